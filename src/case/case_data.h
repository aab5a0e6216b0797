/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_CASE_DATA_H
#define ORTHOSTAT_CASE_CASE_DATA_H

#include "case/probe/read_probe.h"
#include "case/yaml/tree.h"
#include "fields/stress_measure.h"
#include "mesh/mesh_data.h"
#include "orthostat/axes.h"
#include "orthostat/case.h"
#include "orthostat/formulation.h"
#include "orthostat/material.h"
#include "orthostat/time_table.h"

/* A case as its YAML file states it. Plain data; every pointer is owned by the case. */

typedef enum {
    OST_SELECT_ALL,
    OST_SELECT_BOUNDARY, /* named groups of points, curves or faces */
    OST_SELECT_PLANE,    /* |(x - point)·normal| <= tolerance */
    OST_SELECT_BOX,
    OST_SELECT_SPHERE,
    OST_SELECT_CYLINDER, /* inside an infinite cylinder, or between two radii */
    OST_SELECT_VERTICES, /* labels, or a .bou file */
    OST_SELECT_NEAREST   /* the one vertex nearest to a point */
} OstSelectionKind;

typedef struct OstSelection {
    OstSelectionKind kind;
    OstPlace place;
    OstNames boundaries; /* BOUNDARY */
    double point[3];     /* PLANE, SPHERE centre, CYLINDER origin, NEAREST; BOX minimum */
    double direction[3]; /* PLANE normal, CYLINDER axis; BOX maximum */
    double radii[2];     /* SPHERE, CYLINDER: inner (default 0) and outer */
    double
        tolerance; /* PLANE, BOX, SPHERE, CYLINDER: how far outside still counts; negative: 1e-6 of the body's size */
    OstGlobal range_count; /* VERTICES: labels, as ascending ranges that do not touch; read from vertices_file if there
                              is one */
    OstLabelRange *ranges;
    char *vertices_file; /* resolved path, or NULL */
} OstSelection;

typedef enum {
    OST_CONSTRAIN_DISPLACEMENT,
    OST_CONSTRAIN_SLIDE,
    OST_CONSTRAIN_RIGID,   /* the selection moves as a rigid body */
    OST_CONSTRAIN_TIED,    /* its vertices follow other faces */
    OST_CONSTRAIN_PERIODIC /* opposite boundaries move alike, but for a mean strain */
} OstConstraintKind;

typedef struct OstConstraint {
    OstConstraintKind kind;
    int line;
    OstSelection on;    /* not used by PERIODIC */
    int constrained[3]; /* DISPLACEMENT, RIGID: is the component constrained? (0: the word free) */
    int exact[3];       /* DISPLACEMENT: is it prescribed by the formula (the word exact)? See assembly/closed_form.h */
    double displacement[3]; /* DISPLACEMENT, RIGID: the prescribed value, at factor 1 */
    int table;              /* 0 if it grows with t, or 1 + its place in the case's tables */
    double normal[3];       /* SLIDE: the plane's normal */
    double point[3];        /* RIGID */
    int turn_constrained[3];
    double rotation[3];
    OstSelection to;  /* TIED: the faces that are followed */
    double tolerance; /* TIED: how far away; negative: 1e-3 of the body's size */
    int pair_count;   /* PERIODIC */
    char *pair[3][2]; /* names of boundaries: those that lead, those that follow */
    double strain[6]; /* xx yy zz xy yz zx, of the tensor */
} OstConstraint;

/* Local. Does a constraint prescribe a displacement, a rotation or a strain other than zero? */
static inline int ost_constraint_moves(const OstConstraint *constraint)
{
    const OstConstraint *k = constraint;
    int moves = k->exact[0] || k->exact[1] || k->exact[2];
    for (int i = 0; i < 6; i++)
        moves |= k->strain[i] != 0.0 || (i < 3 && (k->displacement[i] != 0.0 || k->rotation[i] != 0.0));
    return moves;
}

/* Local. Does a constraint make vertices follow others? */
static inline int ost_constraint_links(const OstConstraint *constraint)
{
    return constraint->kind >= OST_CONSTRAIN_RIGID;
}

/* Local. Of a rigid face: is a part of its rotation's vector given? But for a hinge, which turns about its axis. */
static inline int ost_constraint_gives_part(const OstConstraint *constraint)
{
    int given = 0, zero = 1;
    for (int i = 0; i < 3; i++) {
        given += constraint->turn_constrained[i] != 0;
        zero &= constraint->rotation[i] == 0.0;
    }
    return given == 1 || (given == 2 && !zero);
}

