/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_H
#define ORTHOSTAT_GUARD_FREEDOM_H

#include "assembly/supports.h"

/* Collective, before anything is assembled. Finds the connected components of the body (tets joined through faces) and
 * the rigid motions that supports, and hinges between components, leave them. Raises OST_INVALID_INPUT that describes
 * these motions if there are any, and for tets that occur twice. Warns of motions that are weakly constrained, and of
 * vertices that coincide where the body has several components. Messages begin with `where` (the case file).
 * `free_body`: the supports are those of a floating body, which changes the advice. */
OstStatus ost_freedom_check(const OstMesh *mesh, const OstSupports *supports, const char *where, int free_body);

#endif
