/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/distributing/selection.h"

#include "assembly/links/rigid_faces.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/boundary_conditions.h"
#include "solve/motion/motion.h"

#include <string.h>

/* A second moment of this share of the largest is none: the selection is flat. */
static const double flat = 1e-12;

/* A point this near to the centroid, beside the size of the selection, is there. */
static const double near_centre = 1e-9;

/* The step of differences by F, as a share of its largest second moment. */
static const double step = 1e-5;

/* --- the sums --- */

/* Forces of a + b × (X - c) on the selection. */
static OstStatus spread_on(const OstScene *scene, const OstLoad *load, const double mean[3], const double turn[3],
                           double centre[3], double *force)
{
    OstSpread spread = {.mean = {0.0}};
    OstLocal count = 0, *items = NULL;
    int on_faces = 0, nodes_per_face = 3;
    OstStatus status = ost_scene_spread(scene, load, 0, &on_faces, &count, &nodes_per_face, &items, &spread);
    if (status == OST_SUCCESS && !on_faces) {
        OST_FREE(items);
        status = ost_select_nodes(scene->c, scene->mesh, &load->on, &count, &items);
        OST_THEN(ost_spread_over_vertices(scene->mesh, count, items, &(OstResultant){.acts_at = 0}, &spread));
    }
    memcpy(spread.mean, mean, sizeof spread.mean);
    memcpy(spread.turn, turn, sizeof spread.turn);
    memset(force, 0, 3 * (size_t)scene->mesh->node_count * sizeof *force);
    if (status == OST_SUCCESS && on_faces)
        ost_load_spread_on_faces(scene->mesh, count, items, nodes_per_face, &spread, force);
    else if (status == OST_SUCCESS)
        ost_load_spread_on_vertices(scene->mesh, count, items, &spread, force);
    memcpy(centre, spread.centre, sizeof spread.centre);
    OST_FREE(items);
    return status;
}

/* Along the principal axes, from the centroid. */
static OstStatus find_axes(OstContext *ctx, const OstMesh *mesh, const double centre[3], OstMovedSelection *selection)
{
    double moments[9] = {0.0}, values[3], vectors[9];
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++)
        for (size_t k = 0; k < 9; k++)
            moments[k] += (mesh->coordinates[3 * n + k / 3] - centre[k / 3]) * selection->arm[3 * n + k % 3];
    OST_TRY(ost_sum(ctx, 9, moments));
    OST_TRY(ost_symmetric_eigen(ctx, 3, moments, values, vectors));
    for (int k = 0; k < 3; k++) {
        selection->extent[k] = fmax(values[2 - k], 0.0);
        memcpy(selection->axis + 3 * k, vectors + 3 * (2 - k), 3 * sizeof *vectors);
        selection->sums += selection->extent[k] > flat * selection->extent[0] ? 3 : 0;
    }
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double along[3];
        ost_apply3(selection->axis, selection->arm + 3 * n, along);
        memcpy(selection->arm + 3 * n, along, sizeof along);
    }
    return OST_SUCCESS;
}

/* A point at the centroid that does not turn moves with the mean displacement alone; other motions turn. */
static OstStatus check_turning(const OstScene *scene, double area, OstMovedSelection *selection)
{
    const int *moved = selection->load->moved;
    const double beside = near_centre * near_centre * selection->extent[0] / area;
    if (!moved[3] && !moved[4] && !moved[5] && ost_dot3(selection->point, selection->point) <= beside)
        selection->sums = 3;
    else if (selection->sums < 9)
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                         "%s:%d: the selection of this distributing coupling lies on one line, about which no rotation "
                         "is known; select more, put 'at' at its centroid and give no rotation, or say large_rotation: "
                         "off",
                         scene->c->path, selection->load->line);
    return OST_SUCCESS;
}

