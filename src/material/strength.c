/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/material.h"

#include <math.h>

/* The second axis of the shear pairs 12, 23, 31; the first is i. */
static int next(int i)
{
    return (i + 1) % 3;
}

static double square(double x)
{
    return x * x;
}

static double shear_part(const OstStrength *strength, const double stress[6])
{
    double sum = 0.0;
    for (int p = 0; p < 3; p++)
        sum += square(stress[3 + p] / strength->shear[p]);
    return sum;
}

static int differ(const double x[3])
{
    return x[0] != x[1] || x[1] != x[2];
}

/* Shear strengths that are those of no isotropic material have directions too. */
int ost_strength_has_directions(const OstStrength *strength)
{
    static const double rounding = 1e-6;
    const double even = sqrt(strength->tension[0] * strength->compression[0] / 3.0);
    return strength->known && (differ(strength->tension) || differ(strength->compression) || differ(strength->shear) ||
                               differ(strength->interaction) || fabs(strength->shear[0] - even) > rounding * even ||
                               strength->interaction[0] != -0.5);
}

/* The f > 0 of a f^2 + b f = 1, without the difference of nearly equal numbers. */
static double root(double a, double b)
{
    const double under = b * b + 4.0 * a;
    if (under < 0.0)
        return OST_MOST_LOAD_FACTOR;
    const double sum = sqrt(under);
    if (b > 0.0)
        return 2.0 / (b + sum);
    return a > 0.0 ? (sum - b) / (2.0 * a) : OST_MOST_LOAD_FACTOR;
}

static double tsai_wu_square(const OstStrength *strength, int i)
{
    return 1.0 / (strength->tension[i] * strength->compression[i]);
}

/* Under pressure alone the form may cancel: what is left is rounding below this share of its squares. */
static const double cancelled = 1e-14;

static double tsai_wu(const OstStrength *strength, const double stress[6])
{
    double a = shear_part(strength, stress), b = 0.0, squares = a;
    for (int i = 0; i < 3; i++) {
        const int j = next(i);
        const double f_ii = tsai_wu_square(strength, i), f_jj = tsai_wu_square(strength, j);
        a += f_ii * square(stress[i]) + 2.0 * strength->interaction[i] * sqrt(f_ii * f_jj) * stress[i] * stress[j];
        squares += f_ii * square(stress[i]);
        b += (1.0 / strength->tension[i] - 1.0 / strength->compression[i]) * stress[i];
    }
    return root(fabs(a) > cancelled * squares ? a : 0.0, b);
}

/* Hill's criterion knows one strength of an axis: the smaller one. (By the sign of the stress, it would jump where a
 * stress along one axis passes 0.) */
static void hill_coefficients(const OstStrength *strength, double coefficient[3])
{
    double inverse_square[3];
    for (int i = 0; i < 3; i++)
        inverse_square[i] = 1.0 / square(fmin(strength->tension[i], strength->compression[i]));
    for (int i = 0; i < 3; i++)
        coefficient[i] = 0.5 * (inverse_square[next(i)] + inverse_square[next(next(i))] - inverse_square[i]);
}

static double hill(const OstStrength *strength, const double stress[6])
{
    double coefficient[3], a = shear_part(strength, stress);
    hill_coefficients(strength, coefficient);
    for (int i = 0; i < 3; i++)
        a += coefficient[i] * square(stress[next(i)] - stress[next(next(i))]);
    return root(a, 0.0);
}

static double maximum_stress(const OstStrength *strength, const double stress[6])
{
    double most = 0.0;
    for (int i = 0; i < 3; i++) {
        most = fmax(most, stress[i] / strength->tension[i]);
        most = fmax(most, -stress[i] / strength->compression[i]);
        most = fmax(most, fabs(stress[3 + i]) / strength->shear[i]);
    }
    return root(0.0, most);
}

double ost_load_factor(const OstStrength *strength, OstCriterion criterion, const double stress[6])
{
    static double (*const factor[OST_CRITERIA])(const OstStrength *, const double *) = {
        [OST_TSAI_WU] = tsai_wu, [OST_HILL] = hill, [OST_MAXIMUM_STRESS] = maximum_stress};
    return fmin(factor[criterion](strength, stress), OST_MOST_LOAD_FACTOR);
}

/* Is the form of normal stresses, sum of c_i (s_j - s_k)^2, negative somewhere? */
static int hill_is_open(const OstStrength *strength)
{
    double c[3];
    hill_coefficients(strength, c);
    return c[0] + c[1] + c[2] < 0.0 || c[0] * c[1] + c[1] * c[2] + c[2] * c[0] < 0.0;
}

/* The same of the matrix with ones on its diagonal and the interactions beside it; a little less than 0 counts as 0, as
 * it is with all of them -1/2. */
static int tsai_wu_is_open(const double f[3])
{
    static const double rounding = 1e-12;
    const double determinant = 1.0 + 2.0 * f[0] * f[1] * f[2] - f[0] * f[0] - f[1] * f[1] - f[2] * f[2];
    return determinant < -rounding || fabs(f[0]) > 1.0 || fabs(f[1]) > 1.0 || fabs(f[2]) > 1.0;
}

int ost_criterion_is_open(const OstStrength *strength, OstCriterion criterion)
{
    return criterion == OST_TSAI_WU ? tsai_wu_is_open(strength->interaction)
                                    : criterion == OST_HILL && hill_is_open(strength);
}

/* Turned about the axis, a sum of squares F_aa (s_a^2 + s_b^2) + 2 F_ab s_a s_b + (s_ab / S)^2 stays as it is for
 * 1 / S^2 = 2 (F_aa - F_ab). */
double ost_criterion_even_shear(const OstStrength *strength, OstCriterion criterion, int axis)
{
    const int a = next(axis);
    double coefficient[3], difference;
    if (criterion == OST_MAXIMUM_STRESS)
        return 0.0;
    if (criterion == OST_TSAI_WU)
        difference = tsai_wu_square(strength, a) * (1.0 - strength->interaction[a]);
    else {
        hill_coefficients(strength, coefficient);
        difference = coefficient[next(a)] + 2.0 * coefficient[axis];
    }
    return difference > 0.0 ? sqrt(0.5 / difference) : 0.0;
}
