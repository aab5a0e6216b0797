/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/select.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/halo.h"

#include <string.h>

/* The body's surface, the selected ones of its faces, and an index that finds a face by its vertices. */
typedef struct Faces {
    const OstMesh *mesh;
    const OstSurface *surface; /* the mesh's */
    unsigned char *selected;   /* surface->count */
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

static OstStatus flag_boundary(const OstCase *c, const OstSelection *selection, const OstBoundary *boundary,
                               Faces *faces)
{
    for (OstLocal i = 0; i < boundary->count; i++) {
        OstLocal nodes[3];
        OstGlobal vertices[3];
        for (int k = 0; k < 3; k++)
            nodes[k] = (OstLocal)boundary->nodes[(size_t)i * (size_t)boundary->nodes_per_item + (size_t)k];
        sort_vertices(nodes, vertices);
        const OstLocal face = ost_index_find(faces->index, vertices);
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

/* Selects faces all of whose nodes are selected; also used for boundaries of points and curves. */
static OstStatus flag_by_nodes(const OstCase *c, const OstSelection *selection, Faces *faces)
{
    unsigned char *flags = NULL;
    const int n = faces->surface->nodes_per_face;
    OST_TRY(ost_select_flags(c, faces->mesh, selection, &flags));
    for (OstLocal f = 0; f < faces->surface->count; f++) {
        int all = 1;
        for (int k = 0; k < n; k++)
            all &= flags[faces->surface->nodes[(size_t)f * (size_t)n + (size_t)k]];
        faces->selected[f] |= (unsigned char)all;
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
        return flag_by_nodes(c, selection, faces);
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

/* Of nodes, beside bits for x, y and z: along what faces of the selection are held, and others, by constraints (shift
 * 0) or by springs (shift 6). */
enum {
    ALONG = 7,
    OWN = 0,
    OTHERS = 3,
    BY_SPRINGS = 6,
    SELECTED = 1 << 12,
    HAS_FACE = 1 << 13,
    IS_RIGID = 1 << 14,
    LINKS_OWN = 1 << 15,    /* a link, or moved coupling, has selected faces there */
    LINKS_OTHERS = 1 << 16, /* one has others there alone */
    HAS_OWN = 1 << 17,      /* the one that is looked at */
    HAS_OTHERS = 1 << 18
};

/* What holds a face. */
typedef enum { HELD_BY_CONSTRAINT, HELD_RIGID, HELD_BY_SPRINGS, HELD_BY_LINK } Holder;

/* Faces between selected nodes are those of the selection. */
static void look_at_selected(const OstSurface *surface, unsigned *flags)
{
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *node = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        unsigned selected = SELECTED;
        for (int k = 0; k < surface->nodes_per_face; k++)
            selected &= flags[node[k]];
        for (int k = 0; k < surface->nodes_per_face && selected; k++)
            flags[node[k]] |= HAS_FACE;
    }
}

/* Faces between nodes `in` one support leave bits at their nodes: of constraints for what all of these are `held`
 * along; of rigid faces, and of springs, which on quadratic tets act between vertices, for all directions. */
static void look_at_faces(const OstSurface *surface, const unsigned char *in, const unsigned char *held, Holder by,
                          unsigned *flags)
{
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *node = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        unsigned along = ALONG, selected = SELECTED;
        for (int k = 0; k < surface->nodes_per_face; k++) {
            along &= !in[node[k]] ? 0U : by == HELD_BY_CONSTRAINT ? held[node[k]] : ALONG;
            selected &= flags[node[k]];
        }
        const int shift = (by == HELD_BY_SPRINGS ? BY_SPRINGS : 0) + (selected ? OWN : OTHERS);
        unsigned bits = along << shift | (along && by == HELD_RIGID ? IS_RIGID : 0U);
        if (by == HELD_BY_LINK)
            bits = along && selected ? HAS_OWN : along ? HAS_OTHERS : 0U;
        for (int k = 0; k < surface->nodes_per_face; k++)
            flags[node[k]] |= bits;
    }
}

/* Boundaries one by one: sides of a body one tet thick lie between two of them. */
static OstStatus look_at_support(const OstCase *c, const OstMesh *mesh, const OstSurface *surface,
                                 const OstSelection *on, const unsigned char *held, Holder by, unsigned *flags)
{
    unsigned char *in = NULL;
    if (on->kind != OST_SELECT_BOUNDARY) {
        OST_TRY(ost_select_flags(c, mesh, on, &in));
        look_at_faces(surface, in, held, by, flags);
        OST_FREE(in);
        return OST_SUCCESS;
    }
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &in, mesh->node_count)));
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        if (!ost_selection_names(on, boundary->name))
            continue;
        memset(in, 0, (size_t)mesh->node_count);
        for (size_t n = 0; n < (size_t)boundary->count * (size_t)boundary->nodes_per_item; n++)
            in[boundary->nodes[n]] = 1;
        look_at_faces(surface, in, held, by, flags);
    }
    OST_FREE(in);
    return OST_SUCCESS;
}

