/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/watch.h"

#include "assembly/batch.h"
#include "case/select.h"
#include "case/verify.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/nearest.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Linear theory that is off by this share of the largest displacement is worth a warning where that is this share of
 * what is watched. */
static const double worth_words = 1e-3;
static const double most_off = 0.1;

static const char force_is_unknown[] = "the force of a moved coupling is looked for too";

/* An error below this share is rounding, as is a reaction of the body's. */
static const double rounding = 1e-12;

static double component_of(const double vector[3], int component)
{
    return component == OST_WATCH_LENGTH ? ost_norm3(vector) : vector[component];
}

static OstStatus displacement(const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    const OstMesh *mesh = result->mesh;
    OstNearest vertex;
    double pair[6] = {0.0}; /* the vertex's displacement; then that with what the estimate adds */
    OST_TRY(ost_mesh_nearest(mesh, watch->on.point, &vertex));
    if (vertex.node >= 0)
        memcpy(pair, result->displacement + 3 * (size_t)vertex.node, 3 * sizeof *pair);
    if (vertex.node >= 0 && result->surplus)
        memcpy(pair + 3, result->surplus + 3 * (size_t)vertex.node, 3 * sizeof *pair);
    OST_TRY(OST_MPI(mesh->ctx, MPI_Bcast(pair, 6, MPI_DOUBLE, vertex.owner, ost_comm(mesh->ctx))));
    for (int i = 0; i < 3; i++)
        pair[3 + i] += pair[i];
    watched->value = component_of(pair, watch->component);
    watched->error = result->surplus ? component_of(pair + 3, watch->component) - watched->value : NAN;
    watched->scale = result->largest_displacement;
    return OST_SUCCESS;
}

/* A node's reaction, or its moment about the point asked for, with the arm of the body as it is loaded; of it a share,
 * or, if that is NULL, all. */
static void add_reaction(const OstResult *result, const OstWatch *watch, OstLocal node, const OstBearing *share,
                         double sum[3])
{
    const double *x = result->mesh->coordinates + 3 * (size_t)node;
    const double *u = result->displacement + 3 * (size_t)node;
    const int turns = result->formulation != OST_FORMULATION_LINEAR;
    double arm[3], force[3], moment[3], borne[3], passed[3], moved[3];
    for (int i = 0; i < 3; i++) {
        const size_t n = 3 * (size_t)node + (size_t)i;
        const double both = result->passed ? result->passed[n] : 0.0;
        moved[i] = result->moved ? result->moved[n] : 0.0;
        passed[i] = both - moved[i];
        borne[i] = result->reaction[n] - both;
        arm[i] = x[i] + (turns ? u[i] : 0.0) - watch->about[i];
        force[i] = borne[i];
    }
    if (share)
        ost_apply3(share->own, borne, force);
    for (int i = 0; i < 3; i++)
        force[i] += (!share || share->is_passed ? passed[i] : 0.0) + (!share || share->is_moved ? moved[i] : 0.0);
    ost_cross3(arm, force, moment);
    for (int i = 0; i < 3; i++)
        sum[i] += watch->of_moment ? moment[i] : force[i];
}

/* By the adjoint problem (solve/reactions/), where that was solved. The surplus says little of reactions: what few
 * steps leave out of balance in the body is of their errors' size. Of a mixed form's mean stresses it says half. */
static void take_adjoint(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    const OstCase *c = scene->c;
    for (int w = 0; result->reactions && w < c->watch_count; w++)
        if (strcmp(c->watches[w].name, watch->name) == 0 && result->reactions[w].known) {
            watched->value += result->reactions[w].missing;
            watched->error = result->reactions[w].error;
        }
}

/* The size of the forces, or moments, that a selection's reaction is the sum of, along what is watched, and that of all
 * the body's: below a rounding's share of it the first is none. *terms: the size in any direction. */
static OstStatus acts(const OstResult *result, const OstWatch *watch, OstLocal count, const OstLocal *nodes,
                      const OstBearing *shares, double *terms, int *yes)
{
    const OstLocal owned = result->mesh->owned_nodes;
    double sums[3] = {0.0};
    for (OstLocal n = 0; n < count; n++) {
        double force[3] = {0.0};
        if (nodes[n] < owned)
            add_reaction(result, watch, nodes[n], &shares[n], force);
        sums[0] += fabs(component_of(force, watch->component));
        sums[2] += ost_norm3(force);
    }
    for (OstLocal n = 0; n < owned; n++) {
        double force[3] = {0.0};
        add_reaction(result, watch, n, NULL, force);
        sums[1] += ost_norm3(force);
    }
    OST_TRY(ost_sum(result->ctx, 3, sums));
    *terms = sums[2];
    *yes = sums[0] > rounding * sums[1];
    return OST_SUCCESS;
}

