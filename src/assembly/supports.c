/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/supports.h"

#include "assembly/links/rigid_faces.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

/* A direction counts as dependent on the constrained ones if less than this of it is left: normals of one plane that
 * come from rounded coordinates must not hold the tangent too. */
static const double parallel = 1e-6;

/* Displacements agree if they differ by no more than this, relative to the largest. */
static const double same = 1e-10;

OstStatus ost_supports_create(const OstMesh *mesh, OstSupports **supports)
{
    OstContext *ctx = mesh->ctx;
    OstSupports *made = NULL;
    *supports = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_SUPPORTS);
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->mesh = mesh;
        status = OST_NEW(ctx, &made->index, mesh->node_count);
    }
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS) {
        ost_supports_destroy(&made);
        return status;
    }
    for (OstLocal node = 0; node < mesh->node_count; node++)
        made->index[node] = -1;
    *supports = made;
    return OST_SUCCESS;
}

void ost_supports_destroy(OstSupports **supports)
{
    if (!*supports)
        return;
    OST_FREE((*supports)->index);
    OST_FREE((*supports)->support);
    OST_FREE((*supports)->spring);
    OST_FREE((*supports)->bed);
    ost_links_destroy(&(*supports)->links);
    OST_FREE(*supports);
}

/* The support of a node, made if it has none. */
static OstStatus support_of(OstSupports *supports, OstLocal node, OstSupport **support)
{
    OstLocal *index = &supports->index[node];
    if (*index < 0) {
        if (supports->count == supports->capacity) {
            const OstLocal capacity = supports->capacity / 2 * 3 + 64;
            OST_TRY(OST_RESIZE(supports->ctx, &supports->support, capacity));
            supports->capacity = capacity;
        }
        *index = supports->count++;
        supports->support[*index] = (OstSupport){0};
    }
    *support = &supports->support[*index];
    return OST_SUCCESS;
}

static OstStatus raise_contradiction(const OstSupports *supports, OstLocal node, const double direction[3],
                                     double earlier, double prescribed)
{
    return OST_RAISE(
        supports->ctx, OST_INVALID_INPUT,
        "vertex %lld is constrained to %g along (%g, %g, %g) and to %g by another constraint; make them agree, or "
        "leave one out",
        (long long)ost_mesh_node_number(supports->mesh, node), earlier, direction[0], direction[1], direction[2],
        prescribed);
}

/* Removes from `rest` its part along the constrained directions (twice, against rounding errors), and returns the
 * displacement already prescribed along that part. */
static double remove_constrained_part(const OstSupport *support, double rest[3])
{
    double earlier = 0.0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < support->constrained; k++) {
            const double *along = support->direction + 3 * k;
            const double part = ost_dot3(rest, along);
            earlier += part * support->prescribed[k];
            for (int i = 0; i < 3; i++)
                rest[i] -= part * along[i];
        }
    return earlier;
}

/* The largest prescribed displacement of the node, with the new one: agreement is relative to it. */
static double largest_prescribed(const OstSupport *support, double prescribed)
{
    double size = fabs(prescribed);
    for (int k = 0; k < support->constrained; k++)
        size = fmax(size, fabs(support->prescribed[k]));
    return size;
}

OstStatus ost_supports_constrain(OstSupports *supports, OstLocal node, const double direction[3], double prescribed)
{
    const double length = ost_norm3(direction);
    if (!(length > 0.0) || !isfinite(length) || !isfinite(prescribed))
        return OST_RAISE(supports->ctx, OST_INVALID_INPUT,
                         "vertex %lld is to be constrained to %g along (%g, %g, %g); expected finite numbers and a "
                         "direction that is not zero",
                         (long long)ost_mesh_node_number(supports->mesh, node), prescribed, direction[0], direction[1],
                         direction[2]);
    OstSupport *support;
    OST_TRY(support_of(supports, node, &support));
    const double unit[3] = {direction[0] / length, direction[1] / length, direction[2] / length};
    double rest[3] = {unit[0], unit[1], unit[2]};
    const double earlier = remove_constrained_part(support, rest);
    const double rest_length = ost_norm3(rest);
    if (rest_length <= parallel || support->constrained == 3) {
        if (fabs(prescribed - earlier) > same * largest_prescribed(support, prescribed))
            return raise_contradiction(supports, node, unit, earlier, prescribed);
        return OST_SUCCESS;
    }
    for (int i = 0; i < 3; i++)
        support->direction[3 * support->constrained + i] = rest[i] / rest_length;
    support->prescribed[support->constrained++] = (prescribed - earlier) / rest_length;
    return OST_SUCCESS;
}

