/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_TET4_H
#define ORTHOSTAT_ELEMENT_TET4_H

#include "element/element.h"

/* The linear tet: its strain and stress are uniform. */
extern const OstElement ost_tet4;

/* Local. Gradients of the four shape functions (3 numbers each); returns the volume, signed. */
double ost_tet4_gradients(const double x[12], double gradients[12]);

/* Local. The stiffness with a symmetric matrix C (an upper triangle), which need not be definite. */
void ost_tet4_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks);

#endif
