/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tets.h"

#include "core/kernel.h"

#include <string.h>

enum { BLOCK = 9, LINEAR_BLOCKS = 10 * BLOCK };

/* sum += weight × block ij of the linear tet */
static inline void add(OstSimd *restrict sum, double weight, const OstSimd *restrict linear, int i, int j)
{
    if (i <= j) {
        const OstSimd *block = linear + BLOCK * ost_pair_index(4, i, j);
        for (int n = 0; n < BLOCK; n++)
            sum[n] += weight * block[n];
    } else {
        const OstSimd *block = linear + BLOCK * ost_pair_index(4, j, i);
        for (int n = 0; n < BLOCK; n++)
            sum[n] += weight * block[3 * (n % 3) + n / 3];
    }
}

/* Gradients are (4 L_a - 1) g_a at a vertex node and 4 (L_a g_b + L_b g_a) at a mid-edge node, with g the gradients of
 * the barycentric coordinates L. The mean of L_c L_d over the tet is 1/20, and 1/10 for c = d. */
static void add_pair(const OstSimd *linear, int a, int b, OstSimd *block)
{
    const int *end_a = ost_tet10_ends[a];
    const int *end_b = ost_tet10_ends[b];
    if (b < 4) {
        add(block, a == b ? 0.6 : -0.2, linear, a, b);
        return;
    }
    for (int d = 0; d < 2; d++) {
        if (a < 4) {
            add(block, a == end_b[d] ? 0.6 : -0.2, linear, a, end_b[1 - d]);
            continue;
        }
        for (int c = 0; c < 2; c++)
            add(block, end_a[c] == end_b[d] ? 1.6 : 0.8, linear, end_a[1 - c], end_b[1 - d]);
    }
}

OST_KERNEL void ost_tet10_straight_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks)
{
    OstSimd linear[LINEAR_BLOCKS];
    ost_tet4_blocks(x, c, linear);
    for (int a = 0; a < 10; a++)
        for (int b = a; b < 10; b++, blocks += BLOCK) {
            OstSimd block[BLOCK] = {{0}};
            add_pair(linear, a, b, block);
            memcpy(blocks, block, sizeof block);
        }
}
