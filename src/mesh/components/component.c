/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/components/component.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "mesh/components/component_faces.h"

#include <float.h>
#include <stdlib.h>

void ost_components_destroy(OstComponents **components)
{
    if (!*components)
        return;
    OST_FREE((*components)->of_tet, (*components)->component);
    OST_FREE(*components);
}

/* Two tets on one side of a face would add their stiffness in the same place. The pair in the message does not depend
 * on the number of ranks. */
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

static void widen(const double *x, OstComponent *component)
{
    for (int d = 0; d < 3; d++) {
        component->low[d] = x[d] < component->low[d] ? x[d] : component->low[d];
        component->high[d] = x[d] > component->high[d] ? x[d] : component->high[d];
    }
}

/* Number of tets, lowest label and box of each component, from the tets that this rank owns. */
static void measure(const OstMesh *mesh, OstComponents *components)
{
    for (OstLocal p = 0; p < components->count; p++)
        components->component[p] =
            (OstComponent){0, INT64_MAX, {DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        OstComponent *component = &components->component[components->of_tet[t]];
        component->tets++;
        if (ost_mesh_tet_number(mesh, t) < component->first_tet)
            component->first_tet = ost_mesh_tet_number(mesh, t);
        for (int v = 0; v < 4 && components->count > 1; v++)
            widen(mesh->coordinates + 3 * (size_t)ost_mesh_nodes_of(mesh, t)[v], component);
    }
    for (OstLocal n = 0; components->count == 1 && n < mesh->owned_nodes; n++)
        widen(mesh->coordinates + 3 * (size_t)n, &components->component[0]);
}

/* A box as six numbers, the upper corner negated, so that one MPI_MIN reduces both corners. */
enum { MINIMA = 6 };

static OstStatus reduce(OstContext *ctx, OstComponents *components)
{
    const size_t count = (size_t)components->count;
    OstGlobal *tets = NULL;
    double *box = NULL;
    OstStatus status = OST_NEW(ctx, &tets, 2 * count);
    OST_THEN(OST_NEW(ctx, &box, MINIMA * count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t p = 0; p < count; p++) {
        tets[p] = components->component[p].tets;
        tets[count + p] = components->component[p].first_tet;
        for (int d = 0; d < 3; d++) {
            box[MINIMA * p + (size_t)d] = components->component[p].low[d];
            box[MINIMA * p + 3 + (size_t)d] = -components->component[p].high[d];
        }
    }
    OST_TRY_DONE(ost_sum_numbers(ctx, (int)count, tets));
    OST_TRY_DONE(ost_min_numbers(ctx, (int)count, tets + count));
    OST_TRY_DONE(ost_min(ctx, MINIMA * (int)count, box));
    for (size_t p = 0; p < count; p++) {
        components->component[p].tets = tets[p];
        components->component[p].first_tet = tets[count + p];
        for (int d = 0; d < 3; d++) {
            components->component[p].low[d] = box[MINIMA * p + (size_t)d];
            components->component[p].high[d] = -box[MINIMA * p + 3 + (size_t)d];
        }
    }
done:
    OST_FREE(tets, box);
    return status;
}

typedef struct Rank {
    OstGlobal first_tet;
    OstLocal component;
} Rank;

static int compare_ranks(const void *a, const void *b)
{
    const Rank *x = a;
    const Rank *y = b;
    if (x->first_tet != y->first_tet)
        return x->first_tet < y->first_tet ? -1 : 1;
    return (x->component > y->component) - (x->component < y->component);
}

/* Numbers the components in the order of their lowest labels, on any number of ranks. */
static OstStatus order(const OstMesh *mesh, OstComponents *components)
{
    const size_t count = (size_t)components->count;
    Rank *rank = NULL;
    OstComponent *ordered = NULL;
    OstLocal *place = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &rank, count));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &ordered, count));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &place, count));
    for (size_t p = 0; p < count; p++)
        rank[p] = (Rank){components->component[p].first_tet, (OstLocal)p};
    qsort(rank, count, sizeof *rank, compare_ranks);
    for (size_t p = 0; p < count; p++) {
        ordered[p] = components->component[rank[p].component];
        place[rank[p].component] = (OstLocal)p;
    }
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        components->of_tet[t] = place[components->of_tet[t]];
    OST_FREE(components->component);
    components->component = ordered;
    ordered = NULL;
done:
    OST_FREE(rank, ordered, place);
    return status;
}

static OstStatus find_components(const OstMesh *mesh, OstComponents *components)
{
    OstContext *ctx = mesh->ctx;
    OstOverlap overlap = {0};
    OstStatus status = OST_NEW(ctx, &components->of_tet, mesh->tet_count);
    OST_THEN(ost_component_faces_join(mesh, components->of_tet, &components->count, &overlap));
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(check_overlap(ctx, &overlap));
    if (ost_size(ctx) > 1)
        OST_TRY(ost_component_ranks_merge(mesh, components->count, components->of_tet, &components->count));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &components->component, components->count)));
    measure(mesh, components);
    if (ost_size(ctx) > 1)
        OST_TRY(reduce(ctx, components));
    return components->count > 1 ? ost_agree(ctx, order(mesh, components)) : OST_SUCCESS;
}

OstStatus ost_components_create(const OstMesh *mesh, OstComponents **components)
{
    OstComponents *made = NULL;
    *components = NULL;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &made, 1));
    if (status == OST_SUCCESS) {
        made->ctx = mesh->ctx;
        status = find_components(mesh, made);
    }
    if (status != OST_SUCCESS)
        ost_components_destroy(&made);
    *components = made;
    return status;
}
