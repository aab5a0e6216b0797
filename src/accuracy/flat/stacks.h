/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_FLAT_STACKS_H
#define ORTHOSTAT_ACCURACY_FLAT_STACKS_H

#include "accuracy/complement/complement.h"
#include "problem/problem.h"

/* Where tets are flat, functions that lie above each other change together for far less energy than each alone: 3×3
 * blocks know nothing of that. A stack holds all functions that lie above each other, and has one block. Vertices that
 * short edges join are one place; the functions on edges and faces between the same places are a stack. */
/* Functions of a stack: more cost more than they gain. */
enum { OST_MOST_OF_STACK = 24 };

typedef struct OstStacks {
    const OstComplement *complement;
    OstLocal count;
    OstLocal *start;    /* count + 1: of a stack in `function` */
    OstLocal *function; /* this rank's, stack by stack */
    OstLocal *stack;    /* of each function; -1: another rank's */
    int *place;         /* of each function in its stack */
    size_t *block;      /* count + 1: where a stack's block begins in `factor` */
    float *factor;      /* N of N'N, the block's inverse: columns of a lower triangle */
} OstStacks;

/* Collective. How flat tets are: a tet's longest edge over its least altitude, over that of the six tets that a cube is
 * cut into; the geometric mean. 0.5 is that of regular tets, 2.4 that of hexes that are four times as long and as wide
 * as thick. */
OstStatus ost_flatness(const OstMesh *mesh, double *flatness);

/* Local. */
OstStatus ost_stacks_create(const OstComplement *complement, OstStacks **stacks);
void ost_stacks_destroy(OstStacks **stacks);

/* Local. The blocks of the stiffness over `unit`, turned with the body by the displacement turned_by, unless that is
 * NULL. Tets are taken as straight, and C as that at the centroid: this only preconditions. */
OstStatus ost_stacks_factor(OstStacks *stacks, const OstProblem *problem, const double *turned_by, double unit);

/* Local. z = N'N r, and r'z; r and z are vectors of the functions, z is 0 at other ranks' functions. */
double ost_stacks_apply(const OstStacks *stacks, const float *r, float *z);

#endif
