/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/distributing/turned.h"

#include "assembly/links/rigid_faces.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/boundary_conditions.h"
#include "solve/distributing/distributing.h"

#include <string.h>

extern void dgesv_(const int *n, const int *columns, double *a, const int *leading, int *pivot, double *b,
                   const int *leading_b, int *info);

extern void dsyev_(const char *jobz, const char *uplo, const int *n, double *a, const int *leading, double *w,
                   double *work, const int *room, int *info, size_t length_jobz, size_t length_uplo);

enum { MOST_SUMS = 12, MOST_GIVEN = 6 };

/* A second moment of this share of the largest is none: the selection is flat. */
static const double flat = 1e-12;

/* The step of differences by F, as a share of its largest second moment. */
static const double step = 1e-5;

typedef struct Coupling {
    const OstLoad *load;
    double *share, *arm; /* of owned nodes: the mean displacement's weights; integrals of N (X - c), along the axes */
    double axis[9];      /* principal axes of the selection as rows, the longest first, */
    double extent[3];    /* and its second moments along them */
    double point[3];     /* from the centroid c */
    int sums;            /* 3 + 3 × axes along which it extends: the mean displacement, and F along these */
    int turns_wholly;    /* are all components of its rotation given? */
    int count, component[MOST_GIVEN];
    double given[MOST_GIVEN]; /* now */
} Coupling;

struct OstTurnedCouplings {
    OstProblem *problem;
    size_t unknowns;
    int count;
    Coupling *coupling;
    int sums, components; /* of all couplings */
    double *z, *h;        /* sums */
    double *lack, *x;     /* components: g - c, and the multipliers */
    double *slope;        /* components × sums: c' */
    double *bend;         /* sums × sums: h_z */
    double *response;     /* sums × unknowns: K^-1 Y' */
    double *compliance;   /* sums × sums: Y K^-1 Y'; 0 before the first correction */
    double *unit, *stiff; /* components: the norm of the forces of a unit, and their size for a unit of motion */
};

/* --- the sums --- */

/* Forces of a + b × (X - c) on the selection. */
static OstStatus spread_on(const OstScene *scene, const OstLoad *load, const double mean[3], const double turn[3],
                           double centre[3], double *force)
{
    OstSpread spread = {.mean = {0.0}};
    OstLocal count = 0, *items = NULL;
    int on_faces = 0, nodes_per_face = 3;
    OstStatus status = ost_scene_spread(scene, load, &on_faces, &count, &nodes_per_face, &items, &spread);
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

/* Along the principal axes. */
static OstStatus find_axes(OstContext *ctx, const OstMesh *mesh, Coupling *coupling)
{
    double moments[9] = {0.0}, values[3], vectors[9];
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++)
        for (size_t k = 0; k < 9; k++)
            moments[k] += mesh->coordinates[3 * n + k / 3] * coupling->arm[3 * n + k % 3];
    OST_TRY(ost_sum(ctx, 9, moments));
    OST_TRY(ost_symmetric_eigen(ctx, 3, moments, values, vectors));
    for (int k = 0; k < 3; k++) {
        coupling->extent[k] = fmax(values[2 - k], 0.0);
        memcpy(coupling->axis + 3 * k, vectors + 3 * (2 - k), 3 * sizeof *vectors);
        coupling->sums += coupling->extent[k] > flat * coupling->extent[0] ? 3 : 0;
    }
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double along[3];
        ost_apply3(coupling->axis, coupling->arm + 3 * n, along);
        memcpy(coupling->arm + 3 * n, along, sizeof along);
    }
    return OST_SUCCESS;
}

