/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What the mesh file states tet by tet: axes, moduli, eigenstrains. */

OstStatus ost_scene_read_tet_fields(const OstCase *c, OstMeshChunk *chunk)
{
    for (int f = 0; f < c->field_count; f++) {
        const OstCaseField *asked = &c->fields[f];
        if (c->mesh_kind != OST_MESH_FILE)
            return ost_case_located(
                c, asked->place,
                OST_RAISE(c->ctx, OST_INVALID_INPUT,
                          "the field '%s' is read from the mesh file, and this mesh comes from none", asked->name));
        OST_TRY(ost_case_located(
            c, asked->place,
            ost_mesh_file_read_field(c->ctx, c->mesh_file, asked->name,
                                     asked->directions ? OST_FIELD_OF_DIRECTIONS : OST_FIELD_OF_NUMBERS, chunk)));
    }
    return OST_SUCCESS;
}

/* A field's numbers of a tet; NULL if the mesh has none of the name. */
static const double *field_of(const OstCase *c, const OstMesh *mesh, const char *name, OstLocal tet, int *width)
{
    const int field = mesh->tet_field ? ost_case_find_field(c, name) : -1;
    if (field < 0 || field >= mesh->fields.count)
        return NULL;
    *width = mesh->fields.first[field + 1] - mesh->fields.first[field];
    return mesh->tet_field + (size_t)ost_tet_fields_width(&mesh->fields) * (size_t)tet + mesh->fields.first[field];
}

static OstStatus raise_for_tet(const OstScene *scene, OstPlace place, const char *field, OstLocal tet)
{
    const OstMesh *mesh = scene->mesh;
    char reason[512];
    snprintf(reason, sizeof reason, "%s", ost_error_text(scene->ctx));
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d:%d: the field '%s', tet %lld of region '%s': %s",
                     scene->c->path, place.line, place.column, field, (long long)ost_mesh_tet_number(mesh, tet),
                     mesh->regions.name[mesh->tet_region[tet]], reason);
}

/* --- axes --- */

/* The numbers of a tet, of which there must be `width`. */
static OstStatus numbers_of(const OstScene *scene, const char *name, OstLocal tet, int width, const double **numbers)
{
    int found = 0;
    *numbers = field_of(scene->c, scene->mesh, name, tet, &found);
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

static double modulus_of_number(const OstModulusField *modulus, double number)
{
    return fmax(modulus->factor * pow(number, modulus->power), modulus->least);
}

double ost_scene_chunk_modulus(const OstCase *c, const OstMeshChunk *chunk, const OstModulusField *modulus,
                               OstLocal tet)
{
    const int field = chunk->tet_field ? ost_case_find_field(c, modulus->field) : -1;
    if (field < 0 || field >= chunk->fields.count)
        return 1.0;
    const size_t row = (size_t)ost_tet_fields_width(&chunk->fields) * (size_t)tet;
    return modulus_of_number(modulus, chunk->tet_field[row + (size_t)chunk->fields.first[field]]);
}

static OstStatus modulus_of_tet(const OstScene *scene, const OstModulusField *modulus, OstLocal tet, double *value)
{
    const double *number = NULL;
    OST_TRY(numbers_of(scene, modulus->field, tet, 1, &number));
    *value = modulus_of_number(modulus, *number);
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

/* --- eigenstrains --- */

/* The eigenstrain that a tet's numbers stand for: of all directions, along the axes, with the shears, or a tensor. */
static void strain_of(const OstCaseMaterial *stated, int width, const double *field, double strain[6])
{
    for (int p = 0; p < 6; p++)
        strain[p] = p < 3 ? field[width == 1 ? 0 : width == 9 ? 4 * p : p] : width == 6 ? field[p] : 0.0;
    for (int p = 3; p < 6 && width == 9; p++) {
        const int i = p - 3, j = (i + 1) % 3;
        strain[p] = field[3 * i + j] + field[3 * j + i];
    }
    for (int p = 0; p < 6 && stated->eigen_per_unit; p++)
        strain[p] = field[0] * stated->eigenstrain[p];
}

static OstStatus check_numbers(const OstMesh *mesh, OstLocal tet, const OstCaseMaterial *stated, int width,
                               const double *field)
{
    if (stated->eigen_per_unit && width != 1)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "the field '%s' has %d numbers a tet; a change is one",
                         stated->eigen_field, width);
    for (int k = 0; k < width; k++)
        if (!isfinite(field[k]))
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "the field '%s' has no number for tet %lld of region '%s', which it is asked for",
                             stated->eigen_field, (long long)ost_mesh_tet_number(mesh, tet),
                             mesh->regions.name[mesh->tet_region[tet]]);
    return OST_SUCCESS;
}

/* Of the tets in regions whose eigenstrain is a field; in memory from the context. */
static OstStatus eigenstrain_of_tets(const OstCase *c, const OstMesh *mesh, double **strain)
{
    const OstCaseMaterial *stated = NULL;
    int region = -1;
    OST_TRY(OST_NEW(mesh->ctx, strain, 6 * (size_t)mesh->tet_count));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        if (mesh->tet_region[t] != region) {
            region = mesh->tet_region[t];
            stated = ost_case_material_of(c, mesh->regions.name[region]);
        }
        if (!stated || !stated->eigen_field)
            continue;
        int width = 0;
        const double *field = field_of(c, mesh, stated->eigen_field, t, &width);
        if (!field)
            continue;
        OST_TRY(ost_case_located(c, stated->eigen_place, check_numbers(mesh, t, stated, width, field)));
        strain_of(stated, width, field, *strain + 6 * (size_t)t);
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_set_eigenstrain(OstScene *scene)
{
    const OstNames *regions = &scene->mesh->regions;
    double *of_regions = NULL, *of_tets = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(scene->ctx, &of_regions, 6 * regions->count));
    for (int r = 0; r < regions->count; r++) {
        const OstCaseMaterial *stated = ost_case_material_of(scene->c, regions->name[r]);
        if (stated && !stated->eigen_field)
            memcpy(of_regions + 6 * r, stated->eigenstrain, sizeof stated->eigenstrain);
    }
    if (scene->mesh->tet_field)
        OST_TRY_DONE(eigenstrain_of_tets(scene->c, scene->mesh, &of_tets));
    status = ost_field_set_eigenstrain(scene->field, of_regions, scene->mesh->tet_count, of_tets);
done:
    OST_FREE(of_regions, of_tets);
    return status;
}
