/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FIELDS_OUTPUT_FIELD_H
#define ORTHOSTAT_FIELDS_OUTPUT_FIELD_H

#include "orthostat/output_field.h"

typedef enum { OST_ON_NODES, OST_ON_TETS } OstCentring;
typedef enum { OST_VALUES_DOUBLE, OST_VALUES_INT32, OST_VALUES_INT64 } OstValueType;

/* What a field is, for the writers of files and for the plan. */
typedef struct OstOutputField {
    const char *word;
    OstCentring centring;
    OstValueType type;
    int components;
    const char *component_names; /* with blanks between them; "" if there is one */
    const char *unit;            /* in words: the units are the user's */
    const char *description;
    unsigned needs;   /* bits of the fields that it is made of, itself among them if it is recovered */
    int is_recovered; /* are its values computed after the solve, and kept? */
    int is_derived;   /* is it made of others, for the file alone? */
} OstOutputField;

/* The fields of strengths. */
enum { OST_LOAD_FACTORS = 1U << OST_FIELD_TSAI_WU | 1U << OST_FIELD_HILL | 1U << OST_FIELD_MAXIMUM_STRESS };

/* Local. What one of OstOutputFieldBit is. */
OstOutputField ost_output_field(OstOutputFieldBit field);

/* Local. The same by its word, the labels `vertex` and `tet` that every file has and those of an envelope of load cases
 * among them. Returns 0 for any other word. */
int ost_output_field_named(const char *word, OstOutputField *field);

/* Those of the body, whatever acts on it: a file of several results has them once. */
enum {
    OST_FIELDS_OF_BODY = 1U << OST_FIELD_AXES | 1U << OST_FIELD_REGION | 1U << OST_FIELD_RANK | 1U << OST_FIELD_E1 |
                         1U << OST_FIELD_E2 | 1U << OST_FIELD_E3
};

/* Local. Is it one of these by its word, or a label? */
int ost_output_field_is_of_body(const char *word);

/* Local. The fields asked for, and all that they are made of. */
unsigned ost_output_fields_needed(unsigned asked);

/* Local. Name `number` (from 0) of a field's components; copies "" where it has no more. */
enum { OST_LONGEST_COMPONENT = 16 };
void ost_output_component(const OstOutputField *field, int number, char name[OST_LONGEST_COMPONENT]);

#endif
