/* SPDX-License-Identifier: BSD-3-Clause */
#include "iterations.h"

#include "core/memory.h"

/* Inclusions that are far stiffer or softer than what is around them take about as many iterations as none, on any
 * number of ranks, without a factorisation. */

#define CUBE                                                                                     \
    "mesh: {block: {size: [1, 1, 1], divisions: [12, 12, 12]}}\n"                                \
    "constraints: [{on: {boundary: zmin}, displacement: [0, 0, 0]}]\n"                           \
    "loads: [{on: {boundary: zmax}, total_force: [0.003, 0, 0.01]}]\n"                           \
    "large_rotation: off\naccuracy: {algebraic_fraction: 0}\noutput: {fields: [displacement]}\n" \
    "solver: {factor_memory: 1e-6}\n"                                                            \
    "materials:\n"

#define EVEN CUBE "  - {region: block, youngs_modulus: 1, poissons_ratio: 0.3}\n"
#define FIBROUS                                                                  \
    CUBE "  - {region: block, youngs_modulus: [1, 1, 1e3], poissons_ratio: 0.3," \
         " axes: {euler: {degrees: [35, 50, 20]}}}\n"
#define CORE(modulus) "  - {region: core, youngs_modulus: " modulus ", poissons_ratio: 0.3}\n"

enum { CELLS = 12 };

typedef struct Cores {
    int period, width;
} Cores;

/* Hexes of a region `core`: width³ of them in each period³. */
static void add_core(OstMeshChunk *chunk, const void *cores)
{
    const int period = ((const Cores *)cores)->period, width = ((const Cores *)cores)->width;
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

static void contrast_takes_few_iterations(void **state)
{
    static const struct {
        const char *name, *text;
        int order;
        Cores cores;
        int most;
    } bodies[] = {
        {"64 inclusions, 1e9 times stiffer", EVEN CORE("1e9"), 1, {3, 2}, 40},
        {"216 of one cell, 1e9", EVEN CORE("1e9"), 1, {2, 1}, 50},
        {"216 of one cell, 1e6", EVEN CORE("1e6"), 1, {2, 1}, 25},
        {"8 of 4 cells, 1e9", EVEN CORE("1e9"), 1, {6, 4}, 40},
        {"27, 1e9 times softer", EVEN CORE("1e-9"), 1, {4, 2}, 25},
        {"8 of 4 cells in fibres, 1e6", FIBROUS CORE("1e6"), 1, {6, 4}, 25},
        {"8 of 4 cells in fibres, 1e6", FIBROUS CORE("1e6"), 2, {6, 4}, 30},
        {"64, 1e9 times stiffer", EVEN CORE("1e9"), 2, {3, 2}, 45},
        {"216 of one cell, 1e6", EVEN CORE("1e6"), 2, {2, 1}, 30},
        {"8 of 4 cells in fibres, 1e9", FIBROUS CORE("1e9"), 2, {6, 4}, 45},
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++)
        check_iterations(bodies[i].name, bodies[i].text, bodies[i].order, bodies[i].most, add_core, &bodies[i].cores);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(contrast_takes_few_iterations),
};

OST_TEST_MAIN(tests)
