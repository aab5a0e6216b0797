/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_LARGE_ROTATION_H
#define ORTHOSTAT_ELEMENT_LARGE_ROTATION_H

#include "element/element.h"
#include "orthostat/formulation.h"

/* Energy, forces and stiffness of a batch of tets at a displacement u, with large rotations: consistent or classical
 * (orthostat/formulation.h). Local. Arguments as of OstElement; `elasticity` has C itself, not only its stretch tensor.
 *
 * Consistent: Biot's strain at each point of the element's rule (biot.h). Where C is split (elasticity.h), the stiff
 * mode counts by the tet's mean of m'(U - I), or by the pressure of a mixed form.
 *
 * Classical: R is the rotation of the tet's mean F. Forces are R K d and the stiffness R K R', with d = R'x - X; the
 * energy 1/2 d'K d is reported, but is not a potential of the forces.
 *
 * Where an eigenstrain e0 acts (elasticity.h), stress and energy are of U - I - e0, or of the strain of d less e0. */

void ost_large_rotation_energy(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                               const OstElasticity *elasticity, const OstSimd *u, OstSimd *energy);

/* The last Newton iteration went straight from one displacement to another; where nodes follow others along curves, u
 * is not that. The stress is taken as that at `from` plus its linear change up to `to`, without what rotation by a
 * linear displacement seems to stretch (D. Magisano, L. Leonetti and G. Garcea, How to improve efficiency and
 * robustness of the Newton method in geometrically non-linear structural problem discretized via displacement-based
 * finite elements, Comput. Methods Appl. Mech. Eng. 313, 2017). */
typedef struct OstLastStep {
    const OstSimd *from, *to;
} OstLastStep;

/* `last`: NULL, or whence the stress of the consistent form is, here and in the geometric part of the stiffness. */
void ost_large_rotation_force(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                              const OstElasticity *elasticity, const OstSimd *u, const OstLastStep *last,
                              OstSimd *force);

/* Blocks as of OstElement.stiffness. If `definite`, the derivative of the stress at each point is made
 * positive semidefinite where it is not (ost_biot_hessian), and so the tet's stiffness. (The classical one always is.)
 */
void ost_large_rotation_stiffness(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                  const OstElasticity *elasticity, const OstSimd *u, const OstLastStep *last,
                                  int definite, OstSimd *blocks);

/* The coupling of a mixed form's pressures, consistent alone: for each vertex, with N its share of the pressure, the
 * derivative by the displacements (3 numbers a node) of the integral of N (m'(U - I - e0) - looseness p), and that
 * integral itself. */
void ost_large_rotation_coupling(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                 const OstSimd *u, OstSimd *columns, OstSimd volume[4]);

/* F - I at a point. */
static inline void ost_displacement_gradient(int nodes, const OstPoint *point, const OstSimd *u, OstSimd slope[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            slope[3 * i + j] = (u[3 + i] - u[i]) * point->gradient[1][j];
            for (int a = 2; a < nodes; a++)
                slope[3 * i + j] += (u[3 * a + i] - u[i]) * point->gradient[a][j];
        }
}

/* Classical: R, row-major, and d, with node 0 in place. */
void ost_classical_displacement(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                const OstSimd *u, OstSimd rotation[9], OstSimd *d);

/* Means over the tets of U - I, or of the strain of d; of its conjugate stress and of the energy density. */
void ost_large_rotation_means(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                              const OstElasticity *elasticity, const OstSimd *u, OstMeans *means);

/* Cauchy's stress, the symmetric part of P F' / det F, in world axes: the mean over each deformed tet, and that at
 * points, or its nodes (6 each), where `at_points` has the elasticity. Classical: P = R C : strain of d. */
void ost_large_rotation_mean_stress(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                    const OstElasticity *elasticity, const OstSimd *u, OstSimd stress[6]);
void ost_large_rotation_stress_at(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                  const OstElasticity *elasticity, const OstElasticity *at_points, int points,
                                  const OstQuadraturePoint *at, const OstSimd *u, OstSimd *stress);
void ost_large_rotation_nodal_stress(const OstElement *element, OstFormulation formulation, const OstSimd *x,
                                     const OstElasticity *elasticity, const OstElasticity *at_nodes, const OstSimd *u,
                                     OstSimd *stress);

/* The symmetric part of P F' (slope = F - I, row-major); a stress over det F. */
void ost_kirchhoff_of_piola(const OstSimd piola[9], const OstSimd slope[9], OstSimd tau[6]);
void ost_divide_by_volume(const OstSimd *jacobian, OstSimd stress[6]);

/* The rotation R of each tet's mean F = R U, row-major. */
void ost_large_rotation_mean_rotation(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                      const OstSimd *u, OstSimd rotation[9]);

/* U - I at points of the tets. `at`: count × 4 barycentric coordinates; 6 strains a point. */
void ost_large_rotation_strains(const OstElement *element, const OstSimd *x, const OstSimd *u, int count,
                                const OstQuadraturePoint *at, OstSimd *strain);

/* The tets' volumes before and after: integrals of 1 and of det F, counted positive before. */
void ost_large_rotation_volumes(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                const OstSimd *u, OstSimd volumes[2]);

/* The least principal stretch over the tets' points; negative where a tet is inverted. */
void ost_large_rotation_least_stretch(const OstElement *element, const OstSimd *x, const OstElasticity *elasticity,
                                      const OstSimd *u, OstSimd *stretch);

#endif
