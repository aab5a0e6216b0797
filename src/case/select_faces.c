/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/select.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

/* The body's surface, the selected ones of its faces, and an index that finds a face by its vertices. */
typedef struct Faces {
    const OstMesh *mesh;
    const OstSurface *surface; /* the mesh's */
    unsigned char *selected;   /* surface->count: not 0, or bits, where a face is */
    OstIndex *index;           /* of the surface's faces by their vertices, ascending */
} Faces;

static void sort_vertices(const OstLocal *nodes, OstGlobal vertices[3])
{
    OstGlobal a = nodes[0], b = nodes[1], c = nodes[2], t;
    if (a > b)
        t = a, a = b, b = t;
    if (b > c)
        t = b, b = c, c = t;
    if (a > b)
        t = a, a = b, b = t;
    vertices[0] = a;
    vertices[1] = b;
    vertices[2] = c;
}

static OstStatus fill_index(Faces *faces)
{
    OstGlobal vertices[3];
    OstLocal place;
    OST_TRY(ost_index_create(faces->mesh->ctx, 3, &faces->index));
    for (OstLocal f = 0; f < faces->surface->count; f++) {
        sort_vertices(faces->surface->nodes + (size_t)f * (size_t)faces->surface->nodes_per_face, vertices);
        OST_TRY(ost_index_place(faces->index, vertices, &place));
    }
    return OST_SUCCESS;
}

/* The face of the surface that is an item of a boundary, or -1. */
static OstLocal find_face(const Faces *faces, const OstBoundary *boundary, OstLocal item)
{
    OstLocal nodes[3];
    OstGlobal vertices[3];
    for (int k = 0; k < 3; k++)
        nodes[k] = (OstLocal)boundary->nodes[(size_t)item * (size_t)boundary->nodes_per_item + (size_t)k];
    sort_vertices(nodes, vertices);
    return ost_index_find(faces->index, vertices);
}

static OstStatus flag_boundary(const OstCase *c, const OstSelection *selection, const OstBoundary *boundary,
                               Faces *faces)
{
    for (OstLocal i = 0; i < boundary->count; i++) {
        const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item;
        const OstLocal face = find_face(faces, boundary, i);
        const OstGlobal *label = faces->mesh->node_label;
        if (face < 0)
            return ost_select_raise(
                c, selection,
                "face (%lld, %lld, %lld) of boundary '%s' is not on the body's surface, so it has no "
                "outside; loads by area and ties act on the surface (total_force with share: vertices acts anywhere, "
                "and "
                "parts that 'merge' has joined need no tie)",
                (long long)label[nodes[0]], (long long)label[nodes[1]], (long long)label[nodes[2]], boundary->name);
        faces->selected[face] = 1;
    }
    return OST_SUCCESS;
}

/* Sets a bit of faces all of whose nodes are selected; also used for boundaries of points and curves. */
static OstStatus flag_by_nodes(const OstCase *c, const OstSelection *selection, unsigned char bit, Faces *faces)
{
    unsigned char *flags = NULL;
    const int n = faces->surface->nodes_per_face;
    OST_TRY(ost_select_flags(c, faces->mesh, selection, &flags));
    for (OstLocal f = 0; f < faces->surface->count; f++) {
        int all = 1;
        for (int k = 0; k < n; k++)
            all &= flags[faces->surface->nodes[(size_t)f * (size_t)n + (size_t)k]];
        faces->selected[f] |= all ? bit : 0;
    }
    OST_FREE(flags);
    return OST_SUCCESS;
}

/* Refuses a list of boundaries of faces with others of points or curves, which would add no face and go unnoticed. */
static OstStatus check_all_are_faces(const OstCase *c, const OstSelection *selection, const OstMesh *mesh)
{
    static const char *const kind[] = {"points", "curves"};
    OST_TRY(ost_select_check_names(c, mesh, selection));
    for (int n = 0; n < selection->boundaries.count; n++) {
        const OstBoundary *boundary = &mesh->boundaries[ost_mesh_find_boundary(mesh, selection->boundaries.name[n])];
        if (boundary->dimension < 2)
            return ost_select_raise(c, selection,
                                    "boundary '%s' is one of %s, and others listed with it are of faces; name "
                                    "boundaries of faces alone, or share the force over vertices (share: vertices)",
                                    boundary->name, kind[boundary->dimension]);
    }
    return OST_SUCCESS;
}

