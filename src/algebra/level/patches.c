/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/patches.h"

#include "algebra/aggregation/aggregates.h"
#include "algebra/level/node_factor.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"

#include <string.h>

/* Nodes of a patch before it grows by the layers of nodes around it. Smaller ones take as much memory and more
 * iterations. */
static const double patch_nodes = 400.0;

/* So much of its diagonal is added to a patch's matrix where it is not positive definite, or single precision has been
 * found to lose its factor; each next try adds a hundred times as much. Iterations to what rounding allows: slivers of
 * 5,148 unknowns 188 with 1e-6 and 124 with 1e-8, stiff inclusions 715 and 584. */
static const double least_softening = 1e-8, safe_softening = 1e-6, next_softening = 100.0, most_softening = 1.0;

typedef struct Patch {
    OstLocal *node; /* in the factor's order */
    OstNodeFactor factor;
} Patch;

struct OstPatches {
    OstContext *ctx;
    OstDoubleMatrix *matrix;
    OstLocal count;
    Patch *patch;
    double *value; /* the matrix's blocks, scaled */
    float *part;   /* unknowns of the largest patch */
};

/* For the construction: of each node, the last patch it was seen in, and its place there. */
typedef struct Places {
    OstLocal *seen, *place;
    OstLocal stamp;
    OstLocal *list, *order, *start; /* of a patch: its nodes, in which order they are factored, and */
    OstLocal *neighbour;            /* their neighbours */
    size_t room;
} Places;

void ost_patches_destroy(OstPatches **patches)
{
    if (!*patches)
        return;
    for (OstLocal p = 0; (*patches)->patch && p < (*patches)->count; p++) {
        OST_FREE((*patches)->patch[p].node);
        ost_node_factor_clear(&(*patches)->patch[p].factor);
    }
    OST_FREE((*patches)->patch, (*patches)->value, (*patches)->part);
    ost_double_matrix_destroy(&(*patches)->matrix);
    OST_FREE(*patches);
}

/* A block that is scaled at each access takes longer than the sweep's other work. */
static OstStatus copy_blocks(OstPatches *patches)
{
    const OstDoubleMatrix *matrix = patches->matrix;
    OST_TRY(OST_NEW_UNCLEARED(patches->ctx, &patches->value, 9 * (size_t)matrix->row_start[matrix->rows]));
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            double room[OST_BLOCK];
            memcpy(patches->value + 9 * (size_t)k, ost_double_matrix_block(matrix, 3, i, k, room),
                   9 * sizeof *patches->value);
        }
    return OST_SUCCESS;
}

/* Appends the neighbours of list[from .. count - 1] that have not been seen yet; returns the new count. */
static OstLocal add_layer(const OstDoubleMatrix *matrix, Places *places, OstLocal from, OstLocal count)
{
    const OstLocal end = count;
    for (OstLocal n = from; n < end; n++)
        for (OstLocal k = matrix->row_start[places->list[n]]; k < matrix->row_start[places->list[n] + 1]; k++) {
            const OstLocal j = matrix->column[k];
            if (j >= matrix->rows || places->seen[j] == places->stamp)
                continue;
            places->seen[j] = places->stamp;
            places->list[count++] = j;
        }
    return count;
}

/* The neighbours within the patch of each of its nodes. */
static OstStatus list_neighbours(const OstDoubleMatrix *matrix, Places *places, OstLocal count)
{
    size_t most = 0;
    OstLocal used = 0;
    for (OstLocal n = 0; n < count; n++) {
        places->place[places->list[n]] = n;
        most += (size_t)(matrix->row_start[places->list[n] + 1] - matrix->row_start[places->list[n]]);
    }
    if (most > places->room)
        OST_TRY(OST_RESIZE(matrix->ctx, &places->neighbour, most));
    places->room = most > places->room ? most : places->room;
    for (OstLocal n = 0; n < count; n++) {
        const OstLocal i = places->list[n];
        places->start[n] = used;
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const OstLocal j = matrix->column[k];
            if (j < matrix->rows && j != i && places->seen[j] == places->stamp)
                places->neighbour[used++] = places->place[j];
        }
    }
    places->start[count] = used;
    return OST_SUCCESS;
}

static OstStatus make_patch(const OstPatches *patches, Places *places, int layers, OstLocal count,
                            const OstLocal *member, Patch *patch)
{
    const OstDoubleMatrix *matrix = patches->matrix;
    places->stamp++;
    for (OstLocal n = 0; n < count; n++) {
        places->list[n] = member[n];
        places->seen[member[n]] = places->stamp;
    }
    for (OstLocal layer = 0, from = 0; layer < layers; layer++) {
        const OstLocal end = count;
        count = add_layer(matrix, places, from, count);
        from = end;
    }
    OST_TRY(list_neighbours(matrix, places, count));
    OST_TRY(ost_node_factor_plan(patches->ctx, count, places->start, places->neighbour, places->order, &patch->factor));
    OST_TRY(OST_NEW(patches->ctx, &patch->node, count));
    for (OstLocal n = 0; n < count; n++)
        patch->node[n] = places->list[places->order[n]];
    return OST_SUCCESS;
}

