/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_MATERIAL_REPORT_H
#define ORTHOSTAT_CLI_MATERIAL_REPORT_H

#include "orthostat/material.h"

/* Local; to be called by one rank. Prints what there is to say of a material of this kind ("orthotropic"), as text or
 * JSON; with axes (else NULL), also what it is in world axes. */
OstStatus ost_material_report(OstContext *ctx, const OstMaterial *material, const char *kind, const double axes[9],
                              int json);

#endif
