/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/scaling.h"
#include "algebra/multigrid/coarsest.h"
#include "algebra/multigrid/cycle.h"
#include "algebra/multigrid/gathered_level.h"
#include "elastic_block.h"
#include "support.h"

/* A block, scaled, and the levels made of it. */
typedef struct Setup {
    ElasticProblem problem;
    OstScaling *scaling;
    double *modes; /* in scaled unknowns */
    OstSolverOptions options;
    OstLevels levels;
} Setup;

static void set_up_down_to(int coarsest, const ElasticBlock *block, Setup *s)
{
    OstMetricGraph *graph = NULL;
    double *taken = NULL; /* by the levels */
    memset(s, 0, sizeof *s);
    s->options = ost_solver_default_options();
    s->options.coarsest_unknowns = coarsest;
    assert_success(elastic_create(ctx, block, &s->problem));
    const size_t n = 3 * (size_t)s->problem.matrix->rows;
    assert_success(ost_scaling_create(s->problem.matrix, &s->scaling));
    assert_success(OST_NEW(ctx, &s->modes, 6 * n));
    for (size_t k = 0; k < 6; k++)
        ost_scaling_to_scaled_mode(s->scaling, s->problem.modes + k * n, s->modes + k * n);
    assert_success(ost_metric_graph_create(s->problem.matrix, &s->problem.geometry, &graph));
    assert_success(OST_NEW(ctx, &taken, 6 * n));
    memcpy(taken, s->modes, 6 * n * sizeof *taken);
    assert_success(ost_levels_create(s->problem.matrix, s->scaling, &taken, &graph, NULL, &s->options, &s->levels));
    assert_null(taken);
    assert_true(s->levels.count >= 3);
}

static void set_up(const ElasticBlock *block, Setup *s)
{
    set_up_down_to(100, block, s);
}

static void tear_down(Setup *s)
{
    ost_levels_clear(&s->levels);
    ost_scaling_destroy(&s->scaling);
    OST_FREE(s->modes);
    elastic_destroy(&s->problem);
}

/* Room for whatever any level's columns are. */
static double *new_vector(void)
{
    double *vector = NULL;
    assert_success(ost_level_vector_create(ctx, 6, (size_t)5000, &vector));
    return vector;
}

static size_t owned(const OstLevelMatrix *matrix)
{
    return ost_level_unknowns(matrix);
}

/* A level vector that looks like noise, the same on any number of ranks only in kind. */
static double *noise(const OstLevelMatrix *matrix, unsigned seed)
{
    double *x = new_vector();
    for (size_t i = 0; i < owned(matrix); i++)
        x[i] = sin(12.9898 * (double)(i + 1) * (seed + 1 + (unsigned)ost_rank(ctx)));
    return x;
}

static double global_dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return sum;
}

static const ElasticBlock free_block = {.bricks = {14, 12, 16}, .size = {1, 1, 1}, .modulus = 3e5, .poisson = 0.3};
static const ElasticBlock held_block = {
    .bricks = {14, 12, 16}, .size = {1, 1, 1}, .modulus = 3e5, .poisson = 0.3, .held = 1};

static void check_galerkin(const Setup *setup)
{
    const Setup s = *setup;
    for (int l = 0; l + 1 < s.levels.count; l++) {
        OstLevelMatrix *fine = s.levels.matrix[l], *coarse = s.levels.matrix[l + 1];
        double *x = noise(coarse, 1), *px = new_vector(), *ax = new_vector(), *apx = new_vector();
        ost_prolongator_add(s.levels.prolongator[l], x, px);
        ost_level_matrix_add(fine, 1.0, px, apx);
        ost_level_matrix_add(coarse, 1.0, x, ax);
        const double energy = global_dot(owned(coarse), x, ax);
        assert_true(energy > 0.0);
        assert_close(global_dot(owned(fine), px, apx) / energy, 1.0, 1e-5); /* single precision */
        OST_FREE(x, px, ax, apx);
    }
}

static void coarse_matrices_are_the_galerkin_products(void **state)
{
    Setup s;
    set_up(&held_block, &s);
    check_galerkin(&s);
    tear_down(&s);
}

/* Coarse nodes of a solid body have so many neighbours that aggregates of 8 would make a nearly full matrix; those of a
 * wall of one aggregate do not. A number that is given is kept. */
