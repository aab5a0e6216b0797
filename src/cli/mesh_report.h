/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_MESH_REPORT_H
#define ORTHOSTAT_CLI_MESH_REPORT_H

#include "mesh/components/component.h"
#include "mesh/mesh_data.h"
#include "mesh/misfit.h"

enum { OST_QUALITY_BINS = 10 };

/* What is counted in a mesh, over all ranks. */
typedef struct OstMeshReport {
    double low[3], high[3];
    double volume, shortest, longest; /* of the tets, of their edges */
    OstCutOff cut_off;
    double least_quality, mean_quality;
    OstGlobal worst_tet; /* its label */
    OstGlobal bins[OST_QUALITY_BINS];
    OstGlobal coincident;
    double tolerance; /* within which they coincide */
    OstMisfits misfits;
    double surface_faces;
    OstGlobal *region_tets; /* of each region */
    double *region_volume;
    OstGlobal *boundary_items; /* of each boundary */
    double *boundary_area;     /* of those of faces */
    OstComponents *components;
} OstMeshReport;

/* Collective. Clear it even after a failure. */
OstStatus ost_mesh_report_make(const OstMesh *mesh, OstMeshReport *counts);
void ost_mesh_report_clear(OstMeshReport *counts);

/* Local. Print them, or write them as JSON to a path ("-": standard output). */
void ost_mesh_report_print(const OstMesh *mesh, const OstMeshReport *counts, const char *path);
OstStatus ost_mesh_report_json(const OstMesh *mesh, const OstMeshReport *counts, const char *path, const char *json);

#endif
