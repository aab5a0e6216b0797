/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_NEWTON_DATA_H
#define ORTHOSTAT_SOLVE_NEWTON_DATA_H

#include "solve/distributing/turned.h"
#include "solve/newton.h"

/* How the search for a state at rest ended. */
typedef enum {
    OST_REST_FOUND,
    OST_REST_ROUNDING, /* rounding allows no smaller residual */
    OST_REST_SLOW,     /* too many iterations */
    OST_REST_STALLED,  /* no step along the correction lowers the energy */
    OST_REST_NO_STEP,  /* the linear solver found no correction */
    OST_REST_UNSTABLE, /* at rest, but not stable, and nothing stable was found near by */
    OST_REST_CREEPS    /* at rest, but after so short load steps that the last is out of sight */
} OstRest;

/* The energy may rise above that of the last iteration, but not above all of so many. */
enum { OST_RECENT = 5 };

/* Whole steps that are taken though they are not low enough (newton_search.c). */
typedef struct OstNewtonTrial {
    int steps;            /* 0: none */
    double *displacement; /* count: where they began */
    double *correction;   /* 3 × rows: the first of them */
    double value, slope;  /* of the energy there, along it */
    double goal;          /* the energy below which they are kept */
} OstNewtonTrial;

struct OstNewton {
    OstContext *ctx;
    OstProblem *problem;
    OstSolverOptions options;
    OstStiffnessSolver *stiffness;
    OstNewtonReport report;
    OstSolveReport solve; /* of the last linear solve */

    /* The displacement that is looked for, and where it is. A mixed form's pressures are part of it, at its end. */
    double t;
    size_t count;                     /* 3 × node_count, and the pressures */
    double *displacement, *candidate; /* count */
    double *direction;                /* count: the correction of the displacement */
    double *from;                     /* count: the displacement before its last change */
    double recent[OST_RECENT];        /* the energies at the last displacements, the oldest overwritten first */
    OstNewtonTrial trial;
    int moved;                     /* is there such a change, since the last state at rest? */
    double *residual, *correction; /* 3 × rows, and the pressures */
    double *of_tets;               /* 4 × tet_count: a mixed form's pressures now, which the problem has; else NULL */
    double *internal, *load;       /* 3 × owned_nodes */
    double energy;                 /* total: of the strain, less that of the load */
    double energy_size;            /* the sum of their sizes, for rounding */
    double strain_energy;          /* 0 where there is no energy to minimise */
    double norm;                   /* of the residual */
    double driving;                /* the largest residual with which a load step began, before its prediction */
    double rounding;               /* about what rounding of the displacement leaves of the residual */
    double size;                   /* of load and reactions, or `driving`: what the residual is relative to */

    /* Distributing couplings that are moved, or NULL. Their multipliers are at the displacement's end too. */
    OstTurnedCouplings *couplings;
    int multipliers;
    double driven; /* the residual's norm without what given motions lack */

    /* The last correction: */
    double change;    /* its 2-norm over that of the displacement */
    double forcing;   /* relative residual of its linear solve */
    double decrement; /* its norm in the energy; INFINITY if by the definite stiffness, or taken in part */
    double enough; /* share of the state's size in the norm of the energy; a correction below it is the last. 0: off */
    int stopped;   /* that has ended the last search */
    OstAnswerError answer; /* by linear theory, where `enough` is not 0 */
    int watches_stress;
    OstErrors errors; /* of the state that the last advance ended with */

    /* The solver's hierarchy: */
    int rebuild;      /* is a new one needed? */
    OstMethod method; /* strategy that a new one begins with */
    double cost;      /* iterations per digit of the first solve since it was built; 0: none yet */
    double *beyond;   /* count: a state at rest, found by a jump that a shorter load step may yet avoid; or NULL */
    double beyond_t;  /* its load factor */
    double beyond_change;
    int without_skew;  /* is the skew part of the stiffness left out, to probe the rest? */
    int indefinite;    /* was the exact stiffness found indefinite in this load step? */
    int no_factors;    /* have the next ones not fitted into memory? */
    int by_factors;    /* of couplings: does the solver have factors of the exact stiffness, though it be indefinite? */
    int most_descents; /* iterations with the definite stiffness that a search for rest may take */
    int leaving;       /* is a state that is not stable being left, by the definite stiffness? */
    int step_iterations; /* Newton iterations in this load step */
    int leads_to_pose;   /* does the first load step go straight to a pose that is known? */
};

