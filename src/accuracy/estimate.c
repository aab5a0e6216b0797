/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"

#include "accuracy/earlier.h"
#include "accuracy/loads.h"
#include "accuracy/operator.h"
#include "algebra/matrix/vector.h"
#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/free_body.h"

#include <math.h>
#include <string.h>

/* Steps end when what is to come is below the first share of |e|_A², and what the last pair added below the second.
 * Gains of pairs of steps are taken to fall by no less than the ratio. On linear tets that lock they fall, and then
 * stay for long: more is asked for there. */
typedef struct Enough {
    double rest, gain;
} Enough;
static const Enough enough_of_linear = {0.45, 0.2}, enough_of_locked = {0.25, 0.115}, enough_of_quadratic = {0.45, 1.0};
static const double largest_ratio = 0.75;

/* The share where errors of other loads gave a start, and what one pair of steps may add to that to be the last. */
static const double small_rest_of_start = 0.05, little_new = 0.03;

enum { most_pairs = 12 };

/* The later steps of an error add about as much to the first pair as those of another load's error did whose second
 * step was as large beside its first (within the factor): then they are taken to, unless it is too much of the whole.
 * Seen on beams and tubes, linear and quadratic: the size differs by up to 6 % from that of all steps. */
static const double alike = 1.3, most_of_tail = 0.5;

enum { MOST_TAILS = 16 };

/* Of errors for which more than one pair of steps was taken: the second step over the first, and what all steps add
 * over what the first pair does. */
typedef struct Tails {
    int count;
    double second[MOST_TAILS], whole[MOST_TAILS];
} Tails;

struct OstEstimate {
    const OstProblem *problem;
    int is_shared; /* is all but the loads another's? */
    OstComplement complement;
    OstSurplusLoads loads;
    OstOperator stiffness;
    double *inverse;     /* of the functions' blocks, once they are known */
    int has_inverse;     /* of linear theory */
    OstEarlier *earlier; /* what was found for other loads; or NULL */
    Tails tails;         /* of them */
    Enough enough;
};

void ost_estimate_destroy(OstEstimate **estimate)
{
    if (!*estimate)
        return;
    ost_surplus_loads_clear(&(*estimate)->loads);
    if (!(*estimate)->is_shared) {
        ost_light_tets_destroy(&(*estimate)->stiffness.light);
        ost_complement_clear(&(*estimate)->complement);
        OST_FREE((*estimate)->inverse);
        ost_earlier_destroy(&(*estimate)->earlier);
    }
    OST_FREE(*estimate);
}

static Enough find_enough(const OstProblem *problem)
{
    if (problem->mesh->nodes_per_tet == 10)
        return enough_of_quadratic;
    for (int r = 0; r < problem->field->region_count; r++) {
        double eigenvalues[3] = {1.0, 1.0, 1.0};
        if (ost_orthotropic_eigenvalues(problem->ctx, &problem->field->material[r].constants, eigenvalues) ==
                OST_SUCCESS &&
            ost_has_one_stiff_mode(eigenvalues, OST_NEARLY_INCOMPRESSIBLE))
            return enough_of_locked;
    }
    return enough_of_linear;
}

static OstStatus create(OstEstimate *estimate)
{
    const OstProblem *problem = estimate->problem;
    OST_TRY(ost_complement_create(problem->mesh, problem->supports, &estimate->complement));
    OST_TRY(ost_surplus_loads_create(problem, &estimate->complement, &estimate->loads));
    estimate->stiffness = (OstOperator){problem, &estimate->complement, NULL, NULL};
    estimate->enough = find_enough(problem);
    OstStatus status = ost_light_tets_create(problem, &estimate->complement, &estimate->stiffness.light);
    OST_THEN(OST_NEW(problem->ctx, &estimate->inverse, 6 * (size_t)estimate->complement.count));
    return ost_agree(problem->ctx, status);
}

OstStatus ost_estimate_take_loading(OstEstimate *estimate)
{
    if (!estimate->problem->scene)
        return OST_SUCCESS;
    ost_surplus_loads_clear(&estimate->loads);
    return ost_surplus_loads_create(estimate->problem, &estimate->complement, &estimate->loads);
}

