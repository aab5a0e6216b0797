/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/operator.h"

#include "accuracy/cells.h"
#include "accuracy/complement/blocks.h"
#include "accuracy/linear_tets.h"
#include "accuracy/straight.h"
#include "assembly/batch.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "core/together/together.h"
#include "element/biot.h"
#include "element/large_rotation.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"

#include <math.h>
#include <string.h>

/* --- forces --- */

/* The strain of a displacement gradient (row-major), less the eigenstrain. */
static inline void find_strain(const Cells *cells, OstFormulation formulation, int q, const OstSimd slope[9],
                               OstPolar *polar, OstSimd elastic[6])
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    OstSimd strain[6];
    for (int i = 0; i < 3 && formulation == OST_FORMULATION_LINEAR; i++) {
        const int next = (i + 1) % 3;
        strain[i] = slope[4 * i];
        strain[3 + i] = slope[3 * i + next] + slope[3 * next + i];
    }
    if (formulation != OST_FORMULATION_LINEAR) {
        ost_polar(slope, polar);
        ost_biot_strain(polar, strain);
    }
    ost_elastic_strain(elasticity, ost_elasticity_at(elasticity, q), strain, elastic);
}

/* Is the material of quadratic tets known by the line of its axes alone? */
static inline int is_about_line(const Cells *cells)
{
    return cells->nodes == 10 && cells->batch.elasticity.about_line;
}

/* The first Piola stress, times the volume; `mean` is that of the stiff mode over the tet. */
static inline void find_stress(const Cells *cells, OstFormulation formulation, int q, const OstSimd slope[9],
                               const OstSimd *mean, const OstSimd *volume, OstSimd piola[9])
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    const OstElasticity *elasticity = &cells->batch.elasticity;
    const int at = ost_elasticity_at(elasticity, q);
    OstSimd elastic[6], stress[6];
    OstPolar polar;
    find_strain(cells, formulation, q, slope, &polar, elastic);
    if (is_about_line(cells))
        ost_stretch_stress(elasticity->stretch_at[q], elasticity->shear, elastic, stress);
    else if (elasticity->by_stretch)
        ost_stretch_stress(elasticity->stretch_tensor, elasticity->shear, elastic, stress);
    else
        ost_simd_stress(elasticity->c[at], elastic, stress);
    for (int p = 0; p < 6 && elasticity->by_mean; p++)
        stress[p] += *mean * elasticity->m[at][p];
    if (elasticity->mixed && cells->state) {
        OstSimd pressure;
        ost_pressure_at(elasticity, cells->rule->point[q].at, &pressure);
        for (int p = 0; p < 6; p++)
            stress[p] += pressure * elasticity->m[at][p];
    }
    for (int n = 0; n < 9 && formulation == OST_FORMULATION_LINEAR; n++)
        piola[n] = stress[place[n]];
    if (formulation != OST_FORMULATION_LINEAR)
        ost_biot_piola(&polar, stress, piola);
    for (int n = 0; n < 9; n++)
        piola[n] *= *volume;
}

static inline void add_along(const OstSimd piola[9], const OstSimd gradient[3], OstSimd *force)
{
    for (int i = 0; i < 3; i++)
        force[i] += piola[3 * i] * gradient[0] + piola[3 * i + 1] * gradient[1] + piola[3 * i + 2] * gradient[2];
}

static inline void add_slope(const OstSimd *u, const OstSimd gradient[3], OstSimd slope[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] += u[i] * gradient[j];
}

/* The displacement gradient at a point; w may be NULL. */
static inline void find_slope(const Cells *cells, const OstPoint *point, const OstSimd (*gradient)[3], const OstSimd *u,
                              const OstSimd *w, OstSimd slope[9])
{
    ost_displacement_gradient(cells->nodes, point, u, slope);
    for (int k = 0; k < cells->functions && w; k++)
        add_slope(w + 3 * k, gradient[k], slope);
}

