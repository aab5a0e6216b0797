/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_ADAPT_H
#define ORTHOSTAT_ADAPT_ADAPT_H

#include "adapt/first_mesh.h"
#include "orthostat/adaption.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"

/* Memory of the process, with libraries, over that of Orthostat's own arrays. */
extern const double ost_memory_beside;

enum { OST_MOST_ADAPT_LEVELS = 40 };

struct OstAdaption {
    OstContext *ctx;
    double request;        /* relative error */
    const OstWatch *watch; /* of this quantity; NULL: in the norm of the energy */
    OstAdaptLimits limits;
    double overshoot; /* tets that the last cuts made over those that were expected of the marks */
    int count;
    OstAdaptLevel level[OST_MOST_ADAPT_LEVELS];
    OstAdaptEnd end;
    char failure[OST_ERROR_TEXT_SIZE];                    /* FAILED: why */
    double rate;                                          /* the error falls as unknowns^-rate, by the last levels */
    double needed_unknowns, needed_seconds, needed_bytes; /* to meet the request, by that rate; 0 if met or not known */
    double left;                 /* OUT_OF_REACH: the error over that with 8 times fewer unknowns; 0: the
                                    memory would not do */
    double reach, reach_seconds; /* the error that the memory allows, by that rate */
    OstFirstMesh first;
    struct Stage *stage; /* the last level that was solved; in the end the one that is the answer */
    struct Stage *best;  /* one before it with a smaller error; NULL: there is none */
    int answer;          /* the number of the level that is the answer, or would be if this were the end; from 0 */
};

/* Local. Is it of a quantity of a body with tied faces, whose error the estimate knows in part? */
int ost_adaption_leaves_out_ties(const OstAdaption *adaption);

/* Local; rank 0 prints: a line for each level, and how it ended. */
void ost_adaption_print(const OstAdaption *adaption);

/* Local. The levels as JSON: the caller's reference. */
struct json_t;
struct json_t *ost_adaption_json(const OstAdaption *adaption);

#endif
