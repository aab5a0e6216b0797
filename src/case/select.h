/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_SELECT_H
#define ORTHOSTAT_CASE_SELECT_H

#include "case/case_data.h"

/* Collective. One flag for each local node, equal on owners and ghosts; memory from the context. Raises as
 * ost_select_nodes does, except that a selection may be empty. */
OstStatus ost_select_flags(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, unsigned char **flags);

/* Why what links pass on to a node may not be the selection's. */
typedef enum {
    OST_BEARING_KNOWN,
    OST_BEARING_OF_LINKS, /* two of them meet there */
    OST_BEARING_OF_TIE    /* a tie does, and supports hold a part of its face */
} OstBearingDoubt;

/* What a selection bears at one of its nodes, the rest being other supports'. */
typedef struct OstBearing {
    double own[9];      /* times the force of constraints and springs there: its part */
    double in_doubt[9]; /* times it: the part that may as well be more or less */
    int is_passed;      /* does it have what links pass on there? */
    int is_moved;       /* and the force of moved couplings? */
    OstBearingDoubt unknown;
} OstBearing;

/* Collective. Of a watched reaction's nodes, as ost_select_nodes has them: `shares`, memory from the context, which
 * counts for owned ones. At an edge of its faces, others of the surface may be held or lie on springs. Each bears what
 * acts along directions that its own constraint holds, half of it where both hold them; springs bear by their
 * stiffness, and nothing where a constraint does. Of a tied or periodic face that supports hold along what is watched,
 * the selection has their force, not what the link passes on. Of a part of a rigid, tied, periodic or coupled face on
 * which springs act it has the springs' force alone, but of a rigid face that is held. */
OstStatus ost_select_shares(const OstCase *c, const OstMesh *mesh, const OstWatch *watch, OstLocal count,
                            const OstLocal *nodes, OstBearing **shares);

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