OstStatus ost_estimate_remember(OstEstimate *estimate)
{
    const OstProblem *problem = estimate->problem;
    if (!problem->scene || !ost_problem_is_linear(problem) || estimate->earlier)
        return OST_SUCCESS;
    const size_t size = 3 * ((size_t)problem->system->matrix->rows + (size_t)estimate->complement.count);
    return ost_agree(problem->ctx, ost_earlier_create(problem->ctx, size, &estimate->earlier));
}

/* Takes the stiffness to u. */
static OstStatus move(OstEstimate *estimate, const double *u)
{
    const int is_linear = ost_problem_is_linear(estimate->problem);
    estimate->stiffness.turned_by = is_linear ? NULL : u;
    if (is_linear && estimate->has_inverse)
        return OST_SUCCESS;
    estimate->has_inverse = is_linear;
    return ost_agree(estimate->problem->ctx, ost_operator_diagonal(&estimate->stiffness, estimate->inverse));
}

OstStatus ost_estimate_create(const OstProblem *problem, OstEstimate **estimate)
{
    OstStatus status = ost_agree(problem->ctx, OST_NEW(problem->ctx, estimate, 1));
    if (status != OST_SUCCESS)
        return status;
    (*estimate)->problem = problem;
    if (problem->scene)
        status = create(*estimate);
    if (status != OST_SUCCESS)
        ost_estimate_destroy(estimate);
    return status;
}

OstStatus ost_estimate_share(OstEstimate *estimate, const OstProblem *problem, OstEstimate **shared)
{
    if (problem->scene)
        OST_TRY(move(estimate, NULL));
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, shared, 1)));
    **shared = *estimate;
    (*shared)->problem = (*shared)->stiffness.problem = problem;
    (*shared)->is_shared = 1;
    (*shared)->loads = (OstSurplusLoads){0};
    (*shared)->earlier = NULL;
    return problem->scene ? ost_surplus_loads_create(problem, &estimate->complement, &(*shared)->loads) : OST_SUCCESS;
}

/* --- conjugate gradients on elements and complement --- */

/* Vectors: 3 numbers for each row of the system, then 3 for each function; in most of them those of ghosts are 0. */
typedef struct Search {
    OstEstimate *estimate;
    OstSolver *solver;
    size_t rows, all; /* numbers of the rows, and of both */
    double *r, *p, *q, *e;
    double *z;         /* of the rows alone */
    double *u, *force; /* of nodes: a displacement, and forces on it */
    double longer;     /* by what e is short of in its work on the residual, as extrapolated: a factor */
    double energy;     /* of this rank's tets, under u; NAN: not known */
    int turns;         /* directions found so far */
    int is_short;      /* were later steps taken to be as those of an earlier load? */
    int failed;        /* is the preconditioner, or the stiffness, not positive definite? */
} Search;

static OstStatus open_search(OstEstimate *estimate, OstSolver *solver, Search *search)
{
    const OstProblem *problem = estimate->problem;
    OstContext *ctx = problem->ctx;
    *search = (Search){.estimate = estimate, .solver = solver};
    search->rows = 3 * (size_t)problem->system->matrix->rows;
    search->all = search->rows + 3 * (size_t)estimate->complement.count;
    OstStatus status = OST_NEW(ctx, &search->r, 4 * search->all);
    OST_THEN(OST_NEW(ctx, &search->z, search->rows));
    OST_THEN(OST_NEW(ctx, &search->u, 3 * (size_t)problem->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &search->force, 3 * (size_t)problem->mesh->owned_nodes));
    OST_TRY(ost_agree(ctx, status));
    search->p = search->r + search->all;
    search->q = search->p + search->all;
    search->e = search->q + search->all;
    return OST_SUCCESS;
}

static void close_search(Search *search)
{
    OST_FREE(search->r);
    OST_FREE(search->z);
    OST_FREE(search->u);
    OST_FREE(search->force);
}

static OstStatus dot(const Search *search, const double *a, const double *b, double *product)
{
    return ost_vector_dot(search->estimate->problem->ctx, search->all, a, b, product);
}

/* The rows' part of forces on nodes. */
static OstStatus take_rows(const Search *search, double *vector)
{
    return ost_system_take_rows(search->estimate->problem->system, search->force, vector);
}

