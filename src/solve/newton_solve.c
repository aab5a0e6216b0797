/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"
#include "algebra/solver_seconds.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "solve/newton_data.h"

#include <math.h>
#include <string.h>

/* A new hierarchy pays once a digit takes so many times the iterations, and so many more, than when it was new. */
static const double more_iterations = 1.5, further_iterations = 1.0;

/* So many iterations cost more than a hierarchy: after them it pays once a digit takes so many times the iterations. */
static const double of_a_setup = 40.0, slightly_more = 1.2;

/* How far GMRES goes: residuals of slender bodies say little about their bending, so that less leads astray. Where it
 * does not get below the other, factors take the hierarchy's place. */
static const double accurate = 1e-10, inaccurate = 1e-6;

/* A failure that Newton's method can answer: the matrix is indefinite, or too hard for the solver. */
static int can_go_on(OstStatus status)
{
    return status == OST_NOT_CONVERGED || status == OST_INVALID_INPUT;
}

/* The classical form's own stiffness leaves out how R changes; that of the consistent one has it, and is near. Once the
 * stiffness was found indefinite, the exact stress in the definite one says which way the body buckles. */
static OstStatus fill(OstNewton *newton, int definite)
{
    OstProblem *problem = newton->problem;
    const OstFormulation formulation = problem->formulation;
    if (ost_newton_is_mixed(newton))
        ost_newton_take_pressure(newton, newton->displacement);
    ost_problem_take_formulation(problem, OST_FORMULATION_CONSISTENT);
    const OstStatus status = ost_problem_stiffness_from(
        problem, newton->t, newton->displacement,
        newton->moved && !(newton->indefinite && definite) && ost_newton_has_energy(newton) ? newton->from : NULL,
        definite);
    ost_problem_take_formulation(problem, formulation);
    return status;
}

/* Fills the stiffness at the displacement, and brings the solver up to date with it. */
static OstStatus update(OstNewton *newton, int definite)
{
    const int rebuild = newton->rebuild;
    OST_TRY(fill(newton, definite));
    if (rebuild || newton->solve.method == OST_METHOD_DIRECT) {
        newton->report.setups++;
        newton->cost = 0.0;
    }
    newton->stiffness->moved = 1;
    newton->rebuild = 1; /* should what follows fail */
    if (rebuild)
        OST_TRY(ost_stiffness_solver_rebuild(newton->stiffness, newton->t, newton->displacement));
    else
        OST_TRY(ost_solver_update(newton->stiffness->solver, OST_UPDATE_KEEP));
    newton->rebuild = 0;
    return OST_SUCCESS;
}

/* What moves couplings takes a solve for each of their sums: are factors of the exact stiffness made for these? Of
 * linear tets nobody knows how thick the body is: no thicker than a cube. */
static int factors_pay(const OstNewton *newton)
{
    OstSolverFacts facts = newton->stiffness->facts;
    const OstMethod asked = newton->options.method;
    if (!newton->couplings || !newton->problem->conservative || newton->no_factors ||
        (asked != OST_METHOD_AUTO && asked != OST_METHOD_DIRECT))
        return 0;
    if (!(facts.thickness > 0.0))
        facts.thickness = cbrt((double)facts.unknowns / 3.0);
    return asked == OST_METHOD_DIRECT || newton->method == OST_METHOD_DIRECT ||
           ost_solver_factor_seconds(&facts) <
               (1.0 + ost_turned_couplings_sums(newton->couplings)) * ost_solver_multigrid_seconds(&facts);
}

/* The same where GMRES solves: any factors or hierarchy of a definite stiffness serve as its preconditioner. */
static OstStatus update_unsymmetric(OstNewton *newton)
{
    newton->by_factors = 0;
    if (factors_pay(newton)) {
        OST_TRY(fill(newton, 0));
        newton->stiffness->moved = newton->rebuild = 1;
        newton->report.setups++;
        OST_TRY(ost_solver_factor_indefinite(newton->stiffness->solver,
                                             ost_newton_is_mixed(newton) ? newton->problem->coupling : NULL,
                                             &newton->by_factors));
        if (newton->by_factors)
            return OST_SUCCESS;
        newton->no_factors = newton->indefinite = 1; /* it may be, and GMRES does not tell */
    }
    if (newton->rebuild) {
        OST_TRY(fill(newton, 1));
        newton->report.setups++;
        newton->cost = 0.0;
        newton->stiffness->moved = 1;
        OST_TRY(ost_stiffness_solver_rebuild(newton->stiffness, newton->t, newton->displacement));
        newton->rebuild = 0;
    }
    return fill(newton, 0);
}

