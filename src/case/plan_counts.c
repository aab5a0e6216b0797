/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"

#include <math.h>
#include <string.h>

/* Surface faces of a compact body of which nothing else is known. */
static double compact_surface(double vertices)
{
    return 12.0 * pow(vertices, 2.0 / 3.0);
}

/* Of V vertices, E edges, F faces and T tets Euler's formula says V - E + F - T = 0 (1 for a body without a hole, which
 * is as good), and each tet has four faces, of which those inside are shared: F = 2 T + B / 2, where B are on the
 * surface. */
static double edges_of(double vertices, double tets, double surface)
{
    return vertices + tets + 0.5 * surface;
}

/* The stiffness has a block for each node, and two for each pair of nodes that share a tet. Quadratic tets: the two
 * ends of an edge and its middle are three pairs; in a face each vertex is paired with the middle opposite to it and
 * the middles among themselves, six pairs; in a tet the middles of opposite edges, three. */
static double quadratic_pairs(const OstMeshCounts *counts)
{
    return 3.0 * counts->edges + 6.0 * (2.0 * counts->tets + 0.5 * counts->surface) + 3.0 * counts->tets;
}

OstMeshCounts ost_mesh_counts(double nodes, double tets, int quadratic, double surface)
{
    OstMeshCounts counts = {.nodes = nodes, .tets = tets, .surface = surface, .vertices = nodes};
    if (surface <= 0.0)
        counts.surface = compact_surface(quadratic ? fmax(nodes - 7.0 / 6.0 * tets, 0.0) : nodes);
    if (quadratic) /* a node for each vertex and each edge */
        counts.vertices = fmax(0.5 * (nodes - tets - 0.5 * counts.surface), 0.0);
    counts.edges = edges_of(counts.vertices, tets, counts.surface);
    counts.linear_blocks = counts.vertices + 2.0 * counts.edges;
    counts.blocks = quadratic ? nodes + 2.0 * quadratic_pairs(&counts) : counts.linear_blocks;
    return counts;
}

static OstGlobal bounded(double count)
{
    return count < (double)OST_PLAN_MOST ? (OstGlobal)count : OST_PLAN_MOST;
}

/* A refinement doubles a shape's divisions. Computed in double precision, which is exact for all counts in use and
 * cannot overflow. */
void ost_plan_shape_size(const OstCase *c, OstGlobal *nodes, OstGlobal *tets)
{
    /* For the nodes, so does a node on every edge. */
    const double fine = (double)(1 << c->refinement);
    const double nodal = c->order == 2 ? 2.0 * fine : fine;
    const OstTubeShape *tube = &c->tube;
    const OstSectorShape *sector = &c->sector;
    const double around = c->octant.around;
    const OstLocal *n = c->block.divisions;
    double points = 0.0, cells = 0.0;
    if (c->mesh_kind == OST_MESH_TUBE) {
        points = (nodal * tube->axial + 1.0) * nodal * tube->around * (nodal * tube->radial + 1.0);
        cells = (double)tube->axial * tube->around * tube->radial;
    } else if (c->mesh_kind == OST_MESH_SECTOR) {
        points = (nodal * sector->axial + 1.0) * (nodal * sector->around + 1.0) * (nodal * sector->radial + 1.0);
        cells = (double)sector->axial * sector->around * sector->radial;
    } else if (c->mesh_kind == OST_MESH_OCTANT) {
        points = (3.0 * nodal * around * (nodal * around + 1.0) + 1.0) * (nodal * c->octant.radial + 1.0);
        cells = 3.0 * around * around * c->octant.radial;
    } else if (c->mesh_kind == OST_MESH_BLOCK) {
        points = (nodal * n[0] + 1.0) * (nodal * n[1] + 1.0) * (nodal * n[2] + 1.0);
        cells = (double)n[0] * n[1] * n[2];
    }
    *nodes = bounded(points);
    *tets = bounded(6.0 * cells * fine * fine * fine);
}

