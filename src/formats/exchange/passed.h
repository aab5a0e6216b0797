/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_PASSED_H
#define ORTHOSTAT_FORMATS_EXCHANGE_PASSED_H

#include "orthostat/context.h"

/* What a model states beside its mesh that moves or stiffens the body, and that is passed over: which keywords, how
 * often, and what a case says in their place. */
typedef struct OstPassed {
    int count;
    struct OstPassedWord {
        char name[40];
        OstGlobal times;
        const char *way;
    } * word;
    int lines, more; /* lines for the case file; further ones that had no room */
    char text[2048];
} OstPassed;

typedef struct OstPassedWay {
    const char *name, *way; /* `way` may be "": a line says it */
} OstPassedWay;

/* What programs have in common. */
extern const char ost_way_joined[], ost_way_contact[], ost_way_thin[], ost_way_spring[], ost_way_axes[];

/* Local. Counts a keyword if it is one of those. */
OstStatus ost_passed_take(OstContext *ctx, const OstPassedWay *ways, size_t count, const char *name, OstPassed *passed);

/* Local. Adds a line for the case file. */
void ost_passed_line(OstPassed *passed, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Local. Adds the line of a boundary that moves with a point, or in the mean with it, at `at`. `directions`: the digits
 * of those that the model couples, "" for all; where one of 1, 2 and 3 is missing the line says that it holds more. */
void ost_passed_point(OstPassed *passed, const char *boundary, const char *at, int in_the_mean, const char *directions);

/* Local. A name as YAML has it: in quotes where it needs them. */
enum { OST_YAML_NAME = 300 };
const char *ost_yaml_name(const char *name, char text[OST_YAML_NAME]);

/* Local. One warning about all of it, if there is any; frees it. */
void ost_passed_warn(OstContext *ctx, const char *path, OstPassed *passed);

#endif
