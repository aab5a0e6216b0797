/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_ROWS_H
#define ORTHOSTAT_GUARD_FREEDOM_ROWS_H

#include "orthostat/context.h"

/* A rigid motion of a body is six numbers: the velocity of its centre, and its rotation times its radius, so that all
 * six are lengths and no choice of units changes their proportions. A point at centre + radius × arm moves by
 * motion[0..2] + motion[3..5] × arm.
 *
 * A condition on it is a row of six. Any number of rows is kept as the upper triangle R of their QR factorisation,
 * which has the same null space and the same singular values. (Summing products of rows instead would lose half the
 * digits.) */
typedef struct OstRigidFrame {
    double centre[3];
    double radius;
} OstRigidFrame;

enum { OST_ROWS = 36 };

/* Local. The row of the condition "no motion along `direction` (of length 1) at `point`". */
void ost_rows_of_point(const OstRigidFrame *frame, const double point[3], const double direction[3], double row[6]);

/* Local. Adds a row to the triangle (6×6, row-major; zero to begin with) by six plane rotations. */
void ost_rows_add(double triangle[OST_ROWS], const double row[6]);

/* Local. The 6×6 matrix that gives a body's motion in frame `to` from that in frame `from`. */
void ost_rows_change_frame(const OstRigidFrame *from, const OstRigidFrame *to, double change[OST_ROWS]);

/* c = A B of 6×6 matrices; c may not be a or b. */
void ost_rows_multiply(const double *a, const double *b, double *c);

/* Local. An orthonormal basis of the vectors that a rows × columns matrix (row-major; overwritten) maps to no more than
 * `tolerance` times their length: `count` vectors of `columns` numbers in `basis`, which has room for columns². */
OstStatus ost_null_space(OstContext *ctx, int rows, int columns, double *matrix, double tolerance, int *count,
                         double *basis);

#endif
