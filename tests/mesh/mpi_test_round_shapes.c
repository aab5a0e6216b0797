/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"
#include "orthostat/refine.h"
#include "piece_checks.h"

static const OstSectorShape quarter = {2, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 90.0, 4, 2, 3};
static const OstOctantShape eighth = {{0.5, -1.0, 2.0}, {3.0, 9.0}, 3, 5};

static const OstBoundary *boundary_named(const OstMesh *mesh, const char *name)
{
    const int b = ost_mesh_find_boundary(mesh, name);
    assert_true(b >= 0);
    return &mesh->boundaries[b];
}

/* All nodes of a boundary have this coordinate, exactly. */
static void assert_in_plane(const OstMesh *mesh, const char *name, int direction, double value)
{
    const OstBoundary *boundary = boundary_named(mesh, name);
    assert_true(sum_over_ranks(boundary->count) > 0);
    for (OstLocal i = 0; i < boundary->count * boundary->nodes_per_item; i++)
        assert_close(mesh->coordinates[3 * boundary->nodes[i] + direction], value, 0.0);
}

static void a_sector_has_the_volume_of_its_polygon(void **state)
{
    const double angles[] = {15.0, 90.0, 100.0, 270.0, 359.0};
    for (int i = 0; i < 5; i++) {
        OstSectorShape shape = quarter;
        shape.angle = angles[i];
        OstMesh *mesh = mesh_of_sector(ctx, &shape);
        check_piece(mesh);
        assert_int_equal(mesh->global_nodes, 5 * 3 * 4);
        assert_int_equal(mesh->global_tets, 6 * 4 * 2 * 3);
        const double step = shape.angle / 4.0 * M_PI / 180.0;
        assert_close(total_volume(mesh), 4.0 * 0.5 * sin(step) * (1.5 * 1.5 - 0.9 * 0.9) * 2.0, 1e-12);
        ost_mesh_destroy(&mesh);
    }
}

static void a_quarters_boundaries_lie_in_planes_and_on_circles(void **state)
{
    OstMesh *mesh = mesh_of_sector(ctx, &quarter); /* about z: angles from y to x, as the tube's */
    double vector[3];
    assert_in_plane(mesh, "bottom", 2, 2.0);
    assert_in_plane(mesh, "top", 2, 4.0);
    assert_in_plane(mesh, "start", 0, 0.5);
    assert_in_plane(mesh, "finish", 1, -1.0);
    assert_close(boundary_area(mesh, "start", vector), 1.2, 1e-14);
    assert_close(vector[0], -1.2, 1e-14);
    assert_close(boundary_area(mesh, "finish", vector), 1.2, 1e-14);
    assert_close(vector[1], -1.2, 1e-14);
    assert_close(boundary_area(mesh, "bottom", vector), 2.0 * sin(M_PI / 8.0) * (1.5 * 1.5 - 0.9 * 0.9), 1e-14);
    assert_close(boundary_area(mesh, "outer", vector), 4.0 * 2.0 * sin(M_PI / 16.0) * 1.5 * 2.0, 1e-13);
    surface_area(mesh, vector);
    for (int d = 0; d < 3; d++)
        assert_close(vector[d], 0.0, 1e-13);
    for (int side = 0; side < 2; side++) {
        const OstBoundary *boundary = boundary_named(mesh, side == 0 ? "inner" : "outer");
        for (OstLocal i = 0; i < 3 * boundary->count; i++) {
            const double *x = mesh->coordinates + 3 * boundary->nodes[i];
            assert_close(hypot(x[0] - 0.5, x[1] + 1.0), quarter.radii[side], 1e-15);
        }
    }
    ost_mesh_destroy(&mesh);
}

