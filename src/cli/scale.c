/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/study_report.h"

#include "core/error.h"
#include "core/parallel/free_memory.h"
#include "study/scale/scale.h"

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

static error_t read_ranks(struct argp_state *state, const char *text, OstScaleVariants *v)
{
    double number[OST_SCALE_MOST_VALUES];
    const error_t failed = ost_cli_list(state, "ranks", text, OST_SCALE_MOST_VALUES, &v->rank_count, NULL, number);
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
    switch (key) {
    case RANKS:
        return read_ranks(state, value, v);
    case SIZES:
        return ost_cli_list(state, "sizes", value, OST_SCALE_MOST_VALUES, &v->size_count, NULL, v->size);
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
        return ost_cli_max_time(state, value, &v->max_seconds);
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

static OstStatus tell(const void *study, OstStudyForm form, const char *path)
{
    if (form == OST_AS_CSV)
        return ost_scale_write_csv(study, path);
    if (form == OST_AS_JSON)
        return ost_scale_write_json(study, path);
    ost_scale_print(study);
    return OST_SUCCESS;
}

static OstStatus read_again(OstContext *ctx, const void *from, OstCase **c)
{
    return ost_cli_read_one(ctx, from, c);
}

static OstStatus run_study(OstContext *ctx, void *input)
{
    Arguments *arguments = input;
    OstCase *c = NULL;
    OstScale *scale = NULL;
    OstStatus status = OST_SUCCESS;
    const char *path = arguments->common.case_path;
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdin") == 0)
        return OST_RAISE(ctx, OST_INVALID_USAGE,
                         "the case is read anew for each number of ranks: name a file, not standard input");
    OST_TRY_DONE(ost_memory_installed(ctx, &arguments->variants.max_bytes));
    OST_TRY_DONE(ost_cli_read_one(ctx, &arguments->common, &c));
    OST_TRY_DONE(ost_cli_check_reports(c, &arguments->common));
    OST_TRY_DONE(ost_scale_create(c, read_again, &arguments->common, &arguments->variants, &scale));
    ost_case_destroy(&c);
    OST_TRY_DONE(ost_scale_run(scale));
    status = ost_cli_report(ctx, &arguments->common, tell, scale, "plot-scale");
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
