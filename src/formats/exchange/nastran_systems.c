/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/nastran_systems.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

OstStatus ost_nastran_system_add(OstMshCursor *cursor, OstNastranSystems *systems, OstNastranSystem **added)
{
    OST_TRY(OST_GROW(cursor->ctx, &systems->system, systems->count + 1));
    *added = &systems->system[systems->count++];
    **added = (OstNastranSystem){0};
    return OST_SUCCESS;
}

static void place(const OstNastranSystem *system, double x[3])
{
    double local[3] = {x[0], x[1], x[2]};
    if (system->kind == 'C') {
        local[0] = x[0] * cos(degree * x[1]);
        local[1] = x[0] * sin(degree * x[1]);
    } else if (system->kind == 'S') {
        const double across = x[0] * sin(degree * x[1]);
        local[0] = across * cos(degree * x[2]);
        local[1] = across * sin(degree * x[2]);
        local[2] = x[0] * cos(degree * x[1]);
    }
    ost_apply3_transposed(system->axes, local, x);
    for (int d = 0; d < 3; d++)
        x[d] += system->origin[d];
}

static int scale_to_one(double v[3])
{
    const double length = ost_norm3(v);
    for (int d = 0; d < 3; d++)
        v[d] /= length;
    return isnormal(length);
}

/* Each base is found first; a circle of them has more links than there are systems. */
static OstStatus find(OstMshCursor *cursor, OstNastranSystems *systems, OstGlobal label, int links,
                      const OstNastranSystem **found)
{
    OstNastranSystem *system = NULL;
    const OstNastranSystem *base = NULL;
    for (int s = 0; s < systems->count && !system; s++)
        if (systems->system[s].label == label)
            system = &systems->system[s];
    if (!system || links > systems->count)
        return OST_RAISE(cursor->ctx, OST_INVALID_INPUT,
                         "%s: coordinate system %" PRId64 " is used, and %s; write the mesh in the basic system",
                         cursor->path, label, system ? "is based on itself" : "no CORD2R, CORD2C or CORD2S states it");
    *found = system;
    if (system->found)
        return OST_SUCCESS;
    double point[3][3], *e1 = system->axes, *e2 = system->axes + 3, *e3 = system->axes + 6;
    memcpy(point, system->points, sizeof point);
    if (system->base != 0)
        OST_TRY(find(cursor, systems, system->base, links + 1, &base));
    for (int p = 0; p < 3 && base; p++)
        place(base, point[p]);
    for (int d = 0; d < 3; d++) {
        system->origin[d] = point[0][d];
        e3[d] = point[1][d] - point[0][d];
        e1[d] = point[2][d] - point[0][d];
    }
    ost_cross3(e3, e1, e2);
    ost_cross3(e2, e3, e1);
    system->found = scale_to_one(e1) && scale_to_one(e2) && scale_to_one(e3);
    return system->found
               ? OST_SUCCESS
               : OST_RAISE(cursor->ctx, OST_INVALID_INPUT,
                           "%s: the three points of coordinate system %" PRId64 " lie on a line", cursor->path, label);
}

OstStatus ost_nastran_to_basic(OstMshCursor *cursor, OstNastranSystems *systems, OstGlobal label, double x[3])
{
    const OstNastranSystem *system = NULL;
    OST_TRY(find(cursor, systems, label, 0, &system));
    place(system, x);
    return OST_SUCCESS;
}
