/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"

#include "core/together/together.h"
#include "element/large_rotation.h"

void ost_batch_gather_vectors(const OstBatch *batch, int nodes, const double *vectors, OstSimd *gathered)
{
    const double *of_node[OST_SIMD_WIDTH];
    for (int a = 0; a < nodes; a++) {
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            of_node[slot] = vectors + 3 * (size_t)batch->node[slot][a];
        ost_simd_gather3(of_node, gathered + 3 * a);
    }
}

void ost_batch_scatter_vectors(const OstBatch *batch, int nodes, const OstSimd *vectors, double scale, OstLocal owned,
                               double *sum)
{
    double *of_node[OST_SIMD_WIDTH], nowhere[3] = {0.0};
    for (int a = 0; a < nodes; a++) {
        const OstSimd scaled[3] = {scale * vectors[3 * a], scale * vectors[3 * a + 1], scale * vectors[3 * a + 2]};
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const OstLocal node = batch->node[slot][a];
            of_node[slot] = slot < batch->count && node < owned ? sum + 3 * (size_t)node : nowhere;
        }
        ost_simd_scatter3(scaled, of_node);
    }
}

/* Quadratic tets sum coordinates times derivatives of shape functions. Far from the origin that would round as much as
 * the distance from there is larger than the tet. (Linear tets take differences alone.) */
static void refer_to_first_node(OstSimd *x, int nodes)
{
    for (int a = nodes - 1; a >= 0; a--)
        for (int i = 0; i < 3; i++)
            x[3 * a + i] -= x[i];
}

void ost_batch_gather(OstBatch *batch, const OstElement *element, const OstMesh *mesh, const OstMaterialField *field,
                      int count, const OstLocal *tets)
{
    const int nodes = element->nodes;
    OstSimd places[3 * OST_MAX_POINTS]; /* read only where axes come from a formula */
    batch->count = count;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const OstLocal tet = tets[slot < count ? slot : count - 1];
        batch->tet[slot] = tet;
        ost_order_nodes(nodes, mesh->node_label, mesh->tet_nodes + (size_t)nodes * (size_t)tet, batch->node[slot]);
    }
    ost_batch_gather_vectors(batch, nodes, mesh->coordinates, batch->x);
    if (field->region_formula && element->points > 0)
        element->places(batch->x, places);
    ost_elasticity_gather(&batch->elasticity, field, batch->tet, element->points,
                          element->at ? element->at->point : NULL, places);
    if (nodes > 4)
        refer_to_first_node(batch->x, nodes);
}

void ost_batch_gather_from(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                           const OstMaterialField *field, OstLocal first, OstLocal end)
{
    const OstLocal left = end - first;
    OstLocal tets[OST_SIMD_WIDTH];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        tets[slot] = first + slot;
    ost_batch_gather(batch, element, mesh, field, left < OST_SIMD_WIDTH ? (int)left : OST_SIMD_WIDTH, tets);
}

void ost_batch_keep_alike(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                          const OstMaterialField *field)
{
    const unsigned uniform = element->uniform ? element->uniform(batch->x, &batch->elasticity) : 0U;
    int count = 1;
    while (count < batch->count && (uniform >> count & 1U) == (uniform & 1U))
        count++;
    if (count < batch->count)
        ost_batch_gather_from(batch, element, mesh, field, batch->tet[0], batch->tet[0] + count);
}

void ost_batch_keep_points(OstBatch *batch, const OstElement *element, OstKeptPoints *kept)
{
    batch->elasticity.kept = NULL;
    if (!element->keep)
        return;
    element->keep(batch->x, &batch->elasticity, kept);
    batch->elasticity.kept = kept;
}

void ost_visit_means(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u, OstMeansVisit visit,
                     void *data)
{
    ost_visit_means_of(mesh, field, OST_FORMULATION_LINEAR, t, u, visit, data);
}

/* A visit: as ost_visit_means_of. */
typedef struct Request {
    const OstMesh *mesh;
    OstFormulation formulation;
    double t;
    const double *u;
    OstMeansVisit visit;
    void *data;
} Request;

static void visit_batch(const Request *request, const OstElement *element, const OstBatch *batch)
{
    OstSimd of_nodes[3 * OST_MAX_TET_NODES];
    OstMeans means;
    ost_batch_gather_vectors(batch, element->nodes, request->u, of_nodes);
    if (request->formulation == OST_FORMULATION_LINEAR)
        element->means(batch->x, &batch->elasticity, of_nodes, &means);
    else
        ost_large_rotation_means(element, request->formulation, batch->x, &batch->elasticity, of_nodes, &means);
    request->visit(request->data, batch, element, of_nodes, &means);
}

/* OstServe: of one field. */
static OstStatus visit_all(void *common, int count, void *const *request)
{
    const Request *first = request[0];
    const OstMesh *mesh = first->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstKeptPoints kept;
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = first->t;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet += batch.count) {
        ost_batch_gather_from(&batch, element, mesh, common, tet, mesh->owned_tets);
        if (first->formulation != OST_FORMULATION_LINEAR)
            ost_batch_keep_alike(&batch, element, mesh, common);
        else if (count > 1)
            ost_batch_keep_points(&batch, element, &kept);
        for (int k = 0; k < count; k++)
            visit_batch(request[k], element, &batch);
    }
    return OST_SUCCESS;
}

void ost_visit_means_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation, double t,
                        const double *u, OstMeansVisit visit, void *data)
{
    Request request = {mesh, formulation, t, u, visit, data};
    void *const alone = &request;
    if (formulation != OST_FORMULATION_LINEAR || ost_field_is_eigenstrained(field)) /* of a tet as it is then */
        (void)visit_all((void *)field, 1, &alone);
    else
        (void)ost_together(mesh->ctx, visit_all, OST_MOST_TOGETHER, (void *)field, &request);
}

void ost_visit_energy(void *energy, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                      const OstMeans *means)
{
    (void)element;
    (void)u;
    for (int slot = 0; slot < batch->count; slot++)
        *(double *)energy += means->energy[slot] * means->volume[slot];
}
