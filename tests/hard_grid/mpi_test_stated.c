/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "../case/case_text.h"
#include "hard_grid/grid.h"

#include <string.h>

/* What is stated of an answer's errors is true, and what holds no digit is not accepted: small bodies, by every
 * strategy, compared with the solution of the tets' equations. */

typedef struct Body {
    const char *shape;
    int order;
    OstLocal divisions[3];
    double length;   /* along x; 0: the shape's */
    double contrast; /* of the inclusions; 0: the shape's */
    OstMethod method;
    double residual; /* asked for; 0: the grid's */
} Body;

static OstScene *make_scene(const Body *body, HardCase *hard)
{
    const HardPoint point = {.shape = hard_find_shape(body->shape), .order = body->order, .poisson = 1};
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    assert_success(hard_make_case(ctx, &point, hard));
    if (body->length > 0.0)
        hard->c.block.size[0] = body->length;
    memcpy(hard->c.block.divisions, body->divisions, sizeof body->divisions);
    if (body->contrast > 0.0) {
        const OstOrthotropic constants = ost_orthotropic_isotropic(body->contrast, 0.3);
        assert_success(ost_material_create(ctx, "inclusion", &constants, 0.0, &hard->material[1].material));
    }
    hard->c.solver.method = body->method;
    if (body->residual > 0.0)
        hard->c.solver.relative_residual = body->residual;
    assert_success(hard_make_chunk(&point, &hard->c, &chunk));
    assert_success(ost_scene_create_on(&hard->c, &chunk, &scene));
    return scene;
}

static void what_is_accepted_is_stated_rightly(void **state)
{
    const Body bodies[] = {
        {"beam", 2, {40, 1, 1}, 400.0, 0.0, OST_METHOD_DIRECT, 0.0},
        {"beam", 1, {200, 1, 1}, 200.0, 0.0, OST_METHOD_DIRECT, 0.0},
        {"beam", 1, {200, 1, 1}, 200.0, 0.0, OST_METHOD_TWO_LEVEL, 0.0},
        {"stiff", 1, {6, 6, 4}, 0.0, 0.0, OST_METHOD_DIRECT, 0.0},
        {"stiff", 1, {6, 6, 4}, 0.0, 0.0, OST_METHOD_METRIC, 0.0},
        {"stiff", 2, {4, 4, 4}, 0.0, 1e5, OST_METHOD_METRIC, 0.0},
        {"soft", 1, {6, 6, 4}, 0.0, 0.0, OST_METHOD_METRIC, 0.0},
        {"slivers", 1, {4, 4, 4}, 0.0, 0.0, OST_METHOD_DIRECT, 0.0},
        {"checker", 1, {6, 5, 5}, 0.0, 0.0, OST_METHOD_STRONG, 0.0},
    };
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++) {
        HardCase hard;
        HardReading reading = {.point = {0}};
        OstScene *scene = make_scene(&bodies[b], &hard);
        assert_success(hard_solve_scene(scene, &reading));
        ost_scene_destroy(&scene);
        const HardErrors *off = &reading.truth.off;
        if (reading.status != OST_SUCCESS || !off->known || !hard_states_its_error(&reading))
            print_message(
                "body %zu: %s: displacement %.1e (stated %.1e), reactions %.1e, stresses %.1e (stated %.1e)\n", b,
                reading.reason, off->displacement, reading.stated_error, off->reaction, off->stress,
                reading.stated_forces);
        assert_int_equal(reading.status, OST_SUCCESS);
        assert_true(off->known && off->displacement < 0.1);
        assert_true(hard_states_its_error(&reading));
    }
}

/* What a residual of a hundredth or of a thousandth leaves, where moduli differ. */
static void what_a_large_residual_leaves_is_stated(void **state)
{
    const Body bodies[] = {
        {"beam", 2, {40, 1, 1}, 100.0, 0.0, OST_METHOD_METRIC, 1e-2},
        {"beam", 1, {200, 1, 1}, 200.0, 0.0, OST_METHOD_TWO_LEVEL, 1e-3},
        {"stiff", 1, {6, 6, 4}, 0.0, 0.0, OST_METHOD_METRIC, 1e-2},
        {"stiff", 2, {4, 4, 4}, 0.0, 1e5, OST_METHOD_METRIC, 1e-2},
        {"stiff", 2, {4, 4, 4}, 0.0, 1e5, OST_METHOD_METRIC, 1e-3},
        {"soft", 1, {6, 6, 4}, 0.0, 0.0, OST_METHOD_METRIC, 1e-2},
        {"checker", 1, {6, 5, 5}, 0.0, 0.0, OST_METHOD_STRONG, 1e-2},
    };
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++) {
        HardCase hard;
        HardReading reading = {.point = {0}};
        OstScene *scene = make_scene(&bodies[b], &hard);
        assert_success(hard_solve_scene(scene, &reading));
        ost_scene_destroy(&scene);
        if (reading.status != OST_SUCCESS || !hard_states_its_error(&reading))
            fail_msg("body %zu: %s: displacement %.1e, stated %.1e", b, reading.reason, reading.truth.off.displacement,
                     reading.stated_error);
        assert_true(reading.truth.off.known);
    }
}

