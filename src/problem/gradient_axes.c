/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "algebra/solver.h"
#include "assembly/laplacian.h"
#include "assembly/supports.h"
#include "assembly/system.h"
#include "case/case_data.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "problem/row_geometry.h"

#include <string.h>

/* Accurate enough that the error of the axes does not limit that of the displacement. */
static const double potential_residual = 1e-10;

/* The two potentials are components 0 and 1 of a displacement. Component 2 repeats the first: a third right-hand side
 * costs less than a matrix with 2×2 blocks. */
static const int potential_of_component[3] = {0, 1, 0};

static const OstGlobal none_shared = INT64_MAX;

static OstStatus prescribe_potential(const OstScene *scene, const char *name, int potential, double value,
                                     OstSupports *supports)
{
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    char *names[1] = {(char *)name};
    OstSelection boundary = {.kind = OST_SELECT_BOUNDARY, .boundaries = {1, names}, .tolerance = -1.0};
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &boundary, &count, &nodes));
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++) {
        for (int component = 0; component < 3 && status == OST_SUCCESS; component++) {
            if (potential_of_component[component] != potential || nodes[i] >= scene->mesh->owned_nodes)
                continue;
            double direction[3] = {0.0};
            direction[component] = 1.0;
            status = ost_supports_constrain(supports, nodes[i], direction, value);
        }
    }
    OST_FREE(nodes);
    return ost_agree(scene->ctx, status);
}

/* The lowest label among the vertices in both boundaries, or none_shared. */
static OstStatus find_shared(const OstScene *scene, OstPlace place, const OstAxesSpec *spec, int potential,
                             OstGlobal *shared)
{
    const OstMesh *mesh = scene->mesh;
    unsigned char *flags[2] = {NULL, NULL};
    *shared = none_shared;
    OstStatus status = OST_SUCCESS;
    for (int side = 0; side < 2; side++) {
        char *names[1] = {side == 0 ? spec->from[potential] : spec->to[potential]};
        const OstSelection boundary = {
            .kind = OST_SELECT_BOUNDARY, .place = place, .boundaries = {1, names}, .tolerance = -1.0};
        OST_TRY_DONE(ost_select_flags(scene->c, mesh, &boundary, &flags[side]));
    }
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        if (flags[0][n] && flags[1][n] && mesh->node_label[n] < *shared)
            *shared = mesh->node_label[n];
    status = OST_MPI(scene->ctx, MPI_Allreduce(MPI_IN_PLACE, shared, 1, MPI_INT64_T, MPI_MIN, ost_comm(scene->ctx)));
done:
    OST_FREE(flags[0]);
    OST_FREE(flags[1]);
    return status;
}

static OstStatus check_apart(const OstScene *scene, int region, const OstAxesSpec *spec)
{
    const OstPlace place = ost_case_material_of(scene->c, scene->mesh->regions.name[region])->axes_place;
    for (int potential = 0; potential < 2; potential++) {
        OstGlobal shared;
        OST_TRY(find_shared(scene, place, spec, potential, &shared));
        if (shared != none_shared)
            return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                             "%s:%d:%d: gradient axes of region '%s', e%d: the boundaries '%s' and '%s' share vertex "
                             "%lld; a potential needs two boundaries that do not touch",
                             scene->c->path, place.line, place.column, scene->mesh->regions.name[region], potential + 1,
                             spec->from[potential], spec->to[potential], (long long)shared);
    }
    return OST_SUCCESS;
}

static OstStatus prescribe_potentials(const OstScene *scene, const OstAxesSpec *spec, OstSupports **supports)
{
    OST_TRY(ost_agree(scene->ctx, ost_supports_create(scene->mesh, supports)));
    for (int potential = 0; potential < 2; potential++) {
        OST_TRY(prescribe_potential(scene, spec->from[potential], potential, 0.0, *supports));
        OST_TRY(prescribe_potential(scene, spec->to[potential], potential, 1.0, *supports));
    }
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
    options.relative_residual = potential_residual;
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
    OST_FREE(rhs);
    OST_FREE(v);
    return status;
}

static OstStatus axes_from_potentials(const OstScene *scene, int region, const double *u, double *axes)
{
    const OstMesh *mesh = scene->mesh;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        if (mesh->tet_region[t] != region)
            continue;
        double gradients[9];
        ost_tet_component_gradients(mesh, t, u, gradients);
        if (ost_axes_from_gradients(scene->ctx, gradients, gradients + 3, axes + 9 * (size_t)t) != OST_SUCCESS) {
            char reason[256];
            strncpy(reason, ost_error_text(scene->ctx), sizeof reason - 1);
            reason[sizeof reason - 1] = '\0';
            return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "gradient axes of region '%s', tet %lld: %s",
                             mesh->regions.name[region], (long long)mesh->tet_label[t], reason);
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_gradient_axes(const OstScene *scene, int region, const OstAxesSpec *spec, double *axes)
{
    OstContext *ctx = scene->ctx;
    OstSupports *supports = NULL;
    OstSystem *system = NULL;
    double *u = NULL;
    OstStatus status = check_apart(scene, region, spec);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(prescribe_potentials(scene, spec, &supports));
    OST_TRY_DONE(ost_system_create(scene->mesh, supports, &system));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &u, 3 * (size_t)scene->mesh->node_count)));
    OST_TRY_DONE(solve_potentials(scene, system, u));
    OST_TRY_DONE(ost_agree(ctx, axes_from_potentials(scene, region, u, axes)));
done:
    OST_FREE(u);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    return status;
}
