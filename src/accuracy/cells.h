/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_CELLS_H
#define ORTHOSTAT_ACCURACY_CELLS_H

#include "accuracy/operator.h"
#include "accuracy/straight.h"
#include "assembly/batch.h"
#include "element/large_rotation.h"
#include "element/polar.h"
#include "element/shape_functions.h"

#include <stdint.h>
#include <string.h>

/* Batches of tets with their functions, read and written: for accuracy/operator_forces.c and accuracy/pressure_error.c.
 */

static const size_t nowhere_of_functions = SIZE_MAX;

enum { NUMBERS = 3 * OST_MAX_TET_NODES, MORE = 3 * OST_MAX_FUNCTIONS };

/* A point with the gradients of the functions. */
typedef struct OstEvaluated {
    OstPoint point;
    OstSimd gradient[OST_MAX_FUNCTIONS][3];
} OstEvaluated;

/* A batch of tets with its functions. */
typedef struct Cells {
    OstBatch batch;
    int nodes, functions;
    const OstQuadrature *rule;
    int points; /* at which C is needed */
    int state;  /* forces of a state, which may have a pressure; else those of a small displacement */
    int straight;
    OstLocal function[OST_SIMD_WIDTH][OST_MAX_FUNCTIONS];
    size_t place[OST_MAX_FUNCTIONS][OST_SIMD_WIDTH]; /* of a function's forces; or nowhere_of_functions */
    OstSimd turn[OST_MAX_FUNCTIONS];
    const OstEvaluated *evaluated;      /* at the rule's points; NULL: not kept */
    const OstCurvedPoint *curved;       /* the same of curved tets that are nothing else */
    OstSimd stretch[OST_MAX_POINTS][6]; /* where axes are known by their line alone: elasticity.stretch_at */
    const double *turned_by;            /* as the operator's; then its displacements */
    OstSimd base[NUMBERS];
} Cells;

/* Degrees 2 and 5 integrate products of the functions' gradients in straight tets without error. Where axes come from a
 * formula, the residual needs them `exactly`; for the stiffness of linear tets those at the centroid will do. */
static inline void clear_cells(const OstOperator *operator, int exactly, double eigen_share, Cells *cells)
{
    cells->turned_by = operator->turned_by;
    cells->nodes = operator->complement->mesh->nodes_per_tet;
    cells->functions = ost_complement_per_tet(operator->complement);
    cells->rule = cells->nodes == 4 ? &ost_tet_degree2 : &ost_tet_degree5;
    cells->points = cells->nodes == 4 && !exactly ? 0 : cells->rule->count;
    cells->state = exactly;
    cells->evaluated = NULL;
    cells->curved = NULL;
    ost_elasticity_clear(&cells->batch.elasticity);
    cells->batch.elasticity.stretch_suffices = cells->nodes == 4 && !exactly && !operator->turned_by;
    cells->batch.elasticity.eigen_share = eigen_share;
}

static inline void find_places(const Cells *cells, OstSimd *places)
{
    for (int q = 0; q < cells->rule->count; q++) {
        double shape[OST_MAX_TET_NODES];
        ost_shape_values(cells->nodes, cells->rule->point[q].at, shape);
        for (int i = 0; i < 3; i++) {
            places[3 * q + i] = shape[0] * cells->batch.x[i];
            for (int a = 1; a < cells->nodes; a++)
                places[3 * q + i] += shape[a] * cells->batch.x[3 * a + i];
        }
    }
}

