/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/boundary_conditions.h"

#include "assembly/springs.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/free_body.h"
#include "problem/scene_links.h"

#include <stdio.h>
#include <string.h>

/* Of a load, this share on unconstrained displacements is rounding. */
static const double no_load = 1e-12;

/* Puts "case.yaml:12: " in front of an error text, unless it names the case already. */
static OstStatus at_line(const OstCase *c, int line, OstStatus status)
{
    char text[2048];
    if (status == OST_SUCCESS || strncmp(ost_error_text(c->ctx), c->path, strlen(c->path)) == 0)
        return status;
    snprintf(text, sizeof text, "%s", ost_error_text(c->ctx));
    return OST_RAISE(c->ctx, status, "%s:%d: %s", c->path, line, text);
}

/* Only a verify run knows the closed-form solution that `exact` stands for. */
static OstStatus need_closed_form(const OstScene *scene)
{
    if (scene->exact)
        return OST_SUCCESS;
    return OST_RAISE(
        scene->ctx, OST_INVALID_INPUT,
        "'exact' stands for the formula of the case's verify section, which only `orthostat verify` computes; "
        "give numbers, or run the case by that command");
}

/* The displacement that a constraint prescribes at a node: its own numbers, or the formula's. */
static OstStatus prescribed_displacement(const OstScene *scene, const OstConstraint *constraint, OstLocal node,
                                         double prescribed[3])
{
    memcpy(prescribed, constraint->displacement, sizeof constraint->displacement);
    if (!constraint->exact[0] && !constraint->exact[1] && !constraint->exact[2])
        return OST_SUCCESS;
    double u[3];
    OST_TRY(need_closed_form(scene));
    OST_TRY(scene->exact->displacement(scene->exact->data, scene->mesh->coordinates + 3 * (size_t)node, u));
    for (int i = 0; i < 3; i++)
        prescribed[i] = constraint->exact[i] ? u[i] : prescribed[i];
    return OST_SUCCESS;
}

static OstStatus constrain_node(const OstScene *scene, const OstConstraint *constraint, int table, OstLocal node,
                                OstSupports *supports)
{
    const double factor = constraint->table == table ? 1.0 : 0.0;
    double prescribed[3];
    if (constraint->kind == OST_CONSTRAIN_SLIDE)
        return ost_supports_constrain(supports, node, constraint->normal, 0.0);
    OST_TRY(prescribed_displacement(scene, constraint, node, prescribed));
    for (int component = 0; component < 3; component++) {
        double direction[3] = {0.0};
        direction[component] = 1.0;
        if (constraint->constrained[component])
            OST_TRY(ost_supports_constrain(supports, node, direction, factor * prescribed[component]));
    }
    return OST_SUCCESS;
}

/* Each table's displacements are prescribed alone, with zeros where others act: what differs may be the tables. */
static OstStatus blame_tables(const OstScene *scene, OstStatus status)
{
    const OstCase *c = scene->c;
    char text[OST_ERROR_TEXT_SIZE];
    int several = 0;
    for (int i = 1; i < c->constraint_count; i++)
        several |= c->constraints[i].table != c->constraints[0].table;
    if (status != OST_INVALID_INPUT || !several)
        return status;
    snprintf(text, sizeof text, "%s", ost_error_text(scene->ctx));
    return OST_RAISE(scene->ctx, status,
                     "%s (a displacement counts as 0 beside one that follows another time table: where two meet, give "
                     "both the same table)",
                     text);
}

static OstStatus add_constraint(const OstScene *scene, const OstConstraint *constraint, int table,
                                OstSupports *supports)
{
    const OstAccount account = constraint->kind == OST_CONSTRAIN_SLIDE ? OST_EFFECT_SLIDING : OST_LEDGER_SUPPORTS;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &constraint->on, &count, &nodes));
    ost_ledger_enter(scene->ctx, account);
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++)
        if (nodes[i] < scene->mesh->owned_nodes)
            status = blame_tables(scene, constrain_node(scene, constraint, table, nodes[i], supports));
    status = ost_agree(scene->ctx, at_line(scene->c, constraint->line, status));
    ost_ledger_leave(scene->ctx);
    OST_FREE(nodes);
    return status;
}

