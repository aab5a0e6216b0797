/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "material/directions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What the mesh file states tet by tet, or at vertices: axes, moduli, eigenstrains. */

/* Directions at the vertices are kept where axes vary within the tets, which are or become quadratic; e1, e2 and e3
 * always, as their mean is no frame, and numbers, as finer tets and the estimate of the error want them. */
static unsigned use_of(const OstCase *c, const OstCaseField *asked, const OstMeshChunk *chunk)
{
    const int quadratic = c->order == 2 || (c->order == 0 && (chunk->nodes_per_tet == 10 || c->asks_error));
    if (asked->use == OST_CASE_FIELD_OF_DIRECTIONS)
        return OST_FIELD_OF_DIRECTIONS | (quadratic ? OST_FIELD_AT_VERTICES : 0U);
    return OST_FIELD_AT_VERTICES;
}

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
            ost_mesh_file_read_field(c->ctx, c->mesh_file, asked->name, use_of(c, asked, chunk), chunk)));
    }
    return OST_SUCCESS;
}

/* A field's numbers of a tet, or of its vertices one after the other; NULL if the mesh has none of the name. */
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

static int is_at_vertices(const OstScene *scene, const char *name)
{
    const int field = name && scene->mesh->tet_field ? ost_case_find_field(scene->c, name) : -1;
    return field >= 0 && field < scene->mesh->fields.count && scene->mesh->fields.at_vertices[field];
}

/* The numbers of a tet, or of its vertices one after the other, of which there must be `width` each. */
static OstStatus numbers_of(const OstScene *scene, const char *name, OstLocal tet, int width, const double **numbers)
{
    const int places = is_at_vertices(scene, name) ? 4 : 1;
    int found = 0;
    *numbers = field_of(scene->c, scene->mesh, name, tet, &found);
    if (*numbers && found == places * width)
        return OST_SUCCESS;
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "it has %d numbers a %s, expected %d", found / places,
                     places > 1 ? "vertex" : "tet", width);
}

int ost_scene_field_varies(const OstScene *scene, const OstAxesSpec *spec)
{
    return spec->kind == OST_AXES_FIELD &&
           (is_at_vertices(scene, spec->field[0]) || is_at_vertices(scene, spec->field[1]));
}

/* Of nine numbers at a vertex, which a finer mesh has from the old one's by means: is e3 about e1 × e2? */
static OstStatus check_frame(OstContext *ctx, const double at[9])
{
    double across[3];
    ost_cross3(at, at + 3, across);
    return ost_dot3(across, at + 6) > 0.5 * ost_norm3(at) * ost_norm3(at + 3) * ost_norm3(at + 6)
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_INVALID_INPUT,
                           "e1 (%g, %g, %g), e2 (%g, %g, %g) and e3 (%g, %g, %g) are no right-handed, orthogonal axes",
                           at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7], at[8]);
}

/* The directions of a tet at its vertices, 4 × 3: one of a field, or e1 and e2 of one of axes. */
static OstStatus directions_of(const OstScene *scene, const char *name, OstLocal tet, int width, double first[12],
                               double *second)
{
    const int at_vertices = is_at_vertices(scene, name);
    const double *numbers = NULL;
    OST_TRY(numbers_of(scene, name, tet, width, &numbers));
    for (int v = 0; v < 4; v++) {
        double axes[9];
        memcpy(axes, numbers + (at_vertices ? width * v : 0), (size_t)width * sizeof *axes);
        if (width == 9)
            OST_TRY(at_vertices ? check_frame(scene->ctx, axes) : ost_axes_check(scene->ctx, "e1, e2, e3", axes));
        memcpy(first + 3 * v, axes, 3 * sizeof *first);
        if (width == 9)
            memcpy(second + 3 * v, axes + 3, 3 * sizeof *second);
    }
    return OST_SUCCESS;
}

static void take_mean(const double vectors[12], double mean[3])
{
    for (int i = 0; i < 3; i++)
        mean[i] = 0.25 * (vectors[i] + vectors[3 + i] + vectors[6 + i] + vectors[9 + i]);
}

/* Its own axes, and `directions` unless that is NULL. */
static OstStatus axes_of_tet(const OstScene *scene, const OstAxesSpec *spec, OstLocal tet, double axes[9],
                             float *directions)
{
    const int nine = spec->along[0] < 0, two = nine || spec->field[1];
    double vectors[2][12], mean[2][3];
    int along[2];
    ost_directions_along(spec->along, two, along);
    OST_TRY(directions_of(scene, spec->field[0], tet, nine ? 9 : 3, vectors[0], vectors[1]));
    if (two && !nine)
        OST_TRY(directions_of(scene, spec->field[1], tet, 3, vectors[1], NULL));
    take_mean(vectors[0], mean[0]);
    if (two)
        take_mean(vectors[1], mean[1]);
    OST_TRY(ost_axes_from_directions(scene->ctx, along, mean[0], two ? mean[1] : NULL, axes));
    if (directions)
        ost_directions_set_linear(axes, along, vectors[0], two ? vectors[1] : NULL, directions);
    return OST_SUCCESS;
}

