/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ALGEBRA_ELASTIC_BLOCK_H
#define ORTHOSTAT_TESTS_ALGEBRA_ELASTIC_BLOCK_H

#include "support.h"

#include "algebra/matrix/block_matrix.h"
#include "algebra/matrix/rigid_modes.h"
#include "algebra/solver.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An isotropic block of trilinear bricks, held at its bottom layer of nodes (or free), its layers shared out over the
 * ranks: a stiffness matrix that owes nothing to the library. */
typedef struct ElasticBlock {
    int bricks[3];
    double size[3]; /* of a brick */
    double modulus, poisson;
    double contrast; /* every other brick is stiffer by this factor; 0 or 1: all alike */
    int held;
} ElasticBlock;

typedef struct ElasticProblem {
    OstBlockMatrix *matrix;
    double *coordinates; /* rows × 3 */
    double *modes;       /* 6 columns of 3 × rows */
    double *force;       /* 3 × rows; depends on the global numbers alone */
    OstSolverGeometry geometry;
} ElasticProblem;

typedef struct ElasticSlab {
    const ElasticBlock *block;
    int plane, layers; /* nodes of a layer; layers that have rows */
    int low, high;     /* this rank's */
} ElasticSlab;

/* Stiffness of one brick of modulus 1, nodes numbered x first: 2×2×2 Gauss points. */
static inline void elastic_brick(const ElasticBlock *block, double stiffness[24][24])
{
    const double lambda = block->poisson / ((1.0 + block->poisson) * (1.0 - 2.0 * block->poisson));
    const double mu = 0.5 / (1.0 + block->poisson);
    const double volume = block->size[0] * block->size[1] * block->size[2];
    memset(stiffness, 0, 24 * 24 * sizeof(double));
    for (int point = 0; point < 8; point++) {
        double at[3];
        double gradient[8][3];
        for (int d = 0; d < 3; d++)
            at[d] = 0.5 + ((point >> d & 1) ? 0.5 : -0.5) / sqrt(3.0);
        for (int a = 0; a < 8; a++)
            for (int d = 0; d < 3; d++) {
                gradient[a][d] = ((a >> d & 1) ? 1.0 : -1.0) / block->size[d];
                for (int e = 0; e < 3; e++)
                    if (e != d)
                        gradient[a][d] *= (a >> e & 1) ? at[e] : 1.0 - at[e];
            }
        for (int a = 0; a < 8; a++)
            for (int b = 0; b < 8; b++) {
                double inner = 0.0;
                for (int d = 0; d < 3; d++)
                    inner += gradient[a][d] * gradient[b][d];
                for (int i = 0; i < 3; i++)
                    for (int j = 0; j < 3; j++)
                        stiffness[3 * a + i][3 * b + j] +=
                            volume / 8.0 *
                            (lambda * gradient[a][i] * gradient[b][j] + mu * gradient[a][j] * gradient[b][i] +
                             (i == j ? mu * inner : 0.0));
            }
    }
}

/* Column of the node in place `in_plane` of a layer; layers count from the first that has rows. */
static inline OstLocal elastic_column(const ElasticSlab *slab, int layer, int in_plane)
{
    const int owned = (slab->high - slab->low) * slab->plane;
    if (layer >= slab->low && layer < slab->high)
        return (layer - slab->low) * slab->plane + in_plane;
    if (layer < slab->low)
        return owned + in_plane;
    return owned + (slab->low > 0 ? slab->plane : 0) + in_plane;
}

static inline int elastic_compare(const void *a, const void *b)
{
    return *(const OstLocal *)a - *(const OstLocal *)b;
}

/* The columns of the node at (i, j, layer), ascending; at most 27. */
static inline int elastic_neighbours(const ElasticSlab *slab, int i, int j, int layer, OstLocal columns[27])
{
    const int *bricks = slab->block->bricks;
    int n = 0;
    for (int z = layer - 1; z <= layer + 1; z++)
        for (int y = j - 1; y <= j + 1; y++)
            for (int x = i - 1; x <= i + 1; x++)
                if (z >= 0 && z < slab->layers && y >= 0 && y <= bricks[1] && x >= 0 && x <= bricks[0])
                    columns[n++] = elastic_column(slab, z, y * (bricks[0] + 1) + x);
    qsort(columns, (size_t)n, sizeof *columns, elastic_compare);
    return n;
}

