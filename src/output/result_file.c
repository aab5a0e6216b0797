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

OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    const OstMaterialField *field = result->field;
    const OstVerdict *objections = &result->verdict;
    const int has_axes = fields >> OST_FIELD_AXES & 1U && (field->region_axes || field->tet_axes);
    const int has_rank = fields >> OST_FIELD_RANK & 1U;
    const int has_load = fields >> OST_FIELD_LOAD & 1U && result->force;
    double *load = NULL; /* these three are made for the file alone */
    double *axes = NULL;
    int32_t *rank = NULL;
    char *reasons[OST_MOST_OBJECTIONS];
    const OstOutputMark mark = {ost_result_status(result), result->unfinished, objections->count, reasons};
    OstOutputArray arrays[OST_FIELD_COUNT];
    int count = 0;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    if (has_load)
        status = OST_NEW(ctx, &load, 3 * (size_t)mesh->node_count);
    if (has_axes)
        OST_THEN(OST_NEW(ctx, &axes, 9 * (size_t)mesh->owned_tets));
    if (has_rank)
        OST_THEN(OST_NEW(ctx, &rank, mesh->owned_tets));
    OST_TRY_DONE(ost_agree(ctx, status));
    if (has_load) {
        memcpy(load, result->force, 3 * (size_t)mesh->owned_nodes * sizeof *load);
        OST_TRY_DONE(ost_halo_import(mesh->halo, 3 * sizeof *load, load));
    }
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        if (has_axes)
            ost_field_axes(field, t, axes + 9 * (size_t)t);
        if (has_rank)
            rank[t] = ost_rank(ctx);
    }
    /* Fields without values were not recovered, or the body does not have them. */
    const OstOutputArray all[OST_FIELD_COUNT] = {
        [OST_FIELD_DISPLACEMENT] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->displacement},
        [OST_FIELD_REACTION] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->reaction},
        [OST_FIELD_LOAD] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, load},
        [OST_FIELD_STRESS] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, result->stress},
        [OST_FIELD_NODE_STRESS] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 6, result->node_stress},
        [OST_FIELD_STRAIN] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, result->strain},
        [OST_FIELD_ENERGY] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 1, result->strain_energy_density},
        [OST_FIELD_AXES] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 9, axes},
        [OST_FIELD_REGION] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region},
        [OST_FIELD_RANK] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, rank},
    };
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        if (fields >> f & 1U && all[f].values) {
            arrays[count] = all[f];
            arrays[count++].name = field_word[f];
        }
    status = ost_vtkhdf_write(ctx, path, mesh, count, arrays, objections->count > 0 ? &mark : NULL);
done:
    OST_FREE(load);
    OST_FREE(axes);
    OST_FREE(rank);
    ost_ledger_leave(ctx);
    return status;
}
