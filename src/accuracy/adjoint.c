/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"
#include "accuracy/search.h"
#include "algebra/matrix/vector.h"
#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

/* What is out of balance at u + length × moved. */
static OstStatus out_of_balance(const OstProblem *problem, double t, const double *u, double length,
                                const double *moved, double *at, double *load, double *force)
{
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->node_count; i++)
        at[i] = u[i] + length * moved[i];
    OST_TRY(ost_problem_force(problem, t, at, force));
    ost_problem_load(problem, t, at, load);
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        force[i] -= load[i];
    return OST_SUCCESS;
}

/* The stiffness at u changes within a tet's edges; the difference over so small a part of the body's size is as good as
 * a derivative. */
static OstStatus find_small_length(const OstProblem *problem, const double *moved, double *length)
{
    static const double small = 1e-6;
    double low[3], high[3], side[3], most = ost_largest(3 * (size_t)problem->mesh->node_count, moved);
    OST_TRY(ost_max(problem->ctx, 1, &most));
    OST_TRY(ost_mesh_bounds(problem->mesh, low, high));
    for (int i = 0; i < 3; i++)
        side[i] = high[i] - low[i];
    *length = small * ost_norm3(side) / (most > 0.0 ? most : 1.0);
    return OST_SUCCESS;
}

/* Minus the force of a given motion where rotations are large, in steps.force. */
static OstStatus move_large(const Search *search, double t, const double *u, const double *moved)
{
    const OstProblem *problem = search->estimate->problem;
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    double *at = NULL, *load = NULL, *behind = NULL, length;
    OST_TRY(find_small_length(problem, moved, &length));
    OstStatus status = OST_NEW(problem->ctx, &at, 3 * (size_t)problem->mesh->node_count);
    OST_THEN(OST_NEW(problem->ctx, &load, owned));
    OST_THEN(OST_NEW(problem->ctx, &behind, owned));
    OST_THEN(out_of_balance(problem, t, u, -length, moved, at, load, behind));
    OST_THEN(out_of_balance(problem, t, u, length, moved, at, load, search->steps.force));
    for (size_t i = 0; i < owned && status == OST_SUCCESS; i++)
        search->steps.force[i] = (behind[i] - search->steps.force[i]) / (2.0 * length);
    OST_FREE(at);
    OST_FREE(load);
    OST_FREE(behind);
    return ost_agree(problem->ctx, status);
}

static void take_strain(const OstInterest *interest, OstMaterialField *field)
{
    field->region_eigenstrain = NULL;
    field->region_per_unit = NULL;
    field->tet_eigenstrain = interest->strain;
    field->eigenstrain_places = 1;
    field->tet_eigenstrain_in_world = interest->strain_in_world;
}

/* The forces of a strain, in steps.force. */
static OstStatus strain_load(Search *search, const OstInterest *interest)
{
    const OstProblem *problem = search->estimate->problem;
    OstMaterialField field;
    OstProblem strained;
    ost_problem_at_pressure(problem, NULL, &field, &strained);
    take_strain(interest, &field);
    memset(search->steps.force, 0, 3 * (size_t)problem->mesh->owned_nodes * sizeof *search->steps.force);
    OST_TRY(ost_agree(problem->ctx, ost_eigenstrain_force(problem->mesh, &field, 1.0, search->steps.force)));
    return ost_steps_take_rows(&search->steps, search->steps.q.rows);
}

/* Minus the force of a given motion by linear theory, in steps.force: by the elements' own stiffness, that of the
 * solve. The pressure of a mixed form has its own equation. */
static OstStatus move_small(const Search *search, const double *moved)
{
    const OstProblem *problem = search->estimate->problem;
    OstMaterialField field;
    OstProblem unpressed;
    ost_problem_at_pressure(problem, NULL, &field, &unpressed);
    OST_TRY(ost_agree(problem->ctx, ost_internal_force(problem->mesh, &field, 0.0, moved, search->steps.force, NULL)));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        search->steps.force[i] = -search->steps.force[i];
    return OST_SUCCESS;
}

