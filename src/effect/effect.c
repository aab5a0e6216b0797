/* SPDX-License-Identifier: BSD-3-Clause */
#include "effect/effect.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

_Static_assert((int)OST_EFFECT_END <= (int)OST_LEDGER_ACCOUNTS, "the ledger has no room for so many effects");

static void on(OstEffectState *state, double bytes, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void on(OstEffectState *state, double bytes, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    state->on = 1;
    state->bytes = bytes;
    vsnprintf(state->reason, sizeof state->reason, format, arguments);
    va_end(arguments);
}

static void off(OstEffectState *state, const char *reason)
{
    state->on = 0;
    state->bytes = 0.0;
    snprintf(state->reason, sizeof state->reason, "%s", reason);
}

/* The material metric of each node, for multigrid; the axes of each region. */
static void orthotropy(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->orthotropic > 0)
        on(state, 48.0 * f->nodes + 72.0 * f->regions, "%s", f->orthotropic_reason);
    else
        off(state, "every material is isotropic");
}

/* Four numbers a tet; sixty in single precision where axes follow directions within quadratic tets. */
static void varying_axes(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->varying > 0)
        on(state, (f->quadratic && f->directions > 0 ? 272.0 : 32.0) * f->tets, "%s", f->varying_reason);
    else
        off(state, f->orthotropic > 0 ? "the axes are uniform in each region" : "an isotropic body needs no axes");
}

/* The stiffness of linear tets on the same vertices: a block of 76 bytes for each vertex and two for each edge. */
static double matrix_bytes(const OstEffectFacts *f)
{
    return 76.0 * (f->vertices + 2.0 * f->edges);
}

/* The axes; and matrix and multigrid hierarchy of the potentials, which are solved for like displacements, on the nodes
 * of quadratic tets themselves: measured. */
static void gradient_axes(const OstEffectFacts *f, OstEffectState *state)
{
    const double potentials = f->quadratic ? 4000.0 * f->nodes : 600.0 * f->vertices + 2.5 * matrix_bytes(f);
    if (f->gradient_region)
        on(state, 112.0 * f->tets + potentials, "axes of region '%.60s' follow potentials between boundaries",
           f->gradient_region);
    else
        off(state, "no axes are given by gradients");
}

/* The constants of each region, its stiffness and compliance in material axes, and its stiffness in world axes. */
static void several_materials(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->modulus_region)
        on(state, 8.0 * (128.0 * f->regions + f->tets), "the modulus of region '%.60s' differs from tet to tet",
           f->modulus_region);
    else if (f->materials > 1)
        on(state, 8.0 * 128.0 * f->regions, "%d materials", f->materials);
    else
        off(state, "one material for the whole body");
}

/* What these three take is given back before the stiffness is made. */
static void joined_vertices(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->merge > 0.0)
        on(state, 0.0, "the case says so: vertices no farther apart than %g become one", f->merge);
    else
        off(state, "the case does not say merge");
}

static void whole(const OstEffectFacts *f, OstEffectState *state, int any, const char *why, const char *why_not)
{
    if (f->ranks < 2)
        off(state, "one rank holds the whole body");
    else if (any)
        on(state, 0.0, "%s", why);
    else
        off(state, why_not);
}

static void close_nodes(const OstEffectFacts *f, OstEffectState *state)
{
    whole(f, state, f->close_welded, "edges of a tet differ more than fourfold: nodes that are close stay on one rank",
          "no tet has edges that differ more than fourfold");
}

static void whole_inclusions(const OstEffectFacts *f, OstEffectState *state)
{
    whole(f, state, f->stiff_welded, "moduli differ by a ratio of more than 10,000: stiff inclusions stay on one rank",
          "no tet is 10,000 times stiffer than another");
}

/* Does a constraint make nodes follow others? */
static int has_links(const OstEffectFacts *f)
{
    return f->rigid_faces + f->ties + f->periodic > 0;
}

static const char free_is_linear[] = "a free body is solved linearly";

static const char *why_linear(const OstEffectFacts *f)
{
    return f->free_body ? free_is_linear : NULL;
}

