/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_NESTED_H
#define ORTHOSTAT_ADAPT_NESTED_H

#include "case/case_data.h"
#include "material/field_data.h"

/* Local. Is the problem that a case states the same on finer meshes, but for the elements? Not where supports, springs
 * or loads are on what a box, a sphere, a cylinder or the nearest vertex selects, or on each vertex of a boundary; nor
 * where faces are tied, periodic or moved in the mean, where material axes vary, or a mean dilatation is each tet's. */
int ost_is_same_on_finer(const OstCase *c, const OstMaterialField *field);

#endif
