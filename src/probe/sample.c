/* SPDX-License-Identifier: BSD-3-Clause */
#include "probe/sample.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "element/element.h"
#include "element/shape_functions.h"
#include "recovery/derived.h"
#include "recovery/recovery.h"

#include <math.h>
#include <string.h>

/* Numbers of a sample that the rank with the tet has, and all get by a sum. */
enum { BETTER = 3 + OST_STRESS_MEASURES, WIDTH = BETTER + OST_STRESS_MEASURES };

static OstStatus sample(const OstResult *result, const OstLocated *located, const double point[3], double row[WIDTH])
{
    const OstMesh *mesh = result->mesh;
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, located->tet);
    const float *surplus = result->node_stress_surplus;
    double values[OST_MAX_TET_NODES], at_nodes[6 * OST_MAX_TET_NODES], stress[6] = {0.0}, better[6] = {0.0}, turned[6];
    ost_shape_values(mesh->nodes_per_tet, located->at, values);
    ost_tet_nodal_stress(result, located->tet, at_nodes);
    for (int a = 0; a < mesh->nodes_per_tet; a++) {
        for (int i = 0; i < 3; i++)
            row[i] += values[a] * result->displacement[3 * (size_t)nodes[a] + (size_t)i];
        for (int p = 0; p < 6; p++)
            stress[p] += values[a] * at_nodes[6 * a + p];
        for (size_t p = 0; p < 6 && surplus; p++)
            better[p] +=
                values[a] * (double)surplus[6 * ((size_t)mesh->nodes_per_tet * (size_t)located->tet + (size_t)a) + p];
    }
    for (int p = 0; p < 6; p++)
        better[p] += stress[p];
    memcpy(turned, better, sizeof turned);
    ost_turn_with_error(result, located->tet, OST_STRESS_MEASURE_XX, 1, turned);
    for (int m = 0; m < OST_STRESS_MEASURES; m++) {
        const double *with_error = m <= (int)OST_STRESS_MEASURE_ZX ? turned : better;
        OST_TRY(ost_stress_measure(result, located->tet, stress, (OstStressMeasure)m, &row[3 + m]));
        OST_TRY(ost_stress_measure(result, located->tet, with_error, (OstStressMeasure)m, &row[BETTER + m]));
    }
    enum { ALONG_AXES = OST_STRESS_MEASURE_11 };
    ost_result_material_stress_at(result, located->tet, located->at, point, stress, &row[3 + ALONG_AXES]);
    ost_result_material_stress_at(result, located->tet, located->at, point, better, &row[BETTER + ALONG_AXES]);
    return OST_SUCCESS;
}

static OstStatus sample_own(const OstResult *result, OstLocal count, const OstLocated *located, const double *points,
                            double *rows)
{
    for (OstLocal p = 0; p < count; p++)
        if (located[p].tet >= 0)
            OST_TRY(sample(result, &located[p], points + 3 * (size_t)p, rows + WIDTH * (size_t)p));
    return OST_SUCCESS;
}

OstStatus ost_sample_points(const OstResult *result, OstLocal count, const double *points, OstSample *samples)
{
    OstContext *ctx = result->ctx;
    const int knows_errors = result->node_stress_surplus != NULL;
    OstLocated *located = NULL;
    double *rows = NULL;
    OstStatus status = OST_NEW(ctx, &located, count);
    OST_THEN(OST_NEW(ctx, &rows, WIDTH * (size_t)count));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_locate(result->mesh, count, points, located));
    OST_TRY_DONE(ost_agree(ctx, sample_own(result, count, located, points, rows)));
    OST_TRY_DONE(ost_sum(ctx, WIDTH * count, rows));
    for (OstLocal p = 0; p < count; p++) {
        const double *row = rows + WIDTH * (size_t)p;
        samples[p].tet = located[p].label;
        for (int i = 0; i < 3; i++)
            samples[p].displacement[i] = row[i];
        for (int m = 0; m < OST_STRESS_MEASURES; m++) {
            samples[p].stress[m] = row[3 + m];
            samples[p].stress_error[m] = knows_errors ? row[BETTER + m] - row[3 + m] : NAN;
        }
    }
done:
    OST_FREE(located, rows);
    return status;
}
