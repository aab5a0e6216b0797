/* SPDX-License-Identifier: BSD-3-Clause */
#include "run.h"

#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "problem/problem.h"

/* The mixed form where rotations are large. */

static void read_scene(const char *text, Run *run)
{
    *run = (Run){.c = NULL};
    assert_success(read_text(text, &run->c));
    assert_success(ost_scene_create(run->c, &run->scene));
    assert_true(ost_effect_on(&run->scene->plan.effects, OST_EFFECT_MIXED));
}

static void solve(const char *text, Run *run)
{
    read_scene(text, run);
    assert_success(ost_scene_solve(run->scene, &run->result));
    assert_string_equal(ost_result_status(run->result), "accepted");
    assert_true(run->result->newton.used);
    assert_non_null(run->result->pressure);
}

/* A state of the mixed form, and a change of it. */
typedef struct State {
    OstProblem *problem;
    size_t nodes, pressures, owned; /* numbers of displacements and pressures, ghosts included; owned pressures */
    double *u, *p, *du, *dp;
    double *of_tets, *force, *volume; /* 3 × owned nodes; owned pressures */
} State;

static double wave(int64_t label, int i)
{
    return sin(12.9898 * (double)label + 78.233 * i);
}

/* The body turned by 70 degrees about z and bent by its own length, with pressures that vary. */
static void set_state(State *state)
{
    const OstMesh *mesh = state->problem->mesh;
    const double c = cos(1.2), s = sin(1.2);
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        const double *x = mesh->coordinates + 3 * n;
        const double bent[3] = {x[0] + 0.1 * x[1] * x[2], 1.1 * x[1] - 0.05 * x[0] * x[0], x[2] + 0.08 * x[0] * x[1]};
        double *u = state->u + 3 * n;
        u[0] = c * bent[0] - s * bent[1] - x[0];
        u[1] = s * bent[0] + c * bent[1] - x[1];
        u[2] = bent[2] - x[2];
        for (int i = 0; i < 3; i++)
            state->du[3 * n + i] =
                state->problem->system->row_of_node[n] < 0 ? 0.0 : 0.1 * wave(mesh->node_label[n], i);
    }
    for (size_t k = 0; k < state->owned; k++) {
        state->p[k] = 5.0 * wave((int64_t)k, 3);
        state->dp[k] = 3.0 * wave((int64_t)k, 4);
    }
    assert_success(ost_pressure_complete(state->problem->pressures, state->p));
    assert_success(ost_pressure_complete(state->problem->pressures, state->dp));
}

static void make_room(State *state)
{
    const OstProblem *problem = state->problem;
    state->nodes = 3 * (size_t)problem->mesh->node_count;
    state->pressures = (size_t)problem->pressures->count;
    state->owned = (size_t)problem->pressures->owned;
    assert_success(OST_NEW(ctx, &state->u, state->nodes));
    assert_success(OST_NEW(ctx, &state->du, state->nodes));
    assert_success(OST_NEW(ctx, &state->p, state->pressures));
    assert_success(OST_NEW(ctx, &state->dp, state->pressures));
    assert_success(OST_NEW(ctx, &state->of_tets, 4 * (size_t)problem->mesh->tet_count));
    assert_success(OST_NEW(ctx, &state->force, state->nodes));
    assert_success(OST_NEW(ctx, &state->volume, state->owned));
}

static void release(State *state)
{
    ost_problem_take_pressure(state->problem, NULL);
    ost_problem_destroy(&state->problem);
    OST_FREE(state->u, state->du, state->p, state->dp, state->of_tets, state->force, state->volume);
}

/* Adds weight × both equations of the state, changed by so much of its change. */
static void add_equations(State *state, double weight, double step, double *force, double *volume)
{
    const OstProblem *problem = state->problem;
    double *u = NULL, *p = NULL;
    assert_success(OST_NEW(ctx, &u, state->nodes));
    assert_success(OST_NEW(ctx, &p, state->pressures));
    for (size_t i = 0; i < state->nodes; i++)
        u[i] = state->u[i] + step * state->du[i];
    for (size_t k = 0; k < state->pressures; k++)
        p[k] = state->p[k] + step * state->dp[k];
    ost_pressure_of_tets(problem->pressures, p, state->of_tets);
    assert_success(ost_problem_force(problem, 1.0, u, state->force));
    assert_success(ost_pressure_volume(problem->pressures, problem->field, OST_FORMULATION_CONSISTENT, 1.0, u,
                                       state->volume, NULL));
    for (OstLocal i = 0; i < 3 * problem->mesh->owned_nodes; i++)
        force[i] += weight * state->force[i];
    for (size_t k = 0; k < state->owned; k++)
        volume[k] += weight * state->volume[k];
    OST_FREE(u, p);
}

