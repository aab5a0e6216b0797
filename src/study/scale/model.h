/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_SCALE_MODEL_H
#define ORTHOSTAT_STUDY_SCALE_MODEL_H

#include "study/scale/scale.h"

/* A model of an iteration on any number of ranks, made from the counts of a run: what a rank reads of memory, its
 * messages to neighbours, their bytes, sums over all ranks, and the coarsest level (docs/how-it-scales.md). */

/* Columns: name, label. */
#define OST_SCALE_PART_TABLE(X)        \
    X(OST_SCALE_MEMORY, "memory")      \
    X(OST_SCALE_MESSAGES, "messages")  \
    X(OST_SCALE_BYTES, "bytes")        \
    X(OST_SCALE_SUMS, "sums over all") \
    X(OST_SCALE_COARSEST, "coarsest level")
#define OST_SCALE_PART_ENUM(name, label) name,
typedef enum { OST_SCALE_PART_TABLE(OST_SCALE_PART_ENUM) OST_SCALE_PARTS } OstScalePart;
#undef OST_SCALE_PART_ENUM

extern const char *const ost_scale_part_label[]; /* by OstScalePart */

typedef struct OstScaleForecast {
    double ranks, unknowns;
    int levels;
    double coarsest;              /* unknowns of the last level */
    double part[OST_SCALE_PARTS]; /* seconds of an iteration */
    double seconds;               /* their sum */
    double efficiency;            /* of the forecast's ranks: memory's share */
    double messages, bytes;       /* that a rank sends in an iteration */
    int slowest_level;            /* where most of the messages are */
    double partition, lists;      /* seconds of the setup: METIS on rank 0; lists of all ranks */
} OstScaleForecast;

/* Local. From the counts of `run`, which must have levels. */
void ost_scale_foretell(const OstScaleRun *run, const OstNetwork *network, double ranks, double unknowns,
                        OstScaleForecast *forecast);

/* Local. The run to foretell from: of those with multigrid, the one with the most ranks, and of them the largest. NULL:
 * none. */
const OstScaleRun *ost_scale_base(const OstScale *scale);

/* Local. Bytes a second that a rank's entries of matrices go through memory, in the runs whose seconds count; times the
 * ranks of a machine. 0: there are none. */
double ost_scale_memory_rate(const OstScale *scale);

/* Local. What a rank sends in an iteration, on all levels. */
void ost_scale_sent(const OstScaleRun *run, OstScaleCount *messages, OstScaleCount *bytes);

/* Local. Foretells a run for this machine from that of the same size on fewer ranks, but more than one; from itself if
 * there is none, which checks its seconds alone. Returns 0 on one rank. */
int ost_scale_check(const OstScale *scale, const OstScaleRun *run, const OstScaleRun **from,
                    OstScaleForecast *forecast);

/* Local. Our own arrays in the run with the most. */
double ost_scale_most_bytes(const OstScale *scale);

enum { OST_SCALE_FORECASTS = 5 };
extern const double ost_scale_foretold[OST_SCALE_FORECASTS]; /* numbers of ranks */

/* Local. The first thing that stops scaling, in words: where, of the forecasts with growing ranks, efficiency falls
 * below a half, or that it does not. */
void ost_scale_first_limit(const OstScaleForecast *forecast, int count, char *text, size_t size);

#endif
