/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "orthostat/scene.h"
#include "problem/result_data.h"
#include "study/forecast/forecast.h"

#include <sys/stat.h>

/* What is foretold of a run, before it and after it. */

#define USUAL "youngs_modulus: 1e6, poissons_ratio: 0.3"

static OstCase *c;
static OstPlan plan;

static void make_plan(const char *mesh, int order, const char *material, const char *more)
{
    char text[1024];
    snprintf(text, sizeof text,
             "mesh:\n  %s\nelement: {order: %d}\nmaterials: [{region: all, %s}]\nconstraints: [{on: {boundary: %s}, "
             "displacement: [0, 0, 0]}]\nloads: [{body_force: [0, 0, -1]}]\nlarge_rotation: off\n%s",
             mesh, order, material, strstr(mesh, "tube") ? "ends" : "xmin", more);
    assert_success(read_text(text, &c));
    OstPlanMesh facts = {.quadratic = order == 2};
    ost_plan_shape_size(c, &facts.nodes, &facts.tets);
    ost_plan_make(c, &facts, 1, &plan);
}

/* The ledger is exact, and the same on every machine. */
static double foretold_over_taken(const char *mesh, int order, const char *material, const char *more)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    make_plan(mesh, order, material, more);
    ost_ledger_restart_peak(ctx);
    const double before = (double)ost_ledger_bytes(ctx);
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_solve(scene, &result));
    const double taken = (double)ost_ledger_peak_bytes(ctx) - before;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return plan.bytes_in_all / taken;
}

static void memory_is_foretold(void **state)
{
    static const char turned[] =
        "youngs_modulus: [1e9, 1e6, 1e6], poissons_ratio: 0.3, axes: {rotation: {axis: [0, 0, 1], degrees: 30}}";
    static const struct {
        const char *mesh;
        int order;
        const char *material;
    } body[] = {
        {"tube: {axis: y, length: 10, radii: [1.4, 1.5], divisions: {around: 60, radial: 1, axial: 60}}", 1, USUAL},
        {"block: {size: [1, 1, 1], divisions: [17, 17, 17]}", 1, USUAL},
        {"block: {size: [10, 1, 1], divisions: [50, 6, 6]}", 1, USUAL},
        {"tube: {axis: y, length: 10, radii: [1.4, 1.5], divisions: {around: 24, radial: 1, axial: 24}}", 2, USUAL},
        {"block: {size: [1, 1, 1], divisions: [9, 9, 9]}", 2, USUAL},
        {"block: {size: [1, 1, 1], divisions: [9, 9, 9]}", 2, turned}, /* levels of vertices that turn */
    };
    for (size_t b = 0; b < sizeof body / sizeof *body; b++)
        for (int with_estimate = 0; with_estimate < 2; with_estimate++) {
            const char *more = with_estimate ? "" : "output: {fields: [displacement]}\n";
            const double ratio = foretold_over_taken(body[b].mesh, body[b].order, body[b].material, more);
            if (!(ratio > 1.0 / 1.15 && ratio < 1.15))
                fail_msg("body %zu, %s estimate: foretold %.3f times what was taken", b,
                         with_estimate ? "with" : "without", ratio);
        }
}

static OstForecast forecast_with(const OstRates *rates, int ranks)
{
    OstForecast forecast;
    ost_forecast_make(c, &plan, rates, ranks, &forecast);
    ost_case_destroy(&c);
    return forecast;
}

static OstForecast forecast(const char *mesh, int order, const char *material, const char *more)
{
    const OstRates rates = ost_rates_typical();
    make_plan(mesh, order, material, more);
    return forecast_with(&rates, 1);
}

/* Potentials are solved for before the stiffness is made, and take most there is. */
static void potentials_are_foretold(void **state)
{
#define MUSCLE                                                                                                        \
    "youngs_modulus: {plane: 1e6, axis: 1e7}, poissons_ratio: {plane: 0.3, plane_axis: 0.03}, shear_modulus: {axis: " \
    "4e5}, fibre: "
    static const char *const body[] = {"block: {size: [1, 1, 1], divisions: [15, 15, 15]}",
                                       "block: {size: [1, 1, 1], divisions: [8, 8, 8]}"};
    for (int order = 1; order <= 2; order++) {
        const char *mesh = body[order - 1], *gradient = MUSCLE "{gradient: {from: xmin, to: xmax}}";
        const double ratio = foretold_over_taken(mesh, order, gradient, "");
        if (!(ratio > 1.0 / 1.2 && ratio < 1.2))
            fail_msg("order %d: foretold %.3f times what was taken", order, ratio);
        const double seconds = forecast(mesh, order, MUSCLE "[1, 0, 0]", "").in_all;
        assert_true(forecast(mesh, order, gradient, "").in_all > 1.1 * seconds);
    }
#undef MUSCLE
}

