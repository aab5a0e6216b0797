/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "hard_grid/grid.h"

/* A checkerboard of quadratic tets, 1e9 between its cells. Each soft one has a single vertex that no stiff cell has:
 * left as nodes of all coarser levels, these made seven levels of four, and the last one of a large body too large. */
static void soft_pockets_do_not_stay_on_coarse_levels(void **state)
{
    (void)state;
    const HardPoint point = {.shape = hard_find_shape("checker"),
                             .order = 2,
                             .poisson = 4,
                             .ratio = 1,
                             .stiff = 1,
                             .axes = 2,
                             .iterated = 1,
                             .iterations = 1,
                             .size = 10000};
    HardCase hard;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(hard_make_case(ctx, &point, &hard));
    hard.c.solver.method = OST_METHOD_METRIC;
    hard.c.solver.coarsest_unknowns = 50;
    assert_success(hard_make_chunk(&point, &hard.c, &chunk));
    assert_success(ost_scene_create_on(&hard.c, &chunk, &scene));
    assert_int_equal(ost_scene_solve(scene, &result), OST_NOT_CONVERGED); /* in one iteration */
    assert_non_null(result);
    assert_true(result->solve.levels <= 5);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(soft_pockets_do_not_stay_on_coarse_levels),
};

OST_TEST_MAIN(tests)
