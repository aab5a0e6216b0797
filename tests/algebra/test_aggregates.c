/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/aggregates.h"
#include "algebra/aggregation/alignment.h"
#include "elastic_block.h"
#include "support.h"

static const ElasticBlock cube = {.bricks = {17, 17, 17}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3};

/* The cube's graph in the metric diag(w). */
static OstMetricGraph *cube_graph(const double w[3])
{
    ElasticProblem problem;
    double *metric = NULL;
    OstMetricGraph *graph = NULL;
    assert_success(elastic_create(ctx, &cube, &problem));
    assert_success(OST_NEW(ctx, &metric, 6 * (size_t)problem.matrix->rows));
    for (OstLocal i = 0; i < problem.matrix->rows; i++)
        for (int c = 0; c < 3; c++)
            metric[6 * i + c] = w[c];
    problem.geometry.metric = metric;
    assert_success(ost_metric_graph_create(problem.matrix, &problem.geometry, &graph));
    OST_FREE(metric);
    elastic_destroy(&problem);
    return graph;
}

/* Mean over aggregates of the variance of their nodes' positions along each axis. */
static void mean_variance(const OstMetricGraph *graph, const OstAggregates *aggregates, double variance[3])
{
    double *sums = NULL; /* of 1, x, x² */
    assert_success(OST_NEW(ctx, &sums, 7 * (size_t)aggregates->count));
    for (OstLocal i = 0; i < graph->nodes; i++) {
        double *s = sums + 7 * aggregates->of_node[i];
        s[0] += 1.0;
        for (int c = 0; c < 3; c++) {
            const double x = graph->position[3 * i + c];
            s[1 + c] += x;
            s[4 + c] += x * x;
        }
    }
    for (int c = 0; c < 3; c++) {
        variance[c] = 0.0;
        for (OstLocal a = 0; a < aggregates->count; a++) {
            const double *s = sums + 7 * a;
            variance[c] += (s[4 + c] - s[1 + c] * s[1 + c] / s[0]) / s[0] / aggregates->count;
        }
    }
    OST_FREE(sums);
}

static double misalignment(const double w[6])
{
    OstMetricGraph *graph = cube_graph((double[3]){1.0, 1.0, 1.0});
    double mean;
    for (OstLocal i = 0; i < graph->nodes; i++)
        memcpy(graph->metric + 6 * (size_t)i, w, 6 * sizeof *w);
    assert_success(ost_metric_graph_misalignment(graph, &mean));
    ost_metric_graph_destroy(&graph);
    return mean;
}

/* The bricks' edges lie along x, y, z and their diagonals; 0.03 is the metric at a ratio of moduli of 1000. A metric of
 * 1 + (s - 1) e eᵀ is s along e, and 1 across. */
static void edges_off_the_stiff_directions_are_noticed(void **state)
{
    const double stiff = 0.03, c = cos(0.4), s = sin(0.4), drop = stiff - 1.0;
    assert_close(misalignment((double[6]){1, 1, 1, 0, 0, 0}), 1.0, 1e-12);
    assert_close(misalignment((double[6]){stiff, 1, 1, 0, 0, 0}), 1.0, 1e-12);
    assert_close(misalignment((double[6]){stiff, stiff, 1, 0, 0, 0}), 1.0, 0.2);
    /* 0.4 from x and 0.385 from the diagonal of x and y, which is the nearest edge of the inner nodes. */
    const double nearest = (1.0 + drop * pow(cos(M_PI / 4 - 0.4), 2)) / stiff;
    assert_close(misalignment((double[6]){1.0 + drop * c * c, 1.0 + drop * s * s, 1, drop * c * s, 0, 0}), nearest,
                 0.3);
    assert_true(nearest > 4.0);
}

/* A metric that shortens z a hundredfold makes a plate of the cube. */
static void flat_bricks_at_the_surface_are_noticed(void **state)
{
    double flatness[3];
    const double squares[3] = {1.0, 1e-2, 1e-4};
    for (int k = 0; k < 3; k++) {
        OstMetricGraph *graph = cube_graph((double[3]){1.0, 1.0, squares[k]});
        assert_success(ost_metric_graph_flatness(graph, &flatness[k]));
        ost_metric_graph_destroy(&graph);
    }
    assert_true(flatness[0] >= 1.0 && flatness[0] < 3.0);
    assert_close(flatness[2] / flatness[1], 10.0, 1.0);
    assert_true(flatness[1] > 5.0);
}

