/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/search.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* Near corners and edges, what an order of elements adds to the energy falls as a power of the order. Where order three
 * adds a share r of what order two has, all orders from three on then add 1 + 4.4 r times as much as three: 1.23, 1.81
 * and 2.4 for powers of 4, 2 and 1, whose r are .053, .18 and .33. A smooth solution has a small r. Nearly
 * incompressible materials have a large one everywhere. */
static const double to_come_of_orders = 4.4, largest_share = 0.3;

int ost_orders_are_known(const OstEstimate *estimate)
{
    return estimate->knows_orders && !estimate->problem->pressures;
}

/* u less its linear part in each tet: what mid-edge nodes are off the middle of their edge's ends. */
static void take_second_order(const OstMesh *mesh, const double *u, double *bent)
{
    memset(bent, 0, 3 * (size_t)mesh->node_count * sizeof *bent);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *node = ost_mesh_nodes_of(mesh, tet);
        for (int e = 0; e < 6; e++) {
            const double *a = u + 3 * node[ost_tet_edge[e][0]], *b = u + 3 * node[ost_tet_edge[e][1]];
            for (int i = 0; i < 3; i++)
                bent[3 * node[4 + e] + i] = u[3 * node[4 + e] + i] - 0.5 * (a[i] + b[i]);
        }
    }
}

void ost_orders_second(Search *search, const double *u, double *of_second)
{
    const OstEstimate *estimate = search->estimate;
    const OstMesh *mesh = estimate->problem->mesh;
    take_second_order(mesh, u, search->steps.u);
    memset(search->steps.p.functions, 0, OST_PER_FUNCTION * search->steps.functions * sizeof(float));
    ost_operator_energy(&estimate->stiffness, search->steps.u, search->steps.p.functions, of_second);
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        of_second[tet] *= estimate->stiffness.unit;
}

double ost_orders_share(double of_third, double of_second)
{
    return of_second > 0.0 ? fmin(fmax(of_third, 0.0) / of_second, largest_share) : 0.0;
}

/* What orders from three on add, over what three does, of a tet in which that is a share r of what two does. */
static double of_all_orders(const OstEstimate *estimate, double share)
{
    return fmax(estimate->of_flat, 1.0 + to_come_of_orders * share);
}

OstStatus ost_orders_add(Search *search, const double *u, double *tet_error, double *square)
{
    const OstEstimate *estimate = search->estimate;
    const OstMesh *mesh = estimate->problem->mesh;
    double *of_second = NULL;
    if (!ost_orders_are_known(estimate))
        return OST_SUCCESS;
    OST_TRY(ost_agree(estimate->problem->ctx, OST_NEW(estimate->problem->ctx, &of_second, mesh->owned_tets)));
    ost_orders_second(search, u, of_second);
    *square = 0.0;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        tet_error[tet] *= of_all_orders(estimate, ost_orders_share(tet_error[tet], of_second[tet]));
        *square += tet_error[tet];
    }
    OST_FREE(of_second);
    return ost_sum(estimate->problem->ctx, 1, square);
}

/* The share r that order three adds, from what all orders from three on do: x = r times the above. */
static double share_of_all(const OstEstimate *estimate, double of_all, double of_second)
{
    const double x = of_second > 0.0 ? fmax(of_all, 0.0) / of_second : 0.0;
    const double share = (sqrt(1.0 + 4.0 * to_come_of_orders * x) - 1.0) / (2.0 * to_come_of_orders);
    return fmin(fmin(share, x / estimate->of_flat), largest_share);
}

OstStatus ost_orders_of_product(Search *search, const double *u, const double *tet_error, const OstOrders *of_adjoint,
                                double *factor, double *unsigned_sum)
{
    const OstEstimate *estimate = search->estimate;
    OstContext *ctx = estimate->problem->ctx;
    const OstLocal tets = estimate->problem->mesh->owned_tets;
    double *of_second = NULL, sums[2] = {0.0};
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &of_second, tets)));
    ost_orders_second(search, u, of_second);
    for (OstLocal tet = 0; tet < tets; tet++) {
        const double share = share_of_all(estimate, tet_error[tet], of_second[tet]);
        const double of_third = fmax(tet_error[tet], 0.0) / of_all_orders(estimate, share);
        const double product = sqrt(of_third * (double)of_adjoint[tet].of_third);
        sums[0] += product;
        sums[1] += product * of_all_orders(estimate, sqrt(share * (double)of_adjoint[tet].share));
    }
    OST_FREE(of_second);
    OST_TRY(ost_sum(ctx, 2, sums));
    *unsigned_sum = sums[0];
    *factor = sums[0] > 0.0 ? sums[1] / sums[0] : 1.0;
    return OST_SUCCESS;
}
