/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_TWO_LAYERS_H
#define ORTHOSTAT_TESTS_TWO_LAYERS_H

#include "../case/case_text.h"
#include "core/memory.h"
#include "problem/scene_data.h"

#include "orthostat/orthostat.h"

/* Strips of two layers along x, each one hex high, of the regions 'block' and 'upper'. */

/* The upper half of a block, z > 1, becomes a region of its own. */
static inline void add_upper(OstMeshChunk *chunk)
{
    char **names = NULL;
    assert_success(OST_NEW(ctx, &names, 2));
    names[0] = chunk->regions.name[0];
    assert_success(ost_copy_string(ctx, "upper", &names[1]));
    OST_FREE(chunk->regions.name);
    chunk->regions = (OstNames){2, names};
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_region[t] = (int32_t)(chunk->first_tet + t) / 6 % 2; /* hexes are numbered along z first */
}

/* A displacement at (x, 0, 1), on the interface of the layers. */
static inline double displacement_at(const OstResult *result, double x, int component)
{
    const OstMesh *mesh = result->mesh;
    double found = 0.0;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *at = mesh->coordinates + 3 * node;
        if (fabs(at[0] - x) + fabs(at[1]) + fabs(at[2] - 1.0) < 1e-9)
            found += result->displacement[3 * node + component];
    }
    MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return found;
}

static inline OstResult *solve_layers(const char *text, OstCase **c, OstScene **scene)
{
    OstMeshChunk *chunk = NULL;
    OstResult *result = NULL;
    assert_success(read_text(text, c));
    assert_success(ost_chunk_create_block(ctx, &(*c)->block, &chunk));
    add_upper(chunk);
    assert_success(ost_scene_create_on(*c, &chunk, scene));
    assert_success(ost_scene_solve(*scene, &result));
    return result;
}

#endif