/* P times the quantity's derivative, or minus the force of its given motion: the right-hand side of z, in q. The motion
 * strains the body and no spring, whose forces are reactions. */
static OstStatus adjoint_load(Search *search, const OstInterest *interest, double t, const double *u)
{
    OstSteps *steps = &search->steps;
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    if (interest->strain)
        return strain_load(search, interest);
    if (!interest->moved) {
        memcpy(steps->force, interest->load, numbers * sizeof *steps->force);
    } else if (search->estimate->stiffness.turned_by) {
        OST_TRY(move_large(search, t, u, interest->moved));
        for (size_t i = 0; i < numbers && interest->load; i++)
            steps->force[i] += interest->load[i];
        if (problem->supports->spring)
            ost_spring_force(problem->supports, -1.0, interest->moved, steps->force);
    } else {
        OST_TRY(move_small(search, interest->moved));
        for (size_t i = 0; i < numbers && interest->load; i++)
            steps->force[i] += interest->load[i];
    }
    return ost_steps_take_rows(steps, steps->q.rows);
}

/* Ends the solve of an adjoint problem where its error is a small share of z. That is w and what the solve adds to it,
 * a part that may be far larger than the whole, as w ends within one layer of tets. */
typedef struct AdjointStop {
    OstErrorStop stop;
    const Search *search;
    double share, of_given; /* the energy norm of w, squared */
} AdjointStop;

/* OstErrorStop's. |z|² = a(w, w) - f·u, as a(z, u) is 0. */
static OstStatus ask(void *data, const double *u, double error, double *next)
{
    const AdjointStop *stop = data;
    double work = 0.0;
    for (size_t i = 0; i < stop->search->steps.rows; i++)
        work += stop->search->steps.q.rows[i] * u[i];
    OST_TRY(ost_sum(stop->search->estimate->problem->ctx, 1, &work));
    ost_log(stop->search->estimate->problem->ctx, OST_LOG_VERBOSE, "adjoint problem: error of the equations %.2e",
            error);
    *next = stop->share * sqrt(fmax(stop->of_given > 0.0 ? stop->of_given - work : work, 0.0));
    return OST_SUCCESS;
}

static OstStatus energy_of_given(const Search *search, const OstInterest *interest, double *energy)
{
    *energy = 0.0;
    for (size_t i = 0; interest->moved && i < 3 * (size_t)search->estimate->problem->mesh->owned_nodes; i++)
        *energy -= search->steps.force[i] * interest->moved[i];
    return ost_sum(search->estimate->problem->ctx, 1, energy);
}

/* steps.u: the displacement z, to an error of that share in the norm of the energy, or 0: to the solver's residual.
 */
static OstStatus solve_adjoint(Search *search, const OstInterest *interest, double t, const double *u, double share)
{
    AdjointStop stop = {
        .stop = {.ask = ask, .data = &stop, .first = 1e-2, .relative = 1}, .search = search, .share = share};
    OstSolveReport report;
    OST_TRY(adjoint_load(search, interest, t, u));
    OST_TRY(energy_of_given(search, interest, &stop.of_given));
    OstSteps *steps = &search->steps;
    ost_solver_aim(steps->solver, (OstSolverAim){.stop = share > 0.0 ? &stop.stop : NULL});
    const OstStatus solved = ost_solver_solve(steps->solver, steps->q.rows, steps->z, &report);
    ost_solver_aim(steps->solver, (OstSolverAim){0});
    OST_TRY(solved);
    return ost_system_displacement(search->estimate->problem->system, 0.0, steps->z, steps->u);
}