/* The rows of the tangent along the change. */
static void multiply(const State *state, double *force, double *volume)
{
    const OstProblem *problem = state->problem;
    const OstBlockMatrix *matrix = problem->system->matrix;
    double *wide = NULL, *of_pressure = NULL, *loose = NULL;
    assert_success(OST_NEW(ctx, &wide, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &of_pressure, 3 * (size_t)matrix->rows));
    assert_success(OST_NEW(ctx, &loose, state->owned));
    for (OstLocal row = 0; row < matrix->rows; row++)
        for (int i = 0; i < 3; i++)
            wide[3 * row + i] = state->du[3 * problem->system->node_of_row[row] + i];
    assert_success(ost_block_matrix_apply(matrix, wide, force));
    assert_success(ost_coupling_transpose(problem->coupling, state->dp, of_pressure));
    for (OstLocal i = 0; i < 3 * matrix->rows; i++)
        force[i] += of_pressure[i];
    ost_coupling_multiply(problem->coupling, wide, volume);
    assert_success(ost_coupling_give_way(problem->coupling, state->dp, loose));
    for (size_t k = 0; k < state->owned; k++)
        volume[k] -= loose[k];
    OST_FREE(wide, of_pressure, loose);
}

/* The tangent is the derivative of both equations, by central differences; so it is at nu = 1/2, and with axes that
 * turn and an eigenstrain. */
static void the_tangent_is_the_derivative_of_both_equations(void **unused)
{
    (void)unused;
    static const char *const materials[] = {
        "youngs_modulus: 100, poissons_ratio: 0.5",
        "youngs_modulus: [1000, 100, 10], poissons_ratio: 0.499, axes: {euler: {degrees: [20, 40, 60]}}, "
        "eigenstrain: [0.01, 0.02, -0.01]",
        "youngs_modulus: [10, 100, 1000], poissons_ratio: 0.5, axes: {cylindrical: {origin: [-1, 0, 0], axis: [0, 0, "
        "1], order: [radial, tangential, axial]}}"};
    for (int m = 0; m < 3; m++) {
        char text[1024];
        Run run;
        State state;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [2, 1, 1], divisions: [3, 2, 2]}}\nelement: {order: 2}\nlarge_rotation: \"on\"\n"
                 "materials: [{region: all, %s}]\nconstraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                 "loads: [{on: {boundary: xmax}, total_force: [0, 0, 1]}]\n",
                 materials[m]);
        read_scene(text, &run);
        assert_success(ost_scene_problem(run.scene, &state.problem));
        make_room(&state);
        ost_problem_take_formulation(state.problem, OST_FORMULATION_CONSISTENT);
        assert_success(ost_problem_stiffness(state.problem, 1.0, NULL, NULL)); /* numbers the unknowns */
        set_state(&state);
        ost_problem_take_pressure(state.problem, state.of_tets);
        ost_pressure_of_tets(state.problem->pressures, state.p, state.of_tets);
        assert_success(ost_problem_stiffness(state.problem, 1.0, state.u, NULL));

        const OstSystem *system = state.problem->system;
        double *force = NULL, *volume = NULL, *tangent = NULL, *of_volume = NULL, sums[4] = {0.0};
        assert_success(OST_NEW(ctx, &force, state.nodes));
        assert_success(OST_NEW(ctx, &volume, state.owned));
        assert_success(OST_NEW(ctx, &tangent, 3 * (size_t)system->matrix->rows));
        assert_success(OST_NEW(ctx, &of_volume, state.owned));
        multiply(&state, tangent, of_volume);
        const double step = 1e-5;
        for (int side = -1; side < 2; side += 2)
            add_equations(&state, side / (2.0 * step), side * step, force, volume);
        for (OstLocal row = 0; row < system->matrix->rows; row++)
            for (int i = 0; i < 3; i++) {
                const double expected = force[3 * system->node_of_row[row] + i];
                sums[0] += (tangent[3 * row + i] - expected) * (tangent[3 * row + i] - expected);
                sums[1] += expected * expected;
            }
        for (size_t k = 0; k < state.owned; k++) {
            sums[2] += (of_volume[k] - volume[k]) * (of_volume[k] - volume[k]);
            sums[3] += volume[k] * volume[k];
        }
        assert_success(ost_sum(ctx, 4, sums));
        assert_true(sqrt(sums[0] / sums[1]) < 1e-7);
        assert_true(sqrt(sums[2] / sums[3]) < 1e-7);
        OST_FREE(force, volume, tangent, of_volume);
        release(&state);
        clear(&run);
    }
}

