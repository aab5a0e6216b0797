/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"
#include "assembly/follower.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "element/element.h"
#include "element/large_rotation.h"

#include <string.h>

/* Numbers in one tet's blocks, rounded up to a multiple of four. */
enum { BLOCK_NUMBERS = 9 * OST_MAX_TET_NODES * (OST_MAX_TET_NODES + 1) / 2 + OST_SIMD_FOUR };

static inline void add_block(double *sum, const double *block)
{
    for (int i = 0; i < 8; i += OST_SIMD_FOUR)
        *(OstSimdFour *)(sum + i) += *(const OstSimdFour *)(block + i);
    sum[8] += block[8];
}

static inline void add_transposed(double *restrict sum, const double *restrict block)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum[3 * i + j] += block[3 * j + i];
}

/* Transposes the blocks, so that each tet's numbers are contiguous: returns how many there are, padding included. */
static int blocks_by_tet(const OstSimd *blocks, int count, double *numbers)
{
    const int width = (count + OST_SIMD_FOUR - 1) / OST_SIMD_FOUR * OST_SIMD_FOUR;
    for (int i = 0; i < width; i += OST_SIMD_FOUR)
        for (int from = 0; from < OST_SIMD_WIDTH; from += OST_SIMD_FOUR) {
            OstSimdFour rows[OST_SIMD_FOUR], turned[OST_SIMD_FOUR];
            for (int k = 0; k < OST_SIMD_FOUR; k++)
                rows[k] = *(const OstSimdFour *)((const double *)&blocks[i + k] + from);
            ost_simd_transpose(rows, turned);
            for (int slot = 0; slot < OST_SIMD_FOUR; slot++)
                *(OstSimdFour *)(numbers + (from + slot) * width + i) = turned[slot];
        }
    return width;
}

static void scatter(const OstBatch *batch, int nodes, const OstLocal *block_of_tet, const double *numbers, int width,
                    double *value)
{
    const int pairs = ost_pair_count(nodes);
    for (int slot = 0; slot < batch->count; slot++) {
        const OstLocal *target = block_of_tet + (size_t)pairs * (size_t)batch->tet[slot];
        const OstLocal *node = batch->node[slot];
        const double *block = numbers + slot * width;
        for (int a = 0; a < nodes; a++)
            for (int b = a; b < nodes; b++, target++, block += 9) {
                if (*target < 0)
                    continue;
                if (node[a] <= node[b])
                    add_block(value + 9 * (size_t)*target, block);
                else
                    add_transposed(value + 9 * (size_t)*target, block);
            }
    }
}

static inline OstLocal least(OstLocal a, OstLocal b)
{
    return a < b ? a : b;
}

/* Prefetches the blocks of K that the next tets will add to. */
static inline void fetch_ahead(const OstLocal *block_of_tet, size_t first, size_t end, const double *value)
{
    for (size_t i = first; i < end; i++)
        if (block_of_tet[i] >= 0) {
            __builtin_prefetch(value + 9 * (size_t)block_of_tet[i], 1);
            __builtin_prefetch(value + 9 * (size_t)block_of_tet[i] + 8, 1);
        }
}

static void tangent_stiffness(const OstBatch *batch, const OstElement *element, const OstTangent *tangent,
                              OstSimd *blocks)
{
    OstSimd u[3 * OST_MAX_TET_NODES], from[3 * OST_MAX_TET_NODES], to[3 * OST_MAX_TET_NODES];
    const OstLastStep last = {from, to};
    ost_batch_gather_vectors(batch, element->nodes, tangent->u, u);
    if (tangent->from) {
        ost_batch_gather_vectors(batch, element->nodes, tangent->from, from);
        ost_batch_gather_vectors(batch, element->nodes, tangent->to, to);
    }
    ost_large_rotation_stiffness(element, tangent->formulation, batch->x, &batch->elasticity, u,
                                 tangent->from ? &last : NULL, tangent->definite, blocks);
}

