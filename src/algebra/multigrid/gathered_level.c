/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/gathered_level.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"

#include <limits.h>
#include <string.h>

enum { BLOCK = OST_MODES * OST_MODES, PLACE = 9 }; /* PLACE: position and metric of a node */

int ost_gathered_stride(OstGlobal nodes, int ranks, int stride, int together)
{
    const OstGlobal holders = (ranks + stride - 1) / stride; /* of the level above */
    const OstGlobal wanted = together || nodes < OST_NODES_OF_RANK ? 1 : nodes / OST_NODES_OF_RANK;
    if (2 * wanted > holders)
        return stride;
    return stride * (int)((holders + wanted - 1) / wanted);
}

/* A group of ranks, and what its first one has of all of them; the arrays are empty on the others. */
typedef struct Group {
    OstContext *ctx;
    MPI_Comm comm;
    int rank, size;
    int *count, *start; /* size each: of the array on its way */
    OstLocal rows, blocks;
    OstGlobal first;   /* of the group's nodes; on the other ranks, the end of them */
    OstLocal *length;  /* rows: blocks in each */
    OstGlobal *number; /* blocks: columns */
    double *value;     /* blocks × BLOCK */
    double *modes;     /* rows × BLOCK, node by node */
    double *place;     /* rows × PLACE */
    OstLocal *row_start, *order;
    OstGlobal *ghost; /* the columns of other groups, ascending */
    OstLocal ghosts;
} Group;

static void destroy_group(Group *g)
{
    if (g->comm != MPI_COMM_NULL)
        MPI_Comm_free(&g->comm);
    OST_FREE(g->count, g->length, g->number, g->value, g->modes, g->place, g->row_start, g->order);
    OST_FREE(g->ghost);
}

/* Collective over all groups. Brings `count` items of so many bytes to the group's first rank. */
static OstStatus bring(Group *g, size_t bytes, OstLocal count, const void *mine, void **all, OstLocal *total)
{
    MPI_Datatype item;
    OstGlobal sum = 0;
    OstStatus status = OST_MPI(g->ctx, MPI_Gather(&count, 1, MPI_INT32_T, g->count, 1, MPI_INT, 0, g->comm));
    for (int r = 0; g->rank == 0 && r < g->size && status == OST_SUCCESS; r++) {
        g->start[r] = (int)sum;
        sum += g->count[r];
        if (sum > INT_MAX)
            status = OST_RAISE(g->ctx, OST_LIMIT_EXCEEDED, "a coarse level has more blocks on rank %d than MPI gathers",
                               ost_rank(g->ctx));
    }
    OST_THEN(ost_allocate(g->ctx, (size_t)sum, bytes, all));
    OST_TRY(ost_agree(g->ctx, status));
    OST_TRY(OST_MPI(g->ctx, MPI_Type_contiguous((int)bytes, MPI_BYTE, &item)));
    OST_TRY(OST_MPI(g->ctx, MPI_Type_commit(&item)));
    status = OST_MPI(g->ctx, MPI_Gatherv(mine, count, item, *all, g->count, g->start, item, 0, g->comm));
    MPI_Type_free(&item);
    *total = (OstLocal)sum;
    return status;
}

static OstStatus form_group(OstContext *ctx, int stride, Group *g)
{
    const int leader = ost_rank(ctx) / stride * stride;
    *g = (Group){.ctx = ctx, .comm = MPI_COMM_NULL};
    OST_TRY(OST_MPI(ctx, MPI_Comm_split(ost_comm(ctx), leader, ost_rank(ctx), &g->comm)));
    OST_TRY(OST_MPI(ctx, MPI_Comm_rank(g->comm, &g->rank)));
    OST_TRY(OST_MPI(ctx, MPI_Comm_size(g->comm, &g->size)));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &g->count, 2 * (size_t)g->size)));
    g->start = g->count + g->size;
    return OST_SUCCESS;
}

/* The group's nodes are numbered on: from the first one's first to the last one's end. */
static OstStatus number_group(const OstLooseLevel *level, Group *g)
{
    OstGlobal ends[2] = {-level->first, level->first + (*level->matrix)->rows};
    OST_TRY(OST_MPI(g->ctx, MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_INT64_T, MPI_MAX, g->comm)));
    g->first = g->rank == 0 ? -ends[0] : ends[1];
    return OST_SUCCESS;
}