/* The next tets from `first` on. */
static inline void gather(const OstOperator *operator, OstLocal first, OstLocal end, Cells *cells)
{
    const OstMesh *mesh = operator->problem->mesh;
    const OstMaterialField *field = operator->problem->field;
    OstBatch *batch = &cells->batch;
    OstSimd places[3 * OST_MAX_POINTS];
    batch->count = end - first < OST_SIMD_WIDTH ? (int)(end - first) : OST_SIMD_WIDTH;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const OstLocal tet = first + (slot < batch->count ? slot : batch->count - 1);
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        batch->tet[slot] = tet;
        memcpy(batch->node[slot], nodes, (size_t)cells->nodes * sizeof *nodes);
        ost_complement_of_tet(operator->complement, tet, cells->function[slot]);
        for (int k = 0; k < cells->functions; k++)
            cells->turn[k][slot] = k < 6 ? ost_complement_turn_of(operator->complement, tet, k) : 1.0;
    }
    ost_batch_gather_vectors(batch, cells->nodes, mesh->coordinates, batch->x);
    cells->straight = cells->nodes == 4 || ost_straight_all(batch->x);
    if (cells->turned_by)
        ost_batch_gather_vectors(batch, cells->nodes, cells->turned_by, cells->base);
    if (field->region_formula && cells->points > 0 && !(batch->elasticity.about_line && field->region_count == 1))
        find_places(cells, places);
    ost_elasticity_gather(&batch->elasticity, field, batch->tet, cells->points, cells->rule->point, places);
    const int is_about_line = batch->elasticity.about_line;
    batch->elasticity.stretch_at =
        is_about_line && (cells->nodes == 10 || batch->elasticity.points > 1) ? cells->stretch : NULL;
    if (batch->elasticity.stretch_at)
        ost_straight_stretches(cells->nodes, batch->x, &batch->elasticity, cells->rule, cells->stretch);
    else if (is_about_line)
        ost_stretch_about_line(&batch->elasticity, batch->x, batch->elasticity.stretch_tensor);
}

static inline void gather_functions(const Cells *cells, const float *values, OstSimd *gathered)
{
    for (int k = 0; k < cells->functions; k++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const float *value = values + OST_PER_FUNCTION * (size_t)cells->function[slot][k];
            for (int i = 0; i < 3; i++)
                gathered[3 * k + i][slot] = cells->turn[k][slot] * (double)value[i];
        }
}

/* Where the functions' numbers start, 3 each: for all states of a visit. */
static inline void find_places_of_functions(const OstComplement *complement, Cells *cells)
{
    for (int k = 0; k < cells->functions; k++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const OstLocal function = cells->function[slot][k];
            const int counts = slot < cells->batch.count && ost_complement_owns(complement, function);
            cells->place[k][slot] = counts ? 3 * (size_t)function : nowhere_of_functions;
        }
}

/* Takes forces of a state off those on the functions: 3 numbers each. */
static inline void take_off_state(const Cells *cells, const OstSimd *at_functions, double *of_state)
{
    double *of_function[OST_SIMD_WIDTH], nowhere[3] = {0.0};
    for (int k = 0; k < cells->functions; k++) {
        OstSimd turned[3];
        for (int i = 0; i < 3; i++)
            turned[i] = -cells->turn[k] * at_functions[3 * k + i];
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const size_t place = cells->place[k][slot];
            of_function[slot] = place == nowhere_of_functions ? nowhere : of_state + place;
        }
        ost_simd_scatter3(turned, of_function);
    }
}

static inline void add_to_functions(const Cells *cells, const OstSimd *at_functions, float *of_functions)
{
    for (int slot = 0; slot < cells->batch.count; slot++)
        for (int k = 0; k < cells->functions; k++) {
            float *force = of_functions + OST_PER_FUNCTION * (size_t)cells->function[slot][k];
            for (int i = 0; i < 3; i++)
                force[i] += (float)(cells->turn[k][slot] * at_functions[3 * k + i][slot]);
        }
}

/* The gradients at a point, with its volume. */
static inline void evaluate(const Cells *cells, const OstElement *element, int q, OstPoint *point,
                            OstSimd gradient[OST_MAX_FUNCTIONS][3])
{
    element->evaluate(cells->batch.x, &cells->rule->point[q], point);
    ost_complement_gradients(cells->nodes, cells->rule->point[q].at, point, gradient);
}

/* R at a point of the turned body. */
static inline void find_rotation(const Cells *cells, const OstPoint *point, OstSimd rotation[9])
{
    OstSimd slope[9];
    OstPolar polar;
    ost_displacement_gradient(cells->nodes, point, cells->base, slope);
    ost_polar(slope, &polar);
    ost_polar_rotation(&polar, rotation);
}

/* R' slope. */
static inline void turn_back(const OstSimd rotation[9], OstSimd slope[9])
{
    OstSimd given[9];
    memcpy(given, slope, sizeof given);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] = rotation[i] * given[j] + rotation[3 + i] * given[3 + j] + rotation[6 + i] * given[6 + j];
}

#endif
