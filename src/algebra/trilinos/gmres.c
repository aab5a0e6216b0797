/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/gmres.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"

#include <az_aztec.h>
#include <string.h>

/* Iterations, for each of which GMRES keeps a vector: it does not start anew. */
enum { MOST = 100 };

typedef struct Gmres {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    const OstFurtherPart *further;
    size_t n;
    double *product;  /* n */
    double *unscaled; /* with room for ghosts */
    OstStatus status; /* the first failure inside a callback: AztecOO cannot pass it on */
} Gmres;

/* y = M^-1 S (A + further) S^T p */
static OstStatus apply(Gmres *gmres, const double *p, double *y)
{
    const OstScaling *scaling = gmres->system->scaling;
    if (scaling)
        ost_scaling_from_scaled(scaling, p, gmres->unscaled);
    else if (gmres->n > 0)
        memcpy(gmres->unscaled, p, gmres->n * sizeof *p);
    OST_TRY(ost_block_matrix_apply(gmres->system->matrix, gmres->unscaled, gmres->product));
    OST_TRY(gmres->further->add(gmres->further->data, gmres->unscaled, gmres->product));
    if (scaling)
        ost_scaling_to_scaled(scaling, gmres->product, gmres->product);
    return gmres->preconditioner->apply(gmres->preconditioner->data, gmres->product, y);
}

static void multiply(double *p, double *y, AZ_MATRIX *matrix, int *configuration)
{
    Gmres *gmres = AZ_get_matvec_data(matrix);
    (void)configuration;
    if (gmres->status == OST_SUCCESS)
        gmres->status = apply(gmres, p, y);
    if (gmres->status != OST_SUCCESS)
        memset(y, 0, gmres->n * sizeof *y);
}

static void iterate(Gmres *gmres, double relative, double *b, double *x, double *outcome)
{
    int configuration[AZ_PROC_SIZE], options[AZ_OPTIONS_SIZE];
    double parameters[AZ_PARAMS_SIZE];
    AZ_set_proc_config(configuration, ost_comm(gmres->system->matrix->ctx));
    AZ_defaults(options, parameters);
    options[AZ_solver] = AZ_gmres;
    options[AZ_precond] = AZ_none;
    options[AZ_scaling] = AZ_none;
    options[AZ_conv] = AZ_r0;
    options[AZ_output] = AZ_none;
    options[AZ_kspace] = MOST;
    options[AZ_max_iter] = MOST;
    parameters[AZ_tol] = relative;
    AZ_MATRIX *matrix = AZ_matrix_create((int)gmres->n);
    AZ_set_MATFREE(matrix, gmres, multiply);
    AZ_iterate(x, b, options, parameters, outcome, configuration, matrix, NULL, NULL);
    AZ_matrix_destroy(&matrix);
}

/* M^-1 S f */
static OstStatus precondition(Gmres *gmres, const double *f, double *b)
{
    if (gmres->system->scaling)
        ost_scaling_to_scaled(gmres->system->scaling, f, gmres->product);
    else if (gmres->n > 0)
        memcpy(gmres->product, f, gmres->n * sizeof *f);
    return gmres->preconditioner->apply(gmres->preconditioner->data, gmres->product, b);
}

OstStatus ost_gmres_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                          const OstFurtherPart *further, double relative, const double *f, double *u, int *iterations,
                          double *residual)
{
    const OstBlockMatrix *matrix = system->matrix;
    OstContext *ctx = matrix->ctx;
    const size_t n = 3 * (size_t)matrix->rows;
    Gmres gmres = {.system = system, .preconditioner = preconditioner, .further = further, .n = n};
    double outcome[AZ_STATUS_SIZE] = {0}, *right_side = NULL;
    OstStatus status;
    OST_TRY(ost_memory_foresee(ctx, (double)((MOST + 4) * n * sizeof(double)), "AztecOO's GMRES"));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &right_side, 2 * n + 3 * (size_t)matrix->columns)));
    gmres.product = right_side + n;
    gmres.unscaled = right_side + 2 * n;
    memset(u, 0, n * sizeof *u);
    OST_TRY_DONE(precondition(&gmres, f, right_side));
    iterate(&gmres, relative, right_side, u, outcome);
    OST_TRY_DONE(gmres.status);
    if (system->scaling)
        ost_scaling_from_scaled(system->scaling, u, u);
    *iterations = (int)outcome[AZ_its];
    *residual = outcome[AZ_scaled_r];
done:
    OST_FREE(right_side);
    return status;
}