/* A node of a solid block has more neighbours than one of a thin wall. */
static void a_solid_body_costs_more_an_unknown(void **state)
{
    const OstForecast thin =
        forecast("tube: {axis: y, length: 10, radii: [1.4, 1.5], divisions: {around: 116, radial: 1, axial: 127}}", 1,
                 USUAL, "");
    const OstGlobal thin_nodes = plan.nodes;
    const OstForecast solid = forecast("block: {size: [1, 1, 1], divisions: [30, 30, 30]}", 1, USUAL, "");
    assert_close((double)thin_nodes / (double)plan.nodes, 1.0, 0.01);
    assert_true(solid.bytes > 1.2 * thin.bytes);
    assert_true(solid.in_all > 1.3 * thin.in_all);
    assert_true(solid.work[OST_STAGE_SETUP] > 1.5 * thin.work[OST_STAGE_SETUP]);
}

static void what_is_hard_takes_more(void **state)
{
    static const char *const mesh = "block: {size: [1, 1, 1], divisions: [20, 20, 20]}";
    const char *const tight = "accuracy: {relative_residual: 1e-8}\n";
    const OstForecast usual = forecast(mesh, 1, USUAL, tight);
    const OstForecast quadratic = forecast(mesh, 2, USUAL, tight);
    const OstForecast volume = forecast(mesh, 1, "youngs_modulus: 1e6, poissons_ratio: 0.499", tight);
    const OstForecast uneven = forecast(mesh, 1, "youngs_modulus: [1e9, 1e6, 1e6], poissons_ratio: 0.3", tight);
    const OstForecast loose = forecast(mesh, 1, USUAL, "accuracy: {relative_residual: 1e-4}\n");
    const OstForecast stopped = forecast(mesh, 1, USUAL, "");
    const OstForecast without = forecast(mesh, 1, USUAL, "output: {fields: [displacement]}\n");
    assert_true(quadratic.bytes > 5.0 * usual.bytes && quadratic.in_all > 3.0 * usual.in_all);
    assert_true(volume.iterations > 3.0 * usual.iterations && volume.bytes > 1.2 * usual.bytes);
    assert_true(uneven.iterations > 1.2 * usual.iterations);
    assert_close(loose.iterations, 0.5 * usual.iterations, 1e-9);
    assert_true(stopped.iterations < 0.5 * usual.iterations);
    assert_close(without.work[OST_STAGE_ESTIMATE], 0.0, 0.0);
    assert_close(without.iterations, usual.iterations, 1e-9); /* nothing tells when to stop */
}

/* Each reaction that statics does not give takes an adjoint problem; load cases share it. */
static void watched_quantities_take_more(void **state)
{
    static const char *const mesh = "block: {size: [1, 1, 1], divisions: [12, 12, 12]}";
    char text[512], cases[768];
    const OstForecast none = forecast(mesh, 2, USUAL, "");
    const OstForecast by_statics = forecast(mesh, 2, USUAL, "watch: {r: {reaction: {boundary: xmin}, component: z}}\n");
    const OstForecast place = forecast(mesh, 2, USUAL, "watch: {u: {displacement: {nearest: [1, 1, 1]}}}\n");
    assert_close(by_statics.in_all, place.in_all, 1e-9);
    assert_true(place.in_all > none.in_all);
    snprintf(text, sizeof text, "springs: [{on: {boundary: zmax}, foundation: 10}]\n");
    const OstForecast held = forecast(mesh, 2, USUAL, text);
    strcat(text, "watch:\n  a: {reaction: {boundary: xmin}, component: z}\n");
    const OstForecast one = forecast(mesh, 2, USUAL, text);
    strcat(text, "  b: {reaction: {boundary: xmin}, component: x}\n");
    const OstForecast two = forecast(mesh, 2, USUAL, text);
    assert_int_equal(plan.adjoints, 2);
    assert_true(one.seconds[OST_STAGE_ESTIMATE] > held.seconds[OST_STAGE_ESTIMATE] + held.seconds[OST_STAGE_SOLVE]);
    assert_true(two.in_all - one.in_all > 0.5 * (one.in_all - held.in_all));
    assert_true(one.bytes > held.bytes);
    snprintf(cases, sizeof cases, "cases: [{name: p}, {name: q}, {name: r}]\n%s", text);
    const OstForecast three = forecast(mesh, 2, USUAL, cases);
    assert_true(three.seconds[OST_STAGE_ESTIMATE] < 2.5 * two.seconds[OST_STAGE_ESTIMATE]);
}

