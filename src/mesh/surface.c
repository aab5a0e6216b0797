/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/mesh_data.h"

void ost_surface_destroy(OstSurface **surface)
{
    if (!*surface)
        return;
    OST_FREE((*surface)->nodes, (*surface)->tet);
    OST_FREE(*surface);
}

/* A face of a tet, in the list of its lowest vertex. */
typedef struct Face {
    uint64_t others; /* its middle and highest vertex */
    OstLocal tet;
    int8_t opposite; /* the tet's vertex that it lacks */
    int8_t turn;     /* seen from outside the tet its vertices ascend counter-clockwise (1) or clockwise (-1) */
    int8_t twins;    /* number of other faces with the same vertices */
} Face;

typedef struct FaceTable {
    OstLocal rows;    /* local nodes */
    OstGlobal *start; /* rows + 2 */
    Face *face;
} FaceTable;

static OstLocal lowest_of(const OstLocal *tet, int opposite)
{
    const int *corner = ost_tet_face[opposite];
    const OstLocal low = tet[corner[0]] < tet[corner[1]] ? tet[corner[0]] : tet[corner[1]];
    return tet[corner[2]] < low ? tet[corner[2]] : low;
}

/* Without a branch, which would often be foretold wrongly. */
static void sort_two(OstLocal *low, OstLocal *high, int *swaps)
{
    const OstLocal a = *low, b = *high;
    *swaps += a > b;
    *low = a < b ? a : b;
    *high = a < b ? b : a;
}

/* Vertices in ascending order; the number of swaps decides the turn. */
static OstLocal sort_face(const OstLocal *tet, int opposite, Face *face)
{
    const int *corner = ost_tet_face[opposite];
    OstLocal low = tet[corner[0]], middle = tet[corner[1]], high = tet[corner[2]];
    int swaps = 0;
    sort_two(&low, &middle, &swaps);
    sort_two(&middle, &high, &swaps);
    sort_two(&low, &middle, &swaps);
    face->others = (uint64_t)middle << 32 | (uint64_t)high;
    face->opposite = (int8_t)opposite;
    face->turn = swaps % 2 ? -1 : 1;
    return low;
}

static void write_face(const OstLocal *tet, int opposite, int nodes_per_face, OstLocal *nodes)
{
    const int *corner = ost_tet_face[opposite];
    for (int i = 0; i < 3; i++)
        nodes[i] = tet[corner[i]];
    for (int i = 3; i < nodes_per_face; i++)
        nodes[i] = tet[ost_tet_mid_node(corner[i - 3], corner[(i - 2) % 3])];
}

/* A quadratic face may touch an owned node at a mid-edge node only. */
static int touches_owned(const OstMesh *mesh, const OstLocal *tet, int opposite)
{
    const int *corner = ost_tet_face[opposite];
    for (int i = 0; i < 3; i++) {
        const int next = corner[(i + 1) % 3];
        if (tet[corner[i]] < mesh->owned_nodes)
            return 1;
        if (mesh->nodes_per_tet == 10 && tet[ost_tet_mid_node(corner[i], next)] < mesh->owned_nodes)
            return 1;
    }
    return 0;
}

/* Can a face of the tet have marked vertices alone? */
static int has_three(const unsigned char *marked, const OstLocal *tet)
{
    return !marked || marked[tet[0]] + marked[tet[1]] + marked[tet[2]] + marked[tet[3]] >= 3;
}

static int is_wanted(const OstMesh *mesh, const unsigned char *marked, const OstLocal *tet, int opposite)
{
    const int *corner = ost_tet_face[opposite];
    return (!marked || (marked[tet[corner[0]]] & marked[tet[corner[1]]] & marked[tet[corner[2]]])) &&
           touches_owned(mesh, tet, opposite);
}

/* Lists the faces that touch an owned node: this rank has the tets on both sides of these. `marked`: 1 for the nodes
 * between which faces are wanted, and 0; NULL: all. */
