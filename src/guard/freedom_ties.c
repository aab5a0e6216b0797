/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_ties.h"

#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/halo.h"
#include "core/small.h"

#include <stdlib.h>
#include <string.h>

/* A component is well constrained if its supports resist every motion by at least this share of it; further supports
 * need not be read then. Tested at 64, 256, 1024, ... rows. */
static const double well_constrained = 0.01;
enum { FIRST_LOOK = 64, LOOK_FACTOR = 4 };

/* A node where components meet; `component` is not the lowest of them. */
typedef struct Meeting {
    OstLocal low, component;
    OstLocal node;
} Meeting;

/* Which components each owned node is in. */
typedef struct NodeComponents {
    OstLocal *lowest; /* owned_nodes; NULL: there is one component */
    Meeting *meeting;
    OstLocal meetings, capacity;
} NodeComponents;

OstRigidFrame ost_frame_of_box(const double low[3], const double high[3])
{
    OstRigidFrame frame;
    double half[3];
    for (int i = 0; i < 3; i++) {
        frame.centre[i] = 0.5 * low[i] + 0.5 * high[i];
        half[i] = 0.5 * high[i] - 0.5 * low[i];
    }
    frame.radius = ost_norm3(half);
    return frame;
}

const OstRigidFrame *ost_tie_frame(const OstRigidFrame *frames, const OstTie *tie)
{
    const OstRigidFrame *first = &frames[tie->body[0]];
    if (tie->body[1] == OST_TIE_SUPPORT)
        return first;
    const OstRigidFrame *second = &frames[tie->body[1]];
    return second->radius < first->radius ? second : first;
}

void ost_ties_release(OstTies *ties)
{
    OST_FREE(ties->tie);
    ties->count = 0;
}

static int compare_meetings(const void *a, const void *b)
{
    const OstLocal *x = a;
    const OstLocal *y = b;
    for (int i = 0; i < 3; i++) /* low, component, node */
        if (x[i] != y[i])
            return x[i] < y[i] ? -1 : 1;
    return 0;
}

static int compare_ties(const void *a, const void *b)
{
    const OstTie *x = a;
    const OstTie *y = b;
    const int first = (x->body[0] > y->body[0]) - (x->body[0] < y->body[0]);
    return first ? first : (x->body[1] > y->body[1]) - (x->body[1] < y->body[1]);
}

static OstStatus add_meeting(OstContext *ctx, NodeComponents *of, Meeting meeting)
{
    if (of->meetings == of->capacity) {
        const OstLocal capacity = of->capacity / 2 * 3 + 256;
        OST_TRY(OST_RESIZE(ctx, &of->meeting, capacity));
        of->capacity = capacity;
    }
    of->meeting[of->meetings++] = meeting;
    return OST_SUCCESS;
}

static void sort_meetings(NodeComponents *of)
{
    OstLocal kept = 0;
    if (of->meetings == 0)
        return;
    qsort(of->meeting, (size_t)of->meetings, sizeof *of->meeting, compare_meetings);
    for (OstLocal i = 0; i < of->meetings; i++)
        if (i == 0 || compare_meetings(&of->meeting[i], &of->meeting[kept - 1]) != 0)
            of->meeting[kept++] = of->meeting[i];
    of->meetings = kept;
}

static OstStatus find_meetings(const OstMesh *mesh, const OstComponents *components, NodeComponents *of)
{
    const size_t width = (size_t)mesh->nodes_per_tet;
    if (components->count == 1)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(mesh->ctx, &of->lowest, mesh->owned_nodes));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        of->lowest[n] = components->count;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (size_t v = 0; v < width; v++) {
            const OstLocal node = mesh->tet_nodes[(size_t)t * width + v];
            if (node < mesh->owned_nodes && components->of_tet[t] < of->lowest[node])
                of->lowest[node] = components->of_tet[t];
        }
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (size_t v = 0; v < width; v++) {
            const OstLocal node = mesh->tet_nodes[(size_t)t * width + v];
            const OstLocal component = components->of_tet[t];
            if (node < mesh->owned_nodes && component != of->lowest[node])
                OST_TRY(add_meeting(mesh->ctx, of, (Meeting){of->lowest[node], component, node}));
        }
    sort_meetings(of);
    return OST_SUCCESS;
}

/* The component that a follower's first leader is in, of each link (0 where there is one component alone); collective.
 */