/* Flags the selected faces of the surface; all ranks take the same branches. */
static OstStatus flag_faces(const OstCase *c, const OstSelection *selection, Faces *faces)
{
    const OstMesh *mesh = faces->mesh;
    OstContext *ctx = mesh->ctx;
    int of_faces = 0;
    for (int b = 0; selection->kind == OST_SELECT_BOUNDARY && b < mesh->boundary_count; b++)
        of_faces |= mesh->boundaries[b].dimension == 2 && ost_selection_names(selection, mesh->boundaries[b].name);
    if (!of_faces)
        return flag_by_nodes(c, selection, 1, faces);
    OST_TRY(ost_agree(ctx, fill_index(faces)));
    OstStatus status = check_all_are_faces(c, selection, mesh);
    for (int b = 0; b < mesh->boundary_count && status == OST_SUCCESS; b++)
        if (mesh->boundaries[b].dimension == 2 && ost_selection_names(selection, mesh->boundaries[b].name))
            status = flag_boundary(c, selection, &mesh->boundaries[b], faces);
    return ost_agree(ctx, status);
}

static OstStatus list_faces(const Faces *faces, OstLocal *count, OstLocal **nodes)
{
    const size_t n = (size_t)faces->surface->nodes_per_face;
    size_t next = 0;
    *count = 0;
    for (OstLocal f = 0; f < faces->surface->count; f++)
        *count += faces->selected[f];
    OST_TRY(OST_NEW(faces->mesh->ctx, nodes, (size_t)*count * n));
    for (OstLocal f = 0; f < faces->surface->count; f++)
        if (faces->selected[f])
            memcpy(*nodes + n * next++, faces->surface->nodes + n * (size_t)f, n * sizeof **nodes);
    return OST_SUCCESS;
}

OstStatus ost_select_faces(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, OstLocal *count,
                           int *nodes_per_face, OstLocal **faces)
{
    OstContext *ctx = mesh->ctx;
    Faces found = {.mesh = mesh};
    *count = 0;
    *nodes_per_face = mesh->nodes_per_tet == 10 ? 6 : 3;
    *faces = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_SELECTION);
    OstStatus status = ost_mesh_surface(mesh, &found.surface);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &found.selected, found.surface->count)));
    OST_TRY_DONE(flag_faces(c, selection, &found));
    OST_TRY_DONE(ost_agree(ctx, list_faces(&found, count, faces)));
done:
    if (status != OST_SUCCESS) {
        OST_FREE(*faces);
        *count = 0;
    }
    ost_index_destroy(&found.index);
    OST_FREE(found.selected);
    ost_ledger_leave(ctx);
    return status;
}

/* --- nodes that two supports hold --- */

enum { OF_SELECTION = 1, OF_SUPPORT = 2 }; /* bits of faces */

/* Bits of nodes. */
enum {
    SELECTED = 1,
    HAS_SPRING = 2,
    HAS_OWN = 4,       /* the support that is looked at has a selected face there, or is there where none is selected */
    HAS_OTHERS = 8,    /* it has one that is not */
    LINKS_OWN = 16,    /* a link has selected faces there, and what it passes on is asked for */
    LINKS_OTHERS = 32, /* one has others there alone, or is not asked for */
    BEARS_SPRINGS = 64, /* a part of a link's nodes is selected, where springs act: these are asked for */
    BEARS = 128,        /* supports of the selection act there: constraints, springs, moved couplings */
    BEARS_ALONG = 256,  /* along what is watched */
    MOVES_OWN = 512,    /* as of links, of moved couplings */
    MOVES_OTHERS = 1024,
    IS_MIXED = 2048 /* a tie passes a force on to a face that supports hold in part */
};

