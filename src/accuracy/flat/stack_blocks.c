/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/flat/stacks.h"
#include "assembly/batch.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/large_rotation.h"
#include "element/polar.h"
#include "element/strain_batch.h"

#include <math.h>
#include <string.h>

enum { VERTICES = 4, EDGES = 6, FUNCTIONS = 10 };

/* A pivot is taken to be at least this, over the diagonal's. */
static const double least_pivot = 1e-10;

/* Of each two functions of a tet, and each two vertices a and b, the mean of the derivatives' product, of the one
 * function with L_a and of the other with L_b. */
typedef struct Means {
    double of[FUNCTIONS][FUNCTIONS][VERTICES][VERTICES];
} Means;

static void find_derivatives(const double at[VERTICES], double derivative[FUNCTIONS][VERTICES])
{
    memset(derivative, 0, FUNCTIONS * sizeof *derivative);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        derivative[e][a] = 8.0 * at[b] * (at[b] - 2.0 * at[a]);
        derivative[e][b] = 8.0 * at[a] * (2.0 * at[b] - at[a]);
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            derivative[EDGES + f][ost_tet_face[f][i]] =
                27.0 * at[ost_tet_face[f][(i + 1) % 3]] * at[ost_tet_face[f][(i + 2) % 3]];
}

static void find_means(Means *means)
{
    memset(means, 0, sizeof *means);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double derivative[FUNCTIONS][VERTICES];
        find_derivatives(point->at, derivative);
        for (int k = 0; k < FUNCTIONS; k++)
            for (int l = 0; l < FUNCTIONS; l++)
                for (int a = 0; a < VERTICES; a++)
                    for (int b = 0; b < VERTICES; b++)
                        means->of[k][l][a][b] += point->weight * derivative[k][a] * derivative[l][b];
    }
}

/* volume × B_a' C B_b of each two vertices, turned with the body */
typedef struct Products {
    OstSimd of[VERTICES][VERTICES][9];
} Products;

