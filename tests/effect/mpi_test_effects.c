/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "adapt/adapt.h"
#include "core/memory.h"
#include "problem/scene_data.h"

/* Every effect of the table is solved with once and without once, and the ledger is held to the table: what is off is
 * not called, holds no byte and takes no second; what is on is called. */

#define BLOCK "mesh: {block: {size: [2, 1, 1], divisions: [8, 4, 4]}}\n"
#define QUADRATIC BLOCK "element: {order: 2}\n"
#define SOFT "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3, density: 1}]\n"
#define RUBBER "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.49}]\n"
#define STIFF(axes) "materials: [{region: all, youngs_modulus: [1e6, 2e6, 4e6], poissons_ratio: 0.3" axes "}]\n"
#define CYLINDER "axes: {cylindrical: {origin: [0, 9, 9], axis: [1, 0, 0], order: [axial, radial, tangential]}}"
#define GRADIENTS "axes: {gradient: {e1: {from: xmin, to: xmax}, e2: {from: ymin, to: ymax}}}"
#define TWO                                                                       \
    "materials:\n  - {region: block, youngs_modulus: 1e6, poissons_ratio: 0.3}\n" \
    "  - {region: core, youngs_modulus: 2e6, poissons_ratio: 0.3}\n"
#define SPECKS                                                                    \
    "materials:\n  - {region: block, youngs_modulus: 1e6, poissons_ratio: 0.3}\n" \
    "  - {region: core, youngs_modulus: 1e11, poissons_ratio: 0.3}\n"
#define LAYERED "mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 40]}}\n"
#define TORN_FILE "mesh: {file: torn.veg, merge: 0.01}\n"
#define WHOLE_FILE "mesh: {file: torn.veg}\n"
#define CORNERS                                                                                    \
    "constraints:\n  - {on: {box: {min: [0, 0, 0], max: [1, 1, 0.1]}}, displacement: [0, 0, 0]}\n" \
    "  - {on: {box: {min: [0, 0, 0.9], max: [0.1, 0.1, 1]}}, displacement: [0, 0, 0]}\n"
#define TIP "loads: [{on: {nearest: [1, 1, 1]}, total_force: [0, 0, 1]}]\n"
#define STRONG "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3, strengths: {tension: 1e4}}]\n"
#define HELD "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n"
#define MOVED                                                             \
    "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n" \
    "  - {on: {boundary: xmax}, displacement: [0.01, free, free]}\n"
#define SLIDING                                                           \
    "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n" \
    "  - {on: {boundary: xmax}, slide: [1, 1, 0]}\n"
#define RIGID HELD "  - {on: {boundary: xmax}, rigid: [2, 0, 0]}\n"
#define TIED HELD "  - {on: {nearest: [2, 1, 1]}, tied_to: {boundary: xmin}, tolerance: 3}\n"
#define CELL                                                                                                  \
    "constraints: [{periodic: [[xmin, xmax], [ymin, ymax]], strain: {xx: 0.01}}, {on: {nearest: [0, 0, 0]}, " \
    "displacement: [0, 0, 0]}]\n"
#define FREE "constraints: free_body\n"
#define PULLED "loads: [{on: {boundary: xmax}, traction: [1, 0, 0]}]\n"
#define PUSHED "loads: [{on: {boundary: xmax}, traction: [-1, 0, 0]}]\n"
#define TORN "loads: [{on: {boundary: xmax}, traction: [1, 0, 0]}, {on: {boundary: xmin}, traction: [-1, 0, 0]}]\n"
#define POKED "loads: [{on: {box: {min: [2, 1, 1], max: [2, 1, 1]}}, total_force: [0, 0, 1]}]\n"
#define SPREAD "loads: [{on: {box: {min: [2, 0, 0], max: [2, 1, 1]}}, total_force: [0, 0, 1]}]\n"
#define HEAVY "loads: [{gravity: [0, 0, -1]}]\n"
#define TURNING "loads: [{centrifugal: {axis: [0, 0, 1], angular_velocity: 1}}]\n"
#define TWISTED "loads: [{on: {boundary: xmax}, moment: [1, 0, 0]}]\n"
#define STEERED "loads: [{on: {boundary: xmax}, distributing: {at: [2, 0.5, 0.5], displacement: [0.01, free, free]}}]\n"
#define PRESSED "loads: [{on: {boundary: xmax}, pressure: 1}]\n"
#define FOLLOWED "loads: [{on: {boundary: xmax}, pressure: 1, follows: true}]\n"
#define SWOLLEN "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3, eigenstrain: 0.01}]\n"
#define FOUNDED "springs: [{on: {boundary: xmin}, foundation: 1e6}]\n"
#define SPRUNG "springs: [{on: {boundary: xmin}, spring: 1e6}]\n"
#define ALONG "path: {times: [0.5, 1]}\n"
#define TIMED "loads: [{on: {boundary: xmax}, traction: [1, 0, 0], time: [[0, 0], [1, 2]]}]\n"
#define ALL_FIELDS "output: {fields: [displacement, strain_tensor, stress, node_stress, strain_energy_density]}\n"
#define ACCURATE "accuracy: {relative_error: 0.1}\n"
#define ERROR_FIELD "output: {fields: [displacement, error]}\n"
#define NO_FIELDS "output: {fields: [displacement]}\n"

