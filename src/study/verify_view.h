/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_VERIFY_VIEW_H
#define ORTHOSTAT_STUDY_VERIFY_VIEW_H

#include "element/element.h"
#include "study/verify.h"

/* What is measured, and where. */
typedef struct OstVerifyView {
    const OstMesh *mesh;
    const OstResult *result;
    const OstClosedForm *exact;
    const OstVerifyQuantity *quantity;
} OstVerifyView;

/* A tet's nodes: coordinates and displacements, three numbers each. */
typedef struct OstViewTet {
    int nodes;
    OstLocal number;
    double x[3 * OST_MAX_TET_NODES], u[3 * OST_MAX_TET_NODES];
} OstViewTet;

/* Quadratic tets of a nearly incompressible material see one mode of the strain by its mean over the tet alone
 * (ost_field_mean_dilatation). m: that mode's stress at a point, in world axes; zeros for other tets. */
typedef struct OstViewMode {
    int split;
    double m[6];
} OstViewMode;

/* Local. Three numbers of each node, row by row. */
void ost_view_gather(const OstLocal *nodes, int count, const double *values, double *rows);
void ost_view_gather_tet(const OstVerifyView *view, OstLocal tet, OstViewTet *gathered);

/* Local. Strain (11 22 33 12 23 31, shear twice) of a displacement's gradient, and of the answer at barycentric
 * coordinates. */
void ost_view_strain_of_gradient(const double gradient[9], double strain[6]);
void ost_view_strain(const OstViewTet *tet, const double at[4], double strain[6]);

void ost_view_mode(const OstVerifyView *view, OstLocal tet, const double place[3], OstViewMode *mode);

/* Local. Mean over a tet of m'(strain of the answer); 0 without mean dilatation. */
double ost_view_mean_of_mode(const OstVerifyView *view, const OstViewTet *tet);

/* Local. a'b, and C times a strain. */
double ost_view_dot6(const double a[6], const double b[6]);
void ost_view_stress(const double c[36], const double strain[6], double stress[6]);

/* Collective. Sums over the ranks. */
OstStatus ost_view_reduce(OstContext *ctx, int count, double *sums);

/* Collective. The distance of the whole field from the formula's. */
OstStatus ost_view_measure_field(const OstVerifyView *view, OstVerifyReading *reading);

#endif