/* The graph without what keeps nodes apart: a patch crosses jumps of stiffness. */
static OstStatus join(const OstDoubleMatrix *matrix, const OstMetricGraph *graph, OstMetricGraph **joined)
{
    double *place = NULL;
    OST_TRY(OST_NEW(graph->ctx, &place, 9 * (size_t)graph->nodes));
    for (size_t i = 0; i < (size_t)graph->nodes; i++) {
        memcpy(place + 9 * i, graph->position + 3 * i, 3 * sizeof *place);
        memcpy(place + 9 * i + 3, graph->metric + 6 * i, 6 * sizeof *place);
    }
    const OstStatus status =
        ost_metric_graph_of_pattern(graph->ctx, matrix->rows, matrix->row_start, matrix->column, place, joined);
    OST_FREE(place);
    return status;
}

static OstStatus group(const OstDoubleMatrix *matrix, const OstMetricGraph *graph, OstAggregates **aggregates)
{
    const OstAggregateShape shape = {.target = patch_nodes, .minimum = 1};
    OstMetricGraph *joined = NULL;
    OstStatus status = OST_SUCCESS;
    if (ost_metric_graph_is_uneven(graph))
        status = join(matrix, graph, &joined);
    OST_THEN(ost_aggregates_create(joined ? joined : graph, &shape, aggregates));
    ost_metric_graph_destroy(&joined);
    return status;
}

static OstStatus make_patches(const OstMetricGraph *graph, int layers, OstPatches *patches)
{
    const OstLocal rows = patches->matrix->rows;
    OstAggregates *aggregates = NULL;
    OstLocal *start = NULL, *member = NULL;
    Places places = {0};
    OstStatus status;
    OST_TRY_DONE(group(patches->matrix, graph, &aggregates));
    OST_TRY_DONE(ost_aggregates_list(aggregates, rows, &start, &member));
    OST_TRY_DONE(OST_NEW(patches->ctx, &places.seen, 5 * (size_t)rows + 1));
    OST_TRY_DONE(OST_NEW(patches->ctx, &patches->patch, aggregates->count));
    places.place = places.seen + rows;
    places.list = places.place + rows;
    places.order = places.list + rows;
    places.start = places.order + rows;
    patches->count = aggregates->count;
    for (OstLocal a = 0; a < aggregates->count; a++)
        OST_TRY_DONE(
            make_patch(patches, &places, layers, start[a + 1] - start[a], member + start[a], &patches->patch[a]));
done:
    OST_FREE(start, member, places.seen, places.neighbour);
    ost_aggregates_destroy(&aggregates);
    return status;
}

/* The patch's matrix in the pattern of its factor. `place` has each node's place, that of others in other patches. */
static void fill(const OstPatches *patches, const Patch *patch, const OstLocal *place, double softening,
                 double *diagonal, double *value)
{
    const OstDoubleMatrix *matrix = patches->matrix;
    const OstNodeFactor *factor = &patch->factor;
    memset(value, 0, 9 * (size_t)factor->start[factor->count] * sizeof *value);
    for (OstLocal n = 0; n < factor->count; n++) {
        const OstLocal i = patch->node[n];
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const OstLocal j = matrix->column[k], m = j < matrix->rows ? place[j] : factor->count;
            if (m > n || patch->node[m] != j)
                continue;
            double *to = j == i ? diagonal + 9 * (size_t)n : value + 9 * (size_t)ost_node_factor_find(factor, n, m);
            memcpy(to, patches->value + 9 * (size_t)k, 9 * sizeof *to);
        }
        for (size_t c = 0; c < 9; c += 4)
            diagonal[9 * (size_t)n + c] *= 1.0 + softening;
    }
}

static OstStatus factor_patch(const OstPatches *patches, double softening, OstLocal *place, double *work, Patch *patch)
{
    OstNodeFactor *factor = &patch->factor;
    int pivot = 1;
    for (OstLocal n = 0; n < factor->count; n++)
        place[patch->node[n]] = n;
    for (; pivot != 0 && softening <= most_softening; softening *= next_softening) {
        double *value = work + 9 * (size_t)factor->count;
        fill(patches, patch, place, softening, work, value);
        OST_TRY(ost_node_factor_fill(patches->ctx, work, value, factor, &pivot));
    }
    return pivot == 0 ? OST_SUCCESS
                      : OST_RAISE(patches->ctx, OST_NOT_CONVERGED,
                                  "pivot %d of %d in a patch is not positive: the stiffness is indefinite, or rounding "
                                  "makes it so",
                                  pivot, factor->count);
}

