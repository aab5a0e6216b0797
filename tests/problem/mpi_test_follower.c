/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "orthostat/refine.h"
#include "problem/problem.h"

/* Pressure that follows the surface, on linear and quadratic tets in shapes of no particular kind. */

typedef struct Made {
    OstMesh *mesh;
    OstMaterialField *field;
    OstProblem *problem;
    double *u;
} Made;

/* Pressed on its whole surface, or but for x = 0, where all nodes are held; without pressure; on a part with a rim that
 * may move. */
typedef enum { CLOSED, HELD_RIM, UNPRESSED, FREE_RIM } Pressed;

static int holds(const OstMesh *mesh, OstLocal node)
{
    return mesh->coordinates[3 * (size_t)node] < 1e-12;
}

static Made make(int order, Pressed pressed)
{
    const OstMaterial material = make_material(ctx, 1);
    Made made = {.mesh = make_body_of(order)};
    OstSurface *surface = NULL;
    const OstMesh *mesh = made.mesh;
    made.field = make_field(mesh, &material, AXES_FIXED);
    assert_success(ost_surface_create(mesh, NULL, &surface));
    const size_t n = (size_t)surface->nodes_per_face;
    OstLocal *faces = calloc(n * (size_t)surface->count + 1, sizeof *faces);
    OstNodeConstraint *constraints = calloc(3 * (size_t)mesh->owned_nodes + 1, sizeof *constraints);
    OstProblemParts parts = {.mesh = mesh,
                             .field = made.field,
                             .constraints = constraints,
                             .formulation = OST_FORMULATION_CONSISTENT,
                             .pressed_faces = faces,
                             .pressure = 30.0};
    for (OstLocal f = 0; f < surface->count && pressed != UNPRESSED; f++) {
        int held = 0;
        for (size_t a = 0; a < n; a++)
            held += holds(mesh, surface->nodes[n * (size_t)f + a]);
        const int before = mesh->coordinates[3 * (size_t)surface->nodes[n * (size_t)f]] < 1.0;
        if (pressed == CLOSED || (held < (int)n && (pressed == HELD_RIM || before)))
            memcpy(faces + n * (size_t)parts.pressed_count++, surface->nodes + n * (size_t)f, n * sizeof *faces);
    }
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3 && holds(mesh, node); i++) {
            constraints[parts.constraint_count].node = node;
            constraints[parts.constraint_count++].direction[i] = 1.0;
        }
    assert_success(ost_problem_create(&parts, &made.problem));
    ost_surface_destroy(&surface);
    free(faces);
    free(constraints);
    made.u = numbers(3 * (size_t)mesh->node_count);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        for (int i = 0; i < 3 && !holds(mesh, node); i++)
            made.u[3 * node + i] = 0.1 * random_of(mesh->node_label[node], 40 + i);
    return made;
}

static void destroy(Made *made)
{
    ost_problem_destroy(&made->problem);
    ost_field_destroy(&made->field);
    ost_mesh_destroy(&made->mesh);
    free(made->u);
}

static void on_a_closed_surface_it_balances_in_any_shape(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, CLOSED);
        const OstMesh *mesh = made.mesh;
        double *force = numbers(3 * (size_t)mesh->owned_nodes);
        double sums[7] = {0.0};
        ost_problem_load(made.problem, 1.0, made.u, force);
        for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
            double place[3], moment[3];
            for (int i = 0; i < 3; i++)
                place[i] = mesh->coordinates[3 * node + i] + made.u[3 * node + i];
            ost_cross3(place, force + 3 * node, moment);
            for (int i = 0; i < 3; i++) {
                sums[i] += force[3 * node + i];
                sums[3 + i] += moment[i];
            }
            sums[6] += ost_norm3(force + 3 * node);
        }
        for (int k = 0; k < 7; k++)
            sums[k] = sum_over_ranks(ctx, sums[k]);
        assert_true(sums[6] > 10.0);
        for (int k = 0; k < 6; k++)
            assert_close(sums[k] / sums[6], 0.0, 1e-14);
        free(force);
        destroy(&made);
    }
}

/* Displaces the free nodes along a random direction. */
static void shift(const Made *made, double step, const double *direction, double *u)
{
    for (OstLocal i = 0; i < 3 * made->mesh->node_count; i++)
        u[i] = made->u[i] + step * direction[i];
}

/* The work function is of third degree in the nodes' places: differences of fourth order leave rounding alone. The
 * stiffness with the pressure, less that without, is the derivative of the load, which is symmetric here. */
