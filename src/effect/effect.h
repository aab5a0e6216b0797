/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_EFFECT_EFFECT_H
#define ORTHOSTAT_EFFECT_EFFECT_H

#include "orthostat/context.h"

/* The table of effects: the optional features of a model that a scene may need. `explain`, the plan and the ledger list
 * them, and code asks the table before it works on one. The work of an effect that is off is not called, and takes
 * neither memory nor time.
 * Columns: name, which is also its account in the ledger; label; the rule in src/effect/effect.c that decides if it is
 * on, gives the reason, and estimates its memory. */
#define OST_EFFECT_TABLE(X)                                                                   \
    X(OST_EFFECT_ORTHOTROPY, "orthotropy", orthotropy)                                        \
    X(OST_EFFECT_VARYING_AXES, "varying axes", varying_axes)                                  \
    X(OST_EFFECT_GRADIENT_AXES, "gradient axes", gradient_axes)                               \
    X(OST_EFFECT_REGIONS, "several materials", several_materials)                             \
    X(OST_EFFECT_JOINED_VERTICES, "joined vertices", joined_vertices)                         \
    X(OST_EFFECT_CLOSE_NODES, "close nodes", close_nodes)                                     \
    X(OST_EFFECT_WHOLE_INCLUSIONS, "whole inclusions", whole_inclusions)                      \
    X(OST_EFFECT_MIXED, "mixed form", mixed)                                                  \
    X(OST_EFFECT_MEAN_DILATATION, "mean dilatation", mean_dilatation)                         \
    X(OST_EFFECT_LARGE_ROTATION, "large rotation", large_rotation)                            \
    X(OST_EFFECT_BUCKLING, "buckling", buckling)                                              \
    X(OST_EFFECT_LINEAR_SPACE, "linear space", linear_space)                                  \
    X(OST_EFFECT_PRESCRIBED_DISPLACEMENT, "prescribed displacement", prescribed_displacement) \
    X(OST_EFFECT_SLIDING, "sliding support", sliding)                                         \
    X(OST_EFFECT_RIGID_FACE, "rigid face", rigid_face)                                        \
    X(OST_EFFECT_TIE, "tied faces", tie)                                                      \
    X(OST_EFFECT_PERIODIC, "periodic pairs", periodic)                                        \
    X(OST_EFFECT_FREE_BODY, "free body", free_body)                                           \
    X(OST_EFFECT_POINT_FORCE, "point force", point_force)                                     \
    X(OST_EFFECT_SURFACE_LOAD, "surface load", surface_load)                                  \
    X(OST_EFFECT_BODY_FORCE, "body force", body_force)                                        \
    X(OST_EFFECT_CENTRIFUGAL, "centrifugal load", centrifugal)                                \
    X(OST_EFFECT_MOMENT, "moment", moment)                                                    \
    X(OST_EFFECT_MOVED_COUPLING, "moved coupling", moved_coupling)                            \
    X(OST_EFFECT_FOLLOWER_PRESSURE, "follower pressure", follower_pressure)                   \
    X(OST_EFFECT_EIGENSTRAIN, "eigenstrain", eigenstrain)                                     \
    X(OST_EFFECT_FOUNDATION, "elastic foundation", foundation)                                \
    X(OST_EFFECT_SPRINGS, "springs", springs)                                                 \
    X(OST_EFFECT_PATH, "path", path)                                                          \
    X(OST_EFFECT_RECOVERY, "strain and stress", recovery)                                     \
    X(OST_EFFECT_STRENGTH, "strength", strength)                                              \
    X(OST_EFFECT_ERROR_ESTIMATE, "error estimate", error_estimate)                            \
    X(OST_EFFECT_ADAPTIVITY, "adaptive refinement", adaptivity)

#define OST_EFFECT_ENUM(name, label, rule) name,
typedef enum {
    OST_EFFECT_BEFORE_FIRST = OST_LEDGER_PHASES - 1,
    OST_EFFECT_TABLE(OST_EFFECT_ENUM) OST_EFFECT_END,
    OST_EFFECT_FIRST = OST_LEDGER_PHASES,
    OST_EFFECT_COUNT = OST_EFFECT_END - OST_EFFECT_FIRST
} OstEffect;
#undef OST_EFFECT_ENUM

