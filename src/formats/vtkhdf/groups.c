/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/groups.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "formats/vtkhdf/match.h"

static const char region_names[] = "/Orthostat/RegionNames";
static const char boundary_names[] = "/Orthostat/BoundaryNames";
static const char boundary_kinds[] = "/Orthostat/BoundaryKinds";
static const char boundary_items[] = "/Orthostat/BoundaryItems";

/* The longest row: the number of a boundary, and the six nodes of a face. */
enum { LONGEST_ROW = 7 };

/* --- writing --- */

static int row_width(const OstMesh *mesh)
{
    int width = 2;
    for (int b = 0; b < mesh->boundary_count; b++)
        width = mesh->boundaries[b].nodes_per_item + 1 > width ? mesh->boundaries[b].nodes_per_item + 1 : width;
    return width;
}

static OstGlobal count_own_items(const OstMesh *mesh)
{
    OstGlobal count = 0;
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        for (OstLocal i = 0; i < boundary->count; i++)
            count += ost_mesh_owns(mesh, boundary->nodes_per_item,
                                   boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item) != 0;
    }
    return count;
}

static void fill_items(const OstMesh *mesh, int width, OstGlobal *row)
{
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        const int n = boundary->nodes_per_item;
        for (OstLocal i = 0; i < boundary->count; i++) {
            const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)n;
            if (!ost_mesh_owns(mesh, n, nodes))
                continue;
            row[0] = b;
            for (int k = 1; k < width; k++)
                row[k] = k <= n ? mesh->node_label[nodes[k - 1]] : -1;
            row += width;
        }
    }
}

static OstStatus write_items(OstHdf5 *h5, const OstMesh *mesh)
{
    const int width = row_width(mesh);
    OstRows rows;
    OstGlobal *items = NULL;
    OST_TRY(ost_rows_create(h5->ctx, count_own_items(mesh), &rows));
    OstStatus status = ost_agree(h5->ctx, OST_NEW(h5->ctx, &items, rows.count * width));
    if (status == OST_SUCCESS) {
        fill_items(mesh, width, items);
        status = ost_hdf5_write_rows(h5, boundary_items, H5T_NATIVE_INT64, width, &rows, items);
    }
    OST_FREE(items);
    return status;
}

static OstStatus write_boundaries(OstHdf5 *h5, const OstMesh *mesh)
{
    const int count = mesh->boundary_count;
    const OstRows rows = {.count = ost_rank(h5->ctx) == 0 ? count : 0, .total = count, .most = count};
    char **names = NULL;
    int32_t *kinds = NULL;
    OstStatus status = OST_NEW(h5->ctx, &names, count);
    OST_THEN(OST_NEW(h5->ctx, &kinds, 2 * count));
    OST_TRY_DONE(ost_agree(h5->ctx, status));
    for (int b = 0; b < count; b++) {
        names[b] = mesh->boundaries[b].name;
        kinds[2 * b] = mesh->boundaries[b].dimension;
        kinds[2 * b + 1] = mesh->boundaries[b].nodes_per_item;
    }
    OST_TRY_DONE(ost_hdf5_write_names(h5, boundary_names, count, names));
    OST_TRY_DONE(ost_hdf5_write_rows(h5, boundary_kinds, H5T_NATIVE_INT32, 2, &rows, kinds));
    OST_TRY_DONE(write_items(h5, mesh));
done:
    OST_FREE(names, kinds);
    return status;
}

OstStatus ost_groups_write(OstHdf5 *h5, const OstMesh *mesh)
{
    OST_TRY(ost_hdf5_write_names(h5, region_names, mesh->regions.count, mesh->regions.name));
    return mesh->boundary_count > 0 ? write_boundaries(h5, mesh) : OST_SUCCESS;
}

/* --- reading --- */

OstStatus ost_groups_read_regions(const OstHdf5 *h5, OstMeshChunk *chunk)
{
    if (ost_hdf5_has(h5, region_names))
        return ost_hdf5_read_names(h5, region_names, &chunk->regions.count, &chunk->regions.name);
    OST_TRY(OST_NEW(h5->ctx, &chunk->regions.name, 1));
    chunk->regions.count = 1;
    return ost_copy_string(h5->ctx, "volume", &chunk->regions.name[0]);
}

