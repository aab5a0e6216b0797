/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"

#include "core/small.h"
#include "material/axes_formula.h"
#include "material/directions.h"
#include "material/turn.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* Weights of a world strain e in the material normal strain a'ea, and in the material shear strain 2 a'eb. */
static inline void strain_along(const OstSimd a[3], OstSimd weight[6])
{
    for (int i = 0; i < 3; i++) {
        weight[i] = a[i] * a[i];
        weight[3 + i] = a[i] * a[(i + 1) % 3];
    }
}

static inline void shear_between(const OstSimd a[3], const OstSimd b[3], OstSimd weight[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        weight[i] = 2.0 * a[i] * b[i];
        weight[3 + i] = a[i] * b[next] + a[next] * b[i];
    }
}

/* C in world axes: W'CW, with W the weights that turn world strains into material strains (the paper's eq. 9 with K =
 * W'), skipping the zeros of an orthotropic C. */
static void rotate(const double *stiffness, const OstSimd axes[9], OstSimd *c)
{
    OstSimd along[3][6];
    OstSimd shear[3][6];
    OstSimd normal[3][6]; /* material normal stresses for world strains */
    OstSimd shearing[3][6];
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

/* Is C, in material axes, of the family up to rounding? Its stretches are the roots of its diagonal. */
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

/* A, from the axes as rows. */
static inline void stretch_tensor(const double stretch[3], const OstSimd axes[9], OstSimd tensor[6])
{
    for (int i = 0; i < 3; i++) {
        const OstSimd scaled[3] = {stretch[0] * axes[i], stretch[1] * axes[3 + i], stretch[2] * axes[6 + i]};
        const int next = (i + 1) % 3;
        tensor[i] = scaled[0] * axes[i] + scaled[1] * axes[3 + i] + scaled[2] * axes[6 + i];
        tensor[3 + i] = scaled[0] * axes[next] + scaled[1] * axes[3 + next] + scaled[2] * axes[6 + next];
    }
}

static inline void stretched_stiffness(double shear, const OstSimd tensor[6], OstSimd *c)
{
    static const int ends[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const double bulk = 1.0 - 2.0 * shear;
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++) {
            const int *ij = ends[p];
            const int *kl = ends[q];
            c[n++] =
                bulk * (tensor[p] * tensor[q]) + shear * (tensor[place[ij[0]][kl[0]]] * tensor[place[ij[1]][kl[1]]] +
                                                          tensor[place[ij[0]][kl[1]]] * tensor[place[ij[1]][kl[0]]]);
        }
}

static void fill_batch(const double stiffness[36], OstSimd *c)
{
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++)
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                c[n][slot] = stiffness[6 * p + q];
}

/* Reads each tet's axes from memory. */
static inline void gather_axes(const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH], OstSimd axes[9])
{
    OstSimd turn[4];
    for (int from = 0; from < OST_SIMD_WIDTH; from += OST_SIMD_FOUR) {
        OstSimdFour rows[OST_SIMD_FOUR], turned[OST_SIMD_FOUR];
        for (int slot = 0; slot < OST_SIMD_FOUR; slot++)
            rows[slot] = *(const OstSimdFour *)(field->tet_turn + 4 * (size_t)tets[from + slot]);
        ost_simd_transpose(rows, turned);
        for (int i = 0; i < 4; i++)
            *(OstSimdFour *)((double *)&turn[i] + from) = turned[i];
    }
    OST_AXES_OF_TURN(turn, axes);
}

static void dot(const OstSimd a[3], const OstSimd b[3], OstSimd *product)
{
    *product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* As ost_axes_at, of a cylinder. Returns 0 where a point is close to its axis. */
static int cylindrical_axes(const OstAxesSpec *spec, const OstSimd place[3], OstSimd axes[9])
{
    static const double close = 1e-16; /* to the axis: a share of the squared offset */
    const double length = ost_norm3(spec->axis);
    const int first = (int)spec->order[0], second = (int)spec->order[1], third = (int)spec->order[2];
    const double sign = (second - first + 3) % 3 == 1 ? 1.0 : -1.0;
    OstSimd frame[9], offset[3], size = {0}; /* axial, radial, tangential */
    OstSimd *axial = frame, *radial = frame + 3, *tangential = frame + 6;
    for (int i = 0; i < 3; i++) {
        axial[i] = (OstSimd){0} + spec->axis[i] / length;
        offset[i] = radial[i] = place[i] - spec->origin[i];
    }
    for (int pass = 0; pass < 2; pass++) { /* the second takes off what rounding left */
        OstSimd along;
        dot(axial, radial, &along);
        for (int i = 0; i < 3; i++)
            radial[i] -= along * axial[i];
    }
    OstSimd square, whole;
    dot(radial, radial, &square);
    dot(offset, offset, &whole);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        if (!(square[slot] > close * whole[slot]))
            return 0;
        size[slot] = sqrt(square[slot]);
    }
    for (int i = 0; i < 3; i++)
        radial[i] /= size;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        tangential[i] = axial[j] * radial[k] - axial[k] * radial[j];
    }
    for (int i = 0; i < 3; i++) {
        axes[i] = frame[3 * first + i];
        axes[3 + i] = frame[3 * second + i];
        axes[6 + i] = sign * frame[3 * third + i];
    }
    return 1;
}

