/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/prolongator.h"

#include "core/kernel.h"
#include "core/memory.h"

#include <string.h>

void ost_prolongator_destroy(OstProlongator **prolongator)
{
    if (!*prolongator)
        return;
    OST_FREE((*prolongator)->row_start, (*prolongator)->column, (*prolongator)->value, (*prolongator)->rest);
    ost_halo_destroy(&(*prolongator)->halo);
    ost_exchange_destroy(&(*prolongator)->exchange);
    OST_FREE(*prolongator);
}

OST_UNROLLED void add_rows(const OstProlongator *p, const float *value, int height, const double *restrict c,
                           double *restrict x)
{
    for (OstLocal i = 0; i < p->rows; i++) {
        OstRow6 sum[OST_MODES] = {{{0}, {0}}};
        for (OstLocal k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
            const float *a = value + (size_t)(height * OST_MODES) * (size_t)k;
            OstRow6 row, v;
            ost_load_row6(c + OST_MODES * (size_t)p->column[k], &v);
            for (int r = 0; r < height; r++) {
                ost_load_float_row6(a + OST_MODES * r, &row);
                ost_add_product_row6(&row, &v, &sum[r]);
            }
        }
        for (int r = 0; r < height; r++)
            x[(size_t)height * (size_t)i + (size_t)r] += ost_sum_row6(&sum[r]);
    }
}

OST_UNROLLED void restrict_rows(const OstProlongator *p, const float *value, int height, const double *restrict x,
                                double *restrict c)
{
    for (OstLocal i = 0; i < p->rows; i++) {
        const double *v = x + (size_t)height * (size_t)i;
        for (OstLocal k = p->row_start[i]; k < p->row_start[i + 1]; k++) {
            const float *a = value + (size_t)(height * OST_MODES) * (size_t)k;
            OstRow6 row, sum = {{0}, {0}};
            for (int r = 0; r < height; r++) {
                ost_load_float_row6(a + OST_MODES * r, &row);
                ost_add_scaled_row6(v[r], &row, &sum);
            }
            ost_add_row6(&sum, c + OST_MODES * (size_t)p->column[k]);
        }
    }
}

static void book(const OstProlongator *prolongator)
{
    const double entries = (double)prolongator->row_start[prolongator->rows];
    ost_ledger_multiplied(prolongator->ctx,
                          entries * prolongator->height * OST_MODES * (prolongator->rest ? 2.0 : 1.0));
}

OST_KERNEL void ost_prolongator_add(const OstProlongator *prolongator, double *c, double *x)
{
    ost_exchange_import(prolongator->exchange, c);
    book(prolongator);
    for (const float *value = prolongator->value; value; value = value == prolongator->value ? prolongator->rest : NULL)
        if (prolongator->height == 3)
            add_rows(prolongator, value, 3, c, x);
        else
            add_rows(prolongator, value, 6, c, x);
}

OST_KERNEL void ost_prolongator_restrict(const OstProlongator *prolongator, const double *x, double *c)
{
    memset(c, 0, OST_MODES * (size_t)prolongator->columns * sizeof *c);
    for (const float *value = prolongator->value; value; value = value == prolongator->value ? prolongator->rest : NULL)
        if (prolongator->height == 3)
            restrict_rows(prolongator, value, 3, x, c);
        else
            restrict_rows(prolongator, value, 6, x, c);
    ost_exchange_add_to_owners(prolongator->exchange, c);
    book(prolongator);
}
