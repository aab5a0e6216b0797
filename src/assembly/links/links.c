/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/links.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

OstStatus ost_links_create(const OstMesh *mesh, OstLinks **links)
{
    OstContext *ctx = mesh->ctx;
    OST_TRY(OST_NEW(ctx, links, 1));
    (*links)->ctx = ctx;
    (*links)->mesh = mesh;
    (*links)->of_face = -1;
    OstStatus status = OST_NEW(ctx, &(*links)->of_node, mesh->node_count);
    OST_THEN(OST_NEW(ctx, &(*links)->leads, mesh->node_count));
    OST_THEN(OST_NEW(ctx, &(*links)->kept, mesh->owned_nodes));
    OST_THEN(OST_NEW(ctx, &(*links)->offset, 3 * (size_t)mesh->node_count));
    for (OstLocal n = 0; n < mesh->node_count && status == OST_SUCCESS; n++)
        (*links)->of_node[n] = -1;
    if (status != OST_SUCCESS)
        ost_links_destroy(links);
    return status;
}

void ost_links_destroy(OstLinks **links)
{
    if (!*links)
        return;
    OST_FREE((*links)->link);
    OST_FREE((*links)->held);
    OST_FREE((*links)->lever);
    ost_halo_destroy(&(*links)->of_links);
    OST_FREE((*links)->of_node);
    OST_FREE((*links)->leads);
    OST_FREE((*links)->kept);
    OST_FREE((*links)->offset);
    OST_FREE((*links)->face);
    ost_halo_destroy(&(*links)->halo);
    OST_FREE(*links);
}

static OstStatus make_room(OstLinks *links, OstLocal count)
{
    if (count <= links->capacity)
        return OST_SUCCESS;
    const OstLocal capacity = count + links->capacity / 2 + 64;
    OST_TRY(OST_RESIZE(links->ctx, &links->link, capacity));
    links->capacity = capacity;
    return OST_SUCCESS;
}

OstStatus ost_links_add(OstLinks *links, OstLocal node, int count, const OstLeader *leader, const double place[3],
                        const double offset[3])
{
    const long long label = (long long)ost_mesh_node_number(links->mesh, node);
    if (links->of_node[node] >= 0)
        return OST_RAISE(links->ctx, OST_INVALID_INPUT,
                         "vertex %lld is to follow two others: two of tied, periodic and rigid faces meet there; leave "
                         "it out of one of them",
                         label);
    OST_TRY(make_room(links, links->count + 1));
    OstLink *link = &links->link[links->count];
    *link = (OstLink){.node = node,
                      .count = count,
                      .line = links->line,
                      .between_meshes = links->between_meshes,
                      .face = links->of_face};
    memcpy(link->leader, leader, (size_t)count * sizeof *leader);
    memcpy(link->place, place, sizeof link->place);
    memcpy(links->offset + 3 * (size_t)node, offset, 3 * sizeof *offset);
    links->of_node[node] = links->count++;
    return OST_SUCCESS;
}

void ost_links_add_corners(OstLinks *links, int count, const OstGlobal *corner, const double (*weight)[9])
{
    OstLink *link = &links->link[links->count - 1];
    link->corners = count;
    memcpy(link->corner, corner, (size_t)count * sizeof *corner);
    memcpy(link->corner_weight, weight, (size_t)count * sizeof *weight);
}

OstStatus ost_links_add_face(OstLinks *links, const OstRigidFace *face)
{
    OST_TRY(OST_RESIZE(links->ctx, &links->face, links->face_count + 1));
    links->face[links->face_count++] = *face;
    for (int k = 0; k < 2; k++) {
        const OstGlobal local = face->carrier[k] - links->mesh->first_node;
        if (face->carrier[k] >= 0 && local >= 0 && local < links->mesh->owned_nodes)
            links->kept[local] = 1;
    }
    return OST_SUCCESS;
}

OstStatus ost_links_add_lever(OstLinks *links, const OstLever *lever)
{
    OST_TRY(OST_GROW(links->ctx, &links->lever, links->lever_count + 1));
    links->lever[links->lever_count++] = *lever;
    links->gaps = 1;
    return OST_SUCCESS;
}

void ost_rigid_face_weight(const OstRigidFace *face, const double arm[3], double weight[9])
{
    for (int k = 0; k < 3; k++) {
        const double axis[3] = {k == 0, k == 1, k == 2};
        double moved[3];
        ost_cross3(axis, arm, moved);
        for (int i = 0; i < 3; i++)
            weight[3 * i + k] = face->constrained[3 + k] ? 0.0 : moved[i] / face->length;
    }
}

