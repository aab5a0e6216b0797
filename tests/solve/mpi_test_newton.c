/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"
#include "problem/scene_data.h"

#include "solve/linear.h"
#include "solve/newton_data.h"

/* Slender beams of length 1 along x, clamped at x = 0, with E = 1e9 and nu = 0, of quadratic tets. */
static const double modulus = 1e9;

typedef struct Solved {
    OstCase *c;
    OstScene *scene;
    OstResult *result;
} Solved;

static void destroy(Solved *solved)
{
    ost_result_destroy(&solved->result);
    ost_scene_destroy(&solved->scene);
    ost_case_destroy(&solved->c);
}

/* `height` along z, `width` along y, so many divisions, the total force at the free end; `more` of the case. */
static void make_beam(double width, double height, int divisions, const double force[3], const char *more,
                      Solved *solved)
{
    char text[1024];
    snprintf(text, sizeof text,
             "mesh: {block: {size: [1, %g, %g], divisions: [%d, 1, 1]}}\nelement: {order: 2}\n"
             "materials: [{region: all, youngs_modulus: %g, poissons_ratio: 0}]\n"
             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
             "loads: [{on: {boundary: xmax}, total_force: [%.17g, %.17g, %.17g]}]\n"
             "output: {fields: [displacement, strain_tensor, stress, node_stress, strain_energy_density]}\n%s",
             width, height, divisions, modulus, force[0], force[1], force[2], more);
    *solved = (Solved){0};
    assert_success(read_text(text, &solved->c));
    assert_success(ost_scene_create(solved->c, &solved->scene));
}

/* The displacement of the node nearest to a place, on all ranks. */
static void displacement_at(const OstMesh *mesh, const double *u, const double place[3], double found[3])
{
    struct {
        double value;
        int rank;
    } nearest = {1e300, ost_rank(ctx)};
    OstLocal node = 0;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const double *x = mesh->coordinates + 3 * n;
        const double distance = fabs(x[0] - place[0]) + fabs(x[1] - place[1]) + fabs(x[2] - place[2]);
        if (distance < nearest.value) {
            nearest.value = distance;
            node = n;
        }
    }
    memcpy(found, u + 3 * (size_t)node, 3 * sizeof *found);
    MPI_Allreduce(MPI_IN_PLACE, &nearest, 1, MPI_DOUBLE_INT, MPI_MINLOC, ost_comm(ctx));
    MPI_Bcast(found, 3, MPI_DOUBLE, nearest.rank, ost_comm(ctx));
}

static void tip_of(const Solved *solved, double width, double height, double tip[3])
{
    displacement_at(solved->scene->mesh, solved->result->displacement,
                    (const double[3]){1.0, 0.5 * width, 0.5 * height}, tip);
}

/* Euler's elastica: deflection and shortening over the length, for P L² / EI (K. Mattiasson, Numerical results from
 * large deflection beam and frame problems analysed by means of elliptic integrals, Int. J. Numer. Meth. Eng. 17,
 * 1981). */
static const double elastica[4][3] = {{1.0, 0.30172077, 0.05643324},
                                      {2.0, 0.49345748, 0.16064172},
                                      {5.0, 0.71379152, 0.38762836},
                                      {10.0, 0.81060902, 0.55499560}};

static const double thickness = 0.02;

static double bending_stiffness(double width, double height)
{
    return modulus * width * height * height * height / 12.0;
}

static void make_cantilever(double load, int divisions, const char *more, Solved *solved)
{
    const double force = -load * bending_stiffness(thickness, thickness);
    make_beam(thickness, thickness, divisions, (const double[3]){0.0, 0.0, force}, more, solved);
}

static void assert_elastica(int k, int divisions, const char *more, double tolerance)
{
    Solved solved;
    double tip[3];
    make_cantilever(elastica[k][0], divisions, more, &solved);
    assert_success(ost_scene_solve(solved.scene, &solved.result));
    tip_of(&solved, thickness, thickness, tip);
    assert_close(-tip[2], elastica[k][1], tolerance * elastica[k][1]);
    assert_close(-tip[0], elastica[k][2], tolerance * elastica[k][2]);
    assert_true(ost_result_newton_report(solved.result)->used);
    assert_close(ost_result_newton_report(solved.result)->reached, 1.0, 0.0);
    assert_string_equal(ost_result_status(solved.result), "accepted");
    destroy(&solved);
}