static inline OstStatus elastic_pattern(const ElasticSlab *slab, OstBlockMatrix *matrix)
{
    OstContext *context = matrix->ctx;
    OST_TRY(OST_NEW(context, &matrix->row_start, matrix->rows + 1));
    OST_TRY(OST_NEW(context, &matrix->column, 27 * (size_t)matrix->rows));
    OST_TRY(OST_NEW(context, &matrix->value, 9 * 27 * (size_t)matrix->rows));
    OST_TRY(OST_NEW(context, &matrix->diagonal, matrix->rows));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const int in_plane = row % slab->plane;
        const int width = slab->block->bricks[0] + 1;
        const OstLocal start = matrix->row_start[row];
        const int n = elastic_neighbours(slab, in_plane % width, in_plane / width, slab->low + row / slab->plane,
                                         matrix->column + start);
        matrix->row_start[row + 1] = start + n;
        for (OstLocal k = start; k < start + n; k++)
            if (matrix->column[k] == row)
                matrix->diagonal[row] = k;
    }
    return OST_SUCCESS;
}

static inline OstStatus elastic_halo(const ElasticSlab *slab, OstBlockMatrix *matrix)
{
    OstGlobal *ghost = NULL;
    const OstLocal ghosts = matrix->columns - matrix->rows;
    OstStatus status = ost_agree(matrix->ctx, OST_NEW(matrix->ctx, &ghost, ghosts));
    OstLocal n = 0;
    if (status == OST_SUCCESS && matrix->rows > 0)
        for (int layer = slab->low - 1; layer <= slab->high; layer += slab->high - slab->low + 1)
            for (int p = 0; p < slab->plane && layer >= 0 && layer < slab->layers; p++)
                ghost[n++] = (OstGlobal)layer * slab->plane + p;
    if (status == OST_SUCCESS)
        status = ost_halo_create(matrix->ctx, matrix->rows, matrix->first_row, ghosts, ghost, &matrix->halo);
    OST_FREE(ghost);
    return status;
}

static inline void elastic_add_brick(const ElasticSlab *slab, const int at[3], double modulus, double brick[24][24],
                                     OstBlockMatrix *matrix)
{
    OstLocal node[8];
    for (int a = 0; a < 8; a++) {
        const int layer = at[2] + (a >> 2) - slab->block->held;
        const int near = layer >= slab->low - 1 && layer <= slab->high && layer >= 0 && layer < slab->layers;
        node[a] = !near ? -1
                        : elastic_column(slab, layer,
                                         (at[1] + (a >> 1 & 1)) * (slab->block->bricks[0] + 1) + at[0] + (a & 1));
    }
    for (int a = 0; a < 8; a++)
        for (int b = 0; b < 8; b++) {
            if (node[a] < 0 || node[a] >= matrix->rows || node[b] < 0)
                continue;
            OstLocal k = matrix->row_start[node[a]];
            while (matrix->column[k] != node[b])
                k++;
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    matrix->value[9 * (size_t)k + (size_t)(3 * i + j)] += modulus * brick[3 * a + i][3 * b + j];
        }
}

static inline void elastic_fill(const ElasticSlab *slab, OstBlockMatrix *matrix)
{
    const ElasticBlock *block = slab->block;
    double brick[24][24];
    elastic_brick(block, brick);
    for (int z = 0; z < block->bricks[2]; z++)
        for (int y = 0; y < block->bricks[1]; y++)
            for (int x = 0; x < block->bricks[0]; x++) {
                const int top = z + 1 - block->held;
                const double factor = block->contrast > 0.0 && (x + y + z) % 2 ? block->contrast : 1.0;
                if (top >= slab->low && top - 1 < slab->high)
                    elastic_add_brick(slab, (int[3]){x, y, z}, factor * block->modulus, brick, matrix);
            }
}