/* The faces of a selection; refuses none at all. */
static OstStatus select_faces(const OstScene *scene, const OstSelection *on, OstLocal *count, int *nodes_per_face,
                              OstLocal **faces, double *area)
{
    OST_TRY(ost_select_faces(scene->c, scene->mesh, on, count, nodes_per_face, faces));
    OST_TRY(ost_faces_area(scene->mesh, *count, *faces, *nodes_per_face, area));
    if (*area > 0.0)
        return OST_SUCCESS;
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                     "the selection holds no whole face of the body's surface, and this acts on faces; select a named "
                     "surface, or widen the selection");
}

/* Does a selection get nodes from `order: 2` or refinement? Boundaries of points do not. */
static int grows(const OstScene *scene, const OstSelection *on)
{
    int more = on->kind != OST_SELECT_VERTICES && on->kind != OST_SELECT_NEAREST && on->kind != OST_SELECT_BOUNDARY;
    for (int n = 0; on->kind == OST_SELECT_BOUNDARY && n < on->boundaries.count; n++) {
        const int number = ost_mesh_find_boundary(scene->mesh, on->boundaries.name[n]);
        more |= number >= 0 && scene->mesh->boundaries[number].dimension > 0;
    }
    return more && (scene->mesh->nodes_per_tet == 10 || scene->c->refinement > 0);
}

/* Warns of what acts on each node where the mesh decides how many there are. */
static OstStatus warn_of_each(const OstScene *scene, const OstSelection *on, int line, const char *what,
                              const char *instead, OstLocal count, const OstLocal *nodes)
{
    double all = 0.0;
    for (OstLocal i = 0; i < count; i++)
        all += nodes[i] < scene->mesh->owned_nodes;
    OST_TRY(ost_sum(scene->ctx, 1, &all));
    if (all > 1.0 && grows(scene, on))
        ost_warn(scene->ctx,
                 "%s:%d: %s acts on each node that is selected, %.0f here with those that quadratic tets or refinement "
                 "have added; another mesh has more or fewer, and another sum. Use %s, or name the vertices (vertices: "
                 "[...])",
                 scene->c->path, line, what, all, instead);
    return OST_SUCCESS;
}

/* Adds the springs of the case's entry to the selected nodes, or faces. */
static OstStatus add_springs(const OstScene *scene, const OstSpring *spring, OstLocal count, const OstLocal *selected,
                             int nodes_per_face, OstSupports *supports)
{
    OstSpringStiffness stiffness = {.along = spring->along, .across = spring->across};
    memcpy(stiffness.direction, spring->direction, sizeof stiffness.direction);
    OST_TRY(ost_agree(scene->ctx, ost_supports_allow_springs(supports)));
    if (spring->kind == OST_SPRING_POINT)
        OST_TRY(warn_of_each(scene, &spring->on, spring->line, "a spring", "foundation (stiffness by area)", count,
                             selected));
    if (spring->kind == OST_SPRING_FOUNDATION)
        OST_TRY(
            ost_agree(scene->ctx, ost_supports_add_foundation(supports, count, selected, nodes_per_face, &stiffness)));
    for (OstLocal i = 0; i < count && spring->kind == OST_SPRING_POINT; i++)
        if (selected[i] < scene->mesh->owned_nodes)
            ost_supports_add_spring(supports, selected[i], &stiffness);
    return OST_SUCCESS;
}

static OstStatus add_spring(const OstScene *scene, const OstSpring *spring, OstSupports *supports)
{
    const OstEffect effect = spring->kind == OST_SPRING_FOUNDATION ? OST_EFFECT_FOUNDATION : OST_EFFECT_SPRINGS;
    OstLocal count = 0;
    OstLocal *selected = NULL;
    int nodes_per_face = 3;
    double area = 0.0;
    if (!ost_effect_on(&scene->plan.effects, effect))
        return OST_SUCCESS;
    OstStatus status = effect == OST_EFFECT_FOUNDATION
                           ? select_faces(scene, &spring->on, &count, &nodes_per_face, &selected, &area)
                           : ost_select_nodes(scene->c, scene->mesh, &spring->on, &count, &selected);
    ost_ledger_enter(scene->ctx, effect);
    OST_THEN(add_springs(scene, spring, count, selected, nodes_per_face, supports));
    ost_ledger_leave(scene->ctx);
    OST_FREE(selected);
    return at_line(scene->c, spring->line, status);
}

