/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MSH_CHECK_H
#define ORTHOSTAT_FORMATS_MSH_CHECK_H

#include "formats/msh_cursor.h"

/* What a .msh file holds, by a walk over it. Gmsh's own reader trusts the counts and numbers of a file: it writes past
 * its arrays where they are wrong, takes a cut file for an empty one, and runs one that is no mesh as a script. So it
 * is handed only files that have passed here. */
typedef struct OstMshContents {
    int version; /* 22 or 41 */
    OstGlobal nodes;
    OstGlobal elements;
    OstGlobal first_node_tag, last_node_tag;
    OstGlobal last_tet_tag;
    int tets_out_of_order; /* their tags do not ascend */
    int type_of_shape[8];  /* Gmsh's type of lines 1, triangles 2, quadrangles 3, tets 4, ...; 0: none so far */
} OstMshContents;

/* Local. Raises OST_INVALID_INPUT with file:line (or the byte) where the file is cut, not a mesh of version 2.2 or 4.1,
 * or holds sections, counts, tags or elements that cannot be. */
OstStatus ost_msh_check(OstContext *ctx, const char *path, OstMshContents *contents);

/* Local. The walks over what the two versions write in their own ways; for ost_msh_check. */
OstStatus ost_msh22_nodes(OstMshCursor *cursor, OstMshContents *contents);
OstStatus ost_msh22_elements(OstMshCursor *cursor, OstMshContents *contents);
OstStatus ost_msh41_entities(OstMshCursor *cursor);
OstStatus ost_msh41_nodes(OstMshCursor *cursor, OstMshContents *contents);
OstStatus ost_msh41_elements(OstMshCursor *cursor, OstMshContents *contents);

/* Local. Takes the tag of a node (of an element) as it is defined, and checks the tag of a node where it is used. */
OstStatus ost_msh_define_node(const OstMshCursor *cursor, OstMshContents *contents, OstGlobal tag);
OstStatus ost_msh_define_element(const OstMshCursor *cursor, OstMshContents *contents, int type, OstGlobal tag);
OstStatus ost_msh_use_node(const OstMshCursor *cursor, const OstMshContents *contents, OstGlobal tag);

/* Local. Dimension and node count of Gmsh's element types; raises on one that Gmsh does not write for solids. */
OstStatus ost_msh_element_type(const OstMshCursor *cursor, int type, int *dimension, int *nodes);

/* Local. Dimension of a type that has passed. */
int ost_msh_type_dimension(int type);

#endif
