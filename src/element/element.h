/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_ELEMENT_H
#define ORTHOSTAT_ELEMENT_ELEMENT_H

#include "element/elasticity.h"
#include "element/quadrature.h"

/* One kind of tet, known by its number of nodes (OstMesh.nodes_per_tet). Another kind is another file and another entry
 * in ost_element_of.
 *
 * Coordinates and displacements are 3 numbers a node, node by node, in the mesh's order of nodes. Strains are 11 22 33
 * 12 23 31 with engineering shear. Forces and stiffnesses do not depend on the tet's orientation. */
enum { OST_MAX_TET_NODES = 10, OST_MAX_FACE_NODES = 6 };

/* Means over a tet. */
typedef struct OstMeans {
    OstSimd strain[6];
    OstSimd stress[6];
    OstSimd energy; /* strain energy density */
    OstSimd volume; /* positive */
    OstSimd stiff;  /* of m'(strain - e0) where C is split and that mode seen by its mean (elasticity.h); otherwise 0 */
    OstSimd eigen;  /* of e0'stress: the work that is left out of the energy, times two */
} OstMeans;

/* One point of each tet. */
typedef struct OstPoint {
    OstSimd gradient[OST_MAX_TET_NODES][3]; /* of the shape functions */
    OstSimd volume;                         /* positive, times the quadrature weight */
} OstPoint;

/* The points of a rule: all displacements of the same tets share them. */
typedef struct OstKeptPoints {
    const OstQuadrature *rule;
    OstPoint at[OST_MAX_POINTS];
} OstKeptPoints;

typedef struct OstElement {
    int nodes;
    int nodes_per_face;
    int linear; /* are the forces linear in the displacements? */

    /* Quadrature points at which C is needed where it varies within a tet, and their places (3 numbers a point); 0 for
     * linear tets. */
    int points;
    const OstQuadrature *at;
    void (*places)(const OstSimd *x, OstSimd *places);

    /* The rule that integrates these tets' stiffness, and one of its points. C at its point q is
     * elasticity->c[ost_elasticity_at(elasticity, q)]. */
    const OstQuadrature *(*rule)(const OstSimd *x, const OstElasticity *elasticity);
    void (*evaluate)(const OstSimd *x, const OstQuadraturePoint *at, OstPoint *point);

    /* Evaluates that rule and its points, which the functions below take from elasticity->kept. NULL: they need none.
     */
    void (*keep)(const OstSimd *x, const OstElasticity *elasticity, OstKeptPoints *kept);

    /* Bit k: by itself, tet k would have the rule of fewer points. NULL: there is only one. */
    unsigned (*uniform)(const OstSimd *x, const OstElasticity *elasticity);

    /* Stiffness: for each pair of nodes a <= b, row by row (00 01 .. 11 ..), the 3×3 block K_ab row-major. */
    void (*stiffness)(const OstSimd *x, const OstElasticity *elasticity, OstSimd *blocks);

    /* The coupling of a mixed form's pressures (elasticity.h), by the same rule as `force`: for each vertex, with N its
     * share of the pressure, the integral of N m'B (3 numbers a node), and of N m'e0; for each pair of vertices a <= b,
     * the integral of N_a N_b. `columns` has 4 × 3 × nodes, `eigen` 4, `mass` 10. NULL: these tets have no mixed form.
     */
    void (*coupling)(const OstSimd *x, const OstElasticity *elasticity, OstSimd *columns, OstSimd *eigen,
                     OstSimd *mass);

    /* Internal forces B'C (B u - e0), K u where there is no eigenstrain, computed without K: 3 numbers a node. */
    void (*force)(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force);

    /* The forces, and of `means` the stress. */
    void (*force_and_stress)(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force,
                             OstSimd stress[6]);

    /* The forces' terms by their absolute values, |B'| |C| (|B| |u| + |e0|): the scale of rounding errors in the
     * forces. */
    void (*magnitude)(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *magnitude);

    /* Means of strain, stress and energy over the tets; strain at each node (6 numbers a node), which keep_nodes has
     * evaluated for all displacements that follow. */
    void (*means)(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstMeans *means);
    void (*nodal_strain)(const OstSimd *x, const OstKeptPoints *at_nodes, const OstSimd *u, OstSimd *strain);

    void (*keep_nodes)(const OstSimd *x, OstKeptPoints *at_nodes); /* NULL: none are needed */

    /* One tet: its volume (signed); mean gradient of three components (du_i/dx_j at 3i + j). */
    double (*volume)(const double *x);
    void (*gradient)(const double *x, const double *u, double gradient[9]);

    /* One tet: for each pair of nodes a <= b, the integral of grad N_a · grad N_b. */
    void (*laplacian)(const double *x, double *pairs);

    /* One tet / one face: integrals of each node's shape function over the volume / the area, and over the face's
     * outward area vector (3 numbers a node). */
    void (*node_volumes)(const double *x, double *volumes);
    void (*node_areas)(const double *x, double *areas, double *area_vectors);
} OstElement;

/* Local. The kind of tet with this many nodes, or NULL if there is none. */
const OstElement *ost_element_of(int nodes_per_tet);

/* Number of node pairs a <= b of an element. */
static inline int ost_pair_count(int nodes)
{
    return nodes * (nodes + 1) / 2;
}

/* Index of the pair (a, b), a <= b. */
static inline int ost_pair_index(int nodes, int a, int b)
{
    return a * nodes - a * (a - 1) / 2 + b - a;
}

#endif
