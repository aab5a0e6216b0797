/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_COST_H
#define ORTHOSTAT_STUDY_COST_H

#include "study/cost_reference.h"
#include "study/forecast/stage.h"
#include "study/watch.h"

/* What accuracy costs: one case, solved with every combination of element order, uniform refinement and solver
 * tolerance, and adaptively to several accuracies; where rotations are large, also by other formulations and in more
 * load steps. Each run's error against a reference and as it was estimated, its seconds and its memory. */

enum {
    OST_COST_MOST_REFINEMENTS = 8,
    OST_COST_MOST_VALUES = 16,
    OST_COST_MOST_RUNS = 2 * (OST_COST_MOST_REFINEMENTS + 1) * OST_COST_MOST_VALUES + 7 * OST_COST_MOST_VALUES,
    OST_COST_REASON_SIZE = OST_ERROR_TEXT_SIZE
};

typedef struct OstCostVariants {
    int order_count, refinement_count, tolerance_count, accuracy_count, formulation_count, load_step_count;
    int order[OST_COST_MOST_VALUES];
    int refinement[OST_COST_MOST_VALUES];
    double tolerance[OST_COST_MOST_VALUES];
    double accuracy[OST_COST_MOST_VALUES]; /* asked of adaptive runs: relative errors in the norm of the energy */
    OstFormulation formulation[OST_COST_MOST_VALUES]; /* beside the case's own, where rotations are large */
    int load_steps[OST_COST_MOST_VALUES];             /* the least number of them there */
    double max_seconds;                               /* for all runs together */
    double max_bytes;                                 /* of our own arrays, over all ranks; 0: no bound */
} OstCostVariants;

typedef enum { OST_COST_WAITING, OST_COST_DONE, OST_COST_NOT_RUN, OST_COST_FAILED } OstCostState;

typedef struct OstCostRun {
    int order, refinement;
    double tolerance; /* of the relative residual */
    double accuracy;  /* of an adaptive run, which has no tolerance, refinement -1 and its last mesh's order; else 0 */
    int levels;       /* meshes that it went through */
    OstFormulation formulation; /* in place of the case's, if `other` */
    int other;
    int load_steps;         /* at least so many; 0: as many as are needed */
    OstNewtonReport newton; /* found */
    OstCostState state;
    char reason[OST_COST_REASON_SIZE]; /* NOT_RUN, FAILED; DONE: why an accuracy was not met, or empty */
    double predicted_seconds;          /* from earlier runs; 0: not known */
    double seconds_left;               /* of the study, as the run begins */
    int repeats;                       /* short runs are repeated, and the fastest counts */
    OstGlobal unknowns, tets;
    int iterations;
    double residual;
    double seconds; /* of the slowest rank, as are those by phase */
    double phase[OST_STAGES];
    double bytes;     /* our own arrays at their peak, over all ranks */
    double estimate;  /* of the relative error in the norm of the energy, by the run itself; NaN: not known */
    double true_norm; /* that error by the reference of the strain energy; NaN: not known */
    OstWatched watched[OST_COST_MOST_QUANTITIES];
    double error[OST_COST_MOST_QUANTITIES];       /* relative; NaN: not known */
    double least_error[OST_COST_MOST_QUANTITIES]; /* relative: a smaller one is by accident */
} OstCostRun;

typedef struct OstCostQuantity {
    const char *name;
    const OstWatch *watch; /* NULL: the largest displacement */
    OstCostReference reference;
} OstCostQuantity;

typedef struct OstCost OstCost;

/* Collective. Solves a variant of the case; fills `unknowns` to `watched` of the run. */
typedef OstStatus (*OstCostMeasure)(OstCost *cost, const OstCase *variant, OstCostRun *run);

