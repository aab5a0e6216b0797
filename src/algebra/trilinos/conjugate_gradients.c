/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/cg_run.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"

#include <az_aztec.h>
#include <math.h>
#include <string.h>

enum { AZTEC_SUMS = 2 }; /* over all ranks that AztecOO makes itself in a step: p·Ap and r·z */

/* AztecOO iterates; the goal and the Lanczos estimate need these numbers of each step. */
typedef struct Aztec {
    OstCgRun *run;
    OstGoal *goal;
    double *residual;       /* copy of r, as AztecOO passes r in the array that receives z */
    const double *solution; /* x, which AztecOO improves in place */
    int steps, products;
    int stopped;      /* by the goal or by a failure */
    int multiplied;   /* has A p been computed since the last residual? */
    double energy;    /* this rank's part of p·Ap */
    double weight;    /* r·z of this step */
    OstStatus status; /* the first failure inside a callback: AztecOO cannot pass it on */
} Aztec;

static void note(Aztec *aztec, OstStatus status)
{
    if (aztec->status == OST_SUCCESS)
        aztec->status = status;
    aztec->stopped = aztec->stopped || status != OST_SUCCESS;
}

static void multiply(double *p, double *y, AZ_MATRIX *matrix, int *configuration)
{
    Aztec *aztec = AZ_get_matvec_data(matrix);
    (void)configuration;
    /* Skips the products of which nothing is used: the first, of x = 0, and those for a final residual, after the end
     * or after a breakdown. */
    if (aztec->products++ == 0 || aztec->stopped) {
        memset(y, 0, aztec->run->n * sizeof *y);
    } else if (!aztec->multiplied) {
        note(aztec, ost_cg_multiply(aztec->run, p, y));
        aztec->energy = ost_dot(aztec->run->n, p, y);
        aztec->multiplied = 1;
        ost_ledger_reduced(aztec->run->ctx, AZTEC_SUMS);
    }
}

/* Counts the step whose residual is r; `norm` is that of the unscaled residual. */
static OstStatus count_step(Aztec *aztec, double *norm)
{
    OstCgRun *run = aztec->run;
    double sums[2] = {ost_cg_square(run, aztec->residual), aztec->energy};
    OST_TRY(ost_sum(run->ctx, 2, sums));
    *norm = run->size * sqrt(sums[0]);
    if (aztec->steps == 0)
        return OST_SUCCESS;
    if (run->runs == 0)
        OST_TRY(ost_lanczos_add(&run->lanczos, aztec->weight / sums[1], aztec->weight));
    ost_goal_count(aztec->goal, *norm, run->size * run->size * aztec->weight);
    return OST_SUCCESS;
}

/* Ends the iteration if the goal says so; else z = M^-1 r. */
static OstStatus next_step(Aztec *aztec, double *z)
{
    OstCgRun *run = aztec->run;
    OstGoal *goal = aztec->goal;
    double norm;
    OST_TRY(count_step(aztec, &norm));
    if (aztec->steps > 0)
        OST_TRY(ost_cg_judge_error(run, aztec->solution, goal));
    aztec->stopped = norm <= goal->target || goal->enough || goal->stagnates || goal->end != OST_END_REACHED ||
                     goal->iterations >= goal->most_iterations;
    if (aztec->stopped)
        return OST_SUCCESS;
    OST_TRY(run->preconditioner->apply(run->preconditioner->data, aztec->residual, z));
    aztec->weight = ost_dot(run->n, aztec->residual, z);
    OST_TRY(ost_sum(run->ctx, 1, &aztec->weight));
    aztec->stopped = !ost_goal_accepts(goal, aztec->weight);
    aztec->steps++;
    aztec->multiplied = 0;
    return OST_SUCCESS;
}

/* Called before each step. The iteration is ended here, as otherwise AztecOO applies the preconditioner once more after
 * its last step. */
static void precondition(double *z, int *options, int *configuration, double *parameters, AZ_MATRIX *matrix,
                         AZ_PRECOND *preconditioner)
{
    Aztec *aztec = AZ_get_precond_data(preconditioner);
    (void)options;
    (void)configuration;
    (void)parameters;
    (void)matrix;
    if (aztec->stopped)
        return;
    if (aztec->run->n > 0)
        memcpy(aztec->residual, z, aztec->run->n * sizeof *z);
    note(aztec, next_step(aztec, z));
}

/* AztecOO's convergence test: reports what `next_step` decided. The norm is 1 until then, as with 0 AztecOO would take
 * a breakdown for convergence. */
static void test(void *data, void *vector, int iteration, double *r, int print, int updated, int *converged,
                 int *not_a_number, double *norm, int *residual_wanted)
{
    (void)vector;
    (void)iteration;
    (void)r;
    (void)print;
    (void)updated;
    *converged = ((const Aztec *)data)->stopped;
    *not_a_number = 0;
    *norm = *converged ? 0.0 : 1.0;
    *residual_wanted = AZ_TRUE;
}

static void iterate(Aztec *aztec, double *b, double *x, double *outcome)
{
    int configuration[AZ_PROC_SIZE], options[AZ_OPTIONS_SIZE];
    double parameters[AZ_PARAMS_SIZE];
    AZ_set_proc_config(configuration, ost_comm(aztec->run->ctx));
    AZ_defaults(options, parameters);
    options[AZ_solver] = AZ_cg;
    options[AZ_precond] = AZ_user_precond;
    options[AZ_scaling] = AZ_none;
    options[AZ_conv] = AZTECOO_conv_test;
    options[AZ_output] = AZ_none;
    options[AZ_max_iter] = aztec->goal->most_iterations - aztec->goal->iterations + 1;
    AZ_MATRIX *matrix = AZ_matrix_create((int)aztec->run->n);
    AZ_set_MATFREE(matrix, aztec, multiply);
    AZ_PRECOND *preconditioner = AZ_precond_create(matrix, precondition, aztec);
    matrix->conv_info = AZ_converge_create();
    matrix->conv_info->conv_object = aztec;
    matrix->conv_info->conv_function = test;
    AZ_iterate(x, b, options, parameters, outcome, configuration, matrix, preconditioner, NULL);
    AZ_converge_destroy(&matrix->conv_info);
    AZ_precond_destroy(&preconditioner);
    AZ_matrix_destroy(&matrix);
}

OstStatus ost_cg_run_by_aztec(OstCgRun *run, double *u, OstGoal *goal)
{
    enum { VECTORS = 4 }; /* r, z, p and A p */
    const size_t n = run->n;
    OstContext *ctx = run->ctx;
    Aztec aztec = {.run = run, .goal = goal, .solution = u};
    double outcome[AZ_STATUS_SIZE] = {0};
    OST_TRY(ost_memory_foresee(ctx, (double)(VECTORS * n * sizeof(double)), "AztecOO's conjugate gradients"));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &aztec.residual, 2 * n)));
    double *right_side = memcpy(aztec.residual + n, run->residual, n * sizeof *run->residual);
    iterate(&aztec, right_side, u, outcome);
    OST_FREE(aztec.residual);
    OST_TRY(aztec.status);
    if (aztec.stopped || (int)outcome[AZ_why] != AZ_breakdown)
        return OST_SUCCESS;
    OST_TRY(ost_sum(ctx, 1, &aztec.energy));
    return ost_cg_judge_energy(run, aztec.energy, goal);
}
