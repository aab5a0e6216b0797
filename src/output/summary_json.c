/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/summary.h"

#include "core/error.h"
#include "core/json_file.h"
#include "output/path_files.h"

#include <math.h>

static json_t *vector_json(const double v[3])
{
    return json_pack("[o, o, o]", ost_json_number(v[0]), ost_json_number(v[1]), ost_json_number(v[2]));
}

json_t *ost_solver_reasons_json(const OstSolverPlan *plan)
{
    json_t *reasons = json_array();
    for (int r = 0; r < plan->reasons; r++)
        json_array_append_new(reasons, ost_json_text(plan->reason[r]));
    return reasons;
}

static json_t *steps_json(const OstSolveReport *report)
{
    json_t *steps = json_array();
    for (int s = 0; s < report->steps; s++) {
        const OstSolveStep *step = &report->step[s];
        json_array_append_new(steps,
                              json_pack("{s:s, s:i, s:o, s:o, s:f, s:o}", "strategy", ost_method_name(step->method),
                                        "iterations", step->iterations, "factor", ost_json_number(step->factor),
                                        "relative_residual", ost_json_number(step->relative_residual), "seconds",
                                        step->seconds, "outcome", ost_json_text(step->outcome)));
    }
    return steps;
}

/* 0 stands for no estimate. */
static json_t *estimate_json(double estimate)
{
    return estimate > 0.0 ? ost_json_number(estimate) : json_null();
}

static json_t *solver_json(const OstSolveReport *report)
{
    json_t *levels = json_array();
    for (int l = 0; l < report->levels; l++)
        json_array_append_new(levels, json_integer(report->level_unknowns[l]));
    return json_pack(
        "{s:s, s:s, s:i, s:o, s:o, s:b, s:f, s:f, s:o, s:f, s:o, s:o, s:o, s:f, s:o, s:o, s:o, s:o, s:b, s:i}",
        "method", ost_method_name(report->method), "engine", report->engine, "iterations", report->iterations,
        "relative_residual", ost_json_number(report->relative_residual), "attainable_residual",
        estimate_json(report->attainable_residual), "rounding_limited", report->rounding_limited, "setup_seconds",
        report->setup_seconds, "solve_seconds", report->solve_seconds, "level_unknowns", levels, "operator_complexity",
        report->operator_complexity, "condition_estimate", ost_json_number(report->condition_estimate),
        "error_estimate", ost_json_number(report->error_estimate), "rounding_error",
        ost_json_number(report->rounding_error), "rounding_spread", report->rounding_spread, "plan",
        ost_solver_reasons_json(&report->plan), "strategies", steps_json(report), "algebraic_error",
        estimate_json(report->algebraic_error), "algebraic_bound", estimate_json(report->algebraic_bound), "stopped",
        report->stopped, "iterations_saved", report->iterations_saved);
}

static json_t *checks_json(const OstChecks *checks)
{
    return json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:o, s:o, s:o, s:o}", "relative_residual",
        ost_json_number(checks->relative_residual), "rounding", ost_json_number(checks->rounding), "rigid_motion",
        ost_json_number(checks->rigid_motion), "displacement_error", ost_json_number(checks->displacement_error),
        "force_error", ost_json_number(checks->force_error), "load", vector_json(checks->load), "reaction",
        vector_json(checks->reaction), "force_imbalance", ost_json_number(checks->force_imbalance), "moment_imbalance",
        ost_json_number(checks->moment_imbalance), "strain_energy", ost_json_number(checks->strain_energy), "work",
        ost_json_number(checks->linear ? checks->work : NAN), "energy_imbalance",
        ost_json_number(checks->linear ? checks->energy_imbalance : NAN), "finite", checks->finite, "largest_strain",
        ost_json_number(checks->largest_strain), "largest_rotation", ost_json_number(checks->largest_rotation),
        "stiffening", ost_json_number(checks->linear ? checks->stiffening : NAN), "volume_ratio",
        checks->volume_ratio != 0.0 ? ost_json_number(checks->volume_ratio) : json_null());
}

/* The error that the mesh makes; null: not estimated. */
static json_t *answer_error_json(const OstResult *result)
{
    const OstAnswerError *answer = &result->answer;
    if (!answer->known)
        return json_null();
    return json_pack("{s:o, s:o, s:o, s:b, s:s, s:o, s:o, s:o, s:o}", "energy_norm",
                     ost_json_number(answer->energy_norm), "relative", ost_json_number(answer->relative),
                     "displacement", ost_json_number(answer->displacement), "displacement_is_least",
                     answer->displacement_is_least, "worst_region", result->mesh->regions.name[answer->region],
                     "region_share", ost_json_number(answer->region_share), "worst_place", vector_json(answer->place),
                     "cut_off", ost_json_number(answer->cut_off), "filled_in", ost_json_number(answer->filled_in));
}