/* Sorts the supports by node and makes room for `count` of them, the ghosts' last. */
static OstStatus order_by_node(OstSupports *supports, const OstLocal *order, OstLocal count)
{
    OstSupport *ordered = NULL;
    OST_TRY(OST_NEW(supports->ctx, &ordered, count));
    for (OstLocal node = 0; node < supports->mesh->owned_nodes; node++)
        if (order[node] >= 0)
            ordered[order[node]] = supports->support[supports->index[node]];
    OST_FREE(supports->support);
    supports->support = ordered;
    supports->count = count;
    supports->capacity = count;
    return OST_SUCCESS;
}

/* Numbers the nodes with a support, ghosts included, in the order of nodes, as ost_halo_subset needs it. */
static OstStatus number_supported(const OstSupports *supports, OstLocal *order, OstLocal *count)
{
    const OstMesh *mesh = supports->mesh;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        order[node] = supports->index[node];
    OST_TRY(ost_halo_import(mesh->halo, sizeof *order, order));
    *count = 0;
    for (OstLocal node = 0; node < mesh->node_count; node++)
        order[node] = order[node] < 0 ? -1 : (*count)++;
    return OST_SUCCESS;
}

static OstStatus share_with_ghosts(OstSupports *supports)
{
    OstContext *ctx = supports->ctx;
    OstLocal *order = NULL;
    OstHalo *halo = NULL;
    OstLocal count = 0;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &order, supports->mesh->node_count));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(ctx, number_supported(supports, order, &count)));
    OST_TRY_DONE(ost_agree(ctx, order_by_node(supports, order, count)));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_subset(supports->mesh->halo, order, &halo)));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(halo, sizeof(OstSupport), supports->support)));
    memcpy(supports->index, order, (size_t)supports->mesh->node_count * sizeof *order);
done:
    ost_halo_destroy(&halo);
    OST_FREE(order);
    return status;
}

static OstStatus check_anything_constrained(const OstSupports *supports)
{
    OstGlobal constrained = supports->count;
    OST_TRY(ost_sum_numbers(supports->ctx, 1, &constrained));
    if (constrained == 0 && !supports->spring && !supports->links)
        return OST_RAISE(supports->ctx, OST_INVALID_INPUT,
                         "nothing is constrained: no vertex has a prescribed displacement or slides on a plane, so the "
                         "body can move away as a whole; add constraints");
    return OST_SUCCESS;
}

/* Without the offsets of links. */
static int find_support(const OstSupports *supports, OstLocal node, double projector[9], double prescribed[3])
{
    const OstLocal index = supports->index[node];
    const OstSupport *support = index < 0 ? NULL : &supports->support[index];
    const int constrained = support ? support->constrained : 0;
    for (int i = 0; i < 9; i++)
        projector[i] = i % 4 == 0 && constrained < 3 ? 1.0 : 0.0;
    for (int i = 0; i < 3 && prescribed; i++)
        prescribed[i] = 0.0;
    for (int k = 0; k < constrained; k++)
        for (int i = 0; i < 3; i++) {
            const double *along = support->direction + 3 * k;
            if (prescribed)
                prescribed[i] += support->prescribed[k] * along[i];
            for (int j = 0; j < 3 && constrained < 3; j++)
                projector[3 * i + j] -= along[i] * along[j];
        }
    return constrained;
}

static OstStatus complete_links(OstSupports *supports)
{
    OstHeld *held = NULL;
    OstStatus status = ost_agree(supports->ctx, OST_NEW(supports->ctx, &held, supports->mesh->owned_nodes));
    for (OstLocal n = 0; n < supports->mesh->owned_nodes && status == OST_SUCCESS; n++)
        held[n].constrained = find_support(supports, n, held[n].projector, held[n].prescribed);
    OST_THEN(ost_links_complete(supports->links, held));
    OST_THEN(ost_rigid_faces_measure(supports->links));
    for (OstLocal n = 0; n < supports->mesh->owned_nodes && status == OST_SUCCESS; n++)
        if (held[n].constrained == 0)
            supports->index[n] = -1;
    OST_FREE(held);
    return status;
}

OstStatus ost_supports_complete(OstSupports *supports)
{
    ost_ledger_enter(supports->ctx, OST_LEDGER_SUPPORTS);
    OstStatus status = ost_agree(supports->ctx, check_anything_constrained(supports));
    if (status == OST_SUCCESS && supports->links)
        status = complete_links(supports);
    OST_THEN(share_with_ghosts(supports));
    if (status == OST_SUCCESS && supports->spring)
        status = ost_agree(supports->ctx, ost_halo_import(supports->mesh->halo, 9 * sizeof(double), supports->spring));
    ost_ledger_leave(supports->ctx);
    return status;
}

