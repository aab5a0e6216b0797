/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/material_report.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What `orthostat material` says of a material. */
typedef struct Report {
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
} Report;

static OstStatus fill(OstContext *ctx, const OstMaterial *material, const double axes[9], Report *report)
{
    const OstOrthotropic *constants = &material->constants;
    report->material = *material;
    for (int i = 0; i < 3; i++)
        report->reverse_ratio[i] =
            constants->poissons_ratio[i] * constants->youngs_modulus[(i + 1) % 3] / constants->youngs_modulus[i];
    OST_TRY(ost_orthotropic_eigenvalues(ctx, constants, report->block_eigenvalues));
    for (int i = 0; i < 6; i++)
        report->stiffness_eigenvalues[i] = NAN;
    if (!material->incompressible)
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

static void print_stable_range(const Report *report)
{
    static const char *const names[3] = {"nu12", "nu23", "nu31"};
    puts("stable range (open), the others as they are");
    for (int i = 0; i < 3; i++)
        printf("  %s in (%.7g, %.7g)\n", names[i], report->low[i], report->high[i]);
    if (isfinite(report->scale))
        printf("  all three together: up to %.7g times as large\n", report->scale);
    puts("  one nu for all (the stable family): nu in (-1, 0.5)");
}

static void print(const Report *report)
{
    const OstOrthotropic *constants = &report->material.constants;
    char moduli[OST_MODULI_WORDS];
    ost_orthotropic_words(constants, moduli);
    printf("%s material: %s\n", report->kind, moduli);
    print_numbers("E1 E2 E3", 3, constants->youngs_modulus);
    print_numbers("nu12 nu23 nu31", 3, constants->poissons_ratio);
    print_numbers("nu21 nu32 nu13", 3, report->reverse_ratio);
    print_numbers("G12 G23 G31", 3, constants->shear_modulus);
    if (report->material.incompressible)
        printf("\nstiffness C: none, as one strain is kept (nu = 1/2): %s\n",
               report->material.isotropic ? "the volume" : "sqrt(E1) e11 + sqrt(E2) e22 + sqrt(E3) e33");
    else
        print_matrix("\nstiffness C", report->material.stiffness);
    print_matrix("\ncompliance S = C^-1", report->material.compliance);
    putchar('\n');
    if (!report->material.incompressible)
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
    if (!report->material.incompressible)
        print_matrix("\nstiffness in world axes", report->turned_stiffness);
    puts("\nengineering constants along the world axes");
    print_numbers("Ex Ey Ez", 3, report->turned_constants.youngs_modulus);
    print_numbers("nuxy nuyz nuzx", 3, report->turned_constants.poissons_ratio);
    print_numbers("Gxy Gyz Gzx", 3, report->turned_constants.shear_modulus);
}

/* --- JSON --- */

static json_t *numbers(int count, const double *values)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(array, ost_json_number(values[i]));
    return array;
}

static json_t *matrix(const double values[36])
{
    json_t *array = json_array();
    for (int i = 0; i < 6; i++)
        json_array_append_new(array, numbers(6, values + 6 * i));
    return array;
}

/* Three numbers by their names, which blanks separate. */
static json_t *add_named(json_t *object, const char *names, const double values[3])
{
    char name[3][8] = {"", "", ""};
    sscanf(names, "%7s %7s %7s", name[0], name[1], name[2]);
    for (int i = 0; i < 3; i++)
        json_object_set_new(object, name[i], ost_json_number(values[i]));
    return object;
}

static json_t *report_json(const Report *report)
{
    const OstOrthotropic *own = &report->material.constants, *world = &report->turned_constants;
    const double *low = report->low, *high = report->high;
    json_t *ratios = add_named(json_object(), "nu12 nu23 nu31", own->poissons_ratio);
    json_t *range =
        json_pack("{s:o, s:[ff], s:[ff], s:[ff], s:[ff]}", "scale", ost_json_number(report->scale), "nu12", low[0],
                  high[0], "nu23", low[1], high[1], "nu31", low[2], high[2], "family_nu", -1.0, 0.5);
    char moduli[OST_MODULI_WORDS];
    ost_orthotropic_words(own, moduli);
    json_t *root = json_pack("{s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "kind", report->kind, "moduli",
                             moduli, "youngs_modulus", add_named(json_object(), "E1 E2 E3", own->youngs_modulus),
                             "poissons_ratio", add_named(ratios, "nu21 nu32 nu13", report->reverse_ratio),
                             "shear_modulus", add_named(json_object(), "G12 G23 G31", own->shear_modulus), "stiffness",
                             matrix(report->material.stiffness), "compliance", matrix(report->material.compliance),
                             "stiffness_eigenvalues", numbers(6, report->stiffness_eigenvalues),
                             "normalised_eigenvalues", numbers(3, report->block_eigenvalues), "condition",
                             ost_json_number(report->material.condition), "stable_range", range);
    if (root && report->turned)
        json_object_set_new(root, "world",
                            json_pack("{s:o, s:o, s:o, s:o, s:o}", "axes", numbers(9, report->axes), "stiffness",
                                      matrix(report->turned_stiffness), "youngs_modulus",
                                      add_named(json_object(), "Ex Ey Ez", world->youngs_modulus), "poissons_ratio",
                                      add_named(json_object(), "nuxy nuyz nuzx", world->poissons_ratio),
                                      "shear_modulus", add_named(json_object(), "Gxy Gyz Gzx", world->shear_modulus)));
    return root;
}

OstStatus ost_material_report(OstContext *ctx, const OstMaterial *material, const char *kind, const double axes[9],
                              int json)
{
    Report report = {.kind = kind};
    OST_TRY(fill(ctx, material, axes, &report));
    json_t *root = json ? report_json(&report) : NULL;
    if (!json)
        print(&report);
    else if (!root)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "the material's JSON could not be made");
    return json ? ost_json_write(ctx, root, "-") : OST_SUCCESS;
}
