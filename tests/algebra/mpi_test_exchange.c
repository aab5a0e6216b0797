/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/exchange.h"
#include "elastic_block.h"
#include "support.h"

static const ElasticBlock block = {
    .bricks = {4, 3, 9}, .size = {1.0, 1.0, 2.0}, .modulus = 1.0, .poisson = 0.3, .held = 1};

static double *numbers(const OstHalo *halo, int width)
{
    const size_t count = (size_t)width * (size_t)(halo->owned + halo->ghosts);
    double *made = NULL;
    assert_success(OST_NEW(ctx, &made, count));
    for (size_t i = 0; i < count; i++)
        made[i] = 1.0 + 0.001 * (double)i + 1000.0 * ost_rank(ctx);
    return made;
}

/* ML's exchange does what our own does, in both directions. */
static void it_moves_the_same_numbers_as_the_halo(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &block, &problem));
    OstHalo *halo = problem.matrix->halo;
    for (int width = 3; width <= 6; width += 3) {
        OstExchange *exchange = NULL;
        assert_success(ost_exchange_create(halo, width, &exchange));
        double *x = numbers(halo, width), *expected = numbers(halo, width);
        const size_t count = (size_t)width * (size_t)(halo->owned + halo->ghosts);
        ost_exchange_import(exchange, x);
        assert_success(ost_halo_import(halo, (size_t)width * sizeof *x, expected));
        assert_memory_equal(x, expected, count * sizeof *x);
        ost_exchange_add_to_owners(exchange, x);
        assert_success(ost_halo_add_to_owners(halo, width, expected));
        for (size_t i = 0; i < count; i++)
            assert_close(x[i], expected[i], 1e-15 * fabs(expected[i]));
        OST_FREE(x, expected);
        ost_exchange_destroy(&exchange);
        assert_null(exchange);
    }
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(it_moves_the_same_numbers_as_the_halo),
};

OST_TEST_MAIN(tests)
