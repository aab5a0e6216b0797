/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"
#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/problem.h"
#include "problem/scene_data.h"

/* Moments, forces at a point and centrifugal loads, against formulas. */

typedef struct Solved {
    OstCase *c;
    OstScene *scene;
    OstResult *result;
} Solved;

static Solved solve(const char *text)
{
    Solved solved = {0};
    assert_success(read_text(text, &solved.c));
    assert_success(ost_scene_create(solved.c, &solved.scene));
    assert_success(ost_scene_solve(solved.scene, &solved.result));
    return solved;
}

static void destroy(Solved *solved)
{
    ost_result_destroy(&solved->result);
    ost_scene_destroy(&solved->scene);
    ost_case_destroy(&solved->c);
}

/* The displacement of the vertex at a place, on every rank. */
static double displacement_at(const Solved *solved, double x, double y, double z, int component)
{
    const OstMesh *mesh = solved->result->mesh;
    double found[2] = {0.0};
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *at = mesh->coordinates + 3 * node;
        if (fabs(at[0] - x) + fabs(at[1] - y) + fabs(at[2] - z) < 1e-9) {
            found[0] += solved->result->displacement[3 * node + component];
            found[1] += 1.0;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    assert_close(found[1], 1.0, 0.0);
    return found[0];
}

static double bar_tip(const char *loads, int component)
{
    char text[1024];
    snprintf(text, sizeof text,
             "large_rotation: off\nmesh: {block: {size: [4, 1, 1], divisions: [4, 2, 2]}}\nelement: {order: 2}\n"
             "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: 0}]\n"
             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n%s"
             "accuracy: {relative_residual: 1e-12}\n",
             loads);
    Solved solved = solve(text);
    const double tip = displacement_at(&solved, 4, 0.5, 0.5, component);
    destroy(&solved);
    return tip;
}

/* Without Poisson's ratio beam theory is the exact solution, M L² / (2 E I), and quadratic tets hold it. */
static void a_moment_bends_a_bar_as_beam_theory_says(void **state)
{
    const double bent = 5.0 * 16.0 / (2.0 * 1200.0 / 12.0);
    assert_close(bar_tip("loads: [{on: {boundary: xmax}, moment: [0, 0, 5]}]\n", 1), bent, 1e-9);
    assert_close(bar_tip("loads: [{on: {boundary: xmax}, moment: [0, 5, 0]}]\n", 2), -bent, 1e-9);
}

/* A force beside the bar is the force at the end's centroid, and the moment that its arm makes. */
static void a_force_at_a_point_is_a_force_and_a_moment(void **state)
{
    const double far = bar_tip("loads: [{on: {boundary: xmax}, total_force: [0, 2, 0], at: [7, 0.5, 0.5]}]\n", 1);
    const double near = bar_tip("loads: [{on: {boundary: xmax}, total_force: [0, 2, 0]}]\n", 1);
    const double here = bar_tip("loads: [{on: {boundary: xmax}, total_force: [0, 2, 0], at: [4, 0.5, 0.5]}]\n", 1);
    const double share = bar_tip("loads: [{on: {box: {min: [4, 0, 0], max: [4, 1, 1]}}, total_force: [0, 2, 0], "
                                 "at: [7, 0.5, 0.5], share: vertices}]\n",
                                 1);
    assert_close(here, near, 1e-9 * near);
    assert_close(far - near, 6.0 * 16.0 / (2.0 * 1200.0 / 12.0), 1e-9);
    assert_close(share, far, 0.02 * far);
}

/* What acts on faces or vertices has the force and the moment asked for, about any point, on curved faces too. */
static void forces_add_up_to_what_is_asked_for(void **state)
{
    static const char *const how[] = {"share: faces", "share: vertices"};
    for (int order = 1; order <= 2; order++)
        for (int h = 0; h < 2; h++) {
            char text[1024];
            snprintf(text, sizeof text,
                     "large_rotation: off\nmesh: {tube: {axis: z, length: 2, radii: [0.5, 1], divisions: {around: 7, "
                     "radial: 1, axial: 2}}}\nelement: {order: %d}\n"
                     "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3}]\n"
                     "constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]\n"
                     "loads:\n  - {on: {boundary: outer}, moment: [1, -2, 3], %s}\n"
                     "  - {on: {boundary: inner}, total_force: [4, 5, 6], at: [1, 2, 3], %s}\n"
                     "accuracy: {relative_residual: 1e-10}\n",
                     order, how[h], how[h]);
            Solved made = {0};
            OstProblem *problem = NULL;
            assert_success(read_text(text, &made.c));
            assert_success(ost_scene_create(made.c, &made.scene));
            assert_success(ost_scene_problem(made.scene, &problem));
            const OstMesh *mesh = made.scene->mesh;
            double sums[6] = {0.0};
            double *force = calloc(3 * (size_t)mesh->owned_nodes + 1, sizeof *force);
            ost_problem_load(problem, 1.0, NULL, force);
            for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
                const double *x = mesh->coordinates + 3 * n, *f = force + 3 * n;
                for (int i = 0; i < 3; i++) {
                    sums[i] += f[i];
                    sums[3 + i] += x[(i + 1) % 3] * f[(i + 2) % 3] - x[(i + 2) % 3] * f[(i + 1) % 3];
                }
            }
            free(force);
            MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
            for (int i = 0; i < 3; i++)
                assert_close(sums[i], 4.0 + i, 1e-10);
            assert_close(sums[3], 1.0 + 2.0 * 6.0 - 3.0 * 5.0, 1e-10);
            assert_close(sums[4], -2.0 + 3.0 * 4.0 - 1.0 * 6.0, 1e-10);
            assert_close(sums[5], 3.0 + 1.0 * 5.0 - 2.0 * 4.0, 1e-10);
            ost_problem_destroy(&problem);
            destroy(&made);
        }
}

