/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/effects.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <stdio.h>
#include <string.h>

#define VARIANT_LABEL(name, effect, label) label,
const char *const ost_variant_label[] = {OST_VARIANT_TABLE(VARIANT_LABEL)};
#undef VARIANT_LABEL
#define VARIANT_EFFECT(name, effect, label) effect,
const OstEffect ost_variant_effect[] = {OST_VARIANT_TABLE(VARIANT_EFFECT)};
#undef VARIANT_EFFECT

/* Of one region: its volume, and the sums of volume × e_k e_k' over its tets. */
typedef struct RegionMean {
    double volume;
    double scale; /* volume × the factor of the stiffness */
    double direction[3][9];
} RegionMean;

/* Collective. */
static OstStatus sum_regions(const OstScene *scene, RegionMean *mean)
{
    const OstMesh *mesh = scene->mesh;
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        double axes[9];
        const double volume = fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, t)));
        RegionMean *of = &mean[mesh->tet_region[t]];
        ost_field_axes(scene->field, t, axes);
        of->volume += volume;
        of->scale += volume * ost_field_scale(scene->field, t, NULL);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 9; i++)
                of->direction[k][i] += volume * axes[3 * k + i / 3] * axes[3 * k + i % 3];
    }
    const int numbers = (int)(sizeof *mean / sizeof(double));
    return ost_sum(scene->ctx, numbers * mesh->regions.count, (double *)mean);
}

/* The unit vector that is on average best aligned with an axis, among those orthogonal to `taken` (0, or a unit
 * vector); returns by how much, 1 at most. Of equally good ones the first world axis wins, the same on any number of
 * ranks. */
static OstStatus best_aligned(OstContext *ctx, const RegionMean *mean, int k, const double taken[3], double found[3],
                              double *alignment)
{
    static const double tie = 1e-9;
    double projector[9], left[9], projected[9], values[3], vectors[9];
    for (int i = 0; i < 9; i++)
        projector[i] = (i % 4 == 0) - taken[i / 3] * taken[i % 3];
    ost_multiply3(projector, mean->direction[k], left);
    ost_multiply3(left, projector, projected);
    for (int i = 0; i < 3; i++)
        projected[4 * i] -= tie * i * mean->volume * projector[4 * i];
    OST_TRY(ost_symmetric_eigen(ctx, 3, projected, values, vectors));
    memcpy(found, vectors + 6, 3 * sizeof *found);
    *alignment = values[2] / mean->volume;
    return OST_SUCCESS;
}

/* The best aligned axis first, then the better of the other two; the third makes the frame right-handed. */
static OstStatus mean_frame(OstContext *ctx, const RegionMean *mean, double axes[9])
{
    static const double nothing[3] = {0.0};
    int order[2] = {-1, -1};
    for (int step = 0; step < 2; step++) {
        double best = -1.0;
        for (int k = 0; k < 3; k++) {
            double found[3], alignment;
            if (k == order[0])
                continue;
            OST_TRY(best_aligned(ctx, mean, k, step == 0 ? nothing : axes + 3 * order[0], found, &alignment));
            if (alignment <= best + 1e-9)
                continue;
            best = alignment;
            order[step] = k;
            memcpy(axes + 3 * k, found, sizeof found);
        }
    }
    const int third = 3 - order[0] - order[1];
    ost_cross3(axes + 3 * ((third + 1) % 3), axes + 3 * ((third + 2) % 3), axes + 3 * third);
    return OST_SUCCESS;
}

/* Young's modulus is the geometric mean; Poisson's ratio the mean of sqrt(nu_ij nu_ji), which for the stable family is
 * its nu. */
static OstStatus isotropic_mean(OstContext *ctx, const OstMaterial *material, OstMaterial *mean)
{
    const double *e = material->constants.youngs_modulus;
    const double *nu = material->constants.poissons_ratio;
    double ratio = 0.0;
    for (int k = 0; k < 3; k++)
        ratio += nu[k] * sqrt(e[(k + 1) % 3] / e[k]) / 3.0;
    const OstOrthotropic constants = ost_orthotropic_isotropic(cbrt(e[0]) * cbrt(e[1]) * cbrt(e[2]), ratio);
    return ost_material_create(ctx, material->name, &constants, material->density, mean);
}

/* `stated` is NULL for a material of the mesh file, which has none. */
static void take_eigenstrain(const OstCaseMaterial *stated, OstCaseMaterial *made)
{
    static const OstCaseMaterial none = {0};
    const OstCaseMaterial *from = stated ? stated : &none;
    memcpy(made->eigenstrain, from->eigenstrain, sizeof made->eigenstrain);
    made->eigenstrained = from->eigenstrained;
    made->eigen_field = from->eigen_field;
    made->eigen_place = from->eigen_place;
    made->eigen_per_unit = from->eigen_per_unit;
}

/* The material with its moduli times a factor: the mean of those of its tets. */
static OstStatus scaled(OstContext *ctx, double factor, OstMaterial *material)
{
    OstOrthotropic constants = material->constants;
    char name[sizeof material->name];
    const int isotropic = material->isotropic;
    const OstStrength strength = material->strength;
    for (int k = 0; k < 3; k++) {
        constants.youngs_modulus[k] *= factor;
        constants.shear_modulus[k] *= factor;
    }
    snprintf(name, sizeof name, "%s", material->name);
    OST_TRY(ost_material_create(ctx, name, &constants, material->density, material));
    material->isotropic &= isotropic;
    material->strength = strength;
    return OST_SUCCESS;
}

