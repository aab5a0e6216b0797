/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/stage.h"

#include "adapt/mark_ties.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "problem/scene_parts.h"
#include "recovery/recovery.h"
#include "solve/strategy.h"

#include <math.h>
#include <string.h>

OstStatus ost_stage_create(OstContext *ctx, OstStage **stage)
{
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, stage, 1)));
    (*stage)->ctx = ctx;
    (*stage)->missed = 1.0;
    return OST_SUCCESS;
}

static void release_analysis(OstStage *stage)
{
    ost_analysis_destroy(&stage->analysis);
    ost_problem_destroy(&stage->problem);
}

void ost_stage_destroy(OstStage **stage)
{
    if (!*stage)
        return;
    release_analysis(*stage);
    OST_FREE((*stage)->start, (*stage)->fall, (*stage)->before, (*stage)->cuts);
    ost_result_destroy(&(*stage)->result);
    ost_bisection_destroy(&(*stage)->bisection);
    ost_scene_destroy(&(*stage)->scene);
    OST_FREE(*stage);
}

/* Adds the pairs of a constraint, whose boundaries must grow with the mesh. */
static OstStatus add_pairs(const OstStage *stage, const OstConstraint *constraint, int *count, OstPeriodicPair *pair)
{
    const OstMesh *mesh = stage->scene->mesh;
    for (int p = 0; p < constraint->pair_count; p++) {
        const OstSelection on = {.kind = OST_SELECT_BOUNDARY,
                                 .boundaries = {2, (char **)constraint->pair[p]},
                                 .place = {constraint->line, 1}};
        OST_TRY(ost_select_check_names(&stage->c, mesh, &on));
        for (int side = 0; side < 2; side++)
            if (mesh->boundaries[ost_mesh_find_boundary(mesh, constraint->pair[p][side])].dimension != 2)
                return ost_select_raise(&stage->c, &on,
                                        "boundary '%.80s' has no faces, as a periodic pair needs where an accuracy is "
                                        "asked for; name one of faces",
                                        constraint->pair[p][side]);
        pair[(*count)++] = (OstPeriodicPair){constraint->pair[p][0], constraint->pair[p][1]};
    }
    return OST_SUCCESS;
}

/* Boundaries of periodic pairs are to be cut alike. */
static OstStatus keep_periods(const OstStage *stage)
{
    const OstCase *c = &stage->c;
    OstPeriodicPair *pair = NULL;
    int count = 0;
    OstStatus status = ost_agree(c->ctx, OST_NEW(c->ctx, &pair, 3 * c->constraint_count));
    for (int k = 0; k < c->constraint_count; k++)
        if (c->constraints[k].kind == OST_CONSTRAIN_PERIODIC)
            OST_THEN(add_pairs(stage, &c->constraints[k], &count, pair));
    OST_THEN(ost_bisection_pair(stage->bisection, count, pair));
    OST_FREE(pair);
    return status;
}

OstStatus ost_stage_open(OstStage *stage, const OstCase *c)
{
    stage->c = *c;
    OST_TRY(ost_scene_create(&stage->c, &stage->scene));
    ost_ledger_enter(c->ctx, OST_EFFECT_ADAPTIVITY);
    OstStatus status = ost_bisection_create(stage->scene->mesh, &stage->bisection);
    OST_THEN(keep_periods(stage));
    ost_ledger_leave(c->ctx);
    return status;
}

/* --- solving --- */

/* A tet's share of the squared error in the norm of the energy; or of the error of a quantity, which falls like that.
 */
static double share_of(const OstStage *stage, OstLocal tet)
{
    if (stage->result->interest.share)
        return stage->result->interest.share[tet];
    const double error = stage->result->tet_error[tet];
    return error * error;
}

/* What is expected of the next cuts, from what the last ones did. */
static OstStatus learn(OstStage *stage)
{
    const int order = stage->scene->mesh->nodes_per_tet == 10 ? 2 : 1;
    OST_TRY(OST_NEW(stage->ctx, &stage->fall, stage->scene->mesh->owned_tets));
    for (OstLocal t = 0; t < stage->scene->mesh->owned_tets; t++) {
        const double *before = stage->before ? stage->before + 2 * (size_t)t : NULL;
        stage->fall[t] = !before               ? ost_smooth_fall(order)
                         : stage->cuts[t] == 0 ? before[1]
                                               : ost_found_fall(order, before[0], share_of(stage, t), stage->cuts[t]);
    }
    OST_FREE(stage->before, stage->cuts);
    return OST_SUCCESS;
}

