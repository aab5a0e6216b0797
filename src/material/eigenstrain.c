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

/* What the tet has beyond its region. */
static void find_of_tet(const OstMaterialField *field, OstLocal tet, const double at[4], double strain[6])
{
    const size_t places = (size_t)field->eigenstrain_places, columns = ost_field_eigenstrain_columns(field);
    memset(strain, 0, 6 * sizeof *strain);
    for (size_t place = 0; place < places && field->tet_eigenstrain; place++) {
        const double *there = field->tet_eigenstrain + columns * (places * (size_t)tet + place);
        for (size_t p = 0; p < columns; p++)
            strain[p] += ost_field_share(places, at, place) * there[p];
    }
    for (size_t p = 6; field->region_per_unit && p-- > 0;)
        strain[p] = strain[0] * field->region_per_unit[6 * (size_t)field->tet_region[tet] + p];
}

void ost_field_add_eigenstrain(const OstMaterialField *field, OstLocal tet, const double at[4], double share,
                               const double axes[9], double strain[6])
{
    double own[6] = {0.0}, of_tet[6], world[6];
    find_of_tet(field, tet, at, of_tet);
    for (size_t p = 0; p < 6; p++) {
        if (field->region_eigenstrain)
            own[p] += field->region_eigenstrain[6 * (size_t)field->tet_region[tet] + p];
        own[p] += field->tet_eigenstrain_in_world ? 0.0 : of_tet[p];
    }
    ost_strain_to_world(own, axes, world);
    for (int p = 0; p < 6; p++)
        strain[p] += share * (field->tet_eigenstrain_in_world ? world[p] + of_tet[p] : world[p]);
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

OstStatus ost_field_set_eigenstrain_at(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                       int places, const double *of_tets, const double *per_unit)
{
    const size_t of_region = 6 * (size_t)field->region_count, numbers = (size_t)places * (per_unit ? 1 : 6);
    ost_ledger_enter(field->ctx, OST_EFFECT_EIGENSTRAIN);
    OstStatus status = copy(field->ctx, of_region, of_regions, &field->region_eigenstrain);
    OST_THEN(copy(field->ctx, of_region, per_unit, &field->region_per_unit));
    OST_THEN(copy(field->ctx, numbers * (size_t)tet_count, of_tets, &field->tet_eigenstrain));
    field->eigenstrain_places = places;
    ost_ledger_leave(field->ctx);
    return status;
}

OstStatus ost_field_set_eigenstrain(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                    const double *of_tets)
{
    return ost_field_set_eigenstrain_at(field, of_regions, tet_count, 1, of_tets, NULL);
}

OstStatus ost_field_set_vertex_eigenstrain(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                           const double *at_vertices)
{
    return ost_field_set_eigenstrain_at(field, of_regions, tet_count, 4, at_vertices, NULL);
}
