/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_MATERIAL_REPORT_H
#define ORTHOSTAT_CLI_MATERIAL_REPORT_H

#include "orthostat/material.h"

/* What `orthostat material` says of a material. */
typedef struct OstMaterialReport {
    OstMaterial material;
    const char *kind;                /* "isotropic", "transversely isotropic", "orthotropic" */
    double reverse_ratio[3];         /* nu21 nu32 nu13 */
    double block_eigenvalues[3];     /* of the normalised normal block */
    double stiffness_eigenvalues[6]; /* of C */
    double scale;                    /* all Poisson's ratios may be multiplied by less than this */
    double low[3], high[3];          /* open range of each of nu12 nu23 nu31 with the others as they are */
    int turned;                      /* were axes given? The rest is filled only then. */
    double axes[9];
    double turned_stiffness[36];
    OstOrthotropic turned_constants; /* Ex Ey Ez, nuxy nuyz nuzx, Gxy Gyz Gzx */
} OstMaterialReport;

/* Local. Fills all but `kind`; `axes` may be NULL. */
OstStatus ost_material_report_fill(OstContext *ctx, const OstMaterial *material, const double axes[9],
                                   OstMaterialReport *report);

/* Local; print to standard output (to be called by one rank). */
void ost_material_report_print(const OstMaterialReport *report);
OstStatus ost_material_report_print_json(OstContext *ctx, const OstMaterialReport *report);

#endif