/* T L / (G J), but for the error of quadratic tets on a round section, 0.3 %. */
static void a_torque_twists_a_tube_as_theory_says(void **state)
{
    Solved solved =
        solve("large_rotation: off\nmesh: {tube: {axis: z, length: 4, radii: [0.5, 1], divisions: {around: 24, "
              "radial: 2, axial: 4}}}\nelement: {order: 2}\n"
              "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.25}]\n"
              "constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]\n"
              "loads: [{on: {boundary: top}, moment: [0, 0, 3]}]\naccuracy: {relative_residual: 1e-10}\n");
    const double twist = 3.0 * 4.0 / (400.0 * 0.5 * acos(-1.0) * (1.0 - pow(0.5, 4)));
    assert_close(displacement_at(&solved, 1, 0, 4, 1) / twist, 1.0, 4e-3);
    destroy(&solved);
}

/* A thin ring that turns (S. Timoshenko and J. Goodier, Theory of Elasticity, 1951, §30); its axis is not at the
 * origin, and the speed's sign does not matter. */
static void a_disc_widens_as_it_turns(void **state)
{
    const double e = 1e3, nu = 0.3, a = 1.0, b = 3.0, load = 2.0 * 1.5 * 1.5;
    const double hoop = (3.0 + nu) / 8.0 * load * (2.0 * a * a + b * b - (1.0 + 3.0 * nu) / (3.0 + nu) * b * b);
    const double hoop_inside = (3.0 + nu) / 8.0 * load * (a * a + 2.0 * b * b - (1.0 + 3.0 * nu) / (3.0 + nu) * a * a);
    Solved solved =
        solve("large_rotation: off\nmesh: {sector: {axis: z, length: 0.1, radii: [1, 3], angle: 90, divisions: "
              "{around: 8, radial: 6, axial: 1}}}\nelement: {order: 2}\n"
              "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3, density: 2}]\n"
              "constraints:\n  - {on: {boundary: bottom}, slide: [0, 0, 1]}\n"
              "  - {on: {boundary: start}, slide: [1, 0, 0]}\n  - {on: {boundary: finish}, slide: [0, 1, 0]}\n"
              "loads: [{centrifugal: {origin: [0, 0, 7], axis: [0, 0, 2], angular_velocity: -1.5}}]\n"
              "accuracy: {relative_residual: 1e-10}\n");
    assert_close(displacement_at(&solved, 3, 0, 0, 0) / (b * hoop / e), 1.0, 1e-3);
    assert_close(displacement_at(&solved, 0, 1, 0, 1) / (a * hoop_inside / e), 1.0, 2e-3);
    destroy(&solved);
}

