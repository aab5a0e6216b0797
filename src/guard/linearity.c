/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/linearity.h"

#include "assembly/springs.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/large_rotation.h"
#include "element/point_stress.h"
#include "element/polar.h"
#include "mesh/mesh_data.h"

#include <string.h>

/* The edges from the first of four vectors with the mean gradient of the displacement as their linear map, up to a
 * factor: in the mean gradient of a quadratic tet's shape functions only mid-edge nodes appear, each as the sum of its
 * two ends'. */
static inline void find_edges(int nodes, const OstSimd *vectors, OstSimd edges[3][3])
{
    OstSimd sums[12] = {{0}};
    const OstSimd *corners = nodes == 4 ? vectors : sums;
    for (int e = 0; e < 6 && nodes > 4; e++)
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 3; i++)
                sums[3 * ost_tet_edge[e][end] + i] += vectors[3 * (4 + e) + i];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            edges[k][i] = corners[3 * (k + 1) + i] - corners[i];
}

/* The gradient is that of u's corners over x's: where u is linear it is right, in curved tets too. */
static inline void find_gradient(const OstBatch *batch, int nodes, const OstSimd *u, OstSimd gradient[9])
{
    OstSimd x[3][3], moved[3][3], inverse[3][3];
    find_edges(nodes, batch->x, x);
    find_edges(nodes, u, moved);
    for (int k = 0; k < 3; k++)
        ost_simd_cross(x[(k + 1) % 3], x[(k + 2) % 3], inverse[k]);
    const OstSimd over = 1.0 / (x[0][0] * inverse[0][0] + x[0][1] * inverse[0][1] + x[0][2] * inverse[0][2]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            gradient[3 * i + j] = (OstSimd){0};
            for (int k = 0; k < 3; k++)
                gradient[3 * i + j] += moved[k][i] * inverse[k][j];
            gradient[3 * i + j] *= over;
        }
}

/* The length of the vector of a matrix's antisymmetric part. */
static inline void find_turn(const OstSimd matrix[9], OstSimd *length)
{
    OstSimd square = {0};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const OstSimd twice = matrix[3 * k + j] - matrix[3 * j + k];
        square += twice * twice;
    }
    ost_simd_square_root(&square);
    *length = 0.5 * square;
}

/* Adds a weight times the work of stress on H'H - e², twice what the strain U - I has to second order. */
static inline void add_stress_work(const OstSimd *weight, const OstSimd h[9], const OstSimd stress[6], OstSimd *work)
{
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3; /* 11 22 33 12 23 31 */
        OstSimd both = {0};
        for (int k = 0; k < 3; k++)
            both += h[3 * k + i] * h[3 * k + j] - 0.25 * (h[3 * k + i] + h[3 * i + k]) * (h[3 * k + j] + h[3 * j + k]);
        *work += *weight * (p < 3 ? 1.0 : 2.0) * stress[p] * both;
    }
}

/* Its integral over quadratic tets: the stress of a bent bar changes sign within a tet. */
OST_KERNEL static void integrate_work(const OstBatch *batch, const OstElement *element, const OstSimd *u,
                                      const OstMeans *means, OstSimd *work)
{
    const OstElasticity *elasticity = &batch->elasticity;
    const OstQuadrature *rule = element->rule(batch->x, elasticity);
    OstPoint room;
    *work = (OstSimd){0};
    for (int q = 0; q < rule->count; q++) {
        const OstPoint *point = elasticity->kept ? &elasticity->kept->at[q] : &room;
        OstSimd gradient[9], stress[6];
        if (!elasticity->kept)
            element->evaluate(batch->x, &rule->point[q], &room);
        ost_displacement_gradient(element->nodes, point, u, gradient);
        ost_point_stress(elasticity, &rule->point[q], ost_elasticity_at(elasticity, q), gradient, means, stress);
        add_stress_work(&point->volume, gradient, stress, work);
    }
}

/* The angle by which each tet turns: half the curl by linear theory, that of R where rotations are large. */
OST_KERNEL static void find_angles(const OstBatch *batch, int nodes, OstFormulation formulation, const OstSimd *u,
                                   const OstMeans *means, OstSimd *angle, OstSimd *work)
{
    OstSimd gradient[9], rotation[9];
    OstPolar polar;
    if (nodes == 4) /* so that the compiler makes one of each */
        find_gradient(batch, 4, u, gradient);
    else
        find_gradient(batch, 10, u, gradient);
    *work = (OstSimd){0};
    add_stress_work(&means->volume, gradient, means->stress, work);
    if (formulation == OST_FORMULATION_LINEAR) {
        find_turn(gradient, angle);
        return;
    }
    ost_polar(gradient, &polar);
    ost_polar_rotation(&polar, rotation);
    find_turn(rotation, angle);
    for (int slot = 0; slot < batch->count; slot++)
        (*angle)[slot] = atan2((*angle)[slot], 0.5 * (rotation[0][slot] + rotation[4][slot] + rotation[8][slot] - 1.0));
}

