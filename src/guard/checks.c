/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/energy_error.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "assembly/means.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/guard.h"
#include "guard/linearity.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* Digits. The solver estimates the error from the preconditioner applied to the true residual and to what rounding
 * leaves of the stiffness: with multigrid in the norm of the energy or of the displacement, whichever is more, by the
 * smallest Ritz value of the solve; with factors the displacement's own (energy_error.h), or what their steps would
 * still move it, if that is more (refine.h). It is an estimate, not a bound: the Ritz value comes from above. PLAIN
 * keeps its coefficients to itself, and states no digits. What the work misses of the energy is an error too. -log10 of
 * the most is the digits. Fewer digits than the requested residual leaves are the user's choice; less than one digit
 * left by rounding is objected to. The 2-norm of the residual times the condition, which needs no preconditioner, is of
 * no use where stiffness is uneven: it takes the residual at a stiff inclusion for one at what is soft, and denied
 * digits to answers that held five.
 *
 * Forces. A displacement may hold eleven digits beside a support that takes the whole body along, and its strains none:
 * neither residual nor error estimate sees that, both being over what the support does to the unknowns. The forces'
 * error is the most of what is measured, the imbalances of force, moment and energy, and of the displacement's error
 * over what strains the body: over the strain energy, or, of factors, the displacement less its mean. The imbalances
 * alone would not do: their size is that of rounded reactions as well, whose sum hides in the square root of their
 * number (a cube of 9261 vertices, moved by 1 where it deforms by 1e-10: balanced to 0.06, stresses 330 times too
 * large).
 *
 * The sums are not compensated, because the limit is u's own: a displacement rounded to double leaves a residual of
 * about DBL_EPSILON |K| |u| however exactly that is summed. Measured where it is worst, on an inclusion 1e9 times
 * stiffer than what is around it: 4.61e-6 summed in double, 4.61e-6 summed in 64 bits (the same displacement). Nothing
 * is gained before u has more bits. */

/* Sums over the body that the checks compare; the order is that of the reduction. */
enum {
    SUM_RESIDUAL, /* squares of P (f - K u) */
    SUM_ROUNDING, /* squares of what rounding may leave of it */
    SUM_LOAD,     /* 3 */
    SUM_REACTION = SUM_LOAD + 3,
    SUM_FORCE_SIZE = SUM_REACTION + 3, /* of |f + r|: what goes straight into a support strains nothing */
    SUM_FORCE_TERMS,                   /* of |f| + |r|, by which f + r is rounded */
    SUM_MOMENT,                        /* 3 */
    SUM_MOMENT_SIZE = SUM_MOMENT + 3,
    SUM_MOMENT_TERMS,
    SUM_ENERGY,      /* of the tets, by their strain */
    SUM_SQUARE,      /* of u */
    SUM_DEFORMATION, /* squares of u less the common displacement */
    SUM_DOUBLE_WORK, /* (f + r)·u */
    SUM_WORK_SIZE,   /* of |(f + r)·u|, by component */
    SUM_WORK_TERMS,  /* of |f·u| + |r·u| */
    SUM_FREE_LOAD,   /* squares of P f: what does not go straight into a support */
    SUM_NOT_FINITE,
    SUM_COUNT
};

/* Roundings that a term of a nodal force goes through: of the displacement, the element's numbers, the sum over tets.
 * They rarely all pull one way. */
static const double rounding_steps = 4.0;

/* A balance may miss by this much beyond what the residual explains. */
static const double balance_tolerance = 1e-10;

/* A common displacement is to speak of where it is this many times the rest. */
static const double common_by_far = 10.0;

/* What the sums over nodes ask of the body. */
typedef struct Body {
    const OstSupports *supports;
    double centre[3];
    int moved;        /* does a support give a displacement? */
    double common[3]; /* the mean one if so: elsewhere there is none to take out */
} Body;

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

static void add_sizes(const Body *body, OstLocal node, const double *f, const double *u, double *sums)
{
    double held[3];
    project_on_held(body->supports, node, f, held);
    for (int i = 0; i < 3; i++) {
        const double deformation = u[i] - body->common[i];
        sums[SUM_SQUARE] += u[i] * u[i];
        sums[SUM_DEFORMATION] += deformation * deformation;
        sums[SUM_FREE_LOAD] += (f[i] - held[i]) * (f[i] - held[i]);
    }
}

