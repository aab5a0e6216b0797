/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "algebra/solver.h"
#include "assembly/laplacian.h"
#include "assembly/supports.h"
#include "assembly/system.h"
#include "case/case_data.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "material/directions.h"
#include "problem/row_geometry.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* By order. Axes are right to 1e-4 then, far less than they turn from one linear tet to the next, and to 1e-6. */
static const double potential_residual[2] = {1e-5, 1e-7};

/* The two potentials are components 0 and 1 of a displacement. Component 2 repeats the first: a third right-hand side
 * costs less than a matrix with 2×2 blocks. */
static const int potential_of_component[3] = {0, 1, 0};

/* A gradient this small beside the region's mean is rounding; two directions this near to each other are one. */
static const double negligible = 1e-6, parallel_sine = 1e-3;

/* What a boundary's vertices have of each potential: 0, 1, or, where its two boundaries touch, halfway. */
static OstStatus mark_boundary(const OstScene *scene, OstPlace place, const char *name, double value, double *given)
{
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    char *names[1] = {(char *)name};
    OstSelection boundary = {.kind = OST_SELECT_BOUNDARY, .place = place, .boundaries = {1, names}, .tolerance = -1.0};
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &boundary, &count, &nodes));
    for (OstLocal i = 0; i < count; i++)
        given[nodes[i]] = isnan(given[nodes[i]]) || given[nodes[i]] == value ? value : 0.5;
    OST_FREE(nodes);
    return OST_SUCCESS;
}

static OstStatus prescribe_potential(const OstScene *scene, const OstAxesSpec *spec, OstPlace place, int potential,
                                     OstSupports *supports)
{
    const OstMesh *mesh = scene->mesh;
    double *given = NULL;
    OstStatus status = ost_agree(scene->ctx, OST_NEW(scene->ctx, &given, mesh->node_count));
    for (OstLocal n = 0; n < mesh->node_count && status == OST_SUCCESS; n++)
        given[n] = NAN;
    const int source = spec->from[potential] ? potential : 0; /* one potential alone is solved for twice */
    OST_THEN(mark_boundary(scene, place, spec->from[source], 0.0, given));
    OST_THEN(mark_boundary(scene, place, spec->to[source], 1.0, given));
    for (OstLocal n = 0; n < mesh->owned_nodes && status == OST_SUCCESS; n++)
        for (int component = 0; component < 3 && status == OST_SUCCESS; component++) {
            double direction[3] = {0.0};
            direction[component] = 1.0;
            if (potential_of_component[component] == potential && !isnan(given[n]))
                status = ost_supports_constrain(supports, n, direction, given[n]);
        }
    OST_FREE(given);
    return ost_agree(scene->ctx, status);
}

static OstStatus prescribe_potentials(const OstScene *scene, const OstAxesSpec *spec, OstPlace place,
                                      OstSupports **supports)
{
    OST_TRY(ost_agree(scene->ctx, ost_supports_create(scene->mesh, supports)));
    for (int potential = 0; potential < 2; potential++)
        OST_TRY(prescribe_potential(scene, spec, place, potential, *supports));
    return ost_supports_complete(*supports);
}

/* Solves for the potentials; u has them at every local node, three numbers a node. */
static OstStatus solve_potentials(const OstScene *scene, OstSystem *system, double *u)
{
    OstContext *ctx = scene->ctx;
    const size_t unknowns = 3 * (size_t)system->matrix->rows;
    OstRowGeometry rows = {0};
    double *rhs = NULL, *v = NULL;
    OstSolver *solver = NULL;
    OstSolveReport report;
    OstSolverOptions options = scene->c->solver;
    options.relative_residual = potential_residual[scene->mesh->nodes_per_tet == 10];
    OstStatus status = OST_NEW(ctx, &rhs, unknowns);
    OST_THEN(OST_NEW(ctx, &v, unknowns));
    OST_THEN(ost_system_fill_laplacian(system, rhs));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_row_geometry_create(system, NULL, 0, &rows));
    OST_TRY_DONE(ost_solver_create(ctx, system->matrix, &rows.geometry, &options, &solver));
    OST_TRY_DONE(ost_solver_solve(solver, rhs, v, &report));
    OST_TRY_DONE(ost_system_displacement(system, 1.0, v, u));
