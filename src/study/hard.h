/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_HARD_H
#define ORTHOSTAT_STUDY_HARD_H

#include "orthostat/scene.h"

/* The hard grid: small bodies of every kind that solvers are known to fail on, each solved as a user's case would be
 * and held against a direct solution of the same equations, or refused. A point of the grid is one body: */

enum {
    OST_HARD_SHAPES = 8,
    OST_HARD_ORDERS = 2,
    OST_HARD_RATIOS = 3,   /* of Young's moduli: 1, 1e3, 1e6 */
    OST_HARD_FAMILY = 5,   /* Poisson's ratios of the stable family */
    OST_HARD_POISSONS = 7, /* those, and nine constants at 0.99 and 0.999 of the border of stability */
    OST_HARD_AXES = 3,     /* aligned, cylindrical, random smooth */
    OST_HARD_COLUMNS = OST_HARD_AXES * (1 + 2 * 3)
};

/* What is wrong with a point that has to be refused. */
typedef enum {
    OST_HARD_SOUND,
    OST_HARD_BEYOND_BORDER, /* nine constants at 1.001 of the border of stability */
    OST_HARD_NU_HALF,       /* nu = 0.5 */
    OST_HARD_LOOSE,         /* held at one vertex */
    OST_HARD_INVERTED,      /* slivers with -1/1000 of their neighbours' volume */
    OST_HARD_NOT_A_NUMBER,  /* for a load */
    OST_HARD_FLAWS
} OstHardFlaw;

typedef struct OstHardPoint {
    int shape, order;
    int poisson;            /* 0 to OST_HARD_POISSONS - 1 */
    int ratio, stiff, axes; /* which ratio, the stiff direction (0 to 2), which axes */
    OstHardFlaw flaw;
} OstHardPoint;

typedef enum {
    OST_HARD_SOLVED,
    OST_HARD_SOLVED_TO_ROUNDING, /* to what double precision holds, which is less than 1e-8 */
    OST_HARD_REFUSED,            /* rightly: it is flawed, or double precision holds not one digit of it */
    OST_HARD_GIVEN_UP,           /* refused, and should have been solved */
    OST_HARD_FALSE,              /* said to be solved, and is not; or solved where it had to be refused */
    OST_HARD_OUTCOMES
} OstHardOutcome;

/* The move that rounding the stiffness makes, from which on double precision is said to hold no answer. */
extern const double ost_hard_hopeless;

/* What is known of the equations without the recipe under test. */
typedef struct OstHardTruth {
    int known;            /* is there a direct solution? */
    int indefinite;       /* did rounding leave the stiffness not positive definite? */
    double error;         /* ||u - u*|| / ||u*||, 2-norms of all free displacements */
    double size;          /* ||u*|| */
    double amplification; /* ||K^-1|| ||f|| / ||u*||, by the factors: error allowed by a residual, over that residual */
    double floor;         /* relative residual, in double precision, of u* itself rounded to double precision */
    double plain;   /* error of a factorisation's solution as it comes, unrefined: about what conditioning costs */
    double rounded; /* how far u* moves when every entry of K does by 2^-53 of itself, root of the mean square over
                       signs at random; NAN where the factors leave five digits, and nobody asked */
} OstHardTruth;

typedef struct OstHardReading {
    OstHardPoint point;
    OstHardOutcome outcome;
    OstStatus status;
    char reason[512]; /* of a refusal, or of the verdict */
    OstGlobal unknowns;
    OstRecipe recipe;
    int iterations, steps; /* in all, over so many rungs of the ladder */
    double residual;       /* true, relative */
    int rounding_limited;  /* is that what double precision holds, and not 1e-8? */
    double stated_error;   /* of the displacement, relative, as the solver says of its equations; NAN if it does not */
    double digits;         /* of the displacement, against the direct solution; NAN if there is none */
    OstHardTruth truth;
    double seconds; /* of the solve, the direct one left out */
} OstHardReading;

typedef struct OstHardReport {
    OstContext *ctx;
    int quick;
    int count;
    OstHardReading *reading;
    double seconds;
} OstHardReport;

/* Local. Names, values and words for tables. */
extern const char *const ost_hard_outcome_name[OST_HARD_OUTCOMES];
extern const double ost_hard_ratio[OST_HARD_RATIOS];
extern const double ost_hard_nu[OST_HARD_FAMILY];
extern const double ost_hard_border[OST_HARD_POISSONS - OST_HARD_FAMILY];
const char *ost_hard_shape_name(int shape);
int ost_hard_find_shape(const char *name); /* or -1 */
void ost_hard_describe_poisson(int poisson, char *text, size_t size);
void ost_hard_describe_column(int column, char *text, size_t size);
void ost_hard_describe(const OstHardPoint *point, char *text, size_t size);

/* Local. The column of the printed matrices that a point belongs to: ratio and stiff direction, then axes. */
int ost_hard_column(const OstHardPoint *point);

/* Local. All points of the shapes marked in `wanted`, or with `quick` a sample in which every value of every parameter
 * occurs; the caller's to free. */
OstStatus ost_hard_points(OstContext *ctx, const int wanted[OST_HARD_SHAPES], int quick, int *count,
                          OstHardPoint **points);

/* A point's case, made in memory. It holds pointers into itself: it must not move. */
typedef struct OstHardCase {
    OstCase c;
    OstCaseMaterial material[2];
    OstConstraint constraint;
    OstLoad load;
    char *held, *pulled; /* names of boundaries */
} OstHardCase;

/* Local. The case of a point: shape, supports, load, materials. */
OstStatus ost_hard_make_case(OstContext *ctx, const OstHardPoint *point, OstHardCase *hard);

/* Local: its parts. */
void ost_hard_place(const OstHardPoint *point, OstHardCase *hard);
OstStatus ost_hard_materials(OstContext *ctx, const OstHardPoint *point, OstHardCase *hard);

/* Collective. The mesh of a point: slivers and layers moved into place, inclusions marked, smooth axes laid on. */
OstStatus ost_hard_make_chunk(const OstHardPoint *point, const OstCase *c, OstMeshChunk **chunk);

/* Local. Contrast of a shape's second region, 1 if it has none; origin and axis of its cylindrical axes. */
double ost_hard_contrast(int shape);
void ost_hard_cylinder(int shape, double origin[3], double axis[3]);

/* Collective. Assembles the scene's equations afresh, factors them, iterates with residuals in twofold precision until
 * the solution stands to the last digits of double precision, or is seen not to exist, and holds the result (NULL:
 * there is none) against it. */
OstStatus ost_hard_find_truth(const OstScene *scene, const OstResult *result, OstHardTruth *truth);

/* Collective. Solves one point and judges it; fails only where the grid itself cannot go on. */
OstStatus ost_hard_read(OstContext *ctx, const OstHardPoint *point, OstHardReading *reading);

/* Collective. All points, with a line of progress. */
OstStatus ost_hard_run(OstContext *ctx, const int wanted[OST_HARD_SHAPES], int quick, OstHardReport **report);
void ost_hard_report_destroy(OstHardReport **report);
int ost_hard_passed(const OstHardReport *report);

/* Local; rank 0 prints and writes. */
void ost_hard_print(const OstHardReport *report);
OstStatus ost_hard_write_json(const OstHardReport *report, const char *path);

#endif
