/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/checks.h"

#include "algebra/energy_error.h"
#include "algebra/rounded_stiffness.h"
#include "assembly/batch.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/halo.h"
#include "core/memory.h"
#include "core/small.h"
#include "solve/linearity.h"

#include <float.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Sums over the body that the checks compare; the order is that of the reduction. */
enum {
    SUM_RESIDUAL, /* squares of P (f - K u) */
    SUM_ROUNDING, /* squares of what rounding may leave of it */
    SUM_LOAD,     /* 3 */
    SUM_REACTION = SUM_LOAD + 3,
    SUM_LOAD_SIZE = SUM_REACTION + 3, /* of |f| + |r| */
    SUM_MOMENT,                       /* 3 */
    SUM_MOMENT_SIZE = SUM_MOMENT + 3,
    SUM_ENERGY,      /* of the tets, by their strain */
    SUM_SQUARE,      /* of u */
    SUM_DOUBLE_WORK, /* (f + r)·u */
    SUM_WORK_SIZE,   /* of |(f + r)·u| */
    SUM_NOT_FINITE,
    SUM_COUNT
};

/* Roundings that a term of a nodal force goes through: of the displacement, the element's numbers, the sum over tets.
 * They rarely all pull one way. */
static const double rounding_steps = 4.0;

/* A balance may miss by this much beyond what the residual explains. */
static const double balance_tolerance = 1e-10;

static void project_on_held(const OstSupports *supports, OstLocal node, const double vector[3], double held[3])
{
    double projector[9], given[3], free_part[3];
    if (ost_supports_get(supports, node, projector, given) == 0) {
        memset(held, 0, 3 * sizeof *held);
        return;
    }
    ost_apply3(projector, vector, free_part);
    for (int i = 0; i < 3; i++)
        held[i] = vector[i] - free_part[i];
}

static void add_node(OstResult *result, const OstSupports *supports, OstLocal node, const double *internal,
                     const double *magnitude, const double centre[3], double *sums)
{
    const double *f = result->force + 3 * (size_t)node;
    const double *u = result->displacement + 3 * (size_t)node;
    double *r = result->reaction + 3 * (size_t)node;
    double out_of_balance[3], external[3], arm[3], moment[3];
    for (int i = 0; i < 3; i++)
        out_of_balance[i] = internal[i] - f[i];
    project_on_held(supports, node, out_of_balance, r);
    for (int i = 0; i < 3; i++) {
        const double residual = out_of_balance[i] - r[i];
        external[i] = f[i] + r[i];
        arm[i] = result->mesh->coordinates[3 * (size_t)node + (size_t)i] - centre[i];
        sums[SUM_RESIDUAL] += residual * residual;
        sums[SUM_ROUNDING] += magnitude[i] * magnitude[i];
        sums[SUM_LOAD + i] += f[i];
        sums[SUM_REACTION + i] += r[i];
        sums[SUM_SQUARE] += u[i] * u[i];
        sums[SUM_DOUBLE_WORK] += external[i] * u[i];
        sums[SUM_WORK_SIZE] += fabs(external[i] * u[i]);
        sums[SUM_NOT_FINITE] += !isfinite(u[i]) || !isfinite(internal[i]);
    }
    ost_cross3(arm, external, moment);
    for (int i = 0; i < 3; i++)
        sums[SUM_MOMENT + i] += moment[i];
    sums[SUM_LOAD_SIZE] += ost_norm3(f) + ost_norm3(r);
    sums[SUM_MOMENT_SIZE] += ost_norm3(arm) * (ost_norm3(f) + ost_norm3(r));
}

/* By the density of energy, so that it owes nothing to the forces that the work is told by. On the way, how small the
 * strains and rotations are. */
static double energy_of_tets(const OstResult *result, OstLinearity *largest)
{
    const OstMesh *mesh = result->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    double energy = 0.0;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_LANES) {
        OstLanes u[3 * OST_MAX_TET_NODES];
        OstMeans means;
        ost_batch_gather_from(&batch, element, mesh, result->field, first, mesh->owned_tets);
        ost_batch_gather_vectors(&batch, element->nodes, result->displacement, u);
        element->means(batch.x, &batch.elasticity, u, &means);
        ost_linearity_add(&batch, element, u, &means, largest);
        for (int lane = 0; lane < batch.count; lane++)
            energy += means.energy[lane] * means.volume[lane];
    }
    return energy;
}

static void draw_conclusions(OstChecks *checks, const double *sums, double rhs_norm)
{
    double force[3];
    for (int i = 0; i < 3; i++) {
        checks->load[i] = sums[SUM_LOAD + i];
        checks->reaction[i] = sums[SUM_REACTION + i];
        force[i] = checks->load[i] + checks->reaction[i];
    }
    const double tiny = DBL_MIN;
    const double scale = fmax(rhs_norm, tiny);
    checks->relative_residual = sqrt(sums[SUM_RESIDUAL]) / scale;
    checks->rounding = rounding_steps * DBL_EPSILON * sqrt(sums[SUM_ROUNDING]) / scale;
    checks->force_imbalance = ost_norm3(force) / fmax(sums[SUM_LOAD_SIZE], tiny);
    checks->moment_imbalance = ost_norm3(sums + SUM_MOMENT) / fmax(sums[SUM_MOMENT_SIZE], tiny);
    checks->strain_energy = sums[SUM_ENERGY];
    checks->work = 0.5 * sums[SUM_DOUBLE_WORK];
    checks->energy_imbalance = fabs(checks->strain_energy - checks->work) / fmax(0.5 * sums[SUM_WORK_SIZE], tiny);
    checks->finite = sums[SUM_NOT_FINITE] == 0.0;
}

