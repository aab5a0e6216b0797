/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_text.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/refine.h"
#include "study/cost.h"

/* A cantilever of 4×1×1 pulled down at its end. */
static const char beam[] = "title: a cantilever\n"
                           "mesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}\n"
                           "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0}]\n"
                           "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                           "loads: [{on: {boundary: xmax}, total_force: [0, 0, -1]}]\n";
static const char watch[] = "watch:\n"
                            "  tip: {displacement: {nearest: [4, 1, 0]}, component: z}\n"
                            "  held: {reaction: {boundary: xmin}}\n"
                            "  work: strain_energy\n";

static OstCase *c;
static OstCost *cost;

static void make_study(const char *more, const OstCostVariants *variants)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s", beam, more);
    assert_success(read_text(text, &c));
    assert_success(ost_cost_create(c, variants, &cost));
}

static void drop_study(void)
{
    ost_cost_destroy(&cost);
    ost_case_destroy(&c);
}

/* Stands in for the solver: energy 2 + 4^-refinement / order; seconds by order and size. */
static OstStatus pretend(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    (void)study;
    const double finer = ldexp(1.0, run->refinement);
    assert_int_equal(variant->order, run->order);
    assert_int_equal(variant->refinement, run->refinement);
    assert_close(variant->solver.relative_residual, run->tolerance, 0.0);
    run->repeats = 1;
    run->unknowns = (OstGlobal)(finer * finer * finer);
    run->seconds = run->order * finer * finer * finer * (1.0 - 0.05 * log10(run->tolerance));
    run->bytes = 1e6 * run->seconds;
    run->watched[0] = (OstWatched){2.0 + 1.0 / (finer * finer * run->order), 2.0, .error = NAN};
    run->watched[1] = (OstWatched){1.0 + finer, 1.0 + finer, .error = NAN};
    return OST_SUCCESS;
}

static OstStatus pretend_order_two_fails(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    return run->order == 2 ? OST_RAISE(study->ctx, OST_NOT_CONVERGED, "no \"end\" in sight")
                           : pretend(study, variant, run);
}

static OstStatus pretend_all_fail(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    (void)variant;
    (void)run;
    return OST_RAISE(study->ctx, OST_NOT_CONVERGED, "never");
}

static void the_variants_are_listed_once_and_in_order(void **state)
{
    const OstCostVariants variants = {.order_count = 3,
                                      .refinement_count = 2,
                                      .tolerance_count = 2,
                                      .order = {2, 1, 2},
                                      .refinement = {1, 0},
                                      .tolerance = {1e-2, 1e-6},
                                      .max_seconds = 1.0};
    make_study("", &variants);
    assert_int_equal(cost->run_count, 8);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(cost->run[i].refinement, i / 4);
        assert_int_equal(cost->run[i].order, 1 + i / 2 % 2);
        assert_close(cost->run[i].tolerance, i % 2 ? 1e-2 : 1e-6, 0.0);
    }
    assert_int_equal(cost->quantity_count, 2);
    assert_string_equal(cost->quantity[0].name, "energy");
    assert_string_equal(cost->quantity[1].name, "largest |u|");
    drop_study();
}

/* Large rotations: other formulations than the case's and load steps, on the coarsest mesh at the tightest tolerance.
 */
static const OstCostVariants large = {
    .order_count = 1,
    .refinement_count = 2,
    .tolerance_count = 2,
    .formulation_count = 3,
    .load_step_count = 2,
    .order = {2},
    .refinement = {1, 0},
    .tolerance = {1e-2, 1e-6},
    .formulation = {OST_FORMULATION_LINEAR, OST_FORMULATION_CONSISTENT, OST_FORMULATION_CLASSICAL},
    .load_steps = {16, 4},
    .max_seconds = 1e6};

static OstStatus pretend_to_turn(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    run->newton = (OstNewtonReport){.used = variant->large_rotation != OST_LARGE_ROTATION_OFF};
    if (run->other && run->formulation == OST_FORMULATION_LINEAR)
        assert_int_equal(variant->large_rotation, OST_LARGE_ROTATION_OFF);
    else
        assert_int_equal(variant->formulation, run->other ? run->formulation : OST_FORMULATION_CONSISTENT);
    assert_int_equal(variant->solver.load_steps, run->load_steps);
    return pretend(study, variant, run);
}

