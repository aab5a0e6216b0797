/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/energy_error.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "assembly/batch.h"
#include "assembly/springs.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/guard.h"
#include "guard/linearity.h"
#include "guard/volume.h"
#include "orthostat/case.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* Errors in the equations are those that the solver found (solve/error.h): of the displacement, the reactions and the
 * stresses. An answer is objected to where they leave no digit of what was asked for. The residual's 2-norm times the
 * condition number would need no solver, but fails where stiffness is uneven: it takes the residual at a stiff
 * inclusion for one at a soft place, and refused answers with errors of 1e-5.
 *
 * Where the solver finds none, the displacement's error is the solver's estimate (energy_error.h, refine.h), or the
 * relative difference of strain energy and work. If a support moves the whole body along, the displacement may have a
 * relative error of 1e-11 and the strains one of 1. The error of the forces is then the largest of the imbalances of
 * force, moment and energy, and of the displacement's error relative to what strains the body (to the strain energy;
 * with factors, to the displacement less its mean). The imbalances alone do not suffice: they are relative to the
 * reactions, and random rounding errors of n reactions add up to sqrt(n) of them only (a cube of 9261 vertices, moved
 * by 1 while it deforms by 1e-10, balances to 0.06 with stresses 330 times too large).
 *
 * The sums are not compensated: a displacement rounded to double precision leaves a residual of about DBL_EPSILON |K|
 * |u|, however it is summed. Measured on the worst case, an inclusion 1e9 times stiffer than its surroundings: 4.61e-6
 * with sums in 53 bits and in 64 bits. */

/* Sums over the body that the checks compare; the order is that of the reduction. */
enum {
    SUM_RESIDUAL, /* squares of P (f - K u), and of a mixed form's error of volume (volume.h) */
    SUM_ROUNDING, /* squares of the residual that rounding explains */
    SUM_LOAD,     /* 3 */
    SUM_REACTION = SUM_LOAD + 3,
    SUM_FORCE_SIZE = SUM_REACTION + 3, /* of |f + r - s| + |s|, s of springs: a load on a constrained component strains
                                          nothing, one on a spring moves the body */
    SUM_FORCE_TERMS,                   /* of |f| + |r|, which sets the rounding error of f + r */
    SUM_MOMENT,                        /* 3 */
    SUM_MOMENT_SIZE = SUM_MOMENT + 3,
    SUM_MOMENT_TERMS,
    SUM_ENERGY,      /* strain energy of the tets */
    SUM_SQUARE,      /* of u */
    SUM_DEFORMATION, /* squares of u less the mean displacement */
    SUM_DOUBLE_WORK, /* (f + r)·u, less the integral of stress on the eigenstrain */
    SUM_WORK_SIZE,   /* of |(f + r - s)·u| and |s·u|, by component, and of that integral */
    SUM_WORK_TERMS,  /* of |f·u| + |r·u| likewise */
    SUM_FREE_LOAD,   /* squares of P f, the load on unconstrained components */
    SUM_NOT_FINITE,
    SUM_COUNT
};

/* Rounding errors that a term of a nodal force collects: of the displacement, of the element, of the sum over tets.
 * They rarely all have one sign. */
static const double rounding_steps = 4.0;

/* A balance may be off by this much beyond what the residual explains. */
static const double balance_tolerance = 1e-10;

/* Fields that are lost with the reactions, and with the stresses. */
static const unsigned forces = 1U << OST_FIELD_REACTION;
static const unsigned stresses =
    1U << OST_FIELD_STRESS | 1U << OST_FIELD_NODE_STRESS | 1U << OST_FIELD_STRAIN | 1U << OST_FIELD_ENERGY;

/* The body moves as a whole if its displacement is this many times its deformation. */
static const double moves_as_a_whole = 10.0;

typedef struct Body {
    const OstSupports *supports;
    int turns; /* are rotations large? Moments are then those of the current shape */
    double centre[3];
    int moved;      /* is any prescribed displacement not zero? */
    double mean[3]; /* if so, the mean displacement; else zero */
} Body;

