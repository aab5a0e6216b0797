/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/distributing/turned.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "solve/distributing/distributing.h"
#include "solve/distributing/selection.h"

#include <string.h>

extern void dgesv_(const int *n, const int *columns, double *a, const int *leading, int *pivot, double *b,
                   const int *leading_b, int *info);

extern void dsyev_(const char *jobz, const char *uplo, const int *n, double *a, const int *leading, double *w,
                   double *work, const int *room, int *info, size_t length_jobz, size_t length_uplo);

struct OstTurnedCouplings {
    OstProblem *problem;
    size_t unknowns;
    int count;
    OstMovedSelection *coupling;
    int sums, components; /* of all couplings */
    double *z, *h;        /* sums */
    double *lack, *x;     /* components: g - c, and the multipliers */
    double *slope;        /* components × sums: c' */
    double *bend;         /* sums × sums: h_z */
    double *response;     /* sums × unknowns: K^-1 Y' */
    double *compliance;   /* sums × sums: A = Y K^-1 Y', column by column; 0 before the first correction */
    double *unit, *stiff; /* components: the norm of the forces of a unit, and their size for a unit of motion */
};

static OstStatus find_state(OstTurnedCouplings *all)
{
    const int width = all->sums;
    for (int c = 0, first = 0, row = 0; c < all->count; c++) {
        const OstMovedSelection *selection = &all->coupling[c];
        OST_TRY(ost_moved_selection_state(all->problem->ctx, selection, all->z + first, all->x + row, width,
                                          all->lack + row, all->slope + row * width + first, all->h + first,
                                          all->bend + first * (width + 1)));
        first += selection->sums;
        row += selection->count;
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
        for (int k = 0; k < OST_MOST_GIVEN && c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            count += c->loads[i].moved[k] != 0;
    return count;
}

void ost_turned_couplings_begin(const OstProblem *problem, double t, double *multipliers)
{
    const OstScene *scene = problem->scene;
    if (!ost_distributing_any(problem))
        return;
    for (int i = 0; i < scene->c->load_count; i++)
        for (int k = 0; k < OST_MOST_GIVEN && scene->c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++) {
            double sum = 0.0;
            for (int f = 0; f < ost_problem_functions(problem); f++)
                sum += ost_problem_factor(problem, f, t) * ost_scene_drive(scene, f, i)->of_point[k];
            if (scene->c->loads[i].moved[k])
                *multipliers++ = sum;
        }
}

static OstStatus open_couplings(OstTurnedCouplings *all)
{
    const OstScene *scene = all->problem->scene;
    double *force = NULL;
    OstStatus status = OST_NEW(scene->ctx, &force, 3 * (size_t)scene->mesh->node_count);
    OST_THEN(OST_NEW(scene->ctx, &all->coupling, (size_t)scene->c->load_count));
    status = ost_agree(scene->ctx, status);
    memset(scene->drive, 0,
           (size_t)(scene->c->load_count * ost_problem_functions(all->problem)) * sizeof *scene->drive);
    for (int i = 0; i < scene->c->load_count && status == OST_SUCCESS; i++) {
        if (scene->c->loads[i].kind != OST_LOAD_DISTRIBUTING)
            continue;
        OstMovedSelection *coupling = &all->coupling[all->count++];
        status = ost_moved_selection_open(scene, i, force, coupling);
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
        ost_moved_selection_close(&all->coupling[c]);
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
                z[first + s] += ost_moved_selection_weight(&all->coupling[c], s, n) * u[3 * n + (size_t)(s % 3)];
    return ost_sum(all->problem->ctx, all->sums, z);
}

/* force += Y'h */
static void add_resultant(const OstTurnedCouplings *all, const double *h, double *force)
{
    const size_t owned = (size_t)all->problem->mesh->owned_nodes;
    for (int c = 0, first = 0; c < all->count; first += all->coupling[c++].sums)
        for (int s = 0; s < all->coupling[c].sums; s++)
            for (size_t n = 0; n < owned && h[first + s] != 0.0; n++)
                force[3 * n + (size_t)(s % 3)] += ost_moved_selection_weight(&all->coupling[c], s, n) * h[first + s];
}

OstStatus ost_turned_couplings_move(OstTurnedCouplings *all, double t, const double *u, const double *multipliers)
{
    OstContext *ctx = all->problem->ctx;
    ost_ledger_enter(ctx, OST_EFFECT_MOVED_COUPLING);
    for (int c = 0; c < all->count; c++) {
        const OstLoad *load = all->coupling[c].load;
        for (int k = 0; k < all->coupling[c].count; k++)
            all->coupling[c].given[k] =
                ost_problem_factor(all->problem, load->table, t) * load->motion[all->coupling[c].component[k]];
    }
    memcpy(all->x, multipliers, (size_t)all->components * sizeof *multipliers);
    OstStatus status = find_sums(all, u, all->z);
    OST_THEN(find_state(all));
    ost_ledger_leave(ctx);
    return ost_agree(ctx, status);
}

int ost_turned_couplings_sums(const OstTurnedCouplings *all)
{
    return all->sums;
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
        all->stiff[k] = give != 0.0 ? 1.0 / fabs(give) : 0.0;
    }
    return OST_SUCCESS;
}

/* Sums are of different units: each is taken relative to what a unit of its force does. */
static double scale_of(const OstTurnedCouplings *all, int sum)
{
    const double size = fabs(all->compliance[(all->sums + 1) * sum]);
    return size > 0.0 ? sqrt(size) : 1.0;
}

/* (I - A h_z) dz - A c' dx = z0, c' dz = lack; then dh = h_z dz + c' dx. `room` has dz and dx. */
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
                matrix[i + size * j] -= a[n * l + i] * all->bend[n * l + j];
            for (int k = 0; k < m; k++)
                matrix[i + size * (n + k)] -= a[n * l + i] * all->slope[n * k + l];
        }
    }
    for (int k = 0; k < m; k++) {
        room[n + k] = all->lack[k];
        for (int j = 0; j < n; j++)
            matrix[n + k + size * j] = all->slope[n * k + j];
    }
    for (int i = 0; i < n; i++) { /* rows and columns of one unit */
        const double scale = scale_of(all, i);
        for (int j = 0; j < size; j++) {
            matrix[i + size * j] /= scale;
            matrix[j + size * i] *= scale;
        }
        room[i] /= scale;
    }
    dgesv_(&size, &one, matrix, &size, pivot, room, &size, &info);
    for (int i = 0; i < n; i++)
        room[i] *= scale_of(all, i);
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
        const double scale = scale_of(all, i);
        matrix[(n + i) * size + i] = 1.0;
        for (int j = 0; j < n; j++) {
            const double both = scale * scale_of(all, j);
            matrix[j * size + i] = -all->compliance[n * i + j] / both;
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

/* The traction that the forces h of a selection are: weights are integrals of N over the area, and of N (X - c). */
static void find_traction(const OstMovedSelection *selection, const double *h, double factor, OstDrive *drive)
{
    for (int i = 0; i < 3; i++)
        drive->mean[i] = h[i] / (factor * selection->area);
    for (int s = 3; s < selection->sums; s++)
        for (int j = 0; j < 3; j++)
            drive->gradient[3 * (s % 3) + j] += h[s] * selection->axis[3 * (s / 3 - 1) + j] / factor;
}

OstStatus ost_turned_couplings_apply(const OstTurnedCouplings *all, double t)
{
    OstProblem *problem = all->problem;
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    int function = 0;
    for (int k = 1; k < ost_problem_functions(problem); k++)
        if (fabs(ost_problem_factor(problem, k, t)) > fabs(ost_problem_factor(problem, function, t)))
            function = k;
    const double factor = ost_problem_factor(problem, function, t);
    OST_TRY(ost_agree(problem->ctx, ost_distributing_make_room(problem)));
    double *driven = problem->driven + (size_t)function * owned;
    ost_turned_couplings_add(all, driven);
    for (size_t i = 0; i < owned; i++)
        driven[i] /= factor != 0.0 ? factor : 1.0;
    for (int c = 0, first = 0; c < all->count && factor != 0.0; first += all->coupling[c++].sums) {
        const int load = (int)(all->coupling[c].load - problem->scene->c->loads);
        find_traction(&all->coupling[c], all->h + first, factor, ost_scene_drive(problem->scene, function, load));
    }
    return OST_SUCCESS;
}
