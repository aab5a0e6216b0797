/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/face_search.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/small.h"
#include "element/shape_functions.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 6 };

/* Distances below this part of a face are rounding errors. */
static const double no_gap = 1e-9;

typedef struct Face {
    OstGlobal number[MOST];
    double x[3 * MOST];
    double centre[3], radius; /* a ball around its vertices */
} Face;

struct OstFaceSearch {
    int nodes;
    OstLocal count;
    Face *face;    /* by centre, so that no partition decides between faces that are equally near */
    double radius; /* the largest */
};

static int compare_faces(const void *a, const void *b)
{
    const double *x = ((const Face *)a)->centre, *y = ((const Face *)b)->centre;
    int i = 0;
    while (i < 2 && x[i] == y[i])
        i++;
    return (x[i] > y[i]) - (x[i] < y[i]);
}

static void take_face(const OstMesh *mesh, int n, const OstLocal *nodes, Face *face)
{
    memset(face, 0, sizeof *face);
    for (int a = 0; a < n; a++)
        face->number[a] = mesh->node_number[nodes[a]];
    ost_gather3(n, nodes, mesh->coordinates, face->x);
    for (int i = 0; i < 9; i++)
        face->centre[i % 3] += face->x[i] / 3.0;
    for (int a = 0; a < 3; a++) {
        const double arm[3] = {face->x[3 * a] - face->centre[0], face->x[3 * a + 1] - face->centre[1],
                               face->x[3 * a + 2] - face->centre[2]};
        face->radius = fmax(face->radius, ost_norm3(arm));
    }
}

static OstStatus take_mine(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int n, Face **mine,
                           OstLocal *kept)
{
    *kept = 0;
    OST_TRY(OST_NEW(mesh->ctx, mine, count));
    for (OstLocal f = 0; f < count; f++) {
        const OstLocal *nodes = faces + (size_t)n * (size_t)f;
        OstGlobal local[MOST] = {0};
        for (int a = 0; a < n; a++)
            local[a] = nodes[a];
        if (ost_mesh_owns(mesh, n, local))
            take_face(mesh, n, nodes, &(*mine)[(*kept)++]);
    }
    return OST_SUCCESS;
}

OstStatus ost_face_search_create(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                                 OstFaceSearch **search)
{
    OstContext *ctx = mesh->ctx;
    Face *mine = NULL;
    OstLocal kept = 0;
    OstStatus status = OST_NEW(ctx, search, 1);
    OST_THEN(take_mine(mesh, count, faces, nodes_per_face, &mine, &kept));
    status = ost_agree(ctx, status);
    OST_THEN(ost_gather_items(ctx, sizeof *mine, mine, kept, "there are too many faces to tie vertices to",
                              (void **)&(*search)->face, &(*search)->count));
    OST_FREE(mine);
    if (status == OST_SUCCESS && (*search)->count == 0)
        status =
            OST_RAISE(ctx, OST_INVALID_INPUT,
                      "the faces to be tied to are none: that selection holds no whole face of the body's surface");
    if (status != OST_SUCCESS)
        return status;
    (*search)->nodes = nodes_per_face;
    qsort((*search)->face, (size_t)(*search)->count, sizeof(Face), compare_faces);
    for (OstLocal f = 0; f < (*search)->count; f++)
        (*search)->radius = fmax((*search)->radius, (*search)->face[f].radius);
    return OST_SUCCESS;
}

void ost_face_search_destroy(OstFaceSearch **search)
{
    if (!*search)
        return;
    OST_FREE((*search)->face);
    OST_FREE(*search);
}

