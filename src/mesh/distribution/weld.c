/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/weld.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/parallel/rendezvous.h"
#include "core/parallel/route.h"
#include "effect/effect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The ratio from which multigrid aggregates by stiffness. A tet hangs together if it has more than the share of what
 * the tets of each of its nodes have in all; a node has up to some hundred. Nodes are close below this part of the mean
 * of the distances that each has to others of its tets. */
static const double uneven = 1e4, share = 1e-3, close = 0.1, largest = 0.25;

/* A tet of a layer with close nodes has edges that differ by more. */
static const double flat = 0.25;

/* An inclusion is found after as many rounds as it is split over ranks; what is split more often is too large. */
enum { MOST_ROUNDS = 100 };

/* The part that so many nodes of an inclusion are in, as one rank counts them. */
typedef struct Piece {
    OstGlobal label;
    OstGlobal nodes, border; /* so many of them with a tet that is far softer */
    OstLocal part, number;   /* -1 for none; its place in the list */
} Piece;

typedef struct Welding {
    const OstMeshChunk *chunk;
    const Slab *slab;
    size_t nodes;     /* the slab's, and its ghosts */
    double *sum;      /* nodes: the stiffness of their tets */
    double *softer;   /* nodes: how many of these are far softer than the others */
    OstLocal *set;    /* nodes: any other of the same inclusion, or itself */
    OstGlobal *label; /* nodes: the lowest number of the inclusion that is known here */
    OstLocal pieces;
    Piece *piece;    /* of this rank's nodes */
    OstLocal *place; /* the slab's nodes: their piece */
} Welding;

static void destroy_welding(Welding *w)
{
    OST_FREE(w->sum, w->softer, w->set, w->label, w->piece, w->place);
}

static OstStatus create_welding(const OstMeshChunk *chunk, const Slab *slab, Welding *w)
{
    OstContext *ctx = slab->ctx;
    *w = (Welding){.chunk = chunk, .slab = slab, .nodes = (size_t)slab->node_count + (size_t)slab->ghost_count};
    OST_TRY(OST_NEW(ctx, &w->sum, w->nodes));
    OST_TRY(OST_NEW(ctx, &w->softer, w->nodes));
    OST_TRY(OST_NEW(ctx, &w->set, w->nodes));
    OST_TRY(OST_NEW(ctx, &w->label, w->nodes));
    OST_TRY(OST_NEW(ctx, &w->piece, slab->node_count));
    return OST_NEW(ctx, &w->place, slab->node_count);
}

/* --- what hangs together: close nodes --- */

static double squared_distance(const double *position, OstLocal a, OstLocal b)
{
    double square = 0.0;
    for (size_t c = 0; c < 3; c++) {
        const double d = position[3 * (size_t)b + c] - position[3 * (size_t)a + c];
        square += d * d;
    }
    return square;
}

static double distance(const double *position, OstLocal a, OstLocal b)
{
    return sqrt(squared_distance(position, a, b));
}

/* Has any tet edges that differ as much as those of a flat layer? Most bodies have none, and all else is left out. */
static OstStatus has_flat_tets(const OstMeshChunk *chunk, const Slab *slab, const double *position, int *answer)
{
    enum { VERTICES = 4 };
    const size_t width = (size_t)chunk->nodes_per_tet;
    *answer = 0;
    for (size_t t = 0; t < (size_t)chunk->tet_count && !*answer; t++) {
        const OstLocal *node = slab->tet_nodes + width * t;
        double least = INFINITY, most = 0.0;
        for (size_t u = 0; u < VERTICES; u++)
            for (size_t v = 0; v < u; v++) {
                const double square = squared_distance(position, node[u], node[v]);
                least = fmin(least, square);
                most = fmax(most, square);
            }
        *answer = least < flat * flat * most;
    }
    return ost_max_ints(chunk->ctx, 1, answer);
}

