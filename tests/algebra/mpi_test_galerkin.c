/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/galerkin.h"

#include "algebra/aggregation/aggregates.h"
#include "algebra/level/fetched_rows.h"
#include "algebra/multigrid/prolongator_smoothing.h"
#include "elastic_block.h"
#include "support.h"

/* A block and the coarse level made of it. */
typedef struct Coarse {
    ElasticProblem problem;
    OstScaling *scaling;
    OstDoubleMatrix *matrix;
    OstLevelMatrix *level;
    OstTentative *tentative;
    OstProlongator *prolongator;
    OstDoubleMatrix *coarse;
} Coarse;

static const ElasticBlock soft_and_stiff = {
    .bricks = {7, 6, 11}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .contrast = 100.0, .held = 1};

/* Rows of a block share their columns, which the product relies on. */
static void check_columns(const OstSmootherBlocks *blocks, const OstProlongator *p)
{
    for (OstLocal b = 0; b < blocks->count; b++) {
        const OstLocal first = blocks->node[blocks->node_start[b]];
        const OstLocal columns = p->row_start[first + 1] - p->row_start[first];
        for (OstLocal m = blocks->node_start[b]; m < blocks->node_start[b + 1]; m++) {
            const OstLocal i = blocks->node[m];
            assert_int_equal(p->row_start[i + 1] - p->row_start[i], columns);
            for (OstLocal k = 0; k < columns; k++)
                assert_int_equal(p->column[p->row_start[i] + k], p->column[p->row_start[first] + k]);
        }
    }
}

/* `given` NULL: of the scaled matrix, on aggregates of about `target` nodes. */
static void make_coarse(const ElasticBlock *block, double target, const OstAggregates *given, Coarse *c)
{
    const OstAggregateShape shape = {.target = target, .minimum = 1, .recentrings = 1};
    const OstSolverOptions options = ost_solver_default_options();
    OstMetricGraph *graph = NULL;
    OstAggregates *aggregates = NULL;
    OstSmoother *smoother = NULL;
    memset(c, 0, sizeof *c);
    assert_success(elastic_create(ctx, block, &c->problem));
    if (!given)
        assert_success(ost_scaling_create(c->problem.matrix, &c->scaling));
    assert_success(ost_double_matrix_borrow(c->problem.matrix, c->scaling, &c->matrix));
    assert_success(ost_level_matrix_create(c->matrix, &c->level));
    assert_success(ost_metric_graph_create(c->problem.matrix, &c->problem.geometry, &graph));
    if (!given)
        assert_success(ost_aggregates_create(graph, &shape, &aggregates));
    assert_success(
        ost_tentative_create(c->matrix, given ? given : aggregates, c->problem.geometry.modes, 0, &c->tentative));
    assert_success(ost_smoother_create(c->level, graph, &options, &smoother));
    assert_success(ost_tentative_smooth(c->tentative, c->matrix, smoother, &c->prolongator));
    assert_success(
        ost_galerkin_create(c->matrix, smoother->blocks, c->prolongator, c->tentative->first_coarse, &c->coarse));
    check_columns(smoother->blocks, c->prolongator);
    ost_smoother_destroy(&smoother);
    ost_aggregates_destroy(&aggregates);
    ost_metric_graph_destroy(&graph);
}

static void destroy_coarse(Coarse *c)
{
    ost_double_matrix_destroy(&c->coarse);
    ost_prolongator_destroy(&c->prolongator);
    ost_tentative_destroy(&c->tentative);
    ost_level_matrix_destroy(&c->level);
    ost_double_matrix_destroy(&c->matrix);
    ost_scaling_destroy(&c->scaling);
    elastic_destroy(&c->problem);
}

static double *vector(void)
{
    double *made = NULL;
    assert_success(ost_level_vector_create(ctx, 6, (size_t)2000, &made));
    return made;
}

