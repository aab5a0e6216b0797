/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh/mesh_support.h"

#include "core/small.h"
#include "guard/guard.h"
#include "mesh/lattice.h"

static OstSupports *new_supports(const OstMesh *mesh)
{
    OstSupports *supports = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    return supports;
}

static void hold(OstSupports *supports, OstGlobal label, double x, double y, double z)
{
    const double direction[3] = {x, y, z};
    for (OstLocal n = 0; n < supports->mesh->owned_nodes; n++)
        if (supports->mesh->node_label[n] == label)
            assert_success(ost_supports_constrain(supports, n, direction, 0.0));
}

static void hold_fully(OstSupports *supports, OstGlobal label)
{
    hold(supports, label, 1.0, 0.0, 0.0);
    hold(supports, label, 0.0, 1.0, 0.0);
    hold(supports, label, 0.0, 0.0, 1.0);
}

static void hold_labels(OstSupports *supports, OstGlobal first, OstGlobal last)
{
    for (OstGlobal label = first; label <= last; label++)
        hold_fully(supports, label);
}

/* The check of these supports, which are destroyed, raises with all of these lines. */
static void assert_free(OstMesh *mesh, OstSupports *supports, const char *const *lines)
{
    assert_success(ost_supports_complete(supports));
    const OstStatus status = ost_freedom_check(mesh, supports, "case.yaml", 0);
    const char *text = ost_error_text(ctx);
    if (status != OST_INVALID_INPUT)
        fail_msg("expected a refusal, got %s", ost_status_name(status));
    size_t length = strlen("case.yaml: nothing constrains these motions, so there is no unique solution:");
    for (int i = 0; lines[i]; i++) {
        const char *found = strstr(text, lines[i]);
        if (!found || found[strlen(lines[i])] != '\n')
            fail_msg("no '%s' in:\n%s", lines[i], text);
        length += strlen(lines[i]) + 3;
    }
    assert_int_equal(strncmp(text + length, "\nprevent each of them", 21), 0); /* and no other line */
    ost_supports_destroy(&supports);
}

static void assert_held(OstMesh *mesh, OstSupports *supports)
{
    assert_success(ost_supports_complete(supports));
    assert_success(ost_freedom_check(mesh, supports, "case.yaml", 0));
    ost_supports_destroy(&supports);
}

#define LINES(...) ((const char *const[]){__VA_ARGS__, NULL})

static OstMesh *one_tet(double scale, double shift)
{
    double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const OstGlobal nodes[] = {0, 1, 2, 3};
    OstMesh *mesh = NULL;
    for (int i = 0; i < 12; i++)
        x[i] = scale * (x[i] + shift);
    OstMeshChunk *chunk = hand_chunk(4, 4, x, 1, nodes);
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    return mesh;
}

static void a_tet_turns_about_a_vertex_or_an_edge_and_rests_on_three_vertices(void **state)
{
    OstMesh *mesh = one_tet(1.0, 0.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 1);
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (0.5, 0.5, 0.5): can turn about any line through (0, 0, 0)"));
    supports = new_supports(mesh);
    hold_labels(supports, 2, 3);
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (0.5, 0.5, 0.5): can turn about the line through (0.5, 0.5, 0) along "
                      "(0.707107, -0.707107, 0)"));
    supports = new_supports(mesh);
    hold_labels(supports, 1, 3);
    assert_held(mesh, supports);
    ost_mesh_destroy(&mesh);
}

static void units_and_places_change_nothing(void **state)
{
    OstMesh *mesh = one_tet(1e-6, 0.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 2, 2);
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (5e-07, 5e-07, 5e-07): can turn about any line through (1e-06, 0, 0)"));
    ost_mesh_destroy(&mesh);
    mesh = one_tet(1e6, 1000.0);
    supports = new_supports(mesh);
    hold_labels(supports, 1, 1);
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (1.0005e+09, 1.0005e+09, 1.0005e+09): can turn about any line through "
                      "(1e+09, 1e+09, 1e+09)"));
    supports = new_supports(mesh);
    hold_labels(supports, 1, 3);
    assert_held(mesh, supports);
    ost_mesh_destroy(&mesh);
}

