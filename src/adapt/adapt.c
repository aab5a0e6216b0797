/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/adapt.h"

#include "adapt/stage.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <stdio.h>

/* The estimate is to be within this share of the error that is asked for: it is up to a quarter low near edges and
 * corners. A mesh is refined for somewhat less, so that regions that are less smooth than expected do not take another
 * level. */
static const double safety = 0.75, aim = 0.6;

/* By how much a level may reduce the error, by order: what is expected of finer meshes is not trusted further. */
static const double most_reduction[3] = {0.0, 2.0, 4.0};

/* Linear tets are kept where no more than this is missing: refined, they are cheaper than quadratic ones then, which
 * have six times the unknowns on the same mesh, and mostly a quarter of the error. */
static const double linear_is_near = 1.5, growth_of_order = 6.0;

/* A level has at most about this many times the tets: what is marked on a coarse mesh is marked widely. */
static const double most_growth = 4.0;

/* A level that would have less than this many times the tets is not worth its time; one that is to have more marks so
 * many times at least, and up to the second as the rate of the last levels asks for: a level too much costs more than
 * what is finer than it need be. The third: tets made over those expected of marks, as neighbours are cut, too. */
static const double least_growth = 1.15, worthwhile_growth[2] = {1.25, 1.6}, made_over_marked = 1.5;

/* Seconds grow a little faster than unknowns; at a limit, as much faster as the last levels did, up to the second. */
static const double seconds_power = 1.1, most_seconds_power = 2.0;
const double ost_memory_beside = 2.0;

/* A request that would take so many times the memory there is, even if the error fell as that of a smooth solution, is
 * out of reach. Refinement then goes on to an error that is small or for so many seconds. */
static const double far_beyond = 100.0, small_error = 0.02, patience = 60.0;

/* What the meshes of tied faces get wrong between their vertices is not in the estimate, which has 0.6 to 0.75 of a
 * quantity's error there. */
static const double safety_of_tied = 0.5, aim_of_tied = 0.4;

/* An estimate that was measured by what potentials fell is to be within this share. */
static const double safety_of_measured = 0.9, aim_of_measured = 0.75;

/* So is one of a quantity, where its values on two levels tell how much it may miss. */
static const double safety_of_two = 0.95;

/* Errors that are more alike than this say little by their difference; volumes may change by such a part of what the
 * energy does; what contradicts the estimates by more is no measure of them. */
static const double most_alike = 0.9, flat = 0.05, least_missed = 0.7, most_missed = 2.0;

/* --- limits --- */

/* Collective. Clocks differ between ranks; rank 0's counts. */
static OstStatus seconds_since(OstContext *ctx, double start, double *seconds)
{
    *seconds = ost_seconds() - start;
    return ost_broadcast(ctx, sizeof *seconds, seconds);
}

/* Of the last level, and of the adjoint problems of watched reactions that it is solved for if it stays the last: each
 * takes about as long. */
static double seconds_to_end(const OstAdaption *adaption)
{
    const OstCase *c = &adaption->stage->c;
    int reactions = 0;
    for (int w = 0; w < c->watch_count; w++)
        reactions += c->watches[w].kind == OST_WATCH_REACTION;
    return (1.0 + reactions) * adaption->level[adaption->count - 1].seconds;
}

/* By the last two levels. */
static double power_of_seconds(const OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1], *before = last - 1;
    if (adaption->count < 2 || !((double)last->unknowns > least_growth * (double)before->unknowns))
        return seconds_power;
    const double found = log(last->seconds / before->seconds) / log((double)last->unknowns / (double)before->unknowns);
    return fmin(fmax(found, seconds_power), most_seconds_power);
}

/* By how much the limits allow the next mesh to grow, and which of them is the narrower. What is marked grows less than
 * what is made. */
