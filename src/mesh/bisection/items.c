/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/bisection/forest.h"

/* Curves and faces of boundaries. Each is split by the one rank that owns it. A face is cut as the tets behind it:
 * first across its marked edge, then opposite the new vertex. The rank has those tets, though perhaps as another's. */

static void sort3(const OstLocal *vertex, OstGlobal key[3])
{
    for (int i = 0; i < 3; i++)
        key[i] = vertex[i];
    for (int i = 0; i < 3; i++)
        for (int j = i + 1; j < 3; j++)
            if (key[j] < key[i]) {
                const OstGlobal swap = key[i];
                key[i] = key[j];
                key[j] = swap;
            }
}

static OstStatus file_edges_of(Forest *forest, Item *item)
{
    const int edges = item->dimension == 1 ? 1 : 3;
    for (int e = 0; e < edges; e++)
        OST_TRY(ost_forest_edge(forest, item->vertex[e], item->vertex[(e + 1) % 3], &item->edge[e]));
    return OST_SUCCESS;
}

static OstStatus add_item(Forest *forest, Item *item)
{
    OST_TRY(FOREST_ROOM(forest, forest->item_count, &forest->item));
    OST_TRY(file_edges_of(forest, item));
    forest->item[forest->item_count++] = *item;
    return OST_SUCCESS;
}

/* The vertices of all faces of boundaries, sorted, with the marked edge of each as a pair of them. */
typedef struct Faces {
    OstIndex *index;
    OstLocal (*marked)[2];
} Faces;

static OstStatus list_faces(const OstMesh *mesh, Faces *faces)
{
    OstGlobal key[3];
    OstLocal vertex[3], place = 0;
    OST_TRY(ost_index_create(mesh->ctx, 3, &faces->index));
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        for (OstLocal i = 0; boundary->dimension == 2 && i < boundary->count; i++) {
            for (int v = 0; v < 3; v++)
                vertex[v] = (OstLocal)boundary->nodes[(size_t)i * (size_t)boundary->nodes_per_item + (size_t)v];
            sort3(vertex, key);
            OST_TRY(ost_index_place(faces->index, key, &place));
        }
    }
    return OST_NEW(mesh->ctx, &faces->marked, faces->index->count);
}

static void mark_faces(const OstMesh *mesh, const OstTag *tag, const Faces *faces)
{
    for (OstLocal t = 0; faces->index->count > 0 && t < mesh->tet_count; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (int f = 0; f < 4; f++) {
            OstLocal vertex[3];
            OstGlobal key[3];
            for (int v = 0; v < 3; v++)
                vertex[v] = nodes[ost_tet_face[f][v]];
            sort3(vertex, key);
            const OstLocal place = ost_index_find(faces->index, key);
            for (int end = 0; place >= 0 && end < 2; end++)
                faces->marked[place][end] = nodes[ost_tet_edge[tag[t].face[f]][end]];
        }
    }
}

static int marked_edge(const Faces *faces, const Item *item)
{
    OstGlobal key[3];
    sort3(item->vertex, key);
    const OstLocal *marked = faces->marked[ost_index_find(faces->index, key)];
    for (int e = 0; e < 3; e++) {
        const OstLocal apex = item->vertex[(e + 2) % 3];
        if (apex != marked[0] && apex != marked[1])
            return e;
    }
    return 0;
}

static OstStatus file_boundary(Forest *forest, int number, const Faces *faces)
{
    const OstMesh *mesh = forest->mesh;
    const OstBoundary *boundary = &mesh->boundaries[number];
    for (OstLocal i = 0; boundary->dimension > 0 && i < boundary->count; i++) {
        const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item;
        Item item = {.boundary = number, .dimension = boundary->dimension};
        if (!ost_mesh_owns(mesh, boundary->nodes_per_item, nodes))
            continue;
        for (int v = 0; v <= boundary->dimension; v++)
            item.vertex[v] = (OstLocal)nodes[v];
        if (boundary->dimension == 2)
            item.marked = marked_edge(faces, &item);
        OST_TRY(add_item(forest, &item));
    }
    return OST_SUCCESS;
}

OstStatus ost_forest_file_items(Forest *forest, const OstTag *tag)
{
    Faces faces = {0};
    OstStatus status = list_faces(forest->mesh, &faces);
    if (status == OST_SUCCESS)
        mark_faces(forest->mesh, tag, &faces);
    for (int b = 0; b < forest->mesh->boundary_count; b++)
        OST_THEN(file_boundary(forest, b, &faces));
    ost_index_destroy(&faces.index);
    OST_FREE(faces.marked);
    return status;
}

/* The second half goes to the end of the list, where it is looked at in turn. */
static OstStatus split(Forest *forest, OstLocal number, OstLocal middle)
{
    Item half[2] = {forest->item[number], forest->item[number]};
    const int first = half[0].marked, second = half[0].dimension == 1 ? 1 : (first + 1) % 3;
    half[0].vertex[second] = middle;
    half[1].vertex[first] = middle;
    if (half[0].dimension == 2) {
        half[0].marked = (first + 2) % 3;
        half[1].marked = second;
    }
    OST_TRY(file_edges_of(forest, &half[0]));
    forest->item[number] = half[0];
    return add_item(forest, &half[1]);
}

OstStatus ost_forest_split_items(Forest *forest, OstLocal *count)
{
    for (OstLocal i = 0; i < forest->item_count;) {
        const Item *item = &forest->item[i];
        const OstLocal middle = forest->edge[item->edge[item->marked]].cut;
        if (middle < 0) {
            i++;
            continue;
        }
        OST_TRY(split(forest, i, middle));
        (*count)++;
    }
    return OST_SUCCESS;
}