typedef enum {
    OST_LOAD_TOTAL_FORCE, /* over the selection */
    OST_LOAD_POINT_FORCE, /* on each selected vertex */
    OST_LOAD_TRACTION,
    OST_LOAD_PRESSURE,
    OST_LOAD_GRAVITY,
    OST_LOAD_BODY_FORCE,
    OST_LOAD_CENTRIFUGAL,
    OST_LOAD_MOMENT,      /* over the selection */
    OST_LOAD_DISTRIBUTING /* a force and a moment at a point that move the selection, in the mean, as given */
} OstLoadKind;

typedef enum { OST_SHARE_AUTO, OST_SHARE_FACES, OST_SHARE_VERTICES } OstShare;

typedef struct OstLoad {
    OstLoadKind kind;
    int line;
    OstSelection on; /* not used by loads in the volume (ost_load_in_volume) */
    char *region;    /* loads in the volume: NULL for all */
    OstPlace region_place;
    double vector[3];
    double origin[3], axis[3], speed; /* CENTRIFUGAL: a point of the axis, its direction, radians per time */
    int acts_at;                      /* TOTAL_FORCE: does the force act at the point `at`? */
    double at[3];                     /* and DISTRIBUTING */
    int moved[6];     /* DISTRIBUTING: which components of displacement and rotation at the point are given? */
    double motion[6]; /* and what they are */
    double pressure;
    int follows;    /* PRESSURE: does it follow the surface? */
    int exact;      /* TRACTION, BODY_FORCE: by the formula (the word exact)? */
    int chosen;     /* is it of one load case, or set from outside the file (case/yaml/set.h)? It may well be zero */
    int table;      /* 0 if it grows with t, or 1 + its place in the case's tables */
    OstShare share; /* TOTAL_FORCE: by area over faces, or equally over vertices; AUTO: faces if the selection has any
                       (never for VERTICES and NEAREST, which are read as share: vertices) */
} OstLoad;

/* Local. Does a load act in the volume, not where a selection says? */
static inline int ost_load_in_volume(OstLoadKind kind)
{
    return kind == OST_LOAD_GRAVITY || kind == OST_LOAD_BODY_FORCE || kind == OST_LOAD_CENTRIFUGAL;
}

typedef enum { OST_SPRING_FOUNDATION, OST_SPRING_POINT } OstSpringKind;

/* Springs between vertices, or a surface, and the ground. */
typedef struct OstSpring {
    OstSpringKind kind;
    int line;
    OstSelection on;
    double along, across; /* stiffness along `direction` and across it: per area, or of each vertex */
    double direction[3];  /* unit; zero: the surface's normal, or none where along = across */
} OstSpring;

/* Young's modulus tet by tet: factor × field^power, not below `least`; that of the material is multiplied by it. */
typedef struct OstModulusField {
    char *field; /* NULL: there is none */
    OstPlace place;
    double factor, power, least;
} OstModulusField;

typedef struct OstCaseMaterial {
    char *region; /* "all" or a region's name */
    OstPlace region_place, axes_place;
    int line;
    OstMaterial material;
    double eigenstrain[6]; /* in material axes, 11 22 33 12 23 31, engineering shear; one that has directions makes the
                              material count as not isotropic, so that its axes are kept */
    int eigenstrained;     /* does the case state one? */
    char *eigen_field;     /* the mesh file's field of it, tet by tet; or NULL */
    OstPlace eigen_place;
    int eigen_per_unit; /* the field is the change that `eigenstrain` is multiplied by, not the strain itself */
    OstModulusField modulus;
    OstAxesSpec axes;
    int axes_asked_for; /* isotropic, but something is asked for along its axes, so that these are kept */
} OstCaseMaterial;

/* A field of the mesh file that a material asks for: numbers, a direction that has no sense, or e1, e2 and e3. */
typedef enum { OST_CASE_FIELD_OF_NUMBERS, OST_CASE_FIELD_OF_DIRECTIONS, OST_CASE_FIELD_OF_AXES } OstCaseFieldUse;
typedef struct OstCaseField {
    const char *name; /* a material's */
    OstPlace place;
    OstCaseFieldUse use;
} OstCaseField;

