/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/gmsh_mesh.h"

#include <limits.h>
#include <string.h>

static const char *const kind[] = {"points", "curves", "faces"};

/* The element type that bounds the body's tets, and its nodes. */
static int item_type(const OstMeshChunk *chunk, int dimension)
{
    static const int types[2][3] = {{OST_GMSH_POINT, OST_GMSH_LINE2, OST_GMSH_TRIANGLE3},
                                    {OST_GMSH_POINT, OST_GMSH_LINE3, OST_GMSH_TRIANGLE6}};
    return types[chunk->nodes_per_tet == 10][dimension];
}

static int nodes_per_item(const OstMeshChunk *chunk, int dimension)
{
    static const int nodes[2][3] = {{1, 2, 3}, {1, 3, 6}};
    return nodes[chunk->nodes_per_tet == 10][dimension];
}

/* The boundary with this name; groups of the same name and dimension are one. Takes the name over. */
static OstStatus find_boundary(const OstGmshMesh *mesh, int dimension, char **name, OstBoundary **boundary)
{
    OstMeshChunk *chunk = mesh->chunk;
    for (int b = 0; b < chunk->boundary_count; b++) {
        *boundary = &chunk->boundaries[b];
        if (strcmp((*boundary)->name, *name) != 0)
            continue;
        if ((*boundary)->dimension != dimension)
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                             "%s: physical name '%s' stands for %s and for %s; give each its own", mesh->gmsh.path,
                             *name, kind[(*boundary)->dimension], kind[dimension]);
        OST_FREE(*name);
        return OST_SUCCESS;
    }
    OST_TRY(OST_RESIZE(chunk->ctx, &chunk->boundaries, chunk->boundary_count + 1));
    *boundary = &chunk->boundaries[chunk->boundary_count++];
    (*boundary)->name = *name;
    (*boundary)->dimension = dimension;
    (*boundary)->nodes_per_item = nodes_per_item(chunk, dimension);
    *name = NULL;
    return OST_NEW(chunk->ctx, &(*boundary)->nodes, 0);
}

static OstStatus add_items(const OstGmshMesh *mesh, OstBoundary *boundary, size_t count, const size_t *nodes)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    const size_t first = (size_t)boundary->count;
    if (first + count > INT_MAX)
        return OST_RAISE(mesh->gmsh.ctx, OST_LIMIT_EXCEEDED, "%s: boundary '%s' has more than %d items",
                         mesh->gmsh.path, boundary->name, INT_MAX);
    OST_TRY(OST_RESIZE(mesh->gmsh.ctx, &boundary->nodes, (first + count) * width));
    OST_TRY(ost_gmsh_find_nodes(mesh, count * width, nodes, boundary->nodes + first * width));
    boundary->count += (OstLocal)count;
    return OST_SUCCESS;
}

static OstStatus refuse_type(const OstGmshMesh *mesh, const OstBoundary *boundary, int type)
{
    char name[64], expected[64];
    OST_TRY(ost_gmsh_type_name(mesh, type, name, sizeof name));
    OST_TRY(ost_gmsh_type_name(mesh, item_type(mesh->chunk, boundary->dimension), expected, sizeof expected));
    return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT,
                     "%s: boundary '%s' holds elements of Gmsh's type '%s', expected '%s' as on tets of %d nodes",
                     mesh->gmsh.path, boundary->name, name, expected, mesh->chunk->nodes_per_tet);
}

static OstStatus add_elements(const OstGmshMesh *mesh, int entity, OstBoundary *boundary, int type)
{
    size_t *tags = NULL, *nodes = NULL, count = 0;
    OST_TRY(ost_gmsh_elements(mesh, type, entity, &tags, &count, &nodes));
    OstStatus status = OST_SUCCESS;
    if (count > 0)
        status = type == item_type(mesh->chunk, boundary->dimension) ? add_items(mesh, boundary, count, nodes)
                                                                     : refuse_type(mesh, boundary, type);
    mesh->gmsh.free(tags);
    mesh->gmsh.free(nodes);
    return status;
}

static OstStatus add_entity(const OstGmshMesh *mesh, int entity, OstBoundary *boundary)
{
    int *types = NULL;
    size_t count = 0;
    int error = 0;
    mesh->gmsh.get_element_types(&types, &count, boundary->dimension, entity, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list the elements of a group"));
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++)
        status = add_elements(mesh, entity, boundary, types[i]);
    mesh->gmsh.free(types);
    return status;
}

/* In version 2.2 a group is the entity of its tag; see OstGmshMesh. */
static OstStatus add_entities(const OstGmshMesh *mesh, int group, OstBoundary *boundary)
{
    int *entities = NULL;
    size_t count = 0;
    int error = 0;
    if (mesh->contents.version == 22)
        return add_entity(mesh, group, boundary);
    mesh->gmsh.get_entities_of_group(boundary->dimension, group, &entities, &count, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list the entities of a group"));
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++)
        status = add_entity(mesh, entities[i], boundary);
    mesh->gmsh.free(entities);
    return status;
}

static OstStatus read_group(const OstGmshMesh *mesh, int dimension, int group)
{
    OstBoundary *boundary = NULL;
    char *name = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_gmsh_group_name(mesh, dimension, group, &name));
    OST_TRY_DONE(find_boundary(mesh, dimension, &name, &boundary));
    OST_TRY_DONE(add_entities(mesh, group, boundary));
done:
    OST_FREE(name);
    return status;
}

OstStatus ost_gmsh_read_boundaries(OstGmshMesh *mesh)
{
    OST_TRY(OST_NEW(mesh->gmsh.ctx, &mesh->chunk->boundaries, 0));
    for (int dimension = 2; dimension >= 0; dimension--) {
        int *groups = NULL; /* pairs of dimension and tag */
        size_t count = 0;
        int error = 0;
        if (mesh->contents.version == 22)
            mesh->gmsh.get_entities(&groups, &count, dimension, &error);
        else
            mesh->gmsh.get_groups(&groups, &count, dimension, &error);
        OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "list its physical groups"));
        OstStatus status = OST_SUCCESS;
        for (size_t i = 0; i + 1 < count && status == OST_SUCCESS; i += 2)
            if (groups[i + 1] > 0)
                status = read_group(mesh, dimension, groups[i + 1]);
        mesh->gmsh.free(groups);
        OST_TRY(status);
    }
    return OST_SUCCESS;
}
