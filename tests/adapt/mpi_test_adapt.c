/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "adapt/adapt.h"
#include "adapt/mark.h"
#include "adapt/stage.h"
#include "core/parallel/reduce.h"

/* A beam of three cells, clamped at one end, where edges and corners are singular, and pushed aside at the other. */
#define BEAM                                                                             \
    "mesh: {block: {size: [3, 1, 1], divisions: [3, 1, 1]}}\n"                           \
    "materials: [{region: all, youngs_modulus: [1e6, 1e5, 1e5], poissons_ratio: 0.3}]\n" \
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"                   \
    "loads: [{on: {boundary: xmax}, traction: [0, 0, 100]}]\nlarge_rotation: off\n"

static const OstAdaptLimits no_limits = {INFINITY, INFINITY};

static OstAdaption *adapt(const char *text, const OstAdaptLimits *limits, OstCase **c)
{
    OstAdaption *adaption = NULL;
    assert_success(read_text(text, c));
    assert_success(ost_adapt(*c, limits, &adaption));
    return adaption;
}

static void end(OstAdaption **adaption, OstCase **c)
{
    ost_adaption_destroy(adaption);
    ost_case_destroy(c);
}

static const OstAdaptLevel *last_of(const OstAdaption *adaption)
{
    return &adaption->level[adaption->count - 1];
}

/* Loads alone act: the energy that is missing is half the error's square. */
static double true_error(const OstAdaption *adaption, double energy)
{
    return sqrt(1.0 - last_of(adaption)->strain_energy / energy);
}

static void a_request_is_met_and_not_by_far(void **state)
{
    static const double request[2] = {0.1, 0.05};
    OstCase *c = NULL;
    const double energy = 0.666362; /* by 222,330 unknowns that are 0.7 % off, and what they miss */
    for (int r = 0; r < 2; r++) {
        char text[1024];
        snprintf(text, sizeof text, BEAM "accuracy: {relative_error: %g}\n", request[r]);
        OstAdaption *adaption = adapt(text, &no_limits, &c);
        assert_int_equal(adaption->end, OST_ADAPT_MET);
        assert_true(last_of(adaption)->error.relative <= (last_of(adaption)->is_measured ? 0.9 : 0.75) * request[r]);
        assert_true(true_error(adaption, energy) < request[r]);
        assert_true(true_error(adaption, energy) > 0.3 * request[r]);
        assert_int_equal(ost_adaption_result(adaption)->unknowns, last_of(adaption)->unknowns);
        assert_int_equal(ost_adaption_scene(adaption)->mesh->global_tets, last_of(adaption)->tets);
        end(&adaption, &c);
    }
}

/* Where stiff directions cross the tets an estimate alone finds two thirds of the error; what the last levels gained
 * tells the rest. The energy that is not known is that of the finer answer, with its own error added. */
#define CROSSED                                                                         \
    "mesh: {block: {size: [9.42, 1, 1.3], divisions: [6, 2, 2]}}\n"                     \
    "materials: [{region: all, youngs_modulus: [1e6, 1e8, 1e6], poissons_ratio: 0.3,\n" \
    "             axes: {rotation: {axis: [0.58, -0.81, 1], degrees: 12}}}]\n"          \
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"                  \
    "loads: [{on: {boundary: zmax}, traction: [-0.13, 0.52, -1]}]\nlarge_rotation: off\n"

static void what_levels_gain_measures_the_estimate(void **state)
{
    OstCase *coarse_case = NULL, *fine_case = NULL;
    OstAdaption *coarse = adapt(CROSSED "accuracy: {relative_error: 0.2}\n", &no_limits, &coarse_case);
    OstAdaption *fine = adapt(CROSSED "accuracy: {relative_error: 0.08}\n", &no_limits, &fine_case);
    const OstResult *result = ost_adaption_result(coarse);
    const double left = last_of(fine)->error.energy_norm;
    const double energy = last_of(fine)->strain_energy + 0.5 * left * left;
    const double whole = true_error(coarse, energy) * sqrt(2.0 * energy);
    double square = 0.0;
    assert_true(last_of(coarse)->is_measured && last_of(coarse)->missed > 1.1);
    assert_true(last_of(coarse)->error.energy_norm / last_of(coarse)->missed < 0.75 * whole);
    assert_true(fabs(result->answer.energy_norm / whole - 1.0) < 0.12);
    for (OstLocal t = 0; t < ost_adaption_scene(coarse)->mesh->owned_tets; t++)
        square += result->tet_error[t] * result->tet_error[t];
    assert_success(ost_sum(coarse->ctx, 1, &square));
    assert_true(fabs(sqrt(square) / result->answer.energy_norm - 1.0) < 1e-6);
    end(&coarse, &coarse_case);
    end(&fine, &fine_case);
}

