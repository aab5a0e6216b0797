/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/sweep/sweep.h"

#include "cli/destination.h"
#include "cli/study_report.h"
#include "core/error.h"
#include "core/memory.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Arguments {
    OstArguments common;
    int over_count;
    const char *over[OST_MOST_SWEEP_KEYS];
} Arguments;

static const struct argp_option options[] = {
    {"over", 'O', "KEY=VALUES", 0, "Sweep over KEY: a,b,c or from:to:count; once for each key", 0},
    {"csv", 'c', "FILE", 0, "Write the table as CSV here; - for standard output", 0},
    {"json", 'j', "FILE", 0, "Write everything as JSON here; - for standard output", 0},
    {"picture", 'p', "FILE", 0, "Draw the watched quantities here (.png, .svg or .pdf)", 0},
    {0},
};

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    if (key != 'O')
        return ost_cli_take(key, value, state);
    if (arguments->over_count == OST_MOST_SWEEP_KEYS) {
        argp_error(state, "a sweep is over %d keys at most", OST_MOST_SWEEP_KEYS);
        return EINVAL;
    }
    arguments->over[arguments->over_count++] = value;
    return 0;
}

static const struct argp sweep_argp = {
    .options = options,
    .parser = parse_option,
    .args_doc = "CASE",
    .doc = "Solves a case for several values of some of its numbers, each combined with each, and lists the watched "
           "quantities, under each load case if there are any: for the keys of --over, else of the case's section "
           "'sweep'.",
};

/* --- the values of --over --- */

static OstStatus raise_over(OstContext *ctx, const char *over)
{
    return OST_RAISE(ctx, OST_INVALID_USAGE,
                     "--over takes KEY=a,b,c or KEY=from:to:count, as in materials.wood.E1=9e9:13e9:5 or "
                     "loads.0.value=[1,0,0],[0,1,0]; found '%.200s'",
                     over);
}

/* from:to:count */
static int read_range(const char *values, double *from, double *to, int *count)
{
    int used = 0;
    return sscanf(values, "%lf:%lf:%d%n", from, to, count, &used) == 3 && values[used] == 0 && *count >= 2 &&
           *count <= OST_MOST_SWEEP_RUNS;
}

static OstStatus add_value(OstContext *ctx, const char *text, size_t length, OstSweepKey *key)
{
    OST_TRY(OST_RESIZE(ctx, &key->value, key->count + 1));
    key->value[key->count] = NULL;
    OST_TRY(OST_NEW(ctx, &key->value[key->count], length + 1));
    memcpy(key->value[key->count++], text, length);
    return OST_SUCCESS;
}

/* Up to the next comma outside of brackets and quotes, or the end; 0 for none, a colon outside, or open brackets. */
static size_t value_length(const char *text)
{
    int depth = 0;
    char quote = 0;
    size_t length = 0;
    for (; text[length] && (text[length] != ',' || depth > 0 || quote); length++) {
        const char letter = text[length];
        if (quote)
            quote = letter == quote ? 0 : quote;
        else if ((letter == '"' || letter == '\'') && (length == 0 || strchr("[{,: ", text[length - 1])))
            quote = letter;
        else if (letter == ':' && depth == 0)
            return 0;
        else
            depth += (letter == '[' || letter == '{') - (letter == ']' || letter == '}');
    }
    return depth == 0 && !quote ? length : 0;
}

static OstStatus read_over(OstContext *ctx, const char *over, OstSweepKey *key)
{
    const char *values = strchr(over, '=');
    double from, to;
    int count;
    if (!values || values == over || !values[1])
        return raise_over(ctx, over);
    OST_TRY(OST_NEW(ctx, &key->key, values - over + 1));
    memcpy(key->key, over, (size_t)(values - over));
    values++;
    if (read_range(values, &from, &to, &count)) {
        for (int i = 0; i < count; i++) {
            char text[32];
            snprintf(text, sizeof text, "%.12g", from + (to - from) * i / (count - 1));
            OST_TRY(add_value(ctx, text, strlen(text), key));
        }
        return OST_SUCCESS;
    }
    for (int ended = 0; !ended;) {
        const size_t length = value_length(values);
        if (length == 0)
            return raise_over(ctx, over);
        OST_TRY(add_value(ctx, values, length, key));
        ended = values[length] == 0;
        values += length + 1;
    }
    return OST_SUCCESS;
}

static void release_keys(int count, OstSweepKey *keys)
{
    for (int k = 0; k < count; k++) {
        OST_FREE_EACH(keys[k].count, keys[k].value);
        OST_FREE(keys[k].key);
    }
}

/* --- the command --- */

static OstStatus tell(const void *study, OstStudyForm form, const char *path)
{
    if (form == OST_AS_CSV)
        return ost_sweep_write_csv(study, path);
    if (form == OST_AS_JSON)
        return ost_sweep_write_json(study, path);
    ost_sweep_print(study);
    return OST_SUCCESS;
}

