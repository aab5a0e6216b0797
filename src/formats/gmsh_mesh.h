/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_GMSH_MESH_H
#define ORTHOSTAT_FORMATS_GMSH_MESH_H

#include "formats/gmsh_library.h"
#include "formats/label_index.h"
#include "formats/msh_check.h"
#include "orthostat/mesh.h"

/* Gmsh's numbers of the element types in use. */
enum {
    OST_GMSH_LINE2 = 1,
    OST_GMSH_TRIANGLE3 = 2,
    OST_GMSH_TET4 = 4,
    OST_GMSH_LINE3 = 8,
    OST_GMSH_TRIANGLE6 = 9,
    OST_GMSH_TET10 = 11,
    OST_GMSH_POINT = 15
};

/* A mesh on its way from Gmsh's model to a chunk. In files of version 2.2 the physical tag stands with each element,
 * and is read as the tag of its entity (Gmsh would give an entity the groups of all its elements, and those to each);
 * in files of version 4.1 entities belong to groups. */
typedef struct OstGmshMesh {
    OstGmsh gmsh;
    OstMshContents contents;
    OstMeshChunk *chunk;
    OstLabelIndex nodes;
} OstGmshMesh;

/* Local. Tets and their regions. */
OstStatus ost_gmsh_read_tets(OstGmshMesh *mesh);

/* Local. Physical points, curves and surfaces. */
OstStatus ost_gmsh_read_boundaries(OstGmshMesh *mesh);

/* Local. Elements of a type in an entity, or in all (-1): tags (NULL if not wanted) and nodes, freed by ost_gmsh_free.
 */
OstStatus ost_gmsh_elements(const OstGmshMesh *mesh, int type, int entity, size_t **tags, size_t *count,
                            size_t **nodes);

/* Local. Writes the name of a physical group, or a made one ("surface-3"); `name` is freed by OST_FREE. */
OstStatus ost_gmsh_group_name(const OstGmshMesh *mesh, int dimension, int tag, char **name);

/* Local. Gmsh's name of an element type, such as "Hexahedron 8". */
OstStatus ost_gmsh_type_name(const OstGmshMesh *mesh, int type, char *name, size_t size);

/* Local. Positions of nodes in the chunk. */
OstStatus ost_gmsh_find_nodes(const OstGmshMesh *mesh, size_t count, const size_t *tags, OstGlobal *positions);

#endif
