/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "mesh/check/check.h"
#include "mesh/refinement/divide.h"

static const int quadratic_item[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
static const Division raising = {{1, 10, quadratic_item},
                                 {{1, 1, quadratic_item}, {1, 3, quadratic_item}, {1, 6, quadratic_item}}};

OstStatus ost_mesh_raise_over(const MidNodes *mid, OstMesh **quadratic)
{
    return ost_mesh_divide(mid, &raising, NULL, quadratic, NULL);
}

static OstStatus raise_linear(const OstMesh *linear, const OstShapeSurface *shape, OstMesh **quadratic)
{
    if (linear->nodes_per_tet != 4)
        return OST_RAISE(linear->ctx, OST_INVALID_INPUT, "the mesh to raise has tets of %d nodes, expected 4",
                         linear->nodes_per_tet);
    MidNodes mid = {0};
    OstStatus status = ost_mid_nodes_create(linear, shape, &mid);
    OST_THEN(ost_mesh_raise_over(&mid, quadratic));
    ost_mid_nodes_clear(&mid);
    if (status == OST_SUCCESS && shape && shape->kind != OST_SURFACE_NONE)
        (*quadratic)->cut_off = (OstCutOff){0};
    if (status == OST_SUCCESS && shape)
        status = ost_check_folds(*quadratic);
    return status;
}

OstStatus ost_mesh_raise(const OstMesh *linear, const OstShapeSurface *shape, OstMesh **quadratic)
{
    *quadratic = NULL;
    ost_ledger_enter(linear->ctx, OST_LEDGER_MESH);
    const OstStatus status = raise_linear(linear, shape, quadratic);
    if (status != OST_SUCCESS)
        ost_mesh_destroy(quadratic);
    ost_ledger_leave(linear->ctx);
    return status;
}
