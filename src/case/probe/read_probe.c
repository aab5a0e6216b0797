/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/probe/read_probe.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static const char example[] = "a name for each table of points, as in knots: {points: [[1, 0, 0], [2, 0, 0]]}";

static OstStatus read_points(const OstYaml *yaml, const OstYamlNode *node, OstProbe *probe)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of points", &count));
    if (count == 0)
        return ost_yaml_raise(yaml, node, "found an empty list, expected points, as in [[1, 0, 0]]");
    OST_TRY(OST_NEW(yaml->ctx, &probe->points, 3 * count));
    probe->count = count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(ost_yaml_vector(yaml, item, probe->points + 3 * (size_t)i));
    return OST_SUCCESS;
}

/* At equal distances, both ends included. */
static OstStatus read_line(const OstYaml *yaml, const OstYamlKey *from, const OstYamlKey *to, const OstYamlKey *number,
                           OstProbe *probe)
{
    int64_t count = 0;
    double start[3], end[3];
    OST_TRY(ost_yaml_vector(yaml, from->value, start));
    OST_TRY(ost_yaml_vector(yaml, to->value, end));
    OST_TRY(ost_yaml_integer(yaml, number->value, 2, OST_MOST_PROBE_POINTS, &count));
    OST_TRY(OST_NEW(yaml->ctx, &probe->points, 3 * count));
    probe->count = (OstLocal)count;
    for (int64_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const double share = (double)i / (double)(count - 1);
            probe->points[3 * i + k] = (1.0 - share) * start[k] + share * end[k];
        }
    return OST_SUCCESS;
}

static OstStatus read_probe(const OstYaml *yaml, const OstYamlNode *node, OstProbe *probe)
{
    enum { POINTS, FROM, TO, COUNT };
    OstYamlKey keys[] = {
        [POINTS] = {.name = "points"}, [FROM] = {.name = "from"}, [TO] = {.name = "to"}, [COUNT] = {.name = "count"}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    const int of_line = (keys[FROM].value != NULL) + (keys[TO].value != NULL) + (keys[COUNT].value != NULL);
    if (keys[POINTS].value && of_line == 0)
        return read_points(yaml, keys[POINTS].value, probe);
    return !keys[POINTS].value && of_line == 3
               ? read_line(yaml, &keys[FROM], &keys[TO], &keys[COUNT], probe)
               : ost_yaml_raise(yaml, node,
                                "expected either points, as in {points: [[1, 0, 0]]}, or a line, as in {from: [0, 0, "
                                "0], to: [1, 0, 0], count: 11}");
}

static OstStatus check_name(const OstYaml *yaml, const OstYamlNode *key, const char *name, int count,
                            const OstProbe *probes)
{
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    const size_t length = strlen(name);
    if (length == 0 || length > 60 || strspn(name, allowed) < length)
        return ost_yaml_raise(yaml, key,
                              "found the name '%.80s'; it becomes part of a file's name: 1 to 60 letters, digits, - "
                              "and _",
                              name);
    for (int p = 0; p < count; p++)
        if (strcmp(probes[p].name, name) == 0)
            return ost_yaml_raise(yaml, key, "'%s' occurs twice, the first time in line %d; keep one", name,
                                  probes[p].line);
    return OST_SUCCESS;
}

OstStatus ost_read_probes(const OstYaml *yaml, const OstYamlNode *node, int *count, OstProbe **probes)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING) || ost_yaml_follow(yaml, node)->value < 1)
        return ost_yaml_raise_type(yaml, node, example, "");
    const int entries = (int)ost_yaml_follow(yaml, node)->value;
    if (entries > OST_MOST_PROBES)
        return ost_yaml_raise(yaml, node, "found %d tables of points, expected at most %d", entries, OST_MOST_PROBES);
    OST_TRY(OST_NEW(yaml->ctx, probes, entries));
    const OstYamlNode *key = ost_yaml_first(yaml, node);
    for (int p = 0; p < entries; p++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        const char *name;
        OST_TRY(ost_yaml_text(yaml, key, &name));
        OST_TRY(check_name(yaml, key, name, p, *probes));
        *count = p + 1;
        (*probes)[p].line = ost_yaml_line(key);
        OST_TRY(ost_copy_string(yaml->ctx, name, &(*probes)[p].name));
        OST_TRY(read_probe(yaml, value, &(*probes)[p]));
        key = ost_yaml_next(yaml, value);
    }
    return OST_SUCCESS;
}

void ost_probes_release(int count, OstProbe **probes)
{
    for (int p = 0; p < count; p++) {
        OST_FREE((*probes)[p].name, (*probes)[p].points);
    }
    OST_FREE(*probes);
}
