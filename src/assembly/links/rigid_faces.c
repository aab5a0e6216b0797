/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/rigid_faces.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

static int has_faces(const OstLinks *links)
{
    return links && links->face_count > 0;
}

/* The face that an owned node or a ghost belongs to, or NULL; its place relative to a point. */
static OstRigidFace *face_of(const OstLinks *links, const OstLink *link, const double *from, double arm[3])
{
    const double *x = links->mesh->coordinates + 3 * (size_t)link->node;
    if (link->face < 0)
        return NULL;
    for (int i = 0; i < 3; i++)
        arm[i] = x[i] - from[i];
    return &links->face[link->face];
}

/* --- the shape of faces --- */

static OstStatus find_middles(OstLinks *links, double *sums)
{
    static const double origin[3] = {0.0};
    for (OstLocal i = 0; i < links->count; i++) {
        double x[3];
        const int f = links->link[i].face;
        if (!face_of(links, &links->link[i], origin, x))
            continue;
        for (int c = 0; c < 3; c++)
            sums[4 * f + c] += x[c];
        sums[4 * f + 3] += 1.0;
    }
    OST_TRY(ost_sum(links->ctx, 4 * links->face_count, sums));
    for (int f = 0; f < links->face_count; f++)
        for (int c = 0; c < 3; c++)
            links->face[f].middle[c] = sums[4 * f + c] / sums[4 * f + 3];
    return OST_SUCCESS;
}

static OstStatus find_axes(OstLinks *links, double *sums)
{
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        double arm[3];
        if (link->face < 0 || !face_of(links, link, links->face[link->face].middle, arm))
            continue;
        for (int k = 0; k < 9; k++)
            sums[9 * link->face + k] += arm[k / 3] * arm[k % 3];
    }
    OST_TRY(ost_sum(links->ctx, 9 * links->face_count, sums));
    for (int f = 0; f < links->face_count; f++) {
        OstRigidFace *face = &links->face[f];
        double values[3], vectors[9];
        OST_TRY(ost_symmetric_eigen(links->ctx, 3, sums + 9 * f, values, vectors));
        for (int k = 0; k < 3; k++)
            face->extent[k] = values[2 - k];
        memcpy(face->axis, vectors + 6, 3 * sizeof *vectors);
        memcpy(face->axis + 3, vectors + 3, 3 * sizeof *vectors);
        ost_cross3(face->axis, face->axis + 3, face->axis + 6);
    }
    return OST_SUCCESS;
}

OstStatus ost_rigid_faces_measure(OstLinks *links)
{
    double *sums = NULL;
    if (!has_faces(links))
        return OST_SUCCESS;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &sums, 13 * (size_t)links->face_count)));
    OstStatus status = find_middles(links, sums);
    OST_THEN(ost_agree(links->ctx, find_axes(links, sums + 4 * links->face_count)));
    OST_FREE(sums);
    OST_THEN(ost_rigid_faces_turn(links, NULL));
    return status;
}

/* --- rotations --- */