/* What the rules use: counts and sizes of the whole body. */
typedef struct OstEffectFacts {
    int materials;                /* in use */
    int orthotropic, varying;     /* materials that are not isotropic; those of them whose axes vary */
    char orthotropic_reason[160]; /* of the first of them, in words */
    char varying_reason[160];
    const char *modulus_region;  /* a region whose Young's modulus is a field of the mesh file, or NULL */
    const char *gradient_region; /* a region whose axes follow potentials, or NULL */
    int directions;              /* materials whose axes follow directions within quadratic tets, or may */
    int nearly_incompressible;   /* materials with one stiff mode (ost_material_stiff_mode) */
    int mixed;                   /* 0: the case says no mixed form; 1: where it is useful */
    int quadratic;               /* are the tets quadratic? */
    int multigrid;               /* may the linear system be solved by multigrid? */
    int constraints, prescribed, slides, rigid_faces, ties, periodic;
    int free_body;
    int large_rotation; /* 0: off; 1: where linear theory is off by more than `accuracy`; 2: on */
    int factored;       /* are its corrections to be found by factors? */
    int buckling;       /* modes asked for */
    double accuracy;    /* relative */
    const char *formulation;
    int classical;          /* is it? */
    int path_steps, tables; /* outputs of the path, 0: no path; time tables */
    int loads, point_loads, surface_loads, body_loads, gravity_loads, follower_loads, centrifugal_loads;
    int moments;                      /* loads with a moment: those, and forces at a point */
    int moved_couplings;              /* loads whose motion is given */
    int moved_components;             /* of all of these */
    int cases;                        /* load cases */
    int springs, foundations;         /* entries of the case's springs, and those of them that are per area */
    const char *eigenstrained_region; /* a region with an eigenstrain, or NULL */
    int cell_fields; /* numbers a tet among the output fields that are recovered: strains, stresses, energy */
    int node_fields; /* numbers a node likewise */
    int strengths;   /* materials that state them */
    int error_field; /* is the error of the answer among them? */
    int watches;     /* quantities of interest */
    int asks_error;  /* is the mesh to be refined until the answer has the accuracy asked for? */
    int ranks;
    int stiff_welded, close_welded; /* are there stiff inclusions, close nodes that the partition keeps on one rank? */
    double merge;                   /* vertices no farther apart are joined; 0: none */
    double nodes, tets, regions;    /* of the mesh */
    double vertices, edges;         /* of its tets */
    uint64_t without;               /* effects that a study leaves out: bit e - OST_EFFECT_FIRST */
} OstEffectFacts;

/* An effect of one scene. `bytes`: estimated peak memory on one rank, without ghosts; 0 if it is negligible or not
 * known.
 */
typedef struct OstEffectState {
    int on;
    double bytes;
    char reason[160];
} OstEffectState;

/* Every effect, on or off, with the reason. Plain data. */
typedef struct OstEffects {
    OstEffectState state[OST_EFFECT_COUNT];
    const char *why_linear; /* why large rotations cannot be solved for, whatever the case asks; NULL: they can */
} OstEffects;

/* Local. Applies every rule of the table; what is left out is off. */
void ost_effects_find(const OstEffectFacts *facts, OstEffects *effects);

/* Local. Turns an effect off that a rule has turned on. */
void ost_effects_leave_out(OstEffects *effects, OstEffect effect, const char *reason);

/* Local. Is the mixed form on? Told before the others, as the solver's plan depends on it, and they on the plan. */
int ost_effects_mixed(const OstEffectFacts *facts);

/* Local. Gives the effects' accounts their labels in the ledger. */
void ost_effects_name_accounts(OstContext *ctx);

/* Local. Is an effect on? With NULL every effect is, since no scene says which are needed. */
int ost_effect_on(const OstEffects *effects, OstEffect effect);

/* Local. The effect's state: on or off, why, and its bytes. */
const OstEffectState *ost_effect_state(const OstEffects *effects, OstEffect effect);
const char *ost_effect_label(OstEffect effect);

#endif
