/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "core/memory.h"
#include "orthostat/analysis.h"
#include "problem/scene_data.h"
#include "study/watch.h"

/* The estimated error of an answer against the true one, which a far finer one knows: where nothing is moved,
 * |u - u_h|² = 2 (energy of u - energy of u_h). */

#define CUBE "mesh: {block: {size: [1, 1, 1], divisions: [3, 3, 3]}}\n"
#define BEAM "mesh: {block: {size: [20, 2, 2], divisions: [20, 2, 2]}}\n"
#define HELD "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
#define SIDEWAYS "loads: [{on: {boundary: xmax}, traction: [0, 1, 0.5]}]\n"
#define HEAVY "loads: [{body_force: [0.3, -1, 0.2]}, {on: {boundary: zmax}, pressure: 2}]\n"
#define STEEL "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]\n"
#define OF_NU(nu) "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: " nu "}]\n"
#define TURNED "axes: {fixed: [[0.6, 0.48, 0.64], [-0.8, 0.36, 0.48], [0, -0.8, 0.6]]}"
#define FIBRES "materials: [{region: all, youngs_modulus: [1e6, 1e3, 1e3], poissons_ratio: 0.3, " TURNED "}]\n"
#define JUMPS                                                                      \
    "materials:\n  - {region: block, youngs_modulus: 1000, poissons_ratio: 0.3}\n" \
    "  - {region: core, youngs_modulus: [1e6, 2e4, 1e4], poissons_ratio: 0.2, " TURNED "}\n"
#define FINE "large_rotation: off\naccuracy: {relative_residual: 1e-10}\noutput: {fields: [error]}\n"

/* Tets of a region `core`, here and there, where the case has a material for it. */
static void add_core(const OstCase *c, OstMeshChunk *chunk)
{
    char **names = NULL;
    if (strcmp(c->materials[c->material_count - 1].region, "core") != 0)
        return;
    assert_success(OST_NEW(ctx, &names, 2));
    names[0] = chunk->regions.name[0];
    assert_success(ost_copy_string(ctx, "core", &names[1]));
    OST_FREE(chunk->regions.name);
    chunk->regions = (OstNames){2, names};
    for (OstLocal t = 0; t < chunk->tet_count; t++) /* hexes of six tets, so that both regions are thick */
        chunk->tet_region[t] = ((chunk->first_tet + t) / 6 * 7) % 5 < 2;
}

typedef struct Answer {
    OstCase *c;
    OstScene *scene;
    OstResult *result;
} Answer;

static Answer solve(const char *text, int order, int refinement)
{
    Answer made = {0};
    OstMeshChunk *chunk = NULL;
    assert_success(read_text(text, &made.c));
    made.c->order = order;
    made.c->refinement = refinement;
    assert_success(ost_chunk_create_block(ctx, &made.c->block, &chunk));
    add_core(made.c, chunk);
    assert_success(ost_scene_create_on(made.c, &chunk, &made.scene));
    assert_success(ost_scene_solve(made.scene, &made.result));
    return made;
}

static void release(Answer *answer)
{
    ost_result_destroy(&answer->result);
    ost_scene_destroy(&answer->scene);
    ost_case_destroy(&answer->c);
}

/* Estimated over true error; `refinement` is that of the finer answer. */
static double effectivity(const char *text, int order, int refinement)
{
    Answer coarse = solve(text, order, 0), fine = solve(text, 2, refinement);
    const double square = 2.0 * (fine.result->checks.strain_energy - coarse.result->checks.strain_energy);
    const OstAnswerError found = *ost_result_answer_error(coarse.result);
    const OstAnswerError rest = *ost_result_answer_error(fine.result);
    assert_true(found.known && rest.known);
    assert_true(square > 0.0);
    const double truth = sqrt(square + rest.energy_norm * rest.energy_norm);
    release(&coarse);
    release(&fine);
    return found.energy_norm / truth;
}

static void true_errors_are_estimated(void **state)
{
    static const struct {
        const char *name, *text;
        int order;
    } bodies[] = {
        {"bending", BEAM STEEL HELD SIDEWAYS FINE, 1},
        {"steel", CUBE STEEL HELD HEAVY FINE, 1},
        {"steel", CUBE STEEL HELD HEAVY FINE, 2},
        {"fibres", CUBE FIBRES HELD SIDEWAYS FINE, 1},
        {"fibres", CUBE FIBRES HELD SIDEWAYS FINE, 2},
        {"jumps", CUBE JUMPS HELD HEAVY FINE, 1},
        {"jumps", CUBE JUMPS HELD HEAVY FINE, 2},
        {"nu 0.49", CUBE OF_NU("0.49") HELD SIDEWAYS FINE, 1},
        {"nu 0.49", CUBE OF_NU("0.49") HELD SIDEWAYS FINE, 2},
        {"nu 0.499", CUBE OF_NU("0.499") HELD SIDEWAYS FINE, 1},
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        const double found = effectivity(bodies[i].text, bodies[i].order, 1);
        print_message("%s, order %d: %.3f\n", bodies[i].name, bodies[i].order, found);
        if (!(found > 0.7 && found < 1.5))
            fail_msg("%s, order %d: estimated over true error is %g", bodies[i].name, bodies[i].order, found);
    }
}

