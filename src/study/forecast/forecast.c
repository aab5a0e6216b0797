/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/forecast.h"

#include "algebra/solver_seconds.h"
#include "case/case_data.h"

#include <math.h>

/* Iterations to a relative residual of 1e-8, fitted to tubes, blocks, beams and octants (docs/how-it-scales.md). They
 * depend little on size; orders differ. Thin bodies, near incompressibility and moduli that differ need more. */
static const struct {
    double usual, thinner, incompressible, uneven;
} iterations_of[2] = {{13.5, 2.0, 0.27, 0.08}, {9.0, 5.0, 0.4, 0.13}};
static const double usual_poisson = 0.3;

/* Thin walls bend, and the longer their cells are over the wall's thickness, the softer the bending modes are beside
 * the others; more cells through it make less of that. Iterations grow by 1 + this × (slenderness / cells
 * across)^power, by order: to a residual, and where the mesh's error ends them. Fitted to plates and tubes whose cells
 * are 0.2 to 7 times as long as the wall is thick (docs/how-it-scales.md). */
static const double slender[2] = {0.22, 0.35}, stopped_slender[2] = {0.27, 0.65}, slender_power = 1.5;

/* By what multigrid coarsens: so many times the setup, the bytes of an iteration and, of what does not bend and what
 * does, iterations. The latter are of quadratic tets' nodes, of their columns, of their vertices that turn, and of
 * those of a thin body, factored. */
static const struct {
    double setup, iteration, membrane, bending;
} coarsened[5] = {
    {1.0, 1.0, 0.0, 0.0}, {3.4, 2.6, 1.35, 3.2}, {6.5, 3.7, 1.0, 1.0}, {2.2, 1.4, 1.3, 1.3}, {5.0, 2.1, 1.9, 1.9}};

static const double plain_factor = 4.0; /* of ML's own aggregates */
static const double usual_digits = 8.0;

/* Where the solver stops at a share of the discretisation error: few, whatever the order. */
static const double stopped_usual = 3.7, stopped_incompressible = 0.21, stopped_uneven = 0.05;

/* An adjoint problem's iterations over those of a solve that stops, and over those of one that does not; what its
 * estimate takes of one for a load, and each further load; and what the estimate takes on top where anything is
 * watched, by order. */
static const double adjoint_stopped = 1.2, adjoint_solved = 0.5, adjoint_estimate = 0.7, adjoint_again = 0.3;
static const double settled[2] = {0.3, 1.0};

/* Operations for each vertex while a hierarchy is made, over the square of its row's columns in the prolongator; for
 * each node of quadratic tets; and of a dense factorisation, for the cube of its unknowns. */
static const double product_operations = 600.0, quadratic_operations = 34e3, factor_operations = 1.0 / 6.0;

/* Strain and stress, and the error estimate, where each tet has axes of its own. */
static const double varying_axes = 2.0;

/* Of Newton's method: the stiffness of large rotations over the linear one, an iteration's linear solve over one to a
 * residual of 1e-8, as the hierarchy is that of another stiffness, and the iterations of a step that bends little. */
static const double newton_assembly = 3.0, newton_solve = 2.0;
static const double newton_least = 3.0;

/* Of each component that moves a coupling: its solve over that of the loads. */
static const double coupling_solve = 1.2;

/* Of the potentials of gradient axes: what comes before their solve over what does for the displacement, as multigrid
 * takes the nodes of quadratic tets themselves; and their iterations, by order. */
static const double potential_setup = 1.5, potential_iterations[2] = {8.0, 11.0};

static int is_multigrid(const OstPlan *plan)
{
    return plan->solver.first != OST_METHOD_DIRECT && plan->solver.first != OST_METHOD_PLAIN;
}

/* Does the solver end where the error of the equations is small beside the discretisation's? */
static int stops_early(const OstPlan *plan)
{
    return is_multigrid(plan) && plan->solver.options.algebraic_fraction > 0.0 &&
           ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE) && !plan->solves_to_residual;
}

/* How many times as many iterations a material takes: by how near it is to incompressible, and how moduli differ. */
static double hardness(const OstSolverFacts *facts, double incompressible, double uneven)
{
    const double volume = (1.0 - 2.0 * usual_poisson) / fmax(1.0 - 2.0 * facts->poisson, 1e-6);
    return pow(fmax(volume, 1.0), incompressible) * pow(fmax(facts->anisotropy, 1.0), uneven);
}

static OstCoarsening coarsening(const OstPlan *plan)
{
    return is_multigrid(plan) ? plan->coarsening : OST_COARSEN_TETS;
}