/* Has the hierarchy become too old? */
static void judge_hierarchy(OstNewton *newton)
{
    const double digits = fmax(-log10(fmax(newton->solve.relative_residual, 1e-16)), 1.0);
    const double cost = newton->solve.iterations / digits;
    if (newton->cost == 0.0)
        newton->cost = fmax(cost, 1.0);
    else if (cost > more_iterations * newton->cost + further_iterations ||
             (newton->solve.iterations > of_a_setup && cost > slightly_more * newton->cost))
        newton->rebuild = 1;
}

OstStatus ost_newton_spread(const OstNewton *newton, const double *correction, double *direction)
{
    const OstProblem *problem = newton->problem;
    if (ost_newton_is_mixed(newton)) {
        double *pressures = direction + 3 * (size_t)problem->mesh->node_count;
        memcpy(pressures, correction + 3 * (size_t)problem->system->matrix->rows,
               (size_t)problem->pressures->owned * sizeof(double));
        OST_TRY(ost_pressure_complete(problem->pressures, pressures));
    }
    return ost_system_displacement(problem->system, 0.0, correction, direction);
}

/* The load may have no work function (pressure that follows a surface with a free rim): its stiffness then has a skew
 * part. GMRES solves with it, preconditioned by the definite stiffness of some earlier state. */
typedef struct Skew {
    OstNewton *newton;
    double *moved;   /* newton->count */
    double *product; /* 3 × owned_nodes */
    double *of_rows; /* 3 × rows */
} Skew;

/* y += P S P v on the rows */
static OstStatus add_skew(void *data, const double *v, double *y)
{
    const Skew *skew = data;
    const OstNewton *newton = skew->newton;
    const OstProblem *problem = newton->problem;
    OST_TRY(ost_newton_spread(newton, v, skew->moved));
    memset(skew->product, 0, 3 * (size_t)problem->mesh->owned_nodes * sizeof(double));
    OST_TRY(ost_agree(newton->ctx,
                      ost_problem_add_skew(problem, newton->t, newton->displacement, skew->moved, skew->product)));
    OST_TRY(ost_system_take_rows(problem->system, skew->product, skew->of_rows));
    for (size_t i = 0; i < 3 * (size_t)problem->system->matrix->rows; i++)
        y[i] += skew->of_rows[i];
    return OST_SUCCESS;
}

static OstStatus solve_skew(OstNewton *newton, double forcing, const double *rhs)
{
    const OstMesh *mesh = newton->problem->mesh;
    Skew skew = {.newton = newton};
    const OstFurtherPart further = {.data = &skew, .add = add_skew};
    const OstSaddle mixed = ost_newton_saddle(newton, rhs);
    OstStatus status = OST_NEW(newton->ctx, &skew.moved, newton->count);
    OST_THEN(OST_NEW(newton->ctx, &skew.product, 3 * (size_t)mesh->owned_nodes));
    OST_THEN(OST_NEW(newton->ctx, &skew.of_rows, 3 * (size_t)newton->problem->system->matrix->rows));
    status = ost_agree(newton->ctx, status);
    OST_THEN(ost_solver_solve_unsymmetric(newton->stiffness->solver, mixed.coupling ? &mixed : NULL, &further, forcing,
                                          rhs, newton->correction, &newton->solve));
    OST_FREE(skew.moved, skew.product, skew.of_rows);
    return status;
}

/* By the stiffness that the solver has. */
static OstStatus solve(OstNewton *newton, int unsymmetric, double forcing, const double *rhs)
{
    if (unsymmetric)
        return solve_skew(newton, forcing, rhs);
    return ost_newton_is_mixed(newton)
               ? ost_newton_solve_mixed(newton, rhs)
               : ost_solver_solve(newton->stiffness->solver, rhs, newton->correction, &newton->solve);
}

