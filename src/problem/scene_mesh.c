/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_parts.h"

#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"
#include "material/field_data.h"
#include "mesh/distribution/share.h"
#include "orthostat/refine.h"

#include <math.h>

/* Refuses a mesh too large for the machines before it is made. Compares the least that a solve needs, so that nothing
 * is refused that would fit. */
static OstStatus check_memory(const OstCase *c, OstGlobal nodes, OstGlobal tets)
{
    OstPlan plan;
    double left = 0.0;
    ost_plan_make(c, &(OstPlanMesh){.nodes = nodes, .tets = tets, .quadratic = c->order == 2}, ost_size(c->ctx), &plan);
    OST_TRY(ost_memory_free(c->ctx, &left));
    const double wanted = plan.bytes_mesh + plan.bytes_matrix;
    if (wanted > left)
        return OST_RAISE(c->ctx, OST_LIMIT_EXCEEDED,
                         "%s: %lld tets and their stiffness take at least about %.1f GiB, and %.1f GiB are free; use "
                         "a coarser mesh, or more machines",
                         c->path, (long long)tets, wanted / 1073741824.0, left / 1073741824.0);
    return OST_SUCCESS;
}

static OstStatus make_chunk(const OstCase *c, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    OstGlobal nodes = 0, tets = 0;
    ost_plan_shape_size(c, &nodes, &tets);
    OST_TRY(ost_plan_check_size(c, nodes));
    OST_TRY(check_memory(c, nodes, tets));
    switch (c->mesh_kind) {
    case OST_MESH_TUBE:
        return ost_chunk_create_tube(c->ctx, &c->tube, chunk);
    case OST_MESH_BLOCK:
        return ost_chunk_create_block(c->ctx, &c->block, chunk);
    case OST_MESH_SECTOR:
        return ost_chunk_create_sector(c->ctx, &c->sector, chunk);
    case OST_MESH_OCTANT:
        return ost_chunk_create_octant(c->ctx, &c->octant, chunk);
    case OST_MESH_FILE:
        return ost_case_located(c, c->mesh_place, ost_mesh_file_read(c->ctx, c->mesh_file, chunk, materials));
    case OST_MESH_FROM_PROGRAM: /* refused by ost_plan_check_size */
        break;
    }
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s: the case names no mesh", c->path);
}

/* A merge that joins nothing is likely an error: warns. */
static OstStatus merge_vertices(const OstCase *c, OstMeshChunk *chunk)
{
    OstGlobal merged = 0;
    if (!(c->merge > 0.0))
        return OST_SUCCESS;
    ost_ledger_enter(c->ctx, OST_EFFECT_JOINED_VERTICES);
    const OstStatus status = ost_chunk_merge(chunk, c->merge, &merged);
    ost_ledger_leave(c->ctx);
    OST_TRY(status);
    if (merged == 0)
        ost_warn(c->ctx, "%s: merge: %g joined no vertices", c->path, c->merge);
    else
        ost_log(c->ctx, OST_LOG_NORMAL, "%s: merge: %g joined %lld vertices with others", c->path, c->merge,
                (long long)merged);
    return OST_SUCCESS;
}

/* Is the region orthotropic, with axes that are known before the mesh is partitioned? */
static int has_direction(const OstMeshChunk *chunk, const OstSceneMaterials *materials, int region)
{
    const OstAxesKind kind = materials->axes[region].kind;
    return !materials->material[region].isotropic &&
           (kind == OST_AXES_CELLS ? chunk->tet_axes != NULL : kind != OST_AXES_GRADIENT && kind != OST_AXES_FIELD);
}

/* What metrics and stiffness are found from. */
typedef struct Source {
    const OstCase *c;
    const OstSceneMaterials *materials;
} Source;

