/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/watch.h"

#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "element/element.h"
#include "probe/sample.h"
#include "recovery/derived.h"
#include "recovery/recovery.h"

#include <math.h>
#include <string.h>

/* What is found of the tets of a region, on this rank and then on all. */
typedef struct Over {
    double sum, volume; /* value times volume */
    double more;        /* what the estimate adds to the sum */
    double best;        /* the least value, or the largest one's negative */
    OstGlobal tet;      /* the lowest label of those that have it, but for rounding */
    int region;         /* its */
    double place[3];
    double size; /* the largest von Mises stress; of load factors the least */
} Over;

static int is_in(const OstWatch *watch, const OstMesh *mesh, OstLocal tet)
{
    return ost_is_every_region(watch->region) || strcmp(mesh->regions.name[mesh->tet_region[tet]], watch->region) == 0;
}

static OstStatus value_at(const OstResult *result, const OstWatch *watch, OstLocal tet, const double stress[6],
                          double *value)
{
    if (watch->kind == OST_WATCH_STRESS)
        return ost_stress_measure(result, tet, stress, (OstStressMeasure)watch->component, value);
    *value = OST_MOST_LOAD_FACTOR;
    for (int c = 0; c < OST_CRITERIA; c++)
        if (watch->component == c || watch->component == OST_CRITERIA)
            *value = fmin(*value, ost_result_load_factor(result, tet, (OstCriterion)c, stress));
    return OST_SUCCESS;
}

static OstStatus value_of(const OstResult *result, const OstWatch *watch, OstLocal tet, double *value)
{
    return value_at(result, watch, tet, result->stress + 6 * (size_t)tet, value);
}

/* A mean along material axes is that along the axes as they vary within the tet. */
static int varies(const OstWatch *watch)
{
    return watch->take == OST_TAKE_MEAN && watch->kind == OST_WATCH_STRESS &&
           watch->component >= (int)OST_STRESS_MEASURE_11 && watch->component <= (int)OST_STRESS_MEASURE_31;
}

/* A load factor is made of stresses along the material axes. */
static OstStressMeasure measure_of(const OstWatch *watch)
{
    return watch->kind == OST_WATCH_STRESS ? (OstStressMeasure)watch->component : OST_STRESS_MEASURE_11;
}

/* What the estimate adds to the value: of measures that are linear, as the error's stress varies
 * far more than its mean. */
static OstStatus surplus_of(const OstResult *result, const OstWatch *watch, OstLocal tet, double value, double *more)
{
    double stress[6];
    *more = NAN;
    const int is_linear =
        watch->component < (int)OST_STRESS_MEASURE_VON_MISES || watch->component == (int)OST_STRESS_MEASURE_PRESSURE;
    if (!result->stress_surplus || !is_linear || watch->kind != OST_WATCH_STRESS)
        return OST_SUCCESS;
    for (size_t p = 0; p < 6; p++)
        stress[p] = result->stress[6 * (size_t)tet + p] + result->stress_surplus[6 * (size_t)tet + p];
    ost_turn_with_error(result, tet, (OstStressMeasure)watch->component, 1, stress);
    OST_TRY(ost_stress_measure(result, tet, stress, (OstStressMeasure)watch->component, more));
    *more -= value;
    if (varies(watch) && result->along_axes_surplus)
        *more += result->along_axes_surplus[6 * (size_t)tet + (size_t)(watch->component - (int)OST_STRESS_MEASURE_11)];
    return OST_SUCCESS;
}

static double volume_of(const OstMesh *mesh, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double x[3 * OST_MAX_TET_NODES];
    for (int a = 0; a < mesh->nodes_per_tet; a++)
        memcpy(x + 3 * a, mesh->coordinates + 3 * (size_t)nodes[a], 3 * sizeof *x);
    return fabs(ost_element_of(mesh->nodes_per_tet)->volume(x));
}

