/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RECOVERY_RECOVERY_H
#define ORTHOSTAT_RECOVERY_RECOVERY_H

#include "assembly/batch.h"
#include "fields/stress_measure.h"
#include "problem/result_data.h"

/* Collective. Computes what the bits of `fields` (OstOutputFieldBit) ask for, or what those are made of: strain, stress
 * and strain energy density of the owned tets (means over each), and stress at the nodes. Stress at a node is that of
 * the tets around it at this node, averaged by their volumes. Where regions meet, stress jumps: the node takes it from
 * the tets of the region with the lowest number alone. Where rotations are large, strain is Biot's U - I, in world axes
 * of the undeformed body, and stress is Cauchy's, in world axes of the deformed one. Where load factors are asked for
 * and a material has strengths, finds the least ones. */
OstStatus ost_result_recover(OstResult *result, unsigned fields);

/* Local. Makes room for those of these fields that are means, unless they are there. *visit writes them, with the
 * result as its data; NULL: nothing is to be written. What has been written ost_result_recover need not compute. */
OstStatus ost_result_prepare_means(OstResult *result, unsigned fields, OstMeansVisit *visit);

/* Local. Stress at the nodes of one tet, as it is in that tet: 6 numbers a node, world axes. */
void ost_tet_nodal_stress(const OstResult *result, OstLocal tet, double *stress);

/* Local. The mean of a tet's stress along its material axes, which have turned with it where rotations are large: as
 * they vary within it, if it is quadratic. The mean stress has been recovered. */
void ost_tet_mean_along_axes(const OstResult *result, OstLocal tet, double own[6]);

/* Local. Turns stresses that the estimate has added to (`count`, 6 numbers each) as the error of the displacement turns
 * the tet, for a measure along the world's axes; material axes turn with it. Nothing is done by linear theory. */
void ost_turn_with_error(const OstResult *result, OstLocal tet, OstStressMeasure measure, int count, double *stress);

#endif
