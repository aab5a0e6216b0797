/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "problem/scene_data.h"

static const char *const field_word[OST_FIELD_COUNT] = {
#define OST_FIELD_WORD(name, word) word,
    OST_OUTPUT_FIELD_TABLE(OST_FIELD_WORD)
#undef OST_FIELD_WORD
};

/* Arrays computed for the file alone. */
typedef struct Derived {
    double *axes;
    int32_t *rank;
} Derived;

static OstStatus make_axes(const OstResult *result, double **axes)
{
    OST_TRY(OST_NEW(result->ctx, axes, 9 * (size_t)result->mesh->owned_tets));
    for (OstLocal t = 0; t < result->mesh->owned_tets; t++)
        ost_field_axes(result->field, t, *axes + 9 * (size_t)t);
    return OST_SUCCESS;
}

static OstStatus make_rank(const OstResult *result, int32_t **rank)
{
    OST_TRY(OST_NEW(result->ctx, rank, result->mesh->owned_tets));
    for (OstLocal t = 0; t < result->mesh->owned_tets; t++)
        (*rank)[t] = ost_rank(result->ctx);
    return OST_SUCCESS;
}

static OstStatus describe_field(const OstResult *result, OstOutputFieldBit field, Derived *derived,
                                OstOutputArray *array)
{
    *array = (OstOutputArray){field_word[field], OST_ON_TETS, OST_VALUES_DOUBLE, 6, NULL};
    switch (field) {
    case OST_FIELD_DISPLACEMENT:
        *array = (OstOutputArray){field_word[field], OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->displacement};
        return OST_SUCCESS;
    case OST_FIELD_REACTION:
        *array = (OstOutputArray){field_word[field], OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->reaction};
        return OST_SUCCESS;
    case OST_FIELD_STRESS:
        array->values = result->stress;
        return OST_SUCCESS;
    case OST_FIELD_NODE_STRESS:
        *array = (OstOutputArray){field_word[field], OST_ON_NODES, OST_VALUES_DOUBLE, 6, result->node_stress};
        return OST_SUCCESS;
    case OST_FIELD_STRAIN:
        array->values = result->strain;
        return OST_SUCCESS;
    case OST_FIELD_ENERGY:
        array->components = 1;
        array->values = result->strain_energy_density;
        return OST_SUCCESS;
    case OST_FIELD_AXES:
        array->components = 9;
        OST_TRY(make_axes(result, &derived->axes));
        array->values = derived->axes;
        return OST_SUCCESS;
    case OST_FIELD_REGION:
        array->components = 1;
        array->type = OST_VALUES_INT32;
        array->values = result->mesh->tet_region;
        return OST_SUCCESS;
    default:
        array->components = 1;
        array->type = OST_VALUES_INT32;
        OST_TRY(make_rank(result, &derived->rank));
        array->values = derived->rank;
        return OST_SUCCESS;
    }
}

/* Is there such a field? Some are only recovered on request, and not every body has material axes. */
static int has_field(const OstResult *result, OstOutputFieldBit field)
{
    switch (field) {
    case OST_FIELD_REACTION:
        return result->reaction != NULL;
    case OST_FIELD_STRESS:
        return result->stress != NULL;
    case OST_FIELD_NODE_STRESS:
        return result->node_stress != NULL;
    case OST_FIELD_STRAIN:
        return result->strain != NULL;
    case OST_FIELD_ENERGY:
        return result->strain_energy_density != NULL;
    case OST_FIELD_AXES:
        return result->field->region_axes != NULL || result->field->tet_axes != NULL;
    default:
        return 1;
    }
}

const char *ost_result_status(const OstResult *result)
{
    return result->verdict.count == 0 ? "accepted" : result->unfinished ? "unfinished" : "refused";
}

OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path)
{
    OstContext *ctx = result->ctx;
    OstOutputArray arrays[OST_FIELD_COUNT];
    Derived derived = {NULL, NULL};
    const OstVerdict *objections = &result->verdict;
    char *reasons[OST_MOST_OBJECTIONS];
    const OstOutputMark mark = {ost_result_status(result), result->unfinished, objections->count, reasons};
    int count = 0;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    OstStatus status = OST_SUCCESS;
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    for (int field = 0; field < OST_FIELD_COUNT && status == OST_SUCCESS; field++)
        if ((fields >> field & 1U) != 0 && has_field(result, (OstOutputFieldBit)field))
            status = describe_field(result, (OstOutputFieldBit)field, &derived, &arrays[count++]);
    status = ost_agree(ctx, status);
    OST_THEN(ost_vtkhdf_write(ctx, path, result->mesh, count, arrays, objections->count > 0 ? &mark : NULL));
    OST_FREE(derived.axes);
    OST_FREE(derived.rank);
    ost_ledger_leave(ctx);
    return status;
}