static void estimate_digits(OstChecks *checks, const OstSolveReport *report)
{
    const int known = report->error_estimate > 0.0;
    checks->displacement_error = known ? report->error_estimate : NAN;
    checks->digits = known ? fmax(-log10(fmax(checks->displacement_error, DBL_EPSILON)), 0.0) : NAN;
}

void ost_object(OstResult *result, const char *format, ...)
{
    OstObjections *objections = &result->objections;
    va_list arguments;
    if (objections->count == OST_MOST_OBJECTIONS)
        return;
    va_start(arguments, format);
    vsnprintf(objections->text[objections->count++], OST_LONGEST_OBJECTION, format, arguments);
    va_end(arguments);
}

/* What of the imbalances is no news, because the residual says it: internal forces sum to zero exactly, so the balances
 * miss the sum of the residual, at most sqrt(n) its norm; the energy misses its work on the displacement. */
typedef struct Explained {
    double balance, energy;
} Explained;

static Explained explain(const OstResult *result, const double *sums, double rhs_norm)
{
    const double residual = sqrt(sums[SUM_RESIDUAL]) + result->checks.rounding * rhs_norm;
    return (Explained){balance_tolerance +
                           sqrt((double)result->unknowns) * residual / fmax(sums[SUM_LOAD_SIZE], DBL_MIN),
                       balance_tolerance + sqrt(sums[SUM_SQUARE]) * residual / fmax(sums[SUM_WORK_SIZE], DBL_MIN)};
}

/* Where rounding kept the solver from the residual asked for, what is left of that is rounding too. */
static double lost_to_rounding(const OstSolveReport *report)
{
    return report->rounding_limited ? report->error_estimate : report->rounding_error;
}

/* Only what was thrown at random has a spread; the residual's part, added in squares, has none. */
static int loses_the_last_digit(const OstSolveReport *report)
{
    const double lost = lost_to_rounding(report);
    const double thrown = lost > 0.0 ? report->rounding_error / lost : 0.0;
    return ost_surely_beyond(lost, thrown * thrown * report->rounding_spread, ost_least_digit);
}

static void object_to_rounding(OstResult *result)
{
    const double lost = lost_to_rounding(&result->solve);
    char left[48] = "none at all";
    if (isfinite(lost))
        snprintf(left, sizeof left, "an error of about %.1g", lost);
    ost_object(
        result,
        "rounding in double precision leaves the displacement less than one digit (%s); bring the stiffnesses of "
        "the parts nearer to each other, or hold the body better",
        left);
}

/* Comparisons are such that what is no number fails. */
static void judge(OstResult *result, double requested, Explained explained)
{
    const OstChecks *checks = &result->checks;
    if (!checks->finite) {
        ost_object(result, "the displacement is not finite everywhere");
        return;
    }
    if (!(checks->relative_residual <= 2.0 * requested + checks->rounding))
        ost_object(result,
                   "the true residual, summed tet by tet, is %.2e where %.2e was asked for (rounding explains %.1e)",
                   checks->relative_residual, requested, checks->rounding);
    if (!(checks->force_imbalance <= explained.balance && checks->moment_imbalance <= explained.balance))
        ost_object(result,
                   "loads and reactions do not balance: force %.2e, moment %.2e of their size, where %.1e can be "
                   "explained",
                   checks->force_imbalance, checks->moment_imbalance, explained.balance);
    if (!(checks->energy_imbalance <= explained.energy && checks->strain_energy >= 0.0))
        ost_object(result, "the strain energy %.10e is not the work %.10e of loads and reactions",
                   checks->strain_energy, checks->work);
    if (loses_the_last_digit(&result->solve))
        object_to_rounding(result);
}

OstStatus ost_result_check(OstResult *result, const OstSupports *supports, double requested_residual, double rhs_norm)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    double *internal = NULL, *magnitude = NULL;
    double sums[SUM_COUNT] = {0.0};
    double low[3], high[3], centre[3];
    OstLinearity largest = {0.0, 0.0};
    ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
    OstStatus status = OST_NEW(ctx, &internal, 3 * (size_t)mesh->owned_nodes);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &magnitude, 3 * (size_t)mesh->owned_nodes);
    if (status == OST_SUCCESS)
        status = ost_internal_force(mesh, result->field, result->displacement, internal, magnitude);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * (low[i] + high[i]);
    sums[SUM_ENERGY] = energy_of_tets(result, &largest);
    OST_TRY_DONE(ost_linearity_agree(ctx, &largest));
    result->checks.largest_strain = largest.strain;
    result->checks.largest_rotation = largest.rotation;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        add_node(result, supports, n, internal + 3 * (size_t)n, magnitude + 3 * (size_t)n, centre, sums);
    OST_TRY_DONE(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sums, SUM_COUNT, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    OST_TRY_DONE(ost_halo_import(mesh->halo, 3 * sizeof(double), result->reaction));
    draw_conclusions(&result->checks, sums, rhs_norm);
    estimate_digits(&result->checks, &result->solve);
    judge(result, requested_residual, explain(result, sums, rhs_norm));
done:
    OST_FREE(internal);
    OST_FREE(magnitude);
    ost_ledger_leave(ctx);
    return status;
}
