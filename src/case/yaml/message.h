/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_MESSAGE_H
#define ORTHOSTAT_CASE_YAML_MESSAGE_H

#include "case/yaml/tree.h"

enum { OST_YAML_PLACE_SIZE = 128, OST_YAML_LIST_SIZE = 512 };

/* Raises OST_INVALID_INPUT at a node's line and column. */
OstStatus ost_yaml_raise(const OstYaml *yaml, const OstYamlNode *node, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Puts the node's line and column in front of a failure from a deeper call; passes success on. */
OstStatus ost_yaml_located(const OstYaml *yaml, const OstYamlNode *node, OstStatus status);

/* Local. The place of a node in words: "the case", "materials[0].axes"; written to `text`, which is returned. Walks the
 * tree from its root, so it is for messages only. */
const char *ost_yaml_place(const OstYaml *yaml, const OstYamlNode *node, char *text, size_t size);

/* Local. "a, b, c" */
void ost_yaml_name_list(const char *const *names, int count, char *text, size_t size);

/* Local. Raises "path:line:column: PLACE: found THIS, expected EXPECTED MORE". */
OstStatus ost_yaml_raise_type(const OstYaml *yaml, const OstYamlNode *node, const char *expected, const char *more);

/* Local. The word nearest to `word` by edit distance, or one that begins like it; NULL if none is near. */
const char *ost_nearest_word(const char *word, const char *const *words, int count);

#endif
