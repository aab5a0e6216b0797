/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_TURN_H
#define ORTHOSTAT_MATERIAL_TURN_H

#include <math.h>
#include <stddef.h>

/* Right-handed axes (rows e1 e2 e3) kept as a unit quaternion, w first: 4 numbers in place of 9. */

/* Local. From the largest of its numbers, so that none is lost to cancellation. */
static inline void ost_turn_of_axes(const double axes[9], double turn[4])
{
    const double trace = axes[0] + axes[4] + axes[8];
    int largest = 0; /* of 4 q_k² */
    double most = 1.0 + trace, square = 0.0;
    for (int k = 0; k < 3; k++)
        if (1.0 + 2.0 * axes[4 * k] - trace > most) {
            largest = k + 1;
            most = 1.0 + 2.0 * axes[4 * k] - trace;
        }
    if (largest == 0) {
        turn[0] = most;
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            turn[1 + k] = axes[3 * a + b] - axes[3 * b + a];
        }
    } else {
        const int k = largest - 1, a = (k + 1) % 3, b = (k + 2) % 3;
        turn[0] = axes[3 * a + b] - axes[3 * b + a];
        turn[1 + k] = most;
        turn[1 + a] = axes[3 * k + a] + axes[3 * a + k];
        turn[1 + b] = axes[3 * k + b] + axes[3 * b + k];
    }
    for (int n = 0; n < 4; n++)
        square += turn[n] * turn[n];
    for (int n = 0; n < 4; n++)
        turn[n] /= sqrt(square);
}

/* Of numbers or of vectors of them. */
#define OST_AXES_OF_TURN(q, axes)                            \
    do {                                                     \
        (axes)[0] = 1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]); \
        (axes)[1] = 2.0 * (q[1] * q[2] + q[0] * q[3]);       \
        (axes)[2] = 2.0 * (q[1] * q[3] - q[0] * q[2]);       \
        (axes)[3] = 2.0 * (q[1] * q[2] - q[0] * q[3]);       \
        (axes)[4] = 1.0 - 2.0 * (q[1] * q[1] + q[3] * q[3]); \
        (axes)[5] = 2.0 * (q[2] * q[3] + q[0] * q[1]);       \
        (axes)[6] = 2.0 * (q[1] * q[3] + q[0] * q[2]);       \
        (axes)[7] = 2.0 * (q[2] * q[3] - q[0] * q[1]);       \
        (axes)[8] = 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]); \
    } while (0)

#endif
