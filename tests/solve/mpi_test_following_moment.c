/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"
#include "core/memory.h"
#include "problem/scene_data.h"

/* A strip along x, clamped at x = 0, that an end moment bends. The moment is made by pressures p and -p on the two
 * halves of the end's face, which follow it. They act on a stiff cap, so that the face stays plane: a face that warps
 * makes a transverse force of the order p² / E out of them, which bends a long strip as much as the moment. The rim of
 * each half is free: the load has no work function. */
static const double length = 20.0, height = 0.5, width = 0.5, modulus = 1e6;

enum { DIVISIONS = 24 };

/* The tets beyond x = length become the region 'cap'. */
static void add_cap(OstMeshChunk *chunk)
{
    char **names = NULL;
    assert_success(OST_NEW(ctx, &names, 2));
    names[0] = chunk->regions.name[0];
    assert_success(ost_copy_string(ctx, "cap", &names[1]));
    OST_FREE(chunk->regions.name);
    chunk->regions = (OstNames){2, names};
    for (OstLocal t = 0; t < chunk->tet_count; t++) /* six tets a hex, two hexes high, along x last */
        chunk->tet_region[t] = chunk->first_tet + t >= 12 * DIVISIONS;
}

/* The displacement at (length, 0, height / 2). */
static void end_of(const OstResult *result, double found[3])
{
    const OstMesh *mesh = result->mesh;
    memset(found, 0, 3 * sizeof *found);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *at = mesh->coordinates + 3 * node;
        if (fabs(at[0] - length) + fabs(at[1]) + fabs(at[2] - 0.5 * height) < 1e-9)
            memcpy(found, result->displacement + 3 * node, 3 * sizeof *found);
    }
    MPI_Allreduce(MPI_IN_PLACE, found, 3, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
}

/* Bends the strip by an angle. */
static void bend(double angle, OstCase **c, OstScene **scene, OstResult **result)
{
    const double cap = length / DIVISIONS, end = length + cap;
    const double moment = angle * modulus * width * height * height * height / 12.0 / length;
    const double pressure = moment / (0.25 * width * height * height);
    OstMeshChunk *chunk = NULL;
    char text[1024];
    snprintf(text, sizeof text,
             "mesh: {block: {size: [%.17g, %g, %g], divisions: [%d, 1, 2]}}\nelement: {order: 2}\n"
             "materials:\n  - {region: block, youngs_modulus: %g, poissons_ratio: 0}\n"
             "  - {region: cap, youngs_modulus: %g, poissons_ratio: 0}\n"
             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
             "loads:\n  - {on: {box: {min: [%g, -1, -1], max: [%g, 1, %g]}}, pressure: %.17g, follows: true}\n"
             "  - {on: {box: {min: [%g, -1, %g], max: [%g, 1, 1]}}, pressure: %.17g, follows: true}\n"
             "large_rotation: on\n",
             end, width, height, DIVISIONS + 1, modulus, 30.0 * modulus, end - 0.1 * cap, end + 0.1 * cap, 0.5 * height,
             pressure, end - 0.1 * cap, 0.5 * height, end + 0.1 * cap, -pressure);
    assert_success(read_text(text, c));
    assert_success(ost_chunk_create_block(ctx, &(*c)->block, &chunk));
    add_cap(chunk);
    assert_success(ost_scene_create_on(*c, &chunk, scene));
    assert_success(ost_scene_solve(*scene, result));
}

static void a_following_moment_bends_it_into_a_circle(void **state)
{
    static const double pi = 3.14159265358979323846;
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    double end[3];
    const double angle = ost_size(ctx) == 1 ? 2.0 * pi : 0.5 * pi, radius = length / angle; /* less on many: time */
    bend(angle, &c, &scene, &result);
    end_of(result, end);
    assert_string_equal(ost_result_status(result), "accepted");
    assert_close(end[0], radius * sin(angle) - length, 0.005 * length);
    assert_close(end[1], 0.0, 0.005 * length);
    assert_close(end[2], radius * (cos(angle) - 1.0), 0.005 * length);
    assert_true(ost_result_newton_report(result)->iterations < 250);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_following_moment_bends_it_into_a_circle),
};

OST_TEST_MAIN(tests)