/* r: what a z, and the strain of its load or the pressure of a mixed form, leave on the functions. */
static OstStatus find_left(Search *search, const OstState *of)
{
    OstSteps *steps = &search->steps;
    OstOperator at_state = search->estimate->stiffness;
    double *left = ost_steps_spare(steps);
    at_state.problem = of->problem;
    ost_operator_small_force(&at_state, of->eigen_share, of->u, NULL, left);
    memset(steps->r.rows, 0, steps->rows * sizeof *steps->r.rows);
    return ost_search_take(search, left);
}

/* A tet's part is at most the product of both errors in it. Parts have signs and cancel in part. */
static OstStatus share_interest(const OstProblem *problem, const double *of_adjoint, double error, double *share)
{
    const double least_of_sum = 0.1;
    double sum = 0.0;
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++) {
        share[tet] = sqrt(fmax(share[tet], 0.0) * fmax(of_adjoint[tet], 0.0));
        sum += share[tet];
    }
    OST_TRY(ost_sum(problem->ctx, 1, &sum));
    const double factor = sum > 0.0 ? fmax(fabs(error) / sum, least_of_sum) : 0.0;
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        share[tet] *= factor;
    return OST_SUCCESS;
}

struct OstAdjoint {
    OstContext *ctx;
    size_t nodes;
    OstEnriched e; /* the surplus of z, lengthened, over `size` */
    double size;
    double *pressure;   /* 4 × tet_count: of a mixed form, the error of z's pressure; or NULL */
    OstOrders *orders;  /* owned_tets; NULL where orders above the next are not known */
    double *z;          /* 3 × owned_nodes: what the solve adds to the given motion */
    double *whole;      /* z and that motion, where rotations are large; or NULL */
    int is_reaction;    /* not a displacement, or a mean */
    double *z_pressure; /* the owned pressures of z, of a mixed form; or NULL */
};

void ost_adjoint_destroy(OstAdjoint **adjoint)
{
    if (!*adjoint)
        return;
    OST_FREE((*adjoint)->e.rows);
    OST_FREE((*adjoint)->e.functions);
    OST_FREE((*adjoint)->z, (*adjoint)->whole, (*adjoint)->z_pressure);
    OST_FREE((*adjoint)->pressure);
    OST_FREE((*adjoint)->orders);
    OST_FREE(*adjoint);
}

/* The adjoint problem that is wanted. */
typedef struct Wanted {
    const OstInterest *interest;
    double t;
    const double *u;
    double share;      /* the error of its equations, of z; 0: to the solver's residual */
    double *tet_share; /* owned_tets: each tet's share of the squared error of z is found too; or NULL */
} Wanted;

/* What orders above the next take to know of z: of_second, then of_third, of tets. */
static OstStatus keep_orders(const Search *search, const double *of_second, const double *of_third, OstAdjoint *adjoint)
{
    const OstProblem *problem = search->estimate->problem;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &adjoint->orders, problem->mesh->owned_tets)));
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        adjoint->orders[tet] =
            (OstOrders){(float)fmax(of_third[tet], 0.0), (float)ost_orders_share(of_third[tet], of_second[tet])};
    return OST_SUCCESS;
}

/* Steps for the surplus of z; of_second: what the second order has in z's tets, or NULL: that is not known. */
static OstStatus find_surplus(Search *search, const Wanted *wanted, const double *of_second, OstAdjoint *adjoint)
{
    const OstProblem *problem = search->estimate->problem;
    double square, *of_third = NULL;
    OST_TRY(ost_search_iterate(search, 0.0, &square));
    if (!(wanted->tet_share || of_second) || search->steps.failed)
        return OST_SUCCESS;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &of_third, problem->mesh->owned_tets)));
    OstStatus status = ost_search_displacement(search);
    square = ost_search_true_square(search, square);
    OST_THEN(ost_search_share(search, &square, of_third));
    if (of_second)
        OST_THEN(keep_orders(search, of_second, of_third, adjoint));
    if (wanted->tet_share)
        memcpy(wanted->tet_share, of_third, (size_t)problem->mesh->owned_tets * sizeof *of_third);
    OST_FREE(of_third);
    return status;
}

