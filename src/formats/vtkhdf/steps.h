/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_STEPS_H
#define ORTHOSTAT_FORMATS_VTKHDF_STEPS_H

#include "formats/vtkhdf/hdf5.h"
#include "formats/vtkhdf/vtkhdf.h"

typedef struct OstStep {
    double value;
    char *name;
    int refused, unfinished; /* is it no answer? */
    int place;               /* of its rows, from 0 */
} OstStep;

/* What a file says of its steps besides their arrays. Start from {0}. */
typedef struct OstStepList {
    int count;
    OstStep *step;
    char status[32]; /* of the last that is none; else empty */
    int reason_count;
    char **reason; /* of all steps, with the step's name where there is a series */
} OstStepList;

/* Local. One step more, which is put where its value belongs; `name` is NULL, and `value` counts for nothing, where
 * there is no series. */
OstStatus ost_step_list_add(OstContext *ctx, OstStepList *list, double value, const char *name,
                            const OstOutputMark *mark);
void ost_step_list_free(OstStepList *list);

/* Collective. What of the steps is no answer: see vtkhdf.h. */
OstStatus ost_step_list_write_marks(OstHdf5 *h5, const OstStepList *list);

/* Collective. The group Steps, but for the offsets of arrays on points and cells, and the names by which our reader
 * finds a step; `pieces` of the one mesh. */
OstStatus ost_step_list_write(OstHdf5 *h5, const OstStepList *list, int pieces);

/* Collective. Where an array of a step begins: with `rows` in each of them, 0 for one that is the same in all. */
OstStatus ost_step_list_write_offsets(OstHdf5 *h5, const OstStepList *list, const char *group, const char *array,
                                      OstGlobal rows);

/* Local. The names once more, for those who look at the file in ParaView; the file is closed. */
OstStatus ost_step_list_add_names(OstContext *ctx, const OstStepList *list, const char *path);

/* --- reading --- */

/* Local. Raises OST_INVALID_INPUT for steps of several meshes. */
OstStatus ost_steps_check(const OstHdf5 *h5);

/* Local. Takes a word FIELD:STEP apart, where there are steps and no field of the whole word on cells or points. */
enum { OST_LONGEST_FIELD = 200 };
void ost_steps_split(const OstHdf5 *h5, const char *word, char field[OST_LONGEST_FIELD], char step[OST_LONGEST_FIELD]);

/* Local. The rows of a dataset, `count` in each step: that of `step`, by its name or else its number from 1, begins
 * with row `first`. Raises OST_INVALID_INPUT where a step is missing or not known. `group` is CellData or PointData. */
OstStatus ost_steps_find(const OstHdf5 *h5, const char *group, const char *field, const char *step, OstGlobal count,
                         OstGlobal *rows, OstGlobal *first);

/* Local. What a dry run has to read for these; `group` is NULL for the first. */
OstStatus ost_steps_try(const OstHdf5 *h5, const char *group, const char *field);

#endif