static void large_rotations_have_rungs_of_their_own(void **state)
{
    char more[64];
    make_study("", &large);
    cost->measure = pretend_to_turn;
    assert_success(ost_cost_run(cost));
    assert_int_equal(cost->run_count, 8);
    static const char *const expected[] = {"linear theory", "classical formulation", "at least 4 load steps",
                                           "at least 16 load steps"};
    for (int i = 0; i < 8; i++) {
        const OstCostRun *run = &cost->run[i];
        ost_cost_describe(run, more, sizeof more);
        assert_string_equal(more, i < 4 ? "" : expected[i - 4]);
        assert_int_equal(run->state, OST_COST_DONE);
        assert_true(i < 4 || (run->refinement == 0 && run->tolerance == 1e-6));
    }
    drop_study();
}

/* Nor where no rotation was found to be large. */
static void small_rotations_have_no_such_rungs(void **state)
{
    make_study("", &large);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    assert_int_equal(cost->run_count, 4);
    drop_study();
    make_study("large_rotation: off\n", &large);
    assert_int_equal(cost->run_count, 4);
    drop_study();
}

static void values_out_of_range_are_refused(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    assert_success(read_text(beam, &c));
    variants.order[1] = 3;
    assert_failure(ost_cost_create(c, &variants, &cost), OST_INVALID_INPUT, "order 1 or 2, not 3");
    variants = ost_cost_default_variants();
    variants.refinement[0] = 9;
    assert_failure(ost_cost_create(c, &variants, &cost), OST_INVALID_INPUT, "0 to 8 times, not 9");
    variants = ost_cost_default_variants();
    variants.tolerance[2] = 1.0;
    assert_failure(ost_cost_create(c, &variants, &cost), OST_INVALID_INPUT, "below 1, not 1");
    variants = large;
    variants.load_steps[1] = 0;
    assert_failure(ost_cost_create(c, &variants, &cost), OST_INVALID_INPUT, "load steps are 1 to 1000, not 0");
    assert_null(cost);
    ost_case_destroy(&c);
}

static void time_bounds_what_runs(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.max_seconds = 50.0;
    make_study("", &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        /* 1e-8 takes 1.4 × order × 8^refinement: 89.6 s are foreseen of order 1, 179.2 of order 2 */
        assert_int_equal(run->state, run->refinement == 2 ? OST_COST_NOT_RUN : OST_COST_DONE);
        if (run->refinement == 2 && run->tolerance == 1e-8)
            assert_string_equal(run->reason, run->order == 1 ? "about 90 s" : "about 3 min");
    }
    drop_study();
}

