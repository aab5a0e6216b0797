/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_GRID_H
#define HARD_GRID_GRID_H

#include "problem/scene_data.h"

/* The hard grid: small bodies of every kind that solvers are known to fail on, each solved as a user's case would be
 * and compared with a direct solution of the same equations. A point of the grid is one body: */

enum {
    HARD_SHAPES = 8,
    HARD_ORDERS = 2,
    HARD_RATIOS = 3,   /* of Young's moduli: 1, 1e3, 1e6 */
    HARD_FAMILY = 5,   /* Poisson's ratios of the stable family */
    HARD_POISSONS = 7, /* those, and nine constants at 0.99 and 0.999 of the border of stability */
    HARD_AXES = 3,     /* aligned, cylindrical, random smooth */
    HARD_COLUMNS = HARD_AXES * (1 + 2 * 3),
    HARD_INCOMPRESSIBLE = HARD_POISSONS /* nu = 1/2 by the mixed form: points of their own */
};

/* What is wrong with a point that must be refused. */
typedef enum {
    HARD_SOUND,
    HARD_BEYOND_BORDER, /* nine constants at 1.001 of the border of stability */
    HARD_NU_HALF,       /* nu = 0.5, and no mixed form */
    HARD_LOOSE,         /* constrained at one vertex */
    HARD_INVERTED,      /* slivers with -1/1000 of their neighbours' volume */
    HARD_NOT_A_NUMBER,  /* for a load */
    HARD_FLAWS
} HardFlaw;

typedef struct HardPoint {
    int shape, order;
    int poisson;            /* 0 to HARD_POISSONS - 1, or HARD_INCOMPRESSIBLE */
    int ratio, stiff, axes; /* which ratio, the stiff direction (0 to 2), which axes */
    HardFlaw flaw;
    OstGlobal size; /* about so many unknowns; 0: the grid's own, a few thousand */
    int iterated;   /* without a factorisation; one at size is, unless `usual` */
    int usual;      /* at size: as a case is by default, with factors that fit and the mixed form */
    int iterations; /* at most, without a factorisation; 0: as a case has */
} HardPoint;

typedef enum {
    HARD_SOLVED,
    HARD_SOLVED_TO_ROUNDING, /* as far as double precision allows: the residual stays above 1e-8 */
    HARD_REFUSED,            /* rightly: it is flawed, or rounding the stiffness moves the solution by 10 % or more */
    HARD_GIVEN_UP,           /* refused, and should have been solved */
    HARD_FALSE,              /* reported as solved with a wrong answer, or solved where it had to be refused */
    HARD_OUTCOMES
} HardOutcome;

/* If rounding the stiffness moves the solution by more than this, double precision has no answer. */
extern const double hard_hopeless;

/* What an answer is off by, relative to the solution of the tets' equations (exact.h), in 2-norms. */
typedef struct HardErrors {
    int known;           /* has that solution settled? */
    double displacement; /* over all nodes */
    double reaction;     /* over constrained nodes */
    double stress;       /* over the tets' means */
} HardErrors;

/* What is known of the equations without the solver under test. */
typedef struct HardTruth {
    int known;            /* is there a direct solution? */
    int indefinite;       /* did rounding leave the stiffness not positive definite? */
    double error;         /* ||u - u*|| / ||u*||, 2-norms of all free displacements */
    HardErrors off;       /* of the answer, from the equations before their stiffness is rounded */
    double pressure;      /* of a mixed form: error of its pressures, in the norm of the energy */
    double size;          /* ||u*|| */
    double amplification; /* ||K^-1|| ||f|| / ||u*||, by the factors: bounds the error over the residual */
    double floor;         /* relative residual, in double precision, of u* itself rounded to double precision */
    double plain;         /* error of the factorisation's solution before any refinement */
    double residual;      /* of a body at size: relative, of the answer in the tets' equations, in 64 bits */
    double rounded; /* root mean square change of u*, relative, when every entry of K changes by 2^-53 of itself with
                       random sign; NAN where `plain` is small enough not to ask */
} HardTruth;

typedef struct HardReading {
    HardPoint point;
    HardOutcome outcome;
    OstStatus status;
    char reason[512]; /* of a refusal, or of the verdict */
    OstGlobal unknowns;
    OstMethod method;
    int iterations, steps; /* in all, by so many solver strategies */
    double residual;       /* true, relative, as the solver states it */
    double tet_residual;   /* the same as the checks state it, summed tet by tet */
    int rounding_limited;  /* did rounding keep the residual above 1e-8? */
    double stated_error;   /* relative error of the displacement as the program states it; NAN if it does not */
    double stated_forces;  /* the same of reactions and stresses */
    double digits; /* correct digits of the displacement: by the tets' equations, or where those could not be solved by
                      the direct solution; NAN if there is none */
    HardTruth truth;
    double seconds; /* of the solve, without the direct one */
} HardReading;

