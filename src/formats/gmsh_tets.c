/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/gmsh_mesh.h"
#include "formats/tet_list.h"
#include "mesh/names.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

static int is_tet(int type)
{
    return type == OST_GMSH_TET4 || type == OST_GMSH_TET10;
}

static OstStatus refuse_type(const OstGmshMesh *mesh, int type, size_t count)
{
    char name[64];
    OST_TRY(ost_gmsh_type_name(mesh, type, name, sizeof name));
    return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT,
                     "%s: holds %zu elements of Gmsh's type '%s', expected tets of 4 or of 10 nodes only; split or "
                     "remesh the body with tets",
                     mesh->gmsh.path, count, name);
}

/* Number of elements of a type. */
static OstStatus count_type(const OstGmshMesh *mesh, int type, size_t *count)
{
    size_t *tags = NULL, *nodes = NULL;
    OST_TRY(ost_gmsh_elements(mesh, type, -1, &tags, count, &nodes));
    mesh->gmsh.free(tags);
    mesh->gmsh.free(nodes);
    return OST_SUCCESS;
}

/* Takes note of a type of solid elements that the mesh holds `count` of. */
static OstStatus choose_type(const OstGmshMesh *mesh, int candidate, size_t count, int *type, size_t *tets)
{
    if (count == 0)
        return OST_SUCCESS;
    if (!is_tet(candidate))
        return refuse_type(mesh, candidate, count);
    if (*tets > 0)
        return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT,
                         "%s: holds tets of 4 and of 10 nodes, expected one kind; mesh the whole body in one order",
                         mesh->gmsh.path);
    *type = candidate;
    *tets = count;
    return OST_SUCCESS;
}

/* Of elements with the same tag Gmsh may keep the last one only. */
static OstStatus check_elements(const OstGmshMesh *mesh, size_t taken)
{
    if ((OstGlobal)taken == mesh->contents.elements)
        return OST_SUCCESS;
    return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT,
                     "%s: of its %" PRId64 " elements Gmsh takes %zu; the others repeat a tag: give each its own",
                     mesh->gmsh.path, mesh->contents.elements, taken);
}

/* The one type of the body's tets, and their number. */
static OstStatus choose_types(const OstGmshMesh *mesh, size_t type_count, const int *types, int *type, size_t *tets)
{
    size_t count = 0, total = 0;
    *type = 0;
    *tets = 0;
    for (size_t i = 0; i < type_count; i++) {
        OST_TRY(count_type(mesh, types[i], &count));
        total += count;
        if (ost_msh_type_dimension(types[i]) == 3)
            OST_TRY(choose_type(mesh, types[i], count, type, tets));
    }
    OST_TRY(check_elements(mesh, total));
    if (*tets == 0)
        return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT, "%s: holds no tets; mesh its volume (gmsh -3)",
                         mesh->gmsh.path);
    return OST_SUCCESS;
}

static OstStatus find_type(const OstGmshMesh *mesh, int *type, size_t *tets)
{
    int *types = NULL;
    size_t type_count = 0;
    int error = 0;
    mesh->gmsh.get_element_types(&types, &type_count, -1, -1, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list its element types"));
    const OstStatus status = choose_types(mesh, type_count, types, type, tets);
    mesh->gmsh.free(types);
    return status;
}

/* The physical volume an entity belongs to, or 0. */
static OstStatus find_group(const OstGmshMesh *mesh, int entity, int *group)
{
    int *groups = NULL;
    size_t count = 0;
    int error = 0;
    *group = 0;
    if (mesh->contents.version == 22) {
        *group = entity;
        return OST_SUCCESS;
    }
    mesh->gmsh.get_groups_of_entity(3, entity, &groups, &count, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list the groups of a volume"));
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++) {
        const int other = abs(groups[i]);
        if (*group != 0 && *group != other)
            status = OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT,
                               "%s: volume %d belongs to the physical volumes %d and %d; a tet can be in one region "
                               "only",
                               mesh->gmsh.path, entity, *group, other);
        *group = other;
    }
    mesh->gmsh.free(groups);
    return status;
}

/* Number of the region of a physical volume, new or known; those without one get -1 for now. */
static OstStatus find_region(const OstGmshMesh *mesh, int group, int32_t *region)
{
    OstNames *regions = &mesh->chunk->regions;
    char *name = NULL;
    *region = -1;
    if (group == 0)
        return OST_SUCCESS;
    OstStatus status = ost_gmsh_group_name(mesh, 3, group, &name);
    if (status == OST_SUCCESS && ost_names_find(regions, name) < 0)
        status = ost_names_add(mesh->gmsh.ctx, regions, name);
    if (status == OST_SUCCESS)
        *region = ost_names_find(regions, name);
    OST_FREE(name);
    return status;
}