/* Is the problem that the case states the same on finer meshes, but for the elements? Not where material axes vary, or
 * a mean dilatation is each tet's. */
static int is_same_on_finer(const OstStage *stage)
{
    const OstMaterialField *field = stage->problem->field;
    int keeps = field->form == OST_SPLIT_NOT && ost_case_stays(&stage->c);
    for (int r = 0; r < field->region_count; r++)
        keeps &= !field->region_varies[r];
    return keeps;
}

/* The potential falls from mesh to mesh as the error does where spaces are nested, and it is the least in each: not
 * with a mixed form. That of large rotations is not looked at. */
static OstStatus measure(OstStage *stage)
{
    const OstMesh *mesh = stage->scene->mesh;
    double work = 0.0;
    stage->potential = NAN;
    if (stage->problem->pressures || !ost_problem_is_linear(stage->problem) || !is_same_on_finer(stage))
        return OST_SUCCESS;
    stage->volume = 0.0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        stage->volume += ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, t));
    OST_TRY(ost_sum(stage->ctx, 1, &stage->volume));
    OST_TRY(ost_problem_energy(stage->problem, 1.0, stage->result->displacement, &stage->potential));
    OST_TRY(ost_problem_load_work(stage->problem, 1.0, stage->result->displacement, &work));
    stage->potential -= work;
    return OST_SUCCESS;
}

OstStatus ost_stage_solve(OstStage *stage)
{
    OstStatus status = ost_scene_problem(stage->scene, &stage->problem);
    OST_THEN(ost_analysis_create(stage->problem, &stage->c.solver, &stage->analysis));
    if (status == OST_SUCCESS) {
        stage->analysis->start = stage->starts_turned ? NULL : stage->start;
        stage->analysis->pose = stage->starts_turned ? stage->start : NULL;
        stage->analysis->leaves_reactions = 1;
        status = ost_analysis_solve(stage->analysis, 1U << OST_FIELD_ERROR, &stage->result);
        stage->analysis->start = stage->analysis->pose = NULL;
    }
    if (status == OST_SUCCESS && stage->result->answer.known) {
        status = ost_agree(stage->ctx, learn(stage));
        OST_THEN(measure(stage));
    }
    OST_FREE(stage->start);
    return status;
}

static int watches_reaction(const OstCase *c)
{
    int any = 0;
    for (int w = 0; w < c->watch_count; w++)
        any |= c->watches[w].kind == OST_WATCH_REACTION;
    return any;
}

/* Once more, from the answer: the analysis has been released for a finer level, which failed. */
static OstStatus solve_again(OstStage *stage)
{
    const size_t size = 3 * (size_t)stage->scene->mesh->node_count;
    OST_TRY(ost_agree(stage->ctx, OST_NEW(stage->ctx, &stage->start, size)));
    memcpy(stage->start, stage->result->displacement, size * sizeof *stage->start);
    stage->starts_turned = stage->result->newton.used;
    ost_result_destroy(&stage->result);
    OST_FREE(stage->fall);
    return ost_stage_solve(stage);
}

static void add_missed(OstStage *stage)
{
    OstResult *result = stage->result;
    result->answer.energy_norm *= stage->missed;
    result->answer.relative = fmin(stage->missed * result->answer.relative, 1.0);
    for (OstLocal t = 0; t < stage->scene->mesh->owned_tets && result->tet_error; t++)
        result->tet_error[t] *= stage->missed;
}

OstStatus ost_stage_finish(OstStage *stage)
{
    if (!stage->analysis && watches_reaction(&stage->c))
        OST_TRY(solve_again(stage));
    if (stage->analysis)
        OST_TRY(ost_analysis_find_reactions(stage->analysis, stage->result));
    release_analysis(stage);
    add_missed(stage);
    stage->result->asked = ost_scene_result_fields(stage->scene);
    return ost_agree(stage->ctx, ost_result_recover(stage->result, stage->result->asked));
}