static const struct {
    const char *on, *off;
} cases[OST_EFFECT_COUNT] = {
#define ROW(effect) [effect - OST_EFFECT_FIRST]
    ROW(OST_EFFECT_ORTHOTROPY) = {BLOCK STIFF("") HELD PULLED NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_VARYING_AXES) = {BLOCK STIFF(", " CYLINDER) HELD PULLED NO_FIELDS, BLOCK
                                    "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3, " CYLINDER
                                    "}]\n" HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_GRADIENT_AXES) = {BLOCK STIFF(", " GRADIENTS) HELD PULLED NO_FIELDS,
                                     BLOCK STIFF(", " CYLINDER) HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_REGIONS) = {BLOCK TWO HELD PULLED NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_JOINED_VERTICES) = {TORN_FILE SOFT CORNERS TIP NO_FIELDS, WHOLE_FILE SOFT CORNERS TIP NO_FIELDS},
    ROW(OST_EFFECT_CLOSE_NODES) = {LAYERED SOFT HELD PULLED NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_WHOLE_INCLUSIONS) = {BLOCK SPECKS HELD PULLED NO_FIELDS, BLOCK TWO HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_MIXED) = {QUADRATIC RUBBER HELD PULLED NO_FIELDS, BLOCK RUBBER HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_MEAN_DILATATION) = {QUADRATIC RUBBER HELD PULLED NO_FIELDS
                                       "large_rotation: on\nformulation: classical\n",
                                       BLOCK RUBBER HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_LARGE_ROTATION) = {BLOCK SOFT HELD PULLED NO_FIELDS "large_rotation: on\nsolver: {method: metric}\n",
                                      BLOCK SOFT HELD PULLED NO_FIELDS "large_rotation: off\n"},
    ROW(OST_EFFECT_BUCKLING) = {BLOCK SOFT HELD PUSHED "buckling: {modes: 2}\n" NO_FIELDS,
                                BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_LINEAR_SPACE) = {QUADRATIC SOFT HELD PULLED NO_FIELDS "solver: {method: metric}\n",
                                    QUADRATIC SOFT HELD PULLED NO_FIELDS "solver: {method: direct}\n"},
    ROW(OST_EFFECT_PRESCRIBED_DISPLACEMENT) = {BLOCK SOFT MOVED NO_FIELDS, BLOCK SOFT SLIDING PULLED NO_FIELDS},
    ROW(OST_EFFECT_SLIDING) = {BLOCK SOFT SLIDING PULLED NO_FIELDS, BLOCK SOFT FREE TORN NO_FIELDS},
    ROW(OST_EFFECT_RIGID_FACE) = {BLOCK SOFT RIGID PULLED NO_FIELDS, BLOCK SOFT TIED PULLED NO_FIELDS},
    ROW(OST_EFFECT_TIE) = {BLOCK SOFT TIED PULLED NO_FIELDS, BLOCK SOFT CELL NO_FIELDS},
    ROW(OST_EFFECT_PERIODIC) = {BLOCK SOFT CELL NO_FIELDS, BLOCK SOFT RIGID PULLED NO_FIELDS},
    ROW(OST_EFFECT_FREE_BODY) = {BLOCK SOFT FREE TORN NO_FIELDS, BLOCK SOFT MOVED NO_FIELDS},
    ROW(OST_EFFECT_POINT_FORCE) = {BLOCK SOFT HELD POKED NO_FIELDS, BLOCK SOFT HELD SPREAD NO_FIELDS},
    ROW(OST_EFFECT_SURFACE_LOAD) = {BLOCK SOFT HELD SPREAD NO_FIELDS, BLOCK SOFT HELD POKED NO_FIELDS},
    ROW(OST_EFFECT_BODY_FORCE) = {BLOCK SOFT HELD HEAVY NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_CENTRIFUGAL) = {BLOCK SOFT HELD TURNING NO_FIELDS, BLOCK SOFT HELD HEAVY NO_FIELDS},
    ROW(OST_EFFECT_MOMENT) = {BLOCK SOFT HELD TWISTED NO_FIELDS, BLOCK SOFT HELD SPREAD NO_FIELDS},
    ROW(OST_EFFECT_MOVED_COUPLING) = {BLOCK SOFT HELD STEERED NO_FIELDS, BLOCK SOFT HELD TWISTED NO_FIELDS},
    ROW(OST_EFFECT_FOLLOWER_PRESSURE) = {BLOCK SOFT HELD FOLLOWED NO_FIELDS, BLOCK SOFT HELD PRESSED NO_FIELDS},
    ROW(OST_EFFECT_EIGENSTRAIN) = {BLOCK SWOLLEN HELD NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_STRENGTH) = {BLOCK STRONG HELD PULLED NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_FOUNDATION) = {BLOCK SOFT FOUNDED PULLED NO_FIELDS, BLOCK SOFT SPRUNG PULLED NO_FIELDS},
    ROW(OST_EFFECT_SPRINGS) = {BLOCK SOFT SPRUNG PULLED NO_FIELDS, BLOCK SOFT FOUNDED PULLED NO_FIELDS},
    ROW(OST_EFFECT_PATH) = {BLOCK SOFT HELD TIMED ALONG NO_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_RECOVERY) = {BLOCK SOFT HELD PULLED ALL_FIELDS, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_ADAPTIVITY) = {BLOCK SOFT HELD PULLED NO_FIELDS ACCURATE, BLOCK SOFT HELD PULLED NO_FIELDS},
    ROW(OST_EFFECT_ERROR_ESTIMATE) = {BLOCK SOFT HELD PULLED ERROR_FIELD, BLOCK SOFT HELD PULLED ALL_FIELDS},
#undef ROW
};