/* The eigenvalue of a strain with the largest absolute value, by the trigonometric solution of the cubic. */
static double principal(const OstMeans *means, int slot)
{
    double e[6];
    for (int p = 0; p < 6; p++)
        e[p] = means->strain[p][slot];
    const double mean = (e[0] + e[1] + e[2]) / 3.0;
    const double d[3] = {e[0] - mean, e[1] - mean, e[2] - mean};
    const double s[3] = {0.5 * e[3], 0.5 * e[4], 0.5 * e[5]}; /* 12 23 31 */
    const double size = sqrt((ost_dot3(d, d) + 2.0 * ost_dot3(s, s)) / 6.0);
    if (size == 0.0)
        return fabs(mean);
    const double determinant =
        d[0] * (d[1] * d[2] - s[1] * s[1]) - s[0] * (s[0] * d[2] - s[1] * s[2]) + s[2] * (s[0] * s[1] - d[1] * s[2]);
    const double angle = acos(fmax(fmin(0.5 * determinant / (size * size * size), 1.0), -1.0)) / 3.0;
    const double third = 2.0943951023931957; /* 2 pi / 3 */
    return fmax(fabs(mean + 2.0 * size * cos(angle)), fabs(mean + 2.0 * size * cos(angle + third)));
}

/* A part that strains by less beside its rotation is rigid, and its stress rounding. Beside a pressure of
 * incompressible material whose work is more than the energy by this factor, the strain is. */
static const double least_strain = 1e-10, most_work = 1e8;

static void add_tets(const OstBatch *batch, const OstMeans *means, const OstSimd *angle, const OstSimd *work,
                     OstLinearity *largest)
{
    const OstSimd energy = means->energy * means->volume;
    OstSimd square = {0}, stress = {0};
    for (int p = 0; p < 6; p++) {
        square += (p < 3 ? 1.0 : 0.5) * means->strain[p] * means->strain[p];
        stress += (p < 3 ? 1.0 : 2.0) * means->stress[p] * means->stress[p];
    }
    OstSimd size = square, most = stress * square;
    ost_simd_square_root(&size);
    ost_simd_square_root(&most);
    const OstSimdMask counts = (size > least_strain * *angle) & (most < most_work * means->energy);
    const OstSimd stiffening = OST_SIMD_SELECT(counts, 0.5 * *work, (OstSimd){0});
    for (int slot = 0; slot < batch->count; slot++) {
        largest->rotation = (*angle)[slot] > largest->rotation ? (*angle)[slot] : largest->rotation;
        if (square[slot] > largest->strain * largest->strain) /* no eigenvalue exceeds the square root */
            largest->strain = fmax(largest->strain, principal(means, slot));
        largest->energy += energy[slot];
        largest->stiffening += stiffening[slot];
    }
}

void ost_linearity_add(const OstBatch *batch, const OstElement *element, OstFormulation formulation, const OstSimd *u,
                       const OstMeans *means, OstLinearity *largest)
{
    OstSimd angle, work;
    find_angles(batch, element->nodes, formulation, u, means, &angle, &work);
    if (element->nodes > 4 && formulation == OST_FORMULATION_LINEAR)
        integrate_work(batch, element, u, means, &work);
    add_tets(batch, means, &angle, &work, largest);
}

OstStatus ost_linearity_agree(OstContext *ctx, const OstSupports *supports, const double *u, OstLinearity *largest)
{
    const double of_springs = supports->spring ? ost_spring_energy(supports, u) : 0.0;
    double most[2] = {largest->strain, largest->rotation};
    double sums[2] = {largest->energy + of_springs, largest->stiffening};
    OST_TRY(ost_max(ctx, 2, most));
    OST_TRY(ost_sum(ctx, 2, sums));
    *largest = (OstLinearity){most[0], most[1], sums[0], sums[1]};
    return OST_SUCCESS;
}

static void visit(void *largest, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                  const OstMeans *means)
{
    ost_linearity_add(batch, element, OST_FORMULATION_LINEAR, u, means, largest);
}

OstStatus ost_linearity_of(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                           const OstSupports *supports, OstLinearity *largest)
{
    *largest = (OstLinearity){0};
    ost_visit_means(mesh, field, 0.0, u, visit, largest);
    if (ost_field_is_eigenstrained(field)) { /* the energy is that of the whole strain, the stress without e0's part */
        OstLinearity stressed = {0};
        ost_visit_means(mesh, field, t, u, visit, &stressed);
        largest->stiffening = stressed.stiffening;
    }
    return ost_linearity_agree(mesh->ctx, supports, u, largest);
}
