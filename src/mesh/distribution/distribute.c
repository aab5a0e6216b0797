/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "mesh/check/check.h"
#include "mesh/distribution/curve.h"
#include "mesh/distribution/partition.h"
#include "mesh/distribution/weld.h"

static OstStatus label_all(OstMeshChunk *chunk)
{
    OST_TRY(ost_chunk_label_nodes(chunk));
    if (!chunk->tet_label) {
        OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_label, chunk->tet_count));
        for (OstLocal t = 0; t < chunk->tet_count; t++)
            chunk->tet_label[t] = chunk->first_tet + t + 1;
    }
    return OST_SUCCESS;
}

/* Moves what all ranks have in common to the mesh; the boundaries' items are redistributed later. */
static void take_names(OstMeshChunk *chunk, OstMesh *mesh)
{
    mesh->nodes_per_tet = chunk->nodes_per_tet;
    mesh->fields = chunk->fields;
    mesh->of_cells = chunk->of_cells;
    mesh->of_arrays = chunk->of_arrays;
    mesh->node_shift = chunk->node_shift;
    mesh->global_nodes = chunk->global_nodes;
    mesh->global_tets = chunk->global_tets;
    mesh->regions = chunk->regions;
    mesh->boundary_count = chunk->boundary_count;
    mesh->boundaries = chunk->boundaries;
    chunk->regions = (OstNames){0, NULL};
    chunk->boundary_count = 0;
    chunk->boundaries = NULL;
}

#define TAKE(mesh, chunk, array)        \
    do {                                \
        (mesh)->array = (chunk)->array; \
        (chunk)->array = NULL;          \
    } while (0)

/* On one rank the mesh is the chunk, with local numbers. */
static OstStatus take_all(OstMeshChunk *chunk, OstMesh *mesh)
{
    OstContext *ctx = chunk->ctx;
    const size_t entries = (size_t)chunk->tet_count * (size_t)chunk->nodes_per_tet;
    take_names(chunk, mesh);
    mesh->node_count = mesh->owned_nodes = chunk->node_count;
    mesh->tet_count = mesh->owned_tets = chunk->tet_count;
    TAKE(mesh, chunk, coordinates);
    TAKE(mesh, chunk, node_label);
    TAKE(mesh, chunk, tet_label);
    TAKE(mesh, chunk, tet_region);
    TAKE(mesh, chunk, tet_axes);
    TAKE(mesh, chunk, tet_field);
    OST_TRY(OST_NEW(ctx, &mesh->node_number, mesh->node_count));
    for (OstLocal i = 0; i < mesh->node_count; i++)
        mesh->node_number[i] = i;
    OST_TRY(OST_NEW(ctx, &mesh->tet_nodes, entries));
    for (size_t i = 0; i < entries; i++)
        mesh->tet_nodes[i] = (OstLocal)chunk->tet_nodes[i];
    return ost_halo_create(ctx, mesh->owned_nodes, 0, 0, NULL, &mesh->halo);
}

static OstStatus weld(const OstMeshChunk *chunk, const Slab *slab, const OstTetMetric *tets, int *part, int *any)
{
    double *stiffness = NULL;
    OstStatus status = OST_NEW(chunk->ctx, &stiffness, chunk->tet_count);
    OST_THEN(tets->stiffness(tets->data, chunk, stiffness));
    status = ost_agree(chunk->ctx, status);
    OST_THEN(ost_parts_weld_stiff(chunk, slab, stiffness, part, any));
    OST_FREE(stiffness);
    return status;
}

/* Slabs by node number may lie all over the body, and so would their clusters, along which ost_partition cuts. */
static OstStatus partition_along_curve(const OstMeshChunk *chunk, const Slab *slab, const NodeMetric *metric, int *part)
{
    OstContext *ctx = slab->ctx;
    Slab *moved = NULL;
    NodeMetric *moved_metric = NULL;
    OstRoute *route = NULL;
    int *to = NULL, *moved_part = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &to, (size_t)slab->node_count + (size_t)slab->ghost_count)));
    OST_TRY_DONE(ost_curve_slabs(ctx, slab->node_count, chunk->coordinates, to));
    OST_TRY_DONE(ost_halo_import(slab->halo, sizeof *to, to));
    OST_TRY_DONE(ost_route_create(ctx, slab->node_count, 1, to, &route));
    OST_TRY_DONE(ost_slab_move(slab, route, to, &moved));
    const size_t nodes = (size_t)moved->node_count + (size_t)moved->ghost_count;
    if (metric) {
        OST_TRY_DONE(ost_route_carry(route, sizeof *metric, metric, (void **)&moved_metric));
        OST_TRY_DONE(ost_agree(ctx, OST_RESIZE(ctx, &moved_metric, nodes)));
        OST_TRY_DONE(ost_halo_import(moved->halo, sizeof *metric, moved_metric));
    }
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &moved_part, nodes)));
    OST_TRY_DONE(ost_partition(moved, moved_metric, moved_part));
    OST_TRY_DONE(ost_route_answer(route, sizeof *part, moved_part, part));
    OST_TRY_DONE(ost_halo_import(slab->halo, sizeof *part, part));
done:
    OST_FREE(to, moved_metric, moved_part);
    ost_route_destroy(&route);
    ost_slab_destroy(&moved);
    return status;
}

