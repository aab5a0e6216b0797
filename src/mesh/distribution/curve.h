/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_CURVE_H
#define ORTHOSTAT_MESH_DISTRIBUTION_CURVE_H

#include "orthostat/context.h"

/* Collective. Divides points (x: count × 3, finite) among the ranks, about as many to each, by their place along
 * Morton's space-filling curve: each rank's lie close together, in whatever order they are numbered. (Hilbert's curve
 * was tried and did not cut less.) */
OstStatus ost_curve_slabs(OstContext *ctx, OstLocal count, const double *x, int *to);

#endif