static void add_node(OstResult *result, const Body *body, OstLocal node, const double *internal,
                     const double *magnitude, double *sums)
{
    const double *f = result->force + 3 * (size_t)node;
    const double *u = result->displacement + 3 * (size_t)node;
    double *r = result->reaction + 3 * (size_t)node;
    double out_of_balance[3], external[3], arm[3], moment[3];
    for (int i = 0; i < 3; i++)
        out_of_balance[i] = internal[i] - f[i];
    project_on_held(body->supports, node, out_of_balance, r);
    for (int i = 0; i < 3; i++) {
        const double residual = out_of_balance[i] - r[i];
        external[i] = f[i] + r[i];
        arm[i] = result->mesh->coordinates[3 * (size_t)node + (size_t)i] - body->centre[i];
        sums[SUM_RESIDUAL] += residual * residual;
        sums[SUM_ROUNDING] += magnitude[i] * magnitude[i];
        sums[SUM_LOAD + i] += f[i];
        sums[SUM_REACTION + i] += r[i];
        sums[SUM_DOUBLE_WORK] += external[i] * u[i];
        sums[SUM_WORK_SIZE] += fabs(external[i] * u[i]);
        sums[SUM_WORK_TERMS] += (fabs(f[i]) + fabs(r[i])) * fabs(u[i]);
        sums[SUM_NOT_FINITE] += !isfinite(u[i]) || !isfinite(internal[i]);
    }
    add_sizes(body, node, f, u, sums);
    ost_cross3(arm, external, moment);
    for (int i = 0; i < 3; i++)
        sums[SUM_MOMENT + i] += moment[i];
    sums[SUM_FORCE_SIZE] += ost_norm3(external);
    sums[SUM_FORCE_TERMS] += ost_norm3(f) + ost_norm3(r);
    sums[SUM_MOMENT_SIZE] += ost_norm3(arm) * ost_norm3(external);
    sums[SUM_MOMENT_TERMS] += ost_norm3(arm) * (ost_norm3(f) + ost_norm3(r));
}

/* By the density of energy, so that it owes nothing to the forces that the work is told by. On the way, how small the
 * strains and rotations are. */
typedef struct OfTets {
    double energy;
    OstLinearity largest;
} OfTets;

static void add_tets(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                     const OstMeans *means)
{
    OfTets *tets = data;
    ost_linearity_add(batch, element, u, means, &tets->largest);
    for (int slot = 0; slot < batch->count; slot++)
        tets->energy += means->energy[slot] * means->volume[slot];
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
    checks->force_imbalance = ost_norm3(force) / fmax(sums[SUM_FORCE_SIZE], tiny);
    checks->moment_imbalance = ost_norm3(sums + SUM_MOMENT) / fmax(sums[SUM_MOMENT_SIZE], tiny);
    checks->strain_energy = sums[SUM_ENERGY];
    checks->work = 0.5 * sums[SUM_DOUBLE_WORK];
    if (checks->linear)
        checks->energy_imbalance = fabs(checks->strain_energy - checks->work) / fmax(0.5 * sums[SUM_WORK_SIZE], tiny);
    checks->finite = sums[SUM_NOT_FINITE] == 0.0;
}

static double digits_of(double error)
{
    return isnan(error) ? NAN : fmax(-log10(fmax(error, DBL_EPSILON)), 0.0);
}

/* How many times the deformation the displacement is. */
static double common_share(const double *sums)
{
    return sqrt(sums[SUM_SQUARE] / fmax(sums[SUM_DEFORMATION], DBL_MIN));
}

/* The estimate is over the displacement, or over the energy of the unknowns, to which a support that takes all along is
 * a wall that they run into; what strains the body may be far less. */
static double error_of_strain(const OstResult *result, const Body *body, const double *sums, double work)
{
    const double error = result->checks.displacement_error;
    if (!body->moved)
        return error;
    if (result->solve.method == OST_METHOD_DIRECT || !result->checks.linear) /* of the displacement itself */
        return error * common_share(sums);
    return result->solve.energy_error * fmax(sqrt(fmax(work, 0.0) / fmax(2.0 * sums[SUM_ENERGY], DBL_MIN)), 1.0);
}

/* The work that the strains do not have, (f·u - u·K u) / f·u, is how far the displacement under the load is off: in K
 * itself, too, where equal tets are rounded alike, which adds up, and which roundings thrown at random do not tell.
 * Where supports move, what they give is no such displacement. */
static double error_of_work(const OstChecks *checks, const Body *body)
{
    return body->moved ? 0.0 : checks->energy_imbalance;
}

static void estimate_digits(OstResult *result, const Body *body, const double *sums, double work)
{
    OstChecks *checks = &result->checks;
    const int known = result->solve.error_estimate > 0.0;
    checks->displacement_error = known ? fmax(result->solve.error_estimate, error_of_work(checks, body)) : NAN;
    checks->digits = digits_of(checks->displacement_error);
    const double missed = fmax(checks->force_imbalance, fmax(checks->moment_imbalance, checks->energy_imbalance));
    checks->force_error = known ? fmax(missed, error_of_strain(result, body, sums, work)) : NAN;
    checks->force_digits = digits_of(checks->force_error);
}

