/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_SWEEP_SWEEP_H
#define ORTHOSTAT_STUDY_SWEEP_SWEEP_H

#include "case/case_data.h"
#include "problem/result_data.h"

/* A case solved for several values of some of its numbers, each combined with each, under all of its load cases. */

enum { OST_MOST_SWEEP_KEYS = 6, OST_MOST_SWEEP_RUNS = 10000 };

typedef struct OstSweepRun {
    const char *value[OST_MOST_SWEEP_KEYS]; /* of each key */
    const char *load_case;                  /* its name; NULL: the case has none, or one was taken */
    char *failure;                          /* why there is no answer; NULL if there is one */
    OstGlobal unknowns;
    double largest_displacement, strain_energy;
    double relative_error; /* that the mesh makes; NAN if not known */
    int iterations, newton_iterations;
    double seconds;  /* of load cases an equal share of what those of its values took */
    double *watched; /* of each that the sweep watches, NAN where it has none; NULL without an answer */
} OstSweepRun;

typedef struct OstSweep {
    OstContext *ctx;
    const char *path;      /* of the case */
    OstCaseText text;      /* of the case, with the settings that are common to all */
    const char *load_case; /* the one to take, or NULL */
    int case_count; /* load cases of which a run is made for the same values, in their order; 0: there are none */
    const OstLoadCase *cases;
    int key_count;
    const OstSweepKey *key;
    int watch_count; /* as in the first case that was read, of all load cases */
    char **watch;
    int run_count, done, failures;
    OstSweepRun *run; /* load cases vary first, then the last key */
    /* Collective. Called with what is done, at most every second; or NULL. */
    OstStatus (*keep)(const struct OstSweep *sweep, const void *kept);
    const void *kept;
} OstSweep;

/* Collective. Solves for all values. `sweep` comes with all but watches and runs. Raises what is wrong with the case or
 * its keys in the first run; a later run that fails says so. */
OstStatus ost_sweep_run(OstSweep *sweep);
void ost_sweep_clear(OstSweep *sweep);

/* Local; rank 0 prints a table of the runs that are done, or writes it as CSV, or everything as JSON; "-" is standard
 * output. */
void ost_sweep_print(const OstSweep *sweep);
OstStatus ost_sweep_write_csv(const OstSweep *sweep, const char *to);
OstStatus ost_sweep_write_json(const OstSweep *sweep, const char *to);

#endif
