/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/select.h"
#include "cli/command.h"
#include "cli/destination.h"
#include "cli/solve_path.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "output/load_case_files.h"
#include "output/path_files.h"
#include "problem/scene_data.h"
#include "study/watch.h"

#include <stdio.h>
#include <string.h>

static const struct argp_option options[] = {
    {"json", 'j', "FILE", OPTION_ARG_OPTIONAL, "Print what was found as JSON, or write it here", 0}, {0}};

static const struct argp check_argp = {
    .options = options,
    .parser = ost_cli_take,
    .args_doc = "CASE",
    .doc = "Read a case, make its mesh, materials, axes, selections and equations, and report what is wrong with them. "
           "Nothing is solved.",
};

/* What the checks found besides errors. */
typedef struct Findings {
    OstGlobal constrained; /* vertices that constraints select, counted once for each constraint */
    char output[OST_LONGEST_PATH];
    char first_step[OST_LONGEST_PATH]; /* of a path */
} Findings;

static OstStatus count_nodes(const OstScene *scene, const OstSelection *selection, OstGlobal *total)
{
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, selection, &count, &nodes));
    *total = 0;
    for (OstLocal i = 0; i < count; i++)
        *total += nodes[i] < scene->mesh->owned_nodes;
    OST_FREE(nodes);
    return ost_sum_numbers(scene->ctx, 1, total);
}

static OstStatus count_faces(const OstScene *scene, const OstSelection *selection, int *some)
{
    OstLocal count = 0;
    int nodes_per_face = 0;
    OstLocal *faces = NULL;
    OST_TRY(ost_select_faces(scene->c, scene->mesh, selection, &count, &nodes_per_face, &faces));
    OST_FREE(faces);
    *some = count > 0;
    return ost_max_ints(scene->ctx, 1, some);
}

static OstStatus check_load(const OstScene *scene, const OstLoad *load)
{
    const int needs_faces =
        load->kind == OST_LOAD_TRACTION || load->kind == OST_LOAD_PRESSURE ||
        ((load->kind == OST_LOAD_TOTAL_FORCE || load->kind == OST_LOAD_MOMENT) && load->share == OST_SHARE_FACES);
    if (ost_load_in_volume(load->kind))
        return load->region && ost_mesh_find_region(scene->mesh, load->region) < 0
                   ? ost_raise_no_region(scene->c, load->region_place, &scene->mesh->regions, load->region)
                   : OST_SUCCESS;
    OstGlobal nodes;
    int some = 1;
    OST_TRY(count_nodes(scene, &load->on, &nodes));
    if (needs_faces)
        OST_TRY(count_faces(scene, &load->on, &some));
    return some ? OST_SUCCESS
                : OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                            "%s:%d: the load acts on faces, but its selection holds %lld vertices and no whole face of "
                            "the surface; select more, or use point_force or share: vertices",
                            scene->c->path, load->line, (long long)nodes);
}

static OstStatus check_conditions(const OstScene *scene, Findings *findings)
{
    const OstCase *c = scene->c;
    for (int i = 0; i < c->constraint_count; i++) {
        OstGlobal nodes = 0;
        if (c->constraints[i].kind != OST_CONSTRAIN_PERIODIC) /* names boundaries, which the dry run looks for */
            OST_TRY(count_nodes(scene, &c->constraints[i].on, &nodes));
        findings->constrained += nodes;
    }
    for (int i = 0; i < c->load_count; i++)
        OST_TRY(check_load(scene, &c->loads[i]));
    return OST_SUCCESS;
}

/* Values of the word `exact` come from the formula, which only `verify` evaluates. */
static int says_exact(const OstCase *c)
{
    for (int i = 0; i < c->constraint_count; i++)
        for (int k = 0; k < 3; k++)
            if (c->constraints[i].exact[k])
                return 1;
    for (int i = 0; i < c->load_count; i++)
        if (c->loads[i].exact)
            return 1;
    return 0;
}

static int is_unsupported(const OstCase *c)
{
    return c->constraint_count == 0 && c->spring_count == 0 && !c->free_body;
}

/* Assembles and checks the equations without solving them. A body without constraints gets a warning instead. */
static OstStatus dry_run(const OstScene *scene)
{
    const OstCase *c = scene->c;
    return says_exact(c) || is_unsupported(c) ? OST_SUCCESS : ost_scene_dry_run(scene);
}

static void look_for_oddities(const OstScene *scene)
{
    OstContext *ctx = scene->ctx;
    const OstCase *c = scene->c;
    if (is_unsupported(c))
        ost_warn(ctx, "%s: there is no constraint; solve will refuse a body that can move freely", c->path);
    ost_plan_warn_idle(c, &scene->plan, NULL);
    for (int i = 0; i < c->material_count; i++)
        if (c->materials[i].axes.kind != OST_AXES_NONE && !ost_effect_on(&scene->plan.effects, OST_EFFECT_ORTHOTROPY)) {
            ost_warn(ctx, "%s: axes are set, but every material is isotropic, so they have no effect", c->path);
            break;
        }
}

static void check_output(const OstCase *c, const Findings *findings)
{
    const OstStatus status = c->path_steps > 0 ? ost_cli_check_path_outputs(c, findings->output)
                             : c->load_case_count > 0
                                 ? ost_check_case_outputs(c, findings->output)
                                 : ost_check_outputs(c, 1, (const char *const[]){findings->output});
    if (status != OST_SUCCESS)
        ost_warn(c->ctx, "%s: solve will refuse its output from here: %s", c->path, ost_error_text(c->ctx));
}

