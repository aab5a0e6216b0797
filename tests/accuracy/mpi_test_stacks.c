/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "accuracy/flat/stacks.h"
#include "accuracy/operator.h"
#include "core/memory.h"
#include "orthostat/scene.h"
#include "problem/problem.h"
#include "problem/scene_data.h"

#include <math.h>
#include <stdlib.h>

/* Stacks of functions that lie above each other in flat tets. */

#define FLAT "mesh: {block: {size: [9, 8, 0.5], divisions: [4, 4, 1]}}\n"
#define CUBES "mesh: {block: {size: [2, 2, 2], divisions: [3, 3, 3]}}\n"
#define LONG "mesh: {block: {size: [12, 1, 1], divisions: [3, 2, 2]}}\n"
#define REST                                                                                                        \
    "element: {order: 2}\nmaterials: [{region: all, youngs_modulus: [1e4, 2e3, 1e3], poissons_ratio: 0.3, axes: "   \
    "{rotation: {axis: [1, 2, 3], degrees: 40}}}]\nconstraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, " \
    "{on: {boundary: ymax}, displacement: [free, 0, free]}]\n"

typedef struct Body {
    OstCase *c;
    OstScene *scene;
    OstProblem *problem;
    OstComplement complement;
    OstStacks *stacks;
} Body;

static void open_body(const char *text, Body *body)
{
    *body = (Body){0};
    assert_success(read_text(text, &body->c));
    assert_success(ost_scene_create(body->c, &body->scene));
    assert_success(ost_scene_problem(body->scene, &body->problem));
    assert_success(ost_complement_create(body->problem->mesh, body->problem->supports, &body->complement));
    assert_success(ost_stacks_create(&body->complement, &body->stacks));
}

static void close_body(Body *body)
{
    ost_stacks_destroy(&body->stacks);
    ost_complement_clear(&body->complement);
    ost_problem_destroy(&body->problem);
    ost_scene_destroy(&body->scene);
    ost_case_destroy(&body->c);
}

static OstLocal largest(const OstStacks *stacks)
{
    OstLocal most = 0;
    for (OstLocal s = 0; s < stacks->count; s++)
        most = stacks->start[s + 1] - stacks->start[s] > most ? stacks->start[s + 1] - stacks->start[s] : most;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, ost_comm(ctx));
    return most;
}

/* The edges between two places of one layer of hexes are two or three, with two faces; the faces between three, four.
 */
static void flat_tets_are_stacked(void **state)
{
    Body flat, cubes, bars;
    open_body(FLAT REST, &flat);
    open_body(CUBES REST, &cubes);
    open_body(LONG REST, &bars);
    const OstComplement *complement = &flat.complement;
    assert_int_equal(largest(flat.stacks), 5);
    assert_int_equal(largest(cubes.stacks), 1);
    assert_int_equal(largest(bars.stacks), 1);
    for (OstLocal k = 0; k < complement->count; k++) { /* each of this rank's functions is in one */
        const OstLocal stack = flat.stacks->stack[k];
        assert_int_equal(stack >= 0, ost_complement_owns(complement, k));
        if (stack >= 0)
            assert_int_equal(flat.stacks->function[flat.stacks->start[stack] + flat.stacks->place[k]], k);
    }
    assert_int_equal(flat.stacks->start[flat.stacks->count], complement->owned_edges + complement->owned_faces);
    close_body(&flat);
    close_body(&cubes);
    close_body(&bars);
}

/* The displacement of a body that turns about z. */
static void turn_body(const OstMesh *mesh, double *u)
{
    for (size_t n = 0; n < (size_t)mesh->node_count; n++) {
        const double *x = mesh->coordinates + 3 * n;
        u[3 * n] = (cos(0.7) - 1.0) * x[0] - sin(0.7) * x[1];
        u[3 * n + 1] = sin(0.7) * x[0] + (cos(0.7) - 1.0) * x[1];
    }
}

/* The forces of a displacement of one stack alone give that displacement back. */
static void check_stack(const Body *body, const OstOperator *stiffness, OstLocal stack)
{
    const OstComplement *complement = &body->complement;
    const size_t numbers = OST_PER_FUNCTION * (size_t)complement->count;
    float *w = NULL, *force = NULL, *found = NULL;
    double *at_nodes = NULL;
    assert_success(OST_NEW(ctx, &w, numbers));
    assert_success(OST_NEW(ctx, &force, numbers));
    assert_success(OST_NEW(ctx, &found, numbers));
    assert_success(OST_NEW(ctx, &at_nodes, 3 * (size_t)body->problem->mesh->owned_nodes));
    const OstLocal start = body->stacks->start[stack], end = body->stacks->start[stack + 1];
    for (OstLocal k = start; k < end; k++)
        for (int i = 0; i < 3; i++)
            w[OST_PER_FUNCTION * body->stacks->function[k] + i] = (float)sin(3 * k + i + 1);
    ost_complement_project(complement, w);
    ost_operator_apply(stiffness, NULL, w, at_nodes, force);
    ost_complement_project(complement, force);
    ost_stacks_apply(body->stacks, force, found);
    for (OstLocal k = start; k < end; k++)
        for (int i = 0; i < 3; i++) {
            const OstLocal at = OST_PER_FUNCTION * body->stacks->function[k] + i;
            assert_close((double)found[at], (double)w[at], 1e-3);
        }
    OST_FREE(w);
    OST_FREE(force);
    OST_FREE(found);
    OST_FREE(at_nodes);
}

static void blocks_are_the_stiffness(void **state)
{
    for (int turned = 0; turned <= 1; turned++) {
        Body body;
        open_body(FLAT REST, &body);
        double *u = NULL;
        OstOperator stiffness = {.problem = body.problem, .complement = &body.complement};
        assert_success(OST_NEW(ctx, &u, 3 * (size_t)body.problem->mesh->node_count));
        turn_body(body.problem->mesh, u);
        stiffness.turned_by = turned ? u : NULL;
        assert_success(ost_operator_unit(body.problem, &stiffness.unit));
        assert_success(ost_stacks_factor(body.stacks, body.problem, stiffness.turned_by, stiffness.unit));
        for (OstLocal stack = 0; stack < body.stacks->count; stack += 3)
            check_stack(&body, &stiffness, stack);
        OST_FREE(u);
        close_body(&body);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(flat_tets_are_stacked),
    cmocka_unit_test(blocks_are_the_stiffness),
};

OST_TEST_MAIN(tests)
