/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/biot.h"

#include "element/eigen_batch.h"
#include "element/strain_batch.h"

enum { STRAINS = 6, ROTATIONS = 3, COUNT = STRAINS + ROTATIONS };

/* Eigenvalues below this, relative to the sum of all, count as negative. */
static const double rounding = 1e-13;

/* The components of a shear strain or a rotation, and the axis that is left. */
static const int pair[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};

/* World strains of unit strains along the principal directions before the deformation: strain = w principal. */
static void principal_to_world(const OstPolar *polar, OstSimd w[STRAINS][STRAINS])
{
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++) {
            const int j = (i + 1) % 3;
            const int b = (a + 1) % 3;
            const OstSimd *va = polar->before + 3 * a;
            const OstSimd *vb = polar->before + 3 * b;
            w[i][a] = va[i] * va[i];
            w[3 + i][a] = 2.0 * va[i] * va[j];
            w[i][3 + a] = va[i] * vb[i];
            w[3 + i][3 + a] = va[i] * vb[j] + va[j] * vb[i];
        }
}

void ost_biot_strain(const OstPolar *polar, OstSimd strain[6])
{
    OstSimd w[STRAINS][STRAINS];
    principal_to_world(polar, w);
    for (int p = 0; p < STRAINS; p++)
        strain[p] = w[p][0] * polar->strain[0] + w[p][1] * polar->strain[1] + w[p][2] * polar->strain[2];
}

/* 1 / (sigma_i + sigma_j) of each pair */
static void inverse_sums(const OstPolar *polar, OstSimd inverse[3])
{
    for (int k = 0; k < 3; k++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            inverse[k][slot] =
                1.0 / fmax(polar->stretch[pair[k][0]][slot] + polar->stretch[pair[k][1]][slot], OST_LEAST_STRETCH_SUM);
}

/* share_ij = 2 sigma_i / (sigma_i + sigma_j): the shear strain 2 dU_ij is share_ij g_ij + share_ji g_ji, with g_ij =
 * a_i'dF v_j. */
static void shear_shares(const OstPolar *polar, const OstSimd inverse[3], OstSimd share[3][3])
{
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0];
        const int j = pair[k][1];
        share[k][k] = (OstSimd){1.0, 1.0, 1.0, 1.0};
        share[i][j] = 2.0 * polar->stretch[i] * inverse[k];
        share[j][i] = 2.0 * polar->stretch[j] * inverse[k];
    }
}

/* s and P along the principal directions. */
static void principal_stress(const OstSimd stress[6], OstSimd w[STRAINS][STRAINS], OstSimd share[3][3],
                             OstSimd piola[9])
{
    OstSimd s[STRAINS];
    for (int a = 0; a < STRAINS; a++) {
        s[a] = w[0][a] * stress[0];
        for (int p = 1; p < STRAINS; p++)
            s[a] += w[p][a] * stress[p];
    }
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0];
        const int j = pair[k][1];
        piola[4 * k] = s[k];
        piola[3 * i + j] = s[3 + k] * share[i][j];
        piola[3 * j + i] = s[3 + k] * share[j][i];
    }
}