/* Cells 0.25 to 6 times as long as the wall is thick, in one and two layers. */
static void thin_walls_take_more_iterations(void **state)
{
    static const struct {
        const char *mesh;
        int order;
    } walls[] = {
        {"block: {size: [8, 8, 0.08], divisions: [32, 32, 1]}", 1},
        {"block: {size: [8, 8, 1], divisions: [32, 32, 1]}", 1},
        {"tube: {axis: y, length: 4, radii: [0.9, 1], divisions: {around: 24, radial: 1, axial: 16}}", 2},
        {"block: {size: [5, 5, 0.1], divisions: [20, 20, 1]}", 2},
        {"block: {size: [5, 5, 0.1], divisions: [20, 20, 2]}", 2},
        {"block: {size: [5, 5, 1], divisions: [20, 20, 1]}", 2},
    };
    for (size_t w = 0; w < sizeof walls / sizeof *walls; w++) {
        OstScene *scene = NULL;
        OstResult *result = NULL;
        make_plan(walls[w].mesh, walls[w].order, USUAL, "");
        assert_success(ost_scene_create(c, &scene));
        assert_success(ost_scene_solve(scene, &result));
        const double ratio = ost_forecast_iterations(&plan) / result->solve.iterations;
        ost_result_destroy(&result);
        ost_scene_destroy(&scene);
        ost_case_destroy(&c);
        print_message("%s, order %d: %.2f\n", walls[w].mesh, walls[w].order, ratio);
        assert_true(ratio > 0.5 && ratio < 2.0);
    }
}

/* Cells of a quarter of a tube, 0.1 thick: arcs of pi / 2 × 1.05 / 11, refined once. */
static void cells_of_shapes_have_a_slenderness(void **state)
{
    make_plan(
        "sector: {axis: z, length: 3, radii: [1, 1.1], angle: 90, divisions: {around: 11, radial: 1, axial: 20}}\n"
        "  refine: 1",
        2, USUAL, "");
    assert_close(plan.slenderness, sqrt(acos(0.0) * 1.05 / 22.0 * 3.0 / 40.0) / 0.1, 1e-12);
    assert_close(plan.cells_across, 2.0, 0.0);
    ost_case_destroy(&c);
}

static OstForecast forecast_of(const char *load, const char *large_rotation, const char *more)
{
    char text[1024];
    OstPlanMesh facts = {.quadratic = 0};
    snprintf(text, sizeof text,
             "mesh: {block: {size: [1, 1, 1], divisions: [16, 16, 16]}}\nmaterials: [{region: all, " USUAL
             "}]\nconstraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\nloads: [{%s}]\n"
             "large_rotation: %s\naccuracy: {relative_residual: 1e-8}\n%s",
             load, large_rotation, more);
    const OstRates rates = ost_rates_typical();
    assert_success(read_text(text, &c));
    ost_plan_shape_size(c, &facts.nodes, &facts.tets);
    ost_plan_make(c, &facts, 1, &plan);
    return forecast_with(&rates, 1);
}

