/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTU_VTU_H
#define ORTHOSTAT_FORMATS_VTU_VTU_H

#include "formats/serial/output_array.h"

#include <stdio.h>

/* Collective. Writes a .vtu file of VTK (XML, then the numbers of all arrays as they lie in memory): one piece whatever
 * the number of ranks, in which each vertex and each tet stands once; all ranks write their part of each array. The
 * file gets its name only when complete (core/write_aside.h). Of each field its unit and its components' names are
 * written too; a comment at the head describes the fields and names the regions. `mark` is NULL for an answer; else the
 * comment has its reasons, and field data `refused` and, if so, `unfinished` are 1. All values must be finite. */
OstStatus ost_vtu_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                        const OstOutputArray *arrays, const OstOutputMark *mark);

/* Collective. The same, and a .pvtu file that names the .vtu beside it, which has the same name otherwise. */
OstStatus ost_pvtu_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                         const OstOutputArray *arrays, const OstOutputMark *mark);

/* Local. The .vtu beside a .pvtu, whose name must be that; `size` bytes at `piece`. */
void ost_pvtu_piece(const char *path, size_t size, char *piece);

/* Local. Writes a text as XML's attributes hold it. */
void ost_xml_write(FILE *text, const char *words);

#endif