static OstStatus find_positions(const OstMeshChunk *chunk, const Slab *slab, double **position)
{
    const size_t owned = 3 * (size_t)slab->node_count;
    OST_TRY(ost_agree(chunk->ctx, OST_NEW(chunk->ctx, position, owned + 3 * (size_t)slab->ghost_count)));
    if (owned > 0)
        memcpy(*position, chunk->coordinates, owned * sizeof **position);
    return ost_halo_import(slab->halo, 3 * sizeof **position, *position);
}

/* In `sum` the mean distance that each node has to the others of its tets. */
static OstStatus measure_distances(const Welding *w, const double *position, double *sum)
{
    const size_t width = (size_t)w->chunk->nodes_per_tet;
    for (size_t t = 0; t < (size_t)w->chunk->tet_count; t++) {
        const OstLocal *node = w->slab->tet_nodes + width * t;
        for (size_t u = 0; u < width; u++) {
            for (size_t v = 0; v < u; v++) {
                const double apart = distance(position, node[u], node[v]);
                sum[2 * (size_t)node[u]] += apart;
                sum[2 * (size_t)node[v]] += apart;
            }
            sum[2 * (size_t)node[u] + 1] += (double)(width - 1);
        }
    }
    OST_TRY(ost_halo_add_to_owners(w->slab->halo, 2, sum));
    OST_TRY(ost_halo_import(w->slab->halo, 2 * sizeof *sum, sum));
    for (size_t i = 0; i < w->nodes; i++)
        sum[i] = sum[2 * i] / fmax(sum[2 * i + 1], 1.0);
    return OST_SUCCESS;
}

static OstLocal root_of(OstLocal *set, OstLocal i)
{
    for (; set[i] != i; i = set[i])
        set[i] = set[set[i]];
    return i;
}

static void start_sets(Welding *w)
{
    for (size_t i = 0; i < w->nodes; i++)
        w->set[i] = (OstLocal)i;
}

/* Joins close nodes; *joined: how many pairs there are on all ranks. */
static OstStatus join_close(Welding *w, const double *position, OstGlobal *joined)
{
    const size_t width = (size_t)w->chunk->nodes_per_tet;
    double *mean = NULL;
    OstStatus status;
    *joined = 0;
    OST_TRY_DONE(ost_agree(w->slab->ctx, OST_NEW(w->slab->ctx, &mean, 2 * w->nodes)));
    OST_TRY_DONE(measure_distances(w, position, mean));
    start_sets(w);
    for (size_t t = 0; t < (size_t)w->chunk->tet_count; t++) {
        const OstLocal *node = w->slab->tet_nodes + width * t;
        for (size_t u = 0; u < width; u++)
            for (size_t v = 0; v < u; v++) {
                if (distance(position, node[u], node[v]) > close * fmin(mean[node[u]], mean[node[v]]))
                    continue;
                w->set[root_of(w->set, node[u])] = root_of(w->set, node[v]);
                (*joined)++;
            }
    }
    OST_TRY_DONE(ost_sum_numbers(w->slab->ctx, 1, joined));
done:
    OST_FREE(mean);
    return status;
}

/* --- what hangs together: stiff tets --- */

static OstStatus is_uneven(const OstMeshChunk *chunk, const double *stiffness, int *answer)
{
    double range[2] = {0.0, 0.0}; /* of the stiffness, and of one over it */
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        range[0] = fmax(range[0], stiffness[t]);
        range[1] = fmax(range[1], 1.0 / stiffness[t]);
    }
    OST_TRY(ost_max(chunk->ctx, 2, range));
    *answer = range[0] * range[1] > uneven && isfinite(range[0] * range[1]);
    return OST_SUCCESS;
}

