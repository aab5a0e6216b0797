/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_linkage.h"

#include "core/error.h"
#include "core/memory.h"
#include "mesh/union_find.h"

#include <string.h>

void ost_linkage_destroy(OstLinkage **linkage)
{
    if (!*linkage)
        return;
    OST_FREE((*linkage)->joint_start);
    OST_FREE((*linkage)->joint);
    OST_FREE((*linkage)->conditions);
    OST_FREE((*linkage)->fixed);
    OST_FREE((*linkage)->cluster);
    OST_FREE(*linkage);
}

void ost_free_motions_release(OstFreeMotions *free)
{
    OST_FREE(free->member);
    OST_FREE(free->motion);
    free->members = free->count = 0;
}

OstLocal ost_linkage_neighbour(const OstTie *tie, OstLocal component)
{
    return tie->body[0] == component ? tie->body[1] : tie->body[0];
}

static OstStatus list_joints(OstLinkage *linkage)
{
    const OstTies *ties = linkage->ties;
    const OstLocal count = linkage->components->count;
    OST_TRY(OST_NEW(linkage->ctx, &linkage->joint_start, (size_t)count + 2));
    OstLocal *next = linkage->joint_start + 1; /* offset by one: filling moves each start to its place */
    for (OstLocal i = 0; i < ties->count; i++)
        for (int end = 0; end < 2 && ties->tie[i].body[1] != OST_TIE_SUPPORT; end++)
            next[ties->tie[i].body[end] + 1]++;
    for (OstLocal p = 0; p < count; p++)
        next[p + 1] += next[p];
    OST_TRY(OST_NEW(linkage->ctx, &linkage->joint, next[count]));
    for (OstLocal i = 0; i < ties->count; i++)
        for (int end = 0; end < 2 && ties->tie[i].body[1] != OST_TIE_SUPPORT; end++)
            linkage->joint[next[ties->tie[i].body[end]]++] = i;
    return OST_SUCCESS;
}

void ost_linkage_add_conditions(const OstLinkage *linkage, const OstTie *tie, OstLocal component,
                                double triangle[OST_ROWS])
{
    double change[OST_ROWS], rows[OST_ROWS];
    ost_rows_change_frame(&linkage->frames[component], ost_tie_frame(linkage->frames, tie), change);
    ost_rows_multiply(tie->triangle, change, rows);
    for (int r = 0; r < 6; r++)
        ost_rows_add(triangle, rows + 6 * r);
}

static OstStatus find_whether_fixed(OstLinkage *linkage, OstLocal component)
{
    double copy[OST_ROWS], basis[OST_ROWS];
    int loose = 0;
    memcpy(copy, linkage->conditions + OST_ROWS * (size_t)component, sizeof copy);
    OST_TRY(ost_null_space(linkage->ctx, 6, 6, copy, linkage->tolerance, &loose, basis));
    linkage->fixed[component] = loose == 0;
    return OST_SUCCESS;
}

/* A fixed component constrains its neighbours like a support, which may fix them too. */
static OstStatus fix_components(OstLinkage *linkage)
{
    OstLocal *stack = NULL;
    OstLocal height = 0;
    OstStatus status = OST_NEW(linkage->ctx, &stack, linkage->components->count);
    for (OstLocal p = 0; p < linkage->components->count && status == OST_SUCCESS; p++) {
        status = find_whether_fixed(linkage, p);
        if (linkage->fixed[p])
            stack[height++] = p;
    }
    while (height > 0 && status == OST_SUCCESS) {
        const OstLocal component = stack[--height];
        for (OstLocal j = linkage->joint_start[component]; j < linkage->joint_start[component + 1]; j++) {
            const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
            const OstLocal other = ost_linkage_neighbour(tie, component);
            if (linkage->fixed[other])
                continue;
            ost_linkage_add_conditions(linkage, tie, other, linkage->conditions + OST_ROWS * (size_t)other);
            status = find_whether_fixed(linkage, other);
            if (status != OST_SUCCESS)
                break;
            if (linkage->fixed[other])
                stack[height++] = other;
        }
    }
    OST_FREE(stack);
    return status;
}

static void find_clusters(OstLinkage *linkage)
{
    const OstTies *ties = linkage->ties;
    ost_set_start(linkage->cluster, linkage->components->count);
    for (OstLocal i = 0; i < ties->count; i++) {
        const OstLocal *body = ties->tie[i].body;
        if (body[1] != OST_TIE_SUPPORT && !linkage->fixed[body[0]] && !linkage->fixed[body[1]])
            ost_set_join(linkage->cluster, body[0], body[1]);
    }
    linkage->clusters = ost_set_number(linkage->cluster, linkage->components->count);
}

