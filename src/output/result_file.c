/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "problem/scene_data.h"

#include <string.h>

static const char *const field_word[OST_FIELD_COUNT] = {
#define OST_FIELD_WORD(name, word) word,
    OST_OUTPUT_FIELD_TABLE(OST_FIELD_WORD)
#undef OST_FIELD_WORD
};

const char *ost_result_status(const OstResult *result)
{
    return result->verdict.count == 0 ? "accepted" : result->unfinished ? "unfinished" : "refused";
}

/* Fields that are made for the file alone; NULL: not asked for, or the body does not have it. */
typedef struct Made {
    double *load;   /* 3 × node_count */
    double *axes;   /* 9 × owned_tets */
    double *strain; /* 6 × owned_tets */
    int32_t *rank;  /* owned_tets */
} Made;

static OstStatus make_room(const OstResult *result, unsigned fields, Made *made)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    if (fields >> OST_FIELD_LOAD & 1U && result->force)
        OST_TRY(OST_NEW(ctx, &made->load, 3 * (size_t)mesh->node_count));
    if (fields >> OST_FIELD_AXES & 1U && (result->field->region_axes || result->field->tet_axes))
        OST_TRY(OST_NEW(ctx, &made->axes, 9 * (size_t)mesh->owned_tets));
    if (fields >> OST_FIELD_STRAIN & 1U && result->strain)
        OST_TRY(OST_NEW(ctx, &made->strain, 6 * (size_t)mesh->owned_tets));
    if (fields >> OST_FIELD_RANK & 1U)
        OST_TRY(OST_NEW(ctx, &made->rank, mesh->owned_tets));
    return OST_SUCCESS;
}

static OstStatus make_fields(const OstResult *result, unsigned fields, Made *made)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    OST_TRY(ost_agree(ctx, make_room(result, fields, made)));
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        if (made->axes)
            ost_field_axes(result->field, t, made->axes + 9 * (size_t)t);
        for (size_t p = 0; made->strain && p < 6; p++) /* what reads six components takes them for those of a tensor */
            made->strain[6 * (size_t)t + p] = (p < 3 ? 1.0 : 0.5) * result->strain[6 * (size_t)t + p];
        if (made->rank)
            made->rank[t] = ost_rank(ctx);
    }
    if (!(fields >> OST_FIELD_LOAD & 1U) || !result->force)
        return OST_SUCCESS;
    if (mesh->owned_nodes > 0)
        memcpy(made->load, result->force, 3 * (size_t)mesh->owned_nodes * sizeof *made->load);
    return ost_halo_import(mesh->halo, 3 * sizeof *made->load, made->load);
}

OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    const OstVerdict *objections = &result->verdict;
    Made made = {NULL};
    char *reasons[OST_MOST_OBJECTIONS];
    const OstOutputMark mark = {ost_result_status(result), result->unfinished, objections->count, reasons};
    OstOutputArray arrays[OST_FIELD_COUNT];
    int count = 0;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    OST_TRY_DONE(make_fields(result, fields, &made));
    /* Fields without values were not recovered, or the body does not have them. */
    const OstOutputArray all[OST_FIELD_COUNT] = {
        [OST_FIELD_DISPLACEMENT] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->displacement},
        [OST_FIELD_REACTION] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->reaction},
        [OST_FIELD_LOAD] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, made.load},
        [OST_FIELD_STRESS] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, result->stress},
        [OST_FIELD_NODE_STRESS] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 6, result->node_stress},
        [OST_FIELD_STRAIN] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, made.strain},
        [OST_FIELD_ENERGY] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 1, result->strain_energy_density},
        [OST_FIELD_AXES] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 9, made.axes},
        [OST_FIELD_REGION] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region},
        [OST_FIELD_ERROR] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 1, result->tet_error},
        [OST_FIELD_RANK] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, made.rank},
    };
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        if (fields >> f & 1U && all[f].values) {
            arrays[count] = all[f];
            arrays[count++].name = field_word[f];
        }
    status = ost_vtkhdf_write(ctx, path, mesh, count, arrays, objections->count > 0 ? &mark : NULL);
done:
    OST_FREE(made.load);
    OST_FREE(made.axes);
    OST_FREE(made.strain);
    OST_FREE(made.rank);
    ost_ledger_leave(ctx);
    return status;
}
