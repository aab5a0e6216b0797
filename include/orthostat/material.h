/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_H
#define ORTHOSTAT_MATERIAL_H

#include "orthostat/context.h"

OST_API_BEGIN

/* Conventions, after Li and Barbič, "Stable Orthotropic Materials" (2014), eq. 1-2: strain [e11 e22 e33 2e12 2e23
 * 2e31], stress [s11 s22 s33 s12 s23 s31], shear order 12, 23, 31; nu_ij is the contraction along j when pulled along
 * i, and nu_ij / E_i = nu_ji / E_j. Stiffness C (sigma = C epsilon), compliance S = C^-1, both 6×6 row-major. Units are
 * the user's, consistently. */

typedef enum { OST_SHEAR_GEOMETRIC, OST_SHEAR_ARITHMETIC, OST_SHEAR_MIN, OST_SHEAR_MAX } OstShearRule;

/* The nine constants of an orthotropic material, in its own axes. */
typedef struct OstOrthotropic {
    double youngs_modulus[3]; /* E1 E2 E3 */
    double poissons_ratio[3]; /* nu12 nu23 nu31 */
    double shear_modulus[3];  /* G12 G23 G31 */
} OstOrthotropic;

/* Strengths along the material axes: the sizes of the stresses at which the material fails, all above 0. */
typedef struct OstStrength {
    int known;             /* 0: none are stated */
    double tension[3];     /* along e1 e2 e3 */
    double compression[3]; /* likewise */
    double shear[3];       /* 12 23 31 */
    double interaction[3]; /* Tsai and Wu's F_ij / sqrt(F_ii F_jj), 12 23 31 */
} OstStrength;

/* A material ready for use: definite, with what the kernels need. Made by ost_material_create_*; plain data, copy
 * freely. */
typedef struct OstMaterial {
    char name[64];
    double density; /* mass per volume; 0 if the scene has no use for it */
    int isotropic;  /* all nine constants those of an isotropic body: axes do not matter. Set it to 0 to keep the axes
                       for  an eigenstrain (ost_field_set_eigenstrain) */
    int incompressible; /* nu = 1/2 of the family or of isotropy: there is no C, and only a mixed form (ost_field_mixed)
                           can use the material */
    OstOrthotropic constants;
    double stiffness[36];  /* C in material axes: 3×3 normal block (NAN if incompressible), diagonal shear block */
    double compliance[36]; /* S = C^-1, eq. 4 */
    double condition;      /* largest over smallest eigenvalue of the normalised normal block */
    OstStrength strength;  /* 0 where nobody sets it */
} OstMaterial;

/* Local. Constants of the isotropic body, of the stable one-parameter family (eq. 18 and 22), and of the transversely
 * isotropic body with plane 1-2 and axis 3 (section 3.1; nu_pz and G_zp default, when NaN, to the family's eq. 20 and
 * 22). */
OstOrthotropic ost_orthotropic_isotropic(double youngs_modulus, double poissons_ratio);
OstOrthotropic ost_orthotropic_family(const double youngs_modulus[3], double nu, OstShearRule rule);
OstOrthotropic ost_orthotropic_transverse(double e_plane, double e_axis, double nu_plane, double nu_plane_axis,
                                          double g_axis);

/* Local. Which Young's modulus goes along which material axis: "E = 88 along e3 (the axis), 1 along e1 and e2". An axis
 * is called so where the material is transversely isotropic about it. */
enum { OST_MODULI_WORDS = 128 };
void ost_orthotropic_words(const OstOrthotropic *constants, char text[OST_MODULI_WORDS]);

/* Local. Does only the direction of axis 0, 1 or 2 matter: is the material transversely isotropic about it? */
int ost_orthotropic_is_transverse(const OstOrthotropic *constants, int axis);

/* Local. The shear moduli of eq. 22 for a rule. */
void ost_orthotropic_shear(const double youngs_modulus[3], double nu, OstShearRule rule, double shear_modulus[3]);

/* Local. The nine constants by name: `nu` holds nu12 nu21 nu23 nu32 nu31 nu13, NaN where not given, and one of each
 * pair is enough (nu_ij / E_i = nu_ji / E_j). `shear` is G12 G23 G31. Raises OST_INVALID_INPUT with `what` if a pair is
 * missing, if both of a pair are given and disagree by more than 1e-6 of the larger, or if a modulus is not positive.
 */
OstStatus ost_orthotropic_named(OstContext *ctx, const char *what, const double youngs[3], const double nu[6],
                                const double shear[3], OstOrthotropic *constants);

