/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ITERATIONS_H
#define ORTHOSTAT_TESTS_ITERATIONS_H

#include "../case/case_text.h"
#include "orthostat/analysis.h"
#include "problem/scene_data.h"

/* Iterations of all strategies on the case's block, as `change` leaves it (NULL: as it is). */
static inline int count_iterations(const char *text, int order, void (*change)(OstMeshChunk *chunk, const void *data),
                                   const void *data)
{
    OstCase *c = NULL;
    OstMeshChunk *chunk = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    int iterations = 0;
    assert_success(read_text(text, &c));
    c->order = order;
    assert_success(ost_chunk_create_block(ctx, &c->block, &chunk));
    if (change)
        change(chunk, data);
    assert_success(ost_scene_create_on(c, &chunk, &scene));
    assert_success(ost_scene_solve(scene, &result));
    for (int k = 0; k < result->solve.steps; k++)
        iterations += result->solve.step[k].iterations;
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return iterations;
}

/* The same, printed, and held to at most so many. */
static inline void check_iterations(const char *name, const char *text, int order, int most,
                                    void (*change)(OstMeshChunk *chunk, const void *data), const void *data)
{
    const int found = count_iterations(text, order, change, data);
    if (ost_rank(ctx) == 0)
        print_message("%s, order %d: %d iterations\n", name, order, found);
    if (found > most)
        fail_msg("%s, order %d: %d iterations, expected at most %d", name, order, found, most);
}

#endif
