/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/large_rotation.h"
#include "assembly/batch.h"
#include "assembly/system.h"

#include <float.h>

/* Reads the next owned tets of one quadrature rule from `first` on, and the displacements of their nodes. */
static void gather(OstBatch *batch, const OstMesh *mesh, const OstMaterialField *field, const double *u, OstLocal first,
                   OstSimd *of_nodes)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    ost_batch_gather_from(batch, element, mesh, field, first, mesh->owned_tets);
    ost_batch_keep_alike(batch, element, mesh, field);
    ost_batch_gather_vectors(batch, element->nodes, u, of_nodes);
}

double ost_large_rotation_energy_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation,
                                    double t, const double *u)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    double energy = 0.0;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = t;
    for (OstLocal first = 0; first < mesh->owned_tets; first += batch.count) {
        OstSimd of_nodes[3 * OST_MAX_TET_NODES];
        OstSimd of_tets;
        gather(&batch, mesh, field, u, first, of_nodes);
        ost_large_rotation_energy(element, formulation, batch.x, &batch.elasticity, of_nodes, &of_tets);
        for (int slot = 0; slot < batch.count; slot++)
            energy += of_tets[slot];
    }
    return energy;
}

void ost_least_stretch(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstLeastStretch *least)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    *least = (OstLeastStretch){.tet = -1, .stretch = DBL_MAX};
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += batch.count) {
        OstSimd of_nodes[3 * OST_MAX_TET_NODES];
        OstSimd stretch;
        gather(&batch, mesh, field, u, first, of_nodes);
        ost_large_rotation_least_stretch(element, batch.x, &batch.elasticity, of_nodes, &stretch);
        for (int slot = 0; slot < batch.count; slot++) {
            least->inverted += stretch[slot] < 0.0;
            if (stretch[slot] < least->stretch) {
                least->stretch = stretch[slot];
                least->tet = batch.tet[slot];
            }
        }
    }
}

void ost_deformed_volume(const OstMesh *mesh, const OstMaterialField *field, const double *u, double volumes[2])
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    volumes[0] = volumes[1] = 0.0;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += batch.count) {
        OstSimd of_nodes[3 * OST_MAX_TET_NODES], of_tets[2];
        gather(&batch, mesh, field, u, first, of_nodes);
        ost_large_rotation_volumes(element, batch.x, &batch.elasticity, of_nodes, of_tets);
        for (int slot = 0; slot < batch.count; slot++)
            for (int after = 0; after < 2; after++)
                volumes[after] += of_tets[after][slot];
    }
}