static void load_and_stiffness_are_derivatives_of_the_work(void **state)
{
    static const double weight[5] = {1.0 / 12.0, -8.0 / 12.0, 0.0, 8.0 / 12.0, -1.0 / 12.0};
    const double step = 0.01, t = 0.7;
    for (int order = 1; order <= 2; order++)
        for (Pressed pressed = CLOSED; pressed <= HELD_RIM; pressed++) {
            Made made = make(order, pressed), plain = make(order, UNPRESSED);
            const OstMesh *mesh = made.mesh;
            double *direction = numbers(3 * (size_t)mesh->node_count), *u = numbers(3 * (size_t)mesh->node_count);
            double *load = numbers(3 * (size_t)mesh->owned_nodes), *slope = numbers(3 * (size_t)mesh->owned_nodes);
            double *beside = numbers(3 * (size_t)mesh->owned_nodes), of_work = 0.0;
            for (OstLocal node = 0; node < mesh->node_count; node++)
                for (int i = 0; i < 3 && !holds(mesh, node); i++)
                    direction[3 * node + i] = random_of(mesh->node_label[node], 50 + i);
            for (int s = 0; s < 5; s++) {
                double work;
                shift(&made, step * (s - 2), direction, u);
                assert_success(ost_problem_load_work(made.problem, t, u, &work));
                ost_problem_load(made.problem, t, u, beside);
                of_work += weight[s] / step * work;
                for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
                    slope[i] += weight[s] / step * beside[i];
            }
            ost_problem_load(made.problem, t, made.u, load);
            const double along = dot(ctx, 3 * mesh->owned_nodes, load, direction);
            assert_close(of_work / fabs(along), along / fabs(along), 1e-10);
            OstStiffness with, without;
            assert_success(ost_problem_stiffness(made.problem, t, made.u, &with));
            assert_success(ost_problem_stiffness(plain.problem, t, plain.u, &without));
            const double size = largest(ctx, 3 * mesh->owned_nodes, slope);
            assert_true(size > 0.1);
            for (OstLocal row = 0; row < with.rows; row++) {
                double product[3] = {0.0};
                for (OstLocal k = with.row_start[row]; k < with.row_start[row + 1]; k++)
                    for (int n = 0; n < 9; n++)
                        product[n / 3] += (with.value[9 * k + n] - without.value[9 * k + n]) *
                                          direction[3 * with.node[with.column[k]] + n % 3];
                for (int i = 0; i < 3; i++)
                    assert_close(-product[i] / size, slope[3 * with.node[row] + i] / size, 1e-10);
            }
            free(direction);
            free(u);
            free(load);
            free(slope);
            free(beside);
            destroy(&made);
            destroy(&plain);
        }
}

static void a_rim_that_moves_leaves_no_work_function(void **state)
{
    for (int order = 1; order <= 2; order++)
        for (Pressed pressed = CLOSED; pressed <= FREE_RIM; pressed++) {
            Made made = make(order, pressed);
            assert_int_equal(made.problem->conservative, pressed != FREE_RIM);
            destroy(&made);
        }
}

/* On a surface with a free rim the derivative of the load has a skew part, which the matrix leaves out. Differences of
 * the load, of second degree in the places, are exact but for rounding. */
static void stiffness_and_its_skew_part_are_the_loads_derivative(void **state)
{
    const double step = 0.01, t = 0.7;
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, FREE_RIM), plain = make(order, UNPRESSED);
        const OstMesh *mesh = made.mesh;
        const size_t owned = 3 * (size_t)mesh->owned_nodes, all = 3 * (size_t)mesh->node_count;
        double *direction = numbers(all), *u = numbers(all), *slope = numbers(owned), *beside = numbers(owned);
        double *skew = numbers(owned);
        OstStiffness with, without;
        for (OstLocal node = 0; node < mesh->node_count; node++)
            for (int i = 0; i < 3 && !holds(mesh, node); i++)
                direction[3 * node + i] = random_of(mesh->node_label[node], 50 + i);
        for (int side = -1; side <= 1; side += 2) {
            shift(&made, side * step, direction, u);
            ost_problem_load(made.problem, t, u, beside);
            for (size_t i = 0; i < owned; i++)
                slope[i] += 0.5 * side / step * beside[i];
        }
        assert_success(ost_problem_add_skew(made.problem, t, made.u, direction, skew));
        assert_success(ost_problem_stiffness(made.problem, t, made.u, &with));
        assert_success(ost_problem_stiffness(plain.problem, t, plain.u, &without));
        const double size = largest(ctx, (OstLocal)owned, slope);
        assert_true(largest(ctx, (OstLocal)owned, skew) > 0.01 * size);
        for (OstLocal row = 0; row < with.rows; row++) {
            double product[3];
            memcpy(product, skew + 3 * with.node[row], sizeof product);
            for (OstLocal k = with.row_start[row]; k < with.row_start[row + 1]; k++)
                for (int n = 0; n < 9; n++)
                    product[n / 3] += (with.value[9 * k + n] - without.value[9 * k + n]) *
                                      direction[3 * with.node[with.column[k]] + n % 3];
            for (int i = 0; i < 3; i++)
                assert_close(-product[i] / size, slope[3 * with.node[row] + i] / size, 1e-10);
        }
        free(direction);
        free(u);
        free(slope);
        free(beside);
        free(skew);
        destroy(&made);
        destroy(&plain);
    }
}

static void undeformed_it_is_the_ordinary_pressure(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Made made = make(order, CLOSED);
        const OstMesh *mesh = made.mesh;
        const OstFollower *follower = made.problem->follower;
        double *force = numbers(3 * (size_t)mesh->owned_nodes), *ordinary = numbers(3 * (size_t)mesh->owned_nodes);
        ost_problem_load(made.problem, 0.5, NULL, force);
        if (follower)
            assert_success(
                ost_load_pressure(mesh, follower->count, follower->faces, follower->nodes_per_face, 15.0, ordinary));
        for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
            assert_close(force[i], ordinary[i], 1e-14);
        free(force);
        free(ordinary);
        destroy(&made);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(on_a_closed_surface_it_balances_in_any_shape),
    cmocka_unit_test(load_and_stiffness_are_derivatives_of_the_work),
    cmocka_unit_test(a_rim_that_moves_leaves_no_work_function),
    cmocka_unit_test(stiffness_and_its_skew_part_are_the_loads_derivative),
    cmocka_unit_test(undeformed_it_is_the_ordinary_pressure),
};

OST_TEST_MAIN(tests)
