/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "mesh/misfit.h"
#include "problem/scene_parts.h"

/* Vertices of tied faces, on either side. */
static OstStatus flag_tied(const OstCase *c, const OstMesh *mesh, unsigned char *tied)
{
    for (int i = 0; i < c->constraint_count; i++) {
        const OstConstraint *constraint = &c->constraints[i];
        const OstSelection *side[2] = {&constraint->on, &constraint->to};
        for (int s = 0; s < 2 && constraint->kind == OST_CONSTRAIN_TIED; s++) {
            unsigned char *flags = NULL;
            OST_TRY(ost_select_flags(c, mesh, side[s], &flags));
            for (OstLocal n = 0; n < mesh->node_count; n++)
                tied[n] |= flags[n];
            OST_FREE(flags);
        }
    }
    return OST_SUCCESS;
}

static void tell(const OstCase *c, const OstMesh *mesh, const OstMisfits *misfits)
{
    char cells[2][OST_CELL_WORDS];
    if (misfits->faces > 0)
        ost_warn(c->ctx,
                 "%s: %lld faces of tets lie on faces of others without fitting them, from (%g, %g, %g) to (%g, %g, "
                 "%g): their vertices differ, as of tet %lld%s on tet %lld%s. There the body may open: only vertices "
                 "in common hold it together. Make a mesh whose neighbours share whole faces, or join parts by "
                 "tied_to",
                 c->path, (long long)misfits->faces, misfits->low[0], misfits->low[1], misfits->low[2],
                 misfits->high[0], misfits->high[1], misfits->high[2], (long long)misfits->tet,
                 ost_cell_words(mesh, misfits->tet, cells[0]), (long long)misfits->neighbour,
                 ost_cell_words(mesh, misfits->neighbour, cells[1]));
    if (misfits->cracked > 0)
        ost_log(c->ctx, OST_LOG_NORMAL,
                "%s: %lld faces lie on others that have vertices of their own at the same places, as on the two sides "
                "of a crack; mesh: {merge: DISTANCE} joins them",
                c->path, (long long)misfits->cracked);
}

OstStatus ost_scene_check_fit(const OstCase *c, const OstMesh *mesh)
{
    unsigned char *tied = NULL;
    OstMisfits misfits;
    if (c->mesh_kind != OST_MESH_FILE && c->mesh_kind != OST_MESH_FROM_PROGRAM)
        return OST_SUCCESS;
    OST_TRY(ost_agree(c->ctx, OST_NEW(c->ctx, &tied, mesh->node_count)));
    OstStatus status = flag_tied(c, mesh, tied);
    OST_THEN(ost_mesh_find_misfits(mesh, tied, &misfits));
    OST_FREE(tied);
    if (status == OST_SUCCESS)
        tell(c, mesh, &misfits);
    return status;
}
