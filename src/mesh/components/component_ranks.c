/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"
#include "mesh/components/component_faces.h"
#include "mesh/union_find.h"

#include <stdlib.h>

/* A tet that is owned on one rank and a ghost on others: its vertices' global numbers, ascending, and a rank's set of
 * it.
 */
typedef struct SharedTet {
    OstGlobal vertex[4];
    OstLocal set;
} SharedTet;

typedef struct Link {
    OstLocal a, b;
} Link;

typedef struct Links {
    Link *link;
    OstLocal count;
} Links;

static int compare_tets(const void *a, const void *b)
{
    const OstGlobal *x = ((const SharedTet *)a)->vertex;
    const OstGlobal *y = ((const SharedTet *)b)->vertex;
    for (int i = 0; i < 4; i++)
        if (x[i] != y[i])
            return x[i] < y[i] ? -1 : 1;
    return 0;
}

static int compare_links(const void *a, const void *b)
{
    const Link *x = a;
    const Link *y = b;
    if (x->a != y->a)
        return x->a < y->a ? -1 : 1;
    return (x->b > y->b) - (x->b < y->b);
}

static SharedTet describe(const OstMesh *mesh, OstLocal tet, OstLocal set)
{
    SharedTet shared = {.set = set};
    for (int v = 0; v < 4; v++) {
        const OstGlobal number = mesh->node_number[ost_mesh_nodes_of(mesh, tet)[v]];
        int i = v;
        for (; i > 0 && shared.vertex[i - 1] > number; i--)
            shared.vertex[i] = shared.vertex[i - 1];
        shared.vertex[i] = number;
    }
    return shared;
}

static int owner_of_ghost(const OstMesh *mesh, OstLocal node)
{
    const OstHalo *halo = mesh->halo;
    int k = 0;
    while (halo->receive_start[k + 1] <= node - mesh->owned_nodes)
        k++;
    return halo->neighbour[k];
}

/* The owner of a tet is that of its node with the lowest global number. */
static int owner_of_tet(const OstMesh *mesh, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    OstLocal lowest = nodes[0];
    for (int v = 1; v < mesh->nodes_per_tet; v++)
        if (mesh->node_number[nodes[v]] < mesh->node_number[lowest])
            lowest = nodes[v];
    return owner_of_ghost(mesh, lowest);
}

/* Tells the owners of the ghost tets which sets these are in here. */
static OstStatus send_ghosts(const OstMesh *mesh, const OstLocal *set, SharedTet **arrived, OstLocal *count)
{
    OstContext *ctx = mesh->ctx;
    const OstLocal ghosts = mesh->tet_count - mesh->owned_tets;
    int *to = NULL;
    SharedTet *ghost = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_NEW(ctx, &to, ghosts);
    OST_THEN(OST_NEW(ctx, &ghost, ghosts));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal i = 0; i < ghosts; i++) {
        const OstLocal tet = mesh->owned_tets + i;
        to[i] = owner_of_tet(mesh, tet);
        ghost[i] = describe(mesh, tet, set[tet]);
    }
    OST_TRY_DONE(ost_route_create(ctx, ghosts, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *ghost, ghost, (void **)arrived));
    *count = route->receives;
done:
    OST_FREE(to, ghost);
    ost_route_destroy(&route);
    return status;
}

static int is_shared(const OstMesh *mesh, OstLocal tet)
{
    for (int v = 0; v < mesh->nodes_per_tet; v++)
        if (ost_mesh_nodes_of(mesh, tet)[v] >= mesh->owned_nodes)
            return 1;
    return 0;
}

/* The owned tets that are ghosts on other ranks, sorted. */
static OstStatus list_shared(const OstMesh *mesh, const OstLocal *set, SharedTet **shared, OstLocal *count)
{
    *count = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        *count += is_shared(mesh, t);
    OST_TRY(OST_NEW(mesh->ctx, shared, *count));
    OstLocal next = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        if (is_shared(mesh, t))
            (*shared)[next++] = describe(mesh, t, set[t]);
    qsort(*shared, (size_t)*count, sizeof **shared, compare_tets);
    return OST_SUCCESS;
}

static void remove_repetitions(Links *links)
{
    OstLocal kept = 0;
    qsort(links->link, (size_t)links->count, sizeof *links->link, compare_links);
    for (OstLocal i = 0; i < links->count; i++)
        if (i == 0 || compare_links(&links->link[i], &links->link[kept - 1]) != 0)
            links->link[kept++] = links->link[i];
    links->count = kept;
}

/* Links this rank's sets with the other ranks' sets of the same tets, each pair once. */
static OstStatus match_ghosts(const OstMesh *mesh, const OstLocal *set, const SharedTet *arrived, OstLocal count,
                              Links *links)
{
    SharedTet *shared = NULL;
    OstLocal shared_count = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(list_shared(mesh, set, &shared, &shared_count));
    OST_TRY_DONE(OST_NEW(mesh->ctx, &links->link, count));
    for (OstLocal i = 0; i < count; i++) {
        const SharedTet *mine = bsearch(&arrived[i], shared, (size_t)shared_count, sizeof *shared, compare_tets);
        if (!mine) {
            status =
                OST_RAISE(mesh->ctx, OST_LIBRARY_FAILED, "a tet at vertex %lld is missing on the rank that owns it",
                          (long long)arrived[i].vertex[0]);
            goto done;
        }
        links->link[links->count++] = (Link){mine->set, arrived[i].set};
    }
    remove_repetitions(links);
done:
    OST_FREE(shared);
    return status;
}

/* Every rank joins the sets of all ranks. There are few links: one for each pair of sets that meet. */
static OstStatus join_everywhere(OstContext *ctx, const Links *mine, OstLocal *parent)
{
    Link *all = NULL;
    OstLocal total = 0;
    OST_TRY(ost_gather_items(ctx, sizeof *all, mine->link, mine->count,
                             "the mesh has too many connected components to count", (void **)&all, &total));
    for (OstLocal i = 0; i < total; i++)
        ost_set_join(parent, all[i].a, all[i].b);
    OST_FREE(all);
    return OST_SUCCESS;
}

/* Numbers the sets contiguously over ranks. */
static OstStatus number_sets(const OstMesh *mesh, OstLocal set_count, OstLocal *set, OstLocal *total)
{
    OstContext *ctx = mesh->ctx;
    OstGlobal before = 0;
    OstGlobal sum = 0;
    OST_TRY(ost_number_from(ctx, set_count, &before, &sum));
    if (sum > INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "the mesh has %lld connected components, more than the %d that can be numbered",
                         (long long)sum, INT32_MAX);
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        set[t] += (OstLocal)before;
    *total = (OstLocal)sum;
    return OST_SUCCESS;
}

OstStatus ost_component_ranks_merge(const OstMesh *mesh, OstLocal set_count, OstLocal *set, OstLocal *count)
{
    OstContext *ctx = mesh->ctx;
    SharedTet *arrived = NULL;
    OstLocal arrivals = 0;
    OstLocal *merged = NULL;
    Links links = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(number_sets(mesh, set_count, set, count));
    OST_TRY_DONE(send_ghosts(mesh, set, &arrived, &arrivals));
    status = match_ghosts(mesh, set, arrived, arrivals, &links);
    OST_THEN(OST_NEW(ctx, &merged, *count));
    OST_TRY_DONE(ost_agree(ctx, status));
    ost_set_start(merged, *count);
    OST_TRY_DONE(join_everywhere(ctx, &links, merged));
    *count = ost_set_number(merged, *count);
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        set[t] = merged[set[t]];
done:
    OST_FREE(arrived, merged, links.link);
    return status;
}