/* R slope. */
static inline void turn(const OstSimd rotation[9], OstSimd slope[9])
{
    OstSimd given[9];
    memcpy(given, slope, sizeof given);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] =
                rotation[3 * i] * given[j] + rotation[3 * i + 1] * given[3 + j] + rotation[3 * i + 2] * given[6 + j];
}

/* The mean of m'(strain - e0) over the tets where C is split. */
static void find_mean(const Cells *cells, const OstElement *element, OstFormulation formulation, const OstSimd *u,
                      const OstSimd *w, OstSimd *mean)
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    OstSimd volume = {0};
    *mean = (OstSimd){0};
    for (int q = 0; q < cells->rule->count; q++) {
        const OstSimd *m = elasticity->m[ost_elasticity_at(elasticity, q)];
        OstSimd gradient[OST_MAX_FUNCTIONS][3], slope[9], elastic[6], rotation[9];
        OstPoint point;
        OstPolar polar;
        evaluate(cells, element, q, &point, gradient);
        find_slope(cells, &point, gradient, u, w, slope);
        if (cells->turned_by) {
            find_rotation(cells, &point, rotation);
            turn_back(rotation, slope);
        }
        find_strain(cells, formulation, q, slope, &polar, elastic);
        volume += point.volume;
        for (int p = 0; p < 6; p++)
            *mean += point.volume * m[p] * elastic[p];
    }
    *mean /= volume;
}

/* Forces of a batch; w may be NULL. */
OST_KERNEL static void forces_of(const Cells *cells, const OstElement *element, OstFormulation formulation,
                                 const OstSimd *u, const OstSimd *w, OstSimd *at_nodes, OstSimd *at_functions)
{
    OstSimd mean = {0};
    memset(at_nodes, 0, 3 * (size_t)cells->nodes * sizeof *at_nodes);
    memset(at_functions, 0, 3 * (size_t)cells->functions * sizeof *at_functions);
    if (cells->batch.elasticity.by_mean)
        find_mean(cells, element, formulation, u, w, &mean);
    for (int q = 0; q < cells->rule->count; q++) {
        OstSimd slope[9], piola[9], rotation[9];
        OstEvaluated here;
        if (!cells->evaluated)
            evaluate(cells, element, q, &here.point, here.gradient);
        const OstEvaluated *at = cells->evaluated ? &cells->evaluated[q] : &here;
        find_slope(cells, &at->point, at->gradient, u, w, slope);
        if (cells->turned_by) {
            find_rotation(cells, &at->point, rotation);
            turn_back(rotation, slope);
        }
        find_stress(cells, formulation, q, slope, &mean, &at->point.volume, piola);
        if (cells->turned_by)
            turn(rotation, piola);
        for (int a = 0; a < cells->nodes; a++)
            add_along(piola, at->point.gradient[a], at_nodes + 3 * a);
        for (int k = 0; k < cells->functions; k++)
            add_along(piola, at->gradient[k], at_functions + 3 * k);
    }
}

/* Has the stress no part but C times the strain of linear theory? */
static int is_plain(const Cells *cells, OstFormulation formulation)
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    return formulation == OST_FORMULATION_LINEAR && !cells->turned_by && !elasticity->by_mean &&
           !(cells->state && (elasticity->mixed || elasticity->eigenstrained));
}

/* Are the tets curved, and is that all that they are? */
static int is_curved(const Cells *cells, OstFormulation formulation)
{
    return cells->nodes == 10 && !cells->straight && is_plain(cells, formulation);
}

/* Forces of a batch by the quickest way; w may be NULL. */
static void find_forces(const Cells *cells, const OstElement *element, OstFormulation formulation, const OstSimd *u,
                        const OstSimd *w, OstSimd *at_nodes, OstSimd *at_functions)
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    if (cells->nodes == 4 && !w && formulation == OST_FORMULATION_LINEAR && !cells->turned_by && !elasticity->by_mean &&
        !elasticity->mixed)
        ost_linear_tets_forces(cells->batch.x, elasticity, cells->rule, u, at_nodes, at_functions);
    else if (cells->nodes == 10 && (cells->straight || !cells->state) && is_plain(cells, formulation))
        ost_straight_forces(cells->batch.x, elasticity, cells->rule, u, w, at_nodes, at_functions);
    else
        forces_of(cells, element, formulation, u, w, at_nodes, at_functions);
}

