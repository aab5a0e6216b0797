/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_H
#define ORTHOSTAT_GUARD_FREEDOM_H

#include "assembly/supports.h"

/* Collective, before anything is assembled. Finds the components of the body (tets joined through faces), and what
 * rigid motions supports and the hinges between components leave them. Raises OST_INVALID_INPUT with each of these
 * motions in words if there are any, and for doubled tets. Warns of motions that are held only just, and of vertices
 * that coincide where the body has several components. `where` begins the messages (the case file). `free_body`: the
 * supports are those of a floating body, which changes the advice. */
OstStatus ost_freedom_check(const OstMesh *mesh, const OstSupports *supports, const char *where, int free_body);

#endif
