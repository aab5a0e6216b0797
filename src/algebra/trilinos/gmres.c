/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/gmres.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"

#include <az_aztec.h>
#include <string.h>

/* Iterations, for each of which GMRES keeps a vector: it does not start anew. */
enum { MOST = 100 };

/* AztecOO cannot pass on the first failure inside a callback. */
typedef struct Gmres {
    const OstGmresSystem *system;
    OstStatus status;
} Gmres;

static void multiply(double *p, double *y, AZ_MATRIX *matrix, int *configuration)
{
    Gmres *gmres = AZ_get_matvec_data(matrix);
    (void)configuration;
    if (gmres->status == OST_SUCCESS)
        gmres->status = gmres->system->apply(gmres->system->data, p, y);
    if (gmres->status != OST_SUCCESS)
        memset(y, 0, gmres->system->n * sizeof *y);
}

static void iterate(Gmres *gmres, double relative, double *b, double *x, double *outcome)
{
    int configuration[AZ_PROC_SIZE], options[AZ_OPTIONS_SIZE];
    double parameters[AZ_PARAMS_SIZE];
    AZ_set_proc_config(configuration, ost_comm(gmres->system->ctx));
    AZ_defaults(options, parameters);
    options[AZ_solver] = AZ_gmres;
    options[AZ_precond] = AZ_none;
    options[AZ_scaling] = AZ_none;
    options[AZ_conv] = AZ_r0;
    options[AZ_output] = AZ_none;
    options[AZ_kspace] = MOST;
    options[AZ_max_iter] = MOST;
    parameters[AZ_tol] = relative;
    AZ_MATRIX *matrix = AZ_matrix_create((int)gmres->system->n);
    AZ_set_MATFREE(matrix, gmres, multiply);
    AZ_iterate(x, b, options, parameters, outcome, configuration, matrix, NULL, NULL);
    AZ_matrix_destroy(&matrix);
}

OstStatus ost_gmres_iterate(const OstGmresSystem *system, double relative, double *b, double *x, int *iterations,
                            double *residual)
{
    Gmres gmres = {.system = system};
    double outcome[AZ_STATUS_SIZE] = {0};
    OST_TRY(ost_memory_foresee(system->ctx, (double)((MOST + 4) * system->n * sizeof(double)), "AztecOO's GMRES"));
    memset(x, 0, system->n * sizeof *x);
    iterate(&gmres, relative, b, x, outcome);
    *iterations = (int)outcome[AZ_its];
    *residual = outcome[AZ_scaled_r];
    return gmres.status;
}

/* A symmetric matrix with a further part. */
typedef struct Further {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    const OstFurtherPart *part;
    size_t n;
    double *product;  /* n */
    double *unscaled; /* with room for ghosts */
} Further;

/* y = M^-1 S (A + part) S^T p */
static OstStatus apply(void *data, const double *p, double *y)
{
    const Further *further = data;
    const OstScaling *scaling = further->system->scaling;
    if (scaling)
        ost_scaling_from_scaled(scaling, p, further->unscaled);
    else if (further->n > 0)
        memcpy(further->unscaled, p, further->n * sizeof *p);
    OST_TRY(ost_block_matrix_apply(further->system->matrix, further->unscaled, further->product));
    OST_TRY(further->part->add(further->part->data, further->unscaled, further->product));
    if (scaling)
        ost_scaling_to_scaled(scaling, further->product, further->product);
    return further->preconditioner->apply(further->preconditioner->data, further->product, y);
}

/* M^-1 S f */
static OstStatus precondition(const Further *further, const double *f, double *b)
{
    if (further->system->scaling)
        ost_scaling_to_scaled(further->system->scaling, f, further->product);
    else if (further->n > 0)
        memcpy(further->product, f, further->n * sizeof *f);
    return further->preconditioner->apply(further->preconditioner->data, further->product, b);
}

OstStatus ost_gmres_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                          const OstFurtherPart *part, double relative, const double *f, double *u, int *iterations,
                          double *residual)
{
    const OstBlockMatrix *matrix = system->matrix;
    OstContext *ctx = matrix->ctx;
    const size_t n = 3 * (size_t)matrix->rows;
    Further further = {.system = system, .preconditioner = preconditioner, .part = part, .n = n};
    const OstGmresSystem gmres = {.ctx = ctx, .n = n, .data = &further, .apply = apply};
    double *right_side = NULL;
    OstStatus status;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &right_side, 2 * n + 3 * (size_t)matrix->columns)));
    further.product = right_side + n;
    further.unscaled = right_side + 2 * n;
    OST_TRY_DONE(precondition(&further, f, right_side));
    OST_TRY_DONE(ost_gmres_iterate(&gmres, relative, right_side, u, iterations, residual));
    if (system->scaling)
        ost_scaling_from_scaled(system->scaling, u, u);
done:
    OST_FREE(right_side);
    return status;
}