/* A value with its error added changes little from level to level: where that tells, an estimate need not be within
 * three quarters. Solves stop by what they leave of the displacement. */
static void two_values_tell_how_much_an_estimate_may_miss(void **state)
{
    static const char *const stop[2] = {"", ", algebraic_fraction: 0"};
    const double request = 0.028, exact = 0.0142031; /* by 73,533 unknowns */
    OstAdaptLevel last[2];
    for (int k = 0; k < 2; k++) {
        char text[1024];
        OstCase *c = NULL;
        snprintf(text, sizeof text,
                 "mesh: {tube: {axis: z, length: 4, radii: [0.7, 1], divisions: {around: 16, radial: 1, axial: 6}}}\n"
                 "materials: [{region: all, youngs_modulus: [1, 10, 3], poissons_ratio: 0.3, axes: {cylindrical:\n"
                 "  {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]\nlarge_rotation: off\n"
                 "constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]\n"
                 "loads: [{on: {boundary: top}, total_force: [0.001, 0, 0]}]\n"
                 "watch: {tip: {displacement: {nearest: [1, 0, 4]}, component: x}}\n"
                 "accuracy: {relative_error: %g, of: tip%s}\n",
                 request, stop[k]);
        OstAdaption *adaption = adapt(text, &no_limits, &c);
        last[k] = *last_of(adaption);
        assert_int_equal(adaption->end, OST_ADAPT_MET);
        assert_int_equal(ost_adaption_result(adaption)->solve.stopped, k == 0);
        end(&adaption, &c);
    }
    assert_true(last[0].relative_error > 0.75 * request && last[0].most_relative_error < 0.95 * request);
    assert_true(fabs(1.0 - last[0].value / exact) < request && fabs(1.0 - last[0].value / exact) > 0.3 * request);
    assert_int_equal(last[0].unknowns, last[1].unknowns);
    assert_true(fabs(last[0].value - last[1].value) < 0.05 * fabs(last[1].off));
    assert_true(fabs(last[0].value + last[0].off - last[1].value - last[1].off) < 0.005 * fabs(last[1].off));
    assert_true(2 * last[0].iterations < last[1].iterations);
}

/* The volume of a tube grows as its faces follow the surface, and a box holds more faces of a finer mesh: potentials
 * tell nothing there. */
static void problems_that_change_with_the_mesh_measure_nothing(void **state)
{
    static const char *const body[] = {
        "mesh: {tube: {axis: z, length: 2, radii: [0.6, 1], divisions: {around: 8, radial: 1, axial: 3}}}\n"
        "constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]\n"
        "loads: [{on: {boundary: inner}, pressure: 100}]\n",
        "mesh: {block: {size: [3, 1, 1], divisions: [3, 1, 1]}}\n"
        "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
        "loads: [{on: {box: {min: [1.4, 0, 1], max: [3, 1, 1]}}, traction: [0, 0, 100]}]\n"};
    for (size_t k = 0; k < sizeof body / sizeof *body; k++) {
        char text[1024];
        OstCase *c = NULL;
        snprintf(text, sizeof text,
                 "%smaterials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]\nlarge_rotation: off\n"
                 "accuracy: {relative_error: 0.1}\n",
                 body[k]);
        OstAdaption *adaption = adapt(text, &no_limits, &c);
        assert_int_equal(adaption->end, OST_ADAPT_MET);
        assert_true(adaption->count > 2);
        for (int l = 0; l < adaption->count; l++)
            assert_false(adaption->level[l].is_measured);
        assert_true(last_of(adaption)->error.relative <= 0.75 * 0.1);
        end(&adaption, &c);
    }
}

