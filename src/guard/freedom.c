/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/guard.h"

#include "assembly/links/links.h"
#include "core/error.h"
#include "core/memory.h"
#include "guard/freedom_report.h"
#include "mesh/coincident.h"

#include <stdio.h>
#include <string.h>

/* A motion that its ties resist by no more than this share of it is free. Stiffness goes with the square: a share of
 * 1e-7 is an eigenvalue of 1e-14 times the others, which double precision cannot tell from zero. Rounding of
 * coordinates stays far below (1e-15 or so of a component's size, unless the body lies very far from the origin). */
static const double free_share = 1e-7;

/* A motion constrained this weakly costs ten of sixteen digits; directions typed with few digits do that. */
static const double loose_share = 1e-5;

typedef struct Freedom {
    OstContext *ctx;
    const OstMesh *mesh;
    const char *where;
    int free_body;
    OstComponents *components;
    OstRigidFrame *frames;
    OstTies ties;
    OstGlobal coincident;
    double merge_tolerance;
} Freedom;

static OstStatus make_frames(Freedom *freedom)
{
    OST_TRY(OST_NEW(freedom->ctx, &freedom->frames, freedom->components->count));
    for (OstLocal p = 0; p < freedom->components->count; p++)
        freedom->frames[p] =
            ost_frame_of_box(freedom->components->component[p].low, freedom->components->component[p].high);
    return OST_SUCCESS;
}

static OstStatus report_motions(const Freedom *freedom, double tolerance, OstFreedomReport *report)
{
    OstLinkage *linkage = NULL;
    OST_TRY(
        ost_linkage_create(freedom->ctx, freedom->components, freedom->frames, &freedom->ties, tolerance, &linkage));
    const OstStatus status = ost_freedom_report(linkage, report);
    ost_linkage_destroy(&linkage);
    return status;
}

static void advise(const Freedom *freedom, char *text, size_t size)
{
    size_t used = 0;
    const int several = freedom->components->count > 1;
    if (freedom->ties.facets_hold > 0)
        used +=
            (size_t)snprintf(text, size,
                             "(a foundation with a normal stiffness alone does not hold what is round, and only the "
                             "mesh's facets are not: give it a tangential stiffness too; if the body is not round, "
                             "refine the mesh)\n");
    if (freedom->free_body)
        used += (size_t)snprintf(text, size, "free_body takes one connected body; join its components");
    else
        used += (size_t)snprintf(text + used, size - used,
                                 "prevent each of them by constraints (a displacement, or a slide across "
                                 "the motion)%s",
                                 several ? ", or join the components" : "");
    if (freedom->coincident > 0)
        used += (size_t)snprintf(text + used, size - used,
                                 ": %lld vertices coincide with others, and mesh: {merge: %g} joins them",
                                 (long long)freedom->coincident, freedom->merge_tolerance);
    if (!several && !freedom->free_body)
        snprintf(text + used, size - used, ", or say constraints: free_body if its loads balance each other");
}

static OstStatus refuse(const Freedom *freedom, const OstFreedomReport *report)
{
    char rest[64] = "", advice[512];
    if (report->found > OST_FREEDOM_LINES)
        snprintf(rest, sizeof rest, "\n  and %d more that can move", report->found - OST_FREEDOM_LINES);
    advise(freedom, advice, sizeof advice);
    return OST_RAISE(freedom->ctx, OST_INVALID_INPUT,
                     "%s: nothing constrains these motions, so there is no unique solution:%s%s\n%s", freedom->where,
                     report->text, rest, advice);
}

static void warn_of_loose(const Freedom *freedom, const OstFreedomReport *report)
{
    if (report->found > 0)
        ost_warn(freedom->ctx,
                 "%s: these motions are only weakly constrained (give directions with more digits, or constrain points "
                 "farther apart):%s",
                 freedom->where, report->text);
    if (report->unsolved > 0)
        ost_warn(
            freedom->ctx,
            "%s: %d components are joined at vertices and edges only, too many to check how they can move against each "
            "other",
            freedom->where, report->unsolved);
}

static OstStatus judge(const Freedom *freedom)
{
    OstFreedomReport report;
    OST_TRY(report_motions(freedom, free_share, &report));
    if (report.found > 0)
        return refuse(freedom, &report);
    OST_TRY(report_motions(freedom, loose_share, &report));
    warn_of_loose(freedom, &report);
    if (freedom->coincident > 0)
        ost_warn(freedom->ctx,
                 "%s: the mesh falls into %d components, and %lld vertices coincide with others; mesh: {merge: %g} "
                 "joins them",
                 freedom->where, freedom->components->count, (long long)freedom->coincident, freedom->merge_tolerance);
    return OST_SUCCESS;
}

/* Collective. Vertices that coincide with others, where no link joins them: of two that a tie joins one follows, the
 * other leads. */
static OstStatus count_coincident(Freedom *freedom, const OstLinks *links)
{
    const OstMesh *mesh = freedom->mesh;
    unsigned char *joined = NULL;
    OST_TRY(ost_agree(freedom->ctx, OST_NEW(freedom->ctx, &joined, mesh->owned_nodes)));
    for (OstLocal n = 0; links && n < mesh->owned_nodes; n++)
        joined[n] = links->of_node[n] >= 0 || links->leads[n];
    const OstStatus status = ost_mesh_count_coincident(mesh, joined, &freedom->coincident, &freedom->merge_tolerance);
    OST_FREE(joined);
    return status;
}

static OstStatus check(Freedom *freedom, const OstSupports *supports)
{
    OstContext *ctx = freedom->ctx;
    OST_TRY(ost_components_create(freedom->mesh, &freedom->components));
    OST_TRY(ost_agree(ctx, make_frames(freedom)));
    OST_TRY(ost_ties_create(freedom->mesh, supports, freedom->components, freedom->frames, &freedom->ties));
    if (freedom->components->count > 1)
        OST_TRY(count_coincident(freedom, supports->links));
    return ost_agree(ctx, judge(freedom));
}

OstStatus ost_freedom_check(const OstMesh *mesh, const OstSupports *supports, const char *where, int free_body)
{
    Freedom freedom = {.ctx = mesh->ctx, .mesh = mesh, .where = where, .free_body = free_body};
    ost_ledger_enter(mesh->ctx, OST_LEDGER_SUPPORTS);
    const OstStatus status = check(&freedom, supports);
    ost_components_destroy(&freedom.components);
    OST_FREE(freedom.frames);
    ost_ties_release(&freedom.ties);
    ost_ledger_leave(mesh->ctx);
    return status;
}
