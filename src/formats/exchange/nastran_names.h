/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_NAMES_H
#define ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_NAMES_H

#include "orthostat/context.h"

enum { OST_NASTRAN_NO_PROPERTY = -1, OST_NASTRAN_NEXT_PROPERTY = -2 };

/* The name of a property, or of OptiStruct's set, which HyperMesh, ANSA, Femap, Patran and Simcenter write as a
 * comment: Nastran knows numbers alone. */
typedef struct OstNastranName {
    OstGlobal property; /* or that of the next card of a property, or none; start from OST_NASTRAN_NO_PROPERTY */
    OstGlobal set;      /* whose name it is, if not 0 */
    char text[64];      /* "" while ANSA's stands on the next line */
} OstNastranName;

/* Local. Takes a comment, which begins with $. Whatever is no name leaves `name` as it is. */
void ost_nastran_take_comment(OstNastranName *name, const char *line, const char *end);

#endif
