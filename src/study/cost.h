/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_COST_H
#define ORTHOSTAT_STUDY_COST_H

#include "study/cost_reference.h"
#include "study/watch.h"

/* What accuracy costs: one case, run over a ladder of element order × uniform refinement × solver tolerance, every
 * answer's error against a reference, and what each took. */

enum {
    OST_COST_MOST_REFINEMENTS = 8,
    OST_COST_MOST_RUNGS = 16,
    OST_COST_MOST_RUNS = 2 * (OST_COST_MOST_REFINEMENTS + 1) * OST_COST_MOST_RUNGS,
    OST_COST_REASON_SIZE = OST_ERROR_TEXT_SIZE
};

typedef struct OstCostLadder {
    int order_count, refinement_count, tolerance_count;
    int order[OST_COST_MOST_RUNGS];
    int refinement[OST_COST_MOST_RUNGS];
    double tolerance[OST_COST_MOST_RUNGS];
    double max_seconds; /* for all runs together */
    double max_bytes;   /* of our own arrays, over all ranks; 0: no bound */
} OstCostLadder;

/* What a run's seconds go to. */
#define OST_COST_PHASE_TABLE(X)      \
    X(OST_COST_REST, "rest")         \
    X(OST_COST_MESH, "mesh")         \
    X(OST_COST_ASSEMBLY, "assembly") \
    X(OST_COST_SETUP, "setup")       \
    X(OST_COST_SOLVE, "solve")
#define OST_COST_PHASE_ENUM(name, label) name,
typedef enum { OST_COST_PHASE_TABLE(OST_COST_PHASE_ENUM) OST_COST_PHASES } OstCostPhase;
#undef OST_COST_PHASE_ENUM

typedef enum { OST_COST_WAITING, OST_COST_DONE, OST_COST_NOT_RUN, OST_COST_FAILED } OstCostState;

typedef struct OstCostRun {
    int order, refinement;
    double tolerance; /* of the relative residual */
    OstCostState state;
    char reason[OST_COST_REASON_SIZE]; /* NOT_RUN, FAILED */
    double foreseen_seconds;           /* before it ran; 0: not known */
    int repeats;                       /* short runs are repeated, and the fastest counts */
    OstGlobal unknowns, tets;
    int iterations;
    double residual;
    double seconds; /* of the slowest rank, as are those by phase */
    double phase[OST_COST_PHASES];
    double bytes; /* our own arrays at their peak, over all ranks */
    OstWatched watched[OST_COST_MOST_QUANTITIES];
    double error[OST_COST_MOST_QUANTITIES];    /* relative; NaN: not known */
    double accident[OST_COST_MOST_QUANTITIES]; /* relative: an error below this is luck, not order */
} OstCostRun;

typedef struct OstCostQuantity {
    const char *name;
    const OstWatch *watch; /* NULL: the largest displacement */
    OstCostReference reference;
} OstCostQuantity;

typedef struct OstCost OstCost;

/* Measures one run of the variant of the case that it is told to: fills unknowns to watched. Collective. */
typedef OstStatus (*OstCostMeasure)(OstCost *cost, const OstCase *variant, OstCostRun *run);

struct OstCost {
    OstContext *ctx;
    const OstCase *c;
    OstCostLadder ladder;
    OstCostMeasure measure;
    int placed;             /* are the watched places moved to vertices? */
    int heard[2];           /* have the warnings of order 1, 2 been said? */
    OstWatch strain_energy; /* watched in any case */
    OstWatch watch[OST_MOST_WATCHES];
    int quantity_count;
    OstCostQuantity quantity[OST_COST_MOST_QUANTITIES];
    int run_count;
    OstCostRun *run; /* in the order they run: by refinement, order, and tolerance, the tightest first */
    double seconds;  /* of the whole study */
};

/* Local. Orders 1 and 2, no to two refinements, tolerances 1e-2, 1e-4 and 1e-8. */
OstCostLadder ost_cost_default_ladder(void);

/* Collective. Lists the runs; the case outlives the study. Raises OST_INVALID_INPUT for a rung that is out of range. */
OstStatus ost_cost_create(const OstCase *c, const OstCostLadder *ladder, OstCost **cost);
void ost_cost_destroy(OstCost **cost);

/* Collective. Runs what fits into the bounds, in order, and judges it. What is refused or does not converge is listed
 * with its reason; fails, with the reason of the last one, only if no run has an answer. */
OstStatus ost_cost_run(OstCost *cost);

/* Collective. One run as it is: mesh, assembly, solve; no fields are recovered or written. */
OstStatus ost_cost_measure(OstCost *cost, const OstCase *variant, OstCostRun *run);

/* Local. Chooses the references and fills the errors; ost_cost_run does it at its end. */
void ost_cost_judge(OstCost *cost);

/* Local. The error of a run that may be claimed: not below what is known of the reference, nor below what the change
 * from the refinement before can leave at the best rate of its order (values on their way past the reference come near
 * it by accident). NaN if there is none. */
double ost_cost_claim(const OstCost *cost, const OstCostRun *run, int quantity);

/* Local. The fastest run whose error may be claimed to be at most `target`; -1: none. */
int ost_cost_cheapest(const OstCost *cost, int quantity, double target);

/* Local. The runs that no faster one beats, from fast to exact; `runs` has room for OST_COST_MOST_RUNS. Returns
 * how many. */
int ost_cost_frontier(const OstCost *cost, int quantity, int *runs);

/* Local. The errors that are priced in the end. */
enum { OST_COST_TARGETS = 4 };
double ost_cost_target(int number);

const char *ost_cost_phase_label(OstCostPhase phase);
const char *ost_cost_state_word(OstCostState state);

/* Local; rank 0 prints. The price list for a person. */
void ost_cost_print(const OstCost *cost);

/* Local; rank 0 writes. All of it, to a file (written aside and renamed) or, for "-", to standard output. */
OstStatus ost_cost_write_csv(const OstCost *cost, const char *path);
OstStatus ost_cost_write_json(const OstCost *cost, const char *path);

#endif
