/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/recovery.h"

#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/case.h"
#include "solve/node_stress.h"

static int asks(unsigned fields, OstOutputFieldBit field)
{
    return (fields >> field & 1U) != 0;
}

static void write_means(OstResult *result, const OstMeans *means, OstLocal tet, int lane)
{
    for (size_t p = 0; p < 6; p++) {
        if (result->strain)
            result->strain[6 * (size_t)tet + p] = means->strain[p][lane];
        if (result->stress)
            result->stress[6 * (size_t)tet + p] = means->stress[p][lane];
    }
    if (result->strain_energy_density)
        result->strain_energy_density[tet] = means->energy[lane];
}

static void recover_tets(OstResult *result)
{
    const OstMesh *mesh = result->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_LANES) {
        OstLanes u[3 * OST_MAX_TET_NODES];
        OstMeans means;
        ost_batch_gather_from(&batch, element, mesh, result->field, first, mesh->owned_tets);
        ost_batch_gather_vectors(&batch, element->nodes, result->displacement, u);
        element->means(batch.x, &batch.elasticity, u, &means);
        for (int lane = 0; lane < batch.count; lane++)
            write_means(result, &means, batch.tet[lane], lane);
    }
}

static OstStatus recover_means(OstResult *result, unsigned fields)
{
    OstContext *ctx = result->ctx;
    const size_t tets = (size_t)result->mesh->owned_tets;
    if (asks(fields, OST_FIELD_STRAIN))
        OST_TRY(OST_NEW(ctx, &result->strain, 6 * tets));
    if (asks(fields, OST_FIELD_STRESS))
        OST_TRY(OST_NEW(ctx, &result->stress, 6 * tets));
    if (asks(fields, OST_FIELD_ENERGY))
        OST_TRY(OST_NEW(ctx, &result->strain_energy_density, tets));
    if (result->strain || result->stress || result->strain_energy_density)
        recover_tets(result);
    return OST_SUCCESS;
}

OstStatus ost_result_recover(OstResult *result, unsigned fields)
{
    OstContext *ctx = result->ctx;
    const int at_nodes = asks(fields, OST_FIELD_NODE_STRESS);
    if (!at_nodes && !asks(fields, OST_FIELD_STRAIN) && !asks(fields, OST_FIELD_STRESS) &&
        !asks(fields, OST_FIELD_ENERGY))
        return OST_SUCCESS;
    ost_ledger_enter(ctx, OST_EFFECT_RECOVERY);
    OstStatus status = ost_agree(ctx, recover_means(result, fields));
    if (status == OST_SUCCESS && at_nodes)
        status = ost_result_recover_node_stress(result);
    ost_ledger_leave(ctx);
    return status;
}
