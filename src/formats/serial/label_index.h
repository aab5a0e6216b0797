/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_LABEL_INDEX_H
#define ORTHOSTAT_FORMATS_SERIAL_LABEL_INDEX_H

#include "orthostat/context.h"

typedef struct OstLabelledPosition {
    OstGlobal label;
    OstGlobal position;
} OstLabelledPosition;

/* Finds the position of a label in a list. Labels that count up by one take no memory. */
typedef struct OstLabelIndex {
    OstGlobal count;
    OstGlobal first;             /* label of position 0 */
    OstLabelledPosition *sorted; /* by label; NULL if they count up by one */
    int repeated;                /* does some label occur twice? Then the next: */
    OstGlobal repeated_label;
} OstLabelIndex;

/* Local. */
OstStatus ost_label_index_create(OstContext *ctx, OstGlobal count, const OstGlobal *label, OstLabelIndex *index);
void ost_label_index_clear(OstLabelIndex *index);

/* Local. Position of a label, or -1. */
OstGlobal ost_label_index_find(const OstLabelIndex *index, OstGlobal label);

#endif