static OstStatus build(OstLinkage *linkage)
{
    const size_t count = (size_t)linkage->components->count;
    OST_TRY(OST_NEW(linkage->ctx, &linkage->conditions, OST_ROWS * count));
    OST_TRY(OST_NEW(linkage->ctx, &linkage->fixed, count));
    OST_TRY(OST_NEW(linkage->ctx, &linkage->cluster, count));
    for (OstLocal i = 0; i < linkage->ties->count; i++) {
        const OstTie *tie = &linkage->ties->tie[i];
        if (tie->body[1] == OST_TIE_SUPPORT)
            memcpy(linkage->conditions + OST_ROWS * (size_t)tie->body[0], tie->triangle, sizeof tie->triangle);
    }
    OST_TRY(list_joints(linkage));
    OST_TRY(fix_components(linkage));
    find_clusters(linkage);
    return OST_SUCCESS;
}

OstStatus ost_linkage_create(OstContext *ctx, const OstComponents *components, const OstRigidFrame *frames,
                             const OstTies *ties, double tolerance, OstLinkage **linkage)
{
    OstLinkage *made = NULL;
    *linkage = NULL;
    OST_TRY(OST_NEW(ctx, &made, 1));
    *made = (OstLinkage){.ctx = ctx, .components = components, .frames = frames, .ties = ties, .tolerance = tolerance};
    const OstStatus status = build(made);
    if (status != OST_SUCCESS)
        ost_linkage_destroy(&made);
    *linkage = made;
    return status;
}

int ost_place_of(int members, const OstLocal *member, OstLocal component)
{
    for (int i = 0; i < members; i++)
        if (member[i] == component)
            return i;
    return -1;
}

/* Six rows: the joint's triangle, applied to the difference of its two members' motions. */
static void fill_joint(const OstLinkage *linkage, const OstFreeMotions *free, const OstTie *tie, double *rows)
{
    const size_t columns = 6 * (size_t)free->members;
    for (int end = 0; end < 2; end++) {
        const int place = ost_place_of(free->members, free->member, tie->body[end]);
        double change[OST_ROWS], block[OST_ROWS];
        ost_rows_change_frame(&linkage->frames[tie->body[end]], ost_tie_frame(linkage->frames, tie), change);
        ost_rows_multiply(tie->triangle, change, block);
        for (size_t r = 0; r < 6; r++)
            for (size_t k = 0; k < 6; k++)
                rows[r * columns + 6 * (size_t)place + k] = end == 0 ? block[6 * r + k] : -block[6 * r + k];
    }
}

/* Is the joint within the cluster? Counted once, at its lower component. */
static int is_inner(const OstLinkage *linkage, const OstTie *tie, OstLocal component)
{
    return tie->body[0] == component && !linkage->fixed[tie->body[1]];
}

static int count_rows(const OstLinkage *linkage, const OstFreeMotions *free)
{
    int rows = 6 * free->members;
    for (int i = 0; i < free->members; i++)
        for (OstLocal j = linkage->joint_start[free->member[i]]; j < linkage->joint_start[free->member[i] + 1]; j++)
            rows += is_inner(linkage, &linkage->ties->tie[linkage->joint[j]], free->member[i]) ? 6 : 0;
    return rows;
}

static void fill_matrix(const OstLinkage *linkage, const OstFreeMotions *free, double *matrix)
{
    const size_t columns = 6 * (size_t)free->members;
    double *rows = matrix;
    for (int i = 0; i < free->members; i++) {
        const OstLocal component = free->member[i];
        for (size_t r = 0; r < 6; r++, rows += columns)
            memcpy(rows + 6 * (size_t)i, linkage->conditions + OST_ROWS * (size_t)component + 6 * r, 6 * sizeof *rows);
        for (OstLocal j = linkage->joint_start[component]; j < linkage->joint_start[component + 1]; j++) {
            const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
            if (!is_inner(linkage, tie, component))
                continue;
            fill_joint(linkage, free, tie, rows);
            rows += 6 * columns;
        }
    }
}

OstStatus ost_linkage_solve(const OstLinkage *linkage, int members, const OstLocal *member, OstFreeMotions *free)
{
    OstContext *ctx = linkage->ctx;
    const int columns = 6 * members;
    double *matrix = NULL;
    OstStatus status = OST_SUCCESS;
    *free = (OstFreeMotions){.members = members};
    OST_TRY_DONE(OST_NEW(ctx, &free->member, members));
    memcpy(free->member, member, (size_t)members * sizeof *member);
    const int rows = count_rows(linkage, free);
    OST_TRY_DONE(OST_NEW(ctx, &matrix, (size_t)rows * (size_t)columns));
    OST_TRY_DONE(OST_NEW(ctx, &free->motion, (size_t)columns * (size_t)columns));
    fill_matrix(linkage, free, matrix);
    OST_TRY_DONE(ost_null_space(ctx, rows, columns, matrix, linkage->tolerance, &free->count, free->motion));
done:
    OST_FREE(matrix);
    if (status != OST_SUCCESS)
        ost_free_motions_release(free);
    return status;
}
