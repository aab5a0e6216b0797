/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/buckling/modes.h"

#include "algebra/matrix/vector.h"
#include "assembly/links/levers.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "solve/buckling/stress_force.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Where modes are asked for, one more is looked for: those asked for are then found sooner. */
enum { SPARE = 1, BLOCK = OST_MOST_BUCKLING_MODES + SPARE, MOST = 3 * BLOCK };

/* The subspace: columns of modes, of preconditioned residuals, and of the last change of the modes; of each the vector
 * x, K x, and -K_stress x. */
typedef struct Search {
    const OstProblem *problem;
    OstSolver *solver;
    const OstResult *result;
    const OstHeldMotions *held; /* as OstModesAim's */
    int mixed;
    int block, columns; /* modes in work; columns filled */
    size_t n;           /* 3 × rows */
    double *room;       /* of all columns */
    double *x[MOST], *k[MOST], *s[MOST];
    double *ghosted;             /* 3 × matrix->columns */
    double *v[BLOCK], *f[BLOCK]; /* 3 × node_count, 3 × owned_nodes */
    double *p[BLOCK], *volume;   /* of a mixed form: pressures of the columns filled last, and zeros; or NULL */
    double *turned[2];           /* 3 × node_count, 3 × owned_nodes: of loads that follow the surface; or NULL */
    OstTurning turning;          /* ost_problem_find_turning */
    double value[BLOCK], residual[BLOCK];
} Search;

static void release(Search *search)
{
    OST_FREE(search->room, search->ghosted, search->v[0], search->f[0], search->p[0], search->volume);
    OST_FREE(search->turned[0], search->turned[1], search->turning.faces, search->turning.levers);
}

static OstStatus allocate(Search *search)
{
    const OstProblem *problem = search->problem;
    OstContext *ctx = problem->ctx;
    const size_t nodes = 3 * (size_t)problem->mesh->node_count, owned = 3 * (size_t)problem->mesh->owned_nodes;
    const size_t block = (size_t)search->block, pressures = search->mixed ? ost_problem_pressure_room(problem) : 0;
    OstStatus status = OST_NEW(ctx, &search->room, 9 * block * search->n);
    OST_THEN(OST_NEW(ctx, &search->ghosted, 3 * (size_t)problem->system->matrix->columns));
    OST_THEN(OST_NEW(ctx, &search->v[0], block * nodes));
    OST_THEN(OST_NEW(ctx, &search->f[0], block * owned));
    if (search->mixed) {
        OST_THEN(OST_NEW(ctx, &search->p[0], block * pressures));
        OST_THEN(OST_NEW(ctx, &search->volume, (size_t)problem->pressures->owned));
    }
    if (problem->follower) {
        OST_THEN(OST_NEW(ctx, &search->turned[0], nodes));
        OST_THEN(OST_NEW(ctx, &search->turned[1], owned));
    }
    OST_TRY(ost_agree(ctx, status));
    for (size_t c = 0; c < 3 * block; c++) {
        search->x[c] = search->room + 3 * c * search->n;
        search->k[c] = search->x[c] + search->n;
        search->s[c] = search->k[c] + search->n;
    }
    for (size_t c = 0; c < block; c++) {
        search->v[c] = search->v[0] + c * nodes;
        search->f[c] = search->f[0] + c * owned;
        if (search->mixed)
            search->p[c] = search->p[0] + c * pressures;
    }
    return OST_SUCCESS;
}

/* Takes from the forces of a displacement how loads that follow the surface change with it. They are quadratic in the
 * displacement: the central difference is their derivative at rest. */
static void add_follower(const Search *search, const double *v, double *force)
{
    OstProblem turned = *search->problem;
    const size_t nodes = 3 * (size_t)turned.mesh->node_count, owned = 3 * (size_t)turned.mesh->owned_nodes;
    ost_problem_take_formulation(&turned, OST_FORMULATION_CONSISTENT);
    for (double sign = -1.0; sign <= 1.0; sign += 2.0) {
        for (size_t i = 0; i < nodes; i++)
            search->turned[0][i] = sign * v[i];
        ost_problem_load(&turned, search->result->t, search->turned[0], search->turned[1]);
        for (size_t i = 0; i < owned; i++)
            force[i] -= 0.5 * sign * search->turned[1][i];
    }
}

static OstStatus find_turning(Search *search)
{
    OstProblem answer = *search->problem; /* with its pressure, if it has one */
    answer.field = search->result->field;
    const OstTangent tangent = {.u = search->result->displacement};
    return ost_problem_find_turning(&answer, search->result->t, &tangent, &search->turning);
}