static void a_body_held_at_one_component_can_do_all_the_rest(void **state)
{
    OstMesh *mesh = one_tet(1.0, 0.0);
    OstSupports *supports = new_supports(mesh);
    hold(supports, 1, 0.0, 0.0, 1.0);
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (0.5, 0.5, 0.5): can move in any direction normal to (0, 0, 1), and turn "
                      "about the line through (0.5, 0, 0.5) along (1, 0, 0), and turn about the line through "
                      "(0, 0.5, 0.5) along (0, 1, 0), and turn about any line along (0, 0, 1)"));
    ost_mesh_destroy(&mesh);
}

/* Each vertex may move along the velocity of a screw of pitch 1 about z through (2, 0, 0), and not across it. */
static void a_screw_is_called_a_twist_with_its_pitch(void **state)
{
    OstMesh *mesh = one_tet(1.0, 0.0);
    OstSupports *supports = new_supports(mesh);
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const double *x = mesh->coordinates + 3 * n;
        const double velocity[3] = {-x[1], x[0] - 2.0, 0.5 / M_PI};
        const double up[3] = {0.0, 0.0, 1.0};
        double side[3], other[3];
        ost_cross3(velocity, up, side);
        ost_cross3(velocity, side, other);
        assert_success(ost_supports_constrain(supports, n, side, 0.0));
        assert_success(ost_supports_constrain(supports, n, other, 0.0));
    }
    assert_free(mesh, supports,
                LINES("the body, 1 tet around (0.5, 0.5, 0.5): can twist about the line through (2, 0, 0.5) along "
                      "(0, 0, 1), moving 1 along it per turn"));
    ost_mesh_destroy(&mesh);
}

static void a_block_on_a_plane_slides_and_turns_on_it_and_rests_in_a_corner(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 0}};
    OstMesh *mesh = lattice_mesh(2, cell, 1.0);
    for (int planes = 1; planes <= 3; planes++) {
        OstSupports *supports = new_supports(mesh);
        for (OstLocal n = 0; n < mesh->owned_nodes; n++)
            for (int d = 3 - planes; d < 3; d++) {
                double normal[3] = {0.0};
                normal[d] = 1.0;
                if (mesh->coordinates[3 * n + d] == 0.0)
                    assert_success(ost_supports_constrain(supports, n, normal, 0.0));
            }
        if (planes == 1)
            assert_free(mesh, supports,
                        LINES("the body, 12 tets around (1, 0.5, 0.5): can move in any direction normal to (0, 0, 1), "
                              "and turn about any line along (0, 0, 1)"));
        else if (planes == 2)
            assert_free(mesh, supports, LINES("the body, 12 tets around (1, 0.5, 0.5): can move along (1, 0, 0)"));
        else
            assert_held(mesh, supports);
    }
    ost_mesh_destroy(&mesh);
}

static void a_tube_on_its_cylinder_turns_about_its_axis_and_moves_along_it(void **state)
{
    const OstTubeShape tube = {0, {1.0, 2.0, 3.0}, 4.0, {0.9, 1.5}, 12, 1, 4};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    for (int ends = 0; ends < 2; ends++) {
        OstSupports *supports = new_supports(mesh);
        for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
            const double *x = mesh->coordinates + 3 * n;
            const double radial[3] = {0.0, x[1] - 2.0, x[2] - 3.0};
            const double axial[3] = {1.0, 0.0, 0.0};
            if (ost_norm3(radial) > 1.4)
                assert_success(ost_supports_constrain(supports, n, radial, 0.0));
            if (ends && x[0] == 1.0)
                assert_success(ost_supports_constrain(supports, n, axial, 0.0));
        }
        assert_free(mesh, supports,
                    ends ? LINES("the body, 288 tets around (3, 2, 3): can turn about the line through (3, 2, 3) along "
                                 "(1, 0, 0)")
                         : LINES("the body, 288 tets around (3, 2, 3): can move along (1, 0, 0), and turn about the "
                                 "line through (3, 2, 3) along (1, 0, 0)"));
    }
    ost_mesh_destroy(&mesh);
}

