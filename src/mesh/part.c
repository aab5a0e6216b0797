/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/part.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/reduce.h"
#include "mesh/part_faces.h"
#include "mesh/part_ranks.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

void ost_parts_destroy(OstParts **parts)
{
    if (!*parts)
        return;
    OST_FREE((*parts)->of_tet);
    OST_FREE((*parts)->part);
    OST_FREE(*parts);
}

/* Two tets on one side of a face would add up their stiffness where there is one body; which pair is named does not
 * depend on the ranks. */
static OstStatus check_overlap(OstContext *ctx, const OstOverlap *mine)
{
    OstGlobal low = mine->found ? mine->low : INT64_MAX;
    OST_TRY(ost_min_numbers(ctx, 1, &low));
    if (low == INT64_MAX)
        return OST_SUCCESS;
    OstGlobal high = mine->found && mine->low == low ? mine->high : INT64_MAX;
    OST_TRY(ost_min_numbers(ctx, 1, &high));
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "tets %lld and %lld lie on the same side of a face that they share; remove the doubled or "
                     "overlapping tet",
                     (long long)low, (long long)high);
}

static void widen(const double *x, OstPart *part)
{
    for (int d = 0; d < 3; d++) {
        part->low[d] = x[d] < part->low[d] ? x[d] : part->low[d];
        part->high[d] = x[d] > part->high[d] ? x[d] : part->high[d];
    }
}

static void widen_by_tet(const OstMesh *mesh, OstLocal tet, OstPart *part)
{
    const OstLocal *nodes = mesh->tet_nodes + (size_t)tet * (size_t)mesh->nodes_per_tet;
    for (int v = 0; v < 4; v++)
        widen(mesh->coordinates + 3 * (size_t)nodes[v], part);
}

/* Counts, labels and boxes of what this rank owns. */
static void measure(const OstMesh *mesh, OstParts *parts)
{
    for (OstLocal p = 0; p < parts->count; p++)
        parts->part[p] = (OstPart){0, INT64_MAX, {DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        OstPart *part = &parts->part[parts->of_tet[t]];
        part->tets++;
        part->first_tet = mesh->tet_label[t] < part->first_tet ? mesh->tet_label[t] : part->first_tet;
        if (parts->count > 1)
            widen_by_tet(mesh, t, part);
    }
    for (OstLocal n = 0; parts->count == 1 && n < mesh->owned_nodes; n++)
        widen(mesh->coordinates + 3 * (size_t)n, &parts->part[0]);
}

/* A box as numbers that are least over the ranks: the high side by its negative. */
enum { MINIMA = 6 };

static OstStatus reduce(OstContext *ctx, OstParts *parts)
{
    const size_t count = (size_t)parts->count;
    OstGlobal *tets = NULL;
    double *box = NULL;
    OstStatus status = OST_NEW(ctx, &tets, 2 * count);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &box, MINIMA * count);
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t p = 0; p < count; p++) {
        tets[p] = parts->part[p].tets;
        tets[count + p] = parts->part[p].first_tet;
        for (int d = 0; d < 3; d++) {
            box[MINIMA * p + (size_t)d] = parts->part[p].low[d];
            box[MINIMA * p + 3 + (size_t)d] = -parts->part[p].high[d];
        }
    }
    OST_TRY_DONE(ost_sum_numbers(ctx, (int)count, tets));
    OST_TRY_DONE(ost_min_numbers(ctx, (int)count, tets + count));
    OST_TRY_DONE(ost_min(ctx, MINIMA * (int)count, box));
    for (size_t p = 0; p < count; p++) {
        parts->part[p].tets = tets[p];
        parts->part[p].first_tet = tets[count + p];
        for (int d = 0; d < 3; d++) {
            parts->part[p].low[d] = box[MINIMA * p + (size_t)d];
            parts->part[p].high[d] = -box[MINIMA * p + 3 + (size_t)d];
        }
    }
done:
    OST_FREE(tets);
    OST_FREE(box);
    return status;
}

typedef struct Rank {
    OstGlobal first_tet;
    OstLocal part;
} Rank;

static int compare_ranks(const void *a, const void *b)
{
    const Rank *x = a;
    const Rank *y = b;
    if (x->first_tet != y->first_tet)
        return x->first_tet < y->first_tet ? -1 : 1;
    return (x->part > y->part) - (x->part < y->part);
}

/* Numbers the parts as a reader of the mesh file meets them, whatever the ranks. */
static OstStatus order(const OstMesh *mesh, OstParts *parts)
{
    const size_t count = (size_t)parts->count;
    Rank *rank = NULL;
    OstPart *ordered = NULL;
    OstLocal *place = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &rank, count));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &ordered, count));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &place, count));
    for (size_t p = 0; p < count; p++)
        rank[p] = (Rank){parts->part[p].first_tet, (OstLocal)p};
    qsort(rank, count, sizeof *rank, compare_ranks);
    for (size_t p = 0; p < count; p++) {
        ordered[p] = parts->part[rank[p].part];
        place[rank[p].part] = (OstLocal)p;
    }
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        parts->of_tet[t] = place[parts->of_tet[t]];
    OST_FREE(parts->part);
    parts->part = ordered;
    ordered = NULL;
done:
    OST_FREE(rank);
    OST_FREE(ordered);
    OST_FREE(place);
    return status;
}

static OstStatus find_parts(const OstMesh *mesh, OstParts *parts)
{
    OstContext *ctx = mesh->ctx;
    OstOverlap overlap = {0};
    OstStatus status = OST_NEW(ctx, &parts->of_tet, mesh->tet_count);
    if (status == OST_SUCCESS)
        status = ost_part_faces_join(mesh, parts->of_tet, &parts->count, &overlap);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(check_overlap(ctx, &overlap));
    if (ost_size(ctx) > 1)
        OST_TRY(ost_part_ranks_merge(mesh, parts->count, parts->of_tet, &parts->count));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &parts->part, parts->count)));
    measure(mesh, parts);
    if (ost_size(ctx) > 1)
        OST_TRY(reduce(ctx, parts));
    return parts->count > 1 ? ost_agree(ctx, order(mesh, parts)) : OST_SUCCESS;
}

OstStatus ost_parts_create(const OstMesh *mesh, OstParts **parts)
{
    OstParts *made = NULL;
    *parts = NULL;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &made, 1));
    if (status == OST_SUCCESS) {
        made->ctx = mesh->ctx;
        status = find_parts(mesh, made);
    }
    if (status != OST_SUCCESS)
        ost_parts_destroy(&made);
    *parts = made;
    return status;
}
