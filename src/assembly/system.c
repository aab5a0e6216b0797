/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/small.h"
#include "element/element.h"

#include <string.h>

void ost_system_destroy(OstSystem **system)
{
    if (!*system)
        return;
    ost_block_matrix_destroy(&(*system)->matrix);
    ost_system_destroy(&(*system)->whole);
    OST_FREE((*system)->row_of_node);
    OST_FREE((*system)->node_of_row);
    OST_FREE((*system)->block_of_tet);
    OST_FREE(*system);
}

void ost_system_release_scatter(OstSystem *system)
{
    OST_FREE(system->block_of_tet);
    ost_system_destroy(&system->whole);
}

/* Ghosts have columns only where nobody follows: else the matrix finds its own (condense.c). */
static int is_free(const OstSupports *supports, OstLocal node)
{
    const OstLocal index = supports->index[node];
    const OstLinks *links = supports->links;
    if (links && (node >= supports->mesh->owned_nodes || (links->of_node[node] >= 0 && !links->kept[node])))
        return 0;
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
    if (supports->links) {
        made->unlinked = *supports;
        made->unlinked.links = NULL;
        OST_TRY_DONE(ost_system_create(mesh, &made->unlinked, &made->whole));
        *system = made;
        goto done;
    }
    OST_TRY_DONE(ost_agree(ctx, ost_halo_subset(mesh->halo, made->row_of_node, &made->matrix->halo)));
    OST_TRY_DONE(ost_agree(ctx, ost_system_make_pattern(made)));
    *system = made;
done:
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        ost_system_destroy(&made);
    return status;
}

/* v of the owned nodes that have a row, for those that follow them: P is in their weights. */
static OstStatus add_followers(const OstSystem *system, const double *v, double *u)
{
    const OstLinks *links = system->supports->links;
    double *of_leaders = NULL;
    OST_TRY(ost_agree(system->ctx, OST_NEW(system->ctx, &of_leaders, 3 * (size_t)links->slots)));
    for (OstLocal row = 0; row < system->matrix->rows; row++)
        memcpy(of_leaders + 3 * (size_t)system->node_of_row[row], v + 3 * (size_t)row, 3 * sizeof *v);
    const OstStatus status = ost_links_follow(links, of_leaders, u);
    OST_FREE(of_leaders);
    return status;
}

OstStatus ost_system_displacement(const OstSystem *system, double t, const double *v, double *u)
{
    const OstMesh *mesh = system->mesh;
    const OstLinks *links = system->supports->links;
    OstStatus status = OST_SUCCESS;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const OstLocal row = links && links->of_node[node] >= 0 ? -1 : system->row_of_node[node];
        double *displacement = u + 3 * (size_t)node;
        double projector[9];
        double prescribed[3];
        if (row >= 0 && !links && system->supports->index[node] < 0) {
            memcpy(displacement, v + 3 * (size_t)row, 3 * sizeof *displacement);
            continue;
        }
        ost_supports_get(system->supports, node, projector, prescribed);
        if (row >= 0)
            ost_apply3(projector, v + 3 * (size_t)row, displacement);
        for (int i = 0; i < 3; i++)
            displacement[i] = (row >= 0 ? displacement[i] : 0.0) + t * prescribed[i];
    }
    if (links)
        status = add_followers(system, v, u);
    OST_THEN(ost_agree(system->ctx, ost_halo_import(mesh->halo, 3 * sizeof(double), u)));
    return status;
}

OstStatus ost_system_take_rows(const OstSystem *system, const double *force, double *of_rows)
{
    const OstLinks *links = system->supports->links;
    double *of_leaders = NULL;
    OstStatus status = OST_SUCCESS;
    if (links) {
        status = ost_agree(system->ctx, OST_NEW(system->ctx, &of_leaders, 3 * (size_t)links->slots));
        OST_THEN(ost_links_gather(links, force, of_leaders));
    }
    for (OstLocal row = 0; row < system->matrix->rows && status == OST_SUCCESS; row++) {
        const OstLocal node = system->node_of_row[row];
        double projector[9];
        if (!links && system->supports->index[node] < 0) {
            memcpy(of_rows + 3 * (size_t)row, force + 3 * (size_t)node, 3 * sizeof *of_rows);
            continue;
        }
        ost_supports_get(system->supports, node, projector, NULL);
        ost_apply3(projector, force + 3 * (size_t)node, of_rows + 3 * (size_t)row);
        for (size_t i = 0; i < 3 && links; i++) {
            const double own = links->of_node[node] < 0 ? of_rows[3 * (size_t)row + i] : 0.0;
            of_rows[3 * (size_t)row + i] = own + of_leaders[3 * (size_t)node + i];
        }
    }
    OST_FREE(of_leaders);
    return status;
}
