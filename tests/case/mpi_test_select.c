/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

#include "case/select.h"
#include "core/memory.h"
#include "core/parallel/halo.h"

enum { AROUND = 12, RADIAL = 2, AXIAL = 5, NX = 4, NY = 3, NZ = 2 };

typedef struct Scene {
    OstCase *c;
    OstMesh *mesh;
} Scene;

/* A case with one constraint on the selection, and its mesh. */
static Scene make_scene(const char *mesh_text, const char *selection)
{
    char whole[1024];
    Scene scene = {NULL, NULL};
    OstMeshChunk *chunk = NULL;
    snprintf(whole, sizeof whole, "%s%sconstraints:\n  - {on: {%s}, displacement: [0, 0, 0]}\n", mesh_text, steel,
             selection);
    assert_success(read_text(whole, &scene.c));
    if (scene.c->mesh_kind == OST_MESH_TUBE)
        assert_success(ost_chunk_create_tube(ctx, &scene.c->tube, &chunk));
    else
        assert_success(ost_chunk_create_block(ctx, &scene.c->block, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &scene.mesh));
    return scene;
}

static void drop_scene(Scene *scene)
{
    ost_mesh_destroy(&scene->mesh);
    ost_case_destroy(&scene->c);
}

static const char tube[] =
    "mesh: {tube: {axis: y, length: 10, radii: [1, 2], divisions: {around: 12, radial: 2, axial: "
    "5}}}\n";
static const char block[] = "mesh: {block: {size: [4, 3, 2], divisions: [4, 3, 2]}}\n";

/* Vertices selected over all ranks, each counted by its owner; what ghosts show must be their owners' answer. */
static OstGlobal count_nodes(const char *mesh_text, const char *selection)
{
    Scene scene = make_scene(mesh_text, selection);
    const OstMesh *mesh = scene.mesh;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    assert_success(ost_select_nodes(scene.c, mesh, &scene.c->constraints[0].on, &count, &nodes));
    unsigned char *mine = calloc((size_t)mesh->node_count + 1, 1);
    unsigned char *owners = calloc((size_t)mesh->node_count + 1, 1);
    OstGlobal owned = 0;
    for (OstLocal i = 0; i < count; i++) {
        assert_true(i == 0 || nodes[i] > nodes[i - 1]);
        owned += nodes[i] < mesh->owned_nodes;
        mine[nodes[i]] = owners[nodes[i]] = 1;
    }
    assert_success(ost_halo_import(mesh->halo, 1, owners));
    assert_memory_equal(mine, owners, (size_t)mesh->node_count);
    free(mine);
    free(owners);
    OST_FREE(nodes);
    drop_scene(&scene);
    MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    return owned;
}

