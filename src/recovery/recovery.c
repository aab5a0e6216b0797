/* SPDX-License-Identifier: BSD-3-Clause */
#include "recovery/recovery.h"

#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/together/together.h"
#include "element/large_rotation.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"
#include "element/tets.h"
#include "fields/output_field.h"
#include "recovery/derived.h"

#include <string.h>

/* Fields of stress along material axes, which turn with the body. */
enum { ALONG_AXES = OST_LOAD_FACTORS | 1U << OST_FIELD_MATERIAL_STRESS };

static int asks(unsigned fields, OstOutputFieldBit field)
{
    return (fields >> field & 1U) != 0;
}

static void write_six(const OstBatch *batch, const OstSimd numbers[6], double *of_tets)
{
    OstSimdFour first[OST_SIMD_WIDTH], rest[OST_SIMD_WIDTH]; /* four numbers and two */
    ost_simd_rows(4, numbers, first);
    ost_simd_rows(2, numbers + 4, rest);
    for (int slot = 0; slot < batch->count; slot++) {
        double *of_tet = of_tets + 6 * (size_t)batch->tet[slot];
        *(OstSimdFour *)of_tet = first[slot];
        *(OstSimdTwo *)(of_tet + 4) = __builtin_shufflevector(rest[slot], rest[slot], 0, 1);
    }
}

static void write_means(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                        const OstMeans *means)
{
    OstResult *result = data;
    OstSimd stress[6], rotation[9];
    memcpy(stress, means->stress, sizeof stress);
    if (result->formulation != OST_FORMULATION_LINEAR && result->stress)
        ost_large_rotation_mean_stress(element, result->formulation, batch->x, &batch->elasticity, u, stress);
    if (result->rotation)
        ost_large_rotation_mean_rotation(element, batch->x, &batch->elasticity, u, rotation);
    if (result->strain)
        write_six(batch, means->strain, result->strain);
    if (result->stress)
        write_six(batch, stress, result->stress);
    for (int slot = 0; slot < batch->count; slot++) {
        const size_t tet = (size_t)batch->tet[slot];
        for (size_t n = 0; result->rotation && n < 9; n++)
            result->rotation[9 * tet + n] = rotation[n][slot];
        if (result->strain_energy_density)
            result->strain_energy_density[tet] = means->energy[slot];
    }
}

/* Makes room for a field that is asked for. */
static OstStatus make_room(OstResult *result, int is_asked, size_t numbers, double **values, int *is_new)
{
    if (!is_asked || *values)
        return OST_SUCCESS;
    *is_new = 1;
    return OST_NEW_UNCLEARED(result->ctx, values, numbers * (size_t)result->mesh->owned_tets);
}

OstStatus ost_result_prepare_means(OstResult *result, unsigned fields, OstMeansVisit *visit)
{
    const unsigned needed = ost_output_fields_needed(fields);
    const int turns = result->formulation != OST_FORMULATION_LINEAR && (needed & ALONG_AXES) != 0;
    int is_new = 0;
    *visit = NULL;
    if (!asks(needed, OST_FIELD_STRAIN) && !asks(needed, OST_FIELD_STRESS) && !asks(needed, OST_FIELD_ENERGY))
        return OST_SUCCESS;
    ost_ledger_enter(result->ctx, OST_EFFECT_RECOVERY);
    OstStatus status = make_room(result, asks(needed, OST_FIELD_STRAIN), 6, &result->strain, &is_new);
    OST_THEN(make_room(result, asks(needed, OST_FIELD_STRESS), 6, &result->stress, &is_new));
    OST_THEN(make_room(result, asks(needed, OST_FIELD_ENERGY), 1, &result->strain_energy_density, &is_new));
    if (is_new)
        OST_THEN(make_room(result, turns, 9, &result->rotation, &is_new));
    ost_ledger_leave(result->ctx);
    if (is_new)
        *visit = write_means;
    return status;
}

static OstStatus recover_means(OstResult *result, unsigned fields)
{
    OstMeansVisit visit;
    OST_TRY(ost_result_prepare_means(result, fields, &visit));
    if (visit)
        ost_visit_means_of(result->mesh, result->field, result->formulation, result->t, result->displacement, visit,
                           result);
    return OST_SUCCESS;
}

/* Of each owned node: the lowest region of the tets around it, and the volume of that region's tets. */
typedef struct Around {
    int32_t *region;
    double *volume;
} Around;