/* What of the imbalances is no news: the residual says it, as internal forces sum to zero exactly, so that the balances
 * miss the sum of the residual, at most sqrt(n) its norm, and the energy misses its work on the displacement; and so
 * does rounding, of a force that goes straight into a support and is all but cancelled there. */
typedef struct Explained {
    double force, moment, energy;
} Explained;

static double explained_part(double residual, double terms, double size)
{
    return balance_tolerance + (residual + rounding_steps * DBL_EPSILON * terms) / fmax(size, DBL_MIN);
}

static Explained explain(const OstResult *result, const double *sums, double rhs_norm)
{
    const double residual = sqrt(sums[SUM_RESIDUAL]) + result->checks.rounding * rhs_norm;
    const double of_balance = sqrt((double)result->unknowns) * residual;
    const double arm = sums[SUM_MOMENT_SIZE] / fmax(sums[SUM_FORCE_SIZE], DBL_MIN);
    return (Explained){explained_part(of_balance, sums[SUM_FORCE_TERMS], sums[SUM_FORCE_SIZE]),
                       explained_part(arm * of_balance, sums[SUM_MOMENT_TERMS], sums[SUM_MOMENT_SIZE]),
                       explained_part(sqrt(sums[SUM_SQUARE]) * residual, sums[SUM_WORK_TERMS], sums[SUM_WORK_SIZE])};
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

static void describe_error(double error, char left[48])
{
    snprintf(left, 48, "none at all");
    if (isfinite(error))
        snprintf(left, 48, "an error of about %.1g", error);
}

static void object_to_rounding(OstResult *result)
{
    char left[48];
    describe_error(lost_to_rounding(&result->solve), left);
    ost_object(
        &result->verdict, OST_CHECK_FAILED,
        "rounding in double precision leaves the displacement less than one digit (%s); bring the stiffnesses of "
        "the parts nearer to each other, or hold the body better",
        left);
}

/* By the error of what strains the body; where no solver states one, by a residual that is more than the load. */
static double forces_lost_in_common(const OstResult *result, const double *sums)
{
    if (isnan(result->checks.force_error))
        return sums[SUM_RESIDUAL] > sums[SUM_FREE_LOAD] ? INFINITY : 0.0;
    return result->checks.force_error;
}

/* Without a load nothing speaks against a rigid motion, whose forces are rounding alone. What the residual asked for
 * may leave at every unknown, all one way, is the user's choice. Where no common displacement hides it the
 * displacement's error is judged by itself, and energy may miss work beside a displacement and reactions that hold: a
 * part that is stiffer by 1e9 strains by less than rounding. That is stated, and no reason to refuse. */
static int loses_the_forces(const OstResult *result, const double *sums, double requested)
{
    const OstChecks *checks = &result->checks;
    const double chosen = result->solve.rounding_limited ? 0.0 : sqrt((double)result->unknowns) * requested;
    double error = fmax(checks->force_imbalance, checks->moment_imbalance);
    if (!(sqrt(sums[SUM_FREE_LOAD]) > rounding_steps * DBL_EPSILON * sums[SUM_FORCE_TERMS]))
        return 0;
    if (common_share(sums) > common_by_far)
        error = fmax(error, forces_lost_in_common(result, sums));
    return error > fmax(ost_least_digit, chosen);
}

static void object_to_forces(OstResult *result, const Body *body, const double *sums)
{
    const OstChecks *checks = &result->checks;
    const double *c = body->common;
    const double nodes = (double)result->mesh->global_nodes;
    const double to_speak_of = 1e-3 * ost_norm3(c);
    char left[48];
    char remedy[240] = "bring the stiffnesses of the parts nearer to each other, or hold the body better";
    if (common_share(sums) > common_by_far)
        snprintf(
            remedy, sizeof remedy,
            "the body moves as a whole by about (%.3g, %.3g, %.3g), and what deforms it, about %.1g, is lost beside "
            "that; take the common part out of the given displacements",
            fabs(c[0]) > to_speak_of ? c[0] : 0.0, fabs(c[1]) > to_speak_of ? c[1] : 0.0,
            fabs(c[2]) > to_speak_of ? c[2] : 0.0, sqrt(sums[SUM_DEFORMATION] / nodes));
    describe_error(checks->force_error < 1.0 ? checks->force_error : INFINITY, left);
    ost_object(&result->verdict, OST_CHECK_FAILED,
               "reactions and stresses hold less than one digit (%s): loads and reactions miss each other by %.2g %%, "
               "their moments by %.2g %%, strain energy and work by %.2g %%; %s",
               left, 100.0 * checks->force_imbalance, 100.0 * checks->moment_imbalance,
               100.0 * checks->energy_imbalance, remedy);
}

/* Comparisons are such that what is no number fails. */
static void judge(OstResult *result, double requested, Explained explained)
{
    const OstChecks *checks = &result->checks;
    if (!checks->finite) {
        ost_object(&result->verdict, OST_CHECK_FAILED, "the displacement is not finite everywhere");
        return;
    }
    if (!(checks->relative_residual <= 2.0 * requested + checks->rounding))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "the true residual, summed tet by tet, is %.2e where %.2e was asked for (rounding explains %.1e)",
                   checks->relative_residual, requested, checks->rounding);
    if (!(checks->force_imbalance <= explained.force && checks->moment_imbalance <= explained.moment))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "loads and reactions do not balance: force %.2e, moment %.2e of their size, where %.1e and %.1e can "
                   "be explained",
                   checks->force_imbalance, checks->moment_imbalance, explained.force, explained.moment);
    if (checks->linear && !(checks->energy_imbalance <= explained.energy && checks->strain_energy >= 0.0))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "the strain energy %.10e is not the work %.10e of loads and reactions", checks->strain_energy,
                   checks->work);
    if (loses_the_last_digit(&result->solve))
        object_to_rounding(result);
}

