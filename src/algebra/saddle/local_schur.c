/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/local_schur.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/scatter.h"
#include "core/small.h"

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

/* Where that is so next to fixed nodes alone, T is restricted to the pressures with a diagonal below the first share,
 * if these are no more than the second of all: they are no smooth ones, so more of T^-1 may be taken, and down to
 * smaller eigenvalues. Next to a fixed half S then has its eigenvalues in 0.2 to 1.2 of what it is taken for, on any
 * mesh; of the whole of T smooth pressures make that grow. Where moduli are the reason, S is below the mass matrix at
 * others too: a checkerboard (E2 x 1e6, along circles) takes four times the iterations by the part. */
static const double poorly_held = 0.2, most_poor = 1.0 / 3.0, share_of_part = 0.3, interval_of_part = 300.0;

struct OstLocalSchur {
    OstCgSystem system;
    const OstCoupling *coupling;
    double largest;                       /* eigenvalue of T over its diagonal */
    double *diagonal;                     /* of T: rows */
    double *force;                        /* 3 × columns of A */
    double *p;                            /* with ghosts */
    double *left, *step, *product, *mass; /* rows */
    OstLocal *part, owned, count;         /* the pressures that T is restricted to, this rank's first; */
    OstLocal *node, nodes;                /* and the nodes they act on */
    double share, interval;
};

void ost_local_schur_destroy(OstLocalSchur **local)
{
    if (!*local)
        return;
    OST_FREE((*local)->part);
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

/* Pressures at which T's diagonal is below a share of that of S: `apart` where no node around is fixed, `beside` where
 * one is. */
typedef struct Below {
    OstGlobal apart, beside, poor;
} Below;

/* If no node around a pressure is fixed, a common displacement does not change its volume. */
static int is_beside_fixed(const OstCoupling *coupling, OstLocal i)
{
    static const double rounding = 1e-8;
    double sum[3] = {0.0}, size = 0.0;
    for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++)
        for (int c = 0; c < 3; c++) {
            sum[c] += coupling->value[3 * (size_t)k + (size_t)c];
            size += fabs(coupling->value[3 * (size_t)k + (size_t)c]);
        }
    return ost_norm3(sum) > rounding * size;
}

/* Fills the diagonal, and counts. `poor`: a 1 for each owned pressure that is poorly held. */
static Below find_diagonal(OstLocalSchur *local, unsigned char *poor)
{
    const OstCoupling *coupling = local->coupling;
    Below below = {0};
    for (OstLocal i = 0; i < coupling->rows; i++) {
        const double sum = diagonal_at(&local->system, coupling, i);
        const double of_mass = coupling->schur[i] * coupling->diagonal[i];
        if (sum > 0.0 && sum < apart * of_mass)
            *(is_beside_fixed(coupling, i) ? &below.beside : &below.apart) += 1;
        poor[i] = sum > 0.0 && sum < poorly_held * of_mass;
        below.poor += poor[i];
        local->diagonal[i] = sum > 0.0 ? sum : of_mass;
    }
    return below;
}

/* Restricts T to the pressures marked, ghosts too, or to none if `only` is NULL. */
static OstStatus restrict_to(OstLocalSchur *local, const unsigned char *only)
{
    const OstCoupling *coupling = local->coupling;
    const OstLocal unknowns = coupling->unknowns;
    unsigned char *touched = NULL;
    OstStatus status = OST_NEW(coupling->ctx, &local->part, (size_t)coupling->columns + (size_t)unknowns);
    OST_THEN(OST_NEW(coupling->ctx, &touched, unknowns));
    OST_TRY_DONE(ost_agree(coupling->ctx, status));
    for (OstLocal i = 0; i < coupling->columns; i++) {
        if (only && !only[i])
            continue;
        local->part[local->count++] = i;
        local->owned += i < coupling->rows;
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1] && coupling->column[k] < unknowns; k++)
            touched[coupling->column[k]] = 1;
    }
    local->node = local->part + local->count;
    for (OstLocal node = 0; node < unknowns; node++)
        if (touched[node])
            local->node[local->nodes++] = node;
done:
    OST_FREE(touched);
    return status;
}

/* D^-1 of the force at a node. */
static void divide(const double *s, double *force)
{
    const double a = s[0] * force[0], b = s[1] * force[0] + s[2] * force[1];
    const double c = s[3] * force[0] + s[4] * force[1] + s[5] * force[2];
    force[0] = s[0] * a + s[1] * b + s[3] * c;
    force[1] = s[2] * b + s[4] * c;
    force[2] = s[5] * c;
}

/* D^-1 B' p at the nodes that the part acts on, ghosts too; p has room for ghosts, and is 0 outside the part. */
static OstStatus find_displacement(OstLocalSchur *local, double *p)
{
    const OstCoupling *coupling = local->coupling;
    OST_TRY(ost_halo_import(coupling->halo, sizeof *p, p));
    for (OstLocal k = 0; k < local->nodes; k++)
        memset(local->force + 3 * (size_t)local->node[k], 0, 3 * sizeof *local->force);
    for (OstLocal n = 0; n < local->count; n++) {
        const OstLocal i = local->part[n];
        for (OstLocal k = coupling->row_start[i];
             k < coupling->row_start[i + 1] && coupling->column[k] < coupling->unknowns; k++) {
            const double *b = coupling->value + 3 * (size_t)k;
            double *y = local->force + 3 * (size_t)coupling->column[k];
            for (int c = 0; c < 3; c++)
                y[c] += b[c] * p[i];
        }
    }
    for (OstLocal k = 0; k < local->nodes; k++)
        divide(local->system.scaling->factor + 6 * (size_t)local->node[k], local->force + 3 * (size_t)local->node[k]);
    return ost_halo_import(local->system.matrix->halo, 3 * sizeof *local->force, local->force);
}