/* A result whose stress at the nodes is wanted. */
typedef struct Request {
    const OstResult *result;
    double *stress; /* 6 × node_count */
} Request;

static const OstLocal *nodes_of(const OstMesh *mesh, OstLocal tet)
{
    return mesh->tet_nodes + (size_t)mesh->nodes_per_tet * (size_t)tet;
}

static void find_regions(const OstMesh *mesh, int32_t *region)
{
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        region[node] = INT32_MAX;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++)
        for (int a = 0; a < mesh->nodes_per_tet; a++) {
            const OstLocal node = nodes_of(mesh, tet)[a];
            if (node < mesh->owned_nodes && mesh->tet_region[tet] < region[node])
                region[node] = mesh->tet_region[tet];
        }
}

/* C at the nodes, and what the strain there takes. */
static void gather_at_nodes(const OstResult *result, const OstElement *element, const OstBatch *batch,
                            OstElasticity *at_nodes, OstKeptPoints *kept)
{
    if (element->keep_nodes && result->formulation == OST_FORMULATION_LINEAR)
        element->keep_nodes(batch->x, kept);
    OstSimd places[3 * OST_MAX_TET_NODES];
    ost_batch_gather_vectors(batch, element->nodes, result->mesh->coordinates, places);
    ost_elasticity_gather(at_nodes, result->field, batch->tet, element->points > 0 ? element->nodes : 0,
                          ost_tet_nodes.point, places);
}

/* Do a tet's nodes have one stress? */
static int is_uniform(const OstResult *result, const OstElement *element)
{
    return element->nodes == 4 && result->formulation == OST_FORMULATION_LINEAR;
}

/* Stress at the nodes of a batch's tets, 6 numbers a node; at the first alone where it is uniform. */
static void stress_of_batch(const OstResult *result, const OstElement *element, const OstBatch *batch,
                            const OstElasticity *at_nodes, const OstKeptPoints *kept, OstSimd *stress)
{
    OstSimd u[3 * OST_MAX_TET_NODES];
    OstSimd strain[6 * OST_MAX_TET_NODES];
    OstMeans means;
    ost_batch_gather_vectors(batch, element->nodes, result->displacement, u);
    if (result->formulation != OST_FORMULATION_LINEAR) {
        ost_large_rotation_nodal_stress(element, result->formulation, batch->x, &batch->elasticity, at_nodes, u,
                                        stress);
        return;
    }
    element->nodal_strain(batch->x, kept, u, strain);
    if (at_nodes->by_mean)
        element->means(batch->x, &batch->elasticity, u, &means);
    for (int a = 0; a < (element->nodes == 4 ? 1 : element->nodes); a++) {
        const int at = ost_elasticity_at(at_nodes, a);
        OstSimd elastic[6];
        ost_elastic_strain(at_nodes, at, strain + 6 * a, elastic);
        ost_simd_stress(at_nodes->c[at], elastic, stress + 6 * a);
        for (int p = 0; p < 6 && at_nodes->by_mean; p++) /* where C is split, the stiff mode's part is its mean */
            stress[6 * a + p] += means.stiff * at_nodes->m[at][p];
        if (at_nodes->mixed) {
            const OstSimd *pressure = batch->elasticity.pressure;
            const int *end = ost_tet10_ends[a];
            for (int p = 0; p < 6; p++)
                stress[6 * a + p] += 0.5 * (pressure[end[0]] + pressure[end[1]]) * at_nodes->m[at][p];
        }
    }
}

void ost_tet_nodal_stress(const OstResult *result, OstLocal tet, double *stress)
{
    const OstElement *element = ost_element_of(result->mesh->nodes_per_tet);
    OstSimd all[6 * OST_MAX_TET_NODES];
    OstKeptPoints kept;
    OstBatch batch;
    OstElasticity at_nodes;
    ost_elasticity_clear(&batch.elasticity);
    ost_elasticity_clear(&at_nodes);
    batch.elasticity.eigen_share = at_nodes.eigen_share = result->t;
    ost_batch_gather(&batch, element, result->mesh, result->field, 1, &tet);
    gather_at_nodes(result, element, &batch, &at_nodes, &kept);
    stress_of_batch(result, element, &batch, &at_nodes, &kept, all);
    for (int n = 0; n < 6 * element->nodes; n++)
        stress[n] = all[is_uniform(result, element) ? n % 6 : n][0];
}