/* What holds a node of a selected face: by selected faces, and by others. */
typedef struct Bearers {
    double constrained[2][9]; /* sums of projectors on the directions that constraints hold */
    double springs[2][9];     /* stiffness */
    double all[9];            /* as `constrained`, constraints without faces there too */
} Bearers;

typedef struct Sharing {
    const OstCase *c;
    Faces faces;           /* with bits */
    int axis;              /* of the component that is watched; -1: a length, or a moment */
    unsigned short *nodes; /* bits */
    unsigned char *in;     /* is a node of the support that is looked at? */
    OstLocal *place;       /* of a node in `bearers`, or -1 */
    Bearers *bearers;
} Sharing;

static void add_matrix(double factor, const double *a, double *sum)
{
    for (int i = 0; i < 9; i++)
        sum[i] += factor * a[i];
}

/* across I + (along - across) n n', for a unit vector n, or 0. */
static void find_block(double along, double across, const double n[3], double block[9])
{
    for (int i = 0; i < 9; i++)
        block[i] = (i % 4 == 0 ? across : 0.0) + (along - across) * n[i / 3] * n[i % 3];
}

/* Boundaries one by one: sides of a body one tet thick lie between two of them. */
static OstStatus mark_faces(Sharing *of, const OstSelection *on, unsigned char bit)
{
    Faces *faces = &of->faces;
    const OstMesh *mesh = faces->mesh;
    if (on->kind != OST_SELECT_BOUNDARY)
        return flag_by_nodes(of->c, on, bit, faces);
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        OstSelection one = *on;
        one.boundaries = (OstNames){1, &mesh->boundaries[b].name};
        if (!ost_selection_names(on, boundary->name))
            continue;
        if (boundary->dimension < 2)
            OST_TRY(flag_by_nodes(of->c, &one, bit, faces));
        for (OstLocal i = 0; i < boundary->count && boundary->dimension == 2; i++) {
            const OstLocal face = find_face(faces, boundary, i);
            if (face >= 0) /* not one within the body */
                faces->selected[face] |= bit;
        }
    }
    return OST_SUCCESS;
}

static const double nothing = 1e-9; /* as a share */

/* Its nodes, its faces, and what these are at their nodes. */
static OstStatus look_at_support(Sharing *of, const OstSelection *on)
{
    const OstSurface *surface = of->faces.surface;
    OST_FREE(of->in);
    OST_TRY(ost_select_flags(of->c, of->faces.mesh, on, &of->in));
    for (OstLocal f = 0; f < surface->count; f++)
        of->faces.selected[f] &= (unsigned char)~OF_SUPPORT;
    OST_TRY(mark_faces(of, on, OF_SUPPORT));
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *node = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        for (int k = 0; k < surface->nodes_per_face && of->faces.selected[f] & OF_SUPPORT; k++)
            of->nodes[node[k]] |= of->faces.selected[f] & OF_SELECTION ? HAS_OWN : HAS_OTHERS;
    }
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++)
        of->nodes[n] |= of->in[n] && of->place[n] < 0 ? HAS_OWN : 0;
    return OST_SUCCESS;
}

static void forget_support(Sharing *of)
{
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++)
        of->nodes[n] &= (unsigned short)~(HAS_OWN | HAS_OTHERS);
}

/* A support that acts along the directions of a block is the selection's at a node. */
static void note_own(Sharing *of, OstLocal node, const double block[9])
{
    const double size = block[0] + block[4] + block[8];
    const double along = of->axis < 0 ? size : block[4 * of->axis];
    of->nodes[node] |= (unsigned short)((size > 0.0 ? BEARS : 0) | (along > nothing * size ? BEARS_ALONG : 0));
}

