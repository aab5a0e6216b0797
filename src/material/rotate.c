/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/material.h"

/* K of eq. 9-13 for Q with the axes as columns: turns stresses from material into world axes. */
static void stress_rotation(const double axes[9], double k[36])
{
    for (int i = 0; i < 3; i++) {
        const int in = (i + 1) % 3;
        for (int j = 0; j < 3; j++) {
            const int jn = (j + 1) % 3;
            const double q_ij = axes[3 * j + i];
            const double q_ijn = axes[3 * jn + i];
            const double q_inj = axes[3 * j + in];
            const double q_injn = axes[3 * jn + in];
            k[6 * i + j] = q_ij * q_ij;
            k[6 * i + j + 3] = 2.0 * q_ij * q_ijn;
            k[6 * (i + 3) + j] = q_ij * q_inj;
            k[6 * (i + 3) + j + 3] = q_ij * q_injn + q_ijn * q_inj;
        }
    }
}

/* rotated = K a Kᵀ: the upper triangle is computed and mirrored. */
static void transform(const double k[36], const double a[36], double rotated[36])
{
    double half[36] = {0};
    for (int i = 0; i < 6; i++)
        for (int m = 0; m < 6; m++)
            for (int j = 0; j < 6; j++)
                half[6 * i + j] += k[6 * i + m] * a[6 * m + j];
    for (int i = 0; i < 6; i++)
        for (int j = i; j < 6; j++) {
            double sum = 0.0;
            for (int m = 0; m < 6; m++)
                sum += half[6 * i + m] * k[6 * j + m];
            rotated[6 * i + j] = rotated[6 * j + i] = sum;
        }
}

void ost_material_rotate_stiffness(const double stiffness[36], const double axes[9], double rotated[36])
{
    double k[36];
    stress_rotation(axes, k);
    transform(k, stiffness, rotated);
}

void ost_material_rotate_compliance(const double compliance[36], const double axes[9], double rotated[36])
{
    /* Strains rotate by K^-T, the transpose of the K of the opposite rotation. */
    double opposite[9], k[36], strain_rotation[36];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            opposite[3 * i + j] = axes[3 * j + i];
    stress_rotation(opposite, k);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            strain_rotation[6 * i + j] = k[6 * j + i];
    transform(strain_rotation, compliance, rotated);
}
