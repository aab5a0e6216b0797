/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"
#include "assembly/springs.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "core/together/together.h"
#include "element/large_rotation.h"

#include <string.h>

OstStatus ost_internal_force(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                             double *force, double *magnitude)
{
    return ost_internal_force_of(mesh, field, OST_FORMULATION_LINEAR, t, u, force, magnitude);
}

/* Where forces are wanted: as ost_internal_force_of. */
typedef struct Request {
    const OstMesh *mesh;
    const OstMaterialField *field;
    OstFormulation formulation;
    double t;
    const double *u;
    double *force, *magnitude;
    double *stress;          /* grows by the squares of the owned tets' mean stresses; NULL: not wanted */
    const double *from, *to; /* of the last step, or NULL */
} Request;

static void add_squares(const OstBatch *batch, OstLocal owned_tets, const OstSimd stress[6], double *sum)
{
    OstSimd square;
    ost_batch_squares(stress, &square);
    for (int slot = 0; slot < batch->count; slot++)
        *sum += batch->tet[slot] < owned_tets ? square[slot] : 0.0;
}

static void find_turned(const Request *request, const OstElement *element, const OstBatch *batch, const OstSimd *u,
                        OstSimd *force)
{
    OstSimd from[3 * OST_MAX_TET_NODES], to[3 * OST_MAX_TET_NODES];
    const OstLastStep last = {from, to};
    if (request->from) {
        ost_batch_gather_vectors(batch, element->nodes, request->from, from);
        ost_batch_gather_vectors(batch, element->nodes, request->to, to);
    }
    ost_large_rotation_force(element, request->formulation, batch->x, &batch->elasticity, u,
                             request->from ? &last : NULL, force);
}

/* Of one batch, which is gathered. */
static void add_batch(const Request *request, const OstElement *element, const OstBatch *batch)
{
    OstSimd displacement[3 * OST_MAX_TET_NODES];
    OstSimd of_tets[3 * OST_MAX_TET_NODES];
    const OstLocal owned = request->mesh->owned_nodes;
    ost_batch_gather_vectors(batch, element->nodes, request->u, displacement);
    if (request->stress) {
        OstSimd stress[6];
        element->force_and_stress(batch->x, &batch->elasticity, displacement, of_tets, stress);
        add_squares(batch, request->mesh->owned_tets, stress, request->stress);
    } else if (request->force && request->formulation == OST_FORMULATION_LINEAR)
        element->force(batch->x, &batch->elasticity, displacement, of_tets);
    else if (request->force)
        find_turned(request, element, batch, displacement, of_tets);
    if (request->force)
        ost_batch_scatter_vectors(batch, element->nodes, of_tets, 1.0, owned, request->force);
    if (!request->magnitude)
        return;
    element->magnitude(batch->x, &batch->elasticity, displacement, of_tets);
    ost_batch_scatter_vectors(batch, element->nodes, of_tets, 1.0, owned, request->magnitude);
}

/* OstServe: of one field. */
static OstStatus add_all(void *common, int count, void *const *request)
{
    const Request *first = request[0];
    const OstMesh *mesh = first->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstKeptPoints kept;
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = first->t;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet += batch.count) {
        ost_batch_gather_from(&batch, element, mesh, common, tet, mesh->tet_count);
        if (first->formulation != OST_FORMULATION_LINEAR)
            ost_batch_keep_alike(&batch, element, mesh, common);
        else if (count > 1)
            ost_batch_keep_points(&batch, element, &kept);
        for (int k = 0; k < count; k++)
            add_batch(request[k], element, &batch);
    }
    return OST_SUCCESS;
}

static OstStatus find(Request *request)
{
    const OstMesh *mesh = request->mesh;
    const size_t bytes = 3 * (size_t)mesh->owned_nodes * sizeof *request->u;
    void *const alone = request;
    if (!ost_element_of(mesh->nodes_per_tet))
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "no tets of %d nodes are known; 4 or 10 are expected",
                         mesh->nodes_per_tet);
    if (request->force)
        memset(request->force, 0, bytes);
    if (request->magnitude)
        memset(request->magnitude, 0, bytes);
    if (request->formulation != OST_FORMULATION_LINEAR ||
        ost_field_is_eigenstrained(request->field)) /* of a tet as it is then */
        return add_all((void *)request->field, 1, &alone);
    return ost_together(mesh->ctx, add_all, OST_MOST_TOGETHER, (void *)request->field, request);
}

OstStatus ost_internal_force_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation,
                                double t, const double *u, double *force, double *magnitude)
{
    return find(&(Request){mesh, field, formulation, t, u, force, magnitude, NULL, NULL, NULL});
}

OstStatus ost_internal_force_along(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                                   const double *from, const double *to, double *force)
{
    return find(&(Request){mesh, field, OST_FORMULATION_CONSISTENT, t, u, force, NULL, NULL, from, to});
}

OstStatus ost_internal_force_and_stress(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                                        double *force, double *stress)
{
    *stress = 0.0;
    return find(&(Request){mesh, field, OST_FORMULATION_LINEAR, t, u, force, NULL, stress, NULL, NULL});
}

