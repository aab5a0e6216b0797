/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H
#define ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H

#include "algebra/solver.h"
#include "assembly/system.h"

/* What multigrid needs to know of a system's rows (ost_system_geometry), with the arrays that hold it. */
typedef struct OstRowGeometry {
    double *coordinates, *metric, *modes; /* metric: NULL if isotropic */
    OstSolverGeometry geometry;
} OstRowGeometry;

/* Collective. */
OstStatus ost_row_geometry_create(const OstSystem *system, const OstMaterialField *field, int with_metric,
                                  OstRowGeometry *rows);
void ost_row_geometry_release(OstRowGeometry *rows);

#endif