static void impossible_sectors_are_refused(void **state)
{
    OstMeshChunk *chunk = NULL;
    OstSectorShape shape = quarter;
    shape.angle = 360.0;
    assert_failure(ost_chunk_create_sector(ctx, &shape, &chunk), OST_INVALID_INPUT, "angle is 360 degrees");
    shape.angle = 270.0;
    shape.around = 1;
    assert_failure(ost_chunk_create_sector(ctx, &shape, &chunk), OST_INVALID_INPUT, "steps of 270 degrees");
    shape.around = 0;
    assert_failure(ost_chunk_create_sector(ctx, &shape, &chunk), OST_INVALID_INPUT, "0 divisions around");
    shape = quarter;
    shape.radii[0] = 1.5;
    assert_failure(ost_chunk_create_sector(ctx, &shape, &chunk), OST_INVALID_INPUT, "radii are [1.5, 1.5]");
    assert_null(chunk);
}

static void an_octant_has_its_counts_and_sides(void **state)
{
    const OstLocal sizes[] = {1, 2, 5};
    double vector[3];
    for (int s = 0; s < 3; s++) {
        OstOctantShape shape = eighth;
        const OstLocal n = shape.around = sizes[s];
        OstMesh *mesh = mesh_of_octant(ctx, &shape);
        check_piece(mesh);
        assert_int_equal(mesh->global_nodes, (3 * n * n + 3 * n + 1) * 6);
        assert_int_equal(mesh->global_tets, 3 * n * n * 5 * 6);
        assert_string_equal(mesh->regions.name[0], "shell");
        assert_in_plane(mesh, "xmin", 0, 0.5);
        assert_in_plane(mesh, "ymin", 1, -1.0);
        assert_in_plane(mesh, "zmin", 2, 2.0);
        /* A quarter ring in 2 n equal angles. */
        const double ring = 2.0 * n * 0.5 * sin(M_PI_4 / n) * (81.0 - 9.0);
        const char *planes[] = {"xmin", "ymin", "zmin"};
        for (int d = 0; d < 3; d++) {
            assert_close(boundary_area(mesh, planes[d], vector), ring, 1e-12);
            assert_close(vector[d], -ring, 1e-12);
        }
        double sides = 3.0 * ring + boundary_area(mesh, "inner", vector) + boundary_area(mesh, "outer", vector);
        assert_close(surface_area(mesh, vector), sides, 1e-11); /* and nothing else is on the surface */
        for (int d = 0; d < 3; d++)
            assert_close(vector[d], 0.0, 1e-12);
        ost_mesh_destroy(&mesh);
    }
}

static void an_octants_spheres_are_spheres(void **state)
{
    OstMesh *mesh = mesh_of_octant(ctx, &eighth);
    for (int side = 0; side < 2; side++) {
        const OstBoundary *boundary = boundary_named(mesh, side == 0 ? "inner" : "outer");
        for (OstLocal i = 0; i < 3 * boundary->count; i++) {
            const double *x = mesh->coordinates + 3 * boundary->nodes[i];
            assert_close(sqrt(pow(x[0] - 0.5, 2) + pow(x[1] + 1.0, 2) + pow(x[2] - 2.0, 2)), eighth.radii[side], 1e-14);
        }
    }
    ost_mesh_destroy(&mesh);
}

static void octants_converge_to_the_spheres_volume_and_stay_well_shaped(void **state)
{
    const double exact = M_PI / 6.0 * (729.0 - 27.0);
    const double centre[3] = {0.5, -1.0, 2.0};
    const OstShapeSurface sphere = ost_shape_surface_sphere(centre);
    OstOctantShape shape = eighth;
    shape.around = 2;
    shape.radial = 3;
    OstMesh *mesh = mesh_of_octant(ctx, &shape);
    double before = exact - total_volume(mesh);
    double vector[3];
    const double quality = worst_quality(mesh);
    for (int level = 0; level < 3; level++) {
        OstMesh *fine = NULL;
        assert_success(ost_mesh_refine(mesh, &sphere, &fine));
        check_piece(fine);
        ost_mesh_destroy(&mesh);
        mesh = fine;
        const double after = exact - total_volume(mesh);
        assert_close(log2(before / after), 2.0, 0.1);
        before = after;
        assert_true(worst_quality(mesh) > 0.6 * quality);
        assert_in_plane(mesh, "xmin", 0, 0.5);
        assert_in_plane(mesh, "ymin", 1, -1.0);
        assert_in_plane(mesh, "zmin", 2, 2.0);
    }
    assert_close(boundary_area(mesh, "outer", vector) / (M_PI_2 * 81.0), 1.0, 1e-2);
    assert_close(boundary_area(mesh, "inner", vector) / (M_PI_2 * 9.0), 1.0, 1e-2);
    ost_mesh_destroy(&mesh);
}