/* A constraint bears what acts along the directions that it holds itself, not what others hold at its nodes. */
static OstStatus look_at_constraint(Sharing *of, const OstConstraint *constraint)
{
    static const unsigned char has[2] = {HAS_OWN, HAS_OTHERS};
    const double length = ost_norm3(constraint->normal);
    double held[9] = {0.0};
    for (int i = 0; i < 9; i++)
        if (constraint->kind == OST_CONSTRAIN_SLIDE)
            held[i] = constraint->normal[i / 3] * constraint->normal[i % 3] / (length * length);
        else
            held[i] = i % 4 == 0 && (constraint->constrained[i / 4] || constraint->exact[i / 4]) ? 1.0 : 0.0;
    OST_TRY(look_at_support(of, &constraint->on));
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++) {
        Bearers *bearers = of->place[n] < 0 ? NULL : &of->bearers[of->place[n]];
        if (of->in[n] && (of->nodes[n] & HAS_OWN || !(of->nodes[n] & HAS_OTHERS)))
            note_own(of, n, held);
        if (!bearers || !of->in[n])
            continue;
        add_matrix(1.0, held, bearers->all);
        for (int k = 0; k < 2; k++)
            add_matrix(of->nodes[n] & has[k] ? 1.0 : 0.0, held, bearers->constrained[k]);
    }
    forget_support(of);
    return OST_SUCCESS;
}

/* Flat faces, as in ost_supports_add_foundation. */
static void take_foundation(Sharing *of, const OstSpring *spring)
{
    const OstSurface *surface = of->faces.surface;
    const double *x = of->faces.mesh->coordinates;
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *node = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        double sides[2][3], normal[3], block[9];
        if (!(of->faces.selected[f] & OF_SUPPORT))
            continue;
        for (size_t i = 0; i < 6; i++)
            sides[i / 3][i % 3] = x[3 * (size_t)node[1 + i / 3] + i % 3] - x[3 * (size_t)node[0] + i % 3];
        ost_cross3(sides[0], sides[1], normal);
        const double size = ost_norm3(normal);
        for (int i = 0; i < 3; i++)
            normal[i] = ost_norm3(spring->direction) > 0.0 ? spring->direction[i] : normal[i] / size;
        find_block(spring->along, spring->across, normal, block);
        for (int k = 0; k < surface->nodes_per_face; k++)
            if (of->place[node[k]] < 0 || of->faces.selected[f] & OF_SELECTION)
                note_own(of, node[k], block);
        for (int k = surface->nodes_per_face - 3; k < surface->nodes_per_face; k++) {
            const OstLocal place = of->place[node[k]];
            of->nodes[node[k]] |= HAS_SPRING;
            if (place >= 0)
                add_matrix(size, block, of->bearers[place].springs[of->faces.selected[f] & OF_SELECTION ? 0 : 1]);
        }
    }
}

/* A vertex's spring belongs to the selection where it is not one of faces. */
static void take_springs(Sharing *of, const OstSpring *spring)
{
    double block[9];
    find_block(spring->along, spring->across, spring->direction, block);
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++) {
        if (!of->in[n])
            continue;
        of->nodes[n] |= HAS_SPRING;
        const double others = !(of->nodes[n] & HAS_OTHERS) ? 0.0 : of->nodes[n] & HAS_OWN ? 0.5 : 1.0;
        if (others < 1.0)
            note_own(of, n, block);
        if (of->place[n] < 0)
            continue;
        add_matrix(6.0 * (1.0 - others), block, of->bearers[of->place[n]].springs[0]);
        add_matrix(6.0 * others, block, of->bearers[of->place[n]].springs[1]);
    }
}

static OstStatus look_at_springs(Sharing *of, const OstSpring *spring)
{
    OST_TRY(look_at_support(of, &spring->on));
    if (spring->kind == OST_SPRING_FOUNDATION)
        take_foundation(of, spring);
    else
        take_springs(of, spring);
    forget_support(of);
    return OST_SUCCESS;
}

/* What is true of any of a link's nodes: left out of the selection; selected; so, without a support of the selection's;
 * with one along what is watched; with springs. */
