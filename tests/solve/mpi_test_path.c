/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"

#include "core/parallel/reduce.h"
#include "problem/problem.h"
#include "problem/scene_data.h"
#include "solve/path_data.h"

/* Paths: every step is the static answer to the loads at its time, by linear theory or by Newton's method; a checkpoint
 * goes on with the same bits; one that does not fit is refused. */

#define BODY                                                                                         \
    "mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 2]}}\n"                                       \
    "materials: [{region: all, youngs_modulus: [100, 200, 400], poissons_ratio: 0.3, density: 1}]\n" \
    "accuracy: {relative_residual: 1e-11}\nlarge_rotation: off\n"
/* Incompressible: its pressure is an unknown too. */
#define SOFT                                                                                         \
    "mesh: {block: {size: [2, 1, 1], divisions: [3, 1, 1]}}\nelement: {order: 2}\n"                  \
    "materials: [{region: all, youngs_modulus: [100, 200, 400], poissons_ratio: 0.5, density: 1}]\n" \
    "accuracy: {relative_residual: 1e-11}\nlarge_rotation: off\n"
#define HELD "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n"
#define MOVED "  - {on: {nearest: [2, 0, 0]}, displacement: [free, 0.01, free], time: [[0, 1], [1, 3]]}\n"
#define LOADS                                                                                     \
    "loads:\n  - {on: {boundary: xmax}, traction: [1, 0, 0], time: [[0, 0], [0.5, 1], [1, 0]]}\n" \
    "  - {gravity: [0, 0, -1], time: [[0, 1]]}\n  - {on: {boundary: xmax}, total_force: [0, 0, 2]}\n"
#define TIMES "path: {times: [0, 0.25, 0.5, 1]}\n"

typedef struct Made {
    OstCase *c;
    OstScene *scene;
} Made;

static Made make(const char *text)
{
    Made made = {NULL, NULL};
    assert_success(read_text(text, &made.c));
    assert_success(ost_scene_create(made.c, &made.scene));
    return made;
}

static void destroy(Made *made)
{
    ost_scene_destroy(&made->scene);
    ost_case_destroy(&made->c);
}

static double farthest(size_t count, const double *a, const double *b)
{
    double most[2] = {0.0, 0.0};
    for (size_t i = 0; i < count; i++) {
        most[0] = fmax(most[0], fabs(a[i] - b[i]));
        most[1] = fmax(most[1], fabs(b[i]));
    }
    assert_success(ost_max(ctx, 2, most));
    return most[1] > 0.0 ? most[0] / most[1] : most[0];
}

static void compare_steps(const char *body)
{
    static const double pulled[] = {0.0, 0.5, 1.0, 0.0}, moved[] = {1.0, 1.5, 2.0, 3.0}, t[] = {0.0, 0.25, 0.5, 1.0};
    char text[2048];
    snprintf(text, sizeof text, "%s%s", body, HELD MOVED LOADS TIMES);
    Made made = make(text);
    OstPath *path = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    for (int i = 0; i < 4; i++) {
        OstResult *step = NULL, *alone = NULL;
        snprintf(text, sizeof text,
                 "%s" HELD "  - {on: {nearest: [2, 0, 0]}, displacement: [free, %.17g, free]}\n"
                 "loads:\n  - {on: {boundary: xmax}, traction: [%.17g, 0, 0]}\n"
                 "  - {gravity: [0, 0, -1]}\n  - {on: {boundary: xmax}, total_force: [0, 0, %.17g]}\n",
                 body, 0.01 * moved[i], pulled[i], 2.0 * t[i]);
        Made fixed = make(text);
        assert_success(ost_path_advance(path, 1U << OST_FIELD_STRESS, &step));
        assert_success(ost_scene_solve(fixed.scene, &alone));
        const size_t nodes = 3 * (size_t)made.scene->mesh->node_count;
        assert_true(farthest(nodes, step->displacement, alone->displacement) < 1e-9);
        assert_true(farthest(nodes, step->reaction, alone->reaction) < 1e-9);
        assert_true(farthest(6 * (size_t)made.scene->mesh->owned_tets, step->stress, alone->stress) < 1e-8);
        assert_close(step->checks.strain_energy, alone->checks.strain_energy, 1e-9 * alone->checks.strain_energy);
        assert_close(step->checks.load[2], alone->checks.load[2], 1e-12);
        assert_true(ost_path_step(path, i)->t == t[i]);
        assert_true(ost_path_step(path, i)->largest_displacement == step->largest_displacement);
        ost_result_destroy(&step);
        ost_result_destroy(&alone);
        destroy(&fixed);
    }
    OstResult *beyond = NULL;
    assert_failure(ost_path_advance(path, 0, &beyond), OST_INVALID_USAGE, "all 4 steps of the path are done");
    ost_path_destroy(&path);
    destroy(&made);
}

