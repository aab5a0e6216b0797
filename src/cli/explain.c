/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_data.h"
#include "case/plan.h"
#include "cli/command.h"
#include "cli/destination.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "mesh/mesh_data.h"
#include "orthostat/solver.h"
#include "output/summary.h"
#include "problem/scene_parts.h"
#include "study/forecast/forecast.h"

#include <jansson.h>
#include <stdio.h>

static const struct argp_option options[] = {
    {"json", 'j', "FILE", OPTION_ARG_OPTIONAL, "Print what was found as JSON, or write it here", 0}, {0}};

static const struct argp explain_argp = {
    .options = options,
    .parser = ost_cli_take,
    .args_doc = "CASE",
    .doc = "Say which effects a case calls for and why, how it will be solved, and how large the job is. Nothing is "
           "assembled; the mesh is made only where it alone tells what a load acts on, and on several ranks.",
};

/* Makes the mesh, where it alone tells: if a load (on a box, or on a boundary of a file) acts on faces or on vertices;
 * on several ranks, what the partition keeps whole. */
static OstStatus plan_with_mesh(OstContext *ctx, const OstCase *c, OstPlan *plan)
{
    OstMesh *mesh = NULL;
    OstFileMaterials *from_file = NULL;
    OstSceneMaterials materials = {0};
    OstEffect *load = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &load, (size_t)c->load_count));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_scene_make_mesh(c, &mesh, &from_file, &materials));
    OST_TRY_DONE(ost_load_effects(c, mesh, load));
    double surface = 0.0;
    OST_TRY_DONE(ost_mesh_surface_faces(mesh, &surface));
    const OstPlanMesh facts = {.nodes = mesh->global_nodes,
                               .tets = mesh->global_tets,
                               .quadratic = mesh->nodes_per_tet == 10,
                               .surface = surface,
                               .regions = &mesh->regions,
                               .materials = from_file,
                               .load = load,
                               .welded = mesh->welded};
    ost_plan_make(c, &facts, ost_size(ctx), plan);
done:
    OST_FREE(load);
    ost_scene_materials_release(&materials);
    ost_file_materials_destroy(&from_file);
    ost_mesh_destroy(&mesh);
    return status;
}

/* Reads the mesh file for its counts, regions and materials. */
static OstStatus plan_with_file(OstContext *ctx, const OstCase *c, OstPlan *plan)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    OstStatus status = ost_case_located(c, c->mesh_place, ost_mesh_file_read(ctx, c->mesh_file, &chunk, &materials));
    if (status != OST_SUCCESS)
        goto done;
    OstPlanMesh facts = {.nodes = chunk->global_nodes,
                         .tets = chunk->global_tets,
                         .quadratic = c->order == 0 ? chunk->nodes_per_tet == 10 : c->order == 2,
                         .regions = &chunk->regions,
                         .materials = materials};
    OST_TRY_DONE(ost_chunk_surface_faces(chunk, &facts.surface));
    ost_plan_file_size(c, chunk->nodes_per_tet, &facts.nodes, &facts.tets, &facts.surface);
    OST_TRY_DONE(ost_plan_check_size(c, facts.nodes));
    ost_plan_make(c, &facts, ost_size(ctx), plan);
done:
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
    return status;
}

/* A shape's divisions give its size. */
static OstStatus plan_with_shape(OstContext *ctx, const OstCase *c, OstPlan *plan)
{
    OstPlanMesh facts = {.quadratic = c->order == 2};
    ost_plan_shape_size(c, &facts.nodes, &facts.tets);
    OST_TRY(ost_plan_check_size(c, facts.nodes));
    ost_plan_make(c, &facts, ost_size(ctx), plan);
    return OST_SUCCESS;
}

static OstStatus make_plan(OstContext *ctx, const OstCase *c, OstPlan *plan)
{
    if (ost_loads_need_mesh(c) || (ost_size(ctx) > 1 && c->mesh_kind != OST_MESH_FROM_PROGRAM))
        OST_TRY(plan_with_mesh(ctx, c, plan));
    else if (c->mesh_kind == OST_MESH_FILE)
        OST_TRY(plan_with_file(ctx, c, plan));
    else
        OST_TRY(plan_with_shape(ctx, c, plan));
    OST_TRY(ost_memory_free(ctx, &plan->facts.free_memory));
    ost_plan_fit(c, ost_size(ctx), plan->facts.free_memory, plan);
    ost_solver_plan(&c->solver, &plan->facts, &plan->solver);
    ost_warn_absent_fields(c, &plan->effects);
    return OST_SUCCESS;
}

