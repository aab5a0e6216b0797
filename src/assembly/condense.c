/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/levers.h"
#include "assembly/links/row_parts.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"
#include "core/small.h"

#include <stdlib.h>
#include <string.h>

/* T' K T. K is that of all nodes, with their supports. Blocks between nodes that follow nobody stay as they are; each
 * other one becomes an entry for every pair of leaders, and goes to the rank that has the first one's row. */

/* A block of the condensed matrix, or a part of one; numbers of rows over all ranks. */
typedef struct Entry {
    OstGlobal row, column;
    double value[9];
} Entry;

typedef struct Condensation {
    OstSystem *system;
    const OstLinks *links;
    const OstTurning *turning; /* of links, or NULL */
    OstRowNumbers rows;
    OstLocal count, capacity;
    Entry *entry;
    OstLocal ghosts;
    OstGlobal *ghost; /* rows of other ranks, ascending */
} Condensation;

static OstStatus add_entry(Condensation *c, OstGlobal row, OstGlobal column, const double value[9])
{
    if (c->count == c->capacity) {
        const OstLocal capacity = c->capacity / 2 * 3 + 4096;
        OST_TRY(OST_RESIZE(c->system->ctx, &c->entry, capacity));
        c->capacity = capacity;
    }
    Entry *entry = &c->entry[c->count++];
    entry->row = row;
    entry->column = column;
    memcpy(entry->value, value, sizeof entry->value);
    return OST_SUCCESS;
}

static OstStatus spread_block(Condensation *c, const OstRowParts *left, const OstRowParts *right, const double *block)
{
    for (int a = 0; a < left->count; a++)
        for (int b = 0; b < right->count; b++) {
            double product[9], value[9];
            if (left->row[a] < 0 || right->row[b] < 0)
                continue;
            ost_multiply3(block, right->weight[b], product);
            ost_multiply3_transposed_left(left->weight[a], product, value);
            OST_TRY(add_entry(c, left->row[a], right->row[b], value));
        }
    return OST_SUCCESS;
}

/* The blocks that have a follower's row or column. */
static OstStatus spread_blocks(Condensation *c)
{
    const OstSystem *whole = c->system->whole;
    const OstBlockMatrix *matrix = whole->matrix;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const OstLocal node = whole->node_of_row[row];
        OstRowParts left, right;
        ost_row_parts(&c->rows, node, &left);
        for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
            const OstLocal other = whole->node_of_row[matrix->column[k]];
            if (!ost_link_of(c->links, node) && !ost_link_of(c->links, other))
                continue;
            ost_row_parts(&c->rows, other, &right);
            OST_TRY(spread_block(c, &left, &right, matrix->value + 9 * (size_t)k));
        }
    }
    return OST_SUCCESS;
}

/* What forces at the ends of levers add to the rows of their leaders. */
static OstStatus bend_levers(Condensation *c)
{
    for (OstLocal i = 0; c->turning && c->turning->levers && i < c->links->lever_count; i++) {
        const OstLever *lever = &c->links->lever[i];
        OstRowParts parts;
        ost_row_parts(&c->rows, lever->node, &parts);
        for (int n = 0; n < parts.count * parts.count; n++) {
            const int k = n / parts.count, l = n % parts.count;
            double block[9], product[9];
            if (parts.row[k] < 0 || parts.row[l] < 0)
                continue;
            ost_lever_block(lever, c->turning->levers + 36 * (size_t)i, k, l, block);
            ost_multiply3(block, lever->projector[l], product);
            ost_multiply3(lever->projector[k], product, block);
            OST_TRY(add_entry(c, parts.row[k], parts.row[l], block));
        }
    }
    return OST_SUCCESS;
}

static int compare_entries(const void *a, const void *b)
{
    const Entry *x = a;
    const Entry *y = b;
    if (x->row != y->row)
        return x->row < y->row ? -1 : 1;
    return (x->column > y->column) - (x->column < y->column);
}

