/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"
#include "two_cubes.h"

#include "formats/serial/formats.h"

#include <string.h>
#include <unistd.h>

/* Exodus II files of two cubes (exchange/README.md), by meshio and by netCDF. */
static const struct {
    const char *name;
    int nodes, boundaries;
    const char *left, *right, *clamp;
    int by_netcdf, steps; /* with maps of numbers and named sets */
} files[] = {
    {"meshio-linear.e", 23, 2, "volume-1", "volume-2", "surface-0", 0, 1},
    {"meshio-quadratic.e", 113, 2, "volume-1", "volume-2", "surface-0", 0, 1},
    {"exodus-linear-classic.exo", 23, 4, "left", "volume-20", "clamp", 1, 2},
    {"exodus-linear-offset.gen", 23, 4, "left", "volume-20", "clamp", 1, 1},
    {"exodus-linear-netcdf4.g", 23, 4, "left", "volume-20", "clamp", 1, 2},
    {"exodus-quadratic-64bit.ex2", 113, 4, "left", "volume-20", "clamp", 1, 2},
    {"parts.e.4.0", 23, 4, "left", "volume-20", "clamp", 1, 2}, /* of four files, any of them or the whole */
    {"parts.e", 23, 4, "left", "volume-20", "clamp", 1, 2},
};
enum { FILES = sizeof files / sizeof *files, TETS = 48 };

static void path_of(const char *name, char path[512])
{
    snprintf(path, 512, "%s/tests/formats/exchange/%s", getenv("ORTHOSTAT_SOURCE"), name);
}

static void check_boundary(const OstMeshChunk *chunk, const char *name, int dimension, int count, double x)
{
    const OstBoundary *boundary = NULL;
    for (int b = 0; b < chunk->boundary_count; b++)
        if (strcmp(chunk->boundaries[b].name, name) == 0)
            boundary = &chunk->boundaries[b];
    assert_non_null(boundary);
    assert_int_equal(boundary->dimension, dimension);
    assert_int_equal(boundary->count, count);
    for (int i = 0; i < boundary->count * boundary->nodes_per_item; i++)
        assert_true(chunk->coordinates[3 * boundary->nodes[i]] == x);
}

static void files_hold_two_cubes(void **state)
{
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (int f = 0; f < FILES; f++) {
        char path[512];
        OstMesh *mesh = NULL;
        path_of(files[f].name, path);
        OstMeshChunk *chunk = read_cubes(path, 0, files[f].nodes, TETS);
        assert_int_equal(chunk->boundary_count, files[f].boundaries);
        check_cubes(chunk, files[f].left, files[f].right);
        check_boundary(chunk, files[f].clamp, 2, 4, 0.0);
        check_boundary(chunk, "pins", 2, 4, 2.0); /* all nodes of these faces */
        if (files[f].by_netcdf) {
            check_boundary(chunk, "sideset-5", 2, 4, 2.0);
            check_boundary(chunk, "nodeset-9", 0, 1, 2.0);
        }
        for (OstLocal n = 0; n < chunk->node_count; n++)
            assert_int_equal(chunk->node_label[n], files[f].by_netcdf ? 10 * (n + 1) : n + 1);
        for (OstLocal t = 0; t < chunk->tet_count && files[f].by_netcdf; t++)
            assert_int_equal(chunk->tet_label[t], 1001 + t);
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        ost_mesh_destroy(&mesh);
    }
}

static void assert_fibre(const double *fibre, double angle)
{
    assert_close(fibre[0], cos(angle), 1e-12);
    assert_close(fibre[1], sin(angle), 1e-12);
    assert_close(fibre[2], 0.0, 1e-12);
}