/* The work of a batch's nodal forces. */
static inline void find_work(const Cells *cells, const OstSimd *moved, const OstSimd *at_nodes, OstSimd *work)
{
    *work = (OstSimd){0};
    for (int n = 0; n < 3 * cells->nodes; n++)
        *work += (moved[n] - moved[n % 3]) * at_nodes[n];
}

/* The part of a batch's work that is this rank's. */
static double own_work(const Cells *cells, OstLocal owned_tets, const OstSimd *work)
{
    double sum = 0.0;
    for (int slot = 0; slot < cells->batch.count; slot++)
        sum += cells->batch.tet[slot] < owned_tets ? (*work)[slot] : 0.0;
    return sum;
}

/* What the forces of a state are wanted for. */
typedef struct Sum {
    const OstOperator *operator;
    OstFormulation formulation;
    double eigen_share;
    double work; /* found: of the nodal forces on u */
    const double *u;
    double *force; /* on nodes; NULL: not wanted */
    double *of_functions;
} Sum;

/* Of a batch, which is gathered. */
static void add_state(const Cells *cells, const OstElement *element, Sum *sum)
{
    const OstMesh *mesh = sum->operator->problem->mesh;
    OstSimd moved[NUMBERS], at_nodes[NUMBERS], at_functions[MORE], work;
    ost_batch_gather_vectors(&cells->batch, cells->nodes, sum->u, moved);
    if (cells->curved) {
        ost_curved_forces(cells->batch.x, cells->curved, &cells->batch.elasticity, moved, at_functions, &work);
    } else {
        find_forces(cells, element, sum->formulation, moved, NULL, at_nodes, at_functions);
        find_work(cells, moved, at_nodes, &work);
    }
    take_off_state(cells, at_functions, sum->of_functions);
    sum->work += own_work(cells, mesh->owned_tets, &work);
    if (sum->force)
        ost_batch_scatter_vectors(&cells->batch, cells->nodes, at_nodes, 1.0, mesh->owned_nodes, sum->force);
}

/* What all displacements of a visit share at the points of tets that are not straight. */
typedef struct Points {
    OstEvaluated at[OST_MAX_POINTS];
    OstCurvedPoint curved[OST_MAX_POINTS];
} Points;

static void keep_points(const OstElement *element, int is_curved_alone, Points *points, Cells *cells)
{
    cells->curved = is_curved_alone ? points->curved : NULL;
    cells->evaluated = cells->straight || is_curved_alone ? NULL : points->at;
    if (cells->curved)
        ost_curved_points(cells->batch.x, points->curved);
    for (int q = 0; q < cells->rule->count && cells->evaluated; q++)
        evaluate(cells, element, q, &points->at[q].point, points->at[q].gradient);
}

/* OstServe: of one complement and eigenstrain. */
static OstStatus sum_states(void *complement, int count, void *const *sum)
{
    const Sum *one = sum[0];
    const OstMesh *mesh = one->operator->problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    Points points;
    Cells cells;
    (void)complement;
    clear_cells(one->operator, 1, one->eigen_share, &cells);
    cells.batch.elasticity.line_suffices = one->formulation == OST_FORMULATION_LINEAR && !cells.turned_by &&
                                           !ost_field_is_eigenstrained(one->operator->problem->field);
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        gather(one->operator, first, mesh->tet_count, &cells);
        find_places_of_functions(one->operator->complement, &cells);
        keep_points(element, !one->force && is_curved(&cells, one->formulation), &points, &cells);
        for (int k = 0; k < count; k++)
            add_state(&cells, element, sum[k]);
    }
    return OST_SUCCESS;
}

