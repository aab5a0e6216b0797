/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/fields_file.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "fields/output_field.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "formats/vtu/vtu.h"
#include "recovery/derived.h"

#include <string.h>

const char *ost_result_status(const OstResult *result)
{
    return result->verdict.count == 0 ? "accepted" : result->unfinished ? "unfinished" : "refused";
}

/* The arrays of a file, and those of them that are made for it alone. */
typedef struct Arrays {
    int count;
    OstOutputArray array[OST_FIELD_COUNT];
    void *made[OST_FIELD_COUNT]; /* or NULL */
} Arrays;

/* What the result has of a field that is not made for the file; NULL: it was not recovered. */
static const void *values_of(const OstResult *result, OstOutputFieldBit field)
{
    switch (field) {
    case OST_FIELD_DISPLACEMENT:
        return result->displacement;
    case OST_FIELD_REACTION:
        return result->reaction;
    case OST_FIELD_STRESS:
        return result->stress;
    case OST_FIELD_NODE_STRESS:
        return result->node_stress;
    case OST_FIELD_ENERGY:
        return result->strain_energy_density;
    case OST_FIELD_REGION:
        return result->mesh->tet_region;
    case OST_FIELD_ERROR:
        return result->tet_error;
    case OST_FIELD_BUCKLING_MODE_1:
    case OST_FIELD_BUCKLING_MODE_2:
    case OST_FIELD_BUCKLING_MODE_3:
        return result->buckling_mode[field - OST_FIELD_BUCKLING_MODE_1];
    default:
        return NULL;
    }
}

/* --- fields that are made for the file --- */

static int is_made(const OstResult *result, OstOutputFieldBit field)
{
    switch (field) {
    case OST_FIELD_LOAD:
        return result->force != NULL;
    case OST_FIELD_AXES:
        return result->field->region_axes || result->field->tet_turn;
    case OST_FIELD_STRAIN:
        return result->strain != NULL;
    case OST_FIELD_RANK:
        return 1;
    default:
        return ost_output_field(field).is_derived && ost_result_can_derive(result, field);
    }
}

static void make_strain(const OstResult *result, double *strain)
{
    for (size_t i = 0; i < 6 * (size_t)result->mesh->owned_tets; i++) /* readers take six components for a tensor's */
        strain[i] = (i % 6 < 3 ? 1.0 : 0.5) * result->strain[i];
}

/* Local, and of the loads the owned nodes alone. */
static OstStatus make_values(const OstResult *result, OstOutputFieldBit field, void *values)
{
    const OstMesh *mesh = result->mesh;
    switch (field) {
    case OST_FIELD_LOAD:
        if (mesh->owned_nodes > 0)
            memcpy(values, result->force, 3 * (size_t)mesh->owned_nodes * sizeof(double));
        return OST_SUCCESS;
    case OST_FIELD_AXES:
        for (OstLocal t = 0; t < mesh->owned_tets; t++)
            ost_field_axes(result->field, t, (double *)values + 9 * (size_t)t);
        return OST_SUCCESS;
    case OST_FIELD_STRAIN:
        make_strain(result, values);
        return OST_SUCCESS;
    case OST_FIELD_RANK:
        for (OstLocal t = 0; t < mesh->owned_tets; t++)
            ((int32_t *)values)[t] = ost_rank(result->ctx);
        return OST_SUCCESS;
    default:
        return ost_result_derive(result, field, values);
    }
}

static OstStatus make_room(const OstResult *result, const OstOutputField *about, void **values)
{
    const size_t rows = (size_t)(about->centring == OST_ON_NODES ? result->mesh->node_count : result->mesh->owned_tets);
    const OstOutputArray row = {about->word, about->centring, about->type, about->components, NULL};
    return ost_allocate_uncleared(result->ctx, rows, ost_output_row_bytes(&row), values);
}

/* What follows from others is work of the same effect. */
static OstStatus make(const OstResult *result, OstOutputFieldBit field, void **values)
{
    OstContext *ctx = result->ctx;
    const OstOutputField about = ost_output_field(field);
    if (about.is_derived)
        ost_ledger_enter(ctx, 1U << field & OST_LOAD_FACTORS ? OST_EFFECT_STRENGTH : OST_EFFECT_RECOVERY);
    OstStatus status = make_room(result, &about, values);
    OST_THEN(make_values(result, field, *values));
    if (about.is_derived)
        ost_ledger_leave(ctx);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS && field == OST_FIELD_LOAD)
        status = ost_halo_import(result->mesh->halo, 3 * sizeof(double), *values);
    return status;
}

