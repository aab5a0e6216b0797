/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_MESSAGE_H
#define ORTHOSTAT_CASE_YAML_MESSAGE_H

#include "case/yaml_tree.h"

enum { OST_YAML_PLACE_SIZE = 128, OST_YAML_LIST_SIZE = 512 };

/* Local. Where a node is, as a person would say it: "the case", "materials[0].axes"; written to `text`, which is
 * returned. Walks the tree from its root, so it is for messages alone. */
const char *ost_yaml_place(const OstYaml *yaml, const OstYamlNode *node, char *text, size_t size);

/* Local. "a, b, c" */
void ost_yaml_name_list(const char *const *names, int count, char *text, size_t size);

/* Local. Raises "path:line:column: PLACE: found THIS, expected EXPECTED MORE". */
OstStatus ost_yaml_raise_type(const OstYaml *yaml, const OstYamlNode *node, const char *expected, const char *more);

#endif