/* Why the mixed form is not used, or NULL. */
static const char *why_not_mixed(const OstEffectFacts *f)
{
    if (f->nearly_incompressible == 0)
        return "no material is nearly incompressible";
    if (!f->quadratic)
        return "linear tets cannot use it";
    if (f->without >> (OST_EFFECT_MIXED - OST_EFFECT_FIRST) & 1U)
        return "left out";
    if (f->mixed == 0)
        return "the case says so: element: {mixed: off}";
    if (f->large_rotation == 2 && f->classical && !f->free_body)
        return "formulation: classical uses the mean dilatation";
    return NULL;
}

int ost_effects_mixed(const OstEffectFacts *facts)
{
    return why_not_mixed(facts) == NULL;
}

/* A pressure for each vertex with its couplings: to 65 nodes (three numbers and a column), from which those of linked
 * faces are made anew, and to 15 vertices; the pressures of each tet. */
static void mixed(const OstEffectFacts *f, OstEffectState *state)
{
    const char *why = why_not_mixed(f);
    if (why)
        off(state, why);
    else
        on(state, ((has_links(f) ? 2.0 : 1.0) * 65.0 * 28.0 + 15.0 * 12.0 + 50.0) * f->vertices + 48.0 * f->tets,
           "quadratic tets, and %d of %d materials are nearly incompressible: their pressure is an unknown of its own",
           f->nearly_incompressible, f->materials);
}

static void mean_dilatation(const OstEffectFacts *f, OstEffectState *state)
{
    if (!why_not_mixed(f))
        off(state, "the mixed form takes its place");
    else if (f->quadratic && f->nearly_incompressible > 0)
        on(state, 8.0 * (36.0 + 3.0) * f->regions, "quadratic tets, and %d of %d materials are nearly incompressible",
           f->nearly_incompressible, f->materials);
    else
        off(state, f->nearly_incompressible > 0 ? "linear tets do not use it" : "no material is nearly incompressible");
}

/* Newton's vectors, and the scatter map of the stiffness, which a linear solve drops; where nodes follow others, the
 * stiffness of all nodes too. */
static void large_rotation(const OstEffectFacts *f, OstEffectState *state)
{
    const double of_all = !has_links(f) ? 0.0 : f->quadratic ? 2100.0 : 1150.0;
    const double of_factors = f->factored ? 3150.0 : 0.0; /* what goes to MUMPS */
    const double bytes = (264.0 + of_all + of_factors) * f->nodes + (f->quadratic ? 1320.0 : 40.0) * f->tets;
    if (f->large_rotation == 0)
        off(state, "the case says so: linear theory, which takes rotations and strains as small");
    else if (why_linear(f))
        off(state, why_linear(f));
    else if (f->large_rotation == 2)
        on(state, bytes, "the case says so: Newton's method, %s formulation", f->formulation);
    else
        on(state, 0.0, "auto: a linear solve, then Newton's method (%s) where that is off by more than %g %%",
           f->formulation, 100.0 * f->accuracy);
}

/* Of each mode, and one more, three columns of three vectors, its displacement and forces; the modes found. */
static void buckling(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->buckling == 0)
        off(state, "the case does not say buckling");
    else
        on(state, (264.0 * (f->buckling + 1.0) + 24.0 * f->buckling) * f->nodes,
           "the case says so: %d mode%s of the linear answer", f->buckling, f->buckling == 1 ? "" : "s");
}

/* The linear mesh and its matrix, and the row of each node. */
static void linear_space(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->rigid_faces > 0)
        off(state, "with rigid faces multigrid begins with the nodes themselves");
    else if (f->quadratic && f->multigrid)
        on(state, matrix_bytes(f) + 250.0 * f->vertices + 75.0 * f->tets + 24.0 * f->nodes,
           "quadratic tets: multigrid continues on their linear tets, or on their vertices");
    else
        off(state, f->quadratic ? "the planned solver is not Orthostat's multigrid" : "the tets are linear already");
}

