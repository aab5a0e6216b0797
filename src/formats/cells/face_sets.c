/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "formats/cells/cells.h"

#include <string.h>

/* Sets of something else that become sets of faces.
 * Programs name faces by their nodes: nodes that `order: 2`, refinement, or the split of a quadratic hexahedron add
 * within them are then constrained too. Abaqus names solids alone for those of their faces that are free. */

/* Faces all of whose nodes are marked: those of some sets, or of the solids in them. */
typedef struct Faces {
    OstIndex *index;   /* by their vertices */
    OstGlobal *side;   /* of each: 4 × the tet's position + the vertex opposite; -1: between two tets */
    unsigned char *in; /* of each node: is it in the set at hand, and on a face of it? */
} Faces;
enum { WITHIN = 1, COVERED = 2 };

/* Do the cells of a group, of lower dimension than solids, become a boundary of this name? */
static int is_group_of_faces(const OstCells *cells, const OstCellName *name)
{
    for (int k = 0; k < OST_CELL_KINDS; k++) {
        const OstCellList *list = &cells->list[k];
        const int dimension = ost_cell_facts[k].dimension;
        if (dimension < 3 && (name->dimension < 0 || name->dimension == dimension))
            for (OstLocal i = 0; i < list->count; i++)
                if (list->group[i] == name->group)
                    return 1;
    }
    return 0;
}

/* Does a set become one? One of solids alone does not: CAE gives it and the set of its nodes one name. */
static int is_set_of_faces(const OstCells *cells, const OstCellSet *set)
{
    OstLocal cell = 0;
    if (set->kind != OST_SET_OF_CELLS)
        return set->count > 0;
    for (OstLocal i = 0; i < set->count; i++) {
        const OstCellKind kind = ost_cells_find(cells, set->item[i], &cell);
        if (kind < OST_CELL_KINDS && ost_cell_facts[kind].dimension < 3)
            return 1;
    }
    return 0;
}

/* What shares its name with another boundary stays a set of nodes. */
static int is_alone(const OstCells *cells, int s)
{
    const char *name = cells->set[s].name;
    for (int i = 0; i < cells->set_count; i++)
        if (i != s && strcmp(cells->set[i].name, name) == 0 && is_set_of_faces(cells, &cells->set[i]))
            return 0;
    for (int n = 0; n < cells->name_count; n++)
        if (strcmp(cells->name[n].name, name) == 0 && is_group_of_faces(cells, &cells->name[n]))
            return 0;
    return 1;
}

static int is_candidate(const OstCells *cells, int s)
{
    return cells->set[s].kind == OST_SET_OF_NODES && cells->set[s].count >= 3;
}

static void mark(const OstCells *cells, int s, unsigned char *in, unsigned char as)
{
    for (OstLocal i = 0; i < cells->set[s].count; i++) {
        const OstGlobal node = ost_label_index_find(&cells->nodes, cells->set[s].item[i]);
        if (node >= 0)
            in[node] = as;
    }
}

static int is_within(const unsigned char *in, int count, const OstGlobal *nodes)
{
    int within = 1;
    for (int i = 0; i < count; i++)
        within &= (in[nodes[i]] & WITHIN) != 0;
    return within;
}

static void sort3(OstGlobal key[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = k % 2;
        const OstGlobal low = key[i] < key[i + 1] ? key[i] : key[i + 1];
        key[i + 1] = key[i] + key[i + 1] - low;
        key[i] = low;
    }
}

static OstStatus add_face(const OstCells *cells, const OstGlobal *face, OstGlobal side, Faces *faces)
{
    OstGlobal key[3] = {face[0], face[1], face[2]};
    OstLocal place = 0;
    const OstLocal before = faces->index->count;
    sort3(key);
    OST_TRY(ost_index_place(faces->index, key, &place));
    OST_TRY(OST_GROW(cells->ctx, &faces->side, (size_t)place + 1));
    faces->side[place] = place == before ? side : -1;
    return OST_SUCCESS;
}

/* Nodes that a split has added are in no set: their face's others decide. */
static OstStatus find_faces(const OstCells *cells, OstCellKind tets, Faces *faces)
{
    const OstCellList *list = &cells->list[tets];
    const int width = ost_cell_facts[tets].nodes, of_face = width == 4 ? 3 : 6;
    OstGlobal face[6];
    for (OstLocal t = 0; t < list->count; t++)
        for (int v = 0; v < 4; v++) {
            ost_cell_face_of(list->nodes + (size_t)t * (size_t)width, width, v, face);
            if (is_within(faces->in, of_face, face))
                OST_TRY(add_face(cells, face, 4 * (OstGlobal)t + v, faces));
        }
    return OST_SUCCESS;
}

/* Makes the set one of faces if each of its nodes is on one of them. */
static OstStatus cover(OstCells *cells, int s, OstCellKind tets, Faces *faces)
{
    const OstCellList *list = &cells->list[tets];
    const int width = ost_cell_facts[tets].nodes, of_face = width == 4 ? 3 : 6;
    OstCellSet *set = &cells->set[s];
    OstGlobal face[6], *side = NULL;
    OstLocal count = 0;
    memset(faces->in, 0, (size_t)cells->nodes.count);
    memset(faces->in + cells->nodes.count, WITHIN, (size_t)(cells->chunk->node_count - cells->nodes.count));
    mark(cells, s, faces->in, WITHIN);
    OST_TRY(OST_NEW(cells->ctx, &side, faces->index->count));
    for (OstLocal f = 0; f < faces->index->count; f++) {
        const OstGlobal tet = faces->side[f] / 4;
        if (faces->side[f] < 0)
            continue;
        ost_cell_face_of(list->nodes + (size_t)tet * (size_t)width, width, (int)(faces->side[f] % 4), face);
        if (!is_within(faces->in, of_face, face))
            continue;
        side[count++] = faces->side[f];
        for (int i = 0; i < of_face; i++)
            faces->in[face[i]] |= COVERED;
    }
    int covered = count > 0;
    for (OstGlobal n = 0; n < cells->nodes.count; n++)
        covered &= faces->in[n] != WITHIN;
    if (covered) {
        OST_FREE(set->item);
        *set = (OstCellSet){.kind = OST_SET_OF_SIDES, .name = set->name, .count = count, .item = side};
        return OST_SUCCESS;
    }
    OST_FREE(side);
    return OST_SUCCESS;
}