static void memory_bounds_what_runs(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.order_count = 1;
    variants.max_bytes = 1e8;
    make_study("", &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    assert_int_equal(cost->run[5].state, OST_COST_DONE);
    assert_int_equal(cost->run[6].state, OST_COST_NOT_RUN);
    assert_non_null(strstr(cost->run[6].reason, "GiB of memory"));
    drop_study();
}

static void errors_are_against_the_extrapolated_answer(void **state)
{
    const OstCostVariants variants = ost_cost_default_variants();
    make_study("", &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    const OstCostReference *energy = &cost->quantity[0].reference;
    assert_int_equal(energy->kind, OST_REFERENCE_EXTRAPOLATED);
    assert_int_equal(energy->order, 2);
    assert_close(energy->value, 2.0, 1e-10);
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        assert_close(run->error[0], 0.5 * pow(0.25, run->refinement) / run->order, 1e-10);
        assert_true(ost_cost_claim(cost, run, 0) >= energy->uncertainty);
    }
    /* 6.2 % at the least of what can be claimed for 10 %: order 2 refined once, solved loosely */
    const OstCostRun *cheapest = &cost->run[ost_cost_cheapest(cost, 0, 0.1)];
    assert_int_equal(cheapest->order, 2);
    assert_int_equal(cheapest->refinement, 1);
    assert_close(cheapest->tolerance, 1e-2, 0.0);
    assert_int_equal(ost_cost_cheapest(cost, 0, 0.01), -1);
    drop_study();
}

static void errors_are_against_the_formula_where_there_is_one(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.refinement_count = 2;
    make_study("watch: {work: {strain_energy: all, expected: 1.6}, tip: {displacement: {nearest: [4, 0, 0]}}}\n",
               &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    assert_int_equal(cost->quantity_count, 2);
    const OstCostReference *work = &cost->quantity[0].reference;
    assert_int_equal(work->kind, OST_REFERENCE_FORMULA);
    assert_close(work->value, 1.6, 0.0);
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        const double error = (2.0 + pow(0.25, run->refinement) / run->order - 1.6) / 1.6;
        assert_int_equal(run->state, OST_COST_DONE);
        assert_close(run->error[0], error, 1e-14);
        assert_close(ost_cost_claim(cost, run, 0), error, 1e-14); /* the finest too, and nothing is in doubt */
    }
    assert_int_equal(cost->quantity[1].reference.kind, OST_REFERENCE_FINEST);
    drop_study();
}

static void a_lone_answer_of_order_two_is_measured_by_order_one(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.refinement_count = 1;
    make_study("", &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    const OstCostReference *energy = &cost->quantity[0].reference;
    assert_int_equal(energy->kind, OST_REFERENCE_FINEST);
    assert_int_equal(energy->order, 2);
    assert_close(energy->uncertainty, (3.0 - 2.5) / 2.5, 1e-14);
    assert_close(cost->run[0].error[0], (3.0 - 2.5) / 2.5, 1e-14);
    assert_true(isnan(cost->run[3].error[0]));
    drop_study();
}

/* Order 1 on its way past the answer, 2; order 2 tends to it as 4^-refinement. */
static OstStatus pretend_a_crossing(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    static const double crossing[] = {1.0, 1.6, 2.001};
    const OstStatus status = pretend(study, variant, run);
    if (run->order == 1)
        run->watched[0].value = crossing[run->refinement];
    return status;
}

/* Adaptive runs choose how far they solve, whatever the case says: 12 s for as much as order 2 refined once has. */
static OstStatus pretend_requests(OstCost *study, const OstCase *variant, OstCostRun *run)
{
    if (run->accuracy == 0.0)
        return pretend(study, variant, run);
    assert_int_equal(variant->asks_error, 1);
    assert_close(variant->relative_error, run->accuracy, 0.0);
    assert_close(variant->solver.algebraic_fraction, 0.1, 0.0);
    run->order = 2;
    run->seconds = 12.0;
    run->watched[0] = (OstWatched){2.0 + 0.125, 2.0, .error = -0.14};
    return OST_SUCCESS;
}

static void a_request_is_measured_by_settings_that_meet_it(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.accuracy_count = 2;
    variants.accuracy[0] = 0.3;
    variants.accuracy[1] = 0.1;
    make_study("accuracy: {relative_residual: 1e-10}\n", &variants);
    cost->measure = pretend_requests;
    assert_success(ost_cost_run(cost));
    const OstCostRun *asked = &cost->run[cost->run_count - 2];
    assert_close(asked->accuracy, 0.3, 0.0);
    assert_close(asked->true_norm, 0.25, 1e-10);
    /* energies 2 + 4^-refinement / order: the norm is off by 0.5 / sqrt(order) / 2^refinement times the root of 2 */
    const OstCostRun *by_hand = &cost->run[ost_cost_by_hand(cost, asked)];
    assert_int_equal(by_hand->order, 2);
    assert_int_equal(by_hand->refinement, 1);
    assert_close(by_hand->tolerance, 1e-2, 0.0);
    assert_int_equal(ost_cost_by_hand(cost, asked + 1), -1);
    assert_close(ost_cost_claim(cost, asked, 0), 0.07, 1e-10); /* nearer by accident */
    drop_study();
}

/* Of 100 s, 89.6 would be enough for order 1 refined twice. */
static void requests_have_half_of_the_time(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.accuracy_count = 2;
    variants.accuracy[0] = 0.3;
    variants.accuracy[1] = 0.1;
    variants.max_seconds = 100.0;
    make_study("", &variants);
    cost->measure = pretend_requests;
    assert_success(ost_cost_run(cost));
    for (int i = 0; i < cost->run_count; i++)
        assert_int_equal(cost->run[i].state, cost->run[i].accuracy == 0.0 && cost->run[i].refinement == 2
                                                 ? OST_COST_NOT_RUN
                                                 : OST_COST_DONE);
    const OstCostRun *asked = &cost->run[cost->run_count - 2]; /* pretended runs take next to no time */
    assert_true(asked[0].seconds_left <= 50.0 && asked[1].seconds_left > 50.0 && asked[1].seconds_left <= 100.0);
    drop_study();
}

static void near_by_accident_is_not_exact(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.tolerance_count = 1;
    variants.tolerance[0] = 1e-8;
    make_study("", &variants);
    cost->measure = pretend_a_crossing;
    assert_success(ost_cost_run(cost));
    const OstCostRun *run = &cost->run[4];
    assert_int_equal(run->order, 1);
    assert_int_equal(run->refinement, 2);
    assert_int_equal(cost->quantity[0].reference.order, 2);
    assert_close(run->error[0], 0.0005, 1e-9);
    assert_close(ost_cost_claim(cost, run, 0), (2.001 - 1.6) / (pow(2.0, 2.5) - 1.0) / 2.0, 1e-9);
    drop_study();
}

static void what_diverges_has_no_price(void **state)
{
    const OstCostVariants variants = ost_cost_default_variants();
    make_study("", &variants);
    cost->measure = pretend;
    assert_success(ost_cost_run(cost));
    assert_true(isinf(cost->quantity[1].reference.uncertainty));
    assert_int_equal(ost_cost_cheapest(cost, 1, 10.0), -1);
    int runs[OST_COST_MOST_RUNS];
    assert_int_equal(ost_cost_frontier(cost, 1, runs), 0);
    drop_study();
}

static void a_run_that_fails_is_listed_with_its_reason(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.max_seconds = 1e6;
    make_study("", &variants);
    cost->measure = pretend_order_two_fails;
    assert_success(ost_cost_run(cost));
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        assert_int_equal(run->state, run->order == 2 ? OST_COST_FAILED : OST_COST_DONE);
        assert_string_equal(run->reason, run->order == 2 ? "no \"end\" in sight" : "");
        assert_true(run->order == 2 ? isnan(run->error[0]) : run->error[0] > 0.0);
    }
    assert_int_equal(cost->quantity[0].reference.order, 1);
    drop_study();
    make_study("", &variants);
    cost->measure = pretend_all_fail;
    assert_failure(ost_cost_run(cost), OST_NOT_CONVERGED, "never");
    drop_study();
}

static void the_frontier_is_what_nothing_beats(void **state)
{
    OstCostVariants variants = ost_cost_default_variants();
    variants.tolerance_count = OST_COST_MOST_VALUES;
    for (int t = 0; t < OST_COST_MOST_VALUES; t++)
        variants.tolerance[t] = 1e-3 / (t + 1);
    make_study("", &variants);
    unsigned random = 1;
    for (int i = 0; i < cost->run_count; i++) {
        OstCostRun *run = &cost->run[i];
        run->state = i % 7 ? OST_COST_DONE : OST_COST_FAILED;
        run->seconds = 1.0 + (double)((random = random * 1664525u + 1013904223u) >> 26);
        run->error[0] = 1.0 + (double)((random = random * 1664525u + 1013904223u) >> 26);
    }
    int runs[OST_COST_MOST_RUNS];
    const int count = ost_cost_frontier(cost, 0, runs);
    assert_in_range(count, 2, cost->run_count);
    for (int k = 1; k < count; k++) {
        assert_true(cost->run[runs[k]].seconds > cost->run[runs[k - 1]].seconds);
        assert_true(cost->run[runs[k]].error[0] < cost->run[runs[k - 1]].error[0]);
    }
    for (int i = 0; i < cost->run_count; i++) {
        int beaten = cost->run[i].state != OST_COST_DONE;
        for (int k = 0; k < count; k++)
            beaten |= cost->run[runs[k]].seconds <= cost->run[i].seconds &&
                      cost->run[runs[k]].error[0] <= cost->run[i].error[0];
        assert_true(beaten);
    }
    drop_study();
}

/* The error in the tip of the run that was solved best. */
static double tip_error(int order, int refinement)
{
    for (int i = 0; i < cost->run_count; i++)
        if (cost->run[i].order == order && cost->run[i].refinement == refinement)
            return cost->run[i].error[0];
    return NAN;
}

static void a_cantilever_has_its_price_list(void **state)
{
    const OstCostVariants variants = ost_cost_default_variants();
    make_study(watch, &variants);
    const size_t before = ost_ledger_bytes(ctx);
    assert_success(ost_cost_run(cost));
    assert_int_equal(ost_ledger_bytes(ctx), before);
    enum { TIP, HELD, WORK };
    assert_int_equal(cost->quantity_count, 3);
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->state != OST_COST_DONE)
            fail_msg("order %d, refinement %d: %s", run->order, run->refinement, run->reason);
        double phases = 0.0;
        for (int p = 0; p < OST_STAGES; p++)
            phases += run->phase[p];
        assert_true(run->phase[OST_STAGE_MESH] > 0.0 && run->phase[OST_STAGE_SETUP] > 0.0);
        assert_true(run->seconds > 0.0 && phases > 0.99 * run->seconds - 1e-4);
        assert_true(run->bytes > 72.0 * (double)run->unknowns && run->residual <= run->tolerance);
        assert_close(run->watched[HELD].value, 1.0, 1e-3);
        if (run->order == 2) /* the corner moves as the end does; coarse linear tets are not even symmetric */
            assert_close(run->watched[WORK].value, -0.5 * run->watched[TIP].value, 0.01 * run->watched[WORK].value);
    }
    for (int refinement = 0; refinement < 3; refinement++) {
        assert_true(tip_error(2, refinement) < 0.2 * tip_error(1, refinement));
        for (int order = 1; order <= 2 && refinement > 0; order++)
            assert_true(tip_error(order, refinement) < 0.7 * tip_error(order, refinement - 1));
    }
    /* Timoshenko's beam, F L³ / 3 E I + F L / κ G A; without a Poisson's ratio the wall changes little of it. */
    const double timoshenko = 64.0 / (3.0 * 1000.0 / 12.0) + 4.0 / (5.0 / 6.0 * 500.0);
    assert_close(cost->quantity[TIP].reference.value, -timoshenko, 2e-3 * timoshenko);
    drop_study();
}