static void sum_forces(Sum *sum)
{
    const OstComplement *complement = sum->operator->complement;
    const OstMesh *mesh = sum->operator->problem->mesh;
    void *const alone = sum;
    if (sum->force)
        memset(sum->force, 0, 3 * (size_t)mesh->owned_nodes * sizeof *sum->force);
    memset(sum->of_functions, 0, 3 * (size_t)complement->count * sizeof *sum->of_functions);
    sum->work = 0.0;
    const OstMaterialField *field = sum->operator->problem->field;
    if (sum->force || sum->operator->turned_by || field->pressure || ost_field_is_eigenstrained(field))
        (void)sum_states(NULL, 1, &alone);
    else
        (void)ost_together(mesh->ctx, sum_states, OST_MOST_TOGETHER, (void *)complement, sum);
}

OstStatus ost_operator_unit(const OstProblem *problem, double *unit)
{
    const OstMesh *mesh = problem->mesh;
    double sums[2] = {0.0, 0.0}; /* of lengths, and their number */
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        double edge[3];
        for (size_t i = 0; i < 3; i++)
            edge[i] = mesh->coordinates[3 * (size_t)nodes[1] + i] - mesh->coordinates[3 * (size_t)nodes[0] + i];
        sums[0] += ost_norm3(edge);
        sums[1] += 1.0;
    }
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    *unit = ost_light_tets_modulus(problem->field) * sums[0] / sums[1];
    return OST_SUCCESS;
}

OstStatus ost_operator_force(const OstOperator *operator, double t, const double *u, double *missing,
                             double *of_functions, double *energy)
{
    const OstProblem *problem = operator->problem;
    const OstOperator unturned = {.problem = problem, .complement = operator->complement };
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    double *own = NULL;
    const int is_linear = problem->formulation == OST_FORMULATION_LINEAR;
    Sum sum = {.operator= & unturned,
               .formulation = problem->formulation,
               .eigen_share = ost_problem_eigen_share(problem, t),
               .u = u,
               .force = is_linear ? NULL : missing,
               .of_functions = of_functions};
    sum_forces(&sum);
    const int tells = is_linear && !problem->pressures && !problem->supports->spring &&
                      (sum.eigen_share == 0.0 || !ost_field_is_eigenstrained(problem->field));
    *energy = tells ? 0.5 * sum.work : NAN;
    if (is_linear) {
        memset(missing, 0, numbers * sizeof *missing);
        return OST_SUCCESS;
    }
    OST_TRY(OST_NEW(problem->ctx, &own, numbers));
    OstStatus status =
        ost_internal_force_of(problem->mesh, problem->field, problem->formulation, sum.eigen_share, u, own, NULL);
    for (size_t i = 0; i < numbers && status == OST_SUCCESS; i++)
        missing[i] = own[i] - missing[i];
    OST_FREE(own);
    return status;
}

void ost_operator_small_force(const OstOperator *operator, double eigen_share, const double *u, double *force,
                              double *of_functions)
{
    Sum sum = {.operator= operator,
               .formulation = OST_FORMULATION_LINEAR,
               .eigen_share = eigen_share,
               .u = u,
               .force = force,
               .of_functions = of_functions};
    sum_forces(&sum);
}

/* A product with the stiffness: as ost_operator_apply. */
typedef struct Product {
    const OstOperator *operator;
    const double *u;
    const float *w;
    double *force;
    float *of_functions;
} Product;

/* Of a batch, which is gathered. */
static void add_product(const Cells *cells, const OstElement *element, double factor, const Product *product)
{
    OstSimd moved[NUMBERS], more[MORE], at_nodes[NUMBERS], at_functions[MORE];
    if (product->u)
        ost_batch_gather_vectors(&cells->batch, cells->nodes, product->u, moved);
    else
        memset(moved, 0, sizeof moved);
    gather_functions(cells, product->w, more);
    find_forces(cells, element, OST_FORMULATION_LINEAR, moved, more, at_nodes, at_functions);
    for (int n = 0; n < 3 * cells->nodes; n++)
        at_nodes[n] *= factor;
    for (int n = 0; n < 3 * cells->functions; n++)
        at_functions[n] *= factor;
    add_to_functions(cells, at_functions, product->of_functions);
    ost_batch_scatter_vectors(&cells->batch, cells->nodes, at_nodes, 1.0, product->operator->problem->mesh->owned_nodes,
                              product->force);
}

