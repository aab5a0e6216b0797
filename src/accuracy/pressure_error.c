/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/cells.h"
#include "accuracy/search.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/biot.h"

#include <math.h>

enum { VERTICES = 4 };

/* What is added to the error of the volume. */
typedef struct Part {
    const OstOperator *operator; /* whose problem's field has the pressure */
    OstFormulation formulation;  /* LINEAR: also of a small displacement about a body that has turned */
    const double *u;
    const float *w; /* or NULL */
    double factor;  /* of both */
    double eigen_share;
} Part;

static void find_strain(const Cells *cells, const Part *part, const OstPoint *point, OstSimd slope[9],
                        OstSimd strain[6])
{
    if (part->formulation != OST_FORMULATION_LINEAR) {
        OstPolar polar;
        ost_polar(slope, &polar);
        ost_biot_strain(&polar, strain);
        return;
    }
    if (cells->turned_by) {
        OstSimd rotation[9];
        find_rotation(cells, point, rotation);
        turn_back(rotation, slope);
    }
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = (i + 1) % 3;
        strain[p] = part->factor * (p < 3 ? slope[4 * i] : slope[3 * i + j] + slope[3 * j + i]);
    }
}

static void find_mode(const Cells *cells, const OstElement *element, int q, const Part *part, const OstSimd *u,
                      const OstSimd *w, OstPoint *point, OstSimd *mode)
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    const int at = ost_elasticity_at(elasticity, q);
    OstSimd gradient[OST_MAX_FUNCTIONS][3], slope[9], strain[6], elastic[6], pressure;
    evaluate(cells, element, q, point, gradient);
    ost_displacement_gradient(cells->nodes, point, u, slope);
    for (int k = 0; k < cells->functions && part->w; k++)
        for (int n = 0; n < 9; n++)
            slope[n] += w[3 * k + n / 3] * gradient[k][n % 3];
    find_strain(cells, part, point, slope, strain);
    ost_elastic_strain(elasticity, at, strain, elastic);
    ost_pressure_at(elasticity, cells->rule->point[q].at, &pressure);
    *mode = -elasticity->looseness * pressure;
    for (int p = 0; p < 6; p++)
        *mode += elasticity->m[at][p] * elastic[p];
}

/* Adds what m'(strain - e0) - looseness p is in each tet, as a linear function: by its values at the vertices. */
static void add_volume(const Part *part, double *volume)
{
    const OstMesh *mesh = part->operator->problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    Cells cells;
    clear_cells(part->operator, 1, part->eigen_share, &cells);
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        OstSimd moved[NUMBERS], more[MORE], moment[VERTICES] = {{0}}, whole = {0}, sum = {0};
        gather(part->operator, first, mesh->tet_count, &cells);
        if (!cells.batch.elasticity.mixed)
            continue;
        ost_batch_gather_vectors(&cells.batch, cells.nodes, part->u, moved);
        if (part->w)
            gather_functions(&cells, part->w, more);
        for (int q = 0; q < cells.rule->count; q++) {
            OstPoint point;
            OstSimd mode;
            find_mode(&cells, element, q, part, moved, more, &point, &mode);
            whole += point.volume;
            for (int v = 0; v < VERTICES; v++)
                moment[v] += point.volume * cells.rule->point[q].at[v] * mode;
        }
        for (int v = 0; v < VERTICES; v++)
            sum += moment[v];
        for (int slot = 0; slot < cells.batch.count; slot++) /* the inverse of the vertices' mass matrix */
            for (int v = 0; v < VERTICES; v++)
                volume[VERTICES * (size_t)(first + slot) + (size_t)v] +=
                    20.0 / whole[slot] * (moment[v][slot] - 0.2 * sum[slot]);
    }
}

/* Where an enclosed body's adjoint problem leaves a change of volume, evenly spread (OstState.swelling), that is no
 * error of its pressure: it is taken off. */
static void leave_swelling(const OstState *of, double *volume)
{
    const OstProblem *problem = of->problem;
    for (OstLocal tet = 0; of->swelling != 0.0 && tet < problem->mesh->tet_count; tet++) {
        const double *mode = ost_field_stiff_mode(problem->field, problem->mesh->tet_region[tet]);
        const int is_loose = problem->field->mixed.looseness[problem->mesh->tet_region[tet]] > 0.0;
        for (int v = 0; v < VERTICES && mode && !is_loose; v++)
            volume[VERTICES * (size_t)tet + (size_t)v] -= of->swelling * ost_norm3(mode);
    }
}