/* The components of a vector that supports constrain. */
static void project_on_constrained(const OstSupports *supports, OstLocal node, const double vector[3],
                                   double constrained[3])
{
    double projector[9], prescribed[3], free_part[3];
    if (supports->index[node] < 0 || ost_supports_get(supports, node, projector, prescribed) == 0) {
        memset(constrained, 0, 3 * sizeof *constrained);
        return;
    }
    ost_apply3(projector, vector, free_part);
    for (int i = 0; i < 3; i++)
        constrained[i] = vector[i] - free_part[i];
}

/* Where nodes follow others: what takes the owned nodes' forces (ost_supports_split), 3 × owned_nodes each. */
typedef struct Takers {
    double *borne, *passed, *residual; /* NULL: no node follows another */
} Takers;

/* The reaction is that of the springs so far. */
static OstStatus find_takers(const OstProblem *problem, const OstResult *result, const double *internal, Takers *by)
{
    const size_t owned = 3 * (size_t)result->mesh->owned_nodes;
    double *out_of_balance = NULL;
    if (!problem->supports->links)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(result->ctx, &out_of_balance, owned);
    OST_THEN(OST_NEW(result->ctx, &by->borne, owned));
    OST_THEN(OST_NEW(result->ctx, &by->passed, owned));
    OST_THEN(OST_NEW(result->ctx, &by->residual, owned));
    status = ost_agree(result->ctx, status);
    for (size_t i = 0; i < owned && status == OST_SUCCESS; i++)
        out_of_balance[i] = internal[i] - result->force[i] - result->reaction[i];
    OST_THEN(ost_supports_split(problem->supports, out_of_balance, by->borne, by->passed, by->residual));
    OST_FREE(out_of_balance);
    return status;
}

/* What supports and links take of a node's force, and what nothing takes. */
static void take_force(const OstSupports *supports, const Takers *by, OstLocal node, const double out_of_balance[3],
                       double taken[3], double residual[3])
{
    const size_t n = 3 * (size_t)node;
    project_on_constrained(supports, node, out_of_balance, taken);
    for (size_t i = 0; i < 3; i++) {
        taken[i] = by->borne ? by->borne[n + i] + by->passed[n + i] : taken[i];
        residual[i] = by->borne ? by->residual[n + i] : out_of_balance[i] - taken[i];
    }
}

/* Forces on the owned nodes: internal ones, with the sums of their absolute values; of the eigenstrain, or NULL. */
typedef struct NodeForces {
    double *internal, *magnitude, *eigen;
} NodeForces;

/* The reaction is that of the springs so far. An eigenstrain acts like loads that balance each other, `eigen` (NULL if
 * there is none): they count in the sizes that imbalances are relative to. */
