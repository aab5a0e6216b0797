/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ORTHOSTAT_H
#define ORTHOSTAT_ORTHOSTAT_H

/* Orthostat as a library: all of its headers. What holds in each of them:
 *
 * Statuses. A function that can fail returns an OstStatus, 0 for success; ost_error_text then says what was found
 * where, what was expected and what to do. Where nothing else is said, what was to be made is NULL after a failure.
 *
 * Ranks. A function is collective (every rank of the context calls it, in the same order, and all return the same
 * status) or local. OstLocal counts on one rank, OstGlobal over all. Destroying is collective.
 *
 * Handles. ost_x_create makes a handle; ost_x_destroy frees it and nulls the pointer, and does nothing for NULL. What
 * was made of a handle refers to it, so handles are destroyed in the reverse order of their making.
 *
 * Arrays. Those passed are copied. Those returned belong to the handle, and live as long as it does.
 *
 * Units are the user's, consistently: with mm and N, moduli and stresses are in MPa. */

#include "orthostat/adaption.h"
#include "orthostat/analysis.h"
#include "orthostat/axes.h"
#include "orthostat/case.h"
#include "orthostat/context.h"
#include "orthostat/field.h"
#include "orthostat/formulation.h"
#include "orthostat/ledger.h"
#include "orthostat/load_cases.h"
#include "orthostat/material.h"
#include "orthostat/mesh.h"
#include "orthostat/mesh_file.h"
#include "orthostat/output_field.h"
#include "orthostat/path.h"
#include "orthostat/problem.h"
#include "orthostat/refine.h"
#include "orthostat/result.h"
#include "orthostat/scene.h"
#include "orthostat/solver.h"
#include "orthostat/status.h"
#include "orthostat/steps_file.h"
#include "orthostat/time_table.h"
#include "orthostat/watch.h"

#endif
