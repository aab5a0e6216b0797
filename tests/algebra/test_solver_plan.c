/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "orthostat/solver.h"

static OstSolverPlan plan_of(OstMethod method, const OstSolverFacts *facts)
{
    OstSolverOptions options = ost_solver_default_options();
    OstSolverPlan plan;
    options.method = method;
    ost_solver_plan(&options, facts, &plan);
    return plan;
}

static int has_reason(const OstSolverPlan *plan, const char *text)
{
    for (int r = 0; r < plan->reasons; r++)
        if (strstr(plan->reason[r], text))
            return 1;
    return 0;
}

static void few_unknowns_are_factored(void **state)
{
    const OstSolverFacts facts = {.unknowns = 2999, .anisotropy = 1e6};
    const OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &facts);
    assert_int_equal(plan.first, OST_METHOD_DIRECT);
    assert_int_equal(plan.reasons, 1);
    assert_true(has_reason(&plan, "2999 unknowns are fewer"));
}

static void a_factorisation_that_does_not_fit_is_not_begun_with(void **state)
{
    const OstSolverFacts facts = {.unknowns = 882, .anisotropy = 1.0};
    OstSolverOptions options = ost_solver_default_options();
    OstSolverPlan plan;
    options.factor_memory = 1048576.0;
    ost_solver_plan(&options, &facts, &plan);
    assert_int_equal(plan.first, OST_METHOD_METRIC);
    assert_true(has_reason(&plan, "882 unknowns are few, but a factorisation would not fit into the 1 MiB allowed"));
    assert_true(plan.options.coarsest_unknowns < 441); /* or multigrid is a factorisation by another name */
    options.given = OST_GIVEN_COARSEST;
    ost_solver_plan(&options, &facts, &plan);
    assert_int_equal(plan.options.coarsest_unknowns, options.coarsest_unknowns);
    options.method = OST_METHOD_DIRECT;
    ost_solver_plan(&options, &facts, &plan);
    assert_int_equal(plan.first, OST_METHOD_DIRECT);
    const OstSolverFacts no_room = {.unknowns = 2999, .free_memory = 1e6};
    plan = plan_of(OST_METHOD_AUTO, &no_room);
    assert_int_equal(plan.first, OST_METHOD_METRIC);
    assert_true(has_reason(&plan, "MiB free"));
}

static void the_metric_comes_first_whatever_the_ratio(void **state)
{
    OstSolverFacts facts = {.unknowns = 74340, .anisotropy = 1e3};
    OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &facts);
    assert_int_equal(plan.first, OST_METHOD_METRIC);
    assert_true(has_reason(&plan, "factor of 1e+03 at one place"));
    facts.anisotropy = 1e6;
    plan = plan_of(OST_METHOD_AUTO, &facts);
    assert_int_equal(plan.first, OST_METHOD_METRIC);
    assert_true(has_reason(&plan, "factor of 1e+06"));
}

static void what_the_case_asks_for_is_planned(void **state)
{
    const OstSolverFacts facts = {.unknowns = 100, .anisotropy = 1e6};
    for (OstMethod method = OST_METHOD_PLAIN; method <= OST_METHOD_DIRECT; method++) {
        const OstSolverPlan plan = plan_of(method, &facts);
        assert_int_equal(plan.first, method);
        assert_string_equal(plan.reason[0], "the case asks for it");
    }
}

static void trouble_is_foretold(void **state)
{
    const OstSolverFacts easy = {.unknowns = 10000, .anisotropy = 1.0, .poisson = 0.3, .contrast = 1.0, .quality = 0.5};
    assert_int_equal(plan_of(OST_METHOD_AUTO, &easy).reasons, 1);
    const OstSolverFacts hard = {
        .unknowns = 10000, .anisotropy = 1.0, .poisson = 0.499, .contrast = 1e9, .quality = 1e-3, .free_memory = 1e9};
    const OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &hard);
    assert_true(has_reason(&plan, "ratio of 0.499 is close"));
    assert_true(has_reason(&plan, "different places differ by a factor of 1e+09"));
    assert_true(has_reason(&plan, "quality of 0.001"));
    assert_true(has_reason(&plan, "the method direct is in reach"));
    OstSolverFacts large = easy;
    large.unknowns = 1000000;
    large.free_memory = 1e9;
    const OstSolverPlan short_of_memory = plan_of(OST_METHOD_AUTO, &large);
    assert_true(has_reason(&short_of_memory, "out of reach"));
}

static void near_incompressibility_asks_for_small_aggregates_unless_the_case_says_otherwise(void **state)
{
    const OstSolverOptions usual = ost_solver_default_options();
    OstSolverFacts facts = {.unknowns = 10000, .anisotropy = 1.0, .poisson = 0.45};
    OstSolverPlan plan = plan_of(OST_METHOD_METRIC, &facts);
    assert_close(plan.options.aggregate_nodes, usual.aggregate_nodes, 0.0);
    facts.poisson = 0.49;
    plan = plan_of(OST_METHOD_METRIC, &facts);
    const double small = plan.options.aggregate_nodes;
    assert_true(small < 0.5 * usual.aggregate_nodes);
    assert_int_equal(plan.options.smoother_degree, usual.smoother_degree);
    assert_true(has_reason(&plan, "0.49 is above 0.45"));
    facts.poisson = 0.499;
    plan = plan_of(OST_METHOD_METRIC, &facts);
    assert_true(plan.options.aggregate_nodes < small);
    assert_true(plan.options.smoother_degree > usual.smoother_degree);
    OstSolverOptions pinned = usual;
    pinned.given = OST_GIVEN_AGGREGATE | OST_GIVEN_DEGREE;
    ost_solver_plan(&pinned, &facts, &plan);
    assert_close(plan.options.aggregate_nodes, usual.aggregate_nodes, 0.0);
    assert_int_equal(plan.options.smoother_degree, usual.smoother_degree);
}

