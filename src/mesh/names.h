/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NAMES_H
#define ORTHOSTAT_MESH_NAMES_H

#include "orthostat/mesh.h"

void ost_names_clear(OstNames *names);
void ost_boundaries_destroy(int count, OstBoundary **boundaries);

#endif