static OstStatus allowed_growth(const OstAdaption *adaption, double start, double *growth, OstAdaptEnd *end)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    double elapsed = 0.0;
    OST_TRY(seconds_since(adaption->ctx, start, &elapsed));
    const double by_time = pow(fmax(adaption->limits.seconds - elapsed, 0.0) / fmax(seconds_to_end(adaption), 1e-6),
                               1.0 / power_of_seconds(adaption));
    const double by_memory = adaption->limits.bytes / (ost_memory_beside * last->bytes);
    *growth = fmin(by_time, by_memory) / adaption->overshoot;
    *end = by_time < by_memory ? OST_ADAPT_OUT_OF_TIME : OST_ADAPT_OUT_OF_MEMORY;
    return OST_SUCCESS;
}

/* --- what is missing --- */

static double error_of(const OstAdaptLevel *level)
{
    return level->relative_error;
}

/* Before what it missed was added. */
static double estimate_of(const OstAdaptLevel *level)
{
    return level->relative_error / level->missed;
}

/* Is the error of the last level that of a quantity? */
static int is_of_watch(const OstAdaption *adaption)
{
    return adaption->watch && !adaption->level[adaption->count - 1].by_norm;
}

/* The error of a quantity falls like the square of that in the norm of the energy. */
static double power_of(const OstAdaption *adaption)
{
    return is_of_watch(adaption) ? 2.0 : 1.0;
}

/* A displacement below this share of the largest one, and a reaction below this share of all its nodes' forces, as
 * those that are zero by symmetry, are compared with that share. */
static const double small_share = 1e-2;

/* Relative to what the exact value seems to be. */
static double relative_error(const OstResult *result)
{
    const OstInterestError *interest = &result->interest;
    const int of_displacement = interest->watch && interest->watch->kind == OST_WATCH_DISPLACEMENT;
    const double size = of_displacement ? result->largest_displacement : interest->size;
    const double exact = fmax(fabs(interest->value + interest->error), small_share * size);
    return interest->sum > 0.0 ? interest->sum / fmax(exact, interest->sum) : 0.0;
}

/* What the estimate of a level is to be multiplied by; 0 if not known. In nested spaces the potential is above that of
 * the solution by half of |e|²: so |e|² falls by twice as much as potentials do, and what estimates say that it fell by
 * can be compared. Near edges, and where stiff directions cross the mesh, they miss about the same part on all levels.
 * Meshes whose volume changes, as new nodes lie on a curved surface, are not nested; mixed forms have no least
 * potential. */
static double find_missed(const OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1], *before = last - 1;
    if (adaption->watch || adaption->count < 2 || before->order != last->order)
        return 0.0;
    const double e = last->error.energy_norm, old = before->error.energy_norm / before->missed;
    const double fell = 2.0 * (before->potential - last->potential), of_size = fell / fabs(last->potential);
    if (!(e <= most_alike * old) || !(fell > 0.0) || fabs(last->volume / before->volume - 1.0) > flat * of_size)
        return 0.0;
    const double missed = sqrt(fell / (old * old - e * e));
    return missed >= least_missed && missed <= most_missed ? missed : 0.0;
}

static void add_missed(OstAdaption *adaption, OstStage *stage)
{
    OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    const double missed = find_missed(adaption);
    last->is_measured = missed > 0.0;
    last->missed = stage->missed = fmax(missed, 1.0);
    last->error.energy_norm *= last->missed;
    last->error.relative = fmin(last->missed * last->error.relative, 1.0);
    last->relative_error = adaption->watch ? last->relative_error : last->error.relative;
}

/* The rate of the last two levels of one order, not below the share of that of smooth solutions, which is taken where
 * there are no two. */
static double rate_of(const OstAdaption *adaption, double least_share)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    const double smooth = power_of(adaption) * last->order / 3.0;
    if (adaption->count < 2 || last[-1].order != last->order || last[-1].by_norm != last->by_norm)
        return smooth;
    const double found =
        log(estimate_of(&last[-1]) / estimate_of(last)) / log((double)last->unknowns / (double)last[-1].unknowns);
    return fmin(fmax(found, least_share * smooth), 1.5 * smooth);
}

