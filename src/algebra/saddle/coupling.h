/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_COUPLING_H
#define ORTHOSTAT_ALGEBRA_SADDLE_COUPLING_H

#include "core/parallel/halo.h"

/* The second half of a mixed form, with u the unknowns of a matrix A of 3×3 blocks, and pressures p:
 *     A u + B' p = f,   B u - C p = g.
 * M is the pressures' mass matrix. In each region of a body, of which M has a block of its own, C is M times the
 * material's looseness. A rank has the rows of all its pressures, ghosts included, over the columns of A: those of its
 * own pressures are complete, and so are all entries in columns of its own unknowns. */
typedef struct OstCoupling {
    OstContext *ctx;
    OstLocal rows;     /* pressures this rank owns */
    OstLocal columns;  /* rows + ghosts */
    OstLocal unknowns; /* block rows of A this rank owns */
    OstGlobal global_rows;
    OstLocal *row_start;  /* columns + 1: B */
    OstLocal *column;     /* of A, ascending in a row */
    double *value;        /* 3 for each */
    OstLocal *mass_start; /* rows + 1: M */
    OstLocal *mass_column;
    double *mass;
    double *estimate;  /* as M, or M itself: times schur it is about the Schur complement B A^-1 B' + C */
    double *diagonal;  /* of the estimate: rows */
    double *looseness; /* rows */
    double *schur;     /* rows */
    OstHalo *halo;     /* over pressures; the mesh's numbering has it, but for: */
    OstHalo *own_halo; /* where nodes follow others; else NULL */
} OstCoupling;

void ost_coupling_destroy(OstCoupling **coupling);

/* Local. y = B u, of owned pressures; u has A's columns, ghosts set. */
void ost_coupling_multiply(const OstCoupling *coupling, const double *u, double *y);

/* Collective over neighbours. force = B' p, of A's own rows; p has room for `columns` numbers, and its ghosts are set
 * here. */
OstStatus ost_coupling_transpose(const OstCoupling *coupling, double *p, double *force);

/* Collective over neighbours. y = M p, or C p; p as above. */
OstStatus ost_coupling_mass(const OstCoupling *coupling, double *p, double *y);
OstStatus ost_coupling_give_way(const OstCoupling *coupling, double *p, double *y);

/* Collective over neighbours. z = S^-1 r about, S = schur × H E H, E the estimate, H with 1 / weights on its diagonal
 * (NULL: 1): a few Chebyshev steps from the diagonal, a fixed, symmetric and positive definite operator. z has room for
 * `columns` numbers; `work` for 3 × rows. */
OstStatus ost_coupling_schur_solve(const OstCoupling *coupling, const double *weights, const double *r, double *z,
                                   double *work);

#endif
