/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_SCALE_SCALE_H
#define ORTHOSTAT_STUDY_SCALE_SCALE_H

#include "case/case_data.h"
#include "study/forecast/stage.h"
#include "study/scale/network.h"

/* How a case scales: solved in several sizes on several numbers of ranks, of which those of the program take part and
 * the others wait. Seconds, iterations, memory, and counts of what the ranks compute and send, which do not depend on
 * the machine; from them a model foretells larger numbers of ranks. */

enum {
    OST_SCALE_MOST_VALUES = 16,
    OST_SCALE_MOST_RUNS = (OST_SCALE_MOST_VALUES + 1) * OST_SCALE_MOST_VALUES,
    OST_SCALE_LEVELS = OST_MAX_LEVELS + 1, /* of multigrid, that of quadratic tets included */
    OST_SCALE_REASON_SIZE = 512
};

typedef struct OstScaleVariants {
    int rank_count, size_count;
    int ranks[OST_SCALE_MOST_VALUES];   /* ascending */
    double size[OST_SCALE_MOST_VALUES]; /* unknowns; none: the case as it is */
    int weak;                           /* grow the first size with the ranks, too? */
    double max_seconds;                 /* for all runs together */
    double max_bytes;                   /* over all ranks; 0: no bound */
    OstNetwork network;                 /* that large numbers of ranks are foretold for */
} OstScaleVariants;

typedef enum { OST_SCALE_WAITING, OST_SCALE_DONE, OST_SCALE_NOT_RUN, OST_SCALE_FAILED } OstScaleState;

/* A count on one rank: the mean over the ranks, and the most of one. */
typedef struct OstScaleCount {
    double mean, most;
} OstScaleCount;

/* What a rank does in one iteration: on a level of multigrid, or outside of all. */
typedef struct OstScaleWork {
    double unknowns; /* over all ranks */
    double ranks;    /* that have some of them */
    double visits, exchanges, reductions, gathers;
    OstScaleCount messages, bytes, gathered, multiplied;
} OstScaleWork;

/* Plain data: ranks that wait get a copy of it. */
typedef struct OstScaleRun {
    int ranks;
    int is_weak, is_strong;
    double target; /* unknowns asked for; 0: the case as it is */
    OstScaleState state;
    OstStatus status;                   /* FAILED: how */
    char reason[OST_SCALE_REASON_SIZE]; /* NOT_RUN, FAILED */
    char engine[64];
    int crowded; /* more ranks than cores: its seconds say nothing */
    int repeats;
    OstGlobal unknowns, tets;
    int iterations, cycles; /* cycles: of multigrid, in the solve; corrections of rounding iterate outside of it */
    double residual;
    double seconds; /* of the slowest rank, as are those by stage */
    double stage[OST_STAGES];
    double bytes;         /* our own arrays at their peak, over all ranks */
    OstScaleCount memory; /* the same of a rank */
    OstScaleCount nodes, tets_of_rank, work;
    int levels;
    OstScaleWork iteration; /* what is done outside of the levels */
    OstScaleWork level[OST_SCALE_LEVELS];
    OstScaleWork setup; /* of multigrid, as a whole */
} OstScaleRun;

/* Collective. Reads the case anew, in the context of the ranks that take part. */
typedef OstStatus (*OstScaleRead)(OstContext *ctx, const void *from, OstCase **c);

typedef struct OstScale {
    OstContext *ctx;
    OstScaleRead read;
    const void *from;
    char *path, *title;
    OstScaleVariants variants;
    double own_unknowns; /* of the case as it is, about */
    OstNetwork here;     /* measured; `memory` from the runs */
    int cores, ranks;    /* of the machine with the most ranks a core */
    int run_count;
    OstScaleRun *run;
    double seconds; /* of the whole study */
} OstScale;

/* Local. Ranks 1, 2, 4 … up to `most`, the case as it is, weak scaling too, ten minutes, InfiniBand. */
OstScaleVariants ost_scale_default_variants(int most);

/* Collective. Lists the runs of the case, which `read` reads again from `from` for each of them. Raises
 * OST_INVALID_INPUT for a value out of range. */
OstStatus ost_scale_create(const OstCase *c, OstScaleRead read, const void *from, const OstScaleVariants *variants,
                           OstScale **scale);
void ost_scale_destroy(OstScale **scale);

/* Collective. Runs, in order, what fits into the bounds. A run that fails is listed with its reason; returns the last
 * failure if no run has an answer. */
OstStatus ost_scale_run(OstScale *scale);

/* Collective over the context of the case: one run of it, as ost_scale_run makes them. */
OstStatus ost_scale_measure(OstCase *c, OstScaleRun *run);

/* Local. Changes the size of a case to about so many unknowns: the divisions of a shape, or, where the case has a mesh
 * file or names vertices by their labels, its uniform refinements. `own` is what it has now. */
void ost_scale_resize(OstCase *c, double own, double unknowns);

/* Local. Unknowns of a shape, before supports; 0 for a mesh file. */
double ost_scale_unknowns(const OstCase *c);

extern const char *const ost_scale_state_word[]; /* by OstScaleState */

/* Local. The run that others are compared with: of the same size (weak: of the first size) on the fewest ranks, with
 * seconds that count. NULL if there is none. */
const OstScaleRun *ost_scale_reference(const OstScale *scale, const OstScaleRun *run, int weak);

/* Local; rank 0 prints. The tables for a person. */
void ost_scale_print(const OstScale *scale);

/* Local; rank 0 writes the whole study to a file (aside, then renamed) or, for "-", to standard output. */
OstStatus ost_scale_write_csv(const OstScale *scale, const char *path);
OstStatus ost_scale_write_json(const OstScale *scale, const char *path);

#endif
