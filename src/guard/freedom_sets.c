/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "guard/freedom_report.h"

#include <math.h>
#include <string.h>

/* Motions that differ by less than this share are the same. */
static const double same = 1e-6;

/* Splits a cluster's motions by the sets of components that move as one. Members that always move alike form a group;
 * groups are the nodes of a graph whose edges are joints. Sets examined: the whole graph, and each side of an edge
 * whose removal splits it. */
typedef struct Sets {
    const OstLinkage *linkage;
    const OstFreeMotions *free;
    int groups;
    int *group;           /* of each member */
    int *leader;          /* groups: the member with the largest frame, whose motions stand for the group */
    unsigned char *still; /* groups */
    unsigned char *in;    /* groups: in the set that is examined */
    int *stack;           /* groups */
    double *rows;         /* 6 members × count, and room for the coefficients found: count × count */
    double *basis;        /* count × count */
    double *found;        /* coefficients of the motions reported so far, not orthonormal: found_count × count */
    int found_count, found_rank;
    OstLocal *listed; /* members of the set */
} Sets;

static const double *motion_of(const Sets *sets, int vector, int member)
{
    return sets->free->motion + ((size_t)vector * (size_t)sets->free->members + (size_t)member) * 6;
}

static const OstRigidFrame *frame_of(const Sets *sets, int member)
{
    return &sets->linkage->frames[sets->free->member[member]];
}

/* The motion of member a less that of member b, in the frame of b. */
static void difference(const Sets *sets, int vector, int a, int b, const double change[OST_ROWS], double d[6])
{
    const double *x = motion_of(sets, vector, a);
    const double *y = motion_of(sets, vector, b);
    for (int i = 0; i < 6; i++) {
        d[i] = -y[i];
        for (int k = 0; k < 6; k++)
            d[i] += change[6 * i + k] * x[k];
    }
}

static int move_alike(const Sets *sets, int a, int b)
{
    const int larger = frame_of(sets, a)->radius >= frame_of(sets, b)->radius ? a : b;
    const int smaller = larger == a ? b : a;
    double change[OST_ROWS];
    ost_rows_change_frame(frame_of(sets, larger), frame_of(sets, smaller), change);
    for (int m = 0; m < sets->free->count; m++) {
        double d[6];
        difference(sets, m, larger, smaller, change, d);
        for (int i = 0; i < 6; i++)
            if (fabs(d[i]) > same)
                return 0;
    }
    return 1;
}

static int is_still(const Sets *sets, int member)
{
    for (int m = 0; m < sets->free->count; m++)
        for (int i = 0; i < 6; i++)
            if (fabs(motion_of(sets, m, member)[i]) > same)
                return 0;
    return 1;
}

static void find_groups(Sets *sets)
{
    for (int i = 0; i < sets->free->members; i++) {
        int g = 0;
        while (g < sets->groups && !move_alike(sets, sets->leader[g], i))
            g++;
        if (g == sets->groups) {
            sets->leader[sets->groups] = i;
            sets->still[sets->groups++] = (unsigned char)is_still(sets, i);
        }
        sets->group[i] = g;
        if (frame_of(sets, i)->radius > frame_of(sets, sets->leader[g])->radius)
            sets->leader[g] = i;
    }
}

/* The groups still connected to group `from` when its edge to group `without` is removed. */
static void reach(Sets *sets, int from, int without)
{
    const OstLinkage *linkage = sets->linkage;
    int height = 0;
    memset(sets->in, 0, (size_t)sets->groups);
    sets->in[from] = 1;
    sets->stack[height++] = from;
    while (height > 0) {
        const int g = sets->stack[--height];
        for (int i = 0; i < sets->free->members; i++) {
            const OstLocal component = sets->free->member[i];
            for (OstLocal j = linkage->joint_start[component];
                 sets->group[i] == g && j < linkage->joint_start[component + 1]; j++) {
                const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
                const int other =
                    ost_place_of(sets->free->members, sets->free->member, ost_linkage_neighbour(tie, component));
                const int h = other < 0 ? g : sets->group[other];
                if (sets->in[h] || (g == from && h == without))
                    continue;
                sets->in[h] = 1;
                sets->stack[height++] = h;
            }
        }
    }
}

/* The set's member with the largest frame. */
static int leader_of_set(const Sets *sets)
{
    int leader = -1;
    for (int g = 0; g < sets->groups; g++)
        if (sets->in[g] && (leader < 0 || frame_of(sets, sets->leader[g])->radius > frame_of(sets, leader)->radius))
            leader = sets->leader[g];
    return leader;
}

/* Conditions on the coefficients of the free motions: nothing outside the set moves, and all in it move alike. */
static void fill_conditions(const Sets *sets, int leader)
{
    const int count = sets->free->count;
    for (int i = 0; i < sets->free->members; i++) {
        double change[OST_ROWS];
        ost_rows_change_frame(frame_of(sets, leader), frame_of(sets, i), change);
        for (int m = 0; m < count; m++) {
            double d[6];
            memcpy(d, motion_of(sets, m, i), sizeof d);
            if (sets->in[sets->group[i]])
                difference(sets, m, leader, i, change, d);
            for (int r = 0; r < 6; r++)
                sets->rows[(size_t)(6 * i + r) * (size_t)count + (size_t)m] = d[r];
        }
    }
}

/* The rank of the motions reported so far together with `more` new ones. */
static OstStatus rank_with(Sets *sets, int more, int *rank)
{
    const size_t count = (size_t)sets->free->count;
    const int rows = sets->found_count + more;
    int rest = 0;
    memcpy(sets->rows, sets->found, (size_t)rows * count * sizeof *sets->rows);
    OST_TRY(ost_null_space(sets->linkage->ctx, rows, sets->free->count, sets->rows, same, &rest, sets->basis));
    *rank = sets->free->count - rest;
    return OST_SUCCESS;
}