/* Numbers the links of ghosts after those of owned nodes, in the order of nodes, as ost_halo_subset needs it. */
static OstStatus order_links(OstLinks *links, OstLocal *order)
{
    const OstMesh *mesh = links->mesh;
    OstLink *ordered = NULL;
    memcpy(order, links->of_node, (size_t)mesh->owned_nodes * sizeof *order);
    OST_TRY(ost_halo_import(mesh->halo, sizeof *order, order));
    links->all = 0;
    for (OstLocal n = 0; n < mesh->node_count; n++)
        order[n] = order[n] < 0 ? -1 : links->all++;
    OST_TRY(OST_NEW(links->ctx, &ordered, links->all));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        if (order[n] >= 0)
            ordered[order[n]] = links->link[links->of_node[n]];
    OST_FREE(links->link);
    links->link = ordered;
    links->capacity = links->all;
    memcpy(links->of_node, order, (size_t)mesh->node_count * sizeof *order);
    for (OstLocal n = 0; n < mesh->node_count; n++)
        if (order[n] >= 0)
            links->link[order[n]].node = n;
    return OST_SUCCESS;
}

/* Leader by leader: a whole link is longer than what a halo carries. */
OstStatus ost_links_share_weights(OstLinks *links)
{
    OstLeader *leader = NULL;
    OstStatus status = ost_agree(links->ctx, OST_NEW(links->ctx, &leader, links->all));
    for (int k = 0; k < OST_MOST_LEADERS && status == OST_SUCCESS; k++) {
        for (OstLocal i = 0; i < links->count; i++)
            leader[i] = links->link[i].leader[k];
        status = ost_agree(links->ctx, ost_halo_import(links->of_links, sizeof *leader, leader));
        for (OstLocal i = links->count; i < links->all; i++)
            links->link[i].leader[k] = leader[i];
    }
    OST_FREE(leader);
    return status;
}

static OstStatus share_links(OstLinks *links)
{
    int *of = NULL; /* how many leaders a link has, whether it is between meshes, and its face */
    OstStatus status = OST_NEW(links->ctx, &of, 3 * (size_t)links->all);
    OST_TRY_DONE(ost_agree(links->ctx, status));
    for (OstLocal i = 0; i < links->count; i++)
        memcpy(of + 3 * (size_t)i, (int[]){links->link[i].count, links->link[i].between_meshes, links->link[i].face},
               3 * sizeof *of);
    OST_TRY_DONE(ost_agree(links->ctx, ost_halo_import(links->of_links, 3 * sizeof *of, of)));
    OST_TRY_DONE(ost_links_share_weights(links));
    for (OstLocal i = links->count; i < links->all; i++) {
        links->link[i].count = of[3 * (size_t)i];
        links->link[i].between_meshes = of[3 * (size_t)i + 1];
        links->link[i].face = of[3 * (size_t)i + 2];
    }
done:
    OST_FREE(of);
    return status;
}

static OstStatus share_with_ghosts(OstLinks *links)
{
    OstContext *ctx = links->ctx;
    OstLocal *order = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &order, links->mesh->node_count));
    OST_THEN(ost_agree(ctx, order_links(links, order)));
    OST_THEN(ost_agree(ctx, ost_halo_subset(links->mesh->halo, order, &links->of_links)));
    OST_THEN(share_links(links));
    OST_FREE(order);
    return status;
}

static int is_mine(const OstLinks *links, OstGlobal number)
{
    return number >= links->mesh->first_node && number < links->mesh->first_node + links->mesh->owned_nodes;
}

/* The leaders of other ranks, ascending, each once. */
static OstStatus list_far_leaders(const OstLinks *links, OstGlobal **number, OstLocal *count)
{
    *count = 0;
    OST_TRY(OST_NEW(links->ctx, number, (OST_MOST_LEADERS + OST_MOST_CORNERS) * (size_t)links->all));
    for (OstLocal i = 0; i < links->all; i++) {
        for (int k = 0; k < links->link[i].count; k++)
            if (!is_mine(links, links->link[i].leader[k].number))
                (*number)[(*count)++] = links->link[i].leader[k].number;
        for (int k = 0; k < links->link[i].corners; k++)
            if (!is_mine(links, links->link[i].corner[k]))
                (*number)[(*count)++] = links->link[i].corner[k];
    }
    *count = ost_numbers_sort(*count, *number);
    return OST_SUCCESS;
}

static OstLocal slot_of_number(const OstLinks *links, OstLocal count, const OstGlobal *far, OstGlobal number)
{
    return is_mine(links, number) ? (OstLocal)(number - links->mesh->first_node)
                                  : links->mesh->owned_nodes + ost_numbers_find(count, far, number);
}

