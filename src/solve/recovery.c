/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/recovery.h"

#include "assembly/means.h"
#include "case/case_data.h"
#include "core/error.h"
#include "core/memory.h"
#include "solve/node_stress.h"

static int asks(unsigned fields, OstOutputFieldBit field)
{
    return (fields >> field & 1U) != 0;
}

static void write_means(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                        const OstMeans *means)
{
    OstResult *result = data;
    (void)element;
    (void)u;
    for (int slot = 0; slot < batch->count; slot++) {
        const size_t tet = (size_t)batch->tet[slot];
        for (size_t p = 0; p < 6; p++) {
            if (result->strain)
                result->strain[6 * tet + p] = means->strain[p][slot];
            if (result->stress)
                result->stress[6 * tet + p] = means->stress[p][slot];
        }
        if (result->strain_energy_density)
            result->strain_energy_density[tet] = means->energy[slot];
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
        ost_visit_means(result->mesh, result->field, result->displacement, write_means, result);
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