static void a_loose_block_is_named_and_a_held_one_is_not(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{4, 0, 0}, 0}, {{5, 0, 0}, 0}};
    OstMesh *mesh = lattice_mesh(3, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_free(mesh, supports,
                LINES("component 2, 12 tets around (5, 0.5, 0.5): can move in any direction, and turn about any axis"));
    ost_mesh_destroy(&mesh);
}

static void a_block_on_an_edge_turns_about_it_at_any_scale(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}};
    const char *line[] = {
        "component 2, 6 tets around (1.5e-06, 1.5e-06, 5e-07), joined to component 1 along one line only: can "
        "turn about the line through (1e-06, 1e-06, 5e-07) along (0, 0, 1)",
        "component 2, 6 tets around (1.5, 1.5, 0.5), joined to component 1 along one line only: can turn about "
        "the line through (1, 1, 0.5) along (0, 0, 1)",
        "component 2, 6 tets around (1.5e+06, 1.5e+06, 500000), joined to component 1 along one line only: can "
        "turn about the line through (1e+06, 1e+06, 500000) along (0, 0, 1)"};
    for (int i = 0; i < 3; i++) {
        OstMesh *mesh = lattice_mesh(2, cell, pow(10.0, 6 * (i - 1)));
        OstSupports *supports = new_supports(mesh);
        hold_labels(supports, 1, 8);
        assert_free(mesh, supports, LINES(line[i]));
        supports = new_supports(mesh); /* the other way round, by the second's far vertices */
        hold_labels(supports, 9, 14);
        assert_int_equal(mesh->global_nodes, 14);
        assert_success(ost_supports_complete(supports));
        assert_failure(ost_freedom_check(mesh, supports, "case.yaml", 0), OST_INVALID_INPUT, "\n  component 1, 6 tets");
        ost_supports_destroy(&supports);
        supports = new_supports(mesh);
        hold_labels(supports, 1, 9); /* one vertex of the second is enough to stop it */
        assert_held(mesh, supports);
        ost_mesh_destroy(&mesh);
    }
}

static void a_block_on_a_vertex_turns_about_any_line_through_it(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 1}, 0}};
    OstMesh *mesh = lattice_mesh(2, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_free(
        mesh, supports,
        LINES("component 2, 6 tets around (1.5, 1.5, 1.5), joined to component 1 at one point only: can turn about any "
              "line through (1, 1, 1)"));
    ost_mesh_destroy(&mesh);
}

static void of_a_chain_each_hinge_is_named_with_what_hangs_on_it(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}, {{2, 2, 0}, 0}};
    OstMesh *mesh = lattice_mesh(3, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_free(
        mesh, supports,
        LINES(
            "components 2 and 3 together, 12 tets around (2, 2, 0.5), joined to component 1 along one line only: can "
            "turn about the line through (1, 1, 0.5) along (0, 0, 1)",
            "component 3, 6 tets around (2.5, 2.5, 0.5), joined to component 2 along one line only: can turn about the "
            "line through (2, 2, 0.5) along (0, 0, 1)"));
    ost_mesh_destroy(&mesh);
}

static void a_floating_chain_moves_as_a_whole_and_at_its_hinges(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}, {{2, 2, 0}, 0}};
    OstMesh *mesh = lattice_mesh(3, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 1);
    assert_free(
        mesh, supports,
        LINES(
            "components 1, 2 and 3 together, 18 tets around (1.5, 1.5, 0.5): can turn about any line through "
            "(0, 0, 0)",
            "components 2 and 3 together, 12 tets around (2, 2, 0.5), joined to component 1 along one line only: can "
            "turn about the line through (1, 1, 0.5) along (0, 0, 1)",
            "component 3, 6 tets around (2.5, 2.5, 0.5), joined to component 2 along one line only: can turn about the "
            "line through (2, 2, 0.5) along (0, 0, 1)"));
    ost_mesh_destroy(&mesh);
}