/* A reaction takes an adjoint problem: the level that stays the last solves it, and no other. */
static void only_the_last_level_finds_the_errors_of_reactions(void **state)
{
    OstCase *c = NULL;
    OstStage *stage = NULL, *next = NULL;
    OstMarking marking = {.order = 2, .target = 0.0, .least_tets = 40.0, .most_tets = 80.0};
    assert_success(read_text("mesh: {block: {size: [3, 1, 1], divisions: [3, 1, 1]}}\nelement: {order: 2}\n"
                             "materials: [{region: all, youngs_modulus: [1e6, 1e5, 1e5], poissons_ratio: 0.3}]\n"
                             "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n"
                             "  - {on: {boundary: xmax}, displacement: [0, 0, 0.01]}\n"
                             "watch: {push: {reaction: {boundary: xmax}, component: z}}\nlarge_rotation: off\n",
                             &c));
    assert_success(ost_stage_create(c->ctx, &stage));
    assert_success(ost_stage_open(stage, c));
    assert_success(ost_stage_solve(stage));
    assert_true(stage->result->answer.known);
    assert_null(stage->result->reactions);
    assert_success(ost_stage_finish(stage));
    assert_true(stage->result->reactions[0].known);
    const double error = stage->result->reactions[0].error;
    assert_true(error < 0.0); /* a mesh is too stiff */
    assert_null(stage->analysis);
    /* where a finer level fails, the last answer is that of a stage whose solver is gone */
    ost_stage_destroy(&stage);
    assert_success(ost_stage_create(c->ctx, &stage));
    assert_success(ost_stage_open(stage, c));
    assert_success(ost_stage_solve(stage));
    assert_success(ost_stage_create(c->ctx, &next));
    assert_success(ost_stage_refine(stage, &marking, next));
    assert_null(stage->analysis);
    ost_stage_destroy(&next);
    assert_success(ost_stage_finish(stage));
    assert_true(stage->result->reactions[0].known);
    assert_close(stage->result->reactions[0].error, error, 1e-3 * fabs(error));
    ost_stage_destroy(&stage);
    ost_case_destroy(&c);
}

/* Two cuts of a mesh take the same answer; the second solve starts from the first's. */
static void levels_start_from_the_last_answer(void **state)
{
    OstCase *c = NULL;
    OstAdaption *adaption = adapt(
        BEAM "accuracy: {relative_error: 0.08, relative_residual: 1e-6}\nsolver: {method: metric}\n", &no_limits, &c);
    OstCase *alone = NULL;
    OstAdaption *once = NULL;
    const int most = last_of(adaption)->iterations;
    assert_int_equal(adaption->end, OST_ADAPT_MET);
    assert_true(adaption->count > 3);
    for (int l = 2; l < adaption->count; l++) {
        assert_true(adaption->level[l].error.relative < adaption->level[l - 1].error.relative);
        assert_true(adaption->level[l].tets > adaption->level[l - 1].tets);
        assert_int_equal(adaption->level[l].order, 2);
    }
    /* the same mesh, uniformly refined, from nothing */
    once = adapt("element: {order: 2}\nmesh: {block: {size: [3, 1, 1], divisions: [3, 1, 1]}, refine: 1}\n"
                 "materials: [{region: all, youngs_modulus: [1e6, 1e5, 1e5], poissons_ratio: 0.3}]\n"
                 "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                 "loads: [{on: {boundary: xmax}, traction: [0, 0, 100]}]\nlarge_rotation: off\n"
                 "accuracy: {relative_error: 0.9, relative_residual: 1e-6}\nsolver: {method: metric}\n",
                 &no_limits, &alone);
    assert_int_equal(once->count, 1);
    assert_true(most < last_of(once)->iterations);
    end(&once, &alone);
    end(&adaption, &c);
}

static void the_order_of_the_case_is_kept(void **state)
{
    OstCase *c = NULL;
    const int before = ost_warning_count(ctx);
    OstAdaption *adaption = adapt(BEAM "element: {order: 1}\naccuracy: {relative_error: 0.3}\n", &no_limits, &c);
    assert_int_equal(adaption->end, OST_ADAPT_MET);
    assert_true(adaption->count > 1);
    if (ost_rank(ctx) == 0) {
        assert_int_equal(ost_warning_count(ctx), before + 1);
        assert_non_null(strstr(ost_warning(ctx, before), "leave the order out"));
    }
    for (int l = 0; l < adaption->count; l++)
        assert_int_equal(adaption->level[l].order, 1);
    end(&adaption, &c);
}

static void limits_leave_the_best_answer_and_the_price_of_the_rest(void **state)
{
    const OstAdaptLimits limits[2] = {{INFINITY, 1e6}, {1e-9, INFINITY}};
    const OstAdaptEnd ends[2] = {OST_ADAPT_OUT_OF_MEMORY, OST_ADAPT_OUT_OF_TIME};
    for (int i = 0; i < 2; i++) {
        char words[OST_LONGEST_ADAPT_WORDS];
        OstCase *c = NULL;
        OstAdaption *adaption = adapt(BEAM "accuracy: {relative_error: 0.01}\n", &limits[i], &c);
        assert_int_equal(adaption->end, ends[i]);
        assert_true(adaption->needed_unknowns > (double)last_of(adaption)->unknowns);
        assert_true(adaption->needed_seconds > 0.0);
        assert_non_null(ost_adaption_result(adaption)->displacement);
        ost_adaption_words(adaption, words);
        assert_non_null(strstr(words, i == 0 ? "--max-memory" : "--max-time"));
        end(&adaption, &c);
    }
}

