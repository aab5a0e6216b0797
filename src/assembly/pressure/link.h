/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_PRESSURE_LINK_H
#define ORTHOSTAT_ASSEMBLY_PRESSURE_LINK_H

#include "assembly/links/row_parts.h"
#include "assembly/pressure/pressure_space.h"

/* Collective. From B over local nodes to B T over the columns of the matrix, T' K T (assembly/links/row_parts.h). A
 * rank then has as ghosts the pressures of other ranks that act on its rows, through whatever follows them: a numbering
 * and a halo of the coupling's own, in which the pressures it owns come first too. */
OstStatus ost_coupling_link(const OstPressureSpace *space, const OstSystem *system, const OstRowNumbers *rows,
                            OstCoupling *coupling);

#endif