static void a_place_is_a_vertex_and_stays_there(void **state)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *linear = NULL, *quadratic = NULL;
    const OstBlockShape shape = {.size = {2, 1, 1}, .divisions = {2, 1, 1}};
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &linear));
    assert_success(ost_mesh_raise(linear, NULL, &quadratic));
    /* the mid-edge node at (1.5, 0, 0) is nearer than any vertex, and (1, 0, 0) nearer than (2, 0, 0) */
    OstWatch place = {.kind = OST_WATCH_DISPLACEMENT, .name = "p", .on = {.point = {1.45, 0.0, 0.0}}};
    const OstLogLevel level = ost_log_level(ctx);
    ost_log_set_level(ctx, OST_LOG_QUIET);
    assert_success(ost_watch_place(quadratic, &place));
    assert_close(place.on.point[0], 1.0, 0.0);
    /* as near to (0, 0, 0) as to (1, 0, 0): the lowest label wins, on any number of ranks */
    place.on.point[0] = 0.5;
    assert_success(ost_watch_place(linear, &place));
    assert_close(place.on.point[0], 0.0, 0.0);
    ost_log_set_level(ctx, level);
    ost_mesh_destroy(&linear);
    ost_mesh_destroy(&quadratic);
}

static void the_ledgers_peak_can_start_again(void **state)
{
    char *block = NULL;
    assert_success(OST_NEW(ctx, &block, 100000));
    OST_FREE(block);
    assert_true(ost_ledger_peak_bytes(ctx) >= 100000);
    ost_ledger_restart_peak(ctx);
    assert_int_equal(ost_ledger_peak_bytes(ctx), ost_ledger_bytes(ctx));
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_OTHER).peak_bytes, ost_ledger_entry(ctx, OST_LEDGER_OTHER).bytes);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_variants_are_listed_once_and_in_order),
    cmocka_unit_test(large_rotations_have_rungs_of_their_own),
    cmocka_unit_test(small_rotations_have_no_such_rungs),
    cmocka_unit_test(values_out_of_range_are_refused),
    cmocka_unit_test(time_bounds_what_runs),
    cmocka_unit_test(memory_bounds_what_runs),
    cmocka_unit_test(errors_are_against_the_extrapolated_answer),
    cmocka_unit_test(errors_are_against_the_formula_where_there_is_one),
    cmocka_unit_test(a_lone_answer_of_order_two_is_measured_by_order_one),
    cmocka_unit_test(a_request_is_measured_by_settings_that_meet_it),
    cmocka_unit_test(requests_have_half_of_the_time),
    cmocka_unit_test(near_by_accident_is_not_exact),
    cmocka_unit_test(what_diverges_has_no_price),
    cmocka_unit_test(a_run_that_fails_is_listed_with_its_reason),
    cmocka_unit_test(the_frontier_is_what_nothing_beats),
    cmocka_unit_test(a_cantilever_has_its_price_list),
    cmocka_unit_test(a_place_is_a_vertex_and_stays_there),
    cmocka_unit_test(the_ledgers_peak_can_start_again),
};

OST_TEST_MAIN(tests)
