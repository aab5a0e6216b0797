/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "cli/destination.h"
#include "cli/installed.h"
#include "cli/mesh_report.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/parallel/reduce.h"
#include "formats/export/export.h"
#include "formats/serial/chunk_tidy.h"
#include "formats/serial/formats.h"
#include "mesh/distribution/share.h"
#include "orthostat/refine.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const struct argp_option options[] = {
    {"refine", 'r', "TIMES", 0, "Split each tet into eight, so often", 0},
    {"element-order", 'e', "1|2", 0, "Make the tets linear (4 nodes) or quadratic (10 nodes)", 0},
    {"merge", 'm', "DISTANCE", 0, "Join vertices no farther apart than this", 0},
    {"orient", 'o', 0, 0, "Turn every tet that is inside out", 0},
    {"straighten", 's', 0, 0, "Straighten the edges of curved tets that fold over, in place of refusing them", 0},
    {"json", 'j', "FILE", 0, "Write what was found as JSON", 0},
    {"picture", 'p', "FILE", 0, "Draw the mesh here (.png)", 0},
    {0}};

enum { MOST_REFINEMENTS = 8 };

typedef struct Request {
    const char *in, *out;
    const char *text['z' + 1];
    long refine, order;
    double merge;
} Request;

static error_t parse(int key, char *value, struct argp_state *state)
{
    Request *request = state->input;
    char *end = NULL;
    if (key == ARGP_KEY_ARG && state->arg_num < 2) {
        *(state->arg_num == 0 ? &request->in : &request->out) = value;
        return 0;
    }
    if (key == ARGP_KEY_ARG || (key == ARGP_KEY_END && !request->in)) {
        argp_error(state,
                   key == ARGP_KEY_END ? "which mesh? Give the path of its file"
                                       : "one mesh to read, and one to write at most: '%s' is too many",
                   value);
        return EINVAL;
    }
    if (key <= 0 || key > 'z')
        return ARGP_ERR_UNKNOWN;
    request->text[key] = value ? value : "";
    if (key == 'r')
        request->refine = strtol(value, &end, 10);
    else if (key == 'e')
        request->order = strtol(value, &end, 10);
    else if (key == 'm')
        request->merge = strtod(value, &end);
    if ((end && (*end || end == value)) || request->refine < 0 || request->refine > MOST_REFINEMENTS ||
        (request->text['e'] && request->order != 1 && request->order != 2) ||
        (request->text['m'] && !(request->merge > 0.0 && request->merge < 1e300))) {
        argp_error(state, "'%s' for -%c: expected %s", value, key,
                   key == 'r'   ? "0 to 8 refinements"
                   : key == 'e' ? "1 or 2"
                                : "a distance above 0");
        return EINVAL;
    }
    return 0;
}

static const struct argp mesh_argp = {
    .options = options,
    .parser = parse,
    .args_doc = "MESH [NEW]",
    .doc = "Read a mesh, say what is in it, and write it in the format of the new file's ending: .msh (Gmsh), .inp "
           "(Abaqus), .vtu (VTK) or .vtkhdf.",
};

/* What is done to the chunk, while tets are as the file has them. */
static OstStatus prepare(const Request *request, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    OstGlobal merged = 0;
    OstLocal turned = 0;
    if (request->text['o']) {
        OST_TRY(ost_agree(ctx, ost_tets_orient(chunk, request->in, &turned)));
        ost_log(ctx, OST_LOG_NORMAL, "turned tets: %d", turned);
    }
    if (request->merge > 0.0) {
        OST_TRY(ost_chunk_merge(chunk, request->merge, &merged));
        ost_log(ctx, OST_LOG_NORMAL, "joined vertices: %lld", (long long)merged);
    }
    chunk->straighten = request->text['s'] != NULL;
    chunk->only_vertices = request->order == 1 && request->refine == 0;
    return OST_SUCCESS;
}

static void replace(OstMesh **mesh, OstMesh **made)
{
    ost_mesh_destroy(mesh);
    *mesh = *made;
    *made = NULL;
}

/* In the order in which a case does the same. */
static OstStatus change(const Request *request, OstMesh **mesh)
{
    OstMesh *made = NULL;
    for (int r = 0; r < request->refine; r++) {
        OST_TRY(ost_mesh_refine(*mesh, NULL, &made));
        replace(mesh, &made);
    }
    if (request->order == 0 || (request->order == 2) == ((*mesh)->nodes_per_tet == 10))
        return OST_SUCCESS;
    OST_TRY(request->order == 2 ? ost_mesh_raise(*mesh, NULL, &made) : ost_mesh_linear(*mesh, &made, NULL));
    replace(mesh, &made);
    return OST_SUCCESS;
}

