/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/disk_space.h"
#include "formats/vtkhdf.h"
#include "orthostat/scene.h"

#include <stdio.h>

static const char *const field_word[OST_FIELD_COUNT] = {
#define OST_FIELD_WORD(name, word) word,
    OST_OUTPUT_FIELD_TABLE(OST_FIELD_WORD)
#undef OST_FIELD_WORD
};

/* Arrays that exist only in the file: made here, freed after the write. */
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

/* A body without material axes has none to write. */
static int has_field(const OstResult *result, const OstCase *c, OstOutputFieldBit field)
{
    if ((c->output_fields >> field & 1U) == 0)
        return 0;
    return field != OST_FIELD_AXES || result->field->region_axes != NULL || result->field->tet_axes != NULL;
}

const char *ost_result_status(const OstResult *result)
{
    return result->objections.count == 0 ? "accepted" : result->unfinished ? "unfinished" : "refused";
}

/* At most, beside what HDF5 needs for itself: ghosts are counted with the nodes, as some of them are written twice. */
static double file_bytes(const OstMesh *mesh, int count, const OstOutputArray *arrays)
{
    double node = 24.0 + 8.0;                                       /* place and label */
    double tet = 8.0 * mesh->nodes_per_tet + 8.0 + 1.0 + 8.0 + 4.0; /* nodes, offset, type, label, region */
    if (mesh->tet_axes)
        tet += 9.0 * 8.0;
    double names = 0.0;
    for (int a = 0; a < count; a++) {
        const double row = (arrays[a].type == OST_VALUES_DOUBLE ? 8.0 : 4.0) * arrays[a].components;
        *(arrays[a].centring == OST_ON_NODES ? &node : &tet) += row;
    }
    for (int b = 0; b < mesh->boundary_count; b++)
        names += 8.0 * mesh->boundaries[b].nodes_per_item * (double)mesh->boundaries[b].count;
    return node * (double)mesh->node_count + tet * (double)mesh->owned_tets + names;
}

/* A full disk is found before a file is begun; see ost_disk_space_check. */
static OstStatus check_disk_space(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays)
{
    static const double for_hdf5 = 1 << 18; /* measured: 30 kB */
    char partial[OST_VTKHDF_LONGEST_PATH + sizeof ".partial"];
    double bytes = file_bytes(mesh, count, arrays);
    const int letters = snprintf(partial, sizeof partial, "%s.partial", path);
    if (letters < 0 || (size_t)letters >= sizeof partial)
        return OST_SUCCESS; /* the writer refuses so long a path */
    OST_TRY(OST_MPI(mesh->ctx, MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, ost_comm(mesh->ctx))));
    return ost_disk_space_check(mesh->ctx, partial, (OstGlobal)(bytes + for_hdf5));
}

OstStatus ost_result_write(const OstResult *result, const OstCase *c, const char *path)
{
    OstContext *ctx = result->ctx;
    OstOutputArray arrays[OST_FIELD_COUNT];
    Derived derived = {NULL, NULL};
    const OstObjections *objections = &result->objections;
    char *reasons[OST_MOST_OBJECTIONS];
    const OstOutputMark mark = {ost_result_status(result), objections->count, reasons};
    int count = 0;
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    OstStatus status = OST_SUCCESS;
    for (int i = 0; i < objections->count; i++)
        reasons[i] = (char *)objections->text[i];
    for (int field = 0; field < OST_FIELD_COUNT && status == OST_SUCCESS; field++)
        if (has_field(result, c, (OstOutputFieldBit)field))
            status = describe_field(result, (OstOutputFieldBit)field, &derived, &arrays[count++]);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        status = check_disk_space(result->mesh, path, count, arrays);
    if (status == OST_SUCCESS)
        status = ost_vtkhdf_write(ctx, path, result->mesh, count, arrays, objections->count > 0 ? &mark : NULL);
    OST_FREE(derived.axes);
    OST_FREE(derived.rank);
    ost_ledger_leave(ctx);
    return status;
}
