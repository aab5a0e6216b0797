/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/large_rotation.h"

#include "element/biot.h"
#include "element/strain_batch.h"

#include <string.h>

/* One point of each tet at u. */
typedef struct Deformed {
    OstPoint point;
    OstPolar polar;
    OstSimd strain[6]; /* U - I - e0 */
    OstSimd stress[6]; /* without the stiff mode's part, where C is split */
    OstSimd pressure;  /* of a mixed form */
    const OstSimd *c, *m, *e0;
} Deformed;

/* All points of the tets at u. */
typedef struct DeformedTets {
    int count;
    Deformed at[OST_MAX_POINTS];
    OstSimd volume;
    OstSimd stiff; /* the mean of m'(U - I - e0) where C is split, otherwise 0 */
} DeformedTets;

static inline void dot6(const OstSimd a[6], const OstSimd b[6], OstSimd *product)
{
    *product = a[0] * b[0];
    for (int p = 1; p < 6; p++)
        *product += a[p] * b[p];
}

static void deform(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                   DeformedTets *tets)
{
    const OstQuadrature *rule = element->rule(x, elasticity);
    tets->count = rule->count;
    tets->volume = tets->stiff = (OstSimd){0};
    for (int q = 0; q < rule->count; q++) {
        Deformed *at = &tets->at[q];
        OstSimd slope[9];
        OstSimd mode;
        element->evaluate(x, &rule->point[q], &at->point);
        ost_displacement_gradient(element->nodes, &at->point, u, slope);
        ost_polar(slope, &at->polar);
        ost_biot_strain(&at->polar, at->strain);
        at->c = elasticity->c[ost_elasticity_at(elasticity, q)];
        at->m = elasticity->m[ost_elasticity_at(elasticity, q)];
        at->e0 = elasticity->e0[ost_elasticity_at(elasticity, q)];
        for (int p = 0; p < 6 && elasticity->eigenstrained; p++)
            at->strain[p] -= at->e0[p];
        ost_simd_stress(at->c, at->strain, at->stress);
        tets->volume += at->point.volume;
        if (elasticity->mixed)
            ost_pressure_at(elasticity, rule->point[q].at, &at->pressure);
        if (!elasticity->by_mean)
            continue;
        dot6(at->m, at->strain, &mode);
        tets->stiff += at->point.volume * mode;
    }
    tets->stiff /= tets->volume;
}

/* Puts the stress that is linear along a step in place of that at u. */
static void take_linear_stress(const OstElement *element, const OstElasticity *elasticity, const OstLastStep *last,
                               DeformedTets *tets)
{
    tets->stiff = (OstSimd){0};
    for (int q = 0; q < tets->count; q++) {
        Deformed *at = &tets->at[q];
        OstPolar polar;
        OstSimd slope[9], before[9], change[6];
        OstSimd mode;
        ost_displacement_gradient(element->nodes, &at->point, last->from, before);
        ost_displacement_gradient(element->nodes, &at->point, last->to, slope);
        for (int n = 0; n < 9; n++)
            slope[n] -= before[n];
        ost_polar(before, &polar);
        ost_biot_strain(&polar, at->strain);
        ost_biot_strain_change(&polar, slope, change);
        for (int p = 0; p < 6; p++)
            at->strain[p] += change[p];
        for (int p = 0; p < 6 && elasticity->eigenstrained; p++)
            at->strain[p] -= at->e0[p];
        ost_simd_stress(at->c, at->strain, at->stress);
        if (!elasticity->by_mean)
            continue;
        dot6(at->m, at->strain, &mode);
        tets->stiff += at->point.volume * mode;
    }
    tets->stiff /= tets->volume;
}

/* The stress at a point, with the stiff mode's part. */
static inline void whole_stress(const DeformedTets *tets, const OstElasticity *elasticity, int q, OstSimd stress[6])
{
    memcpy(stress, tets->at[q].stress, 6 * sizeof *stress);
    for (int p = 0; p < 6 && elasticity->by_mean; p++)
        stress[p] += tets->stiff * tets->at[q].m[p];
    for (int p = 0; p < 6 && elasticity->mixed; p++)
        stress[p] += tets->at[q].pressure * tets->at[q].m[p];
}