static void few_quadratic_tets_off_the_axes_are_factored_and_no_others(void **state)
{
    const OstSolverFacts thin = {
        .unknowns = 12000, .anisotropy = 1e3, .poisson = 0.3, .thickness = 4.0, .misalignment = 5.0};
    const OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &thin);
    assert_int_equal(plan.first, OST_METHOD_DIRECT);
    assert_true(has_reason(&plan, "factoring takes about"));
    OstSolverFacts other = thin;
    other.misalignment = 1.0; /* linear tets help */
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    other = thin;
    other.repeated = 1;
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    other = thin;
    other.free_memory = 9e7; /* less than twice what is foreseen */
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    other = thin;
    other.thickness = 0.0; /* linear tets */
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    other = thin;
    other.unknowns = 345744;
    other.thickness = 30.0;
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
}

/* Gears, brackets, spindles and pins by scripts/bench-bodies: multigrid is quicker than factors from 50,000 unknowns
 * on; below, to 1e-8, both take as long (docs/performance.md). */
static void the_quicker_of_factors_and_multigrid_is_planned(void **state)
{
    static const struct {
        OstGlobal unknowns;
        double thickness;
        OstMethod full, early; /* OST_METHOD_AUTO: either */
    } body[] = {
        {15831, 3.98, OST_METHOD_AUTO, OST_METHOD_METRIC},    {20340, 4.77, OST_METHOD_AUTO, OST_METHOD_METRIC},
        {32838, 4.34, OST_METHOD_AUTO, OST_METHOD_METRIC},    {54999, 4.73, OST_METHOD_METRIC, OST_METHOD_METRIC},
        {98643, 5.18, OST_METHOD_METRIC, OST_METHOD_METRIC},  {223953, 6.26, OST_METHOD_METRIC, OST_METHOD_METRIC},
        {227238, 6.24, OST_METHOD_METRIC, OST_METHOD_METRIC}, {196500, 10.8, OST_METHOD_METRIC, OST_METHOD_METRIC}};
    for (size_t b = 0; b < sizeof body / sizeof *body; b++) {
        OstSolverFacts facts = {.unknowns = body[b].unknowns,
                                .anisotropy = 1e3,
                                .poisson = 0.3,
                                .thickness = body[b].thickness,
                                .misalignment = 3.0};
        if (body[b].full != OST_METHOD_AUTO)
            assert_int_equal(plan_of(OST_METHOD_AUTO, &facts).first, body[b].full);
        facts.stops_early = 1;
        assert_int_equal(plan_of(OST_METHOD_AUTO, &facts).first, body[b].early);
    }
}

/* A bracket with a ratio of 1e6: 4 to 7 times as quick as multigrid, and quicker than factors of all unknowns. */
static void vertices_are_factored_where_edges_are_far_off_the_stiff_directions(void **state)
{
    (void)state;
    OstSolverFacts facts = {.unknowns = 54999,
                            .anisotropy = 1e6,
                            .poisson = 0.3,
                            .thickness = 4.73,
                            .misalignment = 68.0,
                            .stops_early = 1};
    const OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &facts);
    assert_int_equal(plan.first, OST_METHOD_TWO_LEVEL);
    assert_true(has_reason(&plan, "over vertices whose matrix is factored"));
    facts.free_memory = 1e8;
    assert_int_equal(plan_of(OST_METHOD_AUTO, &facts).first, OST_METHOD_METRIC);
}

/* A fern: over linear tets 7 iterations, a hierarchy with more digits, 40 iterations and another strategy; over its
 * vertices 4 iterations. */
static void vertices_are_factored_where_tets_are_longer_than_the_body_is_thick(void **state)
{
    (void)state;
    const OstSolverFacts fern = {.unknowns = 482223,
                                 .anisotropy = 1.0,
                                 .poisson = 0.3,
                                 .thickness = 9.0,
                                 .misalignment = 1.0,
                                 .slenderness = 5.9,
                                 .stops_early = 1};
    const OstSolverPlan plan = plan_of(OST_METHOD_AUTO, &fern);
    assert_int_equal(plan.first, OST_METHOD_TWO_LEVEL);
    assert_true(has_reason(&plan, "5.9 times as long as the body is thick"));
    static const double others[] = {0.0, 3.0, 30.0};
    for (int k = 0; k < 3; k++) {
        OstSolverFacts other = fern;
        other.slenderness = others[k];
        assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    }
    OstSolverFacts other = fern;
    other.repeated = 1;
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
    other = fern;
    other.free_memory = 1e9;
    assert_int_equal(plan_of(OST_METHOD_AUTO, &other).first, OST_METHOD_METRIC);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(vertices_are_factored_where_tets_are_longer_than_the_body_is_thick),
    cmocka_unit_test(the_quicker_of_factors_and_multigrid_is_planned),
    cmocka_unit_test(vertices_are_factored_where_edges_are_far_off_the_stiff_directions),
    cmocka_unit_test(few_quadratic_tets_off_the_axes_are_factored_and_no_others),
    cmocka_unit_test(near_incompressibility_asks_for_small_aggregates_unless_the_case_says_otherwise),
    cmocka_unit_test(few_unknowns_are_factored),
    cmocka_unit_test(a_factorisation_that_does_not_fit_is_not_begun_with),
    cmocka_unit_test(the_metric_comes_first_whatever_the_ratio),
    cmocka_unit_test(what_the_case_asks_for_is_planned),
    cmocka_unit_test(trouble_is_foretold),
};

OST_TEST_MAIN(tests)