OstStatus ost_scene_supports(const OstScene *scene, int table, OstSupports **supports)
{
    if (ost_effect_on(&scene->plan.effects, OST_EFFECT_FREE_BODY))
        return ost_free_body_supports(scene->mesh, &scene->plan.effects, supports);
    OstStatus status = ost_agree(scene->ctx, ost_supports_create(scene->mesh, supports));
    if (status == OST_SUCCESS)
        (*supports)->effects = &scene->plan.effects;
    for (int i = 0; i < scene->c->constraint_count && status == OST_SUCCESS; i++)
        if (!ost_constraint_links(&scene->c->constraints[i]))
            status = add_constraint(scene, &scene->c->constraints[i], table, *supports);
    OST_THEN(ost_scene_links(scene, table, *supports));
    for (int i = 0; i < scene->c->spring_count && status == OST_SUCCESS; i++)
        status = add_spring(scene, &scene->c->springs[i], *supports);
    if (status == OST_SUCCESS)
        status = at_line(scene->c, 1, ost_supports_complete(*supports));
    if (status != OST_SUCCESS)
        ost_supports_destroy(supports);
    return status;
}

static OstStatus find_load_region(const OstScene *scene, const OstLoad *load, int *region)
{
    *region = -1;
    if (!load->region)
        return OST_SUCCESS;
    *region = ost_mesh_find_region(scene->mesh, load->region);
    if (*region >= 0)
        return OST_SUCCESS;
    return ost_raise_no_region(scene->c, load->region_place, &scene->mesh->regions, load->region);
}

/* Gravity without any mass is an error, not a load of zero; so is a centrifugal load. */
static OstStatus check_density(const OstScene *scene, const OstLoad *load, int region)
{
    for (int r = 0; r < scene->mesh->regions.count; r++)
        if ((region < 0 || r == region) && scene->field->material[r].density > 0.0)
            return OST_SUCCESS;
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                     "%s acts on mass, but no material it acts on has a density; add density to the material",
                     load->kind == OST_LOAD_GRAVITY ? "gravity" : "a centrifugal load");
}

OstSpin ost_load_spin(const OstLoad *load)
{
    OstSpin spin = {.speed = load->speed};
    memcpy(spin.origin, load->origin, sizeof spin.origin);
    memcpy(spin.axis, load->axis, sizeof spin.axis);
    return spin;
}

static OstStatus add_body_load(const OstScene *scene, const OstLoad *load, double *force)
{
    int region = -1;
    OST_TRY(find_load_region(scene, load, &region));
    if (load->exact) {
        OST_TRY(need_closed_form(scene));
        return ost_load_closed_form_body_force(scene->mesh, region, scene->exact, force);
    }
    if (load->kind == OST_LOAD_BODY_FORCE)
        return ost_load_body_force(scene->mesh, region, load->vector, force);
    OST_TRY(check_density(scene, load, region));
    if (load->kind == OST_LOAD_CENTRIFUGAL) {
        const OstSpin spin = ost_load_spin(load);
        return ost_load_centrifugal(scene->mesh, scene->field, region, &spin, force);
    }
    return ost_load_gravity(scene->mesh, scene->field, region, load->vector, force);
}

static OstStatus add_vertex_load(const OstScene *scene, const OstLoad *load, double *force)
{
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &load->on, &count, &nodes));
    OstStatus status = OST_SUCCESS;
    if (load->kind == OST_LOAD_POINT_FORCE) {
        status = warn_of_each(scene, &load->on, load->line, "a point_force", "total_force", count, nodes);
        OST_THEN(ost_agree(scene->ctx, ost_load_point_force(scene->mesh, count, nodes, load->vector, force)));
    } else
        status = ost_load_shared_force(scene->mesh, count, nodes, load->vector, force);
    OST_FREE(nodes);
    return status;
}

static OstStatus add_face_load(const OstScene *scene, const OstLoad *load, OstLocal count, int nodes_per_face,
                               const OstLocal *faces, double area, double *force)
{
    const OstMesh *mesh = scene->mesh;
    if (load->exact) {
        OST_TRY(need_closed_form(scene));
        return ost_agree(scene->ctx,
                         ost_load_closed_form_traction(mesh, count, faces, nodes_per_face, scene->exact, force));
    }
    if (load->kind == OST_LOAD_PRESSURE)
        return ost_agree(scene->ctx, ost_load_pressure(mesh, count, faces, nodes_per_face, load->pressure, force));
    double traction[3];
    for (int i = 0; i < 3; i++)
        traction[i] = load->kind == OST_LOAD_TOTAL_FORCE ? load->vector[i] / area : load->vector[i];
    return ost_agree(scene->ctx, ost_load_traction(mesh, count, faces, nodes_per_face, traction, force));
}

