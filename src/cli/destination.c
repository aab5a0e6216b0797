/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/destination.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/write_aside.h"
#include "formats/serial/formats.h"
#include "formats/vtu/vtu.h"
#include "output/envelope.h"
#include "output/load_case_files.h"
#include "output/path_files.h"
#include "output/probe_files.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Letters left for the name under which a file is written aside. */
enum { LONGEST_OUTPUT = OST_LONGEST_PATH - 32, MOST_OUTPUTS = 4 };

static const char *name_in_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static OstStatus check_length(OstContext *ctx, const char *path)
{
    if (strlen(path) > LONGEST_OUTPUT)
        return OST_RAISE(ctx, OST_INVALID_USAGE,
                         "the path '%.60s...' has %zu letters, more than the %d possible; name a shorter one", path,
                         strlen(path), LONGEST_OUTPUT);
    const char *name = name_in_folder(path);
    if (strlen(name) > NAME_MAX)
        return OST_RAISE(ctx, OST_INVALID_USAGE, "the file name '%.60s...' has %zu letters, more than the %d possible",
                         name, strlen(name), NAME_MAX);
    return OST_SUCCESS;
}

OstStatus ost_choose_output(const OstCase *c, const char *asked, char path[OST_LONGEST_PATH])
{
    const char *name = asked ? asked : c->output_file ? c->output_file : name_in_folder(c->path);
    OST_TRY(check_length(c->ctx, name));
    if (!asked && !c->output_file) {
        const char *dot = strrchr(name, '.');
        const int stem = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
        snprintf(path, OST_LONGEST_PATH, "%.*s.vtkhdf", stem, name);
        return check_length(c->ctx, path);
    }
    size_t length;
    if (ost_result_form(name, &length) == OST_RESULT_FORMS)
        return OST_RAISE(c->ctx, OST_INVALID_USAGE,
                         "'%s' does not end with " OST_RESULT_ENDINGS ", which the file of fields must", name);
    snprintf(path, OST_LONGEST_PATH, "%s", name);
    return OST_SUCCESS;
}