static void gather_directions(const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH],
                              OstSimd directions[OST_DIRECTIONS])
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const float *from = field->tet_directions + OST_DIRECTIONS * (size_t)tets[slot];
        for (int n = 0; n < OST_DIRECTIONS; n++)
            directions[n][slot] = (double)from[n];
    }
}

static void normalise(OstSimd v[3])
{
    OstSimd size;
    dot(v, v, &size);
    ost_simd_square_root(&size);
    for (int i = 0; i < 3; i++)
        v[i] /= size;
}

/* As ost_directions_at; NAN where directions give no axes. */
static void frame_of_directions(const signed char along[2], const OstSimd directions[OST_DIRECTIONS],
                                const double at[4], OstSimd axes[9])
{
    OstSimd *first = axes + 3 * along[0], *second = axes + 3 * along[1], *third = axes + 3 * (3 - along[0] - along[1]);
    const double sign = (along[1] - along[0] + 3) % 3 == 1 ? 1.0 : -1.0;
    double share[OST_DIRECTION_NODES];
    ost_direction_shares(at, share);
    for (int i = 0; i < 3; i++) {
        const OstSimd *a = directions + OST_DIRECTION_NODES * i, *b = a + OST_DIRECTIONS / 2;
        first[i] = share[0] * a[0];
        second[i] = share[0] * b[0];
        for (int n = 1; n < OST_DIRECTION_NODES; n++) {
            first[i] += share[n] * a[n];
            second[i] += share[n] * b[n];
        }
    }
    normalise(first);
    for (int pass = 0; pass < 2; pass++) { /* the second takes off what rounding left */
        OstSimd overlap;
        dot(first, second, &overlap);
        for (int i = 0; i < 3; i++)
            second[i] -= overlap * first[i];
        normalise(second);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        third[i] = sign * (first[j] * second[k] - first[k] * second[j]);
    }
}

/* Axes at a point of each tet; the tet's own where its directions give none. */
static void follow_directions(const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH],
                              const signed char along[2], const OstSimd directions[OST_DIRECTIONS], const double at[4],
                              OstSimd axes[9])
{
    frame_of_directions(along, directions, at, axes);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double own[9], sum = 0.0;
        for (int i = 0; i < 9; i++)
            sum += axes[i][slot];
        if (isfinite(sum))
            continue;
        ost_field_axes(field, tets[slot], own);
        for (int i = 0; i < 9; i++)
            axes[i][slot] = own[i];
    }
}

/* Evaluates the axes' formula at a point of each tet; all are of one region. */
static void evaluate_axes(const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH], const OstSimd place[3],
                          OstSimd axes[9])
{
    const OstAxesSpec *spec = &field->region_formula[field->tet_region[tets[0]]]->spec;
    if (spec->kind == OST_AXES_CYLINDRICAL && cylindrical_axes(spec, place, axes))
        return;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const double point[3] = {place[0][slot], place[1][slot], place[2][slot]};
        double at_point[9];
        ost_field_axes_at(field, tets[slot], NULL, point, at_point);
        for (int i = 0; i < 9; i++)
            axes[i][slot] = at_point[i];
    }
}

/* Rotates both parts of a split C into world axes: m, the stress of the stiff mode, and c, the rest. */
static void rotate_split(const OstMaterialField *field, int32_t region, const OstSimd axes[9], OstSimd *c, OstSimd m[6])
{
    const double *mode = ost_field_stiff_mode(field, region);
    rotate(ost_field_rest(field, region), axes, c);
    memset(m, 0, 6 * sizeof *m);
    for (int a = 0; a < 3; a++) {
        OstSimd along[6];
        strain_along(axes + 3 * a, along);
        for (int p = 0; p < 6; p++)
            m[p] += mode[a] * along[p];
    }
}

/* C of a region in material axes; linear tets of a mixed form see the rest alone. */
static const double *stiffness_of(const OstMaterialField *field, int32_t region)
{
    const double *rest = ost_field_is_mixed(field) ? ost_field_rest(field, region) : NULL;
    return rest ? rest : field->material[region].stiffness;
}

/* Is the region's material of the family, and are its axes cylindrical? Then A = t I + (a - t) axis axis' + (r - t) d
 * d' / d'd, with r, t and a the radial, tangential and axial stretches and d the offset from the axis. */