/* q = A p */
static OstStatus multiply(Search *search)
{
    const OstProblem *problem = search->estimate->problem;
    double *of_functions = search->q + search->rows;
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->p, search->u));
    OST_TRY(ost_complement_import(&search->estimate->complement, search->p + search->rows));
    ost_operator_apply(&search->estimate->stiffness, search->u, search->p + search->rows, search->force, of_functions);
    if (problem->supports->spring)
        ost_spring_force(problem->supports, -1.0, search->u, search->force);
    ost_complement_project(&search->estimate->complement, of_functions);
    return take_rows(search, search->q);
}

/* z = B r on the rows. The elements' own unknowns take part in every other step: hardly more steps are needed so, and a
 * multigrid cycle takes as long as several products with A. On quadratic tets, where that is most of the time, the
 * first pair of steps is without. */
static OstStatus precondition(Search *search)
{
    int found = 1;
    const int first = search->estimate->complement.mesh->nodes_per_tet == 10 ? 2 : 1, turn = search->turns++;
    if (turn >= first && (turn - first) % 2 == 0)
        OST_TRY(ost_solver_precondition(search->solver, search->r, search->z, &found));
    else
        memset(search->z, 0, search->rows * sizeof *search->z);
    search->failed = !found;
    return OST_SUCCESS;
}

/* z = B r of a function. */
static inline void precondition_function(const Search *search, size_t k, double z[3])
{
    const double *b = search->estimate->inverse + 6 * k, *r = search->r + search->rows + 3 * k;
    z[0] = b[0] * r[0] + b[3] * r[1] + b[5] * r[2];
    z[1] = b[3] * r[0] + b[1] * r[1] + b[4] * r[2];
    z[2] = b[5] * r[0] + b[4] * r[1] + b[2] * r[2];
}

/* r·z and z·q. (Those of the functions are found again where they are needed: so they take no memory.) */
static OstStatus weigh(const Search *search, double sums[2])
{
    sums[0] = sums[1] = 0.0;
    for (size_t i = 0; i < search->rows; i++) {
        sums[0] += search->r[i] * search->z[i];
        sums[1] += search->q[i] * search->z[i];
    }
    for (size_t k = 0; k < (size_t)search->estimate->complement.count; k++) {
        const double *r = search->r + search->rows + 3 * k, *q = search->q + search->rows + 3 * k;
        double z[3];
        precondition_function(search, k, z);
        sums[0] += r[0] * z[0] + r[1] * z[1] + r[2] * z[2];
        sums[1] += q[0] * z[0] + q[1] * z[1] + q[2] * z[2];
    }
    return ost_sum(search->estimate->problem->ctx, 2, sums);
}

/* Goes along p: `gain` is what that adds to |e|_A², `weight` r·z before. */
static OstStatus go_on(Search *search, double weight, double *gain)
{
    double curvature = 0.0;
    OST_TRY(multiply(search));
    OST_TRY(dot(search, search->p, search->q, &curvature));
    search->failed = !(curvature > 0.0);
    const double length = search->failed ? 0.0 : weight / curvature;
    for (size_t i = 0; i < search->all; i++) {
        search->e[i] += length * search->p[i];
        search->r[i] -= length * search->q[i];
    }
    *gain = length * weight;
    return OST_SUCCESS;
}

/* The next direction, as if the preconditioner varied (Polak and Ribiere). */
static OstStatus turn(Search *search, double gain, double *weight)
{
    const double before = *weight;
    double sums[2];
    OST_TRY(precondition(search));
    OST_TRY(weigh(search, sums));
    const double share = before > 0.0 ? -gain * sums[1] / (before * before) : 0.0;
    *weight = sums[0];
    for (size_t i = 0; i < search->rows; i++)
        search->p[i] = search->z[i] + share * search->p[i];
    for (size_t k = 0; k < (size_t)search->estimate->complement.count; k++) {
        double *p = search->p + search->rows + 3 * k, z[3];
        precondition_function(search, k, z);
        for (int i = 0; i < 3; i++)
            p[i] = z[i] + share * p[i];
    }
    search->failed |= !(*weight >= 0.0) || !isfinite(*weight);
    return OST_SUCCESS;
}