/* Sorts the entries, and sums those of one block. */
static void merge_entries(Condensation *c)
{
    OstLocal kept = 0;
    if (c->count > 0)
        qsort(c->entry, (size_t)c->count, sizeof *c->entry, compare_entries);
    for (OstLocal i = 0; i < c->count; i++) {
        if (kept == 0 || compare_entries(&c->entry[kept - 1], &c->entry[i]) != 0) {
            c->entry[kept++] = c->entry[i];
            continue;
        }
        for (int k = 0; k < 9; k++)
            c->entry[kept - 1].value[k] += c->entry[i].value[k];
    }
    c->count = kept;
}

static OstStatus find_owners(const Condensation *c, int **owner)
{
    OstContext *ctx = c->system->ctx;
    const OstBlockMatrix *matrix = c->system->matrix;
    OstGlobal *end = NULL;
    OstStatus status = OST_NEW(ctx, &end, ost_size(ctx));
    OST_THEN(OST_NEW(ctx, owner, c->count));
    status = ost_agree(ctx, status);
    OST_THEN(ost_number_ends(ctx, matrix->first_row + matrix->rows, end));
    for (OstLocal i = 0; i < c->count && status == OST_SUCCESS; i++)
        (*owner)[i] = ost_number_holder(end, ost_size(ctx), c->entry[i].row);
    OST_FREE(end);
    return status;
}

/* Collective. Each entry goes to the rank of its row. */
static OstStatus send_entries(Condensation *c)
{
    OstContext *ctx = c->system->ctx;
    OstRoute *route = NULL;
    Entry *arrived = NULL;
    int *owner = NULL;
    OstStatus status = find_owners(c, &owner);
    OST_THEN(ost_agree(ctx, ost_route_create(ctx, c->count, 1, owner, &route)));
    OST_THEN(ost_agree(ctx, ost_route_carry(route, sizeof *arrived, c->entry, (void **)&arrived)));
    if (status == OST_SUCCESS) {
        OST_FREE(c->entry);
        c->entry = arrived;
        c->count = c->capacity = route->receives;
        merge_entries(c);
    }
    ost_route_destroy(&route);
    OST_FREE(owner);
    return status;
}

static int is_mine(const Condensation *c, OstGlobal row)
{
    const OstBlockMatrix *matrix = c->system->matrix;
    return row >= matrix->first_row && row < matrix->first_row + matrix->rows;
}

/* The blocks of K that stay, of one row of it: returns how many, with their columns unless that is NULL. */
static OstLocal plain_blocks(const Condensation *c, OstLocal row, OstGlobal *column, const double **value)
{
    const OstSystem *whole = c->system->whole;
    const OstBlockMatrix *matrix = whole->matrix;
    OstLocal count = 0;
    if (row < 0 || ost_link_of(c->links, whole->node_of_row[row]))
        return 0;
    for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
        const OstLocal other = whole->node_of_row[matrix->column[k]];
        if (ost_link_of(c->links, other))
            continue;
        if (column) {
            column[count] = c->rows.of_node[other];
            value[count] = matrix->value + 9 * (size_t)k;
        }
        count++;
    }
    return count;
}

/* The rows of other ranks among all columns; and what else moves a local tet, which a mixed form's pressures ask for.
 */
static OstStatus list_ghosts(Condensation *c)
{
    const OstSystem *whole = c->system->whole;
    const OstLocal owned = c->system->mesh->owned_nodes;
    const OstLocal most = c->count + (whole->matrix->columns - whole->matrix->rows) + (c->links->slots - owned);
    OST_TRY(OST_NEW(c->system->ctx, &c->ghost, most));
    for (OstLocal i = 0; i < c->count; i++)
        if (!is_mine(c, c->entry[i].column))
            c->ghost[c->ghosts++] = c->entry[i].column;
    for (OstLocal column = whole->matrix->rows; column < whole->matrix->columns; column++) {
        const OstGlobal row = c->rows.of_node[whole->node_of_row[column]];
        if (row >= 0)
            c->ghost[c->ghosts++] = row;
    }
    for (OstLocal slot = owned; slot < c->links->slots; slot++)
        if (c->rows.of_leader[slot] >= 0)
            c->ghost[c->ghosts++] = c->rows.of_leader[slot];
    c->ghosts = ost_numbers_sort(c->ghosts, c->ghost);
    return OST_SUCCESS;
}