static void aggregates_of_a_coarse_level_grow_with_its_rows(void **state)
{
    const ElasticBlock solid = {.bricks = {15, 15, 15}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    const ElasticBlock wall = {.bricks = {40, 40, 1}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    for (int k = 0; k < 2 && ost_size(ctx) == 1; k++) {
        Setup s;
        set_up(k == 0 ? &solid : &wall, &s);
        const double nodes = (double)s.levels.matrix[1]->rows / (double)s.levels.matrix[2]->rows;
        const double row = (double)s.levels.matrix[1]->nonzeros / (36.0 * s.levels.matrix[1]->rows);
        printf("rows of %.3g blocks: aggregates of %.3g nodes\n", row, nodes);
        assert_true(k == 0 ? nodes > 10.0 : nodes < 10.0);
        tear_down(&s);
    }
}

static void few_nodes_go_to_fewer_ranks(void **state)
{
    const OstGlobal enough = OST_NODES_OF_RANK;
    assert_int_equal(ost_gathered_stride(100 * enough, 64, 1, 0), 1);
    assert_int_equal(ost_gathered_stride(40 * enough, 64, 1, 0), 1); /* not yet half as many */
    assert_int_equal(ost_gathered_stride(32 * enough, 64, 1, 0), 2);
    assert_int_equal(ost_gathered_stride(8 * enough, 64, 2, 0), 8);
    assert_int_equal(ost_gathered_stride(1, 64, 8, 0), 64);
    assert_int_equal(ost_gathered_stride(40 * enough, 64, 1, 1), 64); /* all together */
    assert_int_equal(ost_gathered_stride(3 * enough, 7, 1, 0), 3);    /* ranks 0, 3 and 6 */
    assert_int_equal(ost_gathered_stride(5, 1, 1, 1), 1);
}

/* About 60 nodes below 2500, and 8 below them. */
static void gathered_levels_are_galerkin_products_too(void **state)
{
    const ElasticBlock block = {.bricks = {12, 12, 14}, .size = {1, 1, 1}, .modulus = 3e5, .poisson = 0.3, .held = 1};
    const int stride = ost_size(ctx) == 4 ? 2 : 1;
    Setup s;
    set_up_down_to(60, &block, &s);
    assert_true(s.levels.count == 3);
    assert_true((s.levels.matrix[1]->rows > 0) == (ost_rank(ctx) % stride == 0));
    assert_true((s.levels.matrix[2]->rows > 0) == (ost_rank(ctx) == 0));
    check_galerkin(&s);
    tear_down(&s);
}

/* c minimises ||P c - m||, by conjugate gradients on the normal equations; returns ||P c - m|| / ||m||. */
static double fit(const OstProlongator *p, size_t coarse_owned, const double *m, double *c)
{
    const size_t n = (size_t)(p->height * p->rows);
    double *residual = new_vector(), *gradient = new_vector(), *direction = new_vector(), *image = new_vector();
    memcpy(residual, m, n * sizeof *m);
    double square = 0.0;
    for (int k = 0; k < 60; k++) {
        ost_prolongator_restrict(p, residual, gradient);
        const double next = global_dot(coarse_owned, gradient, gradient);
        for (size_t i = 0; i < coarse_owned; i++)
            direction[i] = gradient[i] + (k > 0 ? next / square : 0.0) * direction[i];
        square = next;
        memset(image, 0, n * sizeof *image);
        ost_prolongator_add(p, direction, image);
        const double step = square / global_dot(n, image, image);
        for (size_t i = 0; i < coarse_owned; i++)
            c[i] += step * direction[i];
        for (size_t i = 0; i < n; i++)
            residual[i] -= step * image[i];
    }
    const double error = sqrt(global_dot(n, residual, residual) / global_dot(n, m, m));
    OST_FREE(residual, gradient, direction, image);
    return error;
}

static void rigid_motions_pass_down_the_levels_and_cost_no_energy(void **state)
{
    Setup s;
    set_up(&free_block, &s);
    for (size_t mode = 0; mode < 6; mode++) {
        double *m = new_vector();
        memcpy(m, s.modes + mode * owned(s.levels.matrix[0]), owned(s.levels.matrix[0]) * sizeof *m);
        for (int l = 0; l + 1 < s.levels.count; l++) {
            OstLevelMatrix *coarse = s.levels.matrix[l + 1];
            double *c = new_vector(), *ac = new_vector();
            assert_true(fit(s.levels.prolongator[l], owned(coarse), m, c) < 1e-5); /* single precision */
            ost_level_matrix_add(coarse, 1.0, c, ac);
            const double force = sqrt(global_dot(owned(coarse), ac, ac) / global_dot(owned(coarse), c, c));
            assert_true(force < 1e-5); /* the scaled matrix' largest eigenvalues are about 3 */
            OST_FREE(m, ac);
            m = c;
        }
        OST_FREE(m);
    }
    tear_down(&s);
}

static void the_smoother_is_symmetric_and_positive(void **state)
{
    Setup s;
    set_up(&held_block, &s);
    for (int l = 0; l < 2; l++) {
        const OstLevelMatrix *a = s.levels.matrix[l];
        OstSmoother *smoother = s.levels.smoother[l];
        assert_true(smoother->largest > 1.0 && smoother->largest < 10.0);
        double *x = noise(a, 1), *y = noise(a, 2), *mx = noise(a, 3), *my = noise(a, 4);
        ost_smoother_apply(smoother, x, mx, 1);
        ost_smoother_apply(smoother, y, my, 1);
        const double xx = global_dot(owned(a), x, mx), yy = global_dot(owned(a), y, my);
        assert_true(xx > 0.0 && yy > 0.0);
        assert_close(global_dot(owned(a), x, my), global_dot(owned(a), y, mx), 1e-5 * sqrt(xx * yy));
        OST_FREE(x, y, mx, my);
    }
    tear_down(&s);
}

static void the_cycle_is_symmetric_and_positive(void **state)
{
    Setup s;
    set_up(&held_block, &s);
    OstCycle *cycle = NULL;
    OstQuadraticLevel *none = NULL;
    const OstLevelMatrix *a = s.levels.matrix[0];
    double *x = noise(a, 1), *y = noise(a, 2), *mx = noise(a, 3), *my = noise(a, 4);
    assert_success(ost_cycle_create(ctx, &s.levels, &none, &s.options, &cycle));
    assert_int_equal(s.levels.count, 0);
    assert_success(ost_cycle_apply(cycle, x, mx));
    assert_success(ost_cycle_apply(cycle, y, my));
    const double xx = global_dot(owned(a), x, mx), yy = global_dot(owned(a), y, my);
    assert_true(xx > 0.0 && yy > 0.0);
    assert_close(global_dot(owned(a), x, my), global_dot(owned(a), y, mx), 1e-5 * sqrt(xx * yy));
    assert_success(ost_cycle_apply_half(cycle, x, mx));
    const double of_half = global_dot(owned(a), x, mx) / xx;
    print_message("half a cycle: %.3f of the whole one's product\n", of_half);
    assert_true(of_half > 0.0);
    assert_success(ost_cycle_apply_brief(cycle, y, my));
    assert_true(global_dot(owned(a), y, my) > 0.0);
    assert_success(ost_cycle_apply_half(cycle, x, my)); /* the brief one leaves the smoother as it was */
    assert_close(global_dot(owned(a), x, my), of_half * xx, 1e-12 * xx);
    OST_FREE(x, y, mx, my);
    ost_cycle_destroy(&cycle);
    tear_down(&s);
}

static void the_coarsest_level_is_solved_exactly(void **state)
{
    Setup s;
    set_up(&held_block, &s);
    const OstLevelMatrix *a = s.levels.matrix[s.levels.count - 1];
    OstCoarsest *coarsest = NULL;
    assert_success(ost_coarsest_create(s.levels.coarsest, 0.0, &coarsest));
    double *b = noise(a, 1), *x = noise(a, 2);
    assert_success(ost_coarsest_solve(coarsest, 1, b, x));
    const double size = global_dot(owned(a), b, b);
    ost_level_matrix_add(a, -1.0, x, b);
    assert_true(sqrt(global_dot(owned(a), b, b) / size) < 1e-4); /* the product is in single precision */
    OST_FREE(b, x);
    ost_coarsest_destroy(&coarsest);
    tear_down(&s);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(aggregates_of_a_coarse_level_grow_with_its_rows),
    cmocka_unit_test(coarse_matrices_are_the_galerkin_products),
    cmocka_unit_test(few_nodes_go_to_fewer_ranks),
    cmocka_unit_test(gathered_levels_are_galerkin_products_too),
    cmocka_unit_test(rigid_motions_pass_down_the_levels_and_cost_no_energy),
    cmocka_unit_test(the_smoother_is_symmetric_and_positive),
    cmocka_unit_test(the_cycle_is_symmetric_and_positive),
    cmocka_unit_test(the_coarsest_level_is_solved_exactly),
};

OST_TEST_MAIN(tests)