/* What all pairs of steps after this one would add to |e|_A², if gains go on falling as from the last to this. */
static double gains_to_come(double gain, double last)
{
    const double ratio = last > 0.0 ? fmin(gain / last, largest_ratio) : 0.0;
    return gain * ratio / (1.0 - ratio);
}

/* What steps after the first pair would add, as with an earlier load; NAN: none was alike. */
static double learned_to_come(const Tails *tails, double second, double gain)
{
    for (int k = 0; k < tails->count; k++)
        if (second <= alike * tails->second[k] && tails->second[k] <= alike * second)
            return (tails->whole[k] - 1.0) * gain;
    return NAN;
}

static void learn(Tails *tails, double second, double whole)
{
    if (tails->count == MOST_TAILS || !(second > 0.0 && whole >= 1.0))
        return;
    tails->second[tails->count] = second;
    tails->whole[tails->count++] = whole;
}

/* Two steps, of which at most one takes a multigrid cycle. `of_step`: what the last one added. */
static OstStatus take_pair(Search *search, double *weight, double *of_step, double *gain)
{
    *gain = 0.0;
    for (int k = 0; k < 2 && !search->failed; k++) {
        OST_TRY(turn(search, *of_step, weight));
        if (search->failed || !(*weight > 0.0))
            break;
        OST_TRY(go_on(search, *weight, of_step));
        *gain += *of_step;
    }
    return OST_SUCCESS;
}

/* Pairs of steps until what is to come of |e|_A² is small; `start` is that of the part of e that was found before. */
static OstStatus iterate(Search *search, double start, double *square)
{
    OstContext *ctx = search->estimate->problem->ctx;
    const Enough *enough = &search->estimate->enough;
    double weight = 0.0, of_step = 0.0, gain = 0.0, sum = start, first = 0.0, second = 0.0;
    Tails *tails = search->estimate->earlier ? &search->estimate->tails : NULL;
    int learns = tails != NULL;
    *square = start;
    search->turns = 0;
    for (int k = 1; k <= most_pairs && !search->failed; k++) {
        const double last = gain;
        OST_TRY(take_pair(search, &weight, &of_step, &gain));
        sum += gain;
        double to_come = gains_to_come(gain, last);
        if (k == 1) {
            first = gain;
            second = of_step / (gain - of_step);
            const double learned = tails ? learned_to_come(tails, second, gain) : NAN;
            learns &= isnan(learned);
            search->is_short = learned <= most_of_tail * (sum + learned);
            to_come = search->is_short ? learned : to_come;
        }
        *square = sum + to_come;
        ost_log(ctx, OST_LOG_VERBOSE, "error estimate: pair %d of steps: %.6e, with %.6e to come", k, sqrt(sum),
                sqrt(to_come));
        const int falls =
            to_come <= (start > 0.0 ? small_rest_of_start : enough->rest) * *square && gain <= enough->gain * sum;
        const int known = start > 0.0 && gain <= little_new * sum;
        if (!(gain > 0.0) || (k > 1 ? falls : known || search->is_short))
            break;
    }
    if (learns && gain < first)
        learn(tails, second, (*square - start) / first);
    search->longer = sum > 0.0 ? *square / sum : 1.0;
    return OST_SUCCESS;
}

/* What is left on the elements' own unknowns, once more: few steps have little of a displacement far from where its
 * error is made. */
static OstStatus settle(Search *search)
{
    int found = 0;
    OST_TRY(ost_solver_precondition(search->solver, search->r, search->z, &found));
    for (size_t i = 0; i < search->rows && found; i++)
        search->e[i] += search->z[i];
    return OST_SUCCESS;
}

/* Makes up for the steps that were not taken. */
static void lengthen(Search *search)
{
    for (size_t i = 0; i < search->all; i++)
        search->e[i] *= search->longer;
    search->longer = 1.0;
}

/* Steps from the best combination of what was found for other loads. */
static OstStatus iterate_from(Search *search, double *square)
{
    OstEarlier *earlier = search->estimate->earlier;
    double start;
    OST_TRY(ost_earlier_start(earlier, search->r, &start));
    OST_TRY(iterate(search, start, square));
    return search->failed ? OST_SUCCESS : ost_earlier_finish(earlier, search->r, search->e);
}

