/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/vertices.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

enum { PARENTS = 4, BLOCK = 3 * OST_MODES };

typedef struct Making {
    const OstCoarseSpace *space;
    const OstSolverGeometry *geometry;
    const OstScaling *scaling, *linear;
    double *place; /* linear columns × 3 */
    double *arm;   /* linear columns: root mean square of the distances to the nodes that a vertex moves */
    OstVertexSpace *made;
} Making;

void ost_vertex_space_clear(OstVertexSpace *vertices)
{
    ost_prolongator_destroy(&vertices->prolongator);
    ost_metric_graph_destroy(&vertices->graph);
    OST_FREE(vertices->modes);
}

/* A row's parents by ascending column, each once. */
static int list_parents(const OstCoarseSpace *space, size_t row, OstLocal column[PARENTS], double weight[PARENTS])
{
    int count = 0;
    for (size_t k = PARENTS * row; k < PARENTS * (row + 1); k++) {
        int at = 0;
        if (space->parents[k] < 0 || space->weights[k] == 0.0)
            continue;
        while (at < count && column[at] < space->parents[k])
            at++;
        if (at < count && column[at] == space->parents[k]) {
            weight[at] += space->weights[k];
            continue;
        }
        memmove(column + at + 1, column + at, (size_t)(count - at) * sizeof *column);
        memmove(weight + at + 1, weight + at, (size_t)(count - at) * sizeof *weight);
        column[at] = space->parents[k];
        weight[at] = space->weights[k];
        count++;
    }
    return count;
}

static const double *places(const OstSolverGeometry *geometry)
{
    return geometry->moved ? geometry->moved : geometry->coordinates;
}

/* A row's parents, and its arms from them. A row lies between its parents, so its arms balance. Where they do not, a
 * parent is on the other side of a periodic cell, and the arms are set to 0. */
typedef struct Parents {
    int count;
    OstLocal column[PARENTS];
    double weight[PARENTS], arm[PARENTS][3];
} Parents;

static void find_parents(const Making *m, size_t row, Parents *parents)
{
    static const double balanced = 1e-3;
    double sum[3] = {0.0}, longest = 0.0;
    parents->count = list_parents(m->space, row, parents->column, parents->weight);
    for (int k = 0; k < parents->count; k++) {
        double *arm = parents->arm[k];
        for (size_t c = 0; c < 3; c++) {
            arm[c] = places(m->geometry)[3 * row + c] - m->place[3 * (size_t)parents->column[k] + c];
            sum[c] += parents->weight[k] * arm[c];
        }
        longest = fmax(longest, ost_norm3(arm));
    }
    if (ost_norm3(sum) > balanced * longest)
        memset(parents->arm, 0, sizeof parents->arm);
}

static OstStatus place_vertices(Making *m)
{
    const OstBlockMatrix *linear = m->space->matrix;
    OstStatus status = OST_NEW(linear->ctx, &m->place, 3 * (size_t)linear->columns);
    OST_THEN(OST_NEW(linear->ctx, &m->arm, 2 * (size_t)linear->columns));
    OST_TRY(ost_agree(linear->ctx, status));
    memcpy(m->place, places(m->space->geometry), 3 * (size_t)linear->rows * sizeof *m->place);
    return ost_halo_import(linear->halo, 3 * sizeof *m->place, m->place);
}

/* Unknown rotations are scaled by the length of their arms, so that they are of the size of displacements. */
static OstStatus measure_arms(Making *m)
{
    const OstBlockMatrix *linear = m->space->matrix;
    double *sum = m->arm; /* squares, and their number */
    for (size_t row = 0; row < (size_t)m->scaling->rows; row++) {
        Parents parents;
        find_parents(m, row, &parents);
        for (int k = 0; k < parents.count && parents.count > 1; k++) {
            const size_t column = (size_t)parents.column[k];
            const double square = ost_dot3(parents.arm[k], parents.arm[k]);
            sum[2 * column] += square;
            sum[2 * column + 1] += square > 0.0;
        }
    }
    OST_TRY(ost_halo_add_to_owners(linear->halo, 2, sum));
    OST_TRY(ost_halo_import(linear->halo, 2 * sizeof *sum, sum));
    for (size_t v = 0; v < (size_t)linear->columns; v++)
        m->arm[v] = sum[2 * v] > 0.0 ? sqrt(sum[2 * v] / sum[2 * v + 1]) : 1.0;
    return OST_SUCCESS;
}

/* S_q^-T x */
static void to_scaled(const double s[6], double x[3])
{
    x[2] = x[2] / s[5];
    x[1] = (x[1] - s[4] * x[2]) / s[2];
    x[0] = (x[0] - s[1] * x[1] - s[3] * x[2]) / s[0];
}

/* The motion of a row, in its scaled unknowns, for each unknown of one of its parents. A vertex has the constraints of
 * its own row; another row follows where it is free. */
