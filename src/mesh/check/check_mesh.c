/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/check/check.h"
#include "mesh/incidence.h"

#include <float.h>
#include <stdio.h>

enum { LABELS_SHOWN = 8 };

/* A tet counts as flat if its volume is below this share of its longest edge cubed / 6. */
static const double flat_share = 1e-12;

/* The volume up to which a tet counts as flat: a share of its longest edge cubed, or what rounding its coordinates in
 * the last place can change. */
static double flat_volume(const double *coordinates, const OstLocal *nodes)
{
    double longest = 0.0;
    double farthest = 0.0;
    for (int e = 0; e < 6; e++) {
        const double *a = coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
        const double *b = coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
        const double edge[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        longest = fmax(longest, ost_norm3(edge));
        for (int d = 0; d < 3; d++)
            farthest = fmax(farthest, fmax(fabs(a[d]), fabs(b[d])));
    }
    return longest * longest * fmax(flat_share * longest, DBL_EPSILON * farthest) / 6.0;
}

enum { INVERTED, FLAT, KINDS };

/* Twisted: do others of the bad tet's element have a volume? */
static void say_what_mends(const OstMesh *mesh, const OstGlobal bad[KINDS], int twisted, size_t size, char *text)
{
    size_t used = 0;
    if (twisted) {
        snprintf(text, size,
                 "%lld of its tets are inverted or flat, and as others of the element are not, it is twisted, has a "
                 "corner of 180 degrees or more, or its nodes are in a wrong order",
                 (long long)(bad[INVERTED] + bad[FLAT]));
        return;
    }
    if (bad[INVERTED] > 0)
        used = (size_t)snprintf(text, size, "%lld of its tets %s inverted: %s%s", (long long)bad[INVERTED],
                                bad[INVERTED] == 1 ? "is" : "are",
                                mesh->of_arrays ? "exchanging two vertices of such a tet turns it"
                                                : "'orthostat mesh FILE NEW --orient' turns such",
                                bad[FLAT] > 0 ? "; " : "");
    if (bad[FLAT] > 0)
        snprintf(text + used, size - used, "%lld of its tets %s flat: mesh the body anew there", (long long)bad[FLAT],
                 bad[FLAT] == 1 ? "is" : "are");
}

/* The cube of a length below 1e-102 or above 1e102 underflows or overflows. */
static OstStatus raise_bad_tet(const OstMesh *mesh, OstGlobal label, double volume, double flat,
                               const OstGlobal bad[KINDS], int twisted)
{
    char cell[OST_CELL_WORDS], mending[512];
    ost_cell_words(mesh, label, cell);
    if (!(flat >= DBL_MIN && isfinite(flat) && isfinite(volume)))
        return OST_RAISE(
            mesh->ctx, OST_INVALID_INPUT,
            "tet %lld%s has a volume of %g, beyond what double precision holds; choose another unit of length",
            (long long)label, cell, volume);
    say_what_mends(mesh, bad, twisted, sizeof mending, mending);
    return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                     "tet %lld%s is %s: its volume is %g, expected more than %g (1e-12 of its longest edge cubed, or "
                     "what rounding of coordinates takes); mend the mesh: %s",
                     (long long)label, cell, volume < -flat ? "inverted" : "flat", volume, flat, mending);
}

/* Has the element of the file with this tet others that are not inverted? */
static OstStatus find_upright(const OstMesh *mesh, OstGlobal label, int *found)
{
    const OstGlobal cell = ost_cell_label(1, label);
    *found = 0;
    for (OstLocal t = 0; t < mesh->owned_tets && mesh->of_cells; t++)
        *found |= ost_cell_label(1, mesh->tet_label[t]) == cell &&
                  ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, t)) > 0.0;
    return ost_max_ints(mesh->ctx, 1, found);
}

/* The message names the bad tet with the lowest label of all ranks. */
static OstStatus check_volumes(const OstMesh *mesh)
{
    OstGlobal lowest = INT64_MAX;
    OstLocal worst = -1;
    OstGlobal bad[KINDS] = {0};
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        const double volume = ost_tet_volume(mesh->coordinates, nodes), flat = flat_volume(mesh->coordinates, nodes);
        if (volume > flat)
            continue;
        bad[volume < -flat ? INVERTED : FLAT]++;
        if (mesh->tet_label[t] < lowest) {
            lowest = mesh->tet_label[t];
            worst = t;
        }
    }
    OstGlobal first = lowest;
    OST_TRY(ost_min_numbers(mesh->ctx, 1, &first));
    OST_TRY(ost_sum_numbers(mesh->ctx, KINDS, bad));
    int twisted = 0;
    if (first < INT64_MAX)
        OST_TRY(find_upright(mesh, first, &twisted));
    OstStatus status = OST_SUCCESS;
    if (worst >= 0 && lowest == first) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, worst);
        status = raise_bad_tet(mesh, lowest, ost_tet_volume(mesh->coordinates, nodes),
                               flat_volume(mesh->coordinates, nodes), bad, twisted);
    }
    return ost_agree(mesh->ctx, status);
}