static void every_step_is_the_static_answer(void **state)
{
    compare_steps(BODY);
    compare_steps(SOFT);
}

static void without_a_load_the_body_is_at_rest(void **state)
{
    Made made =
        make(BODY HELD "loads:\n  - {gravity: [0, 0, 1], time: [[0, 0], [0.5, 1], [1, 0]]}\npath: {steps: 2}\n");
    OstResult *result = NULL;
    assert_success(ost_scene_solve(made.scene, &result)); /* the end of the path */
    assert_true(result->largest_displacement == 0.0);
    ost_result_destroy(&result);
    destroy(&made);
}

static void what_has_no_table_needs_no_memory(void **state)
{
    Made made = make(BODY HELD "loads: [{gravity: [0, 0, 1]}, {body_force: [1, 0, 0]}]\n");
    OstProblem *problem = NULL;
    assert_success(ost_scene_problem(made.scene, &problem));
    assert_null(problem->timed);
    assert_int_equal(ost_ledger_entry(ctx, OST_EFFECT_PATH).bytes, 0);
    ost_problem_destroy(&problem);
    destroy(&made);
    made = make(BODY HELD "path: {steps: 3}\nloads: [{gravity: [0, 0, 1], time: [[0, 1]]}, {body_force: [1, 0, 0], "
                          "time: [[0, 1]]}, {on: {boundary: ymin}, pressure: 1, time: [[0, 1]]}]\n");
    assert_success(ost_scene_problem(made.scene, &problem));
    assert_int_equal(problem->timed_count, 1);
    assert_false(ost_problem_begins_at_rest(problem));
    ost_problem_destroy(&problem);
    destroy(&made);
}

static void a_program_gives_tables_too(void **state)
{
    Made made = make(BODY HELD LOADS TIMES);
    const OstMesh *mesh = made.scene->mesh;
    const size_t nodes = 3 * (size_t)mesh->node_count, owned = 3 * (size_t)mesh->owned_nodes;
    double times[] = {0.0, 1.0}, factors[] = {1.0, 5.0};
    double *force = calloc(2 * nodes + 2, sizeof *force), *u = force + nodes;
    double *displacement = calloc((size_t)mesh->owned_nodes + 1, sizeof *displacement);
    OstNodeConstraint *constraints = calloc((size_t)mesh->owned_nodes + 1, sizeof *constraints);
    OstTimedParts timed = {{2, times, factors}, force, displacement};
    OstProblemParts parts = {.mesh = mesh,
                             .field = made.scene->field,
                             .constraints = constraints,
                             .constraint_count = mesh->owned_nodes,
                             .timed_count = 1,
                             .timed = &timed};
    OstProblem *problem = NULL;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        constraints[n] = (OstNodeConstraint){n, {0.0, 0.0, 2.0}, 0.25 * (double)mesh->node_label[n]};
        displacement[n] = (double)mesh->node_label[n];
        force[3 * n] = 7.0;
    }
    assert_success(ost_problem_create(&parts, &problem));
    assert_success(ost_problem_stiffness(problem, 1.0, NULL, NULL));
    memset(u, 0, nodes * sizeof *u);
    double *v = calloc(3 * (size_t)mesh->node_count + 1, sizeof *v);
    assert_success(ost_problem_displacement(problem, 0.5, v, u));
    for (OstLocal n = 0; n < mesh->node_count; n++)
        assert_close(u[3 * n + 2], (0.5 * 0.25 + 3.0) * (double)mesh->node_label[n], 1e-12 * 100.0);
    ost_problem_load(problem, 0.5, NULL, u);
    for (size_t i = 0; i < owned; i++)
        assert_close(u[i], i % 3 == 0 ? 21.0 : 0.0, 1e-13);
    ost_problem_destroy(&problem);
    free(v);
    free(constraints);
    free(displacement);
    free(force);
    destroy(&made);
}

/* --- large rotations --- */