/* Variables of elements and of nodes, vectors by their components, or as meshio writes them; of the last time step. */
static void fields_are_read_tet_by_tet(void **state)
{
    for (int f = 0; f < FILES; f++) {
        char path[512];
        OstMeshChunk *chunk = NULL;
        Warnings found = {files[f].name, 0};
        path_of(files[f].name, path);
        assert_success(ost_chunk_read(ctx, path, &chunk));
        ost_warn_listen(ctx, count_warning, &found);
        assert_success(ost_mesh_file_read_field(ctx, path, "density", OST_FIELD_OF_NUMBERS, chunk));
        assert_success(ost_mesh_file_read_field(ctx, path, "direction", OST_FIELD_OF_DIRECTIONS, chunk));
        if (files[f].by_netcdf) {
            assert_success(ost_mesh_file_read_field(ctx, path, "modulus", OST_FIELD_OF_NUMBERS, chunk));
            assert_success(ost_mesh_file_read_field(ctx, path, "fibre", OST_FIELD_OF_DIRECTIONS, chunk));
        }
        ost_warn_listen(ctx, NULL, NULL);
        assert_int_equal(found.count, files[f].steps > 1 ? 4 : 0);
        assert_int_equal(ost_mesh_file_read_field(ctx, path, "modulos", OST_FIELD_OF_NUMBERS, chunk),
                         OST_INVALID_INPUT);
        assert_non_null(strstr(ost_error_text(ctx), "'density'"));
        const int width = ost_tet_fields_width(&chunk->fields);
        assert_int_equal(width, files[f].by_netcdf ? 8 : 4);
        for (OstLocal t = 0; t < chunk->tet_count; t++) {
            const double *field = chunk->tet_field + width * t;
            assert_close(field[0], 1.0 + centre_x(chunk, t), 1e-12);
            assert_close(fabs(field[1]), 0.6, 1e-12);
            assert_close(field[2] / field[1], 4.0 / 3.0, 1e-12);
            if (files[f].by_netcdf) {
                assert_close(field[4], 1000.0 + 1000.0 * centre_x(chunk, t), 1e-9);
                assert_fibre(field + 5, centre_x(chunk, t));
            }
        }
        ost_chunk_destroy(&chunk);
    }
}

/* Hexahedra, wedges and pyramids are split; their sides bound, and their tets have their values. */
static void other_solids_are_read(void **state)
{
    static const struct {
        const char *name;
        int nodes;
    } solids[] = {{"solids-linear.exo", 17}, {"solids-serendipity.exo", 71}};
    for (int f = 0; f < 2; f++) {
        char path[512];
        OstMesh *mesh = NULL;
        double faces = 0.0;
        path_of(solids[f].name, path);
        OstMeshChunk *chunk = read_cubes(path, 0, solids[f].nodes, 24);
        check_cubes(chunk, NULL, NULL);
        check_boundary(chunk, "clamp", 2, 2, 0.0);
        check_boundary(chunk, "end", 2, 2, 2.0);
        assert_success(ost_mesh_file_read_field(ctx, path, "modulus", OST_FIELD_OF_NUMBERS, chunk));
        for (OstLocal t = 0; t < chunk->tet_count; t++) {
            const double x = centre_x(chunk, t), modulus = chunk->tet_field[t];
            /* of the hexahedron 1500; of the pyramids around (1.25, 0.5, 0.5), and their tets, 2062.5 to 2437.5; wedges
             */
            assert_true(x < 1.0   ? fabs(modulus - 1500.0) < 1e-9
                        : x < 1.5 ? modulus > 2000.0 && modulus < 2500.0
                                  : fabs(modulus - 2750.0) < 100.0);
        }
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        assert_success(ost_mesh_surface_faces(mesh, &faces));
        assert_close(faces, 28.0, 0.0);
        ost_mesh_destroy(&mesh);
    }
}

/* --- what is refused --- */

enum { MOST_BYTES = 1 << 16 };

static size_t load(const char *name, unsigned char *bytes)
{
    char path[512];
    path_of(name, path);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, MOST_BYTES, file);
    fclose(file);
    assert_true(size > 0 && size < MOST_BYTES);
    return size;
}

static OstStatus read_bytes(const unsigned char *bytes, size_t size, OstMeshChunk **chunk)
{
    char path[512];
    snprintf(path, sizeof path, "/tmp/orthostat-exodus-%d.e", (int)getpid());
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    const OstStatus status = ost_chunk_read(ctx, path, chunk);
    remove(path);
    return status;
}