/* Half of the tets are of a region 'core' where the case has a material for it. */
static void add_core(const OstCase *c, OstMeshChunk *chunk)
{
    char **names = NULL;
    if (strcmp(c->materials[c->material_count - 1].region, "core") != 0)
        return;
    assert_int_equal(chunk->regions.count, 1);
    assert_success(OST_NEW(ctx, &names, 2));
    names[0] = chunk->regions.name[0];
    assert_success(ost_copy_string(ctx, "core", &names[1]));
    OST_FREE(chunk->regions.name);
    chunk->regions = (OstNames){2, names};
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_region[t] = t % 2;
}

static void check_ledger(const OstEffects *effects, OstEffect effect, const char *text)
{
    const OstLedgerEntry entry = ost_ledger_entry(ctx, effect);
    const OstEffectState *state = ost_effect_state(effects, effect);
    double counted[3] = {(double)entry.entries, (double)entry.peak_bytes, entry.seconds};
    MPI_Allreduce(MPI_IN_PLACE, counted, 3, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    assert_true(state->reason[0] != '\0');
    if (!state->on && (counted[0] > 0.0 || counted[1] > 0.0 || counted[2] > 0.0))
        fail_msg("%s is off (%s), but %g calls, %g bytes and %g s were counted in\n%s", ost_effect_label(effect),
                 state->reason, counted[0], counted[1], counted[2], text);
    if (state->on && !(counted[0] > 0.0))
        fail_msg("%s is on (%s), but was not called in\n%s", ost_effect_label(effect), state->reason, text);
    const double unforeseen = counted[1] / fmax(state->bytes, 1.0);
    if (ost_size(ctx) == 1 && state->bytes > 0.0 && (unforeseen > 2.0 || unforeseen < 0.5))
        fail_msg("%s: %g bytes were foreseen, and %g counted in\n%s", ost_effect_label(effect), state->bytes,
                 counted[1], text);
}

/* Refined as far as the case asks. */
static void check_accurate(const OstCase *c, OstEffect effect, const char *text)
{
    const OstAdaptLimits limits = {INFINITY, INFINITY};
    OstAdaption *adaption = NULL;
    assert_success(ost_adapt(c, &limits, &adaption));
    const OstEffects *effects = &ost_adaption_scene(adaption)->plan.effects;
    assert_int_equal(ost_effect_on(effects, effect), 1);
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        check_ledger(effects, (OstEffect)e, text);
    ost_adaption_destroy(&adaption);
}

static void check_as_given(const OstCase *c, OstEffect effect, int on, const char *text)
{
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    if (c->mesh_kind == OST_MESH_FILE) {
        assert_success(ost_scene_create(c, &scene));
    } else {
        assert_success(ost_chunk_create_block(ctx, &c->block, &chunk));
        add_core(c, chunk);
        assert_success(ost_scene_create_on(c, &chunk, &scene));
    }
    assert_success(ost_scene_solve(scene, &result));
    assert_int_equal(ost_effect_on(&scene->plan.effects, effect), on);
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        check_ledger(&scene->plan.effects, (OstEffect)e, text);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
}

/* In a context of its own, whose ledger begins with nothing. */
static void check_case(const char *text, OstEffect effect, int on)
{
    OstContext *const kept = ctx;
    OstCase *c = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_WORLD, &ctx), OST_SUCCESS);
    ost_log_set_level(ctx, OST_LOG_QUIET);
    assert_success(read_text(text, &c));
    if (c->asks_error)
        check_accurate(c, effect, text);
    else
        check_as_given(c, effect, on, text);
    ost_case_destroy(&c);
    assert_int_equal(ost_ledger_bytes(ctx), 0);
    ost_context_destroy(&ctx);
    ctx = kept;
}