int ost_adaption_leaves_out_ties(const OstAdaption *adaption)
{
    return is_of_watch(adaption) && ost_effect_on(&adaption->stage->scene->plan.effects, OST_EFFECT_TIE);
}

static double safety_of(const OstAdaption *adaption, const OstAdaptLevel *level)
{
    return ost_adaption_leaves_out_ties(adaption) ? safety_of_tied : level->is_measured ? safety_of_measured : safety;
}

static double aim_at(const OstAdaption *adaption, const OstAdaptLevel *level)
{
    return ost_adaption_leaves_out_ties(adaption) ? aim_of_tied : level->is_measured ? aim_of_measured : aim;
}

/* The largest that the error of a quantity may be, by two levels. A value with its error added is far nearer to the
 * exact one, and is hardly off by more than what it has changed by since the level before. INFINITY where that is not
 * known: in parts of some errors the sign is not. */
static double most_relative_error(const OstAdaption *adaption, const OstInterestError *interest)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1], *before = last - 1;
    if (adaption->count < 2 || !interest->watch || interest->watch->kind == OST_WATCH_STRAIN_ENERGY ||
        interest->doubt > 0.0 || before->by_norm || !(last->shares > 0.0))
        return INFINITY;
    const double change = last->value + last->off - before->value - before->off;
    return last->relative_error * fmax(fabs(last->off + change) / last->shares, 1.0);
}

static int is_met(const OstAdaption *adaption, const OstAdaptLevel *level)
{
    return error_of(level) <= safety_of(adaption, level) * adaption->request ||
           (!level->by_norm && level->most_relative_error <= safety_of_two * adaption->request);
}

/* By how much the unknowns of the last level are to grow to meet the request, at a rate. */
static double growth_to_meet(const OstAdaption *adaption, double rate)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    return pow(error_of(last) / (safety_of(adaption, last) * adaption->request), 1.0 / rate);
}

static void foretell(OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    adaption->rate = rate_of(adaption, 0.1);
    const double growth = growth_to_meet(adaption, adaption->rate);
    const double room = fmax(adaption->limits.bytes / (ost_memory_beside * last->bytes), 1.0);
    adaption->reach = error_of(last) * pow(room, -adaption->rate);
    adaption->reach_seconds = pow(room, seconds_power) * seconds_to_end(adaption);
    adaption->needed_unknowns = growth * (double)last->unknowns;
    adaption->needed_seconds = pow(growth, seconds_power) * seconds_to_end(adaption);
    adaption->needed_bytes = ost_memory_beside * growth * last->bytes;
}

/* --- levels --- */

/* May linear theory do on this mesh alone? With this error e relative to u + e, the exact solution moves by up to
 * 1 / (1 - e²) times as much, and what linear theory leaves out grows like the square of that. */
static int is_too_stiff_to_judge(const OstResult *result)
{
    const OstNewtonReport *newton = &result->newton;
    const double seen = 1.0 - result->answer.relative * result->answer.relative;
    return newton->judged && !newton->used && newton->linear_error > newton->accuracy * seen * seen;
}

/* A quantity may be right while that is open, as a reaction is that statics gives: then the norm of the energy counts.
 */
static void doubt_linear_theory(const OstAdaption *adaption, OstResult *result, OstAdaptLevel *level)
{
    if (!adaption->watch || !is_met(adaption, level) || !is_too_stiff_to_judge(result))
        return;
    level->by_norm = 1;
    level->relative_error = result->answer.relative;
    OST_FREE(result->interest.share);
}

/* What the level is judged by, and its mesh refined for, where the quantity's error is not found. */
static void take_norm(const OstAdaption *adaption, OstResult *result, OstAdaptLevel *level)
{
    level->error.known &= !adaption->watch || result->interest.watch || result->interest.has_no_answer;
    if (!result->interest.has_no_answer)
        return;
    level->by_norm = 1;
    level->relative_error = result->answer.relative;
    OST_FREE(result->interest.share);
}