static void examine_region(OstElasticity *elasticity, const OstMaterialField *field, int32_t region)
{
    if (elasticity->examined == region)
        return;
    elasticity->examined = region;
    elasticity->stretched = is_stretched(stiffness_of(field, region), elasticity->stretch, &elasticity->shear);
    elasticity->cylindrical = elasticity->stretched && ost_field_has_formula(field, region) &&
                              field->region_formula[region]->spec.kind == OST_AXES_CYLINDRICAL;
    if (!elasticity->cylindrical)
        return;
    const OstAxesSpec *spec = &field->region_formula[region]->spec;
    const double length = ost_norm3(spec->axis);
    double along[3] = {0.0}; /* radial, tangential, axial */
    for (int a = 0; a < 3; a++)
        along[spec->order[a] == OST_RADIAL ? 0 : spec->order[a] == OST_TANGENTIAL ? 1 : 2] = elasticity->stretch[a];
    const OstSimd zero = {0};
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

/* C at a point from the tets' axes there, or A alone if that suffices. */
static void rotate_or_stretch(OstElasticity *elasticity, const double *stiffness, const OstSimd axes[9], int point)
{
    if (!elasticity->stretched) {
        rotate(stiffness, axes, elasticity->c[point]);
        return;
    }
    stretch_tensor(elasticity->stretch, axes, elasticity->stretch_tensor);
    if (!elasticity->by_stretch)
        stretched_stiffness(elasticity->shear, elasticity->stretch_tensor, elasticity->c[point]);
}

static void gather_uniform(OstElasticity *elasticity, const OstMaterialField *field, int32_t region)
{
    const double *of_region = field->region_axes ? field->region_axes + 9 * (size_t)region : world;
    OstSimd axes[9];
    elasticity->points = 1;
    for (int i = 0; i < 9; i++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            axes[i][slot] = of_region[i];
    if (elasticity->by_mean || elasticity->mixed)
        rotate_split(field, region, axes, elasticity->c[0], elasticity->m[0]);
    else if (stiffness_of(field, region) != field->material[region].stiffness)
        rotate(stiffness_of(field, region), axes, elasticity->c[0]);
    else
        fill_batch(field->region_stiffness + 36 * (size_t)region, elasticity->c[0]);
    if (elasticity->by_stretch)
        stretch_tensor(elasticity->stretch, axes, elasticity->stretch_tensor);
}

static void gather_varying(OstElasticity *elasticity, const OstMaterialField *field, int32_t region,
                           const OstLocal tets[OST_SIMD_WIDTH], int points, const OstQuadraturePoint *at,
                           const OstSimd *places)
{
    OstSimd axes[9], directions[OST_DIRECTIONS];
    const signed char *along = ost_field_directions_along(field, region);
    elasticity->points = points > 0 && ost_field_varies_within(field, region) ? points : 1;
    if (elasticity->points > 1 && along)
        gather_directions(field, tets, directions);
    for (int point = 0; point < elasticity->points; point++) {
        if (elasticity->points > 1 && along)
            follow_directions(field, tets, along, directions, at[point].at, axes);
        else if (elasticity->points > 1)
            evaluate_axes(field, tets, places + 3 * point, axes);
        else
            gather_axes(field, tets, axes);
        if (elasticity->by_mean || elasticity->mixed)
            rotate_split(field, region, axes, elasticity->c[point], elasticity->m[point]);
        else
            rotate_or_stretch(elasticity, stiffness_of(field, region), axes, point);
    }
}

/* All tets of the batch are of one region. */
static void gather_region(OstElasticity *elasticity, const OstMaterialField *field, int32_t region,
                          const OstLocal tets[OST_SIMD_WIDTH], int points, const OstQuadraturePoint *at,
                          const OstSimd *places)
{
    if (elasticity->region == region)
        return;
    const int split = points > 0 && ost_field_stiff_mode(field, region) != NULL;
    elasticity->by_mean = split && !ost_field_is_mixed(field);
    elasticity->mixed = split && ost_field_is_mixed(field);
    elasticity->looseness = (OstSimd){0} + (elasticity->mixed ? field->mixed.looseness[region] : 0.0);
    examine_region(elasticity, field, region);
    const int by_line = elasticity->line_suffices && !split;
    elasticity->about_line = (elasticity->stretch_suffices || by_line) && elasticity->cylindrical &&
                             field->region_varies[region] && !field->tet_scale;
    elasticity->by_stretch = elasticity->about_line || (elasticity->stretch_suffices && elasticity->stretched);
    elasticity->region = elasticity->about_line || !field->region_varies[region] ? region : -1;
    if (elasticity->about_line)
        elasticity->points = points > 0 ? points : 1;
    else if (field->region_varies[region])
        gather_varying(elasticity, field, region, tets, points, at, places);
    else
        gather_uniform(elasticity, field, region);
    elasticity->varying = elasticity->points > 1 ? (1U << OST_SIMD_WIDTH) - 1U : 0U;
}

static void copy_lane(const OstElasticity *from, int slot, OstElasticity *to)
{
    for (int point = 0; point < to->points; point++) {
        const int at = ost_elasticity_at(from, point);
        for (int n = 0; n < OST_ELASTICITY_COUNT; n++)
            to->c[point][n][slot] = from->c[at][n][slot];
        for (int p = 0; p < 6; p++)
            to->m[point][p][slot] = from->by_mean || from->mixed ? from->m[at][p][slot] : 0.0;
    }
    to->looseness[slot] = from->looseness[slot];
}

/* The tets are of several regions: gathers each by itself and copies it to its slot. */
static void gather_mixed(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH],
                         int points, const OstQuadraturePoint *at, const OstSimd *places)
{
    elasticity->region = -1;
    elasticity->points = points > 0 ? points : 1;
    elasticity->by_mean = 0;
    elasticity->mixed = 0;
    elasticity->by_stretch = 0;
    elasticity->about_line = 0;
    elasticity->varying = 0;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        OstLocal same[OST_SIMD_WIDTH];
        for (int other = 0; other < OST_SIMD_WIDTH; other++)
            same[other] = tets[slot];
        OstElasticity one;
        ost_elasticity_clear(&one);
        gather_region(&one, field, field->tet_region[tets[slot]], same, points, at, places);
        elasticity->by_mean |= one.by_mean;
        elasticity->mixed |= one.mixed;
        elasticity->varying |= one.varying & 1U << slot;
        copy_lane(&one, slot, elasticity);
    }
    if (!elasticity->varying)
        elasticity->points = 1;
}