/* R block R' */
static void turn(const OstSimd rotation[9], OstSimd block[9])
{
    OstSimd half[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] =
                rotation[3 * i] * block[j] + rotation[3 * i + 1] * block[3 + j] + rotation[3 * i + 2] * block[6 + j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            block[3 * i + j] = half[3 * i] * rotation[3 * j] + half[3 * i + 1] * rotation[3 * j + 1] +
                               half[3 * i + 2] * rotation[3 * j + 2];
}

OST_KERNEL static void find_products(const OstBatch *batch, const OstSimd *rotation, Products *products)
{
    OstPoint point;
    OstSimd stress[6][3];
    ost_element_of(4)->evaluate(batch->x, &ost_tet_degree1.point[0], &point);
    for (int b = 0; b < VERTICES; b++) {
        ost_stress_columns(batch->elasticity.c[0], point.gradient[b], stress);
        for (int a = 0; a < VERTICES; a++) {
            OstSimd *block = products->of[a][b];
            ost_block_of_stress(point.gradient[a], stress, block);
            for (int n = 0; n < 9; n++)
                block[n] *= point.volume;
            if (rotation)
                turn(rotation, block);
        }
    }
}

static void find_rotation(const OstBatch *batch, const double *turned_by, OstSimd rotation[9])
{
    OstSimd u[3 * OST_MAX_TET_NODES], slope[9];
    OstPoint point;
    OstPolar polar;
    ost_batch_gather_vectors(batch, 10, turned_by, u);
    ost_element_of(10)->evaluate(batch->x, &ost_tet_degree1.point[0], &point);
    ost_displacement_gradient(10, &point, u, slope);
    ost_polar(slope, &polar);
    ost_polar_rotation(&polar, rotation);
}

/* --- the sum over tets --- */

/* The start of column j of a lower triangle. */
static inline size_t column(size_t n, size_t j)
{
    return j * n - j * (j + 1) / 2;
}

/* Adds to a stack's block the part of functions at places k and l, k >= l. */
static inline void add_part(size_t n, size_t k, size_t l, const double part[9], double *block)
{
    for (size_t j = 0; j < 3; j++)
        for (size_t i = k == l ? j : 0; i < 3; i++)
            block[column(n, 3 * l + j) + 3 * k + i] += part[3 * i + j];
}

/* What functions k and l of a tet have together; `products` are the tet's. */
static inline void find_part(const Means *means, int k, int l, double factor, double products[VERTICES][VERTICES][9],
                             double part[9])
{
    memset(part, 0, 9 * sizeof *part);
    for (int a = 0; a < VERTICES; a++)
        for (int b = 0; b < VERTICES; b++) {
            const double weight = factor * means->of[k][l][a][b];
            for (int m = 0; m < 9 && weight != 0.0; m++)
                part[m] += weight * products[a][b][m];
        }
}

static void add_tet(const OstStacks *stacks, const Means *means, double products[VERTICES][VERTICES][9], OstLocal tet,
                    double unit, double *blocks)
{
    OstLocal function[FUNCTIONS];
    double turn_of[FUNCTIONS], part[9];
    ost_complement_of_tet(stacks->complement, tet, function);
    for (int k = 0; k < FUNCTIONS; k++)
        turn_of[k] = k < EDGES ? ost_complement_turn_of(stacks->complement, tet, k) : 1.0;
    for (int k = 0; k < FUNCTIONS; k++) {
        const OstLocal stack = stacks->stack[function[k]];
        const int place = stacks->place[function[k]];
        for (int l = 0; l < FUNCTIONS && stack >= 0; l++) {
            if (stacks->stack[function[l]] != stack || stacks->place[function[l]] > place)
                continue;
            find_part(means, k, l, turn_of[k] * turn_of[l] / unit, products, part);
            add_part(3 * (size_t)(stacks->start[stack + 1] - stacks->start[stack]), (size_t)place,
                     (size_t)stacks->place[function[l]], part, blocks + stacks->block[stack]);
        }
    }
}

/* Of one tet of a batch. */
static inline void take_slot(const Products *products, int slot, double of[VERTICES][VERTICES][9])
{
    for (int a = 0; a < VERTICES; a++)
        for (int b = 0; b < VERTICES; b++)
            for (int m = 0; m < 9; m++)
                of[a][b][m] = products->of[a][b][m][slot];
}

static void sum_blocks(const OstStacks *stacks, const OstProblem *problem, const double *turned_by, double unit,
                       double *blocks)
{
    const OstMesh *mesh = problem->mesh;
    Means means;
    Products products;
    OstBatch batch;
    find_means(&means);
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        const OstLocal left = mesh->tet_count - first;
        OstSimd rotation[9];
        batch.count = left < OST_SIMD_WIDTH ? (int)left : OST_SIMD_WIDTH;
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            batch.tet[slot] = first + (slot < batch.count ? slot : batch.count - 1);
            memcpy(batch.node[slot], ost_mesh_nodes_of(mesh, batch.tet[slot]), 10 * sizeof(OstLocal));
        }
        ost_batch_gather_vectors(&batch, 10, mesh->coordinates, batch.x);
        ost_elasticity_gather(&batch.elasticity, problem->field, batch.tet, 0, NULL, NULL);
        if (turned_by)
            find_rotation(&batch, turned_by, rotation);
        find_products(&batch, turned_by ? rotation : NULL, &products);
        for (int slot = 0; slot < batch.count; slot++) {
            double of_tet[VERTICES][VERTICES][9];
            take_slot(&products, slot, of_tet);
            add_tet(stacks, &means, of_tet, batch.tet[slot], unit, blocks);
        }
    }
}

/* --- supports --- */

static void get_part(size_t n, size_t k, size_t l, const double *block, double part[9])
{
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++) {
            const size_t row = 3 * k + i, of = 3 * l + j;
            part[3 * i + j] = row >= of ? block[column(n, of) + row] : block[column(n, row) + of];
        }
}

