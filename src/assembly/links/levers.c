/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/levers.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

/* The leaders' values, those of other ranks filled in; 3 × slots. `add`: are they places? */
static OstStatus at_slots(const OstLinks *links, const double *values, int add, double **slots)
{
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, slots, 3 * (size_t)links->slots)));
    for (size_t i = 0; i < 3 * (size_t)links->mesh->owned_nodes; i++)
        (*slots)[i] = (values ? values[i] : 0.0) + (add ? links->mesh->coordinates[i] : 0.0);
    return ost_agree(links->ctx, ost_halo_import(links->halo, 3 * sizeof(double), *slots));
}

/* The face where a lever begins. */
typedef struct Frame {
    double tangent[2][3], normal[3], area;
} Frame;

static void find_frame(const OstLever *lever, const OstLink *link, const double *place, Frame *frame)
{
    memset(frame, 0, sizeof *frame);
    for (int k = 0; k < link->count; k++)
        for (int i = 0; i < 6; i++)
            frame->tangent[i / 3][i % 3] += lever->slope[k][i / 3] * place[3 * (size_t)link->slot[k] + (size_t)(i % 3)];
    ost_cross3(frame->tangent[0], frame->tangent[1], frame->normal);
    frame->area = ost_norm3(frame->normal);
    for (int i = 0; i < 3; i++)
        frame->normal[i] /= frame->area;
}

/* The normal's derivative by a tangent is minus its reciprocal times the normal. */
static void find_reciprocal(const Frame *frame, double reciprocal[2][3])
{
    ost_cross3(frame->tangent[1], frame->normal, reciprocal[0]);
    ost_cross3(frame->normal, frame->tangent[0], reciprocal[1]);
    for (int n = 0; n < 6; n++)
        reciprocal[n / 3][n % 3] /= frame->area;
}

/* W(I - P), of what leaders' supports take. */
static void set_held(OstLinks *links, const OstLever *lever, const OstLink *link)
{
    for (OstLocal i = 0; i < links->held_count; i++) {
        OstHeldWeight *held = &links->held[i];
        if (held->node != link->node)
            continue;
        double allowed[9];
        ost_multiply3(lever->weight[held->leader], lever->projector[held->leader], allowed);
        for (int n = 0; n < 9; n++)
            held->weight[n] = lever->weight[held->leader][n] - allowed[n];
    }
}

static void set_weights(OstLinks *links, OstLever *lever, const Frame *frame)
{
    OstLink *link = &links->link[links->of_node[lever->node]];
    double reciprocal[2][3];
    find_reciprocal(frame, reciprocal);
    for (int k = 0; k < link->count; k++) {
        double *weight = lever->weight[k];
        for (int n = 0; n < 9; n++) {
            weight[n] = n % 4 == 0 ? lever->share[k] : 0.0;
            for (int a = 0; a < 2; a++)
                weight[n] -= lever->across * lever->slope[k][a] * reciprocal[a][n / 3] * frame->normal[n % 3];
        }
        ost_multiply3(weight, lever->projector[k], link->leader[k].weight);
    }
    set_held(links, lever, link);
}

OstStatus ost_levers_turn(OstLinks *links, const double *u)
{
    double *place = NULL;
    if (!links || !links->gaps)
        return OST_SUCCESS;
    OstStatus status = at_slots(links, u, 1, &place);
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        Frame frame;
        find_frame(&links->lever[i], ost_link_of(links, links->lever[i].node), place, &frame);
        set_weights(links, &links->lever[i], &frame);
    }
    OST_FREE(place);
    OST_THEN(ost_links_share_weights(links));
    return status;
}

OstStatus ost_levers_put(const OstLinks *links, double *u)
{
    double *place = NULL;
    if (!links || !links->gaps)
        return OST_SUCCESS;
    OstStatus status = at_slots(links, u, 1, &place);
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        const OstLever *lever = &links->lever[i];
        const OstLink *link = ost_link_of(links, lever->node);
        const size_t node = 3 * (size_t)lever->node;
        Frame frame;
        find_frame(lever, link, place, &frame);
        for (size_t c = 0; c < 3; c++) {
            u[node + c] = lever->across * frame.normal[c] - links->mesh->coordinates[node + c];
            for (int k = 0; k < link->count; k++)
                u[node + c] += lever->share[k] * place[3 * (size_t)link->slot[k] + c];
        }
    }
    OST_FREE(place);
    OST_THEN(ost_agree(links->ctx, ost_halo_import(links->mesh->halo, 3 * sizeof(double), u)));
    return status;
}

/* The derivative of the end's place along the changes of its leaders' places. */
static void find_rate(const OstLever *lever, const OstLink *link, const Frame *frame, const double *change,
                      double rate[3])
{
    double reciprocal[2][3];
    find_reciprocal(frame, reciprocal);
    memset(rate, 0, 3 * sizeof *rate);
    for (int k = 0; k < link->count; k++) {
        const double *of_leader = change + 3 * (size_t)link->slot[k], along = ost_dot3(frame->normal, of_leader);
        for (int i = 0; i < 3; i++)
            rate[i] +=
                lever->share[k] * of_leader[i] -
                lever->across * along * (lever->slope[k][0] * reciprocal[0][i] + lever->slope[k][1] * reciprocal[1][i]);
    }
}

