/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H
#define ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H

#include "formats/serial/formats.h"
#include "formats/serial/output_array.h"
#include "mesh/mesh_data.h"

/* Collective. Writes a VTKHDF 1.0 UnstructuredGrid in parallel, one piece per rank (its owned tets and their nodes).
 * The file gets its name only when complete (core/write_aside.h); after a failure an earlier file is still there.
 * `mark` is NULL for an answer; else it becomes an attribute Status of /VTKHDF, the reasons in /Orthostat/Objections,
 * and field data arrays `refused` and, if so, `unfinished` (1), which VTK's reader passes on. Labels, region names and
 * boundaries are written too, so that the file can be read back as a mesh. All values must be finite. */
OstStatus ost_vtkhdf_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                           const OstOutputArray *arrays, const OstOutputMark *mark);

/* Collective. The mesh of a VTKHDF file of tets (types 10 and 24 only), each rank reading its share; nodes that pieces
 * share are merged by their labels or, in a file of another program without labels, by bitwise equal coordinates. */
OstStatus ost_vtkhdf_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);

/* Collective. Adds a field on the cells, or on the points, to the chunk that ost_vtkhdf_read made of the file. */
OstStatus ost_vtkhdf_read_field(OstContext *ctx, const char *path, const char *field, OstFieldUse use,
                                OstMeshChunk *chunk);

#endif
