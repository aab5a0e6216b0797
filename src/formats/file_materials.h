/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_FILE_MATERIALS_H
#define ORTHOSTAT_FORMATS_FILE_MATERIALS_H

#include "formats/serial/formats.h"

/* Collective. Broadcasts rank 0's materials. */
OstStatus ost_file_materials_share(OstContext *ctx, OstFileMaterials **materials);

#endif