static OstStatus connect_leaders(OstLinks *links)
{
    const OstMesh *mesh = links->mesh;
    OstGlobal *far = NULL;
    OstLocal count = 0;
    OstStatus status = ost_agree(links->ctx, list_far_leaders(links, &far, &count));
    OST_THEN(ost_agree(links->ctx,
                       ost_halo_create(links->ctx, mesh->owned_nodes, mesh->first_node, count, far, &links->halo)));
    links->slots = mesh->owned_nodes + count;
    for (OstLocal i = 0; i < links->all && status == OST_SUCCESS; i++) {
        OstLink *link = &links->link[i];
        for (int k = 0; k < link->count; k++)
            link->slot[k] = slot_of_number(links, count, far, link->leader[k].number);
        for (int k = 0; k < link->corners; k++)
            link->corner_slot[k] = slot_of_number(links, count, far, link->corner[k]);
    }
    OST_FREE(far);
    return status;
}

/* What a leader has to say: does it follow others itself, and how is it held? */
typedef struct Leading {
    OstHeld held;
    int follows;
} Leading;

static OstStatus raise_of(const OstLinks *links, const OstLink *link, const char *text)
{
    const double *x = links->mesh->coordinates + 3 * (size_t)link->node;
    char where[OST_ERROR_TEXT_SIZE / 2] = "";
    if (links->path)
        snprintf(where, sizeof where, "%s:%d: ", links->path, link->line);
    return OST_RAISE(links->ctx, OST_INVALID_INPUT, "%svertex %lld at (%g, %g, %g) %s", where,
                     (long long)ost_mesh_node_number(links->mesh, link->node), x[0], x[1], x[2], text);
}

static OstStatus keep_held(OstLinks *links, const OstLink *link, int k, const double weight[9])
{
    OST_TRY(OST_GROW(links->ctx, &links->held, links->held_count + 1));
    OstHeldWeight *held = &links->held[links->held_count++];
    *held = (OstHeldWeight){.node = link->node, .leader = k};
    for (int i = 0; i < 9; i++)
        held->weight[i] = weight[i] - link->leader[k].weight[i];
    return OST_SUCCESS;
}

/* The leaders' own supports: u = W (P v + g). */
static OstStatus take_leader(OstLinks *links, const Leading *leading, OstLink *link, int k)
{
    const Leading *of = &leading[link->slot[k]];
    double weight[9], moved[3];
    if (of->follows)
        return raise_of(links, link,
                        "follows one that itself follows another (tied, periodic or rigid faces meet); exchange the "
                        "two faces of a pair, leave the edge out of one selection, or, where a tie leads to a rigid "
                        "face, let one rigid face have both selections in place of the tie");
    memcpy(weight, link->leader[k].weight, sizeof weight);
    ost_multiply3(weight, of->held.projector, link->leader[k].weight);
    ost_apply3(weight, of->held.prescribed, moved);
    for (int i = 0; i < 3; i++)
        links->offset[3 * (size_t)link->node + (size_t)i] += moved[i];
    return of->held.constrained ? keep_held(links, link, k, weight) : OST_SUCCESS;
}

/* A follower is at rest in the directions that it is held in, if its leaders are: as at the common edge of two tied
 * parts that are clamped there, or lie on a plane of symmetry. */
static int is_held_by_leaders(const OstLinks *links, const Leading *leading, const OstLink *link)
{
    static const double rounding = 1e-9;
    const OstHeld *own = &leading[link->node].held;
    double largest = ost_norm3(own->prescribed) + ost_norm3(links->offset + 3 * (size_t)link->node);
    if (link->face >= 0) /* the rows of its leaders are a rigid motion's */
        return 0;
    for (int k = 0; k < link->count && largest == 0.0; k++) {
        const double *weight = link->leader[k].weight;
        double left[9];
        ost_multiply3(own->projector, weight, left);
        for (int i = 0; i < 9; i++)
            largest = fmax(largest, fabs(weight[i] - left[i]));
        largest = largest < rounding ? ost_norm3(leading[link->slot[k]].held.prescribed) : largest;
    }
    return largest == 0.0;
}

/* What its leaders do for it, its own supports need not. */
static OstStatus check_follower(const OstLinks *links, const Leading *leading, const OstLink *link, OstHeld *held)
{
    if (held->constrained == 0)
        return OST_SUCCESS;
    held->constrained = 0;
    return is_held_by_leaders(links, leading, link)
               ? OST_SUCCESS
               : raise_of(links, link,
                          "follows others here (a tied, periodic or rigid face), and is constrained besides; leave it "
                          "out of one of them, or constrain those that it follows");
}

