/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/exodus/exodus.h"
#include "formats/exodus/file.h"
#include "formats/exodus/parts.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 64, MOST_NODES = 27 };

/* Of its distance from the origin: coordinates may be in single precision. */
static const double same_place = 1e-6;

/* --- nodes --- */

/* Coordinates are three arrays, or in older files one. */
static OstStatus open_axis(const OstExodus *exodus, int axis, OstNetcdfRows *rows)
{
    static const char *const names[3] = {"coordx", "coordy", "coordz"};
    OST_TRY(ost_netcdf_rows(&exodus->nc, names[axis], 0, 0, rows));
    if (!rows->found)
        OST_TRY(ost_netcdf_rows(&exodus->nc, "coord", 1, axis, rows));
    if (rows->found && rows->width == 1 && rows->total == exodus->nodes)
        return OST_SUCCESS;
    return OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT,
                     "%s: %s (or coord) has %d numbers, expected %d, as num_nodes is", exodus->nc.path, names[axis],
                     rows->total, exodus->nodes);
}

static OstStatus read_nodes(const OstExodus *exodus, OstCells *cells)
{
    OstNetcdfRows axis[3];
    if (exodus->nodes == 0) /* a rank without any */
        return OST_SUCCESS;
    for (int d = 0; d < 3; d++)
        OST_TRY(open_axis(exodus, d, &axis[d]));
    do {
        for (int d = 0; d < 3; d++)
            OST_TRY(ost_netcdf_reals(&axis[d]));
        for (OstLocal i = 0; i < axis[0].count && !exodus->nc.dry; i++) {
            const double x[3] = {axis[0].real[i], axis[1].real[i], axis[2].real[i]};
            OST_TRY(ost_cells_add_node(cells, ost_exodus_node(exodus, axis[0].first + i + 1), x));
        }
    } while (axis[0].count > 0);
    return OST_SUCCESS;
}

/* --- blocks --- */

static OstStatus add_element(const OstExodus *exodus, const OstExodusBlock *block, OstLocal place,
                             const long long *read, OstCells *cells)
{
    OstGlobal nodes[MOST_NODES];
    for (OstLocal n = 0; n < block->type->nodes; n++) {
        const OstGlobal node = ost_exodus_node(exodus, read[n]);
        if (node < 0)
            return OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT, "%s: element %d uses node %lld, expected 1 to %d",
                             exodus->nc.path, place, read[n], exodus->nodes);
        nodes[block->type->place ? block->type->place[n] : n] = node;
    }
    return ost_cells_add(cells, block->type->kind, ost_exodus_element(exodus, place), block->id, nodes);
}

static void skip_block(const OstNetcdf *nc, const char *name, const OstExodusBlock *block, OstCells *cells)
{
    char word[OST_NETCDF_NAME];
    ost_netcdf_attribute(nc, name, "elem_type", word);
    if (block->count == 0)
        return;
    ost_cells_skip(cells, block->type->dimension, word[0] ? word : "of no type");
    *(block->type->dimension == 3 ? &cells->solids : &cells->others) += block->count - 1;
}

static OstStatus read_block(const OstExodus *exodus, OstLocal b, OstCells *cells)
{
    const OstNetcdf *nc = &exodus->nc;
    const OstExodusBlock *block = &exodus->block[b];
    OstNetcdfRows rows;
    char name[NAME], own[OST_NETCDF_NAME];
    snprintf(name, sizeof name, "connect%d", b + 1);
    OST_TRY(ost_netcdf_text(nc, "eb_names", b, own));
    if (block->type->kind == OST_CELL_KINDS) {
        if (!nc->dry)
            skip_block(nc, name, block, cells);
        return OST_SUCCESS;
    }
    if (own[0] && !nc->dry)
        OST_TRY(ost_cells_name(cells, block->type->dimension, block->id, own));
    OST_TRY(ost_netcdf_rows(nc, name, 0, 0, &rows));
    do {
        OST_TRY(ost_netcdf_integers(&rows));
        for (OstLocal i = 0; i < rows.count && !nc->dry; i++)
            OST_TRY(add_element(exodus, block, block->first + rows.first + i + 1,
                                rows.integer + (size_t)i * (size_t)rows.width, cells));
    } while (rows.count > 0);
    return OST_SUCCESS;
}

/* --- parts --- */

/* A node by its number, to be sorted by it, and of one number as they came. */
typedef struct Place {
    OstGlobal label;
    OstLocal node;
} Place;