/* A rank that read the whole mesh partitions it as a whole. */
static OstStatus find_parts(const OstMeshChunk *chunk, const Slab *slab, const OstTetMetric *tets, int *part)
{
    NodeMetric *metric = NULL;
    int whole = chunk->node_count == chunk->global_nodes && chunk->tet_count == chunk->global_tets;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_max_ints(slab->ctx, 1, &whole));
    if (tets && tets->fill)
        OST_TRY_DONE(ost_node_metrics_create(chunk, slab, tets, &metric));
    OST_TRY_DONE(whole ? ost_partition(slab, metric, part) : partition_along_curve(chunk, slab, metric, part));
done:
    OST_FREE(metric);
    return status;
}

static OstStatus partition_and_move(OstMeshChunk *chunk, const OstTetMetric *tets, OstMesh *mesh)
{
    OstContext *ctx = chunk->ctx;
    Slab *slab = NULL;
    int *part = NULL, has_close = 0, has_stiff = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_slab_create(chunk, &slab));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &part, (size_t)slab->node_count + (size_t)slab->ghost_count)));
    OST_TRY_DONE(find_parts(chunk, slab, tets, part));
    OST_TRY_DONE(ost_parts_weld_close(chunk, slab, part, &has_close));
    if (tets && tets->stiffness)
        OST_TRY_DONE(weld(chunk, slab, tets, part, &has_stiff));
    mesh->welded = (has_close ? OST_WELDED_CLOSE : 0U) | (has_stiff ? OST_WELDED_STIFF : 0U);
    take_names(chunk, mesh);
    OST_TRY_DONE(ost_mesh_redistribute(chunk, slab, part, mesh));
done:
    OST_FREE(part);
    ost_slab_destroy(&slab);
    return status;
}

/* The message about a bad mesh names its file, if it is from one. */
static OstStatus name_file(const OstMeshChunk *chunk, OstStatus status)
{
    char *text = NULL;
    if (status != OST_INVALID_INPUT || !chunk->file)
        return status;
    OST_TRY(ost_copy_string(chunk->ctx, ost_error_text(chunk->ctx), &text));
    OST_RAISE(chunk->ctx, status, "%s: %s", chunk->file, text);
    OST_FREE(text);
    return status;
}

/* Local. The least label if it is below 1, else 1; and the greatest, negated. */
static void find_range(OstLocal count, const OstGlobal *label, OstGlobal range[2])
{
    range[0] = 1;
    range[1] = -1;
    for (OstLocal i = 0; i < count; i++) {
        range[0] = label[i] < range[0] ? label[i] : range[0];
        range[1] = label[i] > -range[1] ? -label[i] : range[1];
    }
}

/* `shift`: grows by what the labels do. */
static OstStatus shift_labels(const OstMesh *mesh, const char *what, const OstGlobal range[2], OstLocal count,
                              OstGlobal *label, OstGlobal *shift)
{
    if (range[0] < -OST_LARGEST_LABEL || (range[0] < 1 && range[1] < -OST_LARGEST_LABEL))
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                         "%s are numbered from %lld to %lld, too wide a range; number them from 1", what,
                         (long long)range[0], -(long long)range[1]);
    for (OstLocal i = 0; i < count; i++)
        label[i] += 1 - range[0];
    *shift += 1 - range[0];
    return OST_SUCCESS;
}

/* Collective. Labels of new nodes and tets are made of these, and other programs know no number below 1. */
static OstStatus number_from_one(const char *file, OstMesh *mesh)
{
    OstGlobal range[4];
    find_range(mesh->owned_nodes, mesh->node_label, range);
    find_range(mesh->owned_tets, mesh->tet_label, range + 2);
    OST_TRY(ost_min_numbers(mesh->ctx, 4, range));
    OST_TRY(shift_labels(mesh, "vertices", range, mesh->node_count, mesh->node_label, &mesh->node_shift));
    OST_TRY(shift_labels(mesh, "tets", range + 2, mesh->tet_count, mesh->tet_label, &mesh->tet_shift));
    if (range[0] < 1)
        ost_log(mesh->ctx, OST_LOG_NORMAL, "%s: vertices are numbered from %lld; in results they are from 1",
                file ? file : "mesh", (long long)range[0]);
    return OST_SUCCESS;
}

static OstStatus distribute(OstMeshChunk *chunk, const OstTetMetric *tets, OstMesh **mesh)
{
    OstContext *ctx = chunk->ctx;
    OST_TRY(name_file(chunk, ost_check_chunk(chunk)));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, mesh, 1)));
    (*mesh)->ctx = ctx;
    (*mesh)->straighten = chunk->straighten;
    (*mesh)->cut_off = chunk->cut_off;
    OST_TRY(ost_agree(ctx, label_all(chunk)));
    OST_TRY(ost_size(ctx) == 1 ? take_all(chunk, *mesh) : partition_and_move(chunk, tets, *mesh));
    OST_TRY(name_file(chunk, ost_check_mesh(*mesh, !chunk->only_vertices)));
    return name_file(chunk, number_from_one(chunk->file, *mesh));
}

OstStatus ost_mesh_distribute(OstContext *ctx, OstMeshChunk **chunk, OstMesh **mesh)
{
    return ost_mesh_distribute_by(ctx, chunk, NULL, mesh);
}

OstStatus ost_mesh_distribute_by(OstContext *ctx, OstMeshChunk **chunk, const OstTetMetric *tets, OstMesh **mesh)
{
    *mesh = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_PARTITION);
    const OstStatus status = distribute(*chunk, tets, mesh);
    ost_chunk_destroy(chunk);
    if (status != OST_SUCCESS)
        ost_mesh_destroy(mesh);
    ost_ledger_leave(ctx);
    return status;
}