static OstStatus find_common(const OstResult *result, Body *body)
{
    const OstMesh *mesh = result->mesh;
    double sums[4] = {0.0};
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        double projector[9], given[3];
        if (ost_supports_get(body->supports, n, projector, given) > 0)
            sums[3] += given[0] != 0.0 || given[1] != 0.0 || given[2] != 0.0;
        for (int i = 0; i < 3; i++)
            sums[i] += result->displacement[3 * (size_t)n + (size_t)i];
    }
    OST_TRY(ost_sum(result->ctx, 4, sums));
    body->moved = sums[3] > 0.0;
    for (int i = 0; body->moved && i < 3; i++)
        body->common[i] = sums[i] / (double)mesh->global_nodes;
    return OST_SUCCESS;
}

static OstStatus look_at_body(const OstResult *result, Body *body)
{
    double low[3], high[3];
    OST_TRY(ost_mesh_bounds(result->mesh, low, high));
    for (int i = 0; i < 3; i++)
        body->centre[i] = 0.5 * (low[i] + high[i]);
    return find_common(result, body);
}

/* What the residual is held to: what was asked for, or, where that is taken, what double precision held. */
static double residual_to_hold(const OstResult *result, double requested)
{
    const OstSolveReport *report = &result->solve;
    return report->rounding_limited ? fmax(requested, report->relative_residual) : requested;
}

OstStatus ost_guard_after(const OstProblem *problem, double requested, const OstSolvedFor *solved_for,
                          OstResult *result)
{
    OstContext *ctx = problem->ctx;
    const OstMesh *mesh = problem->mesh;
    OstChecks *checks = &result->checks;
    double *internal = NULL, *magnitude = NULL;
    double sums[SUM_COUNT] = {0.0};
    Body body = {.supports = problem->supports};
    OfTets tets = {0.0, {0.0, 0.0}};
    requested = residual_to_hold(result, requested);
    checks->linear = ost_problem_is_linear(problem);
    ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
    OstStatus status = OST_NEW(ctx, &internal, 3 * (size_t)mesh->owned_nodes);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &magnitude, 3 * (size_t)mesh->owned_nodes);
    if (status == OST_SUCCESS)
        status = ost_internal_force(mesh, problem->field, result->displacement, internal, magnitude);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(look_at_body(result, &body));
    ost_visit_means(mesh, problem->field, result->displacement, add_tets, &tets);
    sums[SUM_ENERGY] = tets.energy;
    OST_TRY_DONE(ost_linearity_agree(ctx, &tets.largest));
    checks->largest_strain = tets.largest.strain;
    checks->largest_rotation = tets.largest.rotation;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        add_node(result, &body, n, internal + 3 * (size_t)n, magnitude + 3 * (size_t)n, sums);
    OST_TRY_DONE(ost_sum(ctx, SUM_COUNT, sums));
    OST_TRY_DONE(ost_halo_import(mesh->halo, 3 * sizeof(double), result->reaction));
    draw_conclusions(checks, sums, solved_for->norm);
    estimate_digits(result, &body, sums, solved_for->work);
    judge(result, requested, explain(result, sums, solved_for->norm));
    if (checks->finite && !result->unfinished && loses_the_forces(result, sums, requested))
        object_to_forces(result, &body, sums);
done:
    OST_FREE(internal);
    OST_FREE(magnitude);
    ost_ledger_leave(ctx);
    return status;
}