/* r = f - A u on the functions; on the rows, by how much the elements' own quadrature differs. */
static OstStatus find_residual(Search *search, double t, const double *u)
{
    const OstEstimate *estimate = search->estimate;
    const OstProblem *problem = estimate->problem;
    const OstComplement *complement = &estimate->complement;
    double *of_functions = search->r + search->rows;
    OST_TRY(ost_agree(problem->ctx,
                      ost_operator_force(&estimate->stiffness, t, u, search->force, of_functions, &search->energy)));
    for (size_t i = 0; i < 3 * (size_t)complement->count; i++)
        of_functions[i] = -of_functions[i];
    ost_surplus_loads_add(&estimate->loads, problem, complement, t, u, of_functions);
    for (size_t k = 0; k < (size_t)complement->count; k++)
        if (!ost_complement_owns(complement, (OstLocal)k))
            memset(of_functions + 3 * k, 0, 3 * sizeof *of_functions);
    ost_complement_project(complement, of_functions);
    return take_rows(search, search->r);
}

static OstStatus compare(Search *search, double t, const double *u, double square, OstAnswerError *found)
{
    const OstProblem *problem = search->estimate->problem;
    double most[2] = {0.0}, energy = 0.0;
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->e, search->u));
    for (size_t n = 0; n < (size_t)problem->mesh->owned_nodes; n++) {
        double better[3];
        for (size_t i = 0; i < 3; i++)
            better[i] = u[3 * n + i] + search->u[3 * n + i];
        most[0] = fmax(most[0], ost_norm3(search->u + 3 * n));
        most[1] = fmax(most[1], ost_norm3(better));
    }
    OST_TRY(ost_max(problem->ctx, 2, most));
    if (isnan(search->energy)) {
        OST_TRY(ost_problem_energy(problem, t, u, &energy));
    } else {
        energy = search->energy;
        OST_TRY(ost_sum(problem->ctx, 1, &energy));
    }
    found->energy_norm = sqrt(square);
    found->relative = square > 0.0 ? sqrt(square / (square + 2.0 * energy)) : 0.0;
    found->displacement = most[1] > 0.0 ? most[0] / most[1] : 0.0;
    found->known = 1;
    return OST_SUCCESS;
}

static OstStatus share(Search *search, double square, double *tet_error, double *stress)
{
    const OstProblem *problem = search->estimate->problem;
    double sum = 0.0;
    OST_TRY(ost_complement_import(&search->estimate->complement, search->e + search->rows));
    ost_operator_energy(&search->estimate->stiffness, search->u, search->e + search->rows, tet_error, stress);
    for (size_t i = 0; i < 6 * (size_t)problem->mesh->owned_tets && stress; i++)
        stress[i] *= search->longer;
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        sum += tet_error[tet];
    OST_TRY(ost_sum(problem->ctx, 1, &sum));
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        tet_error[tet] *= sum > 0.0 ? square / sum : 0.0;
    return OST_SUCCESS;
}

/* The surplus at the nodes, lengthened by what was extrapolated of it: its own work on the residual. */
static OstStatus hand_out(Search *search, double *surplus)
{
    const OstProblem *problem = search->estimate->problem;
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->u));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        surplus[i] = search->longer * search->u[i];
    return OST_SUCCESS;
}

OstStatus ost_estimate_find(OstEstimate *estimate, OstSolver *solver, double t, const double *u, OstAnswerError *found,
                            const OstSurplus *surplus)
{
    Search search = {0};
    double square = 0.0;
    *found = (OstAnswerError){0};
    if (!estimate->problem->scene)
        return OST_SUCCESS;
    OstStatus status = move(estimate, u);
    OST_THEN(open_search(estimate, solver, &search));
    OST_THEN(find_residual(&search, t, u));
    const int has_earlier = estimate->earlier && !estimate->stiffness.turned_by; /* of the same stiffness */
    OST_THEN(has_earlier ? iterate_from(&search, &square) : iterate(&search, 0.0, &square));
    if (status == OST_SUCCESS && !search.failed) {
        if (surplus->displacement || search.is_short)
            status = settle(&search);
        if (search.is_short)
            lengthen(&search);
        OST_THEN(compare(&search, t, u, square, found));
        if (surplus->tet_error)
            OST_THEN(share(&search, square, surplus->tet_error, surplus->stress));
        if (surplus->displacement)
            OST_THEN(hand_out(&search, surplus->displacement));
    }
    close_search(&search);
    return status;
}

