/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "core/memory.h"
#include "orthostat/analysis.h"
#include "problem/scene_data.h"

/* Inclusions that are far stiffer or softer than what is around them take about as many iterations as none, on any
 * number of ranks, without a factorisation. */

#define CUBE                                                                                     \
    "mesh: {block: {size: [1, 1, 1], divisions: [12, 12, 12]}}\n"                                \
    "constraints: [{on: {boundary: zmin}, displacement: [0, 0, 0]}]\n"                           \
    "loads: [{on: {boundary: zmax}, total_force: [0.003, 0, 0.01]}]\n"                           \
    "large_rotation: off\naccuracy: {algebraic_fraction: 0}\noutput: {fields: [displacement]}\n" \
    "solver: {factor_memory: 1e-6}\n"                                                            \
    "materials:\n  - {region: block, youngs_modulus: 1, poissons_ratio: 0.3}\n"

#define CORE(modulus) "  - {region: core, youngs_modulus: " modulus ", poissons_ratio: 0.3}\n"

enum { CELLS = 12 };

/* Hexes of a region `core`: width³ of them in each period³. */
static void add_core(OstMeshChunk *chunk, int period, int width)
{
    assert_success(OST_RESIZE(ctx, &chunk->regions.name, 2));
    assert_success(ost_copy_string(ctx, "core", &chunk->regions.name[1]));
    chunk->regions.count = 2;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        OstGlobal hex = (chunk->first_tet + t) / 6;
        int inside = 1;
        for (int d = 0; d < 3; d++, hex /= CELLS) {
            const int at = (int)(hex % CELLS) % period - (period - width) / 2;
            inside &= at >= 0 && at < width;
        }
        chunk->tet_region[t] = inside;
    }
}

/* Iterations of all strategies. */
static int count_iterations(const char *text, int order, int period, int width)
{
    OstCase *c = NULL;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(read_text(text, &c));
    c->order = order;
    assert_success(ost_chunk_create_block(ctx, &c->block, &chunk));
    add_core(chunk, period, width);
    assert_success(ost_scene_create_on(c, &chunk, &scene));
    assert_success(ost_scene_solve(scene, &result));
    int iterations = 0;
    for (int k = 0; k < result->solve.steps; k++)
        iterations += result->solve.step[k].iterations;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return iterations;
}

static void contrast_takes_few_iterations(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text;
        int order, period, width, most;
    } bodies[] = {
        {"64 inclusions, 1e9 times stiffer", CUBE CORE("1e9"), 1, 3, 2, 40},
        {"216 of one cell, 1e9", CUBE CORE("1e9"), 1, 2, 1, 50},
        {"216 of one cell, 1e6", CUBE CORE("1e6"), 1, 2, 1, 25},
        {"8 of 4 cells, 1e9", CUBE CORE("1e9"), 1, 6, 4, 40},
        {"27, 1e9 times softer", CUBE CORE("1e-9"), 1, 4, 2, 25},
        {"64, 1e9 times stiffer", CUBE CORE("1e9"), 2, 3, 2, 45},
        {"216 of one cell, 1e6", CUBE CORE("1e6"), 2, 2, 1, 30},
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        const int found = count_iterations(bodies[i].text, bodies[i].order, bodies[i].period, bodies[i].width);
        if (ost_rank(ctx) == 0)
            print_message("%s, order %d: %d iterations\n", bodies[i].name, bodies[i].order, found);
        if (found > bodies[i].most)
            fail_msg("%s, order %d: %d iterations, expected at most %d", bodies[i].name, bodies[i].order, found,
                     bodies[i].most);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(contrast_takes_few_iterations),
};

OST_TEST_MAIN(tests)
