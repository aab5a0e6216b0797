/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/frame.h"

#include "core/error.h"

OstStatus ost_frame_in_order(OstContext *ctx, const OstCylindricalDirection order[3], const double frame[9],
                             double axes[9])
{
    const int a = (int)order[0], b = (int)order[1], c = (int)order[2];
    if (a < 0 || a > 2 || b < 0 || b > 2 || c < 0 || c > 2 || a == b || b == c || c == a)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "order of the axes %d %d %d; axial, radial and tangential, each once, are expected", a, b, c);
    const double sign = (b - a + 3) % 3 == 1 ? 1.0 : -1.0;
    for (int i = 0; i < 3; i++) {
        axes[i] = frame[3 * a + i];
        axes[3 + i] = frame[3 * b + i];
        axes[6 + i] = sign * frame[3 * c + i];
    }
    return OST_SUCCESS;
}