static void fill_block(const Making *m, size_t row, OstLocal vertex, double weight, const double arm[3],
                       float block[BLOCK])
{
    const int is_vertex = weight == 1.0;
    const size_t stride = 3 * (size_t)m->scaling->rows;
    const double *s = m->linear->factor + 6 * (size_t)vertex;
    const double basis[3][3] = {{s[0], 0.0, 0.0}, {s[1], s[2], 0.0}, {s[3], s[4], s[5]}}; /* columns of S^T */
    for (int c = 0; c < OST_MODES; c++) {
        double whole[3], motion[3] = {0.0};
        if (c < 3)
            memcpy(whole, basis[c], sizeof whole);
        else
            ost_cross3(basis[c - 3], arm, whole);
        const double factor = c < 3 ? weight : 0.5 * weight / m->arm[vertex];
        for (size_t k = 0; k < 3; k++) /* the modes' translations are the projector on the row's free directions */
            for (size_t i = 0; i < 3; i++)
                motion[i] +=
                    factor * whole[k] * (is_vertex ? (double)(i == k) : m->geometry->modes[k * stride + 3 * row + i]);
        to_scaled(m->scaling->factor + 6 * row, motion);
        for (int i = 0; i < 3; i++)
            block[OST_MODES * i + c] = (float)motion[i];
    }
}

static OstStatus fill_rows(Making *m)
{
    OstContext *ctx = m->scaling->ctx;
    OstProlongator *p = m->made->prolongator;
    OST_TRY(OST_NEW(ctx, &p->row_start, p->rows + 1));
    OST_TRY(OST_NEW(ctx, &p->column, PARENTS * (size_t)p->rows));
    for (OstLocal row = 0; row < p->rows; row++) {
        double weight[PARENTS];
        p->row_start[row + 1] =
            p->row_start[row] + list_parents(m->space, (size_t)row, p->column + p->row_start[row], weight);
    }
    OST_TRY(OST_NEW(ctx, &p->value, BLOCK * (size_t)p->row_start[p->rows] + OST_PADDING));
    for (OstLocal row = 0; row < p->rows; row++) {
        Parents parents;
        find_parents(m, (size_t)row, &parents);
        for (int k = 0; k < parents.count; k++)
            fill_block(m, (size_t)row, parents.column[k], parents.weight[k], parents.arm[k],
                       p->value + BLOCK * (size_t)(p->row_start[row] + k));
    }
    return OST_RESIZE(ctx, &p->column, p->row_start[p->rows]);
}

/* In a rigid motion all vertices turn alike. */
static OstStatus fill_modes(Making *m)
{
    const size_t vertices = (size_t)m->linear->rows, fine = 3 * vertices, coarse = OST_MODES * vertices;
    double *scaled = NULL;
    OstStatus status = OST_NEW(m->linear->ctx, &scaled, fine);
    OST_THEN(OST_NEW(m->linear->ctx, &m->made->modes, OST_MODES * coarse));
    for (size_t k = 0; k < OST_MODES && status == OST_SUCCESS; k++)
        for (size_t v = 0; v < vertices; v++) {
            double *to = m->made->modes + k * coarse + OST_MODES * v, turn[3] = {k == 3, k == 4, k == 5};
            if (v == 0)
                ost_scaling_to_scaled_mode(m->linear, m->space->geometry->modes + k * fine, scaled);
            to_scaled(m->linear->factor + 6 * v, turn);
            for (size_t i = 0; i < 3; i++) {
                to[i] = scaled[3 * v + i];
                to[3 + i] = m->arm[v] * turn[i];
            }
        }
    OST_FREE(scaled);
    return status;
}

static OstStatus make_prolongator(Making *m)
{
    const OstBlockMatrix *linear = m->space->matrix;
    OstContext *ctx = linear->ctx;
    OstLocal *same = NULL;
    OstStatus status = OST_NEW(ctx, &m->made->prolongator, 1);
    OST_THEN(OST_NEW(ctx, &same, (size_t)linear->columns));
    OST_TRY_DONE(ost_agree(ctx, status));
    OstProlongator *p = m->made->prolongator;
    p->ctx = ctx;
    p->height = 3;
    p->rows = m->scaling->rows;
    p->columns = linear->columns;
    for (OstLocal v = 0; v < linear->columns; v++)
        same[v] = v;
    OST_TRY_DONE(ost_agree(ctx, ost_halo_subset(linear->halo, same, &p->halo)));
    OST_TRY_DONE(ost_exchange_create(p->halo, OST_MODES, &p->exchange));
    status = fill_rows(m);
    OST_THEN(fill_modes(m));
    status = ost_agree(ctx, status);
done:
    OST_FREE(same);
    return status;
}

OstStatus ost_vertex_space_create(const OstCoarseSpace *space, const OstSolverGeometry *geometry,
                                  const OstScaling *scaling, const OstScaling *linear, OstVertexSpace *vertices)
{
    Making m = {.space = space, .geometry = geometry, .scaling = scaling, .linear = linear, .made = vertices};
    OstSolverGeometry with_facts = *space->geometry;
    with_facts.facts = geometry->facts;
    *vertices = (OstVertexSpace){.first = space->matrix->first_row};
    OstStatus status = place_vertices(&m);
    OST_THEN(measure_arms(&m));
    OST_THEN(make_prolongator(&m));
    OST_THEN(ost_metric_graph_create(space->matrix, &with_facts, &vertices->graph));
    OST_FREE(m.place, m.arm);
    if (status != OST_SUCCESS)
        ost_vertex_space_clear(vertices);
    return status;
}