enum { LEFT_OUT, CHOSEN, BARE, ALONG, SPRINGS, FACTS };

/* `fact`: of one side. Where springs act on a part of it that is selected, these are asked for, not what the link
 * passes on, unless `is_held`. */
static OstStatus look_at_side(Sharing *of, const OstSelection *on, int is_held, int fact[FACTS])
{
    const OstMesh *mesh = of->faces.mesh;
    memset(fact, 0, FACTS * sizeof *fact);
    OST_TRY(look_at_support(of, on));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const unsigned bits = of->in[n] ? of->nodes[n] : 0;
        const int is_own = bits & SELECTED && bits & HAS_OWN;
        fact[LEFT_OUT] |= of->in[n] && !(bits & SELECTED);
        fact[CHOSEN] |= is_own;
        fact[BARE] |= is_own && !(bits & BEARS);
        fact[ALONG] |= is_own && bits & BEARS_ALONG;
        fact[SPRINGS] |= bits & SELECTED && bits & HAS_SPRING;
    }
    OST_TRY(ost_max_ints(mesh->ctx, FACTS, fact));
    for (OstLocal n = 0; n < mesh->owned_nodes && fact[LEFT_OUT] && fact[SPRINGS] && !is_held; n++)
        of->nodes[n] |= of->in[n] ? BEARS_SPRINGS : 0;
    return OST_SUCCESS;
}

static void take_link(Sharing *of, int own, int others)
{
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++)
        of->nodes[n] |= (unsigned short)(of->nodes[n] & HAS_OWN ? own : of->nodes[n] & HAS_OTHERS ? others : 0);
    forget_support(of);
}

/* What meets a rigid face at its edge bears nothing there. One that is held is a support, in every part. */
static OstStatus look_at_rigid(Sharing *of, const OstConstraint *constraint)
{
    int is_held = 1, fact[FACTS];
    for (int i = 0; i < 3; i++)
        is_held &= constraint->constrained[i] && constraint->turn_constrained[i];
    OST_TRY(look_at_side(of, &constraint->on, is_held, fact));
    take_link(of, LINKS_OWN, 0);
    return OST_SUCCESS;
}

/* Ties and periodic pairs. Of a side that supports hold everywhere, their force is asked for, not what the link passes
 * on, which of both sides together is none. Who holds a part of a tie's side may bear little, as a pin, or all. */
static OstStatus look_at_link(Sharing *of, const OstConstraint *constraint)
{
    const int is_tie = constraint->kind == OST_CONSTRAIN_TIED, count = is_tie ? 2 : 2 * constraint->pair_count;
    int chosen = 0, left_out = 0, held = 0, some = 0;
    for (int k = 0; k < count; k++) {
        int fact[FACTS];
        const OstSelection pair = {
            .kind = OST_SELECT_BOUNDARY,
            .boundaries = {1, is_tie ? NULL : (char **)&constraint->pair[k / 2][k % 2]},
        };
        OST_TRY(look_at_side(of, !is_tie ? &pair : k == 0 ? &constraint->on : &constraint->to, 0, fact));
        chosen += fact[CHOSEN];
        left_out |= fact[CHOSEN] && fact[LEFT_OUT];
        held |= fact[ALONG] && !fact[BARE];
        some |= fact[ALONG];
    }
    const int is_within = is_tie && chosen == 2 && !left_out;
    const int is_mixed = is_tie && some && !is_within;
    take_link(of, held && !is_within ? LINKS_OTHERS : LINKS_OWN | (is_mixed ? IS_MIXED : 0), LINKS_OTHERS);
    return OST_SUCCESS;
}

static OstStatus look_at_coupling(Sharing *of, const OstLoad *load)
{
    double moved[9] = {0.0};
    int fact[FACTS];
    for (int i = 0; i < 3; i++)
        moved[4 * i] = load->moved[i] || load->moved[3] || load->moved[4] || load->moved[5] ? 1.0 : 0.0;
    OST_TRY(look_at_side(of, &load->on, 0, fact));
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++)
        if (of->in[n] && of->nodes[n] & HAS_OWN)
            note_own(of, n, moved);
    take_link(of, MOVES_OWN, MOVES_OTHERS);
    return OST_SUCCESS;
}

