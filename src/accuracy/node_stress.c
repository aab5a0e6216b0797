/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/operator.h"
#include "assembly/batch.h"
#include "element/biot.h"
#include "element/large_rotation.h"
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

/* What a displacement adds to F at a node of the tets. */
static void find_slope(const OstElement *element, const OstBatch *batch, int node, const OstSimd *u, int functions,
                       const OstSimd *w, OstSimd slope[9])
{
    OstSimd gradient[OST_MAX_FUNCTIONS][3];
    OstQuadraturePoint point = {.weight = 1.0};
    OstPoint of;
    find_place(node, point.at);
    element->evaluate(batch->x, &point, &of);
    ost_displacement_gradient(element->nodes, &of, u, slope);
    ost_complement_gradients(element->nodes, point.at, &of, gradient);
    for (int k = 0; k < functions; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[3 * i + j] += w[3 * k + i] * gradient[k][j];
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

/* A node's share of the mean of a polynomial: of degree 1 by the vertices, of degree 2 by the middles of the edges too.
 */
static double share_of_mean(int nodes, int node)
{
    return nodes == 4 ? 0.25 : ost_tet10_share(node);
}

/* Where C is split, the stiff mode counts by its mean over the tet. */
static void take_stress(const OstElasticity *at_nodes, int nodes, const OstSimd *strain, OstSimd *stress)
{
    OstSimd mean = {0};
    for (int a = 0; a < nodes && at_nodes->by_mean; a++)
        for (int p = 0; p < 6; p++)
            mean += share_of_mean(nodes, a) * at_nodes->m[ost_elasticity_at(at_nodes, a)][p] * strain[6 * a + p];
    for (int a = 0; a < nodes; a++) {
        const int at = ost_elasticity_at(at_nodes, a);
        ost_simd_stress(at_nodes->c[at], strain + 6 * a, stress + 6 * a);
        for (int p = 0; p < 6 && at_nodes->by_mean; p++)
            stress[6 * a + p] += mean * at_nodes->m[at][p];
    }
}

/* Of a mixed form. */
static void add_pressure(const OstElasticity *at_nodes, int nodes, OstSimd *stress)
{
    for (int a = 0; a < nodes && at_nodes->mixed; a++) {
        double place[4];
        OstSimd pressure;
        find_place(a, place);
        ost_pressure_at(at_nodes, place, &pressure);
        for (int p = 0; p < 6; p++)
            stress[6 * a + p] += pressure * at_nodes->m[ost_elasticity_at(at_nodes, a)][p];
    }
}

/* Stresses at the nodes of displacements whose F - I is there. */
static void find_small(const OstElasticity *at_nodes, int nodes, const OstSimd *slope, OstSimd *stress)
{
    OstSimd strain[6 * OST_MAX_TET_NODES];
    for (int a = 0; a < nodes; a++)
        for (int p = 0; p < 6; p++) {
            const int i = p % 3, j = (i + 1) % 3;
            const OstSimd *of = slope + 9 * a;
            strain[6 * a + p] = p < 3 ? of[4 * i] : of[3 * i + j] + of[3 * j + i];
        }
    take_stress(at_nodes, nodes, strain, stress);
    add_pressure(at_nodes, nodes, stress);
}

/* Cauchy's, of the consistent form: by how much it changes from `given`, in a frame that turns with the tet. */
static void find_large(const OstElasticity *at_nodes, int nodes, const OstSimd *given, const OstSimd *slope,
                       OstSimd *rotation, OstSimd *stress)
{
    OstSimd change[6 * OST_MAX_TET_NODES] = {{0}}, of_stretch[6 * OST_MAX_TET_NODES];
    OstPolar polar[OST_MAX_TET_NODES];
    for (int a = 0; a < nodes; a++) {
        ost_polar(given + 9 * a, &polar[a]);
        ost_polar_rotation(&polar[a], rotation + 9 * a);
        ost_biot_strain_change(&polar[a], slope + 9 * a, change + 6 * a);
    }
    take_stress(at_nodes, nodes, change, of_stretch);
    add_pressure(at_nodes, nodes, of_stretch);
    for (int a = 0; a < nodes; a++) {
        const OstSimd jacobian = polar[a].stretch[0] * polar[a].stretch[1] * polar[a].stretch[2];
        OstSimd piola[9];
        ost_biot_piola(&polar[a], of_stretch + 6 * a, piola);
        ost_kirchhoff_of_piola(piola, given + 9 * a, stress + 6 * a);
        ost_divide_by_volume(&jacobian, stress + 6 * a);
    }
}

/* Batches of tets that follow each other. */
typedef struct Visit {
    const OstOperator *operator;
    const OstElement *element;
    const double *u;
    const float *w;
    double factor;
    int functions;
    OstBatch batch;
    OstElasticity at_nodes;
    OstSimd rotation[9 * OST_MAX_TET_NODES]; /* where rotations are large */
} Visit;

static void find_added(Visit *visit, OstSimd *found)
{
    const int nodes = visit->element->nodes;
    const double *base = visit->operator->turned_by;
    OstSimd moved[3 * OST_MAX_TET_NODES], more[3 * OST_MAX_FUNCTIONS], slope[9 * OST_MAX_TET_NODES];
    ost_batch_gather_vectors(&visit->batch, nodes, visit->u, moved);
    if (visit->w)
        gather_functions(visit->operator->complement, &visit->batch, visit->w, more);
    for (int a = 0; a < nodes; a++)
        find_slope(visit->element, &visit->batch, a, moved, visit->functions, more, slope + 9 * a);
    for (int n = 0; n < 9 * nodes; n++)
        slope[n] *= visit->factor;
    if (!base) {
        find_small(&visit->at_nodes, nodes, slope, found);
        return;
    }
    OstSimd given[9 * OST_MAX_TET_NODES];
    ost_batch_gather_vectors(&visit->batch, nodes, base, moved);
    for (int a = 0; a < nodes; a++)
        find_slope(visit->element, &visit->batch, a, moved, 0, more, given + 9 * a);
    find_large(&visit->at_nodes, nodes, given, slope, visit->rotation, found);
}

static void add_mean(int nodes, const OstSimd *found, int slot, double mean[6])
{
    for (int p = 0; p < 6; p++)
        for (int a = 0; a < nodes; a++)
            mean[p] += share_of_mean(nodes, a) * found[6 * a + p][slot];
}

/* Of quadratic tets: turned back as each node has turned, then along the axes there. */
static void add_along_axes(const Visit *visit, const OstSimd *found, int slot, double along_axes[6])
{
    const double *turned_by = visit->operator->turned_by;
    const OstMaterialField *field = visit->operator->problem->field;
    const OstLocal tet = visit->batch.tet[slot];
    double x[3 * OST_MAX_TET_NODES], stress[6 * OST_MAX_TET_NODES], share[OST_MAX_TET_NODES], more[6];
    if (!ost_field_varies_within(field, field->tet_region[tet]))
        return;
    for (int n = 0; n < 30; n++)
        x[n] = visit->batch.x[n][slot];
    for (int n = 0; n < 60; n++)
        stress[n] = found[n][slot];
    for (int a = 0; a < 10 && turned_by; a++) {
        double given[6], back[9];
        memcpy(given, stress + 6 * a, sizeof given);
        for (int n = 0; n < 9; n++)
            back[n] = visit->rotation[9 * a + 3 * (n % 3) + n / 3][slot];
        ost_tensor_along(given, back, stress + 6 * a);
    }
    for (int a = 0; a < 10; a++)
        share[a] = ost_tet10_share(a);
    ost_vary_axes(field, tet, &ost_tet_nodes, share, x, stress, more);
    for (int p = 0; p < 6; p++)
        along_axes[p] += more[p];
}

void ost_operator_add_stress(const OstOperator *operator, const double * u, const float *w, double factor,
                             float *at_nodes, double *mean, double *along_axes)
{
    const OstProblem *problem = operator->problem;
    const OstMesh *mesh = problem->mesh;
    Visit visit = {.operator= operator,
                   .element = ost_element_of(mesh->nodes_per_tet),
                   .u = u,
                   .w = w,
                   .factor = factor,
                   .functions = w ? ost_complement_per_tet(operator->complement) : 0};
    const int nodes = visit.element->nodes;
    const size_t width = 6 * (size_t)nodes;
    const OstLocal end = at_nodes ? mesh->tet_count : mesh->owned_tets;
    ost_elasticity_clear(&visit.batch.elasticity);
    ost_elasticity_clear(&visit.at_nodes);
    for (OstLocal first = 0; first < end; first += OST_SIMD_WIDTH) {
        OstSimd found[6 * OST_MAX_TET_NODES];
        OstLocal tets[OST_SIMD_WIDTH];
        const int count = end - first < OST_SIMD_WIDTH ? (int)(end - first) : OST_SIMD_WIDTH;
        for (int slot = 0; slot < count; slot++)
            tets[slot] = first + slot;
        ost_batch_gather(&visit.batch, visit.element, mesh, problem->field, count, tets);
        take_own_order(mesh, &visit.batch);
        ost_elasticity_gather(&visit.at_nodes, problem->field, visit.batch.tet, visit.element->points > 0 ? nodes : 0,
                              ost_tet_nodes.point, visit.batch.x);
        find_added(&visit, found);
        for (int slot = 0; slot < count; slot++) {
            const size_t tet = (size_t)(first + slot);
            for (size_t n = 0; n < width && at_nodes; n++)
                at_nodes[width * tet + n] += (float)found[n][slot];
            if (mean && first + slot < mesh->owned_tets)
                add_mean(nodes, found, slot, mean + 6 * tet);
            if (along_axes && first + slot < mesh->owned_tets)
                add_along_axes(&visit, found, slot, along_axes + 6 * tet);
        }
    }
}
