/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/recovery.h"

#include "core/error.h"
#include "core/memory.h"
#include "element/elasticity.h"
#include "element/element.h"
#include "orthostat/case.h"

#include <string.h>

static int asks(unsigned fields, OstOutputFieldBit field)
{
    return (fields >> field & 1U) != 0;
}

/* A tet's nodes' rows of an array with 3 numbers a node. */
static void gather(const OstMesh *mesh, OstLocal tet, const double *values, double *rows)
{
    const OstLocal *nodes = mesh->tet_nodes + (size_t)mesh->nodes_per_tet * (size_t)tet;
    for (int a = 0; a < mesh->nodes_per_tet; a++)
        memcpy(rows + 3 * a, values + 3 * (size_t)nodes[a], 3 * sizeof *rows);
}

static void recover_tet(OstResult *result, const OstElement *element, OstLocal t)
{
    double x[3 * OST_MAX_TET_NODES], u[3 * OST_MAX_TET_NODES], stiffness[36], strain[6], stress[6];
    gather(result->mesh, t, result->mesh->coordinates, x);
    gather(result->mesh, t, result->displacement, u);
    element->strain(x, u, strain);
    ost_field_stiffness(result->field, t, stiffness);
    ost_stress(stiffness, strain, stress);
    if (result->strain)
        memcpy(result->strain + 6 * (size_t)t, strain, sizeof strain);
    if (result->stress)
        memcpy(result->stress + 6 * (size_t)t, stress, sizeof stress);
    if (!result->strain_energy_density)
        return;
    for (int i = 0; i < 6; i++)
        result->strain_energy_density[t] += 0.5 * stress[i] * strain[i];
}

OstStatus ost_result_recover(OstResult *result, unsigned fields)
{
    OstContext *ctx = result->ctx;
    const size_t tets = (size_t)result->mesh->owned_tets;
    const int any = asks(fields, OST_FIELD_STRAIN) || asks(fields, OST_FIELD_STRESS) || asks(fields, OST_FIELD_ENERGY);
    if (!any)
        return OST_SUCCESS;
    ost_ledger_enter(ctx, OST_LEDGER_RECOVERY);
    OstStatus status = OST_SUCCESS;
    if (asks(fields, OST_FIELD_STRAIN))
        status = OST_NEW(ctx, &result->strain, 6 * tets);
    if (status == OST_SUCCESS && asks(fields, OST_FIELD_STRESS))
        status = OST_NEW(ctx, &result->stress, 6 * tets);
    if (status == OST_SUCCESS && asks(fields, OST_FIELD_ENERGY))
        status = OST_NEW(ctx, &result->strain_energy_density, tets);
    for (OstLocal t = 0; status == OST_SUCCESS && t < result->mesh->owned_tets; t++)
        recover_tet(result, ost_element_of(result->mesh->nodes_per_tet), t);
    ost_ledger_leave(ctx);
    return status;
}