/* Faces selected over all ranks, and the sum of their area vectors and areas. */
static OstGlobal measure_faces(const char *mesh_text, const char *selection, double area[4])
{
    Scene scene = make_scene(mesh_text, selection);
    const OstMesh *mesh = scene.mesh;
    OstLocal count = 0;
    int n = 0;
    OstLocal *faces = NULL;
    OstGlobal owned = 0;
    memset(area, 0, 4 * sizeof *area);
    assert_success(ost_select_faces(scene.c, mesh, &scene.c->constraints[0].on, &count, &n, &faces));
    assert_int_equal(n, 3);
    for (OstLocal f = 0; f < count; f++) {
        const OstGlobal nodes[3] = {faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]};
        if (!ost_mesh_owns(mesh, 3, nodes))
            continue;
        double a[3], b[3];
        for (int i = 0; i < 3; i++) {
            a[i] = mesh->coordinates[3 * nodes[1] + i] - mesh->coordinates[3 * nodes[0] + i];
            b[i] = mesh->coordinates[3 * nodes[2] + i] - mesh->coordinates[3 * nodes[0] + i];
        }
        const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        for (int i = 0; i < 3; i++)
            area[i] += 0.5 * cross[i];
        area[3] += 0.5 * sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
        owned++;
    }
    OST_FREE(faces);
    drop_scene(&scene);
    MPI_Allreduce(MPI_IN_PLACE, &owned, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    MPI_Allreduce(MPI_IN_PLACE, area, 4, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return owned;
}

static void boundaries_hold_their_vertices(void **state)
{
    assert_int_equal(count_nodes(tube, "boundary: ends"), 2 * AROUND * (RADIAL + 1));
    assert_int_equal(count_nodes(tube, "boundary: [top, outer]"),
                     AROUND * (RADIAL + 1) + AROUND * (AXIAL + 1) - AROUND);
    assert_int_equal(count_nodes(block, "boundary: xmin"), (NY + 1) * (NZ + 1));
    assert_int_equal(count_nodes(block, "boundary: [xmin, xmax, xmin]"), 2 * (NY + 1) * (NZ + 1));
}

static void shapes_in_space_hold_what_lies_in_them(void **state)
{
    assert_int_equal(count_nodes(block, "all: true"), (NX + 1) * (NY + 1) * (NZ + 1));
    assert_int_equal(count_nodes(block, "plane: {point: [9, 2, 9], normal: [0, -7, 0]}"), (NX + 1) * (NZ + 1));
    assert_int_equal(count_nodes(block, "plane: {point: [2, 2, 1], normal: [0, 1, 0], tolerance: 1}"),
                     3 * (NX + 1) * (NZ + 1));
    assert_int_equal(count_nodes(block, "box: {min: [1, 1, 0], max: [3, 2, 2]}"), 3 * 2 * 3);
    /* of the lattice: the centre and its six neighbours, at distance 1 */
    assert_int_equal(count_nodes(block, "sphere: {center: [2, 1, 1], radius: 1}"), 7);
    assert_int_equal(count_nodes(block, "sphere: {center: [2, 1, 1], radius: 1, tolerance: 0.42}"), 7 + 12);
    /* rings of the tube, and its middle and outer walls */
    assert_int_equal(count_nodes(tube, "cylinder: {origin: [0, 5, 0], axis: [0, 1, 0], radius: 1}"),
                     AROUND * (AXIAL + 1));
    assert_int_equal(count_nodes(tube, "cylinder: {origin: [0, 5, 0], axis: [0, -1, 0], radii: [1.4, 2]}"),
                     2 * AROUND * (AXIAL + 1));
}

static void vertices_go_by_their_labels(void **state)
{
    assert_int_equal(count_nodes(block, "vertices: [60, 1, 17]"), 3);
    Scene scene = make_scene(block, "vertices: [1, 60, 61, 62]");
    OstLocal count;
    OstLocal *nodes = NULL;
    assert_failure(ost_select_nodes(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &nodes),
                   OST_INVALID_INPUT, ".yaml:4:21: 2 of 4 listed vertices are not in the mesh, the first is 61");
    assert_null(nodes);
    drop_scene(&scene);
}

/* Of equally near vertices the one with the lowest label: here (a, b, c) = (1, 1, 1), label (1·4 + 1)·3 + 1 + 1. */
static void the_nearest_vertex_is_one(void **state)
{
    assert_int_equal(count_nodes(block, "nearest: [1.5, 1.5, 1.25]"), 1);
    Scene scene = make_scene(block, "nearest: [1.5, 1.5, 1.25]");
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    assert_success(ost_select_nodes(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &nodes));
    for (OstLocal i = 0; i < count; i++)
        assert_int_equal(scene.mesh->node_label[nodes[i]], (1 * 4 + 1) * 3 + 1 + 1);
    OST_FREE(nodes);
    drop_scene(&scene);
}

static void remember(void *text, const char *warning)
{
    snprintf(text, 256, "%s", warning);
}

static void check_place(const char *selection)
{
    Scene scene = make_scene(block, selection);
    assert_success(ost_select_check_place(scene.c, scene.mesh, &scene.c->constraints[0].on));
    drop_scene(&scene);
}

/* A slip of a digit would load another place than is meant. */
static void a_place_off_the_body_is_warned_of(void **state)
{
    char warning[256] = "";
    ost_warn_listen(ctx, remember, warning);
    check_place("nearest: [4, 3.9, 2]");
    check_place("sphere: {center: [40, 1, 1], radius: 1}");
    assert_string_equal(warning, "");
    check_place("nearest: [4, 5, 2]");
    ost_warn_listen(ctx, NULL, NULL);
    if (ost_rank(ctx) == 0) /* which alone hears warnings; the cells' edges are 1, their diagonals 1.73205 */
        assert_non_null(strstr(warning,
                               ".yaml:4:20: the vertex nearest to (4, 5, 2) is at (4, 3, 2), 2 away; the edges "
                               "there are no longer than 1.73205"));
}

static void names_that_do_not_exist_come_with_those_that_do(void **state)
{
    Scene scene = make_scene(block, "boundary: xmim");
    OstLocal count;
    int n;
    OstLocal *nodes = NULL;
    assert_failure(ost_select_nodes(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &nodes),
                   OST_INVALID_INPUT, ".yaml:4:21: there is no boundary 'xmim'; did you mean 'xmin'? The mesh has: ");
    assert_non_null(strstr(ost_error_text(ctx), "ymax"));
    assert_failure(ost_select_faces(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &n, &nodes),
                   OST_INVALID_INPUT, "there is no boundary 'xmim'");
    drop_scene(&scene);
    scene = make_scene(block, "boundary: [xmin, nose]");
    assert_failure(ost_select_faces(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &n, &nodes),
                   OST_INVALID_INPUT, "there is no boundary 'nose'. The mesh has: ");
    drop_scene(&scene);
}

static void an_empty_selection_says_where_the_body_is(void **state)
{
    Scene scene = make_scene(block, "sphere: {center: [40, 1, 1], radius: 1}");
    OstLocal count;
    OstLocal *nodes = NULL;
    assert_failure(ost_select_nodes(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &nodes),
                   OST_INVALID_INPUT,
                   ".yaml:4:19: the selection holds no vertex; the body reaches from (0, 0, 0) to (4, 3, 2)");
    drop_scene(&scene);
}

static void faces_point_outwards(void **state)
{
    double area[4];
    assert_int_equal(measure_faces(block, "boundary: xmin", area), 2 * NY * NZ);
    assert_close(area[0], -6.0, 1e-12);
    assert_close(area[3], 6.0, 1e-12);
    assert_int_equal(measure_faces(block, "boundary: [zmax, zmax]", area), 2 * NX * NY);
    assert_close(area[2], 12.0, 1e-12);
    /* the whole surface closes */
    assert_int_equal(measure_faces(block, "all: true", area), 4 * (NX * NY + NY * NZ + NZ * NX));
    for (int i = 0; i < 3; i++)
        assert_close(area[i], 0.0, 1e-12);
    assert_close(area[3], 52.0, 1e-12);
}

static void faces_follow_from_their_vertices(void **state)
{
    double area[4];
    assert_int_equal(measure_faces(block, "plane: {point: [4, 0, 0], normal: [1, 0, 0]}", area), 2 * NY * NZ);
    assert_close(area[0], 6.0, 1e-12);
    /* a plane through the inside holds vertices, but no face of the surface */
    assert_int_equal(measure_faces(block, "plane: {point: [2, 0, 0], normal: [1, 0, 0]}", area), 0);
    /* the outer wall: 24 flat facets of a 12-gon, AROUND sides of 2·2·sin(15°) by 10 */
    assert_int_equal(measure_faces(tube, "boundary: outer", area), 2 * AROUND * AXIAL);
    assert_close(area[3], AROUND * 4.0 * sin(M_PI / AROUND) * 10.0, 1e-11);
    assert_int_equal(measure_faces(tube, "boundary: [top, ends]", area), 2 * 2 * AROUND * RADIAL);
    assert_close(area[1], 0.0, 1e-12);
}

/* A boundary of faces inside the body has no outside. */
static void faces_inside_the_body_are_refused(void **state)
{
    Scene scene = make_scene(block, "boundary: xmin");
    OstMesh *mesh = scene.mesh;
    OstLocal count;
    int n;
    OstLocal *faces = NULL;
    const int b = ost_mesh_find_boundary(mesh, "xmin");
    OstBoundary *boundary = &mesh->boundaries[b];
    const OstGlobal saved = boundary->count > 0 ? boundary->nodes[0] : 0;
    if (boundary->count > 0) /* some vertex that no face of this plane has */
        for (OstLocal i = 0; i < mesh->node_count; i++)
            if (mesh->coordinates[3 * i] > 3.5)
                boundary->nodes[0] = i;
    const int changed = boundary->count > 0 && boundary->nodes[0] != saved;
    int any = 0;
    MPI_Allreduce(&changed, &any, 1, MPI_INT, MPI_MAX, ost_comm(ctx));
    if (any)
        assert_failure(ost_select_faces(scene.c, mesh, &scene.c->constraints[0].on, &count, &n, &faces),
                       OST_INVALID_INPUT, "of boundary 'xmin' is not on the body's surface");
    if (boundary->count > 0)
        boundary->nodes[0] = saved;
    drop_scene(&scene);
}

/* A curve listed with faces would be left out in silence; by its vertices alone it may be selected. */
static void a_curve_among_faces_is_refused(void **state)
{
    Scene scene = make_scene(block, "boundary: [xmin, zmax]");
    OstBoundary *curve = &scene.mesh->boundaries[ost_mesh_find_boundary(scene.mesh, "zmax")];
    OstLocal count;
    int n;
    OstLocal *faces = NULL;
    curve->dimension = 1;
    assert_failure(ost_select_faces(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &n, &faces),
                   OST_INVALID_INPUT,
                   ".yaml:4:21: boundary 'zmax' is one of curves, and others listed with it are of "
                   "faces; name boundaries of faces alone");
    assert_null(faces);
    assert_success(ost_select_nodes(scene.c, scene.mesh, &scene.c->constraints[0].on, &count, &faces));
    OST_FREE(faces);
    drop_scene(&scene);
}

static void ranks_read_the_same_case_and_fail_together(void **state)
{
    OstCase *c = NULL;
    assert_refused(
        "mesh: 1\n",
        "1:7: mesh: found '1', expected a mapping with the keys tube, block, sector, octant, file, refine, merge");
    assert_failure(ost_case_read(ctx, "/nowhere/no.yaml", &c), OST_FILE_FAILED, "cannot be opened");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(boundaries_hold_their_vertices),
    cmocka_unit_test(shapes_in_space_hold_what_lies_in_them),
    cmocka_unit_test(vertices_go_by_their_labels),
    cmocka_unit_test(the_nearest_vertex_is_one),
    cmocka_unit_test(a_place_off_the_body_is_warned_of),
    cmocka_unit_test(names_that_do_not_exist_come_with_those_that_do),
    cmocka_unit_test(an_empty_selection_says_where_the_body_is),
    cmocka_unit_test(faces_point_outwards),
    cmocka_unit_test(faces_follow_from_their_vertices),
    cmocka_unit_test(faces_inside_the_body_are_refused),
    cmocka_unit_test(a_curve_among_faces_is_refused),
    cmocka_unit_test(ranks_read_the_same_case_and_fail_together),
};

OST_TEST_MAIN(tests)
