/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/conjugate_gradients.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"

#include <az_aztec.h>
#include <string.h>

typedef struct Aztec {
    const OstAztecSystem *system;
    double *residual; /* copy of r, as AztecOO passes r in the array that receives z */
    int products;
    int stopped;
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
    /* Skips two products: the first, of x = 0, and the one for a final residual that is not used. */
    if (aztec->products++ == 0 || aztec->stopped)
        memset(y, 0, (size_t)aztec->system->unknowns * sizeof *y);
    else
        note(aztec, aztec->system->multiply(aztec->system->data, p, y));
}

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
    if (aztec->system->unknowns > 0)
        memcpy(aztec->residual, z, (size_t)aztec->system->unknowns * sizeof *z);
    note(aztec, aztec->system->precondition(aztec->system->data, aztec->residual, z, &aztec->stopped));
}

/* AztecOO's convergence test: reports what `precondition` decided. The norm is 1 until then, as with 0 AztecOO would
 * take a breakdown for convergence. */
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

static void set_options(int *options, double *parameters, int most_steps)
{
    AZ_defaults(options, parameters);
    options[AZ_solver] = AZ_cg;
    options[AZ_precond] = AZ_user_precond;
    options[AZ_scaling] = AZ_none;
    options[AZ_conv] = AZTECOO_conv_test;
    options[AZ_output] = AZ_none;
    options[AZ_max_iter] = most_steps;
}

static void iterate(Aztec *aztec, MPI_Comm comm, double *b, double *x, int most_steps, double *outcome)
{
    int configuration[AZ_PROC_SIZE];
    int options[AZ_OPTIONS_SIZE];
    double parameters[AZ_PARAMS_SIZE];
    AZ_set_proc_config(configuration, comm);
    set_options(options, parameters, most_steps);
    AZ_MATRIX *matrix = AZ_matrix_create(aztec->system->unknowns);
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

OstStatus ost_aztec_cg(OstContext *ctx, const OstAztecSystem *system, const double *b, double *x, int most_steps,
                       OstAztecEnd *end)
{
    enum { VECTORS = 4 }; /* r, z, p and A p */
    const size_t n = (size_t)system->unknowns;
    Aztec aztec = {.system = system};
    double outcome[AZ_STATUS_SIZE] = {0};
    double *right_side = NULL;
    OST_TRY(ost_memory_foresee(ctx, (double)(VECTORS * n * sizeof(double)), "AztecOO's conjugate gradients"));
    OstStatus status = OST_NEW(ctx, &aztec.residual, n + 1); /* AztecOO needs arrays even without unknowns */
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &right_side, n + 1);
    OST_TRY_DONE(ost_agree(ctx, status));
    memcpy(right_side, b, n * sizeof *b);
    iterate(&aztec, ost_comm(ctx), right_side, x, most_steps, outcome);
    status = aztec.status;
    *end = aztec.stopped ? OST_AZTEC_STOPPED : outcome[AZ_why] == AZ_breakdown ? OST_AZTEC_BREAKDOWN : OST_AZTEC_STEPS;
done:
    OST_FREE(aztec.residual);
    OST_FREE(right_side);
    return status;
}
