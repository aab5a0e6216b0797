/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H
#define ORTHOSTAT_FORMATS_VTKHDF_VTKHDF_H

#include "formats/serial/formats.h"
#include "mesh/mesh_data.h"

typedef enum { OST_ON_NODES, OST_ON_TETS } OstCentring;
typedef enum { OST_VALUES_DOUBLE, OST_VALUES_INT32 } OstValueType;

/* One array of the file. `values` start at local node 0 (all local nodes) or at owned tet 0 (owned tets). */
typedef struct OstOutputArray {
    const char *name;
    OstCentring centring;
    OstValueType type;
    int components;
    const void *values;
} OstOutputArray;

/* Marks the fields of a file as no answer: an attribute Status of /VTKHDF, the reasons in /Orthostat/Objections, and
 * field data arrays `refused` and, if so, `unfinished` (1), which VTK's reader passes on. */
typedef struct OstOutputMark {
    const char *status; /* one word */
    int unfinished;
    int reason_count;
    char *const *reasons;
} OstOutputMark;

/* Collective. Writes a VTKHDF 1.0 UnstructuredGrid in parallel, one piece per rank (its owned tets and their nodes).
 * The file gets its name only when complete (core/write_aside.h); after a failure an earlier file is still there.
 * `mark` is NULL for an answer. Labels, region names and boundaries are written too, so that the file can be read back
 * as a mesh. All values must be finite. */
OstStatus ost_vtkhdf_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                           const OstOutputArray *arrays, const OstOutputMark *mark);

/* Collective. The mesh of a VTKHDF file of tets (types 10 and 24 only), each rank reading its share; nodes that pieces
 * share are merged by their labels or, in a file of another program without labels, by bitwise equal coordinates. */
OstStatus ost_vtkhdf_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);

/* Collective. Adds a field on the cells to the chunk that ost_vtkhdf_read made of the file. */
OstStatus ost_vtkhdf_read_field(OstContext *ctx, const char *path, const char *field, OstMeshChunk *chunk);

#endif