/* Energy density of a mixed form's stiff mode. */
static inline void energy_of_pressure(const OstElasticity *elasticity, const Deformed *at, OstSimd *density)
{
    *density = elasticity->mixed ? 0.5 * elasticity->looseness * at->pressure * at->pressure : (OstSimd){0};
}

/* force += the first Piola stress along the shape functions' gradients */
static void add_force(int nodes, const Deformed *at, const OstSimd stress[6], OstSimd *force)
{
    OstSimd piola[9];
    ost_biot_piola(&at->polar, stress, piola);
    for (int n = 0; n < 9; n++)
        piola[n] *= at->point.volume;
    for (int a = 0; a < nodes; a++) {
        const OstSimd *g = at->point.gradient[a];
        for (int i = 0; i < 3; i++)
            force[3 * a + i] += piola[3 * i] * g[0] + piola[3 * i + 1] * g[1] + piola[3 * i + 2] * g[2];
    }
}

static void consistent_energy(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                              const OstSimd *u, OstSimd *energy)
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    *energy = 0.5 * tets.volume * tets.stiff * tets.stiff;
    for (int q = 0; q < tets.count; q++) {
        OstSimd twice, of_pressure;
        dot6(tets.at[q].strain, tets.at[q].stress, &twice);
        energy_of_pressure(elasticity, &tets.at[q], &of_pressure);
        *energy += tets.at[q].point.volume * (0.5 * twice + of_pressure);
    }
}

static void consistent_force(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                             const OstSimd *u, const OstLastStep *last, OstSimd *force)
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    if (last)
        take_linear_stress(element, elasticity, last, &tets);
    memset(force, 0, 3 * (size_t)element->nodes * sizeof *force);
    for (int q = 0; q < tets.count; q++) {
        OstSimd stress[6];
        whole_stress(&tets, elasticity, q, stress);
        add_force(element->nodes, &tets.at[q], stress, force);
    }
}

/* blocks += the second derivative by F along the gradients of each two nodes but node 0 */
static inline void add_blocks(int nodes, const Deformed *at, const OstSimd hessian[81], OstSimd *blocks)
{
    const OstSimd *v = at->polar.before;
    OstSimd g[OST_MAX_TET_NODES][3]; /* along the principal directions, as the derivative is */
    for (int b = 1; b < nodes; b++) {
        OstSimd column[9][3]; /* of each component of dF, for a unit displacement of node b in each direction */
        for (int j = 0; j < 3; j++) {
            const OstSimd *of_node = at->point.gradient[b];
            g[b][j] = v[3 * j] * of_node[0] + v[3 * j + 1] * of_node[1] + v[3 * j + 2] * of_node[2];
        }
        const OstSimd scaled[3] = {at->point.volume * g[b][0], at->point.volume * g[b][1], at->point.volume * g[b][2]};
        for (int n = 0; n < 9; n++)
            for (int k = 0; k < 3; k++)
                column[n][k] = hessian[9 * n + k] * scaled[0] + hessian[9 * n + 3 + k] * scaled[1] +
                               hessian[9 * n + 6 + k] * scaled[2];
        for (int a = 1; a <= b; a++) {
            OstSimd *block = blocks + 9 * ost_pair_index(nodes, a, b);
            for (int n = 0; n < 9; n++)
                block[n] += g[a][0] * column[n / 3][n % 3] + g[a][1] * column[3 + n / 3][n % 3] +
                            g[a][2] * column[6 + n / 3][n % 3];
        }
    }
}

