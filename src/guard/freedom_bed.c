/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_ties.h"

#include "core/error.h"
#include "core/small.h"

#include <string.h>

/* A body in a bed of springs along its surface's normals: a round one can turn there, but the normals of the mesh's
 * facets are not quite those of the surface and resist a little. A motion is free if the smooth surface resists it by
 * less than this share of what the facets do, both as squares. Whatever held it would be the mesh, not the body. */
static const double of_facets = 0.25;

/* Directions that facets resist by less than this share of the most, as squares, are left to the check of free
 * motions. */
static const double resisted = 1e-10;

/* The squares that rows sum up to: R'R. */
static void square(const double triangle[OST_ROWS], double product[OST_ROWS])
{
    double transposed[OST_ROWS];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            transposed[6 * i + j] = triangle[6 * j + i];
    ost_rows_multiply(transposed, triangle, product);
}

/* Motions that facets resist by 1 each, orthogonal in that: `count` rows. */
static OstStatus find_resisted(OstContext *ctx, const double facets[OST_ROWS], int *count, double motion[OST_ROWS])
{
    double product[OST_ROWS], values[6], vectors[OST_ROWS];
    square(facets, product);
    OST_TRY(ost_symmetric_eigen(ctx, 6, product, values, vectors));
    *count = 0;
    for (int k = 0; k < 6; k++) {
        if (values[k] <= resisted * values[5])
            continue;
        for (int i = 0; i < 6; i++)
            motion[6 * *count + i] = vectors[6 * k + i] / sqrt(values[k]);
        (*count)++;
    }
    return OST_SUCCESS;
}

/* Takes the motion out of what facets resist, which they do by 1. */
static void set_free(double facets[OST_ROWS], const double motion[6])
{
    double resists[6], row[6] = {0.0};
    ost_apply6(facets, motion, resists);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            row[j] += resists[i] * facets[6 * i + j];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            facets[6 * i + j] -= resists[i] * row[j];
}

/* Sets those motions free that the smooth surface hardly resists, and counts them. */
static OstStatus set_round_motions_free(OstContext *ctx, const double smooth[OST_ROWS], double facets[OST_ROWS],
                                        int *freed)
{
    double product[OST_ROWS], motion[OST_ROWS], small[OST_ROWS], values[6], vectors[OST_ROWS];
    int count;
    OST_TRY(find_resisted(ctx, facets, &count, motion));
    square(smooth, product);
    for (int i = 0; i < count; i++) {
        double resists[6];
        ost_apply6(product, motion + 6 * i, resists);
        for (int j = 0; j < count; j++)
            small[count * i + j] = ost_dot6(resists, motion + 6 * j);
    }
    OST_TRY(ost_symmetric_eigen(ctx, count, small, values, vectors));
    for (int k = 0; k < count && values[k] < of_facets; k++) {
        double free[6] = {0.0};
        for (int i = 0; i < count; i++)
            for (int j = 0; j < 6; j++)
                free[j] += vectors[count * k + i] * motion[6 * i + j];
        set_free(facets, free);
        (*freed)++;
    }
    return OST_SUCCESS;
}

static void keep(OstTies *ties, OstLocal *kept, const OstTie *tie)
{
    OstTie *last = *kept > 0 ? &ties->tie[*kept - 1] : NULL;
    if (!last || last->body[0] != tie->body[0] || last->body[1] != tie->body[1]) {
        last = &ties->tie[(*kept)++];
        *last = *tie;
        return;
    }
    for (int r = 0; r < 6; r++)
        ost_rows_add(last->triangle, tie->triangle + 6 * r);
}

OstStatus ost_ties_settle_beds(OstContext *ctx, OstTies *ties)
{
    OstLocal kept = 0;
    for (OstLocal i = 0; i < ties->count; i++) {
        OstTie tie = ties->tie[i];
        if (tie.body[1] == OST_TIE_FACETS) { /* the smooth ones of the component follow */
            OST_TRY(set_round_motions_free(ctx, ties->tie[++i].triangle, tie.triangle, &ties->facets_hold));
            tie.body[1] = OST_TIE_SUPPORT;
        }
        keep(ties, &kept, &tie);
    }
    ties->count = kept;
    return OST_SUCCESS;
}