static OstStatus measure(const OstScene *scene, double *force, OstMovedSelection *selection)
{
    static const double none[3] = {0.0}, x[3] = {1.0, 0.0, 0.0}, z[3] = {0.0, 0.0, 1.0};
    const size_t owned = (size_t)scene->mesh->owned_nodes;
    double centre[3], area = 0.0;
    OST_TRY(spread_on(scene, selection->load, x, none, centre, force));
    for (size_t n = 0; n < owned; n++)
        area += selection->share[n] = force[3 * n];
    OST_TRY(ost_sum(scene->ctx, 1, &area));
    selection->area = area;
    OST_TRY(spread_on(scene, selection->load, none, z, centre, force));
    for (size_t n = 0; n < owned; n++) {
        selection->share[n] /= area;
        selection->arm[3 * n] = force[3 * n + 1];
        selection->arm[3 * n + 1] = -force[3 * n];
    }
    OST_TRY(spread_on(scene, selection->load, none, x, centre, force));
    for (size_t n = 0; n < owned; n++)
        selection->arm[3 * n + 2] = -force[3 * n + 1];
    for (int i = 0; i < 3; i++)
        selection->point[i] = selection->load->at[i] - centre[i];
    OST_TRY(find_axes(scene->ctx, scene->mesh, centre, selection));
    return check_turning(scene, area, selection);
}

/* --- the motion --- */

/* A state of one selection. */
typedef struct Motion {
    double displacement[3], vector[3];    /* of the point; of the rotation, from the given one if all of it is */
    double axis[3][3], point[3], spin[9]; /* R times the axes, and the point; spin: by which moments of F turn R */
    double turning[9];                    /* the vector's change by a rotation */
} Motion;

static void gradient_of_place(const OstMovedSelection *selection, const double *z, double f[9])
{
    memset(f, 0, 9 * sizeof *f);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            const double along = selection->extent[k] * selection->axis[3 * k + i] +
                                 (3 * (k + 2) <= selection->sums ? z[3 + 3 * k + i] : 0.0);
            for (int j = 0; j < 3; j++)
                f[3 * i + j] += along * selection->axis[3 * k + j];
        }
}

/* The vector of R, or of R from the given rotation; and what it changes by where R turns on. */
static void find_vector(const OstMovedSelection *selection, const OstRigidMotion *turn, Motion *motion)
{
    double back[3], turning[9];
    OstRigidMotion left = *turn;
    ost_rigid_motion_vector(turn, motion->vector);
    if (selection->turns_wholly) {
        for (int i = 0; i < 3; i++)
            back[i] = -selection->given[selection->count - 3 + i];
        ost_rigid_motion_set_vector(back, &left);
        ost_rigid_motion_turn_by(motion->vector, &left);
        ost_rigid_motion_vector(&left, motion->vector);
    }
    memset(motion->turning, 0, sizeof motion->turning);
    ost_rigid_vector_turning(motion->vector, turning);
    ost_invert3(turning, motion->turning);
}

static OstStatus find_motion(OstContext *ctx, const OstMovedSelection *selection, const double *z, Motion *motion)
{
    double f[9], slope[9], rotation[9], stretch[9], inertia[9];
    OstRigidMotion turn;
    gradient_of_place(selection, z, f);
    OST_TRY(ost_nearest_rotation(ctx, f, &turn));
    ost_rigid_motion_slope(&turn, slope);
    ost_apply3(slope, selection->point, motion->point);
    for (int i = 0; i < 3; i++) {
        motion->displacement[i] = z[i] + motion->point[i];
        motion->point[i] += selection->point[i];
    }
    for (int n = 0; n < 9; n++)
        rotation[n] = slope[n] + (n % 4 == 0 ? 1.0 : 0.0);
    for (int k = 0; k < 3; k++)
        ost_apply3(rotation, selection->axis + 3 * k, motion->axis[k]);
    for (int n = 0; n < 9; n++)
        stretch[n] = ost_dot3(f + (size_t)(n / 3) * 3, rotation + (size_t)(n % 3) * 3);
    for (int n = 0; n < 9; n++)
        inertia[n] = (n % 4 == 0 ? stretch[0] + stretch[4] + stretch[8] : 0.0) -
                     0.5 * (stretch[n] + stretch[3 * (n % 3) + n / 3]);
    memset(motion->spin, 0, sizeof motion->spin);
    ost_invert3(inertia, motion->spin);
    find_vector(selection, &turn, motion);
    return OST_SUCCESS;
}

