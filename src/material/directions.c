/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/directions.h"

#include "core/small.h"

#include <math.h>
#include <string.h>

enum { NODES = OST_DIRECTION_NODES };

/* Least cosine of a direction with the tet's own, least sine between two, and most length beside the mean. */
static const double least_cosine = 0.5, least_sine = 0.05, most_length = 5.0;

static const int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

void ost_directions_along(const int stated[2], int second, int along[2])
{
    along[0] = stated[0] < 0 ? 0 : stated[0];
    along[1] = stated[0] < 0 ? 1 : !second || stated[1] == stated[0] ? (along[0] + 1) % 3 : stated[1];
}

/* What of a vector is across another; NULL: all of it. */
static void take_across(const double *other, const double v[3], double across[3])
{
    const double along = other ? ost_dot3(other, v) / ost_dot3(other, other) : 0.0;
    for (int i = 0; i < 3; i++)
        across[i] = v[i] - (other ? along * other[i] : 0.0);
}

/* The vectors of one direction, of which what is across those of `other` is to be along the axis. Returns 0 if they are
 * no use. */
static int take_vectors(const double axis[3], const double *vectors, const double *other, float *components)
{
    double longest = 0.0, mean = 0.0;
    for (int n = 0; n < NODES; n++) {
        const double *v = vectors + 3 * n;
        double across[3];
        take_across(other ? other + 3 * n : NULL, v, across);
        const double length = ost_norm3(v), rest = ost_norm3(across), along = ost_dot3(axis, across);
        if (!(rest > least_sine * length) || !(fabs(along) > least_cosine * rest))
            return 0;
        longest = fmax(longest, length);
        mean += length / NODES;
        for (int i = 0; i < 3; i++)
            components[NODES * i + n] = (float)(along < 0.0 ? -v[i] : v[i]);
    }
    return longest <= most_length * mean;
}

static void take_axis(const double axis[3], float *components)
{
    for (int i = 0; i < 3; i++)
        for (int n = 0; n < NODES; n++)
            components[NODES * i + n] = (float)axis[i];
}

/* So that their squares are numbers of single precision, whatever the units. */
static void scale(const double *vectors, double scaled[3 * NODES])
{
    double largest = 0.0;
    for (int k = 0; k < 3 * NODES; k++)
        largest = fmax(largest, fabs(vectors[k]));
    for (int k = 0; k < 3 * NODES; k++)
        scaled[k] = largest > 0.0 ? vectors[k] / largest : 0.0;
}

void ost_directions_set(const double axes[9], const int along[2], const double *first, const double *second,
                        float directions[OST_DIRECTIONS])
{
    const double *axis[2] = {axes + 3 * along[0], axes + 3 * along[1]};
    double scaled[2][3 * NODES];
    scale(first, scaled[0]);
    if (second)
        scale(second, scaled[1]);
    const int follows = take_vectors(axis[0], scaled[0], NULL, directions) &&
                        (!second || take_vectors(axis[1], scaled[1], scaled[0], directions + OST_DIRECTIONS / 2));
    if (!follows)
        take_axis(axis[0], directions);
    if (!follows || !second)
        take_axis(axis[1], directions + OST_DIRECTIONS / 2);
}

/* Halfway along edges, of directions that are turned alike. */
static void add_middles(const double *at_vertices, double at_nodes[3 * NODES])
{
    memcpy(at_nodes, at_vertices, 12 * sizeof *at_nodes);
    for (int e = 0; e < 6; e++) {
        const double *a = at_vertices + 3 * edge[e][0], *b = at_vertices + 3 * edge[e][1];
        const double sense = ost_dot3(a, b) < 0.0 ? -1.0 : 1.0;
        for (int i = 0; i < 3; i++)
            at_nodes[12 + 3 * e + i] = 0.5 * (a[i] + sense * b[i]);
    }
}

void ost_directions_set_linear(const double axes[9], const int along[2], const double *first, const double *second,
                               float directions[OST_DIRECTIONS])
{
    double at_nodes[2][3 * NODES];
    add_middles(first, at_nodes[0]);
    if (second)
        add_middles(second, at_nodes[1]);
    ost_directions_set(axes, along, at_nodes[0], second ? at_nodes[1] : NULL, directions);
}

void ost_direction_shares(const double at[4], double share[NODES])
{
    for (int v = 0; v < 4; v++)
        share[v] = at[v] * (2.0 * at[v] - 1.0);
    for (int e = 0; e < 6; e++)
        share[4 + e] = 4.0 * at[edge[e][0]] * at[edge[e][1]];
}

OstStatus ost_directions_at(OstContext *ctx, const float directions[OST_DIRECTIONS], const signed char along[2],
                            const double at[4], double axes[9])
{
    double d[6] = {0.0}, share[NODES];
    ost_direction_shares(at, share);
    for (int n = 0; n < OST_DIRECTIONS; n++)
        d[n / NODES] += share[n % NODES] * (double)directions[n];
    return ost_axes_from_directions(ctx, (const int[2]){along[0], along[1]}, d, d + 3, axes);
}
