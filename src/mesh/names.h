/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NAMES_H
#define ORTHOSTAT_MESH_NAMES_H

#include "mesh/mesh_data.h"

void ost_names_clear(OstNames *names);
void ost_boundaries_destroy(int count, OstBoundary **boundaries);

/* Local. Appends a copy of `text` to a list of names; ost_names_add_unique appends a number (text-2) if the list has
 * that name already. */
OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text);
OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text);

#endif
