/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_SORT_H
#define ORTHOSTAT_CORE_SORT_H

#include "orthostat/context.h"

/* Local. Ascending. */
void ost_sort_numbers(size_t count, OstGlobal *numbers);

/* For bsearch among OstGlobal. */
int ost_compare_numbers(const void *a, const void *b);

#endif