/* A translation makes no force, so node 0's blocks are minus the sums of the others'. */
static inline void complete_by_translations(int nodes, OstSimd *blocks)
{
    for (int b = 1; b < nodes; b++)
        for (int n = 0; n < 9; n++) {
            const int turned = 3 * (n % 3) + n / 3;
            OstSimd sum = {0};
            for (int a = 1; a < nodes; a++)
                sum += a <= b ? blocks[9 * ost_pair_index(nodes, a, b) + n]
                              : blocks[9 * ost_pair_index(nodes, b, a) + turned];
            blocks[9 * b + n] = -sum;
            blocks[n] += sum;
        }
}

/* The stiff mode's energy is 1/2 volume (mean of m'(U - I))^2; the second derivative of U is in the points' part. */
static void add_mean_blocks(const OstElement *element, const DeformedTets *tets, OstSimd *blocks)
{
    OstSimd columns[3 * OST_MAX_TET_NODES] = {{0}};
    for (int q = 0; q < tets->count; q++)
        add_force(element->nodes, &tets->at[q], tets->at[q].m, columns);
    for (int a = 0; a < element->nodes; a++)
        for (int b = a; b < element->nodes; b++, blocks += 9)
            for (int n = 0; n < 9; n++)
                blocks[n] += columns[3 * a + n / 3] * columns[3 * b + n % 3] / tets->volume;
}

static inline void sum_points(int nodes, const DeformedTets *tets, const OstElasticity *elasticity, int definite,
                              OstSimd *blocks)
{
    memset(blocks, 0, 9 * (size_t)ost_pair_count(nodes) * sizeof *blocks);
    for (int q = 0; q < tets->count; q++) {
        OstSimd stress[6], hessian[81];
        whole_stress(tets, elasticity, q, stress);
        ost_biot_hessian(&tets->at[q].polar, tets->at[q].c, stress, definite, hessian);
        add_blocks(nodes, &tets->at[q], hessian, blocks);
    }
    complete_by_translations(nodes, blocks);
}

static void consistent_stiffness(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                 const OstSimd *u, const OstLastStep *last, int definite, OstSimd *blocks)
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    if (last)
        take_linear_stress(element, elasticity, last, &tets);
    if (element->nodes == 4) /* a number that the compiler knows: half the time of what follows the Hessian */
        sum_points(4, &tets, elasticity, definite, blocks);
    else
        sum_points(element->nodes, &tets, elasticity, definite, blocks);
    if (elasticity->by_mean)
        add_mean_blocks(element, &tets, blocks);
}

void ost_large_rotation_coupling(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                 const OstSimd *u, OstSimd *columns, OstSimd volume[4])
{
    const OstQuadrature *rule = element->rule(x, elasticity);
    const int numbers = 3 * element->nodes;
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    memset(columns, 0, 4 * (size_t)numbers * sizeof *columns);
    memset(volume, 0, 4 * sizeof *volume);
    for (int q = 0; q < tets.count; q++) {
        const Deformed *at = &tets.at[q];
        OstSimd of_point[3 * OST_MAX_TET_NODES] = {{0}}, mode;
        add_force(element->nodes, at, at->m, of_point);
        dot6(at->m, at->strain, &mode);
        mode = at->point.volume * (mode - elasticity->looseness * at->pressure);
        for (int v = 0; v < 4; v++) {
            const double share = rule->point[q].at[v];
            volume[v] += share * mode;
            for (int n = 0; n < numbers; n++)
                columns[numbers * v + n] += share * of_point[n];
        }
    }
}

/* The mean over the tets of F - I. */
static void mean_gradient(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                          const OstSimd *u, OstSimd mean[9])
{
    const OstQuadrature *rule = element->rule(x, elasticity);
    OstSimd volume = {0};
    memset(mean, 0, 9 * sizeof *mean);
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        OstSimd slope[9];
        element->evaluate(x, &rule->point[q], &point);
        ost_displacement_gradient(element->nodes, &point, u, slope);
        volume += point.volume;
        for (int n = 0; n < 9; n++)
            mean[n] += point.volume * slope[n];
    }
    for (int n = 0; n < 9; n++)
        mean[n] /= volume;
}

