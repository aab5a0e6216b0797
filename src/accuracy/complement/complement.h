/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_COMPLEMENT_COMPLEMENT_H
#define ORTHOSTAT_ACCURACY_COMPLEMENT_COMPLEMENT_H

#include "accuracy/complement/face_table.h"
#include "assembly/supports.h"
#include "element/element.h"

/* What the next order of elements adds to the mesh's own: one vector-valued function for each edge, and for each face
 * of quadratic tets. In barycentric coordinates: 4 L_a L_b for an edge of linear tets; for quadratic ones 8 L_a L_b
 * (L_b - L_a), b the vertex of the higher global number, and 27 L_a L_b L_c for a face. All vanish at the mesh's nodes
 * and on other edges and faces. Edge e has number e, face f number edges.count + f. A function belongs to the rank that
 * owns its vertex of the lowest global number, which has all tets around it. */
enum { OST_MAX_FUNCTIONS = 10 }; /* of a tet: 6 edges as ost_tet_edge, 4 faces as ost_tet_face */

typedef struct OstComplement {
    const OstMesh *mesh;
    EdgeTable edges;
    FaceTable faces; /* none on linear tets */
    OstLocal count;  /* edges and faces */
    OstLocal owned_edges, owned_faces;
    struct OstHalo *edge_halo, *face_halo;
    OstLocal *support; /* count: index of its projector, or -1: it is free */
    OstLocal support_count;
    OstLocal *supported; /* the functions that are not free */
    double *projector;   /* 9 for each of them */
    double *bed;         /* 6 for each function (11 22 33 12 23 31): what elastic foundations add to its block, over the
                          * operator's unit; or NULL */
    unsigned char *turned; /* of each quadratic tet: bit e, if edge e of it is taken from b to a; else NULL */
} OstComplement;

/* Collective. A function is constrained in the directions in which all nodes of a face of the surface are, if it does
 * not vanish on that face. Clear it also after a failure. */
OstStatus ost_complement_create(const OstMesh *mesh, const OstSupports *supports, OstComplement *complement);
void ost_complement_clear(OstComplement *complement);

/* Local. The functions of a tet, of which there are ost_complement_per_tet. */
int ost_complement_per_tet(const OstComplement *complement);
void ost_complement_of_tet(const OstComplement *complement, OstLocal tet, OstLocal *functions);

/* Local. Those of a face, with its vertices (3 edges 01 12 20, and itself on quadratic tets); returns their number. */
int ost_complement_of_face(const OstComplement *complement, const OstLocal *nodes, OstLocal functions[4]);

/* Local. Is the function this rank's? */
static inline int ost_complement_owns(const OstComplement *complement, OstLocal function)
{
    return function < complement->edges.count ? function < complement->owned_edges
                                              : function - complement->edges.count < complement->owned_faces;
}

/* Local. 1, or -1 where the function of edge a-b of quadratic tets is taken from b to a. */
static inline double ost_complement_turn(const OstMesh *mesh, OstLocal a, OstLocal b)
{
    return mesh->nodes_per_tet == 10 && mesh->node_number[a] > mesh->node_number[b] ? -1.0 : 1.0;
}

/* Local. The same of edge e of a tet. */
static inline double ost_complement_turn_of(const OstComplement *complement, OstLocal tet, int e)
{
    return complement->turned && complement->turned[tet] >> e & 1 ? -1.0 : 1.0;
}

/* Vectors of the functions have three numbers in single precision for each, and a zero, so that four are read at once.
 */
enum { OST_PER_FUNCTION = 4 };

/* Collective. Gives ghosts their owners' values. */
OstStatus ost_complement_import(const OstComplement *complement, float *values);

/* Local. Takes from owned functions' values what their constraints do not allow, and all from those of ghosts. */
void ost_complement_project(const OstComplement *complement, float *values);

/* Local. Adds to forces on the functions what their beds take at w. */
void ost_complement_add_bed(const OstComplement *complement, const float *w, float *forces);

/* Local. Adds its bed to a function's 3×3 block A of a stiffness (11 22 33 12 23 31); and s (I - P) to it, reduced to
 * P A P, if the function is constrained: P is the projector on the directions that are left, s of the size of A. */
void ost_complement_constrain_block(const OstComplement *complement, OstLocal function, double symmetric[6]);

/* Local. Of functions at barycentric coordinates, their values: of a tet (6 or 10), or of a face (3 or 4), with edges
 * taken in their own order. */
void ost_complement_values(int quadratic, const double at[4], double *values);
void ost_complement_face_values(int quadratic, const double at[3], double *values);

/* Local. Gradients of a tet's functions from those of the shape functions at a point. */
void ost_complement_gradients(int nodes, const double at[4], const OstPoint *point,
                              OstSimd gradient[OST_MAX_FUNCTIONS][3]);

/* A vector of the elements' space and its complement: 3 numbers for each row of the system, and OST_PER_FUNCTION in
 * single precision for each function. */
typedef struct OstEnriched {
    double *rows;
    float *functions;
} OstEnriched;

#endif
