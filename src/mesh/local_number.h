/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_LOCAL_NUMBER_H
#define ORTHOSTAT_MESH_LOCAL_NUMBER_H

#include "mesh/mesh_data.h"

/* Local. The mesh's local number of a node by its global number, or -1 if it is not on this rank. */
OstLocal ost_mesh_local(const OstMesh *mesh, OstGlobal number);

#endif
