/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTU_HEADING_H
#define ORTHOSTAT_FORMATS_VTU_HEADING_H

#include "formats/vtu/vtu.h"

#include <stdio.h>

/* The arrays that describe the tets, in the order in which they follow the fields. */
enum { OST_VTU_POINTS, OST_VTU_CONNECTIVITY, OST_VTU_OFFSETS, OST_VTU_TYPES, OST_VTU_SHAPE_ARRAYS };

/* Local. The XML before the numbers. `offset` has where each array begins after it: those of the fields, then of the
 * shape. Equal on all ranks, which all call it to know its length. */
void ost_vtu_heading(FILE *text, const OstMesh *mesh, int count, const OstOutputArray *arrays,
                     const OstOutputMark *mark, const OstGlobal *offset);

/* Local. A .pvtu of one piece. */
void ost_pvtu_text(FILE *text, const char *piece, int count, const OstOutputArray *arrays);

#endif
