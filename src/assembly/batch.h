/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_BATCH_H
#define ORTHOSTAT_ASSEMBLY_BATCH_H

#include "element/element.h"
#include "mesh/mesh_data.h"
#include "orthostat/formulation.h"

/* OST_SIMD_WIDTH tets side by side, with what the kernels read of them. If only `count` tets are left, the last one
 * fills the other slots; only the first `count` results mean something. */
typedef struct OstBatch {
    int count;
    OstLocal tet[OST_SIMD_WIDTH];
    OstLocal node[OST_SIMD_WIDTH][OST_MAX_TET_NODES];
    OstSimd x[3 * OST_MAX_TET_NODES]; /* of quadratic tets less that of the first node */
    OstElasticity elasticity;
} OstBatch;

/* A linear tet's vertices in ascending order of their labels (a sorting network). */
static inline void ost_sort_vertices(const OstGlobal *label, const OstLocal *vertices, OstLocal *sorted)
{
    static const int pair[5][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {1, 2}};
    OstGlobal key[4];
    for (int a = 0; a < 4; a++) {
        sorted[a] = vertices[a];
        key[a] = label[vertices[a]];
    }
    for (int k = 0; k < 5; k++) {
        const int a = pair[k][0], b = pair[k][1], swap = key[b] < key[a];
        const OstGlobal low = swap ? key[b] : key[a], high = swap ? key[a] : key[b];
        const OstLocal first = swap ? sorted[b] : sorted[a], second = swap ? sorted[a] : sorted[b];
        key[a] = low;
        key[b] = high;
        sorted[a] = first;
        sorted[b] = second;
    }
}

/* A tet's nodes in the order that batches and the matrix's pattern use. All ranks must compute a tet in the same order:
 * the determinant of a flat one depends on it by far more than 1e-16, and rows of different ranks would not fit
 * together. With labels that ascend as the local numbers do, which is usual, a linear tet's upper triangle adds to the
 * upper triangle of K. */
static inline void ost_order_nodes(int count, const OstGlobal *label, const OstLocal *nodes, OstLocal *ordered)
{
    if (count == 4) {
        ost_sort_vertices(label, nodes, ordered);
        return;
    }
    for (int a = 0; a < count; a++)
        ordered[a] = nodes[a];
}

/* Local. Reads nodes, coordinates and elasticity of `count` tets (1 to OST_SIMD_WIDTH). */
void ost_batch_gather(OstBatch *batch, const OstElement *element, const OstMesh *mesh, const OstMaterialField *field,
                      int count, const OstLocal *tets);

/* Local. The same for the next OST_SIMD_WIDTH tets from `first` on, or as many as there are before `end`. */
void ost_batch_gather_from(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                           const OstMaterialField *field, OstLocal first, OstLocal end);

/* Local. Drops the tets from the first on that would not have the first one's quadrature rule by themselves. Rules that
 * all integrate linear elasticity without error differ where rotations are large: all ranks must take the same for a
 * tet, whatever its neighbours in the batch. */
void ost_batch_keep_alike(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                          const OstMaterialField *field);

/* Local. Reads the vectors of the batch's nodes: vectors[3 n + i] is component i at local node n. */
void ost_batch_gather_vectors(const OstBatch *batch, int nodes, const double *vectors, OstSimd *gathered);

/* Local. Adds `scale` times vectors of the batch's nodes to `sum`, which has 3 numbers for each of the first `owned`
 * local nodes; those at other nodes are left out. */
void ost_batch_scatter_vectors(const OstBatch *batch, int nodes, const OstSimd *vectors, double scale, OstLocal owned,
                               double *sum);

/* Local. Evaluates the points of the batch's quadrature into `kept`, for displacements of linear theory that follow. */
void ost_batch_keep_points(OstBatch *batch, const OstElement *element, OstKeptPoints *kept);

/* The sums of the squares of six numbers. */
static inline void ost_batch_squares(const OstSimd numbers[6], OstSimd *sum)
{
    *sum = numbers[0] * numbers[0];
    for (int p = 1; p < 6; p++)
        *sum += numbers[p] * numbers[p];
}

/* Called with each batch of owned tets, the displacements u of their nodes, and their means. */
typedef void (*OstMeansVisit)(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                              const OstMeans *means);

/* Local. Computes the means of strain, stress and energy of the owned tets under the displacement u (3 × node_count)
 * and t times the eigenstrain, batch by batch. */
void ost_visit_means(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u, OstMeansVisit visit,
                     void *data);

/* Local. The same of any formulation: with large rotations the strain is U - I, and the stress is conjugate to it. */
void ost_visit_means_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation, double t,
                        const double *u, OstMeansVisit visit, void *data);

/* Local. Such a visit: adds the energy of the tets to the double at `energy`. */
void ost_visit_energy(void *energy, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                      const OstMeans *means);

#endif
