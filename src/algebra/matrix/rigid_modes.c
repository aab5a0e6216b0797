/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rigid_modes.h"
#include "core/small.h"

void ost_rigid_body_modes(OstLocal count, const double *coordinates, const double about[3], double *modes)
{
    const size_t length = 3 * (size_t)count;
    for (int axis = 0; axis < 3; axis++) {
        const double along[3] = {axis == 0, axis == 1, axis == 2};
        double *translation = modes + (size_t)axis * length;
        double *rotation = modes + (size_t)(3 + axis) * length;
        for (size_t i = 0; i < length; i += 3) {
            const double arm[3] = {coordinates[i] - about[0], coordinates[i + 1] - about[1],
                                   coordinates[i + 2] - about[2]};
            for (size_t c = 0; c < 3; c++)
                translation[i + c] = along[c];
            ost_cross3(along, arm, rotation + i);
        }
    }
}
