/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"

static OstMesh *tube_mesh(const OstTubeShape *shape)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_tube(ctx, shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_null(chunk);
    return mesh;
}

static OstMesh *block_mesh(const OstBlockShape *shape)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_block(ctx, shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    return mesh;
}

static void the_papers_tube_has_its_counts(void **state)
{
    OstMesh *mesh = tube_mesh(&paper_tube);
    assert_int_equal(mesh->global_nodes, 25620); /* Li and Barbič, sec. 5 */
    assert_int_equal(mesh->global_tets, 129600);
    assert_int_equal(mesh->node_count, 25620);
    assert_int_equal(mesh->owned_tets, 129600);
    assert_int_equal(mesh->nodes_per_tet, 4);
    assert_int_equal(ost_mesh_find_region(mesh, "tube"), 0);
    assert_int_equal(ost_mesh_find_region(mesh, "block"), -1);
    ost_mesh_destroy(&mesh);
    assert_null(mesh);
}

static void tube_nodes_lie_where_their_labels_say(void **state)
{
    OstMesh *mesh = tube_mesh(&paper_tube);
    const OstGlobal labels[] = {1, 7, 8, 420, 421, 12601, 13013, 17777, 25200, 25201, 25620};
    for (size_t s = 0; s < sizeof labels / sizeof *labels; s++) {
        const OstGlobal n = labels[s] - 1;
        const double k = (double)(n / 420);
        const double angle = 2.0 * M_PI * (double)(n / 7 % 60) / 60.0;
        const double r = 0.9 + 0.1 * (double)(n % 7);
        assert_int_equal(mesh->node_label[n], labels[s]);
        assert_close(mesh->coordinates[3 * n], r * cos(angle), 1e-14);
        assert_close(mesh->coordinates[3 * n + 1], 10.0 * k / 60.0, 1e-14);
        assert_close(mesh->coordinates[3 * n + 2], r * sin(angle), 1e-14);
    }
    /* (k, j, i) = (30, 58, 6), where the case pulls: half height, outside. */
    assert_close(mesh->coordinates[3 * 13012 + 1], 5.0, 0.0);
    assert_close(hypot(mesh->coordinates[3 * 13012], mesh->coordinates[3 * 13012 + 2]), 1.5, 1e-15);
    ost_mesh_destroy(&mesh);
}

/* The division that the reference results were computed with: from corner 000 along the six orders of the directions,
 * the second and last vertices swapped where the tet would be inverted. */
static void a_hex_is_divided_along_its_diagonal(void **state)
{
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    OstMesh *mesh = tube_mesh(&paper_tube);
    const OstLocal cell = (17 * 60 + 59) * 6 + 4; /* k = 17, j = 59 (the next is 0), i = 4 */
    for (int t = 0; t < 6; t++) {
        OstLocal expected[4];
        int step[3] = {0, 0, 0};
        for (int v = 0; v < 4; v++) {
            if (v > 0)
                step[order[t][v - 1]] = 1;
            expected[v] = ((17 + step[0]) * 60 + (59 + step[1]) % 60) * 7 + 4 + step[2];
        }
        if (ost_tet_volume(mesh->coordinates, expected) < 0.0) {
            const OstLocal second = expected[1];
            expected[1] = expected[3];
            expected[3] = second;
        }
        assert_memory_equal(mesh->tet_nodes + 4 * (6 * cell + t), expected, sizeof expected);
        assert_int_equal(mesh->tet_label[6 * cell + t], 6 * cell + t + 1);
    }
    ost_mesh_destroy(&mesh);
}

static void the_tubes_volume_is_that_of_a_polygonal_ring(void **state)
{
    const OstTubeShape coarsest = {1, {0.0, 0.0, 0.0}, 2.0, {0.5, 1.0}, 3, 1, 1};
    OstMesh *mesh = tube_mesh(&paper_tube);
    assert_close(total_volume(mesh) / tube_volume(&paper_tube), 1.0, 1e-12);
    ost_mesh_destroy(&mesh);
    mesh = tube_mesh(&coarsest);
    assert_close(total_volume(mesh) / tube_volume(&coarsest), 1.0, 1e-12);
    ost_mesh_destroy(&mesh);
}