/* A bar that turns about an end pulls there with rho omega² A L² / 2; another axis with rho omega² A L (L / 2 + d). */
static void the_reaction_is_the_centrifugal_force(void **state)
{
    for (int order = 1; order <= 2; order++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "large_rotation: off\nmesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}\nelement: {order: %d}\n"
                 "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: 0.2, density: 3}]\n"
                 "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                 "loads: [{centrifugal: {origin: [-2, 0.5, 0], axis: [0, 0, 1], angular_velocity: 2}, region: block}]\n"
                 "accuracy: {relative_residual: 1e-11}\n",
                 order);
        Solved solved = solve(text);
        assert_close(ost_result_checks(solved.result)->reaction[0], -3.0 * 4.0 * 4.0 * (2.0 + 2.0), 1e-8);
        assert_close(ost_result_checks(solved.result)->reaction[1], 0.0, 1e-8);
        destroy(&solved);
    }
}

static void assert_unsolved(const char *loads, const char *says)
{
    char text[1024];
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    snprintf(text, sizeof text,
             "large_rotation: off\nmesh: {block: {size: [4, 1, 1], divisions: [4, 2, 2]}}\n"
             "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: 0}]\n"
             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n%s",
             loads);
    OstStatus status = read_text(text, &c);
    if (status == OST_SUCCESS)
        status = ost_scene_create(c, &scene);
    if (status == OST_SUCCESS)
        status = ost_scene_solve(scene, &result);
    assert_int_equal(status, OST_INVALID_INPUT);
    if (!strstr(ost_error_text(ctx), says))
        fail_msg("expected '%s' in '%s'", says, ost_error_text(ctx));
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static void what_cannot_be_is_refused(void **state)
{
    assert_unsolved("loads: [{on: {nearest: [4, 1, 1]}, moment: [0, 0, 5]}]\n", "the selection is one point");
    assert_unsolved("loads: [{on: {vertices: [37, 38, 39]}, moment: [0, 0, 5]}]\n", "the selection is one line");
    assert_unsolved("loads: [{on: {nearest: [4, 1, 1]}, moment: [0, 0, 5], share: faces}]\n", "holds nothing");
    assert_unsolved("loads: [{centrifugal: {axis: [0, 0, 1], angular_velocity: 1}}]\n", "has a density");
    assert_unsolved("loads: [{on: {boundary: xmax}, moment: [0, 0, 5], at: [0, 0, 0]}]\n", "the same about every");
    assert_unsolved("loads: [{on: {boundary: xmax}, traction: [0, 0, 5], at: [0, 0, 0]}]\n", "belongs to total_force");
    assert_unsolved("loads: [{on: {boundary: xmax}, centrifugal: {axis: [0, 0, 1], angular_velocity: 1}}]\n",
                    "acts in the volume");
}

/* A bar with a lever at its end, in some state, and a motion of it from there. */
typedef struct Turned {
    OstProblem *problem;
    double *u, *from, *direction, *load, *force, *rows; /* `rows`: of the motion */
} Turned;

static double total_energy(const Turned *turned, double length)
{
    const OstProblem *problem = turned->problem;
    double energy, work;
    for (OstLocal i = 0; i < 3 * problem->mesh->node_count; i++)
        turned->u[i] = turned->from[i] + length * turned->direction[i];
    assert_success(ost_rigid_faces_move(problem->supports->links, turned->from, turned->direction, length, turned->u));
    assert_success(ost_levers_put(problem->supports->links, turned->u));
    assert_success(ost_problem_turn(problem, turned->u));
    assert_success(ost_problem_energy(problem, 1.0, turned->u, &energy));
    assert_success(ost_problem_load_work(problem, 1.0, turned->u, &work));
    return energy - work;
}

/* A displacement of the nodes, by random numbers of the rows, which follow from labels. */
static void move_at_random(const Turned *turned, double size, int seed, double *displacement)
{
    const OstSystem *system = turned->problem->system;
    for (OstLocal row = 0; row < system->matrix->rows; row++)
        for (int i = 0; i < 3; i++)
            turned->rows[3 * row + i] =
                size * sin(1.7 * (double)(system->matrix->label[row] % 97) + 2.3 * (3 * seed + i));
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        double projector[9], all[3];
        memcpy(all, turned->rows + 3 * row, sizeof all);
        ost_supports_get(turned->problem->supports, system->node_of_row[row], projector, NULL);
        ost_apply3(projector, all, turned->rows + 3 * row);
    }
    const OstRigidFace *face = turned->problem->supports->links->face;
    for (int k = 0; k < 6 * turned->problem->supports->links->face_count; k++) {
        const OstGlobal node = face->carrier[k / 3] - system->mesh->first_node;
        if (face->constrained[k] && node >= 0 && node < system->mesh->owned_nodes)
            turned->rows[3 * system->row_of_node[node] + k % 3] = 0.0;
    }
    assert_success(ost_system_displacement(system, 0.0, turned->rows, displacement));
}

