/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"

#include "assembly/limits.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/small.h"
#include "element/element.h"

void ost_system_destroy(OstSystem **system)
{
    if (!*system)
        return;
    ost_block_matrix_destroy(&(*system)->matrix);
    OST_FREE((*system)->row_of_node);
    OST_FREE((*system)->node_of_row);
    OST_FREE((*system)->block_of_tet);
    OST_FREE(*system);
}

void ost_system_release_scatter(OstSystem *system)
{
    OST_FREE(system->block_of_tet);
}

static int is_free(const OstSupports *supports, OstLocal node)
{
    const OstLocal index = supports->index[node];
    return index < 0 || supports->support[index].constrained < 3;
}

/* Numbers the nodes that are free in some direction, in their order: owned nodes get a row, ghosts a column. */
static OstStatus number_rows(const OstMesh *mesh, const OstSupports *supports, OstSystem *system)
{
    OstContext *ctx = mesh->ctx;
    OstLocal columns = 0;
    system->ctx = ctx;
    system->mesh = mesh;
    system->supports = supports;
    OST_TRY(OST_NEW(ctx, &system->matrix, 1));
    OST_TRY(OST_NEW(ctx, &system->row_of_node, mesh->node_count));
    system->matrix->ctx = ctx;
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        system->row_of_node[node] = is_free(supports, node) ? columns++ : -1;
        if (node < mesh->owned_nodes)
            system->matrix->rows = columns;
    }
    system->matrix->columns = columns;
    OST_TRY(OST_NEW(ctx, &system->node_of_row, columns));
    OST_TRY(OST_NEW(ctx, &system->matrix->label, columns));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        const OstLocal row = system->row_of_node[node];
        if (row < 0)
            continue;
        system->node_of_row[row] = node;
        system->matrix->label[row] = mesh->node_label[node];
    }
    return OST_SUCCESS;
}

/* Collective. Finds the global number of this rank's first row. */
static OstStatus number_globally(OstSystem *system)
{
    OstContext *ctx = system->ctx;
    OstBlockMatrix *matrix = system->matrix;
    OST_TRY(ost_number_from(ctx, matrix->rows, &matrix->first_row, &matrix->global_rows));
    if (matrix->global_rows == 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "every vertex is constrained in all directions, so there is nothing to solve for; leave some "
                         "free");
    return ost_limit_unknowns(ctx, matrix->global_rows);
}

OstStatus ost_system_create(const OstMesh *mesh, const OstSupports *supports, OstSystem **system)
{
    OstContext *ctx = mesh->ctx;
    OstSystem *made = NULL;
    *system = NULL;
    if (!ost_element_of(mesh->nodes_per_tet))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the mesh has tets of %d nodes; 4 or 10 are expected",
                         mesh->nodes_per_tet);
    ost_ledger_enter(ctx, OST_LEDGER_PATTERN);
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS)
        status = number_rows(mesh, supports, made);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_agree(ctx, number_globally(made)));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_subset(mesh->halo, made->row_of_node, &made->matrix->halo)));
    OST_TRY_DONE(ost_agree(ctx, ost_system_make_pattern(made)));
    *system = made;
done:
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        ost_system_destroy(&made);
    return status;
}

OstStatus ost_system_displacement(const OstSystem *system, double t, const double *v, double *u)
{
    const OstMesh *mesh = system->mesh;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const OstLocal row = system->row_of_node[node];
        double *displacement = u + 3 * (size_t)node;
        double projector[9];
        double prescribed[3];
        ost_supports_get(system->supports, node, projector, prescribed);
        if (row >= 0)
            ost_apply3(projector, v + 3 * (size_t)row, displacement);
        for (int i = 0; i < 3; i++)
            displacement[i] = (row >= 0 ? displacement[i] : 0.0) + t * prescribed[i];
    }
    return ost_agree(system->ctx, ost_halo_import(mesh->halo, 3 * sizeof(double), u));
}