static void tube_boundaries_have_their_areas_and_point_outwards(void **state)
{
    OstMesh *mesh = tube_mesh(&paper_tube);
    const double ring = tube_volume(&paper_tube) / 10.0;
    const double around = 2.0 * 60.0 * sin(M_PI / 60.0) * 10.0; /* wall of a 60-gon prism of radius 1 */
    double vector[3];
    assert_close(boundary_area(mesh, "bottom", vector), ring, 1e-11);
    assert_close(vector[1], -ring, 1e-11);
    assert_close(boundary_area(mesh, "top", vector), ring, 1e-11);
    assert_close(vector[1], ring, 1e-11);
    assert_close(boundary_area(mesh, "ends", vector), 2.0 * ring, 1e-11);
    assert_close(boundary_area(mesh, "inner", vector), 0.9 * around, 1e-10);
    assert_close(boundary_area(mesh, "outer", vector), 1.5 * around, 1e-10);
    const OstBoundary *outer = &mesh->boundaries[ost_mesh_find_boundary(mesh, "outer")];
    for (OstLocal i = 0; i < outer->count; i++) {
        const OstGlobal *nodes = outer->nodes + 3 * i;
        area_vector(mesh, nodes, vector);
        const double *x = mesh->coordinates + 3 * nodes[0];
        assert_true(x[0] * vector[0] + x[2] * vector[2] > 0.0);
    }
    ost_mesh_destroy(&mesh);
}

static void the_tubes_surface_is_closed_and_outward(void **state)
{
    OstMesh *mesh = tube_mesh(&paper_tube);
    OstSurface *surface = NULL;
    assert_success(ost_surface_create(mesh, NULL, &surface));
    assert_int_equal(surface->count, 2 * (2 * 60 * 6 + 2 * 60 * 60)); /* tube.veg.obj's 15,840 - faces */
    double flux = 0.0;                                                /* ∫ x·n dA = 3 V (divergence theorem) */
    for (OstLocal i = 0; i < surface->count; i++) {
        const OstLocal *f = surface->nodes + 3 * i;
        const OstGlobal nodes[3] = {f[0], f[1], f[2]};
        double area[3];
        area_vector(mesh, nodes, area);
        for (int d = 0; d < 3; d++)
            flux += mesh->coordinates[3 * f[0] + d] * area[d];
    }
    assert_close(flux / (3.0 * tube_volume(&paper_tube)), 1.0, 1e-12);
    ost_surface_destroy(&surface);
    ost_mesh_destroy(&mesh);
}

static void another_axis_turns_the_tube_cyclically(void **state)
{
    OstTubeShape shape = {1, {0.1, 0.2, 0.3}, 2.0, {0.5, 1.0}, 7, 2, 3};
    OstMesh *along_y = tube_mesh(&shape);
    for (int axis = 0; axis < 3; axis++) {
        shape.axis = axis;
        for (int d = 0; d < 3; d++) /* the origin turns along */
            shape.origin[(d + axis + 2) % 3] = 0.1 * (d + 1);
        OstMesh *mesh = tube_mesh(&shape);
        for (OstLocal i = 0; i < mesh->node_count; i++)
            for (int d = 0; d < 3; d++)
                assert_close(mesh->coordinates[3 * i + (d + axis + 2) % 3], along_y->coordinates[3 * i + d], 1e-15);
        assert_close(total_volume(mesh) / tube_volume(&shape), 1.0, 1e-12);
        ost_mesh_destroy(&mesh);
    }
    ost_mesh_destroy(&along_y);
}