static OstStatus note_level(OstAdaption *adaption, OstStage *stage, double start)
{
    char share[24];
    OstAdaptLevel *level = &adaption->level[adaption->count++];
    OstResult *result = stage->result;
    *level = (OstAdaptLevel){.order = stage->scene->mesh->nodes_per_tet == 10 ? 2 : 1,
                             .tets = stage->scene->mesh->global_tets,
                             .unknowns = result->unknowns,
                             .error = result->answer,
                             .value = result->interest.value,
                             .off = result->interest.error,
                             .shares = result->interest.sum,
                             .relative_error = adaption->watch ? relative_error(result) : result->answer.relative,
                             .missed = 1.0,
                             .strain_energy = result->checks.strain_energy,
                             .potential = stage->potential,
                             .volume = stage->volume,
                             .iterations = result->solve.iterations,
                             .bytes = (double)ost_ledger_peak_bytes(adaption->ctx)};
    take_norm(adaption, result, level);
    level->most_relative_error = level->by_norm ? INFINITY : most_relative_error(adaption, &result->interest);
    if (level->error.known)
        add_missed(adaption, stage);
    if (level->error.known)
        doubt_linear_theory(adaption, result, level);
    OST_TRY(ost_sum(adaption->ctx, 1, &level->bytes));
    OST_TRY(seconds_since(adaption->ctx, start, &level->seconds));
    ost_log(adaption->ctx, OST_LOG_VERBOSE,
            "level %d: order %d, %lld tets, %lld unknowns, %d iterations, about %s off in %s; %.3f s", adaption->count,
            level->order, (long long)level->tets, (long long)level->unknowns, level->iterations,
            ost_percent(level->relative_error, share, sizeof share),
            is_of_watch(adaption) ? adaption->watch->name : "energy", level->seconds);
    return OST_SUCCESS;
}

static int is_far(const OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    return error_of(last) > pow(linear_is_near, power_of(adaption)) * adaption->request;
}

/* Quadratic tets come where much is missing: first without cutting any. Where limits leave no room for them, linear
 * ones are refined. */
static int next_order(const OstAdaption *adaption, const OstCase *c, double growth)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    return last->order == 2 || (c->order == 0 && is_far(adaption) && growth >= growth_of_order) ? 2 : 1;
}

static void warn_of_order(const OstAdaption *adaption, const OstCase *c)
{
    if (c->order == 1 && adaption->level[0].error.known && is_far(adaption))
        ost_warn(c->ctx,
                 "%s: element: {order: 1} keeps linear tets, which take far more unknowns for an error of %.3g %% than "
                 "quadratic ones; leave the order out, and they are taken",
                 c->path, 100.0 * adaption->request);
}

/* What the marks are to reach: of shares that add up to |e|², or to the error of a quantity. */
static OstMarking aim_of(const OstAdaption *adaption, int order, double growth)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    const double error = error_of(last), power = power_of(adaption);
    const double wanted = fmax(aim_at(adaption, last) * adaption->request, error / pow(most_reduction[order], power));
    const double norm = last->error.energy_norm / last->missed; /* as the tets' shares have it */
    const double square = is_of_watch(adaption) ? last->shares : norm * norm;
    const double fall = fmin(wanted / error, 1.0);
    const double needed = pow(fall, -1.0 / rate_of(adaption, 0.7)), target = square * pow(fall, 2.0 / power);
    const double most = fmin(growth, most_growth);
    const double least = fmin(fmax(needed / made_over_marked, worthwhile_growth[0]), worthwhile_growth[1]);
    if (order != last->order)
        return (OstMarking){.order = order, .target = square, .most_tets = most * (double)last->tets};
    return (OstMarking){.order = order,
                        .target = target,
                        .least_share = target / (needed * (double)last->tets),
                        .least_tets = fmin(least, most) * (double)last->tets,
                        .most_tets = most * (double)last->tets};
}