/* y = T p at the part's pressures; p as above. */
static OstStatus multiply(OstLocalSchur *local, double *p, double *y)
{
    const OstCoupling *coupling = local->coupling;
    OST_TRY(find_displacement(local, p));
    for (OstLocal n = 0; n < local->owned; n++) {
        const OstLocal i = local->part[n];
        double sum = 0.0;
        for (OstLocal k = coupling->mass_start[i]; k < coupling->mass_start[i + 1]; k++)
            sum += coupling->looseness[i] * coupling->mass[k] * p[coupling->mass_column[k]];
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++)
            sum += ost_dot3(coupling->value + 3 * (size_t)k, local->force + 3 * (size_t)coupling->column[k]);
        y[i] = sum;
    }
    ost_ledger_multiplied(coupling->ctx, 6.0 * local->owned * coupling->row_start[coupling->rows] / coupling->rows);
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
    for (OstLocal k = 0; k < local->owned; k++) {
        const OstLocal i = local->part[k];
        local->p[i] = (double)(ost_scatter((uint64_t)(first + i)) >> 11) * 0x1p-53 - 0.5;
    }
    for (int k = 0; k < POWER_STEPS; k++) {
        double square;
        OST_TRY(ost_vector_dot(coupling->ctx, n, local->p, local->p, &square));
        for (OstLocal i = 0; i < local->owned; i++)
            local->p[local->part[i]] /= sqrt(square);
        OST_TRY(multiply(local, local->p, local->product));
        for (OstLocal i = 0; i < local->owned; i++)
            local->p[local->part[i]] = local->product[local->part[i]] / local->diagonal[local->part[i]];
        OST_TRY(ost_vector_dot(coupling->ctx, n, local->p, local->p, &square));
        local->largest = sqrt(square);
    }
    return OST_SUCCESS;
}

OstStatus ost_local_schur_create(const OstCgSystem *system, const OstCoupling *coupling, OstLocalSchur **local)
{
    OstContext *ctx = coupling->ctx;
    unsigned char *poor = NULL;
    OstStatus status;
    *local = NULL;
    if (!system->scaling)
        return OST_SUCCESS;
    status = create(system, coupling, local);
    OST_THEN(OST_NEW(ctx, &poor, coupling->columns));
    OST_TRY_DONE(ost_agree(ctx, status));
    Below below = find_diagonal(*local, poor);
    OST_TRY_DONE(ost_sum_numbers(ctx, 3, &below.apart));
    const double all = (double)coupling->global_rows, found = (double)(below.apart + below.beside);
    const int few = one_of * (double)below.apart < all && (double)below.poor <= most_poor * all;
    if (found == 0.0 || (!few && one_of * found < all)) {
        ost_local_schur_destroy(local);
        goto done;
    }
    (*local)->share = few ? share_of_part : share;
    (*local)->interval = few ? interval_of_part : interval;
    OST_TRY_DONE(ost_halo_import(coupling->halo, 1, poor));
    OST_TRY_DONE(restrict_to(*local, few ? poor : NULL));
    OST_TRY_DONE(find_largest(*local));
    ost_log(ctx, OST_LOG_VERBOSE, "solver: %.0f of %.0f pressures change the volume far less than their mass says%s",
            found, all, few ? ", next to fixed nodes" : "");
done:
    OST_FREE(poor);
    if (status != OST_SUCCESS)
        ost_local_schur_destroy(local);
    return status;
}

/* Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1. */
OstStatus ost_local_schur_add(OstLocalSchur *local, const double *r, double *z)
{
    const double most = safety * local->largest, least = most / local->interval;
    const double middle = 0.5 * (most + least), half = 0.5 * (most - least);
    double rho = half / middle;
    for (OstLocal n = 0; n < local->owned; n++) {
        const OstLocal i = local->part[n];
        local->left[i] = r[i];
        local->step[i] = local->p[i] = r[i] / (middle * local->diagonal[i]);
    }
    for (int k = 1; k < STEPS; k++) {
        OST_TRY(multiply(local, local->p, local->product));
        const double next = 1.0 / (2.0 * middle / half - rho);
        for (OstLocal n = 0; n < local->owned; n++) {
            const OstLocal i = local->part[n];
            const double left = (local->left[i] - local->product[i]) / local->diagonal[i];
            local->step[i] = next * rho * local->step[i] + 2.0 * next / half * left;
            local->p[i] += local->step[i];
        }
        rho = next;
    }
    for (OstLocal n = 0; n < local->owned; n++)
        z[local->part[n]] += local->share * local->p[local->part[n]];
    return OST_SUCCESS;
}