/* The least load factors; null: no material has strengths. A factor is null where nothing fails. */
static json_t *strength_json(const OstResult *result)
{
    static const char *const word[OST_CRITERIA] = {
        [OST_TSAI_WU] = "tsai_wu", [OST_HILL] = "hill", [OST_MAXIMUM_STRESS] = "maximum_stress"};
    json_t *criteria = result->failure.known ? json_object() : json_null();
    for (int c = 0; c < OST_CRITERIA && result->failure.known; c++) {
        const OstLeastFactor *least = &result->failure.least[c];
        const int fails = least->factor < OST_MOST_LOAD_FACTOR;
        json_object_set_new(criteria, word[c],
                            json_pack("{s:o, s:o, s:s, s:o}", "load_factor",
                                      fails ? ost_json_number(least->factor) : json_null(), "tet",
                                      fails ? json_integer(least->tet) : json_null(), "region",
                                      result->mesh->regions.name[least->region], "place",
                                      fails ? vector_json(least->place) : json_null()));
    }
    return criteria;
}

/* The load factors of buckling modes; null: not looked for, or none that matters. A factor is null where the body never
 * buckles. */
static json_t *buckling_json(const OstBuckling *buckling)
{
    json_t *factors = json_array();
    for (int m = 0; m < buckling->count; m++)
        json_array_append_new(factors, ost_json_number(buckling->factor[m]));
    json_t *all = json_pack("{s:o, s:i, s:b, s:f}", "load_factors", factors, "iterations", buckling->iterations,
                            "converged", buckling->converged, "seconds", buckling->seconds);
    if (buckling->known)
        return all;
    json_decref(all);
    return json_null();
}

static json_t *large_rotation_json(const OstNewtonReport *newton)
{
    if (!newton->judged)
        return json_null();
    return json_pack("{s:o, s:f, s:o, s:o, s:o, s:o, s:b, s:f, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:o, s:o, s:b, s:i, "
                     "s:o, s:b, s:f}",
                     "linear_error", ost_json_number(newton->linear_error), "accuracy", newton->accuracy,
                     "linear_strain", ost_json_number(newton->linear_strain), "linear_rotation",
                     ost_json_number(newton->linear_rotation), "linear_stiffening",
                     ost_json_number(newton->linear_stiffening), "linear_change",
                     ost_json_number(newton->linear_change), "newton", newton->used, "load_factor", newton->reached,
                     "load_steps", newton->load_steps, "cut_backs", newton->cut_backs, "newton_iterations",
                     newton->iterations, "definite_iterations", newton->definite, "line_search_cuts", newton->cuts,
                     "linear_iterations", newton->linear_iterations, "setups", newton->setups, "newton_residual",
                     ost_json_number(newton->relative_residual), "last_correction", ost_json_number(newton->change),
                     "newton_rounding_limited", newton->rounding_limited, "jumps", newton->jumps, "jump_at",
                     newton->jumps > 0 ? ost_json_number(newton->jump_at) : json_null(), "stability_unknown",
                     newton->stability_unknown, "newton_seconds", newton->seconds);
}

/* What standard error warned of, and what the summary does. */
static json_t *warnings_json(const OstContext *ctx, const OstResult *result)
{
    json_t *warnings = ost_json_warnings(ctx);
    char text[OST_LONGEST_WARNING];
    for (int w = 0; w < OST_WARNINGS; w++)
        if (ost_result_warning(result, w, text))
            json_array_append_new(warnings, ost_json_text(text));
    return warnings;
}

static json_t *objections_json(const OstVerdict *objections)
{
    json_t *reasons = json_array();
    for (int i = 0; i < objections->count; i++)
        json_array_append_new(reasons, ost_json_text(objections->text[i]));
    return reasons;
}

/* Multiplied entries of matrices as products with the stiffness. */
static json_t *products_json(double nonzeros, double multiplied)
{
    return nonzeros > 0.0 ? json_real(multiplied / nonzeros) : json_null();
}

