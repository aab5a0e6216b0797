/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_PRESSURE_PRESSURE_SPACE_H
#define ORTHOSTAT_ASSEMBLY_PRESSURE_PRESSURE_SPACE_H

#include "algebra/saddle/coupling.h"
#include "assembly/system.h"

/* The pressures of a mixed form (ost_field_mixed): one at each vertex of the quadratic tets of each region whose C is
 * split, linear in each tet. A vertex where such regions meet has one for each of them, since the pressure jumps there
 * as the material does. A pressure belongs to the rank that owns its vertex, which has all tets around it. */
typedef struct OstPressureSpace {
    OstContext *ctx;
    const OstMesh *mesh;
    OstLocal owned, count; /* without and with ghosts */
    OstGlobal global;
    OstLocal *first;  /* node_count + 1: the first pressure of each node */
    int most;         /* at a node, of all ranks */
    OstLocal *of_tet; /* tet_count × 4: the pressure at each of a tet's vertices; -1: none */
    int32_t *region;  /* count */
    OstHalo *halo;
} OstPressureSpace;

/* Collective. OST_EFFECT_MIXED, as all below. */
OstStatus ost_pressure_space_create(const OstMesh *mesh, const OstMaterialField *field, OstPressureSpace **space);
void ost_pressure_space_destroy(OstPressureSpace **space);

/* Collective. The coupling of the pressures with the unknowns of a system on the same mesh, along the directions that
 * are not constrained. It uses the space's halo. */
OstStatus ost_pressure_coupling(const OstPressureSpace *space, const OstSystem *system, const OstMaterialField *field,
                                OstCoupling **coupling);

/* Local; collective where nodes follow others. Brings a coupling made by the above to a displacement u (3 × node_count,
 * large rotations: the derivative of the volume below), or back to that of linear theory (NULL). */
OstStatus ost_pressure_coupling_at(const OstPressureSpace *space, const OstSystem *system,
                                   const OstMaterialField *field, const double *u, OstCoupling *coupling);

/* Local. For each owned pressure the integral of its share of m'(strain of u - share × e0) - looseness p, tet by tet
 * without the coupling, with p the field's pressure; the strain is U - I where rotations are large. u is 3 ×
 * node_count, `volume` has `owned` numbers, and so has `mass` (or NULL): the integral of the share alone. */
OstStatus ost_pressure_volume(const OstPressureSpace *space, const OstMaterialField *field, OstFormulation formulation,
                              double share, const double *u, double *volume, double *mass);

/* Collective over neighbours. Sets the ghosts of `pressure`, which has `count` numbers. */
OstStatus ost_pressure_complete(const OstPressureSpace *space, double *pressure);

/* Local. Gives each tet the pressures of its vertices (OstMaterialField.pressure), from `count` numbers. */
void ost_pressure_of_tets(const OstPressureSpace *space, const double *pressure, double *of_tets);

#endif
