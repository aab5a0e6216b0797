/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"

#include "accuracy/blocks.h"
#include "accuracy/earlier.h"
#include "accuracy/loads.h"
#include "accuracy/search.h"
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
    OstComplement complement;
    OstSurplusLoads loads;
    OstOperator stiffness;
    float *factor;       /* of the functions' blocks, once they are known */
    int has_factor;      /* of linear theory */
    OstEarlier *earlier; /* what was found for other loads; or NULL */
    Tails tails;         /* of them */
    Enough enough;
};

void ost_estimate_destroy(OstEstimate **estimate)
{
    if (!*estimate)
        return;
    ost_light_tets_destroy(&(*estimate)->stiffness.light);
    ost_surplus_loads_clear(&(*estimate)->loads);
    ost_complement_clear(&(*estimate)->complement);
    OST_FREE((*estimate)->factor);
    ost_earlier_destroy(&(*estimate)->earlier);
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
    OstOperator *stiffness = &estimate->stiffness;
    *stiffness = (OstOperator){.problem = problem, .complement = &estimate->complement};
    OST_TRY(ost_operator_unit(problem, &stiffness->unit));
    estimate->enough = find_enough(problem);
    OstStatus status = ost_light_tets_create(problem, &estimate->complement, stiffness->unit, &stiffness->light);
    OST_THEN(OST_NEW(problem->ctx, &estimate->factor, OST_PER_BLOCK * (size_t)estimate->complement.count));
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
    return ost_agree(problem->ctx, ost_earlier_create(problem->ctx, 3 * (size_t)problem->system->matrix->rows,
                                                      OST_PER_FUNCTION * (size_t)estimate->complement.count,
                                                      &estimate->earlier));
}