/* What is to be run. */
typedef struct HardRun {
    int wanted[HARD_SHAPES]; /* which shapes */
    int quick;               /* a sample in which every value of every parameter occurs */
    int mixed;               /* the points of the mixed form, and no others */
    OstGlobal size;          /* about so many unknowns, sound bodies alone, no factorisation; 0: the grid's own */
    int iterated;            /* solved without a factorisation */
    int usual;               /* with a size: as a case is by default, with factors that fit and the mixed form */
    int all;                 /* with a size: all points, and not the spread of six a shape and order */
    int iterations;          /* at most, without a factorisation; 0: as a case has */
    const char *like;        /* only points whose description has this; NULL: all */
    int sample;              /* so many of each shape, drawn with a fixed seed; 0: all */
} HardRun;

typedef struct HardReport {
    OstContext *ctx;
    HardRun run;
    int count;
    HardReading *reading;
    double seconds;
} HardReport;

/* Local. Names, values and words for tables. */
extern const char *const hard_outcome_name[HARD_OUTCOMES];
extern const double hard_ratio[HARD_RATIOS];
extern const double hard_nu[HARD_FAMILY];
extern const double hard_border[HARD_POISSONS - HARD_FAMILY];
const char *hard_shape_name(int shape);
int hard_find_shape(const char *name); /* or -1 */
void hard_describe_poisson(int poisson, char *text, size_t size);
void hard_describe_column(int column, char *text, size_t size);
void hard_describe(const HardPoint *point, char *text, size_t size);

/* Local. The column of the printed matrices that a point belongs to: ratio and stiff direction, then axes. */
int hard_column(const HardPoint *point);

/* Local. The points of a run. The caller frees them. */
OstStatus hard_points(OstContext *ctx, const HardRun *run, int *count, HardPoint **points);

/* A point's case, made in memory. It holds pointers into itself: it must not move. */
typedef struct HardCase {
    OstCase c;
    OstCaseMaterial material[2];
    OstConstraint constraint;
    OstLoad load;
    char *constrained, *pulled; /* names of boundaries */
} HardCase;

/* Local. The case of a point: shape, supports, load, materials. */
OstStatus hard_make_case(OstContext *ctx, const HardPoint *point, HardCase *hard);

/* Local: its parts. */
void hard_place(const HardPoint *point, HardCase *hard);
OstStatus hard_materials(OstContext *ctx, const HardPoint *point, HardCase *hard);

/* Collective. The mesh of a point: slivers and layers moved into place, inclusions marked, smooth axes laid on. */
OstStatus hard_make_chunk(const HardPoint *point, const OstCase *c, OstMeshChunk **chunk);

/* Local. Contrast of a shape's second region, 1 if it has none; origin and axis of its cylindrical axes. */
double hard_contrast(int shape);
void hard_cylinder(int shape, double origin[3], double axis[3]);

/* Collective. Assembles the scene's equations again, factors them, iterates with compensated residuals until the
 * solution is known to the last digits of double precision, or K turns out to be indefinite; then compares the result
 * (NULL: there is none) with it. */
OstStatus hard_find_truth(const OstScene *scene, const OstResult *result, HardTruth *truth);

/* Collective. The same of both equations of a mixed form; fills known, error, pressure and size alone. */
OstStatus hard_find_mixed_truth(const OstScene *scene, const OstResult *result, HardTruth *truth);

/* Collective. The same of a body that is too large to be factored: the residual in the tets' equations alone; of a
 * mixed form that of both, as forces. */
OstStatus hard_find_residual(const OstScene *scene, const OstResult *result, HardTruth *truth);
OstStatus hard_find_mixed_residual(const OstScene *scene, const OstResult *result, HardTruth *truth);

/* Collective. The same of one that is refused: fills indefinite and rounded, without factors (singular.h). */
OstStatus hard_find_singular(const OstScene *scene, HardTruth *truth);

/* Collective. Solves one point and judges it. Fails only if the grid itself cannot go on. */
OstStatus hard_read(OstContext *ctx, const HardPoint *point, HardReading *reading);

/* Local. Is what the program states of its answer's errors, of displacement and of reactions and stresses, at least a
 * third of the true ones and at most a thousand times them? True also where no true ones are known. */
int hard_states_its_error(const HardReading *reading);

/* Collective. Solves a scene, and compares and judges the answer as that of a sound body: one at size by its residual
 * in the tets' equations; if it is small, and any other, by a direct solution. */
OstStatus hard_solve_scene(OstScene *scene, HardReading *reading);

/* Collective. The same for a case file, printed; *passed: was the case refused, or are its errors stated rightly? */
OstStatus hard_read_case(OstContext *ctx, const char *path, int *passed);

/* Collective. All points of a run, with a progress line. */
OstStatus hard_run(OstContext *ctx, const HardRun *run, HardReport **report);
void hard_report_destroy(HardReport **report);
int hard_passed(const HardReport *report);

/* Local; rank 0 prints and writes. */
void hard_print(const HardReport *report);
OstStatus hard_write_json(const HardReport *report, const char *path);

#endif