static double bending(const OstPlan *plan, const double by_order[2])
{
    const double slenderness = plan->bends ? plan->slenderness / fmax(plan->cells_across, 1.0) : 0.0;
    const OstCoarsening of = coarsening(plan);
    if (of != OST_COARSEN_TETS)
        return plan->bends ? coarsened[of].bending : coarsened[of].membrane;
    return 1.0 + by_order[plan->quadratic] * pow(slenderness, slender_power);
}

static double iterations_to_residual(const OstPlan *plan)
{
    const OstSolverFacts *facts = &plan->facts;
    const double thin = plan->counts.surface / fmax(plan->counts.vertices, 1.0);
    const int q = plan->quadratic;
    if (plan->solver.first == OST_METHOD_DIRECT)
        return 1.0;
    const double iterations = (iterations_of[q].usual + iterations_of[q].thinner * fmin(thin, 2.0)) *
                              bending(plan, slender) *
                              hardness(facts, iterations_of[q].incompressible, iterations_of[q].uneven) *
                              -log10(plan->solver.options.relative_residual) / usual_digits;
    return plan->solver.first == OST_METHOD_PLAIN ? plain_factor * iterations : iterations;
}

double ost_forecast_iterations(const OstPlan *plan)
{
    if (!stops_early(plan))
        return iterations_to_residual(plan);
    return stopped_usual * bending(plan, stopped_slender) *
           hardness(&plan->facts, stopped_incompressible, stopped_uneven);
}

/* What is read of matrix and hierarchy in an iteration. */
static double iteration_bytes(const OstPlan *plan)
{
    return plan->bytes_matrix + (is_multigrid(plan) ? plan->levels.kept : plan->bytes_solver);
}

/* Of a path. By linear theory one solve does for all its steps. */
static double steps_of(const OstCase *c, int stage)
{
    const int once = stage == OST_STAGE_SOLVE && c->large_rotation != OST_LARGE_ROTATION_ON;
    return c->path_steps > 0 && !once ? c->path_steps : 1.0;
}

void ost_forecast_work(const OstCase *c, const OstPlan *plan, double iterations, double work[OST_STAGES])
{
    const OstMeshCounts *counts = &plan->counts;
    const OstPlanLevels *levels = &plan->levels;
    const OstEffectState *estimate = ost_effect_state(&plan->effects, OST_EFFECT_ERROR_ESTIMATE);
    work[OST_STAGE_MESH] = plan->bytes_mesh;
    work[OST_STAGE_ASSEMBLY] = plan->bytes_matrix;
    work[OST_STAGE_SETUP] = product_operations * counts->vertices * levels->columns * levels->columns +
                            factor_operations * levels->coarsest * levels->coarsest * levels->coarsest +
                            (plan->quadratic ? quadratic_operations * counts->nodes : 0.0);
    work[OST_STAGE_SETUP] *= coarsened[coarsening(plan)].setup;
    if (!is_multigrid(plan))
        work[OST_STAGE_SETUP] = plan->bytes_solver;
    work[OST_STAGE_SOLVE] = iterations * iteration_bytes(plan) * coarsened[coarsening(plan)].iteration;
    const double dearer = ost_effect_on(&plan->effects, OST_EFFECT_VARYING_AXES) ? varying_axes : 1.0;
    work[OST_STAGE_ESTIMATE] = estimate->on ? dearer * (iteration_bytes(plan) + estimate->bytes) : 0.0;
    work[OST_STAGE_REST] = plan->bytes_matrix + dearer * ost_effect_state(&plan->effects, OST_EFFECT_RECOVERY)->bytes;
    work[OST_STAGE_OUTPUT] = c->output_fields != 0 ? plan->bytes_output : 0.0;
    for (int s = 0; s < OST_STAGES; s++) /* of load cases on one stiffness; of a path's steps output is counted */
        if (s != OST_STAGE_MESH && s != OST_STAGE_ASSEMBLY && s != OST_STAGE_SETUP)
            work[s] *= c->load_case_count > 0 ? c->load_case_count : s != OST_STAGE_OUTPUT ? steps_of(c, s) : 1.0;
}

/* Adjoint problems, which load cases share by linear theory, and what else watched quantities add to the estimate, from
 * the seconds of the load cases' solves and estimates without. */
static double watched_seconds(const OstCase *c, const OstPlan *plan, const double seconds[OST_STAGES])
{
    const double cases = c->load_case_count > 0 ? c->load_case_count : 1.0, adjoints = plan->adjoints;
    const double solve = seconds[OST_STAGE_SOLVE] / cases, estimate = seconds[OST_STAGE_ESTIMATE] / cases;
    const double shared = fmin(adjoints, OST_PLAN_MOST_SHARED);
    const double found = c->load_case_count > 0 ? shared + cases * (adjoints - shared) : adjoints;
    const double of_solve = stops_early(plan) ? adjoint_stopped : adjoint_solved;
    const double other = c->watch_count > 0 ? settled[plan->quadratic] * cases : 0.0;
    if (!ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE))
        return 0.0;
    return found * (of_solve * solve + adjoint_estimate * estimate) +
           (adjoint_again * (cases * adjoints - found) + other) * estimate;
}