static int compare_places(const void *a, const void *b)
{
    const Place *x = a, *y = b;
    return x->label != y->label ? (x->label > y->label) - (x->label < y->label)
                                : (x->node > y->node) - (x->node < y->node);
}

static OstStatus check_same(const OstCells *cells, OstLocal first, OstLocal second)
{
    const double *x = cells->chunk->coordinates + 3 * (size_t)first,
                 *y = cells->chunk->coordinates + 3 * (size_t)second;
    const double size = fmax(ost_norm3(x), ost_norm3(y)), d[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
    if (ost_norm3(d) <= same_place * size)
        return OST_SUCCESS;
    return OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                     "%s: node %" PRId64
                     " is at (%g, %g, %g) in one part and at (%g, %g, %g) in another; the parts are of "
                     "different meshes, or their numbers are not those of the whole: join them by epu",
                     cells->path, cells->chunk->node_label[first], x[0], x[1], x[2], y[0], y[1], y[2]);
}

/* Keeps each node once, in the order of the numbers. */
static OstStatus join_nodes(OstCells *cells)
{
    OstMeshChunk *chunk = cells->chunk;
    const OstLocal count = chunk->node_count;
    Place *place = NULL;
    double *x = NULL;
    OstLocal kept = 0;
    OstStatus status = OST_NEW(cells->ctx, &place, count);
    OST_THEN(OST_NEW(cells->ctx, &x, 3 * (size_t)count));
    for (OstLocal n = 0; n < count && status == OST_SUCCESS; n++)
        place[n] = (Place){chunk->node_label[n], n};
    if (status == OST_SUCCESS && count > 0)
        qsort(place, (size_t)count, sizeof *place, compare_places);
    for (OstLocal n = 0, first = 0; n < count && status == OST_SUCCESS; n++) {
        if (n > 0 && place[n].label == place[n - 1].label) {
            status = check_same(cells, place[first].node, place[n].node);
            continue;
        }
        first = n;
        memcpy(x + 3 * (size_t)kept++, chunk->coordinates + 3 * (size_t)place[n].node, 3 * sizeof *x);
    }
    for (OstLocal n = 0, to = 0; n < count && status == OST_SUCCESS; n++)
        if (n == 0 || place[n].label != place[n - 1].label)
            chunk->node_label[to++] = place[n].label;
    if (status == OST_SUCCESS && kept > 0)
        memcpy(chunk->coordinates, x, 3 * (size_t)kept * sizeof *x);
    chunk->node_count = kept;
    OST_FREE(place, x);
    return status;
}

/* Sets have the nodes that parts share from each of them. */
static OstStatus join_parts(OstCells *cells)
{
    OST_TRY(join_nodes(cells));
    for (int s = 0; s < cells->set_count; s++)
        ost_cells_keep_once(cells, s);
    return OST_SUCCESS;
}

/* --- the file --- */

static OstStatus read_all(OstContext *ctx, const char *path, int parts, int dry, OstCells *cells)
{
    OstExodus exodus;
    OstStatus status = ost_exodus_open(ctx, path, parts, dry, &exodus);
    OST_THEN(read_nodes(&exodus, cells));
    for (OstLocal b = 0; b < exodus.block_count && status == OST_SUCCESS; b++)
        status = read_block(&exodus, b, cells);
    OST_THEN(ost_exodus_read_sets(&exodus, cells));
    ost_exodus_close(&exodus);
    return status;
}

static OstStatus try_all(OstContext *ctx, const char *path, const char *name)
{
    (void)name;
    return read_all(ctx, path, 1, 1, NULL);
}

static OstStatus read_parts(const OstExodusParts *parts, OstCells *cells)
{
    for (int p = 0; p < parts->count; p++) {
        OST_TRY(ost_netcdf_dry_run(cells->ctx, parts->path[p], try_all, NULL));
        OST_TRY(read_all(cells->ctx, parts->path[p], parts->count, 0, cells));
    }
    if (parts->count == 1)
        return OST_SUCCESS;
    ost_log(cells->ctx, OST_LOG_NORMAL, "%s: joined with the others of %d files", parts->path[0], parts->count);
    return join_parts(cells);
}

OstStatus ost_exodus_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstCells cells;
    OstExodusParts parts = {0};
    OstStatus status = ost_cells_open(ctx, path, &cells);
    OST_THEN(ost_exodus_parts_find(ctx, path, &parts));
    OST_THEN(read_parts(&parts, &cells));
    OST_THEN(ost_cells_finish(&cells, chunk));
    ost_cells_close(&cells);
    ost_exodus_parts_free(&parts);
    return status;
}
