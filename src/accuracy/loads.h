/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LOADS_H
#define ORTHOSTAT_ACCURACY_LOADS_H

#include "accuracy/complement/complement.h"
#include "problem/problem.h"

/* The loads of a scene on the functions of the complement. */
typedef struct OstSurplusLoads {
    int count;             /* functions of time (problem/problem.h) */
    double **force;        /* of each, 3 numbers for each function of the complement: complete on owned ones */
    struct OstFoundation { /* elastic foundations, whose force depends on the displacement */
        OstLocal count;    /* of faces */
        int nodes_per_face;
        OstLocal *faces;
        double along, across, direction[3];
        struct OstFoundation *next;
    } * foundation;
} OstSurplusLoads;

/* Collective. Loads on vertices have no part on the functions, which vanish there. Clear it also after a failure. */
OstStatus ost_surplus_loads_create(const OstProblem *problem, const OstComplement *complement, OstSurplusLoads *loads);
void ost_surplus_loads_clear(OstSurplusLoads *loads);

/* Local. What elastic foundations add to the functions' own blocks (OstComplement.bed), over `divisor`; *bed stays as
 * it is where there are none. */
OstStatus ost_surplus_loads_bed(const OstSurplusLoads *loads, const OstComplement *complement, double divisor,
                                double **bed);

/* Local. Adds the loads at t and u to `force` (3 numbers for each function): dead ones, pressures that follow the
 * surface, and those of elastic foundations. */
void ost_surplus_loads_add(const OstSurplusLoads *loads, const OstProblem *problem, const OstComplement *complement,
                           double t, const double *u, double *force);

#endif
