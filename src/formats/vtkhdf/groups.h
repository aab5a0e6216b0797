/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_GROUPS_H
#define ORTHOSTAT_FORMATS_VTKHDF_GROUPS_H

#include "formats/vtkhdf/hdf5.h"
#include "mesh/mesh_data.h"

/* Names of regions and boundaries, in a group of the file that VTK ignores:
 *   /Orthostat/RegionNames      strings; the cell array "region" counts them from 0
 *   /Orthostat/BoundaryNames    strings
 *   /Orthostat/BoundaryKinds    of each: dimension, nodes per item
 *   /Orthostat/BoundaryItems    of each item: number of its boundary, labels of its nodes, -1 up to the row's end */

/* Collective. */
OstStatus ost_groups_write(OstHdf5 *h5, const OstMesh *mesh);

/* Local. Region names into the chunk: those of the file, or one region "volume" if it has no such group. */
OstStatus ost_groups_read_regions(const OstHdf5 *h5, OstMeshChunk *chunk);

/* Collective. Boundaries into the chunk, each rank a share of the items; the chunk must have its nodes. */
OstStatus ost_groups_read_boundaries(const OstHdf5 *h5, OstMeshChunk *chunk);

/* Local. Reads all of them for a dry run, as ost_hdf5_try_rows does. */
OstStatus ost_groups_try(const OstHdf5 *h5);

#endif
