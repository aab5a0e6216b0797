/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"

#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"

/* The rows of each tet, and the tets of each row. */
typedef struct RowTets {
    int nodes;           /* per tet */
    OstLocal *row;       /* tet_count × nodes: row or column of each node in ost_order_nodes' order, -1: none */
    OstLocal *tet_start; /* rows + 1 */
    OstLocal *tet;       /* tet_start[rows]: the tets of row r start at tet_start[r] */
} RowTets;

static void incidence_free(RowTets *incidence)
{
    OST_FREE(incidence->row);
    OST_FREE(incidence->tet_start);
    OST_FREE(incidence->tet);
}

/* A counting sort of the tets by the rows that they touch. */
static OstStatus incidence_create(const OstSystem *system, RowTets *incidence)
{
    const OstMesh *mesh = system->mesh;
    const OstLocal rows = system->matrix->rows;
    const OstLocal n = mesh->nodes_per_tet;
    incidence->nodes = n;
    OST_TRY(OST_NEW(system->ctx, &incidence->row, mesh->tet_count * n));
    OST_TRY(OST_NEW(system->ctx, &incidence->tet_start, rows + 1));
    OstLocal *start = incidence->tet_start;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        OstLocal ordered[OST_MAX_TET_NODES];
        ost_order_nodes(n, mesh->node_label, mesh->tet_nodes + (size_t)n * (size_t)t, ordered);
        for (OstLocal a = 0; a < n; a++) {
            const OstLocal row = system->row_of_node[ordered[a]];
            incidence->row[n * t + a] = row;
            if (row >= 0 && row < rows)
                start[row]++;
        }
    }
    for (OstLocal r = 0; r < rows; r++)
        start[r + 1] += start[r];
    OST_TRY(OST_NEW(system->ctx, &incidence->tet, start[rows]));
    /* Filled from the back: each entry moves start[r] down, in the end to where row r begins. */
    for (OstLocal t = mesh->tet_count - 1; t >= 0; t--)
        for (OstLocal a = 0; a < n; a++) {
            const OstLocal row = incidence->row[n * t + a];
            if (row >= 0 && row < rows)
                incidence->tet[--start[row]] = t;
        }
    return OST_SUCCESS;
}

/* Lists the columns of a row, each once, in the order found; with columns NULL only counts them. seen[c] is the last
 * row that had column c. */
static OstLocal collect_columns(const RowTets *incidence, OstLocal row, OstLocal *seen, OstLocal *columns)
{
    OstLocal count = 0;
    for (OstLocal i = incidence->tet_start[row]; i < incidence->tet_start[row + 1]; i++) {
        const OstLocal *of_tet = incidence->row + (size_t)incidence->nodes * (size_t)incidence->tet[i];
        for (int a = 0; a < incidence->nodes; a++) {
            const OstLocal column = of_tet[a];
            if (column < 0 || seen[column] == row)
                continue;
            seen[column] = row;
            if (columns)
                columns[count] = column;
            count++;
        }
    }
    return count;
}

static OstStatus count_blocks(const OstSystem *system, const RowTets *incidence, OstLocal *seen)
{
    OstBlockMatrix *matrix = system->matrix;
    OstGlobal blocks = 0;
    for (OstLocal column = 0; column < matrix->columns; column++)
        seen[column] = -1;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        blocks += collect_columns(incidence, row, seen, NULL);
        OST_TRY(ost_limit_nonzeros(system->ctx, blocks));
        matrix->row_start[row + 1] = (OstLocal)blocks;
    }
    return OST_SUCCESS;
}

static OstStatus allocate_blocks(OstSystem *system)
{
    OstBlockMatrix *matrix = system->matrix;
    const size_t blocks = (size_t)matrix->row_start[matrix->rows];
    const OstMesh *mesh = system->mesh;
    const size_t pairs = (size_t)ost_pair_count(mesh->nodes_per_tet) * (size_t)mesh->tet_count;
    OST_TRY(OST_NEW(system->ctx, &matrix->column, blocks));
    OST_TRY(OST_NEW(system->ctx, &matrix->diagonal, matrix->rows));
    OST_TRY(OST_NEW(system->ctx, &matrix->value, 9 * blocks));
    OST_TRY(OST_NEW(system->ctx, &system->block_of_tet, pairs));
    for (size_t i = 0; i < pairs; i++)
        system->block_of_tet[i] = -1;
    return OST_SUCCESS;
}