/* Gmsh orders the last two mid-edge nodes of a tet the other way round. */
static void swap_last_two(OstGlobal *nodes)
{
    const OstGlobal ninth = nodes[8];
    nodes[8] = nodes[9];
    nodes[9] = ninth;
}

static OstStatus add_tets(const OstGmshMesh *mesh, int32_t region, size_t count, const size_t *tags,
                          const size_t *nodes)
{
    OstMeshChunk *chunk = mesh->chunk;
    const size_t width = (size_t)chunk->nodes_per_tet;
    const size_t first = (size_t)chunk->tet_count;
    if (first + count > (size_t)chunk->global_tets)
        return OST_RAISE(mesh->gmsh.ctx, OST_LIBRARY_FAILED, "%s: Gmsh gives more tets by volume than in all",
                         mesh->gmsh.path);
    OST_TRY(ost_gmsh_find_nodes(mesh, count * width, nodes, chunk->tet_nodes + first * width));
    for (size_t t = first; t < first + count; t++) {
        chunk->tet_label[t] = (OstGlobal)tags[t - first];
        chunk->tet_region[t] = region;
        if (width == 10)
            swap_last_two(chunk->tet_nodes + t * width);
    }
    chunk->tet_count += (OstLocal)count;
    return OST_SUCCESS;
}

static OstStatus read_volume(const OstGmshMesh *mesh, int type, int entity)
{
    size_t *tags = NULL, *nodes = NULL, count = 0;
    int group = 0;
    int32_t region = 0;
    OST_TRY(ost_gmsh_elements(mesh, type, entity, &tags, &count, &nodes));
    OstStatus status = OST_SUCCESS;
    if (count == 0)
        goto done;
    OST_TRY_DONE(find_group(mesh, entity, &group));
    OST_TRY_DONE(find_region(mesh, group, &region));
    OST_TRY_DONE(add_tets(mesh, region, count, tags, nodes));
done:
    mesh->gmsh.free(tags);
    mesh->gmsh.free(nodes);
    return status;
}

static OstStatus read_volumes(const OstGmshMesh *mesh, int type)
{
    int *entities = NULL;
    size_t count = 0;
    int error = 0;
    mesh->gmsh.get_entities(&entities, &count, 3, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list its volumes"));
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i + 1 < count && status == OST_SUCCESS; i += 2)
        status = read_volume(mesh, type, entities[i + 1]);
    mesh->gmsh.free(entities);
    return status;
}

/* Tets in no physical volume make a region of their own. */
static OstStatus name_the_rest(OstMeshChunk *chunk)
{
    const int32_t rest = chunk->regions.count;
    int used = 0;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        if (chunk->tet_region[t] < 0) {
            chunk->tet_region[t] = rest;
            used = 1;
        }
    return used ? ost_names_add_unique(chunk->ctx, &chunk->regions, rest > 0 ? "unnamed" : "volume") : OST_SUCCESS;
}

static OstStatus allocate_tets(const OstGmshMesh *mesh, int type, size_t count)
{
    OstMeshChunk *chunk = mesh->chunk;
    if (count > INT_MAX)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED, "%s: %zu tets, at most %d can be read from a .msh file",
                         mesh->gmsh.path, count, INT_MAX);
    chunk->nodes_per_tet = type == OST_GMSH_TET4 ? 4 : 10;
    chunk->global_tets = (OstGlobal)count;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, count * (size_t)chunk->nodes_per_tet));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_label, count));
    return OST_NEW(chunk->ctx, &chunk->tet_region, count);
}

OstStatus ost_gmsh_read_tets(OstGmshMesh *mesh)
{
    int type = 0;
    size_t count = 0;
    OST_TRY(find_type(mesh, &type, &count));
    OST_TRY(allocate_tets(mesh, type, count));
    OST_TRY(read_volumes(mesh, type));
    if (mesh->chunk->tet_count != mesh->chunk->global_tets)
        return OST_RAISE(mesh->gmsh.ctx, OST_LIBRARY_FAILED, "%s: Gmsh gives fewer tets by volume than in all",
                         mesh->gmsh.path);
    OST_TRY(name_the_rest(mesh->chunk));
    OST_TRY(ost_tets_sort(mesh->chunk, mesh->gmsh.path));
    if (mesh->contents.tets_out_of_order)
        ost_warn(mesh->gmsh.ctx,
                 "%s: its tets are not in the order of their tags; they are counted in that order, "
                 "also in a file of axes",
                 mesh->gmsh.path);
    return ost_tets_refuse_same(mesh->chunk, mesh->gmsh.path);
}