OstStatus ost_scene_field_axes(const OstScene *scene, const OstSceneMaterials *materials, OstTetAxes *axes)
{
    const OstMesh *mesh = scene->mesh;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const int region = mesh->tet_region[t];
        const OstAxesSpec *spec = &materials->axes[region];
        if (spec->kind != OST_AXES_FIELD || materials->material[region].isotropic)
            continue;
        float *directions = axes->directions && ost_scene_field_varies(scene, spec)
                                ? axes->directions + OST_DIRECTIONS * (size_t)t
                                : NULL;
        if (axes_of_tet(scene, spec, t, axes->of_tet + 9 * (size_t)t, directions) != OST_SUCCESS)
            return raise_for_tet(scene, ost_case_material_of(scene->c, mesh->regions.name[region])->axes_place,
                                 spec->field[0], t);
    }
    return OST_SUCCESS;
}

/* --- moduli --- */

/* factor, power, least (material/field_data.h) */
static void law_of(const OstModulusField *modulus, double law[3])
{
    law[0] = modulus->factor;
    law[1] = modulus->power;
    law[2] = modulus->least;
}

double ost_scene_chunk_modulus(const OstCase *c, const OstMeshChunk *chunk, const OstModulusField *modulus,
                               OstLocal tet)
{
    const int field = chunk->tet_field ? ost_case_find_field(c, modulus->field) : -1;
    if (field < 0 || field >= chunk->fields.count)
        return 1.0;
    const double *row = chunk->tet_field + (size_t)ost_tet_fields_width(&chunk->fields) * (size_t)tet;
    const int places = chunk->fields.at_vertices[field] ? 4 : 1;
    double law[3], sum = 0.0;
    for (int place = 0; place < places; place++)
        sum += row[chunk->fields.first[field] + place];
    law_of(modulus, law);
    return ost_scale_by_law(law, sum / places);
}

/* Of numbers of both signs one between them is 0, which makes a modulus only if the least one does. */
static OstStatus check_modulus(const OstScene *scene, const double law[3], int places, const double *numbers)
{
    int signs = 0;
    for (int place = 0; place < places; place++) {
        const double number = numbers[place], value = ost_scale_by_law(law, number);
        signs |= number > 0.0 ? 1 : 2;
        if (!isfinite(number))
            return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                             "%g is no number; mend the field, or give these tets a region with a modulus of its own",
                             number);
        if (!(value > 0.0 && isfinite(value)))
            return OST_RAISE(
                scene->ctx, OST_INVALID_INPUT,
                "%g makes a Young's modulus of %g, expected one above 0; `least` is taken where it would be smaller",
                number, value);
    }
    if (signs == 3 && !(law[1] > 0.0 && law[2] > 0.0))
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                         "its numbers are above and below 0 at vertices of one tet, and none makes a Young's modulus "
                         "in between; state `least`");
    return OST_SUCCESS;
}

/* Of the tet, or at its vertices: `places`, as many as any field has. */
static OstStatus modulus_of_tet(const OstScene *scene, const OstModulusField *modulus, OstLocal tet, int places,
                                double *found)
{
    const int given = is_at_vertices(scene, modulus->field) ? 4 : 1;
    const double *numbers = NULL;
    double law[3];
    law_of(modulus, law);
    OST_TRY(numbers_of(scene, modulus->field, tet, 1, &numbers));
    OST_TRY(check_modulus(scene, law, given, numbers));
    for (int place = 0; place < places; place++)
        found[place] = numbers[given > 1 ? place : 0];
    return OST_SUCCESS;
}

/* `found`: places for each tet, 1 in regions whose modulus is no field. */
static OstStatus find_moduli(const OstScene *scene, int places, double *found)
{
    const OstMesh *mesh = scene->mesh;
    const OstCaseMaterial *stated = NULL;
    int region = -1;
    for (OstLocal t = 0; t < mesh->tet_count; t++, found += places) {
        for (int place = 0; place < places; place++)
            found[place] = 1.0;
        if (mesh->tet_region[t] != region) {
            region = mesh->tet_region[t];
            stated = ost_case_material_of(scene->c, mesh->regions.name[region]);
        }
        if (!stated || !stated->modulus.field)
            continue;
        if (modulus_of_tet(scene, &stated->modulus, t, places, found) != OST_SUCCESS)
            return raise_for_tet(scene, stated->modulus.place, stated->modulus.field, t);
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_set_modulus(OstScene *scene)
{
    const OstNames *regions = &scene->mesh->regions;
    const OstLocal tets = scene->mesh->tet_count;
    double *numbers = NULL, *law = NULL;
    int any = 0, places = 1;
    OstStatus status = OST_NEW(scene->ctx, &law, 3 * regions->count);
    for (int r = 0; r < regions->count && status == OST_SUCCESS; r++) {
        static const OstModulusField none = {.factor = 1.0, .power = 1.0};
        const OstCaseMaterial *stated = ost_case_material_of(scene->c, regions->name[r]);
        const int is_field = stated && stated->modulus.field;
        law_of(is_field ? &stated->modulus : &none, law + 3 * r);
        any |= is_field;
        places = is_field && is_at_vertices(scene, stated->modulus.field) ? 4 : places;
    }
    if (any) {
        OST_THEN(OST_NEW(scene->ctx, &numbers, (size_t)places * (size_t)tets));
        OST_THEN(find_moduli(scene, places, numbers));
        OST_THEN(ost_field_set_scale_by_law(scene->field, tets, places, numbers, law));
    }
    OST_FREE(numbers, law);
    return status;
}

/* --- eigenstrains --- */

/* The eigenstrain that numbers stand for: of all directions, along the axes, with the shears, or a tensor. */
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

/* `width` numbers at each of `places`. */
static OstStatus check_numbers(const OstMesh *mesh, OstLocal tet, const OstCaseMaterial *stated, int width, int places,
                               const double *field)
{
    if (stated->eigen_per_unit && width != 1)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "the field '%s' has %d numbers a tet; a change is one",
                         stated->eigen_field, width);
    for (int k = 0; k < width * places; k++)
        if (!isfinite(field[k]))
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "the field '%s' has no number for tet %lld of region '%s', which it is asked for",
                             stated->eigen_field, (long long)ost_mesh_tet_number(mesh, tet),
                             mesh->regions.name[mesh->tet_region[tet]]);
    return OST_SUCCESS;
}

