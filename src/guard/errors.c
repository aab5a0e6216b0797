/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/guard.h"

/* Reactions may balance each other or be none: their error is over no less than this share of the loads. */
static const double least_reaction = 1e-3;

/* Squares, of the answer and of its error. */
enum { DISPLACEMENT, DISPLACEMENT_ERROR, REACTION, REACTION_ERROR, STRESS, STRESS_ERROR, LOAD, SUMS };

typedef struct Tets {
    const double *error;
    double *sums;
} Tets;

static void add_stresses(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                         const OstMeans *means)
{
    const Tets *tets = data;
    OstSimd error[3 * OST_MAX_TET_NODES];
    OstMeans of_error;
    (void)u;
    ost_batch_gather_vectors(batch, element->nodes, tets->error, error);
    element->means(batch->x, &batch->elasticity, error, &of_error);
    for (int slot = 0; slot < batch->count; slot++)
        for (int p = 0; p < 6; p++) {
            tets->sums[STRESS] += means->stress[p][slot] * means->stress[p][slot];
            tets->sums[STRESS_ERROR] += of_error.stress[p][slot] * of_error.stress[p][slot];
        }
}

static double square_of(const double vector[3])
{
    return ost_dot3(vector, vector);
}

/* `internal` and `of_error` are the internal forces at the node, of the answer and of its error. */
static void add_node(const OstProblem *problem, OstLocal node, const double *internal, const double *of_error,
                     double *sums)
{
    double projector[9], free_force[3], free_error[3], free_load[3], force[3];
    const double *load = problem->force + 3 * (size_t)node;
    const int constrained = ost_supports_get(problem->supports, node, projector, NULL);
    for (int i = 0; i < 3; i++)
        force[i] = internal[i] - load[i];
    ost_apply3(projector, load, free_load);
    sums[LOAD] += square_of(free_load);
    if (constrained == 0)
        return;
    ost_apply3(projector, force, free_force);
    ost_apply3(projector, of_error, free_error);
    for (int i = 0; i < 3; i++) {
        sums[REACTION] += (force[i] - free_force[i]) * (force[i] - free_force[i]);
        sums[REACTION_ERROR] += (of_error[i] - free_error[i]) * (of_error[i] - free_error[i]);
    }
}

/* Relative to the root of `square`; zero is relative to zero. */
static double relative(double square_of_error, double square)
{
    return square_of_error > 0.0 ? sqrt(square_of_error) / sqrt(square) : 0.0;
}

OstStatus ost_guard_errors(const OstProblem *problem, const double *displacement, const double *error,
                           OstErrors *errors)
{
    OstContext *ctx = problem->ctx;
    const size_t n = 3 * (size_t)problem->mesh->owned_nodes;
    double *internal = NULL, *of_error = NULL;
    double sums[SUMS] = {0.0};
    Tets tets = {error, sums};
    OstStatus status = OST_NEW(ctx, &internal, n);
    OST_THEN(OST_NEW(ctx, &of_error, n));
    OST_THEN(ost_problem_force(problem, displacement, internal));
    OST_THEN(ost_problem_force(problem, error, of_error));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t i = 0; i < n; i++) {
        sums[DISPLACEMENT] += displacement[i] * displacement[i];
        sums[DISPLACEMENT_ERROR] += error[i] * error[i];
    }
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++)
        add_node(problem, node, internal + 3 * (size_t)node, of_error + 3 * (size_t)node, sums);
    ost_visit_means(problem->mesh, problem->field, displacement, add_stresses, &tets);
    OST_TRY_DONE(ost_sum(ctx, SUMS, sums));
    const double reaction = fmax(sums[REACTION], least_reaction * least_reaction * sums[LOAD]);
    *errors = (OstErrors){.known = 1,
                          .displacement = relative(sums[DISPLACEMENT_ERROR], sums[DISPLACEMENT]),
                          .reaction = problem->free_body ? 0.0 : relative(sums[REACTION_ERROR], reaction),
                          .stress = relative(sums[STRESS_ERROR], sums[STRESS])};
done:
    OST_FREE(internal);
    OST_FREE(of_error);
    return status;
}
