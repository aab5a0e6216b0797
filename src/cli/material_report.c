/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/material_report.h"

#include "core/error.h"
#include "core/small.h"

#include <stdio.h>
#include <string.h>

OstStatus ost_material_report_fill(OstContext *ctx, const OstMaterial *material, const double axes[9],
                                   OstMaterialReport *report)
{
    const OstOrthotropic *constants = &material->constants;
    report->material = *material;
    for (int i = 0; i < 3; i++)
        report->reverse_ratio[i] =
            constants->poissons_ratio[i] * constants->youngs_modulus[(i + 1) % 3] / constants->youngs_modulus[i];
    OST_TRY(ost_orthotropic_eigenvalues(ctx, constants, report->block_eigenvalues));
    OST_TRY(ost_symmetric_eigen(ctx, 6, material->stiffness, report->stiffness_eigenvalues, NULL));
    report->scale = ost_orthotropic_stable_scale(report->block_eigenvalues);
    ost_orthotropic_stable_range(constants, report->low, report->high);
    report->turned = axes != NULL;
    if (!axes)
        return OST_SUCCESS;
    double compliance[36];
    memcpy(report->axes, axes, sizeof report->axes);
    ost_material_rotate_stiffness(material->stiffness, axes, report->turned_stiffness);
    ost_material_rotate_compliance(material->compliance, axes, compliance);
    for (int i = 0; i < 3; i++) {
        report->turned_constants.youngs_modulus[i] = 1.0 / compliance[7 * i];
        report->turned_constants.poissons_ratio[i] = -compliance[6 * ((i + 1) % 3) + i] / compliance[7 * i];
        report->turned_constants.shear_modulus[i] = 1.0 / compliance[7 * (i + 3)];
    }
    return OST_SUCCESS;
}

static void print_matrix(const char *title, const double matrix[36])
{
    printf("%s (rows and columns 11 22 33 12 23 31)\n", title);
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++)
            printf(" %14.7g", matrix[6 * i + j] + 0.0); /* + 0.0: no "-0" */
        putchar('\n');
    }
}

static void print_numbers(const char *title, int count, const double *values)
{
    printf("%-30s", title);
    for (int i = 0; i < count; i++)
        printf(" %14.8g", values[i]);
    putchar('\n');
}

static void print_stable_range(const OstMaterialReport *report)
{
    static const char *const names[3] = {"nu12", "nu23", "nu31"};
    puts("stable range (open), the others as they are");
    for (int i = 0; i < 3; i++)
        printf("  %s in (%.7g, %.7g)\n", names[i], report->low[i], report->high[i]);
    if (isfinite(report->scale))
        printf("  all three together: up to %.7g times as large\n", report->scale);
    puts("  one nu for all (the stable family): nu in (-1, 0.5)");
}

void ost_material_report_print(const OstMaterialReport *report)
{
    const OstOrthotropic *constants = &report->material.constants;
    printf("%s material\n", report->kind);
    print_numbers("E1 E2 E3", 3, constants->youngs_modulus);
    print_numbers("nu12 nu23 nu31", 3, constants->poissons_ratio);
    print_numbers("nu21 nu32 nu13", 3, report->reverse_ratio);
    print_numbers("G12 G23 G31", 3, constants->shear_modulus);
    print_matrix("\nstiffness C", report->material.stiffness);
    print_matrix("\ncompliance S = C^-1", report->material.compliance);
    putchar('\n');
    print_numbers("eigenvalues of C", 6, report->stiffness_eigenvalues);
    print_numbers("of the normalised normal block", 3, report->block_eigenvalues);
    print_numbers("condition of that block", 1, &report->material.condition);
    putchar('\n');
    print_stable_range(report);
    if (!report->turned)
        return;
    putchar('\n');
    for (int i = 0; i < 3; i++)
        print_numbers((const char *const[]){"axis e1", "axis e2", "axis e3"}[i], 3, report->axes + 3 * i);
    print_matrix("\nstiffness in world axes", report->turned_stiffness);
    puts("\nengineering constants along the world axes");
    print_numbers("Ex Ey Ez", 3, report->turned_constants.youngs_modulus);
    print_numbers("nuxy nuyz nuzx", 3, report->turned_constants.poissons_ratio);
    print_numbers("Gxy Gyz Gzx", 3, report->turned_constants.shear_modulus);
}
