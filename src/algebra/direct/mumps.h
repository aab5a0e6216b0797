/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_DIRECT_MUMPS_H
#define ORTHOSTAT_ALGEBRA_DIRECT_MUMPS_H

#include "algebra/level/double_matrix.h"

/* MUMPS's factors of a symmetric matrix. */
typedef struct OstMumps OstMumps;

/* Entries of a symmetric matrix that a rank has, each pair of equal ones once; numbers are global and count from 1.
 * Entries of the same row and column are added. */
typedef struct OstMumpsEntries {
    size_t count;
    int *row, *column;
    double *value;
} OstMumpsEntries;

/* What factors would take over all ranks. */
typedef struct OstMumpsForecast {
    double bytes, operations; /* 0: not known */
} OstMumpsForecast;

/* Collective. Analyses alone. Raises what ost_mumps_create raises, but for OST_NOT_CONVERGED; the forecast is known
 * also where memory does not allow such factors. */
OstStatus ost_mumps_foretell(const OstBlockMatrix *matrix, double memory, OstMumpsForecast *forecast);

/* Collective. Analyses and factors; the matrix is not kept. Its diagonal should be of order 1 (OstScaling). Raises
 * OST_OUT_OF_MEMORY if the analysis foresees more than `memory` bytes over all ranks (0: more than the machines have
 * free), before any is allocated; OST_NOT_CONVERGED if the matrix is singular or indefinite; OST_LIMIT_EXCEEDED if
 * MUMPS cannot number the unknowns; OST_LIBRARY_FAILED with MUMPS's code. */
OstStatus ost_mumps_create(const OstDoubleMatrix *matrix, double memory, OstMumps **mumps);

/* Collective. The same for S A S^T (A, if scaling is NULL). Unless `shift` is NULL, a matrix that only rounding makes
 * singular or indefinite is factored with *shift, at most 5e-13, added to its diagonal; *shift is 0 if none was needed.
 */
OstStatus ost_mumps_create_of_rows(const OstBlockMatrix *matrix, const OstScaling *scaling, double memory,
                                   double *shift, OstMumps **mumps);

/* Collective. Factors a symmetric matrix that need not be definite, of which this rank numbers `unknowns`, following on
 * those of the ranks before; takes over the entries' arrays. *negative: its eigenvalues below 0 (Sylvester's law: as
 * many as negative pivots). Raises what ost_mumps_create raises, but for an indefinite matrix. */
OstStatus ost_mumps_create_symmetric(OstContext *ctx, OstLocal unknowns, OstMumpsEntries *entries, double memory,
                                     OstGlobal *negative, OstMumps **mumps);
void ost_mumps_destroy(OstMumps **mumps);

/* Collective. x = A^-1 b, size × rows numbers each; as OstPreconditioner's `apply`, with the factors as `data`. */
OstStatus ost_mumps_solve(void *data, const double *b, double *x);

#endif