/* By linear theory one solve does for all steps of a path; each has an estimate and a file. */
static void steps_and_motions_take_more(void **state)
{
    static const double rates = 0.02; /* which grow a little with the memory */
    const char *const force = "body_force: [0, 0, -1]", *const path = "path: {steps: 5}\n";
    const OstForecast once = forecast_of(force, "off", ""), five = forecast_of(force, "off", path);
    assert_close(five.seconds[OST_STAGE_SOLVE], once.seconds[OST_STAGE_SOLVE], rates * once.seconds[OST_STAGE_SOLVE]);
    assert_close(five.seconds[OST_STAGE_ESTIMATE], 5.0 * once.seconds[OST_STAGE_ESTIMATE],
                 rates * five.seconds[OST_STAGE_ESTIMATE]);
    assert_true(five.seconds[OST_STAGE_OUTPUT] > 3.0 * once.seconds[OST_STAGE_OUTPUT]);

    const OstForecast turned = forecast_of(force, "on", ""), turned_five = forecast_of(force, "on", path);
    assert_true(turned.newton > once.seconds[OST_STAGE_SOLVE] + once.seconds[OST_STAGE_ASSEMBLY]);
    assert_true(turned.in_all > once.in_all + 2.0 * turned.newton);
    assert_close(turned_five.newton, turned.newton, rates * turned.newton);
    assert_close(turned_five.newton_in_all, 5.0 * turned.newton_in_all, rates * turned_five.newton_in_all);
    assert_close(once.newton_in_all, 0.0, 0.0);

    const char *const lifted =
        "on: {boundary: xmax}, distributing: {at: [1, 0.5, 0.5], displacement: [free, free, 0.1]}";
    const char *const moved = "on: {boundary: xmax}, distributing: {at: [1, 0.5, 0.5], displacement: [0, 0, 0.1], "
                              "rotation: [0, 0, 0.1]}";
    const OstForecast one = forecast_of(lifted, "off", ""), six = forecast_of(moved, "off", "");
    assert_close(six.seconds[OST_STAGE_SOLVE] - once.seconds[OST_STAGE_SOLVE],
                 6.0 * (one.seconds[OST_STAGE_SOLVE] - once.seconds[OST_STAGE_SOLVE]),
                 rates * six.seconds[OST_STAGE_SOLVE]);
    assert_true(one.seconds[OST_STAGE_SOLVE] > 1.5 * once.seconds[OST_STAGE_SOLVE]);
}

static void few_unknowns_are_factored(void **state)
{
    const OstForecast few = forecast("block: {size: [1, 1, 1], divisions: [4, 4, 4]}", 1, USUAL, "");
    assert_close(few.iterations, 1.0, 0.0);
    assert_true(few.in_all > 0.0 && isfinite(few.in_all));
}

/* The parts of a forecast add up, and ranks share its work. */
static void ranks_share_the_work(void **state)
{
    OstRates rates = {.start = 0.5, .process_bytes = 1e7, .small_bytes = {1e6, 1e6}, .large_bytes = {2e6, 2e6}};
    for (int q = 0; q < 2; q++)
        for (int s = 0; s < OST_STAGES; s++)
            rates.stage[q][s] = (OstRate){1e-9, 2e-9};
    static const char *const mesh = "block: {size: [1, 1, 1], divisions: [20, 20, 20]}";
    make_plan(mesh, 1, USUAL, "");
    const OstForecast one = forecast_with(&rates, 1);
    make_plan(mesh, 1, USUAL, "");
    const OstForecast two = forecast_with(&rates, 2);
    double sum = one.start;
    for (int s = 0; s < OST_STAGES; s++) {
        assert_close(one.seconds[s], 2e-9 * one.work[s], 1e-15 * one.work[s]);
        assert_close(two.seconds[s], 0.5 * one.seconds[s], 1e-12 * one.seconds[s]);
        sum += one.seconds[s];
    }
    assert_close(one.in_all, sum, 1e-12);
    assert_close(one.with_libraries - one.bytes, 1e7, 1.0);
    assert_close(two.with_libraries - two.bytes, 2e7, 1.0);
}

static void rates_lie_between_those_measured(void **state)
{
    OstRates rates = {.small_bytes = {1e6, 1e7}, .large_bytes = {1e8, 1e7}};
    rates.stage[0][OST_STAGE_SOLVE] = (OstRate){1.0, 3.0};
    rates.stage[1][OST_STAGE_SOLVE] = (OstRate){1.0, 3.0};
    assert_close(ost_rate_at(&rates, 1, OST_STAGE_SOLVE, 1e5), 1.0, 0.0);
    assert_close(ost_rate_at(&rates, 1, OST_STAGE_SOLVE, 1e7), 2.0, 1e-12);
    assert_close(ost_rate_at(&rates, 1, OST_STAGE_SOLVE, 1e9), 3.0, 0.0);
    assert_close(ost_rate_at(&rates, 2, OST_STAGE_SOLVE, 1e6), 3.0, 0.0); /* one size alone was measured */
}

