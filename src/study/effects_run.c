/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/effects.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "core/small.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Nodes by their labels, which do not depend on the partition: that follows the materials, which differ between runs.
 */
typedef struct PlacedNode {
    OstGlobal label;
    double displacement[3];
} PlacedNode;

typedef struct Pose {
    OstLocal count;
    PlacedNode *node; /* ascending labels: those that leave this rank's number when divided by the number of ranks */
} Pose;

/* Collective. */
static OstStatus take_pose(const OstMesh *mesh, const double *displacement, Pose *pose)
{
    OstContext *ctx = mesh->ctx;
    const size_t owned = (size_t)mesh->owned_nodes;
    int *to = NULL;
    PlacedNode *mine = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_NEW(ctx, &to, owned);
    OST_THEN(OST_NEW(ctx, &mine, owned));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t n = 0; n < owned; n++) {
        to[n] = (int)(mesh->node_label[n] % ost_size(ctx));
        mine[n].label = mesh->node_label[n];
        memcpy(mine[n].displacement, displacement + 3 * n, sizeof mine[n].displacement);
    }
    OST_TRY_DONE(ost_route_create(ctx, mesh->owned_nodes, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *mine, mine, (void **)&pose->node));
    pose->count = route->receives;
    qsort(pose->node, (size_t)pose->count, sizeof *pose->node, ost_compare_numbers);
done:
    ost_route_destroy(&route);
    OST_FREE(mine, to);
    return status;
}

/* Collective. The largest |u - u0| over the largest |u0|. */
static OstStatus compare_poses(OstContext *ctx, const Pose *pose, const Pose *base, double *change)
{
    double largest[2] = {0.0};
    int same = pose->count == base->count;
    for (OstLocal n = 0; same && n < pose->count; n++) {
        const PlacedNode *a = &pose->node[n], *b = &base->node[n];
        double apart[3];
        same = a->label == b->label;
        for (int i = 0; i < 3; i++)
            apart[i] = a->displacement[i] - b->displacement[i];
        largest[0] = fmax(largest[0], ost_norm3(apart));
        largest[1] = fmax(largest[1], ost_norm3(b->displacement));
    }
    OST_TRY(ost_agree(ctx, same ? OST_SUCCESS
                                : OST_RAISE(ctx, OST_CHECK_FAILED,
                                            "a run with an effect left out has other nodes than the case itself")));
    OST_TRY(ost_max(ctx, 2, largest));
    *change = largest[1] > 0.0 ? largest[0] / largest[1] : NAN;
    return OST_SUCCESS;
}

static OstStatus evaluate(const OstScene *scene, const OstResult *result, OstEffectRun *run)
{
    run->unknowns = result->unknowns;
    run->iterations = result->solve.iterations;
    run->large_rotation = result->newton.used;
    run->energy = result->checks.strain_energy;
    OST_TRY(ost_energy_scale(result, &run->energy_scale));
    for (int w = 0; w < scene->c->watch_count; w++)
        OST_TRY(ost_watch_evaluate(scene, result, &scene->c->watches[w], &run->watched[w]));
    return OST_SUCCESS;
}

/* Collective. Solves a case; the scene is kept for whoever wants its means, otherwise `kept` is NULL. */
static OstStatus solve(const OstCase *c, OstEffectRun *run, Pose *pose, OstScene **kept)
{
    OstContext *ctx = c->ctx;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_meter_start(ctx, &run->meter));
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(ost_scene_solve(scene, &result));
    OST_TRY_DONE(ost_meter_read(ctx, &run->meter));
    OST_TRY_DONE(evaluate(scene, result, run));
    OST_TRY_DONE(take_pose(scene->mesh, result->displacement, pose));
    run->state = OST_VARIANT_SOLVED;
    if (kept) {
        *kept = scene;
        scene = NULL;
    }
done:
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

static double relative(double value, double base, double scale)
{
    const double size = fmax(fabs(base), scale);
    return size > 0.0 ? fabs(value - base) / size : value == base ? 0.0 : INFINITY;
}