/* Takes the stiffness to u. */
static OstStatus move(OstEstimate *estimate, const double *u)
{
    const int is_linear = ost_problem_is_linear(estimate->problem);
    estimate->stiffness.turned_by = is_linear ? NULL : u;
    if (is_linear && estimate->has_factor)
        return OST_SUCCESS;
    estimate->has_factor = is_linear;
    return ost_agree(estimate->problem->ctx, ost_operator_blocks(&estimate->stiffness, estimate->factor));
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

/* --- the error --- */

typedef struct Search {
    OstSearch cg;
    OstEstimate *estimate;
    double longer; /* by what e is short of in its work on the residual, as extrapolated: a factor */
    double energy; /* of this rank's tets, under u; NAN: not known */
    int is_short;  /* were later steps taken to be as those of an earlier load? */
} Search;

static OstStatus open_search(OstEstimate *estimate, OstSolver *solver, Search *search)
{
    *search = (Search){.estimate = estimate};
    return ost_search_open(&estimate->stiffness, estimate->factor, solver, &search->cg);
}

/* What all pairs of steps after this one would add to |e|_A², if gains go on falling as from the last to this. */
static double gains_to_come(double gain, double last)
{
    const double ratio = last > 0.0 ? fmin(gain / last, largest_ratio) : 0.0;
    return gain * ratio / (1.0 - ratio);
}

static int is_alike(double a, double b)
{
    return a <= alike * b && b <= alike * a;
}

/* What steps after the first pair would add, as with an earlier load; NAN: none was alike. */
static double learned_to_come(const Tails *tails, double second, double gain)
{
    for (int k = 0; k < tails->count; k++)
        if (is_alike(second, tails->second[k]))
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

/* A square of the search in the case's units. */
static double true_square(const Search *search, double square)
{
    return search->cg.size * search->cg.size * search->estimate->stiffness.unit * square;
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
    ost_search_start(&search->cg);
    for (int k = 1; k <= most_pairs && !search->cg.failed; k++) {
        const double last = gain;
        OST_TRY(ost_search_pair(&search->cg, &weight, &of_step, &gain));
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
        ost_log(ctx, OST_LOG_VERBOSE, "error estimate: pair %d of steps: %.6e, with %.6e to come", k,
                sqrt(true_square(search, sum)), sqrt(true_square(search, to_come)));
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

/* Makes up for the steps that were not taken. */
static void lengthen(Search *search)
{
    for (size_t i = 0; i < search->cg.rows; i++)
        search->cg.e.rows[i] *= search->longer;
    for (size_t i = 0; i < OST_PER_FUNCTION * search->cg.functions; i++)
        search->cg.e.functions[i] *= (float)search->longer;
    search->longer = 1.0;
}

/* Steps from the best combination of what was found for other loads. */
static OstStatus iterate_from(Search *search, double *square)
{
    OstEarlier *earlier = search->estimate->earlier;
    double start;
    OST_TRY(ost_earlier_start(earlier, &search->cg.r, &start));
    OST_TRY(iterate(search, start, square));
    return search->cg.failed ? OST_SUCCESS : ost_earlier_finish(earlier, &search->cg.r, &search->cg.e);
}

static double largest(size_t count, const double *numbers)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++)
        most = fabs(numbers[i]) > most ? fabs(numbers[i]) : most;
    return most;
}

/* r = f - A u on the functions; on the rows, by how much the elements' own quadrature differs. */
static OstStatus find_residual(Search *search, double t, const double *u)
{
    OstSearch *cg = &search->cg;
    const OstEstimate *estimate = search->estimate;
    const OstProblem *problem = estimate->problem;
    const double unit = estimate->stiffness.unit;
    double *left = ost_search_spare(cg), most; /* f - A u */
    OST_TRY(ost_agree(problem->ctx,
                      ost_operator_force(&estimate->stiffness, t, u, cg->force, left, &search->energy)));
    ost_surplus_loads_add(&estimate->loads, problem, &estimate->complement, t, u, left);
    OST_TRY(ost_search_take_rows(cg, cg->r.rows));
    most = fmax(largest(3 * cg->functions, left), largest(cg->rows, cg->r.rows));
    OST_TRY(ost_max(problem->ctx, 1, &most));
    cg->size = most > 0.0 ? most / unit : 1.0;
    ost_search_take_residual(cg, left, cg->size * unit);
    for (size_t i = 0; i < cg->rows; i++)
        cg->r.rows[i] /= cg->size * unit;
    return OST_SUCCESS;
}

/* e at the nodes. */
static OstStatus take_displacement(Search *search)
{
    return ost_system_displacement(search->estimate->problem->system, 0.0, search->cg.e.rows, search->cg.u);
}

/* `square` is in the case's units. */
static OstStatus compare(Search *search, double t, const double *u, double square, OstAnswerError *found)
{
    const OstProblem *problem = search->estimate->problem;
    double most[2] = {0.0}, energy = 0.0;
    OST_TRY(take_displacement(search));
    for (size_t n = 0; n < (size_t)problem->mesh->owned_nodes; n++) {
        double better[3];
        for (size_t i = 0; i < 3; i++)
            better[i] = u[3 * n + i] + search->cg.size * search->cg.u[3 * n + i];
        const double of_error = ost_norm3(search->cg.u + 3 * n), of_better = ost_norm3(better);
        most[0] = of_error > most[0] ? of_error : most[0];
        most[1] = of_better > most[1] ? of_better : most[1];
    }
    most[0] *= search->cg.size;
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
    OST_TRY(ost_complement_import(&search->estimate->complement, search->cg.e.functions));
    ost_operator_energy(&search->estimate->stiffness, search->cg.u, search->cg.e.functions, tet_error, stress);
    for (size_t i = 0; i < 6 * (size_t)problem->mesh->owned_tets && stress; i++)
        stress[i] *= search->longer * search->cg.size;
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
        OST_TRY(ost_free_body_centre(problem->mesh, search->cg.u));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        surplus[i] = search->longer * search->cg.size * search->cg.u[i];
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
    if (status == OST_SUCCESS && !search.cg.failed) {
        square = true_square(&search, square);
        if (surplus->displacement || search.is_short)
            status = ost_search_settle(&search.cg);
        if (search.is_short)
            lengthen(&search);
        OST_THEN(compare(&search, t, u, square, found));
        if (surplus->tet_error)
            OST_THEN(share(&search, square, surplus->tet_error, surplus->stress));
        if (surplus->displacement)
            OST_THEN(hand_out(&search, surplus->displacement));
    }
    ost_search_close(&search.cg);
    return status;
}

/* --- a quantity of interest --- */

/* P times the quantity's derivative, or minus the force of its given motion: the right-hand side of z. */
static OstStatus adjoint_load(Search *search, const OstInterest *interest)
{
    OstSearch *cg = &search->cg;
    const OstOperator *stiffness = &search->estimate->stiffness;
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    if (interest->load) {
        memcpy(cg->force, interest->load, numbers * sizeof *cg->force);
    } else {
        memset(cg->p.functions, 0, OST_PER_FUNCTION * cg->functions * sizeof *cg->p.functions);
        ost_operator_apply(stiffness, interest->moved, cg->p.functions, cg->force, cg->q.functions);
        for (size_t i = 0; i < numbers; i++)
            cg->force[i] *= -stiffness->unit;
        if (problem->supports->spring)
            ost_spring_force(problem->supports, 1.0, interest->moved, cg->force);
    }
    return ost_search_take_rows(cg, cg->q.rows);
}

/* r: what z leaves of the adjoint problem on the functions. */
static OstStatus adjoint_residual(Search *search, const OstInterest *interest)
{
    OstSearch *cg = &search->cg;
    const OstProblem *problem = search->estimate->problem;
    const size_t numbers = 3 * (size_t)problem->mesh->node_count;
    OstSolveReport report;
    OST_TRY(adjoint_load(search, interest));
    OST_TRY(ost_solver_solve(cg->solver, cg->q.rows, cg->z, &report));
    OST_TRY(ost_system_displacement(problem->system, 0.0, cg->z, cg->u));
    for (size_t i = 0; interest->moved && i < numbers; i++)
        cg->u[i] += interest->moved[i];
    double most = largest(numbers, cg->u);
    OST_TRY(ost_max(problem->ctx, 1, &most));
    cg->size = most > 0.0 ? most : 1.0;
    for (size_t i = 0; i < numbers; i++)
        cg->u[i] /= cg->size;
    memset(cg->p.functions, 0, OST_PER_FUNCTION * cg->functions * sizeof *cg->p.functions);
    ost_operator_apply(&search->estimate->stiffness, cg->u, cg->p.functions, cg->force, cg->r.functions);
    for (size_t i = 0; i < OST_PER_FUNCTION * cg->functions; i++)
        cg->r.functions[i] = -cg->r.functions[i];
    ost_complement_project(&search->estimate->complement, cg->r.functions);
    return OST_SUCCESS;
}

/* The work of u's residual on e, the surplus of z. */
static OstStatus work_on(Search *search, double t, const double *u, double *work)
{
    OstSearch *cg = &search->cg;
    const double size = cg->size;
    OST_TRY(find_residual(search, t, u));
    OST_TRY(ost_search_dot(cg, &cg->r, &cg->e, work));
    *work *= search->longer * size * cg->size * search->estimate->stiffness.unit;
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
    OST_TRY_DONE(iterate(&search, 0.0, &square));
    if (search.cg.failed)
        goto done;
    OST_TRY_DONE(take_displacement(&search));
    OST_TRY_DONE(share(&search, true_square(&search, square), of_adjoint, NULL));
    OST_TRY_DONE(work_on(&search, t, u, error));
    if (interest->moved) /* a reaction is the work of u on z, on which the exact error does no work */
        *error = -*error;
    OST_TRY_DONE(share_interest(&search, of_adjoint, *error, tet_share));
done:
    OST_FREE(of_adjoint);
    ost_search_close(&search.cg);
    return status;
}
