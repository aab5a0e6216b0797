/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_range.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "effect/effect.h"
#include "guard/guard.h"
#include "guard/rigid_motion.h"

#include <math.h>

/* A check that finds a fault adds an objection; a check that could not be made fails, on all ranks alike. */
static OstStatus take_objection(OstContext *ctx, OstStatus status, OstVerdict *before)
{
    if (status != OST_INVALID_INPUT && status != OST_CHECK_FAILED)
        return status;
    ost_object(before, status, "%s", ost_error_text(ctx));
    return OST_SUCCESS;
}

/* Do stiffness and right-hand side (3 × rows) keep all computed numbers within double precision (core/number_range.h)?
 * Both tests are collective and raise OST_INVALID_INPUT with the number and what to do. A right-hand side of zeros is
 * fine. */
static OstStatus check_size(OstContext *ctx, const char *where, const char *what, double size)
{
    if (size >= OST_LEAST_NUMBER && size <= OST_MOST_NUMBER)
        return OST_SUCCESS;
    if (!isfinite(size))
        return OST_RAISE(
            ctx, OST_INVALID_INPUT,
            "%s: the %s are not finite everywhere: a value is no number, or beyond 1.8e308, the largest that "
            "double precision holds; choose units of length and force that bring them nearer to 1",
            where, what);
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: the %s are of size %.2g in the case's units; beyond %g to %g, squares leave the range of "
                     "double precision: choose units of length and force that bring them nearer to 1",
                     where, what, size, OST_LEAST_NUMBER, OST_MOST_NUMBER);
}

/* Largest absolute value; infinite if a value is NaN. */
static double largest_of(size_t count, const double *values)
{
    double largest = 0.0;
    for (size_t i = 0; i < count; i++)
        if (!(fabs(values[i]) <= largest))
            largest = isfinite(values[i]) ? fabs(values[i]) : HUGE_VAL;
    return largest;
}

/* The softest node counts too: its displacement is the largest. */
static void diagonal_range(const OstBlockMatrix *matrix, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = 0.0;
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const double size = largest_of(9, ost_block_matrix_diagonal(matrix, row));
        *low = fmin(*low, size);
        *high = fmax(*high, size);
    }
}

static OstStatus number_range_of_stiffness(const OstBlockMatrix *matrix, const char *where)
{
    OstContext *ctx = matrix->ctx;
    double low, largest[2]; /* the stiffest node, and 1 over the softest */
    diagonal_range(matrix, &low, &largest[0]);
    largest[1] = 1.0 / low;
    OST_TRY(ost_max(ctx, 2, largest));
    OST_TRY(check_size(ctx, where, "stiffest nodes", largest[0]));
    return check_size(ctx, where, "softest nodes", 1.0 / largest[1]);
}

static OstStatus number_range_of_load(const OstBlockMatrix *matrix, const double *rhs, const char *where)
{
    OstContext *ctx = matrix->ctx;
    double largest = largest_of(3 * (size_t)matrix->rows, rhs);
    OST_TRY(ost_max(ctx, 1, &largest));
    return largest > 0.0 ? check_size(ctx, where, "loads, with the forces that prescribed displacements take,", largest)
                         : OST_SUCCESS;
}

/* Loads may be out of balance by this share of their sizes: they are typed, and summed, with rounding. */
static const double balance = 1e-8;

/* Sets components to 0 that are rounding errors of sums of this size. */
static void drop_rounding(double size, double vector[3])
{
    for (int i = 0; i < 3; i++)
        if (fabs(vector[i]) <= 1e-14 * size)
            vector[i] = 0.0;
}

/* Sums of the loads: force, its size, moment about a centre, its size. */
enum { SUM_FORCE, SUM_FORCE_SIZE = 3, SUM_MOMENT, SUM_MOMENT_SIZE = 7, SUM_COUNT };

