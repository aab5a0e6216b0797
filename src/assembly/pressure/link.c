/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/pressure/link.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"
#include "core/small.h"

#include <stdlib.h>
#include <string.h>

/* A part of a row of B T. */
typedef struct Part {
    OstLocal column;
    double value[3];
} Part;

/* An entry for the rank that has the matrix's row; numbers over all ranks. */
typedef struct Far {
    OstGlobal pressure, row;
    double value[3];
} Far;

typedef struct Linking {
    const OstPressureSpace *space;
    const OstSystem *system;
    const OstRowNumbers *rows;
    OstCoupling *coupling;
    OstGlobal *row_of_column; /* of the matrix's columns; ghosts ascending */
    OstGlobal first;          /* of this rank's pressures */
    OstGlobal *number;        /* of the space's pressures */
    OstLocal *start, *column; /* B T: of this rank's pressures, then of ghosts */
    double *value;
    OstLocal far_count;
    Far *far; /* to other ranks, then from them */
    OstLocal ghosts;
    OstGlobal *ghost; /* pressures, ascending */
} Linking;

static OstStatus number_all(Linking *linking)
{
    OstContext *ctx = linking->space->ctx;
    const OstBlockMatrix *matrix = linking->system->matrix;
    OstGlobal all;
    OST_TRY(ost_number_from(ctx, linking->space->owned, &linking->first, &all));
    OstStatus status = OST_NEW(ctx, &linking->row_of_column, matrix->columns);
    OST_THEN(OST_NEW(ctx, &linking->number, linking->space->count));
    OST_TRY(ost_agree(ctx, status));
    for (OstLocal row = 0; row < matrix->rows; row++)
        linking->row_of_column[row] = matrix->first_row + row;
    for (OstLocal i = 0; i < linking->space->owned; i++)
        linking->number[i] = linking->first + i;
    status = ost_halo_import(matrix->halo, sizeof *linking->row_of_column, linking->row_of_column);
    OST_THEN(ost_halo_import(linking->space->halo, sizeof *linking->number, linking->number));
    return ost_agree(ctx, status);
}

static OstLocal column_of(const Linking *linking, OstGlobal row)
{
    const OstBlockMatrix *matrix = linking->system->matrix;
    if (row >= matrix->first_row && row < matrix->first_row + matrix->rows)
        return (OstLocal)(row - matrix->first_row);
    return matrix->rows + ost_numbers_find(matrix->columns - matrix->rows, linking->row_of_column + matrix->rows, row);
}

static int compare_parts(const void *a, const void *b)
{
    const OstLocal x = ((const Part *)a)->column, y = ((const Part *)b)->column;
    return (x > y) - (x < y);
}

/* What a node's numbers of B are for the rows that it is made of. Returns how many parts. */
static OstLocal spread_node(const Linking *linking, OstLocal node, const double value[3], Part *part)
{
    double projector[9], own[3];
    OstRowParts of;
    OstLocal count = 0;
    ost_row_parts(linking->rows, node, &of);
    memcpy(own, value, sizeof own);
    if (!ost_link_of(linking->rows->links, node)) {
        ost_supports_get(linking->system->supports, node, projector, NULL);
        ost_apply3(projector, value, own);
    }
    for (int k = 0; k < of.count; k++) {
        if (of.row[k] < 0)
            continue;
        part[count].column = column_of(linking, of.row[k]);
        ost_apply3_transposed(of.weight[k], own, part[count++].value);
    }
    return count;
}

/* Sorts the parts, and sums those of one column; returns how many are left. */
static OstLocal merge_parts(OstLocal count, Part *part)
{
    OstLocal kept = 0;
    if (count > 0)
        qsort(part, (size_t)count, sizeof *part, compare_parts);
    for (OstLocal i = 0; i < count; i++) {
        if (kept == 0 || part[kept - 1].column != part[i].column) {
            part[kept++] = part[i];
            continue;
        }
        for (int c = 0; c < 3; c++)
            part[kept - 1].value[c] += part[i].value[c];
    }
    return kept;
}