/* Eigenstrains that are fields: 1 or 4 places for each tet, with 6 columns each, or one number. */
typedef struct EigenForm {
    int any, places, columns;
} EigenForm;

static OstStatus eigenstrain_of_tet(const OstScene *scene, const OstCaseMaterial *stated, OstLocal tet,
                                    const EigenForm *form, double *strain)
{
    const int given = is_at_vertices(scene, stated->eigen_field) ? 4 : 1;
    int width = 0;
    const double *field = field_of(scene->c, scene->mesh, stated->eigen_field, tet, &width);
    if (!field)
        return OST_SUCCESS;
    width /= given;
    OST_TRY(check_numbers(scene->mesh, tet, stated, width, given, field));
    for (int place = 0; place < form->places; place++) {
        const double *there = field + (given > 1 ? width * place : 0);
        if (form->columns == 1)
            strain[place] = *there;
        else
            strain_of(stated, width, there, strain + 6 * place);
    }
    return OST_SUCCESS;
}

/* Of the tets in regions whose eigenstrain is a field; in memory from the context. */
static OstStatus eigenstrain_of_tets(const OstScene *scene, const EigenForm *form, double **strain)
{
    const OstMesh *mesh = scene->mesh;
    const OstCaseMaterial *stated = NULL;
    const size_t numbers = (size_t)form->columns * (size_t)form->places;
    int region = -1;
    OST_TRY(OST_NEW(mesh->ctx, strain, numbers * (size_t)mesh->tet_count));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        if (mesh->tet_region[t] != region) {
            region = mesh->tet_region[t];
            stated = ost_case_material_of(scene->c, mesh->regions.name[region]);
        }
        if (stated && stated->eigen_field)
            OST_TRY(ost_case_located(scene->c, stated->eigen_place,
                                     eigenstrain_of_tet(scene, stated, t, form, *strain + numbers * (size_t)t)));
    }
    return OST_SUCCESS;
}

static void add_to_form(const OstScene *scene, const OstCaseMaterial *stated, EigenForm *form)
{
    const int field = ost_case_find_field(scene->c, stated->eigen_field);
    const OstTetFields *fields = &scene->mesh->fields;
    const int places = is_at_vertices(scene, stated->eigen_field) ? 4 : 1;
    form->any = 1;
    form->places = places > 1 ? places : form->places;
    if (field >= 0 && field < fields->count && fields->first[field + 1] - fields->first[field] > places)
        form->columns = 6;
}

OstStatus ost_scene_set_eigenstrain(OstScene *scene)
{
    const OstMesh *mesh = scene->mesh;
    const OstNames *regions = &mesh->regions;
    EigenForm form = {.places = 1, .columns = 1};
    double *of_regions = NULL, *per_unit = NULL, *of_tets = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(scene->ctx, &of_regions, 6 * regions->count));
    OST_TRY_DONE(OST_NEW(scene->ctx, &per_unit, 6 * regions->count));
    for (int r = 0; r < regions->count; r++) {
        static const double one = 1.0;
        const OstCaseMaterial *stated = ost_case_material_of(scene->c, regions->name[r]);
        if (stated && stated->eigen_field) {
            add_to_form(scene, stated, &form);
            strain_of(stated, 1, &one, per_unit + 6 * r);
        } else if (stated) {
            memcpy(of_regions + 6 * r, stated->eigenstrain, sizeof stated->eigenstrain);
        }
    }
    if (form.any && mesh->tet_field)
        OST_TRY_DONE(eigenstrain_of_tets(scene, &form, &of_tets));
    status = ost_field_set_eigenstrain_at(scene->field, of_regions, mesh->tet_count, form.places, of_tets,
                                          of_tets && form.columns == 1 ? per_unit : NULL);
done:
    OST_FREE(of_regions, per_unit, of_tets);
    return status;
}