void ost_large_rotation_mean_rotation(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                      const OstSimd *u, OstSimd rotation[9])
{
    OstSimd mean[9];
    OstPolar polar;
    mean_gradient(element, x, elasticity, u, mean);
    ost_polar(mean, &polar);
    ost_polar_rotation(&polar, rotation);
}

/* d = R'x - X loses all digits where rotations are small. As the mean F is R U, it is (U - I) X + R'(u - (F - I) X). */
void ost_classical_displacement(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                const OstSimd *u, OstSimd rotation[9], OstSimd *d)
{
    OstSimd mean[9], strain[6];
    OstPolar polar;
    mean_gradient(element, x, elasticity, u, mean);
    ost_polar(mean, &polar);
    ost_polar_rotation(&polar, rotation);
    ost_biot_strain(&polar, strain);
    for (int i = 3; i < 6; i++)
        strain[i] *= 0.5;
    for (int a = 0; a < element->nodes; a++, d += 3) {
        OstSimd place[3], rest[3]; /* from node 0; what the mean F leaves of u */
        for (int i = 0; i < 3; i++)
            place[i] = x[3 * a + i] - x[i];
        for (int i = 0; i < 3; i++)
            rest[i] = u[3 * a + i] - u[i] -
                      (mean[3 * i] * place[0] + mean[3 * i + 1] * place[1] + mean[3 * i + 2] * place[2]);
        d[0] = strain[0] * place[0] + strain[3] * place[1] + strain[5] * place[2];
        d[1] = strain[3] * place[0] + strain[1] * place[1] + strain[4] * place[2];
        d[2] = strain[5] * place[0] + strain[4] * place[1] + strain[2] * place[2];
        for (int i = 0; i < 3; i++)
            d[i] += rotation[i] * rest[0] + rotation[3 + i] * rest[1] + rotation[6 + i] * rest[2];
    }
}

static void classical_energy(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                             const OstSimd *u, OstSimd *energy)
{
    OstSimd rotation[9];
    OstSimd d[3 * OST_MAX_TET_NODES];
    OstMeans means;
    ost_classical_displacement(element, x, elasticity, u, rotation, d);
    element->means(x, elasticity, d, &means);
    *energy = means.volume * means.energy;
}

static void classical_force(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                            const OstSimd *u, OstSimd *force)
{
    OstSimd rotation[9];
    OstSimd d[3 * OST_MAX_TET_NODES];
    OstSimd local[3 * OST_MAX_TET_NODES];
    ost_classical_displacement(element, x, elasticity, u, rotation, d);
    element->force(x, elasticity, d, local);
    for (int a = 0; a < element->nodes; a++)
        for (int i = 0; i < 3; i++)
            force[3 * a + i] = rotation[3 * i] * local[3 * a] + rotation[3 * i + 1] * local[3 * a + 1] +
                               rotation[3 * i + 2] * local[3 * a + 2];
}

static void classical_stiffness(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                const OstSimd *u, OstSimd *blocks)
{
    OstSimd rotation[9];
    OstSimd d[3 * OST_MAX_TET_NODES];
    const int pairs = ost_pair_count(element->nodes);
    ost_classical_displacement(element, x, elasticity, u, rotation, d);
    element->stiffness(x, elasticity, blocks);
    for (int pair = 0; pair < pairs; pair++, blocks += 9) {
        OstSimd half[9];
        for (int n = 0; n < 9; n++)
            half[n] = rotation[n / 3 * 3] * blocks[n % 3] + rotation[n / 3 * 3 + 1] * blocks[3 + n % 3] +
                      rotation[n / 3 * 3 + 2] * blocks[6 + n % 3];
        for (int n = 0; n < 9; n++)
            blocks[n] = half[n / 3 * 3] * rotation[n % 3 * 3] + half[n / 3 * 3 + 1] * rotation[n % 3 * 3 + 1] +
                        half[n / 3 * 3 + 2] * rotation[n % 3 * 3 + 2];
    }
}