static void print_bytes(const char *label, double bytes)
{
    const double mebibytes = bytes / 1048576.0;
    if (mebibytes < 1024.0)
        printf("  %-20s %10.1f MiB\n", label, mebibytes);
    else
        printf("  %-20s %10.1f GiB\n", label, mebibytes / 1024.0);
}

static void print_solver(const OstSolverPlan *plan)
{
    printf("\nSolver\n  %-20s %s%s: %s\n", "method", ost_method_name(plan->first),
           plan->options.method == OST_METHOD_AUTO ? " first" : "", plan->reason[0]);
    for (int r = 1; r < plan->reasons; r++)
        printf("  %-20s %s\n", "", plan->reason[r]);
    printf("  %-20s %s\n", "engine", ost_method_engine(plan->first));
}

static void axes_words(const OstAxesSpec *axes, char *text, size_t size)
{
    static const char *const direction[] = {"axial", "radial", "tangential"};
    const double *e = axes->fixed, *a = axes->axis;
    const char *order[3];
    for (int i = 0; i < 3; i++)
        order[i] = direction[axes->order[i]];
    switch (axes->kind) {
    case OST_AXES_CYLINDRICAL:
        snprintf(text, size, "e1 %s, e2 %s, e3 %s about (%g, %g, %g)", order[0], order[1], order[2], a[0], a[1], a[2]);
        return;
    case OST_AXES_CURVE:
        snprintf(text, size, "e1 %s, e2 %s, e3 %s of a curve", order[0], order[1], order[2]);
        return;
    case OST_AXES_CELLS:
        snprintf(text, size, "e1, e2, e3 as %.200s has them", axes->cells_file ? axes->cells_file : "the mesh");
        return;
    case OST_AXES_GRADIENT:
        if (!axes->from[1])
            snprintf(text, size, "e%d from '%.80s' to '%.80s', the others across it", axes->along[0] + 1, axes->from[0],
                     axes->to[0]);
        else
            snprintf(text, size, "e%d from '%.80s' to '%.80s', e%d from '%.80s' to '%.80s', e%d across both",
                     axes->along[0] + 1, axes->from[0], axes->to[0], axes->along[1] + 1, axes->from[1], axes->to[1],
                     4 - axes->along[0] - axes->along[1]);
        return;
    case OST_AXES_FIELD:
        if (axes->along[0] < 0)
            snprintf(text, size, "e1, e2, e3 as the field '%.80s' has them", axes->field[0]);
        else if (axes->field[1])
            snprintf(text, size, "e%d along the field '%.80s', e%d along '%.80s'", axes->along[0] + 1, axes->field[0],
                     axes->along[1] + 1, axes->field[1]);
        else
            snprintf(text, size, "e%d along the field '%.80s', the others across it", axes->along[0] + 1,
                     axes->field[0]);
        return;
    case OST_AXES_NONE:
    case OST_AXES_FIXED:
    case OST_AXES_EULER:
    case OST_AXES_QUATERNION:
        break;
    }
    snprintf(text, size, "e1 = (%.4g, %.4g, %.4g), e2 = (%.4g, %.4g, %.4g), e3 = (%.4g, %.4g, %.4g)", e[0] + 0.0,
             e[1] + 0.0, e[2] + 0.0, e[3] + 0.0, e[4] + 0.0, e[5] + 0.0, e[6] + 0.0, e[7] + 0.0, e[8] + 0.0);
}

/* The materials that the case states. Into which direction each modulus goes is easily mistaken. */
static json_t *materials_json(const OstCase *c)
{
    json_t *materials = json_array();
    for (int i = 0; i < c->material_count; i++) {
        const OstCaseMaterial *stated = &c->materials[i];
        char moduli[OST_MODULI_WORDS], axes[512];
        ost_orthotropic_words(&stated->material.constants, moduli);
        axes_words(&stated->axes, axes, sizeof axes);
        json_array_append_new(materials, json_pack("{s:o, s:s, s:o}", "region", ost_json_text(stated->region), "moduli",
                                                   moduli, "axes", ost_json_text(axes)));
    }
    return materials;
}