/* The same: seventeen bricks lie through it, and a diagonal of one is as long as a twelfth of the plate. */
static void the_length_of_bricks_over_the_thickness_of_the_body_is_measured(void **state)
{
    double length[3];
    const double squares[3] = {1.0, 1e-2, 1e-4};
    for (int k = 0; k < 3; k++) {
        OstMetricGraph *graph = cube_graph((double[3]){1.0, 1.0, squares[k]});
        assert_success(ost_metric_graph_slenderness(graph, &length[k]));
        ost_metric_graph_destroy(&graph);
    }
    assert_true(length[0] < 0.2);
    assert_close(length[2] / length[1], 10.0, 1.0);
    assert_true(length[2] > 0.8 * 100.0 / 12.0 && length[2] < 1.2 * 100.0 / 12.0);
}

/* Every second layer of bricks is a thousandth as thick as the others: the two nodes above each other stay together, in
 * aggregates and in blocks. */
static void the_two_sides_of_a_flat_layer_stay_together(void **state)
{
    const double targets[] = {7.0, 40.0};
    const OstLocal plane = 18 * 18;
    ElasticProblem problem;
    OstMetricGraph *graph = NULL;
    assert_success(elastic_create(ctx, &cube, &problem));
    for (OstLocal i = 0; i < problem.matrix->rows; i++) {
        const OstLocal layer = i / plane;
        problem.coordinates[3 * i + 2] = 1e-3 * (layer / 2 + layer % 2) + 1.999 * (layer / 2);
    }
    assert_success(ost_metric_graph_create(problem.matrix, &problem.geometry, &graph));
    for (int t = 0; t < 2; t++) {
        const OstAggregateShape shape = {.target = targets[t], .minimum = 1, .recentrings = 2};
        OstAggregates *aggregates = NULL;
        assert_success(ost_aggregates_create(graph, &shape, &aggregates));
        for (OstLocal i = 0; i < graph->nodes; i++)
            if (i / plane % 2 == 0)
                assert_int_equal(aggregates->of_node[i], aggregates->of_node[i + plane]);
        assert_in_range(aggregates->count, graph->nodes / (1.5 * targets[t]), graph->nodes / (0.6 * targets[t]));
        ost_aggregates_destroy(&aggregates);
    }
    ost_metric_graph_destroy(&graph);
    elastic_destroy(&problem);
}

static void every_node_is_in_one_aggregate_and_sizes_meet_the_target(void **state)
{
    const double targets[] = {7.0, 40.0};
    OstMetricGraph *graph = cube_graph((double[3]){1.0, 1.0, 1.0});
    for (int t = 0; t < 2; t++) {
        const OstAggregateShape shape = {.target = targets[t], .minimum = 3, .recentrings = 2};
        OstAggregates *aggregates = NULL;
        OstLocal *size = NULL;
        assert_success(ost_aggregates_create(graph, &shape, &aggregates));
        assert_success(OST_NEW(ctx, &size, aggregates->count));
        for (OstLocal i = 0; i < graph->nodes; i++) {
            assert_in_range(aggregates->of_node[i], 0, aggregates->count - 1);
            size[aggregates->of_node[i]]++;
        }
        for (OstLocal a = 0; a < aggregates->count; a++)
            assert_in_range(size[a], 3, 4 * targets[t]);
        const double mean = (double)graph->nodes / aggregates->count;
        assert_true(mean > 0.65 * targets[t] && mean < 1.5 * targets[t]);
        OST_FREE(size);
        ost_aggregates_destroy(&aggregates);
    }
    ost_metric_graph_destroy(&graph);
}