/* The first labels of a sorted list: "17, 23, 99 and 4 more". */
static void list_labels(const OstGlobal *label, OstGlobal count, char *text, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < LABELS_SHOWN && i < count; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%lld", i > 0 ? ", " : "", (long long)label[i]);
    if (count > LABELS_SHOWN)
        snprintf(text + used, size - used, " and %lld more", (long long)(count - LABELS_SHOWN));
}

/* Gathers the lowest labels of all ranks in `all` (LABELS_SHOWN per rank), and names the lowest of these. */
static OstStatus raise_unused(const OstMesh *mesh, OstGlobal count, OstGlobal *lowest, OstGlobal *all)
{
    OST_TRY(OST_MPI(mesh->ctx, MPI_Allgather(lowest, LABELS_SHOWN, MPI_INT64_T, all, LABELS_SHOWN, MPI_INT64_T,
                                             ost_comm(mesh->ctx))));
    ost_numbers_sort(ost_size(mesh->ctx) * LABELS_SHOWN, all);
    char text[32 * (LABELS_SHOWN + 1)] = "";
    list_labels(all, count, text, sizeof text);
    return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "%lld %s used by no tet: %s; remove %s", (long long)count,
                     count == 1 ? "vertex is" : "vertices are", text, count == 1 ? "it" : "them");
}

/* Inserts a label among the lowest, which are sorted, if it is one of them. */
static void keep_lowest(OstGlobal label, OstGlobal lowest[LABELS_SHOWN])
{
    if (label >= lowest[LABELS_SHOWN - 1])
        return;
    int i = LABELS_SHOWN - 1;
    for (; i > 0 && lowest[i - 1] > label; i--)
        lowest[i] = lowest[i - 1];
    lowest[i] = label;
}

static OstStatus check_used(const OstMesh *mesh, const Incidence *incidence)
{
    OstContext *ctx = mesh->ctx;
    OstGlobal lowest[LABELS_SHOWN];
    OstGlobal count = 0;
    for (int i = 0; i < LABELS_SHOWN; i++)
        lowest[i] = INT64_MAX;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        if (incidence->start[n] < incidence->start[n + 1])
            continue;
        count++;
        keep_lowest(mesh->node_label[n], lowest);
    }
    OST_TRY(ost_sum_numbers(ctx, 1, &count));
    if (count == 0)
        return OST_SUCCESS;
    OstGlobal *all = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &all, (size_t)ost_size(ctx) * LABELS_SHOWN));
    OST_THEN(raise_unused(mesh, count, lowest, all));
    OST_FREE(all);
    return status;
}

static int has_node(const OstLocal *tet, int nodes_per_tet, OstGlobal node)
{
    for (int v = 0; v < nodes_per_tet; v++)
        if (tet[v] == node)
            return 1;
    return 0;
}

/* Does a tet have all the item's nodes? Looks at the tets of an owned node, all of which are here. */
static int is_part_of_a_tet(const OstMesh *mesh, const Incidence *incidence, int count, const OstGlobal *nodes)
{
    int owned = 0;
    while (nodes[owned] >= mesh->owned_nodes)
        owned++;
    const OstGlobal node = nodes[owned];
    for (OstGlobal p = incidence->start[node]; p < incidence->start[node + 1]; p++) {
        const OstLocal *tet = ost_mesh_nodes_of(mesh, incidence->tet[p]);
        int found = 0;
        while (found < count && has_node(tet, mesh->nodes_per_tet, nodes[found]))
            found++;
        if (found == count)
            return 1;
    }
    return 0;
}

static OstStatus check_items(const OstMesh *mesh, const Incidence *incidence)
{
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        for (OstLocal i = 0; i < boundary->count; i++) {
            const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item;
            if (!is_part_of_a_tet(mesh, incidence, boundary->nodes_per_item, nodes))
                return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                                 "boundary '%s' has a %s at vertex %lld that is no %s of any tet; remove it or mesh "
                                 "the body with it",
                                 boundary->name, boundary->dimension == 1 ? "curve" : "face",
                                 (long long)mesh->node_label[nodes[0]], boundary->dimension == 1 ? "edge" : "face");
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_check_mesh(OstMesh *mesh, int curved)
{
    Incidence incidence = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(check_volumes(mesh));
    if (curved && mesh->nodes_per_tet == 10)
        OST_TRY_DONE(ost_check_folds(mesh));
    OST_TRY_DONE(ost_agree(mesh->ctx, ost_incidence_build(mesh->ctx, mesh->owned_nodes, mesh->tet_count,
                                                          mesh->nodes_per_tet, mesh->tet_nodes, &incidence)));
    OST_TRY_DONE(check_used(mesh, &incidence));
    OST_TRY_DONE(ost_agree(mesh->ctx, check_items(mesh, &incidence)));
done:
    ost_incidence_clear(&incidence);
    return status;
}