/* Local. Checks the constants and fills `material`. Definiteness is decided by the eigenvalues of the normalised normal
 * block (D^1/2 S_n D^1/2 with D = diag E: ones on the diagonal, -sqrt(nu_ij nu_ji) off it, signs kept). Raises
 * OST_INVALID_INPUT naming `name`, the violated inequality with its numbers, the largest stable value, and the stable
 * family as the way out. */
OstStatus ost_material_create(OstContext *ctx, const char *name, const OstOrthotropic *constants, double density,
                              OstMaterial *material);

/* Local. C in world axes, eq. 9: axes are rows e1, e2, e3 (so Q of the paper is their transpose). C may be any
 * symmetric 6×6 stiffness. */
void ost_material_rotate_stiffness(const double stiffness[36], const double axes[9], double rotated[36]);

/* Local. S in world axes, so that it stays the inverse of the rotated C. */
void ost_material_rotate_compliance(const double compliance[36], const double axes[9], double rotated[36]);

/* Local. A strain in world axes, from one along the axes e1, e2, e3 (rows). */
void ost_strain_to_world(const double strain[6], const double axes[9], double world[6]);

/* The criteria of failure that are known: Tsai and Wu's, Hill's, and the largest stress. */
typedef enum { OST_TSAI_WU, OST_HILL, OST_MAXIMUM_STRESS, OST_CRITERIA } OstCriterion;

/* A load factor says by how much a stress may grow until the material fails: below 1 it has failed. It is at most this
 * (also of no stress, and of stresses that a criterion allows whatever their size). */
#define OST_MOST_LOAD_FACTOR 1e9

/* Local. The load factor of a stress along the material axes (11 22 33 12 23 31), of known strengths. With F the
 * criterion's form, it is the f > 0 of F(f stress) = 1. Tsai and Wu: sum of (1/T_i - 1/C_i) s_i + s_i^2 / (T_i C_i)
 * + 2 F_ij s_i s_j + (s_ij / S_ij)^2. Hill: with X_i the
 * smaller of T_i and C_i, sum of 1/2 (1/X_j^2 + 1/X_k^2 - 1/X_i^2) (s_j - s_k)^2 + (s_ij / S_ij)^2. Largest stress:
 * each stress against its strength. */
double ost_load_factor(const OstStrength *strength, OstCriterion criterion, const double stress[6]);

/* Local. Do strengths differ from direction to direction, so that the material's axes count? Not of unknown ones. */
int ost_strength_has_directions(const OstStrength *strength);

/* Local. Does a criterion of these strengths leave stresses of any size unseen: is its form of second order not
 * positive (less than 0 in some direction)? */
int ost_criterion_is_open(const OstStrength *strength, OstCriterion criterion);

/* Local. Of strengths that are alike along the two axes across `axis` (0 to 2): the shear strength between these with
 * which a criterion does not depend on where they lie. 0: there is none, as the largest stress always does. */
double ost_criterion_even_shear(const OstStrength *strength, OstCriterion criterion, int axis);

/* How near constants are to losing definiteness. Of any constants with positive Young's moduli; Local. */

/* Eigenvalues, ascending, of the normalised normal block. */
OstStatus ost_orthotropic_eigenvalues(OstContext *ctx, const OstOrthotropic *constants, double eigenvalues[3]);

/* The Poisson's ratio of the isotropic material that has this least eigenvalue, 1 - 2 nu. It is to be held against
 * limits that people write, such as 0.45, so that it is given to 1e-12: rounding does not decide whether one is met. */
double ost_equivalent_poisson(double least_eigenvalue);

/* Does one mode of the normal strains, and no other, resist more than in an isotropic material of this Poisson's ratio?
 * Two such modes come with nu below -0.9. From the eigenvalues. */
int ost_has_one_stiff_mode(const double eigenvalues[3], double nu_limit);

/* The common factor up to which all Poisson's ratios may grow (below 1: they are too large already), from the
 * eigenvalues; INFINITY if all are 0. */
double ost_orthotropic_stable_scale(const double eigenvalues[3]);

/* The open range of each of nu12, nu23, nu31 that keeps the material definite with the other two as they are; NAN, NAN
 * where there is none. */
void ost_orthotropic_stable_range(const OstOrthotropic *constants, double low[3], double high[3]);

/* The paper's Fig. 1. For the naive choice nu12 = nu23 = nu31 = nu: points (E1/E2, E3/E2) on the boundary of the
 * stability region, `count` of them along equally spaced directions from the isotropic point (1, 1) in the plane of the
 * logarithms, by bisection on the smallest eigenvalue; `ratios` has count × 2. Raises OST_INVALID_INPUT unless -1 < nu
 * < 0.5 and nu is not 0 (where every ratio is stable). */
OstStatus ost_orthotropic_naive_boundary(OstContext *ctx, double nu, int count, double *ratios);

OST_API_END

#endif