OstStatus ost_scene_locate_axes(const OstCase *c, OstStatus status)
{
    OstPlace place = {1, 1};
    int stated = 0;
    for (int m = 0; m < c->material_count; m++)
        if (c->materials[m].axes_place.line > 0 && stated++ == 0)
            place = c->materials[m].axes_place;
    return ost_case_located(c, stated == 1 ? place : (OstPlace){1, 1}, status);
}

/* By a field on the chunk, in which regions without known axes are isotropic. */
static OstStatus tet_metrics(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric)
{
    OstContext *ctx = chunk->ctx;
    const Source *source = data;
    const OstSceneMaterials *materials = source->materials;
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
    return ost_scene_locate_axes(source->c, status);
}

/* The smallest Young's modulus: a part moves as a rigid body where that is far above what is around. */
static double rigidity(const OstMaterial *material)
{
    const double *e = material->constants.youngs_modulus;
    return fmin(e[0], fmin(e[1], e[2]));
}

/* The smallest Young's modulus of each tet. Numbers of a field that make none are refused later, with their tet. */
static OstStatus tet_stiffness(const void *data, const OstMeshChunk *chunk, double *stiffness)
{
    const Source *source = data;
    const OstCaseMaterial *stated = NULL;
    for (OstLocal t = 0, region = -1; t < chunk->tet_count; t++) {
        if (chunk->tet_region[t] != region) {
            region = chunk->tet_region[t];
            stated = ost_case_material_of(source->c, chunk->regions.name[region]);
        }
        stiffness[t] = rigidity(&source->materials->material[region]);
        if (stated && stated->modulus.field)
            stiffness[t] *= ost_scene_chunk_modulus(source->c, chunk, &stated->modulus, t);
    }
    return OST_SUCCESS;
}

/* Collective. Distributes the mesh (ost_mesh_distribute) so that borders of ranks run along the stiff directions of
 * orthotropic materials rather than across them, and around stiff inclusions: aggregates and blocks of multigrid end at
 * a border, and a strong coupling lost there costs iterations. Axes that are not known yet (of gradients) count as
 * isotropic; a body of isotropic materials is partitioned without weights. */
static OstStatus partition(const OstCase *c, const OstSceneMaterials *materials, OstMeshChunk **chunk, OstMesh **mesh)
{
    int any[2] = {0, 0}; /* a direction; several stiffnesses */
    for (int r = 0; r < (*chunk)->regions.count; r++) {
        const OstCaseMaterial *stated = ost_case_material_of(c, (*chunk)->regions.name[r]);
        any[0] |= has_direction(*chunk, materials, r);
        any[1] |= rigidity(&materials->material[r]) != rigidity(&materials->material[0]);
        any[1] |= stated && stated->modulus.field;
    }
    OST_TRY(ost_max_ints((*chunk)->ctx, 2, any)); /* a rank without tets has no axes */
    const Source source = {c, materials};
    const OstTetMetric metric = {&source, any[0] ? tet_metrics : NULL, any[1] ? tet_stiffness : NULL};
    return ost_mesh_distribute_by((*chunk)->ctx, chunk, any[0] || any[1] ? &metric : NULL, mesh);
}

OstShapeSurface ost_scene_surface(const OstCase *c)
{
    const OstShapeSurface straight = {.kind = OST_SURFACE_NONE};
    switch (c->mesh_kind) {
    case OST_MESH_TUBE:
        return ost_shape_surface_tube(&c->tube);
    case OST_MESH_SECTOR:
        return ost_shape_surface_tube(&(OstTubeShape){
            .axis = c->sector.axis, .origin = {c->sector.origin[0], c->sector.origin[1], c->sector.origin[2]}});
    case OST_MESH_OCTANT:
        return ost_shape_surface_sphere(c->octant.centre);
    default:
        return straight;
    }
}

static void replace(OstMesh **mesh, OstMesh **made)
{
    (*made)->welded = (*mesh)->welded;
    ost_mesh_destroy(mesh);
    *mesh = *made;
    *made = NULL;
}

