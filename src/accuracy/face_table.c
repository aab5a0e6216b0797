/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/face_table.h"

#include "core/error.h"
#include "core/memory.h"

void ost_face_table_clear(FaceTable *table)
{
    OST_FREE(table->start);
    OST_FREE(table->high);
    OST_FREE(table->of_tet);
    table->count = 0;
}

void ost_face_sort(const OstMesh *mesh, const OstLocal *nodes, const int corner[3], OstLocal sorted[3])
{
    for (int i = 0; i < 3; i++)
        sorted[i] = nodes[corner[i]];
    for (int pass = 0; pass < 3; pass++) {
        const int i = pass % 2;
        if (mesh->node_number[sorted[i]] > mesh->node_number[sorted[i + 1]]) {
            const OstLocal larger = sorted[i];
            sorted[i] = sorted[i + 1];
            sorted[i + 1] = larger;
        }
    }
}

OstLocal ost_face_find(const FaceTable *table, OstLocal edge, OstLocal high)
{
    for (OstLocal f = table->start[edge]; f < table->start[edge + 1]; f++)
        if (table->high[f] == high)
            return f;
    return -1;
}

/* Lists the third vertices of the faces at each edge, once for every tet with the face; `start` has two numbers more
 * than there are edges. */
static OstStatus list_third_vertices(const OstMesh *mesh, const EdgeTable *edges, FaceTable *table, OstLocal *start)
{
    OstLocal *next = start + 1, *edge = NULL, sorted[3];
    OST_TRY(OST_NEW(mesh->ctx, &edge, 4 * (size_t)mesh->tet_count));
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count; k++) {
        ost_face_sort(mesh, ost_mesh_nodes_of(mesh, (OstLocal)(k / 4)), ost_tet_face[k % 4], sorted);
        edge[k] = ost_edge_find(edges, mesh, sorted[0], sorted[1]);
        next[edge[k] + 1]++;
    }
    for (OstLocal e = 0; e < edges->count; e++)
        next[e + 1] += next[e];
    const OstStatus status = OST_NEW(mesh->ctx, &table->high, 4 * (size_t)mesh->tet_count);
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count && status == OST_SUCCESS; k++) {
        ost_face_sort(mesh, ost_mesh_nodes_of(mesh, (OstLocal)(k / 4)), ost_tet_face[k % 4], sorted);
        table->high[next[edge[k]]++] = sorted[2];
    }
    OST_FREE(edge);
    return status;
}

static void remove_repetitions(const EdgeTable *edges, const OstLocal *start, FaceTable *table)
{
    OstLocal kept = 0;
    for (OstLocal e = 0; e < edges->count; e++) {
        table->start[e] = kept;
        table->start[e + 1] = kept;
        for (OstLocal k = start[e]; k < start[e + 1]; k++) {
            const OstLocal high = table->high[k];
            if (ost_face_find(table, e, high) >= 0)
                continue;
            table->high[kept++] = high;
            table->start[e + 1] = kept;
        }
    }
    table->count = kept;
}

OstStatus ost_face_table_build(const OstMesh *mesh, const EdgeTable *edges, FaceTable *table)
{
    OstLocal *start = NULL, sorted[3];
    OstStatus status = OST_NEW(mesh->ctx, &start, (size_t)edges->count + 2);
    OST_THEN(OST_NEW(mesh->ctx, &table->start, (size_t)edges->count + 1));
    OST_THEN(OST_NEW(mesh->ctx, &table->of_tet, 4 * (size_t)mesh->tet_count));
    OST_THEN(list_third_vertices(mesh, edges, table, start));
    if (status == OST_SUCCESS)
        remove_repetitions(edges, start, table);
    OST_FREE(start);
    OST_THEN(OST_RESIZE(mesh->ctx, &table->high, table->count));
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count && status == OST_SUCCESS; k++) {
        ost_face_sort(mesh, ost_mesh_nodes_of(mesh, (OstLocal)(k / 4)), ost_tet_face[k % 4], sorted);
        const OstLocal edge = ost_edge_find(edges, mesh, sorted[0], sorted[1]);
        table->of_tet[k] = ost_face_find(table, edge, sorted[2]);
    }
    return status;
}