static void a_curved_octants_volume_converges_with_order_four(void **state)
{
    const double exact = M_PI / 6.0 * (729.0 - 27.0);
    const OstShapeSurface sphere = ost_shape_surface_sphere(eighth.centre);
    double error[2];
    for (int level = 0; level < 2; level++) {
        OstOctantShape shape = eighth;
        shape.around = 3 << level;
        shape.radial = 3 << level;
        OstMesh *linear = mesh_of_octant(ctx, &shape);
        OstMesh *quadratic = NULL;
        assert_success(ost_mesh_raise(linear, &sphere, &quadratic));
        error[level] = fabs(curved_volume(quadratic) - exact) / exact;
        ost_mesh_destroy(&quadratic);
        ost_mesh_destroy(&linear);
    }
    assert_true(log2(error[0] / error[1]) > 3.8);
}

static void sectors_refine_onto_their_circles(void **state)
{
    const double exact = M_PI_4 * (1.5 * 1.5 - 0.9 * 0.9) * 2.0;
    OstTubeShape tube = {2, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 16, 2, 3};
    const OstShapeSurface surface = ost_shape_surface_tube(&tube);
    OstMesh *mesh = mesh_of_sector(ctx, &quarter);
    OstMesh *fine = NULL;
    const double before = exact - total_volume(mesh);
    assert_success(ost_mesh_refine(mesh, &surface, &fine));
    check_piece(fine);
    assert_close(log2(before / (exact - total_volume(fine))), 2.0, 0.05);
    assert_in_plane(fine, "start", 0, 0.5);
    assert_in_plane(fine, "finish", 1, -1.0);
    ost_mesh_destroy(&fine);
    ost_mesh_destroy(&mesh);
}

static void impossible_octants_are_refused(void **state)
{
    OstMeshChunk *chunk = NULL;
    OstOctantShape shape = eighth;
    shape.around = 0;
    assert_failure(ost_chunk_create_octant(ctx, &shape, &chunk), OST_INVALID_INPUT, "0 divisions around");
    shape = eighth;
    shape.radii[0] = -1.0;
    assert_failure(ost_chunk_create_octant(ctx, &shape, &chunk), OST_INVALID_INPUT, "radii are [-1, 9]");
    shape = eighth;
    shape.around = INT32_MAX;
    shape.radial = INT32_MAX;
    assert_failure(ost_chunk_create_octant(ctx, &shape, &chunk), OST_LIMIT_EXCEEDED, "64-bit");
    assert_null(chunk);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_sector_has_the_volume_of_its_polygon),
    cmocka_unit_test(a_quarters_boundaries_lie_in_planes_and_on_circles),
    cmocka_unit_test(impossible_sectors_are_refused),
    cmocka_unit_test(sectors_refine_onto_their_circles),
    cmocka_unit_test(an_octant_has_its_counts_and_sides),
    cmocka_unit_test(an_octants_spheres_are_spheres),
    cmocka_unit_test(octants_converge_to_the_spheres_volume_and_stay_well_shaped),
    cmocka_unit_test(a_curved_octants_volume_converges_with_order_four),
    cmocka_unit_test(impossible_octants_are_refused),
};

OST_TEST_MAIN(tests)