/* Noise that depends on global numbers alone. */
static double *noise(OstGlobal first, OstLocal nodes, int size, double seed)
{
    double *x = vector();
    for (OstLocal i = 0; i < size * nodes; i++)
        x[i] = sin(seed * (double)(size * first + i + 1));
    return x;
}

/* y = A x in double precision. */
static void apply(const OstDoubleMatrix *a, double *x, double *y)
{
    const int size = a->size;
    assert_success(ost_halo_import(a->halo, (size_t)size * sizeof *x, x));
    for (OstLocal i = 0; i < a->rows; i++)
        for (OstLocal k = a->row_start[i]; k < a->row_start[i + 1]; k++) {
            double room[OST_BLOCK];
            const double *block = ost_double_matrix_block(a, size, i, k, room);
            for (int r = 0; r < size; r++)
                for (int c = 0; c < size; c++)
                    y[size * i + r] += block[size * r + c] * x[size * a->column[k] + c];
        }
}

static double global_dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return sum;
}

static void the_coarse_matrix_is_the_product_to_double_precision(void **state)
{
    Coarse c;
    make_coarse(&soft_and_stiff, 12.0, NULL, &c);
    const size_t n = 6 * (size_t)c.coarse->rows;
    double *x = noise(c.tentative->first_coarse, c.coarse->rows, 6, 1.7), *cx = vector();
    double *px = vector(), *apx = vector(), *expected = vector();
    assert_int_equal(c.coarse->rows, c.tentative->coarse_nodes);
    ost_prolongator_add(c.prolongator, x, px);
    apply(c.matrix, px, apx);
    ost_prolongator_restrict(c.prolongator, apx, expected);
    apply(c.coarse, x, cx);
    const double size = sqrt(global_dot(n, expected, expected));
    assert_true(size > 1.0);
    for (size_t i = 0; i < n; i++)
        assert_close(cx[i], expected[i], 1e-13 * size);
    OST_FREE(x, cx, px, apx, expected);
    destroy_coarse(&c);
}

static void the_coarse_matrix_is_symmetric_and_its_rows_are_in_order(void **state)
{
    Coarse c;
    make_coarse(&soft_and_stiff, 12.0, NULL, &c);
    const OstDoubleMatrix *a = c.coarse;
    const size_t n = 6 * (size_t)a->rows;
    double *x = noise(c.tentative->first_coarse, a->rows, 6, 1.7), *ax = vector();
    double *y = noise(c.tentative->first_coarse, a->rows, 6, 2.3), *ay = vector();
    apply(a, x, ax);
    apply(a, y, ay);
    const double xx = global_dot(n, x, ax), yy = global_dot(n, y, ay);
    assert_true(xx > 0.0 && yy > 0.0);
    assert_close(global_dot(n, x, ay), global_dot(n, y, ax), 1e-14 * sqrt(xx * yy));
    for (OstLocal i = 0; i < a->rows; i++) {
        for (OstLocal k = a->row_start[i] + 1; k < a->row_start[i + 1]; k++)
            assert_true(a->column[k] > a->column[k - 1]);
        assert_true(a->column[a->row_start[i + 1] - 1] < a->columns);
        const double *diagonal = ost_double_matrix_diagonal(a, i);
        for (int r = 0; r < 6; r++)
            for (int s = 0; s < r; s++)
                assert_close(diagonal[6 * r + s], diagonal[6 * s + r], 1e-12);
    }
    OST_FREE(x, y, ax, ay);
    destroy_coarse(&c);
}

/* A line of three nodes cannot turn about itself, and two nodes cannot either: that mode is left out, the others are
 * reproduced, and the coarse unknown nobody uses gets a harmless equation. */