/* Insertion sort: a row has about fifteen columns. */
static void sort_ascending(OstLocal *columns, OstLocal count)
{
    for (OstLocal i = 1; i < count; i++) {
        const OstLocal column = columns[i];
        OstLocal j = i;
        for (; j > 0 && columns[j - 1] > column; j--)
            columns[j] = columns[j - 1];
        columns[j] = column;
    }
}

/* Fills block_of_tet for one row: the blocks from the diagonal to the right, of every tet that touches the row. */
static void map_row(OstSystem *system, const RowTets *incidence, OstLocal row, const OstLocal *block_of_column)
{
    const int n = incidence->nodes;
    const size_t pairs = (size_t)ost_pair_count(n);
    for (OstLocal i = incidence->tet_start[row]; i < incidence->tet_start[row + 1]; i++) {
        const size_t tet = (size_t)incidence->tet[i];
        const OstLocal *of_tet = incidence->row + (size_t)n * tet;
        OstLocal *block = system->block_of_tet + pairs * tet;
        int a = 0;
        while (of_tet[a] != row)
            a++;
        for (int b = 0; b < n; b++)
            if (of_tet[b] >= row)
                block[a <= b ? ost_pair_index(n, a, b) : ost_pair_index(n, b, a)] = block_of_column[of_tet[b]];
    }
}

static void fill_rows(OstSystem *system, const RowTets *incidence, OstLocal *seen, OstLocal *block_of_column)
{
    OstBlockMatrix *matrix = system->matrix;
    for (OstLocal column = 0; column < matrix->columns; column++)
        seen[column] = -1;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const OstLocal first = matrix->row_start[row];
        const OstLocal count = collect_columns(incidence, row, seen, matrix->column + first);
        sort_ascending(matrix->column + first, count);
        for (OstLocal block = first; block < first + count; block++)
            block_of_column[matrix->column[block]] = block;
        matrix->diagonal[row] = block_of_column[row];
        map_row(system, incidence, row, block_of_column);
    }
}

OstStatus ost_system_make_pattern(OstSystem *system)
{
    OstContext *ctx = system->ctx;
    OstBlockMatrix *matrix = system->matrix;
    RowTets incidence = {0};
    OstLocal *seen = NULL;
    OstLocal *block_of_column = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_limit_incidences(ctx, system->mesh->tet_count, system->mesh->nodes_per_tet));
    OST_TRY_DONE(incidence_create(system, &incidence));
    OST_TRY_DONE(OST_NEW(ctx, &matrix->row_start, matrix->rows + 1));
    OST_TRY_DONE(OST_NEW(ctx, &seen, matrix->columns));
    OST_TRY_DONE(OST_NEW(ctx, &block_of_column, matrix->columns));
    OST_TRY_DONE(count_blocks(system, &incidence, seen));
    OST_TRY_DONE(allocate_blocks(system));
    fill_rows(system, &incidence, seen, block_of_column);
done:
    incidence_free(&incidence);
    OST_FREE(seen);
    OST_FREE(block_of_column);
    return status;
}

OstStatus ost_system_restore_scatter(OstSystem *system)
{
    const OstMesh *mesh = system->mesh;
    const int n = mesh->nodes_per_tet;
    const size_t pairs = (size_t)ost_pair_count(n);
    if (system->supports->links) {
        system->unlinked = *system->supports;
        system->unlinked.links = NULL;
        return system->whole ? OST_SUCCESS : ost_system_create(mesh, &system->unlinked, &system->whole);
    }
    OST_TRY(OST_NEW(system->ctx, &system->block_of_tet, pairs * (size_t)mesh->tet_count));
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        OstLocal ordered[OST_MAX_TET_NODES];
        OstLocal *block = system->block_of_tet + pairs * (size_t)tet;
        ost_order_nodes(n, mesh->node_label, mesh->tet_nodes + (size_t)n * (size_t)tet, ordered);
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++, block++) {
                const OstLocal of_a = system->row_of_node[ordered[a]], of_b = system->row_of_node[ordered[b]];
                const OstLocal row = of_a < of_b ? of_a : of_b;
                *block = -1;
                if (row >= 0 && row < system->matrix->rows)
                    *block =
                        ost_row_find(system->matrix->row_start, system->matrix->column, row, of_a < of_b ? of_b : of_a);
            }
    }
    return OST_SUCCESS;
}