void ost_rigid_motion_slope(const OstRigidMotion *motion, double slope[9])
{
    const double *v = motion->turn + 1, square = ost_dot3(v, v);
    const double across[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    for (int k = 0; k < 9; k++)
        slope[k] = 2.0 * (motion->turn[0] * across[k] + v[k / 3] * v[k % 3] - (k % 4 == 0 ? square : 0.0));
}

/* By a quaternion: first `before`, then `by`. */
static void compose(const double by[4], const double before[4], double turn[4])
{
    double crossed[3];
    ost_cross3(by + 1, before + 1, crossed);
    for (int i = 1; i < 4; i++)
        crossed[i - 1] += by[0] * before[i] + before[0] * by[i];
    turn[0] = by[0] * before[0] - ost_dot3(by + 1, before + 1);
    memcpy(turn + 1, crossed, sizeof crossed);
}

void ost_rigid_motion_turn_by(const double vector[3], OstRigidMotion *motion)
{
    const double half = 0.5 * ost_norm3(vector), share = half > 0.0 ? 0.5 * sin(half) / half : 0.5;
    const double by[4] = {cos(half), share * vector[0], share * vector[1], share * vector[2]};
    compose(by, motion->turn, motion->turn);
}

/* The vector of the rotation from one motion to another. */
static void turn_between(const OstRigidMotion *from, const OstRigidMotion *to, double vector[3])
{
    const double back[4] = {from->turn[0], -from->turn[1], -from->turn[2], -from->turn[3]};
    double turn[4];
    compose(to->turn, back, turn);
    const double size = ost_norm3(turn + 1), sign = turn[0] < 0.0 ? -1.0 : 1.0;
    const double share = size > 0.0 ? 2.0 * sign * atan2(size, fabs(turn[0])) / size : 2.0;
    for (int i = 0; i < 3; i++)
        vector[i] = share * turn[1 + i];
}

void ost_rigid_motion_vector(const OstRigidMotion *motion, double vector[3])
{
    turn_between(&(OstRigidMotion){.turn = {1.0, 0.0, 0.0, 0.0}}, motion, vector);
}

void ost_rigid_motion_set_vector(const double vector[3], OstRigidMotion *motion)
{
    memcpy(motion->turn, (double[]){1.0, 0.0, 0.0, 0.0}, sizeof motion->turn);
    ost_rigid_motion_turn_by(vector, motion);
}

/* T = I + a V + b V², with V x = v × x, a = (1 - cos |v|) / |v|² and b = (|v| - sin |v|) / |v|³, by their series; and
 * their derivatives by |v|, over |v|. */
typedef struct Exponential {
    double a, b, slope_a, slope_b;
} Exponential;

static Exponential exponential_of(const double vector[3])
{
    enum { TERMS = 20 }; /* for |v| up to 2 pi */
    const double square = ost_dot3(vector, vector);
    Exponential sum = {0.0, 0.0, 0.0, 0.0};
    double term = 0.5, slope = 0.0; /* (-|v|²)^k / (2k + 2)!, and its derivative */
    for (int k = 0; k < TERMS; k++) {
        const double both = (2 * k + 3) * (2 * k + 4);
        sum.a += term;
        sum.b += term / (2 * k + 3);
        sum.slope_a += slope;
        sum.slope_b += slope / (2 * k + 3);
        slope = -2.0 * (k + 1) * term / both;
        term *= -square / both;
    }
    return sum;
}

void ost_rigid_vector_turning(const double vector[3], double turning[9])
{
    const Exponential of = exponential_of(vector);
    const double *v = vector, square = ost_dot3(v, v);
    const double across[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    for (int k = 0; k < 9; k++)
        turning[k] = of.a * across[k] + of.b * v[k / 3] * v[k % 3] + (k % 4 == 0 ? 1.0 - of.b * square : 0.0);
}

/* T'S T, and of p.T'[p] p, whose moment is m: (v.p) (c.p) + b (m.v) p.p. */
void ost_rigid_face_turn_vector(const OstRigidFace *face, const double moment[3], double sum[9])
{
    double vector[3], turning[9], product[9], across[3], c[3];
    ost_rigid_motion_vector(&face->now, vector);
    const Exponential of = exponential_of(vector);
    const double along = ost_dot3(moment, vector), square = ost_dot3(vector, vector);
    ost_rigid_vector_turning(vector, turning);
    ost_multiply3(sum, turning, product);
    ost_multiply3_transposed_left(turning, product, sum);
    ost_cross3(moment, vector, across);
    for (int i = 0; i < 3; i++)
        c[i] = of.slope_a * across[i] + of.slope_b * (along * vector[i] - square * moment[i]) - of.b * moment[i];
    for (int k = 0; k < 9; k++)
        sum[k] += 0.5 * (vector[k / 3] * c[k % 3] + c[k / 3] * vector[k % 3]) + (k % 4 == 0 ? of.b * along : 0.0);
}

/* The unit quaternion of R = slope + I; a small rotation keeps its digits. */
static void find_turn(const double slope[9], double turn[4])
{
    const double trace = slope[0] + slope[4] + slope[8];
    if (trace > -2.0) {
        turn[0] = sqrt(1.0 + 0.25 * trace);
        for (int i = 0, j = 1, k = 2; i < 3; i++, j = (i + 1) % 3, k = (i + 2) % 3)
            turn[1 + i] = 0.25 * (slope[3 * k + j] - slope[3 * j + k]) / turn[0];
    } else {
        int i = slope[4] > slope[0] ? 1 : 0;
        i = slope[8] > slope[4 * i] ? 2 : i;
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double most = 0.5 * sqrt(fmax(2.0 * slope[4 * i] - trace, 0.0));
        turn[1 + i] = most;
        turn[1 + j] = 0.25 * (slope[3 * i + j] + slope[3 * j + i]) / most;
        turn[1 + k] = 0.25 * (slope[3 * i + k] + slope[3 * k + i]) / most;
        turn[0] = 0.25 * (slope[3 * k + j] - slope[3 * j + k]) / most;
    }
    const double size = sqrt(turn[0] * turn[0] + ost_dot3(turn + 1, turn + 1));
    for (int i = 0; i < 4; i++)
        turn[i] /= size;
}

/* --- motions of displacements --- */

/* A field on a face, as far as it is linear there: its mean, and its change along the two longer axes of the face. */
typedef struct Fit {
    double mean[3], along[2][3];
    double count;
} Fit;

enum { FIT_NUMBERS = sizeof(Fit) / sizeof(double) };

static OstStatus fit_field(const OstLinks *links, const double *field, Fit *fit)
{
    memset(fit, 0, (size_t)links->face_count * sizeof *fit);
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        const double *value = field + 3 * (size_t)link->node;
        double arm[3];
        if (link->face < 0)
            continue;
        const OstRigidFace *face = face_of(links, link, links->face[link->face].middle, arm);
        for (int c = 0; c < 3; c++) {
            fit[link->face].mean[c] += value[c];
            for (int k = 0; k < 2; k++)
                fit[link->face].along[k][c] += value[c] * ost_dot3(arm, face->axis + 3 * k) / face->extent[k];
        }
        fit[link->face].count += 1.0;
    }
    OST_TRY(ost_sum(links->ctx, FIT_NUMBERS * links->face_count, (double *)fit));
    for (int f = 0; f < links->face_count; f++)
        for (int c = 0; c < 3; c++)
            fit[f].mean[c] /= fit[f].count;
    return OST_SUCCESS;
}

static void find_motion(const OstRigidFace *face, const Fit *fit, OstRigidMotion *motion)
{
    double third[3], part[3], slope[9], moved[3], arm[3];
    ost_cross3(face->axis, fit->along[1], third);
    ost_cross3(fit->along[0], face->axis + 3, part);
    for (int i = 0; i < 3; i++)
        third[i] += part[i];
    ost_cross3(fit->along[0], fit->along[1], part);
    for (int i = 0; i < 3; i++)
        third[i] += part[i];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] =
                fit->along[0][i] * face->axis[j] + fit->along[1][i] * face->axis[3 + j] + third[i] * face->axis[6 + j];
    find_turn(slope, motion->turn);
    ost_rigid_motion_slope(motion, slope);
    for (int i = 0; i < 3; i++)
        arm[i] = face->middle[i] - face->point[i];
    ost_apply3(slope, arm, moved);
    for (int i = 0; i < 3; i++)
        motion->shift[i] = fit->mean[i] - moved[i];
}