/* The first and second derivative of the energy by differences of fourth order. */
static void find_derivatives(const Turned *turned, double derivative[2])
{
    static const double first[5] = {1.0, -8.0, 0.0, 8.0, -1.0}, second[5] = {-1.0, 16.0, -30.0, 16.0, -1.0};
    const double step = 4e-3;
    for (int s = 0; s < 5; s++) {
        const double energy = total_energy(turned, step * (s - 2));
        derivative[0] += first[s] / (12.0 * step) * energy;
        derivative[1] += second[s] / (12.0 * step * step) * energy;
    }
}

/* The same by forces, and by the stiffness. */
static void expect_derivatives(const Turned *turned, double expected[2])
{
    const OstMesh *mesh = turned->problem->mesh;
    const OstBlockMatrix *matrix = turned->problem->system->matrix;
    double *x = calloc(3 * (size_t)matrix->columns, sizeof *x), *y = calloc(3 * (size_t)matrix->rows + 1, sizeof *y);
    assert_success(ost_problem_force(turned->problem, 1.0, turned->from, turned->force));
    ost_problem_load(turned->problem, 1.0, turned->from, turned->load);
    for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
        turned->force[i] -= turned->load[i];
    assert_success(ost_system_take_rows(turned->problem->system, turned->force, y));
    for (OstLocal i = 0; i < 3 * matrix->rows; i++)
        expected[0] += y[i] * turned->rows[i];
    memcpy(x, turned->rows, 3 * (size_t)matrix->rows * sizeof *x);
    assert_success(ost_block_matrix_apply(matrix, x, y));
    for (OstLocal i = 0; i < 3 * matrix->rows; i++)
        expected[1] += y[i] * turned->rows[i];
    assert_success(ost_sum(ctx, 2, expected));
    free(x);
    free(y);
}