struct OstCost {
    OstContext *ctx;
    const OstCase *c;
    OstCostVariants variants;
    OstCostMeasure measure;
    int placed;             /* are the points of quantities moved to vertices? */
    int heard[2];           /* were the warnings of order 1, 2 printed? */
    OstWatch strain_energy; /* a quantity of every case */
    OstWatch watch[OST_MOST_WATCHES];
    int quantity_count;
    OstCostQuantity quantity[OST_COST_MOST_QUANTITIES];
    int run_count;
    OstCostRun *run; /* in the order they run: by refinement, order, and tolerance, the tightest first */
    double seconds;  /* of the whole study */
};

/* Local. Orders 1 and 2, no to two refinements, tolerances 1e-2, 1e-4 and 1e-8; no adaptive runs, formulations and load
 * steps. */
OstCostVariants ost_cost_default_variants(void);

/* Collective. Lists the runs; the case must outlive the study. Raises OST_INVALID_INPUT for a value out of range. */
OstStatus ost_cost_create(const OstCase *c, const OstCostVariants *variants, OstCost **cost);
void ost_cost_destroy(OstCost **cost);

/* Collective. Runs, in order, what fits into the bounds of time and memory, and judges it. A run that fails is listed
 * with its reason; returns the last failure if no run has an answer. */
OstStatus ost_cost_run(OstCost *cost);

/* Collective. One run: mesh, assembly, solve, estimate of the error. No fields are recovered or written. */
OstStatus ost_cost_measure(OstCost *cost, const OstCase *variant, OstCostRun *run);

/* Local. Is it one of the combinations of order, refinement and tolerance, and nothing more? References are theirs. */
static inline int ost_cost_is_plain(const OstCostRun *run)
{
    return run->accuracy == 0.0 && !run->other && run->load_steps == 0;
}

/* Local. What else a run is: another formulation, load steps; or nothing. */
void ost_cost_describe(const OstCostRun *run, char *text, size_t size);
extern const char *const ost_cost_formulation_word[]; /* by OstFormulation */

/* Local. Chooses the references and fills the errors. ost_cost_run ends with it. */
void ost_cost_judge(OstCost *cost);

/* Local. An upper estimate of a run's error: its distance from the reference, but at least the reference's uncertainty
 * and at least what the change from the previous refinement leaves at the best possible rate (a value that passes the
 * reference is near it by accident). NaN if there is none. */
double ost_cost_claim(const OstCost *cost, const OstCostRun *run, int quantity);

/* Local. The fastest run whose estimated error is at most `target`; -1: none. */
int ost_cost_cheapest(const OstCost *cost, int quantity, double target);

/* Local. The fastest combination of order, refinement and tolerance whose true error in the norm of the energy is
 * within what an adaptive run was asked for; -1: none. */
int ost_cost_by_hand(const OstCost *cost, const OstCostRun *asked);

/* Local. The runs that no faster run beats, the fastest first; `runs` has room for OST_COST_MOST_RUNS. Returns how
 * many. */
int ost_cost_frontier(const OstCost *cost, int quantity, int *runs);

/* A run that was not made: the refinement after the finest of an order. */
typedef struct OstCostNext {
    int order, refinement;
    double tolerance;
    double unknowns, error, seconds, bytes;
    double error_factor, seconds_factor; /* of a refinement, as observed in the last one */
} OstCostNext;

/* Local. What the next refinement of an order would give, from how error, seconds and memory changed in the last one.
 * Returns 0 if there are no two refinements whose errors are known and fall. */
int ost_cost_next(const OstCost *cost, int quantity, int order, OstCostNext *next);

/* The errors for which the cheapest run is listed. */
enum { OST_COST_TARGETS = 5 };
extern const double ost_cost_target[OST_COST_TARGETS];

extern const char *const ost_cost_state_word[]; /* by OstCostState */

/* Local; rank 0 prints. The tables for a person. */
void ost_cost_print(const OstCost *cost);

/* Local; rank 0 writes the whole study to a file (aside, then renamed) or, for "-", to standard output. */
OstStatus ost_cost_write_csv(const OstCost *cost, const char *path);
OstStatus ost_cost_write_json(const OstCost *cost, const char *path);

#endif