/* Goes on to the next level, unless a limit is in the way (`end`). */
static OstStatus step(OstAdaption *adaption, const OstCase *c, OstStage *stage, double start, OstStage *next,
                      int *ended)
{
    const double level_start = ost_seconds();
    double growth = 0.0;
    OST_TRY(allowed_growth(adaption, start, &growth, &adaption->end));
    *ended = growth < least_growth;
    if (*ended)
        return OST_SUCCESS;
    OstMarking marking = aim_of(adaption, next_order(adaption, c, growth), growth);
    OST_TRY(ost_stage_refine(stage, &marking, next));
    const double made = (double)next->scene->mesh->global_tets;
    if (made > (double)adaption->level[adaption->count - 1].tets)
        adaption->overshoot = fmax(made / marking.expected_tets, 1.0);
    ost_log(adaption->ctx, OST_LOG_VERBOSE, "marked: about %.0f tets expected, made %.0f", marking.expected_tets, made);
    OST_TRY(ost_stage_solve(next));
    return note_level(adaption, next, level_start);
}

/* An error that is still above this share of what it was with so many times fewer unknowns tells of an energy without
 * limit, as that of a force on a point. */
static const double many_times = 8.0, hardly_less = 0.85;

/* The error over that of the last level with so many times fewer unknowns; 0 if there is none. Quadratic tets alone:
 * errors of linear ones stay near 100 % as long as they lock. */
static double left_of_error(const OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    for (const OstAdaptLevel *level = last; level-- > adaption->level && level->order == 2;)
        if (many_times * (double)level->unknowns <= (double)last->unknowns)
            return error_of(last) / error_of(level);
    return 0.0;
}

/* Whoever sets a limit of time is not stopped before: that is how to get the best there is. Collective. */
static OstStatus stop_out_of_reach(OstAdaption *adaption, double start, int *over)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    double elapsed = 0.0;
    if (*over || adaption->count < 2 || last[-1].order != last->order || isfinite(adaption->limits.seconds))
        return OST_SUCCESS;
    adaption->left = left_of_error(adaption);
    if (adaption->left > hardly_less) {
        *over = 1;
        adaption->end = OST_ADAPT_OUT_OF_REACH;
        return OST_SUCCESS;
    }
    const double growth = growth_to_meet(adaption, power_of(adaption) * last->order / 3.0);
    adaption->left = 0.0;
    if (growth * ost_memory_beside * last->bytes <= far_beyond * adaption->limits.bytes)
        return OST_SUCCESS;
    OST_TRY(seconds_since(adaption->ctx, start, &elapsed));
    *over = error_of(last) <= small_error || elapsed > patience;
    if (*over)
        adaption->end = OST_ADAPT_OUT_OF_REACH;
    return OST_SUCCESS;
}

/* Is the request met, or is there no more to be done? */
static int is_over(OstAdaption *adaption)
{
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    const int met = last->error.known && is_met(adaption, last);
    const int over = !last->error.known || met || adaption->count == OST_MOST_ADAPT_LEVELS;
    if (over)
        adaption->end = !last->error.known ? OST_ADAPT_NO_ESTIMATE : met ? OST_ADAPT_MET : OST_ADAPT_OUT_OF_LEVELS;
    return over;
}

/* A warning tells of selected areas that change by more than the request and by more than this, as curved surfaces may.
 */
static const double least_change = 0.01;

/* Makes the next level the last one; the one before is kept while no later one has a smaller error. */
static OstStatus take_level(OstAdaption *adaption, OstStage **next)
{
    OstStage *before = adaption->stage;
    const int last = adaption->count - 1;
    const OstAdaptLevel *level = adaption->level;
    const int is_worse =
        !level[last].error.known || level[last].relative_error > level[adaption->answer].relative_error;
    adaption->stage = *next;
    *next = before;
    if (is_worse && !adaption->best) {
        adaption->best = before;
        *next = NULL;
    } else if (!is_worse) {
        ost_stage_destroy(&adaption->best);
        adaption->answer = last;
    }
    return ost_first_mesh_compare(&adaption->first, adaption->stage->scene, fmax(adaption->request, least_change));
}

