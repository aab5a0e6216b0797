/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/motion/motion.h"

#include "assembly/links/rigid_faces.h"
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

/* A body that turns by less goes straight on: the difference is a millionth of its size. */
static const double little = 1e-3;

/* One that bends or twists as well goes straight on too, where that is more than this share of its motion, squared:
 * held somewhere, it would be torn off by turning as a whole. A cantilever's deflection has 0.03. */
static const double most_rest = 0.01;

OstStatus ost_nearest_rotation(OstContext *ctx, const double f[9], OstRigidMotion *motion)
{
    double matrix[16], values[4], vectors[16];
    const double trace = f[0] + f[4] + f[8];
    matrix[0] = trace;
    for (int i = 0, j = 1, k = 2; i < 3; i++, j = (i + 1) % 3, k = (i + 2) % 3) {
        matrix[1 + i] = matrix[4 * (1 + i)] = f[3 * k + j] - f[3 * j + k];
        for (int l = 0; l < 3; l++)
            matrix[4 * (1 + i) + 1 + l] = f[3 * i + l] + f[3 * l + i] - (l == i ? trace : 0.0);
    }
    OST_TRY(ost_symmetric_eigen(ctx, 4, matrix, values, vectors));
    memcpy(motion->turn, vectors + 12, sizeof motion->turn);
    return OST_SUCCESS;
}

/* A place, and the mean of places or of vectors. */
static void find_place(const OstMesh *mesh, const double *u, size_t node, double place[3])
{
    for (size_t i = 0; i < 3; i++)
        place[i] = mesh->coordinates[3 * node + i] + u[3 * node + i];
}

static OstStatus find_mean(const OstMesh *mesh, const double *x, const double *u, double mean[3])
{
    memset(mean, 0, 3 * sizeof *mean);
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++)
        for (size_t i = 0; i < 3; i++)
            mean[i] += (x ? x[3 * n + i] : 0.0) + u[3 * n + i];
    OST_TRY(ost_sum(mesh->ctx, 3, mean));
    for (int i = 0; i < 3; i++)
        mean[i] /= (double)mesh->global_nodes;
    return OST_SUCCESS;
}

static void subtract(const double a[3], const double b[3], double difference[3])
{
    for (int i = 0; i < 3; i++)
        difference[i] = a[i] - b[i];
}

/* How far the centroid of a body comes that moves by v at first and turns by w: V v, V = integral of exp(s w). */
static void integrate(const double w[3], double v[9])
{
    const double angle = ost_norm3(w);
    const double first = angle > little ? (1.0 - cos(angle)) / (angle * angle) : 0.5;
    const double second = angle > little ? (angle - sin(angle)) / (angle * angle * angle) : 1.0 / 6.0;
    const double cross[9] = {0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0};
    double square[9];
    ost_multiply3(cross, cross, square);
    for (int n = 0; n < 9; n++)
        v[n] = (n % 4 == 0 ? 1.0 : 0.0) + first * cross[n] + second * square[n];
}

/* The nearest screw: of the centroid and about it. */
typedef struct Screw {
    double centre[3], speed[3], spin[3];
} Screw;

static OstStatus find_screw(const OstMesh *mesh, const double *from, const double *slope, Screw *screw)
{
    double sums[12] = {0.0}, inverse[9] = {0.0};
    OST_TRY(find_mean(mesh, mesh->coordinates, from, screw->centre));
    OST_TRY(find_mean(mesh, NULL, slope, screw->speed));
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double place[3], arm[3], moment[3];
        find_place(mesh, from, n, place);
        subtract(place, screw->centre, arm);
        ost_cross3(arm, slope + 3 * n, moment);
        for (int k = 0; k < 9; k++)
            sums[k] += (k % 4 == 0 ? ost_dot3(arm, arm) : 0.0) - arm[k / 3] * arm[k % 3];
        for (int i = 0; i < 3; i++)
            sums[9 + i] += moment[i];
    }
    OST_TRY(ost_sum(mesh->ctx, 12, sums));
    ost_invert3(sums, inverse);
    ost_apply3(inverse, sums + 9, screw->spin);
    return OST_SUCCESS;
}

/* What of a node's slope is not the motion of the whole, of that spin and speed about the centre. */
static void find_rest(const OstMesh *mesh, const double *from, const double *slope, const Screw *screw, size_t node,
                      double arm[3], double rest[3])
{
    double place[3], turned[3];
    find_place(mesh, from, node, place);
    subtract(place, screw->centre, arm);
    ost_cross3(screw->spin, arm, turned);
    for (size_t i = 0; i < 3; i++)
        rest[i] = slope[3 * node + i] - screw->speed[i] - turned[i];
}

