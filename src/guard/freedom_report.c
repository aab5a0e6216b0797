/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_report.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Motions that differ by less than this share of the body's size are the same; the normals of a bed are less exact. */
static const double same_motion = 1e-6, same_in_bed = 0.03;

enum { NAMES_SHOWN = 6, LINE_SIZE = 700 };

/* "component 2", "components 2, 3 and 5 together", "components 2, 3, 5, 6, 8, 9 and 14 more together" */
static void name_components(int members, const OstLocal *member, const char *together, char *text, size_t size)
{
    size_t used = (size_t)snprintf(text, size, "component%s ", members > 1 ? "s" : "");
    const int shown = members <= NAMES_SHOWN + 1 ? members : NAMES_SHOWN;
    for (int i = 0; i < shown; i++) {
        const char *between = i == 0 ? "" : i == members - 1 ? " and " : ", ";
        used += (size_t)snprintf(text + used, size - used, "%s%d", between, member[i] + 1);
    }
    if (shown < members)
        used += (size_t)snprintf(text + used, size - used, " and %d more", members - shown);
    if (members > 1)
        snprintf(text + used, size - used, "%s", together);
}

/* The union of components. */
static OstComponent unite(const OstLinkage *linkage, int members, const OstLocal *member)
{
    OstComponent whole = linkage->components->component[member[0]];
    for (int i = 1; i < members; i++) {
        const OstComponent *component = &linkage->components->component[member[i]];
        whole.tets += component->tets;
        for (int d = 0; d < 3; d++) {
            whole.low[d] = fmin(whole.low[d], component->low[d]);
            whole.high[d] = fmax(whole.high[d], component->high[d]);
        }
    }
    return whole;
}

/* "48 tets around (0.5, 2, 1)" */
static void describe_place(const OstLinkage *linkage, int members, const OstLocal *member, char *text, size_t size)
{
    const OstComponent whole = unite(linkage, members, member);
    char middle[96];
    const OstRigidFrame frame = ost_frame_of_box(whole.low, whole.high);
    ost_point_words(frame.centre, frame.radius, middle);
    snprintf(text, size, "%lld tet%s around %s", (long long)whole.tets, whole.tets == 1 ? "" : "s", middle);
}

/* The only joint of these components with others, or NULL if there are none or several. */
static const OstTie *only_joint(const OstLinkage *linkage, int members, const OstLocal *member, OstLocal *outside)
{
    const OstTie *found = NULL;
    for (int i = 0; i < members; i++)
        for (OstLocal j = linkage->joint_start[member[i]]; j < linkage->joint_start[member[i] + 1]; j++) {
            const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
            const OstLocal other = ost_linkage_neighbour(tie, member[i]);
            if (ost_place_of(members, member, other) >= 0)
                continue;
            if (found)
                return NULL;
            found = tie;
            *outside = other;
        }
    return found;
}

/* ", joined to component 1 along one line only": a point leaves three rotations, a line one. */
static OstStatus describe_joint(const OstLinkage *linkage, int members, const OstLocal *member, char *text, size_t size)
{
    OstLocal outside = 0;
    int loose = 0;
    double triangle[OST_ROWS], basis[OST_ROWS];
    const OstTie *tie = only_joint(linkage, members, member, &outside);
    text[0] = 0;
    if (!tie)
        return OST_SUCCESS;
    memcpy(triangle, tie->triangle, sizeof triangle);
    OST_TRY(ost_null_space(linkage->ctx, 6, 6, triangle, linkage->tolerance, &loose, basis));
    if (loose == 3 || loose == 1)
        snprintf(text, size, ", joined to component %d %s only", outside + 1,
                 loose == 3 ? "at one point" : "along one line");
    return OST_SUCCESS;
}

static void add_line(const char *line, OstFreedomReport *report)
{
    const size_t used = strlen(report->text);
    if (report->found++ < OST_FREEDOM_LINES && used + strlen(line) < sizeof report->text)
        memcpy(report->text + used, line, strlen(line) + 1);
}

OstStatus ost_freedom_report_line(const OstLinkage *linkage, int members, const OstLocal *member,
                                  const OstRigidFrame *frame, int count, const double *motions,
                                  OstFreedomReport *report)
{
    char name[128], place[160], joint[80], motion[LINE_SIZE], line[2 * LINE_SIZE];
    if (report->found >= OST_FREEDOM_LINES) {
        report->found++;
        return OST_SUCCESS;
    }
    name_components(members, member, " together", name, sizeof name);
    describe_place(linkage, members, member, place, sizeof place);
    OST_TRY(describe_joint(linkage, members, member, joint, sizeof joint));
    const double same = linkage->ties->facets_hold > 0 ? same_in_bed : same_motion;
    OST_TRY(ost_motion_words(linkage->ctx, frame, count, motions, same, motion, sizeof motion));
    snprintf(line, sizeof line, "\n  %s, %s%s: %s", linkage->components->count == 1 ? "the body" : name, place, joint,
             motion);
    add_line(line, report);
    return OST_SUCCESS;
}

