/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_BUCKLING_MODES_H
#define ORTHOSTAT_SOLVE_BUCKLING_MODES_H

#include "algebra/solver.h"
#include "problem/problem.h"
#include "problem/result_data.h"
#include "solve/distributing/held.h"

/* How the search goes about it. */
typedef struct OstModesAim {
    int modes;        /* 1 to OST_MOST_BUCKLING_MODES */
    double tolerance; /* largest residual of a mode, relative to it: its load factor has an error of about the square */
    double least;     /* ends at once where no `softening` can reach this; 0: does not */
    int most_iterations;
    int mixed; /* of a mixed form: its pressures hold, and it is solved where else a preconditioner is applied; 0: the
                  stiffness is taken without them, which is less stiff */
    const OstHeldMotions *held; /* by moved couplings; NULL: nothing */
} OstModesAim;

/* What a search found. `softening`: 1 / load factor of each mode, the largest first; 0 or less: no growth of this load
 * makes the body buckle. */
typedef struct OstModes {
    int count;
    double softening[OST_MOST_BUCKLING_MODES];
    double residual[OST_MOST_BUCKLING_MODES]; /* of each, about its distance from the nearest true one at most */
    int iterations;
    int converged;
} OstModes;

/* Collective. The lowest positive load factors at which the stiffness and the stress of a linear answer, grown by that
 * factor, have a motion that costs no energy: LOBPCG (A. V. Knyazev, Toward the optimal preconditioned eigensolver,
 * SIAM J. Sci. Comput. 23, 2001) on (K + factor K_stress) v = 0, preconditioned by the solver's strategy. A load factor
 * found is never less than the lowest of the discrete problem, up to rounding. `mode`: aim->modes arrays of 3 ×
 * node_count, or NULL; at most as long as 1. */
OstStatus ost_modes_find(const OstProblem *problem, OstSolver *solver, const OstResult *result, const OstModesAim *aim,
                         double *const *mode, OstModes *modes);

#endif
