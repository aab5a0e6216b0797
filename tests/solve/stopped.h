/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_STOPPED_H
#define ORTHOSTAT_TESTS_STOPPED_H

#include "../case/case_text.h"
#include "core/memory.h"
#include "problem/problem.h"

#include "orthostat/orthostat.h"

/* The same case solved until the error of its equations is small beside that of its mesh, and to the end. */
typedef struct Stopped {
    OstCase *c;
    OstScene *scene;
    OstResult *result, *whole;
    double distance;     /* between the two in the norm of the energy */
    double displacement; /* the same in the 2-norm of the displacement, over that */
} Stopped;

static inline void destroy(Stopped *stopped)
{
    ost_result_destroy(&stopped->result);
    ost_result_destroy(&stopped->whole);
    ost_scene_destroy(&stopped->scene);
    ost_case_destroy(&stopped->c);
}

static inline void measure_distance(Stopped *stopped)
{
    const OstMesh *mesh = stopped->result->mesh;
    const size_t n = 3 * (size_t)mesh->node_count, owned = 3 * (size_t)mesh->owned_nodes;
    OstProblem *problem = NULL;
    double *difference = NULL, energy = 0.0, sums[2] = {0.0};
    assert_success(OST_NEW(ctx, &difference, n));
    for (size_t i = 0; i < n; i++)
        difference[i] = stopped->result->displacement[i] - stopped->whole->displacement[i];
    for (size_t i = 0; i < owned; i++) {
        sums[0] += difference[i] * difference[i];
        sums[1] += stopped->whole->displacement[i] * stopped->whole->displacement[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    assert_success(ost_scene_problem(stopped->scene, &problem));
    ost_problem_set_formulation(problem, OST_FORMULATION_LINEAR);
    assert_success(ost_problem_energy(problem, 0.0, difference, &energy));
    stopped->distance = sqrt(2.0 * energy);
    stopped->displacement = sqrt(sums[0] / sums[1]);
    ost_problem_destroy(&problem);
    OST_FREE(difference);
}

/* Takes over the case. */
static inline void solve_twice(OstCase *c, OstMeshChunk **chunk, Stopped *stopped)
{
    *stopped = (Stopped){.c = c};
    if (chunk)
        assert_success(ost_scene_create_on(c, chunk, &stopped->scene));
    else
        assert_success(ost_scene_create(c, &stopped->scene));
    assert_close(c->solver.algebraic_fraction, 0.1, 0.0);
    assert_success(ost_scene_solve(stopped->scene, &stopped->result));
    c->solver.algebraic_fraction = 0.0;
    c->solver.relative_residual = 1e-10;
    assert_success(ost_scene_solve(stopped->scene, &stopped->whole));
    assert_false(stopped->whole->solve.stopped);
    measure_distance(stopped);
}

/* The stated errors are those there are: no less than a third; the whole error is hardly larger than that of the mesh.
 */
static inline void assert_honest(const Stopped *stopped)
{
    const OstSolveReport *report = &stopped->result->solve;
    const double stated = stopped->result->checks.displacement_error;
    assert_true(report->stopped);
    if (!(report->algebraic_error > stopped->distance / 3.0 && report->algebraic_error < 7.0 * stopped->distance))
        fail_msg("stated error in energy %g, true %g", report->algebraic_error, stopped->distance);
    if (!(stated > stopped->displacement / 3.0 && stated < 30.0 * stopped->displacement))
        fail_msg("stated error of the displacement %g, true %g", stated, stopped->displacement);
    const double mesh = stopped->result->answer.energy_norm;
    assert_true(hypot(stopped->distance, mesh) <= 1.02 * mesh);
}

#endif