/* Along the curve on which a rigid face turns, forces are the derivative of the energy, and the stiffness theirs. */
static void assert_consistent(const char *held, const char *follows)
{
    char text[1024];
    OstCase *c = NULL;
    OstScene *scene = NULL;
    Turned turned = {0};
    double found[2] = {0.0}, expected[2] = {0.0};
    snprintf(text, sizeof text,
             "large_rotation: on\nmesh: {block: {size: [3, 1, 1], divisions: [3, 1, 2]}}\n"
             "materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0.3}]\n"
             "constraints: [{on: %s}, {on: {boundary: xmax}, %s}]\n"
             "loads: [{on: {boundary: xmax}, total_force: [1, 2, -3], at: [5, 1, 0]}, "
             "{on: {boundary: xmax}, moment: [1, -1, 2]}]\n",
             held, follows);
    assert_success(read_text(text, &c));
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_problem(scene, &turned.problem));
    assert_success(ost_problem_stiffness(turned.problem, 1.0, NULL, NULL));
    ost_problem_take_formulation(turned.problem, OST_FORMULATION_CONSISTENT);
    const size_t nodes = 3 * (size_t)scene->mesh->node_count;
    double **arrays[] = {&turned.u, &turned.from, &turned.direction, &turned.load, &turned.force, &turned.rows};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        *arrays[k] = calloc(nodes, sizeof **arrays[k]);
    move_at_random(&turned, 0.1, 1, turned.direction);
    assert_success(ost_problem_prescribe(turned.problem, 1.0, turned.rows, turned.from));
    total_energy(&turned, 1.0);
    memcpy(turned.from, turned.u, nodes * sizeof *turned.u);
    assert_success(ost_problem_stiffness(turned.problem, 1.0, turned.from, NULL));
    move_at_random(&turned, 0.1, 2, turned.direction);
    expect_derivatives(&turned, expected);
    find_derivatives(&turned, found);
    for (int k = 0; k < 2; k++)
        assert_close(found[k], expected[k], 1e-8 * (fabs(expected[0]) + fabs(expected[1])));
    assert_true(fabs(expected[0]) > 1e-3 && fabs(expected[1]) > 1e-3);
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        free(*arrays[k]);
    ost_problem_destroy(&turned.problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static void rigid_faces_turn_under_their_energy(void **state)
{
    static const char end[] = "{boundary: xmin}, displacement: [0, 0, 0]";
    assert_consistent(end, "rigid: [4, 2, 1]");
    assert_consistent(end, "rigid: {at: [3, 1, 1], displacement: [0.5, free, 0.2], rotation: [0, free, 0]}");
    assert_consistent(end, "rigid: {at: [4, 2, 1], displacement: [free, 1, free], rotation: [1, -2, 0.5]}");
    assert_consistent(end, "rigid: {at: [4, 2, 1], displacement: [free, 1, free], rotation: [1, free, -0.8]}");
    assert_consistent(end, "rigid: {at: [4, 2, 1], rotation: [free, 0.7, free]}");
}

/* The end follows the other one, three units away; one of those that it follows slides. */
static void levers_turn_under_their_energy(void **state)
{
    static const char tie[] = "tied_to: {boundary: xmin}, tolerance: 4}, "
                              "{on: {nearest: [0, 0, 0]}, displacement: [free, 0.1, free]";
    assert_consistent("{plane: {point: [1, 0, 0], normal: [1, 0, 0]}}, displacement: [0, 0, 0]", tie);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_moment_bends_a_bar_as_beam_theory_says),
    cmocka_unit_test(a_force_at_a_point_is_a_force_and_a_moment),
    cmocka_unit_test(forces_add_up_to_what_is_asked_for),
    cmocka_unit_test(a_torque_twists_a_tube_as_theory_says),
    cmocka_unit_test(a_disc_widens_as_it_turns),
    cmocka_unit_test(the_reaction_is_the_centrifugal_force),
    cmocka_unit_test(rigid_faces_turn_under_their_energy),
    cmocka_unit_test(levers_turn_under_their_energy),
    cmocka_unit_test(what_cannot_be_is_refused),
};

OST_TEST_MAIN(tests)