static OstStatus add_surface_load(const OstScene *scene, const OstLoad *load, double *force, OstFollower **follower)
{
    OstLocal count = 0;
    OstLocal *faces = NULL;
    int nodes_per_face = 3;
    double area = 0.0;
    OstStatus status = select_faces(scene, &load->on, &count, &nodes_per_face, &faces, &area);
    if (status == OST_SUCCESS && load->follows)
        status = ost_agree(scene->ctx, ost_follower_add(scene->mesh, count, faces, nodes_per_face, load->pressure,
                                                        load->table, follower));
    else if (status == OST_SUCCESS)
        status = add_face_load(scene, load, count, nodes_per_face, faces, area, force);
    OST_FREE(faces);
    return status;
}

static OstResultant resultant_of(const OstScene *scene, const OstLoad *load, int function)
{
    OstResultant resultant = {.acts_at = load->acts_at};
    if (load->kind == OST_LOAD_DISTRIBUTING) {
        const OstDrive *drive = ost_scene_drive(scene, function, (int)(load - scene->c->loads));
        memcpy(resultant.force, drive->of_point, sizeof resultant.force);
        memcpy(resultant.moment, drive->of_point + 3, sizeof resultant.moment);
    } else
        memcpy(load->kind == OST_LOAD_MOMENT ? resultant.moment : resultant.force, load->vector, sizeof load->vector);
    memcpy(resultant.at, load->at, sizeof load->at);
    return resultant;
}

OstStatus ost_scene_spread(const OstScene *scene, const OstLoad *load, int function, int *on_faces, OstLocal *count,
                           int *nodes_per_face, OstLocal **faces, OstSpread *spread)
{
    const OstResultant resultant = resultant_of(scene, load, function);
    *on_faces = 0;
    if (load->share == OST_SHARE_VERTICES)
        return OST_SUCCESS;
    OST_TRY(ost_select_faces(scene->c, scene->mesh, &load->on, count, nodes_per_face, faces));
    *on_faces = *count > 0 || load->share == OST_SHARE_FACES;
    OST_TRY(ost_max_ints(scene->ctx, 1, on_faces));
    if (!*on_faces)
        return OST_SUCCESS;
    OST_TRY(ost_spread_over_faces(scene->mesh, *count, *faces, *nodes_per_face, &resultant, spread));
    if (load->kind != OST_LOAD_DISTRIBUTING)
        return OST_SUCCESS;
    const OstDrive *drive = ost_scene_drive(scene, function, (int)(load - scene->c->loads));
    for (int i = 0; i < 3; i++)
        spread->mean[i] += drive->mean[i];
    memcpy(spread->gradient, drive->gradient, sizeof spread->gradient);
    return OST_SUCCESS;
}

static OstStatus add_moment_on_vertices(const OstScene *scene, const OstLoad *load, double *force)
{
    const OstResultant resultant = resultant_of(scene, load, 0);
    OstSpread spread;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &load->on, &count, &nodes));
    const OstStatus status = ost_spread_over_vertices(scene->mesh, count, nodes, &resultant, &spread);
    if (status == OST_SUCCESS)
        ost_load_spread_on_vertices(scene->mesh, count, nodes, &spread, force);
    OST_FREE(nodes);
    return status;
}

static OstStatus add_moment(const OstScene *scene, const OstLoad *load, double *force)
{
    OstLocal count = 0;
    OstLocal *faces = NULL;
    int on_faces = 0, nodes_per_face = 3;
    OstSpread spread;
    const OstStatus status = ost_scene_spread(scene, load, 0, &on_faces, &count, &nodes_per_face, &faces, &spread);
    if (status == OST_SUCCESS && on_faces)
        ost_load_spread_on_faces(scene->mesh, count, faces, nodes_per_face, &spread, force);
    OST_FREE(faces);
    return status != OST_SUCCESS || on_faces ? status : add_moment_on_vertices(scene, load, force);
}