/* A cache folder of the test's own. */
static void enter_cache(char folder[64])
{
    strcpy(folder, "/tmp/orthostat-rates-XXXXXX");
    assert_non_null(mkdtemp(folder));
    assert_int_equal(setenv("XDG_CACHE_HOME", folder, 1), 0);
}

static void leave_cache(const char *folder)
{
    char path[128];
    assert_true(ost_rates_path(path, sizeof path));
    remove(path);
    snprintf(path, sizeof path, "%s/orthostat", folder);
    rmdir(path);
    assert_int_equal(rmdir(folder), 0);
    unsetenv("XDG_CACHE_HOME");
}

static void assert_words(const OstRates *rates, const char *version, const char *expected)
{
    char words[320];
    ost_rates_words(rates, version, words, sizeof words);
    if (!strstr(words, expected))
        fail_msg("'%s' does not contain '%s'", words, expected);
}

static void rates_are_kept_and_say_where_they_are_from(void **state)
{
    char folder[64];
    OstRates found, made = ost_rates_of_here("1.2.3");
    enter_cache(folder);
    assert_success(ost_rates_load(ctx, &found));
    assert_words(&found, "1.2.3", "typical of");
    made.start = 0.25;
    made.process_bytes = 5e7;
    for (int q = 0; q < 2; q++) {
        made.small_bytes[q] = 1e6 + q;
        made.large_bytes[q] = 1e8 + q;
        for (int s = 0; s < OST_STAGES; s++)
            made.stage[q][s] = (OstRate){1e-9 * (s + 1) + q, 2e-9 * (s + 1) + q};
    }
    assert_success(ost_rates_save(ctx, &made));
    assert_success(ost_rates_load(ctx, &found));
    assert_words(&found, "1.2.3", "measured on this machine on 20");
    assert_words(&found, "1.2.4", "of version 1.2.3 of the program");
    assert_string_equal(found.machine, made.machine);
    assert_close(found.start, 0.25, 0.0);
    assert_close(found.process_bytes, 5e7, 0.0);
    assert_close(found.large_bytes[1], made.large_bytes[1], 0.0);
    assert_memory_equal(found.stage, made.stage, sizeof made.stage);
    strcpy(made.machine, "elsewhere");
    assert_success(ost_rates_save(ctx, &made));
    assert_success(ost_rates_load(ctx, &found));
    assert_words(&found, "1.2.3", "of another machine (elsewhere");
    leave_cache(folder);
}

static void rates_that_cannot_be_read_are_not_used(void **state)
{
    static const char *const broken[] = {"", "{", "{}", "{\"machine\": \"a\", \"orders\": 3}", "[1, 2]"};
    char folder[64], path[128];
    OstRates found;
    enter_cache(folder);
    snprintf(path, sizeof path, "%s/orthostat", folder);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_true(ost_rates_path(path, sizeof path));
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (size_t b = 0; b < sizeof broken / sizeof *broken; b++) {
        write_bytes(path, broken[b], strlen(broken[b]));
        assert_success(ost_rates_load(ctx, &found));
        assert_true(found.typical);
    }
    ost_log_set_level(ctx, OST_LOG_NORMAL);
    leave_cache(folder);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(memory_is_foretold),
    cmocka_unit_test(potentials_are_foretold),
    cmocka_unit_test(a_solid_body_costs_more_an_unknown),
    cmocka_unit_test(what_is_hard_takes_more),
    cmocka_unit_test(watched_quantities_take_more),
    cmocka_unit_test(thin_walls_take_more_iterations),
    cmocka_unit_test(cells_of_shapes_have_a_slenderness),
    cmocka_unit_test(steps_and_motions_take_more),
    cmocka_unit_test(few_unknowns_are_factored),
    cmocka_unit_test(ranks_share_the_work),
    cmocka_unit_test(rates_lie_between_those_measured),
    cmocka_unit_test(rates_are_kept_and_say_where_they_are_from),
    cmocka_unit_test(rates_that_cannot_be_read_are_not_used),
};
OST_TEST_MAIN(tests)
