/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_IDENTITY_H
#define ORTHOSTAT_PROBLEM_IDENTITY_H

#include "problem/problem.h"

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

/* What tells a problem from others, as a file can keep it; the same on all ranks. */
typedef struct OstProblemIdentity {
    uint64_t text;   /* hash of the case's text; 0 without a case */
    uint64_t mesh;   /* of the tets' labels, nodes and regions, the regions' materials, and the time tables */
    uint64_t bits;   /* of all numbers as this partition has them: the same bits follow only if these are the same */
    double accuracy; /* with which linear theory is judged */
    double mark[OST_MARKS], size[OST_MARKS]; /* the sums, and those of the terms' sizes */
    int32_t ranks, formulation, automatic, unused;
} OstProblemIdentity;

enum { OST_LONGEST_DIFFERENCE = 160 };

/* Collective. */
OstStatus ost_problem_identify(const OstProblem *problem, OstProblemIdentity *identity);

/* Local. What differs, in words ("loads have changed since"); 0 if nothing does but, perhaps, the number of ranks. */
int ost_problem_differs(const OstProblemIdentity *found, const OstProblemIdentity *expected,
                        char text[OST_LONGEST_DIFFERENCE]);

#endif