/* Minus what a given motion adds to the second equation of a mixed form, where rotations are large. */
static OstStatus move_large_volume(const OstProblem *problem, double t, const double *u, const double *moved, double *g)
{
    const OstPressureSpace *space = problem->pressures;
    const size_t nodes = 3 * (size_t)problem->mesh->node_count, owned = (size_t)space->owned;
    const double eigen_share = ost_problem_eigen_share(problem, t);
    double *at = NULL, *ahead = NULL, length;
    OST_TRY(find_small_length(problem, moved, &length));
    OstStatus status = OST_NEW(problem->ctx, &at, nodes);
    OST_THEN(OST_NEW(problem->ctx, &ahead, owned));
    for (size_t i = 0; i < nodes && status == OST_SUCCESS; i++)
        at[i] = u[i] + length * moved[i];
    OST_THEN(ost_pressure_volume(space, problem->field, problem->formulation, eigen_share, at, ahead, NULL));
    for (size_t i = 0; i < nodes && status == OST_SUCCESS; i++)
        at[i] = u[i] - length * moved[i];
    OST_THEN(ost_pressure_volume(space, problem->field, problem->formulation, eigen_share, at, g, NULL));
    for (size_t i = 0; i < owned && status == OST_SUCCESS; i++)
        g[i] = (g[i] - ahead[i]) / (2.0 * length);
    OST_FREE(at);
    OST_FREE(ahead);
    return ost_agree(problem->ctx, status);
}

/* Minus what a given motion, or a strain, adds to the second equation. */
static OstStatus adjoint_volume(const OstProblem *problem, const Wanted *wanted, double *g)
{
    const OstInterest *interest = wanted->interest;
    double *zero = NULL;
    OstMaterialField field;
    OstProblem strained;
    if (interest->moved && !ost_problem_is_linear(problem))
        return move_large_volume(problem, wanted->t, wanted->u, interest->moved, g);
    if (!interest->moved)
        OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &zero, 3 * (size_t)problem->mesh->node_count)));
    ost_problem_at_pressure(problem, NULL, &field, &strained);
    take_strain(interest, &field);
    OstStatus status = ost_pressure_volume(problem->pressures, &field, OST_FORMULATION_LINEAR, 1.0,
                                           interest->moved ? interest->moved : zero, g, NULL);
    for (OstLocal i = 0; i < problem->pressures->owned; i++)
        g[i] = -g[i];
    OST_FREE(zero);
    return ost_agree(problem->ctx, status);
}

/* z only tells an error, of which two digits are enough. */
static const double residual_of_mixed = 1e-4;

/* steps.u: z, and its pressures, of tets, by both equations of a mixed form. */
static OstStatus solve_mixed_adjoint(Search *search, const Wanted *wanted, OstAdjoint *adjoint, double *of_tets,
                                     double *swelling)
{
    const OstProblem *problem = search->estimate->problem;
    const OstPressureSpace *space = problem->pressures;
    const OstInterest *interest = wanted->interest;
    OstSteps *steps = &search->steps;
    OstSolveReport report;
    double *g = NULL, *pressure = NULL;
    int enclosed = 0;
    OstStatus status = OST_NEW(problem->ctx, &g, space->owned);
    OST_THEN(OST_NEW(problem->ctx, &pressure, ost_problem_pressure_room(problem)));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    OST_TRY_DONE(adjoint_volume(problem, wanted, g));
    if (ost_problem_is_linear(problem))
        OST_TRY_DONE(ost_problem_is_enclosed(problem, &enclosed));
    if (enclosed) /* the quantity is that at a mean pressure of 0 */
        OST_TRY_DONE(ost_problem_keep_volume(problem, g, swelling));
    OST_TRY_DONE(adjoint_load(search, interest, wanted->t, wanted->u));
    ost_solver_aim(steps->solver, (OstSolverAim){.relative_residual = residual_of_mixed});
    status = ost_solver_solve_mixed(steps->solver, &(OstSaddle){problem->coupling, g, pressure}, steps->q.rows,
                                    steps->z, &report);
    ost_solver_aim(steps->solver, (OstSolverAim){0});
    OST_TRY_DONE(status);
    OST_TRY_DONE(ost_pressure_complete(space, pressure));
    ost_pressure_of_tets(space, pressure, of_tets);
    adjoint->z_pressure = pressure;
    pressure = NULL;
    status = ost_system_displacement(problem->system, 0.0, steps->z, steps->u);
done:
    OST_FREE(g);
    OST_FREE(pressure);
    return status;
}