static inline OstStatus elastic_geometry(const ElasticSlab *slab, ElasticProblem *problem)
{
    const OstBlockMatrix *matrix = problem->matrix;
    const double *size = slab->block->size;
    const int width = slab->block->bricks[0] + 1;
    const double about[3] = {0.5 * size[0] * slab->block->bricks[0], 0.5 * size[1] * slab->block->bricks[1],
                             0.5 * size[2] * slab->block->bricks[2]};
    OST_TRY(OST_NEW(matrix->ctx, &problem->coordinates, 3 * (size_t)matrix->rows));
    OST_TRY(OST_NEW(matrix->ctx, &problem->modes, 18 * (size_t)matrix->rows));
    OST_TRY(OST_NEW(matrix->ctx, &problem->force, 3 * (size_t)matrix->rows));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        const int in_plane = row % slab->plane;
        double *at = problem->coordinates + 3 * (size_t)row;
        at[0] = size[0] * (in_plane % width);
        at[1] = size[1] * (in_plane / width);
        at[2] = size[2] * (slab->low + row / slab->plane + slab->block->held);
        for (int c = 0; c < 3; c++)
            problem->force[3 * row + c] = sin(1.0 + 0.7 * (double)(3 * (matrix->first_row + row) + c));
    }
    ost_rigid_body_modes(matrix->rows, problem->coordinates, about, problem->modes);
    problem->geometry = (OstSolverGeometry){.coordinates = problem->coordinates, .modes = problem->modes};
    return OST_SUCCESS;
}

static inline void elastic_destroy(ElasticProblem *problem)
{
    ost_block_matrix_destroy(&problem->matrix);
    OST_FREE(problem->coordinates, problem->modes, problem->force);
}

/* Collective over the context. */
static inline OstStatus elastic_create(OstContext *context, const ElasticBlock *block, ElasticProblem *problem)
{
    const int rank = ost_rank(context);
    const int size = ost_size(context);
    const int layers = block->bricks[2] + 1 - block->held;
    const ElasticSlab slab = {.block = block,
                              .plane = (block->bricks[0] + 1) * (block->bricks[1] + 1),
                              .layers = layers,
                              .low = layers * rank / size,
                              .high = layers * (rank + 1) / size};
    memset(problem, 0, sizeof *problem);
    OST_TRY(OST_NEW(context, &problem->matrix, 1));
    OstBlockMatrix *matrix = problem->matrix;
    const int empty = slab.low == slab.high;
    const int sides = empty ? 0 : (slab.low > 0) + (slab.high < layers);
    matrix->ctx = context;
    matrix->rows = (slab.high - slab.low) * slab.plane;
    matrix->columns = matrix->rows + sides * slab.plane;
    matrix->first_row = (OstGlobal)slab.low * slab.plane;
    matrix->global_rows = (OstGlobal)layers * slab.plane;
    OST_TRY(elastic_pattern(&slab, matrix));
    OST_TRY(elastic_halo(&slab, matrix));
    OST_TRY(OST_NEW(context, &matrix->label, matrix->columns));
    for (OstLocal row = 0; row < matrix->rows; row++)
        matrix->label[row] = matrix->first_row + row;
    OST_TRY(ost_halo_import(matrix->halo, sizeof *matrix->label, matrix->label));
    elastic_fill(&slab, matrix);
    return elastic_geometry(&slab, problem);
}

/* A bar whose matrix is diagonal, the same three numbers at every node; forces are 1. */
static inline ElasticProblem diagonal_bar(const double diagonal[3])
{
    const ElasticBlock bar = {.bricks = {1, 1, 3}, .size = {1.0, 1.0, 1.0}, .modulus = 1.0, .poisson = 0.0, .held = 0};
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &bar, &problem));
    OstBlockMatrix *matrix = problem.matrix;
    memset(matrix->value, 0, 9 * (size_t)matrix->row_start[matrix->rows] * sizeof *matrix->value);
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (int c = 0; c < 3; c++) {
            matrix->value[9 * (size_t)matrix->diagonal[i] + (size_t)(4 * c)] = diagonal[c];
            problem.force[3 * i + c] = 1.0;
        }
    return problem;
}

#endif
