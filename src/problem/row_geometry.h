/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H
#define ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H

#include "algebra/solver.h"
#include "assembly/system.h"

/* What multigrid needs to know of a system's rows (ost_system_geometry), with the arrays that hold it. */
typedef struct OstRowGeometry {
    double *coordinates, *metric, *modes; /* metric: NULL if isotropic */
    OstSolverGeometry geometry;
    const OstSystem *system;
    const OstMaterialField *field;
    int with_metric;
    int kept; /* by somebody who has changed the modes, even if lent */
} OstRowGeometry;

/* Collective. */
OstStatus ost_row_geometry_create(const OstSystem *system, const OstMaterialField *field, int with_metric,
                                  OstRowGeometry *rows);
void ost_row_geometry_release(OstRowGeometry *rows);

/* Local. From now on a solver releases the arrays while it does not need them: modes, positions and metric take 72
 * bytes an unknown. Whoever changes the modes sets `kept`. */
void ost_row_geometry_lend(OstRowGeometry *rows);

#endif