static OstStatus report(const Request *request, const OstMesh *mesh)
{
    OstContext *ctx = mesh->ctx;
    OstMeshReport counts;
    OstStatus status = ost_mesh_report_make(mesh, &counts);
    const char *json = request->text['j'];
    if (status == OST_SUCCESS && ost_rank(ctx) == 0) {
        if (ost_log_level(ctx) != OST_LOG_QUIET && !(json && strcmp(json, "-") == 0))
            ost_mesh_report_print(mesh, &counts, request->in);
        if (json)
            status = ost_mesh_report_json(mesh, &counts, request->in, json);
    }
    ost_mesh_report_clear(&counts);
    return ost_agree(ctx, status);
}

/* --- the picture --- */

static json_t *numbers_json(size_t count, const OstGlobal *numbers)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, json_integer(numbers[i]));
    return list;
}

/* What scripts/plot-mesh draws: places of the vertices, vertices and region of the tets. */
static OstStatus write_drawing(const void *study, const char *path)
{
    const OstMeshChunk *whole = study;
    json_t *points = json_array(), *tets = json_array(), *regions = json_array(), *names = json_array();
    for (size_t i = 0; i < 3 * (size_t)whole->node_count; i++)
        json_array_append_new(points, json_real(whole->coordinates[i]));
    for (size_t t = 0; t < (size_t)whole->tet_count; t++) {
        json_array_append_new(tets, numbers_json(4, whole->tet_nodes + t * (size_t)whole->nodes_per_tet));
        json_array_append_new(regions, json_integer(whole->tet_region[t]));
    }
    for (int r = 0; r < whole->regions.count; r++)
        json_array_append_new(names, ost_json_text(whole->regions.name[r]));
    json_t *root =
        json_pack("{s:o, s:o, s:o, s:o}", "points", points, "tets", tets, "region", regions, "regions", names);
    return root
               ? ost_json_write(whole->ctx, root, path)
               : OST_RAISE(whole->ctx, OST_LIBRARY_FAILED, "the mesh cannot be written as JSON (are its names UTF-8?)");
}

static OstStatus draw(const OstMesh *mesh, const char *picture)
{
    OstMeshChunk *whole = NULL;
    OST_TRY(ost_mesh_gather(mesh, &whole));
    const OstStatus status = ost_cli_draw(mesh->ctx, "plot-mesh", write_drawing, whole, picture);
    ost_chunk_destroy(&whole);
    return ost_agree(mesh->ctx, status);
}

/* What is read is never written over: a run that is ended half way would leave neither. */
static OstStatus check_files(OstContext *ctx, const Request *request)
{
    const char *const made[] = {request->out, request->text['j'], request->text['p']};
    for (int i = 0; i < 3; i++) {
        int is_input = ost_rank(ctx) == 0 && ost_cli_is_same_file(made[i], request->in);
        OST_TRY(ost_max_ints(ctx, 1, &is_input));
        if (is_input)
            return OST_RAISE(ctx, OST_INVALID_USAGE,
                             "'%s' would be written over the mesh that is read; name another file", made[i]);
    }
    return OST_SUCCESS;
}

static OstStatus work(OstContext *ctx, void *input)
{
    const Request *request = input;
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY(check_files(ctx, request));
    if (request->out)
        OST_TRY(ost_mesh_export_check(ctx, request->out));
    OST_TRY(ost_cli_check_picture(ctx, request->text['p']));
    OST_TRY_DONE(ost_chunk_read(ctx, request->in, &chunk));
    OST_TRY_DONE(prepare(request, chunk));
    OST_TRY_DONE(ost_mesh_distribute(ctx, &chunk, &mesh));
    OST_TRY_DONE(change(request, &mesh));
    OST_TRY_DONE(report(request, mesh));
    if (request->text['p'])
        OST_TRY_DONE(draw(mesh, request->text['p']));
    if (request->out) {
        OST_TRY_DONE(ost_mesh_export(mesh, request->out));
        ost_log(ctx, OST_LOG_NORMAL, "wrote %s", request->out);
    }
done:
    ost_chunk_destroy(&chunk);
    ost_mesh_destroy(&mesh);
    return status;
}

int ost_cli_mesh(OstContext *ctx, int argc, char **argv)
{
    Request request = {0};
    return ost_cli_run(ctx, &mesh_argp, argc, argv, &request, work);
}