static void aggregates_are_round_in_the_metric_and_long_along_the_stiff_axis(void **state)
{
    /* √(E_min/E_x) with E_x 64 times as stiff: 1/8; the metric's unit ball is √8 long along x */
    const double w[3] = {0.125, 1.0, 1.0};
    const OstAggregateShape shape = {.target = 40.0, .minimum = 3, .recentrings = 2};
    OstMetricGraph *graph = cube_graph(w);
    OstAggregates *aggregates = NULL;
    assert_success(ost_aggregates_create(graph, &shape, &aggregates));
    double variance[3];
    mean_variance(graph, aggregates, variance);
    const double along = variance[0];
    const double across = 0.5 * (variance[1] + variance[2]);
    assert_true(along / across > 4.0); /* 8 for an ellipsoid; a ball would have 1 */
    assert_true(w[0] * along / across > 0.5 && w[0] * along / across < 2.0);
    ost_aggregates_destroy(&aggregates);
    ost_metric_graph_destroy(&graph);
}

/* Three paths of nodes a unit apart: `length[0]` + `length[1]` + `length[2]` nodes. */
static OstMetricGraph *paths_graph(const OstLocal length[3])
{
    const OstLocal n = length[0] + length[1] + length[2];
    OstMetricGraph *graph = NULL;
    assert_success(OST_NEW(ctx, &graph, 1));
    graph->ctx = ctx;
    graph->nodes = n;
    assert_success(OST_NEW(ctx, &graph->edge_start, n + 1));
    assert_success(OST_NEW(ctx, &graph->neighbour, 2 * n));
    assert_success(OST_NEW(ctx, &graph->length, 2 * n));
    assert_success(OST_NEW(ctx, &graph->position, 3 * n));
    assert_success(OST_NEW(ctx, &graph->metric, 6 * n));
    OstLocal edges = 0, node = 0;
    for (int p = 0; p < 3; p++)
        for (OstLocal k = 0; k < length[p]; k++, node++) {
            for (OstLocal step = -1; step <= 1; step += 2)
                if (k + step >= 0 && k + step < length[p]) {
                    graph->length[edges] = 1.0f;
                    graph->neighbour[edges++] = node + step;
                }
            graph->edge_start[node + 1] = edges;
            graph->position[3 * node] = k;
            graph->position[3 * node + 1] = 100.0 * p;
            for (int c = 0; c < 3; c++)
                graph->metric[6 * node + c] = 1.0;
        }
    return graph;
}

static void parts_too_small_for_the_modes_are_left_to_the_smoother(void **state)
{
    OstMetricGraph *graph = paths_graph((OstLocal[3]){2, 30, 1});
    const OstAggregateShape shape = {.target = 5.0, .minimum = 3, .recentrings = 2};
    OstAggregates *aggregates = NULL;
    assert_success(ost_aggregates_create(graph, &shape, &aggregates));
    assert_in_range(aggregates->count, 3, 9);
    for (OstLocal i = 0; i < 33; i++) {
        if (i < 2 || i == 32)
            assert_int_equal(aggregates->of_node[i], -1);
        else
            assert_in_range(aggregates->of_node[i], 0, aggregates->count - 1);
    }
    ost_aggregates_destroy(&aggregates);
    ost_metric_graph_destroy(&graph);
}

static int is_third(OstLocal node)
{
    return node % 18 % 3 == 0 && node / 18 % 18 % 3 == 0 && node / (18 * 18) % 3 == 0;
}

/* Every third brick's first node of the cube has no edges left, as the nodes within small soft fields. */
static void small_parts_do_not_change_the_size_of_the_other_aggregates(void **state)
{
    const OstAggregateShape shape = {.target = 40.0, .minimum = 3, .recentrings = 2};
    OstMetricGraph *graph = cube_graph((double[3]){1.0, 1.0, 1.0});
    OstAggregates *aggregates = NULL;
    OstLocal alone = 0;
    graph->jump = 1e9;
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++)
            if (is_third(i) || is_third(graph->neighbour[k]))
                graph->length[k] = INFINITY;
    assert_success(ost_aggregates_create(graph, &shape, &aggregates));
    for (OstLocal i = 0; i < graph->nodes; i++) {
        assert_int_equal(aggregates->of_node[i] == -1, is_third(i));
        alone += is_third(i);
    }
    assert_int_equal(alone, 6 * 6 * 6); /* more than there are aggregates */
    const double mean = (double)(graph->nodes - alone) / aggregates->count;
    assert_true(mean > 0.65 * shape.target && mean < 1.5 * shape.target);
    ost_aggregates_destroy(&aggregates);
    ost_metric_graph_destroy(&graph);
}