static OstStatus find_leading(const OstMesh *mesh, const OstLinks *links, const NodeComponents *of, OstLocal **leading)
{
    OstLocal *of_slot = NULL;
    OstStatus status = OST_NEW(mesh->ctx, leading, links->count);
    OST_THEN(OST_NEW(mesh->ctx, &of_slot, links->slots));
    OST_TRY_DONE(ost_agree(mesh->ctx, status));
    for (OstLocal n = 0; n < mesh->owned_nodes && of->lowest; n++)
        of_slot[n] = of->lowest[n];
    OST_TRY_DONE(ost_halo_import(links->halo, sizeof *of_slot, of_slot));
    for (OstLocal i = 0; i < links->count; i++)
        (*leading)[i] = links->link[i].count > 0 ? of_slot[links->link[i].slot[0]] : -1;
done:
    OST_FREE(of_slot);
    return status;
}

/* Followers move as their leaders' component does: there it meets their own. */
static OstStatus meet_at_links(const OstMesh *mesh, const OstLinks *links, const OstLocal *leading, NodeComponents *of)
{
    for (OstLocal i = 0; i < links->count && of->lowest; i++) {
        const OstLocal node = links->link[i].node, own = of->lowest[node], other = leading[i];
        if (other >= 0 && other != own)
            OST_TRY(add_meeting(mesh->ctx, of, (Meeting){own < other ? own : other, own < other ? other : own, node}));
    }
    sort_meetings(of);
    return OST_SUCCESS;
}

/* Conditions of the supports of one component. */
typedef struct SupportConditions {
    int64_t rows, next_look; /* next_look 0: well constrained */
    double triangle[OST_ROWS];
} SupportConditions;

/* Conditions of one component along surface normals, as OST_TIE_SMOOTH and OST_TIE_FACETS. */
typedef struct BedConditions {
    int any;
    double smooth[OST_ROWS], facets[OST_ROWS];
} BedConditions;

static OstStatus test_whether_enough(OstContext *ctx, SupportConditions *of_supports)
{
    double copy[OST_ROWS], basis[OST_ROWS];
    int loose = 0;
    memcpy(copy, of_supports->triangle, sizeof copy);
    OST_TRY(ost_null_space(ctx, 6, 6, copy, well_constrained, &loose, basis));
    of_supports->next_look = loose == 0 ? 0 : LOOK_FACTOR * of_supports->next_look;
    return OST_SUCCESS;
}

static OstStatus add_support(OstContext *ctx, const OstRigidFrame *frame, const OstSupport *support,
                             const double *point, SupportConditions *of_supports)
{
    if (of_supports->rows > 0 && of_supports->next_look == 0)
        return OST_SUCCESS;
    if (of_supports->rows == 0)
        of_supports->next_look = FIRST_LOOK;
    for (int k = 0; k < support->constrained; k++) {
        double row[6];
        ost_rows_of_point(frame, point, support->direction + 3 * k, row);
        ost_rows_add(of_supports->triangle, row);
        of_supports->rows++;
    }
    return of_supports->rows >= of_supports->next_look ? test_whether_enough(ctx, of_supports) : OST_SUCCESS;
}

static OstStatus add_bed(const OstSupports *supports, OstLocal node, const OstRigidFrame *frame, const double *point,
                         BedConditions *of_bed)
{
    double smooth[9], facets[9], row[6];
    OST_TRY(ost_bed_directions(supports, node, facets, smooth));
    for (int k = 0; k < 3; k++) {
        ost_rows_of_point(frame, point, smooth + 3 * k, row);
        ost_rows_add(of_bed->smooth, row);
        ost_rows_of_point(frame, point, facets + 3 * k, row);
        ost_rows_add(of_bed->facets, row);
        of_bed->any |= ost_norm3(facets + 3 * k) > 0.0;
    }
    return OST_SUCCESS;
}

/* Of a node in the component: its constraints, and the directions of its springs. `of_bed` may be NULL. */
static OstStatus add_node(const OstMesh *mesh, const OstSupports *supports, OstLocal node, const OstRigidFrame *frame,
                          SupportConditions *of_supports, BedConditions *of_bed)
{
    const double *point = mesh->coordinates + 3 * (size_t)node;
    OstSupport held;
    if (supports->index[node] >= 0)
        OST_TRY(add_support(mesh->ctx, frame, &supports->support[supports->index[node]], point, of_supports));
    if (!supports->spring || (of_supports->rows > 0 && of_supports->next_look == 0))
        return OST_SUCCESS;
    OST_TRY(ost_spring_directions(supports, node, &held));
    if (held.constrained > 0)
        OST_TRY(add_support(mesh->ctx, frame, &held, point, of_supports));
    return of_bed ? add_bed(supports, node, frame, point, of_bed) : OST_SUCCESS;
}

