/* SPDX-License-Identifier: BSD-3-Clause */
#include "iterations.h"

/* Layers a thousand times as wide as thick, beams of 100 : 1 and plates of 1000 : 1 take about as many iterations as
 * stout bodies, on any number of ranks, without a factorisation. Beams and plates to what double precision allows. */

#define END                                                                                           \
    "large_rotation: off\naccuracy: {algebraic_fraction: 0}\noutput: {fields: [displacement]}\n"      \
    "solver: {factor_memory: 1e-6}\nconstraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n" \
    "loads: [{on: {boundary: xmax}, total_force: [3e-9, 3e-9, 1e-8]}]\n"
#define LAYERS "mesh: {block: {size: [1, 1, 1], divisions: [12, 12, 12]}}\n" END
#define BEAM "mesh: {block: {size: [100, 1, 1], divisions: [133, 4, 4]}}\n" END
#define PLATE "mesh: {block: {size: [1000, 1000, 1], divisions: [22, 22, 2]}}\n" END
#define SHEET "mesh: {block: {size: [1000, 1000, 1], divisions: [10, 10, 1]}}\n" END
#define SLENDER                                                                                                   \
    "mesh: {block: {size: [100, 1, 1], divisions: [120, 2, 2]}}\nlarge_rotation: off\nsolver: {method: metric}\n" \
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"                                            \
    "loads: [{on: {boundary: xmax}, total_force: [3e-9, 3e-9, 1e-8]}]\noutput: {fields: [displacement]}\n"
#define OF(moduli, nu) "materials: [{region: all, youngs_modulus: " moduli ", poissons_ratio: " nu "}]\n"

/* Every second layer of hexes becomes a thousandth as thick as a hex is wide. */
static void squeeze(OstMeshChunk *chunk, const void *nothing)
{
    (void)nothing;
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        double *z = chunk->coordinates + 3 * (size_t)i + 2;
        const long layer = lround(12.0 * *z), thin = (layer + 1) / 2;
        *z = ((double)thin * 1e-3 + (double)(layer - thin) * 1.999) / 12.0;
    }
}

static void thin_bodies_take_few_iterations(void **state)
{
    static const struct {
        const char *name, *text;
        int order, layers, most;
    } bodies[] = {
        {"layers, isotropic", LAYERS OF("1", "0.3"), 1, 1, 25},
        {"layers, stiff across, nu 0.45", LAYERS OF("[1, 1, 1000]", "0.45"), 1, 1, 45},
        {"layers, stiff along, nu 0.45", LAYERS OF("[1000, 1, 1]", "0.45"), 1, 1, 45},
        {"beam, isotropic", BEAM OF("1", "0.3"), 1, 0, 45},
        {"beam, stiff along", BEAM OF("[1000, 1, 1]", "0.3"), 1, 0, 30},
        {"plate, isotropic", PLATE OF("1", "0.3"), 1, 0, 50},
        {"plate, stiff across, nu 0.45", PLATE OF("[1, 1, 1000]", "0.45"), 1, 0, 60},
        {"plate of quadratic tets, isotropic", SHEET OF("1", "0.3"), 2, 0, 60},
        {"plate of quadratic tets, stiff along", SHEET OF("[1000, 1, 1]", "0.3"), 2, 0, 60},
        {"layers, stiff across, nu 0.4", LAYERS OF("[1, 1, 1000]", "0.4"), 2, 1, 45},
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++)
        check_iterations(bodies[i].name, bodies[i].text, bodies[i].order, bodies[i].most,
                         bodies[i].layers ? squeeze : NULL, NULL);
}

/* A factorisation would find the same: factor_memory, which is as good as 0, is not to blame. */
static void a_plate_beyond_double_precision_is_not_refused_for_want_of_memory(void **state)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(read_text(SHEET OF("[1, 1, 1000]", "0.45"), &c));
    c->order = 2;
    assert_success(ost_scene_create(c, &scene));
    assert_failure(ost_scene_solve(scene, &result), OST_NOT_CONVERGED, "the displacement less than one digit");
    assert_null(strstr(ost_error_text(ctx), "factor_memory"));
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* Single precision makes the coarse levels of this beam indefinite: they are built again with more digits, also where
 * the case asks for one strategy. */
static void a_slender_beam_is_solved_by_the_strategy_asked_for(void **state)
{
    (void)state;
    check_iterations("slender beam, by metric", SLENDER OF("1", "0.3"), 2, 60, NULL, NULL);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_slender_beam_is_solved_by_the_strategy_asked_for),
    cmocka_unit_test(a_plate_beyond_double_precision_is_not_refused_for_want_of_memory),
    cmocka_unit_test(thin_bodies_take_few_iterations),
};

OST_TEST_MAIN(tests)
