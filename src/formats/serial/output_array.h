/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_OUTPUT_ARRAY_H
#define ORTHOSTAT_FORMATS_SERIAL_OUTPUT_ARRAY_H

#include "fields/output_field.h"
#include "mesh/mesh_data.h"

/* One array of a file of fields. `values` start at local node 0 (all local nodes) or at owned tet 0 (owned tets). */
typedef struct OstOutputArray {
    const char *name;
    OstCentring centring;
    OstValueType type;
    int components;
    const void *values;
} OstOutputArray;

/* Marks the fields of a file as no answer. */
typedef struct OstOutputMark {
    const char *status; /* one word */
    int unfinished;
    int reason_count;
    char *const *reasons;
} OstOutputMark;

/* Local. Bytes of a row. */
size_t ost_output_row_bytes(const OstOutputArray *array);

/* Local. Is there an array of this name? */
int ost_output_has_array(int count, const OstOutputArray *arrays, OstCentring centring, const char *name);

/* Local. Refuses arrays that cannot be named so, and numbers that are not finite. */
OstStatus ost_output_check_arrays(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays);

/* The form of a file of fields, by its name's ending. One that ends with .hdf is a VTKHDF file too, but of one result:
 * ParaView 5.11, which knows the ending, knows no steps. */
typedef enum { OST_RESULT_VTKHDF, OST_RESULT_HDF, OST_RESULT_VTU, OST_RESULT_PVTU, OST_RESULT_FORMS } OstResultForm;

/* The endings, for messages. */
#define OST_RESULT_ENDINGS ".vtkhdf, .hdf, .vtu or .pvtu"

/* Local. OST_RESULT_FORMS for a name with another ending. `stem` gets the length of the name without its ending. */
OstResultForm ost_result_form(const char *path, size_t *stem);

#endif