static OstStatus go_over(const OstResult *result, const OstWatch *watch, double sign, Over *over)
{
    const OstMesh *mesh = result->mesh;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        double value, more, own[6];
        if (!is_in(watch, mesh, tet))
            continue;
        OST_TRY(value_of(result, watch, tet, &value));
        OST_TRY(surplus_of(result, watch, tet, value, &more));
        if (varies(watch)) {
            ost_tet_mean_along_axes(result, tet, own);
            value = own[watch->component - (int)OST_STRESS_MEASURE_11];
        }
        const double volume = volume_of(mesh, tet);
        over->sum += volume * value;
        over->more += volume * more;
        over->volume += volume;
        over->best = fmin(over->best, sign * value);
        over->size = fmax(over->size, ost_von_mises(result->stress + 6 * (size_t)tet));
    }
    return OST_SUCCESS;
}

/* The tet of the least value: of those that have it but for rounding, the one with the lowest label. */
static OstStatus find_place(const OstResult *result, const OstWatch *watch, double sign, Over *over)
{
    static const double alike = 1e-9;
    const OstMesh *mesh = result->mesh;
    over->tet = INT64_MAX;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        double value;
        if (!is_in(watch, mesh, tet) || mesh->tet_label[tet] > over->tet)
            continue;
        OST_TRY(value_of(result, watch, tet, &value));
        if (sign * value > over->best + alike * over->size)
            continue;
        over->tet = mesh->tet_label[tet];
        over->region = mesh->tet_region[tet];
        ost_tet_centre(mesh, tet, over->place);
    }
    return OST_SUCCESS;
}

/* Tells all ranks of the place, and of the tet's region, by the rank that has the tet of the lowest label. */
static OstStatus share_place(const OstResult *result, Over *over)
{
    OstContext *ctx = result->ctx;
    OstGlobal lowest = over->tet;
    OST_TRY(ost_min_numbers(ctx, 1, &lowest));
    int holder = over->tet == lowest ? ost_rank(ctx) : -1;
    OST_TRY(ost_max_ints(ctx, 1, &holder));
    double told[4] = {over->place[0], over->place[1], over->place[2], over->region};
    OST_TRY(OST_MPI(ctx, MPI_Bcast(told, 4, MPI_DOUBLE, holder, ost_comm(ctx))));
    memcpy(over->place, told, sizeof over->place);
    over->region = (int)told[3];
    return OST_SUCCESS;
}

/* Adds a tet's stress at its vertices, with what the estimate adds to it, times the volume; the volume comes
 * last. Of owned nodes: all of their tets are here. */
static void add_better(const OstResult *result, OstLocal tet, OstStressMeasure measure, double *sums)
{
    const OstMesh *mesh = result->mesh;
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    const float *surplus = result->node_stress_surplus + 6 * (size_t)mesh->nodes_per_tet * (size_t)tet;
    const double volume = fabs(ost_tet_volume(mesh->coordinates, nodes));
    double at_nodes[6 * OST_MAX_TET_NODES];
    ost_tet_nodal_stress(result, tet, at_nodes);
    for (int n = 0; n < 24; n++)
        at_nodes[n] += (double)surplus[n];
    ost_turn_with_error(result, tet, measure, 4, at_nodes);
    for (size_t a = 0; a < 4; a++) {
        double *sum = sums + 7 * (size_t)nodes[a];
        for (size_t p = 0; p < 6 && nodes[a] < mesh->owned_nodes; p++)
            sum[p] += volume * at_nodes[6 * a + p];
        if (nodes[a] < mesh->owned_nodes)
            sum[6] += volume;
    }
}

/* Each vertex's mean stress in a region, ghosts' too; 0 where the region is not. Collective. */
static OstStatus mean_at_vertices(const OstResult *result, OstStressMeasure measure, int region, double *means)
{
    const OstMesh *mesh = result->mesh;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++)
        if (mesh->tet_region[tet] == region)
            add_better(result, tet, measure, means);
    for (size_t n = 0; n < 7 * (size_t)mesh->owned_nodes; n++)
        if (n % 7 < 6 && means[n - n % 7 + 6] > 0.0)
            means[n] /= means[n - n % 7 + 6];
    return ost_halo_import(mesh->halo, 7 * sizeof *means, means);
}

