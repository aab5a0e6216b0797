/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_MARK_TIES_H
#define ORTHOSTAT_ADAPT_MARK_TIES_H

#include "assembly/links/links.h"

/* Collective. Tets whose vertices follow faces of another part are cut, beyond the `times` that ost_mark has found,
 * until they are about as fine as those faces will be: vertices of finer faces would pass through the side that
 * follows. `links` may be NULL. */
OstStatus ost_mark_ties(const OstMesh *mesh, const OstLinks *links, unsigned char *times);

#endif