static void gather_pressure(OstElasticity *elasticity, const OstMaterialField *field,
                            const OstLocal tets[OST_SIMD_WIDTH])
{
    for (int v = 0; v < 4; v++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            elasticity->pressure[v][slot] = field->pressure ? field->pressure[4 * (size_t)tets[slot] + (size_t)v] : 0.0;
}

/* Has the one C of each tet at all points, where a factor or the eigenstrain differs between them. */
static void spread(OstElasticity *elasticity, int points)
{
    if (elasticity->points > 1 || elasticity->by_stretch)
        return;
    for (int point = 1; point < points; point++) {
        memcpy(elasticity->c[point], elasticity->c[0], sizeof elasticity->c[0]);
        if (elasticity->by_mean || elasticity->mixed)
            memcpy(elasticity->m[point], elasticity->m[0], sizeof elasticity->m[0]);
    }
    elasticity->points = points;
    elasticity->varying = (1U << OST_SIMD_WIDTH) - 1U;
}

/* Multiplies C of each tet by its factor: m and A, which enter twice, by the root. */
static void scale(OstElasticity *elasticity, const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH],
                  const OstQuadraturePoint *at)
{
    const int points = elasticity->by_stretch ? 1 : elasticity->points;
    for (int point = 0; point < points; point++) {
        OstSimd factor, root;
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            factor[slot] = ost_field_scale(field, tets[slot], points > 1 && at ? at[point].at : NULL);
            root[slot] = sqrt(factor[slot]);
        }
        for (int p = 0; p < 6 && elasticity->by_stretch; p++)
            elasticity->stretch_tensor[p] *= root;
        for (int n = 0; n < OST_ELASTICITY_COUNT && !elasticity->by_stretch; n++)
            elasticity->c[point][n] *= factor;
        for (int p = 0; p < 6 && (elasticity->by_mean || elasticity->mixed); p++)
            elasticity->m[point][p] *= root;
    }
    elasticity->region = -1;
}

void ost_elasticity_gather(OstElasticity *elasticity, const OstMaterialField *field,
                           const OstLocal tets[OST_SIMD_WIDTH], int points, const OstQuadraturePoint *at,
                           const OstSimd *places)
{
    const int32_t region = field->tet_region[tets[0]];
    int same = 1;
    for (int slot = 1; slot < OST_SIMD_WIDTH; slot++)
        same &= field->tet_region[tets[slot]] == region;
    if (same)
        gather_region(elasticity, field, region, tets, points, at, places);
    else
        gather_mixed(elasticity, field, tets, points, at, places);
    if (elasticity->mixed)
        gather_pressure(elasticity, field, tets);
    elasticity->eigenstrained = elasticity->eigen_share != 0.0 && ost_field_is_eigenstrained(field);
    if (points > 0 && at &&
        (ost_field_scales_within(field) || (elasticity->eigenstrained && ost_field_strains_within(field))))
        spread(elasticity, points);
    if (field->tet_scale)
        scale(elasticity, field, tets, at);
    if (elasticity->eigenstrained)
        ost_eigenstrain_gather(elasticity, field, tets, at, places);
}