static int kind_is_known(int dimension, int nodes_per_item)
{
    return (dimension == 0 && nodes_per_item == 1) ||
           (dimension == 1 && (nodes_per_item == 2 || nodes_per_item == 3)) ||
           (dimension == 2 && (nodes_per_item == 3 || nodes_per_item == 6));
}

/* The boundaries' names and kinds, with no items yet. */
static OstStatus read_kinds(const OstHdf5 *h5, OstMeshChunk *chunk)
{
    char **names = NULL;
    int32_t *kinds = NULL;
    int count = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_hdf5_read_names(h5, boundary_names, &count, &names));
    OST_TRY_DONE(OST_NEW(h5->ctx, &kinds, 2 * (size_t)count));
    OST_TRY_DONE(ost_hdf5_read_rows(h5, boundary_kinds, H5T_NATIVE_INT32, 2, count, 0, count, kinds));
    OST_TRY_DONE(OST_NEW(h5->ctx, &chunk->boundaries, count));
    for (int b = 0; b < count; b++) {
        if (!kind_is_known(kinds[2 * b], kinds[2 * b + 1]))
            OST_TRY_DONE(OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                                   "%s: boundary '%s' has dimension %d and %d nodes an item; expected points of 1, "
                                   "curves of 2 or 3, faces of 3 or 6 nodes",
                                   h5->path, names[b], kinds[2 * b], kinds[2 * b + 1]));
        chunk->boundaries[b] =
            (OstBoundary){.name = names[b], .dimension = kinds[2 * b], .nodes_per_item = kinds[2 * b + 1]};
        names[b] = NULL;
        chunk->boundary_count = b + 1;
    }
done:
    OST_FREE_EACH(count, names);
    OST_FREE(kinds);
    return status;
}

/* This rank's share of the items, and room for them in their boundaries. */
static OstStatus read_items(const OstHdf5 *h5, OstMeshChunk *chunk, OstLocal *count, int *width, OstGlobal **items)
{
    const OstGlobal size = ost_size(h5->ctx);
    OstGlobal total = 0;
    OST_TRY(ost_hdf5_shape(h5, boundary_items, &total, width));
    if (*width < 2 || *width > LONGEST_ROW || total / size >= INT32_MAX)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: %s has %lld rows of %d; expected rows of 2 to %d", h5->path,
                         boundary_items, (long long)total, *width, LONGEST_ROW);
    const OstGlobal share = total / size + 1; /* enough for all, and total * rank would overflow */
    const OstGlobal first = share * ost_rank(h5->ctx) < total ? share * ost_rank(h5->ctx) : total;
    *count = (OstLocal)(total - first < share ? total - first : share);
    OST_TRY(OST_NEW(h5->ctx, items, (size_t)*count * (size_t)*width));
    OST_TRY(ost_hdf5_read_rows(h5, boundary_items, H5T_NATIVE_INT64, *width, total, first, *count, *items));
    for (OstLocal i = 0; i < *count; i++) {
        const OstGlobal b = (*items)[(size_t)i * (size_t)*width];
        if (b < 0 || b >= chunk->boundary_count || chunk->boundaries[b].nodes_per_item >= *width)
            return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: item %lld of %s is of boundary %lld; there are %d",
                             h5->path, (long long)(first + i), boundary_items, (long long)b, chunk->boundary_count);
        chunk->boundaries[b].count++;
    }
    for (int b = 0; b < chunk->boundary_count; b++) {
        OstBoundary *boundary = &chunk->boundaries[b];
        OST_TRY(OST_NEW(h5->ctx, &boundary->nodes, (size_t)boundary->count * (size_t)boundary->nodes_per_item));
    }
    return OST_SUCCESS;
}