#define BEAM                                                                              \
    "mesh: {block: {size: [6, 1, 1], divisions: [9, 2, 2]}}\n"                            \
    "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3, density: 1}]\n" \
    "accuracy: {relative_residual: 1e-10}\nsolver: {method: metric, coarsest_unknowns: 30}\n" HELD
#define SOFT_BEAM                                                                         \
    "mesh: {block: {size: [6, 1, 1], divisions: [6, 1, 1]}}\nelement: {order: 2}\n"       \
    "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.5, density: 1}]\n" \
    "accuracy: {relative_residual: 1e-10}\nsolver: {method: metric, coarsest_unknowns: 30}\n" HELD
#define BENT "loads:\n  - {on: {boundary: xmax}, total_force: [0, 0, 2]}\n"
#define ON "large_rotation: on\n"

static void compare_end(const char *text, const char *alone)
{
    Made path = make(text), fixed = make(alone);
    const double last = path.c->path_times[path.c->path_steps - 1];
    OstResult *end = NULL, *once = NULL;
    assert_success(ost_scene_solve(path.scene, &end));
    assert_success(ost_scene_solve(fixed.scene, &once));
    assert_true(end->newton.used && once->newton.used && end->newton.reached == last);
    assert_true(farthest(3 * (size_t)end->mesh->node_count, end->displacement, once->displacement) < 1e-7);
    assert_true(farthest(3 * (size_t)end->mesh->node_count, end->reaction, once->reaction) < 1e-6);
    ost_result_destroy(&end);
    ost_result_destroy(&once);
    destroy(&path);
    destroy(&fixed);
}

static void steps_do_not_change_where_a_body_ends(void **state)
{
    compare_end(BEAM BENT ON "path: {steps: 3}\n", BEAM BENT ON);
    /* where the load at t = 0 is not zero, it is brought up first */
    compare_end(BEAM ON "loads:\n  - {gravity: [0, 0, 0.2], time: [[0, 1]]}\npath: {times: [0]}\n",
                BEAM ON "loads:\n  - {gravity: [0, 0, 0.2]}\n");
    compare_end(BEAM "  - {on: {boundary: xmax}, displacement: [-0.5, free, 1.5], time: [[0, 0.5], [1, 2]]}\n" ON
                     "path: {times: [0, 0.2, 1]}\n",
                BEAM "  - {on: {boundary: xmax}, displacement: [-1, free, 3]}\n" ON);
    compare_end(SOFT_BEAM "  - {on: {boundary: xmax}, displacement: [-0.5, free, 1.5], time: [[0, 0.5], [1, 2]]}\n" ON
                          "path: {times: [0, 0.2, 1]}\n",
                SOFT_BEAM "  - {on: {boundary: xmax}, displacement: [-1, free, 3]}\n" ON);
}

/* Unloading takes no more than loading did: where a load turns, the last step's slope would lead the wrong way. */
static void a_load_that_turns_takes_the_body_back(void **state)
{
    Made made = make(BEAM ON "loads:\n  - {on: {boundary: xmax}, total_force: [0, 0, 8], "
                             "time: [[0, 0], [0.5, 1], [1, 0]]}\npath: {steps: 4}\n");
    OstPath *path = NULL;
    OstResult *step[4] = {NULL};
    assert_success(ost_scene_path(made.scene, &path));
    for (int i = 0; i < 4; i++)
        assert_success(ost_path_advance(path, 1U << OST_FIELD_ERROR, &step[i]));
    assert_true(farthest(3 * (size_t)step[0]->mesh->node_count, step[2]->displacement, step[0]->displacement) < 1e-6);
    assert_true(ost_path_step(path, 2)->newton_iterations <= ost_path_step(path, 0)->newton_iterations);
    assert_int_equal(step[2]->newton.jumps, 0);
    assert_true(step[3]->newton.used && step[3]->largest_displacement == 0.0); /* at rest, to the last bit */
    assert_true(step[3]->answer.relative == 0.0 && step[3]->verdict.count == 0);
    for (int i = 0; i < 4; i++)
        ost_result_destroy(&step[i]);
    ost_path_destroy(&path);
    destroy(&made);
}

