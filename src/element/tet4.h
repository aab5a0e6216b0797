/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_TET4_H
#define ORTHOSTAT_ELEMENT_TET4_H

#include "element/element.h"

/* The linear tet: strain and stress are uniform in it. */
extern const OstElement ost_tet4;

/* Local. Gradients of the four shape functions (3 numbers each); returns the volume, signed. */
double ost_tet4_gradients(const double x[12], double gradients[12]);

/* Local. The stiffness for any symmetric matrix in the place of C (an upper triangle). */
void ost_tet4_blocks(const OstLanes *x, const OstLanes *c, OstLanes *blocks);

#endif