static void add_load(const double *x, const double *f, const double centre[3], double sums[SUM_COUNT])
{
    double arm[3], moment[3];
    for (int i = 0; i < 3; i++)
        arm[i] = x[i] - centre[i];
    ost_cross3(arm, f, moment);
    for (int i = 0; i < 3; i++) {
        sums[SUM_FORCE + i] += f[i];
        sums[SUM_MOMENT + i] += moment[i];
    }
    sums[SUM_FORCE_SIZE] += ost_norm3(f);
    sums[SUM_MOMENT_SIZE] += ost_norm3(arm) * ost_norm3(f);
}

/* Do the loads (3 × owned nodes) balance each other in force and moment, as they must on an unconstrained body? */
static OstStatus check_balance(const OstMesh *mesh, const double *force, const char *where)
{
    OstContext *ctx = mesh->ctx;
    double low[3], high[3], centre[3], sums[SUM_COUNT] = {0.0};
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * (low[i] + high[i]);
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        add_load(mesh->coordinates + 3 * (size_t)n, force + 3 * (size_t)n, centre, sums);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sums, SUM_COUNT, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    double *f = sums + SUM_FORCE;
    double *m = sums + SUM_MOMENT;
    if (ost_norm3(f) <= balance * sums[SUM_FORCE_SIZE] && ost_norm3(m) <= balance * sums[SUM_MOMENT_SIZE])
        return OST_SUCCESS;
    drop_rounding(sums[SUM_FORCE_SIZE], f);
    drop_rounding(sums[SUM_MOMENT_SIZE], m);
    return OST_RAISE(
        ctx, OST_INVALID_INPUT,
        "%s: free_body needs loads that balance each other, but these leave a force (%g, %g, %g) of loads of "
        "size %g, and a moment (%g, %g, %g) of size %g about (%g, %g, %g); balance them, or constrain the body",
        where, f[0], f[1], f[2], sums[SUM_FORCE_SIZE], m[0], m[1], m[2], sums[SUM_MOMENT_SIZE], centre[0], centre[1],
        centre[2]);
}

static OstStatus check_function(const OstProblem *problem, int function, const char *where)
{
    double *force = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &force, 3 * (size_t)problem->mesh->owned_nodes)));
    ost_problem_add_load(problem, function, 1.0, NULL, force);
    const OstStatus status = check_balance(problem->mesh, force, where);
    OST_FREE(force);
    return status;
}

OstStatus ost_guard_supports(const OstProblem *problem, OstVerdict *before)
{
    const OstStatus status =
        ost_freedom_check(problem->mesh, problem->supports, ost_problem_name(problem), problem->free_body);
    return take_objection(problem->ctx, status, before);
}

OstStatus ost_guard_stiffness(const OstProblem *problem, const double *modes, double *resistance, OstVerdict *before)
{
    OstContext *ctx = problem->ctx;
    const int others = before->count;
    double of_tets = 0.0, of_rows = 0.0;
    OST_TRY(take_objection(ctx, number_range_of_stiffness(problem->system->matrix, ost_problem_name(problem)), before));
    if (before->count > others)
        return OST_SUCCESS;
    OST_TRY(take_objection(ctx, ost_rigid_motion_of_tets(problem->mesh, problem->field, &of_tets), before));
    OST_TRY(take_objection(ctx, ost_rigid_motion_of_rows(problem->system, modes, &of_rows), before));
    *resistance = fmax(of_tets, of_rows);
    return OST_SUCCESS;
}

/* What the prescribed displacements could change the volume by: nodes may move by as much, and the volumes of tets not
 * change but for rounding. */
