/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "mesh/mesh_data.h"

#include <stdlib.h>

/* About as many faces are compared with each other; of larger meshes this is a sample. */
static const double enough_faces = 4e5;

static void swap_down(OstGlobal *a, OstGlobal *b)
{
    if (*a <= *b)
        return;
    const OstGlobal larger = *a;
    *a = *b;
    *b = larger;
}

/* The same for both tets of a face. */
static uint64_t face_hash(const OstGlobal *tet, int opposite)
{
    OstGlobal v[3];
    for (int i = 0; i < 3; i++)
        v[i] = tet[ost_tet_face[opposite][i]];
    swap_down(&v[0], &v[1]);
    swap_down(&v[1], &v[2]);
    swap_down(&v[0], &v[1]);
    return ost_hash(OST_HASH_START, sizeof v, v);
}

static int compare_hashes(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Items that occur once. */
static double count_single(uint64_t *hash, OstLocal count)
{
    double single = 0.0;
    qsort(hash, (size_t)count, sizeof *hash, compare_hashes);
    for (OstLocal i = 0; i < count; i++)
        single += (i == 0 || hash[i - 1] != hash[i]) && (i + 1 == count || hash[i + 1] != hash[i]);
    return single;
}

/* The faces of this rank's tets that are in the sample, and the rank that compares each. */
static OstStatus sample_faces(const OstMeshChunk *chunk, uint64_t every, uint64_t **hash, int **to, OstLocal *count)
{
    const uint64_t ranks = (uint64_t)ost_size(chunk->ctx);
    OstStatus status = OST_NEW(chunk->ctx, hash, 4 * (size_t)chunk->tet_count);
    OST_THEN(OST_NEW(chunk->ctx, to, 4 * (size_t)chunk->tet_count));
    OST_TRY(ost_agree(chunk->ctx, status));
    *count = 0;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        for (int f = 0; f < 4; f++) {
            const uint64_t h = face_hash(chunk->tet_nodes + (size_t)t * (size_t)chunk->nodes_per_tet, f);
            if (h % every != 0)
                continue;
            (*hash)[*count] = h;
            (*to)[(*count)++] = (int)(h / every % ranks);
        }
    return OST_SUCCESS;
}

OstStatus ost_chunk_surface_faces(const OstMeshChunk *chunk, double *faces)
{
    const uint64_t every = 1 + (uint64_t)(4.0 * (double)chunk->global_tets / enough_faces);
    uint64_t *hash = NULL;
    void *mine = NULL;
    int *to = NULL;
    OstLocal count = 0;
    OstRoute *route = NULL;
    *faces = 0.0;
    OstStatus status = sample_faces(chunk, every, &hash, &to, &count);
    OST_THEN(ost_route_create(chunk->ctx, count, 1, to, &route));
    OST_THEN(ost_route_carry(route, sizeof *hash, hash, &mine));
    if (status == OST_SUCCESS) {
        *faces = (double)every * count_single(mine, route->receives);
        status = ost_sum(chunk->ctx, 1, faces);
    }
    ost_route_destroy(&route);
    OST_FREE(mine, to, hash);
    return status;
}

OstStatus ost_mesh_surface_faces(const OstMesh *mesh, double *faces)
{
    const OstSurface *surface = NULL;
    *faces = 0.0;
    OST_TRY(ost_mesh_surface(mesh, &surface));
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *node = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        const OstGlobal corner[3] = {node[0], node[1], node[2]};
        *faces += ost_mesh_owns(mesh, 3, corner);
    }
    return ost_sum(mesh->ctx, 1, faces);
}
