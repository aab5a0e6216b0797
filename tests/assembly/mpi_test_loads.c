/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

/* Loads are right in total force and moment, and every face counts once on any number of ranks. */

enum { AROUND = 12 };
static const OstTubeShape tube_shape = {
    .axis = 1, .length = 2.0, .radii = {0.9, 1.5}, .around = AROUND, .radial = 2, .axial = 3};

static OstMesh *make_tube(OstContext *of)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_tube(of, &tube_shape, &chunk));
    assert_success(ost_mesh_distribute(of, &chunk, &mesh));
    return mesh;
}

/* Cross-section: a ring between two regular polygons. */
static double ring_area(void)
{
    const double per_square = 0.5 * AROUND * sin(2.0 * 3.14159265358979323846 / AROUND);
    return per_square * (1.5 * 1.5 - 0.9 * 0.9);
}

static void faces_of(const OstMesh *mesh, const char *name, OstLocal *count, OstLocal **faces)
{
    const OstBoundary *boundary = &mesh->boundaries[ost_mesh_find_boundary(mesh, name)];
    assert_int_equal(boundary->nodes_per_item, 3);
    *count = boundary->count;
    *faces = calloc(3 * (size_t)*count + 1, sizeof **faces);
    for (OstLocal i = 0; i < 3 * *count; i++)
        (*faces)[i] = (OstLocal)boundary->nodes[i];
}

static void assert_resultant(const OstMesh *mesh, const double *force, const double expected[6])
{
    double sum[6];
    resultant(mesh, force, sum);
    for (int i = 0; i < 6; i++)
        assert_close(sum[i], expected[i], 1e-12);
}