done:
    ost_solver_destroy(&solver);
    ost_row_geometry_release(&rows);
    OST_FREE(rhs, v);
    return status;
}

/* --- from potentials to axes --- */

/* Gradients of one potential, of each tet; 0 where it has none: all vertices of a tet may lie on one boundary. */
typedef struct Slope {
    double *of_tet;  /* tet_count × 3 */
    double *of_node; /* node_count × 4: sum of the unit directions around it, and how many there are */
} Slope;

static void free_slope(Slope *slope)
{
    OST_FREE(slope->of_tet, slope->of_node);
}

/* Directions of length 1; what is rounding beside the mean gradient of the region is none. */
static OstStatus find_slope(const OstScene *scene, int region, const double *u, int component, Slope *slope)
{
    const OstMesh *mesh = scene->mesh;
    double sum[2] = {0.0, 0.0};
    OstStatus status = OST_NEW(scene->ctx, &slope->of_tet, 3 * (size_t)mesh->tet_count);
    OST_THEN(OST_NEW(scene->ctx, &slope->of_node, 4 * (size_t)mesh->node_count));
    OST_TRY(ost_agree(scene->ctx, status));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        double gradients[9];
        ost_tet_component_gradients(mesh, t, u, gradients);
        memcpy(slope->of_tet + 3 * (size_t)t, gradients + 3 * component, 3 * sizeof *gradients);
        if (mesh->tet_region[t] == region && t < mesh->owned_tets) {
            sum[0] += ost_norm3(gradients + 3 * component);
            sum[1] += 1.0;
        }
    }
    OST_TRY(ost_sum(scene->ctx, 2, sum));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        double *g = slope->of_tet + 3 * (size_t)t;
        const double length = ost_norm3(g);
        const int counts = mesh->tet_region[t] == region && length * sum[1] > negligible * sum[0];
        for (int i = 0; i < 3; i++)
            g[i] = counts ? g[i] / length : 0.0;
    }
    return OST_SUCCESS;
}

static int is_zero(const double g[3])
{
    return g[0] == 0.0 && g[1] == 0.0 && g[2] == 0.0;
}

/* Mean directions around each node, from all tets there; on ghosts those of their owners. */
static OstStatus average(const OstScene *scene, Slope *slope)
{
    const OstMesh *mesh = scene->mesh;
    memset(slope->of_node, 0, 4 * (size_t)mesh->node_count * sizeof *slope->of_node);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const double *g = slope->of_tet + 3 * (size_t)t;
        if (is_zero(g))
            continue;
        for (int v = 0; v < 4; v++) {
            double *at = slope->of_node + 4 * (size_t)ost_mesh_nodes_of(mesh, t)[v];
            for (int i = 0; i < 3; i++)
                at[i] += g[i];
            at[3] += 1.0;
        }
    }
    return ost_halo_import(mesh->halo, 4 * sizeof *slope->of_node, slope->of_node);
}