static OstStatus list_faces(const OstMesh *mesh, const unsigned char *marked, FaceTable *table)
{
    table->rows = mesh->node_count;
    OST_TRY(OST_NEW(mesh->ctx, &table->start, (size_t)table->rows + 2));
    OstGlobal *next = table->start + 1; /* offset by one: filling the lists moves each start to its place */
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int o = 0; o < 4 && has_three(marked, ost_mesh_nodes_of(mesh, t)); o++)
            if (is_wanted(mesh, marked, ost_mesh_nodes_of(mesh, t), o))
                next[lowest_of(ost_mesh_nodes_of(mesh, t), o) + 1]++;
    for (OstLocal n = 0; n < table->rows; n++)
        next[n + 1] += next[n];
    OST_TRY(OST_NEW(mesh->ctx, &table->face, next[table->rows]));
    Face face = {0};
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int o = 0; o < 4 && has_three(marked, ost_mesh_nodes_of(mesh, t)); o++) {
            if (!is_wanted(mesh, marked, ost_mesh_nodes_of(mesh, t), o))
                continue;
            const OstLocal low = sort_face(ost_mesh_nodes_of(mesh, t), o, &face);
            face.tet = t;
            table->face[next[low]++] = face;
        }
    }
    return OST_SUCCESS;
}

static OstStatus raise_twins(const OstMesh *mesh, const Face *a, const Face *b)
{
    char cells[2][OST_CELL_WORDS];
    const OstGlobal label[2] = {ost_mesh_tet_number(mesh, a->tet), ost_mesh_tet_number(mesh, b->tet)};
    const char *fault = a->twins > 1 || b->twins > 1 ? "share a face with a third tet" : "lie on one side of a face";
    return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "tets %lld%s and %lld%s %s; remove the doubled or overlapping tet",
                     (long long)label[0], ost_cell_words(mesh, label[0], cells[0]), (long long)label[1],
                     ost_cell_words(mesh, label[1], cells[1]), fault);
}

static OstStatus check_twins(const OstMesh *mesh, const Face *a, const Face *b)
{
    return a->twins > 1 || b->twins > 1 || a->turn == b->turn ? raise_twins(mesh, a, b) : OST_SUCCESS;
}

/* Two tets meet in an inner face, from opposite sides. A third one is found from the second. */
static OstStatus match_faces(const OstMesh *mesh, FaceTable *table)
{
    for (OstLocal n = 0; n < table->rows; n++) {
        Face *end = table->face + table->start[n + 1];
        for (Face *a = table->face + table->start[n]; a < end; a++) {
            for (Face *b = a + 1; b < end; b++) {
                if (a->others != b->others)
                    continue;
                a->twins++;
                b->twins++;
                OST_TRY(check_twins(mesh, a, b));
                break;
            }
        }
    }
    return OST_SUCCESS;
}

static OstStatus keep_surface_faces(const OstMesh *mesh, const FaceTable *table, OstSurface *surface)
{
    OstGlobal count = 0;
    const OstGlobal faces = table->start[table->rows];
    for (OstGlobal f = 0; f < faces; f++)
        count += table->face[f].twins == 0;
    if (count > INT32_MAX)
        return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED, "%lld surface faces on one rank, at most %d; use more ranks",
                         (long long)count, INT32_MAX);
    surface->nodes_per_face = mesh->nodes_per_tet == 10 ? 6 : 3;
    const size_t width = (size_t)surface->nodes_per_face;
    OST_TRY(OST_NEW(mesh->ctx, &surface->nodes, (size_t)count * width));
    OST_TRY(OST_NEW(mesh->ctx, &surface->tet, count));
    for (OstGlobal f = 0; f < faces; f++) {
        const Face *face = &table->face[f];
        if (face->twins > 0)
            continue;
        write_face(ost_mesh_nodes_of(mesh, face->tet), face->opposite, surface->nodes_per_face,
                   surface->nodes + (size_t)surface->count * width);
        surface->tet[surface->count++] = face->tet;
    }
    return OST_SUCCESS;
}

OstStatus ost_surface_create(const OstMesh *mesh, const unsigned char *marked, OstSurface **surface)
{
    FaceTable table = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(mesh->ctx, surface, 1));
    OST_TRY_DONE(list_faces(mesh, marked, &table));
    OST_TRY_DONE(match_faces(mesh, &table));
    OST_TRY_DONE(keep_surface_faces(mesh, &table, *surface));
done:
    OST_FREE(table.start, table.face);
    status = ost_agree(mesh->ctx, status);
    if (status != OST_SUCCESS)
        ost_surface_destroy(surface);
    return status;
}

/* What is kept follows from the mesh, which it does not change. */
OstStatus ost_mesh_surface(const OstMesh *mesh, const OstSurface **surface)
{
    OstStatus status = OST_SUCCESS;
    if (!mesh->surface)
        status = ost_surface_create(mesh, NULL, &((OstMesh *)mesh)->surface);
    *surface = mesh->surface;
    return status;
}
