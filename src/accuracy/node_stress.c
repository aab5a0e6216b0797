/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/operator.h"
#include "assembly/batch.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"
#include "element/tets.h"

#include <string.h>

static void find_place(int node, double at[4])
{
    memset(at, 0, 4 * sizeof *at);
    at[node < 4 ? node : ost_tet10_ends[node][0]] += 0.5;
    at[node < 4 ? node : ost_tet10_ends[node][1]] += 0.5;
}

/* Adds the strain of the complement's functions at a node of the tets. */
static void add_functions(const OstElement *element, const OstBatch *batch, int node, int functions, const OstSimd *w,
                          OstSimd *strain)
{
    OstSimd gradient[OST_MAX_FUNCTIONS][3], slope[3][3] = {{{0}}}, more[6];
    OstQuadraturePoint point = {.weight = 1.0};
    OstPoint of;
    find_place(node, point.at);
    element->evaluate(batch->x, &point, &of);
    ost_complement_gradients(element->nodes, point.at, &of, gradient);
    for (int k = 0; k < functions; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[i][j] += w[3 * k + i] * gradient[k][j];
    ost_strain_of_slope(slope, more);
    for (int p = 0; p < 6; p++)
        strain[p] += more[p];
}

/* The complement has a tet's edges in the mesh's order of its nodes. */
static void take_own_order(const OstMesh *mesh, OstBatch *batch)
{
    const size_t nodes = (size_t)mesh->nodes_per_tet;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        memcpy(batch->node[slot], ost_mesh_nodes_of(mesh, batch->tet[slot]), nodes * sizeof **batch->node);
    ost_batch_gather_vectors(batch, (int)nodes, mesh->coordinates, batch->x);
}

static void gather_functions(const OstComplement *complement, const OstBatch *batch, const float *values, OstSimd *w)
{
    OstLocal function[OST_MAX_FUNCTIONS];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        ost_complement_of_tet(complement, batch->tet[slot], function);
        for (int k = 0; k < ost_complement_per_tet(complement); k++)
            for (int i = 0; i < 3; i++)
                w[3 * k + i][slot] = (k < 6 ? ost_complement_turn_of(complement, batch->tet[slot], k) : 1.0) *
                                     (double)values[OST_PER_FUNCTION * (size_t)function[k] + (size_t)i];
    }
}

/* Where C is split, the stiff mode counts by its mean over the tet. */
static void take_stress(const OstElasticity *at_nodes, int nodes, const OstSimd *strain, OstSimd *stress)
{
    OstSimd mean = {0};
    for (int a = 0; a < nodes && at_nodes->by_mean; a++)
        for (int p = 0; p < 6; p++)
            mean += at_nodes->m[ost_elasticity_at(at_nodes, a)][p] * strain[6 * a + p] / (double)nodes;
    for (int a = 0; a < nodes; a++) {
        const int at = ost_elasticity_at(at_nodes, a);
        ost_simd_stress(at_nodes->c[at], strain + 6 * a, stress + 6 * a);
        for (int p = 0; p < 6 && at_nodes->by_mean; p++)
            stress[6 * a + p] += mean * at_nodes->m[at][p];
    }
}

void ost_operator_node_stress(const OstOperator *operator, const double * u, const float *w, double factor,
                              float *stress)
{
    const OstProblem *problem = operator->problem;
    const OstMesh *mesh = problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    const int functions = ost_complement_per_tet(operator->complement);
    const size_t width = 6 * (size_t)element->nodes;
    OstBatch batch;
    OstElasticity at_nodes;
    ost_elasticity_clear(&batch.elasticity);
    ost_elasticity_clear(&at_nodes);
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        OstSimd moved[3 * OST_MAX_TET_NODES], more[3 * OST_MAX_FUNCTIONS];
        OstSimd strain[6 * OST_MAX_TET_NODES], found[6 * OST_MAX_TET_NODES];
        OstLocal tets[OST_SIMD_WIDTH];
        const int count = mesh->tet_count - first < OST_SIMD_WIDTH ? (int)(mesh->tet_count - first) : OST_SIMD_WIDTH;
        for (int slot = 0; slot < count; slot++)
            tets[slot] = first + slot;
        ost_batch_gather(&batch, element, mesh, problem->field, count, tets);
        take_own_order(mesh, &batch);
        ost_batch_gather_vectors(&batch, element->nodes, u, moved);
        ost_elasticity_gather(&at_nodes, problem->field, batch.tet, element->points > 0 ? element->nodes : 0, batch.x);
        gather_functions(operator->complement, &batch, w, more);
        element->nodal_strain(batch.x, moved, strain);
        for (int a = 0; a < element->nodes; a++)
            add_functions(element, &batch, a, functions, more, strain + 6 * a);
        take_stress(&at_nodes, element->nodes, strain, found);
        for (int slot = 0; slot < count; slot++)
            for (size_t n = 0; n < width; n++)
                stress[width * (size_t)(first + slot) + n] = (float)(factor * found[n][slot]);
    }
}
