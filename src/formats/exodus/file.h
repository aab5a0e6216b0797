/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXODUS_FILE_H
#define ORTHOSTAT_FORMATS_EXODUS_FILE_H

#include "formats/cells/cells.h"
#include "formats/exodus/netcdf.h"

/* A type of elements, by the first three letters of its name and its nodes. */
typedef struct OstExodusType {
    char begins[4];
    OstLocal nodes; /* 0: of any number */
    int dimension;
    OstCellKind kind; /* OST_CELL_KINDS: not a kind that is read */
    const int *place; /* where each node goes in VTK's order; NULL: it is the same */
} OstExodusType;

/* A block of elements, which follow those of the blocks before. */
typedef struct OstExodusBlock {
    OstGlobal id;
    OstLocal first, count;
    const OstExodusType *type;
} OstExodusBlock;

/* A file while it is read. Lists in it name nodes and elements by their places, from 1; numbers of them that users see
 * are in maps. In a dry run nothing is kept of what is read. */
typedef struct OstExodus {
    OstNetcdf nc;
    OstLocal nodes, elements;
    int parts;                             /* files that the mesh is in */
    OstGlobal *node_label, *element_label; /* NULL: the place is the number */
    OstLocal block_count;
    OstExodusBlock *block;
} OstExodus;

/* Local. Opens a file, one of the `parts` of the mesh, and reads its maps and what blocks there are: of several parts
 * there must be maps. Close it even after a failure. */
OstStatus ost_exodus_open(OstContext *ctx, const char *path, int parts, int dry, OstExodus *exodus);
void ost_exodus_close(OstExodus *exodus);

/* Local. The number of a node or an element by its place; -1 if there is none there. */
OstGlobal ost_exodus_node(const OstExodus *exodus, OstGlobal place);
OstGlobal ost_exodus_element(const OstExodus *exodus, OstGlobal place);

/* Local. How many blocks or sets the dimension `count` states, and their ids, which `property` lists: from 1 on without
 * it. `ids` is the caller's. */
OstStatus ost_exodus_ids(const OstExodus *exodus, const char *count, const char *property, OstLocal *found,
                         OstGlobal **ids);

/* Local. Puts the sets of nodes and of sides into `cells`. */
OstStatus ost_exodus_read_sets(const OstExodus *exodus, OstCells *cells);

#endif