static void a_mode_that_an_aggregate_cannot_show_is_left_out(void **state)
{
    const ElasticBlock line = {.bricks = {2, 1, 7}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    Coarse c;
    OstLocal of_node[48];
    const int rank = ost_rank(ctx), size = ost_size(ctx);
    const OstLocal rows = 6 * (7 * (rank + 1) / size - 7 * rank / size);
    for (OstLocal i = 0; i < rows; i++)
        of_node[i] = i / 3;
    const OstAggregates aggregates = {.ctx = ctx, .count = rows / 3, .of_node = of_node};
    make_coarse(&line, 0.0, &aggregates, &c);
    for (OstLocal a = 0; a < c.coarse->rows; a++) {
        int left_out = 0;
        for (int r = 0; r < 6; r++) {
            double row = 0.0;
            for (int m = 0; m < 6; m++)
                row += fabs(c.tentative->modes[6 * (m * c.coarse->rows + a) + r]);
            left_out += row == 0.0;
            if (row == 0.0)
                assert_close(ost_double_matrix_diagonal(c.coarse, a)[7 * r], 0.0, 0.0);
        }
        assert_int_equal(left_out, 1);
    }
    ost_double_matrix_mend_diagonal(c.coarse);
    double *ones = noise(0, c.coarse->rows, 6, 0.3), *force = vector();
    apply(c.coarse, ones, force);
    assert_true(global_dot(6 * (size_t)c.coarse->rows, ones, force) > 0.0);
    for (OstLocal i = 0; i < rows; i++)
        for (int r = 0; r < 3; r++)
            for (int m = 0; m < 6; m++) { /* T times the coarse modes are the modes */
                double sum = 0.0;
                for (int k = 0; k < 6; k++)
                    sum += (double)c.tentative->block[18 * i + 6 * r + k] *
                           c.tentative->modes[6 * (m * c.coarse->rows + of_node[i]) + k];
                assert_close(sum, c.problem.geometry.modes[m * 3 * rows + 3 * i + r], 1e-5);
            }
    OST_FREE(ones, force);
    destroy_coarse(&c);
}

/* Row i of this rank goes round: its length and its columns tell where it came from. */
static void rows_travel_to_ghosts_and_back(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &soft_and_stiff, &problem));
    OstHalo *halo = problem.matrix->halo;
    OstFetchedRows *out = NULL, *in = NULL, *back = NULL;
    const OstLocal rows = halo->send_start[halo->neighbour_count];
    assert_success(ost_fetched_rows_create(ctx, rows, sizeof(double), &out));
    for (OstLocal i = 0; i < rows; i++)
        out->start[i + 1] = out->start[i] + halo->send_index[i] % 4;
    assert_success(ost_fetched_rows_reserve(out));
    for (OstLocal i = 0; i < rows; i++)
        for (OstLocal k = out->start[i]; k < out->start[i + 1]; k++) {
            out->column[k] = (problem.matrix->first_row + halo->send_index[i]) << 8 | (k - out->start[i]);
            ((double *)(void *)out->value)[k] = 0.5 * (double)out->column[k];
        }
    assert_success(ost_fetched_rows_exchange(halo, OST_TO_GHOSTS, out, &in));
    assert_int_equal(in->rows, halo->ghosts);
    for (OstLocal k = 0; k < in->start[in->rows]; k++)
        assert_close(((double *)(void *)in->value)[k], 0.5 * (double)in->column[k], 0.0);
    assert_success(ost_fetched_rows_exchange(halo, OST_TO_OWNERS, in, &back));
    assert_int_equal(back->rows, rows);
    assert_memory_equal(back->start, out->start, ((size_t)rows + 1) * sizeof *out->start);
    assert_memory_equal(back->column, out->column, (size_t)out->start[rows] * sizeof *out->column);
    ost_fetched_rows_destroy(&out);
    ost_fetched_rows_destroy(&in);
    ost_fetched_rows_destroy(&back);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_coarse_matrix_is_the_product_to_double_precision),
    cmocka_unit_test(the_coarse_matrix_is_symmetric_and_its_rows_are_in_order),
    cmocka_unit_test(a_mode_that_an_aggregate_cannot_show_is_left_out),
    cmocka_unit_test(rows_travel_to_ghosts_and_back),
};

OST_TEST_MAIN(tests)