static OstStatus report(const OstSweep *sweep, const OstArguments *arguments)
{
    OST_TRY(ost_cli_report(sweep->ctx, arguments, tell, sweep, "plot-sweep"));
    return sweep->failures == 0 ? OST_SUCCESS
                                : OST_RAISE(sweep->ctx, OST_NOT_CONVERGED, "%s: %d of %d runs have no answer",
                                            sweep->path, sweep->failures, sweep->run_count);
}

static OstStatus check(const OstCase *c, const Arguments *arguments)
{
    if (arguments->over_count == 0 && c->sweep_count == 0)
        return OST_RAISE(c->ctx, OST_INVALID_USAGE,
                         "%s: over what? Give --over KEY=a,b,c, or the case a section 'sweep'", c->path);
    if (c->sweep_count > OST_MOST_SWEEP_KEYS && arguments->over_count == 0)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s: a sweep is over %d keys at most", c->path,
                         OST_MOST_SWEEP_KEYS);
    return ost_cli_check_reports(c, &arguments->common);
}

static OstStatus keep(const OstSweep *sweep, const void *kept)
{
    const OstArguments *arguments = kept;
    const char *csv = arguments->text['c'], *json = arguments->text['j'];
    OstStatus status = csv && !ost_cli_is_stdout(csv) ? ost_sweep_write_csv(sweep, csv) : OST_SUCCESS;
    if (json && !ost_cli_is_stdout(json))
        OST_THEN(ost_sweep_write_json(sweep, json));
    return ost_agree(sweep->ctx, status);
}

/* Does the step of a key, up to its end or a dot, name this load case? */
static int is_named(const char *step, const OstCase *c, int number)
{
    const size_t length = strcspn(step, ".");
    char digits[16], *end = NULL;
    snprintf(digits, sizeof digits, "%.*s", (int)length, step);
    const long found = strtol(digits, &end, 10);
    return (end != digits && *end == 0 && found == number) ||
           (strlen(c->load_cases[number].name) == length && strncmp(c->load_cases[number].name, step, length) == 0);
}

/* A key of one load case changes another only if that combines it. */
static void warn_of_other_cases(const OstSweep *sweep, const OstCase *c)
{
    for (int k = 0; k < sweep->key_count && sweep->load_case; k++)
        for (int i = 0; i < c->load_case_count; i++)
            if (strncmp(sweep->key[k].key, "cases.", 6) == 0 && is_named(sweep->key[k].key + 6, c, i) &&
                strcmp(c->load_cases[i].name, sweep->load_case) != 0)
                ost_warn(sweep->ctx,
                         "%s: %s is of the load case '%s', and the sweep takes '%s' alone, which has of it what it "
                         "combines; take that one, or leave out --case",
                         sweep->path, sweep->key[k].key, c->load_cases[i].name, sweep->load_case);
}

/* The case is read once: it may come from standard input. */
static OstStatus sweep_case(OstContext *ctx, void *input)
{
    const Arguments *arguments = input;
    const OstArguments *common = &arguments->common;
    OstSweepKey over[OST_MOST_SWEEP_KEYS] = {{0}};
    OstSweep sweep = {.ctx = ctx,
                      .path = common->case_path,
                      .load_case = common->load_case,
                      .key_count = arguments->over_count,
                      .key = over,
                      .keep = keep,
                      .kept = common};
    OstCase *c = NULL;
    char *bytes = NULL;
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < arguments->over_count && status == OST_SUCCESS; k++)
        status = read_over(ctx, arguments->over[k], &over[k]);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_case_bytes(ctx, common->case_path, &bytes, &sweep.text.size));
    sweep.text.bytes = bytes;
    sweep.text.settings = common->settings;
    sweep.text.setting = common->setting;
    OST_TRY_DONE(ost_case_make(ctx, common->case_path, &sweep.text, &c));
    OST_TRY_DONE(check(c, arguments));
    if (!sweep.load_case) {
        sweep.case_count = c->load_case_count;
        sweep.cases = c->load_cases;
    }
    if (arguments->over_count == 0) {
        sweep.key = c->sweep;
        sweep.key_count = c->sweep_count;
    }
    warn_of_other_cases(&sweep, c);
    OST_TRY_DONE(ost_sweep_run(&sweep));
    status = report(&sweep, common);
done:
    ost_sweep_clear(&sweep);
    ost_case_destroy(&c);
    release_keys(OST_MOST_SWEEP_KEYS, over);
    OST_FREE(bytes);
    return status;
}

int ost_cli_sweep(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {0};
    return ost_cli_run_on_case(ctx, &sweep_argp, argc, argv, &arguments, sweep_case);
}