/* The surplus of z and of its pressure. */
static OstStatus find_mixed(Search *search, const Wanted *wanted, OstAdjoint *adjoint)
{
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->node_count;
    const OstInterest *interest = wanted->interest;
    double *of_tets = NULL, *z = NULL, swelling = 0.0;
    OstMaterialField field;
    OstProblem state;
    OstStatus status = OST_NEW(problem->ctx, &of_tets, 4 * (size_t)problem->mesh->tet_count);
    OST_THEN(OST_NEW(problem->ctx, &z, numbers));
    OST_THEN(OST_NEW(problem->ctx, &adjoint->pressure, 4 * (size_t)problem->mesh->tet_count));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    OST_TRY_DONE(solve_mixed_adjoint(search, wanted, adjoint, of_tets, &swelling));
    memcpy(adjoint->z, search->steps.u, adjoint->nodes * sizeof *adjoint->z);
    for (size_t i = 0; i < numbers; i++)
        z[i] = search->steps.u[i] + (interest->moved ? interest->moved[i] : 0.0);
    ost_problem_at_pressure(problem, of_tets, &field, &state);
    take_strain(interest, &field);
    const OstState of = {&state, z, interest->strain ? 1.0 : 0.0, OST_FORMULATION_LINEAR, -swelling};
    OST_TRY_DONE(find_left(search, &of));
    OST_TRY_DONE(find_surplus(search, wanted, NULL, adjoint));
    if (!search->steps.failed)
        status = ost_pressure_error(search, &of, adjoint->pressure);
done:
    OST_FREE(of_tets);
    OST_FREE(z);
    return status;
}

/* r of the z of steps.u, which is then in units of steps.size. */
static OstStatus adjoint_residual(Search *search, const OstInterest *interest)
{
    OstSteps *steps = &search->steps;
    const size_t numbers = 3 * (size_t)search->estimate->problem->mesh->node_count;
    OstMaterialField field;
    OstProblem state;
    for (size_t i = 0; interest->moved && i < numbers; i++)
        steps->u[i] += interest->moved[i];
    ost_problem_at_pressure(search->estimate->problem, NULL, &field, &state);
    take_strain(interest, &field);
    OST_TRY(
        find_left(search, &(OstState){&state, steps->u, interest->strain ? 1.0 : 0.0, OST_FORMULATION_LINEAR, 0.0}));
    for (size_t i = 0; i < numbers; i++)
        steps->u[i] /= steps->size;
    return OST_SUCCESS;
}

/* What the second order has of z, which is steps.u in units of steps.size, and stays. */
static OstStatus find_second(Search *search, double *of_second)
{
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->node_count;
    const double square = search->steps.size * search->steps.size;
    double *z = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &z, numbers)));
    memcpy(z, search->steps.u, numbers * sizeof *z);
    ost_orders_second(search, z, of_second);
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        of_second[tet] *= square;
    OST_FREE(z);
    return OST_SUCCESS;
}

