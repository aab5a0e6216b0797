/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_LIGHT_DATA_H
#define ORTHOSTAT_ACCURACY_LIGHT_LIGHT_DATA_H

#include "accuracy/complement/complement.h"

#include <string.h>

/* What is behind OstLightTets, and how numbers of eight tets are read and written. */

enum { WIDTH = 8, HALVES = WIDTH / OST_SIMD_WIDTH, OFFSETS = 12, BENDS = 18 };

/* A number of each of eight tets; and three numbers of a node or function, which are padded to four, so that they are
 * read at once. */
typedef float Eight __attribute__((vector_size(WIDTH * sizeof(float))));
typedef float Kept __attribute__((vector_size(WIDTH * sizeof(float)), aligned(16))); /* in memory */
typedef float Part __attribute__((vector_size(OST_SIMD_WIDTH * sizeof(float))));     /* of a batch */
typedef float Four __attribute__((vector_size(4 * sizeof(float)), may_alias));
typedef double Wide __attribute__((vector_size(4 * sizeof(double)), aligned(16), may_alias));

/* Eight tets; those that only fill the last ones up have no volume. */
typedef struct Eights {
    OstLocal tet[WIDTH];
    Kept gradient[3][3], volume; /* of vertices 1 to 3 */
} Eights;

/* How C is kept: one for all, or of each eight a stretch tensor with its shear (element/elasticity.h), or C itself; or,
 * of quadratic tets whose axes are known by a line, how far their vertices are from it (3 numbers each). */
typedef enum { KEEP_ONE, KEEP_STRETCH, KEEP_EACH, KEEP_OFFSETS, KEEP_NOT } Keeping;
static const size_t numbers_kept[] = {
    [KEEP_ONE] = 0, [KEEP_STRETCH] = 7, [KEEP_EACH] = OST_ELASTICITY_COUNT, [KEEP_OFFSETS] = OFFSETS};

/* The stretch tensor about a line: about_axis + radial d d' / d'd, d the offset from it. */
typedef struct AboutLine {
    float about_axis[6], radial, shear;
} AboutLine;

typedef struct OstLightTets {
    const OstMesh *mesh;
    const OstComplement *complement;
    size_t count; /* of eights */
    Eights *eights;
    Keeping keeping;
    Kept *elastic;
    Kept *bend; /* BENDS of each eight: where mid-edge nodes are, from the middle of the edge: of quadratic tets */
    AboutLine line;
    double length, modulus; /* units in which lengths and moduli are kept; their product is that of the stiffness */
    double *u, *force;      /* of nodes, padded */
    double *second;         /* u and force of the second of a pair; NULL: there was none */
} OstLightTets;

/* Three numbers of eight rows. */
static inline void transpose(const Four row[WIDTH], Eight out[3])
{
    Eight m[4];
    for (int k = 0; k < 4; k++)
        m[k] = __builtin_shufflevector(row[k], row[4 + k], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight low01 = __builtin_shufflevector(m[0], m[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight high01 = __builtin_shufflevector(m[0], m[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Eight low23 = __builtin_shufflevector(m[2], m[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight high23 = __builtin_shufflevector(m[2], m[3], 2, 10, 3, 11, 6, 14, 7, 15);
    out[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
    out[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
    out[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
}

/* The other way. */
static inline void transpose_back(const Eight in[3], Four row[WIDTH])
{
    const Eight none = {0.0F};
    const Eight low01 = __builtin_shufflevector(in[0], in[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight high01 = __builtin_shufflevector(in[0], in[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Eight low23 = __builtin_shufflevector(in[2], none, 0, 8, 1, 9, 4, 12, 5, 13);
    const Eight high23 = __builtin_shufflevector(in[2], none, 2, 10, 3, 11, 6, 14, 7, 15);
    const Eight m[4] = {__builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13),
                        __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15),
                        __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13),
                        __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15)};
    for (int k = 0; k < 4; k++) {
        row[k] = __builtin_shufflevector(m[k], m[k], 0, 1, 2, 3);
        row[4 + k] = __builtin_shufflevector(m[k], m[k], 4, 5, 6, 7);
    }
}

/* Function k of a tet: an edge's, or a face's. */
static inline OstLocal function_of(const OstLightTets *tets, const Eights *eights, int slot, int k)
{
    const OstComplement *complement = tets->complement;
    const size_t tet = (size_t)eights->tet[slot];
    return k < 6 ? complement->edges.of_tet[6 * tet + (size_t)k]
                 : complement->edges.count + complement->faces.of_tet[4 * tet + (size_t)k - 6];
}

/* The stretch tensor about a line, at barycentric coordinates; `offset` is that of the vertices. */
static inline void find_stretch_at(const AboutLine *line, const Kept offset[OFFSETS], const double at[4],
                                   Eight tensor[6])
{
    static const float tiny = 1e-30F; /* on the line itself any direction will do */
    Eight d[3];
    for (int i = 0; i < 3; i++)
        d[i] = (float)at[0] * offset[i] + (float)at[1] * offset[3 + i] + (float)at[2] * offset[6 + i] +
               (float)at[3] * offset[9 + i];
    const Eight share = line->radial / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + tiny);
    for (int i = 0; i < 3; i++) {
        const Eight part = share * d[i];
        tensor[i] = line->about_axis[i] + part * d[i];
        tensor[3 + i] = line->about_axis[3 + i] + part * d[(i + 1) % 3];
    }
}

#endif