/* a_i t_ij v_j', summed: from principal directions to world axes */
static inline void turn_to_world(const OstPolar *polar, const OstSimd t[9], int stride, OstSimd *world)
{
    OstSimd half[9]; /* rows still along a_i */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = t[stride * (3 * i)] * polar->before[j] + t[stride * (3 * i + 1)] * polar->before[3 + j] +
                              t[stride * (3 * i + 2)] * polar->before[6 + j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            world[stride * (3 * i + j)] =
                polar->after[i] * half[j] + polar->after[3 + i] * half[3 + j] + polar->after[6 + i] * half[6 + j];
}

void ost_biot_piola(const OstPolar *polar, const OstSimd stress[6], OstSimd piola[9])
{
    OstSimd w[STRAINS][STRAINS];
    OstSimd inverse[3];
    OstSimd share[3][3];
    OstSimd principal[9];
    principal_to_world(polar, w);
    inverse_sums(polar, inverse);
    shear_shares(polar, inverse, share);
    principal_stress(stress, w, share, principal);
    turn_to_world(polar, principal, 1, piola);
}

/* C along the principal directions, w'Cw, into the first six rows and columns. */
static void principal_elasticity(const OstSimd *c, OstSimd w[STRAINS][STRAINS], OstSimd q[COUNT][COUNT])
{
    for (int b = 0; b < STRAINS; b++) {
        OstSimd column[STRAINS];
        OstSimd stress[STRAINS];
        for (int p = 0; p < STRAINS; p++)
            column[p] = w[p][b];
        ost_simd_stress(c, column, stress);
        for (int a = 0; a <= b; a++) {
            q[a][b] = w[0][a] * stress[0];
            for (int p = 1; p < STRAINS; p++)
                q[a][b] += w[p][a] * stress[p];
            q[b][a] = q[a][b];
        }
    }
}

/* The rows and columns of the rotation Omega = R'dR, from dF = R (dU + Omega U):
 * d2W = dU : C : dU + 2 P' : (dU Omega) + 2UYU : (Omega'Omega), along the principal directions, where 2UY = P'.
 * Omega_12, Omega_23, Omega_31 are the unknowns. */
static void add_rotations(const OstPolar *polar, OstSimd piola[9], OstSimd q[COUNT][COUNT])
{
    OstSimd trace = {0};
    for (int k = 0; k < 3; k++)
        trace += polar->stretch[k] * piola[4 * k];
    for (int k = 0; k < 3; k++) {
        const int m = pair[k][0];
        const int n = pair[k][1];
        OstSimd z[3][3] = {{{0}}}; /* P'Omega' for Omega_mn = -Omega_nm = 1 */
        for (int i = 0; i < 3; i++) {
            z[i][m] = piola[3 * n + i];
            z[i][n] = -piola[3 * m + i];
        }
        for (int l = 0; l < 3; l++) {
            q[l][STRAINS + k] = z[l][l];
            q[3 + l][STRAINS + k] = 0.5 * (z[pair[l][0]][pair[l][1]] + z[pair[l][1]][pair[l][0]]);
            const int axes[2] = {pair[k][2], pair[l][2]};
            q[STRAINS + k][STRAINS + l] = -polar->stretch[axes[0]] * piola[3 * axes[1] + axes[0]];
        }
        q[STRAINS + k][STRAINS + k] += trace;
        for (int p = 0; p < STRAINS; p++)
            q[STRAINS + k][p] = q[p][STRAINS + k];
    }
}

/* Rows of dU and Omega to rows of g = dU + Omega U: 2 dU_ij = share_ij g_ij + share_ji g_ji, and Omega_ij = (g_ij -
 * g_ji) / (sigma_i + sigma_j). `stride` steps from one row to the next. */
static inline void to_gradient(OstSimd share[3][3], const OstSimd inverse[3], const OstSimd *rows, int stride,
                               OstSimd *gradient)
{
    for (int k = 0; k < 3; k++) {
        const int i = pair[k][0];
        const int j = pair[k][1];
        const OstSimd turned = inverse[k] * rows[stride * (STRAINS + k)];
        gradient[stride * 4 * k] = rows[stride * k];
        gradient[stride * (3 * i + j)] = share[i][j] * rows[stride * (3 + k)] + turned;
        gradient[stride * (3 * j + i)] = share[j][i] * rows[stride * (3 + k)] - turned;
    }
}

/* Have all tets of the batch no negative eigenvalue? Tries Cholesky's factorisation, without roots. */
static int are_semidefinite(const OstSimd h[81])
{
    OstSimd a[81];
    OstSimd shift = {0};
    memcpy(a, h, sizeof a);
    for (int k = 0; k < COUNT; k++)
        shift += rounding * h[10 * k];
    for (int k = 0; k < COUNT; k++) {
        const OstSimd pivot = a[10 * k] + shift;
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            if (!(pivot[slot] > 0.0))
                return 0;
        for (int i = k + 1; i < COUNT; i++) {
            const OstSimd factor = a[9 * k + i] / pivot;
            for (int j = i; j < COUNT; j++)
                a[9 * i + j] -= factor * a[9 * k + j];
        }
    }
    return 1;
}

/* h minus its negative eigenvalues' part */
static void remove_negative(OstSimd h[81])
{
    OstSimd a[81];
    OstSimd vectors[81];
    memcpy(a, h, sizeof a);
    ost_simd_jacobi(COUNT, a, vectors);
    for (int k = 0; k < COUNT; k++) {
        const OstSimd *v = vectors + 9 * k;
        OstSimd excess = a[10 * k];
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            excess[slot] = fmax(-excess[slot], 0.0);
        for (int i = 0; i < COUNT; i++)
            for (int j = 0; j < COUNT; j++)
                h[9 * i + j] += excess * v[i] * v[j];
    }
}

void ost_biot_hessian(const OstPolar *polar, const OstSimd *c, const OstSimd stress[6], int definite,
                      OstSimd hessian[81])
{
    OstSimd w[STRAINS][STRAINS];
    OstSimd inverse[3];
    OstSimd share[3][3];
    OstSimd piola[9];
    OstSimd q[COUNT][COUNT];
    OstSimd half[81];
    OstSimd principal[81];
    principal_to_world(polar, w);
    inverse_sums(polar, inverse);
    shear_shares(polar, inverse, share);
    principal_stress(stress, w, share, piola);
    principal_elasticity(c, w, q);
    add_rotations(polar, piola, q);
    for (int b = 0; b < COUNT; b++)
        to_gradient(share, inverse, q[0] + b, COUNT, half + b);
    for (int a = 0; a < COUNT; a++)
        to_gradient(share, inverse, half + COUNT * a, 1, principal + COUNT * a);
    if (definite && !are_semidefinite(principal))
        remove_negative(principal);
    for (int b = 0; b < COUNT; b++)
        turn_to_world(polar, principal + b, COUNT, half + b);
    for (int a = 0; a < COUNT; a++)
        turn_to_world(polar, half + COUNT * a, 1, hessian + COUNT * a);
}