/* Springs and couplings first, which links ask for; then constraints. */
static OstStatus look_at_all(Sharing *of)
{
    const OstCase *c = of->c;
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < c->spring_count; k++)
        OST_THEN(look_at_springs(of, &c->springs[k]));
    for (int k = 0; k < c->load_count; k++)
        if (c->loads[k].kind == OST_LOAD_DISTRIBUTING)
            OST_THEN(look_at_coupling(of, &c->loads[k]));
    for (int k = 0; k < c->constraint_count; k++)
        if (!ost_constraint_links(&c->constraints[k]))
            OST_THEN(look_at_constraint(of, &c->constraints[k]));
    for (int k = 0; k < c->constraint_count; k++)
        if (c->constraints[k].kind == OST_CONSTRAIN_RIGID)
            OST_THEN(look_at_rigid(of, &c->constraints[k]));
        else if (ost_constraint_links(&c->constraints[k]))
            OST_THEN(look_at_link(of, &c->constraints[k]));
    return status;
}

/* The projector on what a sum of projectors reaches. */
static OstStatus find_range(OstContext *ctx, const double sum[9], double range[9])
{
    static const double least = 1e-6;
    double values[3], vectors[9];
    OST_TRY(ost_symmetric_eigen(ctx, 3, sum, values, vectors));
    memset(range, 0, 9 * sizeof *range);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 9 && values[k] > least * values[2]; i++)
            range[i] += vectors[3 * k + i / 3] * vectors[3 * k + i % 3];
    return OST_SUCCESS;
}

/* Of f = a + b, a = own x and b = others x, the share a = (own (own + others)^-1) f; and all that is neither's. */
static OstStatus find_split(OstContext *ctx, const double own[9], const double others[9], double share[9])
{
    double sum[9] = {0.0}, inverse[9] = {0.0}, rest[9] = {0.0}, values[3], vectors[9];
    add_matrix(1.0, own, sum);
    add_matrix(1.0, others, sum);
    OST_TRY(ost_symmetric_eigen(ctx, 3, sum, values, vectors));
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 9; i++) {
            const double square = vectors[3 * k + i / 3] * vectors[3 * k + i % 3];
            const int is_held = values[k] > nothing * values[2];
            inverse[i] += is_held ? square / values[k] : 0.0;
            rest[i] += is_held ? 0.0 : square;
        }
    ost_multiply3(own, inverse, share);
    add_matrix(1.0, rest, share);
    return OST_SUCCESS;
}

static void project_both(const double projector[9], const double a[9], double projected[9])
{
    double left[9];
    ost_multiply3(projector, a, left);
    ost_multiply3(left, projector, projected);
}

/* Constraints bear what acts along the directions that they hold, springs the rest. Where two constraints hold the same
 * one, each bears half, in doubt; springs bear by their stiffness. */
static OstStatus find_share(OstContext *ctx, const Bearers *by, OstBearing *share)
{
    double held[9], free_part[9], own[9], others[9], of_held[9], of_springs[9], twice[9], part[9];
    OST_TRY(find_range(ctx, by->all, held));
    for (int i = 0; i < 9; i++)
        free_part[i] = (i % 4 == 0 ? 1.0 : 0.0) - held[i];
    OST_TRY(find_range(ctx, by->constrained[0], own));
    OST_TRY(find_range(ctx, by->constrained[1], others));
    OST_TRY(find_split(ctx, own, others, of_held));
    project_both(free_part, by->springs[0], own);
    project_both(free_part, by->springs[1], others);
    OST_TRY(find_split(ctx, own, others, of_springs));
    ost_multiply3(of_held, held, share->own);
    ost_multiply3(of_springs, free_part, part);
    add_matrix(1.0, part, share->own);
    ost_multiply3(of_held, of_held, twice);
    for (int i = 0; i < 9; i++)
        twice[i] = 2.0 * (of_held[i] - twice[i]);
    ost_multiply3(twice, held, share->in_doubt);
    return OST_SUCCESS;
}