static void a_body_at_rest_stays_until_it_is_loaded(void **state)
{
    Made made = make(BEAM ON BENT "path: {times: [0, 0.5]}\n");
    OstPath *path = NULL;
    OstResult *result = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    assert_success(ost_path_advance(path, 0, &result));
    assert_true(result->largest_displacement == 0.0);
    assert_int_equal(ost_path_step(path, 0)->newton_iterations, 0);
    ost_result_destroy(&result);
    assert_success(ost_path_advance(path, 0, &result));
    assert_true(result->largest_displacement > 0.1);
    assert_true(ost_path_step(path, 1)->newton_iterations > 0);
    ost_result_destroy(&result);
    ost_path_destroy(&path);
    destroy(&made);
}

/* Linear theory serves all steps or none. */
static void one_step_too_far_makes_all_newtons(void **state)
{
    static const struct {
        const char *text;
        int linear;
    } cases[] = {{BEAM BENT "path: {times: [0.01, 1]}\n", 0}, {BEAM BENT "path: {times: [0.01, 0.02]}\n", 1}};
    for (int c = 0; c < 2; c++) {
        Made made = make(cases[c].text);
        OstPath *path = NULL;
        OstResult *result = NULL;
        assert_success(ost_scene_path(made.scene, &path));
        assert_success(ost_path_advance(path, 0, &result));
        assert_int_equal(ost_path_step(path, 0)->linear, cases[c].linear);
        assert_int_equal(result->newton.used, !cases[c].linear);
        assert_true(result->newton.judged);
        ost_result_destroy(&result);
        ost_path_destroy(&path);
        destroy(&made);
    }
}

/* --- checkpoints --- */

static void checkpoint_name(char name[300])
{
    char path[256];
    case_path(path);
    snprintf(name, 300, "%s.checkpoint", path);
}

static void same_bits(const OstResult *one, const OstResult *other)
{
    const size_t nodes = 3 * (size_t)one->mesh->node_count;
    assert_memory_equal(one->displacement, other->displacement, nodes * sizeof(double));
    assert_memory_equal(one->reaction, other->reaction, nodes * sizeof(double));
    if (one->pressure)
        assert_memory_equal(one->pressure, other->pressure, 4 * (size_t)one->mesh->tet_count * sizeof(double));
}

static void a_resumed_path_has_the_same_bits(void **state)
{
    static const char *const texts[] = {BODY HELD MOVED LOADS TIMES "solver: {method: metric, coarsest_unknowns: 30}\n",
                                        BEAM ON BENT "path: {times: [0.1, 0.4, 0.7, 1]}\n",
                                        SOFT HELD MOVED LOADS TIMES "solver: {method: metric, coarsest_unknowns: 30}\n",
                                        SOFT_BEAM ON BENT "path: {times: [0.1, 0.4, 0.7, 1]}\n",
                                        BODY HELD MOVED LOADS TIMES "solver: {method: direct}\n"};
    char name[300];
    checkpoint_name(name);
    for (int s = 0; s < 5; s++) {
        if (s == 4 && ost_size(ctx) > 1) /* sums of factors on several ranks depend on the order of messages */
            break;
        Made made = make(texts[s]);
        OstPath *whole = NULL, *killed = NULL;
        assert_success(ost_scene_path(made.scene, &whole));
        assert_success(ost_scene_path(made.scene, &killed));
        for (int i = 0; i < 4; i++) {
            OstResult *result = NULL, *again = NULL;
            assert_success(ost_path_advance(whole, 0, &result));
            assert_success(ost_path_advance(killed, 0, &again));
            same_bits(result, again);
            ost_path_step(killed, i)->note[3] = 0.5 + i;
            assert_success(ost_path_save(killed, name));
            ost_path_destroy(&killed);
            assert_success(ost_scene_path(made.scene, &killed));
            assert_success(ost_path_resume(killed, name));
            assert_int_equal(ost_path_done(killed), i + 1);
            ost_path_step(whole, i)->note[3] = 0.5 + i;
            assert_memory_equal(ost_path_step(whole, 0), ost_path_step(killed, 0),
                                (size_t)(i + 1) * sizeof(OstPathStep));
            ost_result_destroy(&result);
            ost_result_destroy(&again);
        }
        ost_path_destroy(&whole);
        ost_path_destroy(&killed);
        destroy(&made);
    }
    MPI_Barrier(ost_comm(ctx));
    if (ost_rank(ctx) == 0)
        remove(name);
}

static void refuses(const char *text, const char *name, const char *words)
{
    Made made = make(text);
    OstPath *path = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    assert_failure(ost_path_resume(path, name), OST_INVALID_INPUT, words);
    assert_int_equal(ost_path_done(path), 0);
    ost_path_destroy(&path);
    destroy(&made);
}