/* OstServe: of one complement. */
static OstStatus multiply(void *complement, int count, void *const *product)
{
    const OstOperator *operator=((const Product *)product[0])->operator;
    const OstMesh *mesh = operator->problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    const double factor = 1.0 / operator->unit;
    Cells cells;
    (void)complement;
    clear_cells(operator, 0, 0.0, &cells);
    cells.batch.elasticity.line_suffices = cells.nodes == 10 && !cells.turned_by;
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        gather(operator, first, mesh->tet_count, &cells);
        for (int k = 0; k < count; k++)
            add_product(&cells, element, factor, product[k]);
    }
    return OST_SUCCESS;
}

void ost_operator_apply(const OstOperator *operator, const double * u, const float *w, double *force,
                        float *of_functions)
{
    const OstMesh *mesh = operator->problem->mesh;
    Product product = {operator, u, w, force, of_functions};
    void *const alone = &product;
    if (operator->light && !operator->turned_by) {
        ost_light_tets_apply(operator->light, u, w, force, of_functions);
        return;
    }
    memset(force, 0, 3 * (size_t)mesh->owned_nodes * sizeof *force);
    memset(of_functions, 0, OST_PER_FUNCTION * (size_t) operator->complement->count * sizeof * of_functions);
    if (operator->turned_by)
        (void)multiply(NULL, 1, &alone);
    else
        (void)ost_together(mesh->ctx, multiply, OST_MOST_TOGETHER, (void *)operator->complement, &product);
}

void ost_operator_energy(const OstOperator *operator, const double * u, const float *w, double *energy)
{
    const OstMesh *mesh = operator->problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    Cells cells;
    if (operator->light && !operator->turned_by) {
        ost_light_tets_energy(operator->light, u, w, energy);
        return;
    }
    clear_cells(operator, 0, 0.0, &cells);
    cells.batch.elasticity.line_suffices = cells.nodes == 10 && !cells.turned_by;
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_SIMD_WIDTH) {
        OstSimd moved[NUMBERS], more[MORE], at_nodes[NUMBERS], at_functions[MORE];
        OstSimd sum = {0};
        gather(operator, first, mesh->owned_tets, &cells);
        ost_batch_gather_vectors(&cells.batch, cells.nodes, u, moved);
        gather_functions(&cells, w, more);
        find_forces(&cells, element, OST_FORMULATION_LINEAR, moved, more, at_nodes, at_functions);
        for (int n = 0; n < 3 * cells.nodes; n++)
            sum += (moved[n] - moved[n % 3]) * at_nodes[n];
        for (int n = 0; n < 3 * cells.functions; n++)
            sum += more[n] * at_functions[n];
        for (int slot = 0; slot < cells.batch.count; slot++)
            energy[cells.batch.tet[slot]] = sum[slot] / operator->unit;
    }
}

/* --- the functions' own blocks --- */

static void add_blocks(const Cells *cells, const OstElement *element, OstSimd block[OST_MAX_FUNCTIONS][9])
{
    const OstElasticity *elasticity = &cells->batch.elasticity;
    OstSimd mode[OST_MAX_FUNCTIONS][3] = {{{0}}}, volume = {0}; /* m'B of the stiff mode, integrated */
    memset(block, 0, OST_MAX_FUNCTIONS * sizeof *block);
    for (int q = 0; q < cells->rule->count; q++) {
        const int at = ost_elasticity_at(elasticity, q);
        OstSimd gradient[OST_MAX_FUNCTIONS][3];
        OstPoint point;
        evaluate(cells, element, q, &point, gradient);
        volume += point.volume;
        for (int k = 0; k < cells->functions; k++) {
            OstSimd stress[6][3], of_point[9], of_mode[3];
            ost_stress_columns(elasticity->c[at], gradient[k], stress);
            ost_block_of_stress(gradient[k], stress, of_point);
            for (int n = 0; n < 9; n++)
                block[k][n] += point.volume * of_point[n];
            if (!elasticity->by_mean)
                continue;
            ost_force_of_stress(gradient[k], elasticity->m[at], of_mode);
            for (int i = 0; i < 3; i++)
                mode[k][i] += point.volume * of_mode[i];
        }
    }
    for (int k = 0; k < cells->functions && elasticity->by_mean; k++)
        for (int n = 0; n < 9; n++)
            block[k][n] += mode[k][n / 3] * mode[k][n % 3] / volume;
}

