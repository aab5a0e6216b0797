/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_SELECT_H
#define ORTHOSTAT_CASE_SELECT_H

#include "case/case_data.h"

/* Collective. One flag for each local node, equal on owners and ghosts; memory from the context. Raises as
 * ost_select_nodes does, except that a selection may be empty. */
OstStatus ost_select_flags(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, unsigned char **flags);

/* OST_SHARED_BUT_PASSED: what links and moved couplings pass on at the node belongs to others; IN_DOUBT: to which of
 * two of them cannot be told, or there is a spring too. */
enum { OST_SHARED_BUT_PASSED = 64, OST_SHARED_IN_DOUBT = 128 };

/* Collective. What other supports bear of the reaction of a selection's nodes, along x, y and z: a part (bits 1, 2, 4)
 * or all (bits 8, 16, 32). Nodes at an edge of its faces are asked, behind which faces of the surface are held that are
 * not selected: what acts there is borne by both, or, where the selected faces are not held along that direction, by
 * the others alone; a spring bears nothing where a constraint or a rigid face does. `held` and `*shared` (memory from
 * the context): a byte for each local node, the former as ost_supports_held has it. */
OstStatus ost_select_shared(const OstCase *c, const OstMesh *mesh, const unsigned char *held, OstLocal count,
                            const OstLocal *nodes, unsigned char **shared);

/* Local. The selection's share of what acts at a node along a direction, 0 to 2, of the byte that is `shared`. */
static inline double ost_selected_share(unsigned char shared, int direction)
{
    return shared >> (3 + direction) & 1 ? 0.0 : shared >> direction & 1 ? 0.5 : 1.0;
}

/* Local. Is a boundary in the selection? Do all boundaries of the selection exist? */
int ost_selection_names(const OstSelection *selection, const char *boundary);
OstStatus ost_select_check_names(const OstCase *c, const OstMesh *mesh, const OstSelection *selection);

/* Collective. Warns if the vertex nearest to a place is farther away than the edges there are long: probably a mistake.
 */
OstStatus ost_select_check_place(const OstCase *c, const OstMesh *mesh, const OstSelection *selection);

/* Local. Raises OST_INVALID_INPUT for an unknown region, with the mesh's regions and the one that is probably meant. */
OstStatus ost_raise_no_region(const OstCase *c, OstPlace place, const OstNames *regions, const char *name);

/* Local. Raises OST_INVALID_INPUT at the selection's line of the case. */
OstStatus ost_select_raise(const OstCase *c, const OstSelection *selection, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Local. Is what the selection holds a matter of the mesh: the vertices within a box, a sphere or a cylinder? */
int ost_selection_varies(const OstSelection *on);

/* Collective. Takes the place of a selection to the vertex nearest to it (NEAREST; others stay as they are): on finer
 * meshes it is the nearest, too. */
OstStatus ost_place_at_vertex(const OstMesh *mesh, OstSelection *on);

/* Collective. The same of a watched displacement; warns if the vertex is further away than a tenth of its shortest
 * edge.
 */
OstStatus ost_watch_place(const OstMesh *mesh, OstWatch *watch);

#endif
