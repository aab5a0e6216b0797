/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/plan.h"

#include "case/plan_parts.h"
#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void set(OstPlan *plan, OstPlanIndex effect, int on, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void set(OstPlan *plan, OstPlanIndex effect, int on, const char *format, ...)
{
    OstPlanEffect *entry = &plan->effect[effect];
    va_list arguments;
    va_start(arguments, format);
    entry->on = on;
    vsnprintf(entry->reason, sizeof entry->reason, format, arguments);
    va_end(arguments);
}

static void plan_materials(const OstPlanMaterials *m, OstPlan *plan)
{
    set(plan, OST_PLAN_ORTHOTROPY, m->orthotropic > 0, "%s", m->orthotropic_reason);
    set(plan, OST_PLAN_VARYING_AXES, m->varying > 0, "%s", m->varying_reason);
    if (m->gradient_region)
        set(plan, OST_PLAN_GRADIENT_AXES, 1, "axes of region '%.60s' follow potentials between boundaries",
            m->gradient_region);
    else
        set(plan, OST_PLAN_GRADIENT_AXES, 0, "no axes are given by gradients");
    if (m->count > 1)
        set(plan, OST_PLAN_REGIONS, 1, "%d materials", m->count);
    else
        set(plan, OST_PLAN_REGIONS, 0, "one material for the whole body");
}

static void plan_constraints(const OstCase *c, OstPlan *plan)
{
    int moved = 0;
    int slides = 0;
    for (int i = 0; i < c->constraint_count; i++) {
        const OstConstraint *constraint = &c->constraints[i];
        const double *u = constraint->displacement;
        slides += constraint->kind == OST_CONSTRAIN_SLIDE;
        const int exact = constraint->exact[0] || constraint->exact[1] || constraint->exact[2];
        moved += constraint->kind == OST_CONSTRAIN_DISPLACEMENT && (exact || u[0] != 0.0 || u[1] != 0.0 || u[2] != 0.0);
    }
    if (moved > 0)
        set(plan, OST_PLAN_GIVEN_DISPLACEMENT, 1, "%d of %d constraints give a displacement other than zero", moved,
            c->constraint_count);
    else
        set(plan, OST_PLAN_GIVEN_DISPLACEMENT, 0,
            c->constraint_count > 0 ? "every constraint is zero" : "there is no constraint");
    if (slides > 0)
        set(plan, OST_PLAN_SLIDING, 1, "%d of %d constraints let the body slide on a plane", slides,
            c->constraint_count);
    else
        set(plan, OST_PLAN_SLIDING, 0, "no constraint is a slide");
}

/* A total force without a share goes over faces if the selection has any, which only the mesh knows; the boundaries of
 * shapes are faces. */
static int may_be_faces(const OstLoad *load)
{
    if (load->kind == OST_LOAD_TRACTION || load->kind == OST_LOAD_PRESSURE)
        return 1;
    return load->kind == OST_LOAD_TOTAL_FORCE && load->share != OST_SHARE_VERTICES;
}

static int may_be_points(const OstCase *c, const OstLoad *load)
{
    if (load->kind == OST_LOAD_POINT_FORCE)
        return 1;
    if (load->kind != OST_LOAD_TOTAL_FORCE || load->share == OST_SHARE_FACES)
        return 0;
    return load->share == OST_SHARE_VERTICES || c->mesh_kind >= OST_MESH_FILE || load->on.kind != OST_SELECT_BOUNDARY;
}

static void plan_loads(const OstCase *c, OstPlan *plan)
{
    int points = 0, faces = 0, either = 0, volumes = 0, gravity = 0;
    for (int i = 0; i < c->load_count; i++) {
        const OstLoad *load = &c->loads[i];
        points += may_be_points(c, load);
        faces += may_be_faces(load);
        either += may_be_faces(load) && may_be_points(c, load);
        gravity += load->kind == OST_LOAD_GRAVITY;
        volumes += load->kind == OST_LOAD_GRAVITY || load->kind == OST_LOAD_BODY_FORCE;
    }
    const char *none = c->load_count == 0 ? "there is no load" : NULL;
    if (points > either)
        set(plan, OST_PLAN_POINT_FORCE, 1, "%d of %d loads act on vertices", points, c->load_count);
    else if (points > 0)
        set(plan, OST_PLAN_POINT_FORCE, 1, "a total force acts on vertices if its selection has no whole face");
    else
        set(plan, OST_PLAN_POINT_FORCE, 0, "%s", none ? none : "no load acts on vertices");
    if (faces > either)
        set(plan, OST_PLAN_SURFACE_LOAD, 1, "%d of %d loads act on faces", faces, c->load_count);
    else if (faces > 0)
        set(plan, OST_PLAN_SURFACE_LOAD, 1, "a total force acts on faces if its selection has any");
    else
        set(plan, OST_PLAN_SURFACE_LOAD, 0, "%s", none ? none : "no load acts on faces");
    if (volumes > 0)
        set(plan, OST_PLAN_BODY_FORCE, 1, "%d of %d loads act in the volume%s", volumes, c->load_count,
            gravity > 0 ? ", gravity among them" : "");
    else
        set(plan, OST_PLAN_BODY_FORCE, 0, "%s", none ? none : "no load acts in the volume");
}

