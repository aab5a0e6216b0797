/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_materials.h"

#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static void take_from_file(const OstFileMaterials *from_file, OstSceneMaterials *materials)
{
    for (int r = 0; r < from_file->count; r++) {
        materials->material[r] = from_file->material[r];
        materials->axes[r].kind = OST_AXES_FIXED;
        memcpy(materials->axes[r].fixed, from_file->axes + 9 * (size_t)r, sizeof materials->axes[r].fixed);
    }
}

static OstStatus take_from_case(const OstCase *c, const OstNames *regions, const OstCaseMaterial *stated,
                                OstSceneMaterials *materials, unsigned char *known)
{
    OstMaterial material;
    OST_TRY(ost_material_create(c->ctx, stated->region, &stated->constants, stated->density, &material));
    const int all = strcmp(stated->region, "all") == 0;
    const int only = all ? -1 : ost_names_find(regions, stated->region);
    if (!all && only < 0)
        return ost_raise_no_region(c, stated->region_place, regions, stated->region);
    for (int r = 0; r < regions->count; r++) {
        if (!all && r != only)
            continue;
        materials->material[r] = material;
        materials->axes[r] = stated->axes;
        known[r] = 1;
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_materials(const OstCase *c, const OstNames *names, const OstFileMaterials *from_file,
                              OstSceneMaterials *materials)
{
    OstContext *ctx = c->ctx;
    const int regions = names->count;
    unsigned char *known = NULL;
    OstStatus status = OST_NEW(ctx, &known, regions);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &materials->material, regions);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &materials->axes, regions);
    OST_TRY_DONE(ost_agree(ctx, status));
    if (from_file && from_file->count == regions) {
        take_from_file(from_file, materials);
        memset(known, 1, (size_t)regions);
    }
    for (int i = 0; i < c->material_count; i++)
        OST_TRY_DONE(take_from_case(c, names, &c->materials[i], materials, known));
    for (int r = 0; r < regions; r++) {
        if (known[r])
            continue;
        status =
            OST_RAISE(ctx, OST_INVALID_INPUT,
                      "%s: region '%s' of the mesh has no material; add one to materials (region: %s, or region: all)",
                      c->path, names->name[r], names->name[r]);
        goto done;
    }
done:
    OST_FREE(known);
    return status;
}

void ost_scene_materials_release(OstSceneMaterials *materials)
{
    OST_FREE(materials->material);
    OST_FREE(materials->axes);
}

static int concerns(const OstCaseMaterial *stated, const OstMeshChunk *chunk, int region)
{
    return strcmp(stated->region, "all") == 0 || strcmp(stated->region, chunk->regions.name[region]) == 0;
}

static OstStatus read_cell_axes(const OstCaseMaterial *stated, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    const size_t tets = (size_t)chunk->tet_count;
    OstGlobal *line = NULL;
    double *table = NULL;
    OstStatus status = OST_NEW(ctx, &line, tets);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &table, 9 * tets);
    if (status == OST_SUCCESS && !chunk->tet_axes)
        status = OST_NEW(ctx, &chunk->tet_axes, 9 * tets);
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t t = 0; t < tets; t++)
        line[t] = chunk->first_tet + (OstGlobal)t + 1;
    OST_TRY_DONE(ost_table_read(ctx, stated->axes.cells_file, 9, chunk->global_tets, chunk->tet_count, line, table));
    for (size_t t = 0; t < tets; t++)
        if (concerns(stated, chunk, chunk->tet_region[t]))
            memcpy(chunk->tet_axes + 9 * t, table + 9 * t, 9 * sizeof *table);
done:
    OST_FREE(line);
    OST_FREE(table);
    return status;
}

OstStatus ost_scene_read_cell_axes(const OstCase *c, OstMeshChunk *chunk)
{
    for (int i = 0; i < c->material_count; i++)
        if (c->materials[i].axes.kind == OST_AXES_CELLS && c->materials[i].axes.cells_file)
            OST_TRY(ost_case_located(c, c->materials[i].axes_place, read_cell_axes(&c->materials[i], chunk)));
    return OST_SUCCESS;
}
