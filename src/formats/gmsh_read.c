/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/gmsh_mesh.h"
#include "formats/serial.h"

#include <inttypes.h>
#include <stdio.h>

OstStatus ost_gmsh_elements(const OstGmshMesh *mesh, int type, int entity, size_t **tags, size_t *count, size_t **nodes)
{
    size_t node_count = 0;
    int error = 0;
    *tags = *nodes = NULL;
    mesh->gmsh.get_elements(type, tags, count, nodes, &node_count, entity, 0, 1, &error);
    return ost_gmsh_check(&mesh->gmsh, error, "give its elements");
}

OstStatus ost_gmsh_group_name(const OstGmshMesh *mesh, int dimension, int tag, char **name)
{
    static const char *const kind[] = {"point", "curve", "surface", "volume"};
    char made[32];
    char *given = NULL;
    int error = 0;
    *name = NULL;
    mesh->gmsh.get_group_name(dimension, tag, &given, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "name a physical group"));
    snprintf(made, sizeof made, "%s-%d", kind[dimension], tag);
    const OstStatus status = ost_copy_string(mesh->gmsh.ctx, given && *given ? given : made, name);
    mesh->gmsh.free(given);
    return status;
}

OstStatus ost_gmsh_type_name(const OstGmshMesh *mesh, int type, char *name, size_t size)
{
    char *given = NULL;
    double *local = NULL;
    size_t local_count = 0;
    int dimension = 0, order = 0, nodes = 0, primary = 0, error = 0;
    mesh->gmsh.get_element_properties(type, &given, &dimension, &order, &nodes, &local, &local_count, &primary, &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "name an element type"));
    snprintf(name, size, "%s", given);
    mesh->gmsh.free(given);
    mesh->gmsh.free(local);
    return OST_SUCCESS;
}

OstStatus ost_gmsh_find_nodes(const OstGmshMesh *mesh, size_t count, const size_t *tags, OstGlobal *positions)
{
    for (size_t i = 0; i < count; i++) {
        positions[i] = ost_label_index_find(&mesh->nodes, (OstGlobal)tags[i]);
        if (positions[i] < 0)
            return OST_RAISE(mesh->gmsh.ctx, OST_INVALID_INPUT, "%s: an element uses node %zu, which is not defined",
                             mesh->gmsh.path, tags[i]);
    }
    return OST_SUCCESS;
}

static OstStatus index_nodes(OstGmshMesh *mesh)
{
    OstContext *ctx = mesh->gmsh.ctx;
    const OstMeshChunk *chunk = mesh->chunk;
    OST_TRY(ost_label_index_create(ctx, chunk->node_count, chunk->node_label, &mesh->nodes));
    if (mesh->nodes.repeated)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: node tag %" PRId64 " is given to two nodes", mesh->gmsh.path,
                         mesh->nodes.repeated_label);
    if (chunk->global_nodes != mesh->contents.nodes)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: of its %" PRId64 " nodes Gmsh takes %" PRId64
                         "; the others belong to no element or repeat a tag: remove them",
                         mesh->gmsh.path, mesh->contents.nodes, chunk->global_nodes);
    return OST_SUCCESS;
}

static OstStatus copy_nodes(OstGmshMesh *mesh, size_t count, const size_t *tags, const double *coordinates)
{
    OstMeshChunk *chunk = mesh->chunk;
    OST_TRY(OST_NEW(mesh->gmsh.ctx, &chunk->node_label, count));
    OST_TRY(OST_NEW(mesh->gmsh.ctx, &chunk->coordinates, 3 * count));
    for (size_t i = 0; i < count; i++)
        chunk->node_label[i] = (OstGlobal)tags[i];
    for (size_t i = 0; i < 3 * count; i++)
        chunk->coordinates[i] = coordinates[i];
    chunk->global_nodes = (OstGlobal)count;
    chunk->node_count = (OstLocal)count;
    return index_nodes(mesh);
}

static OstStatus read_nodes(OstGmshMesh *mesh)
{
    size_t *tags = NULL;
    double *coordinates = NULL, *parametric = NULL;
    size_t count = 0, coordinate_count = 0, parametric_count = 0;
    int error = 0;
    mesh->gmsh.get_nodes(&tags, &count, &coordinates, &coordinate_count, &parametric, &parametric_count, -1, -1, 0, 0,
                         &error);
    OST_TRY(ost_gmsh_check(&mesh->gmsh, error, "give its nodes"));
    const OstStatus status = copy_nodes(mesh, count, tags, coordinates);
    mesh->gmsh.free(tags);
    mesh->gmsh.free(coordinates);
    mesh->gmsh.free(parametric);
    return status;
}

/* Physical tags of version 2.2 become entity tags; see OstGmshMesh. */
static OstStatus load_model(const OstGmshMesh *mesh)
{
    const OstGmsh *gmsh = &mesh->gmsh;
    int error = 0;
    gmsh->set_number("Mesh.SwitchElementTags", mesh->contents.version == 22, &error);
    OST_TRY(ost_gmsh_check(gmsh, error, "set how tags are read"));
    gmsh->add_model("orthostat", &error);
    OST_TRY(ost_gmsh_check(gmsh, error, "add a model"));
    gmsh->merge(gmsh->path, &error);
    return ost_gmsh_check(gmsh, error, "read it");
}

OstStatus ost_gmsh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstGmshMesh mesh = {0};
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    OST_TRY(ost_msh_check(ctx, path, &mesh.contents));
    OST_TRY(ost_gmsh_open(ctx, path, &mesh.gmsh));
    OST_TRY_DONE(OST_NEW(ctx, &mesh.chunk, 1));
    mesh.chunk->ctx = ctx;
    OST_TRY_DONE(load_model(&mesh));
    OST_TRY_DONE(read_nodes(&mesh));
    OST_TRY_DONE(ost_gmsh_read_tets(&mesh));
    OST_TRY_DONE(ost_gmsh_read_boundaries(&mesh));
done:
    ost_gmsh_close(&mesh.gmsh);
    ost_label_index_clear(&mesh.nodes);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(&mesh.chunk);
    *chunk = mesh.chunk;
    return status;
}