static OstStatus sum_stiffness(Welding *w, const double *stiffness)
{
    const size_t width = (size_t)w->chunk->nodes_per_tet;
    for (size_t t = 0; t < (size_t)w->chunk->tet_count; t++)
        for (size_t v = 0; v < width; v++)
            w->sum[w->slab->tet_nodes[width * t + v]] += stiffness[t];
    OST_TRY(ost_halo_add_to_owners(w->slab->halo, 1, w->sum));
    return ost_halo_import(w->slab->halo, sizeof *w->sum, w->sum);
}

static OstStatus join_tets(Welding *w, const double *stiffness)
{
    const size_t width = (size_t)w->chunk->nodes_per_tet;
    start_sets(w);
    for (size_t t = 0; t < (size_t)w->chunk->tet_count; t++) {
        const OstLocal *node = w->slab->tet_nodes + width * t;
        double most = 0.0;
        for (size_t v = 0; v < width; v++) {
            most = fmax(most, w->sum[node[v]]);
            w->softer[node[v]] += !(stiffness[t] > share * w->sum[node[v]]);
        }
        for (size_t v = 1; v < width && stiffness[t] > share * most; v++)
            w->set[root_of(w->set, node[v])] = root_of(w->set, node[0]);
    }
    return ost_halo_add_to_owners(w->slab->halo, 1, w->softer);
}

/* --- their labels --- */

/* Each node takes the lowest label of its set. */
static void spread_labels(Welding *w)
{
    for (size_t i = 0; i < w->nodes; i++) {
        OstGlobal *lowest = &w->label[root_of(w->set, (OstLocal)i)];
        *lowest = w->label[i] < *lowest ? w->label[i] : *lowest;
    }
    for (size_t i = 0; i < w->nodes; i++)
        w->label[i] = w->label[root_of(w->set, (OstLocal)i)];
}

/* The nodes that several ranks have: those that are ghosts elsewhere, and the ghosts here. */
static OstStatus list_shared(const Welding *w, OstLocal *count, OstLocal **node, OstKey **key)
{
    const OstHalo *halo = w->slab->halo;
    const OstLocal sent = halo->send_start[halo->neighbour_count];
    *count = sent + halo->ghosts;
    OST_TRY(OST_NEW(w->slab->ctx, node, *count));
    OST_TRY(OST_NEW(w->slab->ctx, key, *count));
    for (OstLocal k = 0; k < *count; k++) {
        const OstLocal i = k < sent ? halo->send_index[k] : halo->owned + k - sent;
        const OstGlobal number =
            i < w->slab->node_count ? w->slab->first_node + i : w->slab->ghost_number[i - w->slab->node_count];
        (*node)[k] = i;
        (*key)[k] = ost_key(number, number);
    }
    return OST_SUCCESS;
}

