/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_RECOVERY_H
#define ORTHOSTAT_SOLVE_RECOVERY_H

#include "problem/result_data.h"

/* Collective. Strain, stress and strain energy density of the owned tets (means over each), and stress at the nodes, as
 * far as the bits of `fields` (OstOutputFieldBit) ask. Stress at a node is the average over the tets around it,
 * weighted by their volumes, of their stress at the node. Where regions meet, stress jumps: the node takes it from the
 * tets of the region with the lowest number alone. */
OstStatus ost_result_recover(OstResult *result, unsigned fields);

#endif