/* The folder a file lies in; the path is known not to be too long. */
static void folder_of(const char *path, char folder[OST_LONGEST_PATH])
{
    int length = (int)(name_in_folder(path) - path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    snprintf(folder, OST_LONGEST_PATH, "%.*s", length > 0 ? length : 1, length > 0 ? path : ".");
}

int ost_cli_is_same_file(const char *path, const char *other)
{
    struct stat a, b;
    return path && other && stat(path, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* The same file, or the same name in the same folder where there is none yet. */
static int is_same_place(const char *path, const char *other)
{
    char one[OST_LONGEST_PATH], two[OST_LONGEST_PATH];
    folder_of(path, one);
    folder_of(other, two);
    return ost_cli_is_same_file(path, other) ||
           (strcmp(name_in_folder(path), name_in_folder(other)) == 0 && ost_cli_is_same_file(one, two));
}

static int is_list_of(const OstSelection *on, const char *path)
{
    return ost_cli_is_same_file(path, on->vertices_file);
}

/* Names the file that the case reads at this path; NULL if it reads none there. */
static const char *input_at(const OstCase *c, const char *path)
{
    if (ost_cli_is_same_file(path, c->path))
        return "the case itself";
    if (ost_cli_is_same_file(path, c->mesh_file))
        return "the mesh that the case reads";
    if (c->mesh_file && access(path, F_OK) == 0 && ost_mesh_file_reads(c->ctx, c->mesh_file, path))
        return "a file that the mesh includes";
    for (int i = 0; i < c->constraint_count; i++)
        if (is_list_of(&c->constraints[i].on, path))
            return "a list of vertices that the case reads";
    for (int i = 0; i < c->load_count; i++)
        if (is_list_of(&c->loads[i].on, path))
            return "a list of vertices that the case reads";
    for (int i = 0; i < c->watch_count; i++)
        if (is_list_of(&c->watches[i].on, path))
            return "a list of vertices that the case reads";
    for (int i = 0; i < c->material_count; i++)
        if (ost_cli_is_same_file(path, c->materials[i].axes.cells_file))
            return "axes that the case reads";
    return NULL;
}

static OstStatus check_folder(OstContext *ctx, const char *path)
{
    char folder[OST_LONGEST_PATH];
    struct stat there;
    folder_of(path, folder);
    if (stat(folder, &there) != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "'%s' cannot be written: folder '%s': %s", path, folder,
                         strerror(errno));
    if (!S_ISDIR(there.st_mode))
        return OST_RAISE(ctx, OST_FILE_FAILED, "'%s' cannot be written: '%s' is not a folder", path, folder);
    if (access(folder, W_OK | X_OK) != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "'%s' cannot be written: folder '%s' is closed to writing: %s", path,
                         folder, strerror(errno));
    return OST_SUCCESS;
}

static OstStatus check_file(const OstCase *c, const char *path, char **target)
{
    struct stat there;
    OST_TRY(check_length(c->ctx, path));
    if (*name_in_folder(path) == '\0')
        return OST_RAISE(c->ctx, OST_INVALID_USAGE, "'%s' names no file to write", path);
    const char *input = input_at(c, path);
    if (input)
        return OST_RAISE(c->ctx, OST_INVALID_USAGE, "'%s' would be written over %s; name another file", path, input);
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return OST_RAISE(c->ctx, OST_INVALID_USAGE, "'%s' is there already and is not a regular file; name another%s",
                         path, S_ISDIR(there.st_mode) ? ", or one in it" : ", or '-' for a text on standard output");
    OST_TRY(ost_follow_links(c->ctx, path, target));
    OST_TRY(check_length(c->ctx, *target));
    return check_folder(c->ctx, *target);
}

int ost_cli_is_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

/* A .pvtu brings another file. */
static OstStatus check_piece(const OstCase *c, const char *path)
{
    char piece[OST_LONGEST_PATH], *target = NULL;
    size_t stem;
    if (ost_result_form(path, &stem) != OST_RESULT_PVTU)
        return OST_SUCCESS;
    ost_pvtu_piece(path, sizeof piece, piece);
    const OstStatus status = check_file(c, piece, &target);
    OST_FREE(target);
    return status;
}

/* Paths that are NULL are not written. */
static OstStatus check_files(const OstCase *c, int count, const char *const *paths)
{
    char *target[MOST_OUTPUTS] = {NULL}; /* behind links */
    OstStatus status = OST_SUCCESS;
    for (int i = 0; i < count && status == OST_SUCCESS; i++) {
        if (!paths[i])
            continue;
        if (!ost_cli_is_stdout(paths[i]))
            status = check_file(c, paths[i], &target[i]);
        OST_THEN(check_piece(c, paths[i]));
        for (int j = 0; j < i && status == OST_SUCCESS; j++)
            if (ost_cli_is_stdout(paths[i]) ? ost_cli_is_stdout(paths[j])
                                            : target[j] && is_same_place(target[i], target[j]))
                status = OST_RAISE(c->ctx, OST_INVALID_USAGE, "two outputs cannot both go to %s%s%s",
                                   ost_cli_is_stdout(paths[i]) ? "" : "'",
                                   ost_cli_is_stdout(paths[i]) ? "standard output" : paths[i],
                                   ost_cli_is_stdout(paths[i]) ? "" : "'");
    }
    for (int i = 0; i < count; i++)
        OST_FREE(target[i]);
    return status;
}

OstStatus ost_check_outputs(const OstCase *c, int count, const char *const *paths)
{
    return ost_agree(c->ctx, ost_rank(c->ctx) == 0 ? check_files(c, count, paths) : OST_SUCCESS);
}

OstStatus ost_check_probe_outputs(const OstCase *c, const char *fields, const char *json)
{
    char name[OST_LONGEST_PATH];
    for (int p = 0; p < c->probe_count; p++) {
        ost_probe_file_name(fields, &c->probes[p], sizeof name, name);
        OST_TRY(ost_check_outputs(c, 2, (const char *const[]){name, json}));
    }
    return OST_SUCCESS;
}

OstStatus ost_check_case_outputs(const OstCase *c, const char *output)
{
    char path[OST_LONGEST_PATH], table[OST_LONGEST_PATH];
    const int in_one = ost_load_cases_in_one_file(c, output);
    snprintf(path, sizeof path, "%s", output);
    if (!in_one)
        ost_path_file_name(output, OST_PATH_SERIES, sizeof path, path);
    ost_load_case_table_name(output, sizeof table, table);
    OST_TRY(ost_check_outputs(c, 2, (const char *const[]){path, table}));
    ost_envelope_file_name(output, sizeof path, path);
    if (c->envelope)
        OST_TRY(ost_check_outputs(c, 1, (const char *const[]){path}));
    for (int k = 0; k < c->load_case_count; k++) {
        ost_load_case_fields_name(output, c->load_cases[k].name, sizeof path, path);
        if (!in_one)
            OST_TRY(ost_check_outputs(c, 1, (const char *const[]){path}));
        OST_TRY(ost_check_probe_outputs(c, path, NULL));
    }
    return OST_SUCCESS;
}
