/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_SELECT_H
#define ORTHOSTAT_CASE_SELECT_H

#include "case/case_data.h"

/* Collective. One flag for each local node, alike on owners and ghosts; memory from the context. Raises as
 * ost_select_nodes does, but an empty selection is no error here. */
OstStatus ost_select_flags(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, unsigned char **flags);

/* Local. Is a boundary one of the selection's? Does every boundary of the selection exist? */
int ost_selection_names(const OstSelection *selection, const char *boundary);
OstStatus ost_select_check_names(const OstCase *c, const OstMesh *mesh, const OstSelection *selection);

/* Collective. Warns of a nearest vertex farther from its place than the body's edges are long there: likely a slip. */
OstStatus ost_select_check_place(const OstCase *c, const OstMesh *mesh, const OstSelection *selection);

/* Local. Raises OST_INVALID_INPUT: no region has this name, with those that the mesh has and the one that may be meant.
 */
OstStatus ost_raise_no_region(const OstCase *c, OstPlace place, const OstNames *regions, const char *name);

/* Local. Raises with the selection's line of the case in front. */
OstStatus ost_select_raise(const OstCase *c, const OstSelection *selection, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
