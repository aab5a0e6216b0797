/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/cases/load_case.h"

#include "core/hash.h"
#include "problem/boundary_conditions.h"

#include <string.h>

/* Who follows whom, and how; not by how much a follower is moved besides. */
static uint64_t hash_links(const OstLinks *links, uint64_t hash)
{
    hash = ost_hash(hash, sizeof links->periodic, &links->periodic);
    for (OstLocal i = 0; i < links->all; i++) {
        const OstLink *link = &links->link[i];
        hash = ost_hash(hash, sizeof link->node, &link->node);
        hash = ost_hash(hash, (size_t)link->count * sizeof *link->leader, link->leader);
    }
    hash = ost_hash(hash, (size_t)links->mesh->owned_nodes * sizeof *links->kept, links->kept);
    for (int f = 0; f < links->face_count; f++)
        hash = ost_hash(hash, sizeof links->face[f].constrained, links->face[f].constrained);
    return hash;
}

static uint64_t hash_supports(const OstSupports *supports)
{
    const size_t nodes = (size_t)supports->mesh->node_count;
    uint64_t hash = ost_hash(OST_HASH_START, nodes * sizeof *supports->index, supports->index);
    for (OstLocal i = 0; i < supports->count; i++) {
        const OstSupport *support = &supports->support[i];
        hash = ost_hash(hash, sizeof support->constrained, &support->constrained);
        hash = ost_hash(hash, 3 * (size_t)support->constrained * sizeof *support->direction, support->direction);
    }
    if (supports->links)
        hash = hash_links(supports->links, hash);
    return supports->spring ? ost_hash(hash, 9 * nodes * sizeof *supports->spring, supports->spring) : hash;
}

/* Linear or not: what is solved in the same way. */
static uint64_t hash_method(const OstEffects *effects, uint64_t hash)
{
    const int way = ost_effect_on(effects, OST_EFFECT_LARGE_ROTATION);
    return ost_hash(hash, sizeof way, &way);
}

OstStatus ost_scene_support_hash(const OstScene *scene, uint64_t *hash)
{
    OstSupports *supports = NULL;
    const OstStatus status = ost_scene_supports(scene, 0, &supports);
    if (status == OST_SUCCESS)
        *hash = hash_method(&scene->plan.effects, hash_supports(supports));
    ost_supports_destroy(&supports);
    return status;
}

#define SWAP(type, a, b) \
    do {                 \
        type kept = (a); \
        (a) = (b);       \
        (b) = kept;      \
    } while (0)

/* The supports stay where they are: the system refers to them. Those of the other hold the same directions. */
static void take_displacements(OstSupports *supports, const OstSupports *other)
{
    supports->effects = other->effects;
    if (supports->count > 0)
        memcpy(supports->support, other->support, (size_t)supports->count * sizeof *supports->support);
    if (!supports->links)
        return;
    memcpy(supports->links->offset, other->links->offset,
           3 * (size_t)supports->mesh->node_count * sizeof *supports->links->offset);
    supports->links->moves = other->links->moves;
    for (int f = 0; f < supports->links->face_count; f++)
        memcpy(supports->links->face[f].given, other->links->face[f].given, sizeof other->links->face[f].given);
}

void ost_problem_take_loading(OstProblem *problem, OstProblem *other)
{
    take_displacements(problem->supports, other->supports);
    SWAP(double *, problem->force, other->force);
    SWAP(double *, problem->driven, other->driven);
    SWAP(OstFollower *, problem->follower, other->follower);
    problem->conservative = other->conservative;
    problem->scene = other->scene;
    problem->c = other->c;
    problem->effects = other->effects;
}