static OstStatus try_names(const OstHdf5 *h5, const char *list)
{
    int count = 0;
    char **names = NULL;
    const OstStatus status = ost_hdf5_has(h5, list) ? ost_hdf5_read_names(h5, list, &count, &names) : OST_SUCCESS;
    OST_FREE_EACH(count, names);
    return status;
}

OstStatus ost_groups_try(const OstHdf5 *h5)
{
    const char *const lists[] = {region_names, boundary_names};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        if (try_names(h5, lists[i]) == OST_OUT_OF_MEMORY)
            return OST_OUT_OF_MEMORY;
    if (ost_hdf5_try_rows(h5, boundary_kinds, H5T_NATIVE_INT32) == OST_OUT_OF_MEMORY)
        return OST_OUT_OF_MEMORY;
    return ost_hdf5_try_rows(h5, boundary_items, H5T_NATIVE_INT64);
}

/* Global numbers of the nodes with the labels that `items` holds. */
static OstStatus find_nodes(const OstHdf5 *h5, const OstMeshChunk *chunk, size_t count, const OstGlobal *items,
                            OstGlobal *number)
{
    OstKey *pool = NULL, *query = NULL;
    OstGlobal *value = NULL;
    OstStatus status = count > INT32_MAX ? OST_RAISE(h5->ctx, OST_LIMIT_EXCEEDED,
                                                     "%s: %zu labels of boundaries on a rank exceed 2^31 - 1; read it "
                                                     "with more ranks",
                                                     h5->path, count)
                                         : OST_NEW(h5->ctx, &pool, chunk->node_count);
    OST_THEN(OST_NEW(h5->ctx, &value, chunk->node_count));
    OST_THEN(OST_NEW(h5->ctx, &query, count));
    OST_TRY_DONE(ost_agree(h5->ctx, status));
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        value[i] = chunk->first_node + i;
        pool[i].word[0] = chunk->node_label ? chunk->node_label[i] : value[i] + 1;
    }
    for (size_t i = 0; i < count; i++)
        query[i].word[0] = items[i];
    OST_TRY_DONE(ost_match_keys(h5->ctx, chunk->node_count, pool, value, (OstLocal)count, query, number));
done:
    OST_FREE(pool, value, query);
    return status;
}

static OstStatus fill_boundaries(const OstHdf5 *h5, OstMeshChunk *chunk, OstLocal count, int width,
                                 const OstGlobal *items, const OstGlobal *number)
{
    for (int b = 0; b < chunk->boundary_count; b++)
        chunk->boundaries[b].count = 0;
    for (OstLocal i = 0; i < count; i++) {
        const OstGlobal *row = items + (size_t)i * (size_t)width;
        OstBoundary *boundary = &chunk->boundaries[row[0]];
        const int n = boundary->nodes_per_item;
        OstGlobal *nodes = boundary->nodes + (size_t)boundary->count++ * (size_t)n;
        for (int k = 0; k < n; k++) {
            nodes[k] = number[(size_t)i * (size_t)width + 1 + (size_t)k];
            if (nodes[k] < 0)
                return OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                                 "%s: boundary '%s' names vertex %lld, which the file does not have", h5->path,
                                 boundary->name, (long long)row[1 + k]);
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_groups_read_boundaries(const OstHdf5 *h5, OstMeshChunk *chunk)
{
    OstGlobal *items = NULL, *number = NULL;
    OstLocal count = 0;
    int width = 0;
    int found = ost_hdf5_has(h5, boundary_names);
    OST_TRY(ost_max_ints(h5->ctx, 1, &found));
    if (!found)
        return OST_SUCCESS;
    OstStatus status = read_kinds(h5, chunk);
    OST_THEN(read_items(h5, chunk, &count, &width, &items));
    const size_t labels = (size_t)count * (size_t)width;
    OST_THEN(OST_NEW(h5->ctx, &number, labels));
    OST_TRY_DONE(ost_agree(h5->ctx, status));
    OST_TRY_DONE(find_nodes(h5, chunk, labels, items, number));
    OST_TRY_DONE(ost_agree(h5->ctx, fill_boundaries(h5, chunk, count, width, items, number)));
done:
    OST_FREE(items, number);
    return status;
}
