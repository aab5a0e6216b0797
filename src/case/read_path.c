/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

static OstStatus read_times(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of ascending pseudo-times, as in [0.2, 0.5, 1]", &count));
    if (count < 1)
        return ost_yaml_raise(yaml, node, "found no pseudo-time, expected at least one, as in [0.2, 0.5, 1]");
    OST_TRY(OST_NEW(yaml->ctx, &c->path_times, count));
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        OST_TRY(ost_yaml_number(yaml, item, &c->path_times[i]));
        if (c->path_times[i] < 0.0)
            return ost_yaml_raise(yaml, item, "a path begins at t = 0; found the earlier time %g", c->path_times[i]);
        if (i > 0 && c->path_times[i] <= c->path_times[i - 1])
            return ost_yaml_raise(yaml, item, "times of a path ascend; found %g after %g", c->path_times[i],
                                  c->path_times[i - 1]);
    }
    c->path_steps = count;
    return OST_SUCCESS;
}

static OstStatus read_steps(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int64_t steps;
    OST_TRY(ost_yaml_integer(yaml, node, 1, OST_YAML_MOST_ENTRIES, &steps));
    OST_TRY(OST_NEW(yaml->ctx, &c->path_times, steps));
    c->path_steps = (int)steps;
    for (int i = 0; i < c->path_steps; i++)
        c->path_times[i] = (double)(i + 1) / (double)steps;
    return OST_SUCCESS;
}

OstStatus ost_read_load_path(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { STEPS, TIMES, FORMS };
    OstYamlKey keys[FORMS] = {[STEPS] = {.name = "steps"}, [TIMES] = {.name = "times"}};
    int form;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, FORMS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, FORMS, &form));
    return form == STEPS ? read_steps(yaml, keys[form].value, c) : read_times(yaml, keys[form].value, c);
}

static OstStatus read_point(const OstYaml *yaml, const OstYamlNode *node, OstTimeTable *table)
{
    const int i = table->count;
    double point[2];
    OST_TRY(ost_yaml_numbers(yaml, node, 2, point));
    if (i > 0 && point[0] <= table->time[i - 1])
        return ost_yaml_raise(yaml, node, "times of a table ascend; found %g after %g", point[0], table->time[i - 1]);
    table->time[i] = point[0];
    table->factor[i] = point[1];
    table->count++;
    return OST_SUCCESS;
}

static OstStatus read_table(const OstYaml *yaml, const OstYamlNode *node, OstTimeTable *table)
{
    static const char expected[] = "a list of points [t, factor], as in [[0, 0], [0.5, 2], [1, 1]]";
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, expected, &count));
    if (count < 1)
        return ost_yaml_raise_type(yaml, node, expected, "");
    OST_TRY(OST_NEW(yaml->ctx, &table->time, count));
    OST_TRY(OST_NEW(yaml->ctx, &table->factor, count));
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_point(yaml, item, table));
    return OST_SUCCESS;
}

/* The tables of a case differ from each other, so that what follows the same one is added up. */
OstStatus ost_read_time(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, int *number)
{
    OST_TRY(OST_RESIZE(yaml->ctx, &c->tables, c->table_count + 1));
    OstTimeTable *table = &c->tables[c->table_count++];
    *table = (OstTimeTable){0};
    OST_TRY(read_table(yaml, node, table));
    c->first_table_line = c->table_count == 1 ? ost_yaml_line(node) : c->first_table_line;
    *number = 1;
    while (!ost_time_tables_agree(&c->tables[*number - 1], table))
        ++*number;
    if (*number < c->table_count) {
        ost_time_table_release(table);
        c->table_count--;
    }
    return OST_SUCCESS;
}

void ost_time_table_release(OstTimeTable *table)
{
    OST_FREE(table->time, table->factor);
}