/* One entry of `materials` for each region of the mesh, whatever the case and the mesh file say. */
static OstStatus state_materials(const OstScene *scene, OstVariant variant, const RegionMean *mean,
                                 OstCaseMaterial *materials)
{
    const OstNames *regions = &scene->mesh->regions;
    int largest = 0;
    for (int r = 1; r < regions->count; r++)
        if (mean[r].volume > mean[largest].volume)
            largest = r;
    for (int r = 0; r < regions->count; r++) {
        const OstCaseMaterial *stated = ost_case_material_of(scene->c, regions->name[r]);
        const int from = variant == OST_VARIANT_ONE_MATERIAL ? largest : r;
        OstCaseMaterial *made = &materials[r];
        if (stated)
            *made = *stated;
        else /* a material of the mesh file: its axes are uniform */
            made->axes.kind = OST_AXES_FIXED;
        if (!stated && scene->field->region_axes)
            memcpy(made->axes.fixed, scene->field->region_axes + 9 * (size_t)r, sizeof made->axes.fixed);
        else if (!stated)
            made->axes.kind = OST_AXES_NONE;
        made->region = regions->name[r];
        made->material = scene->field->material[from];
        if (variant == OST_VARIANT_ONE_MATERIAL && scene->field->tet_scale && mean[from].volume > 0.0) {
            made->modulus.field = NULL;
            OST_TRY(scaled(scene->ctx, mean[from].scale / mean[from].volume, &made->material));
        }
        if (from != r)
            take_eigenstrain(ost_case_material_of(scene->c, regions->name[from]), made);
        if (variant == OST_VARIANT_ISOTROPIC) {
            /* the axes stay: an eigenstrain lies along them */
            OST_TRY(isotropic_mean(scene->ctx, &scene->field->material[r], &made->material));
        } else if (variant == OST_VARIANT_ONE_FRAME && ost_axes_vary(&made->axes) && mean[r].volume > 0.0) {
            made->axes = (OstAxesSpec){.kind = OST_AXES_FIXED};
            OST_TRY(mean_frame(scene->ctx, &mean[r], made->axes.fixed));
        }
    }
    return OST_SUCCESS;
}

static OstStatus replace_materials(const OstScene *scene, OstVariant variant, OstVariantCase *made)
{
    OstContext *ctx = scene->ctx;
    const int count = scene->mesh->regions.count;
    RegionMean *mean = NULL;
    OstStatus status = OST_NEW(ctx, &mean, (size_t)count);
    OST_THEN(OST_NEW(ctx, &made->materials, (size_t)count));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(sum_regions(scene, mean));
    OST_TRY_DONE(state_materials(scene, variant, mean, made->materials));
    made->c.materials = made->materials;
    made->c.material_count = count;
done:
    OST_FREE(mean);
    return status;
}

static OstStatus replace_constraints(const OstScene *scene, OstVariant variant, OstVariantCase *made)
{
    const OstCase *c = scene->c;
    OST_TRY(ost_agree(scene->ctx, OST_NEW(scene->ctx, &made->constraints, (size_t)c->constraint_count)));
    for (int i = 0; i < c->constraint_count; i++) {
        OstConstraint *constraint = &made->constraints[i];
        *constraint = c->constraints[i];
        if (variant == OST_VARIANT_NOT_MOVED) {
            memset(constraint->displacement, 0, sizeof constraint->displacement);
            memset(constraint->exact, 0, sizeof constraint->exact);
            memset(constraint->rotation, 0, sizeof constraint->rotation);
            memset(constraint->strain, 0, sizeof constraint->strain);
        } else if (constraint->kind == OST_CONSTRAIN_SLIDE) {
            constraint->kind = OST_CONSTRAIN_DISPLACEMENT;
            for (int k = 0; k < 3; k++)
                constraint->constrained[k] = 1;
        }
    }
    made->c.constraints = made->constraints;
    return OST_SUCCESS;
}

int ost_variant_applies(const OstEffectStudy *study, const OstEffects *effects, OstVariant variant)
{
    if (variant == OST_VARIANT_LINEAR)
        return study->base.large_rotation;
    if (variant == OST_VARIANT_LARGE_ROTATION)
        return !study->base.large_rotation;
    return ost_effect_on(effects, ost_variant_effect[variant]);
}

const char *ost_variant_why_unmeasured(const OstEffects *effects, OstVariant variant)
{
    switch (variant) {
    case OST_VARIANT_NO_RIGID_FACE:
        return "its motion and its loads would go with it";
    case OST_VARIANT_NO_TIE:
        return "the parts would come apart";
    case OST_VARIANT_NO_PERIODIC:
        return "the cell's mean strain would go with them";
    case OST_VARIANT_LARGE_ROTATION:
        return effects->why_linear;
    default:
        return NULL;
    }
}

OstStatus ost_variant_case(const OstScene *scene, OstVariant variant, OstVariantCase *made)
{
    *made = (OstVariantCase){.c = *scene->c};
    made->c.output_fields = 0;
    switch (variant) {
    case OST_VARIANT_ISOTROPIC:
    case OST_VARIANT_ONE_FRAME:
    case OST_VARIANT_ONE_MATERIAL:
        return replace_materials(scene, variant, made);
    case OST_VARIANT_NOT_MOVED:
    case OST_VARIANT_CLAMPED:
        return replace_constraints(scene, variant, made);
    case OST_VARIANT_LINEAR:
        made->c.large_rotation = OST_LARGE_ROTATION_OFF;
        return OST_SUCCESS;
    case OST_VARIANT_LARGE_ROTATION:
        made->c.large_rotation = OST_LARGE_ROTATION_ON;
        return OST_SUCCESS;
    default:
        made->c.without = UINT64_C(1) << (ost_variant_effect[variant] - OST_EFFECT_FIRST);
        return OST_SUCCESS;
    }
}

void ost_variant_case_release(OstVariantCase *made)
{
    OST_FREE(made->materials, made->constraints);
}