/* --- refining --- */

/* A start for the next level. Newton's method comes to rest sooner from what linear theory predicts than from a pose
 * that is farther off than this. */
static OstStatus carry_answer(const OstStage *stage, OstStage *next)
{
    static const double near = 0.5;
    next->starts_turned = stage->result->newton.used;
    if (next->starts_turned && !(stage->result->answer.relative < near))
        return OST_SUCCESS;
    OST_TRY(ost_agree(next->ctx, OST_NEW(next->ctx, &next->start, 3 * (size_t)next->scene->mesh->node_count)));
    return ost_bisection_carry(next->bisection, 3, stage->result->displacement, next->start);
}

/* Shares are compared between levels of one order. */
static OstStatus carry_shares(const OstStage *stage, OstStage *next)
{
    const size_t old = (size_t)stage->scene->mesh->owned_tets, tets = (size_t)next->scene->mesh->owned_tets;
    double *pairs = NULL;
    if (stage->scene->mesh->nodes_per_tet != next->scene->mesh->nodes_per_tet)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(stage->ctx, &pairs, 2 * old);
    OST_THEN(OST_NEW(stage->ctx, &next->before, 2 * tets));
    OST_THEN(OST_NEW(stage->ctx, &next->cuts, tets));
    status = ost_agree(stage->ctx, status);
    for (size_t t = 0; t < old && status == OST_SUCCESS; t++) {
        pairs[2 * t] = share_of(stage, (OstLocal)t);
        pairs[2 * t + 1] = stage->fall[t];
    }
    OST_THEN(ost_bisection_carry_tets(next->bisection, 2, pairs, next->before, next->cuts));
    OST_FREE(pairs);
    return status;
}

/* Which tets have the error. */
static OstStatus mark(OstStage *stage, OstMarking *marking, unsigned char *times)
{
    const OstMesh *mesh = stage->scene->mesh;
    double *share = NULL;
    OST_TRY(ost_agree(stage->ctx, OST_NEW(stage->ctx, &share, mesh->owned_tets)));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        share[t] = share_of(stage, t);
    OstStatus status = ost_mark(mesh, share, stage->fall, marking, times);
    OST_THEN(ost_mark_ties(mesh, stage->problem->supports->links, times));
    OST_FREE(share);
    return status;
}

/* Cuts them, with the memory that the analysis had. */
static OstStatus cut(OstStage *stage, OstMarking *marking, OstBisection *bisection, OstMeshChunk **chunk)
{
    const OstShapeSurface surface = ost_scene_surface(&stage->c);
    unsigned char *times = NULL;
    OST_TRY(ost_agree(stage->ctx, OST_NEW(stage->ctx, &times, stage->scene->mesh->owned_tets)));
    OstStatus status = mark(stage, marking, times);
    release_analysis(stage);
    OST_THEN(ost_bisection_split(bisection, times, &surface, chunk));
    OST_FREE(times);
    return status;
}

static OstStatus carry(const OstStage *stage, OstStage *next)
{
    OST_TRY(ost_bisection_settle(next->bisection, next->scene->mesh));
    OST_TRY(carry_shares(stage, next));
    return carry_answer(stage, next);
}

OstStatus ost_stage_refine(OstStage *stage, OstMarking *marking, OstStage *next)
{
    OstContext *ctx = stage->ctx;
    OstMeshChunk *chunk = NULL;
    next->c = stage->c;
    next->c.order = marking->order;
    next->c.refinement = 0;
    next->bisection = stage->bisection;
    stage->bisection = NULL;
    ost_ledger_enter(ctx, OST_EFFECT_ADAPTIVITY);
    OstStatus status = cut(stage, marking, next->bisection, &chunk);
    ost_ledger_leave(ctx);
    OST_THEN(ost_scene_create_finer(stage->scene, &next->c, &chunk, &next->scene));
    ost_ledger_enter(ctx, OST_EFFECT_ADAPTIVITY);
    OST_THEN(carry(stage, next));
    ost_ledger_leave(ctx);
    return status;
}