static size_t read_whole(const char *name, char *bytes, size_t room)
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, room, file);
    fclose(file);
    MPI_Barrier(ost_comm(ctx)); /* before rank 0 damages it */
    return size;
}

/* A case without a path of its own: the times are the caller's. */
static void refuses_other_times(const char *name)
{
    Made made = make(BODY HELD MOVED LOADS TIMES);
    OstProblem *problem = NULL;
    OstPath *path = NULL;
    assert_success(ost_scene_problem(made.scene, &problem));
    assert_success(ost_path_create(problem, &made.c->solver, 2, (const double[]){0.5, 1.0}, &path));
    assert_failure(ost_path_resume(path, name), OST_INVALID_INPUT, "have changed since");
    ost_path_destroy(&path);
    assert_failure(ost_path_create(problem, &made.c->solver, 2, (const double[]){0.5, 0.5}, &path), OST_INVALID_INPUT,
                   "time 2 of a path is 0.5");
    assert_null(path);
    ost_problem_destroy(&problem);
    destroy(&made);
}

static void checkpoints_that_do_not_fit_are_refused(void **state)
{
    enum { ROOM = 1 << 17 };
    static const char text[] = BODY HELD MOVED LOADS TIMES;
    static const char damaged[] = "it is damaged or incomplete";
    char name[300], *bytes = malloc(ROOM);
    checkpoint_name(name);
    Made made = make(text);
    OstPath *path = NULL;
    OstResult *result = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    assert_success(ost_path_resume(path, name)); /* there is none: the path begins */
    assert_int_equal(ost_path_done(path), 0);
    assert_success(ost_path_advance(path, 0, &result));
    assert_success(ost_path_save(path, name));
    ost_result_destroy(&result);
    ost_path_destroy(&path);
    destroy(&made);
    const size_t size = read_whole(name, bytes, ROOM);
    assert_true(size > 100 && size < ROOM);
    for (size_t at = 0; at < size; at += size / 5) {
        bytes[at] ^= 1;
        write_bytes(name, bytes, size);
        refuses(text, name, damaged);
        bytes[at] ^= 1;
        write_bytes(name, bytes, at);
        refuses(text, name, damaged);
    }
    write_bytes(name, bytes, size);
    refuses(BODY HELD MOVED LOADS TIMES "title: another\n", name,
            "it is that of another case, or the case file has changed since");
    refuses_other_times(name);
    MPI_Barrier(ost_comm(ctx));
    if (ost_rank(ctx) == 0)
        remove(name);
    free(bytes);
}

/* The next step from a checkpoint, and the one after it. */
static void take_two_steps(const char *text, const char *name, OstPathStep steps[2])
{
    Made made = make(text);
    OstPath *path = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    assert_success(ost_path_resume(path, name));
    assert_int_equal(ost_path_done(path), 2);
    for (int i = 2; i < 4; i++) {
        OstResult *result = NULL;
        assert_success(ost_path_advance(path, 0, &result));
        steps[i - 2] = *ost_path_step(path, i);
        ost_result_destroy(&result);
    }
    ost_path_destroy(&path);
    destroy(&made);
}

static void save_two_steps(const char *text, const char *name)
{
    Made made = make(text);
    OstPath *path = NULL;
    assert_success(ost_scene_path(made.scene, &path));
    for (int i = 0; i < 2; i++) {
        OstResult *result = NULL;
        assert_success(ost_path_advance(path, 0, &result));
        ost_result_destroy(&result);
    }
    assert_success(ost_path_save(path, name));
    ost_path_destroy(&path);
    destroy(&made);
}

/* The same on rank 0 alone, while the others wait. */
static OstContext *all_ranks;
static void begin_alone(void)
{
    all_ranks = ctx;
    if (ost_rank(all_ranks) == 0)
        assert_int_equal(ost_context_create(MPI_COMM_SELF, &ctx), OST_SUCCESS);
}
static void end_alone(void)
{
    if (ost_rank(all_ranks) == 0)
        ost_context_destroy(&ctx);
    ctx = all_ranks;
    MPI_Barrier(ost_comm(ctx));
}