/* Adds what forces at the arms of rigid faces do as these turn. */
static void add_turning(const Search *search, const double *x, double *forces)
{
    const OstSystem *system = search->problem->system;
    const OstLinks *links = search->problem->supports->links;
    for (int f = 0; search->turning.faces && f < links->face_count; f++) {
        const OstRigidFace *face = &links->face[f];
        const OstGlobal node = face->carrier[1] - system->mesh->first_node;
        double part[3];
        if (face->carrier[1] < 0 || node < 0 || node >= system->mesh->owned_nodes)
            continue;
        const size_t row = 3 * (size_t)system->row_of_node[node];
        ost_apply3(search->turning.faces + 9 * f, x + row, part);
        for (size_t i = 0; i < 3; i++)
            forces[row + i] += part[i] / (face->length * face->length);
    }
}

static OstStatus add_pressure(Search *search, double *pressure, double *forces)
{
    OST_TRY(
        ost_agree(search->problem->ctx, ost_coupling_transpose(search->problem->coupling, pressure, search->ghosted)));
    for (size_t i = 0; i < search->n; i++)
        forces[i] += search->ghosted[i];
    return OST_SUCCESS;
}

/* K x and -K_stress x of `count` columns from `first` on. */
static OstStatus multiply(Search *search, int first, int count)
{
    const OstProblem *problem = search->problem;
    const OstSystem *system = problem->system;
    const double share = ost_problem_eigen_share(problem, search->result->t);
    for (int c = 0; c < count; c++) {
        memcpy(search->ghosted, search->x[first + c], search->n * sizeof(double));
        OST_TRY(ost_block_matrix_apply(system->matrix, search->ghosted, search->k[first + c]));
        if (search->mixed)
            OST_TRY(add_pressure(search, search->p[c], search->k[first + c]));
        OST_TRY(ost_system_displacement(system, 0.0, search->x[first + c], search->v[c]));
    }
    ost_stress_force(problem->mesh, search->result->field, share, search->result->displacement, count, search->v,
                     search->f);
    for (int c = 0; c < count; c++) {
        if (problem->follower)
            add_follower(search, search->v[c], search->f[c]);
        if (search->held)
            OST_TRY(ost_held_motions_bend(search->held, search->v[c], search->f[c]));
        OST_TRY(ost_levers_multiply(problem->supports->links, search->turning.levers, search->v[c], search->f[c]));
        OST_TRY(ost_system_take_rows(system, search->f[c], search->s[first + c]));
        add_turning(search, search->x[first + c], search->s[first + c]);
        for (size_t i = 0; i < search->n; i++)
            search->s[first + c][i] = -search->s[first + c][i];
    }
    return OST_SUCCESS;
}

/* How far both equations of a mixed form are solved: what a motion changes the volume by beyond what its pressures
 * allow would cost energy that the search does not see. */
static const double residual_of_mixed = 1e-6;

/* Of the column `c` of those filled next. A mixed form is solved: of the subspace's motions the pressures are known. */
static OstStatus precondition_free(const Search *search, int c, const double *r, double *z)
{
    int found = 0;
    if (search->mixed) {
        const OstSaddle saddle = {search->problem->coupling, search->volume, search->p[c]};
        OstSolveReport report;
        ost_solver_aim(search->solver, (OstSolverAim){.relative_residual = residual_of_mixed, .crude = 1});
        const OstStatus status = ost_solver_solve_mixed(search->solver, &saddle, r, z, &report);
        ost_solver_aim(search->solver, (OstSolverAim){0});
        return status;
    }
    OST_TRY(ost_solver_precondition(search->solver, OST_CYCLE_WHOLE, r, z, &found));
    return found ? OST_SUCCESS : OST_RAISE(search->problem->ctx, OST_NOT_CONVERGED, "the solver has no strategy left");
}

/* Likewise, of motions that couplings allow: r becomes its forces on these. */
static OstStatus precondition(const Search *search, int c, double *r, double *z)
{
    if (search->held)
        OST_TRY(ost_held_motions_project_force(search->held, r));
    OST_TRY(precondition_free(search, c, r, z));
    return search->held ? ost_held_motions_project(search->held, z, search->p[c]) : OST_SUCCESS;
}

/* Forces that vary smoothly over the body, another pattern for each column, and no symmetry of it: every soft motion
 * has part in them. */
