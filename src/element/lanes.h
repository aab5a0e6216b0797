/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_LANES_H
#define ORTHOSTAT_ELEMENT_LANES_H

/* Several tets side by side: one number of each. Kernels are written for lanes as one would write them for one tet, and
 * the processor works on all lanes at once; where it has no such registers the compiler takes the vectors apart. */
enum { OST_LANES = 4 };
typedef double OstLanes __attribute__((vector_size(OST_LANES * sizeof(double))));

/* Lanes at any address of doubles. (By memcpy the compiler may move them in halves through the stack, and wait for
 * both.)
 */
typedef double OstAnyLanes __attribute__((vector_size(OST_LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Turns four vectors into the four numbers of each lane, side by side. */
static inline void ost_lanes_transpose(const OstLanes in[OST_LANES], OstLanes out[OST_LANES])
{
    const OstLanes low01 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
    const OstLanes high01 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
    const OstLanes low23 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
    const OstLanes high23 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
    out[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    out[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

#endif