static OstLocal column_of(const Condensation *c, OstGlobal row)
{
    const OstBlockMatrix *matrix = c->system->matrix;
    if (is_mine(c, row))
        return (OstLocal)(row - matrix->first_row);
    return matrix->rows + ost_numbers_find(c->ghosts, c->ghost, row);
}

typedef struct Block {
    OstLocal column;
    double value[9];
} Block;

static int compare_blocks(const void *a, const void *b)
{
    return ((const Block *)a)->column - ((const Block *)b)->column;
}

static void put_block(Block *block, OstLocal column, const double value[9])
{
    block->column = column;
    memcpy(block->value, value, sizeof block->value);
}

/* One row: blocks that stay, and entries; those of one column are added. `room` holds all. Returns the count. */
static OstLocal gather_row(const Condensation *c, OstLocal row, OstLocal *next, OstGlobal *column, const double **value,
                           Block *room)
{
    const OstSystem *system = c->system;
    const OstGlobal number = system->matrix->first_row + row;
    const OstLocal count = plain_blocks(c, system->whole->row_of_node[system->node_of_row[row]], column, value);
    OstLocal all = 0, kept = 0;
    for (; all < count; all++)
        put_block(&room[all], column_of(c, column[all]), value[all]);
    for (; *next < c->count && c->entry[*next].row == number; (*next)++)
        put_block(&room[all++], column_of(c, c->entry[*next].column), c->entry[*next].value);
    qsort(room, (size_t)all, sizeof *room, compare_blocks);
    for (OstLocal i = 0; i < all; i++) {
        if (kept == 0 || room[kept - 1].column != room[i].column) {
            room[kept++] = room[i];
            continue;
        }
        for (int k = 0; k < 9; k++)
            room[kept - 1].value[k] += room[i].value[k];
    }
    return kept;
}

/* A carrier's constrained components have no stiffness of their own. */
static void stiffen_prescribed(double *block)
{
    double most = 0.0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, block[4 * i]);
    for (int i = 0; i < 3; i++)
        if (block[4 * i] == 0.0)
            block[4 * i] = most;
}

/* Adds what forces at the arms of rigid faces do to the rows of their rotations. */
static void add_turning(const Condensation *c)
{
    const OstMesh *mesh = c->system->mesh;
    OstBlockMatrix *matrix = c->system->matrix;
    for (int f = 0; c->turning && c->turning->faces && f < c->links->face_count; f++) {
        const OstRigidFace *face = &c->links->face[f];
        const OstGlobal node = face->carrier[1] - mesh->first_node;
        if (face->carrier[1] < 0 || node < 0 || node >= mesh->owned_nodes)
            continue;
        double *block = matrix->value + 9 * (size_t)matrix->diagonal[c->system->row_of_node[node]];
        for (int k = 0; k < 9; k++)
            block[k] += c->turning->faces[9 * f + k] / (face->length * face->length);
    }
}

/* The most blocks that a row may have before those of one column are added, and of all rows. */
static void count_blocks(const Condensation *c, OstLocal *most, OstLocal *all)
{
    const OstSystem *system = c->system;
    OstLocal next = 0;
    *most = *all = 0;
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        const OstLocal first = next;
        while (next < c->count && c->entry[next].row == system->matrix->first_row + row)
            next++;
        const OstLocal count =
            next - first + plain_blocks(c, system->whole->row_of_node[system->node_of_row[row]], NULL, NULL);
        *all += count;
        *most = count > *most ? count : *most;
    }
}

/* Room for at most `all` blocks. */
static OstStatus make_room(OstBlockMatrix *matrix, OstLocal all)
{
    OST_TRY(ost_limit_nonzeros(matrix->ctx, all));
    OST_TRY(OST_NEW(matrix->ctx, &matrix->row_start, matrix->rows + 1));
    OST_TRY(OST_NEW(matrix->ctx, &matrix->diagonal, matrix->rows));
    OST_TRY(OST_NEW(matrix->ctx, &matrix->column, all));
    return OST_NEW(matrix->ctx, &matrix->value, 9 * (size_t)all);
}