static void add_node(OstResult *result, const Body *body, const Takers *by, OstLocal node, const NodeForces *of_nodes,
                     double *sums)
{
    const double *internal = of_nodes->internal + 3 * (size_t)node, *magnitude = of_nodes->magnitude + 3 * (size_t)node;
    const double *eigen = of_nodes->eigen ? of_nodes->eigen + 3 * (size_t)node : NULL;
    const double *f = result->force + 3 * (size_t)node;
    const double *u = result->displacement + 3 * (size_t)node;
    double *r = result->reaction + 3 * (size_t)node;
    double out_of_balance[3], taken[3], constrained[3], external[3], loaded[3], whole[3], arm[3], moment[3];
    double left[3], spring[3];
    project_on_constrained(body->supports, node, r, constrained);
    for (int i = 0; i < 3; i++) {
        spring[i] = r[i] - constrained[i]; /* the rest is the support's */
        out_of_balance[i] = internal[i] - f[i] - r[i];
    }
    take_force(body->supports, by, node, out_of_balance, taken, left);
    for (int i = 0; i < 3; i++) {
        r[i] += taken[i];
        external[i] = f[i] + r[i];
        loaded[i] = eigen ? f[i] + eigen[i] : f[i];
    }
    project_on_constrained(body->supports, node, loaded, constrained);
    for (int i = 0; i < 3; i++) {
        const double residual = left[i];
        const double deformation = u[i] - body->mean[i];
        whole[i] = loaded[i] + r[i] - spring[i];
        arm[i] = result->mesh->coordinates[3 * (size_t)node + (size_t)i] + (body->turns ? u[i] : 0.0) - body->centre[i];
        sums[SUM_RESIDUAL] += residual * residual;
        sums[SUM_ROUNDING] += magnitude[i] * magnitude[i];
        sums[SUM_LOAD + i] += f[i];
        sums[SUM_REACTION + i] += r[i];
        sums[SUM_DOUBLE_WORK] += external[i] * u[i];
        sums[SUM_WORK_SIZE] += fabs(whole[i] * u[i]) + fabs(spring[i] * u[i]);
        sums[SUM_WORK_TERMS] += (fabs(loaded[i]) + fabs(r[i])) * fabs(u[i]);
        sums[SUM_SQUARE] += u[i] * u[i];
        sums[SUM_DEFORMATION] += deformation * deformation;
        sums[SUM_FREE_LOAD] += (loaded[i] - constrained[i]) * (loaded[i] - constrained[i]);
        sums[SUM_NOT_FINITE] += !isfinite(u[i]) || !isfinite(internal[i]);
    }
    ost_cross3(arm, external, moment);
    for (int i = 0; i < 3; i++)
        sums[SUM_MOMENT + i] += moment[i];
    const double size = ost_norm3(whole) + ost_norm3(spring);
    sums[SUM_FORCE_SIZE] += size;
    sums[SUM_FORCE_TERMS] += ost_norm3(loaded) + ost_norm3(r);
    sums[SUM_MOMENT_SIZE] += ost_norm3(arm) * size;
    sums[SUM_MOMENT_TERMS] += ost_norm3(arm) * (ost_norm3(loaded) + ost_norm3(r));
}

/* Strain energy from strains and stresses, not from nodal forces, so that it checks their work; and the largest strain
 * and rotation, found on the way. */
typedef struct TetSums {
    OstResult *result;
    OstMeansVisit also;
    int is_judged; /* are the largest known? */
    OstFormulation formulation;
    double energy, eigen;
    OstLinearity largest;
} TetSums;

static void add_tets(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                     const OstMeans *means)
{
    TetSums *tets = data;
    if (tets->also)
        tets->also(tets->result, batch, element, u, means);
    if (!tets->is_judged)
        ost_linearity_add(batch, element, tets->formulation, u, means, &tets->largest);
    for (int slot = 0; slot < batch->count; slot++) {
        tets->energy += means->energy[slot] * means->volume[slot];
        tets->eigen += means->eigen[slot] * means->volume[slot];
    }
}

static void fill_checks(OstChecks *checks, const double *sums, double rhs_norm)
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

/* The displacement over the deformation, by their 2-norms. */
static double ratio_to_deformation(const double *sums)
{
    return sqrt(sums[SUM_SQUARE] / fmax(sums[SUM_DEFORMATION], DBL_MIN));
}

/* The displacement's error relative to what strains the body. The solver's estimate is relative to the displacement, or
 * to the energy of the unknowns; where a support moves the whole body, what strains it may be far less. */
static double strain_error(const OstResult *result, const Body *body, const double *sums, double work)
{
    const double error = result->checks.displacement_error;
    if (!body->moved) /* a mixed form's pressure is a stress that no displacement tells of */
        return result->pressure ? fmax(error, result->solve.energy_error) : error;
    if (result->solve.method == OST_METHOD_DIRECT || !result->checks.linear) /* the estimate is of the displacement */
        return error * ratio_to_deformation(sums);
    return result->solve.energy_error * fmax(sqrt(fmax(work, 0.0) / fmax(2.0 * sums[SUM_ENERGY], DBL_MIN)), 1.0);
}

/* (f·u - u·K u) / f·u is an error of the displacement too: it shows errors of K itself, as of equal tets whose rounding
 * errors are equal and add up, which random samples do not show. Under prescribed displacements it says nothing of u.
 */