/* A quantity of interest; `orthostat cost` finds what its error costs. */
typedef enum {
    OST_WATCH_DISPLACEMENT,
    OST_WATCH_REACTION,
    OST_WATCH_STRAIN_ENERGY,
    OST_WATCH_STRESS,
    OST_WATCH_LOAD_FACTOR /* the least of a region, to failure */
} OstWatchKind;

/* What is taken of the stresses of a region. */
typedef enum { OST_TAKE_MEAN, OST_TAKE_LEAST, OST_TAKE_LARGEST } OstTake;

enum {
    OST_WATCH_LENGTH = 3, /* instead of a component */
    OST_MOST_WATCHES = 20
};

typedef struct OstWatch {
    char *name;
    OstWatchKind kind;
    int line;
    OstSelection on; /* DISPLACEMENT: NEAREST, of the vertices; REACTION: any, summed up; not used by the others */
    int of_moment;   /* REACTION: the moment of the reactions about the point `about`? */
    double about[3];
    int component; /* 0 to 2, or OST_WATCH_LENGTH; STRESS: OstStressMeasure; LOAD_FACTOR: OstCriterion, or OST_CRITERIA
                      for the least of all */
    char *region;  /* STRESS, LOAD_FACTOR: of the tets of a region, or "all"; NULL: at the point `at` */
    OstPlace region_place;
    double at[3];
    OstTake take;
    double expected; /* NAN if not known */
    char *source;    /* where `expected` is from, or NULL */
} OstWatch;

/* Is it made of the stress? */
static inline int ost_watch_is_of_stress(const OstWatch *watch)
{
    return watch->kind == OST_WATCH_STRESS || watch->kind == OST_WATCH_LOAD_FACTOR;
}

typedef enum {
    OST_MESH_TUBE,
    OST_MESH_BLOCK,
    OST_MESH_SECTOR,
    OST_MESH_OCTANT,
    OST_MESH_FILE,
    OST_MESH_FROM_PROGRAM /* the word from_program: who creates the scene passes the mesh */
} OstMeshKind;

/* Is the case solved for large rotations? AUTO: where linear theory is off by more than the accuracy asked for. */
typedef enum { OST_LARGE_ROTATION_AUTO, OST_LARGE_ROTATION_ON, OST_LARGE_ROTATION_OFF } OstLargeRotation;

/* One of several loadings of the body. */
typedef struct OstLoadCase {
    char *name;
    int line;
    struct OstCase *c; /* a case with what is stated for all, and its own */
} OstLoadCase;

/* Values for one number of the case, or for any key (case/yaml/set.h). */
typedef struct OstSweepKey {
    char *key;
    int count;
    char **value; /* as they are written */
} OstSweepKey;

struct OstCase {
    OstContext *ctx;
    char *path; /* of the case file */
    char *title;
    OstMeshKind mesh_kind;
    OstTubeShape tube;
    OstBlockShape block;
    OstSectorShape sector;
    OstOctantShape octant;
    char *mesh_file; /* resolved path */
    OstPlace mesh_place;
    double merge;   /* FILE: vertices no farther apart than this are joined; 0: none are */
    int refinement; /* uniform refinements; each splits a tet into eight */
    int order;      /* of the elements: 1 or 2; 0: as the mesh has it */
    int straighten; /* curved tets that fold over are made straight */
    int unmixed;    /* no mixed form, also where it is useful */
    int material_count;
    OstCaseMaterial *materials;
    int free_body; /* the word free_body in place of constraints: loads balance each other */
    int constraint_count;
    OstConstraint *constraints;
    int load_count;
    OstLoad *loads;
    int spring_count;
    OstSpring *springs;
    OstLargeRotation large_rotation;
    int buckling_modes;         /* asked for; 0: none */
    OstFormulation formulation; /* of large rotations */
    int path_steps;             /* outputs of the path; 0: there is none, and the answer is that at t = 1 */
    double *path_times;         /* of the outputs, ascending, not negative */
    int table_count;
    OstTimeTable *tables; /* of loads and prescribed displacements, each different */
    int first_table_line;
    int field_count; /* fields of the mesh file that the materials ask for, each once */
    OstCaseField fields[OST_MOST_TET_FIELDS];
    int eigen_table;    /* which of them the eigenstrains follow: 0 if they grow with t, or 1 + its place */
    uint64_t text_hash; /* of the case's text */
    int watch_count;
    OstWatch *watches;
    struct OstVerify *verify; /* case/verify.h; NULL if the case has no such section */
    OstSolverOptions solver;  /* defaults, overridden by the accuracy and solver sections */
    double relative_error;    /* of the answer, that is asked for: what changes it by less may be left out */
    int interest;      /* 1 + the number of the watched quantity that relative_error is of; 0: of the energy norm */
    int asks_error;    /* does the case give relative_error? Then meshes are refined until it is met */
    char *output_file; /* as written: relative to the caller's directory; or NULL */
    unsigned output_fields; /* bits of OstOutputField */
    unsigned named_fields;  /* of them those that the case lists, */
    int fields_line;        /* and where */
    int probe_count;
    OstProbe *probes;    /* tables of points, beside the output file */
    int envelope;        /* the line that asks for one of the load cases; 0: none is written */
    int load_case_count; /* 0: there are none. Else loads, supports and springs above are those of all */
    OstLoadCase *load_cases;
    int sweep_count; /* of keys */
    OstSweepKey *sweep;
    uint64_t without; /* effects that a study leaves out: bit e - OST_EFFECT_FIRST */
};

