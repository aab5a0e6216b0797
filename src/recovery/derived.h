/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RECOVERY_DERIVED_H
#define ORTHOSTAT_RECOVERY_DERIVED_H

#include "fields/output_field.h"
#include "fields/stress_measure.h"
#include "problem/result_data.h"

/* Local. Can a derived field (OstOutputField.is_derived) be made of what the result has? Load factors need a material
 * with strengths, material axes a body that has any, the others the stress or the strain that they are made of. */
int ost_result_can_derive(const OstResult *result, OstOutputFieldBit field);

/* Local. A derived field on the owned tets: its components × owned_tets numbers. Where rotations are large, the
 * material axes of a stress are those that have turned with the tet; those of a strain have not. */
OstStatus ost_result_derive(const OstResult *result, OstOutputFieldBit field, double *values);

/* Local. A stress of a tet, in world axes, along its material axes. */
void ost_result_material_stress(const OstResult *result, OstLocal tet, const double stress[6], double own[6]);

/* Local. The same along the axes at a point of the tet, in barycentric coordinates and in the undeformed body: they may
 * vary within it. */
void ost_result_material_stress_at(const OstResult *result, OstLocal tet, const double at[4], const double point[3],
                                   const double stress[6], double own[6]);

/* Local. A number that is made of a stress of a tet, in world axes. */
OstStatus ost_stress_measure(const OstResult *result, OstLocal tet, const double stress[6], OstStressMeasure measure,
                             double *value);

/* Local. By how much a stress of a tet, in world axes, may grow until the tet's material fails;
 * OST_MOST_LOAD_FACTOR: by any factor, or the material has no strengths. */
double ost_result_load_factor(const OstResult *result, OstLocal tet, OstCriterion criterion, const double stress[6]);

/* Local. Of a symmetric tensor 11 22 33 12 23 31: von Mises' number. */
double ost_von_mises(const double stress[6]);

/* Local. The mean of a tet's vertices. */
void ost_tet_centre(const OstMesh *mesh, OstLocal tet, double place[3]);

/* Collective. Finds the least load factors (result->failure), from the stress, of a body some of which has strengths.
 */
OstStatus ost_result_find_failure(OstResult *result);

#endif