OstStatus ost_rigid_faces_find(const OstLinks *links, const double *u, OstRigidMotion *motion)
{
    Fit *fit = NULL;
    for (int f = 0; links && f < links->face_count; f++)
        motion[f] = (OstRigidMotion){.turn = {1.0, 0.0, 0.0, 0.0}};
    if (!has_faces(links) || !u)
        return OST_SUCCESS;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &fit, links->face_count)));
    const OstStatus status = fit_field(links, u, fit);
    for (int f = 0; f < links->face_count && status == OST_SUCCESS; f++)
        find_motion(&links->face[f], &fit[f], &motion[f]);
    OST_FREE(fit);
    return status;
}

void ost_rigid_faces_put(const OstLinks *links, const OstRigidMotion *motion, double *u)
{
    for (OstLocal i = 0; i < links->all; i++) {
        const OstLink *link = &links->link[i];
        double arm[3], slope[9], moved[3];
        if (link->face < 0 || !face_of(links, link, links->face[link->face].point, arm))
            continue;
        ost_rigid_motion_slope(&motion[link->face], slope);
        ost_apply3(slope, arm, moved);
        for (int c = 0; c < 3; c++)
            u[3 * (size_t)link->node + (size_t)c] = motion[link->face].shift[c] + moved[c];
    }
}