/* Labels are the lowest number of the inclusion, on all ranks. */
static OstStatus label_nodes(Welding *w)
{
    OstContext *ctx = w->slab->ctx;
    OstLocal count = 0, *node = NULL;
    OstKey *key = NULL;
    OstGlobal *label = NULL, changed = 1;
    for (size_t i = 0; i < w->nodes; i++)
        w->label[i] = i < (size_t)w->slab->node_count ? w->slab->first_node + (OstGlobal)i
                                                      : w->slab->ghost_number[i - (size_t)w->slab->node_count];
    spread_labels(w);
    OstStatus status = list_shared(w, &count, &node, &key);
    OST_THEN(OST_NEW(ctx, &label, 2 * (size_t)count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (int round = 0; changed > 0 && round < MOST_ROUNDS; round++) {
        changed = 0;
        for (OstLocal k = 0; k < count; k++)
            label[k] = w->label[node[k]];
        const OstKeyed known = {.count = count, .key = key, .order = label, .value = label};
        OST_TRY_DONE(ost_rendezvous(ctx, "node", sizeof *label, &known, count, key, label + count));
        for (OstLocal k = 0; k < count; k++) {
            changed += label[count + k] < label[k];
            w->label[node[k]] = label[count + k];
        }
        spread_labels(w);
        OST_TRY_DONE(ost_sum_numbers(ctx, 1, &changed));
    }
done:
    OST_FREE(node, key, label);
    return status;
}

/* --- where it goes --- */

static int compare_pieces(const void *a, const void *b)
{
    const Piece *p = a, *q = b;
    if (p->label != q->label)
        return p->label < q->label ? -1 : 1;
    return p->part != q->part ? p->part - q->part : p->number - q->number;
}

/* Counts this rank's nodes by inclusion and part. */
static void count_pieces(Welding *w, const int *part)
{
    const OstLocal n = w->slab->node_count;
    for (OstLocal i = 0; i < n; i++)
        w->piece[i] =
            (Piece){.label = w->label[i], .nodes = 1, .border = w->softer[i] > 0.0, .part = part[i], .number = i};
    qsort(w->piece, (size_t)n, sizeof *w->piece, compare_pieces);
    for (OstLocal i = 0; i < n; i++) {
        const Piece next = w->piece[i];
        Piece *last = &w->piece[w->pieces - 1];
        if (w->pieces > 0 && last->label == next.label && last->part == next.part) {
            last->nodes++;
            last->border += next.border;
        } else {
            w->piece[w->pieces++] = next;
        }
        w->place[next.number] = w->pieces - 1;
    }
}

/* The part of all pieces with one label: that with most nodes, of equal ones the lowest; -1 if they are too many, or
 * have nothing softer around them. */
static OstLocal best_part(OstLocal count, const Piece *piece, double most)
{
    OstGlobal all = 0, border = 0, best = 0, nodes = 0;
    OstLocal part = -1;
    for (OstLocal k = 0; k < count; k++) {
        nodes = (k > 0 && piece[k].part == piece[k - 1].part ? nodes : 0) + piece[k].nodes;
        all += piece[k].nodes;
        border += piece[k].border;
        if (nodes > best) {
            best = nodes;
            part = piece[k].part;
        }
    }
    return (double)all > most || border == 0 ? -1 : part;
}

/* The part of each piece, in the order of their numbers. */
static void decide(double most, OstLocal count, Piece *piece, OstLocal *answer)
{
    for (OstLocal k = 0; k < count; k++)
        piece[k].number = k;
    qsort(piece, (size_t)count, sizeof *piece, compare_pieces);
    for (OstLocal from = 0, end = 0; from < count; from = end) {
        while (end < count && piece[end].label == piece[from].label)
            end++;
        const OstLocal part = best_part(end - from, piece + from, most);
        for (OstLocal k = from; k < end; k++)
            answer[piece[k].number] = part;
    }
}

/* Pieces of one inclusion meet on one rank, which decides where it goes: `decided`, in the order of the pieces. */
static OstStatus ask_for_parts(const Welding *w, OstLocal *decided)
{
    OstContext *ctx = w->slab->ctx;
    const double most = largest * (double)w->slab->global_nodes / ost_size(ctx);
    OstRoute *route = NULL;
    Piece *met = NULL;
    OstLocal *answer = NULL;
    int *to = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &to, w->pieces)));
    for (OstLocal k = 0; k < w->pieces; k++)
        to[k] = (int)(w->piece[k].label % ost_size(ctx));
    OST_TRY_DONE(ost_route_create(ctx, w->pieces, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *met, w->piece, (void **)&met));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &answer, route->receives)));
    decide(most, route->receives, met, answer);
    OST_TRY_DONE(ost_route_answer(route, sizeof *answer, answer, decided));
done:
    ost_route_destroy(&route);
    OST_FREE(to, met, answer);
    return status;
}

