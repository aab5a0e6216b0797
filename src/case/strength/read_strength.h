/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_STRENGTH_READ_STRENGTH_H
#define ORTHOSTAT_CASE_STRENGTH_READ_STRENGTH_H

#include "case/yaml/read.h"
#include "orthostat/material.h"

/* Local. The strengths of a material; warns where a criterion of them leaves stresses of any size unseen. */
OstStatus ost_read_strength(const OstYaml *yaml, const OstYamlNode *node, OstStrength *strength);

#endif
