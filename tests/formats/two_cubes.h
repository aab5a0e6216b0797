/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FORMATS_TWO_CUBES_H
#define ORTHOSTAT_TESTS_FORMATS_TWO_CUBES_H

#include "mesh/mesh_data.h"
#include "support.h"

#include "formats/serial/formats.h"

#include <string.h>

/* The stored meshes: two cubes, [0, 2] × [0, 1]². */

/* A listener to warnings, which name the file. */
typedef struct Warnings {
    const char *file;
    int count;
} Warnings;

static void count_warning(void *listener, const char *text)
{
    Warnings *warnings = listener;
    assert_non_null(strstr(text, warnings->file));
    warnings->count++;
}

/* Reads a file that gives so many warnings, of so many nodes and tets. */
static OstMeshChunk *read_cubes(const char *path, int warnings, int nodes, int tets)
{
    OstMeshChunk *chunk = NULL;
    Warnings found = {strrchr(path, '/') + 1, 0};
    ost_warn_listen(ctx, count_warning, &found);
    if (ost_chunk_read(ctx, path, &chunk) != OST_SUCCESS)
        fail_msg("%s", ost_error_text(ctx));
    ost_warn_listen(ctx, NULL, NULL);
    assert_int_equal(found.count, warnings);
    assert_int_equal(chunk->global_nodes, nodes);
    assert_int_equal(chunk->global_tets, tets);
    return chunk;
}

static double centre_x(const OstMeshChunk *chunk, OstLocal tet)
{
    const OstGlobal *nodes = chunk->tet_nodes + (size_t)tet * (size_t)chunk->nodes_per_tet;
    double x = 0.0;
    for (int v = 0; v < 4; v++)
        x += chunk->coordinates[3 * nodes[v]] / 4.0;
    return x;
}

static double volume_of(const OstMeshChunk *chunk, const OstGlobal *nodes)
{
    double e[3][3];
    for (int i = 0; i < 3; i++)
        for (int d = 0; d < 3; d++)
            e[i][d] = chunk->coordinates[3 * nodes[i + 1] + d] - chunk->coordinates[3 * nodes[0] + d];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6.0;
}

/* Mid-edge nodes lie in the middle of their edges. */
static void check_mid_nodes(const OstMeshChunk *chunk)
{
    for (OstLocal t = 0; t < chunk->tet_count && chunk->nodes_per_tet == 10; t++) {
        const OstGlobal *nodes = chunk->tet_nodes + 10 * (size_t)t;
        for (int e = 0; e < 6; e++)
            for (int d = 0; d < 3; d++)
                assert_close(chunk->coordinates[3 * nodes[4 + e] + d],
                             0.5 * (chunk->coordinates[3 * nodes[ost_tet_edge[e][0]] + d] +
                                    chunk->coordinates[3 * nodes[ost_tet_edge[e][1]] + d]),
                             1e-12);
    }
}

/* Tets with straight edges fill both cubes. Those of each are in the region of its name, if there is one. */
static void check_cubes(const OstMeshChunk *chunk, const char *left, const char *right)
{
    double volume[2] = {0.0, 0.0};
    check_mid_nodes(chunk);
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        const double x = centre_x(chunk, t);
        volume[x > 1.0] += volume_of(chunk, chunk->tet_nodes + (size_t)t * (size_t)chunk->nodes_per_tet);
        if (left)
            assert_string_equal(chunk->regions.name[chunk->tet_region[t]], x > 1.0 ? right : left);
    }
    assert_close(volume[0], 1.0, 1e-12);
    assert_close(volume[1], 1.0, 1e-12);
}

#endif