static void every_part_has_its_own_aggregates(void **state)
{
    OstMetricGraph *graph = paths_graph((OstLocal[3]){3, 4, 1});
    const OstAggregateShape shape = {.target = 40.0, .minimum = 1, .recentrings = 1};
    OstAggregates *aggregates = NULL;
    assert_success(ost_aggregates_create(graph, &shape, &aggregates));
    assert_int_equal(aggregates->count, 3);
    for (OstLocal i = 0; i < 8; i++)
        assert_int_equal(aggregates->of_node[i], aggregates->of_node[i < 3 ? 0 : i < 7 ? 3 : 7]);
    ost_aggregates_destroy(&aggregates);
    ost_metric_graph_destroy(&graph);
}

static void the_coarse_graph_joins_aggregates_that_touch(void **state)
{
    OstMetricGraph *graph = paths_graph((OstLocal[3]){6, 2, 1});
    OstMetricGraph *coarse = NULL;
    OstLocal of_node[9] = {0, 0, 1, 1, 1, 2, 3, 3, -1};
    const OstAggregates aggregates = {.ctx = ctx, .count = 4, .of_node = of_node};
    assert_success(ost_metric_graph_coarsen(graph, &aggregates, &coarse));
    assert_int_equal(coarse->nodes, 4);
    const OstLocal edges[5] = {0, 1, 3, 4, 4}; /* 0 - 1 - 2, and 3 alone */
    assert_memory_equal(coarse->edge_start, edges, sizeof edges);
    assert_int_equal(coarse->neighbour[0], 1);
    assert_int_equal(coarse->neighbour[3], 1);
    const double centres[4] = {0.5, 3.0, 5.0, 0.5};
    for (int a = 0; a < 4; a++) {
        assert_close(coarse->position[3 * a], centres[a], 1e-15);
        assert_close(coarse->metric[6 * a], 1.0, 1e-15);
    }
    assert_close(coarse->length[0], 2.5, 1e-6);
    ost_metric_graph_destroy(&coarse);
    ost_metric_graph_destroy(&graph);
}

static void a_metric_that_measures_nothing_is_refused(void **state)
{
    const ElasticBlock brick = {.bricks = {1, 1, 1}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3};
    const double wrong[3][6] = {{1, 1, 0, 0, 0, 0}, {1, 1, 1, 2, 0, 0}, {1, 1, NAN, 0, 0, 0}};
    ElasticProblem problem;
    OstMetricGraph *graph = NULL;
    assert_success(elastic_create(ctx, &brick, &problem));
    for (int k = 0; k < 3; k++) {
        double metric[8][6];
        for (int i = 0; i < 8; i++)
            for (int c = 0; c < 6; c++)
                metric[i][c] = c < 3 ? 1.0 : 0.0;
        for (int c = 0; c < 6; c++)
            metric[5][c] = wrong[k][c];
        problem.geometry.metric = &metric[0][0];
        assert_failure(ost_metric_graph_create(problem.matrix, &problem.geometry, &graph), OST_INVALID_INPUT,
                       "metric at node 5");
        assert_null(graph);
    }
    problem.geometry.metric = NULL;
    problem.coordinates[3 * 6] = INFINITY;
    assert_failure(ost_metric_graph_create(problem.matrix, &problem.geometry, &graph), OST_INVALID_INPUT,
                   "node 6 lies at (inf, ");
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(edges_off_the_stiff_directions_are_noticed),
    cmocka_unit_test(flat_bricks_at_the_surface_are_noticed),
    cmocka_unit_test(the_length_of_bricks_over_the_thickness_of_the_body_is_measured),
    cmocka_unit_test(the_two_sides_of_a_flat_layer_stay_together),
    cmocka_unit_test(every_node_is_in_one_aggregate_and_sizes_meet_the_target),
    cmocka_unit_test(aggregates_are_round_in_the_metric_and_long_along_the_stiff_axis),
    cmocka_unit_test(parts_too_small_for_the_modes_are_left_to_the_smoother),
    cmocka_unit_test(small_parts_do_not_change_the_size_of_the_other_aggregates),
    cmocka_unit_test(every_part_has_its_own_aggregates),
    cmocka_unit_test(the_coarse_graph_joins_aggregates_that_touch),
    cmocka_unit_test(a_metric_that_measures_nothing_is_refused),
};

OST_TEST_MAIN(tests)
