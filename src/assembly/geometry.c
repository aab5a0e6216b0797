/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rigid_modes.h"
#include "algebra/solver.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <string.h>

/* Mean of the material metric over the tets of each row's node, all of which this rank has. */
static OstStatus mean_metric(const OstSystem *system, const OstMaterialField *field, double *metric)
{
    const OstMesh *mesh = system->mesh;
    const OstLocal rows = system->matrix->rows;
    OstLocal *tets = NULL;
    OST_TRY(OST_NEW(system->ctx, &tets, rows));
    memset(metric, 0, 6 * (size_t)rows * sizeof *metric);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        double of_tet[6];
        ost_field_metric(field, tet, of_tet);
        for (int a = 0; a < mesh->nodes_per_tet; a++) {
            const OstLocal node = mesh->tet_nodes[(size_t)mesh->nodes_per_tet * (size_t)tet + (size_t)a];
            const OstLocal row = system->row_of_node[node];
            if (row < 0 || row >= rows)
                continue;
            tets[row]++;
            for (size_t i = 0; i < 6; i++)
                metric[6 * (size_t)row + i] += of_tet[i];
        }
    }
    for (OstLocal row = 0; row < rows; row++)
        for (size_t i = 0; i < 6; i++)
            metric[6 * (size_t)row + i] /= tets[row];
    OST_FREE(tets);
    return OST_SUCCESS;
}

/* Without orthotropy the material metric is the identity. */
static void euclidean_metric(OstLocal rows, double *metric)
{
    for (OstLocal row = 0; row < rows; row++)
        for (size_t i = 0; i < 6; i++)
            metric[6 * (size_t)row + i] = i < 3 ? 1.0 : 0.0;
}

/* Collective. The mean of all rows' coordinates. Rotations are taken about it: a near point keeps rounding errors
 * small.
 */
static OstStatus find_middle(const OstSystem *system, const double *coordinates, double middle[3])
{
    middle[0] = middle[1] = middle[2] = 0.0;
    for (OstLocal row = 0; row < system->matrix->rows; row++)
        for (size_t i = 0; i < 3; i++)
            middle[i] += coordinates[3 * (size_t)row + i] / (double)system->matrix->global_rows;
    return ost_sum(system->ctx, 3, middle);
}

static void project_modes(const OstSystem *system, double *modes)
{
    const size_t length = 3 * (size_t)system->matrix->rows;
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        double projector[9];
        if (ost_supports_get(system->supports, system->node_of_row[row], projector, NULL) == 0)
            continue;
        for (size_t m = 0; m < 6; m++) {
            double *mode = modes + m * length + 3 * (size_t)row;
            const double whole[3] = {mode[0], mode[1], mode[2]};
            ost_apply3(projector, whole, mode);
        }
    }
}

/* The rows of a rigid face's carriers are its point's displacement, and its rotation times a length. */
static void take_faces(const OstSystem *system, const OstRigidFace *face, const double middle[3], double *modes)
{
    const OstMesh *mesh = system->mesh;
    const size_t length = 3 * (size_t)system->matrix->rows;
    double arm[3];
    for (int i = 0; i < 3; i++)
        arm[i] = face->point[i] + face->now.shift[i] - middle[i];
    for (size_t c = 0; c < 2; c++) {
        const OstGlobal node = face->carrier[c] - mesh->first_node;
        if (face->carrier[c] < 0 || node < 0 || node >= mesh->owned_nodes)
            continue;
        for (size_t m = 0; m < 6; m++) {
            const double axis[3] = {m % 3 == 0, m % 3 == 1, m % 3 == 2};
            double *mode = modes + m * length + 3 * (size_t)system->row_of_node[node];
            if (m < 3)
                memcpy(mode, axis, sizeof axis);
            else
                ost_cross3(axis, arm, mode);
            for (size_t i = 0; i < 3; i++) {
                if (c == 1)
                    mode[i] = m < 3 ? 0.0 : face->length * axis[i];
                if (face->constrained[3 * c + i])
                    mode[i] = 0.0;
            }
        }
    }
}

OstStatus ost_system_modes(const OstSystem *system, const double *displacement, double *places, double *modes)
{
    const OstLocal rows = system->matrix->rows;
    double middle[3];
    for (size_t row = 0; row < (size_t)rows; row++)
        for (size_t i = 0; i < 3; i++) {
            const size_t at = 3 * (size_t)system->node_of_row[row] + i;
            places[3 * row + i] = system->mesh->coordinates[at] + (displacement ? displacement[at] : 0.0);
        }
    const OstStatus status = find_middle(system, places, middle);
    if (status == OST_SUCCESS) {
        ost_rigid_body_modes(rows, places, middle, modes);
        project_modes(system, modes);
    }
    const OstLinks *links = system->supports->links;
    for (int f = 0; links && f < links->face_count && status == OST_SUCCESS; f++)
        take_faces(system, &links->face[f], middle, modes);
    return status;
}

OstStatus ost_system_geometry(const OstSystem *system, const OstMaterialField *field, double *coordinates,
                              double *metric, double *modes)
{
    const OstLocal rows = system->matrix->rows;
    OstStatus status = OST_SUCCESS;
    if (metric && !field->region_axes)
        euclidean_metric(rows, metric);
    else if (metric)
        status = mean_metric(system, field, metric);
    OST_TRY(ost_agree(system->ctx, status));
    return ost_system_modes(system, NULL, coordinates, modes);
}
