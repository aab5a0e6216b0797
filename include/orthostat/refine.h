/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_REFINE_H
#define ORTHOSTAT_REFINE_H

#include "orthostat/mesh.h"

OST_API_BEGIN

/* Meshes made of others: quadratic tets of linear ones, eight tets of one, and the way back. The new node of an edge is
 * owned by the owner of the edge's vertex with the lowest global number, so no tet changes its rank. Vertices keep
 * their labels; a new node's follows from the vertices' highest label and the lowest label of the tets around its edge.
 * Labels and coordinates do not depend on the number of ranks. */

/* Where the new node of an edge belongs. NONE: halfway. TUBE: in cylindrical coordinates about an axis, at the mean
 * radius, mean angle and mean height of the edge's ends, so circles stay circles and what is between them follows.
 * SPHERE: at the mean radius from a centre, in the mean direction. Halfway also where ends face each other across the
 * axis or centre. */
typedef enum { OST_SURFACE_NONE, OST_SURFACE_TUBE, OST_SURFACE_SPHERE } OstShapeSurfaceKind;

typedef struct OstShapeSurface {
    OstShapeSurfaceKind kind;
    double origin[3]; /* a point of the axis, or the centre */
    double axis[3];   /* TUBE: of any length but 0 */
} OstShapeSurface;

/* Local. */
OstShapeSurface ost_shape_surface_tube(const OstTubeShape *shape);
OstShapeSurface ost_shape_surface_sphere(const double centre[3]);

/* Local. Where the node halfway between a and b belongs (the same to the last bit for b and a); NULL: straight. */
void ost_shape_surface_middle(const OstShapeSurface *shape, const double a[3], const double b[3], double middle[3]);

/* Collective. The same tets with 10 nodes; faces get 6, curves 3. Raises OST_INVALID_INPUT if the mesh is not linear or
 * if a curved tet would fold over at a vertex (naming it), OST_LIMIT_EXCEEDED where labels or local numbers overflow.
 */
OstStatus ost_mesh_raise(const OstMesh *linear, const OstShapeSurface *shape, OstMesh **quadratic);

/* Collective. Eight tets of each, four faces of a face, two curves of a curve; regions and axes are inherited. Tet k
 * (0-7) of the tet labelled p has label 8 (p - 1) + k + 1. Every tet is cut at its vertices and in the octahedron that
 * remains, along one of its three diagonals; their choice keeps the shapes of any number of refinements to a few (a
 * block's tets make those of the block with doubled divisions). A quadratic mesh gives a quadratic one: what is curved
 * stays as it is, unless a shape says better. Raises as ost_mesh_raise, and OST_INVALID_INPUT if a tet would be
 * inverted. */
OstStatus ost_mesh_refine(const OstMesh *coarse, const OstShapeSurface *shape, OstMesh **fine);

/* Collective. The linear mesh of a quadratic one's vertices, on the same ranks: the same tets in the same order with
 * the same owners (some touch no owned vertex, but an owned mid-edge node), vertices in the same order. Points on
 * mid-edge nodes are left out. `node_of_vertex`: the quadratic mesh's local number of each vertex; the caller's to
 * free, NULL if not wanted. */
OstStatus ost_mesh_linear(const OstMesh *quadratic, OstMesh **linear, OstLocal **node_of_vertex);

/* Local. The two vertices in the linear mesh (local numbers; ghosts as well) between which each node of the quadratic
 * mesh lies: twice the same for vertices. For meshes made of one another by ost_mesh_raise or ost_mesh_linear; raises
 * OST_INVALID_INPUT for others. `parents`: 2 × node_count numbers of the caller. */
OstStatus ost_mesh_parents(const OstMesh *quadratic, const OstMesh *linear, OstLocal *parents);

/* Local refinement by bisection, generation after generation: a tet is cut in two across an edge, and its neighbours
 * are, until all tets meet in whole faces again. Each tet has a tag that says how its descendants are cut (D. N.
 * Arnold, A. Mukherjee, L. Pouly, SIAM J. Sci. Comput. 22 (2000) 431-448); the first tags follow from the longest
 * edges. So however often and wherever tets are marked, they take a bounded number of shapes. What is cut, labels and
 * coordinates do not depend on the number of ranks.
 *
 * Vertices keep their labels; new ones follow the highest. Tets are labelled 1, 2, 3, ... in the order of their
 * parents. Regions, axes, and boundaries of points, curves and faces are inherited, but points on mid-edge nodes are
 * left out. */
typedef struct OstBisection OstBisection;

/* Collective. Tags the tets of a mesh, linear or quadratic, which is to live until it has been refined and nothing is
 * to be carried from it any more. */
OstStatus ost_bisection_create(const OstMesh *mesh, OstBisection **bisection);
void ost_bisection_destroy(OstBisection **bisection);

/* Two boundaries of faces whose meshes are the same but for a shift, by name. */
typedef struct OstPeriodicPair {
    const char *leads, *follows;
} OstPeriodicPair;

/* Collective, before anything is cut. Boundaries of these pairs are cut alike, and keep the same mesh but for their
 * shift; at most 32 pairs, whose names are the caller's and live as long as the bisection. Raises OST_INVALID_INPUT for
 * boundaries that are not there or not of faces. */
OstStatus ost_bisection_pair(OstBisection *bisection, int count, const OstPeriodicPair *pair);

/* Collective. Cuts each of this rank's own tets, and its children, at least as often as `times` says (0 to 60: 3 halve
 * all edges); the new mesh is partitioned anew. A quadratic mesh gives a quadratic one: what is curved stays as it is,
 * unless a shape says better; but where pieces of a coarse curved tet would turn or fold over, they have straight
 * edges, and a warning says so. The new mesh, the caller's, is the one that is refined next. Raises OST_INVALID_INPUT
 * if a tet would be inverted or fold over yet, OST_LIMIT_EXCEEDED where labels or local numbers overflow. */
OstStatus ost_bisection_refine(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape,
                               OstMesh **fine);

/* Collective. The same in two steps, for a caller who distributes the chunk of linear tets and perhaps raises the mesh
 * (ost_mesh_raise): `settle` tags that mesh, and bends its edges as the old mesh's are where no shape was given. */
OstStatus ost_bisection_split(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape,
                              OstMeshChunk **chunk);
OstStatus ost_bisection_settle(OstBisection *bisection, OstMesh *mesh);

/* Collective. Carries a field from the mesh before to the refined one, whichever their orders: `width` numbers for each
 * local node there and here. It is evaluated where the new nodes lie in the old tets. */
OstStatus ost_bisection_carry(const OstBisection *bisection, int width, const double *old, double *carried);

/* Collective. Likewise `width` numbers of each own tet, from the tet that a new one lies in; `cuts` receives how often
 * that one was cut to make it. */
OstStatus ost_bisection_carry_tets(const OstBisection *bisection, int width, const double *old, double *carried,
                                   int *cuts);

OST_API_END

#endif
