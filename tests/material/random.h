/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_MATERIAL_RANDOM_H
#define ORTHOSTAT_TESTS_MATERIAL_RANDOM_H

#include "orthostat/axes.h"

/* Random numbers that are the same in every run; to be included after support.h. */
static unsigned short random_state[3] = {1, 2, 3};

static inline double random_between(double low, double high)
{
    return low + (high - low) * erand48(random_state);
}

/* Young's moduli spread over `decades` decades. */
static inline void random_moduli(double decades, double youngs_modulus[3])
{
    for (int i = 0; i < 3; i++)
        youngs_modulus[i] = pow(10.0, random_between(-0.5 * decades, 0.5 * decades));
}

static inline void random_axes(double axes[9])
{
    double quaternion[4];
    for (int i = 0; i < 4; i++)
        quaternion[i] = random_between(-1.0, 1.0);
    assert_success(ost_axes_from_quaternion(ctx, quaternion, axes));
}

static inline void assert_rotation(const double axes[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double product = 0.0;
            for (int k = 0; k < 3; k++)
                product += axes[3 * i + k] * axes[3 * j + k];
            assert_close(product, i == j ? 1.0 : 0.0, 1e-15 * 8);
        }
    const double *a = axes;
    assert_close(a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
                     a[2] * (a[3] * a[7] - a[4] * a[6]),
                 1.0, 1e-15 * 8);
}

static inline void assert_axes(const double axes[9], const double expected[9], double tolerance)
{
    for (int i = 0; i < 9; i++)
        assert_close(axes[i], expected[i], tolerance);
}

#endif
