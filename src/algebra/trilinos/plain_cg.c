/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/plain_cg.h"

#include "core/error.h"
#include "core/memory.h"

#include <az_aztec.h>
#include <math.h>
#include <string.h>

typedef struct Aztec {
    const OstBlockMatrix *matrix;
    const OstPreconditioner *preconditioner;
    OstGoal *goal;
    size_t n;         /* unknowns this rank owns */
    double *vector;   /* 3 × columns: what is multiplied, with its ghosts */
    double *residual; /* the right-hand side of the run, then what is preconditioned */
    double weight;    /* this rank's part of r·z */
    int applied;      /* is that of the residual now tested? */
    int stopped;
    OstStatus status; /* the first failure inside a callback */
} Aztec;

static void note(Aztec *aztec, OstStatus status)
{
    if (aztec->status == OST_SUCCESS)
        aztec->status = status;
}

static void multiply(double *x, double *y, AZ_MATRIX *matrix, int *configuration)
{
    Aztec *aztec = AZ_get_matvec_data(matrix);
    (void)configuration;
    memcpy(aztec->vector, x, aztec->n * sizeof *x);
    note(aztec, ost_block_matrix_apply(aztec->matrix, aztec->vector, y));
}

/* Aztec hands over r in z and wants M^-1 r there. */
static void precondition(double *z, int *options, int *configuration, double *parameters, AZ_MATRIX *matrix,
                         AZ_PRECOND *preconditioner)
{
    Aztec *aztec = AZ_get_precond_data(preconditioner);
    (void)options;
    (void)configuration;
    (void)parameters;
    (void)matrix;
    memcpy(aztec->residual, z, aztec->n * sizeof *z);
    note(aztec, aztec->preconditioner->apply(aztec->preconditioner->data, aztec->residual, z));
    aztec->weight = 0.0;
    for (size_t i = 0; i < aztec->n; i++)
        aztec->weight += aztec->residual[i] * z[i];
    aztec->applied = 1;
}

/* Called by Aztec after every iteration: stops it when the goal is met or something is wrong. Never takes a stop back:
 * Aztec asks again with the true residual, which ost_refine deals with. */
static void test(void *data, void *vector, int iteration, double *r, int print, int updated, int *converged,
                 int *not_a_number, double *norm, int *residual_wanted)
{
    Aztec *aztec = data;
    OstGoal *goal = aztec->goal;
    double sums[2] = {0.0, aztec->weight};
    (void)vector;
    (void)print;
    (void)updated;
    for (size_t i = 0; i < aztec->n; i++)
        sums[0] += r[i] * r[i];
    note(aztec, OST_MPI(goal->ctx, MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, ost_comm(goal->ctx))));
    *norm = sqrt(sums[0]);
    if (!aztec->stopped) {
        aztec->stopped =
            iteration > 0 ? !ost_goal_count(goal, *norm, aztec->applied ? sums[1] : 0.0) : *norm <= goal->target;
        if (!aztec->stopped && aztec->applied)
            aztec->stopped = !ost_goal_accepts(goal, sums[1]);
        aztec->stopped = aztec->stopped || aztec->status != OST_SUCCESS;
    }
    aztec->applied = 0;
    *converged = aztec->stopped;
    *not_a_number = 0;
    *residual_wanted = AZ_TRUE;
}

static void set_options(const Aztec *aztec, int *options, double *parameters)
{
    AZ_defaults(options, parameters);
    options[AZ_solver] = AZ_cg;
    options[AZ_precond] = AZ_user_precond;
    options[AZ_scaling] = AZ_none;
    options[AZ_conv] = AZTECOO_conv_test;
    options[AZ_output] = AZ_none;
    options[AZ_max_iter] = aztec->goal->most_iterations - aztec->goal->iterations;
}

static OstStatus read_outcome(const Aztec *aztec, const double *outcome)
{
    OST_TRY(aztec->status);
    if (outcome[AZ_why] == AZ_breakdown)
        return OST_RAISE(aztec->goal->ctx, OST_NOT_CONVERGED,
                         "iteration %d: p·Ap is not a positive number: the stiffness is not positive definite; check "
                         "supports and materials",
                         aztec->goal->iterations + 1);
    return OST_SUCCESS;
}

/* OstInnerSolve */
static OstStatus iterate(void *data, const double *r, double *u, OstGoal *goal)
{
    Aztec *aztec = data;
    int configuration[AZ_PROC_SIZE];
    int options[AZ_OPTIONS_SIZE];
    double parameters[AZ_PARAMS_SIZE];
    double outcome[AZ_STATUS_SIZE] = {0};
    aztec->goal = goal;
    aztec->stopped = 0;
    aztec->applied = 0;
    memcpy(aztec->residual, r, aztec->n * sizeof *r);
    AZ_set_proc_config(configuration, ost_comm(goal->ctx));
    set_options(aztec, options, parameters);
    AZ_MATRIX *matrix = AZ_matrix_create((int)aztec->n);
    AZ_set_MATFREE(matrix, aztec, multiply);
    AZ_PRECOND *preconditioner = AZ_precond_create(matrix, precondition, aztec);
    matrix->conv_info = AZ_converge_create();
    matrix->conv_info->conv_object = aztec;
    matrix->conv_info->conv_function = test;
    AZ_iterate(u, aztec->residual, options, parameters, outcome, configuration, matrix, preconditioner, NULL);
    AZ_converge_destroy(&matrix->conv_info);
    AZ_precond_destroy(&preconditioner);
    AZ_matrix_destroy(&matrix);
    return read_outcome(aztec, outcome);
}

OstStatus ost_aztec_solve(const OstBlockMatrix *matrix, const OstPreconditioner *preconditioner, const double *f,
                          double *u, OstGoal *goal)
{
    OstContext *ctx = matrix->ctx;
    Aztec aztec = {.matrix = matrix, .preconditioner = preconditioner, .n = 3 * (size_t)matrix->rows};
    OstStatus status = OST_NEW(ctx, &aztec.vector, 3 * (size_t)matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &aztec.residual, aztec.n);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_refine(matrix, iterate, &aztec, f, u, goal));
done:
    OST_FREE(aztec.vector);
    OST_FREE(aztec.residual);
    return status;
}
