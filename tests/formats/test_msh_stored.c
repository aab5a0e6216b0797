/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"
#include "two_cubes.h"

#include "mesh/mesh_data.h"

/* One mesh of two cubes, [0, 2] × [0, 1]², as Gmsh 4.8, meshio 5.0 and FreeFEM 4.11 write it, and by hand as ElmerGrid
 * does (groups of tag 0 alone, and the material as elementary tag); the counts are those of libgmsh. In two of the
 * files the volumes are also in a third group, 'all'. */
static const struct {
    const char *name;
    int nodes, named, boundaries, warnings;
} files[] = {
    {"gmsh1", 23, 0, 1, 0},
    {"gmsh2-binary", 23, 1, 1, 0},
    {"gmsh2-groups", 23, 1, 1, 2},
    {"gmsh3", 23, 1, 1, 0},
    {"gmsh3-binary", 23, 1, 1, 0},
    {"gmsh40", 23, 1, 1, 0},
    {"gmsh41-groups-binary", 23, 1, 1, 2},
    {"gmsh41-parametric", 23, 1, 1, 0},
    {"gmsh41-partitioned", 23, 1, 1, 2},
    {"gmsh41-quadratic-binary", 113, 1, 1, 0},
    {"gmsh41-views", 23, 1, 1, 0},
    {"meshio22-binary", 23, 1, 1, 0},
    {"meshio41-binary", 23, 0, 0, 0},
    {"freefem", 30, 0, 1, 0},
    {"elmer", 30, 0, 0, 0},
};
enum { FILES = sizeof files / sizeof *files };

/* Faces of 'clamp' have x = 0. */
static void check_boundary(const OstMeshChunk *chunk, int named)
{
    const OstBoundary *clamp = &chunk->boundaries[0];
    assert_string_equal(clamp->name, named ? "clamp" : "surface-7");
    assert_int_equal(clamp->count, 4);
    for (int i = 0; i < clamp->count * clamp->nodes_per_item; i++)
        assert_true(chunk->coordinates[3 * clamp->nodes[i]] == 0.0);
}

static void stored_files_are_read_as_gmsh_reads_them(void **state)
{
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (int f = 0; f < FILES; f++) {
        char path[512];
        snprintf(path, sizeof path, "%s/tests/formats/msh/%s.msh", getenv("ORTHOSTAT_SOURCE"), files[f].name);
        OstMeshChunk *chunk = read_cubes(path, files[f].warnings, files[f].nodes, 48);
        assert_int_equal(chunk->boundary_count, files[f].boundaries);
        check_cubes(chunk, files[f].named ? "left" : NULL, "right");
        if (files[f].boundaries > 0)
            check_boundary(chunk, files[f].named);
        ost_chunk_destroy(&chunk);
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(stored_files_are_read_as_gmsh_reads_them)};
OST_TEST_MAIN(tests)
