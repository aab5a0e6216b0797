/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"

#include "cli/destination.h"
#include "cli/installed.h"
#include "core/error.h"
#include "core/parallel/free_memory.h"
#include "study/scale/scale.h"

#include <stdlib.h>
#include <string.h>

typedef struct Arguments {
    OstArguments common;
    OstScaleVariants variants;
} Arguments;

enum { RANKS = 256, SIZES, STRONG, NETWORK };

static const struct argp_option options[] = {
    {"ranks", RANKS, "LIST", 0, "Numbers of ranks (default: 1,2,4 and so on, as many as the program has)", 0},
    {"sizes", SIZES, "LIST", 0, "Unknowns, about: the case is refined or coarsened (default: as it is)", 0},
    {"strong-only", STRONG, 0, 0, "No weak scaling, in which the first size grows with the ranks", 0},
    {"max-time", 't', "SECONDS", 0, "Skip runs that would take the total beyond this time (default: 600)", 0},
    {"network", NETWORK, "NAME", 0,
     "Foretell for infiniband (default), ethernet, laptop, or latency=SECONDS,bandwidth=BYTES_A_SECOND,"
     "memory=BYTES_A_SECOND,ranks=OF_A_NODE",
     0},
    {"csv", 'c', "FILE", 0, "Write the list as CSV here; - for standard output", 0},
    {"json", 'j', "FILE", 0, "Write everything as JSON here; - for standard output", 0},
    {"picture", 'p', "FILE", 0, "Draw the scaling here (.png, .svg or .pdf)", 0},
    {0},
};

/* Reads "1,2,4" into numbers. Returns 0, or EINVAL with a message. */
static error_t read_list(struct argp_state *state, const char *name, const char *text, int *count, double *number)
{
    const char *at = text;
    for (*count = 0; *count < OST_SCALE_MOST_VALUES;) {
        char *end = NULL;
        number[*count] = strtod(at, &end);
        if (end == at || (*end != ',' && *end != 0))
            break;
        ++*count;
        if (*end == 0)
            return 0;
        at = end + 1;
    }
    argp_error(state, "--%s takes up to %d numbers with commas between them, found '%s'", name, OST_SCALE_MOST_VALUES,
               text);
    return EINVAL;
}

static error_t read_ranks(struct argp_state *state, const char *text, OstScaleVariants *v)
{
    double number[OST_SCALE_MOST_VALUES];
    const error_t failed = read_list(state, "ranks", text, &v->rank_count, number);
    for (int i = 0; !failed && i < v->rank_count; i++) {
        if (!(number[i] >= 1.0 && number[i] <= 1e6 && number[i] == (double)(int)number[i])) {
            argp_error(state, "--ranks takes whole numbers from 1 on, found '%s'", text);
            return EINVAL;
        }
        v->ranks[i] = (int)number[i];
    }
    return failed;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    OstScaleVariants *v = &arguments->variants;
    char *end = NULL;
    switch (key) {
    case RANKS:
        return read_ranks(state, value, v);
    case SIZES:
        return read_list(state, "sizes", value, &v->size_count, v->size);
    case STRONG:
        v->weak = 0;
        return 0;
    case NETWORK:
        if (ost_network_parse(value, &v->network))
            return 0;
        argp_error(state, "--network takes one of %s, or latency=…,bandwidth=…,memory=…,ranks=…, found '%s'",
                   ost_network_names(), value);
        return EINVAL;
    case 't':
        v->max_seconds = strtod(value, &end);
        if (end != value && *end == 0 && v->max_seconds > 0.0)
            return 0;
        argp_error(state, "--max-time takes a number of seconds above 0, found '%s'", value);
        return EINVAL;
    default:
        return ost_cli_take(key, value, state);
    }
}

static const struct argp scale_argp = {
    options,
    parse_option,
    "CASE",
    "Measures how a case scales: solves it in several sizes on several numbers of ranks, each size on all of them "
    "(strong scaling) and the first one growing with the ranks (weak scaling); lists seconds, iterations, memory, and "
    "what the ranks send on each level of multigrid; and foretells from these counts what 1,000 to 100,000 ranks of a "
    "network would take, and what stops scaling first.",
    NULL,
    NULL,
    NULL};

static OstStatus write_study(const void *scale, const char *path)
{
    return ost_scale_write_json(scale, path);
}

static OstStatus report(const OstScale *scale, const char *csv, const char *json, const char *picture)
{
    OstStatus status = OST_SUCCESS;
    if (ost_log_level(scale->ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(csv) && !ost_cli_is_stdout(json))
        ost_scale_print(scale);
    if (csv)
        status = ost_scale_write_csv(scale, csv);
    if (status == OST_SUCCESS && json)
        status = ost_scale_write_json(scale, json);
    if (status == OST_SUCCESS && picture)
        status = ost_cli_draw(scale->ctx, "plot-scale", write_study, scale, picture);
    return ost_agree(scale->ctx, status);
}

static OstStatus read_again(OstContext *ctx, const void *from, OstCase **c)
{
    return ost_cli_read_one(ctx, from, c);
}

/* Where reports go is checked before anything runs. */
static OstStatus run_study(OstContext *ctx, void *input)
{
    Arguments *arguments = input;
    const char *const *text = arguments->common.text;
    const char *const paths[] = {text['c'], text['j'], text['p']};
    OstCase *c = NULL;
    OstScale *scale = NULL;
    OstStatus status = OST_SUCCESS;
    const char *path = arguments->common.case_path;
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdin") == 0)
        return OST_RAISE(ctx, OST_INVALID_USAGE,
                         "the case is read anew for each number of ranks: name a file, not standard input");
    OST_TRY_DONE(ost_memory_installed(ctx, &arguments->variants.max_bytes));
    OST_TRY_DONE(ost_cli_read_one(ctx, &arguments->common, &c));
    OST_TRY_DONE(ost_check_outputs(c, 3, paths));
    OST_TRY_DONE(ost_cli_check_picture(ctx, text['p']));
    OST_TRY_DONE(ost_scale_create(c, read_again, &arguments->common, &arguments->variants, &scale));
    ost_case_destroy(&c);
    OST_TRY_DONE(ost_scale_run(scale));
    status = report(scale, text['c'], text['j'], text['p']);
done:
    ost_scale_destroy(&scale);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_scale(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {.variants = ost_scale_default_variants(ost_size(ctx))};
    return ost_cli_run_on_case(ctx, &scale_argp, argc, argv, &arguments, run_study);
}