/* The nearest point of an edge, from its first end to its second: 0 to 1. */
static double along_edge(const double *from, const double *to, const double *x)
{
    const double edge[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double arm[3] = {x[0] - from[0], x[1] - from[1], x[2] - from[2]};
    return fmin(fmax(ost_dot3(edge, arm) / fmax(ost_dot3(edge, edge), DBL_MIN), 0.0), 1.0);
}

static double distance_at(const double *vertices, const double at[3], const double *x)
{
    double d[3];
    for (int i = 0; i < 3; i++)
        d[i] = at[0] * vertices[i] + at[1] * vertices[3 + i] + at[2] * vertices[6 + i] - x[i];
    return ost_norm3(d);
}

/* Barycentric coordinates of the point of a triangle that is nearest to x: over its inside, or on an edge. */
static double nearest_in_triangle(const double *vertices, const double *x, double at[3])
{
    double u[3], v[3], arm[3], normal[3], across[3], nearest = DBL_MAX;
    for (int i = 0; i < 3; i++) {
        u[i] = vertices[3 + i] - vertices[i];
        v[i] = vertices[6 + i] - vertices[i];
        arm[i] = x[i] - vertices[i];
    }
    ost_cross3(u, v, normal);
    const double square = fmax(ost_dot3(normal, normal), DBL_MIN);
    ost_cross3(arm, v, across);
    at[1] = ost_dot3(across, normal) / square;
    ost_cross3(u, arm, across);
    at[2] = ost_dot3(across, normal) / square;
    at[0] = 1.0 - at[1] - at[2];
    if (at[0] >= 0.0 && at[1] >= 0.0 && at[2] >= 0.0)
        return distance_at(vertices, at, x);
    for (int e = 0; e < 3; e++) {
        const int next = (e + 1) % 3;
        double on_edge[3] = {0.0};
        on_edge[next] = along_edge(vertices + (ptrdiff_t)3 * e, vertices + (ptrdiff_t)3 * next, x);
        on_edge[e] = 1.0 - on_edge[next];
        const double distance = distance_at(vertices, on_edge, x);
        if (distance >= nearest)
            continue;
        nearest = distance;
        memcpy(at, on_edge, sizeof on_edge);
    }
    return nearest;
}

static OstLocal first_beyond(const OstFaceSearch *search, double x)
{
    OstLocal low = 0, high = search->count;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (search->face[middle].centre[0] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void try_face(const Face *face, const double x[3], double *nearest, const Face **best, double best_at[3])
{
    const double arm[3] = {x[0] - face->centre[0], x[1] - face->centre[1], x[2] - face->centre[2]};
    double at[3];
    if (ost_norm3(arm) - face->radius > *nearest)
        return;
    const double distance = nearest_in_triangle(face->x, x, at);
    if (distance >= *nearest)
        return;
    *nearest = distance;
    *best = face;
    memcpy(best_at, at, sizeof at);
}

/* Adds what the face's turning moves the end of the lever by. Its normal n turns by -(n.du_a) t^a, with du_a the slope
 * of the displacement along the tangent t_a, and t^a the tangents reciprocal to these; what of the lever lies along the
 * face moves with the slopes. */
static void add_lever(const Face *face, int nodes, const double at[3], const double lever[3], OstFacePoint *found)
{
    double tangent[2][3] = {{0.0}}, reciprocal[2][3], normal[3];
    double(*slope)[2] = found->slope;
    ost_shape_face_slopes(nodes, at, slope);
    for (int k = 0; k < nodes; k++)
        for (int i = 0; i < 6; i++)
            tangent[i / 3][i % 3] += slope[k][i / 3] * face->x[3 * k + i % 3];
    ost_cross3(tangent[0], tangent[1], normal);
    const double area = ost_norm3(normal);
    if (!(area > 0.0))
        return;
    for (int i = 0; i < 3; i++)
        normal[i] /= area;
    ost_cross3(tangent[1], normal, reciprocal[0]);
    ost_cross3(normal, tangent[0], reciprocal[1]);
    const double across = found->across = ost_dot3(lever, normal);
    for (int k = 0; k < nodes; k++)
        for (int a = 0; a < 2; a++) {
            const double along = slope[k][a] * ost_dot3(lever, reciprocal[a]) / area;
            found->share[k] += along;
            for (int i = 0; i < 9; i++)
                found->weight[k][i] +=
                    (i % 4 == 0 ? along : 0.0) - across * slope[k][a] * reciprocal[a][i / 3] / area * normal[i % 3];
        }
}

void ost_face_search_nearest(const OstFaceSearch *search, const double x[3], OstFacePoint *found)
{
    const OstLocal middle = first_beyond(search, x[0]);
    double nearest = DBL_MAX, at[4] = {0.0};
    const Face *best = NULL;
    for (OstLocal up = middle, down = middle - 1, moves = 1; moves;) {
        moves = 0;
        if (up < search->count && search->face[up].centre[0] - x[0] - search->radius <= nearest) {
            try_face(&search->face[up++], x, &nearest, &best, at);
            moves = 1;
        }
        if (down >= 0 && x[0] - search->face[down].centre[0] - search->radius <= nearest) {
            try_face(&search->face[down--], x, &nearest, &best, at);
            moves = 1;
        }
    }
    double shape[MOST], place[3], lever[3];
    ost_shape_values(search->nodes, at, shape);
    ost_shape_place(search->nodes, shape, best->x, place);
    for (int i = 0; i < 3; i++)
        lever[i] = x[i] - place[i];
    found->distance = ost_norm3(lever);
    found->gap = found->distance / fmax(best->radius, DBL_MIN);
    found->count = search->nodes;
    memcpy(found->number, best->number, sizeof found->number);
    for (int k = 0; k < search->nodes; k++) {
        found->share[k] = shape[k];
        for (int i = 0; i < 9; i++)
            found->weight[k][i] = i % 4 == 0 ? shape[k] : 0.0;
    }
    if (found->distance > no_gap * best->radius)
        add_lever(best, search->nodes, at, lever, found);
}
