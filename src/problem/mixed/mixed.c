/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/problem.h"

#include <math.h>
#include <string.h>

OstStatus ost_problem_function_volume(const OstProblem *problem, int function, double *g)
{
    const double share = function == problem->eigen_function ? 1.0 : 0.0;
    double *none = NULL, *prescribed = NULL;
    OstStatus status = OST_NEW(problem->ctx, &none, 3 * (size_t)problem->system->matrix->rows);
    OST_THEN(OST_NEW(problem->ctx, &prescribed, 3 * (size_t)problem->mesh->node_count));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    OST_TRY_DONE(ost_problem_function_displacement(problem, function, none, prescribed));
    ost_ledger_enter(problem->ctx, OST_EFFECT_MIXED);
    status =
        ost_pressure_volume(problem->pressures, problem->field, OST_FORMULATION_LINEAR, share, prescribed, g, NULL);
    ost_ledger_leave(problem->ctx);
    for (OstLocal i = 0; i < problem->pressures->owned; i++)
        g[i] = -g[i];
done:
    OST_FREE(none, prescribed);
    return status;
}

OstStatus ost_problem_volume(const OstProblem *problem, double t, double *g)
{
    const OstLocal count = problem->pressures->owned;
    double *of_function = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &of_function, count)));
    OstStatus status = OST_SUCCESS;
    memset(g, 0, (size_t)count * sizeof *g);
    for (int k = 0; k < ost_problem_functions(problem) && status == OST_SUCCESS; k++) {
        status = ost_problem_function_volume(problem, k, of_function);
        for (OstLocal i = 0; i < count; i++)
            g[i] += ost_problem_factor(problem, k, t) * of_function[i];
    }
    OST_FREE(of_function);
    return status;
}

void ost_problem_at_pressure(const OstProblem *problem, const double *of_tets, OstMaterialField *field,
                             OstProblem *state)
{
    *field = *problem->field;
    field->pressure = of_tets;
    *state = *problem;
    state->field = field;
}

void ost_problem_uniform_pressure(const OstProblem *problem, double *pressure)
{
    const OstPressureSpace *space = problem->pressures;
    for (OstLocal i = 0; i < space->owned; i++) {
        const int32_t region = space->region[i];
        const double looseness = problem->field->mixed.looseness[region];
        pressure[i] = looseness == 0.0 ? 1.0 / ost_norm3(ost_field_stiff_mode(problem->field, region)) : 0.0;
    }
}

/* The size of the forces of a uniform pressure, and of the numbers that they are summed of. */
static OstStatus sum_forces(const OstProblem *problem, double *pressure, double *force, double sums[2])
{
    const OstCoupling *coupling = problem->coupling;
    ost_problem_uniform_pressure(problem, pressure);
    for (OstLocal i = 0; i < coupling->rows; i++)
        for (OstLocal k = 3 * coupling->row_start[i]; k < 3 * coupling->row_start[i + 1]; k++)
            sums[1] += pressure[i] * fabs(coupling->value[k]);
    OST_TRY(ost_agree(problem->ctx, ost_coupling_transpose(coupling, pressure, force)));
    for (OstLocal k = 0; k < 3 * coupling->unknowns; k++)
        sums[0] += fabs(force[k]);
    return ost_sum(problem->ctx, 2, sums);
}

OstStatus ost_problem_is_enclosed(const OstProblem *problem, int *enclosed)
{
    static const double rounding = 1e-10;
    double *pressure = NULL, *force = NULL, sums[2] = {0.0};
    OstStatus status = OST_NEW(problem->ctx, &pressure, ost_problem_pressure_room(problem));
    OST_THEN(OST_NEW(problem->ctx, &force, 3 * (size_t)problem->coupling->unknowns));
    status = ost_agree(problem->ctx, status);
    OST_THEN(sum_forces(problem, pressure, force, sums));
    *enclosed = sums[1] > 0.0 && sums[0] <= rounding * sums[1];
    OST_FREE(pressure, force);
    return status;
}

/* Collective. A uniform pressure, and M times |m|, of owned pressures: their product is the volume. */
static OstStatus find_uniform(const OstProblem *problem, double **uniform, double **mass)
{
    const size_t owned = (size_t)problem->pressures->owned;
    double *size = NULL;
    OstStatus status = OST_NEW(problem->ctx, uniform, owned);
    OST_THEN(OST_NEW(problem->ctx, mass, owned));
    OST_THEN(OST_NEW(problem->ctx, &size, ost_problem_pressure_room(problem)));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    ost_problem_uniform_pressure(problem, *uniform);
    for (size_t i = 0; i < owned; i++)
        size[i] = (*uniform)[i] > 0.0 ? 1.0 / (*uniform)[i] : 0.0;
    status = ost_agree(problem->ctx, ost_coupling_mass(problem->coupling, size, *mass));
done:
    OST_FREE(size);
    return status;
}

/* Takes (onto·numbers / volume) × along off the numbers; *share is what is in brackets. */
static OstStatus take_off(const OstProblem *problem, const double *along, const double *onto, double *numbers,
                          double *share)
{
    const size_t owned = (size_t)problem->pressures->owned;
    double sums[2] = {0.0};
    for (size_t i = 0; i < owned; i++) {
        sums[0] += onto[i] * numbers[i];
        sums[1] += onto[i] * along[i];
    }
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    *share = sums[0] / sums[1];
    for (size_t i = 0; i < owned; i++)
        numbers[i] -= *share * along[i];
    return OST_SUCCESS;
}

OstStatus ost_problem_centre_pressure(const OstProblem *problem, double *pressure)
{
    double *uniform = NULL, *mass = NULL, share;
    OstStatus status = find_uniform(problem, &uniform, &mass);
    OST_THEN(take_off(problem, uniform, mass, pressure, &share));
    OST_FREE(uniform, mass);
    return status;
}

OstStatus ost_problem_keep_volume(const OstProblem *problem, double *g, double *swelling)
{
    double *uniform = NULL, *mass = NULL;
    OstStatus status = find_uniform(problem, &uniform, &mass);
    OST_THEN(take_off(problem, mass, uniform, g, swelling));
    OST_FREE(uniform, mass);
    return status;
}

size_t ost_problem_pressure_room(const OstProblem *problem)
{
    const OstLocal solved_for = problem->coupling ? problem->coupling->columns : 0;
    return (size_t)(problem->pressures->count > solved_for ? problem->pressures->count : solved_for);
}

/* The problem's own copy of its field, to be changed. */
static OstMaterialField *own_field(OstProblem *problem)
{
    if (problem->field != &problem->own)
        problem->own = *problem->field;
    problem->field = &problem->own;
    return &problem->own;
}

void ost_problem_take_pressure(OstProblem *problem, const double *of_tets)
{
    own_field(problem)->pressure = of_tets;
}

OstStatus ost_problem_leave_mixed(OstProblem *problem)
{
    const int region = ost_field_incompressible(problem->field);
    if (region >= 0)
        return OST_RAISE(problem->ctx, OST_INVALID_INPUT,
                         "material '%s' is incompressible (nu = 1/2), and rotations are large here, which formulation: "
                         "classical can follow only below 1/2, as 0.4999; set formulation: consistent",
                         problem->field->material[region].name);
    ost_problem_release_stiffness(problem);
    ost_pressure_space_destroy(&problem->pressures);
    OstMaterialField *own = own_field(problem);
    own->form = own->mean.stiff_mode ? OST_SPLIT_MEAN : OST_SPLIT_NOT;
    return OST_SUCCESS;
}
