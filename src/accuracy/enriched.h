/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_ENRICHED_H
#define ORTHOSTAT_ACCURACY_ENRICHED_H

/* A vector of the elements' space and its complement: 3 numbers for each row of the system, and OST_PER_FUNCTION in
 * single precision for each function (accuracy/complement/complement.h). */
typedef struct OstEnriched {
    double *rows;
    float *functions;
} OstEnriched;

#endif
