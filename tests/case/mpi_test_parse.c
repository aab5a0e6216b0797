/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

#include "core/memory.h"
#include "problem/scene_data.h"

static const char bar[] =
    "mesh: from_program\n"
    "materials: [{region: all, youngs_modulus: [2, 1, 1], poissons_ratio: 0.3, axes: {cells: mesh}}]\n"
    "constraints:\n"
    "  - {on: {boundary: [xmin]}, slide: [1, 0, 0]}\n"
    "  - {on: {boundary: [ymin]}, slide: [0, 1, 0]}\n"
    "  - {on: {boundary: [zmin]}, slide: [0, 0, 1]}\n"
    "loads: [{on: {boundary: [xmax]}, traction: [1, 0, 0]}]\n"
    "large_rotation: off\n";

static void a_text_is_read_as_its_file_is(void **state)
{
    char text[1024];
    OstCase *from_text = NULL;
    OstCase *from_file = NULL;
    snprintf(text, sizeof text, "title: a cube\n%s%sconstraints: free_body\nloads: []\n", cube, steel);
    assert_success(ost_case_parse(ctx, "some/where.yaml", text, &from_text));
    assert_success(read_text(text, &from_file));
    assert_string_equal(from_text->title, "a cube");
    assert_string_equal(from_text->path, "some/where.yaml");
    assert_int_equal(from_text->mesh_kind, from_file->mesh_kind);
    assert_memory_equal(&from_text->block, &from_file->block, sizeof from_file->block);
    assert_int_equal(from_text->material_count, from_file->material_count);
    ost_case_destroy(&from_text);
    ost_case_destroy(&from_file);
}

static void messages_name_the_text_and_files_are_beside_it(void **state)
{
    OstCase *c = NULL;
    assert_failure(ost_case_parse(ctx, "some/where.yaml", "mesh: {blok: 1}\n", &c), OST_INVALID_INPUT,
                   "some/where.yaml:1:");
    assert_null(c);
    char text[1024];
    snprintf(text, sizeof text, "mesh: {file: bone.msh}\n%sconstraints: free_body\nloads: []\n", steel);
    assert_success(ost_case_parse(ctx, "some/where.yaml", text, &c));
    assert_string_equal(c->mesh_file, "some/bone.msh");
    ost_case_destroy(&c);
}

/* The second material axis of every tet lies along x: a bar of modulus 1, not 2, is pulled to twice its length. */
static void a_program_brings_mesh_and_axes(void **state)
{
    static const double turned[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {2, 2, 2}};
    OstCase *c = NULL;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(ost_case_parse(ctx, "bar", bar, &c));
    assert_failure(ost_scene_create(c, &scene), OST_INVALID_INPUT,
                   "bar:1:7: the case expects its mesh from a program (ost_scene_create_on)");
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    assert_success(ost_allocate(ctx, 9 * (size_t)chunk->tet_count, sizeof(double), (void **)&chunk->tet_axes));
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        memcpy(chunk->tet_axes + 9 * (size_t)t, turned, sizeof turned);
    assert_success(ost_scene_create_on(c, &chunk, &scene));
    assert_success(ost_scene_solve(scene, &result));
    const OstMesh *mesh = ost_scene_mesh(scene);
    for (OstLocal n = 0; n < ost_mesh_node_count(mesh); n++)
        assert_close(ost_result_displacement(result)[3 * n], ost_mesh_coordinates(mesh)[3 * n], 1e-7);
    for (OstLocal t = 0; t < ost_mesh_owned_tets(mesh); t++)
        assert_close(ost_result_stress(result)[6 * t], 1.0, 1e-6);
    /* nu_ij = 0.3 √(Ei / Ej): a corner moves by 1, -0.3 / √2 and -0.3 */
    assert_close(ost_result_largest_displacement(result, NULL), sqrt(1.0 + 0.045 + 0.09), 1e-6);
    assert_int_equal(ost_result_objection_count(result), 0);
    assert_string_equal(ost_result_status(result), "accepted");
    assert_true(ost_result_solve_report(result)->relative_residual <= 1e-8);
    assert_true(ost_result_checks(result)->finite);
    assert_int_equal(ost_result_unknowns(result), 3 * 26); /* the node at the origin is constrained */
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_text_is_read_as_its_file_is),
    cmocka_unit_test(messages_name_the_text_and_files_are_beside_it),
    cmocka_unit_test(a_program_brings_mesh_and_axes),
};

OST_TEST_MAIN(tests)
