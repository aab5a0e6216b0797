/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_YAML_PLACE_H
#define ORTHOSTAT_CASE_YAML_PLACE_H

/* Line and column of a word in the case file, from 1, for messages; zeros if there is none. */
typedef struct OstPlace {
    int line, column;
} OstPlace;

#endif
