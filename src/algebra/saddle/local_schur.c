/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/local_schur.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/scatter.h"

#include <math.h>
#include <string.h>

/* T is asked where its diagonal is below the first share of that of S at one of so many pressures. Of the hard grid's
 * bodies, S has its smallest eigenvalue at 0.09 and more of the mass matrix where no diagonal is below 0.1, and at 0.06
 * to 1e-9 where some are. */
static const double apart = 0.1, one_of = 200.0;

/* T's diagonal is 0.3 to 2 of that of S at most pressures; below the first, weights make S smaller. With 0.3 in place
 * of it an incompressible beam may take 450 iterations for 100. A weight counts twice: the largest is 1e8, half of what
 * double precision holds beside 1. */
static const double low = 0.1, most_weight = 1e4;

/* The steps' interval is from the largest eigenvalue, with some safety, down to this share of it. With a tenth of T^-1
 * the eigenvalues of soft inclusions (E2 x 1e6, axes that vary) are in 0.10 to 1.0, and without in 0.003 to 0.76; of a
 * checkerboard (E1 x 1e6) 0.04 to 2.7, and 0.002 to 1. */
static const double share = 0.1, interval = 100.0, safety = 1.2;
enum { STEPS = 14, POWER_STEPS = 40 };

struct OstLocalSchur {
    OstCgSystem system;
    const OstCoupling *coupling;
    double largest;                       /* eigenvalue of T over its diagonal */
    double *diagonal;                     /* of T: rows */
    double *force;                        /* 3 × columns of A */
    double *p;                            /* with ghosts */
    double *left, *step, *product, *mass; /* rows */
};

void ost_local_schur_destroy(OstLocalSchur **local)
{
    if (!*local)
        return;
    OST_FREE((*local)->diagonal);
    OST_FREE(*local);
}

static OstStatus create(const OstCgSystem *system, const OstCoupling *coupling, OstLocalSchur **local)
{
    const size_t rows = (size_t)coupling->rows, wide = 3 * (size_t)system->matrix->columns;
    double *memory;
    OST_TRY(OST_NEW(coupling->ctx, local, 1));
    **local = (OstLocalSchur){.system = *system, .coupling = coupling};
    OST_TRY(OST_NEW(coupling->ctx, &memory, 5 * rows + wide + (size_t)coupling->columns));
    double **of_rows[] = {&(*local)->diagonal, &(*local)->left, &(*local)->step, &(*local)->product, &(*local)->mass};
    for (int i = 0; i < 5; i++)
        *of_rows[i] = memory + (size_t)i * rows;
    (*local)->force = memory + 5 * rows;
    (*local)->p = (*local)->force + wide;
    return OST_SUCCESS;
}

/* T's diagonal at a pressure. */
static double diagonal_at(const OstCgSystem *system, const OstCoupling *coupling, OstLocal i)
{
    double sum = 0.0;
    for (OstLocal k = coupling->mass_start[i]; k < coupling->mass_start[i + 1]; k++)
        sum += coupling->mass_column[k] == i ? coupling->looseness[i] * coupling->mass[k] : 0.0;
    for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++) {
        const double *s = system->scaling->factor + 6 * (size_t)coupling->column[k];
        const double *b = coupling->value + 3 * (size_t)k;
        const double scaled[3] = {s[0] * b[0], s[1] * b[0] + s[2] * b[1], s[3] * b[0] + s[4] * b[1] + s[5] * b[2]};
        sum += scaled[0] * scaled[0] + scaled[1] * scaled[1] + scaled[2] * scaled[2];
    }
    return sum;
}

OstStatus ost_pressure_weights(const OstCgSystem *system, const OstCoupling *coupling, double **weights)
{
    *weights = NULL;
    if (!system->scaling)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(coupling->ctx, weights, coupling->rows));
    for (OstLocal i = 0; i < coupling->rows; i++) {
        const double sum = diagonal_at(system, coupling, i), least = low * coupling->schur[i] * coupling->diagonal[i];
        (*weights)[i] = sum > 0.0 && sum < least ? fmin(sqrt(least / sum), most_weight) : 1.0;
    }
    return OST_SUCCESS;
}