/* Rounding of the assembled stiffness took a quarter of this beam's displacement. */
static void a_slender_beam_keeps_its_digits(void **state)
{
    const Body body = {"beam", 2, {200, 1, 1}, 4000.0, 0.0, OST_METHOD_DIRECT, 0.0};
    HardCase hard;
    HardReading reading = {.point = {0}};
    OstScene *scene = make_scene(&body, &hard);
    assert_success(hard_solve_scene(scene, &reading));
    ost_scene_destroy(&scene);
    assert_int_equal(reading.outcome, HARD_SOLVED_TO_ROUNDING);
    assert_true(reading.truth.off.known && reading.truth.off.displacement < 1e-6);
}

/* Its stiff parts hold no digit of a strain beside the displacement: their stresses are lost. */
static void what_holds_no_digit_is_refused_for_rounding(void **state)
{
    const Body body = {"stiff", 1, {6, 6, 4}, 0.0, 1e17, OST_METHOD_DIRECT, 0.0};
    HardCase hard;
    OstScene *scene = make_scene(&body, &hard);
    OstResult *result = NULL;
    hard.c.output_fields = 1U << OST_FIELD_STRESS;
    scene->plan.effects.state[OST_EFFECT_RECOVERY - OST_EFFECT_FIRST].on = 1;
    const OstStatus status = ost_scene_solve(scene, &result);
    assert_true(status == OST_CHECK_FAILED || status == OST_NOT_CONVERGED);
    assert_non_null(strstr(ost_error_text(ctx), "less than one digit"));
    assert_null(strstr(ost_error_text(ctx), "move freely"));
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
}

/* "order 1, 0.999 of border, E3 x 1e+06, cylindrical": found to a tenth in the norm of the energy, the error of the
 * checkerboard was a quarter of that of the reactions on four ranks, and that of stiff inclusions a ninth of that of
 * their stresses. */
static void what_forces_hold_more_of_is_stated(void **state)
{
    const HardPoint points[] = {
        {.shape = hard_find_shape("checker"), .order = 1, .poisson = 6, .ratio = 2, .stiff = 2, .axes = 1},
        {.shape = hard_find_shape("stiff"), .order = 1, .poisson = 6, .ratio = 2, .stiff = 2, .axes = 1, .size = 1000},
    };
    for (size_t p = 0; p < sizeof points / sizeof *points; p++) {
        HardReading reading = {.outcome = HARD_OUTCOMES};
        assert_success(hard_read(ctx, &points[p], &reading));
        assert_int_equal(reading.status, OST_SUCCESS);
        assert_true(reading.truth.off.known && hard_states_its_error(&reading));
    }
}

/* Bars by the mixed form, stopped early and held by springs: softer than the preconditioner says, so that the norm in
 * which the iteration goes down did not see what was left. They stated a fifth to a seventeenth of their errors. */
static void what_a_mixed_form_leaves_is_stated(void **state)
{
    static const struct {
        const char *size, *moduli, *held, *load;
        int coarsest;
    } bars[] = {
        {"[20, 1, 0.3], divisions: [8, 1, 1]", "[1, 1, 10]", "0.1", "zmax", 30},
        {"[40, 1, 1], divisions: [4, 1, 1]", "[1, 1, 1]", "10", "xmax", 100},
        {"[6, 1, 0.1], divisions: [3, 1, 1]", "[1000, 1, 1]", "10", "zmax", 100},
    };
    for (size_t b = 0; b < sizeof bars / sizeof *bars; b++) {
        HardReading reading = {.point = {0}};
        OstCase *c = NULL;
        OstScene *scene = NULL;
        char text[1024];
        snprintf(text, sizeof text,
                 "mesh: {block: {size: %s}}\nelement: {order: 2}\nlarge_rotation: off\n"
                 "materials: [{region: all, youngs_modulus: %s, poissons_ratio: 0.5, axes: {euler: {degrees: [30, 40, "
                 "50]}}}]\nsprings: [{on: {boundary: xmin}, foundation: %s}]\n"
                 "loads: [{on: {boundary: %s}, pressure: 1}]\nsolver: {method: metric, coarsest_unknowns: %d}\n"
                 "output: {file: r.vtkhdf}\n",
                 bars[b].size, bars[b].moduli, bars[b].held, bars[b].load, bars[b].coarsest);
        assert_success(read_text(text, &c));
        assert_success(ost_scene_create(c, &scene));
        assert_success(hard_solve_scene(scene, &reading));
        ost_scene_destroy(&scene);
        ost_case_destroy(&c);
        assert_int_equal(reading.status, OST_SUCCESS);
        assert_true(reading.truth.off.known);
        if (!hard_states_its_error(&reading))
            fail_msg("bar %zu: displacement %.1e, stated %.1e", b, reading.truth.off.displacement,
                     reading.stated_error);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_a_mixed_form_leaves_is_stated), cmocka_unit_test(what_forces_hold_more_of_is_stated),
    cmocka_unit_test(what_is_accepted_is_stated_rightly), cmocka_unit_test(what_a_large_residual_leaves_is_stated),
    cmocka_unit_test(a_slender_beam_keeps_its_digits),    cmocka_unit_test(what_holds_no_digit_is_refused_for_rounding),
};

OST_TEST_MAIN(tests)