/* A finer level that fails leaves the one before as the answer. */
static OstStatus take_failure(OstAdaption *adaption, OstStatus status)
{
    snprintf(adaption->failure, sizeof adaption->failure, "%s", ost_error_text(adaption->ctx));
    adaption->end = OST_ADAPT_FAILED;
    return status == OST_LIBRARY_FAILED ? status : OST_SUCCESS;
}

static OstStatus solve_levels(OstAdaption *adaption, const OstCase *c, double start)
{
    int ended = is_over(adaption);
    OST_TRY(stop_out_of_reach(adaption, start, &ended));
    while (!ended) {
        OstStage *next = NULL;
        OstStatus status = ost_stage_create(adaption->ctx, &next);
        OST_THEN(step(adaption, c, adaption->stage, start, next, &ended));
        if (status == OST_SUCCESS && !ended)
            status = take_level(adaption, &next);
        ost_stage_destroy(&next);
        if (status != OST_SUCCESS)
            return take_failure(adaption, status);
        ended = ended || is_over(adaption);
        OST_TRY(stop_out_of_reach(adaption, start, &ended));
    }
    return OST_SUCCESS;
}

static OstStatus adapt(OstAdaption *adaption, const OstCase *c)
{
    const double start = ost_seconds();
    OST_TRY(ost_stage_create(adaption->ctx, &adaption->stage));
    OST_TRY(ost_stage_open(adaption->stage, c));
    OST_TRY(ost_first_mesh_keep(adaption->stage->scene, &adaption->stage->c, &adaption->first));
    OST_TRY(ost_stage_solve(adaption->stage));
    OST_TRY(note_level(adaption, adaption->stage, start));
    warn_of_order(adaption, c);
    OST_TRY(solve_levels(adaption, c, start));
    if (adaption->end != OST_ADAPT_MET && adaption->end != OST_ADAPT_NO_ESTIMATE)
        foretell(adaption);
    if (adaption->best) {
        ost_stage_destroy(&adaption->stage);
        adaption->stage = adaption->best;
        adaption->best = NULL;
    }
    return ost_stage_finish(adaption->stage);
}

OstStatus ost_adapt(const OstCase *c, const OstAdaptLimits *limits, OstAdaption **adaption)
{
    OST_TRY(ost_agree(c->ctx, OST_NEW(c->ctx, adaption, 1)));
    (*adaption)->ctx = c->ctx;
    (*adaption)->request = c->relative_error;
    (*adaption)->watch = c->interest > 0 ? &c->watches[c->interest - 1] : NULL;
    (*adaption)->limits = *limits;
    (*adaption)->overshoot = made_over_marked;
    return adapt(*adaption, c);
}

void ost_adaption_destroy(OstAdaption **adaption)
{
    if (!*adaption)
        return;
    ost_stage_destroy(&(*adaption)->stage);
    ost_stage_destroy(&(*adaption)->best);
    ost_first_mesh_clear(&(*adaption)->first);
    OST_FREE(*adaption);
}

OstScene *ost_adaption_scene(const OstAdaption *adaption)
{
    return adaption->stage ? adaption->stage->scene : NULL;
}

OstResult *ost_adaption_result(const OstAdaption *adaption)
{
    return adaption->stage ? adaption->stage->result : NULL;
}

OstAdaptEnd ost_adaption_end(const OstAdaption *adaption)
{
    return adaption->end;
}

int ost_adaption_level_count(const OstAdaption *adaption)
{
    return adaption->count;
}

const OstAdaptLevel *ost_adaption_level(const OstAdaption *adaption, int number)
{
    return &adaption->level[number];
}
