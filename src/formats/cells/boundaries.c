/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "formats/cells/cells.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Groups and sets of triangles, lines and points, and sets of nodes and of faces, become boundaries. */

enum { MOST_BOUNDARIES = 10000 };

static const char *const entity[] = {"point", "curve", "surface"};
static const char *const entities[] = {"points", "curves", "faces"};

static int find_boundary(const OstMeshChunk *chunk, const char *name)
{
    for (int b = 0; b < chunk->boundary_count; b++)
        if (strcmp(chunk->boundaries[b].name, name) == 0)
            return b;
    return -1;
}

/* A boundary is of one dimension: what shares a name with one of another gets the dimension after its own. */
static OstStatus name_of(const OstCells *cells, const char *wanted, int dimension, char *text, size_t size)
{
    snprintf(text, size, "%s", wanted);
    int taken = find_boundary(cells->chunk, text);
    if (taken < 0 || cells->chunk->boundaries[taken].dimension == dimension)
        return OST_SUCCESS;
    snprintf(text, size, "%.200s-%s", wanted, entities[dimension]);
    taken = find_boundary(cells->chunk, text);
    if (taken >= 0 && cells->chunk->boundaries[taken].dimension != dimension)
        return OST_RAISE(cells->ctx, OST_INVALID_INPUT, "%s: several sets are called '%s'; give each its own name",
                         cells->path, wanted);
    ost_warn(cells->ctx, "%s: '%s' has %s and %s; its %s are the boundary '%s'", cells->path, wanted,
             entities[cells->chunk->boundaries[find_boundary(cells->chunk, wanted)].dimension], entities[dimension],
             entities[dimension], text);
    return OST_SUCCESS;
}

/* The boundary of a name and dimension: a new one if there is none. */
static OstStatus boundary_of(OstCells *cells, const char *wanted, int dimension, int nodes_per_item,
                             OstBoundary **found)
{
    OstMeshChunk *chunk = cells->chunk;
    char name[256];
    OST_TRY(name_of(cells, wanted, dimension, name, sizeof name));
    int number = find_boundary(chunk, name);
    if (number < 0) {
        if (chunk->boundary_count == MOST_BOUNDARIES)
            return OST_RAISE(cells->ctx, OST_LIMIT_EXCEEDED,
                             "%s: more than %d groups and sets, too many for boundaries", cells->path, MOST_BOUNDARIES);
        OST_TRY(OST_RESIZE(cells->ctx, &chunk->boundaries, chunk->boundary_count + 1));
        number = chunk->boundary_count++;
        chunk->boundaries[number] = (OstBoundary){.dimension = dimension, .nodes_per_item = nodes_per_item};
        OST_TRY(ost_copy_string(cells->ctx, name, &chunk->boundaries[number].name));
    }
    *found = &chunk->boundaries[number];
    return OST_SUCCESS;
}

/* Room for `more` items after those that there are. */
static OstStatus reserve(const OstCells *cells, OstBoundary *boundary, OstLocal more)
{
    if (more > INT32_MAX - boundary->count)
        return OST_RAISE(cells->ctx, OST_LIMIT_EXCEEDED, "%s: boundary '%s' has more than %d items", cells->path,
                         boundary->name, INT32_MAX);
    return OST_RESIZE(cells->ctx, &boundary->nodes,
                      (size_t)(boundary->count + more) * (size_t)boundary->nodes_per_item);
}

static void append(OstBoundary *boundary, const OstGlobal *nodes)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    memcpy(boundary->nodes + (size_t)boundary->count++ * width, nodes, width * sizeof *nodes);
}

/* --- groups --- */

/* A cell and its group, to be sorted by the group. */
typedef struct Grouped {
    OstGlobal group;
    OstLocal cell;
} Grouped;

static int compare_grouped(const void *a, const void *b)
{
    const Grouped *x = a, *y = b;
    const int order = (x->group > y->group) - (x->group < y->group);
    return order != 0 ? order : (x->cell > y->cell) - (x->cell < y->cell);
}

static void group_name(const OstCells *cells, int dimension, OstGlobal group, char *text, size_t size)
{
    snprintf(text, size, "%s-%" PRId64, entity[dimension], group);
    for (int n = 0; n < cells->name_count; n++)
        if (cells->name[n].group == group && (cells->name[n].dimension == dimension || cells->name[n].dimension < 0))
            snprintf(text, size, "%s", cells->name[n].name);
}