static OstStatus refine(const OstCase *c, const OstShapeSurface *surface, OstMesh **mesh)
{
    for (int r = 0; r < c->refinement; r++) {
        OstMesh *fine = NULL;
        OST_TRY(ost_mesh_refine(*mesh, surface, &fine));
        replace(mesh, &fine);
    }
    return OST_SUCCESS;
}

/* Order 0 keeps the order of the mesh. */
static OstStatus change_order(const OstCase *c, const OstShapeSurface *surface, OstMesh **mesh)
{
    OstMesh *changed = NULL;
    const int order = (*mesh)->nodes_per_tet == 10 ? 2 : 1;
    if (c->order == 0 || c->order == order)
        return OST_SUCCESS;
    if (c->order == 2)
        OST_TRY(ost_mesh_raise(*mesh, surface, &changed));
    else
        OST_TRY(ost_mesh_linear(*mesh, &changed, NULL));
    replace(mesh, &changed);
    return OST_SUCCESS;
}

/* A rank without a vertex has nothing to do, and many of them keep the others waiting. */
static OstStatus check_ranks(const OstCase *c, const OstMeshChunk *chunk)
{
    const int ranks = ost_size(c->ctx);
    if (ranks <= chunk->global_nodes)
        return OST_SUCCESS;
    return OST_RAISE(
        c->ctx, OST_INVALID_INPUT,
        "%s: %d ranks are more than the %lld vertices of the mesh; use %lld at most, and one for a mesh as "
        "small as this",
        c->path, ranks, (long long)chunk->global_nodes, (long long)chunk->global_nodes);
}

/* A file may bring axes that a case leaves; a program that gives them wants them used. */
static OstStatus warn_of_unused_axes(const OstCase *c, const OstMeshChunk *chunk)
{
    int unused = chunk->of_arrays && chunk->tet_axes; /* a rank without tets has none */
    for (int m = 0; m < c->material_count; m++)
        unused &= c->materials[m].axes.kind != OST_AXES_CELLS || c->materials[m].axes.cells_file;
    OST_TRY(ost_max_ints(c->ctx, 1, &unused));
    if (unused)
        ost_warn(
            c->ctx,
            "%s: the mesh has material axes, and no material uses them: a material with 'axes: {cells: mesh}' does",
            c->path);
    return OST_SUCCESS;
}

OstStatus ost_scene_distribute(const OstCase *c, const OstFileMaterials *from_file, OstMeshChunk **chunk,
                               OstMesh **mesh, OstSceneMaterials *materials)
{
    const OstShapeSurface surface = ost_scene_surface(c);
    *mesh = NULL;
    OstStatus status = check_ranks(c, *chunk);
    OST_THEN(warn_of_unused_axes(c, *chunk));
    OST_THEN(ost_scene_materials(c, &(*chunk)->regions, from_file, materials));
    (*chunk)->straighten = c->straighten;
    (*chunk)->only_vertices = c->order == 1 && c->refinement == 0;
    OST_THEN(partition(c, materials, chunk, mesh));
    OST_THEN(refine(c, &surface, mesh));
    OST_THEN(change_order(c, &surface, mesh));
    if (status != OST_SUCCESS)
        ost_mesh_destroy(mesh);
    return status;
}

OstStatus ost_scene_make_mesh(const OstCase *c, OstMesh **mesh, OstFileMaterials **from_file,
                              OstSceneMaterials *materials)
{
    OstMeshChunk *chunk = NULL;
    *mesh = NULL;
    *from_file = NULL;
    OstStatus status = make_chunk(c, &chunk, from_file);
    OST_THEN(ost_scene_read_cell_axes(c, chunk));
    OST_THEN(ost_scene_read_tet_fields(c, chunk));
    OST_THEN(merge_vertices(c, chunk));
    OST_THEN(ost_scene_distribute(c, *from_file, &chunk, mesh, materials));
    ost_chunk_destroy(&chunk);
    if (status != OST_SUCCESS)
        ost_file_materials_destroy(from_file);
    return status;
}