static OstStatus cover_all(OstCells *cells, OstCellKind tets, Faces *faces)
{
    const OstGlobal added = cells->chunk->node_count - cells->nodes.count;
    OST_TRY(ost_index_create(cells->ctx, 3, &faces->index));
    OST_TRY(OST_NEW(cells->ctx, &faces->in, cells->chunk->node_count));
    memset(faces->in + cells->nodes.count, WITHIN, (size_t)added);
    for (int s = 0; s < cells->set_count; s++)
        if (is_candidate(cells, s))
            mark(cells, s, faces->in, WITHIN);
    OST_TRY(find_faces(cells, tets, faces));
    for (int s = 0; s < cells->set_count && faces->index->count > 0; s++)
        if (is_candidate(cells, s) && is_alone(cells, s))
            OST_TRY(cover(cells, s, tets, faces));
    return OST_SUCCESS;
}

/* --- the free faces of solids --- */

static void mark_solids(const OstCells *cells, const OstCellSet *set, OstCellKind tets, unsigned char *in)
{
    const size_t width = (size_t)ost_cell_facts[tets].nodes;
    OstLocal tet = 0;
    for (OstLocal i = 0; i < set->count; i++)
        for (size_t n = 0; n < width && ost_cells_find(cells, set->item[i], &tet) == tets; n++)
            in[cells->list[tets].nodes[(size_t)tet * width + n]] = WITHIN;
}

/* The faces of a tet that no other has. */
static OstStatus put_free(OstCells *cells, int set, OstCellKind tets, OstLocal tet, const Faces *faces)
{
    static const int number[4] = {2, 3, 1, 0}; /* of Abaqus, by the vertex opposite */
    const int width = ost_cell_facts[tets].nodes;
    OstGlobal face[6];
    for (int v = 0; v < 4; v++) {
        ost_cell_face_of(cells->list[tets].nodes + (size_t)tet * (size_t)width, width, v, face);
        sort3(face);
        if (faces->side[ost_index_find(faces->index, face)] >= 0)
            OST_TRY(ost_cells_put(cells, set, ost_cell_face(cells->list[tets].label[tet], number[v])));
    }
    return OST_SUCCESS;
}

/* They join the faces that the surface of this name has by their numbers, and its shells. */
static OstStatus free_set(OstCells *cells, int s, OstCellKind tets, const Faces *faces)
{
    int sides = 0, shells = 0;
    OST_TRY(ost_cells_set(cells, OST_SET_OF_FACES, cells->set[s].name, &sides));
    OST_TRY(ost_cells_set(cells, OST_SET_OF_CELLS, cells->set[s].name, &shells));
    for (OstLocal i = 0; i < cells->set[s].count; i++) {
        const OstGlobal label = cells->set[s].item[i];
        OstLocal cell = 0;
        const OstCellKind kind = ost_cells_find(cells, label, &cell);
        if (kind == tets)
            OST_TRY(put_free(cells, sides, tets, cell, faces));
        else if (kind < OST_CELL_KINDS && ost_cell_facts[kind].dimension == 2)
            OST_TRY(ost_cells_put(cells, shells, label));
        else
            cells->missing++;
    }
    cells->set[s].count = 0;
    ost_cells_keep_once(cells, sides);
    ost_cells_keep_once(cells, shells);
    return OST_SUCCESS;
}

static OstStatus free_all(OstCells *cells, OstCellKind tets, Faces *faces)
{
    const int count = cells->set_count;
    OST_TRY(ost_index_create(cells->ctx, 3, &faces->index));
    OST_TRY(OST_NEW(cells->ctx, &faces->in, cells->chunk->node_count));
    for (int s = 0; s < count; s++)
        if (cells->set[s].kind == OST_SET_OF_FREE)
            mark_solids(cells, &cells->set[s], tets, faces->in);
    OST_TRY(find_faces(cells, tets, faces));
    for (int s = 0; s < count; s++)
        if (cells->set[s].kind == OST_SET_OF_FREE)
            OST_TRY(free_set(cells, s, tets, faces));
    return OST_SUCCESS;
}

/* --- all of them --- */

static OstStatus make_faces(OstCells *cells, OstCellKind tets, OstStatus (*make)(OstCells *, OstCellKind, Faces *))
{
    Faces faces = {NULL};
    const OstStatus status = make(cells, tets, &faces);
    ost_index_destroy(&faces.index);
    OST_FREE(faces.side, faces.in);
    return status;
}

OstStatus ost_cells_make_faces(OstCells *cells, OstCellKind tets)
{
    int nodes = 0, solids = 0;
    for (int s = 0; s < cells->set_count; s++) {
        nodes |= is_candidate(cells, s);
        solids |= cells->set[s].kind == OST_SET_OF_FREE;
    }
    if (solids)
        OST_TRY(make_faces(cells, tets, free_all));
    return nodes ? make_faces(cells, tets, cover_all) : OST_SUCCESS;
}