/* R x */
static void turn_vector(const OstRigidMotion *motion, const double x[3], double turned[3])
{
    double slope[9];
    ost_rigid_motion_slope(motion, slope);
    ost_apply3(slope, x, turned);
    for (int i = 0; i < 3; i++)
        turned[i] += x[i];
}

static void set_weight(const OstRigidFace *face, const double arm[3], double weight[9])
{
    double vector[3], turning[9], columns[3][3];
    if (!face->by_vector) {
        ost_rigid_face_weight(face, arm, weight);
        return;
    }
    ost_rigid_motion_vector(&face->now, vector);
    ost_rigid_vector_turning(vector, turning);
    for (int k = 0; k < 3; k++) {
        const double turn[3] = {turning[k], turning[3 + k], turning[6 + k]};
        ost_cross3(turn, arm, columns[k]);
    }
    for (int n = 0; n < 9; n++)
        weight[n] = face->constrained[3 + n % 3] ? 0.0 : columns[n % 3][n / 3] / face->length;
}

OstStatus ost_rigid_faces_turn(OstLinks *links, const double *u)
{
    OstRigidMotion *motion = NULL;
    if (!has_faces(links))
        return OST_SUCCESS;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &motion, links->face_count)));
    const OstStatus status = ost_rigid_faces_find(links, u, motion);
    for (int f = 0; f < links->face_count; f++)
        links->face[f].now = motion[f];
    for (OstLocal i = 0; i < links->all && status == OST_SUCCESS; i++) {
        OstLink *link = &links->link[i];
        double arm[3];
        if (link->face < 0 || links->face[link->face].carrier[1] < 0)
            continue;
        const OstRigidFace *face = &links->face[link->face];
        ost_rigid_face_arm(links, link, arm);
        set_weight(face, arm, link->leader[face->carrier[0] < 0 ? 0 : 1].weight);
    }
    OST_FREE(motion);
    return status;
}

void ost_rigid_face_arm(const OstLinks *links, const OstLink *link, double arm[3])
{
    const OstRigidFace *face = &links->face[link->face];
    double before[3];
    face_of(links, link, face->point, before);
    turn_vector(&face->now, before, arm);
}

/* The motion per length that a field is at a face that is where `motion` takes it: of the point, and its rotation. */
static void find_rate(const OstRigidFace *face, const Fit *fit, const OstRigidMotion *motion, double shift[3],
                      double turn[3])
{
    double axis[3][3], arm[3], turned[3], moved[3];
    for (int k = 0; k < 3; k++)
        turn_vector(motion, face->axis + 3 * k, axis[k]);
    const double rate[3] = {ost_dot3(fit->along[1], axis[2]), -ost_dot3(fit->along[0], axis[2]),
                            0.5 * (ost_dot3(fit->along[0], axis[1]) - ost_dot3(fit->along[1], axis[0]))};
    for (int i = 0; i < 3; i++) {
        turn[i] = rate[0] * axis[0][i] + rate[1] * axis[1][i] + rate[2] * axis[2][i];
        arm[i] = face->middle[i] - face->point[i];
    }
    turn_vector(motion, arm, turned);
    ost_cross3(turn, turned, moved);
    for (int i = 0; i < 3; i++)
        shift[i] = fit->mean[i] - moved[i];
}

/* By the change of v that begins with a rotation. */
static void move_vector(const double turn[3], OstRigidMotion *motion)
{
    double vector[3], turning[9], inverse[9] = {0.0}, change[3];
    ost_rigid_motion_vector(motion, vector);
    ost_rigid_vector_turning(vector, turning);
    ost_invert3(turning, inverse);
    ost_apply3(inverse, turn, change);
    for (int i = 0; i < 3; i++)
        vector[i] += change[i];
    ost_rigid_motion_set_vector(vector, motion);
}

