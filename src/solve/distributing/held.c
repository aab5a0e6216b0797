/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/distributing/held.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "solve/distributing/distributing.h"
#include "solve/distributing/selection.h"

#include <string.h>

extern void dpotrf_(const char *uplo, const int *n, double *a, const int *leading, int *info, size_t length);
extern void dpotrs_(const char *uplo, const int *n, const int *columns, const double *a, const int *leading, double *b,
                    const int *leading_b, int *info, size_t length);

/* A coupling, and h_z at the undeformed body. */
typedef struct Curvature {
    OstMovedSelection selection;
    double bend[OST_MOST_SUMS * OST_MOST_SUMS];
} Curvature;

struct OstHeldMotions {
    const OstProblem *problem;
    OstResponses of; /* B, D and the Cholesky factor of B'D */
    double *room;    /* of.count */
    int couplings;
    Curvature *curvature;
};

void ost_held_motions_destroy(OstHeldMotions **held)
{
    if (!*held)
        return;
    for (int c = 0; c < (*held)->couplings; c++)
        ost_moved_selection_close(&(*held)->curvature[c].selection);
    OST_FREE((*held)->curvature);
    OST_FREE((*held)->room);
    ost_responses_release(&(*held)->of);
    OST_FREE(*held);
}

/* By the multipliers of the answer at t. */
static OstStatus find_curvature(const OstProblem *problem, int load, double t, double *force, Curvature *curvature)
{
    const OstScene *scene = problem->scene;
    const double z[OST_MOST_SUMS] = {0.0};
    double x[OST_MOST_GIVEN] = {0.0}, lack[OST_MOST_GIVEN], slope[OST_MOST_GIVEN * OST_MOST_SUMS], h[OST_MOST_SUMS];
    OST_TRY(ost_moved_selection_open(scene, load, force, &curvature->selection));
    for (int k = 0; k < curvature->selection.count; k++)
        for (int f = 0; f < ost_problem_functions(problem); f++)
            x[k] += ost_problem_factor(problem, f, t) *
                    ost_scene_drive(scene, f, load)->of_point[curvature->selection.component[k]];
    return ost_moved_selection_state(problem->ctx, &curvature->selection, z, x, OST_MOST_SUMS, lack, slope, h,
                                     curvature->bend);
}

static OstStatus find_curvatures(double t, OstHeldMotions *held)
{
    const OstScene *scene = held->problem->scene;
    double *force = NULL;
    OstStatus status = OST_NEW(scene->ctx, &force, 3 * (size_t)scene->mesh->node_count);
    OST_THEN(OST_NEW(scene->ctx, &held->curvature, (size_t)scene->c->load_count));
    OST_THEN(OST_NEW(scene->ctx, &held->room, (size_t)held->of.count));
    status = ost_agree(scene->ctx, status);
    for (int i = 0; i < scene->c->load_count && status == OST_SUCCESS; i++)
        if (scene->c->loads[i].kind == OST_LOAD_DISTRIBUTING)
            status = find_curvature(held->problem, i, t, force, &held->curvature[held->couplings++]);
    OST_FREE(force);
    return status;
}

OstStatus ost_held_motions_create(const OstProblem *problem, OstSolver *solver, double t, int *known,
                                  OstHeldMotions **held)
{
    int info = 0;
    *known = 1;
    *held = NULL;
    if (!ost_distributing_any(problem))
        return OST_SUCCESS;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, held, 1)));
    (*held)->problem = problem;
    OstStatus status = ost_distributing_respond(problem, solver, &(*held)->of);
    OST_THEN(find_curvatures(t, *held));
    if (status == OST_SUCCESS)
        dpotrf_("U", &(*held)->of.count, (*held)->of.products, &(*held)->of.count, &info, 1);
    *known = status == OST_SUCCESS && info == 0;
    if (!*known)
        ost_held_motions_destroy(held);
    return status == OST_INVALID_INPUT ? OST_SUCCESS : status;
}

/* vector -= of (B'D)^-1 by' vector; the pressures' part of D likewise. */
static OstStatus project(const OstHeldMotions *held, const double *by, const double *of, double *vector,
                         double *pressure)
{
    const OstResponses *all = &held->of;
    const int one = 1;
    int info = 0;
    for (size_t k = 0; k < (size_t)all->count; k++) {
        held->room[k] = 0.0;
        for (size_t i = 0; i < all->rows; i++)
            held->room[k] += by[k * all->rows + i] * vector[i];
    }
    OST_TRY(ost_sum(held->problem->ctx, all->count, held->room));
    dpotrs_("U", &all->count, &one, all->products, &all->count, held->room, &all->count, &info, 1);
    for (size_t k = 0; k < (size_t)all->count; k++) {
        for (size_t i = 0; i < all->rows; i++)
            vector[i] -= held->room[k] * of[k * all->rows + i];
        for (size_t i = 0; pressure && i < all->pressures; i++)
            pressure[i] -= held->room[k] * all->pressure[k * all->pressures + i];
    }
    return OST_SUCCESS;
}

OstStatus ost_held_motions_project(const OstHeldMotions *held, double *v, double *pressure)
{
    return project(held, held->of.force, held->of.response, v, pressure);
}

OstStatus ost_held_motions_project_force(const OstHeldMotions *held, double *force)
{
    return project(held, held->of.response, held->of.force, force, NULL);
}

OstStatus ost_held_motions_bend(const OstHeldMotions *held, const double *v, double *force)
{
    const size_t owned = (size_t)held->problem->mesh->owned_nodes;
    for (int c = 0; c < held->couplings; c++) {
        const Curvature *curvature = &held->curvature[c];
        const OstMovedSelection *selection = &curvature->selection;
        double z[OST_MOST_SUMS] = {0.0};
        for (int s = 0; s < selection->sums; s++)
            for (size_t n = 0; n < owned; n++)
                z[s] += ost_moved_selection_weight(selection, s, n) * v[3 * n + (size_t)(s % 3)];
        OST_TRY(ost_sum(held->problem->ctx, selection->sums, z));
        for (int s = 0; s < selection->sums; s++) {
            double h = 0.0;
            for (int k = 0; k < selection->sums; k++)
                h += curvature->bend[s * OST_MOST_SUMS + k] * z[k];
            for (size_t n = 0; n < owned; n++)
                force[3 * n + (size_t)(s % 3)] -= ost_moved_selection_weight(selection, s, n) * h;
        }
    }
    return OST_SUCCESS;
}