static void set_part(size_t n, size_t k, size_t l, const double part[9], double *block)
{
    for (size_t j = 0; j < 3; j++)
        for (size_t i = k == l ? j : 0; i < 3; i++)
            block[column(n, 3 * l + j) + 3 * k + i] = part[3 * i + j];
}

/* P block P, of the projectors of functions at places k >= l. */
static void constrain_pair(const OstComplement *complement, const OstLocal *function, size_t n, size_t k, size_t l,
                           double *block)
{
    static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const OstLocal of_k = complement->support[function[k]], of_l = complement->support[function[l]];
    double part[9], half[9];
    if (of_k < 0 && of_l < 0)
        return;
    get_part(n, k, l, block, part);
    ost_multiply3(of_k < 0 ? identity : complement->projector + 9 * (size_t)of_k, part, half);
    ost_multiply3(half, of_l < 0 ? identity : complement->projector + 9 * (size_t)of_l, part);
    set_part(n, k, l, part, block);
}

static void constrain(const OstStacks *stacks, OstLocal stack, double *block)
{
    static const int of[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2}, place[6] = {0, 4, 8, 1, 5, 6};
    const OstComplement *complement = stacks->complement;
    const OstLocal *function = stacks->function + stacks->start[stack];
    const size_t count = (size_t)(stacks->start[stack + 1] - stacks->start[stack]);
    for (size_t l = 0; l < count; l++) {
        double part[9], symmetric[6];
        get_part(3 * count, l, l, block, part);
        for (int p = 0; p < 6; p++)
            symmetric[p] = part[place[p]];
        ost_complement_constrain_block(complement, function[l], symmetric);
        for (int n = 0; n < 9; n++)
            part[n] = symmetric[of[n]];
        set_part(3 * count, l, l, part, block);
        for (size_t k = l + 1; k < count; k++)
            constrain_pair(complement, function, 3 * count, k, l, block);
    }
}

/* --- the inverse --- */

/* L of a lower triangle, in its place, by columns. */
static void factor_block(size_t n, double *a)
{
    for (size_t j = 0; j < n; j++) {
        double *of_j = a + column(n, j);
        const double diagonal = of_j[j];
        for (size_t k = 0; k < j; k++) {
            const double *of_k = a + column(n, k);
            for (size_t i = j; i < n; i++)
                of_j[i] -= of_k[j] * of_k[i];
        }
        const double inverse = 1.0 / sqrt(fmax(of_j[j], least_pivot * diagonal));
        for (size_t i = j + 1; i < n; i++)
            of_j[i] *= inverse;
        of_j[j] = 1.0 / inverse;
    }
}

/* N = L^-1 */
static void invert(size_t n, const double *l, float *inverse)
{
    double x[3 * OST_MOST_OF_STACK];
    for (size_t j = 0; j < n; j++) {
        memset(x, 0, n * sizeof *x);
        x[j] = 1.0;
        for (size_t k = j; k < n; k++) {
            const double *of_k = l + column(n, k);
            x[k] /= of_k[k];
            for (size_t i = k + 1; i < n; i++)
                x[i] -= of_k[i] * x[k];
        }
        for (size_t i = j; i < n; i++)
            inverse[column(n, j) + i] = (float)x[i];
    }
}

OstStatus ost_stacks_factor(OstStacks *stacks, const OstProblem *problem, const double *turned_by, double unit)
{
    double *blocks = NULL;
    OST_TRY(OST_NEW(problem->ctx, &blocks, stacks->block[stacks->count]));
    sum_blocks(stacks, problem, turned_by, unit, blocks);
    for (OstLocal s = 0; s < stacks->count; s++) {
        const size_t n = 3 * (size_t)(stacks->start[s + 1] - stacks->start[s]);
        double *block = blocks + stacks->block[s];
        constrain(stacks, s, block);
        factor_block(n, block);
        invert(n, block, stacks->factor + stacks->block[s]);
    }
    OST_FREE(blocks);
    return OST_SUCCESS;
}