static OstStatus measure(const OstScene *scene, double *force, Coupling *coupling)
{
    static const double none[3] = {0.0}, x[3] = {1.0, 0.0, 0.0}, z[3] = {0.0, 0.0, 1.0};
    const size_t owned = (size_t)scene->mesh->owned_nodes;
    double centre[3], area = 0.0;
    OST_TRY(spread_on(scene, coupling->load, x, none, centre, force));
    for (size_t n = 0; n < owned; n++)
        area += coupling->share[n] = force[3 * n];
    OST_TRY(ost_sum(scene->ctx, 1, &area));
    OST_TRY(spread_on(scene, coupling->load, none, z, centre, force));
    for (size_t n = 0; n < owned; n++) {
        coupling->share[n] /= area;
        coupling->arm[3 * n] = force[3 * n + 1];
        coupling->arm[3 * n + 1] = -force[3 * n];
    }
    OST_TRY(spread_on(scene, coupling->load, none, x, centre, force));
    for (size_t n = 0; n < owned; n++)
        coupling->arm[3 * n + 2] = -force[3 * n + 1];
    for (int i = 0; i < 3; i++)
        coupling->point[i] = coupling->load->at[i] - centre[i];
    return find_axes(scene->ctx, scene->mesh, coupling);
}

/* A row of Y: the weight of a sum at an owned node is of one component of its displacement. */
static double weight_of(const Coupling *coupling, int sum, size_t node)
{
    return sum < 3 ? coupling->share[node] : coupling->arm[3 * node + (size_t)(sum / 3 - 1)];
}

/* --- the motion --- */

/* A state of one coupling. */
typedef struct Motion {
    double displacement[3], vector[3];    /* of the point; of the rotation, from the given one if all of it is */
    double axis[3][3], point[3], spin[9]; /* R times the axes, and the point; spin: by which moments of F turn R */
    double turning[9];                    /* the vector's change by a rotation */
} Motion;

/* The quaternion of the rotation nearest to F (B. K. P. Horn, Closed-form solution of absolute orientation using unit
 * quaternions, J. Opt. Soc. Am. A 4, 1987). */
static OstStatus nearest_rotation(OstContext *ctx, const double f[9], OstRigidMotion *motion)
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

static void gradient_of_place(const Coupling *coupling, const double *z, double f[9])
{
    memset(f, 0, 9 * sizeof *f);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            const double along = coupling->extent[k] * coupling->axis[3 * k + i] +
                                 (3 * (k + 2) <= coupling->sums ? z[3 + 3 * k + i] : 0.0);
            for (int j = 0; j < 3; j++)
                f[3 * i + j] += along * coupling->axis[3 * k + j];
        }
}

/* The vector of R, or of R from the given rotation; and what it changes by where R turns on. */
static void find_vector(const Coupling *coupling, const OstRigidMotion *turn, Motion *motion)
{
    double back[3], turning[9];
    OstRigidMotion left = *turn;
    ost_rigid_motion_vector(turn, motion->vector);
    if (coupling->turns_wholly) {
        for (int i = 0; i < 3; i++)
            back[i] = -coupling->given[coupling->count - 3 + i];
        ost_rigid_motion_set_vector(back, &left);
        ost_rigid_motion_turn_by(motion->vector, &left);
        ost_rigid_motion_vector(&left, motion->vector);
    }
    memset(motion->turning, 0, sizeof motion->turning);
    ost_rigid_vector_turning(motion->vector, turning);
    ost_invert3(turning, motion->turning);
}

static OstStatus find_motion(OstContext *ctx, const Coupling *coupling, const double *z, Motion *motion)
{
    double f[9], slope[9], rotation[9], stretch[9], inertia[9];
    OstRigidMotion turn;
    gradient_of_place(coupling, z, f);
    OST_TRY(nearest_rotation(ctx, f, &turn));
    ost_rigid_motion_slope(&turn, slope);
    ost_apply3(slope, coupling->point, motion->point);
    for (int i = 0; i < 3; i++) {
        motion->displacement[i] = z[i] + motion->point[i];
        motion->point[i] += coupling->point[i];
    }
    for (int n = 0; n < 9; n++)
        rotation[n] = slope[n] + (n % 4 == 0 ? 1.0 : 0.0);
    for (int k = 0; k < 3; k++)
        ost_apply3(rotation, coupling->axis + 3 * k, motion->axis[k]);
    for (int n = 0; n < 9; n++)
        stretch[n] = ost_dot3(f + (size_t)(n / 3) * 3, rotation + (size_t)(n % 3) * 3);
    for (int n = 0; n < 9; n++)
        inertia[n] = (n % 4 == 0 ? stretch[0] + stretch[4] + stretch[8] : 0.0) -
                     0.5 * (stretch[n] + stretch[3 * (n % 3) + n / 3]);
    memset(motion->spin, 0, sizeof motion->spin);
    ost_invert3(inertia, motion->spin);
    find_vector(coupling, &turn, motion);
    return OST_SUCCESS;
}

