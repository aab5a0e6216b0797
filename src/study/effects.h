/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_EFFECTS_H
#define ORTHOSTAT_STUDY_EFFECTS_H

#include "study/forecast/meter.h"
#include "study/watch.h"

/* Which effects does a scene call for? The case is solved as it is, and once more for each effect that can be left out
 * (or put in): what that saves, and by how much it changes the answer. */

/* What a run does differently. Columns: name; the effect; what is said of it. Of the two for large rotation the one
 * runs where the case itself was solved for large rotation, the other where it was not. */
#define OST_VARIANT_TABLE(X)                                                                  \
    X(OST_VARIANT_ISOTROPIC, OST_EFFECT_ORTHOTROPY, "isotropic mean for orthotropy")          \
    X(OST_VARIANT_ONE_FRAME, OST_EFFECT_VARYING_AXES, "one frame for varying axes")           \
    X(OST_VARIANT_ONE_MATERIAL, OST_EFFECT_REGIONS, "one material for several")               \
    X(OST_VARIANT_NOT_MIXED, OST_EFFECT_MIXED, "mean dilatation for mixed form")              \
    X(OST_VARIANT_PLAIN_DILATATION, OST_EFFECT_MEAN_DILATATION, "without mean dilatation")    \
    X(OST_VARIANT_NOT_MOVED, OST_EFFECT_PRESCRIBED_DISPLACEMENT, "constraints held at zero")  \
    X(OST_VARIANT_CLAMPED, OST_EFFECT_SLIDING, "clamped where it slides")                     \
    X(OST_VARIANT_NO_RIGID_FACE, OST_EFFECT_RIGID_FACE, "without rigid faces")                \
    X(OST_VARIANT_NO_TIE, OST_EFFECT_TIE, "without tied faces")                               \
    X(OST_VARIANT_NO_PERIODIC, OST_EFFECT_PERIODIC, "without periodic pairs")                 \
    X(OST_VARIANT_NO_POINT_FORCE, OST_EFFECT_POINT_FORCE, "without point forces")             \
    X(OST_VARIANT_NO_SURFACE_LOAD, OST_EFFECT_SURFACE_LOAD, "without surface loads")          \
    X(OST_VARIANT_NO_BODY_FORCE, OST_EFFECT_BODY_FORCE, "without gravity and body forces")    \
    X(OST_VARIANT_NO_CENTRIFUGAL, OST_EFFECT_CENTRIFUGAL, "without centrifugal loads")        \
    X(OST_VARIANT_NO_MOMENT, OST_EFFECT_MOMENT, "without moments")                            \
    X(OST_VARIANT_NO_COUPLING, OST_EFFECT_MOVED_COUPLING, "without moved couplings")          \
    X(OST_VARIANT_NO_FOLLOWER, OST_EFFECT_FOLLOWER_PRESSURE, "without pressure that follows") \
    X(OST_VARIANT_NO_EIGENSTRAIN, OST_EFFECT_EIGENSTRAIN, "without eigenstrain")              \
    X(OST_VARIANT_NO_FOUNDATION, OST_EFFECT_FOUNDATION, "without elastic foundation")         \
    X(OST_VARIANT_NO_SPRINGS, OST_EFFECT_SPRINGS, "without springs")                          \
    X(OST_VARIANT_LINEAR, OST_EFFECT_LARGE_ROTATION, "linear theory for large rotation")      \
    X(OST_VARIANT_LARGE_ROTATION, OST_EFFECT_LARGE_ROTATION, "large rotation for linear theory")

#define OST_VARIANT_ENUM(name, effect, label) name,
typedef enum { OST_VARIANT_TABLE(OST_VARIANT_ENUM) OST_VARIANT_COUNT } OstVariant;
#undef OST_VARIANT_ENUM

typedef enum { OST_VARIANT_OFF, OST_VARIANT_SOLVED, OST_VARIANT_FAILED, OST_VARIANT_UNMEASURED } OstVariantState;

/* One solve. Changes are relative to the case as it is; NaN where there is nothing to compare. */
typedef struct OstEffectRun {
    OstVariantState state;            /* OFF: the case does not have the effect */
    char reason[OST_ERROR_TEXT_SIZE]; /* of one that failed, or is not measured */
    OstMeter meter;
    OstGlobal unknowns;
    int iterations;
    int large_rotation; /* was it solved for? */
    double pose;        /* largest |u - u0| of a node over the largest |u0| */
    double energy;      /* of the strain energy */
    double energy_scale;
    OstWatched watched[OST_MOST_WATCHES];
    double watch[OST_MOST_WATCHES]; /* change over the size of the quantity, or of its kind where that is larger */
} OstEffectRun;

typedef struct OstEffectStudy {
    OstContext *ctx;
    const OstCase *c;
    OstEffectRun base; /* the case as it is */
    OstEffectRun run[OST_VARIANT_COUNT];
} OstEffectStudy;

/* Local. Does a variant apply to the case, given its effects and how it was solved? */
int ost_variant_applies(const OstEffectStudy *study, const OstEffects *effects, OstVariant variant);

/* Local. Why a variant that applies cannot be run, or NULL. */
const char *ost_variant_why_unmeasured(const OstEffects *effects, OstVariant variant);

extern const char *const ost_variant_label[]; /* by OstVariant */
extern const OstEffect ost_variant_effect[];

/* Collective. Solves the case, and every variant of it that its effects allow. Raises what solving the case raises; a
 * variant that fails is listed with its reason. */
OstStatus ost_effect_study(const OstCase *c, OstEffectStudy *study);

/* Local. The largest change of pose, energy and quantities of interest. */
double ost_effect_change(const OstEffectStudy *study, const OstEffectRun *run);

/* Local; rank 0 prints: a table, and which effects change the answer by less than the accuracy asked for. */
void ost_effect_study_print(const OstEffectStudy *study);

/* Local; rank 0 writes the study as JSON, to standard output for "-". */
OstStatus ost_effect_study_write_json(const OstEffectStudy *study, const char *path);

/* A case with one effect left out: a copy of `c` that shares all but what is replaced. */
typedef struct OstVariantCase {
    OstCase c;
    OstCaseMaterial *materials;
    OstConstraint *constraints;
} OstVariantCase;

/* Collective. Makes the case of a variant from the solved scene, whose materials and axes are averaged where the
 * variant wants a mean: moduli by their geometric mean; a frame by the mean of e_k e_k', the best aligned axis first;
 * of several materials the one that fills the largest volume counts. Release it in any case. */
OstStatus ost_variant_case(const OstScene *scene, OstVariant variant, OstVariantCase *made);
void ost_variant_case_release(OstVariantCase *made);

#endif
