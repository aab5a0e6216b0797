/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_RUN_H
#define ORTHOSTAT_TESTS_RUN_H

#include "../case/case_text.h"
#include "orthostat/orthostat.h"

/* A case with its scene and answer. */
typedef struct Run {
    OstCase *c;
    OstScene *scene;
    OstResult *result;
} Run;

static inline void clear(Run *run)
{
    ost_result_destroy(&run->result);
    ost_scene_destroy(&run->scene);
    ost_case_destroy(&run->c);
}

#endif
