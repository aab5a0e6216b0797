/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_EARLIER_H
#define ORTHOSTAT_ACCURACY_EARLIER_H

#include "accuracy/enriched.h"
#include "orthostat/context.h"

enum { OST_MOST_EARLIER = 8 };

/* Solutions of A x = b for earlier b, as vectors that are orthonormal in the energy x'A x, with A times each; in single
 * precision, as they only start the next solve: what is a multiple or a sum of earlier ones is then found at once. */
typedef struct OstEarlier {
    OstContext *ctx;
    size_t rows, functions; /* numbers of a vector's parts on this rank */
    int count;
    float *x[OST_MOST_EARLIER], *ax[OST_MOST_EARLIER]; /* rows, then functions */
    double share[OST_MOST_EARLIER];                    /* of each in the start */
    double square;                                     /* the start's energy */
    OstEnriched left;                                  /* the residual after the start */
} OstEarlier;

/* Local. None yet. */
OstStatus ost_earlier_create(OstContext *ctx, size_t rows, size_t functions, OstEarlier **earlier);
void ost_earlier_destroy(OstEarlier **earlier);

/* Collective. Takes off the residual r what the best combination of the solutions (in the energy of its error) solves;
 * *square is its energy. */
OstStatus ost_earlier_start(OstEarlier *earlier, const OstEnriched *r, double *square);

/* Collective. x solves what the start left, up to the residual r: keeps it, if there is room and much new in it, and
 * adds the start to x. */
OstStatus ost_earlier_finish(OstEarlier *earlier, const OstEnriched *r, const OstEnriched *x);

#endif
