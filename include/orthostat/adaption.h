/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPTION_H
#define ORTHOSTAT_ADAPTION_H

#include "orthostat/scene.h"

OST_API_BEGIN

/* A case solved to the accuracy that it asks for: solve, estimate the error, refine the tets that have it, carry the
 * answer to the new mesh, and solve from there, until the estimate is met or a limit is reached. */

typedef struct OstAdaptLimits {
    double seconds; /* of the whole; INFINITY: none */
    double bytes;   /* of all ranks' processes; INFINITY: none */
} OstAdaptLimits;

typedef struct OstAdaptLevel {
    int order;
    OstGlobal tets, unknowns;
    OstAnswerError error;       /* estimated */
    double value, off;          /* of the quantity asked about: its value, and by how much the exact one is larger */
    double shares;              /* sum of the tets' shares of that */
    double relative_error;      /* of what the case asks about: that quantity, or the norm of the energy */
    double most_relative_error; /* of that quantity, by what its value with its error added has changed by since the
                                   level before; INFINITY: not known */
    int by_norm;     /* the norm's in place of that quantity's: whether linear theory does is open on this mesh */
    int is_measured; /* 1: the last two potentials tell how much the estimate missed */
    double missed;   /* what it was multiplied by, 1 or more */
    double strain_energy, potential; /* potential: that less the work of the loads */
    double volume;
    int iterations;
    double seconds; /* from the refinement to the estimate */
    double bytes;   /* peak so far, of Orthostat's arrays */
} OstAdaptLevel;

typedef enum {
    OST_ADAPT_MET,
    OST_ADAPT_OUT_OF_TIME,
    OST_ADAPT_OUT_OF_MEMORY,
    OST_ADAPT_OUT_OF_LEVELS,
    OST_ADAPT_NO_ESTIMATE, /* nothing is known of the error of this problem */
    OST_ADAPT_FAILED,      /* a finer mesh could not be made or solved */
    OST_ADAPT_OUT_OF_REACH /* no limit of time, and 100 times the memory would not do: ended when 2 % off, or after a
                              minute; or the error hardly falls */
} OstAdaptEnd;

typedef struct OstAdaption OstAdaption;

/* Collective. Solves the case; `c` outlives the adaption. Returns OST_SUCCESS where there is an answer, whether it
 * meets the request or not (`end`). On failure of the first level, the adaption has what there is of it. The caller
 * destroys it in any case. */
OstStatus ost_adapt(const OstCase *c, const OstAdaptLimits *limits, OstAdaption **adaption);
void ost_adaption_destroy(OstAdaption **adaption);

/* Local. The finest level's, which live as long as the adaption; NULL if there is none. */
OstScene *ost_adaption_scene(const OstAdaption *adaption);
OstResult *ost_adaption_result(const OstAdaption *adaption);

/* Local. How it ended, and the levels, from the first to the finest; level 0 is the case's own mesh. */
OstAdaptEnd ost_adaption_end(const OstAdaption *adaption);
int ost_adaption_level_count(const OstAdaption *adaption);
const OstAdaptLevel *ost_adaption_level(const OstAdaption *adaption, int number);

/* Local. How it ended where the request is not met, and what meeting it would take, in words. */
enum { OST_LONGEST_ADAPT_WORDS = 800 };
void ost_adaption_words(const OstAdaption *adaption, char words[OST_LONGEST_ADAPT_WORDS]);

OST_API_END

#endif
