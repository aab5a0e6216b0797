/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"

#include "core/small.h"
#include "material/axes_formula.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

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

/* Does C, in material axes, belong to the family, up to rounding? Then the roots of its diagonal are the stretches. */
static int is_stretched(const double *stiffness, double stretch[3], double *shear)
{
    for (int a = 0; a < 3; a++)
        stretch[a] = sqrt(stiffness[7 * a]);
    *shear = stiffness[7 * 3] / (stretch[0] * stretch[1]);
    double error = 0.0;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        const double unit = stretch[a] * stretch[b];
        error = fmax(error, fabs(stiffness[6 * a + b] / unit - (1.0 - 2.0 * *shear)));
        error = fmax(error, fabs(stiffness[7 * (3 + a)] / unit - *shear));
    }
    return error <= 8.0 * DBL_EPSILON;
}

/* A, from axes that come as rows. */
static inline void stretched_metric(const double stretch[3], const OstLanes axes[9], OstLanes metric[6])
{
    for (int i = 0; i < 3; i++) {
        const OstLanes scaled[3] = {stretch[0] * axes[i], stretch[1] * axes[3 + i], stretch[2] * axes[6 + i]};
        const int next = (i + 1) % 3;
        metric[i] = scaled[0] * axes[i] + scaled[1] * axes[3 + i] + scaled[2] * axes[6 + i];
        metric[3 + i] = scaled[0] * axes[next] + scaled[1] * axes[3 + next] + scaled[2] * axes[6 + next];
    }
}

static inline void stretched_stiffness(double shear, const OstLanes metric[6], OstLanes *c)
{
    static const int ends[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const double bulk = 1.0 - 2.0 * shear;
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++) {
            const int *ij = ends[p];
            const int *kl = ends[q];
            c[n++] =
                bulk * (metric[p] * metric[q]) + shear * (metric[place[ij[0]][kl[0]]] * metric[place[ij[1]][kl[1]]] +
                                                          metric[place[ij[0]][kl[1]]] * metric[place[ij[1]][kl[0]]]);
        }
}

static void fill_lanes(const double stiffness[36], OstLanes *c)
{
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++)
            for (int lane = 0; lane < OST_LANES; lane++)
                c[n][lane] = stiffness[6 * p + q];
}

/* Each tet's own axes. */
static inline void gather_axes(const OstMaterialField *field, const OstLocal tets[OST_LANES], OstLanes axes[9])
{
    OstLanes rows[2][OST_LANES];
    const double *of_tet[OST_LANES];
    for (int lane = 0; lane < OST_LANES; lane++) {
        of_tet[lane] = field->tet_axes + 9 * (size_t)tets[lane];
        rows[0][lane] = *(const OstAnyLanes *)of_tet[lane];
        rows[1][lane] = *(const OstAnyLanes *)(of_tet[lane] + 4);
    }
    ost_lanes_transpose(rows[0], axes);
    ost_lanes_transpose(rows[1], axes + 4);
    axes[8] = (OstLanes){of_tet[0][8], of_tet[1][8], of_tet[2][8], of_tet[3][8]};
}

/* Axes at a point of each tet. */
static void evaluate_axes(const OstMaterialField *field, const OstLocal tets[OST_LANES], const OstLanes place[3],
                          OstLanes axes[9])
{
    for (int lane = 0; lane < OST_LANES; lane++) {
        const double point[3] = {place[0][lane], place[1][lane], place[2][lane]};
        double at_point[9];
        ost_field_axes_at(field, tets[lane], point, at_point);
        for (int i = 0; i < 9; i++)
            axes[i][lane] = at_point[i];
    }
}

/* C in its two parts, where the stiff mode is split off: m is its stress, given along the axes, c the rest. */
static void turn_split(const OstMaterialField *field, int32_t region, const OstLanes axes[9], OstLanes *c,
                       OstLanes m[6])
{
    const double *mode = ost_field_stiff_mode(field, region);
    rotate(ost_field_rest(field, region), axes, c);
    memset(m, 0, 6 * sizeof *m);
    for (int a = 0; a < 3; a++) {
        OstLanes along[6];
        strain_along(axes + 3 * a, along);
        for (int p = 0; p < 6; p++)
            m[p] += mode[a] * along[p];
    }
}

/* Two directions turn about the axis and one does not: A = t I + (a - t) axis axis' + (r - t) d d' / d'd, with the
 * stretches r, t and a. */
static void examine_axes(OstElasticity *elasticity, const OstMaterialField *field, int32_t region)
{
    elasticity->cylindrical = elasticity->stretched && ost_field_has_formula(field, region) &&
                              field->region_formula[region]->spec.kind == OST_AXES_CYLINDRICAL;
    if (!elasticity->cylindrical)
        return;
    const OstAxesSpec *spec = &field->region_formula[region]->spec;
    const double length = ost_norm3(spec->axis);
    double along[3] = {0.0}; /* radial, tangential, axial */
    for (int a = 0; a < 3; a++)
        along[spec->order[a] == OST_RADIAL ? 0 : spec->order[a] == OST_TANGENTIAL ? 1 : 2] = elasticity->stretch[a];
    const OstLanes zero = {0};
    for (int i = 0; i < 3; i++) {
        const double axis = spec->axis[i] / length;
        const double next = spec->axis[(i + 1) % 3] / length;
        elasticity->origin[i] = zero + 4.0 * spec->origin[i];
        elasticity->axis[i] = zero + axis;
        elasticity->about_axis[i] = zero + along[1] + (along[2] - along[1]) * axis * axis;
        elasticity->about_axis[3 + i] = zero + (along[2] - along[1]) * axis * next;
    }
    elasticity->radial = zero + (along[0] - along[1]);
}