static void estimate_errors(OstResult *result, const Body *body, const double *sums, double work)
{
    OstChecks *checks = &result->checks;
    const int known = result->solve.error_estimate > 0.0;
    const double of_energy = body->moved ? 0.0 : checks->energy_imbalance;
    checks->displacement_error = known ? fmax(result->solve.error_estimate, of_energy) : NAN;
    const double imbalance = fmax(checks->force_imbalance, fmax(checks->moment_imbalance, checks->energy_imbalance));
    checks->force_error = known ? fmax(imbalance, strain_error(result, body, sums, work)) : NAN;
}

/* The errors that were found. Imbalances of force and moment show errors of reactions that the equations do not. */
static void state_errors(OstResult *result, const OstErrors *errors)
{
    OstChecks *checks = &result->checks;
    checks->displacement_error = errors->displacement;
    checks->force_error =
        fmax(fmax(checks->force_imbalance, checks->moment_imbalance), fmax(errors->reaction, errors->stress));
}

/* Imbalances that need no further cause. Internal forces sum to zero, so a residual unbalances forces by its sum, at
 * most sqrt(n) times its norm, and the energy by its work on u. Rounding adds to that where a load and its reaction all
 * but cancel. */
typedef struct Explained {
    double force, moment, energy;
} Explained;

static double explained_imbalance(double residual, double terms, double size)
{
    return balance_tolerance + (residual + rounding_steps * DBL_EPSILON * terms) / fmax(size, DBL_MIN);
}

static Explained explain(const OstResult *result, const OstVolumeError *volume, const double *sums, double rhs_norm)
{
    const double residual = sqrt(sums[SUM_RESIDUAL]) + result->checks.rounding * rhs_norm;
    const double of_balance = sqrt((double)result->unknowns) * residual;
    const double arm = sums[SUM_MOMENT_SIZE] / fmax(sums[SUM_FORCE_SIZE], DBL_MIN);
    return (Explained){explained_imbalance(of_balance, sums[SUM_FORCE_TERMS], sums[SUM_FORCE_SIZE]),
                       explained_imbalance(arm * of_balance, sums[SUM_MOMENT_TERMS], sums[SUM_MOMENT_SIZE]),
                       explained_imbalance(sqrt(sums[SUM_SQUARE]) * residual + volume->work, sums[SUM_WORK_TERMS],
                                           sums[SUM_WORK_SIZE])};
}

/* The error that rounding causes: all of it where rounding, not the residual asked for, ended the solve. */
static double error_of_rounding(const OstSolveReport *report)
{
    return report->rounding_limited ? report->error_estimate : report->rounding_error;
}

/* Is the error above a tenth? Where only the solver's random samples of rounding errors tell, beyond statistical doubt:
 * only they have a spread; the residual's part, added in squares, has none. */
static int loses_the_displacement(const OstResult *result, const OstErrors *errors)
{
    const OstSolveReport *report = &result->solve;
    if (errors->known)
        return !(errors->displacement <= ost_least_digit);
    const double error = error_of_rounding(report);
    const double sampled = error > 0.0 ? report->rounding_error / error : 0.0;
    return ost_surely_beyond(error, sampled * sampled * report->rounding_spread, ost_least_digit);
}

static int asks_for(const OstResult *result, unsigned fields)
{
    return (result->asked & fields) != 0;
}

static void describe_error(double error, char left[48])
{
    snprintf(left, 48, "none at all");
    if (isfinite(error))
        snprintf(left, 48, "an error of about %.1g", error);
}

/* Does the residual that the user asked for explain the error? */
static int is_as_asked(const OstSolveReport *report, const OstErrors *errors)
{
    return errors->asked ||
           (errors->known && !report->rounding_limited && report->error_estimate > 0.5 * errors->displacement &&
            report->rounding_error < 0.5 * report->error_estimate);
}

static void object_to_displacement(OstResult *result, const OstErrors *errors, const char *worst)
{
    char left[48];
    describe_error(errors->known ? errors->displacement : error_of_rounding(&result->solve), left);
    if (is_as_asked(&result->solve, errors))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "the relative residual asked for leaves the displacement less than one digit (%s); ask for a "
                   "smaller one",
                   left);
    else
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "rounding in double precision leaves the displacement less than one digit (%s); %s%s%s", left,
                   ost_rounding_remedy, worst[0] ? "; " : "", worst);
}

