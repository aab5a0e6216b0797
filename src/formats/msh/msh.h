/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MSH_MSH_H
#define ORTHOSTAT_FORMATS_MSH_MSH_H

#include "formats/cells/split.h"
#include "formats/msh/cursor.h"
#include "formats/serial/label_index.h"
#include "mesh/mesh_data.h"

#include <stddef.h>

/* Gmsh's numbers of the element types in use. */
enum {
    OST_MSH_LINE2 = 1,
    OST_MSH_TRIANGLE3 = 2,
    OST_MSH_TET4 = 4,
    OST_MSH_LINE3 = 8,
    OST_MSH_TRIANGLE6 = 9,
    OST_MSH_TET10 = 11,
    OST_MSH_POINT = 15,
    OST_MSH_TYPES = 32,
    OST_MSH_MOST_NODES = 56
};

typedef struct OstMshType {
    int dimension, nodes;
    const char *shape;
} OstMshType;
extern const OstMshType ost_msh_types[OST_MSH_TYPES];

/* Types that are split, and Gmsh's place of each node of the kind that they are. */
typedef struct OstMshCell {
    int type;
    OstCellKind kind;
    signed char place[27];
} OstMshCell;

/* Local. NULL for a type that is not split. */
const OstMshCell *ost_msh_cell(int type);

/* Local. The type of the tets that a solid of this type is, or becomes; 0 for another. */
int ost_msh_tet_type(int type);

/* A line of $PhysicalNames. */
typedef struct OstMshName {
    int dimension; /* -1: any; version 2.0 does not say */
    int tag;
    OstMshText text;
} OstMshName;

/* A physical group, by dimension and tag: a region, or a boundary with its nodes. */
typedef struct OstMshGroup {
    int dimension, tag;
    int number;           /* of its region or boundary; -1 at first */
    int type, other_type; /* of the first element; of one of another type, or 0 */
    int quad;             /* that of quadrilaterals, which are triangles here; or 0 */
    OstLocal count;
    OstGlobal *nodes; /* count × nodes of the type: positions in the chunk */
} OstMshGroup;

/* Where a section lies in memory; a large one is longer than OstMshText can say. */
typedef struct OstMshBytes {
    const char *start; /* NULL: not read yet */
    ptrdiff_t length;
} OstMshBytes;
enum { OST_MSH_SECTIONS = 8, OST_MSH_LONGEST_NAME = 64 };

/* A .msh file while it is read. tet_region then holds physical tags, 0 for none, and labels of pieces of other solids
 * are negative. */
typedef struct OstMsh {
    OstMshCursor cursor;
    int version; /* 10, 20, 21, 22, 30, 40 or 41 */
    int stage;   /* the last section that was read */
    OstMshBytes text[OST_MSH_SECTIONS];
    OstMeshChunk *chunk;
    OstLabelIndex nodes;           /* tag to position, once all are read */
    OstGlobal elements;            /* number that the file states */
    OstGlobal read[OST_MSH_TYPES]; /* elements of each type */
    int tet_type;                  /* of the first tet */
    int tets_out_of_order;         /* their tags do not ascend */
    OstGlobal last_tag;            /* of a tet */
    OstSplit split;                /* of cells that are no tets */
    int name_count;
    OstMshName *name;
    int group_count;
    OstMshGroup *group; /* volumes first, points last; by tag */
    OstGlobal ghosts;   /* elements that other partitions own; left out */
    int borders;        /* are there borders between partitions, with physical groups? Left out */
    OstGlobal items;    /* elements in groups, once for each group but the first of a tet */
    /* Entities of versions 3 and 4, and the physical groups they belong to. */
    OstGlobal entity_count;
    OstGlobal *entity;       /* dimension and tag in one number */
    OstGlobal *entity_start; /* entity_count + 1, into entity_group */
    int *entity_group;
    OstLabelIndex entities;
} OstMsh;

/* Local. Read the sections of versions 1 and 2 (or 3, or 4), after the line that names them. */
OstStatus ost_msh2_nodes(OstMsh *msh);
OstStatus ost_msh2_parametric_nodes(OstMsh *msh);
OstStatus ost_msh2_elements(OstMsh *msh);
OstStatus ost_msh3_entities(OstMsh *msh);
OstStatus ost_msh3_nodes(OstMsh *msh);
OstStatus ost_msh3_elements(OstMsh *msh);
OstStatus ost_msh4_entities(OstMsh *msh);
OstStatus ost_msh4_partitioned_entities(OstMsh *msh);
OstStatus ost_msh4_nodes(OstMsh *msh);
OstStatus ost_msh4_elements(OstMsh *msh);

/* Local. Raises if the type is none of those. */
OstStatus ost_msh_check_type(const OstMsh *msh, int type);

/* Local. Allocates the nodes that a section states. */
OstStatus ost_msh_reserve_nodes(OstMsh *msh, OstGlobal count);

/* Local. Indexes nodes by their tags once all are read; raises if two share one. */
OstStatus ost_msh_index_nodes(OstMsh *msh);

/* Local. Adds a node, or an element with its physical tags (of either sign, 0 for none). */
OstStatus ost_msh_add_node(OstMsh *msh, OstGlobal tag, const double x[3]);
OstStatus ost_msh_add_element(OstMsh *msh, int type, OstGlobal tag, const OstGlobal *nodes, OstGlobal group_count,
                              const int *groups);

/* Local. Once all entities are read, indexes them; then: is a volume one of elements that other partitions own, and
 * which physical groups is an entity in? */
OstStatus ost_msh_index_entities(OstMsh *msh);
int ost_msh_is_ghost(const OstMsh *msh, int tag);
void ost_msh_find_groups(const OstMsh *msh, int dimension, int tag, OstGlobal *count, const int **groups);

/* Local. The group of a dimension and tag; a new one if there is none. */
OstStatus ost_msh_group(OstMsh *msh, int dimension, int tag, OstMshGroup **group);

/* Local. Turns what was read into the chunk: names regions and boundaries, sorts tets by tag, reorders them if all are
 * inverted, leaves out unused nodes; or refuses the mesh. */
OstStatus ost_msh_finish(OstMsh *msh);

/* Local. The section $MeshFormat; the first word of a section's line, without the $; goes to the $End line of a
 * section.
 */
OstStatus ost_msh_format(OstMsh *msh);
void ost_msh_section_name(OstMshText line, char name[OST_MSH_LONGEST_NAME]);
OstStatus ost_msh_skip_section(OstMshCursor *cursor, const char *name);

#endif
