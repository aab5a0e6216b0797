/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/mesh_report.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/coincident.h"

#include <float.h>
#include <math.h>

void ost_mesh_counts_clear(OstMeshCounts *counts)
{
    OST_FREE(counts->region_tets);
    OST_FREE(counts->region_volume);
    OST_FREE(counts->boundary_items);
    OST_FREE(counts->boundary_area);
    ost_components_destroy(&counts->components);
}

static OstStatus make_room(const OstMesh *mesh, OstMeshCounts *counts)
{
    OST_TRY(OST_NEW(mesh->ctx, &counts->region_tets, mesh->regions.count));
    OST_TRY(OST_NEW(mesh->ctx, &counts->region_volume, mesh->regions.count));
    OST_TRY(OST_NEW(mesh->ctx, &counts->boundary_items, mesh->boundary_count));
    return OST_NEW(mesh->ctx, &counts->boundary_area, mesh->boundary_count);
}

static void count_edges(const OstMesh *mesh, OstLocal tet, OstMeshCounts *counts)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    for (int e = 0; e < 6; e++) {
        const double *a = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
        const double *b = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
        const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        counts->shortest = fmin(counts->shortest, ost_norm3(d));
        counts->longest = fmax(counts->longest, ost_norm3(d));
    }
}

static void count_tet(const OstMesh *mesh, OstLocal tet, OstMeshCounts *counts)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    const double volume = ost_tet_volume(mesh->coordinates, nodes), quality = ost_tet_quality(mesh->coordinates, nodes);
    const int bin = (int)(quality * OST_QUALITY_BINS);
    counts->volume += volume;
    counts->region_tets[mesh->tet_region[tet]]++;
    counts->region_volume[mesh->tet_region[tet]] += volume;
    counts->mean_quality += quality / (double)mesh->global_tets;
    counts->bins[bin < 0 ? 0 : bin >= OST_QUALITY_BINS ? OST_QUALITY_BINS - 1 : bin]++;
    if (quality < counts->least_quality ||
        (quality == counts->least_quality && mesh->tet_label[tet] < counts->worst_tet)) {
        counts->least_quality = quality;
        counts->worst_tet = mesh->tet_label[tet];
    }
    count_edges(mesh, tet, counts);
}

/* Of the triangle between its vertices. */
static double area_of(const OstMesh *mesh, const OstGlobal *nodes)
{
    const double *a = mesh->coordinates + 3 * nodes[0], *b = mesh->coordinates + 3 * nodes[1],
                 *c = mesh->coordinates + 3 * nodes[2];
    const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    double normal[3];
    ost_cross3(ab, ac, normal);
    return 0.5 * ost_norm3(normal);
}

static void count_boundary(const OstMesh *mesh, int number, OstMeshCounts *counts)
{
    const OstBoundary *boundary = &mesh->boundaries[number];
    for (OstLocal i = 0; i < boundary->count; i++) {
        const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item;
        if (!ost_mesh_owns(mesh, boundary->nodes_per_item, nodes))
            continue;
        counts->boundary_items[number]++;
        if (boundary->dimension == 2)
            counts->boundary_area[number] += area_of(mesh, nodes);
    }
}

static OstStatus add_up(const OstMesh *mesh, OstMeshCounts *counts)
{
    OstContext *ctx = mesh->ctx;
    const double mine = counts->least_quality;
    OST_TRY(ost_sum(ctx, 1, &counts->volume));
    OST_TRY(ost_sum(ctx, 1, &counts->mean_quality));
    OST_TRY(ost_min(ctx, 1, &counts->shortest));
    OST_TRY(ost_max(ctx, 1, &counts->longest));
    OST_TRY(ost_min(ctx, 1, &counts->least_quality));
    counts->worst_tet = mine > counts->least_quality ? INT64_MAX : counts->worst_tet;
    OST_TRY(ost_min_numbers(ctx, 1, &counts->worst_tet));
    OST_TRY(ost_sum_numbers(ctx, OST_QUALITY_BINS, counts->bins));
    OST_TRY(ost_sum_numbers(ctx, mesh->regions.count, counts->region_tets));
    OST_TRY(ost_sum(ctx, mesh->regions.count, counts->region_volume));
    OST_TRY(ost_sum_numbers(ctx, mesh->boundary_count, counts->boundary_items));
    return ost_sum(ctx, mesh->boundary_count, counts->boundary_area);
}

OstStatus ost_mesh_counts_make(const OstMesh *mesh, OstMeshCounts *counts)
{
    *counts = (OstMeshCounts){.shortest = DBL_MAX, .least_quality = DBL_MAX, .worst_tet = INT64_MAX};
    OST_TRY(ost_agree(mesh->ctx, make_room(mesh, counts)));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        count_tet(mesh, t, counts);
    for (int b = 0; b < mesh->boundary_count; b++)
        count_boundary(mesh, b, counts);
    OST_TRY(add_up(mesh, counts));
    OST_TRY(ost_mesh_bounds(mesh, counts->low, counts->high));
    OST_TRY(ost_mesh_surface_faces(mesh, &counts->surface_faces));
    OST_TRY(ost_mesh_count_coincident(mesh, &counts->coincident, &counts->tolerance));
    return ost_components_create(mesh, &counts->components);
}