void ost_plan_make(const OstCase *c, OstGlobal nodes, OstGlobal tets, const OstFileMaterials *materials, int ranks,
                   OstPlan *plan)
{
#define EFFECT_LABEL(name, text, account) plan->effect[name].label = text;
    OstPlanMaterials in_use;
    memset(plan, 0, sizeof *plan);
    OST_EFFECT_TABLE(EFFECT_LABEL)
#undef EFFECT_LABEL
    ost_plan_materials(c, materials, &in_use);
    plan_materials(&in_use, plan);
    plan_constraints(c, plan);
    plan_loads(c, plan);
    plan->nodes = nodes;
    plan->tets = tets;
    plan->unknowns = 3 * nodes;
    plan->facts = in_use.facts;
    plan->facts.unknowns = plan->unknowns;
    ost_solver_plan(&c->solver, &plan->facts, &plan->solver);
    ost_plan_memory(c, ranks, plan);
}

static OstGlobal bounded(double count)
{
    return count < (double)OST_PLAN_MOST ? (OstGlobal)count : OST_PLAN_MOST;
}

/* Doubles hold all counts that are of use exactly, and no product of divisions is too large for them. */
void ost_plan_shape_size(const OstCase *c, OstGlobal *nodes, OstGlobal *tets)
{
    /* A refinement doubles a shape's divisions, and so does, for the nodes, a node on every edge. */
    const double fine = (double)(1 << c->refinement);
    const double nodal = c->order == 2 ? 2.0 * fine : fine;
    const OstTubeShape *tube = &c->tube;
    const OstSectorShape *sector = &c->sector;
    const double around = c->octant.around;
    const OstLocal *n = c->block.divisions;
    double points = 0.0, cells = 0.0;
    if (c->mesh_kind == OST_MESH_TUBE) {
        points = (nodal * tube->axial + 1.0) * nodal * tube->around * (nodal * tube->radial + 1.0);
        cells = (double)tube->axial * tube->around * tube->radial;
    } else if (c->mesh_kind == OST_MESH_SECTOR) {
        points = (nodal * sector->axial + 1.0) * (nodal * sector->around + 1.0) * (nodal * sector->radial + 1.0);
        cells = (double)sector->axial * sector->around * sector->radial;
    } else if (c->mesh_kind == OST_MESH_OCTANT) {
        points = (3.0 * nodal * around * (nodal * around + 1.0) + 1.0) * (nodal * c->octant.radial + 1.0);
        cells = 3.0 * around * around * c->octant.radial;
    } else if (c->mesh_kind == OST_MESH_BLOCK) {
        points = (nodal * n[0] + 1.0) * (nodal * n[1] + 1.0) * (nodal * n[2] + 1.0);
        cells = (double)n[0] * n[1] * n[2];
    }
    *nodes = bounded(points);
    *tets = bounded(6.0 * cells * fine * fine * fine);
}

OstStatus ost_plan_check_size(const OstCase *c, OstGlobal nodes)
{
    const OstGlobal most = INT32_MAX / 3;
    if (c->mesh_kind == OST_MESH_FROM_PROGRAM)
        return ost_case_located(c, c->mesh_place,
                                OST_RAISE(c->ctx, OST_INVALID_INPUT,
                                          "the case leaves its mesh to a program (ost_scene_create_on), and there is "
                                          "none here; name a shape or a file"));
    if (nodes <= most)
        return OST_SUCCESS;
    return OST_RAISE(c->ctx, OST_LIMIT_EXCEEDED,
                     "%s: %s%lld nodes have three unknowns each; Epetra and ML number at most 2^31 - 1 over all ranks, "
                     "which is %lld nodes: use a coarser mesh",
                     c->path, nodes == OST_PLAN_MOST ? "more than " : "", (long long)nodes, (long long)most);
}

void ost_plan_file_size(const OstCase *c, int nodes_per_tet, OstGlobal *nodes, OstGlobal *tets)
{
    /* A tet mesh has about 7/6 edges a tet; a refinement or a rise in order puts a node on each, a refinement of
     * quadratic tets is one of its vertices, raised. */
    int quadratic = nodes_per_tet == 10;
    if (quadratic)
        *nodes -= 7 * *tets / 6;
    for (int r = 0; r < c->refinement; r++) {
        *nodes = bounded((double)*nodes + 7.0 * (double)*tets / 6.0);
        *tets = bounded(8.0 * (double)*tets);
    }
    if (c->order != 0)
        quadratic = c->order == 2;
    if (quadratic)
        *nodes = bounded((double)*nodes + 7.0 * (double)*tets / 6.0);
}

int ost_plan_acts(const OstCase *c, const OstPlan *plan)
{
    return c->load_count > 0 || plan->effect[OST_PLAN_GIVEN_DISPLACEMENT].on;
}
