/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H
#define ORTHOSTAT_PROBLEM_ROW_GEOMETRY_H

#include "algebra/solver.h"
#include "assembly/system.h"

/* What multigrid needs to know of a system's rows (ost_system_geometry), with the arrays that hold it. */
typedef struct OstRowGeometry {
    double *coordinates, *metric, *modes; /* metric: NULL if isotropic */
    double *moved;                        /* NULL before ost_row_geometry_move */
    OstSolverGeometry geometry;
    const OstSystem *system;
    const OstMaterialField *field;
    int with_metric;
    int kept; /* even if lent, as when they have been moved */
} OstRowGeometry;

/* Collective. */
OstStatus ost_row_geometry_create(const OstSystem *system, const OstMaterialField *field, int with_metric,
                                  OstRowGeometry *rows);
void ost_row_geometry_release(OstRowGeometry *rows);

/* Collective. Takes the modes to the shape that `displacement` (3 × node_count) gives the body, where they are kept. */
OstStatus ost_row_geometry_move(OstRowGeometry *rows, const double *displacement);

/* Local. From now on a solver releases the arrays while it does not need them: modes, positions and metric take 72
 * bytes an unknown. */
void ost_row_geometry_lend(OstRowGeometry *rows);

#endif
