/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/row_geometry.h"

#include "core/error.h"
#include "core/memory.h"

static OstStatus fill(OstRowGeometry *rows)
{
    OstContext *ctx = rows->system->ctx;
    const size_t count = (size_t)rows->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &rows->coordinates, 3 * count);
    OST_THEN(OST_NEW(ctx, &rows->modes, 18 * count));
    if (status == OST_SUCCESS && rows->with_metric) {
        ost_ledger_enter(ctx, OST_EFFECT_ORTHOTROPY);
        status = OST_NEW(ctx, &rows->metric, 6 * count);
        ost_ledger_leave(ctx);
    }
    OST_TRY(ost_agree(ctx, status));
    rows->geometry.coordinates = rows->coordinates;
    rows->geometry.metric = rows->metric;
    rows->geometry.modes = rows->modes;
    return ost_system_geometry(rows->system, rows->field, rows->coordinates, rows->metric, rows->modes);
}

OstStatus ost_row_geometry_create(const OstSystem *system, const OstMaterialField *field, int with_metric,
                                  OstRowGeometry *rows)
{
    rows->geometry = (OstSolverGeometry){0};
    rows->system = system;
    rows->field = field;
    rows->with_metric = with_metric;
    return fill(rows);
}

void ost_row_geometry_release(OstRowGeometry *rows)
{
    OST_FREE(rows->coordinates, rows->metric, rows->modes, rows->moved);
}

static void release(void *data)
{
    OstRowGeometry *rows = data;
    if (!rows->kept)
        ost_row_geometry_release(rows);
}

static OstStatus renew(void *data, OstSolverGeometry *geometry)
{
    OstRowGeometry *rows = data;
    if (!rows->coordinates)
        OST_TRY(fill(rows));
    geometry->coordinates = rows->coordinates;
    geometry->metric = rows->metric;
    geometry->modes = rows->modes;
    geometry->moved = rows->moved;
    return OST_SUCCESS;
}

OstStatus ost_row_geometry_move(OstRowGeometry *rows, const double *displacement)
{
    OstContext *ctx = rows->system->ctx;
    OST_TRY(ost_geometry_renew(&rows->geometry));
    if (!rows->moved)
        OST_TRY(ost_agree(ctx, OST_NEW(ctx, &rows->moved, 3 * (size_t)rows->system->matrix->rows)));
    rows->kept = 1;
    rows->geometry.moved = rows->moved;
    return ost_system_modes(rows->system, displacement, rows->moved, rows->modes);
}

void ost_row_geometry_lend(OstRowGeometry *rows)
{
    rows->geometry.owner = rows;
    rows->geometry.renew = renew;
    rows->geometry.release = release;
}