/* How many parts the rows have at the most: all of them, and the longest. */
static OstGlobal count_parts(const Linking *linking, OstLocal *longest)
{
    const OstCoupling *coupling = linking->coupling;
    OstGlobal all = 0;
    *longest = 0;
    for (OstLocal i = 0; i < coupling->rows; i++) {
        OstLocal of_row = 0;
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++) {
            const OstLink *link = ost_link_of(linking->rows->links, coupling->column[k]);
            of_row += link ? link->count : 1;
        }
        all += of_row;
        *longest = of_row > *longest ? of_row : *longest;
    }
    return all;
}

static OstStatus make_own_rows(Linking *linking)
{
    const OstCoupling *coupling = linking->coupling;
    OstContext *ctx = coupling->ctx;
    OstLocal longest, filled = 0;
    Part *part = NULL;
    const OstGlobal all = count_parts(linking, &longest);
    OST_TRY(ost_limit_nonzeros(ctx, all));
    OstStatus status = OST_NEW(ctx, &part, longest);
    OST_THEN(OST_NEW(ctx, &linking->start, coupling->rows + 1));
    OST_THEN(OST_NEW(ctx, &linking->column, all));
    OST_THEN(OST_NEW(ctx, &linking->value, 3 * (size_t)all));
    for (OstLocal i = 0; i < coupling->rows && status == OST_SUCCESS; i++) {
        OstLocal count = 0;
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++)
            count += spread_node(linking, coupling->column[k], coupling->value + 3 * (size_t)k, part + count);
        count = merge_parts(count, part);
        for (OstLocal k = 0; k < count; k++, filled++) {
            linking->column[filled] = part[k].column;
            memcpy(linking->value + 3 * (size_t)filled, part[k].value, sizeof part[k].value);
        }
        linking->start[i + 1] = filled;
    }
    OST_FREE(part);
    return status;
}

static OstStatus list_far(Linking *linking, int **owner)
{
    OstContext *ctx = linking->space->ctx;
    const OstBlockMatrix *matrix = linking->system->matrix;
    const OstCoupling *coupling = linking->coupling;
    OstGlobal *end = NULL;
    const OstLocal all = linking->start[coupling->rows];
    OstLocal count = 0;
    for (OstLocal k = 0; k < all; k++)
        count += linking->column[k] >= matrix->rows;
    OstStatus status = OST_NEW(ctx, &linking->far, count);
    OST_THEN(OST_NEW(ctx, owner, count));
    OST_THEN(OST_NEW(ctx, &end, ost_size(ctx)));
    status = ost_agree(ctx, status);
    OST_THEN(ost_number_ends(ctx, matrix->first_row + matrix->rows, end));
    for (OstLocal i = 0; i < coupling->rows && status == OST_SUCCESS; i++)
        for (OstLocal k = linking->start[i]; k < linking->start[i + 1]; k++) {
            if (linking->column[k] < matrix->rows)
                continue;
            Far *far = &linking->far[linking->far_count];
            *far = (Far){.pressure = linking->number[i], .row = linking->row_of_column[linking->column[k]]};
            memcpy(far->value, linking->value + 3 * (size_t)k, sizeof far->value);
            (*owner)[linking->far_count++] = ost_number_holder(end, ost_size(ctx), far->row);
        }
    OST_FREE(end);
    return status;
}

/* They arrive in the order of pressures, as ranks are, and those of each. */
static OstStatus send_far(Linking *linking)
{
    OstContext *ctx = linking->space->ctx;
    OstRoute *route = NULL;
    Far *arrived = NULL;
    int *owner = NULL;
    OstStatus status = list_far(linking, &owner);
    OST_THEN(ost_agree(ctx, ost_route_create(ctx, linking->far_count, 1, owner, &route)));
    OST_THEN(ost_agree(ctx, ost_route_carry(route, sizeof *arrived, linking->far, (void **)&arrived)));
    if (status == OST_SUCCESS) {
        OST_FREE(linking->far);
        linking->far = arrived;
        linking->far_count = route->receives;
    }
    ost_route_destroy(&route);
    OST_FREE(owner);
    return status;
}

