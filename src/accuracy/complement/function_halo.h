/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_COMPLEMENT_FUNCTION_HALO_H
#define ORTHOSTAT_ACCURACY_COMPLEMENT_FUNCTION_HALO_H

#include "accuracy/complement/face_table.h"
#include "core/parallel/halo.h"

/* Collective. The halo of the edges; or, unless NULL, of the faces. Owned ones come first in both tables. */
OstStatus ost_function_halo(const OstMesh *mesh, const EdgeTable *edges, const FaceTable *faces, OstHalo **halo);

#endif
