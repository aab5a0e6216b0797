/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/coupling.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

/* The mass matrix of linear tets, scaled by its diagonal, has its eigenvalues in here (A. J. Wathen, Realistic
 * eigenvalue bounds for the Galerkin mass matrix, IMA J. Numer. Anal. 7, 1987). Four steps leave 4 % of an error. */
static const double least = 0.5, most = 2.5;
enum { STEPS = 4 };

void ost_coupling_destroy(OstCoupling **coupling)
{
    if (!*coupling)
        return;
    OST_FREE((*coupling)->row_start);
    OST_FREE((*coupling)->column);
    OST_FREE((*coupling)->value);
    OST_FREE((*coupling)->mass_start);
    OST_FREE((*coupling)->mass_column);
    if ((*coupling)->estimate != (*coupling)->mass)
        OST_FREE((*coupling)->estimate);
    OST_FREE((*coupling)->mass);
    OST_FREE((*coupling)->diagonal);
    OST_FREE((*coupling)->looseness);
    OST_FREE((*coupling)->schur);
    ost_halo_destroy(&(*coupling)->own_halo);
    OST_FREE(*coupling);
}

void ost_coupling_multiply(const OstCoupling *coupling, const double *restrict u, double *restrict y)
{
    for (OstLocal i = 0; i < coupling->rows; i++) {
        double sum = 0.0;
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++) {
            const double *b = coupling->value + 3 * (size_t)k, *x = u + 3 * (size_t)coupling->column[k];
            sum += b[0] * x[0] + b[1] * x[1] + b[2] * x[2];
        }
        y[i] = sum;
    }
    ost_ledger_multiplied(coupling->ctx, 3.0 * coupling->row_start[coupling->rows]);
}

OstStatus ost_coupling_transpose(const OstCoupling *coupling, double *p, double *restrict force)
{
    OST_TRY(ost_halo_import(coupling->halo, sizeof *p, p));
    memset(force, 0, 3 * (size_t)coupling->unknowns * sizeof *force);
    for (OstLocal i = 0; i < coupling->columns; i++)
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++) {
            const double *b = coupling->value + 3 * (size_t)k;
            double *y = force + 3 * (size_t)coupling->column[k];
            if (coupling->column[k] >= coupling->unknowns)
                break;
            y[0] += b[0] * p[i];
            y[1] += b[1] * p[i];
            y[2] += b[2] * p[i];
        }
    ost_ledger_multiplied(coupling->ctx, 3.0 * coupling->row_start[coupling->rows]);
    return OST_SUCCESS;
}

/* y = M p of a matrix with these values. */
static OstStatus multiply(const OstCoupling *coupling, const double *values, double *p, double *restrict y)
{
    OST_TRY(ost_halo_import(coupling->halo, sizeof *p, p));
    for (OstLocal i = 0; i < coupling->rows; i++) {
        double sum = 0.0;
        for (OstLocal k = coupling->mass_start[i]; k < coupling->mass_start[i + 1]; k++)
            sum += values[k] * p[coupling->mass_column[k]];
        y[i] = sum;
    }
    ost_ledger_multiplied(coupling->ctx, coupling->mass_start[coupling->rows]);
    return OST_SUCCESS;
}

OstStatus ost_coupling_mass(const OstCoupling *coupling, double *p, double *y)
{
    return multiply(coupling, coupling->mass, p, y);
}

OstStatus ost_coupling_give_way(const OstCoupling *coupling, double *p, double *y)
{
    OST_TRY(ost_coupling_mass(coupling, p, y));
    for (OstLocal i = 0; i < coupling->rows; i++)
        y[i] *= coupling->looseness[i];
    return OST_SUCCESS;
}

/* Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1, for D^-1 E. */
OstStatus ost_coupling_schur_solve(const OstCoupling *coupling, const double *weights, const double *r, double *z,
                                   double *work)
{
    const size_t n = (size_t)coupling->rows;
    const double middle = 0.5 * (most + least), half = 0.5 * (most - least);
    double *left = work, *step = left + n, *product = step + n;
    double rho = half / middle;
    for (size_t i = 0; i < n; i++) {
        left[i] = weights ? weights[i] * r[i] : r[i];
        z[i] = step[i] = left[i] / (middle * coupling->diagonal[i]);
    }
    for (int k = 1; k < STEPS; k++) {
        OST_TRY(multiply(coupling, coupling->estimate, z, product));
        const double next = 1.0 / (2.0 * middle / half - rho);
        for (size_t i = 0; i < n; i++) {
            step[i] = next * rho * step[i] + 2.0 * next / half * (left[i] - product[i]) / coupling->diagonal[i];
            z[i] += step[i];
        }
        rho = next;
    }
    for (size_t i = 0; i < n; i++)
        z[i] *= (weights ? weights[i] : 1.0) / coupling->schur[i];
    return OST_SUCCESS;
}