int ost_supports_get(const OstSupports *supports, OstLocal node, double projector[9], double prescribed[3])
{
    const int constrained = find_support(supports, node, projector, prescribed);
    for (int i = 0; i < 3 && prescribed && supports->links; i++)
        prescribed[i] += supports->links->offset[3 * (size_t)node + (size_t)i];
    return constrained;
}

void ost_supports_add(const OstSupports *supports, double factor, double *u)
{
    for (OstLocal node = 0; node < supports->mesh->node_count; node++) {
        const OstLocal index = supports->index[node];
        const OstSupport *support = index < 0 ? NULL : &supports->support[index];
        for (size_t i = 3 * (size_t)node; supports->links && i < 3 * (size_t)node + 3; i++)
            u[i] += factor * supports->links->offset[i];
        for (int k = 0; support && k < support->constrained; k++)
            for (int i = 0; i < 3; i++)
                u[3 * (size_t)node + (size_t)i] += factor * support->prescribed[k] * support->direction[3 * k + i];
    }
}

static OstStatus copy_to_vertices(const OstSupports *quadratic, const OstLocal *node_of_vertex, OstSupports *made)
{
    const OstMesh *linear = made->mesh;
    OstStatus status = OST_SUCCESS;
    for (OstLocal vertex = 0; vertex < linear->node_count && status == OST_SUCCESS; vertex++) {
        const OstLocal index = quadratic->index[node_of_vertex[vertex]];
        OstSupport *support = NULL;
        if (index < 0)
            continue;
        status = support_of(made, vertex, &support);
        if (status == OST_SUCCESS)
            *support = quadratic->support[index];
    }
    return status;
}

OstStatus ost_supports_on_vertices(const OstSupports *quadratic, const OstMesh *linear, const OstLocal *node_of_vertex,
                                   OstSupports **supports)
{
    OstContext *ctx = quadratic->ctx;
    OstSupports *made = NULL;
    *supports = NULL;
    OstStatus status = ost_supports_create(linear, &made);
    OST_THEN(copy_to_vertices(quadratic, node_of_vertex, made));
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        made->effects = quadratic->effects;
    if (status == OST_SUCCESS && quadratic->links) {
        status = ost_links_on_vertices(quadratic->links, linear, node_of_vertex, &made->links);
        if (status == OST_SUCCESS && made->links)
            status = complete_links(made);
    }
    if (status != OST_SUCCESS || (quadratic->links && !made->links))
        ost_supports_destroy(&made);
    *supports = made;
    return status;
}

static void split_node(const OstSupports *supports, OstLocal node, const double force[3], const double of_free[3],
                       const double of_held[3], double *borne, double *passed, double *residual)
{
    const int follows = supports->links && supports->links->of_node[node] >= 0;
    double projector[9], free_force[3];
    ost_supports_get(supports, node, projector, NULL);
    ost_apply3(projector, force, free_force);
    for (size_t i = 0; i < 3; i++) {
        const size_t n = 3 * (size_t)node + i;
        borne[n] = follows ? 0.0 : force[i] - free_force[i] + of_held[i];
        passed[n] = follows ? force[i] : -of_free[i] - of_held[i];
        if (residual)
            residual[n] = follows ? of_free[i] : free_force[i] + of_free[i];
    }
}

OstStatus ost_supports_split(const OstSupports *supports, const double *out_of_balance, double *borne, double *passed,
                             double *residual)
{
    static const double nothing[3] = {0.0};
    const OstLinks *links = supports->links;
    double *of_free = NULL, *of_held = NULL;
    OstStatus status = OST_SUCCESS;
    if (links) {
        status = OST_NEW(links->ctx, &of_free, 3 * (size_t)links->slots);
        OST_THEN(OST_NEW(links->ctx, &of_held, 3 * (size_t)links->slots));
        status = ost_agree(links->ctx, status);
        OST_THEN(ost_links_gather(links, out_of_balance, of_free));
        OST_THEN(ost_links_gather_held(links, out_of_balance, of_held));
    }
    for (OstLocal node = 0; node < supports->mesh->owned_nodes && status == OST_SUCCESS; node++) {
        const size_t n = 3 * (size_t)node;
        split_node(supports, node, out_of_balance + n, links ? of_free + n : nothing, links ? of_held + n : nothing,
                   borne, passed, residual);
    }
    OST_FREE(of_free, of_held);
    return status;
}