static void a_cantilever_bends_as_the_elastica(void **state)
{
    for (int k = 0; k < 4; k++)
        assert_elastica(k, 24, "", 0.005);
}

/* On these tets, which turn by 0.02 from end to end, the classical form is 6 to 13 % too soft, and its forces have a
 * moment. */
static void the_classical_forces_bend_it_too(void **state)
{
    assert_elastica(1, 40, "formulation: classical\n", 0.15);
}

/* At 1.884 times Euler's load the free end has turned by 120 degrees, and stands at 0.12355
 * and 0.80321 of the length (S. Timoshenko and J. Gere, Theory of elastic stability, 1961, table 2-4). */
static void a_column_is_followed_past_its_buckling(void **state)
{
    const double width = 0.06, height = 0.04, pi = 3.14159265358979;
    const double force = 1.884 * pi * pi / 4.0 * bending_stiffness(width, height);
    Solved solved;
    double tip[3];
    make_beam(width, height, 16, (const double[3]){-force, 0.0, 1e-3 * force}, "large_rotation: on\n", &solved);
    assert_success(ost_scene_solve(solved.scene, &solved.result));
    tip_of(&solved, width, height, tip);
    assert_close(1.0 + tip[0], 0.12355, 0.01);
    assert_close(tip[2], 0.80321, 0.01);
    assert_true(ost_result_newton_report(solved.result)->definite > 0);
    /* 81 to 88; 201 where whole steps that stretch the column are not tried, and long load steps not cut at once */
    assert_true(ost_result_newton_report(solved.result)->iterations <= 130);
    destroy(&solved);
}

/* A straight column is at rest under any load, but beyond Euler's, which is met to 2 %, not stable. */
static void a_column_without_imperfection_buckles(void **state)
{
    const double width = 0.12, height = 0.08, pi = 3.14159265358979;
    for (int beyond = 0; beyond < 2; beyond++) {
        const double force = (beyond ? 1.02 : 0.98) * pi * pi / 4.0 * bending_stiffness(width, height);
        Solved solved;
        double tip[3];
        make_beam(width, height, 12, (const double[3]){-force, 0.0, 0.0}, "large_rotation: on\n", &solved);
        assert_success(ost_scene_solve(solved.scene, &solved.result));
        tip_of(&solved, width, height, tip);
        assert_int_equal(ost_result_newton_report(solved.result)->jumps > 0, beyond);
        assert_int_equal(fabs(tip[2]) > 0.1, beyond);
        assert_int_equal(fabs(tip[2]) > 1e-6, beyond);
        destroy(&solved);
    }
}

/* A beam on the way: the linear solve, and Newton's method from there. */
typedef struct Way {
    Solved solved;
    OstProblem *problem;
    OstAnalysis *analysis;
    OstNewton *newton;
    OstNewtonState state;
} Way;

static void begin(double load, int divisions, Way *way)
{
    OstSolvedFor solved_for;
    OstResult *linear = NULL;
    OstVerdict before = {.count = 0};
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = 1e-10;
    options.accept_attainable = 1;
    make_cantilever(load, divisions, "large_rotation: on\n", &way->solved);
    assert_success(ost_scene_problem(way->solved.scene, &way->problem));
    assert_success(ost_analysis_create(way->problem, &options, &way->analysis));
    assert_success(way->analysis->strategy->prepare(way->analysis, &before));
    assert_success(ost_result_create(way->problem, &linear));
    assert_success(ost_linear_strategy.solve(way->analysis, linear, &solved_for));
    ost_problem_take_formulation(way->problem, OST_FORMULATION_CONSISTENT);
    OstStiffnessSolver *stiffness = &((OstLinear *)way->analysis->work)->stiffness;
    assert_success(ost_newton_create(stiffness, &linear->solve, &way->newton));
    assert_success(ost_newton_state_create(way->problem, &way->state));
    ost_result_destroy(&linear);
}

static void end(Way *way)
{
    ost_newton_state_release(&way->state);
    ost_newton_destroy(&way->newton);
    ost_analysis_destroy(&way->analysis);
    ost_problem_destroy(&way->problem);
    destroy(&way->solved);
}