/* Four blocks in a ring, hinged at four edges: a parallelogram, which has one motion that no set of blocks shares. */
static void a_ring_of_four_hinges_is_a_linkage(void **state)
{
    const Cell cell[] = {{{1, 0, 0}, 0}, {{2, 1, 0}, 0}, {{1, 2, 0}, 0}, {{0, 1, 0}, 0}};
    OstMesh *mesh = lattice_mesh(4, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_free(
        mesh, supports,
        LINES("components 2, 3 and 4, 18 tets around (1.5, 2, 0.5): can move against each other, as a linkage, in 1 "
              "way"));
    ost_mesh_destroy(&mesh);
}

/* Three hinges make a triangle, which is stiff. */
static void a_ring_of_three_hinges_is_rigid(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}, {{0, 1, 1}, 0}};
    OstMesh *mesh = lattice_mesh(3, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_held(mesh, supports);
    ost_mesh_destroy(&mesh);
}

static void coincident_vertices_are_the_way_out_that_is_offered(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}};
    OstMesh *mesh = lattice_mesh(2, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_success(ost_supports_complete(supports));
    assert_failure(ost_freedom_check(mesh, supports, "case.yaml", 0), OST_INVALID_INPUT,
                   "or join the components: 4 vertices coincide with others, and mesh: {merge: 0.01} joins them");
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

static void many_loose_parts_fill_ten_lines_and_are_counted(void **state)
{
    Cell cell[LATTICE_CELLS];
    for (int i = 0; i < LATTICE_CELLS; i++)
        cell[i] = (Cell){{2 * (i % 4), 2 * (i / 4), 0}, 0};
    OstMesh *mesh = lattice_mesh(LATTICE_CELLS, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_labels(supports, 1, 8);
    assert_success(ost_supports_complete(supports));
    assert_failure(ost_freedom_check(mesh, supports, "case.yaml", 0), OST_INVALID_INPUT,
                   "\n  and 5 more that can move\n");
    int lines = 1;
    for (const char *c = ost_error_text(ctx); *c; c++)
        lines += *c == '\n';
    assert_int_equal(lines, 13);
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

/* 256 cells that touch in edges alone, hanging on one vertex: more than are solved as a linkage. */
static void a_great_many_hinged_parts_are_still_asked_whether_all_can_move_as_one(void **state)
{
    Cell *cell = malloc(sizeof *cell * 512);
    int cells = 0;
    for (int i = 0; i < 512; i++)
        if ((i / 64 + i / 8 + i) % 2 == 0)
            cell[cells++] = (Cell){{i / 64, i / 8 % 8, i % 8}, 0};
    assert_int_equal(cells, 256);
    OstMesh *mesh = lattice_mesh(cells, cell, 1.0);
    OstSupports *supports = new_supports(mesh);
    hold_fully(supports, 1);
    assert_free(
        mesh, supports,
        LINES("components 1, 2, 3, 4, 5, 6 and 250 more together, 1536 tets around (4, 4, 4): can turn about any "
              "line through (0, 0, 0)"));
    free(cell);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_tet_turns_about_a_vertex_or_an_edge_and_rests_on_three_vertices),
    cmocka_unit_test(units_and_places_change_nothing),
    cmocka_unit_test(a_body_held_at_one_component_can_do_all_the_rest),
    cmocka_unit_test(a_screw_is_called_a_twist_with_its_pitch),
    cmocka_unit_test(a_block_on_a_plane_slides_and_turns_on_it_and_rests_in_a_corner),
    cmocka_unit_test(a_tube_on_its_cylinder_turns_about_its_axis_and_moves_along_it),
    cmocka_unit_test(a_loose_block_is_named_and_a_held_one_is_not),
    cmocka_unit_test(a_block_on_an_edge_turns_about_it_at_any_scale),
    cmocka_unit_test(a_block_on_a_vertex_turns_about_any_line_through_it),
    cmocka_unit_test(of_a_chain_each_hinge_is_named_with_what_hangs_on_it),
    cmocka_unit_test(a_floating_chain_moves_as_a_whole_and_at_its_hinges),
    cmocka_unit_test(a_ring_of_four_hinges_is_a_linkage),
    cmocka_unit_test(a_ring_of_three_hinges_is_rigid),
    cmocka_unit_test(coincident_vertices_are_the_way_out_that_is_offered),
    cmocka_unit_test(a_great_many_hinged_parts_are_still_asked_whether_all_can_move_as_one),
    cmocka_unit_test(many_loose_parts_fill_ten_lines_and_are_counted),
};

OST_TEST_MAIN(tests)
