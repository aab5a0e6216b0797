/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/scene.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

static error_t parse_argument(int key, char *value, struct argp_state *state)
{
    const char **path = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        if (*path)
            argp_error(state, "one case at a time; '%s' is a second one", value);
        *path = value;
        return 0;
    case ARGP_KEY_END:
        if (!*path)
            argp_error(state, "which case? Name its file");
        return *path ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    NULL,
    parse_argument,
    "CASE",
    "Read a case, make its mesh, materials, axes and selections, and say what is wrong with them. Nothing is solved.",
    NULL,
    NULL,
    NULL};

/* What the checks found beyond errors. */
typedef struct Findings {
    OstGlobal held; /* vertices that constraints select, each constraint counted for itself */
    int warnings;
} Findings;

static OstStatus count_nodes(const OstScene *scene, const OstSelection *selection, OstGlobal *total)
{
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, selection, &count, &nodes));
    OstGlobal mine = 0;
    for (OstLocal i = 0; i < count; i++)
        mine += nodes[i] < scene->mesh->owned_nodes;
    OST_FREE(nodes);
    return OST_MPI(scene->ctx, MPI_Allreduce(&mine, total, 1, MPI_INT64_T, MPI_SUM, ost_comm(scene->ctx)));
}

static OstStatus count_faces(const OstScene *scene, const OstSelection *selection, int *some)
{
    OstLocal count = 0;
    int nodes_per_face = 0;
    OstLocal *faces = NULL;
    OST_TRY(ost_select_faces(scene->c, scene->mesh, selection, &count, &nodes_per_face, &faces));
    const int mine = count > 0;
    OST_FREE(faces);
    return OST_MPI(scene->ctx, MPI_Allreduce(&mine, some, 1, MPI_INT, MPI_MAX, ost_comm(scene->ctx)));
}

static int names_no_region(const OstScene *scene, const char *region)
{
    return region && strcmp(region, "all") != 0 && ost_mesh_find_region(scene->mesh, region) < 0;
}

static OstStatus check_load(const OstScene *scene, const OstLoad *load)
{
    const int needs_faces = load->kind == OST_LOAD_TRACTION || load->kind == OST_LOAD_PRESSURE ||
                            (load->kind == OST_LOAD_TOTAL_FORCE && load->share == OST_SHARE_FACES);
    if (load->kind == OST_LOAD_GRAVITY || load->kind == OST_LOAD_BODY_FORCE) {
        char names[1024];
        ost_names_list(&scene->mesh->regions, names, sizeof names);
        return names_no_region(scene, load->region)
                   ? OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d: the mesh has no region '%s'; it has: %s",
                               scene->c->path, load->line, load->region, names)
                   : OST_SUCCESS;
    }
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
        OST_TRY(count_nodes(scene, &c->constraints[i].on, &nodes));
        findings->held += nodes;
    }
    for (int i = 0; i < c->load_count; i++)
        OST_TRY(check_load(scene, &c->loads[i]));
    return OST_SUCCESS;
}

static void warn(OstContext *ctx, Findings *findings, const char *path, const char *text)
{
    findings->warnings++;
    ost_warn(ctx, "%s: %s", path, text);
}

static void look_for_oddities(const OstScene *scene, Findings *findings)
{
    const OstCase *c = scene->c;
    if (c->constraint_count == 0)
        warn(scene->ctx, findings, c->path, "there is no constraint; solve will refuse a body that nothing holds");
    if (c->load_count == 0 && !scene->plan.effect[OST_PLAN_GIVEN_DISPLACEMENT].on)
        warn(scene->ctx, findings, c->path, "there is no load and no given displacement; nothing will move");
    if (!c->output_file)
        warn(scene->ctx, findings, c->path, "no output file is named; solve needs --output to write one");
    for (int i = 0; i < c->material_count; i++)
        if (c->materials[i].axes.kind != OST_AXES_NONE && !scene->plan.effect[OST_PLAN_ORTHOTROPY].on) {
            warn(scene->ctx, findings, c->path, "axes are given, but every material is isotropic; they do nothing");
            break;
        }
}

static OstStatus check_case(OstContext *ctx, const char *path)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    Findings findings = {0};
    OstStatus status = ost_case_read(ctx, path, &c);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(check_conditions(scene, &findings));
    look_for_oddities(scene, &findings);
    if (ost_rank(ctx) == 0 && ost_log_level(ctx) != OST_LOG_QUIET)
        printf("%s is fine: %lld vertices, %lld tets, %d region%s, %d constraint%s on %lld vertices, %d load%s%s\n",
               path, (long long)scene->mesh->global_nodes, (long long)scene->mesh->global_tets,
               scene->mesh->regions.count, scene->mesh->regions.count == 1 ? "" : "s", c->constraint_count,
               c->constraint_count == 1 ? "" : "s", (long long)findings.held, c->load_count,
               c->load_count == 1 ? "" : "s", findings.warnings > 0 ? "; see the warnings" : "");
done:
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_check(OstContext *ctx, int argc, char **argv)
{
    const char *path = NULL;
    int exit_code;
    if (!ost_cli_parse(ctx, &argp, argc, argv, &path, &exit_code))
        return exit_code;
    return ost_cli_finish(ctx, check_case(ctx, path));
}
