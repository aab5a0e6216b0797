/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_READ_H
#define ORTHOSTAT_CASE_YAML_READ_H

#include "case/yaml/message.h"

/* Typed reading of a YAML tree. Every function is local, follows aliases, and raises OST_INVALID_INPUT as
 * "path:line:column: what was found, what was expected". */

/* A key that a mapping may have, optional unless `needed`. ost_yaml_mapping fills `value`; NULL if the key is absent.
 */
typedef struct OstYamlKey {
    const char *name;
    int needed;
    const OstYamlNode *value;
    OstStatus (*read)(const OstYaml *yaml, const OstYamlNode *node, double *into); /* or NULL: the caller reads it */
    double *into;
} OstYamlKey;

#define OST_COUNT_OF(array) ((int)(sizeof(array) / sizeof *(array)))

OstPlace ost_yaml_at(const OstYamlNode *node);

/* Fills the keys' values; refuses unknown, repeated and missing keys, and keys without a value. Then reads those with a
 * `read`, in their order. */
OstStatus ost_yaml_mapping(const OstYaml *yaml, const OstYamlNode *node, OstYamlKey *keys, int count);

/* Does a mapping have this key? */
int ost_yaml_has(const OstYaml *yaml, const OstYamlNode *node, const char *name);

/* Which one of the first `count` keys has a value; refuses none, and more than one. */
OstStatus ost_yaml_one_of(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, int count, int *which);

/* A sequence's length (at most OST_YAML_MOST_ENTRIES for a short list). Its items: first = ost_yaml_first(node), then
 * ost_yaml_next. */
enum { OST_YAML_MOST_ENTRIES = 10000 };
OstStatus ost_yaml_list(const OstYaml *yaml, const OstYamlNode *node, const char *expected, int *count);
OstStatus ost_yaml_short_list(const OstYaml *yaml, const OstYamlNode *node, const char *expected, int *count);

/* Scalars. A number is finite, at most 1e75 in size, with nothing after it; an integer lies in [low, high]. The text
 * lives as long as the tree. */
int ost_yaml_says(const OstYaml *yaml, const OstYamlNode *node, const char *word);
OstStatus ost_yaml_text(const OstYaml *yaml, const OstYamlNode *node, const char **text);
OstStatus ost_yaml_number(const OstYaml *yaml, const OstYamlNode *node, double *number);
OstStatus ost_yaml_positive(const OstYaml *yaml, const OstYamlNode *node, double *number);
OstStatus ost_yaml_integer(const OstYaml *yaml, const OstYamlNode *node, int64_t low, int64_t high, int64_t *number);
OstStatus ost_yaml_numbers(const OstYaml *yaml, const OstYamlNode *node, int count, double *numbers);
OstStatus ost_yaml_positives(const OstYaml *yaml, const OstYamlNode *node, int count, double *numbers);

/* Three numbers; a direction's are not all zero, and scaled to length 1. */
OstStatus ost_yaml_vector(const OstYaml *yaml, const OstYamlNode *node, double vector[3]);
OstStatus ost_yaml_direction(const OstYaml *yaml, const OstYamlNode *node, double direction[3]);

/* One of some words; `what` names their kind ("field"). */
OstStatus ost_yaml_word(const OstYaml *yaml, const OstYamlNode *node, const char *what, const char *const *words,
                        int count, int *which);

#endif
