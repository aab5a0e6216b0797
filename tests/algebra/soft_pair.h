/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ALGEBRA_SOFT_PAIR_H
#define ORTHOSTAT_TESTS_ALGEBRA_SOFT_PAIR_H

#include "elastic_block.h"

/* A stiff pair of unknowns whose soft mode, of stiffness `softness`, is what is left of numbers 1e15 times larger. */
static const double pair[3] = {3e15, -1e15, 1e30 / 3e15 + 1.0};

static inline double softness(void)
{
    return (double)(pair[2] - (long double)pair[1] * pair[1] / pair[0]);
}

/* As if the soft mode's stiffness were `soft`. */
static inline void solve_pair(double soft, const double r[2], double u[2])
{
    u[1] = (r[1] - pair[1] / pair[0] * r[0]) / soft;
    u[0] = (r[0] - pair[1] * u[1]) / pair[0];
}

static inline int has_pair(const OstBlockMatrix *matrix)
{
    return matrix->first_row == 0 && matrix->rows > 0;
}

/* A bar of stiffness 2 in every unknown but the first two, which are the pair. */
static inline ElasticProblem bar_with_pair(void)
{
    ElasticProblem problem = diagonal_bar((const double[3]){2.0, 2.0, 2.0});
    if (has_pair(problem.matrix)) {
        double *block = problem.matrix->value + 9 * (size_t)problem.matrix->diagonal[0];
        block[0] = pair[0];
        block[1] = block[3] = pair[1];
        block[4] = pair[2];
    }
    return problem;
}

/* What factors make of r that miss the pair's soft mode by a factor. */
static inline void miss_soft_mode(const OstBlockMatrix *matrix, double factor, const double *r, double *u)
{
    for (size_t i = 0; i < 3 * (size_t)matrix->rows; i++)
        u[i] = r[i] / 2.0;
    if (has_pair(matrix))
        solve_pair(softness() / factor, r, u);
}

#endif