/* Is there an energy whose derivative the residual is? */
static inline int ost_newton_has_energy(const OstNewton *newton)
{
    return newton->problem->formulation == OST_FORMULATION_CONSISTENT && newton->problem->conservative;
}

/* Are pressures looked for too? The state at rest is then a saddle point and no minimum. */
static inline int ost_newton_is_mixed(const OstNewton *newton)
{
    return newton->problem->pressures != NULL;
}

/* Is the state one where nothing is minimised? Corrections are then taken whole. */
static inline int ost_newton_is_saddle(const OstNewton *newton)
{
    return ost_newton_is_mixed(newton) || newton->couplings;
}

/* Has the stiffness an unsymmetric part? */
static inline int ost_newton_is_unsymmetric(const OstNewton *newton)
{
    return !newton->problem->conservative;
}

/* Collective. Finds the state at rest under load(newton->t), from newton->displacement, in at most so many iterations.
 * A failure is one of the machine; else `rest` says how it ended. */
OstStatus ost_newton_find_rest(OstNewton *newton, int most_iterations, OstRest *rest);

/* Collective. Residual, energy and sizes of a displacement (3 × node_count). */
OstStatus ost_newton_evaluate(OstNewton *newton, const double *displacement);

/* Collective. The correction that the stiffness at newton->displacement makes of `rhs` (3 × rows): newton->correction,
 * and newton->direction with ghosts. `definite`: by the stiffness that is made positive definite tet by tet. *found: 0
 * where the solver found none, or the matrix indefinite. */
OstStatus ost_newton_solve(OstNewton *newton, int definite, double forcing, const double *rhs, int *found);

/* Collective. from + length × direction (count each), on rigid faces along the curve on which they keep their shape. */
OstStatus ost_newton_move(const OstNewton *newton, const double *from, const double *direction, double length,
                          double *to);

/* Collective. By the exact stiffness; where couplings move the body, one that is indefinite serves too. */
OstStatus ost_newton_solve_held(OstNewton *newton, double forcing, const double *rhs, int *found);

/* Collective. The correction on the nodes, ghosts included: zero where the displacement is prescribed. */
OstStatus ost_newton_spread(const OstNewton *newton, const double *correction, double *direction);

/* Collective. Goes along newton->direction until the energy (without one, the residual) is low enough; evaluates there.
 * *length: of the step, 0 if none helps. */
OstStatus ost_newton_search(OstNewton *newton, double *length);

/* Collective. Looks whether the state at rest is stable: is the exact stiffness definite? If not, the body is pushed
 * along its softest motion, and a stable state is looked for from there. */
OstStatus ost_newton_settle(OstNewton *newton, int most_iterations, OstRest *rest);

/* Collective, at rest at the end of an advance: finds newton->errors. */
OstStatus ost_newton_find_errors(OstNewton *newton);

/* Of a mixed form (newton_mixed.c). */

/* Local. Gives the problem the pressures of a displacement. */
void ost_newton_take_pressure(OstNewton *newton, const double *displacement);

/* Local. The second equation's residual at a displacement, in newton->residual behind that of the first. */
OstStatus ost_newton_find_volume(OstNewton *newton, const double *displacement);

/* Collective. Adds to that residual its derivative along a displacement of the nodes, by the difference between it and
 * the one at `displaced`, which is away by `share` of the change. */
OstStatus ost_newton_move_volume(OstNewton *newton, const double *displaced, double share);

/* Collective. The norm of both residuals, in forces. */
OstStatus ost_newton_mixed_norm(const OstNewton *newton, double *norm);

/* Local. The second equation of a linear system for the correction; empty without pressures. */
OstSaddle ost_newton_saddle(const OstNewton *newton, const double *rhs);

/* Collective. Solves both equations for newton->correction. */
OstStatus ost_newton_solve_mixed(OstNewton *newton, const double *rhs);

/* Collective. Raises OST_NOT_CONVERGED: no state at rest was found at load factor t, from `state`; says why and where.
 */
OstStatus ost_newton_give_up(OstNewton *newton, const OstNewtonState *state, double t, OstRest rest);

#endif