/* Linear tets whose edges cross the fibres lock; vertices that also turn do not. */
static void multigrid_over_vertices_that_turn_finds_the_error_as_well(void **state)
{
    (void)state;
    static const char text[] =
        "mesh: {block: {size: [2, 1, 1], divisions: [6, 3, 3]}}\n"
        "solver: {method: metric}\n" FIBRES HELD SIDEWAYS "large_rotation: off\noutput: {fields: [error]}\n";
    Answer answer = solve(text, 2, 0);
    assert_in_range(answer.result->solve.iterations, 2, 6);
    assert_true(answer.result->solve.operator_complexity < 1.8);
    release(&answer);
    const double found = effectivity(text, 2, 1);
    print_message("off the axes: %.3f\n", found);
    assert_true(found > 0.7 && found < 1.5);
}

/* --- quantities of interest --- */

enum { WATCHES = 3 };
#define WATCHED                                                                                     \
    "large_rotation: off\naccuracy: {relative_residual: 1e-8}\noutput: {fields: [error]}\nwatch:\n" \
    "  tip: {displacement: {nearest: [20, 2, 2]}, component: y}\n"                                  \
    "  middle: {displacement: {nearest: [10, 0, 0]}, component: length}\n"                          \
    "  energy: strain_energy\n"                                                                     \
    "  held: {reaction: {boundary: xmin}, component: y}\n"

static void read_watches(const Answer *answer, OstWatchedValue watched[WATCHES + 1])
{
    OstWatchedValue *values = NULL;
    assert_success(ost_watch_evaluate_all(answer->scene, answer->result, &values));
    memcpy(watched, values, (WATCHES + 1) * sizeof *watched);
    OST_FREE(values);
}

#define MEAN(name, component) "  " name ": {stress: {region: core}, take: mean, component: " component "}\n"
#define STRESSES                                                                                                     \
    "large_rotation: off\naccuracy: {relative_residual: 1e-8}\noutput: {fields: [error]}\nwatch:\n" MEAN("xx", "xx") \
        MEAN("yz", "yz") MEAN("pressure", "pressure") MEAN("mises", "von_mises")

static double watched_value(const Answer *answer, int w, double *error)
{
    OstWatchedValue *values = NULL;
    assert_success(ost_watch_evaluate_all(answer->scene, answer->result, &values));
    const double value = values[w].value;
    *error = values[w].error;
    OST_FREE(values);
    return value;
}

/* The mean over the tets of one of two materials, against that of a finer mesh and what this one still lacks. */
static void errors_of_mean_stresses_are_estimated(void **state)
{
    static const char *const bodies[] = {CUBE JUMPS HELD SIDEWAYS STRESSES};
    for (size_t b = 0; b < sizeof bodies / sizeof bodies[0]; b++)
        for (int order = 1; order <= 2; order++) {
            Answer coarse = solve(bodies[b], order, 0), fine = solve(bodies[b], 2, 1);
            for (int w = 0; w < 3; w++) {
                double found, rest;
                const double value = watched_value(&coarse, w, &found), better = watched_value(&fine, w, &rest) + rest;
                const double ratio = found / (better - value);
                print_message("body %d, order %d, mean %d: %.4g, off by %.3g, ratio %.3f\n", (int)b, order, w, value,
                              (better - value) / better, ratio);
                if (!(ratio > 0.4 && ratio < 2.0))
                    fail_msg("estimated over true error is %g", ratio);
            }
            double found;
            (void)watched_value(&coarse, 3, &found);
            assert_true(isnan(found)); /* that of a measure that is not linear */
            release(&coarse);
            release(&fine);
        }
}

