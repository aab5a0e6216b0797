/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVER_H
#define ORTHOSTAT_SOLVER_H

#include "orthostat/context.h"

OST_API_BEGIN

/* How the linear system is solved, from the cheapest method to the safest. */
typedef enum {
    OST_METHOD_AUTO,   /* starts with the method that the plan names, and goes on to the next where one is too slow or
                          fails */
    OST_METHOD_PLAIN,  /* AztecOO's CG, ML's smoothed aggregation with its own aggregates; never planned */
    OST_METHOD_METRIC, /* AztecOO's CG, ML's cycle over aggregates that are round in the material's metric, block
                          smoothers */
    OST_METHOD_STRONG, /* the same hierarchy with a smoother of higher degree over a wider interval */
    OST_METHOD_TWO_LEVEL, /* strong smoothing over aggregates whose matrix is factored; quadratic tets: over their
                             vertices, which also turn */
    OST_METHOD_DIRECT     /* MUMPS, refined by CG to the requested residual */
} OstMethod;

/* Parameters that the user has given: neither the plan nor a later strategy changes them. */
enum {
    OST_GIVEN_AGGREGATE = 1,
    OST_GIVEN_COARSE_AGGREGATE = 2,
    OST_GIVEN_BLOCK = 4,
    OST_GIVEN_DEGREE = 8,
    OST_GIVEN_RATIO = 16,
    OST_GIVEN_COARSEST = 32
};

typedef struct OstSolverOptions {
    OstMethod method;
    double relative_residual;      /* of the true, unscaled residual */
    double algebraic_fraction;     /* multigrid stops before that where the error of the equations is this share of the
                                      discretisation error, both in the norm of the energy, and the latter is estimated
                                      (OST_FIELD_ERROR); 0: it does not */
    int accept_attainable;         /* take what double precision holds where that is less */
    int max_iterations;            /* over all strategies */
    int patience;                  /* AUTO leaves a strategy that would need more further iterations than this */
    double aggregate_nodes;        /* METRIC to TWO_LEVEL: nodes per aggregate on the finest level; fewer, down to 10,
                                      where Young's moduli differ by more than 1000 (algebra/multigrid/levels.c) */
    double coarse_aggregate_nodes; /* on the levels below */
    double smoother_block_nodes;   /* nodes per smoother block; more, up to 10, there */
    int smoother_degree;           /* Chebyshev degree */
    double smoother_ratio;         /* Chebyshev covers [lambda / ratio, 1.1 lambda] */
    int coarsest_unknowns;         /* stop coarsening below this many */
    int most_levels;               /* stop coarsening at this many; the last one is then factored, however large */
    int load_steps;       /* Newton's method takes at least so many to the whole load; 0: no more than it needs */
    double factor_memory; /* bytes a factorisation may take over all ranks; 0: what is free */
    unsigned given;       /* OST_GIVEN_* */
    int precise;          /* 1: coarse levels in twice single precision; 2: the finest too. The solver sets it */
    int fine;             /* aggregates so small on all levels that coarse ones need no factors. The solver sets it */
    int patches;          /* the finest level is smoothed over patches, which are factored; 2: though single precision
                           * has lost some of their factors. The solver sets it */
    int own_blocks;       /* are the finest aggregates blocks by which prolongators are smoothed? Multigrid sets it */
    int columns;          /* 1: the finest aggregates are the columns of a plate, if it has any; 2: whose matrix is
                           * factored. Multigrid sets it */
} OstSolverOptions;