/* Tets without a direction take the mean of those around them, as often as some are left that have such neighbours. */
static OstStatus fill_slope(const OstScene *scene, int region, Slope *slope)
{
    const OstMesh *mesh = scene->mesh;
    for (OstGlobal before = INT64_MAX;;) {
        OstGlobal missing = 0;
        for (OstLocal t = 0; t < mesh->owned_tets; t++)
            missing += mesh->tet_region[t] == region && is_zero(slope->of_tet + 3 * (size_t)t);
        OST_TRY(ost_sum_numbers(scene->ctx, 1, &missing));
        if (missing == 0 || missing == before)
            return OST_SUCCESS;
        before = missing;
        OST_TRY(average(scene, slope));
        for (OstLocal t = 0; t < mesh->tet_count; t++) {
            double *g = slope->of_tet + 3 * (size_t)t, mean[3] = {0.0};
            if (mesh->tet_region[t] != region || !is_zero(g))
                continue;
            for (int v = 0; v < 4; v++)
                for (int i = 0; i < 3; i++)
                    mean[i] += slope->of_node[4 * (size_t)ost_mesh_nodes_of(mesh, t)[v] + (size_t)i];
            const double length = ost_norm3(mean);
            for (int i = 0; i < 3; i++)
                g[i] = length > negligible ? mean[i] / length : 0.0;
        }
    }
}

/* Where the second direction is nearly along the first, as in a corner between boundaries, it counts as missing. */
static void drop_parallel(const OstMesh *mesh, const Slope *first, Slope *second)
{
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const double *a = first->of_tet + 3 * (size_t)t;
        double *b = second->of_tet + 3 * (size_t)t;
        double across[3];
        ost_cross3(a, b, across);
        if (ost_norm3(across) < parallel_sine)
            b[0] = b[1] = b[2] = 0.0;
    }
}

/* The mean square of the angle by which directions turn from one tet to the next, by the mean of unit directions around
 * each node, whose length is about 1 - angle²/2. */
static OstStatus find_turns(const OstScene *scene, Slope *slope, double *square)
{
    double sums[2] = {0.0};
    OST_TRY(average(scene, slope));
    for (OstLocal n = 0; n < scene->mesh->owned_nodes; n++) {
        const double *at = slope->of_node + 4 * (size_t)n;
        sums[0] += 2.0 * fmax(at[3] - ost_norm3(at), 0.0);
        sums[1] += at[3];
    }
    OST_TRY(ost_sum(scene->ctx, 2, sums));
    *square = sums[1] > 0.0 ? sums[0] / sums[1] : 0.0;
    return OST_SUCCESS;
}

/* Axes are uniform in each linear tet, and no estimate sees what that makes of the answer: where they turned by an
 * angle from one tet to the next, a spindle 100 times stiffer along had forces off by 0.07 angle² times that ratio. */
static void warn_of_turns(const OstScene *scene, int region, double square)
{
    static const double too_much = 0.3;
    const char *name = scene->mesh->regions.name[region];
    const double *modulus = ost_case_material_of(scene->c, name)->material.constants.youngs_modulus;
    const double most = fmax(modulus[0], fmax(modulus[1], modulus[2]));
    const double ratio = most / fmin(modulus[0], fmin(modulus[1], modulus[2]));
    if (ratio * square > too_much)
        ost_warn(
            scene->ctx,
            "the mesh is coarse for the axes of region '%.80s' ('gradient'), which turn by %.2g degrees from tet to "
            "tet where the body is %.3g times stiffer along one: no estimate of the error sees that; refine it "
            "(mesh: {refine: 1}) and compare",
            name, sqrt(square) * 180.0 / M_PI, ratio);
}

static OstStatus raise_for_tet(const OstScene *scene, int region, OstLocal tet)
{
    const char *name = scene->mesh->regions.name[region];
    char reason[512];
    snprintf(reason, sizeof reason, "%s", ost_error_text(scene->ctx));
    return ost_case_located(
        scene->c, ost_case_material_of(scene->c, name)->axes_place,
        OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                  "gradient axes of region '%s', tet %lld: %s; its boundaries must differ, reach every connected "
                  "component of the region, and, for two, lie across each other",
                  name, (long long)ost_mesh_tet_number(scene->mesh, tet), reason));
}

/* Directions within the tets are the gradients there, which are right in the mean to the third order. (Linear between
 * the vertices of curved tets, they turned to one side throughout: displacements converged with the second order.) */