/* R block R' with the rotation at the centroid. */
static void turn_blocks(const Cells *cells, const OstElement *element, OstSimd block[OST_MAX_FUNCTIONS][9])
{
    OstSimd rotation[9];
    OstPoint point;
    element->evaluate(cells->batch.x, &ost_tet_degree1.point[0], &point);
    find_rotation(cells, &point, rotation);
    for (int k = 0; k < cells->functions; k++) {
        turn(rotation, block[k]);
        for (int n = 0; n < 3; n++) {
            OstSimd row[3] = {block[k][3 * n], block[k][3 * n + 1], block[k][3 * n + 2]};
            for (int i = 0; i < 3; i++)
                block[k][3 * n + i] =
                    rotation[3 * i] * row[0] + rotation[3 * i + 1] * row[1] + rotation[3 * i + 2] * row[2];
        }
    }
}

/* Sums blocks (11 22 33 12 23 31) in double precision. */
static void sum_blocks(const OstOperator *operator, double * sum)
{
    static const int place[6] = {0, 4, 8, 1, 5, 6};
    const OstMesh *mesh = operator->problem->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    Cells cells;
    clear_cells(operator, 0, 0.0, &cells);
    if (operator->problem->field->form == OST_SPLIT_NOT)
        cells.points = 0; /* axes at the centroid do for what only preconditions */
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        OstSimd block[OST_MAX_FUNCTIONS][9];
        gather(operator, first, mesh->tet_count, &cells);
        if (cells.nodes == 4 && cells.batch.elasticity.points == 1)
            ost_linear_tets_blocks(cells.batch.x, &cells.batch.elasticity, block);
        else if (cells.nodes == 10 && cells.batch.elasticity.points == 1 && is_plain(&cells, OST_FORMULATION_LINEAR))
            ost_straight_blocks(cells.batch.x, &cells.batch.elasticity, block);
        else
            add_blocks(&cells, element, block);
        if (cells.turned_by)
            turn_blocks(&cells, element, block);
        for (int slot = 0; slot < cells.batch.count; slot++)
            for (int k = 0; k < cells.functions; k++)
                for (int p = 0; p < 6; p++)
                    sum[6 * (size_t)cells.function[slot][k] + (size_t)p] += block[k][place[p]][slot];
    }
}

OstStatus ost_operator_blocks(const OstOperator *operator, float * factor)
{
    const OstComplement *complement = operator->complement;
    OstContext *ctx = operator->problem->ctx;
    double *sum = NULL;
    int definite = 1;
    if (operator->light && !operator->turned_by) {
        ost_light_tets_blocks(operator->light, factor);
        return OST_SUCCESS;
    }
    OST_TRY(OST_NEW(ctx, &sum, 6 * (size_t)complement->count));
    sum_blocks(operator, sum);
    for (OstLocal k = 0; k < complement->count; k++) {
        double *block = sum + 6 * (size_t)k;
        float *of_function = factor + OST_PER_BLOCK * (size_t)k;
        memset(of_function, 0, OST_PER_BLOCK * sizeof *of_function);
        if (!ost_complement_owns(complement, k))
            continue;
        for (int p = 0; p < 6; p++)
            block[p] /= operator->unit;
        ost_complement_constrain_block(complement, k, block);
        definite &= ost_block_factor(block, 0.0, of_function);
    }
    OST_FREE(sum);
    if (!definite)
        return OST_RAISE(ctx, OST_CHECK_FAILED, "the error estimate meets a stiffness that is not positive definite");
    return OST_SUCCESS;
}
