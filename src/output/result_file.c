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
    const int has_strain = fields >> OST_FIELD_STRAIN & 1U && result->strain;
    double *axes = NULL, *strain = NULL; /* these three are computed for the file alone */
    int32_t *rank = NULL;
    char *reasons[OST_MOST_OBJECTIONS];
    const OstOutputMark mark = {ost_result_status(result), result->unfinished, objections->count, reasons};
    OstOutputArray arrays[OST_FIELD_COUNT];
    int count = 0;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    if (has_axes)
        status = OST_NEW(ctx, &axes, 9 * (size_t)mesh->owned_tets);
    if (has_strain)
        OST_THEN(OST_NEW(ctx, &strain, 6 * (size_t)mesh->owned_tets));
    if (has_rank)
        OST_THEN(OST_NEW(ctx, &rank, mesh->owned_tets));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        if (has_axes)
            ost_field_axes(field, t, axes + 9 * (size_t)t);
        for (size_t p = 0; has_strain && p < 6; p++) /* what reads six components takes them for those of a tensor */
            strain[6 * (size_t)t + p] = (p < 3 ? 1.0 : 0.5) * result->strain[6 * (size_t)t + p];
        if (has_rank)
            rank[t] = ost_rank(ctx);
    }
    /* Fields without values were not recovered, or the body does not have them. */
    const OstOutputArray all[OST_FIELD_COUNT] = {
        [OST_FIELD_DISPLACEMENT] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->displacement},
        [OST_FIELD_REACTION] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, result->reaction},
        [OST_FIELD_STRESS] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, result->stress},
        [OST_FIELD_NODE_STRESS] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 6, result->node_stress},
        [OST_FIELD_STRAIN] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, strain},
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
    OST_FREE(axes);
    OST_FREE(strain);
    OST_FREE(rank);
    ost_ledger_leave(ctx);
    return status;
}
