/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_partition.h"

#include "core/error.h"
#include "core/memory.h"
#include "material/field_data.h"

/* Are these axes known before the mesh is partitioned? */
static int known_early(const OstMeshChunk *chunk, const OstAxesSpec *axes)
{
    return axes->kind == OST_AXES_CELLS ? chunk->tet_axes != NULL : axes->kind != OST_AXES_GRADIENT;
}

static int has_direction(const OstMeshChunk *chunk, const OstSceneMaterials *materials, int region)
{
    return !materials->material[region].isotropic && known_early(chunk, &materials->axes[region]);
}

static int any_has_direction(const OstMeshChunk *chunk, const OstSceneMaterials *materials)
{
    for (int r = 0; r < chunk->regions.count; r++)
        if (has_direction(chunk, materials, r))
            return 1;
    return 0;
}

/* By a field on the chunk, in which regions without known axes are isotropic. */
static OstStatus tet_metrics(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric)
{
    OstContext *ctx = chunk->ctx;
    const OstSceneMaterials *materials = data;
    const int regions = chunk->regions.count;
    OstMaterialField *field = NULL;
    OstMaterial *material = NULL;
    OST_TRY(OST_NEW(ctx, &material, regions));
    for (int r = 0; r < regions; r++) {
        material[r] = materials->material[r];
        if (!has_direction(chunk, materials, r))
            material[r] = (OstMaterial){.isotropic = 1, .constants.youngs_modulus = {1.0, 1.0, 1.0}};
    }
    const OstStatus status = ost_field_create(ctx, NULL, regions, material, materials->axes, chunk->tet_count,
                                              chunk->tet_region, chunk->tet_label, centroids, chunk->tet_axes, &field);
    for (OstLocal t = 0; t < chunk->tet_count && status == OST_SUCCESS; t++)
        ost_field_metric(field, t, metric + 6 * (size_t)t);
    ost_field_destroy(&field);
    OST_FREE(material);
    return status;
}

OstStatus ost_scene_partition(const OstSceneMaterials *materials, OstMeshChunk **chunk, OstMesh **mesh)
{
    const OstTetMetric metric = {materials, tet_metrics};
    return ost_mesh_distribute_by((*chunk)->ctx, chunk, any_has_direction(*chunk, materials) ? &metric : NULL, mesh);
}
