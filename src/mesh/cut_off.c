/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/mesh_data.h"

#include <math.h>
#include <stdlib.h>

/* Faces that meet at a larger angle (radians; 40 degrees) meet at an edge of the body, and not within a curved surface.
 */
static const double sharpest = 0.698;

/* One of the three sides of a face. */
typedef struct Side {
    OstLocal low, high; /* its vertices */
    double along[3];    /* from one to the other, counter-clockwise seen from outside */
    double normal[3];   /* of the face, in the middle of the side; of length one */
    double width;       /* how far the face reaches from it */
} Side;

/* From the middle of a side into the face, to its third vertex: of a quadratic face by the derivative of its shape
 * functions. */
static void find_inwards(const OstMesh *mesh, const OstLocal *face, int nodes, int side, double *inwards)
{
    const double *x[6];
    for (int n = 0; n < nodes; n++)
        x[n] = mesh->coordinates + 3 * (size_t)face[n];
    const int from = side, to = (side + 1) % 3, far = (side + 2) % 3;
    for (int i = 0; i < 3; i++)
        inwards[i] = nodes == 3 ? x[far][i] - x[from][i]
                                : 2.0 * (x[3 + to][i] + x[3 + far][i] - x[3 + from][i]) - x[from][i] - x[far][i];
}

static void find_side(const OstMesh *mesh, const OstLocal *face, int nodes, int number, Side *side)
{
    const OstLocal from = face[number], to = face[(number + 1) % 3];
    double inwards[3];
    for (int i = 0; i < 3; i++)
        side->along[i] =
            mesh->coordinates[3 * (size_t)to + (size_t)i] - mesh->coordinates[3 * (size_t)from + (size_t)i];
    find_inwards(mesh, face, nodes, number, inwards);
    ost_cross3(side->along, inwards, side->normal);
    const double area = ost_norm3(side->normal), length = ost_norm3(side->along);
    for (int i = 0; i < 3; i++)
        side->normal[i] /= area;
    side->width = area / length;
    side->low = from < to ? from : to;
    side->high = from < to ? to : from;
}

/* Of a side that this rank owns it has the faces on both sides. */
static OstLocal list_sides(const OstMesh *mesh, const OstSurface *surface, Side *sides)
{
    OstLocal count = 0;
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *face = surface->nodes + (size_t)f * (size_t)surface->nodes_per_face;
        for (int s = 0; s < 3; s++)
            if (ost_mesh_owns(mesh, 2, (const OstGlobal[2]){face[s], face[(s + 1) % 3]}))
                find_side(mesh, face, surface->nodes_per_face, s, &sides[count++]);
    }
    return count;
}

static int compare_sides(const void *a, const void *b)
{
    const Side *x = a, *y = b;
    return x->low != y->low ? (x->low > y->low) - (x->low < y->low) : (x->high > y->high) - (x->high < y->high);
}

/* Between a smooth surface that bends by an angle across a side, and the faces beside it: c³ / (12 R) for each length
 * of a cylinder of radius R, of which the faces are chords c. Less than 0 in a hollow. */
static double volume_at(const Side *a, const Side *b)
{
    double turn[3];
    ost_cross3(a->normal, b->normal, turn);
    const double length = ost_norm3(a->along);
    const double angle = atan2(ost_dot3(turn, a->along) / length, ost_dot3(a->normal, b->normal));
    if (!(fabs(angle) < sharpest))
        return 0.0;
    return angle * length * (a->width * a->width - a->width * b->width + b->width * b->width) / 12.0;
}

/* volume[0]: what is cut off; volume[1]: what is added in hollows. */
static void find_volumes(Side *sides, OstLocal count, double volume[2])
{
    qsort(sides, (size_t)count, sizeof *sides, compare_sides);
    for (OstLocal first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && compare_sides(&sides[first], &sides[end]) == 0;)
            end++;
        if (end == first + 2) {
            const double between = volume_at(&sides[first], &sides[first + 1]);
            volume[between < 0.0] += fabs(between);
        }
    }
}

static OstStatus find(const OstMesh *mesh, OstCutOff *cut)
{
    OstSurface *own = NULL;
    const OstSurface *surface = mesh->surface;
    Side *sides = NULL;
    double volume[3] = {0.0, 0.0, 0.0};
    if (!surface) /* the whole is not needed */
        OST_TRY(ost_surface_create(mesh, mesh->at_surface, &own));
    if (own)
        surface = own;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &sides, 3 * (size_t)surface->count));
    if (status == OST_SUCCESS) {
        find_volumes(sides, list_sides(mesh, surface, sides), volume);
        for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
            volume[2] += ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet));
        status = ost_sum(mesh->ctx, 3, volume);
    }
    OST_FREE(sides);
    ost_surface_destroy(&own);
    if (status == OST_SUCCESS && volume[2] > 0.0)
        *cut = (OstCutOff){.known = 1, .lacking = volume[0] / volume[2], .filled = volume[1] / volume[2]};
    return status;
}

OstStatus ost_mesh_cut_off(const OstMesh *mesh, OstCutOff *cut)
{
    if (!mesh->cut_off.known)
        OST_TRY(find(mesh, &((OstMesh *)mesh)->cut_off));
    *cut = mesh->cut_off;
    return OST_SUCCESS;
}