/* Rows, modes, positions and metrics, packed node by node. */
static OstStatus bring_nodes(const OstLooseLevel *level, Group *g)
{
    const OstDoubleMatrix *a = *level->matrix;
    const OstMetricGraph *graph = *level->graph;
    const size_t n = (size_t)a->rows;
    OstLocal *length = NULL, total;
    double *modes = NULL, *place = NULL;
    OstStatus status = OST_NEW(g->ctx, &length, n);
    OST_THEN(OST_NEW(g->ctx, &modes, BLOCK * n));
    OST_THEN(OST_NEW(g->ctx, &place, PLACE * n));
    OST_TRY_DONE(ost_agree(g->ctx, status));
    for (size_t i = 0; i < n; i++) {
        length[i] = a->row_start[i + 1] - a->row_start[i];
        for (size_t c = 0; c < OST_MODES; c++)
            memcpy(modes + BLOCK * i + OST_MODES * c, *level->modes + OST_MODES * (c * n + i),
                   OST_MODES * sizeof *modes);
        memcpy(place + PLACE * i, graph->position + 3 * i, 3 * sizeof *place);
        memcpy(place + PLACE * i + 3, graph->metric + 6 * i, 6 * sizeof *place);
    }
    status = bring(g, sizeof *length, a->rows, length, (void **)&g->length, &g->rows);
    OST_THEN(bring(g, BLOCK * sizeof *modes, a->rows, modes, (void **)&g->modes, &total));
    OST_THEN(bring(g, PLACE * sizeof *place, a->rows, place, (void **)&g->place, &total));
    status = ost_agree(g->ctx, status);
done:
    OST_FREE(length, modes, place);
    return status;
}

static OstStatus bring_blocks(const OstLooseLevel *level, Group *g)
{
    OstDoubleMatrix *a = *level->matrix;
    const OstLocal blocks = a->row_start[a->rows];
    OstGlobal *node = NULL, *number = NULL;
    OstStatus status = ost_double_matrix_unfold(a);
    OST_THEN(OST_NEW(g->ctx, &node, a->columns));
    OST_THEN(OST_NEW(g->ctx, &number, blocks));
    OST_TRY_DONE(ost_agree(g->ctx, status));
    for (OstLocal i = 0; i < a->rows; i++)
        node[i] = level->first + i;
    OST_TRY_DONE(ost_agree(g->ctx, ost_halo_import(a->halo, sizeof *node, node)));
    for (OstLocal k = 0; k < blocks; k++)
        number[k] = node[a->column[k]];
    status = bring(g, sizeof *number, blocks, number, (void **)&g->number, &g->blocks);
    OST_THEN(bring(g, BLOCK * sizeof *a->value, blocks, a->value, (void **)&g->value, &g->blocks));
    status = ost_agree(g->ctx, status);
done:
    OST_FREE(node, number);
    return status;
}

/* The local number of a global one here: the group's nodes, then its ghosts. */
static OstLocal local_number(const Group *g, OstGlobal number)
{
    const OstGlobal own = number - g->first;
    return own >= 0 && own < g->rows ? (OstLocal)own : g->rows + ost_numbers_find(g->ghosts, g->ghost, number);
}

static int is_own(const Group *g, OstGlobal number)
{
    return number >= g->first && number < g->first + g->rows;
}

/* Sorts the blocks of row i by column; by insertion, as rows are short. */
static void sort_row(Group *g, OstLocal i, OstLocal *column)
{
    for (OstLocal k = g->row_start[i]; k < g->row_start[i + 1]; k++) {
        const OstLocal c = local_number(g, g->number[k]);
        OstLocal to = k;
        for (; to > g->row_start[i] && column[to - 1] > c; to--) {
            column[to] = column[to - 1];
            g->order[to] = g->order[to - 1];
        }
        column[to] = c;
        g->order[to] = k;
    }
}

static OstStatus fill_matrix(Group *g, OstDoubleMatrix *made)
{
    OstContext *ctx = g->ctx;
    OST_TRY(OST_NEW(ctx, &g->row_start, g->rows + 1));
    OST_TRY(OST_NEW(ctx, &g->order, g->blocks));
    OST_TRY(OST_NEW(ctx, &g->ghost, g->blocks));
    for (OstLocal i = 0; i < g->rows; i++)
        g->row_start[i + 1] = g->row_start[i] + g->length[i];
    for (OstLocal k = 0; k < g->blocks; k++)
        if (!is_own(g, g->number[k]))
            g->ghost[g->ghosts++] = g->number[k];
    g->ghosts = ost_numbers_sort(g->ghosts, g->ghost);
    OST_TRY(OST_NEW(ctx, &made->column, g->blocks));
    OST_TRY(OST_NEW(ctx, &made->value, BLOCK * (size_t)g->blocks));
    made->rows = g->rows;
    made->columns = g->rows + g->ghosts;
    for (OstLocal i = 0; i < g->rows; i++)
        sort_row(g, i, made->column);
    for (OstLocal k = 0; k < g->blocks; k++)
        memcpy(made->value + BLOCK * (size_t)k, g->value + BLOCK * (size_t)g->order[k], BLOCK * sizeof *made->value);
    made->row_start = g->row_start;
    g->row_start = NULL;
    return OST_SUCCESS;
}