/* g and -K g, 3 numbers a node each. */
static void prescribed_displacement(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->prescribed > 0)
        on(state, 48.0 * f->nodes, "%d of %d constraints prescribe a displacement other than zero", f->prescribed,
           f->constraints);
    else
        off(state, f->constraints > 0 ? "every constraint is zero" : "there is no constraint");
}

static void sliding(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->slides > 0)
        on(state, 0.0, "%d of %d constraints let the body slide on a plane", f->slides, f->constraints);
    else
        off(state, "no constraint is a slide");
}

/* They take what the surface has: little beside the tets. */
static void links(const OstEffectFacts *f, OstEffectState *state, int count, const char *what)
{
    char none[64];
    snprintf(none, sizeof none, "no constraint is %s", what);
    if (count > 0)
        on(state, 0.0, "%d of %d constraints %s %s", count, f->constraints, count == 1 ? "is" : "are", what);
    else
        off(state, none);
}

static void rigid_face(const OstEffectFacts *f, OstEffectState *state)
{
    links(f, state, f->rigid_faces, "a rigid face");
}

static void tie(const OstEffectFacts *f, OstEffectState *state)
{
    links(f, state, f->ties, "a tie between faces");
}

static void periodic(const OstEffectFacts *f, OstEffectState *state)
{
    links(f, state, f->periodic, "a periodic cell");
}

static void free_body(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->free_body)
        on(state, 0.0, "the case says so: the loads balance each other");
    else
        off(state, f->constraints > 0 ? "the body is constrained" : "the case does not say free_body");
}

static void loads(const OstEffectFacts *f, OstEffectState *state, int count, const char *where)
{
    char none[64];
    snprintf(none, sizeof none, "no load acts %s", where);
    if (count > 0)
        on(state, 0.0, "%d of %d loads act %s", count, f->loads, where);
    else
        off(state, f->loads == 0 ? "there is no load" : none);
}

static void point_force(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->point_loads, "on vertices");
}

static void surface_load(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->surface_loads, "on faces");
}

static void body_force(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->body_loads, f->gravity_loads > 0 ? "in the volume, gravity among them" : "in the volume");
}

static void centrifugal(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->centrifugal_loads, "in a body that turns");
}

static void moment(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->moments, "with a moment");
}

/* Of each component the load of a unit of its force and the displacement under that; the load of all, two vectors of
 * work, and the solver's eight. With large rotations of each coupling the weights of its sums, and what their forces
 * do. */
static void moved_coupling(const OstEffectFacts *f, OstEffectState *state)
{
    const double turned = f->large_rotation == 2 ? (32.0 + 12.0 * 24.0) * f->moved_couplings : 0.0;
    if (f->moved_couplings > 0)
        on(state, f->nodes * (264.0 + 48.0 * f->moved_components + turned),
           "the motion of %d of %d loads is given, in %d component%s", f->moved_couplings, f->loads,
           f->moved_components, f->moved_components == 1 ? "" : "s");
    else
        off(state, "no coupling of a face to a point is moved");
}

/* The nodes and the pressure of each face are few beside the tets. */
static void follower_pressure(const OstEffectFacts *f, OstEffectState *state)
{
    loads(f, state, f->follower_loads, "on faces and follow them");
}

/* Six numbers a region. */
static void eigenstrain(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->eigenstrained_region)
        on(state, 48.0 * f->regions + 72.0 * f->nodes, "region '%.60s' swells or contracts of itself",
           f->eigenstrained_region);
    else
        off(state, "no material has an eigenstrain");
}

/* A stiffness of nine numbers a node, which foundations and springs share; for the check of free motions a foundation
 * keeps the normals of its surface at each node too. */
static void foundation(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->foundations > 0)
        on(state, 248.0 * f->nodes, "%d of %d springs are spread over an area", f->foundations, f->springs);
    else
        off(state, f->springs > 0 ? "no spring is spread over an area" : "the case has no springs");
}

static void springs(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->springs > f->foundations)
        on(state, f->foundations > 0 ? 0.0 : 72.0 * f->nodes, "%d of %d springs are at vertices",
           f->springs - f->foundations, f->springs);
    else
        off(state, f->springs > 0 ? "no spring is at a vertex" : "the case has no springs");
}