/* Displacements and energy, against those of a finer mesh and what this one still lacks. */
static void errors_of_watches_are_estimated(void **state)
{
    static const char *const bodies[] = {BEAM STEEL HELD SIDEWAYS WATCHED, BEAM FIBRES HELD SIDEWAYS WATCHED};
    for (size_t b = 0; b < 2; b++)
        for (int order = 1; order <= 2; order++) {
            OstWatchedValue found[WATCHES + 1], better[WATCHES + 1];
            Answer coarse = solve(bodies[b], order, 0), fine = solve(bodies[b], 2, 1);
            read_watches(&coarse, found);
            read_watches(&fine, better);
            for (int w = 0; w < WATCHES; w++) {
                const double ratio = found[w].error / (better[w].value + better[w].error - found[w].value);
                print_message("body %d, order %d, %s: %.3f\n", (int)b, order, found[w].name, ratio);
                if (!(ratio > 0.5 && ratio < 2.0))
                    fail_msg("body %d, order %d, %s: estimated over true error is %g", (int)b, order, found[w].name,
                             ratio);
            }
            assert_true(found[WATCHES].error == 0.0); /* of a reaction that statics alone gives */
            release(&coarse);
            release(&fine);
        }
}

#define SLANTED                                                                                          \
    "mesh: {block: {size: [2, 2, 1], divisions: [2, 2, 1]}}\nmaterials: [{region: all, youngs_modulus: " \
    "[1e6, 1e3, 1e3], poissons_ratio: 0.3, axes: {rotation: {axis: [0, 1, 0], degrees: 45}}}]\n"
#define SLIDES                                                                                                    \
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, slide: [1, 0, "        \
    "0]}]\nloads: "                                                                                               \
    "[{on: {boundary: zmax}, traction: [1, 0.5, 2]}]\nlarge_rotation: off\naccuracy: {relative_residual: 1e-8}\n" \
    "output: {fields: [error]}\nwatch: {r: {reaction: {boundary: xmax}, component: x}}\n"

/* Across stiff fibres the next order alone has 0.41 of this error: parts cancel in it, and in what it misses. */
static void errors_of_reactions_across_fibres_are_estimated(void **state)
{
    Answer coarse = solve(SLANTED SLIDES, 2, 0), fine = solve(SLANTED SLIDES, 2, 2);
    double found, rest;
    const double value = watched_value(&coarse, 0, &found), better = watched_value(&fine, 0, &rest) + rest;
    const double ratio = found / (better - value);
    print_message("reaction: %.5g, off by %.3g, ratio %.3f\n", value, (better - value) / better, ratio);
    assert_true(ratio > 0.5 && ratio < 2.0);
    release(&coarse);
    release(&fine);
}

/* What moves a body alone makes too much energy; beside loads that count, or with an eigenstrain, nobody knows.
 */
static void energy_errors_have_a_sign(void **state)
{
#define MOVED                                                                                                     \
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, displacement: [1, 2, " \
    "0]}]\n"
#define ENERGY "watch: {energy: strain_energy}\n"
    Answer coarse = solve(CUBE STEEL MOVED ENERGY FINE, 1, 0), fine = solve(CUBE STEEL MOVED ENERGY FINE, 2, 1);
    OstWatchedValue *found = NULL, *better = NULL;
    assert_success(ost_watch_evaluate_all(coarse.scene, coarse.result, &found));
    assert_success(ost_watch_evaluate_all(fine.scene, fine.result, &better));
    const double truth = better->value + better->error - found->value;
    assert_true(truth < 0.0);
    assert_close(found->error, truth, 0.5 * fabs(truth));
    OST_FREE(found, better);
    release(&coarse);
    release(&fine);
    Answer both = solve(CUBE STEEL MOVED "loads: [{body_force: [30, -100, 20]}]\n" ENERGY FINE, 1, 0);
    assert_success(ost_watch_evaluate_all(both.scene, both.result, &found));
    assert_true(isnan(found->error));
    OST_FREE(found);
    release(&both);
    both = solve(CUBE STEEL MOVED HEAVY ENERGY FINE, 1, 0); /* less than a thousandth of the work */
    assert_success(ost_watch_evaluate_all(both.scene, both.result, &found));
    assert_close(found->error, truth, 0.5 * fabs(truth));
    OST_FREE(found);
    release(&both);
}

/* A beam whose end turns by 30 degrees: how far is it still to go? */
static void large_rotations_are_estimated(void **state)
{
    static const char text[] =
        "mesh: {block: {size: [10, 1, 1], divisions: [20, 2, 2]}}\n" STEEL HELD
        "loads: [{on: {boundary: xmax}, traction: [0, 0, 2]}]\nlarge_rotation: on\noutput: {fields: [error]}\n";
    Answer coarse = solve(text, 1, 0), fine = solve(text, 2, 0);
    const double far = ost_result_largest_displacement(fine.result, NULL);
    const double truth = 1.0 - ost_result_largest_displacement(coarse.result, NULL) / far;
    const OstAnswerError found = *ost_result_answer_error(coarse.result);
    assert_true(ost_result_newton_report(fine.result)->used && found.known);
    assert_true(truth > 0.2);
    if (!(found.displacement > 0.7 * truth && found.displacement < 1.5 * truth))
        fail_msg("the displacement is off by %g, and by %g as estimated", truth, found.displacement);
    assert_true(ost_result_answer_error(fine.result)->displacement < 0.02);
    release(&coarse);
    release(&fine);
}