/* Stress at the points of a rule, 6 numbers each. */
static void stress_at(const OstResult *result, const OstElement *element, const OstBatch *batch,
                      const OstQuadrature *rule, const OstElasticity *at_points, OstSimd *stress)
{
    OstSimd u[3 * OST_MAX_TET_NODES];
    OstMeans means;
    ost_batch_gather_vectors(batch, element->nodes, result->displacement, u);
    if (result->formulation != OST_FORMULATION_LINEAR) {
        ost_large_rotation_stress_at(element, result->formulation, batch->x, &batch->elasticity, at_points, rule->count,
                                     rule->point, u, stress);
        return;
    }
    if (at_points->by_mean)
        element->means(batch->x, &batch->elasticity, u, &means);
    for (int q = 0; q < rule->count; q++, stress += 6) {
        const int at = ost_elasticity_at(at_points, q);
        OstSimd slope[9], strain[6], elastic[6], pressure;
        OstPoint point;
        element->evaluate(batch->x, &rule->point[q], &point);
        ost_displacement_gradient(element->nodes, &point, u, slope);
        for (int i = 0; i < 3; i++) {
            strain[i] = slope[4 * i];
            strain[3 + i] = slope[3 * i + (i + 1) % 3] + slope[3 * ((i + 1) % 3) + i];
        }
        ost_elastic_strain(at_points, at, strain, elastic);
        ost_simd_stress(at_points->c[at], elastic, stress);
        if (at_points->mixed)
            ost_pressure_at(&batch->elasticity, rule->point[q].at, &pressure);
        for (int p = 0; p < 6; p++) {
            if (at_points->by_mean)
                stress[p] += means.stiff * at_points->m[at][p];
            if (at_points->mixed)
                stress[p] += pressure * at_points->m[at][p];
        }
    }
}

/* A stress less what the tet has turned. */
static void turn_back(const double rotation[9], double stress[6])
{
    double given[6], frame[9];
    memcpy(given, stress, sizeof given);
    for (int n = 0; n < 9; n++)
        frame[n] = rotation[3 * (n % 3) + n / 3];
    ost_tensor_along(given, frame, stress);
}

static void find_places(const OstMesh *mesh, const OstBatch *batch, const OstQuadrature *rule, OstSimd *places)
{
    OstSimd x[3 * OST_MAX_TET_NODES];
    ost_batch_gather_vectors(batch, mesh->nodes_per_tet, mesh->coordinates, x);
    for (int q = 0; q < rule->count; q++) {
        double shape[OST_MAX_TET_NODES];
        ost_shape_values(mesh->nodes_per_tet, rule->point[q].at, shape);
        for (int i = 0; i < 3; i++) {
            places[3 * q + i] = shape[0] * x[i];
            for (int a = 1; a < mesh->nodes_per_tet; a++)
                places[3 * q + i] += shape[a] * x[3 * a + i];
        }
    }
}

void ost_tet_mean_along_axes(const OstResult *result, OstLocal tet, double own[6])
{
    const OstElement *element = ost_element_of(result->mesh->nodes_per_tet);
    const OstQuadrature *rule = &ost_tet_degree5;
    OstSimd places[3 * OST_MAX_POINTS], all[6 * OST_MAX_POINTS];
    double x[3 * OST_MAX_POINTS], stress[6 * OST_MAX_POINTS], weight[OST_MAX_POINTS], more[6], volume = 0.0;
    OstBatch batch;
    OstElasticity at_points;
    ost_result_material_stress(result, tet, result->stress + 6 * (size_t)tet, own);
    if (element->nodes != 10 || !ost_field_varies_within(result->field, result->mesh->tet_region[tet]))
        return;
    ost_elasticity_clear(&batch.elasticity);
    ost_elasticity_clear(&at_points);
    batch.elasticity.eigen_share = at_points.eigen_share = result->t;
    ost_batch_gather(&batch, element, result->mesh, result->field, 1, &tet);
    find_places(result->mesh, &batch, rule, places);
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        element->evaluate(batch.x, &rule->point[q], &point);
        weight[q] = point.volume[0];
        volume += weight[q];
        for (int i = 0; i < 3; i++)
            x[3 * q + i] = places[3 * q + i][0];
    }
    ost_elasticity_gather(&at_points, result->field, batch.tet, rule->count, rule->point, places);
    stress_at(result, element, &batch, rule, &at_points, all);
    for (int n = 0; n < 6 * rule->count; n++)
        stress[n] = all[n][0];
    for (int q = 0; q < rule->count && result->rotation; q++)
        turn_back(result->rotation + 9 * (size_t)tet, stress + 6 * q);
    ost_vary_axes(result->field, tet, rule, weight, x, stress, more);
    for (int p = 0; p < 6; p++)
        own[p] += more[p] / volume;
}

