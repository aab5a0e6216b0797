/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_ENVELOPE_H
#define ORTHOSTAT_OUTPUT_ENVELOPE_H

#include "case/case_data.h"
#include "problem/result_data.h"

#include <stddef.h>

/* The envelope of load cases: at each node and in each tet the extreme over all of them, and the load case that governs
 * there, which has it. One result at a time is looked at. */
typedef struct OstEnvelope OstEnvelope;

/* Collective. Of the load cases of a case, on one mesh; case and mesh outlive it. Load factors are there where a
 * material has strengths. */
OstStatus ost_envelope_create(const OstCase *c, const OstMesh *mesh, OstEnvelope **envelope);
void ost_envelope_destroy(OstEnvelope **envelope);

/* Collective. Looks at the result, with its stress, of a load case (from 0). */
OstStatus ost_envelope_take(OstEnvelope *envelope, int number, const OstResult *result);

/* Local. The name of its file, by that of the case's output file: bridge_envelope.vtkhdf. */
void ost_envelope_file_name(const char *output, size_t size, char *path);

/* Collective. After the last result: finds which case governs how much, and writes the file, if there was a result. */
OstStatus ost_envelope_write(OstEnvelope *envelope, const char *output);

/* Local. What governs, in words; rank 0 prints. */
void ost_envelope_print(const OstEnvelope *envelope);

/* Local. The same as JSON; NULL if there was no result. */
struct json_t *ost_envelope_json(const OstEnvelope *envelope);

#endif
