/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/file_materials.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>

static OstStatus broadcast(OstContext *ctx, void *data, size_t bytes)
{
    return OST_MPI(ctx, MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, ost_comm(ctx)));
}

static OstStatus create_materials(OstContext *ctx, int count, OstFileMaterials **materials)
{
    OST_TRY(OST_NEW(ctx, materials, 1));
    OST_TRY(OST_NEW(ctx, &(*materials)->material, count));
    OST_TRY(OST_NEW(ctx, &(*materials)->axes, 9 * (size_t)count));
    (*materials)->count = count;
    return OST_SUCCESS;
}

OstStatus ost_file_materials_share(OstContext *ctx, OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    int count = *materials ? (*materials)->count : 0;
    OST_TRY_DONE(broadcast(ctx, &count, sizeof count));
    if ((size_t)count > INT_MAX / sizeof(OstMaterial))
        status = OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%d materials in a mesh file, at most %zu can be sent", count,
                           INT_MAX / sizeof(OstMaterial));
    else if (!*materials)
        status = create_materials(ctx, count, materials);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(broadcast(ctx, (*materials)->material, (size_t)count * sizeof(OstMaterial)));
    OST_TRY_DONE(broadcast(ctx, (*materials)->axes, 9 * (size_t)count * sizeof(double)));
done:
    if (status != OST_SUCCESS)
        ost_file_materials_destroy(materials);
    return status;
}

void ost_file_materials_destroy(OstFileMaterials **materials)
{
    if (!*materials)
        return;
    OST_FREE((*materials)->material);
    OST_FREE((*materials)->axes);
    OST_FREE(*materials);
}