static void a_block_has_its_volume_nodes_and_sides(void **state)
{
    const OstBlockShape shape = {{1.0, -2.0, 0.5}, {3.0, 0.7, 1.1}, {4, 3, 2}};
    OstMesh *mesh = block_mesh(&shape);
    assert_int_equal(mesh->node_count, 5 * 4 * 3);
    assert_int_equal(mesh->tet_count, 4 * 3 * 2 * 6);
    assert_close(total_volume(mesh), 3.0 * 0.7 * 1.1, 1e-14);
    const OstLocal n = (3 * 4 + 2) * 3 + 1; /* (a, b, c) = (3, 2, 1) */
    assert_int_equal(mesh->node_label[n], n + 1);
    assert_close(mesh->coordinates[3 * n], 1.0 + 3.0 * 3 / 4, 1e-15);
    assert_close(mesh->coordinates[3 * n + 1], -2.0 + 0.7 * 2 / 3, 1e-15);
    assert_close(mesh->coordinates[3 * n + 2], 0.5 + 1.1 * 1 / 2, 1e-15);
    const char *names[3][2] = {{"xmin", "xmax"}, {"ymin", "ymax"}, {"zmin", "zmax"}};
    for (int d = 0; d < 3; d++) {
        const double area = shape.size[(d + 1) % 3] * shape.size[(d + 2) % 3];
        double vector[3];
        assert_close(boundary_area(mesh, names[d][0], vector), area, 1e-14);
        assert_close(vector[d], -area, 1e-14);
        assert_close(boundary_area(mesh, names[d][1], vector), area, 1e-14);
        assert_close(vector[d], area, 1e-14);
    }
    ost_mesh_destroy(&mesh);
}

static void bounds_and_centroids_are_those_of_the_block(void **state)
{
    const OstBlockShape shape = {{1.0, -2.0, 0.5}, {3.0, 0.7, 1.1}, {4, 3, 2}};
    OstMesh *mesh = block_mesh(&shape);
    double low[3];
    double high[3];
    double *centroids = malloc(3 * (size_t)mesh->tet_count * sizeof *centroids);
    double moment[3] = {0.0, 0.0, 0.0};
    assert_success(ost_mesh_bounds(mesh, low, high));
    assert_success(ost_mesh_tet_centroids(mesh, centroids));
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int d = 0; d < 3; d++)
            moment[d] += centroids[3 * t + d] * ost_tet_volume(mesh->coordinates, mesh->tet_nodes + 4 * t);
    for (int d = 0; d < 3; d++) {
        assert_close(low[d], shape.origin[d], 0.0);
        assert_close(high[d], shape.origin[d] + shape.size[d], 1e-15);
        assert_close(moment[d] / total_volume(mesh), shape.origin[d] + 0.5 * shape.size[d], 1e-14);
    }
    free(centroids);
    ost_mesh_destroy(&mesh);
}

static void a_regular_tet_has_quality_1(void **state)
{
    const double x[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    const OstLocal right[] = {0, 1, 2, 3};
    const OstLocal left[] = {0, 1, 3, 2};
    const double volume = ost_tet_volume(x, right);
    assert_close(fabs(volume), 8.0 / 3.0, 1e-15);
    assert_close(fabs(ost_tet_quality(x, right)), 1.0, 1e-15);
    assert_close(ost_tet_quality(x, left), -ost_tet_quality(x, right), 1e-15);
}

static void bad_shapes_are_refused(void **state)
{
    OstMeshChunk *chunk = NULL;
    OstTubeShape tube = paper_tube;
    tube.radii[0] = 1.5;
    assert_failure(ost_chunk_create_tube(ctx, &tube, &chunk), OST_INVALID_INPUT, "radii are [1.5, 1.5]");
    assert_null(chunk);
    tube = paper_tube;
    tube.length = NAN;
    assert_failure(ost_chunk_create_tube(ctx, &tube, &chunk), OST_INVALID_INPUT, "length is nan");
    tube = paper_tube;
    tube.around = 2;
    assert_failure(ost_chunk_create_tube(ctx, &tube, &chunk), OST_INVALID_INPUT, "at least 3");
    tube = paper_tube;
    tube.radial = 0;
    assert_failure(ost_chunk_create_tube(ctx, &tube, &chunk), OST_INVALID_INPUT, "0 radial");
    OstBlockShape block = {{0.0, 0.0, 0.0}, {1.0, -1.0, 1.0}, {1, 1, 1}};
    assert_failure(ost_chunk_create_block(ctx, &block, &chunk), OST_INVALID_INPUT, "size along y is -1");
    block.size[1] = 1.0;
    block.divisions[2] = 0;
    assert_failure(ost_chunk_create_block(ctx, &block, &chunk), OST_INVALID_INPUT, "0 divisions along z");
}

static void too_many_cells_are_refused_before_anything_is_allocated(void **state)
{
    OstMeshChunk *chunk = NULL;
    OstBlockShape block = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2000, 2000, 2000}};
    assert_failure(ost_chunk_create_block(ctx, &block, &chunk), OST_LIMIT_EXCEEDED, "8000000000 cells on 1 rank are");
    for (int d = 0; d < 3; d++)
        block.divisions[d] = INT32_MAX;
    assert_failure(ost_chunk_create_block(ctx, &block, &chunk), OST_LIMIT_EXCEEDED, "64-bit");
    assert_true(ost_ledger_bytes(ctx) == 0);
}