/* The least of the means at vertices, which many tets share: stresses of single ones scatter. Of the owned tets:
 * ghosts have no turned axes. */
static OstStatus least_of_means(const OstResult *result, const OstWatch *watch, double sign, int region,
                                const double *means, double *least)
{
    const OstMesh *mesh = result->mesh;
    *least = INFINITY;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        for (int a = 0; a < 4 && mesh->tet_region[tet] == region; a++) {
            double value;
            OST_TRY(value_at(result, watch, tet, means + 7 * (size_t)ost_mesh_nodes_of(mesh, tet)[a], &value));
            *least = fmin(*least, sign * value);
        }
    return OST_SUCCESS;
}

/* By how much the exact extreme is larger: that of stresses with what the estimate adds to them. */
static OstStatus find_beyond(const OstResult *result, const OstWatch *watch, double sign, const Over *over,
                             double *error)
{
    OstContext *ctx = result->ctx;
    double *means = NULL, least = NAN;
    *error = NAN;
    if (!result->node_stress_surplus)
        return OST_SUCCESS;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &means, 7 * (size_t)result->mesh->node_count));
    OST_THEN(ost_agree(ctx, mean_at_vertices(result, measure_of(watch), over->region, means)));
    OST_THEN(ost_agree(ctx, least_of_means(result, watch, sign, over->region, means, &least)));
    OST_THEN(ost_min(ctx, 1, &least));
    OST_FREE(means);
    *error = sign * (least - over->best);
    return status;
}

static OstStatus of_region(const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    OstContext *ctx = result->ctx;
    const double sign = watch->take == OST_TAKE_LARGEST ? -1.0 : 1.0;
    Over over = {.best = INFINITY};
    OST_TRY(ost_agree(ctx, go_over(result, watch, sign, &over)));
    double sums[3] = {over.sum, over.volume, over.more};
    OST_TRY(ost_sum(ctx, 3, sums));
    OST_TRY(ost_min(ctx, 1, &over.best));
    OST_TRY(ost_max(ctx, 1, &over.size));
    if (watch->kind == OST_WATCH_LOAD_FACTOR)
        over.size = over.best;
    watched->scale = over.size;
    watched->value = watch->take == OST_TAKE_MEAN ? sums[0] / sums[1] : sign * over.best;
    if (watch->take == OST_TAKE_MEAN) {
        watched->error = sums[2] / sums[1];
        return OST_SUCCESS;
    }
    if (watch->kind == OST_WATCH_LOAD_FACTOR && !(over.best < OST_MOST_LOAD_FACTOR)) {
        *watched = (OstWatched){.value = INFINITY, .exact = "as nothing fails there"};
        return OST_SUCCESS;
    }
    OST_TRY(ost_agree(ctx, find_place(result, watch, sign, &over)));
    OST_TRY(share_place(result, &over));
    OST_TRY(find_beyond(result, watch, sign, &over, &watched->error));
    watched->placed = 1;
    memcpy(watched->place, over.place, sizeof over.place);
    return OST_SUCCESS;
}

OstStatus ost_watch_stress(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    OstSample sample;
    watched->error = NAN;
    if (watch->region && !result->stress)
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d: the stress was not recovered", scene->c->path,
                         watch->line);
    if (watch->region)
        return of_region(result, watch, watched);
    OST_TRY(ost_sample_points(result, 1, watch->at, &sample));
    watched->value = sample.stress[watch->component];
    watched->error = sample.stress_error[watch->component];
    watched->scale = sample.stress[OST_STRESS_MEASURE_VON_MISES];
    return OST_SUCCESS;
}