static json_t *account_json(const OstContext *ctx, double nonzeros, const OstLedgerSummary *summary, OstAccount account)
{
    return json_pack("{s:s, s:b, s:f, s:f, s:I, s:o}", "name", ost_ledger_label(ctx, account), "effect",
                     account >= OST_LEDGER_PHASES, "seconds", summary->seconds[account], "bytes",
                     summary->peak_bytes[account], "entries", (json_int_t)summary->entries[account], "products",
                     products_json(nonzeros, summary->multiplied[account]));
}

json_t *ost_ledger_json(const OstContext *ctx, double nonzeros, const OstLedgerSummary *summary)
{
    json_t *accounts = json_array();
    double multiplied = 0.0;
    for (int a = 0; a < OST_EFFECT_END; a++) {
        json_array_append_new(accounts, account_json(ctx, nonzeros, summary, a));
        multiplied += summary->multiplied[a];
    }
    return json_pack("{s:o, s:f, s:f, s:f, s:o}", "accounts", accounts, "total_seconds", summary->total_seconds,
                     "peak_bytes", summary->peak_tracked_bytes, "peak_process_bytes", summary->peak_process_bytes,
                     "products", products_json(nonzeros, multiplied));
}

json_t *ost_effects_json(const OstEffects *effects)
{
    json_t *list = json_array();
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++) {
        const OstEffectState *state = ost_effect_state(effects, (OstEffect)e);
        json_array_append_new(list, json_pack("{s:s, s:b, s:s, s:f}", "effect", ost_effect_label((OstEffect)e), "on",
                                              state->on, "reason", state->reason, "bytes", state->bytes));
    }
    return list;
}

static json_t *watched_json(const OstWatchedValue *watched, int count)
{
    json_t *values = json_object();
    for (int w = 0; w < count; w++)
        json_object_set_new(
            values, watched[w].name,
            json_pack("{s:o, s:o, s:o, s:s?, s:o, s:o}", "value", ost_json_number(watched[w].value), "expected",
                      ost_json_number(watched[w].expected), "error", ost_json_number(watched[w].error),
                      "error_not_known", watched[w].why, "corrected",
                      ost_json_number(watched[w].by_adjoint ? watched[w].value + watched[w].error : NAN), "place",
                      watched[w].placed ? vector_json(watched[w].place) : json_null()));
    return values;
}

json_t *ost_summary_json(const OstScene *scene, const OstResult *result, const OstLedgerSummary *summary,
                         const OstWatchedValue *watched, const char *file)
{
    const OstMesh *mesh = result->mesh;
    return json_pack("{s:s, s:s?, s:b, s:s, s:o, s:o, s:i, s:I, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, "
                     "s:o*, s:s?, s:o, s:o}",
                     "case", scene->c->path, "title", scene->c->title, "accepted", result->verdict.count == 0, "status",
                     ost_result_status(result), "reasons", objections_json(&result->verdict), "warnings",
                     warnings_json(scene->ctx, result), "ranks", ost_size(scene->ctx), "vertices",
                     (json_int_t)mesh->global_nodes, "tets", (json_int_t)mesh->global_tets, "unknowns",
                     (json_int_t)result->unknowns, "solver", solver_json(&result->solve), "large_rotation",
                     large_rotation_json(&result->newton), "checks", checks_json(&result->checks), "answer_error",
                     answer_error_json(result), "largest_displacement", ost_json_number(result->largest_displacement),
                     "largest_at", vector_json(result->largest_at), "watched",
                     watched_json(watched, scene->c->watch_count), "effects", ost_effects_json(&scene->plan.effects),
                     "ledger", summary ? ost_ledger_json(scene->ctx, result->solve.nonzeros, summary) : NULL, "output",
                     file, "strength", strength_json(result), "buckling", buckling_json(&result->buckling));
}

OstStatus ost_summary_write_json(const OstScene *scene, const OstResult *result, OstPath *path,
                                 const OstLedgerSummary *summary, const OstWatchedValue *watched, const char *file,
                                 const OstAdaption *adaption, const char *to)
{
    OstContext *ctx = scene->ctx;
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    json_t *document = ost_summary_json(scene, result, summary, watched, file);
    if (!document)
        return OST_RAISE(ctx, OST_CHECK_FAILED,
                         "the summary holds a number that is not finite, which JSON cannot hold");
    if (path)
        json_object_set_new(document, "steps", ost_path_json(scene, path));
    if (adaption)
        json_object_set_new(document, "adaption", ost_adaption_json(adaption));
    return ost_json_write(ctx, document, to);
}
