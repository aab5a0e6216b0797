/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "core/parallel/reduce.h"
#include "orthostat/refine.h"
#include "problem/problem.h"

/* A problem as a function of the displacement u and the load factor t. */

typedef struct Made {
    OstMesh *mesh;
    OstMaterialField *field;
    OstProblem *problem;
} Made;

/* Held at one end, where it is also moved, sliding on an oblique plane at the other, loaded at random. */
static Made make(int order, double moved)
{
    const OstMaterial material = make_material(ctx, 1);
    Made made = {.mesh = make_body_of(order)};
    const OstMesh *mesh = made.mesh;
    made.field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    double *force = numbers(3 * (size_t)mesh->owned_nodes);
    OstNodeConstraint *constraints = calloc(3 * (size_t)mesh->owned_nodes + 1, sizeof *constraints);
    OstProblemParts parts = {.mesh = mesh, .field = made.field, .constraints = constraints, .force = force};
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double x = mesh->coordinates[3 * node];
        for (int i = 0; i < 3; i++) {
            OstNodeConstraint constraint = {.node = node, .displacement = moved * (1.0 + i)};
            constraint.direction[i] = 1.0;
            if (x < 1e-12)
                constraints[parts.constraint_count++] = constraint;
            force[3 * node + i] = random_of(mesh->node_label[node], 20 + i);
        }
        if (x > size_of_body[0] - 1e-12)
            constraints[parts.constraint_count++] =
                (OstNodeConstraint){.node = node, .direction = {1.0, 2.0, -0.5}, .displacement = 0.5 * moved};
    }
    assert_success(ost_problem_create(&parts, &made.problem));
    free(force);
    free(constraints);
    return made;
}

static void destroy(Made *made)
{
    ost_problem_destroy(&made->problem);
    ost_field_destroy(&made->field);
    ost_mesh_destroy(&made->mesh);
}

/* Random, and such as the supports allow: u = P v. */
static void make_displacement(const Made *made, double *v, double *u)
{
    const OstSystem *system = made->problem->system;
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        double projector[9], prescribed[3], random[3];
        for (int i = 0; i < 3; i++)
            random[i] = random_of(system->matrix->label[row], 30 + i);
        ost_supports_get(system->supports, system->node_of_row[row], projector, prescribed);
        ost_apply3(projector, random, v + 3 * row);
    }
    assert_success(ost_problem_displacement(made->problem, 0.0, v, u));
}

static void force_is_stiffness_times_displacement(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, 0.0);
        const OstMesh *mesh = made.mesh;
        OstStiffness stiffness;
        assert_true(ost_problem_is_linear(made.problem));
        assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &stiffness));
        assert_int_equal(3 * stiffness.global_rows, ost_problem_unknowns(made.problem));
        double *v = numbers(3 * (size_t)stiffness.columns), *product = numbers(3 * (size_t)stiffness.rows);
        double *u = numbers(3 * (size_t)mesh->node_count), *force = numbers(3 * (size_t)mesh->owned_nodes);
        make_displacement(&made, v, u);
        assert_success(ost_block_matrix_apply(made.problem->system->matrix, v, product));
        assert_success(ost_problem_force(made.problem, 1.0, u, force));
        const double size = largest(ctx, 3 * stiffness.rows, product);
        assert_true(size > 0.0);
        for (OstLocal row = 0; row < stiffness.rows; row++) {
            double projector[9], prescribed[3], along[3];
            ost_supports_get(made.problem->supports, stiffness.node[row], projector, prescribed);
            ost_apply3(projector, force + 3 * stiffness.node[row], along);
            for (int i = 0; i < 3; i++)
                assert_close(product[3 * row + i], along[i], 1e-12 * size);
        }
        double energy;
        assert_success(ost_problem_energy(made.problem, 1.0, u, &energy));
        const double work = dot(ctx, 3 * mesh->owned_nodes, u, force);
        assert_true(energy > 0.0);
        assert_close(0.5 * work / energy, 1.0, 1e-12);
        free(v);
        free(product);
        free(u);
        free(force);
        destroy(&made);
    }
}

static void values_filled_again_are_the_same(void **state)
{
    Made made = make(1, 0.0);
    OstStiffness first, again;
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &first));
    const size_t bytes = 9 * (size_t)first.row_start[first.rows] * sizeof(double);
    double *values = malloc(bytes + 1);
    memcpy(values, first.value, bytes);
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &again));
    assert_ptr_equal(again.value, first.value);
    assert_memory_equal(again.value, values, bytes);
    ost_problem_release_scatter(made.problem); /* a linear problem keeps its values without it */
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &again));
    assert_ptr_equal(again.value, first.value);
    ost_problem_release_stiffness(made.problem);
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &again));
    assert_memory_equal(again.value, values, bytes);
    free(values);
    destroy(&made);
}