/* The items of one group: cells of one kind. */
static OstStatus add_group(OstCells *cells, OstCellKind kind, const Grouped *first, OstLocal count)
{
    char name[256];
    const OstCellFacts facts = ost_cell_facts[kind];
    OstBoundary *boundary = NULL;
    group_name(cells, facts.dimension, first->group, name, sizeof name);
    OST_TRY(boundary_of(cells, name, facts.dimension, facts.nodes, &boundary));
    OST_TRY(reserve(cells, boundary, count));
    for (OstLocal i = 0; i < count; i++)
        append(boundary, cells->list[kind].nodes + (size_t)first[i].cell * (size_t)facts.nodes);
    return OST_SUCCESS;
}

static OstStatus add_groups(OstCells *cells, OstCellKind kind)
{
    const OstCellList *list = &cells->list[kind];
    Grouped *grouped = NULL;
    OstLocal count = 0;
    OST_TRY(OST_NEW(cells->ctx, &grouped, list->count));
    for (OstLocal i = 0; i < list->count; i++)
        if (list->group[i] != OST_NO_GROUP)
            grouped[count++] = (Grouped){list->group[i], i};
    qsort(grouped, (size_t)count, sizeof *grouped, compare_grouped);
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0, next; i < count && status == OST_SUCCESS; i = next) {
        for (next = i + 1; next < count && grouped[next].group == grouped[i].group;)
            next++;
        status = add_group(cells, kind, grouped + i, next - i);
    }
    OST_FREE(grouped);
    return status;
}

/* --- sets --- */

/* The cells of one kind among those of a set. */
static OstStatus add_cells(OstCells *cells, const OstCellSet *set, OstCellKind kind)
{
    const OstCellFacts facts = ost_cell_facts[kind];
    OstLocal count = 0, position = 0;
    OstBoundary *boundary = NULL;
    for (OstLocal i = 0; i < set->count; i++)
        count += ost_cells_find(cells, set->item[i], &position) == kind;
    if (count == 0)
        return OST_SUCCESS;
    OST_TRY(boundary_of(cells, set->name, facts.dimension, facts.nodes, &boundary));
    OST_TRY(reserve(cells, boundary, count));
    for (OstLocal i = 0; i < set->count; i++)
        if (ost_cells_find(cells, set->item[i], &position) == kind)
            append(boundary, cells->list[kind].nodes + (size_t)position * (size_t)facts.nodes);
    return OST_SUCCESS;
}

static OstStatus add_nodes(OstCells *cells, const OstCellSet *set)
{
    OstBoundary *boundary = NULL;
    OST_TRY(boundary_of(cells, set->name, 0, 1, &boundary));
    OST_TRY(reserve(cells, boundary, set->count));
    for (OstLocal i = 0; i < set->count; i++) {
        const OstGlobal node = ost_label_index_find(&cells->nodes, set->item[i]);
        cells->missing += node < 0;
        if (node >= 0)
            append(boundary, &node);
    }
    return OST_SUCCESS;
}

void ost_cell_face_of(const OstGlobal *tet, int nodes_per_tet, int opposite, OstGlobal face[6])
{
    const int *v = ost_tet_face[opposite];
    for (int i = 0; i < 3; i++)
        face[i] = tet[v[i]];
    for (int i = 0; i < 3 && nodes_per_tet == 10; i++)
        face[3 + i] = tet[ost_tet_mid_node(v[i], v[(i + 1) % 3])];
}

/* The tet of a face, and the vertex opposite to it; 0 if there is no such tet. */
static int find_face(const OstCells *cells, const OstCellSet *set, OstGlobal item, OstCellKind tets, OstLocal *tet,
                     int *opposite)
{
    static const int of_abaqus[4] = {3, 2, 0, 1}; /* in the order of its faces */
    if (set->kind == OST_SET_OF_SIDES) {
        *tet = (OstLocal)(item / 4);
        *opposite = (int)(item % 4);
        return 1;
    }
    const OstGlobal face = item % OST_CELL_FACES;
    *opposite = of_abaqus[face % 4];
    return face < 4 && ost_cells_find(cells, item / OST_CELL_FACES, tet) == tets;
}