/* Collective. Only own links: ghosts get theirs later. */
static OstStatus take_supports(OstLinks *links, OstHeld *held)
{
    const OstMesh *mesh = links->mesh;
    Leading *leading = NULL;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &leading, links->slots)));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        leading[n].held = held[n];
        leading[n].follows = links->of_node[n] >= 0 && !links->kept[n];
    }
    OstStatus status = ost_agree(links->ctx, ost_halo_import(links->halo, sizeof *leading, leading));
    for (OstLocal i = 0; i < links->count && status == OST_SUCCESS; i++) {
        for (int k = 0; k < links->link[i].count && status == OST_SUCCESS; k++)
            status = take_leader(links, leading, &links->link[i], k);
        OST_THEN(check_follower(links, leading, &links->link[i], &held[links->link[i].node]));
    }
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        const OstLink *link = ost_link_of(links, links->lever[i].node);
        for (int k = 0; k < link->count; k++)
            memcpy(links->lever[i].projector[k], leading[link->slot[k]].held.projector, 9 * sizeof(double));
    }
    OST_FREE(leading);
    return ost_agree(links->ctx, status);
}

static OstStatus mark_leaders(OstLinks *links)
{
    double *marks = NULL;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &marks, links->slots)));
    for (OstLocal i = 0; i < links->count; i++)
        for (int k = 0; k < links->link[i].count; k++)
            marks[links->link[i].slot[k]] += 1.0;
    const OstStatus status = ost_agree(links->ctx, ost_halo_add_to_owners(links->halo, 1, marks));
    for (OstLocal n = 0; n < links->mesh->owned_nodes; n++)
        links->leads[n] = marks[n] > 0.0;
    OST_FREE(marks);
    return status == OST_SUCCESS ? ost_agree(links->ctx, ost_halo_import(links->mesh->halo, 1, links->leads)) : status;
}

OstStatus ost_links_complete(OstLinks *links, OstHeld *held)
{
    int moves = 0;
    links->all = links->count;
    OST_TRY(connect_leaders(links)); /* of own links: their supports change the weights that ghosts get */
    OST_TRY(take_supports(links, held));
    ost_halo_destroy(&links->halo);
    OST_TRY(share_with_ghosts(links));
    OST_TRY(connect_leaders(links));
    OST_TRY(mark_leaders(links));
    OST_TRY(ost_agree(links->ctx, ost_halo_import(links->mesh->halo, 3 * sizeof(double), links->offset)));
    for (size_t i = 0; i < 3 * (size_t)links->mesh->owned_nodes; i++)
        moves |= links->offset[i] != 0.0;
    links->moves = moves;
    OST_TRY(ost_max_ints(links->ctx, 1, &links->gaps));
    return ost_max_ints(links->ctx, 1, &links->moves);
}

OstStatus ost_links_follow(const OstLinks *links, double *of_leaders, double *u)
{
    OST_TRY(ost_agree(links->ctx, ost_halo_import(links->halo, 3 * sizeof(double), of_leaders)));
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        for (int k = 0; k < link->count; k++) {
            double moved[3];
            ost_apply3(link->leader[k].weight, of_leaders + 3 * (size_t)link->slot[k], moved);
            for (int c = 0; c < 3; c++)
                u[3 * (size_t)link->node + (size_t)c] += moved[c];
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_links_gather(const OstLinks *links, const double *force, double *of_leaders)
{
    memset(of_leaders, 0, 3 * (size_t)links->slots * sizeof *of_leaders);
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        for (int k = 0; k < link->count; k++) {
            double part[3];
            ost_apply3_transposed(link->leader[k].weight, force + 3 * (size_t)link->node, part);
            for (int c = 0; c < 3; c++)
                of_leaders[3 * (size_t)link->slot[k] + (size_t)c] += part[c];
        }
    }
    return ost_agree(links->ctx, ost_halo_add_to_owners(links->halo, 3, of_leaders));
}

static OstLocal slot_of(const OstLinks *links, const OstHeldWeight *held)
{
    return ost_link_of(links, held->node)->slot[held->leader];
}

OstStatus ost_links_follow_held(const OstLinks *links, double *of_leaders, double *u)
{
    OST_TRY(ost_agree(links->ctx, ost_halo_import(links->halo, 3 * sizeof(double), of_leaders)));
    for (OstLocal i = 0; i < links->held_count; i++) {
        const OstHeldWeight *held = &links->held[i];
        double moved[3];
        ost_apply3(held->weight, of_leaders + 3 * (size_t)slot_of(links, held), moved);
        for (int c = 0; c < 3; c++)
            u[3 * (size_t)held->node + (size_t)c] += moved[c];
    }
    return OST_SUCCESS;
}

OstStatus ost_links_gather_held(const OstLinks *links, const double *force, double *of_leaders)
{
    memset(of_leaders, 0, 3 * (size_t)links->slots * sizeof *of_leaders);
    for (OstLocal i = 0; i < links->held_count; i++) {
        const OstHeldWeight *held = &links->held[i];
        double part[3];
        ost_apply3_transposed(held->weight, force + 3 * (size_t)held->node, part);
        for (int c = 0; c < 3; c++)
            of_leaders[3 * (size_t)slot_of(links, held) + (size_t)c] += part[c];
    }
    return ost_agree(links->ctx, ost_halo_add_to_owners(links->halo, 3, of_leaders));
}