static OstStatus reaction(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    OstContext *ctx = scene->ctx;
    OstLocal *nodes = NULL;
    OstLocal count = 0;
    OstBearing *shares = NULL;
    double sum[3] = {0.0};
    int does_act = 0;
    watched->in_doubt = 0;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &watch->on, &count, &nodes));
    OstStatus status = ost_select_shares(scene->c, scene->mesh, watch, count, nodes, &shares);
    for (OstLocal n = 0; n < count && status == OST_SUCCESS; n++)
        if (nodes[n] < scene->mesh->owned_nodes) {
            add_reaction(result, watch, nodes[n], &shares[n], sum);
            if ((int)shares[n].unknown > watched->in_doubt)
                watched->in_doubt = (int)shares[n].unknown;
        }
    OST_THEN(acts(result, watch, count, nodes, shares, &watched->terms, &does_act));
    OST_FREE(shares);
    OST_FREE(nodes);
    OST_THEN(ost_sum(ctx, 3, sum));
    OST_THEN(ost_max_ints(ctx, 1, &watched->in_doubt));
    OST_TRY(status);
    watched->value = component_of(sum, watch->component);
    watched->error = NAN;
    watched->scale = ost_norm3(sum);
    take_adjoint(scene, result, watch, watched);
    if (does_act || scene->c->free_body) /* which has words of its own */
        return OST_SUCCESS;
    watched->value = watched->error = 0.0;
    watched->exact =
        watch->component == OST_WATCH_LENGTH ? "as no support acts there" : "as no support acts there along it";
    return OST_SUCCESS;
}

OstStatus ost_energy_scale(const OstResult *result, double *scale)
{
    *scale = 0.0;
    if (ost_field_is_eigenstrained(result->field)) {
        ost_visit_means_of(result->mesh, result->field, result->formulation, 0.0, result->displacement,
                           ost_visit_energy, scale);
        OST_TRY(ost_sum(result->ctx, 1, scale));
    }
    *scale = fmax(*scale, fabs(result->checks.strain_energy));
    return OST_SUCCESS;
}

/* The force that moves a coupling has an error too, of which the surplus knows nothing. */
static int is_moved_by_coupling(const OstScene *scene)
{
    return scene->drive != NULL;
}

static int has_given_forces(const OstCase *c)
{
    int some = 0;
    for (int i = 0; i < c->load_count; i++)
        some |= c->loads[i].kind != OST_LOAD_DISTRIBUTING;
    return some;
}

/* Where loads do less of the work than this, supports alone strain the body. */
static const double next_to_nothing = 1e-3;

/* A body that loads alone strain has less energy than the exact answer, by half the square of the error; one that
 * displacements alone strain has more. Of a moved coupling e is that of its force, which falls as the body gives way.
 * Where both act, or an eigenstrain, or springs, there is no such rule; nor one that leaves less than nothing. */
static double energy_error(const OstScene *scene, const OstResult *result)
{
    const OstEffects *effects = &scene->plan.effects;
    const OstAnswerError *answer = &result->answer;
    const double half = 0.5 * answer->energy_norm * answer->energy_norm, energy = result->checks.strain_energy;
    const int is_moved = ost_effect_on(effects, OST_EFFECT_PRESCRIBED_DISPLACEMENT);
    const int is_other = ost_effect_on(effects, OST_EFFECT_EIGENSTRAIN) || scene->c->spring_count > 0;
    if (!answer->known || result->formulation != OST_FORMULATION_LINEAR || is_other)
        return NAN;
    if (is_moved_by_coupling(scene))
        return has_given_forces(scene->c) ? NAN : -half * energy / (energy + half);
    if (!is_moved)
        return half;
    return answer->by_loads < next_to_nothing && half < energy ? -half : NAN;
}