static OstStatus report_set(Sets *sets, int leader, int count, OstFreedomReport *report)
{
    const int vectors = sets->free->count;
    const double *coefficients = sets->found + (size_t)sets->found_count * (size_t)vectors;
    double motions[36] = {0.0};
    int members = 0;
    for (int i = 0; i < sets->free->members; i++)
        if (sets->in[sets->group[i]])
            sets->listed[members++] = sets->free->member[i];
    for (int c = 0; c < count; c++)
        for (int m = 0; m < vectors; m++)
            for (int i = 0; i < 6; i++)
                motions[6 * c + i] +=
                    coefficients[(size_t)c * (size_t)vectors + (size_t)m] * motion_of(sets, m, leader)[i];
    return ost_freedom_report_line(sets->linkage, members, sets->listed, frame_of(sets, leader), count, motions,
                                   report);
}

/* Reports how the set moves by itself, unless that was reported already. */
static OstStatus examine_set(Sets *sets, OstFreedomReport *report)
{
    const size_t vectors = (size_t)sets->free->count;
    const int leader = leader_of_set(sets);
    int count = 0;
    int rank = 0;
    if (leader < 0)
        return OST_SUCCESS;
    fill_conditions(sets, leader);
    OST_TRY(ost_null_space(sets->linkage->ctx, 6 * sets->free->members, sets->free->count, sets->rows, same, &count,
                           sets->basis));
    if (count == 0 || count > 6)
        return OST_SUCCESS;
    memcpy(sets->found + (size_t)sets->found_count * vectors, sets->basis, (size_t)count * vectors * sizeof(double));
    OST_TRY(rank_with(sets, count, &rank));
    if (rank == sets->found_rank)
        return OST_SUCCESS;
    OST_TRY(report_set(sets, leader, count, report));
    sets->found_rank = rank;
    sets->found_count += count;
    return OST_SUCCESS;
}

static void complement(Sets *sets)
{
    for (int g = 0; g < sets->groups; g++)
        sets->in[g] = !sets->in[g];
}

static int has_still_group(const Sets *sets)
{
    for (int g = 0; g < sets->groups; g++)
        if (sets->in[g] && sets->still[g])
            return 1;
    return 0;
}

/* If removing the edge between two groups splits the graph, examines the side that can move by itself: the one without
 * groups that do not move, or else the one without the first group. */
static OstStatus examine_side(Sets *sets, int a, int b, OstFreedomReport *report)
{
    reach(sets, b, a);
    if (sets->in[a])
        return OST_SUCCESS;
    if (has_still_group(sets)) {
        complement(sets);
        if (has_still_group(sets))
            return OST_SUCCESS;
    } else if (sets->in[0]) {
        complement(sets);
        if (has_still_group(sets))
            complement(sets);
    }
    return examine_set(sets, report);
}

static OstStatus examine_sides(Sets *sets, OstFreedomReport *report)
{
    const OstLinkage *linkage = sets->linkage;
    for (int i = 0; i < sets->free->members; i++) {
        const OstLocal component = sets->free->member[i];
        for (OstLocal j = linkage->joint_start[component]; j < linkage->joint_start[component + 1]; j++) {
            const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
            const int other =
                ost_place_of(sets->free->members, sets->free->member, ost_linkage_neighbour(tie, component));
            if (sets->found_rank == sets->free->count)
                return OST_SUCCESS;
            if (other > i && sets->group[i] != sets->group[other])
                OST_TRY(examine_side(sets, sets->group[i], sets->group[other], report));
        }
    }
    return OST_SUCCESS;
}

static OstStatus make_room(Sets *sets)
{
    OstContext *ctx = sets->linkage->ctx;
    const size_t members = (size_t)sets->free->members;
    const size_t count = (size_t)sets->free->count;
    const size_t reported = count + 6; /* each set reported raises the rank, but may bring six */
    OST_TRY(OST_NEW(ctx, &sets->group, members));
    OST_TRY(OST_NEW(ctx, &sets->leader, members));
    OST_TRY(OST_NEW(ctx, &sets->still, members));
    OST_TRY(OST_NEW(ctx, &sets->in, members));
    OST_TRY(OST_NEW(ctx, &sets->stack, members));
    OST_TRY(OST_NEW(ctx, &sets->listed, members));
    OST_TRY(OST_NEW(ctx, &sets->rows, (6 * members + 6 * reported) * count));
    OST_TRY(OST_NEW(ctx, &sets->basis, count * count));
    return OST_NEW(ctx, &sets->found, 6 * reported * count);
}

static void release(Sets *sets)
{
    OST_FREE(sets->group);
    OST_FREE(sets->leader);
    OST_FREE(sets->still);
    OST_FREE(sets->in);
    OST_FREE(sets->stack);
    OST_FREE(sets->listed);
    OST_FREE(sets->rows);
    OST_FREE(sets->basis);
    OST_FREE(sets->found);
}

OstStatus ost_freedom_report_sets(const OstLinkage *linkage, const OstFreeMotions *free, OstFreedomReport *report)
{
    Sets sets = {.linkage = linkage, .free = free};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(make_room(&sets));
    find_groups(&sets);
    for (int g = 0; g < sets.groups; g++)
        sets.in[g] = !sets.still[g];
    OST_TRY_DONE(examine_set(&sets, report));
    OST_TRY_DONE(examine_sides(&sets, report));
    if (sets.found_rank < free->count)
        ost_freedom_report_rest(linkage, free->members, free->member, free->count - sets.found_rank, report);
done:
    release(&sets);
    return status;
}