static OstStatus check_region(const OstScene *scene, const OstWatch *watch)
{
    const OstCase *c = scene->c;
    const OstNames *regions = &scene->mesh->regions;
    const int everywhere = ost_is_every_region(watch->region);
    int strong = watch->kind != OST_WATCH_LOAD_FACTOR;
    if (!everywhere && ost_names_find(regions, watch->region) < 0)
        return ost_raise_no_region(c, watch->region_place, regions, watch->region);
    for (int m = 0; m < c->material_count; m++)
        strong |= c->materials[m].material.strength.known &&
                  (everywhere || ost_case_material_of(c, watch->region) == &c->materials[m]);
    return strong ? OST_SUCCESS
                  : OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                              "%s:%d: '%s' is a load factor to failure of %s%s, of which no material has 'strengths'",
                              c->path, watch->line, watch->name, everywhere ? "the body" : "region ",
                              everywhere ? "" : watch->region);
}

static OstStatus warn_of_axes(const OstScene *scene, const OstWatch *watch, const OstLocated *located)
{
    int region = located->tet >= 0 ? scene->mesh->tet_region[located->tet] : -1;
    OST_TRY(ost_max_ints(scene->ctx, 1, &region));
    ost_warn_arbitrary_point(scene->c, watch, scene->mesh->regions.name[region]);
    return OST_SUCCESS;
}

/* The vertices of a tet between which a point of its border lies, in `corner` (INT64_MAX: of other ranks; -1: none). */
static void find_corners(const OstMesh *mesh, const OstLocated *located, OstGlobal corner[4])
{
    static const double rounding = 1e-9;
    for (int k = 0; k < 4; k++) {
        corner[k] = INT64_MAX;
        if (located->tet >= 0)
            corner[k] = located->at[k] > rounding ? mesh->node_number[ost_mesh_nodes_of(mesh, located->tet)[k]] : -1;
    }
}

static int has_corners(const OstMesh *mesh, OstLocal tet, const OstGlobal corner[4])
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    int all = 1;
    for (int k = 0; k < 4 && all; k++) {
        int found = corner[k] < 0;
        for (int a = 0; a < 4; a++)
            found |= mesh->node_number[nodes[a]] == corner[k];
        all = found;
    }
    return all;
}

static int have_one_material(const OstScene *scene, int region, int other)
{
    const OstCaseMaterial *material = ost_case_material_of(scene->c, scene->mesh->regions.name[region]);
    return material && material == ost_case_material_of(scene->c, scene->mesh->regions.name[other]);
}

/* On the border of two materials the stress jumps. */
static OstStatus warn_of_border(const OstScene *scene, const OstWatch *watch, const OstLocated *located)
{
    const OstMesh *mesh = scene->mesh;
    char *const *name = mesh->regions.name;
    OstGlobal corner[4];
    int own = located->tet >= 0 ? mesh->tet_region[located->tet] : -1, other = -1;
    find_corners(mesh, located, corner);
    OST_TRY(ost_min_numbers(scene->ctx, 4, corner));
    OST_TRY(ost_max_ints(scene->ctx, 1, &own));
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        if (mesh->tet_region[tet] > other && mesh->tet_region[tet] != own && has_corners(mesh, tet, corner) &&
            !have_one_material(scene, own, mesh->tet_region[tet]))
            other = mesh->tet_region[tet];
    OST_TRY(ost_max_ints(scene->ctx, 1, &other));
    if (other >= 0)
        ost_warn(scene->ctx,
                 "'%s' is at a point on the border of the regions '%.60s' and '%.60s', where stresses may jump: it is "
                 "that in '%.60s'; move the point a little into the one that is meant",
                 watch->name, name[own], name[other], name[own]);
    return OST_SUCCESS;
}

OstStatus ost_watch_check_stress(const OstScene *scene, const OstWatch *watch)
{
    OstLocated located;
    if (watch->region)
        return check_region(scene, watch);
    OST_TRY(ost_locate(scene->mesh, 1, watch->at, &located));
    if (located.label > 0)
        OST_TRY(warn_of_border(scene, watch, &located));
    return located.label > 0
               ? warn_of_axes(scene, watch, &located)
               : OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d: '%s' is at (%g, %g, %g), which is outside the body",
                           scene->c->path, watch->line, watch->name, watch->at[0], watch->at[1], watch->at[2]);
}
