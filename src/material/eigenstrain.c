/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "material/field_data.h"

#include <string.h>

int ost_field_is_eigenstrained(const OstMaterialField *field)
{
    return field->region_eigenstrain || field->tet_eigenstrain;
}

/* e_ij = sum of E_ab a_i b_j over the axes a and b; shear is twice the tensor's. */
void ost_strain_to_world(const double strain[6], const double axes[9], double world[6])
{
    memset(world, 0, 6 * sizeof *world);
    for (int p = 0; p < 6; p++) {
        const double *a = axes + 3 * (p % 3);
        const double *b = axes + 3 * ((p < 3 ? p : p + 1) % 3);
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3;
            world[i] += strain[p] * a[i] * b[i];
            world[3 + i] += strain[p] * (p < 3 ? 2.0 * a[i] * a[j] : a[i] * b[j] + a[j] * b[i]);
        }
    }
}

void ost_tensor_along(const double tensor[6], const double axes[9], double own[6])
{
    for (int p = 0; p < 6; p++) {
        const double *a = axes + 3 * (p % 3);
        const double *b = axes + 3 * ((p < 3 ? p : p + 1) % 3);
        own[p] = 0.0;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3;
            own[p] += tensor[i] * a[i] * b[i] + tensor[3 + i] * (a[i] * b[j] + a[j] * b[i]);
        }
    }
}

void ost_field_add_eigenstrain(const OstMaterialField *field, OstLocal tet, double share, const double axes[9],
                               double strain[6])
{
    double own[6] = {0.0}, world[6];
    for (size_t p = 0; p < 6; p++) {
        if (field->region_eigenstrain)
            own[p] += field->region_eigenstrain[6 * (size_t)field->tet_region[tet] + p];
        if (field->tet_eigenstrain && !field->tet_eigenstrain_in_world)
            own[p] += field->tet_eigenstrain[6 * (size_t)tet + p];
    }
    ost_strain_to_world(own, axes, world);
    for (size_t p = 0; p < 6; p++) {
        if (field->tet_eigenstrain && field->tet_eigenstrain_in_world)
            world[p] += field->tet_eigenstrain[6 * (size_t)tet + p];
        strain[p] += share * world[p];
    }
}

static OstStatus copy(OstContext *ctx, size_t count, const double *given, double **kept)
{
    OST_FREE(*kept);
    if (!given)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, kept, count));
    memcpy(*kept, given, count * sizeof *given);
    return OST_SUCCESS;
}

OstStatus ost_field_set_eigenstrain(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                    const double *of_tets)
{
    ost_ledger_enter(field->ctx, OST_EFFECT_EIGENSTRAIN);
    OstStatus status = copy(field->ctx, 6 * (size_t)field->region_count, of_regions, &field->region_eigenstrain);
    OST_THEN(copy(field->ctx, 6 * (size_t)tet_count, of_tets, &field->tet_eigenstrain));
    ost_ledger_leave(field->ctx);
    return status;
}