static OstStatus collect_supports(const OstMesh *mesh, const OstSupports *supports, const NodeComponents *of,
                                  const OstRigidFrame *frames, SupportConditions *of_supports, BedConditions *of_beds)
{
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const OstLocal p = of->lowest ? of->lowest[n] : 0;
        OST_TRY(add_node(mesh, supports, n, &frames[p], &of_supports[p], of_beds ? &of_beds[p] : NULL));
    }
    for (OstLocal m = 0; m < of->meetings; m++) {
        const OstLocal p = of->meeting[m].component;
        OST_TRY(
            add_node(mesh, supports, of->meeting[m].node, &frames[p], &of_supports[p], of_beds ? &of_beds[p] : NULL));
    }
    return OST_SUCCESS;
}

/* A follower elsewhere than its leaders, of one component: both move alike, so that the component does not turn.
 * `held`: it has no leaders, and does not move. */
static void add_pair(const OstMesh *mesh, const OstLink *link, int held, const OstRigidFrame *frame,
                     SupportConditions *of_supports)
{
    for (int i = 0; i < 3; i++) {
        double direction[3] = {i == 0, i == 1, i == 2}, here[6], there[6];
        ost_rows_of_point(frame, mesh->coordinates + 3 * (size_t)link->node, direction, here);
        ost_rows_of_point(frame, link->place, direction, there);
        for (int k = 0; k < 6; k++)
            here[k] -= held ? 0.0 : there[k];
        ost_rows_add(of_supports->triangle, here);
        of_supports->rows++;
    }
}

/* What of a rigid face's motion is prescribed, at its point. */
static void add_face(const OstRigidFace *face, const OstRigidFrame *frame, SupportConditions *of_supports)
{
    for (int k = 0; k < 6; k++) {
        double direction[3] = {k % 3 == 0, k % 3 == 1, k % 3 == 2}, row[6] = {0.0};
        if (!face->constrained[k])
            continue;
        if (k < 3)
            ost_rows_of_point(frame, face->point, direction, row);
        else
            row[k] = 1.0;
        ost_rows_add(of_supports->triangle, row);
        of_supports->rows++;
    }
}

static void add_links(const OstMesh *mesh, const OstLinks *links, const OstLocal *leading, const NodeComponents *of,
                      const OstRigidFrame *frames, SupportConditions *of_supports)
{
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        const OstLocal own = of->lowest ? of->lowest[link->node] : 0;
        if (leading[i] == own || leading[i] < 0)
            add_pair(mesh, link, leading[i] < 0, &frames[own], &of_supports[own]);
    }
    for (int f = 0; f < links->face_count; f++) {
        const OstGlobal node = links->face[f].first - mesh->first_node;
        if (node >= 0 && node < mesh->owned_nodes) {
            const OstLocal own = of->lowest ? of->lowest[node] : 0;
            add_face(&links->face[f], &frames[own], &of_supports[own]);
        }
    }
}

static int starts_pair(const NodeComponents *of, OstLocal m)
{
    return m == 0 || of->meeting[m].low != of->meeting[m - 1].low ||
           of->meeting[m].component != of->meeting[m - 1].component;
}

/* Components that share a node move alike there in all three directions. */
static void tie_meeting(const OstMesh *mesh, const OstRigidFrame *frames, OstLocal node, OstTie *tie)
{
    for (int i = 0; i < 3; i++) {
        double direction[3] = {0.0};
        double row[6];
        direction[i] = 1.0;
        ost_rows_of_point(ost_tie_frame(frames, tie), mesh->coordinates + 3 * (size_t)node, direction, row);
        ost_rows_add(tie->triangle, row);
    }
}

static void list_tie(OstTies *ties, OstLocal component, OstLocal other, const double triangle[OST_ROWS])
{
    OstTie *tie = &ties->tie[ties->count++];
    tie->body[0] = component;
    tie->body[1] = other;
    memcpy(tie->triangle, triangle, sizeof tie->triangle);
}