static void expect_refusal(const unsigned char *bytes, size_t size, const char *words)
{
    OstMeshChunk *chunk = NULL;
    assert_int_not_equal(read_bytes(bytes, size, &chunk), OST_SUCCESS);
    assert_null(chunk);
    if (!strstr(ost_error_text(ctx), words))
        fail_msg("'%s' has no '%s'", ost_error_text(ctx), words);
}

/* netCDF reads zeros beyond the end of a classic file. */
static void a_file_that_was_cut_off_is_refused(void **state)
{
    static const char *const names[] = {"exodus-linear-classic.exo", "exodus-linear-offset.gen",
                                        "exodus-quadratic-64bit.ex2", "meshio-linear.e"};
    static unsigned char bytes[MOST_BYTES];
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        const size_t size = load(names[n], bytes);
        expect_refusal(bytes, size - 4, n < 3 ? "incomplete or damaged" : "expected in Exodus II, could not be read");
        expect_refusal(bytes, size / 2, n < 3 ? "incomplete or damaged" : "expected in Exodus II, could not be read");
        expect_refusal(bytes, 100, n < 3 ? "incomplete or damaged" : "expected in Exodus II, could not be read");
    }
}

/* The place behind the first `text` in the classic file. */
static unsigned char *behind(unsigned char *bytes, size_t size, const char *text)
{
    unsigned char *found = memmem(bytes, size, text, strlen(text));
    assert_non_null(found);
    return found + strlen(text);
}

static void mistakes_are_named(void **state)
{
    static const struct {
        const char *text;
        int skipped;
        const char *new_bytes;
        int length;
        const char *words;
    } wrong[] = {
        {"num_dim", 4, "\2", 1, "num_dim is 2"},
        {"num_dim", -1, "x", 1, "without num_dim"},
        {"TETRA", -5, "NFACE", 5, "of them NFACE"},
        {"coordz", -1, "q", 1, "coordz (or coord) has 0 numbers, expected 23"},
        {"elem_ss1", -1, "7", 1, "elem_ss1 has 0 numbers and side_ss1 4"},
        {"num_nodes", 6, "\30", 1, "expected in Exodus II, could not be read"},
    };
    static unsigned char bytes[MOST_BYTES];
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        const size_t size = load("exodus-linear-classic.exo", bytes);
        unsigned char *place = behind(bytes, size, wrong[w].text);
        memcpy(place + wrong[w].skipped, wrong[w].new_bytes, (size_t)wrong[w].length);
        expect_refusal(bytes, size, wrong[w].words);
    }
}

/* Node 1 of the first tet, and the first two numbers of maps, by what they are in the file: big-endian integers. */
static void numbers_of_nodes_are_checked(void **state)
{
    static unsigned char bytes[MOST_BYTES];
    static const unsigned char map[] = {0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 30};
    OstMeshChunk *chunk = NULL;
    size_t size = load("exodus-linear-classic.exo", bytes);
    unsigned char *place = memmem(bytes, size, map, sizeof map);
    assert_non_null(place);
    place[3] = 20; /* a number twice: the places are taken */
    assert_success(read_bytes(bytes, size, &chunk));
    assert_int_equal(chunk->node_label[1], 2);
    ost_chunk_destroy(&chunk);
    size = load("exodus-linear-offset.gen", bytes);
    place = behind(bytes, size, "TET4");
    assert_true(place[3] == 4); /* integers; then their bytes, and in eight where they begin */
    const size_t begin = (size_t)place[14] << 8 | place[15];
    assert_true(begin < size);
    bytes[begin + 2] = 1;
    expect_refusal(bytes, size, "element 1 uses node 2");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(files_hold_two_cubes),       cmocka_unit_test(other_solids_are_read),
    cmocka_unit_test(fields_are_read_tet_by_tet), cmocka_unit_test(a_file_that_was_cut_off_is_refused),
    cmocka_unit_test(mistakes_are_named),         cmocka_unit_test(numbers_of_nodes_are_checked)};
OST_TEST_MAIN(tests)