/* What others bear of a node's reaction: of a selection without faces there nothing is known. */
static unsigned char borne_by_others(unsigned flags, unsigned held)
{
    unsigned half = 0, all = 0;
    if (!(flags & SELECTED) || !(flags & HAS_FACE))
        return 0;
    const unsigned constrained = flags & IS_RIGID ? ALONG : held;
    for (unsigned i = 0; i < 3; i++) {
        const unsigned by = constrained >> i & 1 ? flags : held >> (3 + i) & 1 ? flags >> BY_SPRINGS : 0;
        const unsigned own = by >> (OWN + i) & 1, others = by >> (OTHERS + i) & 1;
        half |= (own & others) << i;
        all |= (others & ~own) << i;
    }
    const unsigned passed = flags & LINKS_OWN ? 0U : OST_SHARED_BUT_PASSED;
    const int is_in_doubt = flags & LINKS_OTHERS && (flags & LINKS_OWN || held >> 3);
    return (unsigned char)(half | all << 3 | passed | (is_in_doubt ? OST_SHARED_IN_DOUBT : 0U));
}

/* Of a rigid face `held` tells whose a node's force is. */
static void take_link(OstLocal count, int is_rigid, unsigned *flags)
{
    for (OstLocal n = 0; n < count; n++) {
        if (flags[n] & HAS_OWN)
            flags[n] |= LINKS_OWN;
        else if (flags[n] & HAS_OTHERS && !is_rigid)
            flags[n] |= LINKS_OTHERS;
        flags[n] &= ~(unsigned)(HAS_OWN | HAS_OTHERS);
    }
}

/* The faces of a constraint that links. */
static OstStatus look_at_link(const OstCase *c, const OstMesh *mesh, const OstSurface *surface,
                              const OstConstraint *constraint, const unsigned char *held, unsigned *flags)
{
    const int is_rigid = constraint->kind == OST_CONSTRAIN_RIGID;
    OstStatus status = OST_SUCCESS;
    if (constraint->kind != OST_CONSTRAIN_PERIODIC)
        status = look_at_support(c, mesh, surface, &constraint->on, held, HELD_BY_LINK, flags);
    if (constraint->kind == OST_CONSTRAIN_TIED)
        OST_THEN(look_at_support(c, mesh, surface, &constraint->to, held, HELD_BY_LINK, flags));
    for (int p = 0; constraint->kind == OST_CONSTRAIN_PERIODIC && p < constraint->pair_count; p++) {
        const OstSelection pair = {.kind = OST_SELECT_BOUNDARY, .boundaries = {2, (char **)constraint->pair[p]}};
        OST_THEN(look_at_support(c, mesh, surface, &pair, held, HELD_BY_LINK, flags));
    }
    if (is_rigid)
        OST_THEN(look_at_support(c, mesh, surface, &constraint->on, held, HELD_RIGID, flags));
    take_link(mesh->node_count, is_rigid, flags);
    return status;
}

OstStatus ost_select_shared(const OstCase *c, const OstMesh *mesh, const unsigned char *held, OstLocal count,
                            const OstLocal *nodes, unsigned char **shared)
{
    const OstSurface *surface;
    unsigned *flags = NULL;
    OST_TRY(ost_mesh_surface(mesh, &surface));
    OstStatus status = OST_NEW(mesh->ctx, shared, mesh->node_count);
    OST_THEN(OST_NEW(mesh->ctx, &flags, mesh->node_count));
    status = ost_agree(mesh->ctx, status);
    for (OstLocal n = 0; n < count && status == OST_SUCCESS; n++)
        flags[nodes[n]] = SELECTED;
    if (status == OST_SUCCESS)
        look_at_selected(surface, flags);
    for (int k = 0; k < c->constraint_count && status == OST_SUCCESS; k++) {
        const OstConstraint *constraint = &c->constraints[k];
        status = ost_constraint_links(constraint)
                     ? look_at_link(c, mesh, surface, constraint, held, flags)
                     : look_at_support(c, mesh, surface, &constraint->on, held, HELD_BY_CONSTRAINT, flags);
    }
    for (int k = 0; k < c->load_count && status == OST_SUCCESS; k++)
        if (c->loads[k].kind == OST_LOAD_DISTRIBUTING) {
            status = look_at_support(c, mesh, surface, &c->loads[k].on, held, HELD_BY_LINK, flags);
            take_link(mesh->node_count, 0, flags);
        }
    for (int k = 0; k < c->spring_count && status == OST_SUCCESS; k++)
        status = look_at_support(c, mesh, surface, &c->springs[k].on, held, HELD_BY_SPRINGS, flags);
    for (OstLocal n = 0; n < mesh->node_count && status == OST_SUCCESS; n++)
        (*shared)[n] = borne_by_others(flags[n], held[n]);
    OST_FREE(flags);
    OST_THEN(ost_halo_import(mesh->halo, 1, *shared));
    return status;
}
