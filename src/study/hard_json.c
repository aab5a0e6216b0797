/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/json_file.h"
#include "study/hard.h"

#include <math.h>
#include <stdio.h>

/* Numbers that JSON cannot write are null. */
static json_t *number_json(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

static json_t *reading_json(const OstHardReading *reading)
{
    const OstHardPoint *point = &reading->point;
    char column[64], poisson[32], name[160];
    ost_hard_describe_column(ost_hard_column(point), column, sizeof column);
    ost_hard_describe_poisson(point->poisson, poisson, sizeof poisson);
    ost_hard_describe(point, name, sizeof name);
    json_t *json = json_pack("{s:s, s:s, s:i, s:s, s:i, s:s, s:i, s:b, s:s, s:s, s:s}", "point", name, "shape",
                             ost_hard_shape_name(point->shape), "order", point->order, "poisson", poisson, "row",
                             point->poisson, "stiffness_and_axes", column, "column", ost_hard_column(point), "flawed",
                             point->flaw != OST_HARD_SOUND, "outcome", ost_hard_outcome_name[reading->outcome],
                             "status", ost_status_name(reading->status), "reason", reading->reason);
    if (!json || reading->unknowns == 0)
        return json;
    json_t *numbers = json_pack(
        "{s:I, s:s, s:i, s:i, s:o, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:f}", "unknowns",
        (json_int_t)reading->unknowns, "recipe", ost_recipe_name(reading->recipe), "iterations", reading->iterations,
        "rungs", reading->steps, "relative_residual", number_json(reading->residual), "rounding_limited",
        reading->rounding_limited, "stated_error", number_json(reading->stated_error), "digits",
        number_json(reading->digits), "size", number_json(reading->truth.size), "amplification",
        number_json(reading->truth.amplification), "floor", number_json(reading->truth.floor), "plain_factors_error",
        number_json(reading->truth.plain), "moved_by_rounding", number_json(reading->truth.rounded), "indefinite",
        reading->truth.indefinite, "seconds", reading->seconds);
    json_object_update(json, numbers);
    json_decref(numbers);
    return json;
}

OstStatus ost_hard_write_json(const OstHardReport *report, const char *path)
{
    if (ost_rank(report->ctx) != 0)
        return OST_SUCCESS;
    json_t *points = json_array();
    for (int i = 0; i < report->count; i++)
        json_array_append_new(points, reading_json(&report->reading[i]));
    json_t *document = json_pack("{s:b, s:b, s:i, s:f, s:o}", "passed", ost_hard_passed(report), "quick", report->quick,
                                 "ranks", ost_size(report->ctx), "seconds", report->seconds, "points", points);
    if (!document)
        return OST_RAISE(report->ctx, OST_OUT_OF_MEMORY, "the report could not be put into JSON");
    return ost_json_write(report->ctx, document, path);
}