/* Moves the nodes, unless a part would be left without any. */
static OstStatus move_nodes(const Welding *w, const OstLocal *decided, int *part)
{
    OstContext *ctx = w->slab->ctx;
    const int parts = ost_size(ctx);
    OstGlobal *nodes = NULL, moved = 0;
    int empty = 0;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &nodes, parts));
    if (status != OST_SUCCESS)
        return status;
    for (OstLocal i = 0; i < w->slab->node_count; i++) {
        const OstLocal to = decided[w->place[i]];
        nodes[to >= 0 ? to : part[i]]++;
    }
    OST_TRY_DONE(ost_sum_numbers(ctx, parts, nodes));
    for (int p = 0; p < parts; p++)
        empty |= nodes[p] == 0;
    for (OstLocal i = 0; i < w->slab->node_count && !empty; i++) {
        const OstLocal to = decided[w->place[i]];
        moved += to >= 0 && to != part[i];
        part[i] = to >= 0 ? to : part[i];
    }
    OST_TRY_DONE(ost_sum_numbers(ctx, 1, &moved));
    ost_log(ctx, OST_LOG_VERBOSE, "mesh: %lld vertices change rank, so that what moves as one is on one",
            (long long)moved);
    status = ost_halo_import(w->slab->halo, sizeof *part, part);
done:
    OST_FREE(nodes);
    return status;
}

/* Gives every set to one part. */
static OstStatus weld_sets(Welding *w, int *part)
{
    OstLocal *decided = NULL;
    OstStatus status = label_nodes(w);
    if (status != OST_SUCCESS)
        return status;
    count_pieces(w, part);
    OST_TRY_DONE(ost_agree(w->slab->ctx, OST_NEW(w->slab->ctx, &decided, w->pieces)));
    OST_TRY_DONE(ask_for_parts(w, decided));
    status = move_nodes(w, decided, part);
done:
    OST_FREE(decided);
    return status;
}

static OstStatus weld_close(const OstMeshChunk *chunk, const Slab *slab, const double *position, int *part)
{
    Welding w;
    OstGlobal joined = 0;
    OstStatus status = create_welding(chunk, slab, &w);
    OST_TRY_DONE(ost_agree(chunk->ctx, status));
    OST_TRY_DONE(join_close(&w, position, &joined));
    for (size_t i = 0; i < w.nodes; i++)
        w.softer[i] = 1.0; /* whatever is around them */
    if (joined > 0)
        status = weld_sets(&w, part);
done:
    destroy_welding(&w);
    return status;
}

static OstStatus weld_stiff(const OstMeshChunk *chunk, const Slab *slab, const double *stiffness, int *part)
{
    Welding w;
    OstStatus status = create_welding(chunk, slab, &w);
    OST_TRY_DONE(ost_agree(chunk->ctx, status));
    OST_TRY_DONE(sum_stiffness(&w, stiffness));
    OST_TRY_DONE(join_tets(&w, stiffness));
    status = weld_sets(&w, part);
done:
    destroy_welding(&w);
    return status;
}

OstStatus ost_parts_weld_close(const OstMeshChunk *chunk, const Slab *slab, int *part, int *any)
{
    double *position = NULL;
    OstStatus status = find_positions(chunk, slab, &position);
    OST_THEN(has_flat_tets(chunk, slab, position, any));
    if (status == OST_SUCCESS && *any) {
        ost_ledger_enter(chunk->ctx, OST_EFFECT_CLOSE_NODES);
        status = weld_close(chunk, slab, position, part);
        ost_ledger_leave(chunk->ctx);
    }
    OST_FREE(position);
    return status;
}

OstStatus ost_parts_weld_stiff(const OstMeshChunk *chunk, const Slab *slab, const double *stiffness, int *part,
                               int *any)
{
    OST_TRY(is_uneven(chunk, stiffness, any));
    if (!*any)
        return OST_SUCCESS;
    ost_ledger_enter(chunk->ctx, OST_EFFECT_WHOLE_INCLUSIONS);
    const OstStatus status = weld_stiff(chunk, slab, stiffness, part);
    ost_ledger_leave(chunk->ctx);
    return status;
}
