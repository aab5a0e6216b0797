/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"

#include "case/case_data.h"
#include "material/field_data.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int count_different(const double x[3])
{
    return 1 + (x[1] != x[0]) + (x[2] != x[0] && x[2] != x[1]);
}

static void say_why_orthotropic(const char *region, const OstOrthotropic *k, const OstCaseMaterial *stated,
                                char reason[160])
{
    const int moduli = count_different(k->youngs_modulus);
    const int ratios = count_different(k->poissons_ratio);
    if (moduli > 1)
        snprintf(reason, 160, "%d different Young's moduli in region '%.60s'", moduli, region);
    else if (ratios > 1)
        snprintf(reason, 160, "%d different Poisson's ratios in region '%.60s'", ratios, region);
    else if (stated && (stated->eigen_field || ost_strain_has_directions(stated->eigenstrain)))
        snprintf(reason, 160, "the eigenstrain of region '%.60s' has directions", region);
    else if (stated && ost_strength_has_directions(&stated->material.strength))
        snprintf(reason, 160, "the strengths of region '%.60s' have directions", region);
    else if (stated && stated->axes_asked_for)
        snprintf(reason, 160, "stresses along the axes of region '%.60s' are asked for", region);
    else
        snprintf(reason, 160, "the shear moduli of region '%.60s' are not those of an isotropic material", region);
}

static const char *what_varying_axes_follow(OstAxesKind kind)
{
    switch (kind) {
    case OST_AXES_CYLINDRICAL:
        return "axes follow a cylinder";
    case OST_AXES_CURVE:
        return "axes follow a curve";
    case OST_AXES_CELLS:
        return "axes differ from tet to tet";
    case OST_AXES_GRADIENT:
        return "axes follow the gradients of potentials";
    case OST_AXES_FIELD:
        return "axes are a field of the mesh file";
    default:
        return "axes differ from place to place";
    }
}

void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, OstModuli *moduli, OstSolverFacts *facts)
{
    const double *e = k->youngs_modulus;
    const double least = fmin(e[0], fmin(e[1], e[2]));
    const double most = fmax(e[0], fmax(e[1], e[2]));
    double eigenvalues[3] = {1.0, 1.0, 1.0};
    if (ost_orthotropic_eigenvalues(ctx, k, eigenvalues) == OST_SUCCESS)
        facts->poisson = fmax(facts->poisson, ost_equivalent_poisson(eigenvalues[0]));
    moduli->softest = moduli->softest > 0.0 ? fmin(moduli->softest, least) : least;
    moduli->most_rigid = fmax(moduli->most_rigid, least);
    moduli->stiffest = fmax(moduli->stiffest, most);
    facts->anisotropy = fmax(facts->anisotropy, most / least);
    facts->contrast = moduli->stiffest / moduli->softest;
    facts->jump = moduli->most_rigid / moduli->softest;
}

static int is_eigenstrained(const OstCaseMaterial *stated)
{
    if (stated->eigen_field)
        return 1;
    for (int p = 0; p < 6; p++)
        if (stated->eigenstrain[p] != 0.0)
            return 1;
    return 0;
}

static void add_axes(const OstCaseMaterial *stated, OstEffectFacts *facts)
{
    if (!ost_axes_vary(&stated->axes))
        return;
    if (facts->varying++ == 0)
        snprintf(facts->varying_reason, sizeof facts->varying_reason, "%s in region '%.60s'",
                 what_varying_axes_follow(stated->axes.kind), stated->region);
    facts->directions += stated->axes.kind == OST_AXES_GRADIENT || stated->axes.kind == OST_AXES_FIELD;
    if (stated->axes.kind == OST_AXES_GRADIENT)
        facts->gradient_region = stated->region;
}

/* `stated` is NULL for a material of the mesh file, which has fixed axes. */
static void add_material(OstContext *ctx, const char *region, const OstMaterial *material,
                         const OstCaseMaterial *stated, OstEffectFacts *facts)
{
    double eigenvalues[3] = {1.0, 1.0, 1.0};
    facts->materials++;
    if (stated && stated->modulus.field)
        facts->modulus_region = stated->region;
    facts->strengths += material->strength.known;
    if (stated && is_eigenstrained(stated))
        facts->eigenstrained_region = stated->region;
    if (ost_orthotropic_eigenvalues(ctx, &material->constants, eigenvalues) == OST_SUCCESS)
        facts->nearly_incompressible += ost_has_one_stiff_mode(eigenvalues, OST_NEARLY_INCOMPRESSIBLE);
    if (material->isotropic)
        return;
    if (facts->orthotropic++ == 0)
        say_why_orthotropic(region, &material->constants, stated, facts->orthotropic_reason);
    if (stated)
        add_axes(stated, facts);
}

/* A mesh without regions has one region, which every entry is for. */
static int is_in_use(const OstCase *c, const OstNames *regions, int entry)
{
    for (int r = 0; regions && r < regions->count; r++)
        if (ost_case_material_of(c, regions->name[r]) == &c->materials[entry])
            return 1;
    return !regions && entry == c->material_count - 1;
}

void ost_plan_materials(const OstCase *c, const OstPlanMesh *mesh, OstEffectFacts *facts, OstSolverFacts *solver)
{
    const OstFileMaterials *file = mesh->regions ? mesh->materials : NULL;
    OstModuli moduli = {0};
    for (int i = 0; i < c->material_count; i++) {
        const OstCaseMaterial *stated = &c->materials[i];
        if (!is_in_use(c, mesh->regions, i))
            continue;
        add_material(c->ctx, stated->region, &stated->material, stated, facts);
        ost_plan_add_facts(c->ctx, &stated->material.constants, &moduli, solver);
    }
    for (int r = 0; file && r < file->count; r++) {
        const OstMaterial *material = &file->material[r];
        if (ost_case_material_of(c, mesh->regions->name[r]))
            continue;
        add_material(c->ctx, material->name, material, NULL, facts);
        ost_plan_add_facts(c->ctx, &material->constants, &moduli, solver);
    }
}