static const char *plural(OstGlobal count)
{
    return count == 1 ? "" : "s";
}

static void print_findings(const OstScene *scene, const Findings *findings)
{
    const OstCase *c = scene->c;
    const OstMesh *mesh = scene->mesh;
    char springs[32] = "";
    if (c->spring_count > 0)
        snprintf(springs, sizeof springs, "%d spring%s, ", c->spring_count, plural(c->spring_count));
    printf("%s is fine: %lld vertices, %lld tet%s, %d region%s, %d constraint%s on %lld %s, %s%d load%s%s\n", c->path,
           (long long)mesh->global_nodes, (long long)mesh->global_tets, plural(mesh->global_tets), mesh->regions.count,
           plural(mesh->regions.count), c->constraint_count, plural(c->constraint_count),
           (long long)findings->constrained, findings->constrained == 1 ? "vertex" : "vertices", springs, c->load_count,
           plural(c->load_count), ost_warning_count(scene->ctx) > 0 ? "; see the warnings" : "");
    if (c->load_case_count > 0 && ost_load_cases_in_one_file(c, findings->output)) {
        printf("solve will write the fields of %d load case%s to %s, a step for each\n", c->load_case_count,
               plural(c->load_case_count), findings->output);
    } else if (c->load_case_count > 0) {
        char list[OST_LONGEST_PATH];
        ost_path_file_name(findings->output, OST_PATH_SERIES, sizeof list, list);
        printf("solve will write the fields of %d load case%s beside %s, listed in %s\n", c->load_case_count,
               plural(c->load_case_count), findings->output, list);
    } else if (c->path_steps > 0)
        printf("solve will write the fields of %d step%s beside %s, the first to %s\n", c->path_steps,
               plural(c->path_steps), findings->output, findings->first_step);
    else
        printf("solve will write its fields to %s\n", findings->output);
}

static OstStatus write_json(const OstScene *scene, const Findings *findings, const char *path)
{
    const OstMesh *mesh = scene->mesh;
    json_t *regions = json_array();
    json_t *boundaries = json_array();
    for (int r = 0; r < mesh->regions.count; r++)
        json_array_append_new(regions, json_string(mesh->regions.name[r]));
    for (int b = 0; b < mesh->boundary_count; b++)
        json_array_append_new(boundaries, json_string(mesh->boundaries[b].name));
    json_t *root = json_pack(
        "{s:s, s:I, s:I, s:o, s:o, s:i, s:I, s:i, s:i, s:i, s:s, s:o}", "case", scene->c->path, "vertices",
        (json_int_t)mesh->global_nodes, "tets", (json_int_t)mesh->global_tets, "regions", regions, "boundaries",
        boundaries, "constraints", scene->c->constraint_count, "constrained_vertices",
        (json_int_t)findings->constrained, "springs", scene->c->spring_count, "loads", scene->c->load_count,
        "load_cases", scene->c->load_case_count, "output", findings->output, "warnings", ost_json_warnings(scene->ctx));
    if (!root)
        return OST_RAISE(scene->ctx, OST_LIBRARY_FAILED,
                         "%s: what was found cannot be written as JSON (are its names UTF-8?)", scene->c->path);
    return ost_json_write(scene->ctx, root, path);
}

/* What is solved: the case, or one of its load cases. */
static OstStatus check_scene(const OstScene *scene, Findings *findings)
{
    OST_TRY(check_conditions(scene, findings));
    OST_TRY(dry_run(scene));
    OST_TRY(ost_watch_check(scene));
    look_for_oddities(scene);
    return OST_SUCCESS;
}

/* The failure may come of what this load case alone has. */
static OstStatus name_load_case(OstContext *ctx, OstStatus status, const char *name)
{
    char reason[OST_ERROR_TEXT_SIZE];
    snprintf(reason, sizeof reason, "%s", ost_error_text(ctx));
    return OST_RAISE(ctx, status, "load case '%s': %s", name, reason);
}

static OstStatus check_load_cases(const OstScene *scene, Findings *findings)
{
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < scene->c->load_case_count && status == OST_SUCCESS; k++) {
        OstScene *of_case = NULL;
        status = ost_scene_load_case(scene, k, &of_case);
        OST_THEN(check_scene(of_case, findings));
        if (status != OST_SUCCESS)
            status = name_load_case(scene->ctx, status, scene->c->load_cases[k].name);
        ost_scene_destroy(&of_case);
    }
    return status;
}

static OstStatus check_case(OstContext *ctx, void *input)
{
    const OstArguments *arguments = input;
    Findings findings = {0};
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstStatus status = OST_SUCCESS;
    const char *json = ost_cli_json(arguments);
    OST_TRY_DONE(ost_cli_read(ctx, arguments, &c));
    OST_TRY_DONE(ost_check_outputs(c, 1, &json));
    OST_TRY_DONE(ost_choose_output(c, NULL, findings.output));
    ost_path_step_name(findings.output, 1, sizeof findings.first_step, findings.first_step);
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(c->load_case_count > 0 ? check_load_cases(scene, &findings) : check_scene(scene, &findings));
    check_output(c, &findings);
    if (ost_rank(ctx) == 0 && json)
        status = write_json(scene, &findings, json);
    else if (ost_rank(ctx) == 0 && ost_log_level(ctx) != OST_LOG_QUIET)
        print_findings(scene, &findings);
    status = ost_agree(ctx, status);
done:
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_check(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run_on_case(ctx, &check_argp, argc, argv, &arguments, check_case);
}