/* The load of each table, and the displacement of each function of time. */
static void path(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->path_steps > 0)
        on(state, 24.0 * f->nodes * (1.0 + 2.0 * f->tables), "%d step%s, %d time table%s", f->path_steps,
           f->path_steps == 1 ? "" : "s", f->tables, f->tables == 1 ? "" : "s");
    else
        off(state, "the case has no path: the answer is that at t = 1");
}

static void recovery(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->cell_fields + f->node_fields > 0)
        on(state, 8.0 * (f->cell_fields * f->tets + f->node_fields * f->nodes),
           "the output holds %d of their components a tet, and %d a node", f->cell_fields, f->node_fields);
    else
        off(state, "the output holds neither");
}

/* Load factors are found tet by tet. */
static void strength(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->strengths > 0)
        on(state, 0.0, "%d of %d materials state strengths", f->strengths, f->materials);
    else
        off(state, "no material states strengths");
}

/* Functions of edges and, on quadratic tets, of faces: a block of the stiffness and four vectors for each, its numbers
 * in the tets; the surplus of the nodes for quantities of interest. Of linear tets their gradients in single precision,
 * and C where it is not the same in all. */
static void error_estimate(const OstEffectFacts *f, OstEffectState *state)
{
    const double faces = f->quadratic ? 2.0 * f->tets : 0.0, watched = f->watches > 0 ? 24.0 : 0.0;
    const double stiffness = f->materials > 1 ? 84.0 : f->varying > 0 ? 28.0 : 0.0;
    const double bytes = f->quadratic ? 192.0 * (f->edges + faces) + (168.0 + watched) * f->nodes + 40.0 * f->tets
                                      : 196.0 * f->edges + (232.0 + watched) * f->nodes + (68.0 + stiffness) * f->tets;
    if (f->error_field || f->asks_error)
        on(state, bytes, f->asks_error ? "an accuracy is asked for" : "the output holds the error of the answer");
    else
        off(state, "the output does not hold the error of the answer");
}

/* What it takes depends on the meshes to come. */
static void adaptivity(const OstEffectFacts *f, OstEffectState *state)
{
    if (f->asks_error)
        on(state, 0.0, "an error of %.3g %% is asked for", 100.0 * f->accuracy);
    else
        off(state, "no accuracy is asked for: the mesh stays as it is");
}

void ost_effects_find(const OstEffectFacts *facts, OstEffects *effects)
{
    effects->why_linear = why_linear(facts);
#define OST_EFFECT_RULE(name, label, rule) rule(facts, &effects->state[name - OST_EFFECT_FIRST]);
    OST_EFFECT_TABLE(OST_EFFECT_RULE)
#undef OST_EFFECT_RULE
    for (int e = 0; e < OST_EFFECT_COUNT; e++)
        if (facts->without >> e & 1U)
            off(&effects->state[e], "left out, to see what it changes");
}

void ost_effects_leave_out(OstEffects *effects, OstEffect effect, const char *reason)
{
    off(&effects->state[effect - OST_EFFECT_FIRST], reason);
}

void ost_effects_name_accounts(OstContext *ctx)
{
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        ost_ledger_name(ctx, e, ost_effect_label((OstEffect)e));
}

int ost_effect_on(const OstEffects *effects, OstEffect effect)
{
    return !effects || effects->state[effect - OST_EFFECT_FIRST].on;
}

const OstEffectState *ost_effect_state(const OstEffects *effects, OstEffect effect)
{
    return &effects->state[effect - OST_EFFECT_FIRST];
}

const char *ost_effect_label(OstEffect effect)
{
    static const char *const label[OST_EFFECT_COUNT] = {
#define OST_EFFECT_LABEL(name, text, rule) text,
        OST_EFFECT_TABLE(OST_EFFECT_LABEL)
#undef OST_EFFECT_LABEL
    };
    return label[effect - OST_EFFECT_FIRST];
}