OstStatus ost_rigid_faces_move(const OstLinks *links, const double *from, const double *direction, double length,
                               double *to)
{
    OstRigidMotion *motion = NULL;
    Fit *fit = NULL;
    if (!has_faces(links))
        return OST_SUCCESS;
    OstStatus status = OST_NEW(links->ctx, &motion, links->face_count);
    OST_THEN(OST_NEW(links->ctx, &fit, links->face_count));
    status = ost_agree(links->ctx, status);
    OST_THEN(ost_rigid_faces_find(links, from, motion));
    OST_THEN(fit_field(links, direction, fit));
    for (int f = 0; f < links->face_count && status == OST_SUCCESS; f++) {
        double shift[3], turn[3];
        find_rate(&links->face[f], &fit[f], &motion[f], shift, turn);
        for (int i = 0; i < 3; i++) {
            motion[f].shift[i] += length * shift[i];
            turn[i] *= length;
        }
        if (links->face[f].by_vector)
            move_vector(turn, &motion[f]);
        else
            ost_rigid_motion_turn_by(turn, &motion[f]);
    }
    if (status == OST_SUCCESS)
        ost_rigid_faces_put(links, motion, to);
    OST_FREE(motion, fit);
    return status;
}

/* The rotation from one motion to another, per length of the curve, where it begins or ends. */
static void find_change(const OstRigidFace *face, const OstRigidMotion *from, const OstRigidMotion *to, int at_end,
                        double turn[3])
{
    double before[3], vector[3], turning[9], change[3];
    turn_between(from, to, turn);
    if (!face->by_vector)
        return;
    ost_rigid_motion_vector(from, before);
    ost_rigid_motion_vector(to, vector);
    for (int i = 0; i < 3; i++)
        change[i] = vector[i] - before[i];
    ost_rigid_vector_turning(at_end ? vector : before, turning);
    ost_apply3(turning, change, turn);
}

/* `motion`: where the faces are; and then, where they go. */
static void put_change(const OstLinks *links, const OstRigidMotion *motion, int at_end, double step, double *change)
{
    const OstRigidMotion *to = motion + links->face_count;
    for (OstLocal i = 0; i < links->all; i++) {
        const OstLink *link = &links->link[i];
        double arm[3], turned[3], turn[3], moved[3];
        if (link->face < 0)
            continue;
        const int f = link->face;
        face_of(links, link, links->face[f].point, arm);
        find_change(&links->face[f], &motion[f], &to[f], at_end, turn);
        turn_vector(at_end ? &to[f] : &motion[f], arm, turned);
        ost_cross3(turn, turned, moved);
        for (int c = 0; c < 3; c++)
            change[3 * (size_t)link->node + (size_t)c] = (to[f].shift[c] - motion[f].shift[c] + moved[c]) / step;
    }
}

OstStatus ost_rigid_faces_change(const OstLinks *links, const double *from, const double *to, int at_end, double step,
                                 double *change)
{
    OstRigidMotion *motion = NULL;
    if (!has_faces(links))
        return OST_SUCCESS;
    OST_TRY(ost_agree(links->ctx, OST_NEW(links->ctx, &motion, 2 * (size_t)links->face_count)));
    OstStatus status = ost_rigid_faces_find(links, from, motion);
    OST_THEN(ost_rigid_faces_find(links, to, motion + links->face_count));
    if (status == OST_SUCCESS)
        put_change(links, motion, at_end, step, change);
    OST_FREE(motion);
    return status;
}

void ost_rigid_face_add_moment(const OstLinks *links, int number, const double moment[3], double *force)
{
    const OstRigidFace *face = &links->face[number];
    const double all = face->extent[0] + face->extent[1] + face->extent[2];
    double turn[3] = {0.0};
    for (int k = 0; k < 3; k++) {
        double axis[3];
        turn_vector(&face->now, face->axis + 3 * k, axis);
        const double share = ost_dot3(moment, axis) / (all - face->extent[k]);
        for (int i = 0; i < 3; i++)
            turn[i] += share * axis[i];
    }
    for (OstLocal i = 0; i < links->count; i++) {
        double arm[3] = {0.0}, turned[3], part[3];
        if (links->link[i].face != number)
            continue;
        face_of(links, &links->link[i], face->middle, arm);
        turn_vector(&face->now, arm, turned);
        ost_cross3(turn, turned, part);
        for (int c = 0; c < 3; c++)
            force[3 * (size_t)links->link[i].node + (size_t)c] += part[c];
    }
}
