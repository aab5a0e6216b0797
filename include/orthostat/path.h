/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PATH_H
#define ORTHOSTAT_PATH_H

#include "orthostat/problem.h"
#include "orthostat/result.h"
#include "orthostat/scene.h"

OST_API_BEGIN

/* A quasi-static path: the states at rest at ascending pseudo-times, each found from the one before. A linear problem
 * is solved once for each function of time, and superposed. */
typedef struct OstPath OstPath;

/* A step that was taken. */
enum { OST_PATH_NOTES = 20 };
typedef struct OstPathStep {
    double t;
    double largest_displacement;
    double strain_energy;
    double largest_strain, largest_rotation; /* as in OstChecks */
    int iterations;                          /* of the linear solver, behind this answer */
    int newton_iterations;                   /* 0 where linear theory served */
    int load_steps;                          /* that Newton's method took */
    int linear;                              /* was linear theory used? */
    double note[OST_PATH_NOTES];             /* the caller's own numbers, which checkpoints keep */
} OstPathStep;

/* Collective. A path of the problem (which outlives it, and is not changed meanwhile) or of a scene's case, through
 * `count` pseudo-times, ascending and not negative, copied. Raises OST_INVALID_INPUT for others, or if the case has no
 * path. */
OstStatus ost_path_create(OstProblem *problem, const OstSolverOptions *options, int count, const double *times,
                          OstPath **path);
OstStatus ost_scene_path(const OstScene *scene, OstPath **path);
void ost_path_destroy(OstPath **path);

/* Collective. Takes the next step; fields and result as in ost_analysis_solve. After a failure the step
 * is not done; where Newton's method could not follow the load, the result is the last state at rest that it reached.
 */
OstStatus ost_path_advance(OstPath *path, unsigned fields, OstResult **result);

/* Local. Steps of the whole path, and those taken; a step that was taken (from 0), whose notes may be changed. */
int ost_path_count(const OstPath *path);
int ost_path_done(const OstPath *path);
OstPathStep *ost_path_step(OstPath *path, int number);

/* Collective. Writes a checkpoint: what was done so far, and all that the next step depends on. The file is replaced
 * when it is complete. */
OstStatus ost_path_save(const OstPath *path, const char *file);

/* Collective. Goes on from a checkpoint, which any number of ranks may have made: on the same number the steps that
 * follow have the same bits as without the interruption, on another they agree within rounding. Without a file the path
 * stays at its beginning. Raises OST_INVALID_INPUT for a damaged file, or one of another case, mesh, formulation or
 * solver's options; the path can then only be destroyed. */
OstStatus ost_path_resume(OstPath *path, const char *file);

OST_API_END

#endif