static OstStatus find_plain(Search *search, const Wanted *wanted, OstAdjoint *adjoint)
{
    const OstProblem *problem = search->estimate->problem;
    double *of_second = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY(solve_adjoint(search, wanted->interest, wanted->t, wanted->u, wanted->share));
    memcpy(adjoint->z, search->steps.u, adjoint->nodes * sizeof *adjoint->z);
    OST_TRY(adjoint_residual(search, wanted->interest));
    /* The z of a displacement is that of a force at a vertex, which has no energy: its orders tell nothing. */
    if ((wanted->interest->moved || wanted->interest->strain) && ost_orders_are_known(search->estimate)) {
        OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &of_second, problem->mesh->owned_tets)));
        OST_TRY_DONE(find_second(search, of_second));
    }
    status = find_surplus(search, wanted, of_second, adjoint);
done:
    OST_FREE(of_second);
    return status;
}

static OstStatus find_adjoint(Search *search, const Wanted *wanted, OstAdjoint *adjoint)
{
    search->of_adjoint = 1;
    OST_TRY(search->estimate->problem->pressures ? find_mixed(search, wanted, adjoint)
                                                 : find_plain(search, wanted, adjoint));
    adjoint->size = search->longer * search->steps.size;
    memcpy(adjoint->e.rows, search->steps.e.rows, search->steps.rows * sizeof *adjoint->e.rows);
    memcpy(adjoint->e.functions, search->steps.e.functions,
           OST_PER_FUNCTION * search->steps.functions * sizeof *adjoint->e.functions);
    return OST_SUCCESS;
}

static OstStatus create(OstEstimate *estimate, OstSolver *solver, const Wanted *wanted, OstAdjoint **adjoint)
{
    const OstProblem *problem = estimate->problem;
    Search search = {0};
    *adjoint = NULL;
    OstStatus status = ost_search_move(estimate, wanted->u);
    OST_THEN(ost_search_open(estimate, solver, &search));
    OST_THEN(ost_agree(problem->ctx, OST_NEW(problem->ctx, adjoint, 1)));
    if (status == OST_SUCCESS) {
        **adjoint = (OstAdjoint){.ctx = problem->ctx,
                                 .nodes = 3 * (size_t)problem->mesh->owned_nodes,
                                 .is_reaction = wanted->interest->moved != NULL};
        status = OST_NEW(problem->ctx, &(*adjoint)->e.rows, search.steps.rows);
        OST_THEN(OST_NEW(problem->ctx, &(*adjoint)->e.functions, OST_PER_FUNCTION * search.steps.functions));
        OST_THEN(OST_NEW(problem->ctx, &(*adjoint)->z, (*adjoint)->nodes));
        if (!ost_problem_is_linear(problem))
            OST_THEN(OST_NEW(problem->ctx, &(*adjoint)->whole, (*adjoint)->nodes));
        status = ost_agree(problem->ctx, status);
    }
    OST_THEN(find_adjoint(&search, wanted, *adjoint));
    for (size_t i = 0; status == OST_SUCCESS && (*adjoint)->whole && i < (*adjoint)->nodes; i++)
        (*adjoint)->whole[i] = (*adjoint)->z[i] + (wanted->interest->moved ? wanted->interest->moved[i] : 0.0);
    if (status != OST_SUCCESS || search.steps.failed)
        ost_adjoint_destroy(adjoint);
    ost_steps_close(&search.steps);
    return status;
}

OstStatus ost_adjoint_create(OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                             const OstInterest *interest, double share, OstAdjoint **adjoint)
{
    return create(estimate, solver, &(Wanted){interest, t, u, share, NULL}, adjoint);
}

/* Where stiff directions cross quadratic tets, the next order misses a part of both errors. Of the sum of their
 * products without signs, 0.2 to 0.55 was missing in reactions of four blocks and a bolt in a plate, with any sign. */
static const double missed = 0.2;

/* Where rotations are large the answer balances forces by the elements' own quadrature: the work on z of what finer
 * quadrature says less is an error too, and most of that of a moment of coarse quadratic tets. After
 * ost_search_residual. */
static OstStatus find_missing(const Search *search, const OstAdjoint *adjoint, double *work)
{
    *work = 0.0;
    for (size_t i = 0; adjoint->whole && i < adjoint->nodes; i++)
        *work += search->steps.force[i] * adjoint->whole[i];
    return ost_sum(adjoint->ctx, 1, work);
}