/* By GMRES? Without what moved couplings hold the stiffness may be indefinite though the body is stable. */
static int is_unsymmetric(const OstNewton *newton, int definite)
{
    const int held = newton->couplings && (newton->indefinite || factors_pay(newton));
    return (ost_newton_is_unsymmetric(newton) || held) && !definite && !newton->without_skew;
}

/* One attempt. *again: the hierarchy was old, and a new one may find what it did not. */
static OstStatus attempt(OstNewton *newton, int definite, double forcing, const double *rhs, int *again)
{
    const int old = !newton->rebuild && newton->solve.method != OST_METHOD_DIRECT;
    const int unsymmetric = is_unsymmetric(newton, definite);
    OstStatus status;
    ost_solver_aim(newton->stiffness->solver,
                   (OstSolverAim){.relative_residual = forcing,
                                  .crude = 1,
                                  .probing = !definite,
                                  .first = newton->method,
                                  .coupling = ost_newton_is_mixed(newton) ? newton->problem->coupling : NULL});
    newton->solve.indefinite = newton->by_factors = 0;
    if (unsymmetric) {
        OST_TRY(update_unsymmetric(newton));
        status = solve(newton, 1, accurate, rhs);
        if (newton->solve.relative_residual > inaccurate && !newton->by_factors) {
            newton->rebuild = 1;
            newton->method = OST_METHOD_DIRECT;
        }
    } else {
        OST_TRY(update(newton, definite));
        status = solve(newton, 0, forcing, rhs);
    }
    newton->report.linear_iterations += newton->solve.iterations;
    *again = can_go_on(status) && old && !newton->solve.indefinite;
    if (status == OST_SUCCESS && !old && !newton->by_factors)
        newton->method = newton->solve.method;
    return status;
}

/* What moved couplings do to a correction. */
typedef struct Moved {
    OstNewton *newton;
    int unsymmetric;
} Moved;

static OstStatus solve_moved(void *data, const double *rhs, double *x, int *found)
{
    const Moved *moved = data;
    OstNewton *newton = moved->newton;
    double *const correction = newton->correction;
    newton->correction = x;
    const OstStatus status = solve(newton, moved->unsymmetric, accurate, rhs);
    newton->correction = correction;
    newton->report.linear_iterations += newton->solve.iterations;
    *found = status == OST_SUCCESS;
    return can_go_on(status) ? OST_SUCCESS : status;
}

static OstStatus move_couplings(OstNewton *newton, int definite, int *found)
{
    Moved moved = {newton, is_unsymmetric(newton, definite)};
    const OstSolveReport solve_report = newton->solve;
    double *change = newton->direction + newton->count - newton->multipliers;
    OST_TRY(ost_turned_couplings_correct(newton->couplings, solve_moved, &moved, newton->correction, change, found));
    newton->solve = solve_report;
    return OST_SUCCESS;
}

OstStatus ost_newton_solve(OstNewton *newton, int definite, double forcing, const double *rhs, int *found)
{
    int again = 0;
    *found = 0;
    OstStatus status = attempt(newton, definite, forcing, rhs, &again);
    if (again) {
        newton->rebuild = 1;
        status = attempt(newton, definite, forcing, rhs, &again);
    }
    if (can_go_on(status)) {
        ost_log(newton->ctx, OST_LOG_VERBOSE, "newton: the %s stiffness gives no correction: %s",
                definite ? "definite" : "exact", ost_error_text(newton->ctx));
        newton->rebuild |= !newton->solve.indefinite;
        return OST_SUCCESS;
    }
    OST_TRY(status);
    if (!newton->by_factors)
        judge_hierarchy(newton);
    *found = 1;
    if (newton->couplings)
        OST_TRY(move_couplings(newton, definite, found));
    return ost_newton_spread(newton, newton->correction, newton->direction);
}

OstStatus ost_newton_solve_held(OstNewton *newton, double forcing, const double *rhs, int *found)
{
    OST_TRY(ost_newton_solve(newton, 0, forcing, rhs, found));
    if (*found || !newton->couplings || newton->indefinite)
        return OST_SUCCESS;
    newton->indefinite = newton->rebuild = 1;
    return ost_newton_solve(newton, 0, forcing, rhs, found);
}
