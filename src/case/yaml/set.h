/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_SET_H
#define ORTHOSTAT_CASE_YAML_SET_H

#include "case/yaml/tree.h"

/* Local. Changes the tree as "KEY=VALUE" says, where VALUE is YAML and KEY a path of keys with dots between them:
 * loads.0.pressure. An entry of a list has its number, from 0, or its `region` or `name`; of three numbers x, y and z
 * are the entries too. A material's E1, nu12 and G12 need not name the key they stand in, and `value` is what a load or
 * constraint states. A key that is not there is added, and so is the next entry of a list; whoever reads the tree knows
 * whether it may be. The new value is at the place of the old one in messages, which name the setting. Raises
 * OST_INVALID_USAGE for a path that leads nowhere, with what there is. */
OstStatus ost_yaml_set(OstYaml *yaml, const char *setting);

#endif