OstStatus ost_adjoint_error(const OstAdjoint *adjoint, OstEstimate *estimate, double t, const double *u,
                            const double *tet_error, double *error)
{
    Search search = {0};
    double of_orders = estimate->of_flat, unsigned_sum = 0.0, missing = 0.0;
    OstStatus status = ost_search_move(estimate, u);
    OST_THEN(ost_search_open(estimate, NULL, &search));
    OST_THEN(ost_search_residual(&search, t, u));
    OST_THEN(find_missing(&search, adjoint, &missing));
    OST_THEN(ost_steps_dot(&search.steps, &search.steps.r, &adjoint->e, error));
    if (adjoint->orders && tet_error)
        OST_THEN(ost_orders_of_product(&search, u, tet_error, adjoint->orders, &of_orders, &unsigned_sum));
    *error *= status == OST_SUCCESS ? -of_orders * adjoint->size * search.steps.size * estimate->stiffness.unit : 0.0;
    *error -= missing;
    if (estimate->misses && adjoint->is_reaction)
        *error = copysign(hypot(*error, missed * unsigned_sum), *error);
    ost_steps_close(&search.steps);
    if (adjoint->pressure) {
        double of_pressure = 0.0;
        const OstProblem *problem = estimate->problem;
        const OstState state = {problem, u, ost_problem_eigen_share(problem, t), problem->formulation, 0.0};
        OST_THEN(ost_pressure_work(estimate, &state, adjoint->pressure, &of_pressure));
        *error += of_pressure;
    }
    return status;
}

int ost_estimate_misses(const OstEstimate *estimate)
{
    return estimate->misses;
}

const double *ost_adjoint_displacement(const OstAdjoint *adjoint)
{
    return adjoint->z;
}

const double *ost_adjoint_pressure(const OstAdjoint *adjoint)
{
    return adjoint->z_pressure;
}

/* What a solve that stopped early leaves of the quantity: the work of what is out of balance on z. */
static OstStatus add_equations(const OstProblem *problem, const OstAdjoint *adjoint, double t, const double *u,
                               double *error)
{
    double *force = NULL, *load = NULL, work = 0.0;
    OstStatus status = OST_NEW(problem->ctx, &force, adjoint->nodes);
    OST_THEN(OST_NEW(problem->ctx, &load, adjoint->nodes));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    OST_TRY_DONE(ost_problem_force(problem, t, u, force));
    ost_problem_load(problem, t, u, load);
    for (size_t i = 0; i < adjoint->nodes; i++)
        work += (load[i] - force[i]) * adjoint->z[i];
    OST_TRY_DONE(ost_sum(problem->ctx, 1, &work));
    *error += work;
done:
    OST_FREE(force);
    OST_FREE(load);
    return status;
}

OstStatus ost_estimate_interest(OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                                const OstInterest *interest, double share, double *error, double *tet_share)
{
    const OstProblem *problem = estimate->problem;
    OstAdjoint *adjoint = NULL;
    double *of_adjoint = NULL;
    *error = NAN;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &of_adjoint, problem->mesh->owned_tets)));
    OstStatus status = create(estimate, solver, &(Wanted){interest, t, u, share, of_adjoint}, &adjoint);
    if (adjoint) {
        OST_THEN(ost_adjoint_error(adjoint, estimate, t, u, tet_share, error));
        if (!interest->moved) /* unlike a reaction, which is the work of u on z, on which the exact error does none */
            *error = -*error;
        if (interest->stopped && !problem->pressures)
            OST_THEN(add_equations(problem, adjoint, t, u, error));
        *error += copysign(interest->doubt, *error);
        OST_THEN(share_interest(problem, of_adjoint, *error, tet_share));
    }
    ost_adjoint_destroy(&adjoint);
    OST_FREE(of_adjoint);
    return status;
}