/* The linear stiffness if `tangent` is NULL. */
static void sum_tets(OstSystem *system, const OstMaterialField *field, const OstTangent *tangent)
{
    const OstMesh *mesh = system->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    const size_t pairs = (size_t)ost_pair_count(element->nodes);
    const int count = 9 * (int)pairs;
    OstBatch batch;
    OstSimd blocks[BLOCK_NUMBERS];
    double numbers[BLOCK_NUMBERS * OST_SIMD_WIDTH];
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = tangent ? tangent->t : 0.0;
    batch.elasticity.stretch_suffices = element->points == 0 && !tangent; /* only the linear stiffness does without C */
    for (OstLocal first = 0; first < mesh->tet_count; first += batch.count) {
        fetch_ahead(system->block_of_tet, pairs * (size_t)least(first + OST_SIMD_WIDTH, mesh->tet_count),
                    pairs * (size_t)least(first + 2 * OST_SIMD_WIDTH, mesh->tet_count), system->matrix->value);
        ost_batch_gather_from(&batch, element, mesh, field, first, mesh->tet_count);
        if (tangent)
            ost_batch_keep_alike(&batch, element, mesh, field);
        if (tangent)
            tangent_stiffness(&batch, element, tangent, blocks);
        else
            element->stiffness(batch.x, &batch.elasticity, blocks);
        const int width = blocks_by_tet(blocks, count, numbers);
        scatter(&batch, element->nodes, system->block_of_tet, numbers, width, system->matrix->value);
    }
}

OstStatus ost_system_fill(OstSystem *system, const OstMaterialField *field)
{
    return ost_system_fill_tangent(system, field, NULL);
}

OstStatus ost_system_fill_tangent(OstSystem *system, const OstMaterialField *field, const OstTangent *tangent)
{
    OstContext *ctx = system->ctx;
    if (system->whole) {
        const OstStatus filled = ost_agree(ctx, ost_system_fill_tangent(system->whole, field, tangent));
        return filled == OST_SUCCESS ? ost_system_condense(system, tangent ? tangent->turning : NULL) : filled;
    }
    if (!system->block_of_tet)
        return OST_RAISE(ctx, OST_INVALID_USAGE,
                         "the stiffness cannot be filled again: its scatter map has been released");
    ost_ledger_enter(ctx, OST_LEDGER_STIFFNESS);
    ost_triangle_clear(system->matrix);
    sum_tets(system, field, tangent);
    const OstStatus status = ost_triangle_mirror(system->matrix);
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        return status;
    if (tangent && tangent->follower) {
        ost_ledger_enter(ctx, OST_EFFECT_FOLLOWER_PRESSURE);
        ost_follower_stiffen(tangent->follower, tangent->factor, tangent->u, system);
        ost_ledger_leave(ctx);
    }
    ost_system_apply_supports(system);
    return status;
}

void ost_triangle_clear(OstBlockMatrix *matrix)
{
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const size_t first = (size_t)matrix->diagonal[row];
        const size_t end = (size_t)matrix->row_start[row + 1];
        memset(matrix->value + 9 * first, 0, 9 * (end - first) * sizeof(double));
    }
}

/* As rows ascend, each row's blocks right of the diagonal are needed in their order: next[r] is the next one of row r.
 */
OstStatus ost_triangle_mirror(OstBlockMatrix *matrix)
{
    OstLocal *next = NULL;
    OST_TRY(OST_NEW(matrix->ctx, &next, matrix->rows));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        for (OstLocal block = matrix->row_start[row]; block < matrix->diagonal[row]; block++) {
            const OstLocal mirror = next[matrix->column[block]]++;
            const double *source = matrix->value + 9 * (size_t)mirror;
            double *target = matrix->value + 9 * (size_t)block;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    target[3 * i + j] = source[3 * j + i];
        }
        next[row] = matrix->diagonal[row] + 1;
    }
    OST_FREE(next);
    return OST_SUCCESS;
}