/* The rotation of a tet's mean F under the displacement, and under that with the estimated error. */
static void find_rotations(const OstResult *result, OstLocal tet, double before[9], double after[9])
{
    const OstElement *element = ost_element_of(result->mesh->nodes_per_tet);
    OstSimd u[3 * OST_MAX_TET_NODES], error[3 * OST_MAX_TET_NODES], of_u[9], of_both[9];
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    ost_batch_gather(&batch, element, result->mesh, result->field, 1, &tet);
    ost_batch_gather_vectors(&batch, element->nodes, result->displacement, u);
    ost_batch_gather_vectors(&batch, element->nodes, result->surplus, error);
    for (int n = 0; n < 3 * element->nodes; n++)
        error[n] += u[n];
    ost_large_rotation_mean_rotation(element, batch.x, &batch.elasticity, u, of_u);
    ost_large_rotation_mean_rotation(element, batch.x, &batch.elasticity, error, of_both);
    for (int n = 0; n < 9; n++) {
        before[n] = of_u[n][0];
        after[n] = of_both[n][0];
    }
}

void ost_turn_with_error(const OstResult *result, OstLocal tet, OstStressMeasure measure, int count, double *stress)
{
    double before[9], after[9], turn[9] = {0.0};
    if (result->formulation == OST_FORMULATION_LINEAR || !result->surplus || measure > OST_STRESS_MEASURE_ZX)
        return;
    find_rotations(result, tet, before, after);
    for (int n = 0; n < 27; n++)
        turn[n / 3] += after[3 * (n / 9) + n % 3] * before[3 * (n / 3 % 3) + n % 3];
    for (int k = 0; k < count; k++) {
        double given[6];
        memcpy(given, stress + 6 * k, sizeof given);
        ost_tensor_along(given, turn, stress + 6 * k);
    }
}

/* Adds the volumes of a batch's tets to the nodes around, and finds each tet's shares: 0 at nodes that belong to
 * another region, or to another rank. */
static void add_volumes(const OstMesh *mesh, int nodes, const OstBatch *batch, const Around *around,
                        double share[OST_SIMD_WIDTH][OST_MAX_TET_NODES])
{
    for (int slot = 0; slot < batch->count; slot++) {
        const OstLocal tet = batch->tet[slot];
        const double volume = fabs(ost_tet_volume(mesh->coordinates, nodes_of(mesh, tet)));
        for (int a = 0; a < nodes; a++) {
            const OstLocal node = batch->node[slot][a];
            const int counts = node < mesh->owned_nodes && mesh->tet_region[tet] == around->region[node];
            share[slot][a] = counts ? volume : 0.0;
            if (counts)
                around->volume[node] += volume;
        }
    }
}

static void add(const OstSimdFour *first, const OstSimdTwo *last, double share, double *at_node)
{
    if (!(share > 0.0)) /* a node elsewhere has no place in the sum */
        return;
    *(OstSimdFour *)at_node += share * *first;
    *(OstSimdTwo *)(at_node + 4) += share * *last;
}

static void add_batch(int nodes, int uniform, const OstBatch *batch,
                      const double share[OST_SIMD_WIDTH][OST_MAX_TET_NODES], const OstSimd *stress, double *sum)
{
    OstSimdFour first[OST_SIMD_WIDTH], rest[OST_SIMD_WIDTH]; /* four numbers and two */
    for (int a = 0; a < nodes; a++) {
        if (a == 0 || !uniform) {
            ost_simd_rows(4, stress + 6 * a, first);
            ost_simd_rows(2, stress + 6 * a + 4, rest);
        }
        for (int slot = 0; slot < batch->count; slot++) {
            const OstSimdTwo last = __builtin_shufflevector(rest[slot], rest[slot], 0, 1);
            add(&first[slot], &last, share[slot][a], sum + 6 * (size_t)batch->node[slot][a]);
        }
    }
}

/* Of tets whose uniform stress is known. */
static void add_known(int nodes, const OstBatch *batch, const double share[OST_SIMD_WIDTH][OST_MAX_TET_NODES],
                      const double *stress, double *sum)
{
    for (int slot = 0; slot < batch->count; slot++) {
        const double *of_tet = stress + 6 * (size_t)batch->tet[slot];
        for (int a = 0; a < nodes; a++)
            add((const OstSimdFour *)of_tet, (const OstSimdTwo *)(of_tet + 4), share[slot][a],
                sum + 6 * (size_t)batch->node[slot][a]);
    }
}

