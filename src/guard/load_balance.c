/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/load_balance.h"

#include "core/error.h"
#include "core/small.h"
#include "effect/effect.h"

/* Loads may be out of balance by this share of their sizes: they are typed, and summed, with rounding. */
static const double balance = 1e-8;

/* Sets components to 0 that are rounding errors of sums of this size. */
static void drop_rounding(double size, double vector[3])
{
    for (int i = 0; i < 3; i++)
        if (fabs(vector[i]) <= 1e-14 * size)
            vector[i] = 0.0;
}

/* Sums of the loads: force, its size, moment about a centre, its size. */
enum { SUM_FORCE, SUM_FORCE_SIZE = 3, SUM_MOMENT, SUM_MOMENT_SIZE = 7, SUM_COUNT };

static void add_load(const double *x, const double *f, const double centre[3], double sums[SUM_COUNT])
{
    double arm[3], moment[3];
    for (int i = 0; i < 3; i++)
        arm[i] = x[i] - centre[i];
    ost_cross3(arm, f, moment);
    for (int i = 0; i < 3; i++) {
        sums[SUM_FORCE + i] += f[i];
        sums[SUM_MOMENT + i] += moment[i];
    }
    sums[SUM_FORCE_SIZE] += ost_norm3(f);
    sums[SUM_MOMENT_SIZE] += ost_norm3(arm) * ost_norm3(f);
}

static OstStatus check(const OstMesh *mesh, const double *force, const char *where)
{
    OstContext *ctx = mesh->ctx;
    double low[3], high[3], centre[3], sums[SUM_COUNT] = {0.0};
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * (low[i] + high[i]);
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        add_load(mesh->coordinates + 3 * (size_t)n, force + 3 * (size_t)n, centre, sums);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sums, SUM_COUNT, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    double *f = sums + SUM_FORCE;
    double *m = sums + SUM_MOMENT;
    if (ost_norm3(f) <= balance * sums[SUM_FORCE_SIZE] && ost_norm3(m) <= balance * sums[SUM_MOMENT_SIZE])
        return OST_SUCCESS;
    drop_rounding(sums[SUM_FORCE_SIZE], f);
    drop_rounding(sums[SUM_MOMENT_SIZE], m);
    return OST_RAISE(
        ctx, OST_INVALID_INPUT,
        "%s: free_body needs loads that balance each other, but these leave a force (%g, %g, %g) of loads of "
        "size %g, and a moment (%g, %g, %g) of size %g about (%g, %g, %g); balance them, or constrain the body",
        where, f[0], f[1], f[2], sums[SUM_FORCE_SIZE], m[0], m[1], m[2], sums[SUM_MOMENT_SIZE], centre[0], centre[1],
        centre[2]);
}

OstStatus ost_load_balance_check(const OstMesh *mesh, const double *force, const char *where)
{
    ost_ledger_enter(mesh->ctx, OST_EFFECT_FREE_BODY);
    const OstStatus status = check(mesh, force, where);
    ost_ledger_leave(mesh->ctx);
    return status;
}
