/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H
#define ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H

#include "formats/serial/formats.h"
#include "formats/serial/output_array.h"
#include "mesh/mesh_data.h"
#include "orthostat/steps_file.h"

/* Collective. Writes a VTKHDF 1.0 UnstructuredGrid in parallel, one piece per rank (its owned tets and their nodes).
 * The file gets its name only when complete (core/write_aside.h); after a failure an earlier file is still there.
 * `mark` is NULL for an answer; else it becomes an attribute Status of /VTKHDF, the reasons in /Orthostat/Objections,
 * and field data arrays `refused` and, if so, `unfinished` (1), which VTK's reader passes on. Labels, region names and
 * boundaries are written too, so that the file can be read back as a mesh. All values must be finite. */
OstStatus ost_vtkhdf_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                           const OstOutputArray *arrays, const OstOutputMark *mark);

/* Collective. One step more of a file of steps (orthostat/steps_file.h): VTKHDF 2.0, in which the mesh and the arrays
 * that are of the body stand once, and each other array has the rows of all steps; NaN where a step does not have it.
 * `mark` as above: the flags stand step by step, the reasons begin with the step's name. */
OstStatus ost_vtkhdf_add(OstStepsFile *file, const OstMesh *mesh, double value, const char *name, int array_count,
                         const OstOutputArray *arrays, const OstOutputMark *mark);

/* Local. Is there a step, which has the arrays of the body? */
int ost_vtkhdf_has_step(const OstStepsFile *file);

/* Collective. The mesh of a VTKHDF file of tets (types 10 and 24 only), each rank reading its share; nodes that pieces
 * share are merged by their labels or, in a file of another program without labels, by bitwise equal coordinates. */
OstStatus ost_vtkhdf_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);

/* Collective. Adds a field on the cells, or on the points, to the chunk that ost_vtkhdf_read made of the file. */
OstStatus ost_vtkhdf_read_field(OstContext *ctx, const char *path, const char *field, unsigned use,
                                OstMeshChunk *chunk);

#endif