static OstStatus find_sweep(const OstProblem *problem, double *sweep)
{
    double low[3], high[3], size[3], most = 0.0;
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++)
        for (int k = 0; k <= problem->timed_count; k++) {
            const OstSupports *supports = k == 0 ? problem->supports : problem->timed[k - 1].supports;
            double projector[9], prescribed[3];
            ost_supports_get(supports, node, projector, prescribed);
            most = fmax(most, ost_norm3(prescribed));
        }
    OST_TRY(ost_max(problem->ctx, 1, &most));
    OST_TRY(ost_mesh_bounds(problem->mesh, low, high));
    for (int i = 0; i < 3; i++)
        size[i] = high[i] - low[i];
    *sweep = ost_dot3(size, size) * most;
    return OST_SUCCESS;
}

/* The changes of volume that a uniform pressure of all incompressible material works on, and their sizes. */
static OstStatus sum_volume(const OstProblem *problem, const double *g, double sums[2])
{
    double sweep;
    double *uniform = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &uniform, problem->pressures->owned)));
    ost_problem_uniform_pressure(problem, uniform);
    for (OstLocal i = 0; i < problem->pressures->owned; i++) {
        sums[0] += uniform[i] * g[i];
        sums[1] += uniform[i] * fabs(g[i]);
    }
    OST_FREE(uniform);
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    OST_TRY(find_sweep(problem, &sweep));
    sums[1] += sweep;
    return OST_SUCCESS;
}

OstStatus ost_guard_volume(const OstProblem *problem, const double *g, int *enclosed, OstVerdict *before)
{
    OstContext *ctx = problem->ctx;
    const OstLinks *links = problem->supports->links;
    double sums[2] = {0.0};
    OST_TRY(ost_problem_is_enclosed(problem, enclosed));
    if (*enclosed)
        OST_TRY(sum_volume(problem, g, sums));
    if (!*enclosed || fabs(sums[0]) <= 1e-10 * sums[1])
        return OST_SUCCESS;
    return take_objection(
        ctx,
        OST_RAISE(
            ctx, OST_INVALID_INPUT,
            "%s: the body is incompressible (nu = 1/2) and constrained all around, and what is prescribed changes its "
            "volume: %s, or set nu = 0.4999",
            ost_problem_name(problem),
            links && links->periodic ? "let the strain of the periodic cell have xx + yy + zz = 0"
                                     : "leave a part of its surface free"),
        before);
}

/* Of loads that a caller gives node by node: is one of them no number? */
static OstStatus check_given(const OstProblem *problem, int function)
{
    OstContext *ctx = problem->ctx;
    const size_t count = 3 * (size_t)problem->mesh->owned_nodes;
    double *force = NULL;
    size_t at = 0;
    if (problem->scene)
        return OST_SUCCESS;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &force, count)));
    ost_problem_add_load(problem, function, 1.0, NULL, force);
    while (at < count && isfinite(force[at]))
        at++;
    OstStatus status = OST_SUCCESS;
    if (at < count) {
        const double *x = problem->mesh->coordinates + at - at % 3;
        status =
            OST_RAISE(ctx, OST_INVALID_INPUT,
                      "%s: the force on node %zu of rank %d, at (%g, %g, %g), is %g along %c; expected a finite "
                      "number: give 0 where no force acts",
                      ost_problem_name(problem), at / 3, ost_rank(ctx), x[0], x[1], x[2], force[at], "xyz"[at % 3]);
    }
    OST_FREE(force);
    return ost_agree(ctx, status);
}

OstStatus ost_guard_load(const OstProblem *problem, int function, const double *rhs, OstVerdict *before)
{
    OstContext *ctx = problem->ctx;
    const char *name = ost_problem_name(problem);
    if (problem->free_body) {
        ost_ledger_enter(ctx, OST_EFFECT_FREE_BODY);
        const OstStatus status = check_function(problem, function, name);
        ost_ledger_leave(ctx);
        OST_TRY(take_objection(ctx, status, before));
    }
    const OstStatus in_range = number_range_of_load(problem->system->matrix, rhs, name);
    const OstStatus given = in_range == OST_INVALID_INPUT ? check_given(problem, function) : OST_SUCCESS;
    return take_objection(ctx, given == OST_SUCCESS ? in_range : given, before);
}