/* The derivative of one component by the coupling's sums. */
static void find_slope(const Coupling *coupling, const Motion *motion, int component, double *slope)
{
    for (int s = 0; s < coupling->sums; s++) {
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

/* h of one coupling at z. */
static OstStatus find_resultant(OstContext *ctx, const Coupling *coupling, const double *z, const double *x, double *h)
{
    Motion motion;
    double slope[MOST_SUMS];
    OST_TRY(find_motion(ctx, coupling, z, &motion));
    memset(h, 0, (size_t)coupling->sums * sizeof *h);
    for (int k = 0; k < coupling->count; k++) {
        find_slope(coupling, &motion, coupling->component[k], slope);
        for (int s = 0; s < coupling->sums; s++)
            h[s] += x[k] * slope[s];
    }
    return OST_SUCCESS;
}

/* h_z of one coupling by differences, which the few sums allow; symmetric, as h is a gradient. */
static OstStatus find_bend(OstContext *ctx, const Coupling *coupling, const double *z, const double *x, int width,
                           double *bend)
{
    const double length = step * coupling->extent[0];
    double at[MOST_SUMS], h[2][MOST_SUMS], found[MOST_SUMS][MOST_SUMS] = {{0.0}};
    for (int s = 3; s < coupling->sums; s++) {
        for (int side = 0; side < 2; side++) {
            memcpy(at, z, (size_t)coupling->sums * sizeof *at);
            at[s] += side ? -length : length;
            OST_TRY(find_resultant(ctx, coupling, at, x, h[side]));
        }
        for (int k = 3; k < coupling->sums; k++)
            found[s][k] = (h[0][k] - h[1][k]) / (2.0 * length);
    }
    for (int s = 0; s < coupling->sums; s++)
        for (int k = 0; k < coupling->sums; k++)
            bend[s * width + k] = 0.5 * (found[s][k] + found[k][s]);
    return OST_SUCCESS;
}

static OstStatus find_state(OstTurnedCouplings *all)
{
    OstContext *ctx = all->problem->ctx;
    int first = 0, row = 0;
    for (int c = 0; c < all->count; c++) {
        const Coupling *coupling = &all->coupling[c];
        const double *z = all->z + first;
        Motion motion;
        OST_TRY(find_motion(ctx, coupling, z, &motion));
        for (int k = 0; k < coupling->count; k++) {
            const int component = coupling->component[k];
            find_slope(coupling, &motion, component, all->slope + (size_t)(row + k) * (size_t)all->sums + first);
            const double now = component < 3 ? motion.displacement[component] : motion.vector[component - 3];
            all->lack[row + k] = (component >= 3 && coupling->turns_wholly ? 0.0 : coupling->given[k]) - now;
        }
        OST_TRY(find_resultant(ctx, coupling, z, all->x + row, all->h + first));
        OST_TRY(find_bend(ctx, coupling, z, all->x + row, all->sums, all->bend + first * (all->sums + 1)));
        first += coupling->sums;
        row += coupling->count;
    }
    return OST_SUCCESS;
}

/* --- all of them --- */

int ost_turned_couplings_count(const OstProblem *problem)
{
    int count = 0;
    if (!ost_distributing_any(problem))
        return 0;
    const OstCase *c = problem->scene->c;
    for (int i = 0; i < c->load_count; i++)
        for (int k = 0; k < MOST_GIVEN && c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            count += c->loads[i].moved[k] != 0;
    return count;
}

void ost_turned_couplings_begin(const OstProblem *problem, double *multipliers)
{
    const OstScene *scene = problem->scene;
    if (!ost_distributing_any(problem))
        return;
    for (int i = 0; i < scene->c->load_count; i++)
        for (int k = 0; k < MOST_GIVEN && scene->c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            if (scene->c->loads[i].moved[k])
                *multipliers++ = scene->drive[6 * i + k];
}

static OstStatus open_coupling(const OstScene *scene, int load, double *force, Coupling *coupling)
{
    const size_t owned = (size_t)scene->mesh->owned_nodes;
    *coupling = (Coupling){.load = &scene->c->loads[load], .sums = 3};
    const int *moved = coupling->load->moved;
    for (int k = 0; k < MOST_GIVEN; k++)
        if (moved[k])
            coupling->component[coupling->count++] = k;
    coupling->turns_wholly = moved[3] && moved[4] && moved[5];
    OstStatus status = OST_NEW(scene->ctx, &coupling->share, owned);
    OST_THEN(OST_NEW(scene->ctx, &coupling->arm, 3 * owned));
    status = ost_agree(scene->ctx, status);
    OST_THEN(measure(scene, force, coupling));
    return status;
}

static OstStatus open_couplings(OstTurnedCouplings *all)
{
    const OstScene *scene = all->problem->scene;
    double *force = NULL;
    OstStatus status = OST_NEW(scene->ctx, &force, 3 * (size_t)scene->mesh->node_count);
    OST_THEN(OST_NEW(scene->ctx, &all->coupling, (size_t)scene->c->load_count));
    status = ost_agree(scene->ctx, status);
    memset(scene->drive, 0, 6 * (size_t)scene->c->load_count * sizeof *scene->drive);
    for (int i = 0; i < scene->c->load_count && status == OST_SUCCESS; i++) {
        if (scene->c->loads[i].kind != OST_LOAD_DISTRIBUTING)
            continue;
        Coupling *coupling = &all->coupling[all->count++];
        status = open_coupling(scene, i, force, coupling);
        all->sums += coupling->sums;
        all->components += coupling->count;
    }
    OST_FREE(force);
    return status;
}

OstStatus ost_turned_couplings_create(OstProblem *problem, size_t unknowns, OstTurnedCouplings **couplings)
{
    OstContext *ctx = problem->ctx;
    OstTurnedCouplings *all = NULL;
    ost_distributing_forget(problem);
    ost_ledger_enter(ctx, OST_EFFECT_MOVED_COUPLING);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &all, 1));
    if (status == OST_SUCCESS) {
        *all = (OstTurnedCouplings){.problem = problem, .unknowns = unknowns};
        status = open_couplings(all);
        const size_t sums = (size_t)all->sums, components = (size_t)all->components;
        OST_THEN(OST_NEW(ctx, &all->z, sums));
        OST_THEN(OST_NEW(ctx, &all->h, sums));
        OST_THEN(OST_NEW(ctx, &all->lack, components));
        OST_THEN(OST_NEW(ctx, &all->x, components));
        OST_THEN(OST_NEW(ctx, &all->slope, components * sums));
        OST_THEN(OST_NEW(ctx, &all->bend, sums * sums));
        OST_THEN(OST_NEW(ctx, &all->response, sums * unknowns));
        OST_THEN(OST_NEW(ctx, &all->compliance, sums * sums));
        OST_THEN(OST_NEW(ctx, &all->unit, components));
        OST_THEN(OST_NEW(ctx, &all->stiff, components));
        status = ost_agree(ctx, status);
    }
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        ost_turned_couplings_destroy(&all);
    *couplings = all;
    return status;
}

void ost_turned_couplings_destroy(OstTurnedCouplings **couplings)
{
    OstTurnedCouplings *all = *couplings;
    if (!all)
        return;
    for (int c = 0; c < all->count; c++)
        OST_FREE(all->coupling[c].share, all->coupling[c].arm);
    OST_FREE(all->coupling, all->z, all->h, all->lack, all->x, all->slope, all->bend);
    OST_FREE(all->response, all->compliance, all->unit, all->stiff);
    OST_FREE(*couplings);
}

/* z = Y u, of all couplings. */
static OstStatus find_sums(const OstTurnedCouplings *all, const double *u, double *z)
{
    const size_t owned = (size_t)all->problem->mesh->owned_nodes;
    memset(z, 0, (size_t)all->sums * sizeof *z);
    for (int c = 0, first = 0; c < all->count; first += all->coupling[c++].sums)
        for (int s = 0; s < all->coupling[c].sums; s++)
            for (size_t n = 0; n < owned; n++)
                z[first + s] += weight_of(&all->coupling[c], s, n) * u[3 * n + (size_t)(s % 3)];
    return ost_sum(all->problem->ctx, all->sums, z);
}

/* force += Y'h */
static void add_resultant(const OstTurnedCouplings *all, const double *h, double *force)
{
    const size_t owned = (size_t)all->problem->mesh->owned_nodes;
    for (int c = 0, first = 0; c < all->count; first += all->coupling[c++].sums)
        for (int s = 0; s < all->coupling[c].sums; s++)
            for (size_t n = 0; n < owned && h[first + s] != 0.0; n++)
                force[3 * n + (size_t)(s % 3)] += weight_of(&all->coupling[c], s, n) * h[first + s];
}

OstStatus ost_turned_couplings_move(OstTurnedCouplings *all, double t, const double *u, const double *multipliers)
{
    OstContext *ctx = all->problem->ctx;
    ost_ledger_enter(ctx, OST_EFFECT_MOVED_COUPLING);
    for (int c = 0; c < all->count; c++)
        for (int k = 0; k < all->coupling[c].count; k++)
            all->coupling[c].given[k] =
                ost_problem_factor(all->problem, 0, t) * all->coupling[c].load->motion[all->coupling[c].component[k]];
    memcpy(all->x, multipliers, (size_t)all->components * sizeof *multipliers);
    OstStatus status = find_sums(all, u, all->z);
    OST_THEN(find_state(all));
    ost_ledger_leave(ctx);
    return ost_agree(ctx, status);
}

void ost_turned_couplings_add(const OstTurnedCouplings *all, double *force)
{
    add_resultant(all, all->h, force);
}

double ost_turned_couplings_lack(const OstTurnedCouplings *all)
{
    double sum = 0.0;
    for (int k = 0; k < all->components; k++) {
        const double force = all->lack[k] * all->stiff[k] * all->unit[k];
        sum += force * force;
    }
    return sum;
}

/* --- Newton's equations --- */

static OstStatus respond(OstTurnedCouplings *all, OstTurnedSolve *solve, void *data, double *h, double *force, int s,
                         int *found)
{
    const OstProblem *problem = all->problem;
    double *rows = force + 3 * (size_t)problem->mesh->node_count, *x = all->response + (size_t)s * all->unknowns;
    double *sums = all->compliance + (size_t)s * (size_t)all->sums;
    memset(h, 0, (size_t)all->sums * sizeof *h);
    h[s] = 1.0;
    memset(force, 0, 3 * (size_t)problem->mesh->node_count * sizeof *force);
    memset(rows, 0, all->unknowns * sizeof *rows);
    add_resultant(all, h, force);
    OST_TRY(ost_system_take_rows(problem->system, force, rows));
    OST_TRY(solve(data, rows, x, found));
    if (!*found)
        return OST_SUCCESS;
    OST_TRY(ost_system_displacement(problem->system, 0.0, x, force));
    return find_sums(all, force, sums);
}

/* The norm of each multiplier's forces at a unit, and what it makes its motion. */
static OstStatus measure_units(OstTurnedCouplings *all, double *force)
{
    const size_t owned = 3 * (size_t)all->problem->mesh->owned_nodes;
    const int n = all->sums;
    for (int k = 0; k < all->components; k++) {
        const double *slope = all->slope + (size_t)k * (size_t)n;
        double give = 0.0, square = 0.0;
        for (int i = 0; i < n * n; i++)
            give += slope[i / n] * slope[i % n] * all->compliance[i];
        memset(force, 0, owned * sizeof *force);
        add_resultant(all, slope, force);
        for (size_t i = 0; i < owned; i++)
            square += force[i] * force[i];
        OST_TRY(ost_sum(all->problem->ctx, 1, &square));
        all->unit[k] = sqrt(square);
        all->stiff[k] = give > 0.0 ? 1.0 / give : 0.0;
    }
    return OST_SUCCESS;
}

/* (I - A h_z) dz - A c' dx = z0, c' dz = lack; then dh = h_z dz + c' dx. Sums are of different units: each is taken
 * relative to what a unit of its force does. `room` has what is solved for last. */
static int solve_dense(const OstTurnedCouplings *all, const double *start, double *matrix, int *pivot, double *room)
{
    const int n = all->sums, m = all->components, size = n + m, one = 1;
    const double *a = all->compliance;
    int info = 0;
    memset(matrix, 0, (size_t)size * (size_t)size * sizeof *matrix);
    for (int i = 0; i < n; i++) {
        room[i] = start[i];
        for (int j = 0; j < n; j++)
            matrix[i + size * j] = i == j ? 1.0 : 0.0;
        for (int l = 0; l < n; l++) {
            for (int j = 0; j < n; j++)
                matrix[i + size * j] -= a[n * i + l] * all->bend[n * l + j];
            for (int k = 0; k < m; k++)
                matrix[i + size * (n + k)] -= a[n * i + l] * all->slope[n * k + l];
        }
    }
    for (int k = 0; k < m; k++) {
        room[n + k] = all->lack[k];
        for (int j = 0; j < n; j++)
            matrix[n + k + size * j] = all->slope[n * k + j];
    }
    for (int i = 0; i < n; i++) { /* rows and columns of one unit */
        const double scale = a[(n + 1) * i] > 0.0 ? sqrt(a[(n + 1) * i]) : 1.0;
        for (int j = 0; j < size; j++) {
            matrix[i + size * j] /= scale;
            matrix[j + size * i] *= scale;
        }
        room[i] /= scale;
    }
    dgesv_(&size, &one, matrix, &size, pivot, room, &size, &info);
    for (int i = 0; i < n; i++)
        room[i] *= a[(n + 1) * i] > 0.0 ? sqrt(a[(n + 1) * i]) : 1.0;
    return info == 0;
}

static OstStatus combine(OstTurnedCouplings *all, double *force, double *correction, double *change, int *found)
{
    const int n = all->sums, size = n + all->components;
    double *matrix = NULL, *room = NULL, *start = NULL;
    int *pivot = NULL;
    OstStatus status = OST_NEW(all->problem->ctx, &matrix, (size_t)size * (size_t)size);
    OST_THEN(OST_NEW(all->problem->ctx, &room, (size_t)size));
    OST_THEN(OST_NEW(all->problem->ctx, &start, (size_t)n));
    OST_THEN(OST_NEW(all->problem->ctx, &pivot, (size_t)size));
    status = ost_agree(all->problem->ctx, status);
    OST_THEN(ost_system_displacement(all->problem->system, 0.0, correction, force));
    OST_THEN(find_sums(all, force, start));
    if (status == OST_SUCCESS)
        *found = solve_dense(all, start, matrix, pivot, room);
    for (int s = 0; s < n && status == OST_SUCCESS && *found; s++) {
        double h = 0.0;
        for (int j = 0; j < n; j++)
            h += all->bend[n * s + j] * room[j];
        for (int k = 0; k < all->components; k++)
            h += all->slope[n * k + s] * room[n + k];
        for (size_t i = 0; i < all->unknowns; i++)
            correction[i] += h * all->response[(size_t)s * all->unknowns + i];
    }
    if (status == OST_SUCCESS && *found)
        memcpy(change, room + n, (size_t)all->components * sizeof *change);
    OST_FREE(matrix, room, start, pivot);
    return status;
}

OstStatus ost_turned_couplings_correct(OstTurnedCouplings *all, OstTurnedSolve *solve, void *data, double *correction,
                                       double *change, int *found)
{
    OstContext *ctx = all->problem->ctx;
    double *force = NULL, *h = NULL;
    *found = 1;
    ost_ledger_enter(ctx, OST_EFFECT_MOVED_COUPLING);
    OstStatus status = OST_NEW(ctx, &force, 3 * (size_t)all->problem->mesh->node_count + all->unknowns);
    OST_THEN(OST_NEW(ctx, &h, (size_t)all->sums));
    status = ost_agree(ctx, status);
    for (int s = 0; s < all->sums && status == OST_SUCCESS && *found; s++)
        status = respond(all, solve, data, h, force, s, found);
    if (*found)
        OST_THEN(measure_units(all, force));
    if (*found)
        OST_THEN(combine(all, force, correction, change, found));
    OST_FREE(force, h);
    ost_ledger_leave(ctx);
    return status;
}

/* The energy is least where Y d = dz and c' dz = 0 if the matrix of d, dz and their multipliers has as many negative
 * eigenvalues as there are such equations: those of K, and of what eliminating d leaves (Sylvester's law of inertia),
 * [-A, I, 0; I, -h_z, c'; 0, c', 0]. */
OstStatus ost_turned_couplings_are_stable(const OstTurnedCouplings *all, OstGlobal of_stiffness, int *stable)
{
    const int n = all->sums, size = 2 * n + all->components, room = 3 * size;
    double *matrix = NULL, *values = NULL, *work = NULL;
    int info = 0;
    OstGlobal negative = of_stiffness;
    OstStatus status = OST_NEW(all->problem->ctx, &matrix, (size_t)size * (size_t)size);
    OST_THEN(OST_NEW(all->problem->ctx, &values, (size_t)size));
    OST_THEN(OST_NEW(all->problem->ctx, &work, (size_t)room));
    for (int i = 0; i < n && status == OST_SUCCESS; i++) {
        const double scale = sqrt(fmax(all->compliance[(n + 1) * i], 0.0));
        matrix[(n + i) * size + i] = 1.0;
        for (int j = 0; j < n; j++) {
            const double both = scale * sqrt(fmax(all->compliance[(n + 1) * j], 0.0));
            matrix[j * size + i] = both > 0.0 ? -all->compliance[n * i + j] / both : 0.0;
            matrix[(n + j) * size + n + i] = -all->bend[n * i + j] * both;
        }
        for (int k = 0; k < all->components; k++)
            matrix[(2 * n + k) * size + n + i] = all->slope[n * k + i] * scale * sqrt(all->stiff[k]);
    }
    if (status == OST_SUCCESS)
        dsyev_("N", "U", &size, matrix, &size, values, work, &room, &info, 1, 1);
    for (int i = 0; i < size && status == OST_SUCCESS; i++)
        negative += values[i] < 0.0;
    *stable = status == OST_SUCCESS && info == 0 && negative == n + all->components;
    OST_FREE(matrix, values, work);
    return ost_agree(all->problem->ctx, status);
}

OstStatus ost_turned_couplings_apply(const OstTurnedCouplings *all, double t)
{
    OstProblem *problem = all->problem;
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    const double factor = ost_problem_factor(problem, 0, t);
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &problem->driven, owned)));
    ost_turned_couplings_add(all, problem->driven);
    for (size_t i = 0; i < owned; i++) {
        problem->driven[i] /= factor != 0.0 ? factor : 1.0;
        problem->force[i] += problem->driven[i];
    }
    return OST_SUCCESS;
}