static const char *why_no_energy(const OstScene *scene, const OstResult *result)
{
    if (result->formulation != OST_FORMULATION_LINEAR)
        return "with large rotations it is not half the square of the error in the norm of the energy";
    return ost_effect_on(&scene->plan.effects, OST_EFFECT_EIGENSTRAIN) ? "a part swells or contracts of itself"
           : scene->c->spring_count > 0                                ? "springs have energy too"
           : result->answer.by_loads < next_to_nothing ? "the mesh is too coarse: by the estimate no energy is left"
                                                       : "both loads and prescribed displacements act";
}

static const char *why_in_doubt(const OstWatched *watched)
{
    if (watched->in_doubt == OST_BEARING_OF_TIE)
        return "a tie passes a force on to its face too, of which supports hold a part: the tie's is that on its "
               "other face, and theirs that on both together";
    return "at its edge two links meet: what each of them takes there cannot be told";
}

static const char *why_no_reaction(const OstScene *scene, const OstResult *result)
{
    if (scene->c->free_body)
        return "a free body has none";
    return result->formulation != OST_FORMULATION_LINEAR && !result->conservative
               ? "a pressure that follows a free rim makes its adjoint problem unsymmetric"
               : "its adjoint problem was not solved";
}

/* Why there is no error, in words. */
static const char *find_why(const OstScene *scene, const OstResult *result, const OstWatch *watch,
                            const OstWatched *watched)
{
    if (watch->kind == OST_WATCH_REACTION && watched->in_doubt)
        return why_in_doubt(watched);
    if (!ost_effect_on(&scene->plan.effects, OST_EFFECT_ERROR_ESTIMATE)) /* not asked for, or no room for it */
        return ost_plan_writes(scene->c, OST_FIELD_ERROR) ? "the error of the answer is not estimated" : NULL;
    if (!result->answer.known)
        return result->answer.is_indefinite
                   ? "the stiffness that the estimate takes at the answer is not positive definite"
                   : "that of the answer is not";
    if (is_moved_by_coupling(scene) && watch->kind != OST_WATCH_STRAIN_ENERGY)
        return force_is_unknown;
    switch (watch->kind) {
    case OST_WATCH_STRAIN_ENERGY:
        return why_no_energy(scene, result);
    case OST_WATCH_REACTION:
        return why_no_reaction(scene, result);
    case OST_WATCH_STRESS:
        return "the mean of a measure that is not linear in the stress; those of xx, 11, pressure … have one";
    case OST_WATCH_DISPLACEMENT:
    case OST_WATCH_LOAD_FACTOR:
        break;
    }
    return "it was not estimated";
}

static OstStatus evaluate(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    switch (watch->kind) {
    case OST_WATCH_DISPLACEMENT:
        return displacement(result, watch, watched);
    case OST_WATCH_REACTION:
        return reaction(scene, result, watch, watched);
    case OST_WATCH_STRAIN_ENERGY:
        watched->value = result->checks.strain_energy;
        watched->error = energy_error(scene, result);
        return ost_energy_scale(result, &watched->scale);
    case OST_WATCH_STRESS:
    case OST_WATCH_LOAD_FACTOR:
        OST_TRY(ost_watch_stress(scene, result, watch, watched));
        take_adjoint(scene, result, watch, watched);
        return OST_SUCCESS;
    }
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d: this quantity of interest has no kind", scene->c->path,
                     watch->line);
}

/* Why there is no error of the mesh, in words. What the equations leave is in the estimate's residual: it is then none.
 */
static const char *find_exact(const OstWatch *watch, const OstWatched *watched)
{
    if (watched->exact || !(fabs(watched->error) <= rounding * fmax(fabs(watched->value), watched->scale)))
        return watched->exact;
    return watched->error == 0.0 && watch->kind == OST_WATCH_REACTION ? "which statics alone gives"
                                                                      : "exact but for rounding";
}

OstStatus ost_watch_evaluate(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    watched->placed = 0;
    watched->terms = 0.0;
    watched->exact = NULL;
    OST_TRY(evaluate(scene, result, watch, watched));
    for (int i = 0; i < 3 && !watched->placed; i++)
        watched->place[i] = NAN;
    if (result->interest.watch && result->interest.watch == watch && watch->kind != OST_WATCH_STRAIN_ENERGY)
        watched->error = result->interest.error;
    if (is_moved_by_coupling(scene) && (watch->kind == OST_WATCH_DISPLACEMENT || ost_watch_is_of_stress(watch)))
        watched->error = NAN;
    if (watch->kind == OST_WATCH_REACTION && watched->in_doubt && !watched->exact)
        watched->error = NAN;
    watched->why = isnan(watched->error) ? find_why(scene, result, watch, watched) : NULL;
    watched->exact = find_exact(watch, watched);
    return OST_SUCCESS;
}

