/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement/face_table.h"

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

/* The edge between the two lowest vertices of face k % 4 of tet k / 4, and the third vertex. */
static OstLocal look_at_face(const OstMesh *mesh, const EdgeTable *edges, size_t k, OstLocal *high)
{
    static const int between[4][4] = {{-1, 0, 2, 3}, {0, -1, 1, 4}, {2, 1, -1, 5}, {3, 4, 5, -1}};
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, (OstLocal)(k / 4));
    int last = 0;
    const int *corner = ost_tet_face[k % 4];
    for (int i = 1; i < 3; i++)
        if (mesh->node_number[nodes[corner[i]]] > mesh->node_number[nodes[corner[last]]])
            last = i;
    *high = nodes[corner[last]];
    return edges->of_tet[6 * (k / 4) + (size_t)between[corner[(last + 1) % 3]][corner[(last + 2) % 3]]];
}

/* Lists the third vertices of the faces at each edge, once for every tet with the face; `start` has two numbers more
 * than there are edges. */
static OstStatus list_third_vertices(const OstMesh *mesh, const EdgeTable *edges, FaceTable *table, OstLocal *start)
{
    OstLocal *next = start + 1, high;
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count; k++)
        next[look_at_face(mesh, edges, k, &high) + 1]++;
    for (OstLocal e = 0; e < edges->count; e++)
        next[e + 1] += next[e];
    OST_TRY(OST_NEW(mesh->ctx, &table->high, 4 * (size_t)mesh->tet_count));
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count; k++) {
        const OstLocal edge = look_at_face(mesh, edges, k, &high);
        table->high[next[edge]++] = high;
    }
    return OST_SUCCESS;
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
    OstLocal *start = NULL, high;
    OstStatus status = OST_NEW(mesh->ctx, &start, (size_t)edges->count + 2);
    OST_THEN(OST_NEW(mesh->ctx, &table->start, (size_t)edges->count + 1));
    OST_THEN(OST_NEW(mesh->ctx, &table->of_tet, 4 * (size_t)mesh->tet_count));
    OST_THEN(list_third_vertices(mesh, edges, table, start));
    if (status == OST_SUCCESS)
        remove_repetitions(edges, start, table);
    OST_FREE(start);
    OST_THEN(OST_RESIZE(mesh->ctx, &table->high, table->count));
    for (size_t k = 0; k < 4 * (size_t)mesh->tet_count && status == OST_SUCCESS; k++) {
        const OstLocal edge = look_at_face(mesh, edges, k, &high);
        table->of_tet[k] = ost_face_find(table, edge, high);
    }
    return status;
}
