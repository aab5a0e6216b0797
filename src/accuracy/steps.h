/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_STEPS_H
#define ORTHOSTAT_ACCURACY_STEPS_H

#include "accuracy/complement/complement.h"
#include "accuracy/flat/stacks.h"
#include "accuracy/operator.h"
#include "algebra/solver.h"

/* Conjugate gradients for A e = r on the elements' space and its complement, with the solver's preconditioner on the
 * first and 3×3 blocks on the second. Displacements are over `size`, and forces over size × the operator's unit, so
 * that single precision holds them whatever the units of the case. */
typedef struct OstSteps {
    const OstOperator *stiffness;
    const float *factor;     /* of the functions' blocks (accuracy/complement/blocks.h) */
    const OstStacks *stacks; /* their blocks in place of these; or NULL */
    OstSolver *solver;
    size_t rows, functions; /* numbers of the rows, and the functions */
    double size;
    OstEnriched r, p, q, e; /* those of ghosts are 0, but in p */
    double *z;              /* of the rows alone */
    float *stacked;         /* B r of the functions, where there are stacks; or NULL */
    double *u, *force;      /* of nodes, or of columns if those are more: a displacement; forces on it */
    double products[2];     /* of the functions: r'B r, q'B r */
    double weight, gain;    /* r'B r before the last step, and what the step added to |e|² */
    int turns;              /* directions found so far */
    int at_rest;            /* are p's rows 0, as there was no cycle yet? */
    int failed;             /* is the preconditioner, or the stiffness, not positive definite? */
} OstSteps;

/* Collective. Close it also after a failure. */
OstStatus ost_steps_open(const OstOperator *stiffness, const float *factor, const OstStacks *stacks, OstSolver *solver,
                         OstSteps *steps);
void ost_steps_close(OstSteps *steps);

/* Local. Room for 3 double-precision numbers a function, in place of p and q, before the first step. */
double *ost_steps_spare(OstSteps *steps);

/* Local. Takes forces on the functions (3 numbers each) over `divisor` for the residual's. */
void ost_steps_take_residual(OstSteps *steps, const double *forces, double divisor);

/* Local. Before the first step: r is the residual, e = 0. */
void ost_steps_start(OstSteps *steps);

/* Collective. A step, of which every other one takes a multigrid cycle; steps->gain is 0 where there is none to take.
 */
OstStatus ost_steps_next(OstSteps *steps);

/* Collective. What is left of r'B r on the functions. */
OstStatus ost_steps_left(const OstSteps *steps, double *left);

/* Collective. Steps on the elements' own unknowns alone, until they move e by little: few steps have little of a
 * displacement far from where its error is made. The first goes along a displacement u (3 × node_count, of a body whose
 * nodes follow no others), as bodies are too stiff everywhere; NULL: it does not. The last thing that is done with
 * `steps`, but for reading e. */
OstStatus ost_steps_settle(OstSteps *steps, const double *u);

/* Local; collective where nodes follow others. The rows' part of forces on nodes. */
OstStatus ost_steps_take_rows(const OstSteps *steps, double *rows);

/* Collective. a'b */
OstStatus ost_steps_dot(const OstSteps *steps, const OstEnriched *a, const OstEnriched *b, double *product);

#endif