/* Those of a matrix that is filled again have the same columns. */
static OstStatus make_rows(const Condensation *c, int is_new)
{
    OstContext *ctx = c->system->ctx;
    OstBlockMatrix *matrix = c->system->matrix;
    OstLocal most, all, next = 0, filled = 0;
    OstGlobal *column = NULL;
    const double **value = NULL;
    Block *room = NULL;
    OstStatus status = OST_SUCCESS;
    count_blocks(c, &most, &all);
    OST_TRY_DONE(OST_NEW(ctx, &column, most));
    OST_TRY_DONE(OST_NEW(ctx, &value, most));
    OST_TRY_DONE(OST_NEW(ctx, &room, most));
    if (is_new)
        OST_TRY_DONE(make_room(matrix, all));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const OstLocal count = gather_row(c, row, &next, column, value, room);
        for (OstLocal k = 0; k < count; k++, filled++) {
            matrix->column[filled] = room[k].column;
            memcpy(matrix->value + 9 * (size_t)filled, room[k].value, sizeof room[k].value);
            if (room[k].column == row)
                matrix->diagonal[row] = filled;
        }
        matrix->row_start[row + 1] = filled;
        if (ost_link_of(c->links, c->system->node_of_row[row]))
            stiffen_prescribed(matrix->value + 9 * (size_t)matrix->diagonal[row]);
    }
    if (is_new) {
        OST_TRY_DONE(OST_RESIZE(ctx, &matrix->column, filled));
        OST_TRY_DONE(OST_RESIZE(ctx, &matrix->value, 9 * (size_t)filled));
    }
done:
    OST_FREE(column);
    OST_FREE(value);
    OST_FREE(room);
    return status;
}

/* Ghosts come last; no node is known for them here. */
static OstStatus make_columns(const Condensation *c)
{
    OstSystem *system = c->system;
    OstBlockMatrix *matrix = system->matrix;
    matrix->columns = matrix->rows + c->ghosts;
    OST_TRY(OST_RESIZE(system->ctx, &system->node_of_row, matrix->columns));
    OST_TRY(OST_RESIZE(system->ctx, &matrix->label, matrix->columns));
    for (OstLocal column = matrix->rows; column < matrix->columns; column++)
        system->node_of_row[column] = -1;
    return OST_SUCCESS;
}

static OstStatus make_halo(const Condensation *c)
{
    OstContext *ctx = c->system->ctx;
    OstBlockMatrix *matrix = c->system->matrix;
    OST_TRY(ost_agree(ctx, make_columns(c)));
    OST_TRY(ost_agree(ctx, ost_halo_create(ctx, matrix->rows, matrix->first_row, c->ghosts, c->ghost, &matrix->halo)));
    return ost_agree(ctx, ost_halo_import(matrix->halo, sizeof *matrix->label, matrix->label));
}

static OstStatus condense(Condensation *c)
{
    OstContext *ctx = c->system->ctx;
    OstBlockMatrix *matrix = c->system->matrix;
    OST_TRY(ost_row_numbers_create(c->links, c->system->row_of_node, matrix->first_row, &c->rows));
    OstStatus status = spread_blocks(c);
    OST_THEN(bend_levers(c));
    merge_entries(c);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(send_entries(c));
    OST_TRY(ost_agree(ctx, list_ghosts(c)));
    const int is_new = !matrix->row_start;
    if (is_new)
        OST_TRY(make_halo(c));
    OST_TRY(ost_agree(ctx, make_rows(c, is_new)));
    add_turning(c);
    return OST_SUCCESS;
}

OstStatus ost_system_condense(OstSystem *system, const OstTurning *turning)
{
    Condensation c = {.system = system, .links = system->supports->links, .turning = turning};
    ost_ledger_enter(system->ctx, OST_LEDGER_SUPPORTS);
    const OstStatus status = condense(&c);
    ost_row_numbers_clear(&c.rows);
    OST_FREE(c.entry, c.ghost);
    ost_ledger_leave(system->ctx);
    return status;
}