/* One rank's checkpoint serves all, and theirs serves one: within rounding the path is the same. */
static void another_number_of_ranks_goes_on(void **state)
{
    static const char *const texts[] = {BODY HELD MOVED LOADS TIMES, BEAM ON BENT "path: {times: [0.1, 0.4, 0.7, 1]}\n",
                                        SOFT_BEAM ON BENT "path: {times: [0.1, 0.4, 0.7, 1]}\n"};
    char name[300];
    checkpoint_name(name);
    for (int s = 0; s < 3; s++) {
        OstPathStep alone[2], together[2];
        for (int from_all = 0; from_all < 2; from_all++) {
            if (from_all)
                save_two_steps(texts[s], name);
            begin_alone();
            if (ost_rank(all_ranks) == 0) {
                if (!from_all)
                    save_two_steps(texts[s], name);
                take_two_steps(texts[s], name, alone);
            }
            end_alone();
            take_two_steps(texts[s], name, together);
            for (int i = 0; i < 2 && ost_rank(ctx) == 0; i++) {
                assert_close(together[i].largest_displacement / alone[i].largest_displacement, 1.0, 1e-7);
                assert_close(together[i].strain_energy / alone[i].strain_energy, 1.0, 1e-7);
            }
            MPI_Barrier(ost_comm(ctx));
        }
    }
    if (ost_rank(ctx) == 0)
        remove(name);
}

/* What differs is named, on any number of ranks. */
static void another_problem_is_refused_by_name(void **state)
{
    static const char text[] = BEAM ON BENT "path: {times: [0.1, 0.4, 0.7, 1]}\n";
    char name[300], changed[2048];
    checkpoint_name(name);
    begin_alone();
    if (ost_rank(all_ranks) == 0)
        save_two_steps(text, name);
    end_alone();
    static const struct {
        const char *from, *to, *words;
    } changes[] = {
        {"large_rotation: on\n", "large_rotation: on\nformulation: classical\n",
         "it was made with formulation: consistent, and this run has formulation: classical"},
        {"large_rotation: on\n", "large_rotation: off\n", "and this run has large_rotation: off"},
        {"coarsest_unknowns: 30", "coarsest_unknowns: 40", "the solver's options have changed since"},
        {"relative_residual: 1e-10", "relative_residual: 1e-10, relative_error: 0.03", "the accuracy asked for have"},
        {"times: [0.1, 0.4, 0.7, 1]", "times: [0.1, 0.4, 0.8, 1]", "the case file has changed since"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const char *at = strstr(text, changes[i].from);
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, changes[i].to,
                 at + strlen(changes[i].from));
        refuses(changed, name, changes[i].words);
    }
    for (int what = 0; what < 3; what++) {
        Made made = make(text);
        OstPath *path = NULL;
        assert_success(ost_scene_path(made.scene, &path));
        for (OstLocal n = 0; n < 3 * made.scene->mesh->owned_nodes; n++)
            path->problem->force[n] *= what == 0 ? 1.0 + 1e-6 : 1.0;
        for (OstLocal i = 0; i < path->problem->supports->count; i++)
            path->problem->supports->support[i].prescribed[0] += what == 1 ? 0.01 : 0.0;
        for (OstLocal n = 0; n < 3 * made.scene->mesh->node_count && what == 2; n++)
            ((double *)made.scene->mesh->coordinates)[n] *= 1.0 + 1e-6;
        assert_failure(ost_path_resume(path, name), OST_INVALID_INPUT,
                       what == 0   ? "loads have changed since"
                       : what == 1 ? "constraints have changed since"
                                   : "the mesh has changed since");
        ost_path_destroy(&path);
        destroy(&made);
    }
    MPI_Barrier(ost_comm(ctx));
    if (ost_rank(ctx) == 0)
        remove(name);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_step_is_the_static_answer),
    cmocka_unit_test(without_a_load_the_body_is_at_rest),
    cmocka_unit_test(what_has_no_table_needs_no_memory),
    cmocka_unit_test(a_program_gives_tables_too),
    cmocka_unit_test(steps_do_not_change_where_a_body_ends),
    cmocka_unit_test(a_load_that_turns_takes_the_body_back),
    cmocka_unit_test(a_body_at_rest_stays_until_it_is_loaded),
    cmocka_unit_test(one_step_too_far_makes_all_newtons),
    cmocka_unit_test(a_resumed_path_has_the_same_bits),
    cmocka_unit_test(checkpoints_that_do_not_fit_are_refused),
    cmocka_unit_test(another_number_of_ranks_goes_on),
    cmocka_unit_test(another_problem_is_refused_by_name),
};

OST_TEST_MAIN(tests)
