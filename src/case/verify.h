/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_VERIFY_H
#define ORTHOSTAT_CASE_VERIFY_H

#include "case/case_data.h"

/* The `verify` section of a case: a formula, the quantities that it predicts, the ladder of meshes on which these are
 * measured, and the limits to pass. Plain data, owned by the case. */

typedef enum {
    OST_MEASURE_DISPLACEMENT, /* mean over faces (over vertices if there is no whole face) along a direction */
    OST_MEASURE_STRESS,       /* mean of a component over faces */
    OST_MEASURE_REACTION,     /* sum along a direction */
    OST_MEASURE_ENERGY,       /* strain energy of the body */
    OST_MEASURE_FIELD         /* norm of the difference from the formula's field */
} OstMeasureKind;

/* Directions that depend on the place: away from the z axis, and away from the origin. */
typedef enum { OST_ALONG_FIXED, OST_ALONG_CYLINDER_RADIUS, OST_ALONG_SPHERE_RADIUS } OstAlong;

/* Components of stress in world axes, and in cylindrical coordinates about the z axis. */
typedef enum {
    OST_STRESS_XX,
    OST_STRESS_YY,
    OST_STRESS_ZZ,
    OST_STRESS_XY,
    OST_STRESS_YZ,
    OST_STRESS_ZX,
    OST_STRESS_RADIAL,
    OST_STRESS_HOOP
} OstStressComponent;

typedef enum {
    OST_NORM_DISPLACEMENT,
    OST_NORM_ENERGY,
    OST_NORM_PRESSURE
} OstFieldNorm; /* L2 of u; energy norm; L2 of
                   a mixed form's pressure */

#define OST_RATE_LOCKED 0.0

enum { OST_MOST_VERIFY_STEPS = 4, OST_MOST_VERIFY_LEVELS = 8, OST_MOST_FORMULA_PARAMETERS = 8 };

typedef struct OstVerifyQuantity {
    char *name;
    int line;
    OstMeasureKind kind;
    OstSelection on;
    OstAlong along;      /* DISPLACEMENT, REACTION */
    double direction[3]; /* along FIXED */
    OstStressComponent component;
    OstFieldNorm norm;
    double scale;                        /* factor on the measured value */
    char *expected_name;                 /* a value of the formula, or NULL */
    double expected;                     /* unless expected_name or FIELD */
    double error[OST_MOST_VERIFY_STEPS]; /* relative, on the finest mesh; one for each step of the ladder */
    double rate[OST_MOST_VERIFY_STEPS];  /* order of convergence in theory, of which 0.9 must be seen; NAN (the word
                                            exact): the elements hold the solution, and the error is within its limit on
                                            every mesh; OST_RATE_LOCKED (the word locks): the program warns of locking,
                                            and the error falls to within half its limit and its limit */
} OstVerifyQuantity;

/* One order of elements, on successively refined meshes. */
typedef struct OstVerifyStep {
    int order;
    int level_count, quick_count;           /* all, and how many of them --quick runs */
    int refinement[OST_MOST_VERIFY_LEVELS]; /* consecutive */
} OstVerifyStep;

typedef struct OstVerify {
    int line;
    char *formula;
    char *source; /* where the formula, or the number, is from */
    int parameter_count;
    char *parameter_name[OST_MOST_FORMULA_PARAMETERS];
    double parameter[OST_MOST_FORMULA_PARAMETERS];
    int step_count;
    OstVerifyStep step[OST_MOST_VERIFY_STEPS];
    int quantity_count;
    OstVerifyQuantity *quantity;
} OstVerify;

#endif