OstStatus ost_levers_change(const OstLinks *links, const double *from, double *change)
{
    double *place = NULL, *of_leaders = NULL;
    if (!links || !links->gaps)
        return OST_SUCCESS;
    OstStatus status = at_slots(links, from, 1, &place);
    OST_THEN(at_slots(links, change, 0, &of_leaders));
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        const OstLever *lever = &links->lever[i];
        const OstLink *link = ost_link_of(links, lever->node);
        Frame frame;
        find_frame(lever, link, place, &frame);
        find_rate(lever, link, &frame, of_leaders, change + 3 * (size_t)lever->node);
    }
    OST_FREE(place, of_leaders);
    OST_THEN(ost_agree(links->ctx, ost_halo_import(links->mesh->halo, 3 * sizeof(double), change)));
    return status;
}

static void find_cross(const double v[3], double sign, double matrix[9])
{
    const double cross[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    for (int n = 0; n < 9; n++)
        matrix[n] = sign * cross[n];
}

/* The second derivative of f·n by both tangents, 6 × 6: with N = t_0 × t_1 and p the part of f across n, it is
 * p·N''/|N| - N'(p n' + n p' + (f·n)(I - n n'))N' / |N|². */
static void find_bending(const Frame *frame, const double force[3], double across, double bending[36])
{
    const double along = ost_dot3(force, frame->normal), *n = frame->normal;
    double p[3], q[9], derivative[2][9], mixed[9];
    for (int i = 0; i < 3; i++)
        p[i] = force[i] - along * n[i];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            q[3 * i + j] = -(p[i] * n[j] + n[i] * p[j] + along * ((i == j ? 1.0 : 0.0) - n[i] * n[j])) /
                           (frame->area * frame->area);
    find_cross(frame->tangent[1], -1.0, derivative[0]);
    find_cross(frame->tangent[0], 1.0, derivative[1]);
    find_cross(p, -1.0 / frame->area, mixed);
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            double product[9], block[9];
            ost_multiply3(q, derivative[b], product);
            ost_multiply3_transposed_left(derivative[a], product, block);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    bending[6 * (3 * a + i) + 3 * b + j] = across * (block[3 * i + j] + (a == b  ? 0.0
                                                                                         : a < b ? mixed[3 * i + j]
                                                                                                 : mixed[3 * j + i]));
        }
}

OstStatus ost_levers_bend(const OstLinks *links, const double *u, const double *out_of_balance, int definite,
                          double *bending)
{
    double *place = NULL;
    if (!links || !links->gaps)
        return OST_SUCCESS;
    OstStatus status = at_slots(links, u, 1, &place);
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        const OstLever *lever = &links->lever[i];
        Frame frame;
        find_frame(lever, ost_link_of(links, lever->node), place, &frame);
        find_bending(&frame, out_of_balance + 3 * (size_t)lever->node, lever->across, bending + 36 * (size_t)i);
        if (definite)
            status = ost_symmetric_positive_part(links->ctx, 6, bending + 36 * (size_t)i);
    }
    OST_FREE(place);
    return ost_agree(links->ctx, status);
}

void ost_lever_block(const OstLever *lever, const double bending[36], int k, int l, double block[9])
{
    memset(block, 0, 9 * sizeof *block);
    for (int n = 0; n < 36; n++)
        block[3 * (n / 6 % 3) + n % 3] += lever->slope[k][n / 18] * lever->slope[l][n % 6 / 3] * bending[n];
}

OstStatus ost_levers_multiply(const OstLinks *links, const double *bending, const double *v, double *force)
{
    double *at = NULL, *forces = NULL;
    if (!links || !links->gaps)
        return OST_SUCCESS;
    OstStatus status = at_slots(links, v, 0, &at);
    OST_THEN(ost_agree(links->ctx, OST_NEW(links->ctx, &forces, 3 * (size_t)links->slots)));
    for (OstLocal i = 0; i < links->lever_count && status == OST_SUCCESS; i++) {
        const OstLever *lever = &links->lever[i];
        const OstLink *link = ost_link_of(links, lever->node);
        for (int k = 0; k < link->count; k++)
            for (int l = 0; l < link->count; l++) {
                double block[9], part[3];
                ost_lever_block(lever, bending + 36 * (size_t)i, k, l, block);
                ost_apply3(block, at + 3 * (size_t)link->slot[l], part);
                for (size_t c = 0; c < 3; c++)
                    forces[3 * (size_t)link->slot[k] + c] += part[c];
            }
    }
    OST_THEN(ost_agree(links->ctx, ost_halo_add_to_owners(links->halo, 3, forces)));
    for (size_t i = 0; i < 3 * (size_t)links->mesh->owned_nodes && status == OST_SUCCESS; i++)
        force[i] += forces[i];
    OST_FREE(at, forces);
    return status;
}