/* Are reactions and stresses lost? Without a load they are allowed to be: a rigid motion leaves rounding errors alone.
 * What the requested residual may add up to over all unknowns is the user's choice. The errors that the solver found
 * count where the output holds the fields that they spoil. Where it found none, the error of the forces counts if the
 * body moves as a whole, or, if none is stated, a residual above the load; elsewhere a difference of energy and work is
 * stated but does not refuse: in a part that is 1e9 times stiffer strains are smaller than rounding errors while
 * displacement and reactions are right. */
static int loses_the_forces(const OstResult *result, const OstErrors *errors, const double *sums, double requested)
{
    const OstChecks *checks = &result->checks;
    const int by_residual = !result->solve.rounding_limited && !result->solve.stopped;
    const double chosen = by_residual ? sqrt((double)result->unknowns) * requested : 0.0;
    double error = fmax(checks->force_imbalance, checks->moment_imbalance);
    if (!(sqrt(sums[SUM_FREE_LOAD]) > rounding_steps * DBL_EPSILON * sums[SUM_FORCE_TERMS]))
        return 0;
    if (errors->known) {
        error = fmax(error, asks_for(result, forces) ? errors->reaction : 0.0);
        error = fmax(error, asks_for(result, stresses) ? errors->stress : 0.0);
    } else if (ratio_to_deformation(sums) > moves_as_a_whole) {
        const double unstated = sums[SUM_RESIDUAL] > sums[SUM_FREE_LOAD] ? INFINITY : 0.0;
        error = fmax(error, isnan(checks->force_error) ? unstated : checks->force_error);
    }
    return error > fmax(ost_least_digit, chosen);
}

static void object_to_forces(OstResult *result, const Body *body, const OstErrors *errors, const double *sums,
                             const char *worst)
{
    const OstChecks *checks = &result->checks;
    const double *mean = body->mean;
    const double nodes = (double)result->mesh->global_nodes;
    const double smallest = 1e-3 * ost_norm3(mean);
    char left[48];
    char remedy[280];
    snprintf(remedy, sizeof remedy, "%s",
             is_as_asked(&result->solve, errors) ? "ask for a smaller relative residual" : ost_rounding_remedy);
    if (ratio_to_deformation(sums) > moves_as_a_whole)
        snprintf(
            remedy, sizeof remedy,
            "the body moves as a whole by about (%.3g, %.3g, %.3g), and its deformation, about %.1g, is lost beside "
            "that; subtract the common part from the prescribed displacements",
            fabs(mean[0]) > smallest ? mean[0] : 0.0, fabs(mean[1]) > smallest ? mean[1] : 0.0,
            fabs(mean[2]) > smallest ? mean[2] : 0.0, sqrt(sums[SUM_DEFORMATION] / nodes));
    describe_error(checks->force_error < 1.0 ? checks->force_error : INFINITY, left);
    ost_object(&result->verdict, OST_CHECK_FAILED,
               "reactions and stresses hold less than one digit (%s): loads and reactions differ by %.2g %%, "
               "their moments by %.2g %%, strain energy and work by %.2g %%; %s%s%s",
               left, 100.0 * checks->force_imbalance, 100.0 * checks->moment_imbalance,
               100.0 * checks->energy_imbalance, remedy, worst[0] ? "; " : "", worst);
}

/* Rounding of the stiffness's entries may leave the tets a residual above the one asked for. The errors that it makes
 * were found from it: where they are no larger than that, nothing is wrong. */
static int is_right(const OstErrors *errors, double requested)
{
    return errors->corrected ||
           (errors->known && errors->displacement <= requested && fmax(errors->reaction, errors->stress) <= requested);
}