/* Is a displacement other than 0 prescribed at the node? */
static int is_displaced(const OstSupport *support)
{
    return (support->constrained > 0 && support->prescribed[0] != 0.0) ||
           (support->constrained > 1 && support->prescribed[1] != 0.0) ||
           (support->constrained > 2 && support->prescribed[2] != 0.0);
}

static int any_displaced(const OstSupports *supports)
{
    if (!ost_effect_on(supports->effects, OST_EFFECT_PRESCRIBED_DISPLACEMENT))
        return 0;
    if (supports->links && supports->links->moves)
        return 1;
    for (OstLocal s = 0; s < supports->count; s++)
        if (is_displaced(&supports->support[s]))
            return 1;
    return 0;
}

static int touches_displaced(const OstMesh *mesh, const OstSupports *supports, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    for (int a = 0; a < mesh->nodes_per_tet; a++) {
        const OstLocal index = supports->index[nodes[a]];
        if (index >= 0 && is_displaced(&supports->support[index]))
            return 1;
        for (size_t i = 3 * (size_t)nodes[a]; supports->links && i < 3 * (size_t)nodes[a] + 3; i++)
            if (supports->links->offset[i] != 0.0)
                return 1;
    }
    return 0;
}

/* Fills `force` (3 × owned_nodes, zero) with -K g, from springs and the tets that touch a node with g != 0. */
static OstStatus force_of_prescribed(const OstSystem *system, const OstMaterialField *field, double *force)
{
    const OstMesh *mesh = system->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstLocal tets[OST_SIMD_WIDTH];
    OstBatch batch;
    OstSimd displacement[3 * OST_MAX_TET_NODES];
    OstSimd of_tets[3 * OST_MAX_TET_NODES];
    int count = 0;
    double *g = NULL;
    OST_TRY(OST_NEW(system->ctx, &g, 3 * (size_t)mesh->node_count));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double projector[9];
        if (system->supports->index[node] >= 0 || system->supports->links)
            ost_supports_get(system->supports, node, projector, g + 3 * (size_t)node);
    }
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        if (touches_displaced(mesh, system->supports, tet))
            tets[count++] = tet;
        if (count == OST_SIMD_WIDTH || (count > 0 && tet == mesh->tet_count - 1)) {
            ost_batch_gather(&batch, element, mesh, field, count, tets);
            ost_batch_gather_vectors(&batch, element->nodes, g, displacement);
            element->force(batch.x, &batch.elasticity, displacement, of_tets);
            ost_batch_scatter_vectors(&batch, element->nodes, of_tets, -1.0, mesh->owned_nodes, force);
            count = 0;
        }
    }
    if (system->supports->spring)
        ost_spring_force(system->supports, 1.0, g, force);
    OST_FREE(g);
    return OST_SUCCESS;
}

OstStatus ost_eigenstrain_force(const OstMesh *mesh, const OstMaterialField *field, double t, double *force)
{
    OstContext *ctx = mesh->ctx;
    double *zero = NULL, *internal = NULL;
    OstStatus status = OST_NEW(ctx, &zero, 3 * (size_t)mesh->node_count);
    OST_THEN(OST_NEW(ctx, &internal, 3 * (size_t)mesh->owned_nodes));
    OST_THEN(ost_internal_force(mesh, field, t, zero, internal, NULL));
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes && status == OST_SUCCESS; i++)
        force[i] -= internal[i];
    OST_FREE(zero);
    OST_FREE(internal);
    return status;
}

/* Makes `force` (3 × owned_nodes), what prescribed displacements and eigenstrains add to the loads; NULL if
 * there are none. */
static OstStatus find_other_forces(const OstSystem *system, const OstMaterialField *field, double share, double **force)
{
    OstContext *ctx = system->ctx;
    const size_t count = 3 * (size_t)system->mesh->owned_nodes;
    OstStatus status = OST_SUCCESS;
    if (any_displaced(system->supports)) {
        ost_ledger_enter(ctx, OST_EFFECT_PRESCRIBED_DISPLACEMENT);
        status = OST_NEW(ctx, force, count);
        OST_THEN(force_of_prescribed(system, field, *force));
        ost_ledger_leave(ctx);
    }
    if (status == OST_SUCCESS && share != 0.0 && ost_field_is_eigenstrained(field)) {
        ost_ledger_enter(ctx, OST_EFFECT_EIGENSTRAIN);
        status = *force ? OST_SUCCESS : OST_NEW(ctx, force, count);
        OST_THEN(ost_eigenstrain_force(system->mesh, field, share, *force));
        ost_ledger_leave(ctx);
    }
    return status;
}

OstStatus ost_system_right_hand_side(const OstSystem *system, const OstMaterialField *field, double share,
                                     const double *force, double *rhs)
{
    const size_t count = 3 * (size_t)system->mesh->owned_nodes;
    double *total = NULL;
    OstStatus status = find_other_forces(system, field, share, &total);
    if (status == OST_SUCCESS && !total)
        status = OST_NEW(system->ctx, &total, count);
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++)
        total[i] += force[i];
    status = ost_agree(system->ctx, status);
    OST_THEN(ost_system_take_rows(system, total, rhs));
    OST_FREE(total);
    return status;
}
