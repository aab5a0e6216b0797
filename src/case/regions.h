/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_REGIONS_H
#define ORTHOSTAT_CASE_REGIONS_H

#include "case/case_data.h"

/* Materials by region: "all" stands for every region, and later entries override earlier ones. Local. */

int ost_is_every_region(const char *name);

/* The entry of the case that counts for a region of the mesh; NULL if there is none. */
const OstCaseMaterial *ost_case_material_of(const OstCase *c, const char *region);

#endif