/* Where a nonlinear problem has dropped its map, it makes another. */
static void a_nonlinear_problem_fills_again_without_its_map(void **state)
{
    Made made = make(1, 0.0);
    OstStiffness stiffness;
    made.problem->linear = 0;
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &stiffness));
    ost_problem_release_scatter(made.problem);
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &stiffness));
    assert_non_null(made.problem->system->block_of_tet);
    destroy(&made);
}

/* to = u + step × v, for displacements of all local nodes */
static void step_along(const OstMesh *mesh, const double *u, double step, const double *v, double *to)
{
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        to[i] = u[i] + step * v[i];
}

/* With large rotations the force is the energy's gradient, and the stiffness the force's, along directions that the
 * supports allow. */
static void large_rotations_derive_from_their_energy(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, 0.0);
        const OstMesh *mesh = made.mesh;
        const size_t nodes = 3 * (size_t)mesh->node_count, owned = 3 * (size_t)mesh->owned_nodes;
        const double step = 1e-4;
        OstStiffness stiffness;
        ost_problem_set_formulation(made.problem, OST_FORMULATION_CONSISTENT);
        assert_false(ost_problem_is_linear(made.problem));
        assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &stiffness));
        double *v = numbers(3 * (size_t)stiffness.columns), *product = numbers(3 * (size_t)stiffness.rows);
        double *direction = numbers(nodes), *u = numbers(nodes), *to = numbers(nodes);
        double *force = numbers(owned), *beside[2] = {numbers(owned), numbers(owned)};
        double energy[2];
        make_displacement(&made, v, direction);
        for (OstLocal node = 0; node < mesh->node_count; node++)
            for (int i = 0; i < 3; i++) /* turned and strained by some 0.3 */
                u[3 * node + i] =
                    0.3 * mesh->coordinates[3 * node + (i + 1) % 3] + 0.02 * random_of(mesh->node_label[node], 40 + i);
        assert_success(ost_problem_force(made.problem, 1.0, u, force));
        for (int side = 0; side < 2; side++) {
            step_along(mesh, u, side ? step : -step, direction, to);
            assert_success(ost_problem_energy(made.problem, 1.0, to, &energy[side]));
            assert_success(ost_problem_force(made.problem, 1.0, to, beside[side]));
        }
        const double slope = dot(ctx, (OstLocal)owned, direction, force);
        assert_close((energy[1] - energy[0]) / (2.0 * step) / slope, 1.0, 1e-5);
        assert_success(ost_problem_stiffness(made.problem, 1.0, u, &stiffness));
        assert_success(ost_block_matrix_apply(made.problem->system->matrix, v, product));
        const double size = largest(ctx, 3 * stiffness.rows, product);
        for (OstLocal row = 0; row < stiffness.rows; row++) {
            double projector[9], prescribed[3], change[3], along[3];
            for (int i = 0; i < 3; i++) {
                const OstLocal at = 3 * stiffness.node[row] + i;
                change[i] = (beside[1][at] - beside[0][at]) / (2.0 * step);
            }
            ost_supports_get(made.problem->supports, stiffness.node[row], projector, prescribed);
            ost_apply3(projector, change, along);
            for (int i = 0; i < 3; i++)
                assert_close(product[3 * row + i] / size, along[i] / size, 1e-5);
        }
        const double curvature = dot(ctx, 3 * stiffness.rows, v, product);
        assert_success(ost_problem_definite_stiffness(made.problem, 1.0, u, &stiffness));
        assert_success(ost_block_matrix_apply(made.problem->system->matrix, v, product));
        assert_true(dot(ctx, 3 * stiffness.rows, v, product) > curvature);
        double *all[] = {v, product, direction, u, to, force, beside[0], beside[1]};
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
            free(all[i]);
        destroy(&made);
    }
}

/* One problem can be solved linearly first: its matrix follows the formulation, also without its map. */
static void a_new_formulation_makes_the_stiffness_anew(void **state)
{
    Made made = make(1, 0.0);
    const OstMesh *mesh = made.mesh;
    OstStiffness stiffness;
    double *u = numbers(3 * (size_t)mesh->node_count);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        u[3 * node] = mesh->coordinates[3 * node + 1];
    assert_success(ost_problem_stiffness(made.problem, 1.0, u, &stiffness));
    const size_t bytes = 9 * (size_t)stiffness.row_start[stiffness.rows] * sizeof(double);
    double *linear = malloc(bytes + 1);
    memcpy(linear, stiffness.value, bytes);
    ost_problem_release_scatter(made.problem);
    for (int f = OST_FORMULATION_CLASSICAL; f >= OST_FORMULATION_LINEAR; f--) {
        ost_problem_set_formulation(made.problem, (OstFormulation)f);
        assert_int_equal(ost_problem_formulation(made.problem), f);
        assert_success(ost_problem_stiffness(made.problem, 1.0, u, &stiffness));
        assert_true((memcmp(stiffness.value, linear, bytes) == 0) == (f == OST_FORMULATION_LINEAR || bytes == 0));
        assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, &stiffness)); /* at u = 0 all agree */
        assert_memory_equal(stiffness.value, linear, bytes);
    }
    free(u);
    free(linear);
    destroy(&made);
}