/* Two tets that have the corners of a face in common, each its own. */
static const char torn[] = "*VERTICES\n8 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                           "5 1 0 0\n6 0 1 0\n7 0 0 1\n8 1 1 1\n"
                           "*ELEMENTS\nTET\n2 4 0\n1 1 2 3 4\n2 5 6 7 8\n";

/* In a folder of its own, where the cases are then written too. */
static void write_torn_mesh(char file[280])
{
    static char folder[256];
    if (ost_rank(ctx) == 0) {
        snprintf(folder, sizeof folder, "%s/orthostat-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
        assert_non_null(mkdtemp(folder));
    }
    MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, ost_comm(ctx));
    snprintf(file, 280, "%s/torn.veg", folder);
    write_bytes(file, torn, sizeof torn - 1);
    assert_int_equal(setenv("TMPDIR", folder, 1), 0);
}

static void remove_torn_mesh(const char *file)
{
    MPI_Barrier(ost_comm(ctx));
    if (ost_rank(ctx) == 0) {
        assert_int_equal(remove(file), 0);
        assert_int_equal(rmdir(getenv("TMPDIR")), 0);
    }
}

/* Only several ranks keep anything whole. */
static int needs_ranks(int effect)
{
    return effect == (int)OST_EFFECT_CLOSE_NODES || effect == (int)OST_EFFECT_WHOLE_INCLUSIONS;
}

static void what_is_off_is_not_called_and_what_is_on_is(void **state)
{
    char file[280];
    write_torn_mesh(file);
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++) {
        const char *on = cases[e - OST_EFFECT_FIRST].on;
        const char *off = cases[e - OST_EFFECT_FIRST].off;
        if (!on || !off)
            fail_msg("%s has no case here", ost_effect_label((OstEffect)e));
        check_case(on, (OstEffect)e, !needs_ranks(e) || ost_size(ctx) > 1);
        check_case(off, (OstEffect)e, 0);
    }
    if (ost_size(ctx) == 1) /* directions within quadratic tets, and potentials on their nodes */
        check_case(QUADRATIC STIFF(", " GRADIENTS) HELD PULLED NO_FIELDS, OST_EFFECT_GRADIENT_AXES, 1);
    remove_torn_mesh(file);
}

static void what_is_done_for_an_effect_is_booked_to_it(void **state)
{
    void *memory = NULL;
    const OstLedgerEntry before = ost_ledger_entry(ctx, OST_EFFECT_LINEAR_SPACE);
    const long solves = ost_ledger_entry(ctx, OST_LEDGER_SOLVE).entries;
    ost_ledger_enter(ctx, OST_EFFECT_LINEAR_SPACE);
    ost_ledger_enter(ctx, OST_LEDGER_SOLVE);
    assert_success(ost_allocate(ctx, 10, 8, &memory));
    ost_ledger_leave(ctx);
    ost_ledger_enter(ctx, OST_EFFECT_ORTHOTROPY);
    ost_ledger_leave(ctx);
    ost_ledger_leave(ctx);
    const OstLedgerEntry after = ost_ledger_entry(ctx, OST_EFFECT_LINEAR_SPACE);
    assert_int_equal(after.bytes - before.bytes, 80);
    assert_int_equal(after.entries - before.entries, 1);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_SOLVE).entries, solves);
    assert_int_equal(ost_ledger_entry(ctx, OST_EFFECT_ORTHOTROPY).entries, 1);
    ost_free_memory(memory);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_is_done_for_an_effect_is_booked_to_it),
    cmocka_unit_test(what_is_off_is_not_called_and_what_is_on_is),
};

OST_TEST_MAIN(tests)
