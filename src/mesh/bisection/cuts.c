/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"
#include "mesh/bisection/forest.h"

#include <stdlib.h>
#include <string.h>

/* The meeting place of edges: what this rank knows of those whose lower label is in its range. Ranges ascend with the
 * ranks, so edges that are numbered range by range are numbered in the order of their labels. */

/* Someone who has the edge, and wants to hear of its cut. */
typedef struct Listener {
    OstLocal entry, next; /* next listener of the entry, or -1 */
    int rank;
    OstLocal edge; /* its number there */
} Listener;

typedef struct Entry {
    OstGlobal label; /* of the vertex in its middle; 0: not cut */
    OstGlobal tet;   /* lowest label of a root that cuts it; INT64_MAX: none */
    int holder;      /* that root's rank */
    double x[3];
    OstLocal first; /* listener, or -1 */
} Entry;

typedef struct Cuts {
    OstIndex *index;
    OstLocal listener_count;
    Entry *entry;
    Listener *listener;
} Cuts;

/* What a listener hears. */
typedef struct Answer {
    OstLocal edge; /* its number there */
    int holder;
    OstGlobal label;
    double x[3];
} Answer;

/* The answers of one exchange. */
typedef struct Answers {
    OstLocal count;
    Answer *answer;
    int *to;
} Answers;

void ost_cuts_destroy(Cuts **cuts)
{
    if (!*cuts)
        return;
    ost_index_destroy(&(*cuts)->index);
    OST_FREE((*cuts)->entry, (*cuts)->listener);
    OST_FREE(*cuts);
}

static OstStatus cuts_of(Forest *forest, Cuts **cuts)
{
    if (!forest->cuts) {
        OST_TRY(OST_NEW(forest->ctx, &forest->cuts, 1));
        OST_TRY(ost_index_create(forest->ctx, 2, &forest->cuts->index));
    }
    *cuts = forest->cuts;
    return OST_SUCCESS;
}

static OstStatus answer(const Forest *forest, const Entry *entry, const Listener *listener, Answers *answers)
{
    OST_TRY(FOREST_ROOM(forest, answers->count, &answers->answer));
    OST_TRY(FOREST_ROOM(forest, answers->count, &answers->to));
    Answer *made = &answers->answer[answers->count];
    *made = (Answer){listener->edge, entry->holder, entry->label, {0.0}};
    memcpy(made->x, entry->x, sizeof made->x);
    answers->to[answers->count++] = listener->rank;
    return OST_SUCCESS;
}

static OstStatus listen(const Forest *forest, Cuts *cuts, OstLocal entry, int rank, OstLocal edge)
{
    OST_TRY(FOREST_ROOM(forest, cuts->listener_count, &cuts->listener));
    cuts->listener[cuts->listener_count] = (Listener){entry, cuts->entry[entry].first, rank, edge};
    cuts->entry[entry].first = cuts->listener_count++;
    return OST_SUCCESS;
}

/* Files a notice; an edge that was cut in an earlier exchange is answered at once. */
static OstStatus file_notice(const Forest *forest, Cuts *cuts, const Notice *notice, int rank, Answers *answers)
{
    const OstLocal known = cuts->index->count;
    OstLocal place = 0;
    OST_TRY(ost_index_place(cuts->index, &notice->key.low, &place));
    if (place == known) {
        OST_TRY(FOREST_ROOM(forest, known, &cuts->entry));
        cuts->entry[place] = (Entry){.tet = INT64_MAX, .first = -1};
    }
    if (notice->first)
        OST_TRY(listen(forest, cuts, place, rank, notice->edge));
    Entry *entry = &cuts->entry[place];
    if (entry->label > 0)
        return notice->first ? answer(forest, entry, &cuts->listener[entry->first], answers) : OST_SUCCESS;
    if (notice->tet < entry->tet) {
        entry->tet = notice->tet;
        entry->holder = rank;
        memcpy(entry->x, notice->x, sizeof entry->x);
    }
    return OST_SUCCESS;
}

/* A newly cut edge. */
typedef struct Fresh {
    OstKey key;
    OstLocal entry;
} Fresh;

static int compare_keys(const void *a, const void *b)
{
    const OstKey *x = &((const Fresh *)a)->key, *y = &((const Fresh *)b)->key;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low) : (x->high > y->high) - (x->high < y->high);
}

/* The edges that the arrived notices cut, each once. */
static OstStatus list_fresh(const Forest *forest, const Cuts *cuts, OstLocal count, const Notice *notice,
                            OstLocal *fresh_count, Fresh **fresh)
{
    OstLocal kept = 0;
    *fresh_count = 0;
    OST_TRY(OST_NEW(forest->ctx, fresh, count));
    for (OstLocal i = 0; i < count; i++) {
        const OstLocal place = ost_index_find(cuts->index, &notice[i].key.low);
        if (notice[i].tet < INT64_MAX && cuts->entry[place].label == 0)
            (*fresh)[kept++] = (Fresh){notice[i].key, place};
    }
    qsort(*fresh, (size_t)kept, sizeof **fresh, compare_keys);
    for (OstLocal i = 0; i < kept; i++)
        if (i == 0 || (*fresh)[i].entry != (*fresh)[*fresh_count - 1].entry)
            (*fresh)[(*fresh_count)++] = (*fresh)[i];
    return OST_SUCCESS;
}

