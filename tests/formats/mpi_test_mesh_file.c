/* SPDX-License-Identifier: BSD-3-Clause */
#include "msh_writer.h"

#include "core/memory.h"
#include "formats/serial/formats.h"

static OstMeshChunk *chunk;
static OstFileMaterials *materials;

static const MshNode nodes[] = {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {0, 1, 0}}, {4, {0, 0, 1}}, {6, {1, 1, 1}}};
static const MshElement elements[] = {
    {1, 2, 2, 5, 3, {1, 3, 2}}, {2, 15, 0, 9, 1, {4}}, {5, 4, 3, 1, 5, {1, 2, 3, 4}}, {6, 4, 3, 2, 6, {2, 3, 4, 6}}};
static const MshModel model = {"2\n2 5 \"held\"\n3 2 \"core\"\n", 5, 4, nodes, elements};

#define VEG                                                                                                         \
    "*VERTICES\n5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n*ELEMENTS\nTET\n2 4 0\n1 1 2 3 4\n2 2 3 4 "   \
    "5\n*MATERIAL soft\nENU, 900, 2e6, 0.3\n*MATERIAL bone\nORTHOTROPIC_N1R9, 1000, 1, 2, 3, 0.3, 0, -1, 0, 1, 0, " \
    "0, 0, 0, 1\n*SET shell\n2\n*REGION\nallElements, soft\n*REGION\nshell, bone\n"

static void drop_mesh(void)
{
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
}

/* Rank 0 holds all; the others begin where it ends. */
static void assert_shares(OstLocal node_count, OstLocal tet_count)
{
    const int whole = ost_rank(ctx) == 0;
    assert_int_equal(chunk->global_nodes, node_count);
    assert_int_equal(chunk->global_tets, tet_count);
    assert_int_equal(chunk->nodes_per_tet, 4);
    assert_int_equal(chunk->node_count, whole ? node_count : 0);
    assert_int_equal(chunk->tet_count, whole ? tet_count : 0);
    assert_int_equal(chunk->first_node, whole ? 0 : node_count);
    assert_int_equal(chunk->first_tet, whole ? 0 : tet_count);
    assert_non_null(chunk->node_label);
    assert_non_null(chunk->tet_label);
    assert_null(chunk->tet_axes);
}

static void all_ranks_know_the_names_of_a_gmsh_mesh(void **state)
{
    for (int f = MSH_22_TEXT; f < MSH_FLAVOURS; f += 3) {
        assert_success(ost_mesh_file_read(ctx, msh_write(&model, msh_flavours[f], "mesh.msh"), &chunk, &materials));
        assert_shares(5, 2);
        assert_int_equal(chunk->regions.count, 2);
        assert_string_equal(chunk->regions.name[0], "volume-1");
        assert_string_equal(chunk->regions.name[1], "core");
        assert_int_equal(chunk->boundary_count, 2);
        assert_string_equal(chunk->boundaries[0].name, "held");
        assert_int_equal(chunk->boundaries[0].dimension, 2);
        assert_int_equal(chunk->boundaries[0].nodes_per_item, 3);
        assert_int_equal(chunk->boundaries[0].count, ost_rank(ctx) == 0);
        assert_string_equal(chunk->boundaries[1].name, "point-9");
        assert_int_equal(chunk->boundaries[1].nodes_per_item, 1);
        assert_int_equal(materials->count, 0);
        drop_mesh();
    }
}

static void all_ranks_know_the_materials_of_a_veg_mesh(void **state)
{
    assert_success(ost_mesh_file_read(ctx, write_text("mesh.veg", VEG), &chunk, &materials));
    assert_shares(5, 2);
    assert_int_equal(chunk->regions.count, 2);
    assert_string_equal(chunk->regions.name[0], "allElements");
    assert_string_equal(chunk->regions.name[1], "shell");
    assert_int_equal(chunk->boundary_count, 0);
    assert_int_equal(materials->count, 2);
    assert_string_equal(materials->material[0].name, "soft");
    assert_true(materials->material[0].density == 900.0);
    assert_true(materials->material[1].constants.youngs_modulus[2] == 3.0);
    assert_true(materials->axes[9 + 1] == 1.0);
    drop_mesh();
}

static void all_ranks_fail_together(void **state)
{
    assert_failure(ost_mesh_file_read(ctx, write_text("bad.veg", "*VERTICES\n2 3 0 0\n1 0 0\n"), &chunk, &materials),
                   OST_INVALID_INPUT, "bad.veg:3: the line ends where z is expected");
    assert_null(chunk);
    assert_null(materials);
    assert_failure(ost_mesh_file_read(ctx, write_text("bad.msh", "$MeshFormat\n"), &chunk, &materials),
                   OST_INVALID_INPUT, "bad.msh:2");
    assert_failure(ost_mesh_file_read(ctx, scratch("none.vtkhdf"), &chunk, &materials), OST_FILE_FAILED, "none.vtkhdf");
    assert_failure(ost_mesh_file_read(ctx, "mesh.obj", &chunk, &materials), OST_INVALID_INPUT,
                   "tetgen -pq on the .stl");
}

static OstGlobal range_count;
static OstLabelRange *ranges;

