/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FIELD_H
#define ORTHOSTAT_FIELD_H

#include "orthostat/axes.h"
#include "orthostat/material.h"

OST_API_BEGIN

/* Elasticity and axes of every tet of a rank's piece of a mesh. */
typedef struct OstMaterialField OstMaterialField;

/* Local. Axes of a tet (the world's where the body carries none); of axes that vary within it, those in its middle. */
void ost_field_axes(const OstMaterialField *field, OstLocal tet, double axes[9]);

/* Local. Axes that vary within quadratic tets, of the regions whose axes were given tet by tet (OST_AXES_CELLS): rows
 * e1 e2 e3 at the four vertices of each of `tet_count` tets, ghosts included (36 numbers a tet), in place of those of
 * the tet; copied. Between the vertices they turn evenly; where they turn by more than 60 degrees from a tet's mean,
 * that is taken for all of it. Raises OST_INVALID_INPUT as ost_axes_check, OST_INVALID_USAGE if there is no such
 * region. */
OstStatus ost_field_set_vertex_axes(OstMaterialField *field, OstLocal tet_count, const double *axes);

/* Poisson's ratio above which a material counts as nearly incompressible. */
#define OST_NEARLY_INCOMPRESSIBLE 0.45

/* Local. The remedy for nearly incompressible materials on quadratic tets. With the normalised normal block of the
 * compliance (ones on the diagonal), e its least eigenvalue and w the unit eigenvector, C resists the strain E^(-1/2) w
 * by 1/e: the one stiff mode (isotropic: the dilatation, e = 1 - 2 nu). What it resists beyond nu_limit, where e would
 * be 1 - 2 nu_limit, is taken out of C, C = m m' + rest with m = E^(1/2) w (1/e - 1/(1 - 2 nu_limit))^(1/2), and sees
 * the mean of m'strain over each tet alone. So the many conditions of no dilatation, which would lock a tet, become
 * one; the rest is the stiffness of a material with nu_limit in that mode, so that K stays symmetric and positive
 * definite on any mesh; uniform strains and rigid motions are untouched; nothing jumps where nu passes nu_limit.
 *
 * Measured on quadratic tets with nu = 0.4999, errors without and with nu_limit 0.45: radial displacement of a thick
 * cylinder (b/a = 3, 20 hexes through its wall) -0.056 % and -0.0075 %; of a thick sphere (6 hexes) -13.5 % and -0.7 %;
 * stresses at the cylinder's nodes, rms, 130 % and 0.8 % of the pressure; a manufactured flow with pressure, H1 norm,
 * 8 × 8 × 8 irregular hexes, 1.9 % and 0.7 %. (The whole mode by its mean: 2.3 % there, as it converges with order 1.)
 *
 * A region is taken if its e, and no other eigenvalue, is below 1 - 2 nu_limit (two stiff modes cannot be told apart;
 * they come with nu below -0.9, and lock in other ways). Linear tets have no use for this and ignore it. Stiffness,
 * internal forces and stresses all follow the field. Returns in `regions` how many were taken.
 * OST_EFFECT_MEAN_DILATATION. */
OstStatus ost_field_mean_dilatation(OstMaterialField *field, double nu_limit, int *regions);

/* Local. The mixed form, which holds for any compressibility, nu = 1/2 of the family and of isotropy included: C = rest
 * + m m' / looseness, with m = E^(1/2) w the stress of the stiff mode (see above), rest the stiffness of a material
 * whose nu is 0.3 in that mode, and looseness = e / (1 - 2.5 e). The stress is rest strain + m p, with an unknown of
 * its own, p, continuous in each region and linear in each tet: m'strain = looseness p. (Taylor and Hood's pair: stable
 * whatever the mesh, where one pressure a tet is not.) Regions are taken as by ost_field_mean_dilatation, and of
 * quadratic tets alone; linear tets see the rest, as the coarse space of quadratic ones. Returns in `regions` how many
 * were taken. Unless a region is
 * incompressible, the field keeps what the mean dilatation needs beside it, for Newton's method. OST_EFFECT_MIXED. */
OstStatus ost_field_mixed(OstMaterialField *field, double nu_limit, int *regions);

/* Local. Eigenstrains: what the material would strain by if nothing held it, as by swelling, heat or the contraction of
 * a muscle. Stress is C (strain - t e0), t the load factor (orthostat/problem.h). Six numbers, 11 22 33 12 23 31 with
 * engineering shear, along the material axes: of each region (6 × regions, or NULL), and of each of `tet_count` tets,
 * ghosts included (6 × tet_count, or NULL), which are added up; copied. Both NULL: none any more. An isotropic material
 * keeps no axes, unless its OstMaterial.isotropic is set to 0; without, its eigenstrain is along the world's.
 * OST_EFFECT_EIGENSTRAIN. */
OstStatus ost_field_set_eigenstrain(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                    const double *of_tets);

/* Local. As ost_field_set_eigenstrain, with strains at the four vertices of each tet (24 × tet_count, or NULL). They
 * are linear between the vertices; linear tets, whose strain is uniform, take the mean. */
OstStatus ost_field_set_vertex_eigenstrain(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                           const double *at_vertices);

/* Local. Stiffness tet by tet: that of the region times a factor above 0 for each of `tet_count` tets, ghosts included
 * (copied; NULL: none any more). Raises OST_INVALID_INPUT for a factor that is not positive and finite. */
OstStatus ost_field_set_scale(OstMaterialField *field, OstLocal tet_count, const double *factors);

/* Local. As ost_field_set_scale, with factors at the four vertices of each tet (4 × tet_count), linear between them. */
OstStatus ost_field_set_vertex_scale(OstMaterialField *field, OstLocal tet_count, const double *factors);

void ost_field_destroy(OstMaterialField **field);

OST_API_END

#endif