/* Euler's elastica at P L² / EI = 2 (tests/solve/mpi_test_newton.c), of incompressible material, to half a percent; the
 * same on any number of ranks, and the limit of what gives way. Volume is kept up to the square of the strain. */
static void an_incompressible_cantilever_bends_as_the_elastica(void **unused)
{
    (void)unused;
    static const char *const ratios[] = {"0.499", "0.5"};
    double energy[2];
    for (int n = 0; n < 2; n++) {
        char text[1024];
        double tip[3] = {0.0};
        Run run;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [1, 0.04, 0.04], divisions: [20, 1, 1]}}\nelement: {order: 2}\n"
                 "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: %s}]\n"
                 "constraints:\n  - {on: {boundary: xmin}, slide: [1, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0.04, 0]}, displacement: [0, free, 0]}\n"
                 "loads: [{on: {boundary: xmax}, total_force: [0, 0, %.17g]}]\nlarge_rotation: \"on\"\n"
                 "accuracy: {relative_residual: 1e-9}\n",
                 ratios[n], -2.0 * 1200.0 * pow(0.04, 4) / 12.0);
        solve(text, &run);
        const OstMesh *mesh = run.scene->mesh;
        for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
            const double *x = mesh->coordinates + 3 * node;
            if (fabs(x[0] - 1.0) + fabs(x[1] - 0.02) + fabs(x[2] - 0.02) < 1e-9)
                memcpy(tip, run.result->displacement + 3 * node, sizeof tip);
        }
        assert_success(ost_sum(ctx, 3, tip));
        assert_close(-tip[2], 0.49345748, 0.005 * 0.49345748);
        assert_close(-tip[0], 0.16064172, 0.005 * 0.16064172);
        energy[n] = run.result->checks.strain_energy;
        assert_close(run.result->checks.volume_ratio, 1.0, 1e-4);
        clear(&run);
    }
    assert_close(energy[0] / energy[1], 1.0, 1e-4);
    assert_close(energy[1] / 1.0820339083e-4, 1.0, 1e-8);
}

/* A bar of nu = 1/2, stretched to 1.1 times its length and free across, has U = diag(1.1, 0.95, 0.95): Biot's stress is
 * E × 0.1 along it, Cauchy's that times 1.1 / det F. The pressure is a third of what c leaves. */
static void a_stretched_bar_has_the_stress_of_its_strain(void **unused)
{
    (void)unused;
    const double ratio = 1.1 * 0.95 * 0.95, along = 30.0 * 0.1 * 1.1 / ratio;
    Run run;
    solve("mesh: {block: {size: [2, 1, 1], divisions: [2, 2, 1]}}\nelement: {order: 2}\n"
          "materials: [{region: all, youngs_modulus: 30, poissons_ratio: 0.5}]\n"
          "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]},\n"
          "  {on: {boundary: zmin}, slide: [0, 0, 1]}, {on: {boundary: xmax}, displacement: [0.2, free, free]}]\n"
          "large_rotation: \"on\"\naccuracy: {relative_residual: 1e-11}\n",
          &run);
    assert_close(run.result->checks.volume_ratio, ratio, 1e-9);
    assert_close(run.result->checks.strain_energy, 0.5 * 30.0 * 0.01 * 2.0, 1e-8);
    for (OstLocal t = 0; t < run.scene->mesh->owned_tets; t++)
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_stress(run.result)[6 * t + p], p == 0 ? along : 0.0, 1e-7);
    for (OstLocal node = 0; node < run.scene->mesh->owned_nodes; node++)
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_node_stress(run.result)[6 * node + p], p == 0 ? along : 0.0, 1e-7);
    clear(&run);
}