/* What can be seen of a system before it is solved; 0 where it is not known. */
typedef struct OstSolverFacts {
    OstGlobal unknowns;
    double anisotropy;   /* largest ratio of Young's moduli at one place */
    double poisson;      /* largest over the materials, of a stable family that resists a change of volume as much */
    double contrast;     /* largest over smallest Young's modulus of the body */
    double jump;         /* the same of the materials' smallest moduli: how rigid one is in another */
    double quality;      /* of the worst tet (ost_tet_quality: 1 regular, 0 flat) */
    double free_memory;  /* bytes, over the machines of all ranks */
    double thickness;    /* of quadratic tets: nodes across the body, by its volume over its surface; else 0 */
    double misalignment; /* how far edges are from the stiff directions (ost_metric_graph_misalignment): 1 along them */
    double slenderness;  /* of quadratic tets whose nodes form no columns through the body: their length over its
                            thickness (ost_metric_graph_slenderness) */
    int stops_early;     /* may iterations end where the mesh's error is larger? */
    int repeated;        /* are many stiffnesses solved with, for which a hierarchy can be kept and factors cannot? */
} OstSolverFacts;

enum { OST_PLAN_REASONS = 8 };

/* The first strategy, with which parameters, and why. */
typedef struct OstSolverPlan {
    OstMethod first;
    OstSolverOptions options; /* those of the first strategy */
    int reasons;
    char reason[OST_PLAN_REASONS][160]; /* the first is that of the method */
} OstSolverPlan;

enum { OST_MAX_LEVELS = 12, OST_MAX_STEPS = 6, OST_LONGEST_OUTCOME = 480 };

/* A strategy that was tried. */
typedef struct OstSolveStep {
    OstMethod method;
    int iterations;
    double factor;            /* by which the residual fell in an iteration, geometric mean; 0 if there was none */
    double relative_residual; /* true, at its end */
    double seconds;           /* setup and solve */
    char outcome[OST_LONGEST_OUTCOME]; /* how it ended, in words */
} OstSolveStep;

typedef struct OstSolveReport {
    OstMethod method;         /* the last strategy's */
    char engine[64];          /* which libraries did its work, in words */
    int iterations;           /* over all strategies */
    double relative_residual; /* true, recomputed */
    double
        attainable_residual; /* about what rounding allows, or what was reached if that is less; 0 where nobody asked */
    int rounding_limited;    /* that, and not what was asked for, is what was reached (options.accept_attainable) */
    double setup_seconds, solve_seconds;
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity; /* nonzeros of all levels over those of the finest */
    double condition_estimate;  /* of the preconditioned matrix, from the Lanczos coefficients; 0 if not known */
    double error_estimate;  /* |u - u*| / |u| about, u the unknowns: the larger of that in the 2-norm and that in the
                               norm of the energy, sqrt(u·K u); the 2-norm where factors are at hand. 0 if not
                               known, INFINITY if there is no bound */
    double energy_error;    /* in the norm of the energy, as error_estimate (which it is where factors are at hand) */
    double rounding_error;  /* what of it rounding of K explains; 0 where six digits are left, and nobody asked */
    double rounding_spread; /* standard error of that, over it, where it is a mean over random samples of rounding
                               errors */
    OstSolverPlan plan;
    int steps; /* strategies tried */
    OstSolveStep step[OST_MAX_STEPS];
    int indefinite;         /* did p·Ap < 0 show that the matrix is? */
    double nonzeros;        /* of the matrix, over all ranks */
    double algebraic_error; /* |u - u*| in the norm of the energy, sqrt(u·K u), as conjugate gradients tell; 0 if not
                               known */
    double algebraic_bound; /* the same from above, about */
    int stopped;            /* that was small enough beside the discretisation error before the residual was */
    int iterations_saved;   /* which so many further iterations would have made, at the rate reached */
} OstSolveReport;

/* Local. The defaults: AUTO, 1e-8 in at most 1000 iterations, patience 150, 40 / 8 / 7 nodes, degree 3,
 * ratio 20, coarsest 1000. */
OstSolverOptions ost_solver_default_options(void);
const char *ost_method_name(OstMethod method);

/* Local. Which libraries do a method's work, in words ("AztecOO CG, ML cycle"). */
const char *ost_method_engine(OstMethod method);

/* Local. The plan for a system of which these facts are known; a method other than AUTO is planned as asked. */
void ost_solver_plan(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan);

OST_API_END

#endif
