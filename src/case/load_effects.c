/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"

/* Boundaries of shapes consist of faces. Those of a file, and what a box or a plane selects, may be vertices alone:
 * only the mesh tells. */
OstEffect ost_load_effect(const OstCase *c, const OstLoad *load)
{
    switch (load->kind) {
    case OST_LOAD_GRAVITY:
    case OST_LOAD_BODY_FORCE:
        return OST_EFFECT_BODY_FORCE;
    case OST_LOAD_CENTRIFUGAL:
        return OST_EFFECT_CENTRIFUGAL;
    case OST_LOAD_MOMENT:
        return OST_EFFECT_MOMENT;
    case OST_LOAD_DISTRIBUTING:
        return OST_EFFECT_MOVED_COUPLING;
    case OST_LOAD_PRESSURE:
        return load->follows ? OST_EFFECT_FOLLOWER_PRESSURE : OST_EFFECT_SURFACE_LOAD;
    case OST_LOAD_TRACTION:
        return OST_EFFECT_SURFACE_LOAD;
    case OST_LOAD_POINT_FORCE:
        return OST_EFFECT_POINT_FORCE;
    case OST_LOAD_TOTAL_FORCE:
        break;
    }
    if (load->acts_at)
        return OST_EFFECT_MOMENT;
    if (load->share != OST_SHARE_AUTO)
        return load->share == OST_SHARE_FACES ? OST_EFFECT_SURFACE_LOAD : OST_EFFECT_POINT_FORCE;
    if (load->on.kind == OST_SELECT_VERTICES || load->on.kind == OST_SELECT_NEAREST)
        return OST_EFFECT_POINT_FORCE;
    return load->on.kind == OST_SELECT_BOUNDARY && c->mesh_kind < OST_MESH_FILE ? OST_EFFECT_SURFACE_LOAD
                                                                                : OST_EFFECT_END;
}

int ost_loads_need_mesh(const OstCase *c)
{
    for (int i = 0; i < c->load_count; i++)
        if (ost_load_effect(c, &c->loads[i]) == OST_EFFECT_END)
            return 1;
    return 0;
}

static OstStatus look_for_faces(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, OstEffect *effect)
{
    OstLocal count = 0;
    int nodes_per_face;
    OstLocal *faces = NULL;
    OST_TRY(ost_select_faces(c, mesh, selection, &count, &nodes_per_face, &faces));
    int any = count > 0;
    OST_FREE(faces);
    OST_TRY(OST_MPI(c->ctx, MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, ost_comm(c->ctx))));
    *effect = any ? OST_EFFECT_SURFACE_LOAD : OST_EFFECT_POINT_FORCE;
    return OST_SUCCESS;
}

OstStatus ost_load_effects(const OstCase *c, const OstMesh *mesh, OstEffect *effect)
{
    for (int i = 0; i < c->load_count; i++) {
        effect[i] = ost_load_effect(c, &c->loads[i]);
        if (effect[i] == OST_EFFECT_END)
            OST_TRY(look_for_faces(c, mesh, &c->loads[i].on, &effect[i]));
    }
    return OST_SUCCESS;
}
