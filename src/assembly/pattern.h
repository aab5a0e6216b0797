/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_PATTERN_H
#define ORTHOSTAT_ASSEMBLY_PATTERN_H

#include "assembly/system.h"

/* Local. With the rows numbered, makes the matrix's row_start, column, diagonal and (zero) values, and the system's
 * block_of_tet. Raises OST_LIMIT_EXCEEDED once the blocks are counted, before they are made. */
OstStatus ost_pattern_create(OstSystem *system);

#endif