/* Cuts go on into neighbours, and quadratic tets have six times the unknowns: both must fit. By memory, as seconds
 * differ from run to run. */
static void limits_are_kept(void **state)
{
    static const double bytes[3] = {2e6, 6e6, 2e7};
    for (int i = 0; i < 3; i++) {
        const OstAdaptLimits limits = {INFINITY, bytes[i]};
        OstCase *c = NULL;
        ost_ledger_restart_peak(ctx);
        OstAdaption *adaption = adapt(BEAM "accuracy: {relative_error: 0.01}\n", &limits, &c);
        assert_int_equal(adaption->end, OST_ADAPT_OUT_OF_MEMORY);
        assert_true(ost_memory_beside * last_of(adaption)->bytes <= 1.1 * limits.bytes);
        end(&adaption, &c);
    }
}

static void what_no_memory_allows_ends_early(void **state)
{
    char words[OST_LONGEST_ADAPT_WORDS];
    OstCase *c = NULL;
    const OstAdaptLimits limits = {INFINITY, 1e9};
    OstAdaption *adaption = adapt(BEAM "accuracy: {relative_error: 1e-12, of: tip}\n"
                                       "watch: {tip: {displacement: {nearest: [3, 0, 0]}, component: z}}\n",
                                  &limits, &c);
    assert_int_equal(adaption->end, OST_ADAPT_OUT_OF_REACH);
    assert_true(last_of(adaption)->relative_error <= 0.02);
    assert_true(adaption->reach < last_of(adaption)->relative_error);
    assert_true(adaption->needed_bytes > 100.0 * limits.bytes);
    ost_adaption_words(adaption, words);
    assert_non_null(strstr(words, "out of reach"));
    end(&adaption, &c);
}

/* Equal shares, and one that is 2^14 times larger: it takes three cuts (2^7), and the others none. */
static void marks_make_shares_equal(void **state)
{
    enum { TETS = 60 };
    const OstMesh mesh = {.ctx = ctx, .owned_tets = TETS};
    double error[TETS], fall[TETS];
    unsigned char times[TETS];
    for (int t = 0; t < TETS; t++) {
        error[t] = 1.0;
        fall[t] = ost_smooth_fall(2);
    }
    if (ost_rank(ctx) == 0)
        error[7] = ldexp(1.0, 14);
    OstMarking marking = {.order = 2, .target = 1.0, .most_tets = 1e9};
    assert_success(ost_mark(&mesh, error, fall, &marking, times));
    for (int t = 0; t < TETS; t++)
        assert_int_equal(times[t], t == 7 && ost_rank(ctx) == 0 ? 3 : 0);
    assert_close(marking.expected_tets, TETS * ost_size(ctx) + 7.0, 1e-12);
    /* a level is to have three times the tets: all are cut, but not beyond the share that a tet is to have in the end
     */
    marking.target = 2.0;
    marking.least_tets = 3.0 * TETS * ost_size(ctx);
    marking.least_share = 0.3;
    assert_success(ost_mark(&mesh, error, fall, &marking, times));
    for (int t = 0; t < TETS; t++)
        assert_int_equal(times[t], t == 7 && ost_rank(ctx) == 0 ? 3 : 1);
    assert_close(marking.expected_tets, 2.0 * TETS * ost_size(ctx) + 6.0, 1e-12);
    marking.least_tets = 0.0;
    /* nothing is missing: nothing is cut */
    marking.target = 1e9;
    assert_success(ost_mark(&mesh, error, fall, &marking, times));
    for (int t = 0; t < TETS; t++)
        assert_int_equal(times[t], 0);
    assert_close(ost_found_fall(2, 1.0, 0.5, 1), 1.0, 1e-15);
    assert_close(ost_found_fall(2, 1.0, 1e-9, 1), ost_smooth_fall(2), 1e-15);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_request_is_met_and_not_by_far),
    cmocka_unit_test(only_the_last_level_finds_the_errors_of_reactions),
    cmocka_unit_test(levels_start_from_the_last_answer),
    cmocka_unit_test(the_order_of_the_case_is_kept),
    cmocka_unit_test(limits_leave_the_best_answer_and_the_price_of_the_rest),
    cmocka_unit_test(limits_are_kept),
    cmocka_unit_test(what_no_memory_allows_ends_early),
    cmocka_unit_test(marks_make_shares_equal),
    cmocka_unit_test(what_levels_gain_measures_the_estimate),
    cmocka_unit_test(two_values_tell_how_much_an_estimate_may_miss),
    cmocka_unit_test(problems_that_change_with_the_mesh_measure_nothing),
};

OST_TEST_MAIN(tests)