static size_t blocks_of(const Patch *patch)
{
    return (size_t)patch->factor.count + (size_t)patch->factor.start[patch->factor.count];
}

static OstStatus factor_patches(OstPatches *patches, double softening)
{
    size_t largest = 0, nodes = 0;
    OstLocal *place = NULL;
    double *work = NULL;
    OstStatus status;
    for (OstLocal p = 0; p < patches->count; p++) {
        const Patch *patch = &patches->patch[p];
        nodes = (size_t)patch->factor.count > nodes ? (size_t)patch->factor.count : nodes;
        largest = blocks_of(patch) > largest ? blocks_of(patch) : largest;
    }
    OST_TRY_DONE(OST_NEW(patches->ctx, &patches->part, 3 * nodes));
    OST_TRY_DONE(OST_NEW(patches->ctx, &place, patches->matrix->rows));
    OST_TRY_DONE(OST_NEW_UNCLEARED(patches->ctx, &work, 9 * largest));
    for (OstLocal p = 0; p < patches->count; p++)
        OST_TRY_DONE(factor_patch(patches, softening, place, work, &patches->patch[p]));
done:
    OST_FREE(place, work);
    return status;
}

/* Do the factors fit into free memory? */
static OstStatus check_memory(const OstPatches *patches)
{
    static const double mebibyte = 1048576.0;
    double bytes = 0.0;
    OstMemoryDemand demand;
    for (OstLocal p = 0; p < patches->count; p++)
        bytes += (double)blocks_of(&patches->patch[p]) * 9.0 * sizeof(float);
    OST_TRY(ost_memory_demand(patches->ctx, bytes, &demand));
    ost_log(patches->ctx, OST_LOG_VERBOSE, "solver: factors of overlapping patches take %.3g MiB",
            demand.wanted / mebibyte);
    if (demand.wanted <= demand.free)
        return OST_SUCCESS;
    return OST_RAISE(patches->ctx, OST_OUT_OF_MEMORY,
                     "factors of overlapping patches would take %.0f MiB, but there are %.3g MiB free",
                     demand.wanted / mebibyte, demand.free / mebibyte);
}

OstStatus ost_patches_create(const OstDoubleMatrix *matrix, const OstMetricGraph *graph, int layers, int safe,
                             OstPatches **patches)
{
    OstContext *ctx = matrix->ctx;
    OstPatches *made = NULL;
    *patches = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        status = ost_double_matrix_borrow(matrix->of, matrix->scaling, &made->matrix);
        OST_THEN(copy_blocks(made));
        OST_THEN(make_patches(graph, layers, made));
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(check_memory(made));
    OST_TRY_DONE(ost_agree(ctx, factor_patches(made, safe ? safe_softening : least_softening)));
done:
    if (status != OST_SUCCESS)
        ost_patches_destroy(&made);
    *patches = made;
    return status;
}

/* part = r - A z in the patch's rows. */
OST_KERNEL static void find_residual(const OstPatches *patches, const Patch *patch, const double *r, const double *z)
{
    const OstDoubleMatrix *matrix = patches->matrix;
    for (OstLocal n = 0; n < patch->factor.count; n++) {
        const OstLocal i = patch->node[n];
        double left[3] = {r[3 * (size_t)i], r[3 * (size_t)i + 1], r[3 * (size_t)i + 2]};
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1] && matrix->column[k] < matrix->rows; k++) {
            const double *block = patches->value + 9 * (size_t)k;
            const double *x = z + 3 * (size_t)matrix->column[k];
            for (int c = 0; c < 3; c++)
                left[c] -= block[3 * c] * x[0] + block[3 * c + 1] * x[1] + block[3 * c + 2] * x[2];
        }
        for (size_t c = 0; c < 3; c++)
            patches->part[3 * (size_t)n + c] = (float)left[c];
    }
}

void ost_patches_sweep(const OstPatches *patches, int reverse, const double *r, double *z)
{
    for (OstLocal p = 0; p < patches->count; p++) {
        const Patch *patch = &patches->patch[reverse ? patches->count - 1 - p : p];
        find_residual(patches, patch, r, z);
        ost_node_factor_solve(&patch->factor, patches->part);
        for (OstLocal n = 0; n < patch->factor.count; n++)
            for (size_t c = 0; c < 3; c++)
                z[3 * (size_t)patch->node[n] + c] += (double)patches->part[3 * (size_t)n + c];
        ost_ledger_multiplied(patches->ctx, 2.0 * 9.0 * (double)blocks_of(patch));
    }
}

void ost_patches_solve(const void *data, const double *r, double *z)
{
    const OstPatches *patches = data;
    const size_t n = 3 * (size_t)patches->matrix->rows;
    if (n > 0)
        memset(z, 0, n * sizeof *z);
    ost_patches_sweep(patches, 0, r, z);
    ost_patches_sweep(patches, 1, r, z);
}