/* Answers that the elements hold have no error, whatever acts on the body. */
static void exact_answers_have_no_error(void **state)
{
    static const char *const bodies[] = {
        CUBE STEEL "constraints: [{on: {boundary: xmin}, displacement: [0.5, -0.2, 0.1]}]\n" FINE,
        CUBE FIBRES "constraints: free_body\nloads: [{on: {boundary: xmin}, traction: [-1, 0, 0]}, {on: {boundary: "
                    "xmax}, traction: [1, 0, 0]}]\n" FINE,
        CUBE "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3, eigenstrain: 0.01}]\n"
             "constraints: free_body\n" FINE,
        CUBE STEEL "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}, "
                   "{on: {boundary: zmin}, slide: [0, 0, 1]}]\nloads: [{on: {boundary: xmax}, pressure: 3}]\n" FINE,
        CUBE "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0}]\n"
             "springs: [{on: {boundary: xmin}, foundation: 10}]\nloads: [{on: {boundary: xmax}, traction: [1, 0, "
             "0]}]\n" FINE,
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++)
        for (int order = 1; order <= 2; order++) {
            Answer answer = solve(bodies[i], order, 0);
            const OstAnswerError found = *ost_result_answer_error(answer.result);
            const double size = sqrt(2.0 * answer.result->checks.strain_energy) + 1e-3;
            if (!found.known || !(found.energy_norm < 1e-6 * size))
                fail_msg("body %d, order %d: an error of %g (known: %d) in %g", (int)i, order, found.energy_norm,
                         found.known, size);
            release(&answer);
        }
}

/* The tets' shares add up to the whole. */
static void shares_add_up(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Answer answer = solve(CUBE JUMPS HELD HEAVY FINE, order, 0);
        const double *error = ost_result_tet_error(answer.result);
        double sum = 0.0;
        assert_non_null(error);
        for (OstLocal tet = 0; tet < answer.scene->mesh->owned_tets; tet++)
            sum += error[tet] * error[tet];
        MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
        const double whole = ost_result_answer_error(answer.result)->energy_norm;
        assert_close(sqrt(sum), whole, 1e-10 * whole);
        release(&answer);
    }
}

static double error_of_watch(const Answer *answer)
{
    OstWatchedValue *values = NULL;
    assert_success(ost_watch_evaluate_all(answer->scene, answer->result, &values));
    const double error = values[0].error;
    OST_FREE(values);
    return error;
}

/* With factors, which do not depend on the partition, the estimate is that of one rank. */
static void ranks_agree(void **state)
{
    static const char text[] = CUBE JUMPS HELD HEAVY FINE
        "solver: {method: direct}\nwatch: {corner: {displacement: {nearest: [1, 1, 1]}, component: y}}\n";
    OstContext *const world = ctx;
    for (int order = 1; order <= 2; order++) {
        Answer shared = solve(text, order, 0);
        const double found = ost_result_answer_error(shared.result)->energy_norm, corner = error_of_watch(&shared);
        release(&shared);
        assert_int_equal(ost_context_create(MPI_COMM_SELF, &ctx), OST_SUCCESS);
        ost_log_set_level(ctx, OST_LOG_QUIET);
        Answer alone = solve(text, order, 0);
        const double expected = ost_result_answer_error(alone.result)->energy_norm;
        const double same_corner = error_of_watch(&alone);
        release(&alone);
        ost_context_destroy(&ctx);
        ctx = world;
        assert_close(found, expected, 1e-6 * expected);
        assert_true(same_corner != 0.0);
        /* a product of two answers in the added functions, in single precision: its sums depend on their order */
        assert_close(corner, same_corner, 1e-5 * fabs(same_corner));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(true_errors_are_estimated),
    cmocka_unit_test(multigrid_over_vertices_that_turn_finds_the_error_as_well),
    cmocka_unit_test(errors_of_watches_are_estimated),
    cmocka_unit_test(errors_of_reactions_across_fibres_are_estimated),
    cmocka_unit_test(errors_of_mean_stresses_are_estimated),
    cmocka_unit_test(energy_errors_have_a_sign),
    cmocka_unit_test(large_rotations_are_estimated),
    cmocka_unit_test(exact_answers_have_no_error),
    cmocka_unit_test(shares_add_up),
    cmocka_unit_test(ranks_agree),
};

OST_TEST_MAIN(tests)
