/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "core/parallel/reduce.h"
#include "run.h"

/* Bytes of our own arrays at the peak of a run from the mesh to the checked answer, over its unknowns; on all ranks. */
static double bytes_an_unknown(const char *fields)
{
    char text[2048];
    Run run = {0};
    double bytes;
    snprintf(
        text, sizeof text,
        "mesh: {tube: {axis: y, length: 10, radii: [0.9, 1.5], divisions: {around: 48, radial: 6, axial: 48}}}\n"
        "materials: [{region: all, youngs_modulus: [1e6, 1e9, 1e6], poissons_ratio: 0.3, shear_modulus: geometric,\n"
        "  axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}}]\n"
        "constraints: [{on: {boundary: ends}, displacement: [0, 0, 0]}]\n"
        "loads: [{on: {boundary: outer}, traction: [10, 0, 0]}]\n%s",
        fields);
    ost_ledger_restart_peak(ctx);
    const size_t before = ost_ledger_bytes(ctx);
    assert_success(read_text(text, &run.c));
    assert_success(ost_scene_create(run.c, &run.scene));
    assert_success(ost_scene_solve(run.scene, &run.result));
    bytes = (double)(ost_ledger_peak_bytes(ctx) - before);
    assert_success(ost_sum(ctx, 1, &bytes));
    bytes /= (double)ost_result_unknowns(run.result);
    if (ost_rank(ctx) == 0)
        print_message("%lld unknowns: %.0f bytes each\n", (long long)ost_result_unknowns(run.result), bytes);
    clear(&run);
    return bytes;
}

/* Ghosts add to it on more ranks: a tenth on four, of a body that is so small. */
static double shared(double alone)
{
    return alone * (1.0 + 0.05 * (ost_size(ctx) - 1));
}

static void an_unknown_takes_little_memory(void **state)
{
    assert_true(bytes_an_unknown("output: {fields: [displacement]}\n") < shared(860.0));
}

static void and_not_twice_as_much_where_errors_are_estimated(void **state)
{
    assert_true(bytes_an_unknown("") < shared(1450.0));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_unknown_takes_little_memory),
    cmocka_unit_test(and_not_twice_as_much_where_errors_are_estimated),
};

OST_TEST_MAIN(tests)