static void set_directions(const OstScene *scene, int region, const OstAxesSpec *spec, const double *u,
                           OstTetAxes *axes)
{
    const OstMesh *mesh = scene->mesh;
    const int two = spec->from[1] != NULL;
    int along[2];
    ost_directions_along(spec->along, two, along);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        double first[30], second[30];
        if (mesh->tet_region[t] != region)
            continue;
        ost_tet_node_gradients(mesh, t, u, 0, first);
        if (two)
            ost_tet_node_gradients(mesh, t, u, 1, second);
        ost_directions_set(axes->of_tet + 9 * (size_t)t, along, first, two ? second : NULL,
                           axes->directions + OST_DIRECTIONS * (size_t)t);
    }
}

static OstStatus axes_from_potentials(const OstScene *scene, int region, const OstAxesSpec *spec, const double *u,
                                      OstTetAxes *axes)
{
    const OstMesh *mesh = scene->mesh;
    const int two = spec->from[1] != NULL;
    Slope slope[2] = {{NULL, NULL}, {NULL, NULL}};
    double turned[2] = {0.0};
    OstStatus status = OST_SUCCESS;
    for (int p = 0; p <= two; p++) {
        OST_TRY_DONE(find_slope(scene, region, u, p, &slope[p]));
        if (p == 1)
            drop_parallel(mesh, &slope[0], &slope[1]);
        OST_TRY_DONE(fill_slope(scene, region, &slope[p]));
        if (!axes->directions)
            OST_TRY_DONE(find_turns(scene, &slope[p], &turned[p]));
    }
    if (!axes->directions)
        warn_of_turns(scene, region, fmax(turned[0], turned[1]));
    for (OstLocal t = 0; t < mesh->tet_count && status == OST_SUCCESS; t++)
        if (mesh->tet_region[t] == region &&
            ost_axes_from_directions(scene->ctx, spec->along, slope[0].of_tet + 3 * (size_t)t,
                                     two ? slope[1].of_tet + 3 * (size_t)t : NULL,
                                     axes->of_tet + 9 * (size_t)t) != OST_SUCCESS)
            status = raise_for_tet(scene, region, t);
    if (status == OST_SUCCESS && axes->directions)
        set_directions(scene, region, spec, u, axes);
    status = ost_agree(scene->ctx, status);
done:
    free_slope(&slope[0]);
    free_slope(&slope[1]);
    return status;
}

/* Those that an isotropic material has no use for, which no potential is solved for. */
OstStatus ost_scene_check_gradients(const OstScene *scene)
{
    for (int m = 0; m < scene->c->material_count; m++) {
        const OstCaseMaterial *stated = &scene->c->materials[m];
        OstSupports *supports = NULL;
        if (stated->axes.kind != OST_AXES_GRADIENT || !stated->material.isotropic)
            continue;
        const OstStatus status = prescribe_potentials(scene, &stated->axes, stated->axes_place, &supports);
        ost_supports_destroy(&supports);
        OST_TRY(status);
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_gradient_axes(const OstScene *scene, int region, const OstAxesSpec *spec, OstTetAxes *axes)
{
    OstContext *ctx = scene->ctx;
    OstSupports *supports = NULL;
    OstSystem *system = NULL;
    double *u = NULL;
    OstStatus status = OST_SUCCESS;
    const OstCaseMaterial *stated = ost_case_material_of(scene->c, scene->mesh->regions.name[region]);
    OST_TRY_DONE(prescribe_potentials(scene, spec, stated->axes_place, &supports));
    OST_TRY_DONE(ost_system_create(scene->mesh, supports, &system));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &u, 3 * (size_t)scene->mesh->node_count)));
    OST_TRY_DONE(solve_potentials(scene, system, u));
    OST_TRY_DONE(axes_from_potentials(scene, region, spec, u, axes));
done:
    OST_FREE(u);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    return status;
}