/* --- a quantity of interest --- */

/* P times the quantity's derivative, or minus the force of its given motion: the right-hand side of z. */
static OstStatus adjoint_load(Search *search, const OstInterest *interest)
{
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    if (interest->load) {
        memcpy(search->force, interest->load, numbers * sizeof *search->force);
    } else {
        memset(search->p, 0, search->all * sizeof *search->p);
        ost_operator_apply(&search->estimate->stiffness, interest->moved, search->p + search->rows, search->force,
                           search->q + search->rows);
        if (problem->supports->spring)
            ost_spring_force(problem->supports, -1.0, interest->moved, search->force);
        for (size_t i = 0; i < numbers; i++)
            search->force[i] = -search->force[i];
    }
    return take_rows(search, search->q);
}

/* r: what z leaves of the adjoint problem on the functions. */
static OstStatus adjoint_residual(Search *search, const OstInterest *interest)
{
    const OstProblem *problem = search->estimate->problem;
    const OstComplement *complement = &search->estimate->complement;
    double *of_functions = search->r + search->rows;
    OstSolveReport report;
    OST_TRY(adjoint_load(search, interest));
    OST_TRY(ost_solver_solve(search->solver, search->q, search->z, &report));
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->z, search->u));
    for (size_t i = 0; interest->moved && i < 3 * (size_t)problem->mesh->node_count; i++)
        search->u[i] += interest->moved[i];
    memset(search->p, 0, search->all * sizeof *search->p);
    ost_operator_apply(&search->estimate->stiffness, search->u, search->p + search->rows, search->force, of_functions);
    for (size_t k = 0; k < (size_t)complement->count; k++)
        for (size_t i = 3 * k; i < 3 * k + 3; i++)
            of_functions[i] = ost_complement_owns(complement, (OstLocal)k) ? -of_functions[i] : 0.0;
    ost_complement_project(complement, of_functions);
    return OST_SUCCESS;
}

/* The work of u's residual on e, the surplus of z. */
static OstStatus work_on(Search *search, double t, const double *u, double *work)
{
    memset(search->r, 0, search->all * sizeof *search->r);
    OST_TRY(find_residual(search, t, u));
    OST_TRY(dot(search, search->r, search->e, work));
    *work *= search->longer;
    return OST_SUCCESS;
}

/* A tet's part is at most the product of both errors in it. Parts have signs and cancel in part. */
static OstStatus share_interest(const Search *search, const double *of_adjoint, double error, double *share)
{
    const double least_of_sum = 0.1;
    const OstProblem *problem = search->estimate->problem;
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

OstStatus ost_estimate_interest(OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                                const OstInterest *interest, double *error, double *tet_share)
{
    const OstProblem *problem = estimate->problem;
    Search search = {0};
    double square = 0.0, *of_adjoint = NULL;
    *error = NAN;
    OstStatus status = move(estimate, u);
    OST_THEN(open_search(estimate, solver, &search));
    OST_TRY_DONE(ost_agree(
        problem->ctx, status == OST_SUCCESS ? OST_NEW(problem->ctx, &of_adjoint, problem->mesh->owned_tets) : status));
    OST_TRY_DONE(adjoint_residual(&search, interest));
    memset(search.z, 0, search.rows * sizeof *search.z);
    OST_TRY_DONE(iterate(&search, 0.0, &square));
    if (search.failed)
        goto done;
    OST_TRY_DONE(ost_system_displacement(problem->system, 0.0, search.e, search.u));
    OST_TRY_DONE(share(&search, square, of_adjoint, NULL));
    OST_TRY_DONE(work_on(&search, t, u, error));
    if (interest->moved) /* a reaction is the work of u on z, on which the exact error does no work */
        *error = -*error;
    OST_TRY_DONE(share_interest(&search, of_adjoint, *error, tet_share));
done:
    OST_FREE(of_adjoint);
    close_search(&search);
    return status;
}