/* Lengths of the body, and numbers of cells, along three directions; 0 for a mesh file. */
static int shape_extents(const OstCase *c, double length[3], double cells[3])
{
    const OstTubeShape *tube = &c->tube;
    const OstSectorShape *sector = &c->sector;
    const OstOctantShape *octant = &c->octant;
    const double pi = acos(-1.0);
    if (c->mesh_kind == OST_MESH_TUBE) {
        memcpy(length,
               (double[]){tube->radii[1] - tube->radii[0], pi * (tube->radii[1] + tube->radii[0]), tube->length},
               3 * sizeof *length);
        memcpy(cells, (double[]){tube->radial, tube->around, tube->axial}, 3 * sizeof *cells);
    } else if (c->mesh_kind == OST_MESH_SECTOR) {
        const double arc = pi / 360.0 * sector->angle * (sector->radii[1] + sector->radii[0]);
        memcpy(length, (double[]){sector->radii[1] - sector->radii[0], arc, sector->length}, 3 * sizeof *length);
        memcpy(cells, (double[]){sector->radial, sector->around, sector->axial}, 3 * sizeof *cells);
    } else if (c->mesh_kind == OST_MESH_OCTANT) {
        const double arc = 0.25 * pi * (octant->radii[1] + octant->radii[0]);
        memcpy(length, (double[]){octant->radii[1] - octant->radii[0], arc, arc}, 3 * sizeof *length);
        memcpy(cells, (double[]){octant->radial, 2.0 * octant->around, 2.0 * octant->around}, 3 * sizeof *cells);
    } else if (c->mesh_kind == OST_MESH_BLOCK) {
        for (int i = 0; i < 3; i++) {
            length[i] = c->block.size[i];
            cells[i] = c->block.divisions[i];
        }
    } else {
        return 0;
    }
    return 1;
}

void ost_plan_shape_slenderness(const OstCase *c, double *slenderness, double *across)
{
    const double fine = (double)(1 << c->refinement);
    double length[3], cells[3];
    int thin = 0;
    *slenderness = *across = 0.0;
    if (!shape_extents(c, length, cells))
        return;
    for (int i = 1; i < 3; i++)
        if (length[i] < length[thin])
            thin = i;
    const int a = (thin + 1) % 3, b = (thin + 2) % 3;
    *across = fine * cells[thin];
    *slenderness = sqrt(length[a] / cells[a] * length[b] / cells[b]) / (fine * length[thin]);
}

static double faces_of_box(double a, double b, double c)
{
    return 2.0 * (a * b + b * c + c * a);
}

/* Two triangles for each face of a hexahedron. */
double ost_plan_shape_surface(const OstCase *c)
{
    const double fine = (double)(1 << c->refinement);
    const OstLocal *n = c->block.divisions;
    double faces = 0.0;
    if (c->mesh_kind == OST_MESH_TUBE)
        faces = 2.0 * c->tube.around * ((double)c->tube.axial + c->tube.radial);
    else if (c->mesh_kind == OST_MESH_SECTOR)
        faces = faces_of_box(c->sector.axial, c->sector.around, c->sector.radial);
    else if (c->mesh_kind == OST_MESH_OCTANT)
        faces = 6.0 * c->octant.around * ((double)c->octant.around + c->octant.radial);
    else if (c->mesh_kind == OST_MESH_BLOCK)
        faces = faces_of_box(n[0], n[1], n[2]);
    return 2.0 * faces * fine * fine;
}

void ost_plan_file_size(const OstCase *c, int nodes_per_tet, OstGlobal *nodes, OstGlobal *tets, double *surface)
{
    /* A refinement, or order 2, puts a node on each edge. Quadratic tets are refined by refining their vertices' mesh
     * and raising its order. */
    int quadratic = nodes_per_tet == 10;
    OstMeshCounts counts = ost_mesh_counts((double)*nodes, (double)*tets, quadratic, *surface);
    for (int r = 0; r < c->refinement; r++)
        counts = ost_mesh_counts(counts.vertices + counts.edges, 8.0 * counts.tets, 0, 4.0 * counts.surface);
    if (c->order != 0)
        quadratic = c->order == 2;
    if (c->refinement > 0 || quadratic != (nodes_per_tet == 10))
        *nodes = bounded(counts.vertices + (quadratic ? counts.edges : 0.0));
    *tets = bounded(counts.tets);
    *surface = counts.surface;
}