static void twice_the_steps_lead_to_the_same_place(void **state)
{
    double tip[3][3];
    const double place[3] = {1.0, 0.01, 0.01};
    for (int k = 0; k < 3; k++) {
        Way way = {.newton = NULL};
        begin(3.0, 12, &way);
        for (int step = 0; step < 1 << k; step++)
            assert_success(ost_newton_advance(way.newton, (step + 1.0) / (1 << k), &way.state));
        displacement_at(way.problem->mesh, way.state.displacement, place, tip[k]);
        end(&way);
    }
    for (int k = 1; k < 3; k++)
        for (int i = 0; i < 3; i++)
            assert_close(tip[k][i], tip[0][i], 1e-8);
    /* the same on any number of ranks */
    assert_close(tip[0][0], -0.252312766677, 1e-8);
    assert_close(tip[0][2], -0.600667025892, 1e-8);
}

/* An error of the displacement becomes about its square in an iteration. */
static void convergence_is_quadratic(void **state)
{
    double left[2];
    Way way = {.newton = NULL};
    begin(1.0, 12, &way);
    assert_success(ost_newton_advance(way.newton, 1.0, &way.state));
    OstNewton *newton = way.newton;
    const size_t count = 3 * (size_t)way.problem->mesh->node_count;
    for (int k = 0; k < 2; k++) {
        int found = 0;
        double sum = 0.0;
        for (size_t i = 0; i < count; i++)
            newton->displacement[i] = (1.0 + (k == 0 ? 1e-4 : 1e-5)) * way.state.displacement[i];
        assert_success(ost_newton_evaluate(newton, newton->displacement));
        assert_success(ost_newton_solve(newton, 0, 1e-10, newton->residual, &found));
        assert_true(found);
        for (size_t i = 0; i < 3 * (size_t)way.problem->mesh->owned_nodes; i++) {
            const double error = newton->displacement[i] + newton->direction[i] - way.state.displacement[i];
            sum += error * error;
        }
        MPI_Allreduce(&sum, &left[k], 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
        left[k] = sqrt(left[k]);
    }
    assert_true(left[0] > 0.0 && left[0] > 50.0 * left[1] && left[0] < 200.0 * left[1]);
    end(&way);
}

/* A state that is not found says how far the load was followed, why not further, and where. */
static void what_is_given_up_is_described(void **state)
{
    Way way = {.newton = NULL};
    begin(1.0, 4, &way);
    assert_success(ost_newton_advance(way.newton, 0.5, &way.state));
    assert_failure(ost_newton_give_up(way.newton, &way.state, 0.75, OST_REST_SLOW), OST_NOT_CONVERGED,
                   "the load is followed up to 0.5 of it and not to 0.75: Newton's method does not converge there. The "
                   "last correction is largest in tet ");
    assert_non_null(strstr(ost_error_text(ctx), " of region 'block', at (1, "));
    assert_failure(ost_newton_give_up(way.newton, &way.state, 0.75, OST_REST_UNSTABLE), OST_NOT_CONVERGED,
                   "the body buckles, or the load passes a limit point");
    for (size_t i = 0; i < 3 * (size_t)way.problem->mesh->node_count; i++)
        way.newton->displacement[i] = -2.5 * way.problem->mesh->coordinates[i]; /* inside out */
    assert_failure(ost_newton_give_up(way.newton, &way.state, 0.75, OST_REST_SLOW), OST_NOT_CONVERGED,
                   "tets are turned inside out there, the worst of them tet ");
    end(&way);
}

static void the_case_says_what_is_solved(void **state)
{
    static const struct {
        const char *more;
        double load;
        int judged, used;
    } cases[] = {{"", 1.0, 1, 1},
                 {"", 0.1, 1, 0},
                 {"large_rotation: on\n", 0.1, 1, 1},
                 {"large_rotation: off\n", 1.0, 0, 0},
                 {"accuracy: {relative_error: 0.5}\n", 1.0, 1, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        Solved solved;
        make_cantilever(cases[k].load, 8, cases[k].more, &solved);
        assert_success(ost_scene_solve(solved.scene, &solved.result));
        const OstNewtonReport *report = ost_result_newton_report(solved.result);
        assert_int_equal(report->judged, cases[k].judged);
        assert_int_equal(report->used, cases[k].used);
        assert_int_equal(ost_result_checks(solved.result)->linear, !cases[k].used);
        destroy(&solved);
    }
}

/* A clamp that turns by a quarter takes the body along, at no energy. */
static void a_turning_clamp_turns_the_body(void **state)
{
    Solved solved;
    make_beam(0.3, 0.3, 3, (const double[3]){0.0, 0.0, 0.0}, "", &solved);
    const OstMesh *mesh = solved.scene->mesh;
    OstNodeConstraint *constraints = calloc(3 * (size_t)mesh->owned_nodes + 1, sizeof *constraints);
    OstProblemParts parts = {.mesh = mesh,
                             .field = solved.scene->field,
                             .constraints = constraints,
                             .formulation = OST_FORMULATION_CONSISTENT};
    const OstSolverOptions options = ost_solver_default_options();
    OstProblem *problem = NULL;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node;
        const double u[3] = {x[2] - x[0], 0.0, -x[0] - x[2]}; /* about y */
        for (int i = 0; i < 3 && x[0] < 1e-9; i++) {
            OstNodeConstraint *constraint = &constraints[parts.constraint_count++];
            constraint->node = node;
            constraint->direction[i] = 1.0;
            constraint->displacement = u[i];
        }
    }
    assert_success(ost_problem_create(&parts, &problem));
    assert_success(ost_problem_solve(problem, &options, 0, &solved.result));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node, *u = solved.result->displacement + 3 * node;
        assert_close(u[0], x[2] - x[0], 1e-6);
        assert_close(u[1], 0.0, 1e-6);
        assert_close(u[2], -x[0] - x[2], 1e-6);
    }
    assert_close(solved.result->checks.largest_rotation, 1.5707963, 1e-6);
    assert_true(solved.result->checks.strain_energy < 1e-12 * modulus);
    ost_problem_destroy(&problem);
    free(constraints);
    destroy(&solved);
}