static OstStatus list_ties(const OstMesh *mesh, const OstComponents *components, const NodeComponents *of,
                           const OstRigidFrame *frames, const SupportConditions *of_supports,
                           const BedConditions *of_beds, OstTies *ties)
{
    OstLocal count = 0;
    for (OstLocal p = 0; p < components->count; p++)
        count += (of_supports[p].rows > 0) + (of_beds && of_beds[p].any ? 2 : 0);
    for (OstLocal m = 0; m < of->meetings; m++)
        count += starts_pair(of, m);
    OST_TRY(OST_NEW(mesh->ctx, &ties->tie, count));
    for (OstLocal p = 0; p < components->count; p++) {
        if (of_supports[p].rows > 0)
            list_tie(ties, p, OST_TIE_SUPPORT, of_supports[p].triangle);
        if (!of_beds || !of_beds[p].any)
            continue;
        list_tie(ties, p, OST_TIE_SMOOTH, of_beds[p].smooth);
        list_tie(ties, p, OST_TIE_FACETS, of_beds[p].facets);
    }
    for (OstLocal m = 0; m < of->meetings; m++) {
        if (starts_pair(of, m)) {
            ties->tie[ties->count].body[0] = of->meeting[m].low;
            ties->tie[ties->count++].body[1] = of->meeting[m].component;
        }
        tie_meeting(mesh, frames, of->meeting[m].node, &ties->tie[ties->count - 1]);
    }
    return OST_SUCCESS;
}

static OstStatus list_mine(const OstMesh *mesh, const OstSupports *supports, const OstComponents *components,
                           const OstRigidFrame *frames, OstTies *ties)
{
    NodeComponents of = {0};
    SupportConditions *of_supports = NULL;
    BedConditions *of_beds = NULL;
    OstLocal *leading = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(mesh->ctx, find_meetings(mesh, components, &of)));
    if (supports->links) {
        OST_TRY_DONE(find_leading(mesh, supports->links, &of, &leading));
        OST_TRY_DONE(meet_at_links(mesh, supports->links, leading, &of));
    }
    OST_TRY_DONE(OST_NEW(mesh->ctx, &of_supports, components->count));
    if (supports->bed)
        OST_TRY_DONE(OST_NEW(mesh->ctx, &of_beds, components->count));
    OST_TRY_DONE(collect_supports(mesh, supports, &of, frames, of_supports, of_beds));
    if (supports->links)
        add_links(mesh, supports->links, leading, &of, frames, of_supports);
    OST_TRY_DONE(list_ties(mesh, components, &of, frames, of_supports, of_beds, ties));
done:
    OST_FREE(leading);
    OST_FREE(of_beds);
    OST_FREE(of_supports);
    OST_FREE(of.lowest);
    OST_FREE(of.meeting);
    return status;
}

/* Ties of the same bodies from several ranks become one. */
static void unite(OstTies *ties)
{
    OstLocal kept = 0;
    if (ties->count > 0)
        qsort(ties->tie, (size_t)ties->count, sizeof *ties->tie, compare_ties);
    for (OstLocal i = 0; i < ties->count; i++) {
        if (kept > 0 && compare_ties(&ties->tie[kept - 1], &ties->tie[i]) == 0) {
            for (int r = 0; r < 6; r++)
                ost_rows_add(ties->tie[kept - 1].triangle, ties->tie[i].triangle + 6 * r);
        } else {
            ties->tie[kept++] = ties->tie[i];
        }
    }
    ties->count = kept;
}

OstStatus ost_ties_create(const OstMesh *mesh, const OstSupports *supports, const OstComponents *components,
                          const OstRigidFrame *frames, OstTies *ties)
{
    OstTies mine = {0};
    *ties = (OstTies){0};
    OstStatus status = ost_agree(mesh->ctx, list_mine(mesh, supports, components, frames, &mine));
    OST_THEN(ost_gather_items(mesh->ctx, sizeof *mine.tie, mine.tie, mine.count,
                              "the mesh falls into too many components to check their constraints", (void **)&ties->tie,
                              &ties->count));
    if (status == OST_SUCCESS)
        unite(ties);
    OST_THEN(ost_agree(mesh->ctx, ost_ties_settle_beds(mesh->ctx, ties)));
    if (status != OST_SUCCESS)
        ost_ties_release(ties);
    ost_ties_release(&mine);
    return status;
}