static int any_others(const Bearers *by)
{
    int some = 0;
    for (int i = 0; i < 9; i += 4)
        some |= by->constrained[1][i] != 0.0 || by->springs[1][i] != 0.0;
    return some;
}

static OstStatus take_shares(const Sharing *of, OstLocal count, const OstLocal *nodes, OstBearing *shares)
{
    static const OstBearing whole = {.own = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (OstLocal k = 0; k < count; k++) {
        const unsigned bits = of->nodes[nodes[k]];
        const OstLocal place = of->place[nodes[k]];
        shares[k] = whole;
        shares[k].is_passed = !(bits & BEARS_SPRINGS) && bits & LINKS_OWN;
        shares[k].is_moved = !(bits & BEARS_SPRINGS) && bits & MOVES_OWN;
        if ((shares[k].is_passed && bits & LINKS_OTHERS) || (shares[k].is_moved && bits & MOVES_OTHERS))
            shares[k].unknown = OST_BEARING_OF_LINKS;
        else if (shares[k].is_passed && bits & IS_MIXED)
            shares[k].unknown = OST_BEARING_OF_TIE;
        if (place >= 0 && any_others(&of->bearers[place]))
            OST_TRY(find_share(of->faces.mesh->ctx, &of->bearers[place], &shares[k]));
    }
    return OST_SUCCESS;
}

/* Marks the selection, and makes room for what holds the nodes of its faces. */
static OstStatus look_at_selection(Sharing *of, const OstSelection *on, OstLocal count, const OstLocal *nodes)
{
    const OstSurface *surface = of->faces.surface;
    OstContext *ctx = of->faces.mesh->ctx;
    OstLocal places = 0;
    for (OstLocal n = 0; n < of->faces.mesh->node_count; n++)
        of->place[n] = -1;
    for (OstLocal k = 0; k < count; k++)
        of->nodes[nodes[k]] = SELECTED;
    OST_TRY(mark_faces(of, on, OF_SELECTION));
    for (OstLocal f = 0; f < surface->count; f++)
        for (int k = 0; k < surface->nodes_per_face && of->faces.selected[f]; k++) {
            OstLocal *place = &of->place[surface->nodes[(size_t)f * (size_t)surface->nodes_per_face + (size_t)k]];
            *place = *place < 0 ? places++ : *place;
        }
    return ost_agree(ctx, OST_NEW(ctx, &of->bearers, places));
}

OstStatus ost_select_shares(const OstCase *c, const OstMesh *mesh, const OstWatch *watch, OstLocal count,
                            const OstLocal *nodes, OstBearing **shares)
{
    const int is_component = !watch->of_moment && watch->component != OST_WATCH_LENGTH;
    Sharing of = {.c = c, .faces = {.mesh = mesh}, .axis = is_component ? watch->component : -1};
    OST_TRY(ost_mesh_surface(mesh, &of.faces.surface));
    OstStatus status = OST_NEW(mesh->ctx, shares, count);
    OST_THEN(OST_NEW(mesh->ctx, &of.faces.selected, of.faces.surface->count));
    OST_THEN(OST_NEW(mesh->ctx, &of.nodes, mesh->node_count));
    OST_THEN(OST_NEW(mesh->ctx, &of.place, mesh->node_count));
    OST_THEN(fill_index(&of.faces));
    status = ost_agree(mesh->ctx, status);
    OST_THEN(look_at_selection(&of, &watch->on, count, nodes));
    OST_THEN(look_at_all(&of));
    OST_THEN(ost_agree(mesh->ctx, take_shares(&of, count, nodes, *shares)));
    ost_index_destroy(&of.faces.index);
    OST_FREE(of.faces.selected, of.nodes, of.in, of.place, of.bearers);
    return status;
}
