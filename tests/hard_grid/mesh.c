/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "hard_grid/grid.h"

#include <math.h>

/* Nodes and cells are numbered with the last index fastest, six tets a cell. So the position of a node or a tet follows
 * from its number, on any rank. */

static const double thin = 1e-3; /* volume of slivers and thickness of layers, over their neighbours' */

static void unfold(OstGlobal number, const OstLocal count[3], OstLocal index[3])
{
    index[2] = (OstLocal)(number % count[2]);
    index[1] = (OstLocal)(number / count[2] % count[1]);
    index[0] = (OstLocal)(number / count[2] / count[1]);
}

/* --- slivers and layers --- */

/* Middles of the faces opposite to an inner node, in steps of the grid: x_a = 1 and -1, and x_a - x_b = 1. The tets of
 * a node fill the convex body that the twelve pairs of such faces bound, so that towards a face no tet is inverted
 * before the two that stand on it are flat. */
static void face_middle(int face, double middle[3])
{
    const int a = face % 3, b = (a + 1 + face % 2) % 3, c = 3 - a - b;
    const int kind = face / 3 % 4; /* two kinds of twelve, and two signs */
    middle[a] = kind < 2 ? 1.0 : 2.0 / 3.0;
    middle[b] = kind < 2 ? 2.0 / 3.0 : -1.0 / 3.0;
    middle[c] = 1.0 / 3.0;
    for (int d = 0; d < 3 && kind % 2 == 1; d++)
        middle[d] = -middle[d];
}

/* Every node whose indices are all odd, so that no two share a tet. */
static void flatten(const OstBlockShape *block, OstLocal number, const OstLocal index[3], double left, double x[3])
{
    double middle[3];
    for (int d = 0; d < 3; d++)
        if (index[d] % 2 == 0 || index[d] == block->divisions[d])
            return;
    face_middle((int)(number % 24), middle);
    for (int d = 0; d < 3; d++)
        x[d] += (1.0 - left) * middle[d] * block->size[d] / block->divisions[d];
}

/* Along z, every other layer of cells is a thousandth as thick as a cell is wide. */
static void squeeze(const OstBlockShape *block, const OstLocal index[3], double x[3])
{
    const int n = block->divisions[2], thin_below = index[2] / 2, thick_below = index[2] - thin_below;
    const double thin_height = thin * block->size[0] / block->divisions[0];
    const double thick_height = (block->size[2] - thin_height * (n / 2)) / (n - n / 2);
    x[2] = thin_height * thin_below + thick_height * thick_below;
}

static void move_nodes(const HardPoint *point, const OstCase *c, OstMeshChunk *chunk)
{
    const OstLocal *n = c->block.divisions;
    const OstLocal nodes[3] = {n[0] + 1, n[1] + 1, n[2] + 1};
    const int slivers = point->shape == hard_find_shape("slivers");
    const int layers = point->shape == hard_find_shape("layers");
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        OstLocal index[3];
        double *x = chunk->coordinates + 3 * (size_t)i;
        unfold(chunk->first_node + i, nodes, index);
        if (slivers)
            flatten(&c->block, (OstLocal)(chunk->first_node + i), index, point->flaw == HARD_INVERTED ? -thin : thin,
                    x);
        if (layers)
            squeeze(&c->block, index, x);
    }
}

/* --- inclusions --- */

/* Two cells of every four in each direction; the checkerboard has fields of two by two by two. */
static int is_inclusion(int checker, const OstLocal cell[3])
{
    if (checker)
        return (cell[0] / 2 + cell[1] / 2 + cell[2] / 2) % 2;
    for (int d = 0; d < 3; d++)
        if (cell[d] % 4 != 1 && cell[d] % 4 != 2)
            return 0;
    return 1;
}

static OstStatus mark_inclusions(const HardPoint *point, const OstLocal cells[3], OstMeshChunk *chunk)
{
    const int checker = point->shape == hard_find_shape("checker");
    OST_TRY(OST_RESIZE(chunk->ctx, &chunk->regions.name, 2));
    OST_TRY(ost_copy_string(chunk->ctx, "inclusion", &chunk->regions.name[1]));
    chunk->regions.count = 2;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        OstLocal cell[3];
        unfold((chunk->first_tet + t) / 6, cells, cell);
        chunk->tet_region[t] = is_inclusion(checker, cell);
    }
    return OST_SUCCESS;
}

/* --- axes --- */

/* Rotations that vary smoothly through the body: sines with fixed phases, and whole waves, so that they close around a
 * tube. `s` runs from 0 to 1 in each direction. */
static OstStatus smooth_axes(OstContext *ctx, const double s[3], double axes[9])
{
    static const double phase[3][2] = {{0.7, 4.1}, {5.3, 1.1}, {2.2, 0.4}};
    static const double wave[3][2][3] = {{{1, 0, 1}, {0, 1, -1}}, {{0, 2, 1}, {1, 1, 0}}, {{1, -1, 1}, {0, 1, 2}}};
    double degrees[3] = {0.0};
    for (int k = 0; k < 3; k++)
        for (int w = 0; w < 2; w++) {
            const double *n = wave[k][w];
            degrees[k] += 50.0 * sin(2.0 * M_PI * (n[0] * s[0] + n[1] * s[1] + n[2] * s[2]) + phase[k][w]);
        }
    return ost_axes_from_euler(ctx, "zxz", degrees, axes);
}

static OstStatus lay_axes(const OstLocal cells[3], OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_axes, 9 * (size_t)chunk->tet_count));
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        OstLocal cell[3];
        double s[3];
        unfold((chunk->first_tet + t) / 6, cells, cell);
        for (int d = 0; d < 3; d++)
            s[d] = (cell[d] + 0.5) / cells[d];
        OST_TRY(smooth_axes(chunk->ctx, s, chunk->tet_axes + 9 * (size_t)t));
    }
    return OST_SUCCESS;
}

OstStatus hard_make_chunk(const HardPoint *point, const OstCase *c, OstMeshChunk **chunk)
{
    const int tube = c->mesh_kind == OST_MESH_TUBE;
    const OstLocal round[3] = {c->tube.axial, c->tube.around, c->tube.radial};
    const OstLocal *cells = tube ? round : c->block.divisions;
    OST_TRY(tube ? ost_chunk_create_tube(c->ctx, &c->tube, chunk) : ost_chunk_create_block(c->ctx, &c->block, chunk));
    OstStatus status = OST_SUCCESS;
    move_nodes(point, c, *chunk);
    if (hard_contrast(point->shape) != 1.0)
        status = mark_inclusions(point, cells, *chunk);
    if (status == OST_SUCCESS && point->axes == 2)
        status = lay_axes(cells, *chunk);
    status = ost_agree(c->ctx, status);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    return status;
}