static OstStatus add_faces(OstCells *cells, const OstCellSet *set, OstCellKind tets)
{
    const int width = ost_cell_facts[tets].nodes;
    OstBoundary *boundary = NULL;
    OST_TRY(boundary_of(cells, set->name, 2, width == 4 ? 3 : 6, &boundary));
    OST_TRY(reserve(cells, boundary, set->count));
    for (OstLocal i = 0; i < set->count; i++) {
        OstGlobal face[6];
        OstLocal tet = 0;
        int opposite = 0;
        if (!find_face(cells, set, set->item[i], tets, &tet, &opposite)) {
            cells->missing++;
            continue;
        }
        ost_cell_face_of(cells->list[tets].nodes + (size_t)tet * (size_t)width, width, opposite, face);
        append(boundary, face);
    }
    return OST_SUCCESS;
}

static OstStatus add_set(OstCells *cells, const OstCellSet *set, OstCellKind tets, int dimension)
{
    const int quadratic = tets == OST_CELL_TET10;
    if (set->kind == OST_SET_OF_NODES)
        return dimension == 0 && set->count > 0 ? add_nodes(cells, set) : OST_SUCCESS;
    if (set->kind == OST_SET_OF_FACES || set->kind == OST_SET_OF_SIDES)
        return dimension == 2 && set->count > 0 ? add_faces(cells, set, tets) : OST_SUCCESS;
    if (dimension == 0)
        return add_cells(cells, set, OST_CELL_POINT);
    if (dimension == 1)
        return add_cells(cells, set, quadratic ? OST_CELL_LINE3 : OST_CELL_LINE2);
    return add_cells(cells, set, quadratic ? OST_CELL_TRIANGLE6 : OST_CELL_TRIANGLE3);
}

/* Keeps each face once. */
static OstStatus keep_faces_once(const OstCells *cells, OstBoundary *boundary)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    OstIndex *index = NULL;
    OstStatus status = ost_index_create(cells->ctx, 3, &index);
    OstLocal place = 0, count = boundary->count;
    boundary->count = 0;
    for (OstLocal i = 0; status == OST_SUCCESS && i < count; i++) {
        const OstGlobal *face = boundary->nodes + (size_t)i * width;
        OstGlobal key[3] = {face[0], face[1], face[2]};
        qsort(key, 3, sizeof *key, ost_compare_numbers);
        status = ost_index_place(index, key, &place);
        if (status == OST_SUCCESS && place == boundary->count)
            memmove(boundary->nodes + (size_t)boundary->count++ * width, face, width * sizeof *face);
    }
    ost_index_destroy(&index);
    return status;
}

/* A surface may have a face of a solid, and a shell on it. */
static OstStatus keep_once(const OstCells *cells)
{
    for (int s = 0; s < cells->set_count; s++) {
        const OstCellSet *set = &cells->set[s];
        const int shells = ost_cells_find_set(cells, OST_SET_OF_CELLS, set->name);
        const int b = find_boundary(cells->chunk, set->name);
        if (set->kind == OST_SET_OF_FACES && shells >= 0 && cells->set[shells].count > 0 && b >= 0 &&
            cells->chunk->boundaries[b].dimension == 2)
            OST_TRY(keep_faces_once(cells, &cells->chunk->boundaries[b]));
    }
    return OST_SUCCESS;
}

/* Lines of another order than the tets' bound nothing. */
static void leave_out_lines(OstCells *cells, int quadratic)
{
    const OstCellList *lines = &cells->list[quadratic ? OST_CELL_LINE2 : OST_CELL_LINE3];
    for (OstLocal i = 0; i < lines->count; i++)
        ost_cells_skip(cells, 1, "a line of another order than the tets'");
}

/* Each item once. Faces first: of names that are given twice, theirs stay. */
OstStatus ost_cells_make_boundaries(OstCells *cells, OstCellKind tets)
{
    const int quadratic = tets == OST_CELL_TET10;
    const OstCellKind kind[3] = {OST_CELL_POINT, quadratic ? OST_CELL_LINE3 : OST_CELL_LINE2,
                                 quadratic ? OST_CELL_TRIANGLE6 : OST_CELL_TRIANGLE3};
    leave_out_lines(cells, quadratic);
    for (int s = 0; s < cells->set_count; s++)
        ost_cells_keep_once(cells, s);
    OST_TRY(ost_cells_make_faces(cells, tets));
    OST_TRY(OST_NEW(cells->ctx, &cells->chunk->boundaries, 0));
    for (int dimension = 2; dimension >= 0; dimension--) {
        OST_TRY(add_groups(cells, kind[dimension]));
        for (int s = 0; s < cells->set_count; s++)
            OST_TRY(add_set(cells, &cells->set[s], tets, dimension));
    }
    return keep_once(cells);
}