/* Is nearly all of a slope that of a screw? */
static OstStatus is_whole(const OstMesh *mesh, const double *from, const double *slope, const Screw *screw, int *yes)
{
    double sums[2] = {0.0};
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double arm[3], rest[3];
        find_rest(mesh, from, slope, screw, n, arm, rest);
        sums[0] += ost_dot3(rest, rest);
        sums[1] += ost_dot3(slope + 3 * n, slope + 3 * n);
    }
    OST_TRY(ost_sum(mesh->ctx, 2, sums));
    *yes = sums[0] <= most_rest * sums[1];
    return OST_SUCCESS;
}

OstStatus ost_motion_predict(const OstMesh *mesh, const double *from, const double *slope, double length, double *whole,
                             double *to)
{
    const size_t count = 3 * (size_t)mesh->node_count;
    double turn[3], v[9], come[3], rotation[9];
    OstRigidMotion motion = {.turn = {1.0}};
    Screw screw;
    int turns = 0;
    OST_TRY(find_screw(mesh, from, slope, &screw));
    for (int i = 0; i < 3; i++)
        turn[i] = length * screw.spin[i];
    OST_TRY(is_whole(mesh, from, slope, &screw, &turns));
    if (!turns || ost_norm3(turn) <= little) {
        for (size_t i = 0; i < count; i++)
            to[i] = from[i] + length * slope[i];
        if (whole)
            memcpy(whole, from, count * sizeof *whole);
        return OST_SUCCESS;
    }
    ost_rigid_motion_set_vector(turn, &motion);
    ost_rigid_motion_slope(&motion, rotation);
    integrate(turn, v);
    ost_apply3(v, screw.speed, come);
    for (size_t n = 0; n < (size_t)mesh->node_count; n++) {
        double arm[3], turned[3], rest[3], rest_turned[3];
        find_rest(mesh, from, slope, &screw, n, arm, rest);
        ost_apply3(rotation, rest, rest_turned);
        ost_apply3(rotation, arm, turned);
        for (size_t i = 0; i < 3; i++) {
            const double as_whole = from[3 * n + i] + length * come[i] + turned[i];
            to[3 * n + i] = as_whole + length * (rest[i] + rest_turned[i]);
            if (whole)
                whole[3 * n + i] = as_whole;
        }
    }
    return OST_SUCCESS;
}

/* The rotation between two places of the body, and its vector. */
static OstStatus find_rotation(const OstMesh *mesh, const double *from, const double *to, const double before[3],
                               const double after[3], double rotation[9], double vector[3])
{
    double f[9] = {0.0};
    OstRigidMotion motion = {.turn = {1.0}};
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double place[3], arm[2][3];
        find_place(mesh, from, n, place);
        subtract(place, before, arm[0]);
        find_place(mesh, to, n, place);
        subtract(place, after, arm[1]);
        for (int k = 0; k < 9; k++)
            f[k] += arm[1][k / 3] * arm[0][k % 3];
    }
    OST_TRY(ost_sum(mesh->ctx, 9, f));
    OST_TRY(ost_agree(mesh->ctx, ost_nearest_rotation(mesh->ctx, f, &motion)));
    ost_rigid_motion_slope(&motion, rotation);
    ost_rigid_motion_vector(&motion, vector);
    return OST_SUCCESS;
}

OstStatus ost_motion_slope(const OstMesh *mesh, const double *from, const double *to, double length, double *slope)
{
    Screw screw;
    double before[3], come[3], rotation[9], vector[3], v[9], back[9] = {0.0}, turned[3];
    int turns = 0;
    OST_TRY(find_mean(mesh, mesh->coordinates, from, before));
    OST_TRY(find_mean(mesh, mesh->coordinates, to, screw.centre));
    OST_TRY(find_rotation(mesh, from, to, before, screw.centre, rotation, vector));
    integrate(vector, v);
    ost_invert3(v, back);
    subtract(screw.centre, before, come);
    ost_apply3(back, come, screw.speed);
    ost_apply3(rotation, screw.speed, turned); /* it turns with the body */
    for (int i = 0; i < 3; i++) {
        screw.speed[i] = (screw.speed[i] + turned[i]) / length;
        screw.spin[i] = vector[i] / length;
    }
    for (size_t n = 0; n < (size_t)mesh->node_count; n++) {
        double place[3], arm[2][3], spun[3];
        find_place(mesh, from, n, place);
        subtract(place, before, arm[0]);
        find_place(mesh, to, n, place);
        subtract(place, screw.centre, arm[1]);
        ost_cross3(screw.spin, arm[1], spun);
        ost_apply3(rotation, arm[0], turned);
        for (size_t i = 0; i < 3; i++)
            slope[3 * n + i] = screw.speed[i] + spun[i] + (arm[1][i] - arm[0][i] - turned[i]) / length;
    }
    OST_TRY(is_whole(mesh, to, slope, &screw, &turns));
    for (size_t i = 0; i < 3 * (size_t)mesh->node_count && (!turns || ost_norm3(vector) <= little); i++)
        slope[i] = (to[i] - from[i]) / length;
    return OST_SUCCESS;
}
