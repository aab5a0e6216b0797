/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "orthostat/refine.h"
#include "problem/coarse_space.h"
#include "problem/problem.h"
#include "problem/scene_data.h"

/* A quarter of a tube, whose quadratic tets have curved edges on both surfaces; held at one end. */
typedef struct Body {
    OstMesh *mesh;
    OstSupports *supports;
    OstSystem *system;
} Body;

static void hold_and_number(Body *body)
{
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    assert_success(ost_supports_create(body->mesh, &body->supports));
    for (OstLocal node = 0; node < body->mesh->owned_nodes; node++)
        for (int i = 0; i < 3 && body->mesh->coordinates[3 * node + 2] < 1e-9; i++)
            assert_success(ost_supports_constrain(body->supports, node, unit[i], 0.0));
    assert_success(ost_supports_complete(body->supports));
    assert_success(ost_system_create(body->mesh, body->supports, &body->system));
}

static void destroy(Body *body)
{
    ost_system_destroy(&body->system);
    ost_supports_destroy(&body->supports);
    ost_mesh_destroy(&body->mesh);
}

static void make_bodies(Body *linear, Body *quadratic)
{
    const OstSectorShape shape = {
        .axis = 2, .length = 1.0, .radii = {1.0, 2.0}, .angle = 90.0, .around = 4, .radial = 3, .axial = 3};
    const OstShapeSurface surface = {.kind = OST_SURFACE_TUBE, .axis = {0.0, 0.0, 1.0}};
    OstMeshChunk *chunk = NULL;
    OstMesh *straight = NULL;
    assert_success(ost_chunk_create_sector(ctx, &shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &straight));
    assert_success(ost_mesh_raise(straight, &surface, &quadratic->mesh));
    ost_mesh_destroy(&straight);
    assert_success(ost_mesh_linear(quadratic->mesh, &linear->mesh, NULL));
    hold_and_number(linear);
    hold_and_number(quadratic);
}

/* The weighted sum of the parents' places is the node's own, so every field of uniform slope passes as it is. */
static void curved_edges_keep_rotations_and_uniform_strains(void **state)
{
    Body linear = {0}, quadratic = {0};
    OstLocal *parents = NULL;
    double *weights = NULL;
    int checked[2] = {0};
    make_bodies(&linear, &quadratic);
    assert_success(ost_coarse_parents(quadratic.system, linear.system, &parents, &weights));
    for (OstLocal row = 0; row < quadratic.system->matrix->rows; row++) {
        const double *x = quadratic.mesh->coordinates + 3 * quadratic.system->node_of_row[row];
        double sum = 0.0, place[3] = {0.0};
        int bent = 0, held = 0;
        for (OstLocal k = 4 * row; k < 4 * row + 4; k++) {
            bent += weights[k] != 0.0 && weights[k] != 0.5;
            held += parents[k] < 0 && weights[k] != 0.0;
            if (parents[k] < 0)
                continue;
            sum += weights[k];
            for (int i = 0; i < 3; i++)
                place[i] += weights[k] * linear.mesh->coordinates[3 * linear.system->node_of_row[parents[k]] + i];
        }
        if (held)
            continue;
        checked[bent > 0]++;
        assert_close(sum, 1.0, 1e-12);
        for (int i = 0; i < 3; i++)
            assert_close(place[i], x[i], 1e-12);
    }
    MPI_Allreduce(MPI_IN_PLACE, checked, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    assert_true(checked[0] > 100);
    assert_true(checked[1] > 20);
    OST_FREE(parents, weights);
    destroy(&linear);
    destroy(&quadratic);
}

static double *numbers(size_t count)
{
    double *made = calloc(count, sizeof *made);
    assert_non_null(made);
    return made;
}

/* x·K x */
static double energy_of(const OstBlockMatrix *matrix, const double *x)
{
    double *with_ghosts = numbers(3 * (size_t)matrix->columns), *product = numbers(3 * (size_t)matrix->rows), sum = 0.0;
    memcpy(with_ghosts, x, 3 * (size_t)matrix->rows * sizeof *x);
    assert_success(ost_block_matrix_apply(matrix, with_ghosts, product));
    for (size_t i = 0; i < 3 * (size_t)matrix->rows; i++)
        sum += x[i] * product[i];
    free(with_ghosts);
    free(product);
    assert_success(ost_sum(ctx, 1, &sum));
    return sum;
}

/* Linear tets are in the quadratic ones where nodes follow others, too: what they interpolate has the same energy. */
static void followers_move_as_their_leaders_do(void **state)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstProblem *problem = NULL;
    OstSystem *system = NULL;
    OstLinearSpace *space = NULL;
    assert_success(read_text("mesh: {block: {size: [2, 1, 1], divisions: [4, 3, 3]}}\nelement: {order: 2}\n"
                             "materials: [{region: all, youngs_modulus: [1e4, 2e3, 1e3], poissons_ratio: 0.3}]\n"
                             "constraints: [{periodic: [[xmin, xmax], [ymin, ymax]], strain: {xx: 0.01}}, "
                             "{on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}]\n",
                             &c));
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_problem(scene, &problem));
    assert_success(ost_system_create(problem->mesh, problem->supports, &system));
    assert_success(ost_system_fill(system, problem->field));
    assert_success(ost_linear_space_create(system, problem->field, 0, &space));
    assert_non_null(space);
    const OstBlockMatrix *coarse = space->space.matrix;
    double *v = numbers(3 * (size_t)coarse->columns), *x = numbers(3 * (size_t)system->matrix->rows);
    for (size_t row = 0; row < (size_t)coarse->rows; row++)
        for (size_t i = 0; i < 3; i++)
            v[3 * row + i] = sin((double)(3 * (coarse->first_row + (OstGlobal)row) + (OstGlobal)i + 1));
    assert_success(ost_halo_import(coarse->halo, 3 * sizeof *v, v));
    for (size_t k = 0; k < 4 * (size_t)system->matrix->rows; k++)
        for (size_t i = 0; i < 3 && space->space.parents[k] >= 0; i++)
            x[3 * (k / 4) + i] += space->space.weights[k] * v[3 * (size_t)space->space.parents[k] + i];
    const double expected = energy_of(coarse, v);
    assert_true(expected > 0.0);
    assert_close(energy_of(system->matrix, x), expected, 1e-12 * expected);
    free(v);
    free(x);
    ost_linear_space_destroy(&space);
    ost_system_destroy(&system);
    ost_problem_destroy(&problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(followers_move_as_their_leaders_do),
    cmocka_unit_test(curved_edges_keep_rotations_and_uniform_strains),
};

OST_TEST_MAIN(tests)