static void print_materials(const OstCase *c)
{
    if (c->material_count > 0)
        printf("\nMaterials\n");
    for (int i = 0; i < c->material_count; i++) {
        const OstCaseMaterial *stated = &c->materials[i];
        char words[512];
        ost_orthotropic_words(&stated->material.constants, words);
        printf("  %-20s %s%s%.80s%s\n", stated->region, words, stated->modulus.field ? ", times the field '" : "",
               stated->modulus.field ? stated->modulus.field : "", stated->modulus.field ? "'" : "");
        if (stated->material.isotropic)
            continue;
        axes_words(&stated->axes, words, sizeof words);
        printf("  %-20s %s\n", "", words);
    }
}

/* What is foretold, and from which rates. */
typedef struct Future {
    OstForecast forecast;
    char rates[320];
} Future;

static OstStatus foretell(OstContext *ctx, const OstCase *c, const OstPlan *plan, Future *future)
{
    OstRates rates;
    OST_TRY(ost_rates_load(ctx, &rates));
    ost_forecast_make(c, plan, &rates, ost_size(ctx), &future->forecast);
    ost_rates_words(&rates, ORTHOSTAT_VERSION, future->rates, sizeof future->rates);
    return OST_SUCCESS;
}

static void print_seconds(const char *label, double seconds)
{
    if (seconds < 600.0)
        printf("  %-20s %10.*f s\n", label, seconds < 10.0 ? 2 : 1, seconds);
    else
        printf("  %-20s %10.1f min\n", label, seconds / 60.0);
}

static void print_future(const Future *future)
{
    const OstForecast *forecast = &future->forecast;
    printf("\nPredicted seconds, by rates %s\n", future->rates);
    print_seconds("start", forecast->start);
    for (int s = OST_STAGE_MESH; s < OST_STAGES; s++)
        if (forecast->work[s] > 0.0)
            print_seconds(ost_stage_label[s], forecast->seconds[s]);
    print_seconds(ost_stage_label[OST_STAGE_REST], forecast->seconds[OST_STAGE_REST]);
    if (forecast->newton_in_all > 0.0)
        print_seconds("Newton's method", forecast->newton_in_all);
    print_seconds("total", forecast->in_all);
    printf("  %-20s %10.0f of the linear solver\n", "iterations", forecast->iterations);
    if (forecast->newton > 0.0)
        printf("  Each iteration of Newton's method%s comes on top: about %.2g s\n",
               forecast->newton_in_all > 0.0 ? " beyond three a step" : ", where rotations are large,",
               forecast->newton);
}

static void print_plan(const OstCase *c, const OstPlan *plan, const Future *future, int ranks)
{
    printf("%s: %s\n\nEffects\n", c->path, c->title);
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++) {
        const OstEffectState *state = ost_effect_state(&plan->effects, (OstEffect)e);
        printf("  %-23s %-4s %s\n", ost_effect_label((OstEffect)e), state->on ? "on" : "off", state->reason);
    }
    print_materials(c);
    print_solver(&plan->solver);
    printf("  %-20s %g\n", "relative residual", c->solver.relative_residual);
    if (c->load_case_count > 0)
        printf("  %-20s %d, with one stiffness and one hierarchy for all that share supports\n", "load cases",
               c->load_case_count);
    printf("\nSize\n  %-20s %14lld\n  %-20s %14lld\n  %-20s %14lld at most (before supports)\n", "vertices",
           (long long)plan->nodes, "tets", (long long)plan->tets, "unknowns", (long long)plan->unknowns);
    if (plan->least_ranks > ranks)
        printf("  %-20s %14d at least: a rank can hold 2^31 - 1 nonzeros of the stiffness, or nodes of tets\n", "ranks",
               plan->least_ranks);
    printf("\nPredicted memory, over %d rank%s\n", ranks, ranks == 1 ? "" : "s");
    print_bytes("mesh", plan->bytes_mesh);
    print_bytes("stiffness", plan->bytes_matrix);
    print_bytes("solver", plan->bytes_solver);
    print_bytes("effects", plan->bytes_effects);
    if (plan->bytes_company > 0.0)
        print_bytes("load cases", plan->bytes_company);
    print_bytes("at the peak", plan->bytes_in_all + plan->bytes_company);
    print_bytes("with libraries", future->forecast.with_libraries);
    print_bytes("free now", plan->facts.free_memory);
    if (future->forecast.with_libraries > plan->facts.free_memory)
        puts("  This does not fit: use a coarser mesh, or more machines.");
    print_bytes("output file", plan->bytes_output);
    print_future(future);
}