/* Each comparison is written so that NaN fails it. */
static void judge(OstResult *result, const OstErrors *errors, double requested, Explained explained)
{
    const OstChecks *checks = &result->checks;
    if (!checks->finite) {
        ost_object(&result->verdict, OST_CHECK_FAILED, "the displacement is not finite everywhere");
        return;
    }
    if (!is_right(errors, requested) && !(checks->relative_residual <= 2.0 * requested + checks->rounding))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "the true residual, summed tet by tet, is %.2e where %.2e was asked for (rounding explains %.1e)",
                   checks->relative_residual, requested, checks->rounding);
    const int has_moment = result->formulation == OST_FORMULATION_CLASSICAL; /* of its own: that form's flaw */
    if (!(checks->force_imbalance <= explained.force && (checks->moment_imbalance <= explained.moment || has_moment)))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "loads and reactions do not balance: force %.2e, moment %.2e of their size, where residual and "
                   "rounding explain %.1e and %.1e",
                   checks->force_imbalance, checks->moment_imbalance, explained.force, explained.moment);
    if (checks->linear && !(checks->energy_imbalance <= explained.energy && checks->strain_energy >= 0.0))
        ost_object(&result->verdict, OST_CHECK_FAILED,
                   "the strain energy %.10e differs from the work %.10e of loads and reactions", checks->strain_energy,
                   checks->work);
}

static OstStatus judge_errors(OstResult *result, const Body *body, const OstErrors *errors, const double *sums,
                              double requested)
{
    const int displacement_lost = loses_the_displacement(result, errors);
    const int forces_lost = loses_the_forces(result, errors, sums, requested);
    char worst[OST_WORST_TET_SIZE] = "";
    if (displacement_lost || forces_lost)
        OST_TRY(ost_guard_worst_tet(result->mesh, worst));
    if (displacement_lost)
        object_to_displacement(result, errors, worst);
    if (forces_lost)
        object_to_forces(result, body, errors, sums, worst);
    return OST_SUCCESS;
}

/* Centre, mean displacement, and whether supports move the body. */
static OstStatus look_at_body(const OstProblem *problem, const OstResult *result, Body *body)
{
    const OstMesh *mesh = result->mesh;
    double low[3], high[3];
    double sums[4] = {0.0};
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        body->centre[i] = 0.5 * (low[i] + high[i]);
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        sums[3] += ost_problem_moves(problem, n);
        for (int i = 0; i < 3; i++)
            sums[i] += result->displacement[3 * (size_t)n + (size_t)i];
    }
    OST_TRY(ost_sum(result->ctx, 4, sums));
    body->moved = sums[3] > 0.0;
    for (int i = 0; body->moved && i < 3; i++)
        body->mean[i] = sums[i] / (double)mesh->global_nodes;
    return OST_SUCCESS;
}

static OstStatus find_volume_ratio(const OstProblem *problem, OstResult *result)
{
    double volumes[2];
    ost_deformed_volume(problem->mesh, problem->field, result->displacement, volumes);
    OST_TRY(ost_sum(problem->ctx, 2, volumes));
    result->checks.volume_ratio = volumes[1] / volumes[0];
    return OST_SUCCESS;
}

/* Takes the internal forces of the result, if it has them. */
static OstStatus find_forces(const OstProblem *problem, OstResult *result, NodeForces *of_nodes)
{
    OstContext *ctx = problem->ctx;
    const size_t count = 3 * (size_t)problem->mesh->owned_nodes;
    const int is_summed = result->internal != NULL;
    *of_nodes = (NodeForces){.internal = result->internal};
    result->internal = NULL;
    OstStatus status = is_summed ? OST_SUCCESS : OST_NEW_UNCLEARED(ctx, &of_nodes->internal, count);
    OST_THEN(OST_NEW_UNCLEARED(ctx, &of_nodes->magnitude, count));
    OST_THEN(ost_internal_force_of(problem->mesh, problem->field, problem->formulation, result->t, result->displacement,
                                   is_summed ? NULL : of_nodes->internal, of_nodes->magnitude));
    if (status == OST_SUCCESS && ost_field_is_eigenstrained(problem->field)) {
        status = OST_NEW(ctx, &of_nodes->eigen, count);
        OST_THEN(ost_eigenstrain_force(problem->mesh, problem->field, result->t, of_nodes->eigen));
    }
    return ost_agree(ctx, status);
}