/* Before anything else is assembled; from the seconds of the load cases' solves. */
static double gradient_seconds(const OstCase *c, const OstPlan *plan, const OstForecast *forecast)
{
    const double *seconds = forecast->seconds, cases = c->load_case_count > 0 ? c->load_case_count : 1.0;
    if (!ost_effect_on(&plan->effects, OST_EFFECT_GRADIENT_AXES))
        return 0.0;
    return potential_setup * (seconds[OST_STAGE_ASSEMBLY] + seconds[OST_STAGE_SETUP]) +
           potential_iterations[plan->quadratic] / forecast->iterations * seconds[OST_STAGE_SOLVE] / cases;
}

/* Of the search for buckling modes, from the seconds of the load cases' solves: of each mode, and one more, so many
 * iterations, each as long as so many of the solver's. Measured. */
static const double buckling_iterations = 8.0, buckling_iteration = 1.4;

static double buckling_seconds(const OstCase *c, const OstPlan *plan, const OstForecast *forecast)
{
    if (!ost_effect_on(&plan->effects, OST_EFFECT_BUCKLING))
        return 0.0;
    return buckling_iterations * buckling_iteration * (c->buckling_modes + 1.0) / forecast->iterations *
           forecast->seconds[OST_STAGE_SOLVE];
}

/* Each component that moves a coupling takes a solve, from those of the loads. */
static double coupling_seconds(const OstCase *c, const OstForecast *forecast)
{
    int moved = 0;
    for (int i = 0; i < c->load_count; i++)
        for (int k = 0; k < 6 && c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            moved += c->loads[i].moved[k];
    const double cases = c->load_case_count > 0 ? c->load_case_count : 1.0;
    return moved * coupling_solve / (cases * steps_of(c, OST_STAGE_SOLVE)) * forecast->seconds[OST_STAGE_SOLVE];
}

/* An iteration of Newton's method. */
static double newton_seconds(const OstCase *c, const OstPlan *plan, const OstForecast *forecast)
{
    const double cases = c->load_case_count > 0 ? c->load_case_count : 1.0;
    const double solve =
        forecast->seconds[OST_STAGE_SOLVE] / (cases * steps_of(c, OST_STAGE_SOLVE)) / forecast->iterations;
    if (!ost_effect_on(&plan->effects, OST_EFFECT_LARGE_ROTATION))
        return 0.0;
    const double by_multigrid = newton_solve * iterations_to_residual(plan) * solve;
    return newton_assembly * forecast->seconds[OST_STAGE_ASSEMBLY] +
           (plan->corrects_by_factors ? ost_solver_factor_seconds(&plan->facts) : by_multigrid);
}

void ost_forecast_make(const OstCase *c, const OstPlan *plan, const OstRates *rates, int ranks, OstForecast *forecast)
{
    *forecast = (OstForecast){.iterations = ost_forecast_iterations(plan), .start = rates->start};
    ost_forecast_work(c, plan, forecast->iterations, forecast->work);
    forecast->in_all = rates->start;
    for (int s = 0; s < OST_STAGES; s++) {
        const double rate = ost_rate_at(rates, 1 + plan->quadratic, (OstStage)s, plan->bytes_in_all / ranks);
        forecast->seconds[s] = forecast->work[s] * rate / ranks;
    }
    const double of_gradients = gradient_seconds(c, plan, forecast);
    const double of_buckling = buckling_seconds(c, plan, forecast);
    forecast->seconds[OST_STAGE_ESTIMATE] += watched_seconds(c, plan, forecast->seconds);
    for (int s = 0; s < OST_STAGES; s++)
        forecast->in_all += forecast->seconds[s];
    const double of_couplings = coupling_seconds(c, forecast);
    forecast->newton = newton_seconds(c, plan, forecast);
    if (c->large_rotation == OST_LARGE_ROTATION_ON)
        forecast->newton_in_all = newton_least * steps_of(c, OST_STAGE_REST) * forecast->newton;
    forecast->seconds[OST_STAGE_ASSEMBLY] += of_gradients;
    forecast->seconds[OST_STAGE_SOLVE] += of_buckling + of_couplings;
    forecast->in_all += of_gradients + of_buckling + of_couplings + forecast->newton_in_all;
    forecast->bytes = plan->bytes_in_all + plan->bytes_company;
    forecast->with_libraries = forecast->bytes + rates->process_bytes * ranks;
}
