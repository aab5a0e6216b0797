/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/adapt.h"

#include "core/error.h"
#include "core/json_file.h"

#include <stdio.h>

static const char *const end_name[] = {
    [OST_ADAPT_MET] = "met",
    [OST_ADAPT_OUT_OF_TIME] = "out of time",
    [OST_ADAPT_OUT_OF_MEMORY] = "out of memory",
    [OST_ADAPT_OUT_OF_LEVELS] = "out of levels",
    [OST_ADAPT_NO_ESTIMATE] = "no estimate",
    [OST_ADAPT_FAILED] = "failed",
    [OST_ADAPT_OUT_OF_REACH] = "out of reach",
};

static void describe_end(const OstAdaption *adaption, char *text, size_t size)
{
    switch (adaption->end) {
    case OST_ADAPT_OUT_OF_TIME:
        snprintf(text, size, "the next mesh would not be solved within %.3g s (--max-time)", adaption->limits.seconds);
        break;
    case OST_ADAPT_OUT_OF_MEMORY:
        snprintf(text, size, "the next mesh would not fit into %.3g GiB (--max-memory)",
                 adaption->limits.bytes / 0x1p30);
        break;
    case OST_ADAPT_OUT_OF_LEVELS:
        snprintf(text, size, "%d levels are the most", OST_MOST_ADAPT_LEVELS);
        break;
    case OST_ADAPT_NO_ESTIMATE:
        snprintf(text, size, "the error of this problem cannot be estimated");
        break;
    case OST_ADAPT_FAILED:
        snprintf(text, size, "the next level failed: %.300s", adaption->failure);
        break;
    case OST_ADAPT_OUT_OF_REACH:
        if (adaption->left > 0.0) {
            snprintf(text, size,
                     "with 8 times the unknowns the error is %.2g times what it was, as where a force acts on a point "
                     "and the "
                     "energy has no limit: spread it over faces (total_force, traction), ask for the error of what is "
                     "watched elsewhere (of: NAME), or set --max-time to refine as far as it goes",
                     adaption->left);
            break;
        }
        snprintf(text, size,
                 "it is out of reach of %.3g GiB, which allow about %.2g %% in about %.2g s: ask for that, or set "
                 "--max-time to refine as far as it goes",
                 adaption->limits.bytes / 0x1p30, 100.0 * adaption->reach, adaption->reach_seconds);
        break;
    case OST_ADAPT_MET:
        text[0] = '\0';
        break;
    }
}

void ost_adaption_words(const OstAdaption *adaption, char words[OST_LONGEST_ADAPT_WORDS])
{
    const OstAdaptLevel *answer = &adaption->level[adaption->answer];
    char why[360], share[24];
    describe_end(adaption, why, sizeof why);
    int length = snprintf(words, OST_LONGEST_ADAPT_WORDS, "the error asked for, %.3g %%, is not met: %s",
                          100.0 * adaption->request, why);
    if (adaption->end == OST_ADAPT_NO_ESTIMATE || length < 0 || length >= OST_LONGEST_ADAPT_WORDS)
        return;
    snprintf(words + length, (size_t)(OST_LONGEST_ADAPT_WORDS - length),
             ". The answer is about %s off%s; as the error fell, with unknowns^-%.2f, meeting it takes about %.2g "
             "unknowns, %.2g s and %.2g GiB more",
             ost_percent(answer->relative_error, share, sizeof share),
             answer->relative_error <= adaption->request ? ", but that is to be well within what is asked for, as "
                                                           "estimates near edges are up to a quarter low"
                                                         : "",
             adaption->rate, adaption->needed_unknowns, adaption->needed_seconds, adaption->needed_bytes / 0x1p30);
}

void ost_adaption_print(const OstAdaption *adaption)
{
    char words[OST_LONGEST_ADAPT_WORDS], share[24];
    if (ost_rank(adaption->ctx) != 0 || adaption->count == 0)
        return;
    const OstAdaptLevel *last = &adaption->level[adaption->count - 1];
    printf("  levels           order       tets   unknowns  iterations  error estimated  seconds\n");
    for (int l = 0; l < adaption->count; l++) {
        const OstAdaptLevel *level = &adaption->level[l];
        printf("                   %5d %10lld %10lld %11d", level->order, (long long)level->tets,
               (long long)level->unknowns, level->iterations);
        if (level->error.known)
            printf(" %16s", ost_percent(level->relative_error, share, sizeof share));
        else
            printf(" %16s", "not known");
        printf(" %8.3f\n", level->seconds);
    }
    ost_adaption_words(adaption, words);
    if (adaption->end == OST_ADAPT_MET)
        printf("  request          %.3g %% asked for, about %.2g %% reached, of %s%s\n", 100.0 * adaption->request,
               100.0 * last->relative_error,
               adaption->watch && !last->by_norm ? adaption->watch->name : "the energy norm",
               ost_adaption_leaves_out_ties(adaption) ? "; what tied faces get wrong comes on top" : "");
    else
        printf("  WARNING          %s\n", words);
}

static json_t *needed_json(double needed)
{
    return needed > 0.0 ? ost_json_number(needed) : json_null();
}

json_t *ost_adaption_json(const OstAdaption *adaption)
{
    json_t *levels = json_array();
    for (int l = 0; l < adaption->count; l++) {
        const OstAdaptLevel *level = &adaption->level[l];
        json_array_append_new(
            levels,
            json_pack("{s:i, s:I, s:I, s:i, s:o, s:o, s:o, s:o, s:f, s:f}", "order", level->order, "tets",
                      (json_int_t)level->tets, "unknowns", (json_int_t)level->unknowns, "iterations", level->iterations,
                      "relative_error", level->error.known ? ost_json_number(level->relative_error) : json_null(),
                      "energy_norm_error", level->error.known ? ost_json_number(level->error.energy_norm) : json_null(),
                      "missed", level->is_measured ? ost_json_number(level->missed) : json_null(), "strain_energy",
                      ost_json_number(level->strain_energy), "seconds", level->seconds, "bytes", level->bytes));
    }
    return json_pack("{s:f, s:s, s:s, s:b, s:i, s:o, s:o, s:o, s:o, s:o}", "asked", adaption->request, "of",
                     adaption->watch ? adaption->watch->name : "energy", "end", end_name[adaption->end], "met",
                     adaption->end == OST_ADAPT_MET, "answer_level", adaption->answer + 1, "levels", levels, "rate",
                     needed_json(adaption->rate), "needed_unknowns", needed_json(adaption->needed_unknowns),
                     "needed_seconds", needed_json(adaption->needed_seconds), "needed_bytes",
                     needed_json(adaption->needed_bytes));
}