static OstStatus add_load(const OstScene *scene, const OstLoad *load, OstEffect effect, double *force,
                          OstFollower **follower)
{
    OstStatus status;
    ost_ledger_enter(scene->ctx, effect);
    if (effect == OST_EFFECT_BODY_FORCE || effect == OST_EFFECT_CENTRIFUGAL)
        status = ost_agree(scene->ctx, add_body_load(scene, load, force));
    else if (effect == OST_EFFECT_SURFACE_LOAD || effect == OST_EFFECT_FOLLOWER_PRESSURE)
        status = add_surface_load(scene, load, force, follower);
    else if (effect == OST_EFFECT_MOMENT || effect == OST_EFFECT_MOVED_COUPLING)
        status = add_moment(scene, load, force);
    else
        status = add_vertex_load(scene, load, force);
    ost_ledger_leave(scene->ctx);
    return at_line(scene->c, load->line, status);
}

static int is_zero(const OstLoad *load)
{
    return !load->exact && load->pressure == 0.0 && load->speed == 0.0 && ost_norm3(load->vector) == 0.0;
}

/* A load that does nothing, where nothing says that it is meant to: no load case, no sweep over loads, no --set. */
static void check_zero(const OstScene *scene, const OstLoad *load)
{
    const OstCase *c = scene->c;
    int meant = load->chosen || !is_zero(load);
    for (int k = 0; k < c->sweep_count; k++)
        meant |= strncmp(c->sweep[k].key, "loads", 5) == 0;
    if (!meant)
        ost_warn(c->ctx, "%s:%d: this load is zero, and does nothing; give it a size, or leave it out", c->path,
                 load->line);
}

/* Warns if the supports take up the whole of one load. */
static OstStatus check_strains(const OstScene *scene, const OstSupports *supports, const OstLoad *load,
                               const double *force)
{
    double squares[2] = {0.0}; /* of the load, and of what the supports leave of it */
    for (OstLocal node = 0; node < scene->mesh->owned_nodes; node++) {
        const double *of_node = force + 3 * (size_t)node;
        double projector[9], left[3] = {of_node[0], of_node[1], of_node[2]};
        if (ost_supports_get(supports, node, projector, NULL) > 0)
            ost_apply3(projector, of_node, left);
        squares[0] += ost_dot3(of_node, of_node);
        squares[1] += ost_dot3(left, left);
    }
    OST_TRY(ost_sum(scene->ctx, 2, squares));
    if (squares[0] > 0.0 && squares[1] <= no_load * no_load * squares[0])
        ost_warn(scene->ctx,
                 "%s:%d: this load acts on constrained displacements alone: the supports take it up, and it strains "
                 "nothing; load other vertices, or constrain less",
                 scene->c->path, load->line);
    return OST_SUCCESS;
}

/* Adds one load, which is first collected by itself where it is to be looked at. */
static OstStatus add_checked_load(const OstScene *scene, int i, const OstSupports *supports, double *force,
                                  OstFollower **follower)
{
    const OstLoad *load = &scene->c->loads[i];
    const size_t n = 3 * (size_t)scene->mesh->node_count;
    double *own = NULL;
    check_zero(scene, load);
    OstStatus status = ost_agree(scene->ctx, OST_NEW(scene->ctx, &own, n));
    OST_THEN(add_load(scene, load, scene->load_effect[i], own, follower));
    OST_THEN(check_strains(scene, supports, load, own));
    for (size_t k = 0; k < n && status == OST_SUCCESS; k++)
        force[k] += own[k];
    OST_FREE(own);
    return status;
}

OstStatus ost_scene_load(const OstScene *scene, int number, double *force)
{
    return add_load(scene, &scene->c->loads[number], scene->load_effect[number], force, NULL);
}

OstStatus ost_scene_loads(const OstScene *scene, int table, const OstSupports *supports, double *force,
                          OstFollower **follower)
{
    for (int i = 0; i < scene->c->load_count; i++)
        if (scene->c->loads[i].kind != OST_LOAD_DISTRIBUTING && scene->c->loads[i].table == table &&
            ost_effect_on(&scene->plan.effects, scene->load_effect[i]))
            OST_TRY(supports ? add_checked_load(scene, i, supports, force, follower)
                             : add_load(scene, &scene->c->loads[i], scene->load_effect[i], force, follower));
    return OST_SUCCESS;
}