/* Those that act on this rank's rows, and those of the rows of M. */
static OstStatus list_ghosts(Linking *linking)
{
    const OstPressureSpace *space = linking->space;
    OstLocal listed = 0;
    OST_TRY(OST_NEW(space->ctx, &linking->ghost, (size_t)linking->far_count + (size_t)(space->count - space->owned)));
    for (OstLocal i = 0; i < linking->far_count; i++)
        linking->ghost[listed++] = linking->far[i].pressure;
    for (OstLocal i = space->owned; i < space->count; i++)
        linking->ghost[listed++] = linking->number[i];
    linking->ghosts = ost_numbers_sort(listed, linking->ghost);
    return OST_SUCCESS;
}

static OstStatus add_ghost_rows(Linking *linking)
{
    OstContext *ctx = linking->space->ctx;
    const OstLocal rows = linking->coupling->rows;
    OstLocal filled = linking->start[rows], next = 0;
    OST_TRY(ost_limit_nonzeros(ctx, (OstGlobal)filled + linking->far_count));
    OST_TRY(OST_RESIZE(ctx, &linking->start, rows + linking->ghosts + 1));
    OST_TRY(OST_RESIZE(ctx, &linking->column, filled + linking->far_count));
    OST_TRY(OST_RESIZE(ctx, &linking->value, 3 * (size_t)(filled + linking->far_count)));
    for (OstLocal ghost = 0; ghost < linking->ghosts; ghost++) {
        for (; next < linking->far_count && linking->far[next].pressure == linking->ghost[ghost]; next++, filled++) {
            linking->column[filled] = column_of(linking, linking->far[next].row);
            memcpy(linking->value + 3 * (size_t)filled, linking->far[next].value, sizeof linking->far[next].value);
        }
        linking->start[rows + ghost + 1] = filled;
    }
    return OST_SUCCESS;
}

static OstStatus take_rows(Linking *linking)
{
    OstCoupling *coupling = linking->coupling;
    const OstLocal rows = coupling->rows;
    OST_TRY(ost_agree(coupling->ctx, add_ghost_rows(linking)));
    OST_TRY(ost_agree(coupling->ctx, ost_halo_create(coupling->ctx, rows, linking->first, linking->ghosts,
                                                     linking->ghost, &coupling->own_halo)));
    coupling->halo = coupling->own_halo;
    coupling->columns = rows + linking->ghosts;
    for (OstLocal k = 0; k < coupling->mass_start[rows]; k++) {
        OstLocal *column = &coupling->mass_column[k];
        if (*column >= rows)
            *column = rows + ost_numbers_find(linking->ghosts, linking->ghost, linking->number[*column]);
    }
    OST_FREE(coupling->row_start, coupling->column, coupling->value);
    coupling->row_start = linking->start;
    coupling->column = linking->column;
    coupling->value = linking->value;
    linking->start = linking->column = NULL;
    linking->value = NULL;
    return OST_SUCCESS;
}

OstStatus ost_coupling_link(const OstPressureSpace *space, const OstSystem *system, const OstRowNumbers *rows,
                            OstCoupling *coupling)
{
    Linking linking = {.space = space, .system = system, .rows = rows, .coupling = coupling};
    OstStatus status = number_all(&linking);
    OST_THEN(ost_agree(space->ctx, make_own_rows(&linking)));
    OST_THEN(send_far(&linking));
    OST_THEN(ost_agree(space->ctx, list_ghosts(&linking)));
    OST_THEN(take_rows(&linking));
    OST_FREE(linking.row_of_column, linking.number);
    OST_FREE(linking.start, linking.column, linking.value);
    OST_FREE(linking.far, linking.ghost);
    return status;
}
