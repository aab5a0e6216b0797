/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_LABEL_RANGES_H
#define ORTHOSTAT_MESH_LABEL_RANGES_H

#include "mesh/mesh_data.h"

/* Local. Sorts ranges by their first labels. */
void ost_ranges_sort(OstGlobal count, OstLabelRange *ranges);

/* Local. Puts ranges in ascending order and joins those that overlap or follow each other; returns how many are left.
 * (1:3 5 4 is 1:5.) */
OstGlobal ost_ranges_join(OstGlobal count, OstLabelRange *ranges);

/* Local. Of joined ranges: the number of labels, and the index of the range with a label, or -1. */
OstGlobal ost_ranges_total(OstGlobal count, const OstLabelRange *ranges);
OstGlobal ost_ranges_find(OstGlobal count, const OstLabelRange *ranges, OstGlobal label);

#endif
