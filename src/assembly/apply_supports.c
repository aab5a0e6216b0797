/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"
#include "core/small.h"

#include <string.h>

static int is_coordinate(const double direction[3])
{
    return (direction[0] != 0.0) + (direction[1] != 0.0) + (direction[2] != 0.0) == 1;
}

static int is_partly_constrained(const OstSupport *support)
{
    return support->constrained > 0 && support->constrained < 3;
}

/* The account to book partly constrained nodes to, or OST_LEDGER_ACCOUNTS if there are none. */
static OstAccount account_of(const OstSupports *supports)
{
    const int slides = ost_effect_on(supports->effects, OST_EFFECT_SLIDING);
    OstAccount account = OST_LEDGER_ACCOUNTS;
    for (OstLocal s = 0; s < supports->count; s++) {
        const OstSupport *support = &supports->support[s];
        if (!is_partly_constrained(support))
            continue;
        if (account == OST_LEDGER_ACCOUNTS)
            account = OST_LEDGER_SUPPORTS;
        for (int k = 0; k < support->constrained; k++)
            if (slides && !is_coordinate(support->direction + 3 * k))
                account = OST_EFFECT_SLIDING;
    }
    return account;
}

/* block = P_row block P_column */
static void project_block(const OstSystem *system, OstLocal row, OstLocal column, double *block)
{
    double left[9];
    double right[9];
    double product[9];
    ost_supports_get(system->supports, system->node_of_row[row], left, NULL);
    ost_supports_get(system->supports, system->node_of_row[column], right, NULL);
    ost_multiply3(left, block, product);
    ost_multiply3(product, right, block);
}

/* Adds s(I - P) to a projected diagonal block. */
static void stiffen_constrained_directions(const OstSystem *system, OstLocal row, double *block)
{
    double projector[9];
    const int constrained = ost_supports_get(system->supports, system->node_of_row[row], projector, NULL);
    const double scale = (block[0] + block[4] + block[8]) / (3 - constrained);
    for (int i = 0; i < 9; i++)
        block[i] += scale * ((i % 4 == 0 ? 1.0 : 0.0) - projector[i]);
}

/* Fully constrained nodes have no row. */
static int is_supported(const OstSystem *system, OstLocal row)
{
    const OstLocal index = system->supports->index[system->node_of_row[row]];
    return index >= 0 && is_partly_constrained(&system->supports->support[index]);
}

/* Springs add to the diagonal. */
static void add_springs(OstSystem *system)
{
    const double *spring = system->supports->spring;
    for (OstLocal row = 0; row < system->matrix->rows && spring; row++) {
        double *block = system->matrix->value + 9 * (size_t)system->matrix->diagonal[row];
        for (size_t i = 0; i < 9; i++)
            block[i] += spring[9 * (size_t)system->node_of_row[row] + i];
    }
}

void ost_system_apply_supports(OstSystem *system)
{
    const OstBlockMatrix *matrix = system->matrix;
    add_springs(system);
    const OstAccount account = account_of(system->supports);
    if (account == OST_LEDGER_ACCOUNTS)
        return;
    ost_ledger_enter(system->ctx, account);
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const int row_is_supported = is_supported(system, row);
        for (OstLocal block = matrix->row_start[row]; block < matrix->row_start[row + 1]; block++)
            if (row_is_supported || is_supported(system, matrix->column[block]))
                project_block(system, row, matrix->column[block], matrix->value + 9 * (size_t)block);
        if (row_is_supported)
            stiffen_constrained_directions(system, row, matrix->value + 9 * (size_t)matrix->diagonal[row]);
    }
    ost_ledger_leave(system->ctx);
}
