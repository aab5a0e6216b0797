/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "material/directions.h"
#include "material/field_data.h"
#include "material/turn.h"

#include <stdio.h>
#include <string.h>

/* e1 and e2 at the vertices of a tet, and their means, along those of the first vertex. */
static OstStatus take_tet(OstContext *ctx, OstLocal tet, const double *axes, double vectors[2][12], double mean[2][3])
{
    memset(mean, 0, 2 * sizeof *mean);
    for (int v = 0; v < 4; v++) {
        double frame[9];
        char what[64];
        memcpy(frame, axes + 9 * v, sizeof frame);
        snprintf(what, sizeof what, "axes at vertex %d of local tet %lld", v, (long long)tet);
        OST_TRY(ost_axes_check(ctx, what, frame));
        for (int k = 0; k < 6; k++) {
            const double *first = vectors[k / 3], *e = frame + k / 3 * 3;
            const double along = v == 0 ? 1.0 : first[0] * e[0] + first[1] * e[1] + first[2] * e[2];
            vectors[k / 3][3 * v + k % 3] = frame[k];
            mean[k / 3][k % 3] += along < 0.0 ? -frame[k] : frame[k];
        }
    }
    return OST_SUCCESS;
}

static OstStatus set_tet(OstMaterialField *field, OstLocal tet, const double *axes, float *directions)
{
    static const int along[2] = {0, 1};
    double vectors[2][12], mean[2][3], own[9];
    OST_TRY(take_tet(field->ctx, tet, axes, vectors, mean));
    OST_TRY(ost_axes_from_directions(field->ctx, along, mean[0], mean[1], own));
    ost_turn_of_axes(own, field->tet_turn + 4 * (size_t)tet);
    ost_directions_set_linear(own, along, vectors[0], vectors[1], directions);
    return OST_SUCCESS;
}

static OstStatus set_vertex_axes(OstMaterialField *field, OstLocal tet_count, const double *axes)
{
    signed char *along = NULL;
    float *directions = NULL;
    int any = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(field->ctx, &along, 2 * field->region_count));
    OST_TRY_DONE(OST_NEW(field->ctx, &directions, OST_DIRECTIONS * (size_t)tet_count));
    for (int r = 0; r < field->region_count; r++) {
        along[2 * r + 1] = field->region_varies[r] && !ost_field_has_formula(field, r);
        any |= along[2 * r + 1];
    }
    if (!any)
        status =
            OST_RAISE(field->ctx, OST_INVALID_USAGE,
                      "axes at the vertices are for regions whose axes were given tet by tet (OST_AXES_CELLS), and "
                      "there is none");
    for (OstLocal t = 0; t < tet_count && status == OST_SUCCESS; t++)
        if (along[2 * field->tet_region[t] + 1])
            status = set_tet(field, t, axes + 36 * (size_t)t, directions + OST_DIRECTIONS * (size_t)t);
    if (status == OST_SUCCESS)
        ost_field_take_directions(field, &along, &directions);
done:
    OST_FREE(along, directions);
    return status;
}

OstStatus ost_field_set_vertex_axes(OstMaterialField *field, OstLocal tet_count, const double *axes)
{
    ost_ledger_enter(field->ctx, OST_EFFECT_VARYING_AXES);
    const OstStatus status = set_vertex_axes(field, tet_count, axes);
    ost_ledger_leave(field->ctx);
    return status;
}