OstStatus ost_result_field(const OstResult *result, OstOutputFieldBit field, OstFieldValues *found)
{
    const OstOutputField about = ost_output_field(field);
    const OstMesh *mesh = result->mesh;
    *found = (OstFieldValues){.unit = about.unit,
                              .description = about.description,
                              .component_names = about.component_names,
                              .components = about.components,
                              .is_integer = about.type == OST_VALUES_INT32,
                              .rows = about.centring == OST_ON_NODES ? mesh->node_count : mesh->owned_tets,
                              .values = (void *)values_of(result, field)};
    if (found->values || !is_made(result, field))
        return OST_SUCCESS;
    const OstStatus status = make(result, field, &found->values);
    found->is_made = status == OST_SUCCESS;
    if (status != OST_SUCCESS)
        OST_FREE(found->values);
    return status;
}

static OstStatus list_arrays(const OstResult *result, unsigned fields, Arrays *arrays)
{
    for (int f = 0; f < OST_FIELD_COUNT; f++) {
        const OstOutputField about = ost_output_field((OstOutputFieldBit)f);
        const void *values = values_of(result, (OstOutputFieldBit)f);
        if (!(fields >> f & 1U) || !(values || is_made(result, (OstOutputFieldBit)f)))
            continue;
        if (!values)
            OST_TRY(make(result, (OstOutputFieldBit)f, &arrays->made[f]));
        arrays->array[arrays->count++] = (OstOutputArray){about.word, about.centring, about.type, about.components,
                                                          values ? values : arrays->made[f]};
    }
    return OST_SUCCESS;
}

/* --- the file --- */

/* Why the result is no answer; NULL: it is one. */
static const OstOutputMark *mark_of(const OstResult *result, char *reasons[OST_MOST_OBJECTIONS], OstOutputMark *mark)
{
    const OstVerdict *objections = &result->verdict;
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    *mark = (OstOutputMark){ost_result_status(result), result->unfinished, objections->count, reasons};
    return objections->count > 0 ? mark : NULL;
}

OstStatus ost_fields_write(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays,
                           const OstOutputMark *mark)
{
    static OstStatus (*const write[OST_RESULT_FORMS])(OstContext *, const char *, const OstMesh *, int,
                                                      const OstOutputArray *,
                                                      const OstOutputMark *) = {[OST_RESULT_VTKHDF] = ost_vtkhdf_write,
                                                                                [OST_RESULT_HDF] = ost_vtkhdf_write,
                                                                                [OST_RESULT_VTU] = ost_vtu_write,
                                                                                [OST_RESULT_PVTU] = ost_pvtu_write};
    size_t stem;
    const OstResultForm form = ost_result_form(path, &stem);
    if (form == OST_RESULT_FORMS)
        return OST_RAISE(mesh->ctx, OST_INVALID_USAGE,
                         "'%s' does not end with " OST_RESULT_ENDINGS ", which a file of fields must", path);
    return write[form](mesh->ctx, path, mesh, count, arrays, mark);
}

static OstStatus write_file(const OstResult *result, const char *path, const Arrays *arrays)
{
    char *reasons[OST_MOST_OBJECTIONS];
    OstOutputMark mark;
    return ost_fields_write(result->mesh, path, arrays->count, arrays->array, mark_of(result, reasons, &mark));
}

/* A file to itself, or a step of one. */
typedef struct Place {
    const char *path; /* NULL: a step */
    OstStepsFile *file;
    double time;
    const char *name;
} Place;

static OstStatus write_step(const OstResult *result, const Place *place, const Arrays *arrays)
{
    char *reasons[OST_MOST_OBJECTIONS];
    OstOutputMark mark;
    return ost_vtkhdf_add(place->file, result->mesh, place->time, place->name, arrays->count, arrays->array,
                          mark_of(result, reasons, &mark));
}

static OstStatus write_result(const OstResult *result, unsigned fields, const Place *place)
{
    OstContext *ctx = result->ctx;
    Arrays arrays = {0};
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    OstStatus status = list_arrays(result, fields, &arrays);
    OST_THEN(place->path ? write_file(result, place->path, &arrays) : write_step(result, place, &arrays));
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        OST_FREE(arrays.made[f]);
    ost_ledger_leave(ctx);
    return status;
}

OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path)
{
    return write_result(result, fields, &(Place){.path = path});
}

OstStatus ost_result_write_step(const OstResult *result, unsigned fields, OstStepsFile *file, double time,
                                const char *name)
{
    const unsigned of_step = ost_vtkhdf_has_step(file) ? fields & ~(unsigned)OST_FIELDS_OF_BODY : fields;
    return write_result(result, of_step, &(Place){.file = file, .time = time, .name = name});
}