static OstStatus start(Search *search)
{
    const OstSystem *system = search->problem->system;
    const OstMesh *mesh = search->problem->mesh;
    double low[3], high[3];
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    const double size = fmax(fmax(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    for (int c = 0; c < search->block; c++) {
        for (size_t node = 0; node < (size_t)mesh->owned_nodes; node++) {
            const double *x = mesh->coordinates + 3 * node;
            for (int i = 0; i < 3; i++) {
                const double waves = 1.3 + 2.1 * c, phase = 0.7 + 1.9 * i + 0.4 * c;
                double along = 0.0;
                for (int j = 0; j < 3; j++)
                    along += (1.0 + 0.31 * ((i + j + c) % 3)) * (x[j] - low[j]) / size;
                search->f[c][3 * node + (size_t)i] = sin(waves * along + phase);
            }
        }
        OST_TRY(ost_system_take_rows(system, search->f[c], search->s[c]));
        OST_TRY(precondition(search, c, search->s[c], search->x[c]));
    }
    search->columns = search->block;
    return multiply(search, 0, search->block);
}

/* Both forms on the subspace, each column scaled to the energy 1. */
static OstStatus find_forms(const Search *search, double *stiffness, double *stress)
{
    const int n = search->columns;
    double sums[2 * MOST * MOST], scale[MOST];
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            sums[a * n + b] = b < a ? sums[b * n + a] : ost_dot(search->n, search->x[a], search->k[b]);
            sums[(n + a) * n + b] = b < a ? sums[(n + b) * n + a] : ost_dot(search->n, search->x[a], search->s[b]);
        }
    OST_TRY(ost_sum(search->problem->ctx, 2 * n * n, sums));
    for (int a = 0; a < n; a++)
        scale[a] = sums[a * n + a] > 0.0 ? 1.0 / sqrt(sums[a * n + a]) : 0.0;
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            stiffness[a * n + b] = sums[a * n + b] * scale[a] * scale[b];
            stress[a * n + b] = sums[(n + a) * n + b] * scale[a] * scale[b];
        }
    for (int a = 0; a < n; a++) /* the scale, on the way out, where forms are read no more */
        stiffness[n * n + a] = scale[a];
    return OST_SUCCESS;
}

/* Directions of the subspace with less of its energy than this are rounding. */
static const double dependent = 1e-12;

/* The best modes within the subspace: their values, and what columns they are made of (block × columns). */
static OstStatus find_best(Search *search, double *made_of)
{
    const int n = search->columns;
    OstContext *ctx = search->problem->ctx;
    double stiffness[MOST * MOST + MOST], stress[MOST * MOST], length[MOST], basis[MOST * MOST];
    double reduced[MOST * MOST], value[MOST], vectors[MOST * MOST];
    OST_TRY(find_forms(search, stiffness, stress));
    const double *scale = stiffness + n * n;
    OST_TRY(ost_agree(ctx, ost_symmetric_eigen(ctx, n, stiffness, length, basis)));
    int first = 0;
    while (first < n - search->block && !(length[first] > dependent * length[n - 1]))
        first++;
    const int m = n - first;
    for (int a = first; a < n; a++)
        for (int i = 0; i < n; i++)
            basis[a * n + i] /= sqrt(fmax(length[a], DBL_MIN));
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) {
            double sum = 0.0;
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    sum += basis[(first + a) * n + i] * stress[i * n + j] * basis[(first + b) * n + j];
            reduced[a * m + b] = sum;
        }
    OST_TRY(ost_agree(ctx, ost_symmetric_eigen(ctx, m, reduced, value, vectors)));
    for (int c = 0; c < search->block; c++) {
        search->value[c] = value[m - 1 - c];
        for (int i = 0; i < n; i++) {
            made_of[c * n + i] = 0.0;
            for (int a = 0; a < m; a++)
                made_of[c * n + i] += vectors[(m - 1 - c) * m + a] * basis[(first + a) * n + i] * scale[i];
        }
    }
    return OST_SUCCESS;
}

/* Makes the new modes, and their changes, of one kind of vector. */
static void combine(const Search *search, const double *made_of, double *const *vectors)
{
    const int n = search->columns, block = search->block;
    for (size_t i = 0; i < search->n; i++) {
        double old[MOST];
        for (int a = 0; a < n; a++)
            old[a] = vectors[a][i];
        for (int c = 0; c < block; c++) {
            double kept = 0.0, changed = 0.0;
            for (int a = 0; a < block; a++)
                kept += made_of[c * n + a] * old[a];
            for (int a = block; a < n; a++)
                changed += made_of[c * n + a] * old[a];
            vectors[c][i] = kept + changed;
            vectors[2 * block + c][i] = changed;
        }
    }
}

