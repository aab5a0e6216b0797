/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_LIGHT_TETS_H
#define ORTHOSTAT_ACCURACY_LIGHT_LIGHT_TETS_H

#include "accuracy/complement/complement.h"
#include "problem/problem.h"

/* The stiffness of tets with their functions, by linear theory, in single precision: gradients and C of each tet, or
 * where it is about the line of its axes, are kept, eight side by side. The steps of an estimate take most of their
 * time here, and need two digits. */
typedef struct OstLightTets OstLightTets;

/* Local. A modulus of this field's size: the same on all ranks. */
double ost_light_tets_modulus(const OstMaterialField *field);

/* Local. The stiffness is taken over `unit` (OstOperator). *tets is NULL where single precision is too little: where
 * moduli of one material differ by far; and where C varies within quadratic tets otherwise than about one line. */
OstStatus ost_light_tets_create(const OstProblem *problem, const OstComplement *complement, double unit,
                                OstLightTets **tets);
void ost_light_tets_destroy(OstLightTets **tets);

/* Local. Forces of a displacement u of the nodes (3 numbers each; NULL: at rest), and w of the functions, ghosts
 * included; those on ghosts are not complete. */
void ost_light_tets_apply(OstLightTets *tets, const double *u, const float *w, double *force, float *of_functions);

/* Local. Twice the strain energy of each owned tet. */
void ost_light_tets_energy(OstLightTets *tets, const double *u, const float *w, double *energy);

/* Local. The functions' own blocks as accuracy/complement/blocks.h. */
void ost_light_tets_blocks(const OstLightTets *tets, float *factor);

#endif
