/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_ELASTICITY_H
#define ORTHOSTAT_ELEMENT_ELASTICITY_H

#include "element/quadrature.h"
#include "element/simd.h"
#include "material/field_data.h"

/* The largest number of points of a tet at which C may differ: quadrature points, or nodes. */
enum { OST_MAX_POINTS = 14, OST_ELASTICITY_COUNT = 21 };

/* C in world axes of each tet of a batch, as an upper triangle: 21 numbers row by row (11 12 .. 16 22 .. 66), strains
 * in the order 11 22 33 12 23 31 with engineering shear. It is kept from one batch to the next, because many bodies
 * have the same C everywhere.
 *
 * In regions with the mean-dilatation element (ost_field_mean_dilatation) C is split: C = c + m m', with c the softer
 * rest. The energy density of a tet is then 1/2 strain'c strain + 1/2 (mean of m'strain)^2. In those of the mixed form
 * (ost_field_mixed) C = c + m m' / looseness, and the energy density 1/2 strain'c strain + 1/2 looseness p^2.
 *
 * The stable family with geometric shear (eq. 18 and 22), which includes every isotropic material, is isotropic
 * elasticity in stretched coordinates. Its stretch tensor is A = sum of sqrt(C_aa) e_a e_a' over the axes; with
 * `shear` = C_44 / sqrt(C_11 C_22), C_ijkl = (1 - 2 shear) A_ij A_kl + shear (A_ik A_jl + A_il A_jk). Computing C from
 * A is cheaper than rotating it, and the stiffness of a linear tet follows from A without C, which is cheaper still. */
typedef struct OstElasticity {
    int points;       /* 1: C is uniform in each tet; otherwise the number of points that was asked for */
    unsigned varying; /* bit k: C varies within tet k */
    int by_mean;      /* is C split, and the stiff mode seen by its mean? */
    int mixed;        /* is C split for the mixed form (ost_field_mixed)? The stress is c strain + m p */
    int32_t region;   /* the present values are valid for every tet of this region; -1: for this batch alone */

    int stretch_suffices;      /* set by the caller if A may stand for c and m (linear tets only) */
    int line_suffices;         /* likewise, if cylindrical axes may be known by their line alone where C varies */
    int by_stretch;            /* does A stand for C, and c is not set? */
    int about_line;            /* if so: is A not set either, but computed by ost_stretch_about_line? */
    OstSimd stretch_tensor[6]; /* A_11 A_22 A_33 A_12 A_23 A_31 */

    /* Of region `examined` (-1: of none yet): */
    int32_t examined;
    int stretched; /* is its material of the family? */
    double stretch[3];
    double shear;
    int cylindrical;               /* is it, and are its axes cylindrical? Then A depends on the position alone */
    OstSimd origin[3], axis[3];    /* four times a point of the cylinder's axis; its direction */
    OstSimd about_axis[6], radial; /* A = about_axis + radial d d' / d'd, d the position's offset from the axis */

    /* If about_line: A at the points of a rule, where the caller keeps it; or NULL */
    const OstSimd (*stretch_at)[6];

    /* The points of the tets' rule, where the caller keeps them (element.h); or NULL */
    const struct OstKeptPoints *kept;

    OstSimd c[OST_MAX_POINTS][OST_ELASTICITY_COUNT];
    OstSimd m[OST_MAX_POINTS][6]; /* 0 for the tets that are not split; not set if by_mean and mixed are 0 */

    /* If mixed: 1 / stiffness of the mode, m'(strain - e0) = looseness p; p at the vertices, linear in the tet. */
    OstSimd looseness, pressure[4];

    double eigen_share;            /* set by the caller: the share of the field's eigenstrain that acts */
    int eigenstrained;             /* is e0 set? If not, it counts as 0 */
    OstSimd e0[OST_MAX_POINTS][6]; /* eigenstrain in world axes: stress = C (strain - e0) */
} OstElasticity;

/* Start value: no C yet. */
static inline void ost_elasticity_clear(OstElasticity *elasticity)
{
    elasticity->region = -1;
    elasticity->varying = 0;
    elasticity->mixed = 0;
    elasticity->stretch_suffices = 0;
    elasticity->line_suffices = 0;
    elasticity->by_stretch = 0;
    elasticity->about_line = 0;
    elasticity->stretch_at = NULL;
    elasticity->kept = NULL;
    elasticity->examined = -1;
    elasticity->eigen_share = 0.0;
    elasticity->eigenstrained = 0;
}

/* Local. Reads C of a batch of tets. `at` are `points` points in each of them, `places` where these lie (3 numbers a
 * point, read where axes come from a formula): C is evaluated there if the axes of any of the tets vary within it.
 * Linear tets pass 0 points: their C is that at the centroid, and never split, since their strain is uniform. If A
 * suffices and the axes are cylindrical, only the cylinder's axis is stored, and ost_stretch_about_line computes A,
 * which is cheaper than reading each tet's axes from memory. */
void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field,
                           const OstLocal tets[OST_SIMD_WIDTH], int points, const OstQuadraturePoint *at,
                           const OstSimd *places);

/* Local. Reads e0, at the points of C; a part of ost_elasticity_gather (eigenstrain.c). */
void ost_eigenstrain_gather(OstElasticity *elasticity, const OstMaterialField *field,
                            const OstLocal tets[OST_SIMD_WIDTH], const OstQuadraturePoint *at, const OstSimd *places);

/* A at places, of which these are the fourfold, for cylindrical axes. */
static inline void ost_stretch_at(const OstElasticity *elasticity, const OstSimd fourfold[3], OstSimd tensor[6])
{
    static const double tiny = 1e-200; /* on the line itself any direction will do */
    const OstSimd *axis = elasticity->axis;
    OstSimd d[3]; /* four times the offset from the axis: its length does not matter */
    for (int i = 0; i < 3; i++)
        d[i] = fourfold[i] - elasticity->origin[i];
    const OstSimd height = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    for (int i = 0; i < 3; i++)
        d[i] -= height * axis[i];
    const OstSimd share = elasticity->radial / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + tiny);
    for (int i = 0; i < 3; i++) {
        const OstSimd part = share * d[i];
        tensor[i] = elasticity->about_axis[i] + part * d[i];
        tensor[3 + i] = elasticity->about_axis[3 + i] + part * d[(i + 1) % 3];
    }
}

/* A at the centroids of tets with these corners, likewise. */
static inline void ost_stretch_about_line(const OstElasticity *elasticity, const OstSimd x[12], OstSimd tensor[6])
{
    const OstSimd fourfold[3] = {x[0] + x[3] + x[6] + x[9], x[1] + x[4] + x[7] + x[10], x[2] + x[5] + x[8] + x[11]};
    ost_stretch_at(elasticity, fourfold, tensor);
}

/* Index of a point's C. */
static inline int ost_elasticity_at(const OstElasticity *elasticity, int point)
{
    return elasticity->points == 1 ? 0 : point;
}

/* p of a mixed form, at barycentric coordinates. */
static inline void ost_pressure_at(const OstElasticity *elasticity, const double at[4], OstSimd *pressure)
{
    *pressure = at[0] * elasticity->pressure[0];
    for (int v = 1; v < 4; v++)
        *pressure += at[v] * elasticity->pressure[v];
}

/* elastic = strain - e0, at index `at`. */
static inline void ost_elastic_strain(const OstElasticity *elasticity, int at, const OstSimd strain[6],
                                      OstSimd elastic[6])
{
    for (int p = 0; p < 6; p++)
        elastic[p] = elasticity->eigenstrained ? strain[p] - elasticity->e0[at][p] : strain[p];
}

#endif
