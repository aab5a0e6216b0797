/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "algebra/trilinos/epetra.h"

/* Rank r has 5 r unknowns: the first rank has none. */
static OstEpetraMap *make_map(void)
{
    OstEpetraMap *map = NULL;
    assert_success(ost_epetra_map_create(ctx, 5 * ost_rank(ctx), &map));
    return map;
}

static void a_norm_sees_the_values_of_all_ranks_in_place(void **state)
{
    OstEpetraMap *map = make_map();
    double values[16];
    double norm = -1.0;
    double expected = 0.0;
    for (int i = 0; i < 16; i++)
        values[i] = 1.0 + i;
    for (int r = 0; r < ost_size(ctx); r++)
        for (int i = 0; i < 5 * r; i++)
            expected += (1.0 + i) * (1.0 + i);
    assert_success(ost_epetra_norm(map, values, &norm));
    assert_close(norm, sqrt(expected), 1e-13 * sqrt(expected));
    for (int i = 0; i < 16; i++)
        assert_close(values[i], 1.0 + i, 0.0);
    ost_epetra_map_destroy(&map);
}

static void more_unknowns_than_epetra_numbers_are_refused(void **state)
{
    if (ost_size(ctx) < 2) /* one rank's count is an int */
        skip();
    OstEpetraMap *map = NULL;
    assert_failure(ost_epetra_map_create(ctx, INT32_MAX, &map), OST_LIMIT_EXCEEDED, "2^31");
    assert_null(map);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_norm_sees_the_values_of_all_ranks_in_place),
    cmocka_unit_test(more_unknowns_than_epetra_numbers_are_refused),
};

OST_TEST_MAIN(tests)
