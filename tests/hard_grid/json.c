/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/json_file.h"
#include "hard_grid/grid.h"

#include <math.h>

static json_t *reading_json(const HardReading *reading)
{
    const HardPoint *point = &reading->point;
    char column[64], poisson[32], name[160];
    hard_describe_column(hard_column(point), column, sizeof column);
    hard_describe_poisson(point->poisson, poisson, sizeof poisson);
    hard_describe(point, name, sizeof name);
    json_t *json = json_pack("{s:s, s:s, s:i, s:s, s:i, s:s, s:i, s:b, s:s, s:s, s:o}", "point", name, "shape",
                             hard_shape_name(point->shape), "order", point->order, "poisson", poisson, "row",
                             point->poisson, "stiffness_and_axes", column, "column", hard_column(point), "flawed",
                             point->flaw != HARD_SOUND, "outcome", hard_outcome_name[reading->outcome], "status",
                             ost_status_name(reading->status), "reason", ost_json_text(reading->reason));
    if (!json || reading->unknowns == 0)
        return json;
    json_t *numbers =
        json_pack("{s:I, s:s, s:i, s:i, s:o, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, "
                  "s:o, s:o, s:f}",
                  "unknowns", (json_int_t)reading->unknowns, "method", ost_method_name(reading->method), "iterations",
                  reading->iterations, "strategies", reading->steps, "relative_residual",
                  ost_json_number(reading->residual), "rounding_limited", reading->rounding_limited, "stated_error",
                  ost_json_number(reading->stated_error), "stated_forces", ost_json_number(reading->stated_forces),
                  "pressure_error", ost_json_number(reading->truth.pressure), "displacement_error",
                  ost_json_number(reading->truth.off.displacement), "reaction_error",
                  ost_json_number(reading->truth.off.reaction), "stress_error",
                  ost_json_number(reading->truth.off.stress), "digits", ost_json_number(reading->digits), "size",
                  ost_json_number(reading->truth.size), "amplification", ost_json_number(reading->truth.amplification),
                  "floor", ost_json_number(reading->truth.floor), "plain_factors_error",
                  ost_json_number(reading->truth.plain), "moved_by_rounding", ost_json_number(reading->truth.rounded),
                  "indefinite", reading->truth.indefinite, "tet_residual", ost_json_number(reading->tet_residual),
                  "tet_residual_in_64_bits", ost_json_number(reading->truth.residual), "seconds", reading->seconds);
    json_object_update(json, numbers);
    json_decref(numbers);
    return json;
}

OstStatus hard_write_json(const HardReport *report, const char *path)
{
    if (ost_rank(report->ctx) != 0)
        return OST_SUCCESS;
    json_t *points = json_array();
    for (int i = 0; i < report->count; i++)
        json_array_append_new(points, reading_json(&report->reading[i]));
    json_t *document = json_pack("{s:b, s:b, s:I, s:i, s:f, s:o}", "passed", hard_passed(report), "quick",
                                 report->run.quick, "size", (json_int_t)report->run.size, "ranks",
                                 ost_size(report->ctx), "seconds", report->seconds, "points", points);
    if (!document)
        return OST_RAISE(report->ctx, OST_OUT_OF_MEMORY, "the report could not be put into JSON");
    return ost_json_write(report->ctx, document, path);
}