static void examine(OstElasticity *elasticity, const OstMaterialField *field, int32_t region)
{
    if (elasticity->examined == region)
        return;
    elasticity->examined = region;
    elasticity->stretched = is_stretched(field->material[region].stiffness, elasticity->stretch, &elasticity->shear);
    examine_axes(elasticity, field, region);
}

/* C at a point where the tets have these axes: A in place of it where that will do. */
static void turn(OstElasticity *elasticity, const double *stiffness, const OstLanes axes[9], int point)
{
    if (!elasticity->stretched) {
        rotate(stiffness, axes, elasticity->c[point]);
        return;
    }
    stretched_metric(elasticity->stretch, axes, elasticity->metric);
    if (!elasticity->by_metric)
        stretched_stiffness(elasticity->shear, elasticity->metric, elasticity->c[point]);
}

static void gather_uniform(OstElasticity *elasticity, const OstMaterialField *field, int32_t region)
{
    const double *of_region = field->region_axes ? field->region_axes + 9 * (size_t)region : world;
    OstLanes axes[9];
    elasticity->points = 1;
    for (int i = 0; i < 9; i++)
        for (int lane = 0; lane < OST_LANES; lane++)
            axes[i][lane] = of_region[i];
    if (elasticity->by_mean)
        turn_split(field, region, axes, elasticity->c[0], elasticity->m[0]);
    else
        fill_lanes(field->region_stiffness + 36 * (size_t)region, elasticity->c[0]);
    if (elasticity->by_metric)
        stretched_metric(elasticity->stretch, axes, elasticity->metric);
}

static void gather_varying(OstElasticity *elasticity, const OstMaterialField *field, int32_t region,
                           const OstLocal tets[OST_LANES], int points, const OstLanes *places)
{
    OstLanes axes[9];
    elasticity->points = points > 0 && ost_field_has_formula(field, region) ? points : 1;
    for (int point = 0; point < elasticity->points; point++) {
        if (elasticity->points > 1)
            evaluate_axes(field, tets, places + 3 * point, axes);
        else
            gather_axes(field, tets, axes);
        if (elasticity->by_mean)
            turn_split(field, region, axes, elasticity->c[point], elasticity->m[point]);
        else
            turn(elasticity, field->material[region].stiffness, axes, point);
    }
}

/* All lanes are of one region. */
static void gather_region(OstElasticity *elasticity, const OstMaterialField *field, int32_t region,
                          const OstLocal tets[OST_LANES], int points, const OstLanes *places)
{
    if (elasticity->region == region)
        return;
    elasticity->by_mean = points > 0 && ost_field_stiff_mode(field, region) != NULL;
    examine(elasticity, field, region);
    elasticity->by_metric = elasticity->metric_suffices && elasticity->stretched;
    elasticity->about_line = elasticity->by_metric && elasticity->cylindrical && field->region_varies[region];
    elasticity->region = elasticity->about_line || !field->region_varies[region] ? region : -1;
    if (elasticity->about_line)
        elasticity->points = 1;
    else if (field->region_varies[region])
        gather_varying(elasticity, field, region, tets, points, places);
    else
        gather_uniform(elasticity, field, region);
}

static void copy_lane(const OstElasticity *from, int lane, OstElasticity *to)
{
    for (int point = 0; point < to->points; point++) {
        const int at = ost_elasticity_at(from, point);
        for (int n = 0; n < OST_ELASTICITY_COUNT; n++)
            to->c[point][n][lane] = from->c[at][n][lane];
        for (int p = 0; p < 6; p++)
            to->m[point][p][lane] = from->by_mean ? from->m[at][p][lane] : 0.0;
    }
}

/* Lanes of several regions, one after the other. */
static void gather_mixed(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES],
                         int points, const OstLanes *places)
{
    elasticity->region = -1;
    elasticity->points = points > 0 ? points : 1;
    elasticity->by_mean = 0;
    elasticity->by_metric = 0;
    elasticity->about_line = 0;
    for (int lane = 0; lane < OST_LANES; lane++) {
        const OstLocal same[OST_LANES] = {tets[lane], tets[lane], tets[lane], tets[lane]};
        OstElasticity one;
        ost_elasticity_clear(&one);
        gather_region(&one, field, field->tet_region[tets[lane]], same, points, places);
        elasticity->by_mean |= one.by_mean;
        copy_lane(&one, lane, elasticity);
    }
}

void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_LANES],
                           int points, const OstLanes *places)
{
    const int32_t region = field->tet_region[tets[0]];
    int same = 1;
    for (int lane = 1; lane < OST_LANES; lane++)
        same &= field->tet_region[tets[lane]] == region;
    if (same)
        gather_region(elasticity, field, region, tets, points, places);
    else
        gather_mixed(elasticity, field, tets, points, places);
}
