/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/scene.h"

#include "core/error.h"
#include "core/memory.h"
#include "orthostat/mesh_file.h"
#include "solve/gradient_axes.h"
#include "solve/scene_materials.h"

#include <string.h>

static OstStatus make_chunk(const OstCase *c, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    *materials = NULL;
    switch (c->mesh_kind) {
    case OST_MESH_TUBE:
        return ost_chunk_create_tube(c->ctx, &c->tube, chunk);
    case OST_MESH_BLOCK:
        return ost_chunk_create_block(c->ctx, &c->block, chunk);
    case OST_MESH_FILE:
        return ost_mesh_file_read(c->ctx, c->mesh_file, chunk, materials);
    }
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s: the case names no mesh", c->path);
}

static int wants(const OstSceneMaterials *materials, int region, OstAxesKind kind)
{
    return !materials->material[region].isotropic && materials->axes[region].kind == kind;
}

static int any_wants(const OstMesh *mesh, const OstSceneMaterials *materials, OstAxesKind kind)
{
    for (int r = 0; r < mesh->regions.count; r++)
        if (wants(materials, r, kind))
            return 1;
    return 0;
}

static OstStatus check_mesh_axes(const OstMesh *mesh, const OstSceneMaterials *materials)
{
    if (mesh->tet_axes || mesh->tet_count == 0)
        return OST_SUCCESS;
    for (int r = 0; r < mesh->regions.count; r++)
        if (wants(materials, r, OST_AXES_CELLS))
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "region '%s' takes its axes from the mesh, but the mesh file has no cell field 'axes' of "
                             "nine components; give a table instead (axes: {cells: file.txt})",
                             mesh->regions.name[r]);
    return OST_SUCCESS;
}

/* Axes from gradients, laid over those the mesh came with. */
static OstStatus solve_gradient_axes(const OstScene *scene, const OstSceneMaterials *materials, double **axes)
{
    const OstMesh *mesh = scene->mesh;
    ost_ledger_enter(scene->ctx, OST_EFFECT_GRADIENT_AXES);
    OstStatus status = ost_agree(scene->ctx, OST_NEW(scene->ctx, axes, 9 * (size_t)mesh->tet_count));
    if (status == OST_SUCCESS && mesh->tet_axes)
        memcpy(*axes, mesh->tet_axes, 9 * sizeof **axes * (size_t)mesh->tet_count);
    for (int r = 0; r < mesh->regions.count && status == OST_SUCCESS; r++)
        if (wants(materials, r, OST_AXES_GRADIENT))
            status = ost_scene_gradient_axes(scene, r, &materials->axes[r], *axes);
    ost_ledger_leave(scene->ctx);
    return status;
}

static int needs_centroids(const OstMesh *mesh, const OstSceneMaterials *materials)
{
    for (int r = 0; r < mesh->regions.count; r++)
        if (!materials->material[r].isotropic && ost_axes_vary(&materials->axes[r]))
            return 1;
    return 0;
}

static OstStatus make_field(OstScene *scene, const OstSceneMaterials *materials)
{
    OstContext *ctx = scene->ctx;
    const OstMesh *mesh = scene->mesh;
    double *centroids = NULL;
    double *gradient_axes = NULL;
    OstStatus status = ost_agree(ctx, check_mesh_axes(mesh, materials));
    if (status == OST_SUCCESS && any_wants(mesh, materials, OST_AXES_GRADIENT))
        status = solve_gradient_axes(scene, materials, &gradient_axes);
    if (status == OST_SUCCESS && needs_centroids(mesh, materials)) {
        ost_ledger_enter(ctx, OST_EFFECT_VARYING_AXES);
        status = OST_NEW(ctx, &centroids, (size_t)mesh->tet_count * 3);
        if (status == OST_SUCCESS)
            status = ost_mesh_tet_centroids(mesh, centroids);
        ost_ledger_leave(ctx);
    }
    if (status == OST_SUCCESS)
        status = ost_field_create(ctx, mesh->regions.count, materials->material, materials->axes, mesh->tet_count,
                                  mesh->tet_region, mesh->tet_label, centroids,
                                  gradient_axes ? gradient_axes : mesh->tet_axes, &scene->field);
    OST_FREE(centroids);
    OST_FREE(gradient_axes);
    return ost_agree(ctx, status);
}

OstStatus ost_scene_create(const OstCase *c, OstScene **scene)
{
    OstContext *ctx = c->ctx;
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *from_file = NULL;
    OstSceneMaterials materials = {0};
    OstScene *made = NULL;
    *scene = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    if (status != OST_SUCCESS)
        goto done;
    made->ctx = ctx;
    made->c = c;
    OST_TRY_DONE(make_chunk(c, &chunk, &from_file));
    OST_TRY_DONE(ost_scene_read_cell_axes(c, chunk));
    ost_plan_make(c, chunk->global_nodes, chunk->global_tets, from_file, ost_size(ctx), &made->plan);
    OST_TRY_DONE(ost_mesh_distribute(ctx, &chunk, &made->mesh));
    OST_TRY_DONE(ost_scene_materials(c, made->mesh, from_file, &materials));
    OST_TRY_DONE(make_field(made, &materials));
done:
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&from_file);
    ost_scene_materials_release(&materials);
    if (status != OST_SUCCESS)
        ost_scene_destroy(&made);
    *scene = made;
    return status;
}

void ost_scene_destroy(OstScene **scene)
{
    if (!*scene)
        return;
    ost_field_destroy(&(*scene)->field);
    ost_mesh_destroy(&(*scene)->mesh);
    OST_FREE(*scene);
}
