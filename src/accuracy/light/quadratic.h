/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_QUADRATIC_H
#define ORTHOSTAT_ACCURACY_LIGHT_QUADRATIC_H

#include "accuracy/light/light_data.h"

/* Local. The parts of accuracy/light/light_tets.h that differ where tets are quadratic: forces of tets->u and of the
 * functions' values are added to tets->force and of_functions; and twice the strain energy of each owned tet. */
void ost_quadratic_eights_apply(OstLightTets *tets, const float *functions, float *of_functions);
void ost_quadratic_eights_energy(const OstLightTets *tets, const float *functions, double *energy);

#endif