/* Pulled by 0.1 E, a bar of nu = 0.3 is 10 % longer and 3 % thinner: so much more is the stress on the area that is
 * left.
 */
static void strain_is_biots_and_stress_is_cauchys(void **state)
{
    static const char text[] = "mesh: {block: {size: [1, 1, 1], divisions: [1, 1, 1]}}\nelement: {order: 2}\n"
                               "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3}]\n"
                               "constraints:\n  - {on: {boundary: xmin}, slide: [1, 0, 0]}\n"
                               "  - {on: {boundary: ymin}, slide: [0, 1, 0]}\n"
                               "  - {on: {boundary: zmin}, slide: [0, 0, 1]}\n"
                               "loads: [{on: {boundary: xmax}, traction: [0.2, 0, 0]}]\nlarge_rotation: on\n";
    const double stress = 0.2 / (0.97 * 0.97), strain[6] = {0.1, -0.03, -0.03, 0.0, 0.0, 0.0};
    Solved solved = {0};
    assert_success(read_text(text, &solved.c));
    assert_success(ost_scene_create(solved.c, &solved.scene));
    assert_success(ost_scene_solve(solved.scene, &solved.result));
    const OstMesh *mesh = solved.scene->mesh;
    for (size_t tet = 0; tet < (size_t)mesh->owned_tets; tet++)
        for (size_t p = 0; p < 6; p++) {
            assert_close(solved.result->strain[6 * tet + p], strain[p], 1e-7);
            assert_close(solved.result->stress[6 * tet + p], p == 0 ? stress : 0.0, 1e-7);
        }
    for (size_t node = 0; node < (size_t)mesh->owned_nodes; node++)
        assert_close(solved.result->node_stress[6 * node], stress, 1e-7);
    assert_close(solved.result->checks.strain_energy, 0.01, 1e-8);
    destroy(&solved);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_cantilever_bends_as_the_elastica),     cmocka_unit_test(the_classical_forces_bend_it_too),
    cmocka_unit_test(a_column_is_followed_past_its_buckling), cmocka_unit_test(a_column_without_imperfection_buckles),
    cmocka_unit_test(twice_the_steps_lead_to_the_same_place), cmocka_unit_test(convergence_is_quadratic),
    cmocka_unit_test(what_is_given_up_is_described),          cmocka_unit_test(the_case_says_what_is_solved),
    cmocka_unit_test(a_turning_clamp_turns_the_body),         cmocka_unit_test(strain_is_biots_and_stress_is_cauchys),
};

OST_TEST_MAIN(tests)
