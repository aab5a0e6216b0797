/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "case/case_data.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static OstStatus check_regions_exist(const OstCase *c, const OstNames *regions)
{
    for (int i = 0; i < c->material_count; i++) {
        const OstCaseMaterial *stated = &c->materials[i];
        if (!ost_is_every_region(stated->region) && ost_names_find(regions, stated->region) < 0)
            return ost_raise_no_region(c, stated->region_place, regions, stated->region);
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_materials(const OstCase *c, const OstNames *regions, const OstFileMaterials *from_file,
                              OstSceneMaterials *materials)
{
    OstContext *ctx = c->ctx;
    OstStatus status = OST_NEW(ctx, &materials->material, regions->count);
    OST_THEN(OST_NEW(ctx, &materials->axes, regions->count));
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(check_regions_exist(c, regions));
    for (int r = 0; r < regions->count; r++) {
        const OstCaseMaterial *stated = ost_case_material_of(c, regions->name[r]);
        if (stated) {
            materials->material[r] = stated->material;
            materials->axes[r] = stated->axes;
        } else if (from_file && from_file->count == regions->count) {
            materials->material[r] = from_file->material[r];
            materials->axes[r].kind = OST_AXES_FIXED;
            memcpy(materials->axes[r].fixed, from_file->axes + 9 * (size_t)r, sizeof materials->axes[r].fixed);
        } else
            return OST_RAISE(
                ctx, OST_INVALID_INPUT,
                "%s: region '%s' of the mesh has no material; add one to materials (region: %s, or region: all)",
                c->path, regions->name[r], regions->name[r]);
    }
    return OST_SUCCESS;
}

void ost_scene_materials_release(OstSceneMaterials *materials)
{
    OST_FREE(materials->material, materials->axes);
}

/* The line of each tet, and how many lines there are: one for each solid of the mesh file, of which rank 0 has all if
 * they were split into tets. */
static OstGlobal number_lines(const OstMeshChunk *chunk, OstGlobal *line)
{
    OstGlobal lines = 0;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        const int is_next = t == 0 || !chunk->of_cells ||
                            ost_cell_label(1, chunk->tet_label[t]) != ost_cell_label(1, chunk->tet_label[t - 1]);
        lines += is_next;
        line[t] = chunk->of_cells ? lines : chunk->first_tet + t + 1;
    }
    return chunk->of_cells ? lines : chunk->global_tets;
}

static OstStatus read_cell_axes(const OstCase *c, const OstCaseMaterial *stated, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    const size_t tets = (size_t)chunk->tet_count;
    OstGlobal *line = NULL;
    double *table = NULL;
    int region = -1, counts = 0;
    OstStatus status = OST_NEW(ctx, &line, tets);
    OST_THEN(OST_NEW(ctx, &table, 9 * tets));
    if (status == OST_SUCCESS && !chunk->tet_axes)
        status = OST_NEW(ctx, &chunk->tet_axes, 9 * tets);
    OST_TRY_DONE(ost_agree(ctx, status));
    const OstGlobal lines = number_lines(chunk, line);
    OST_TRY_DONE(ost_table_read(ctx, stated->axes.cells_file, 9, lines, chunk->tet_count, line, table));
    for (size_t t = 0; t < tets; t++) {
        if (chunk->tet_region[t] != region) {
            region = chunk->tet_region[t];
            counts = ost_case_material_of(c, chunk->regions.name[region]) == stated;
        }
        if (counts)
            memcpy(chunk->tet_axes + 9 * t, table + 9 * t, 9 * sizeof *table);
    }
done:
    OST_FREE(line, table);
    return status;
}

OstStatus ost_scene_read_cell_axes(const OstCase *c, OstMeshChunk *chunk)
{
    for (int i = 0; i < c->material_count; i++)
        if (c->materials[i].axes.kind == OST_AXES_CELLS && c->materials[i].axes.cells_file)
            OST_TRY(ost_case_located(c, c->materials[i].axes_place, read_cell_axes(c, &c->materials[i], chunk)));
    return OST_SUCCESS;
}