void ost_large_rotation_energy(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                               const OstElasticity *elasticity, const OstSimd *u, OstSimd *energy)
{
    if (formulation == OST_FORMULATION_CLASSICAL)
        classical_energy(element, x, elasticity, u, energy);
    else
        consistent_energy(element, x, elasticity, u, energy);
}

void ost_large_rotation_force(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                              const OstElasticity *elasticity, const OstSimd *u, const OstLastStep *last,
                              OstSimd *force)
{
    if (formulation == OST_FORMULATION_CLASSICAL)
        classical_force(element, x, elasticity, u, force);
    else
        consistent_force(element, x, elasticity, u, last, force);
}

void ost_large_rotation_stiffness(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                  const OstElasticity *elasticity, const OstSimd *u, const OstLastStep *last,
                                  int definite, OstSimd *blocks)
{
    if (formulation == OST_FORMULATION_CLASSICAL)
        classical_stiffness(element, x, elasticity, u, blocks);
    else
        consistent_stiffness(element, x, elasticity, u, last, definite, blocks);
}

static void consistent_means(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                             const OstSimd *u, OstMeans *means)
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    memset(means, 0, sizeof *means);
    means->volume = tets.volume;
    means->stiff = tets.stiff;
    for (int q = 0; q < tets.count; q++) {
        const Deformed *at = &tets.at[q];
        const OstSimd share = at->point.volume / tets.volume;
        OstSimd stress[6], of_pressure;
        whole_stress(&tets, elasticity, q, stress);
        energy_of_pressure(elasticity, at, &of_pressure);
        means->energy += share * of_pressure;
        for (int p = 0; p < 6; p++) {
            means->strain[p] += share * at->strain[p];
            if (elasticity->eigenstrained) {
                means->strain[p] += share * at->e0[p];
                means->eigen += share * at->e0[p] * stress[p];
            }
            means->stress[p] += share * stress[p];
            means->energy += 0.5 * share * at->strain[p] * at->stress[p];
        }
    }
    means->energy += 0.5 * tets.stiff * tets.stiff;
}

void ost_large_rotation_means(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                              const OstElasticity *elasticity, const OstSimd *u, OstMeans *means)
{
    OstSimd rotation[9];
    OstSimd d[3 * OST_MAX_TET_NODES];
    if (formulation == OST_FORMULATION_CONSISTENT) {
        consistent_means(element, x, elasticity, u, means);
        return;
    }
    ost_classical_displacement(element, x, elasticity, u, rotation, d);
    element->means(x, elasticity, d, means);
}

void ost_large_rotation_strains(const OstElement *element, const OstSimd *x, const OstSimd *u, int count,
                                const OstQuadraturePoint *at, OstSimd *strain)
{
    for (int q = 0; q < count; q++) {
        OstPoint point;
        OstPolar polar;
        OstSimd slope[9];
        element->evaluate(x, &at[q], &point);
        ost_displacement_gradient(element->nodes, &point, u, slope);
        ost_polar(slope, &polar);
        ost_biot_strain(&polar, strain + 6 * q);
    }
}

void ost_large_rotation_least_stretch(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                      const OstSimd *u, OstSimd *stretch)
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    *stretch = tets.at[0].polar.stretch[2];
    for (int q = 1; q < tets.count; q++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            (*stretch)[slot] = fmin((*stretch)[slot], tets.at[q].polar.stretch[2][slot]);
}

void ost_large_rotation_volumes(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                const OstSimd *u, OstSimd volumes[2])
{
    DeformedTets tets;
    deform(element, x, elasticity, u, &tets);
    volumes[0] = tets.volume;
    volumes[1] = (OstSimd){0};
    for (int q = 0; q < tets.count; q++) {
        const OstSimd *stretch = tets.at[q].polar.stretch;
        volumes[1] += tets.at[q].point.volume * (stretch[0] * stretch[1] * stretch[2]);
    }
}