static OstStatus look_at_tets(const OstProblem *problem, TetSums *tets, OstResult *result)
{
    OstChecks *checks = &result->checks;
    const int turns = problem->formulation != OST_FORMULATION_LINEAR;
    ost_visit_means_of(problem->mesh, problem->field, problem->formulation, result->t, result->displacement, add_tets,
                       tets);
    OST_TRY(ost_linearity_agree(problem->ctx, problem->supports, result->displacement, &tets->largest));
    if (turns) {
        OST_TRY(ost_problem_worst_tet(problem, result->displacement, &result->worst));
        OST_TRY(find_volume_ratio(problem, result));
    }
    checks->largest_strain = tets->largest.strain;
    checks->largest_rotation = tets->largest.rotation;
    checks->stiffening = NAN; /* not looked at */
    if (result->newton.judged && !turns)
        checks->stiffening = result->newton.linear_stiffening;
    else if (!turns && !ost_field_is_eigenstrained(problem->field))
        checks->stiffening = ost_linearity_stiffening(&tets->largest);
    return OST_SUCCESS;
}

OstStatus ost_guard_after(const OstProblem *problem, double requested, const OstSolvedFor *solved_for,
                          OstMeansVisit also, OstResult *result)
{
    OstContext *ctx = problem->ctx;
    OstChecks *checks = &result->checks;
    double sums[SUM_COUNT] = {0.0};
    OstVolumeError volume;
    NodeForces of_nodes;
    Body body = {.supports = problem->supports, .turns = problem->formulation != OST_FORMULATION_LINEAR};
    TetSums tets = {.result = result, .also = also, .formulation = problem->formulation};
    if (result->internal && result->newton.judged) { /* of this displacement too, and not of all on a path */
        tets.is_judged = 1;
        tets.largest =
            (OstLinearity){.strain = result->newton.linear_strain, .rotation = result->newton.linear_rotation};
    }
    Takers by = {NULL, NULL, NULL};
    /* What double precision attained, or the error of the answer made do with. */
    if (result->solve.rounding_limited || result->solve.stopped)
        requested = fmax(requested, result->solve.relative_residual);
    checks->linear = ost_problem_is_linear(problem);
    ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
    OstStatus status = find_forces(problem, result, &of_nodes);
    OST_THEN(look_at_body(problem, result, &body));
    OST_THEN(look_at_tets(problem, &tets, result));
    if (status != OST_SUCCESS)
        goto done;
    sums[SUM_ENERGY] = tets.energy;
    sums[SUM_DOUBLE_WORK] = -tets.eigen;
    sums[SUM_WORK_SIZE] = sums[SUM_WORK_TERMS] = fabs(tets.eigen);
    if (problem->supports->spring)
        ost_spring_force(problem->supports, 1.0, result->displacement, result->reaction);
    OST_TRY_DONE(find_takers(problem, result, of_nodes.internal, &by));
    for (OstLocal n = 0; n < problem->mesh->owned_nodes; n++)
        add_node(result, &body, &by, n, &of_nodes, sums);
    for (size_t i = 0; result->passed && by.passed && i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        result->passed[i] = by.passed[i];
    OST_TRY_DONE(ost_sum(ctx, SUM_COUNT, sums));
    OST_TRY_DONE(ost_guard_volume_error(problem, result, &volume));
    sums[SUM_RESIDUAL] += volume.force;
    OST_TRY_DONE(ost_halo_import(problem->mesh->halo, 3 * sizeof(double), result->reaction));
    fill_checks(checks, sums, solved_for->norm);
    if (solved_for->errors.known)
        state_errors(result, &solved_for->errors);
    else
        estimate_errors(result, &body, sums, solved_for->work);
    judge(result, &solved_for->errors, requested, explain(result, &volume, sums, solved_for->norm));
    if (checks->finite && !result->unfinished)
        OST_TRY_DONE(judge_errors(result, &body, &solved_for->errors, sums, requested));
done:
    OST_FREE(of_nodes.internal, of_nodes.magnitude, of_nodes.eigen, by.borne, by.passed, by.residual);
    ost_ledger_leave(ctx);
    return status;
}