void ost_freedom_report_rest(const OstLinkage *linkage, int members, const OstLocal *member, int count,
                             OstFreedomReport *report)
{
    char name[128], place[160], line[LINE_SIZE];
    name_components(members, member, "", name, sizeof name);
    describe_place(linkage, members, member, place, sizeof place);
    snprintf(line, sizeof line, "\n  %s, %s: can move against each other, as a linkage, in %d way%s", name, place,
             count, count == 1 ? "" : "s");
    add_line(line, report);
}

/* Can a component move even if all others are fixed? */
static OstStatus report_alone(const OstLinkage *linkage, OstLocal component, OstFreedomReport *report)
{
    double triangle[OST_ROWS], basis[OST_ROWS];
    int count = 0;
    memcpy(triangle, linkage->conditions + OST_ROWS * (size_t)component, sizeof triangle);
    for (OstLocal j = linkage->joint_start[component]; j < linkage->joint_start[component + 1]; j++) {
        const OstTie *tie = &linkage->ties->tie[linkage->joint[j]];
        if (!linkage->fixed[ost_linkage_neighbour(tie, component)])
            ost_linkage_add_conditions(linkage, tie, component, triangle);
    }
    OST_TRY(ost_null_space(linkage->ctx, 6, 6, triangle, linkage->tolerance, &count, basis));
    if (count == 0)
        return OST_SUCCESS;
    return ost_freedom_report_line(linkage, 1, &component, &linkage->frames[component], count, basis, report);
}

/* Can these components move as one rigid body? */
static OstStatus report_as_one(const OstLinkage *linkage, OstLocal members, const OstLocal *member,
                               OstFreedomReport *report)
{
    const OstComponent whole = unite(linkage, members, member);
    const OstRigidFrame frame = ost_frame_of_box(whole.low, whole.high);
    double triangle[OST_ROWS] = {0.0}, basis[OST_ROWS], change[OST_ROWS], rows[OST_ROWS];
    int count = 0;
    for (OstLocal i = 0; i < members; i++) {
        ost_rows_change_frame(&frame, &linkage->frames[member[i]], change);
        ost_rows_multiply(linkage->conditions + OST_ROWS * (size_t)member[i], change, rows);
        for (int r = 0; r < 6; r++)
            ost_rows_add(triangle, rows + 6 * r);
    }
    OST_TRY(ost_null_space(linkage->ctx, 6, 6, triangle, linkage->tolerance, &count, basis));
    if (count == 0)
        return OST_SUCCESS;
    return ost_freedom_report_line(linkage, members, member, &frame, count, basis, report);
}

static OstStatus report_cluster(const OstLinkage *linkage, OstLocal members, const OstLocal *member,
                                OstFreedomReport *report)
{
    if (members > OST_LARGEST_LINKAGE) {
        report->unsolved += members;
        OST_TRY(report_as_one(linkage, members, member, report));
        for (OstLocal i = 0; i < members; i++)
            OST_TRY(report_alone(linkage, member[i], report));
        return OST_SUCCESS;
    }
    OstFreeMotions free = {0};
    OST_TRY(ost_linkage_solve(linkage, members, member, &free));
    const OstStatus status = free.count > 0 ? ost_freedom_report_sets(linkage, &free, report) : OST_SUCCESS;
    ost_free_motions_release(&free);
    return status;
}

/* The components that are not fixed, cluster by cluster. */
static OstStatus sort_by_cluster(const OstLinkage *linkage, OstLocal **start, OstLocal **member)
{
    OST_TRY(OST_NEW(linkage->ctx, start, (size_t)linkage->clusters + 2));
    OST_TRY(OST_NEW(linkage->ctx, member, linkage->components->count));
    OstLocal *next = *start + 1; /* offset by one: filling moves each start to its place */
    for (OstLocal p = 0; p < linkage->components->count; p++)
        if (!linkage->fixed[p])
            next[linkage->cluster[p] + 1]++;
    for (OstLocal c = 0; c < linkage->clusters; c++)
        next[c + 1] += next[c];
    for (OstLocal p = 0; p < linkage->components->count; p++)
        if (!linkage->fixed[p])
            (*member)[next[linkage->cluster[p]]++] = p;
    return OST_SUCCESS;
}

OstStatus ost_freedom_report(const OstLinkage *linkage, OstFreedomReport *report)
{
    OstLocal *start = NULL;
    OstLocal *member = NULL;
    *report = (OstFreedomReport){0};
    OstStatus status = sort_by_cluster(linkage, &start, &member);
    for (OstLocal c = 0; c < linkage->clusters && status == OST_SUCCESS; c++)
        if (start[c + 1] > start[c])
            status = report_cluster(linkage, start[c + 1] - start[c], member + start[c], report);
    OST_FREE(start);
    OST_FREE(member);
    return status;
}
