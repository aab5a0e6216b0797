/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_CHECKPOINT_IDENTITY_H
#define ORTHOSTAT_SOLVE_CHECKPOINT_IDENTITY_H

#include "solve/path_data.h"

/* Sums over the whole problem, with a weight for each node or tet by its label: the same but for rounding on any number
 * of ranks. Each with what it tells of. */
#define OST_MARK_TABLE(X)                             \
    X(OST_MARK_PLACES, "the mesh has")                \
    X(OST_MARK_MATERIAL, "axes or eigenstrains have") \
    X(OST_MARK_LOAD, "loads have")                    \
    X(OST_MARK_PRESSURE, "pressures have")            \
    X(OST_MARK_SUPPORT, "constraints have")           \
    X(OST_MARK_SPRING, "springs have")

#define OST_MARK_ENUM(name, text) name,
typedef enum { OST_MARK_TABLE(OST_MARK_ENUM) OST_MARKS } OstMark;
#undef OST_MARK_ENUM

/* What a checkpoint belongs to; the same on all ranks. */
typedef struct OstPathIdentity {
    uint64_t text;     /* hash of the case's text; 0 without a case */
    uint64_t settings; /* of the solver's options */
    uint64_t times;    /* of the path's, and the time tables */
    uint64_t mesh;     /* of the tets' labels, nodes, regions and the regions' materials */
    uint64_t bits;     /* of all numbers as this partition has them: the same bits follow only if these are the same */
    double accuracy;   /* with which linear theory is judged */
    double mark[OST_MARKS], size[OST_MARKS]; /* the sums, and those of the terms' sizes */
    int32_t ranks, formulation, automatic, count;
} OstPathIdentity;

/* Collective. */
OstStatus ost_path_identify(const OstPath *path, OstPathIdentity *identity);

/* Local. Why a checkpoint of `found` cannot serve `expected`, in words; 0 if it can. */
int ost_path_identity_differs(const OstPathIdentity *found, const OstPathIdentity *expected, char why[160]);

#endif
