/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "hard_grid/grid.h"

#include <math.h>

/* A refusal is judged without factors. Of plates of quadratic tets rounding makes one indefinite, or nearly so, as the
 * order of sums has it; leaves another without a digit; and hardly moves an isotropic one. A cube is nowhere near. */
static void soft_motions_show_what_rounding_leaves(void **state)
{
    (void)state;
    static const struct {
        const char *shape;
        HardPoint point;
        double least, most; /* of the energy, that rounding changes */
    } bodies[] = {{"plate", {.poisson = 2, .ratio = 1, .stiff = 2, .axes = 0}, 1.0, INFINITY},
                  {"plate", {.poisson = 1, .ratio = 1, .stiff = 0, .axes = 1, .size = 60000}, 0.1, 1.0},
                  {"plate", {.poisson = 1}, 1e-6, 1e-2},
                  {"slivers", {.poisson = 1}, 1e-20, 1e-12}};
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        HardPoint point = bodies[i].point;
        HardTruth truth = {.rounded = NAN};
        HardCase hard;
        OstMeshChunk *chunk = NULL;
        OstScene *scene = NULL;
        point.shape = hard_find_shape(bodies[i].shape);
        point.order = 2;
        assert_success(hard_make_case(ctx, &point, &hard));
        assert_success(hard_make_chunk(&point, &hard.c, &chunk));
        assert_success(ost_scene_create_on(&hard.c, &chunk, &scene));
        assert_success(hard_find_singular(scene, &truth));
        ost_scene_destroy(&scene);
        if (ost_rank(ctx) == 0)
            print_message("%s: indefinite %d, moved by %g\n", bodies[i].shape, truth.indefinite, truth.rounded);
        const double moved = truth.indefinite ? INFINITY : truth.rounded;
        assert_true(moved >= bodies[i].least && moved <= bodies[i].most);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(soft_motions_show_what_rounding_leaves),
};

OST_TEST_MAIN(tests)