static void a_traction_has_the_force_and_moment_of_its_faces(void **state)
{
    OstMesh *mesh = make_tube(ctx);
    OstLocal count;
    OstLocal *faces;
    double area;
    const double traction[3] = {3.0, -1.0, 0.5};
    double *force = numbers(3 * (size_t)mesh->node_count);
    faces_of(mesh, "top", &count, &faces);
    assert_success(ost_faces_area(mesh, count, faces, 3, &area));
    assert_close(area, ring_area(), 1e-12);
    assert_success(ost_load_traction(mesh, count, faces, 3, traction, force));
    /* the ring's centre is (0, 2, 0): moment (0, 2, 0) × traction */
    const double expected[6] = {3.0 * area, -area, 0.5 * area, area, 0.0, -6.0 * area};
    assert_resultant(mesh, force, expected);
    free(faces);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void a_pressure_pushes_inwards(void **state)
{
    OstMesh *mesh = make_tube(ctx);
    OstLocal count;
    OstLocal *faces;
    double *force = numbers(3 * (size_t)mesh->node_count);
    faces_of(mesh, "top", &count, &faces);
    assert_success(ost_load_pressure(mesh, count, faces, 3, 2.5, force));
    const double expected[6] = {0.0, -2.5 * ring_area(), 0.0, 0.0, 0.0, 0.0};
    assert_resultant(mesh, force, expected);
    free(faces);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void pressure_all_around_is_in_balance(void **state)
{
    OstMesh *mesh = make_body(ctx);
    OstSurface *surface = NULL;
    double area;
    double *force = numbers(3 * (size_t)mesh->node_count);
    const double none[6] = {0};
    assert_success(ost_surface_create(mesh, NULL, &surface));
    assert_success(ost_faces_area(mesh, surface->count, surface->nodes, 3, &area));
    assert_close(area, 2.0 * (2.0 * 1.5 + 1.5 * 1.2 + 1.2 * 2.0), 1e-12);
    assert_success(ost_load_pressure(mesh, surface->count, surface->nodes, 3, 7.0, force));
    assert_true(largest(ctx, 3 * mesh->owned_nodes, force) > 0.1);
    assert_resultant(mesh, force, none);
    ost_surface_destroy(&surface);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void gravity_weighs_the_polygonal_tube(void **state)
{
    OstMesh *mesh = make_tube(ctx);
    const OstMaterial material = make_material(ctx, 0); /* density 3 */
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    const double down[3] = {0.0, 0.0, -9.81};
    const double mass = 3.0 * ring_area() * 2.0;
    double *force = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_load_gravity(mesh, field, -1, down, force));
    /* about the origin, the middle of the tube being at (0, 1, 0) */
    const double expected[6] = {0.0, 0.0, -9.81 * mass, -9.81 * mass, 0.0, 0.0};
    assert_resultant(mesh, force, expected);
    free(force);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static void a_body_force_acts_on_its_region(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const double volume = size_of_body[0] * size_of_body[1] * size_of_body[2];
    const double push[3] = {2.0, 0.0, 0.0};
    double sum[6];
    double *force = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_load_body_force(mesh, 1, push, force)); /* no tet is of region 1 */
    resultant(mesh, force, sum);
    assert_close(sum[0], 0.0, 0.0);
    assert_success(ost_load_body_force(mesh, 0, push, force));
    resultant(mesh, force, sum);
    assert_close(sum[0], 2.0 * volume, 1e-12);
    free(force);
    ost_mesh_destroy(&mesh);
}

/* All local nodes are passed, ghosts too: each is counted by its owner. */
static void a_total_force_is_shared_equally(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const double total[3] = {10.0, -20.0, 30.0};
    double *force = numbers(3 * (size_t)mesh->node_count);
    OstLocal *nodes = calloc((size_t)mesh->node_count, sizeof *nodes);
    OstLocal count = 0;
    for (OstLocal node = 0; node < mesh->node_count; node++)
        if (mesh->coordinates[3 * node] < 1e-12)
            nodes[count++] = node;
    assert_success(ost_load_shared_force(mesh, count, nodes, total, force));
    const double share = 1.0 / ((NY + 1) * (NZ + 1));
    for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
        assert_close(force[i], mesh->coordinates[i / 3 * 3] < 1e-12 ? share * total[i % 3] : 0.0, 1e-14);
    assert_failure(ost_load_shared_force(mesh, 0, nodes, total, force), OST_INVALID_INPUT, "none is selected");
    free(nodes);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void point_forces_add_up(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const double each[3] = {1.0, 2.0, 3.0};
    double *force = numbers(3 * (size_t)mesh->node_count);
    OstLocal *nodes = calloc((size_t)mesh->node_count, sizeof *nodes);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        nodes[node] = node;
    for (int twice = 0; twice < 2; twice++)
        assert_success(ost_load_point_force(mesh, mesh->node_count, nodes, each, force));
    for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
        assert_close(force[i], 2.0 * each[i % 3], 0.0);
    free(nodes);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void faces_of_another_kind_are_refused(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const double traction[3] = {1.0, 0.0, 0.0};
    double area;
    double *force = numbers(3 * (size_t)mesh->node_count);
    assert_failure(ost_load_traction(mesh, 0, NULL, 6, traction, force), OST_INVALID_INPUT, "faces of 6 nodes");
    assert_failure(ost_faces_area(mesh, 0, NULL, 6, &area), OST_INVALID_INPUT, "faces of 6 nodes");
    free(force);
    ost_mesh_destroy(&mesh);
}

/* Every load at once, by label, on this many ranks and on one. */
static void ranks_agree_with_one_rank(void **state)
{
    double *loads[2];
    OstContext *alone = NULL;
    const double vector[3] = {1.0, -2.0, 3.0};
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    for (int one = 0; one < 2; one++) {
        OstMesh *mesh = make_tube(one ? alone : ctx);
        OstLocal count;
        OstLocal *faces;
        double *force = numbers(3 * (size_t)mesh->node_count);
        faces_of(mesh, "outer", &count, &faces);
        assert_success(ost_load_traction(mesh, count, faces, 3, vector, force));
        assert_success(ost_load_pressure(mesh, count, faces, 3, 5.0, force));
        assert_success(ost_load_body_force(mesh, -1, vector, force));
        loads[one] = by_label(mesh, force);
        free(faces);
        free(force);
        ost_mesh_destroy(&mesh);
    }
    for (OstLocal i = 0; i < 3 * AROUND * 3 * 4; i++)
        assert_close(loads[0][i], loads[1][i], 1e-13);
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
    free(loads[0]);
    free(loads[1]);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_traction_has_the_force_and_moment_of_its_faces),
    cmocka_unit_test(a_pressure_pushes_inwards),
    cmocka_unit_test(pressure_all_around_is_in_balance),
    cmocka_unit_test(gravity_weighs_the_polygonal_tube),
    cmocka_unit_test(a_body_force_acts_on_its_region),
    cmocka_unit_test(a_total_force_is_shared_equally),
    cmocka_unit_test(point_forces_add_up),
    cmocka_unit_test(faces_of_another_kind_are_refused),
    cmocka_unit_test(ranks_agree_with_one_rank),
};

OST_TEST_MAIN(tests)