/* What e leaves of the second equation, and the pressures that it is worth. */
static OstStatus find_pressures(Search *search, const OstState *of, double *volume, double *of_tets)
{
    const OstProblem *problem = search->estimate->problem;
    OstMaterialField none;
    OstProblem without;
    OstOperator at_state = search->estimate->stiffness, no_pressure = at_state;
    ost_problem_at_pressure(problem, NULL, &none, &without);
    at_state.problem = of->problem;
    no_pressure.problem = &without;
    add_volume(&(Part){&at_state, of->formulation, of->u, NULL, 1.0, of->eigen_share}, volume);
    leave_swelling(of, volume);
    OST_TRY(ost_search_displacement(search));
    OST_TRY(ost_complement_import(&search->estimate->complement, search->steps.e.functions));
    add_volume(&(Part){&no_pressure, OST_FORMULATION_LINEAR, search->steps.u, search->steps.e.functions,
                       search->longer * search->steps.size, 0.0},
               volume);
    for (size_t i = 0; i < VERTICES * (size_t)problem->mesh->tet_count; i++)
        if (problem->pressures->of_tet[i] >= 0)
            of_tets[i] = volume[i] / ost_field_giving_way(problem->field, problem->mesh->tet_region[i / VERTICES]);
    return OST_SUCCESS;
}

/* In a search of its own: the displacement of the elements and their complement that the pressures bring. */
static OstStatus respond(Search *response, const OstProblem *at_pressure, const double *zero)
{
    OstSteps *steps = &response->steps;
    OstOperator at = response->estimate->stiffness;
    double *left = ost_steps_spare(steps), square;
    at.problem = at_pressure;
    ost_operator_small_force(&at, 0.0, zero, steps->force, left);
    for (size_t i = 0; i < 3 * (size_t)at_pressure->mesh->owned_nodes; i++)
        steps->force[i] = -steps->force[i];
    OST_TRY(ost_steps_take_rows(steps, steps->r.rows));
    OST_TRY(ost_search_take(response, left));
    OST_TRY(ost_search_iterate(response, 0.0, &square));
    return steps->failed ? OST_SUCCESS : ost_steps_settle(steps, NULL);
}

/* e becomes e, lengthened, and the response. */
static void add_response(const Search *response, Search *search)
{
    const double longer = search->longer;
    const double factor = response->longer * response->steps.size / search->steps.size;
    for (size_t i = 0; i < search->steps.rows; i++)
        search->steps.e.rows[i] = longer * search->steps.e.rows[i] + factor * response->steps.e.rows[i];
    for (size_t i = 0; i < OST_PER_FUNCTION * search->steps.functions; i++)
        search->steps.e.functions[i] =
            (float)longer * search->steps.e.functions[i] + (float)factor * response->steps.e.functions[i];
    search->longer = 1.0;
    search->steps.failed |= response->steps.failed;
}

OstStatus ost_pressure_error(Search *search, const OstState *of, double *of_tets)
{
    const OstMesh *mesh = search->estimate->problem->mesh;
    double *volume = NULL, *zero = NULL;
    OstMaterialField field;
    OstProblem at_pressure;
    Search response;
    OstStatus status = OST_NEW(mesh->ctx, &volume, VERTICES * (size_t)mesh->tet_count);
    OST_THEN(OST_NEW(mesh->ctx, &zero, 3 * (size_t)mesh->node_count));
    OST_TRY_DONE(ost_agree(mesh->ctx, status));
    OST_TRY_DONE(find_pressures(search, of, volume, of_tets));
    ost_problem_at_pressure(search->estimate->problem, of_tets, &field, &at_pressure);
    status = ost_search_open(search->estimate, search->steps.solver, &response);
    OST_THEN(respond(&response, &at_pressure, zero));
    if (status == OST_SUCCESS)
        add_response(&response, search);
    ost_steps_close(&response.steps);
done:
    OST_FREE(volume);
    OST_FREE(zero);
    return status;
}

OstStatus ost_pressure_work(const OstEstimate *estimate, const OstState *of, const double *of_tets, double *work)
{
    const OstMesh *mesh = estimate->problem->mesh;
    OstOperator at_state = estimate->stiffness;
    double *volume = NULL;
    at_state.problem = of->problem;
    *work = 0.0;
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &volume, VERTICES * (size_t)mesh->tet_count)));
    add_volume(&(Part){&at_state, of->formulation, of->u, NULL, 1.0, of->eigen_share}, volume);
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const double *p = of_tets + VERTICES * (size_t)tet, *left = volume + VERTICES * (size_t)tet;
        const double size = fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet)));
        double sums[2] = {0.0}, product = 0.0;
        for (int v = 0; v < VERTICES; v++) {
            sums[0] += p[v];
            sums[1] += left[v];
            product += p[v] * left[v];
        }
        *work += size / 20.0 * (product + sums[0] * sums[1]);
    }
    OST_FREE(volume);
    return ost_sum(mesh->ctx, 1, work);
}
