/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NAMES_H
#define ORTHOSTAT_MESH_NAMES_H

#include "mesh/mesh_data.h"

void ost_names_clear(OstNames *names);
void ost_boundaries_destroy(int count, OstBoundary **boundaries);

/* Local. Adds a copy of `text` at the end of a list of names; the second one with a number behind it (text-2) if the
 * list has that name already. */
OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text);
OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text);

#endif