static void names_are_listed_in_one_line(void **state)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {1, 1, 1}};
    OstMesh *mesh = block_mesh(&shape);
    char text[64];
    char little[12];
    ost_names_list(&mesh->regions, text, sizeof text);
    assert_string_equal(text, "block");
    ost_mesh_list_boundaries(mesh, text, sizeof text);
    assert_string_equal(text, "xmin, xmax, ymin, ymax, zmin, zmax");
    ost_mesh_list_boundaries(mesh, little, sizeof little);
    assert_string_equal(little, "xmin, xm...");
    assert_int_equal(ost_mesh_find_boundary(mesh, "ymax"), 3);
    assert_int_equal(ost_mesh_find_boundary(mesh, "Ymax"), -1);
    ost_mesh_destroy(&mesh);
}

/* The authors' surface mesh lists all vertices of the tube, to six digits. Skipped where it is not to be had. */
static void the_tube_is_the_authors_tube(void **state)
{
    char path[4096];
    const char *source = getenv("ORTHOSTAT_SOURCE");
    snprintf(path, sizeof path, "%s/../shared/data/tube/tube.veg.obj", source ? source : ".");
    FILE *file = fopen(path, "r");
    if (!file)
        skip();
    OstMesh *mesh = tube_mesh(&paper_tube);
    char line[256];
    OstLocal n = 0;
    while (fgets(line, sizeof line, file)) {
        double x[3];
        if (sscanf(line, "v %lf %lf %lf", &x[0], &x[1], &x[2]) != 3)
            continue;
        for (int d = 0; d < 3 && n < mesh->node_count; d++)
            assert_close(mesh->coordinates[3 * n + d], x[d], 5e-6);
        n++;
    }
    fclose(file);
    assert_int_equal(n, 25620);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_papers_tube_has_its_counts),
    cmocka_unit_test(tube_nodes_lie_where_their_labels_say),
    cmocka_unit_test(a_hex_is_divided_along_its_diagonal),
    cmocka_unit_test(the_tubes_volume_is_that_of_a_polygonal_ring),
    cmocka_unit_test(tube_boundaries_have_their_areas_and_point_outwards),
    cmocka_unit_test(the_tubes_surface_is_closed_and_outward),
    cmocka_unit_test(another_axis_turns_the_tube_cyclically),
    cmocka_unit_test(a_block_has_its_volume_nodes_and_sides),
    cmocka_unit_test(bounds_and_centroids_are_those_of_the_block),
    cmocka_unit_test(a_regular_tet_has_quality_1),
    cmocka_unit_test(bad_shapes_are_refused),
    cmocka_unit_test(too_many_cells_are_refused_before_anything_is_allocated),
    cmocka_unit_test(names_are_listed_in_one_line),
    cmocka_unit_test(the_tube_is_the_authors_tube),
};

OST_TEST_MAIN(tests)