static void average(int count, void *const *request, const Around *around)
{
    const OstResult *first_result = ((const Request *)request[0])->result;
    const OstMesh *mesh = first_result->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstKeptPoints kept;
    OstBatch batch;
    OstElasticity at_nodes;
    ost_elasticity_clear(&batch.elasticity);
    ost_elasticity_clear(&at_nodes);
    batch.elasticity.eigen_share = at_nodes.eigen_share = first_result->t;
    find_regions(mesh, around->region);
    for (OstLocal first = 0; first < mesh->tet_count; first += batch.count) {
        double share[OST_SIMD_WIDTH][OST_MAX_TET_NODES];
        ost_batch_gather_from(&batch, element, mesh, first_result->field, first, mesh->tet_count);
        if (first_result->formulation != OST_FORMULATION_LINEAR)
            ost_batch_keep_alike(&batch, element, mesh, first_result->field);
        gather_at_nodes(first_result, element, &batch, &at_nodes, &kept);
        add_volumes(mesh, element->nodes, &batch, around, share);
        for (int k = 0; k < count; k++) {
            const Request *one = request[k];
            const int uniform = is_uniform(one->result, element);
            OstSimd stress[6 * OST_MAX_TET_NODES];
            if (uniform && one->result->stress && first + batch.count <= mesh->owned_tets) {
                add_known(element->nodes, &batch, share, one->result->stress, one->stress);
                continue;
            }
            stress_of_batch(one->result, element, &batch, &at_nodes, &kept, stress);
            add_batch(element->nodes, uniform, &batch, share, stress, one->stress);
        }
    }
    for (int k = 0; k < count; k++)
        for (size_t n = 0; n < 6 * (size_t)mesh->owned_nodes; n++)
            ((const Request *)request[k])->stress[n] /= around->volume[n / 6];
}

/* OstServe: of one field. */
static OstStatus average_all(void *field, int count, void *const *request)
{
    const OstMesh *mesh = ((const Request *)request[0])->result->mesh;
    Around around = {0};
    (void)field;
    OstStatus status = OST_NEW(mesh->ctx, &around.volume, mesh->owned_nodes);
    OST_THEN(OST_NEW(mesh->ctx, &around.region, mesh->owned_nodes));
    if (status == OST_SUCCESS)
        average(count, request, &around);
    OST_FREE(around.volume, around.region);
    return status;
}

/* Collective. Makes result->node_stress, ghosts included (see recovery.h). */
static OstStatus recover_node_stress(OstResult *result)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    const int is_own = result->formulation != OST_FORMULATION_LINEAR || ost_field_is_eigenstrained(result->field);
    Request request = {.result = result};
    void *const alone = &request;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &request.stress, 6 * (size_t)mesh->node_count)));
    OstStatus status = is_own ? average_all(NULL, 1, &alone)
                              : ost_together(ctx, average_all, OST_MOST_TOGETHER, (void *)result->field, &request);
    status = ost_agree(ctx, status);
    OST_THEN(ost_agree(ctx, ost_halo_import(mesh->halo, 6 * sizeof(double), request.stress)));
    if (status != OST_SUCCESS)
        OST_FREE(request.stress);
    result->node_stress = request.stress;
    return status;
}

/* Collective. */
static OstStatus recover(OstResult *result, unsigned fields)
{
    OST_TRY(ost_agree(result->ctx, recover_means(result, fields)));
    return asks(fields, OST_FIELD_NODE_STRESS) ? recover_node_stress(result) : OST_SUCCESS;
}

OstStatus ost_result_recover(OstResult *result, unsigned asked)
{
    const unsigned fields = ost_output_fields_needed(asked);
    unsigned recovered = 0;
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        recovered |= (unsigned)ost_output_field((OstOutputFieldBit)f).is_recovered << f;
    if (!(fields & recovered))
        return OST_SUCCESS;
    ost_ledger_enter(result->ctx, OST_EFFECT_RECOVERY);
    OstStatus status = recover(result, fields);
    ost_ledger_leave(result->ctx);
    if (status != OST_SUCCESS || !(asked & OST_LOAD_FACTORS) || !ost_field_has_strengths(result->field))
        return status;
    ost_ledger_enter(result->ctx, OST_EFFECT_STRENGTH);
    status = ost_result_find_failure(result);
    ost_ledger_leave(result->ctx);
    return status;
}
