/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Axes and moduli that the mesh file states tet by tet. */

static OstStatus raise_for_tet(const OstScene *scene, OstPlace place, const char *field, OstLocal tet)
{
    const OstMesh *mesh = scene->mesh;
    char reason[512];
    snprintf(reason, sizeof reason, "%s", ost_error_text(scene->ctx));
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d:%d: the field '%s', tet %lld of region '%s': %s",
                     scene->c->path, place.line, place.column, field, (long long)mesh->tet_label[tet],
                     mesh->regions.name[mesh->tet_region[tet]], reason);
}

/* --- axes --- */

/* The numbers of a tet, of which there must be `width`. */
static OstStatus numbers_of(const OstScene *scene, const char *name, OstLocal tet, int width, const double **numbers)
{
    int found = 0;
    *numbers = ost_scene_tet_field(scene->c, scene->mesh, name, tet, &found);
    if (*numbers && found == width)
        return OST_SUCCESS;
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "it has %d numbers a tet, expected %d", found, width);
}

static OstStatus axes_of_tet(const OstScene *scene, const OstAxesSpec *spec, OstLocal tet, double axes[9])
{
    const double *first = NULL, *second = NULL;
    if (spec->along[0] < 0) {
        OST_TRY(numbers_of(scene, spec->field[0], tet, 9, &first));
        memcpy(axes, first, 9 * sizeof *axes);
        return ost_axes_check(scene->ctx, "e1, e2, e3", axes);
    }
    OST_TRY(numbers_of(scene, spec->field[0], tet, 3, &first));
    if (spec->field[1])
        OST_TRY(numbers_of(scene, spec->field[1], tet, 3, &second));
    return ost_axes_from_directions(scene->ctx, spec->along, first, second, axes);
}

OstStatus ost_scene_field_axes(const OstScene *scene, const OstSceneMaterials *materials, double *axes)
{
    const OstMesh *mesh = scene->mesh;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const int region = mesh->tet_region[t];
        const OstAxesSpec *spec = &materials->axes[region];
        if (spec->kind != OST_AXES_FIELD || materials->material[region].isotropic)
            continue;
        if (axes_of_tet(scene, spec, t, axes + 9 * (size_t)t) != OST_SUCCESS)
            return raise_for_tet(scene, ost_case_material_of(scene->c, mesh->regions.name[region])->axes_place,
                                 spec->field[0], t);
    }
    return OST_SUCCESS;
}

/* --- moduli --- */

static OstStatus modulus_of_tet(const OstScene *scene, const OstModulusField *modulus, OstLocal tet, double *value)
{
    const double *number = NULL;
    OST_TRY(numbers_of(scene, modulus->field, tet, 1, &number));
    *value = fmax(modulus->factor * pow(*number, modulus->power), modulus->least);
    if (*value > 0.0 && isfinite(*value) && isfinite(*number))
        return OST_SUCCESS;
    return OST_RAISE(
        scene->ctx, OST_INVALID_INPUT,
        "%g makes a Young's modulus of %g, expected one above 0; `least` is taken where it would be smaller", *number,
        *value);
}

OstStatus ost_scene_set_modulus(OstScene *scene)
{
    const OstMesh *mesh = scene->mesh;
    double *factor = NULL;
    int region = -1, any = 0;
    const OstCaseMaterial *stated = NULL;
    for (int m = 0; m < scene->c->material_count; m++)
        any |= scene->c->materials[m].modulus.field != NULL;
    if (!any)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(scene->ctx, &factor, mesh->tet_count);
    for (OstLocal t = 0; t < mesh->tet_count && status == OST_SUCCESS; t++) {
        factor[t] = 1.0;
        if (mesh->tet_region[t] != region) {
            region = mesh->tet_region[t];
            stated = ost_case_material_of(scene->c, mesh->regions.name[region]);
        }
        if (!stated || !stated->modulus.field)
            continue;
        if (modulus_of_tet(scene, &stated->modulus, t, &factor[t]) != OST_SUCCESS)
            status = raise_for_tet(scene, stated->modulus.place, stated->modulus.field, t);
    }
    OST_THEN(ost_field_set_scale(scene->field, mesh->tet_count, factor));
    OST_FREE(factor);
    return status;
}
