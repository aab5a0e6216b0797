/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_SYSTEMS_H
#define ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_SYSTEMS_H

#include "formats/msh/cursor.h"

/* Coordinate systems of Nastran's cards CORD2R, CORD2C and CORD2S (rectangular, cylindrical, spherical), each given by
 * three points in another one: origin, a point on axis 3, and one in the plane of axes 1 and 3. Start from {0}. */
typedef struct OstNastranSystem {
    OstGlobal label, base; /* base 0 is the basic system */
    char kind;             /* R, C or S */
    int found;
    double points[9]; /* in the base */
    double origin[3], axes[9];
} OstNastranSystem;

typedef struct OstNastranSystems {
    int count;
    OstNastranSystem *system;
} OstNastranSystems;

/* Local. The caller fills in what is added, and frees `system` at last. */
OstStatus ost_nastran_system_add(OstMshCursor *cursor, OstNastranSystems *systems, OstNastranSystem **added);

/* Local, once all systems are there. Turns coordinates in the system of that label into basic ones. */
OstStatus ost_nastran_to_basic(OstMshCursor *cursor, OstNastranSystems *systems, OstGlobal label, double x[3]);

#endif