static OstStatus read_list(const char *text)
{
    return ost_vertex_list_read(ctx, write_text("list.bou", text), &range_count, &ranges);
}

static void vertex_lists_reach_all_ranks(void **state)
{
    assert_success(read_list("# held\n1,3,6,\r\n8 4 # by hand\n\n10 : 12, 20:20\n3\n5:6\n"));
    const OstLabelRange expected[] = {{1, 1}, {3, 6}, {8, 8}, {10, 12}, {20, 20}};
    assert_int_equal(range_count, 5);
    assert_memory_equal(ranges, expected, sizeof expected);
    OST_FREE(ranges);
    assert_success(read_list("2:3 1:1000000000 7\n5"));
    assert_int_equal(range_count, 1);
    assert_int_equal(ranges[0].last, 1000000000);
    OST_FREE(ranges);
}

static void wrong_vertex_lists_are_refused(void **state)
{
    static const struct {
        const char *list, *text;
    } wrong[] = {{"1, x", "list.bou:1: a vertex number is 'x', expected a whole number"},
                 {"1\n1.5", "list.bou:2: a vertex number is '1.5'"},
                 {"3 :", "list.bou:1: the line ends where the end of a range is expected"},
                 {"5:3", "list.bou:1: vertices 5 to 3 found"},
                 {"-1", "vertices -1 to -1 found"},
                 {": 4", "a vertex number is ':', expected"},
                 {"# nothing\n", "list.bou: names no vertex"},
                 {"0:9223372036854775807", "found, expected numbers from 0 to 999999999999999999 that ascend"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_failure(read_list(wrong[i].list), OST_INVALID_INPUT, wrong[i].text);
        assert_null(ranges);
        assert_int_equal(range_count, 0);
    }
    assert_failure(ost_vertex_list_read(ctx, scratch("none.bou"), &range_count, &ranges), OST_FILE_FAILED, "none.bou");
}

enum { LINES = 40000 };

/* More than a rank can ask for at once, in an order of its own. */
static void tables_reach_the_ranks_that_ask(void **state)
{
    char *text = malloc(LINES * 32 + 32);
    OstGlobal *line = malloc(LINES * sizeof *line);
    double *values = malloc(LINES * 2 * sizeof *values);
    size_t length = (size_t)sprintf(text, "# two numbers a line\n\n");
    for (int i = 1; i <= LINES; i++)
        length += (size_t)sprintf(text + length, "%d, %.17g\r\n", i, i / 7.0);
    const char *path = write_text("table.txt", text);
    const OstLocal count = ost_rank(ctx) % 2 == 0 ? LINES / 2 + 1 : LINES / 3;
    for (OstLocal i = 0; i < count; i++)
        line[i] = LINES - i - ost_rank(ctx);
    assert_success(ost_table_read(ctx, path, 2, LINES, count, line, values));
    for (OstLocal i = 0; i < count; i++) {
        assert_true(values[2 * i] == (double)line[i]);
        assert_true(values[2 * i + 1] == (double)line[i] / 7.0);
    }
    free(text);
    free(line);
    free(values);
}

static void wrong_tables_are_refused(void **state)
{
    static const struct {
        const char *table, *text;
    } wrong[] = {{"1 2 3\n4 5 6\n", "table.txt:2: the file ends after 2 lines of 3 numbers, expected 3"},
                 {"1 2 3\n\n4 5 6\n7 8 9\n1 2 3\n", "table.txt:5: more lines of 3 numbers than the 3 expected"},
                 {"1 2 3\n4 5\n7 8 9\n", "table.txt:2: the line ends where number 3 of 3 is expected"},
                 {"1 2 3 4\n", "table.txt:1: '4' follows 3 numbers, expected the end of the line"},
                 {"1 2 inf\n", "table.txt:1: number 3 of 3 is 'inf', expected a finite number"},
                 {"1 2 z\n", "number 3 of 3 is 'z', expected a number"},
                 {"\n", "table.txt:1: the file ends after 0 lines"}};
    const OstGlobal line = ost_rank(ctx) + 1;
    double values[3];
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_failure(
            ost_table_read(ctx, write_text("table.txt", wrong[i].table), 3, 3, ost_rank(ctx) < 3, &line, values),
            OST_INVALID_INPUT, wrong[i].text);
    const OstGlobal beyond = ost_rank(ctx) == ost_size(ctx) - 1 ? 4 : 1;
    assert_failure(ost_table_read(ctx, write_text("table.txt", "1 2 3\n4 5 6\n7 8 9\n"), 3, 3, 1, &beyond, values),
                   OST_INVALID_INPUT, "line 4 asked for, expected 1 to 3");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(all_ranks_know_the_names_of_a_gmsh_mesh),
    cmocka_unit_test(all_ranks_know_the_materials_of_a_veg_mesh),
    cmocka_unit_test(all_ranks_fail_together),
    cmocka_unit_test(vertex_lists_reach_all_ranks),
    cmocka_unit_test(wrong_vertex_lists_are_refused),
    cmocka_unit_test(tables_reach_the_ranks_that_ask),
    cmocka_unit_test(wrong_tables_are_refused),
};

OST_TEST_MAIN(tests)