/* --- all quantities of a case --- */

static OstStatus check_selection(const OstScene *scene, const char *what, const char *name, int line,
                                 const OstSelection *on)
{
    OstContext *ctx = scene->ctx;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, on, &count, &nodes));
    OST_FREE(nodes);
    int some = count > 0;
    OST_TRY(ost_max_ints(ctx, 1, &some));
    return some ? OST_SUCCESS
                : OST_RAISE(ctx, OST_INVALID_INPUT, "%s:%d: %s '%s' selects no vertex", scene->c->path, line, what,
                            name);
}

OstStatus ost_watch_check(const OstScene *scene)
{
    const OstCase *c = scene->c;
    ost_warn_absent_fields(c, &scene->plan.effects);
    for (int w = 0; w < c->watch_count; w++) {
        OstWatch placed = c->watches[w]; /* for the warning alone: the solve finds the vertex itself */
        OST_TRY(ost_watch_place(scene->mesh, &placed));
        if (ost_watch_is_of_stress(&placed))
            OST_TRY(ost_watch_check_stress(scene, &placed));
        if (placed.kind == OST_WATCH_REACTION)
            OST_TRY(check_selection(scene, "the quantity", placed.name, placed.line, &placed.on));
    }
    for (int q = 0; c->verify && q < c->verify->quantity_count; q++) {
        const OstVerifyQuantity *quantity = &c->verify->quantity[q];
        if (quantity->kind != OST_MEASURE_FIELD && quantity->kind != OST_MEASURE_ENERGY)
            OST_TRY(check_selection(scene, "the verified quantity", quantity->name, quantity->line, &quantity->on));
    }
    return OST_SUCCESS;
}

/* What large rotations would make of it, to first order: they are small where this is there. */
static OstStatus find_change(const OstScene *scene, const OstResult *result, const OstWatch *watch, double *change)
{
    OstContext *ctx = scene->ctx;
    const size_t nodes = 3 * (size_t)result->mesh->node_count, owned = 3 * (size_t)result->mesh->owned_nodes;
    OstResult straight = *result, turned;
    OstWatched before, after;
    straight.reactions = NULL;
    straight.surplus = NULL;
    turned = straight;
    turned.displacement = turned.reaction = turned.passed = NULL;
    turned.formulation = OST_FORMULATION_CONSISTENT;
    OstStatus status = OST_NEW(ctx, &turned.displacement, nodes);
    OST_THEN(OST_NEW(ctx, &turned.reaction, owned));
    if (result->passed)
        OST_THEN(OST_NEW(ctx, &turned.passed, owned));
    status = ost_agree(ctx, status);
    for (size_t i = 0; i < nodes && status == OST_SUCCESS; i++)
        turned.displacement[i] = result->displacement[i] + result->left_out[i];
    for (size_t i = 0; i < owned && status == OST_SUCCESS; i++) {
        const double added = result->left_out_reaction ? result->left_out_reaction[i] : 0.0;
        turned.reaction[i] = result->reaction[i] + added;
        if (turned.passed)
            turned.passed[i] = result->passed[i] != 0.0 ? result->passed[i] + added : 0.0;
    }
    OST_THEN(evaluate(scene, &straight, watch, &before));
    OST_THEN(evaluate(scene, &turned, watch, &after));
    OST_FREE(turned.displacement);
    OST_FREE(turned.reaction, turned.passed);
    OST_TRY(status);
    *change = after.value - before.value;
    return OST_SUCCESS;
}

/* A displacement that is less than places are rounded by turns nothing. */
static OstStatus find_least_change(const OstResult *result, const OstWatch *watch, double *least)
{
    double low[3], high[3], size[3];
    *least = 0.0;
    if (watch->kind != OST_WATCH_DISPLACEMENT)
        return OST_SUCCESS;
    OST_TRY(ost_mesh_bounds(result->mesh, low, high));
    for (int i = 0; i < 3; i++)
        size[i] = high[i] - low[i];
    *least = DBL_EPSILON * ost_norm3(size);
    return OST_SUCCESS;
}

/* What statics alone gives stays as it is when the body turns: a sum of forces if the loads keep their directions, a
 * moment if there are none. */
