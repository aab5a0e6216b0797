/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/unsymmetric.h"

#include "algebra/krylov/precondition.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

typedef struct Run {
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    const OstSaddleFactors *factors;
    const OstCoupling *coupling;
    const OstFurtherPart *further;
    size_t n, m;     /* unknowns, pressures */
    double *product; /* n + m */
    double *wide;    /* displacements with ghosts */
    double *force;   /* n */
    double *q;       /* pressures with ghosts */
    double *work;    /* of ost_coupling_schur_solve */
    double *scaled;  /* n: work of the preconditioner */
} Run;

static OstStatus create(Run *run, double **memory)
{
    const OstCoupling *coupling = run->coupling;
    const size_t n = run->n, m = run->m;
    const size_t columns = 3 * (size_t)run->system->matrix->columns, pressures = (size_t)coupling->columns;
    OST_TRY(ost_agree(coupling->ctx, OST_NEW(coupling->ctx, memory, 5 * n + 6 * m + columns + pressures)));
    run->product = *memory + 2 * (n + m); /* behind right-hand side and solution */
    run->force = run->product + n + m;
    run->scaled = run->force + n;
    run->work = run->scaled + n;
    run->wide = run->work + 3 * m;
    run->q = run->wide + columns;
    return OST_SUCCESS;
}

/* z = M^-1 r. Without factors: z.u = A^-1 r.u, z.p = S^-1 (B z.u - r.p), and what z.p does to z.u. */
static OstStatus precondition(Run *run, const double *r, double *z)
{
    const size_t n = run->n, m = run->m;
    if (run->factors)
        return ost_saddle_factors_solve(run->factors, r, r + n, z, z + n);
    OST_TRY(ost_precondition(run->system, run->preconditioner, r, run->scaled, z));
    memcpy(run->wide, z, n * sizeof *z);
    OST_TRY(ost_halo_import(run->system->matrix->halo, 3 * sizeof(double), run->wide));
    ost_coupling_multiply(run->coupling, run->wide, z + n);
    for (size_t i = 0; i < m; i++)
        z[n + i] -= r[n + i];
    OST_TRY(ost_coupling_schur_solve(run->coupling, NULL, z + n, run->q, run->work));
    memcpy(z + n, run->q, m * sizeof *z);
    OST_TRY(ost_coupling_transpose(run->coupling, run->q, run->force));
    OST_TRY(ost_precondition(run->system, run->preconditioner, run->force, run->scaled, run->wide));
    for (size_t i = 0; i < n; i++)
        z[i] -= run->wide[i];
    return OST_SUCCESS;
}

/* y = M^-1 K x */
static OstStatus apply(void *data, const double *x, double *y)
{
    Run *run = data;
    const size_t n = run->n, m = run->m;
    double *product = run->product;
    memcpy(run->wide, x, n * sizeof *x);
    memcpy(run->q, x + n, m * sizeof *x);
    OST_TRY(ost_block_matrix_apply(run->system->matrix, run->wide, product));
    ost_coupling_multiply(run->coupling, run->wide, product + n);
    OST_TRY(ost_coupling_transpose(run->coupling, run->q, run->force));
    for (size_t i = 0; i < n; i++)
        product[i] += run->force[i];
    OST_TRY(ost_coupling_give_way(run->coupling, run->q, run->work));
    for (size_t i = 0; i < m; i++)
        product[n + i] -= run->work[i];
    OST_TRY(run->further->add(run->further->data, x, product));
    return precondition(run, product, y);
}

OstStatus ost_saddle_solve_unsymmetric(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                       const OstSaddleFactors *factors, const OstSaddle *saddle,
                                       const OstFurtherPart *further, double relative, const double *f, double *u,
                                       int *iterations, double *residual)
{
    const OstCoupling *coupling = saddle->coupling;
    const size_t n = 3 * (size_t)coupling->unknowns, m = (size_t)coupling->rows;
    Run run = {.system = system,
               .preconditioner = preconditioner,
               .factors = factors,
               .coupling = coupling,
               .further = further,
               .n = n,
               .m = m};
    const OstGmresSystem gmres = {.ctx = coupling->ctx, .n = n + m, .data = &run, .apply = apply};
    double *b = NULL;
    OstStatus status;
    OST_TRY_DONE(create(&run, &b));
    double *x = b + n + m;
    memcpy(run.product, f, n * sizeof *f);
    memcpy(run.product + n, saddle->g, m * sizeof *f);
    OST_TRY_DONE(precondition(&run, run.product, b));
    OST_TRY_DONE(ost_gmres_iterate(&gmres, relative, b, x, iterations, residual));
    memcpy(u, x, n * sizeof *u);
    memcpy(saddle->p, x + n, m * sizeof *u);
done:
    OST_FREE(b);
    return status;
}