static OstStatus file_notices(const Forest *forest, Cuts *cuts, const OstRoute *route, const Notice *notice,
                              Answers *answers)
{
    for (int rank = 0; rank < ost_size(forest->ctx); rank++)
        for (OstLocal i = 0; i < route->receive_count[rank]; i++)
            OST_TRY(file_notice(forest, cuts, &notice[route->receive_start[rank] + i], rank, answers));
    return OST_SUCCESS;
}

/* Numbers what was cut, and answers all who listen. */
static OstStatus label_fresh(Forest *forest, Cuts *cuts, OstLocal count, const Fresh *fresh, Answers *answers)
{
    OstGlobal first = 0, total = 0;
    OST_TRY(ost_number_from(forest->ctx, count, &first, &total));
    OstStatus status = OST_SUCCESS;
    if (forest->highest_label > OST_LARGEST_LABEL - total)
        status = OST_RAISE(forest->ctx, OST_LIMIT_EXCEEDED,
                           "vertex label %lld is too large to number new vertices after it; number vertices from 1",
                           (long long)forest->highest_label);
    for (OstLocal i = 0; status == OST_SUCCESS && i < count; i++) {
        Entry *entry = &cuts->entry[fresh[i].entry];
        entry->label = forest->highest_label + first + i + 1;
        for (OstLocal l = entry->first; status == OST_SUCCESS && l >= 0; l = cuts->listener[l].next)
            status = answer(forest, entry, &cuts->listener[l], answers);
    }
    forest->highest_label += total;
    return ost_agree(forest->ctx, status);
}

static OstStatus hear(Forest *forest, OstLocal count, const Answer *heard)
{
    for (OstLocal i = 0; i < count; i++) {
        ForestEdge *edge = &forest->edge[heard[i].edge];
        OST_TRY(FOREST_ROOM(forest, forest->vertex_count, &forest->vertex));
        edge->cut = forest->vertex_count++;
        ForestVertex *vertex = &forest->vertex[edge->cut];
        *vertex = (ForestVertex){.label = heard[i].label, .holder = heard[i].holder, .shared = edge->shared};
        ost_forest_ends(forest, heard[i].edge, vertex->ends);
        const ForestVertex *end[2] = {&forest->vertex[vertex->ends[0]], &forest->vertex[vertex->ends[1]]};
        vertex->leads = end[0]->leads & end[1]->leads;
        vertex->follows = end[0]->follows & end[1]->follows;
        memcpy(vertex->x, heard[i].x, sizeof vertex->x);
    }
    for (OstLocal i = 0; i < forest->notice_count; i++)
        forest->edge[forest->notice[i].edge].notice = -1;
    forest->notice_count = 0;
    return OST_SUCCESS;
}

static OstStatus send_answers(Forest *forest, const Answers *answers)
{
    OstRoute *route = NULL;
    Answer *heard = NULL;
    OstStatus status = ost_route_create(forest->ctx, answers->count, 1, answers->to, &route);
    OST_THEN(ost_route_carry(route, sizeof *heard, answers->answer, (void **)&heard));
    OST_THEN(ost_agree(forest->ctx, hear(forest, route->receives, heard)));
    ost_route_destroy(&route);
    OST_FREE(heard);
    return status;
}

static OstStatus send_notices(const Forest *forest, OstRoute **route, Notice **notice)
{
    OstContext *ctx = forest->ctx;
    const OstGlobal range = forest->label_limit / ost_size(ctx) + 1;
    int *to = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &to, forest->notice_count));
    for (OstLocal i = 0; status == OST_SUCCESS && i < forest->notice_count; i++) {
        const OstGlobal rank = forest->notice[i].key.low / range;
        to[i] = rank < ost_size(ctx) ? (int)rank : ost_size(ctx) - 1;
    }
    OST_THEN(ost_route_create(ctx, forest->notice_count, 1, to, route));
    OST_THEN(ost_route_carry(*route, sizeof **notice, forest->notice, (void **)notice));
    OST_FREE(to);
    return status;
}

OstStatus ost_forest_exchange(Forest *forest)
{
    OstContext *ctx = forest->ctx;
    OstRoute *route = NULL;
    Notice *arrived = NULL;
    Fresh *fresh = NULL;
    OstLocal fresh_count = 0;
    Answers answers = {0};
    Cuts *cuts = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, cuts_of(forest, &cuts)));
    OST_TRY_DONE(send_notices(forest, &route, &arrived));
    status = file_notices(forest, cuts, route, arrived, &answers);
    OST_THEN(list_fresh(forest, cuts, route->receives, arrived, &fresh_count, &fresh));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(label_fresh(forest, cuts, fresh_count, fresh, &answers));
    OST_TRY_DONE(send_answers(forest, &answers));
done:
    ost_route_destroy(&route);
    OST_FREE(arrived, fresh, answers.answer, answers.to);
    return status;
}
