/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/row_geometry.h"

#include "core/error.h"
#include "core/memory.h"

OstStatus ost_row_geometry_create(const OstSystem *system, const OstMaterialField *field, int with_metric,
                                  OstRowGeometry *rows)
{
    OstContext *ctx = system->ctx;
    const size_t count = (size_t)system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &rows->coordinates, 3 * count);
    OST_THEN(OST_NEW(ctx, &rows->modes, 18 * count));
    if (status == OST_SUCCESS && with_metric) {
        ost_ledger_enter(ctx, OST_EFFECT_ORTHOTROPY);
        status = OST_NEW(ctx, &rows->metric, 6 * count);
        ost_ledger_leave(ctx);
    }
    OST_TRY(ost_agree(ctx, status));
    rows->geometry =
        (OstSolverGeometry){.coordinates = rows->coordinates, .metric = rows->metric, .modes = rows->modes};
    return ost_system_geometry(system, field, rows->coordinates, rows->metric, rows->modes);
}

void ost_row_geometry_release(OstRowGeometry *rows)
{
    OST_FREE(rows->coordinates);
    OST_FREE(rows->metric);
    OST_FREE(rows->modes);
}