/* The energy of a run becomes its change. A quantity that is nearly zero is compared with the size of its kind. */
static void compare(const OstEffectStudy *study, OstEffectRun *run)
{
    static const double negligible =
        1e-6; /* of the size of its kind: a zero by symmetry, as is one of its error's size */
    const OstEffectRun *base = &study->base;
    const int no_energy = fabs(base->energy) <= negligible * base->energy_scale;
    run->energy = relative(run->energy, base->energy, no_energy ? base->energy_scale : 0.0);
    for (int w = 0; w < study->c->watch_count; w++) {
        const OstWatched *watched = &base->watched[w];
        const double error = isnan(watched->error) ? 0.0 : fabs(watched->error);
        const int is_zero = fabs(watched->value) <= fmax(negligible * watched->scale, error);
        run->watch[w] = relative(run->watched[w].value, watched->value, is_zero ? watched->scale : 0.0);
    }
}

static OstStatus run_variant(OstEffectStudy *study, const OstScene *scene, OstVariant variant, const Pose *base)
{
    OstContext *ctx = study->ctx;
    const OstLogLevel level = ost_log_level(ctx);
    const char *unmeasured = ost_variant_why_unmeasured(&scene->plan.effects, variant);
    OstEffectRun *run = &study->run[variant];
    OstVariantCase made;
    Pose pose = {0, NULL};
    if (unmeasured) {
        run->state = OST_VARIANT_UNMEASURED;
        snprintf(run->reason, sizeof run->reason, "%s", unmeasured);
        return OST_SUCCESS;
    }
    OstStatus status = ost_variant_case(scene, variant, &made);
    if (level == OST_LOG_NORMAL) /* the warnings of the case itself have been said */
        ost_log_set_level(ctx, OST_LOG_QUIET);
    OST_THEN(solve(&made.c, run, &pose, NULL));
    ost_log_set_level(ctx, level);
    OST_THEN(compare_poses(ctx, &pose, base, &run->pose));
    if (status == OST_SUCCESS) {
        compare(study, run);
    } else {
        run->state = OST_VARIANT_FAILED;
        snprintf(run->reason, sizeof run->reason, "%s", ost_error_text(ctx));
    }
    OST_FREE(pose.node);
    ost_variant_case_release(&made);
    return status == OST_OUT_OF_MEMORY ? status : OST_SUCCESS;
}

OstStatus ost_effect_study(const OstCase *c, OstEffectStudy *study)
{
    OstContext *ctx = c->ctx;
    OstScene *scene = NULL;
    Pose base = {0, NULL};
    OstStatus status = OST_SUCCESS;
    OstCase exact = *c; /* small changes must not drown in what a stopped solve leaves */
    exact.solver.algebraic_fraction = 0.0;
    *study = (OstEffectStudy){.ctx = ctx, .c = c};
    OST_TRY_DONE(solve(&exact, &study->base, &base, &scene));
    for (int v = 0; v < OST_VARIANT_COUNT; v++) {
        ost_progress_task(ctx, ost_variant_label[v], v + 1, OST_VARIANT_COUNT + 1);
        if (ost_variant_applies(study, &scene->plan.effects, (OstVariant)v))
            OST_TRY_DONE(run_variant(study, scene, (OstVariant)v, &base));
    }
done:
    ost_progress_task(ctx, "", 0, 0);
    OST_FREE(base.node);
    ost_scene_destroy(&scene);
    return status;
}

/* The largest; one that has no number counts where none of the others is above the accuracy asked for. */
double ost_effect_change(const OstEffectStudy *study, const OstEffectRun *run)
{
    double most = fmax(run->pose, run->energy);
    int endless = 0;
    for (int w = 0; w < study->c->watch_count; w++) {
        endless |= isinf(run->watch[w]);
        most = isinf(run->watch[w]) ? most : fmax(most, run->watch[w]);
    }
    return endless && !(most > study->c->relative_error) ? INFINITY : most;
}
