/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/buckling/stress_force.h"

#include "assembly/batch.h"
#include "core/kernel.h"
#include "element/large_rotation.h"
#include "element/point_stress.h"

#include <string.h>

/* A batch of tets with the stress at their points. */
typedef struct Stressed {
    int count;
    OstPoint point[OST_MAX_POINTS];
    OstSimd stress[OST_MAX_POINTS][9]; /* the whole matrix, times the point's volume */
} Stressed;

OST_KERNEL static void find_stresses(const OstBatch *batch, const OstElement *element, const OstSimd *u, Stressed *tets)
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    const OstElasticity *elasticity = &batch->elasticity;
    const OstQuadrature *rule = element->rule(batch->x, elasticity);
    OstMeans means;
    if (elasticity->by_mean)
        element->means(batch->x, elasticity, u, &means);
    tets->count = rule->count;
    for (int q = 0; q < rule->count; q++) {
        OstSimd gradient[9], stress[6];
        element->evaluate(batch->x, &rule->point[q], &tets->point[q]);
        ost_displacement_gradient(element->nodes, &tets->point[q], u, gradient);
        ost_point_stress(elasticity, &rule->point[q], ost_elasticity_at(elasticity, q), gradient, &means, stress);
        for (int n = 0; n < 9; n++)
            tets->stress[q][n] = stress[place[n]] * tets->point[q].volume;
    }
}

/* force += H S - ½ (S e + e S), along the shape functions' gradients. */
static inline void add_point(int nodes, const OstPoint *point, const OstSimd s[9], const OstSimd h[9], OstSimd *force)
{
    OstSimd e[9], piola[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            e[3 * i + j] = 0.5 * (h[3 * i + j] + h[3 * j + i]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            piola[3 * i + j] = (OstSimd){0};
            for (int k = 0; k < 3; k++)
                piola[3 * i + j] +=
                    (h[3 * i + k] - 0.5 * e[3 * i + k]) * s[3 * k + j] - 0.5 * s[3 * i + k] * e[3 * k + j];
        }
    for (int a = 0; a < nodes; a++) {
        const OstSimd *g = point->gradient[a];
        for (int i = 0; i < 3; i++)
            force[3 * a + i] += piola[3 * i] * g[0] + piola[3 * i + 1] * g[1] + piola[3 * i + 2] * g[2];
    }
}

OST_KERNEL static void find_forces(int nodes, const Stressed *tets, const OstSimd *v, OstSimd *force)
{
    memset(force, 0, 3 * (size_t)nodes * sizeof *force);
    for (int q = 0; q < tets->count; q++) {
        OstSimd gradient[9];
        ost_displacement_gradient(nodes, &tets->point[q], v, gradient);
        add_point(nodes, &tets->point[q], tets->stress[q], gradient, force);
    }
}

void ost_stress_force(const OstMesh *mesh, const OstMaterialField *field, double share, const double *u, int count,
                      double *const *v, double *const *force)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = share;
    for (int k = 0; k < count; k++)
        memset(force[k], 0, 3 * (size_t)mesh->owned_nodes * sizeof(double));
    for (OstLocal tet = 0; tet < mesh->tet_count; tet += batch.count) {
        OstSimd of_nodes[3 * OST_MAX_TET_NODES], of_tets[3 * OST_MAX_TET_NODES];
        Stressed tets;
        ost_batch_gather_from(&batch, element, mesh, field, tet, mesh->tet_count);
        ost_batch_keep_alike(&batch, element, mesh, field);
        ost_batch_gather_vectors(&batch, element->nodes, u, of_nodes);
        find_stresses(&batch, element, of_nodes, &tets);
        for (int k = 0; k < count; k++) {
            ost_batch_gather_vectors(&batch, element->nodes, v[k], of_nodes);
            find_forces(element->nodes, &tets, of_nodes, of_tets);
            ost_batch_scatter_vectors(&batch, element->nodes, of_tets, 1.0, mesh->owned_nodes, force[k]);
        }
    }
}