/* The derivative of one component by the selection's sums. */
static void find_slope(const OstMovedSelection *selection, const Motion *motion, int component, double *slope)
{
    for (int s = 0; s < selection->sums; s++) {
        const double direction[3] = {s % 3 == 0, s % 3 == 1, s % 3 == 2};
        double moment[3], turn[3], moved[3];
        if (s < 3) {
            slope[s] = component == s ? 1.0 : 0.0;
            continue;
        }
        ost_cross3(motion->axis[s / 3 - 1], direction, moment);
        ost_apply3(motion->spin, moment, turn);
        if (component < 3)
            ost_cross3(turn, motion->point, moved);
        else
            ost_apply3(motion->turning, turn, moved);
        slope[s] = moved[component % 3];
    }
}

/* h of one selection at z. */
static OstStatus find_resultant(OstContext *ctx, const OstMovedSelection *selection, const double *z, const double *x,
                                double *h)
{
    Motion motion;
    double slope[OST_MOST_SUMS];
    OST_TRY(find_motion(ctx, selection, z, &motion));
    memset(h, 0, (size_t)selection->sums * sizeof *h);
    for (int k = 0; k < selection->count; k++) {
        find_slope(selection, &motion, selection->component[k], slope);
        for (int s = 0; s < selection->sums; s++)
            h[s] += x[k] * slope[s];
    }
    return OST_SUCCESS;
}

/* h_z of one selection by differences, which the few sums allow; symmetric, as h is a gradient. */
static OstStatus find_bend(OstContext *ctx, const OstMovedSelection *selection, const double *z, const double *x,
                           int width, double *bend)
{
    const double length = step * selection->extent[0];
    double at[OST_MOST_SUMS], h[2][OST_MOST_SUMS], found[OST_MOST_SUMS][OST_MOST_SUMS] = {{0.0}};
    for (int s = 3; s < selection->sums; s++) {
        for (int side = 0; side < 2; side++) {
            memcpy(at, z, (size_t)selection->sums * sizeof *at);
            at[s] += side ? -length : length;
            OST_TRY(find_resultant(ctx, selection, at, x, h[side]));
        }
        for (int k = 3; k < selection->sums; k++)
            found[s][k] = (h[0][k] - h[1][k]) / (2.0 * length);
    }
    for (int s = 0; s < selection->sums; s++)
        for (int k = 0; k < selection->sums; k++)
            bend[s * width + k] = 0.5 * (found[s][k] + found[k][s]);
    return OST_SUCCESS;
}

OstStatus ost_moved_selection_state(OstContext *ctx, const OstMovedSelection *selection, const double *z,
                                    const double *x, int width, double *lack, double *slope, double *h, double *bend)
{
    Motion motion;
    OST_TRY(find_motion(ctx, selection, z, &motion));
    for (int k = 0; k < selection->count; k++) {
        const int component = selection->component[k];
        const double now = component < 3 ? motion.displacement[component] : motion.vector[component - 3];
        find_slope(selection, &motion, component, slope + k * width);
        lack[k] = (component >= 3 && selection->turns_wholly ? 0.0 : selection->given[k]) - now;
    }
    OST_TRY(find_resultant(ctx, selection, z, x, h));
    return find_bend(ctx, selection, z, x, width, bend);
}

OstStatus ost_moved_selection_open(const OstScene *scene, int load, double *force, OstMovedSelection *selection)
{
    const size_t owned = (size_t)scene->mesh->owned_nodes;
    *selection = (OstMovedSelection){.load = &scene->c->loads[load], .sums = 3};
    const int *moved = selection->load->moved;
    for (int k = 0; k < OST_MOST_GIVEN; k++)
        if (moved[k])
            selection->component[selection->count++] = k;
    selection->turns_wholly = moved[3] && moved[4] && moved[5];
    OstStatus status = OST_NEW(scene->ctx, &selection->share, owned);
    OST_THEN(OST_NEW(scene->ctx, &selection->arm, 3 * owned));
    status = ost_agree(scene->ctx, status);
    OST_THEN(measure(scene, force, selection));
    return status;
}

void ost_moved_selection_close(OstMovedSelection *selection)
{
    OST_FREE(selection->share, selection->arm);
}
