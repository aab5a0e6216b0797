/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PROBE_READ_PROBE_H
#define ORTHOSTAT_CASE_PROBE_READ_PROBE_H

#include "case/yaml/read.h"

/* Points at which a case asks for the answer, in one table. */
typedef struct OstProbe {
    char *name; /* letters, digits, - and _: part of a file's name */
    int line;
    OstLocal count;
    double *points; /* count × 3 */
} OstProbe;

enum { OST_MOST_PROBES = 100, OST_MOST_PROBE_POINTS = 100000 };

/* Local. Reads the probes of a case; memory from the context. What is read before a failure counts too. */
OstStatus ost_read_probes(const OstYaml *yaml, const OstYamlNode *node, int *count, OstProbe **probes);
void ost_probes_release(int count, OstProbe **probes);

#endif
