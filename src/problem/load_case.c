/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/load_case.h"

#include "core/hash.h"
#include "problem/boundary_conditions.h"

static uint64_t hash_supports(const OstSupports *supports)
{
    const size_t nodes = (size_t)supports->mesh->node_count;
    uint64_t hash = ost_hash(OST_HASH_START, nodes * sizeof *supports->index, supports->index);
    for (OstLocal i = 0; i < supports->count; i++) {
        const OstSupport *support = &supports->support[i];
        hash = ost_hash(hash, sizeof support->constrained, &support->constrained);
        hash = ost_hash(hash, 3 * (size_t)support->constrained * sizeof *support->direction, support->direction);
    }
    return supports->spring ? ost_hash(hash, 9 * nodes * sizeof *supports->spring, supports->spring) : hash;
}

OstStatus ost_scene_support_hash(const OstScene *scene, uint64_t *hash)
{
    OstSupports *supports = NULL;
    const OstStatus status = ost_scene_supports(scene, 0, &supports);
    if (status == OST_SUCCESS)
        *hash = hash_supports(supports);
    ost_supports_destroy(&supports);
    return status;
}

#define SWAP(type, a, b) \
    do {                 \
        type kept = (a); \
        (a) = (b);       \
        (b) = kept;      \
    } while (0)

/* The supports themselves stay where they are: the system refers to them. */
void ost_problem_take_loading(OstProblem *problem, OstProblem *other)
{
    SWAP(OstSupport *, problem->supports->support, other->supports->support);
    problem->supports->effects = other->supports->effects;
    SWAP(double *, problem->force, other->force);
    SWAP(OstFollower *, problem->follower, other->follower);
    problem->conservative = other->conservative;
    problem->scene = other->scene;
    problem->c = other->c;
    problem->effects = other->effects;
}