/* The text of a case, and changes to it (case/yaml/set.h). */
typedef struct OstCaseText {
    const char *bytes;
    size_t size;
    int settings;
    const char *const *setting; /* "KEY=VALUE" */
    int swept;                  /* of the settings the last ones, none of which may change what another one sets */
} OstCaseText;

/* Collective. The bytes of a case file, or for "-" of standard input, read by rank 0; the caller's to free. */
OstStatus ost_case_bytes(OstContext *ctx, const char *path, char **bytes, size_t *size);

/* Collective. ost_case_read of that text. */
OstStatus ost_case_make(OstContext *ctx, const char *path, const OstCaseText *text, OstCase **c);

/* Local. Puts in place of a case the one of its load cases that has this name. Raises OST_INVALID_USAGE with the names
 * there are. */
OstStatus ost_case_pick(OstCase **c, const char *name);

/* Local. Where all load cases are taken: can the envelope that may be asked for be made of them? */
OstStatus ost_case_check_envelope(const OstCase *c);

/* Local. The fields that are to be recovered: those of the output, and what quantities of interest are made of. */
unsigned ost_case_recovers(const OstCase *c);

/* Local. The algebraic_fraction of a case that gives none. */
double ost_case_stop_fraction(const OstCase *c);

/* Local. Puts the place in front of a failure from a deeper call, as "path:line:column: text"; passes success on. */
OstStatus ost_case_located(const OstCase *c, OstPlace place, OstStatus status);

/* Local. Materials by region: "all" stands for every region, and later entries override earlier ones. The entry that
 * counts for a region of the mesh; NULL if there is none. */
int ost_is_every_region(const char *name);
const OstCaseMaterial *ost_case_material_of(const OstCase *c, const char *region);

/* Local. Warns of a stress that is watched at a point of this region along axes of which one is stated and the others
 * lie anywhere, unless that was true of every region, which reading the case has warned of. */
void ost_warn_arbitrary_point(const OstCase *c, const OstWatch *watch, const char *region);

/* Local. The number of a field that a material asks for, or -1. */
int ost_case_find_field(const OstCase *c, const char *name);

/* Local. Does a strain differ from direction to direction? */
int ost_strain_has_directions(const double strain[6]);

/* Collective. The selected nodes (local numbers, owned and ghosts alike; account OST_LEDGER_SELECTION) in memory from
 * the context, the caller's to free. Raises OST_INVALID_INPUT with the case's line if a name does not exist (naming
 * those that do), a label is not in the mesh, or nothing is selected. */
OstStatus ost_select_nodes(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, OstLocal *count,
                           OstLocal **nodes);

/* Collective. The selected faces, outward: items of 2-D boundaries, or faces of the body's surface all of whose nodes
 * are selected. `faces` has `count` × *nodes_per_face local node numbers. A count of 0 on all ranks is no error here.
 */
OstStatus ost_select_faces(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, OstLocal *count,
                           int *nodes_per_face, OstLocal **faces);

/* Local. Raises OST_INVALID_INPUT at the line of a force or spring that acts on each vertex of a boundary or the like:
 * a finer mesh has more of them, and so another load. `to`: what cannot be done so, as "To ask for an accuracy". */
OstStatus ost_case_check_finer(const OstCase *c, const char *to);

/* Local. Do supports, springs and loads act on the same part of the body on finer meshes? Not on what a box, a sphere
 * or a cylinder selects, nor on each vertex of a boundary; nor where faces are tied or moved in the mean. */
int ost_case_stays(const OstCase *c);

#endif
