/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_PLACE_H
#define ORTHOSTAT_CASE_YAML_PLACE_H

/* Where a word stands in the case file, from 1, for messages; zeros: nowhere. */
typedef struct OstPlace {
    int line, column;
} OstPlace;

#endif
