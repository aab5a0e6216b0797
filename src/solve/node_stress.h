/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_NODE_STRESS_H
#define ORTHOSTAT_SOLVE_NODE_STRESS_H

#include "problem/result_data.h"

/* Collective. Makes result->node_stress, ghosts included (see recovery.h). */
OstStatus ost_result_recover_node_stress(OstResult *result);

#endif
