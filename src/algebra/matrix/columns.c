/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/columns.h"

enum { STRIP = 64 }; /* numbers of each vector in turn: what a strip has of all stays in the cache */

void ost_columns_pack(size_t n, int count, const double *const *vector, double *columns)
{
    for (size_t from = 0; from < n; from += STRIP) {
        const size_t end = from + STRIP < n ? from + STRIP : n;
        for (int k = 0; k < count; k++)
            for (size_t i = from; i < end; i++)
                columns[OST_COLUMNS * i + (size_t)k] = vector[k][i];
        for (int k = count; k < OST_COLUMNS; k++)
            for (size_t i = from; i < end; i++)
                columns[OST_COLUMNS * i + (size_t)k] = 0.0;
    }
}

void ost_columns_unpack(size_t n, int count, const double *columns, double *const *vector)
{
    for (size_t from = 0; from < n; from += STRIP) {
        const size_t end = from + STRIP < n ? from + STRIP : n;
        for (int k = 0; k < count; k++)
            for (size_t i = from; i < end; i++)
                vector[k][i] = columns[OST_COLUMNS * i + (size_t)k];
    }
}