static OstStatus improve(Search *search)
{
    double made_of[BLOCK * MOST];
    OST_TRY(find_best(search, made_of));
    combine(search, made_of, search->x);
    combine(search, made_of, search->k);
    combine(search, made_of, search->s);
    return OST_SUCCESS;
}

/* The preconditioned residuals, and how large they are: |mu - value| <= |r| in the norm of K^-1, which the
 * preconditioner stands for. Modes are of energy 1. */
static OstStatus find_residuals(Search *search)
{
    for (int c = 0; c < search->block; c++) {
        double *z = search->x[search->block + c], *r = search->ghosted;
        for (size_t i = 0; i < search->n; i++)
            r[i] = search->s[c][i] - search->value[c] * search->k[c][i];
        OST_TRY(precondition(search, c, r, z));
        search->residual[c] = ost_dot(search->n, r, z);
    }
    OST_TRY(ost_sum(search->problem->ctx, search->block, search->residual));
    for (int c = 0; c < search->block; c++)
        search->residual[c] = sqrt(fabs(search->residual[c])); /* less than 0 of a poor preconditioner */
    return OST_SUCCESS;
}

/* A motion of which the start has this share would have come up if it were as soft as `least`: each iteration makes
 * more of it beside what is there, by the ratio of both at the least. */
static const double hidden = 1e-3;

static int is_ruled_out(const Search *search, double least, int iterations)
{
    const double most = fabs(search->value[0]) + 2.0 * search->residual[0];
    return most < least && pow(most / least, iterations) < hidden;
}

/* Is there no sign of such a motion after an iteration, which makes least / value times more of it, so that no residual
 * has to tell? */
static int is_far_off(const Search *search, double least)
{
    return fabs(search->value[0]) < hidden * least;
}

static int is_done(const Search *search, const OstModesAim *aim, int iterations)
{
    if (aim->least > 0.0 && is_ruled_out(search, aim->least, iterations))
        return 1;
    for (int c = 0; c < aim->modes; c++)
        if (!(search->residual[c] <= aim->tolerance * fabs(search->value[c])))
            return 0;
    return iterations > 1;
}

static OstStatus iterate(Search *search, const OstModesAim *aim, OstModes *modes)
{
    OST_TRY(start(search));
    OST_TRY(improve(search));
    for (modes->iterations = 0;; modes->iterations++) {
        OST_TRY(find_residuals(search));
        ost_log(search->problem->ctx, OST_LOG_VERBOSE, "buckling: iteration %d: load factor %.6g, off by %.1e of it",
                modes->iterations, 1.0 / search->value[0], search->residual[0] / fabs(search->value[0]));
        modes->converged = is_done(search, aim, modes->iterations);
        if (modes->converged || modes->iterations == aim->most_iterations)
            return OST_SUCCESS;
        OST_TRY(multiply(search, search->block, search->block));
        search->columns = (modes->iterations == 0 ? 2 : 3) * search->block;
        OST_TRY(improve(search));
        if (is_far_off(search, aim->least)) {
            modes->iterations++;
            modes->converged = 1;
            return OST_SUCCESS;
        }
    }
}

/* The mode of a column, its largest displacement of length 1. */
static OstStatus take_mode(const Search *search, int column, double *mode)
{
    const OstProblem *problem = search->problem;
    double most = 0.0;
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->x[column], mode));
    for (size_t node = 0; node < (size_t)problem->mesh->owned_nodes; node++)
        most = fmax(most, ost_norm3(mode + 3 * node));
    OST_TRY(ost_max(problem->ctx, 1, &most));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->node_count; i++)
        mode[i] /= fmax(most, DBL_MIN);
    return OST_SUCCESS;
}

OstStatus ost_modes_find(const OstProblem *problem, OstSolver *solver, const OstResult *result, const OstModesAim *aim,
                         double *const *mode, OstModes *modes)
{
    Search search = {.problem = problem,
                     .solver = solver,
                     .result = result,
                     .held = aim->held,
                     .mixed = aim->mixed,
                     .block = aim->modes + (aim->least > 0.0 ? 0 : SPARE),
                     .n = 3 * (size_t)problem->system->matrix->rows};
    *modes = (OstModes){.count = aim->modes};
    OstStatus status = allocate(&search);
    OST_THEN(find_turning(&search));
    OST_THEN(iterate(&search, aim, modes));
    for (int c = 0; c < aim->modes && status == OST_SUCCESS; c++) {
        modes->softening[c] = search.value[c];
        modes->residual[c] = search.residual[c];
        if (mode)
            status = take_mode(&search, c, mode[c]);
    }
    release(&search);
    return status;
}