/* A straight column is at rest under any load, but beyond Euler's not stable: there A is indefinite from 87 % of it on,
 * and the factors of both equations tell. Beyond the load, also closely, it stands bent as the elastica (Timoshenko and
 * Gere, Theory of elastic stability, 2-7). */
static void an_incompressible_column_buckles_at_eulers_load(void **unused)
{
    (void)unused;
    static const struct {
        const char *ratio;
        double share, tip; /* of Euler's load; aside */
    } columns[] = {{"0.5", 0.98, 0.0}, {"0.5", 1.02, 0.2487}, {"0.5", 1.1, 0.5085}, {"0.4999", 1.1, 0.5085}};
    const double pi = 3.14159265358979, load = pi * pi / 4.0 * 1200.0 * 0.12 * pow(0.08, 3) / 12.0;
    double bent[4] = {0.0};
    for (int k = 0; k < 4; k++) {
        const int beyond = columns[k].share > 1.0;
        char text[1024];
        double aside = 0.0;
        Run run;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [1, 0.12, 0.08], divisions: [10, 1, 1]}}\nelement: {order: 2}\n"
                 "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: %s}]\n"
                 "constraints:\n  - {on: {boundary: xmin}, slide: [1, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0.12, 0]}, displacement: [0, free, 0]}\n"
                 "loads: [{on: {boundary: xmax}, total_force: [%.17g, 0, 0]}]\nlarge_rotation: \"on\"\n",
                 columns[k].ratio, -columns[k].share * load);
        solve(text, &run);
        const OstNewtonReport *report = &run.result->newton;
        assert_int_equal(report->stability_unknown, 0);
        assert_int_equal(report->jumps > 0, beyond);
        for (OstLocal i = 0; i < run.scene->mesh->owned_nodes; i++)
            aside = fmax(aside, fabs(run.result->displacement[3 * i + 2]));
        assert_success(ost_max(ctx, 1, &aside));
        assert_close(aside, columns[k].tip, fmax(0.04 * columns[k].tip, 1e-3)); /* it bulges */
        bent[k] = aside;
        clear(&run);
    }
    assert_close(bent[3] / bent[2], 1.0, 1e-3);
}

/* Of a load without a work function, pressure that follows a strip with free edges, the stiffness is not symmetric:
 * GMRES solves both equations, by factors and without. Euler's elastica (tests/solve/test_large_effects.c) to half a
 * percent. */
static void an_incompressible_strip_under_pressure_is_an_elastica(void **unused)
{
    (void)unused;
    static const char *const solvers[] = {"direct", "metric"};
    for (int k = 0; k < 2; k++) {
        char text[1024];
        double tip[3] = {0.0};
        Run run;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [10, 0.25, 0.25], divisions: [14, 1, 1]}}\nelement: {order: 2}\n"
                 "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.5}]\n"
                 "constraints:\n  - {on: {boundary: xmin}, slide: [1, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}\n"
                 "  - {on: {nearest: [0, 0.25, 0]}, displacement: [0, free, 0]}\n"
                 "loads: [{on: {boundary: zmin}, pressure: 6, follows: true}]\nlarge_rotation: \"on\"\n"
                 "solver: {method: %s}\n",
                 solvers[k]);
        solve(text, &run);
        const OstMesh *mesh = run.scene->mesh;
        for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
            const double *x = mesh->coordinates + 3 * node;
            if (fabs(x[0] - 10.0) + fabs(x[1] - 0.125) + fabs(x[2] - 0.125) < 1e-9)
                memcpy(tip, run.result->displacement + 3 * node, sizeof tip);
        }
        assert_success(ost_sum(ctx, 3, tip));
        assert_close(tip[2], 5.248757868, 0.005 * 5.248757868);
        assert_close(10.0 + tip[0], 8.240726496, 0.005 * 8.240726496);
        assert_close(run.result->checks.volume_ratio, 1.0, 1e-4);
        clear(&run);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_tangent_is_the_derivative_of_both_equations),
    cmocka_unit_test(an_incompressible_cantilever_bends_as_the_elastica),
    cmocka_unit_test(a_stretched_bar_has_the_stress_of_its_strain),
    cmocka_unit_test(an_incompressible_column_buckles_at_eulers_load),
    cmocka_unit_test(an_incompressible_strip_under_pressure_is_an_elastica),
};

OST_TEST_MAIN(tests)