static OstStatus replace_matrix(OstLooseLevel *level, Group *g)
{
    OstContext *ctx = g->ctx;
    OstDoubleMatrix *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        *made = (OstDoubleMatrix){.ctx = ctx, .size = OST_MODES};
        status = fill_matrix(g, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_halo_create(ctx, g->rows, g->first, g->ghosts, g->ghost, &made->halo));
    ost_double_matrix_destroy(level->matrix);
    *level->matrix = made;
    made = NULL;
done:
    ost_double_matrix_destroy(&made);
    return status;
}

/* The nodes of the group see each other as the matrix couples them: the ranks' own graphs had no edges between them. */
static OstStatus replace_graph_and_modes(OstLooseLevel *level, Group *g)
{
    const OstDoubleMatrix *a = *level->matrix;
    const size_t n = (size_t)g->rows;
    OstMetricGraph *graph = NULL;
    double *modes = NULL;
    OstStatus status = OST_NEW(g->ctx, &modes, BLOCK * n);
    OST_THEN(ost_metric_graph_of_pattern(g->ctx, a->rows, a->row_start, a->column, g->place, &graph));
    OST_TRY_DONE(ost_agree(g->ctx, status));
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < OST_MODES; c++)
            memcpy(modes + OST_MODES * (c * n + i), g->modes + BLOCK * i + OST_MODES * c, OST_MODES * sizeof *modes);
    OST_FREE(*level->modes);
    *level->modes = modes;
    modes = NULL;
    graph->jump = (*level->graph)->jump; /* of all ranks */
    ost_metric_graph_destroy(level->graph);
    *level->graph = graph;
    graph = NULL;
done:
    OST_FREE(modes);
    ost_metric_graph_destroy(&graph);
    return status;
}

/* The prolongator's columns: the group's nodes, then those of other groups, ascending. */
static OstStatus renumber(const OstLooseLevel *level, Group *g, OstGlobal *number)
{
    OstProlongator *p = level->prolongator;
    OST_FREE(g->ghost);
    g->ghosts = 0;
    OST_TRY(OST_NEW(g->ctx, &g->ghost, p->columns));
    for (OstLocal c = 0; c < p->columns; c++)
        if (!is_own(g, number[c]))
            g->ghost[g->ghosts++] = number[c];
    g->ghosts = ost_numbers_sort(g->ghosts, g->ghost);
    for (OstLocal k = 0; k < p->row_start[p->rows]; k++)
        p->column[k] = local_number(g, number[p->column[k]]);
    p->columns = g->rows + g->ghosts;
    return OST_SUCCESS;
}

static OstStatus replace_columns(const OstLooseLevel *level, OstLocal owned, Group *g)
{
    OstContext *ctx = g->ctx;
    OstProlongator *p = level->prolongator;
    OstGlobal *number = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &number, p->columns)));
    for (OstLocal c = 0; c < owned; c++)
        number[c] = level->first + c;
    status = ost_halo_import(p->halo, sizeof *number, number);
    OST_THEN(renumber(level, g, number));
    OST_TRY_DONE(ost_agree(ctx, status));
    ost_halo_destroy(&p->halo);
    ost_exchange_destroy(&p->exchange);
    OST_TRY_DONE(ost_halo_create(ctx, g->rows, g->first, g->ghosts, g->ghost, &p->halo));
    status = ost_exchange_create(p->halo, OST_MODES, &p->exchange);
done:
    OST_FREE(number);
    return status;
}

OstStatus ost_level_gather(OstLooseLevel *level, int stride)
{
    Group g;
    const OstLocal owned = (*level->matrix)->rows;
    OstStatus status = form_group((*level->matrix)->ctx, stride, &g);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(g.ctx, number_group(level, &g)));
    OST_TRY_DONE(bring_nodes(level, &g));
    OST_TRY_DONE(bring_blocks(level, &g));
    OST_TRY_DONE(replace_matrix(level, &g));
    OST_TRY_DONE(replace_graph_and_modes(level, &g));
    OST_TRY_DONE(replace_columns(level, owned, &g));
done:
    destroy_group(&g);
    return status;
}
