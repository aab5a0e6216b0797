/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/coarse_space.h"

#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "orthostat/refine.h"

#include <string.h>

void ost_linear_space_destroy(OstLinearSpace **space)
{
    if (!*space)
        return;
    ost_system_destroy(&(*space)->system);
    ost_supports_destroy(&(*space)->supports);
    ost_mesh_destroy(&(*space)->mesh);
    ost_row_geometry_release(&(*space)->rows);
    OST_FREE((*space)->node_of_vertex, (*space)->parents, (*space)->weights);
    OST_FREE(*space);
}

/* Does any vertex of the body have unknowns of its own? */
static OstStatus has_free_vertex(const OstLinearSpace *space, int *has)
{
    const OstMesh *mesh = space->mesh;
    OstContext *ctx = mesh->ctx;
    const OstSupports *supports = space->supports;
    *has = 0;
    for (OstLocal vertex = 0; supports && vertex < mesh->owned_nodes && !*has; vertex++)
        *has = !ost_link_of(supports->links, vertex) &&
               (supports->index[vertex] < 0 || supports->support[supports->index[vertex]].constrained < 3);
    return ost_max_ints(ctx, 1, has);
}

static OstStatus assemble(OstLinearSpace *space, const OstSystem *quadratic, const OstMaterialField *field,
                          int with_metric)
{
    OST_TRY(ost_system_create(space->mesh, space->supports, &space->system));
    const OstStatus status = ost_system_fill(space->system, field);
    ost_system_release_scatter(space->system);
    OST_TRY(ost_agree(quadratic->ctx, status));
    OST_TRY(ost_row_geometry_create(space->system, field, with_metric, &space->rows));
    OST_TRY(ost_agree(quadratic->ctx, ost_coarse_parents(quadratic, space->system, &space->parents, &space->weights)));
    space->space = (OstCoarseSpace){space->system->matrix, &space->rows.geometry, space->parents, space->weights};
    return OST_SUCCESS;
}

static OstStatus take_vertices(OstLinearSpace *space, const OstSystem *quadratic)
{
    OST_TRY(ost_mesh_linear(quadratic->mesh, &space->mesh, &space->node_of_vertex));
    OstStatus status =
        ost_supports_on_vertices(quadratic->supports, space->mesh, space->node_of_vertex, &space->supports);
    if (status == OST_SUCCESS && space->supports && quadratic->supports->spring)
        status = ost_springs_on_vertices(quadratic->supports, space->node_of_vertex, space->supports);
    return ost_agree(quadratic->ctx, status);
}

OstStatus ost_linear_space_move(OstLinearSpace *space, const OstMaterialField *field, OstFormulation formulation,
                                double t, const double *displacement)
{
    OstContext *ctx = space->mesh->ctx;
    double *u = NULL;
    OstStatus status = OST_NEW(ctx, &u, 3 * (size_t)space->mesh->node_count);
    OST_THEN(ost_system_restore_scatter(space->system));
    if (status == OST_SUCCESS) {
        const OstTangent tangent = {.formulation = formulation, .t = t, .u = u, .definite = 1};
        for (size_t vertex = 0; vertex < (size_t)space->mesh->node_count; vertex++)
            memcpy(u + 3 * vertex, displacement + 3 * (size_t)space->node_of_vertex[vertex], 3 * sizeof *u);
        status = ost_system_fill_tangent(space->system, field, &tangent);
    }
    ost_system_release_scatter(space->system);
    status = ost_agree(ctx, status);
    OST_THEN(ost_row_geometry_move(&space->rows, u));
    OST_FREE(u);
    return status;
}

OstStatus ost_linear_space_create(const OstSystem *quadratic, const OstMaterialField *field, int with_metric,
                                  OstLinearSpace **space)
{
    OstContext *ctx = quadratic->ctx;
    OstLinearSpace *made = NULL;
    int has_rows = 0;
    *space = NULL;
    ost_ledger_enter(ctx, OST_EFFECT_LINEAR_SPACE);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    OST_THEN(take_vertices(made, quadratic));
    OST_THEN(has_free_vertex(made, &has_rows));
    if (status == OST_SUCCESS && has_rows)
        status = assemble(made, quadratic, field, with_metric);
    if (status != OST_SUCCESS || !has_rows)
        ost_linear_space_destroy(&made);
    ost_ledger_leave(ctx);
    *space = made;
    return status;
}