static json_t *seconds_json(const OstForecast *forecast)
{
    json_t *seconds = json_pack("{s:f}", "start", forecast->start);
    for (int s = 0; s < OST_STAGES; s++)
        json_object_set_new(seconds, ost_stage_label[s], json_real(forecast->seconds[s]));
    json_object_set_new(seconds, "in_all", json_real(forecast->in_all));
    json_object_set_new(seconds, "newton", json_real(forecast->newton_in_all));
    json_object_set_new(seconds, "newton_iteration", json_real(forecast->newton));
    return seconds;
}

static OstStatus write_json(const OstCase *c, const OstPlan *plan, const Future *future, const char *path)
{
    const int ranks = ost_size(c->ctx);
    json_t *root = json_pack(
        "{s:s, s:s, s:o, s:o, s:{s:s, s:s, s:o, s:f}, s:I, s:I, s:I, s:i, s:i, s:o, s:{s:f, s:f, s:f, s:f, s:f, s:f, "
        "s:f, s:f}, s:o, s:s, s:f}",
        "case", c->path, "title", c->title, "effects", ost_effects_json(&plan->effects), "materials", materials_json(c),
        "solver", "method", ost_method_name(plan->solver.first), "engine", ost_method_engine(plan->solver.first),
        "reasons", ost_solver_reasons_json(&plan->solver), "relative_residual", c->solver.relative_residual, "vertices",
        (json_int_t)plan->nodes, "tets", (json_int_t)plan->tets, "unknowns_at_most", (json_int_t)plan->unknowns,
        "ranks", ranks, "ranks_at_least", plan->least_ranks, "warnings", ost_json_warnings(c->ctx), "bytes", "mesh",
        plan->bytes_mesh, "stiffness", plan->bytes_matrix, "solver", plan->bytes_solver, "effects", plan->bytes_effects,
        "in_all", plan->bytes_in_all + plan->bytes_company, "free", plan->facts.free_memory, "output_file",
        plan->bytes_output, "with_libraries", future->forecast.with_libraries, "seconds",
        seconds_json(&future->forecast), "rates", future->rates, "iterations", future->forecast.iterations);
    if (!root)
        return OST_RAISE(c->ctx, OST_LIBRARY_FAILED, "%s: the plan cannot be written as JSON (is its title UTF-8?)",
                         c->path);
    return ost_json_write(c->ctx, root, path);
}

static OstStatus explain(OstContext *ctx, void *input)
{
    const OstArguments *arguments = input;
    OstCase *c = NULL;
    OstPlan plan;
    Future future;
    OstStatus status = OST_SUCCESS;
    const char *json = ost_cli_json(arguments);
    OST_TRY_DONE(ost_cli_read(ctx, arguments, &c));
    OST_TRY_DONE(ost_check_outputs(c, 1, &json));
    OST_TRY_DONE(make_plan(ctx, c, &plan));
    OST_TRY_DONE(foretell(ctx, c, &plan, &future));
    if (ost_rank(ctx) == 0 && json)
        status = write_json(c, &plan, &future, json);
    else if (ost_rank(ctx) == 0 && ost_log_level(ctx) != OST_LOG_QUIET)
        print_plan(c, &plan, &future, ost_size(ctx));
    status = ost_agree(ctx, status);
done:
    ost_case_destroy(&c);
    return status;
}

int ost_cli_explain(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run_on_case(ctx, &explain_argp, argc, argv, &arguments, explain);
}