/* Fills the diagonal; returns how many pressures T and S are apart at. */
static OstLocal find_diagonal(OstLocalSchur *local)
{
    const OstCoupling *coupling = local->coupling;
    OstLocal found = 0;
    for (OstLocal i = 0; i < coupling->rows; i++) {
        const double sum = diagonal_at(&local->system, coupling, i);
        const double of_mass = coupling->schur[i] * coupling->diagonal[i];
        found += sum > 0.0 && sum < apart * of_mass;
        local->diagonal[i] = sum > 0.0 ? sum : of_mass;
    }
    return found;
}

/* y = T p; p has room for ghosts. */
static OstStatus multiply(OstLocalSchur *local, double *p, double *y)
{
    const OstCoupling *coupling = local->coupling;
    OST_TRY(ost_coupling_transpose(coupling, p, local->force));
    ost_scaling_to_scaled(local->system.scaling, local->force, local->force);
    ost_scaling_from_scaled(local->system.scaling, local->force, local->force);
    OST_TRY(ost_halo_import(local->system.matrix->halo, 3 * sizeof *local->force, local->force));
    ost_coupling_multiply(coupling, local->force, y);
    OST_TRY(ost_coupling_give_way(coupling, p, local->mass));
    for (OstLocal i = 0; i < coupling->rows; i++)
        y[i] += local->mass[i];
    return OST_SUCCESS;
}

/* By the power method, from numbers that do not depend on the ranks. Twenty steps may fall 16 % short, which makes T^-1
 * indefinite. */
static OstStatus find_largest(OstLocalSchur *local)
{
    const OstCoupling *coupling = local->coupling;
    const size_t n = (size_t)coupling->rows;
    OstGlobal first, all;
    OST_TRY(ost_number_from(coupling->ctx, coupling->rows, &first, &all));
    for (size_t i = 0; i < n; i++)
        local->p[i] = (double)(ost_scatter((uint64_t)first + i) >> 11) * 0x1p-53 - 0.5;
    for (int k = 0; k < POWER_STEPS; k++) {
        double square;
        OST_TRY(ost_vector_dot(coupling->ctx, n, local->p, local->p, &square));
        for (size_t i = 0; i < n; i++)
            local->p[i] /= sqrt(square);
        OST_TRY(multiply(local, local->p, local->product));
        for (size_t i = 0; i < n; i++)
            local->p[i] = local->product[i] / local->diagonal[i];
        OST_TRY(ost_vector_dot(coupling->ctx, n, local->p, local->p, &square));
        local->largest = sqrt(square);
    }
    return OST_SUCCESS;
}

OstStatus ost_local_schur_create(const OstCgSystem *system, const OstCoupling *coupling, OstLocalSchur **local)
{
    OstGlobal found = 0;
    OstStatus status;
    *local = NULL;
    if (!system->scaling)
        return OST_SUCCESS;
    OST_TRY_DONE(ost_agree(coupling->ctx, create(system, coupling, local)));
    found = find_diagonal(*local);
    OST_TRY_DONE(ost_sum_numbers(coupling->ctx, 1, &found));
    if (one_of * (double)found < (double)coupling->global_rows || found == 0) {
        ost_local_schur_destroy(local);
        return OST_SUCCESS;
    }
    OST_TRY_DONE(find_largest(*local));
    ost_log(coupling->ctx, OST_LOG_VERBOSE, "solver: %lld of %lld pressures are held by far less than their mass says",
            (long long)found, (long long)coupling->global_rows);
done:
    if (status != OST_SUCCESS)
        ost_local_schur_destroy(local);
    return status;
}

/* Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1. */
OstStatus ost_local_schur_add(OstLocalSchur *local, const double *r, double *z)
{
    const size_t n = (size_t)local->coupling->rows;
    const double most = safety * local->largest, least = most / interval;
    const double middle = 0.5 * (most + least), half = 0.5 * (most - least);
    double rho = half / middle;
    for (size_t i = 0; i < n; i++) {
        local->left[i] = r[i];
        local->step[i] = local->p[i] = r[i] / (middle * local->diagonal[i]);
    }
    for (int k = 1; k < STEPS; k++) {
        OST_TRY(multiply(local, local->p, local->product));
        const double next = 1.0 / (2.0 * middle / half - rho);
        for (size_t i = 0; i < n; i++) {
            const double left = (local->left[i] - local->product[i]) / local->diagonal[i];
            local->step[i] = next * rho * local->step[i] + 2.0 * next / half * left;
            local->p[i] += local->step[i];
        }
        rho = next;
    }
    for (size_t i = 0; i < n; i++)
        z[i] += share * local->p[i];
    return OST_SUCCESS;
}
