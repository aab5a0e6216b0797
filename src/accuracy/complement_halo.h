/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_COMPLEMENT_HALO_H
#define ORTHOSTAT_ACCURACY_COMPLEMENT_HALO_H

#include "accuracy/complement.h"

/* Local. The face whose two lowest vertices are the ends of an edge, by its third; -1 if there is none. */
OstLocal ost_complement_find_face(const OstComplement *complement, OstLocal edge, OstLocal high);

/* Collective. Makes the halos of edges and faces. */
OstStatus ost_complement_connect(OstComplement *complement);

#endif