/* Everything is squeezed to half its length along x, one tet is turned inside out. */
static void the_worst_tet_is_found(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, 0.0);
        const OstMesh *mesh = made.mesh;
        OstWorstTet worst;
        double *u = numbers(3 * (size_t)mesh->node_count);
        for (OstLocal node = 0; node < mesh->node_count; node++)
            u[3 * node] = -0.5 * mesh->coordinates[3 * node];
        assert_success(ost_problem_worst_tet(made.problem, u, &worst));
        assert_close(worst.stretch, 0.5, 1e-12);
        assert_int_equal(worst.inverted, 0);
        for (OstLocal node = 0; node < mesh->node_count; node++) /* the node of the lowest label goes far inside */
            if (mesh->node_label[node] == 1)
                for (int i = 0; i < 3; i++)
                    u[3 * node + i] = 0.6 * size_of_body[i];
        assert_success(ost_problem_worst_tet(made.problem, u, &worst));
        assert_true(worst.stretch < 0.0 && worst.inverted > 0 && worst.inverted < mesh->global_tets);
        int found = 0;
        for (OstLocal t = 0; t < mesh->owned_tets; t++) {
            const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
            for (int a = 0; a < mesh->nodes_per_tet && mesh->tet_label[t] == worst.tet; a++)
                found += mesh->node_label[nodes[a]] == 1;
        }
        double total = found;
        assert_success(ost_sum(ctx, 1, &total));
        assert_true(total == 1.0);
        for (int i = 0; i < 3; i++)
            assert_true(worst.place[i] > 0.0 && worst.place[i] < size_of_body[i]);
        assert_int_equal(worst.region, 0);
        free(u);
        destroy(&made);
    }
}

static void loads_and_prescribed_displacements_scale_with_t(void **state)
{
    Made made = make(1, 0.3);
    const OstMesh *mesh = made.mesh;
    assert_success(ost_problem_stiffness(made.problem, 1.0, NULL, NULL));
    const OstLocal numbers_of_rows = 3 * made.problem->system->matrix->rows, size = 3 * mesh->owned_nodes;
    double *whole = numbers((size_t)size), *part = numbers((size_t)size);
    double *rhs = numbers((size_t)numbers_of_rows), *rhs_part = numbers((size_t)numbers_of_rows);
    double *zero = numbers((size_t)numbers_of_rows);
    double *u = numbers(3 * (size_t)mesh->node_count), *u_part = numbers(3 * (size_t)mesh->node_count);
    ost_problem_load(made.problem, 1.0, NULL, whole);
    ost_problem_load(made.problem, 0.25, NULL, part);
    for (OstLocal i = 0; i < size; i++)
        assert_close(part[i], 0.25 * whole[i], 0.0);
    assert_success(ost_problem_right_hand_side(made.problem, 1.0, rhs));
    assert_success(ost_problem_right_hand_side(made.problem, 0.25, rhs_part));
    for (OstLocal i = 0; i < numbers_of_rows; i++)
        assert_close(rhs_part[i], 0.25 * rhs[i], 0.0);
    assert_success(ost_problem_displacement(made.problem, 1.0, zero, u));
    assert_success(ost_problem_displacement(made.problem, 0.25, zero, u_part));
    assert_true(largest(ctx, size, u) > 0.8);
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        assert_close(u_part[i], 0.25 * u[i], 1e-15);
    free(whole);
    free(part);
    free(rhs);
    free(rhs_part);
    free(zero);
    free(u);
    free(u_part);
    destroy(&made);
}

static void constraints_of_nodes_that_are_not_owned_are_refused(void **state)
{
    Made made = make(1, 0.0);
    OstProblem *problem = NULL;
    const OstNodeConstraint constraint = {.node = made.mesh->owned_nodes, .direction = {1.0, 0.0, 0.0}};
    const OstProblemParts parts = {
        .mesh = made.mesh, .field = made.field, .constraints = &constraint, .constraint_count = 1};
    assert_failure(ost_problem_create(&parts, &problem), OST_INVALID_INPUT, "this rank owns nodes 0 to");
    assert_null(problem);
    destroy(&made);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(force_is_stiffness_times_displacement),
    cmocka_unit_test(values_filled_again_are_the_same),
    cmocka_unit_test(a_nonlinear_problem_fills_again_without_its_map),
    cmocka_unit_test(large_rotations_derive_from_their_energy),
    cmocka_unit_test(a_new_formulation_makes_the_stiffness_anew),
    cmocka_unit_test(the_worst_tet_is_found),
    cmocka_unit_test(loads_and_prescribed_displacements_scale_with_t),
    cmocka_unit_test(constraints_of_nodes_that_are_not_owned_are_refused),
};

OST_TEST_MAIN(tests)
