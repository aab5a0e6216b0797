/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan_parts.h"

#include "case/regions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int count_different(const double x[3])
{
    return 1 + (x[1] != x[0]) + (x[2] != x[0] && x[2] != x[1]);
}

static void say_why_orthotropic(const char *region, const OstOrthotropic *k, OstPlanMaterials *m)
{
    const int moduli = count_different(k->youngs_modulus);
    if (moduli > 1)
        snprintf(m->orthotropic_reason, sizeof m->orthotropic_reason, "%d different Young's moduli in region '%.60s'",
                 moduli, region);
    else if (count_different(k->poissons_ratio) > 1)
        snprintf(m->orthotropic_reason, sizeof m->orthotropic_reason, "%d different Poisson's ratios in region '%.60s'",
                 count_different(k->poissons_ratio), region);
    else
        snprintf(m->orthotropic_reason, sizeof m->orthotropic_reason,
                 "the shear moduli of region '%.60s' are not those of an isotropic material", region);
}

static const char *what_varying_axes_follow(OstAxesKind kind)
{
    switch (kind) {
    case OST_AXES_CYLINDRICAL:
        return "axes follow a cylinder";
    case OST_AXES_CURVE:
        return "axes follow a curve";
    case OST_AXES_CELLS:
        return "axes are given tet by tet";
    case OST_AXES_GRADIENT:
        return "axes follow the gradients of two potentials";
    default:
        return "axes differ from place to place";
    }
}

void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, double *softest, double *stiffest,
                        OstSolverFacts *facts)
{
    const double *e = k->youngs_modulus;
    const double least = fmin(e[0], fmin(e[1], e[2]));
    const double most = fmax(e[0], fmax(e[1], e[2]));
    double eigenvalues[3] = {1.0, 1.0, 1.0};
    if (ost_orthotropic_eigenvalues(ctx, k, eigenvalues) == OST_SUCCESS)
        facts->poisson = fmax(facts->poisson, ost_equivalent_poisson(eigenvalues[0]));
    *softest = *softest > 0.0 ? fmin(*softest, least) : least;
    *stiffest = fmax(*stiffest, most);
    facts->anisotropy = fmax(facts->anisotropy, most / least);
    facts->contrast = *stiffest / *softest;
}

static void count_axes(const OstCaseMaterial *stated, OstPlanMaterials *m)
{
    if (!ost_axes_vary(&stated->axes))
        return;
    if (m->varying++ == 0)
        snprintf(m->varying_reason, sizeof m->varying_reason, "%s in region '%.60s'",
                 what_varying_axes_follow(stated->axes.kind), stated->region);
    if (stated->axes.kind == OST_AXES_GRADIENT)
        m->gradient_region = stated->region;
}

void ost_plan_materials(const OstCase *c, const OstFileMaterials *from_file, OstPlanMaterials *m)
{
    double softest = 0.0;
    double stiffest = 0.0;
    memset(m, 0, sizeof *m);
    for (int i = 0; i < c->material_count; i++) {
        const OstCaseMaterial *stated = &c->materials[i];
        const OstOrthotropic *constants = &stated->material.constants;
        if (ost_case_material_is_overridden(c, i))
            continue;
        m->count++;
        ost_plan_add_facts(c->ctx, constants, &softest, &stiffest, &m->facts);
        if (stated->material.isotropic)
            continue;
        if (m->orthotropic++ == 0)
            say_why_orthotropic(stated->region, constants, m);
        count_axes(stated, m);
    }
    for (int r = 0; from_file && r < from_file->count && !ost_case_material_is_overridden(c, -1); r++) {
        m->count++;
        ost_plan_add_facts(c->ctx, &from_file->material[r].constants, &softest, &stiffest, &m->facts);
        if (!from_file->material[r].isotropic && m->orthotropic++ == 0)
            say_why_orthotropic(from_file->material[r].name, &from_file->material[r].constants, m);
    }
    if (m->orthotropic == 0)
        snprintf(m->orthotropic_reason, sizeof m->orthotropic_reason, "every material is isotropic");
    if (m->varying == 0)
        snprintf(m->varying_reason, sizeof m->varying_reason, "%s",
                 m->orthotropic > 0 ? "the axes are the same all over each region"
                                    : "an isotropic body has no use for axes");
}
