/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/mesh_data.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <stdio.h>

void ost_mesh_destroy(OstMesh **mesh)
{
    OstMesh *old = *mesh;
    if (!old)
        return;
    OST_FREE(old->node_number, old->node_label, old->tet_label, old->coordinates, old->tet_nodes, old->tet_region,
             old->tet_axes, old->tet_field);
    OST_FREE(old->at_surface);
    ost_surface_destroy(&old->surface);
    ost_names_clear(&old->regions);
    ost_boundaries_destroy(old->boundary_count, &old->boundaries);
    ost_halo_destroy(&old->halo);
    OST_FREE(*mesh);
}

void ost_tet_fields_inherit(const OstTetFields *fields, const double *parent, const double place[4][4], double *child)
{
    for (int f = 0; f < fields->count; f++) {
        const int width = (fields->first[f + 1] - fields->first[f]) / (fields->at_vertices[f] ? 4 : 1);
        const double *from = parent + fields->first[f];
        double *to = child + fields->first[f];
        for (int k = 0; k < width && !fields->at_vertices[f]; k++)
            to[k] = from[k];
        for (int k = 0; k < 4 * width && fields->at_vertices[f]; k++) {
            const double *share = place[k / width];
            const double *at = from + k % width;
            to[k] = share[0] * at[0] + share[1] * at[width] + share[2] * at[2 * width] + share[3] * at[3 * width];
        }
    }
}

int ost_mesh_owns(const OstMesh *mesh, int count, const OstGlobal *nodes)
{
    OstGlobal lowest = INT64_MAX;
    for (int i = 0; i < count; i++)
        if (mesh->node_number[nodes[i]] < lowest)
            lowest = mesh->node_number[nodes[i]];
    return lowest >= mesh->first_node && lowest < mesh->first_node + mesh->owned_nodes;
}

OstStatus ost_mesh_connect(OstMesh *mesh)
{
    OST_TRY(ost_halo_create(mesh->ctx, mesh->owned_nodes, mesh->first_node, mesh->node_count - mesh->owned_nodes,
                            mesh->node_number + mesh->owned_nodes, &mesh->halo));
    OST_TRY(ost_agree(mesh->ctx, ost_halo_import(mesh->halo, 3 * sizeof(double), mesh->coordinates)));
    return ost_agree(mesh->ctx, ost_halo_import(mesh->halo, sizeof(OstGlobal), mesh->node_label));
}

OstStatus ost_mesh_bounds(const OstMesh *mesh, double low[3], double high[3])
{
    double outer[6]; /* -low and high, so that one maximum over the ranks gives both */
    for (int d = 0; d < 6; d++)
        outer[d] = -INFINITY;
    for (size_t i = 0; i < (size_t)mesh->owned_nodes; i++) {
        for (size_t d = 0; d < 3; d++) {
            outer[d] = fmax(outer[d], -mesh->coordinates[3 * i + d]);
            outer[3 + d] = fmax(outer[3 + d], mesh->coordinates[3 * i + d]);
        }
    }
    OST_TRY(ost_max(mesh->ctx, 6, outer));
    for (int d = 0; d < 3; d++) {
        low[d] = -outer[d];
        high[d] = outer[3 + d];
    }
    return OST_SUCCESS;
}

int ost_mesh_nodes_per_tet(const OstMesh *mesh)
{
    return mesh->nodes_per_tet;
}

OstGlobal ost_mesh_global_nodes(const OstMesh *mesh)
{
    return mesh->global_nodes;
}

OstGlobal ost_mesh_global_tets(const OstMesh *mesh)
{
    return mesh->global_tets;
}

OstLocal ost_mesh_node_count(const OstMesh *mesh)
{
    return mesh->node_count;
}

OstLocal ost_mesh_owned_nodes(const OstMesh *mesh)
{
    return mesh->owned_nodes;
}

OstLocal ost_mesh_tet_count(const OstMesh *mesh)
{
    return mesh->tet_count;
}

OstLocal ost_mesh_owned_tets(const OstMesh *mesh)
{
    return mesh->owned_tets;
}

const double *ost_mesh_coordinates(const OstMesh *mesh)
{
    return mesh->coordinates;
}

const OstGlobal *ost_mesh_node_labels(const OstMesh *mesh)
{
    return mesh->node_label;
}

const OstLocal *ost_mesh_tet_nodes(const OstMesh *mesh)
{
    return mesh->tet_nodes;
}

const char *ost_cell_words(const OstMesh *mesh, OstGlobal tet_label, char words[OST_CELL_WORDS])
{
    words[0] = '\0';
    if (mesh->of_cells)
        snprintf(words, OST_CELL_WORDS, " (of element %lld of the file)", (long long)ost_cell_label(1, tet_label));
    else if (mesh->of_arrays)
        snprintf(words, OST_CELL_WORDS, " (index %lld)", (long long)tet_label - 1);
    return words;
}

const OstGlobal *ost_mesh_tet_labels(const OstMesh *mesh)
{
    return mesh->tet_label;
}

const int32_t *ost_mesh_tet_regions(const OstMesh *mesh)
{
    return mesh->tet_region;
}

const double *ost_mesh_tet_axes(const OstMesh *mesh)
{
    return mesh->tet_axes;
}

int ost_mesh_region_count(const OstMesh *mesh)
{
    return mesh->regions.count;
}

int ost_mesh_boundary_count(const OstMesh *mesh)
{
    return mesh->boundary_count;
}

const char *ost_mesh_region_name(const OstMesh *mesh, int region)
{
    return mesh->regions.name[region];
}

const char *ost_mesh_boundary_name(const OstMesh *mesh, int boundary)
{
    return mesh->boundaries[boundary].name;
}

OstLocal ost_mesh_boundary_items(const OstMesh *mesh, int boundary, int *nodes_per_item, const OstGlobal **nodes)
{
    const OstBoundary *found = &mesh->boundaries[boundary];
    *nodes_per_item = found->nodes_per_item;
    *nodes = found->nodes;
    return found->count;
}

OstLocal ost_mesh_local(const OstMesh *mesh, OstGlobal number)
{
    if (number >= mesh->first_node && number < mesh->first_node + mesh->owned_nodes)
        return (OstLocal)(number - mesh->first_node);
    const OstLocal ghost =
        ost_numbers_find(mesh->node_count - mesh->owned_nodes, mesh->node_number + mesh->owned_nodes, number);
    return ghost < 0 ? -1 : mesh->owned_nodes + ghost;
}

void ost_chunk_destroy(OstMeshChunk **chunk)
{
    OstMeshChunk *old = *chunk;
    if (!old)
        return;
    OST_FREE(old->coordinates, old->node_label, old->tet_nodes, old->tet_label, old->tet_region, old->tet_axes,
             old->tet_field, old->file);
    ost_names_clear(&old->regions);
    ost_boundaries_destroy(old->boundary_count, &old->boundaries);
    OST_FREE(*chunk);
}

OstStatus ost_chunk_label_nodes(OstMeshChunk *chunk)
{
    if (chunk->node_label)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->node_label, chunk->node_count));
    for (OstLocal i = 0; i < chunk->node_count; i++)
        chunk->node_label[i] = chunk->first_node + i + 1;
    return OST_SUCCESS;
}
