/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"

#include <string.h>

/* What strain e contributes along two directions: a'eb, or twice that for two different ones. */
static inline void strain_along(const OstLanes a[3], OstLanes weight[6])
{
    for (int i = 0; i < 3; i++) {
        weight[i] = a[i] * a[i];
        weight[3 + i] = a[i] * a[(i + 1) % 3];
    }
}

static inline void shear_between(const OstLanes a[3], const OstLanes b[3], OstLanes weight[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        weight[i] = 2.0 * a[i] * b[i];
        weight[3 + i] = a[i] * b[next] + a[next] * b[i];
    }
}

/* C in world axes: material strains are weights times world strains, and the energy is the same in both. (The paper's
 * eq. 9 with K = weights', and the zeros of an orthotropic C left out.) */
static void rotate(const double *stiffness, const OstLanes axes[9], OstLanes *c)
{
    OstLanes along[3][6];
    OstLanes shear[3][6];
    OstLanes normal[3][6]; /* material normal stresses for world strains */
    OstLanes shearing[3][6];
    for (int a = 0; a < 3; a++) {
        strain_along(axes + 3 * a, along[a]);
        shear_between(axes + 3 * a, axes + 3 * ((a + 1) % 3), shear[a]);
    }
    for (int a = 0; a < 3; a++)
        for (int p = 0; p < 6; p++) {
            normal[a][p] = stiffness[6 * a] * along[0][p] + stiffness[6 * a + 1] * along[1][p] +
                           stiffness[6 * a + 2] * along[2][p];
            shearing[a][p] = stiffness[7 * (3 + a)] * shear[a][p];
        }
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++)
            c[n++] = along[0][p] * normal[0][q] + along[1][p] * normal[1][q] + along[2][p] * normal[2][q] +
                     shear[0][p] * shearing[0][q] + shear[1][p] * shearing[1][q] + shear[2][p] * shearing[2][q];
}

static void set_lane(OstElasticity *elasticity, int lane, const double stiffness[36])
{
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++)
            elasticity->c[n++][lane] = stiffness[6 * p + q];
}

static void gather_varying(OstElasticity *elasticity, const OstMaterialField *field, int32_t region,
                           const OstLocal tets[OST_LANES])
{
    OstLanes rows[2][OST_LANES];
    OstLanes axes[9];
    for (int lane = 0; lane < OST_LANES; lane++) {
        const double *of_tet = field->tet_axes + 9 * (size_t)tets[lane];
        memcpy(&rows[0][lane], of_tet, sizeof(OstLanes));
        memcpy(&rows[1][lane], of_tet + 4, sizeof(OstLanes));
        axes[8][lane] = of_tet[8];
    }
    ost_lanes_transpose(rows[0], axes);
    ost_lanes_transpose(rows[1], axes + 4);
    rotate(field->material[region].stiffness, axes, elasticity->c);
}

static void gather_mixed(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES])
{
    for (int lane = 0; lane < OST_LANES; lane++) {
        double stiffness[36];
        ost_field_stiffness(field, tets[lane], stiffness);
        set_lane(elasticity, lane, stiffness);
    }
}

void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES])
{
    const int32_t region = field->tet_region[tets[0]];
    int same = 1;
    for (int lane = 1; lane < OST_LANES; lane++)
        same &= field->tet_region[tets[lane]] == region;
    if (same && !field->region_varies[region]) {
        if (elasticity->region == region)
            return;
        for (int lane = 0; lane < OST_LANES; lane++)
            set_lane(elasticity, lane, field->region_stiffness + 36 * (size_t)region);
        elasticity->region = region;
        return;
    }
    elasticity->region = -1;
    if (same)
        gather_varying(elasticity, field, region, tets);
    else
        gather_mixed(elasticity, field, tets);
}