static int is_same_once_turned(const OstScene *scene, const OstWatch *watch, const OstWatched *watched)
{
    return watch->kind == OST_WATCH_REACTION && watched->exact && !(watch->of_moment && has_given_forces(scene->c)) &&
           !ost_effect_on(&scene->plan.effects, OST_EFFECT_FOLLOWER_PRESSURE);
}

/* Linear theory is off by a share of the largest displacement: of a small component beside a large one, as the
 * shortening of a beam that bends, or of the moment of a column that leans, that may be all. */
static OstStatus warn_of_linear_theory(const OstScene *scene, const OstResult *result, const OstWatch *watch,
                                       const OstWatched *watched)
{
    const OstNewtonReport *newton = &result->newton;
    const int may_differ =
        watch->kind == OST_WATCH_DISPLACEMENT || (watch->kind == OST_WATCH_REACTION && result->left_out_reaction);
    double change = newton->linear_error * watched->scale, least;
    if (!newton->judged || newton->used || !may_differ || is_same_once_turned(scene, watch, watched))
        return OST_SUCCESS;
    if (!result->left_out) {
        if (newton->linear_error > worth_words && change > most_off * fabs(watched->value))
            ost_warn(result->ctx,
                     "'%s' is %.4g by linear theory, which may be off by %.2g, %.2g %% of the largest displacement%s",
                     watch->name, watched->value, change, 100.0 * newton->linear_error,
                     result->linear_alone ? "" : "; large_rotation: on computes it without");
        return OST_SUCCESS;
    }
    OST_TRY(find_change(scene, result, watch, &change));
    OST_TRY(find_least_change(result, watch, &least));
    if (fabs(change) > fmax(fmax(newton->accuracy * fabs(watched->value), worth_words * watched->scale), least))
        ost_warn(
            result->ctx,
            "'%s' is %.4g by linear theory, and about %.4g%s once the body has turned; large_rotation: on computes "
            "it",
            watch->name, watched->value, watched->value + change, change * watched->value > 0.0 ? " or more" : "");
    return OST_SUCCESS;
}

OstStatus ost_watch_evaluate_all(const OstScene *scene, const OstResult *result, OstWatchedValue **values)
{
    OstContext *ctx = scene->ctx;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, values, scene->c->watch_count)));
    for (int w = 0; w < scene->c->watch_count; w++) {
        const OstWatch *watch = &scene->c->watches[w];
        OstWatched watched;
        OstStatus status = ost_watch_evaluate(scene, result, watch, &watched);
        OST_THEN(warn_of_linear_theory(scene, result, watch, &watched));
        if (status != OST_SUCCESS) {
            OST_FREE(*values);
            return status;
        }
        (*values)[w] = (OstWatchedValue){watch->name,
                                         watched.value,
                                         watch->expected,
                                         watched.error,
                                         result->interest.watch == watch && watch->kind != OST_WATCH_STRAIN_ENERGY &&
                                             result->interest.doubt == 0.0,
                                         watched.placed,
                                         {watched.place[0], watched.place[1], watched.place[2]},
                                         watched.why,
                                         watched.exact,
                                         watched.terms};
    }
    return OST_SUCCESS;
}

/* A sum that cancels is 0 but for rounding. */
static double without_rounding(const OstWatchedValue *watched)
{
    return fabs(watched->value) < 1e-12 * watched->terms ? 0.0 : watched->value;
}

void ost_watch_print(const OstWatchedValue *values, int count)
{
    for (int w = 0; w < count; w++) {
        const double expected = values[w].expected, error = fabs(values[w].error);
        char share[24];
        printf("%-22s %.10g", values[w].name, without_rounding(&values[w]));
        if (values[w].exact)
            printf(", %s", values[w].exact);
        else if (!isnan(error))
            printf(" +- %.2g", error);
        if (!values[w].exact && error <= fabs(values[w].value) && values[w].value != 0.0)
            printf(" (%s)", ost_percent(error / fabs(values[w].value), share, sizeof share));
        if (values[w].why)
            printf(", error not known: %s", values[w].why);
        if (values[w].placed)
            printf(" at (%.6g, %.6g, %.6g)", values[w].place[0], values[w].place[1], values[w].place[2]);
        if (values[w].by_adjoint)
            printf(", with its error added %.10g", values[w].value + values[w].error);
        if (!isnan(expected) && expected != 0.0)
            printf(", expected %.10g: %s off", expected,
                   ost_percent(fabs(values[w].value / expected - 1.0), share, sizeof share));
        puts("");
    }
}
