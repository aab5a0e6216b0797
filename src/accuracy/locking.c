/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/locking.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>

int ost_is_nearly_incompressible(const OstProblem *problem)
{
    for (int r = 0; r < problem->field->region_count; r++) {
        double eigenvalues[3] = {1.0, 1.0, 1.0};
        if (ost_orthotropic_eigenvalues(problem->ctx, &problem->field->material[r].constants, eigenvalues) ==
                OST_SUCCESS &&
            ost_has_one_stiff_mode(eigenvalues, OST_NEARLY_INCOMPRESSIBLE))
            return 1;
    }
    return 0;
}

/* The squared length in the metric of a unit step from one end of an edge to the other. */
static double step_along(const OstMesh *mesh, OstLocal a, OstLocal b, const double metric[6])
{
    double x[3], length = 0.0, square = 0.0;
    for (int i = 0; i < 3; i++)
        x[i] = mesh->coordinates[3 * b + i] - mesh->coordinates[3 * a + i];
    for (int i = 0; i < 3; i++) {
        length += x[i] * x[i];
        square += metric[i] * x[i] * x[i] + 2.0 * metric[3 + i] * x[i] * x[(i + 1) % 3];
    }
    return square / length;
}

static double misalignment(const OstProblem *problem, OstLocal tet)
{
    const double *modulus = problem->field->material[problem->field->tet_region[tet]].constants.youngs_modulus;
    const OstLocal *node = ost_mesh_nodes_of(problem->mesh, tet);
    const double most = fmax(modulus[0], fmax(modulus[1], modulus[2]));
    const double least = fmin(modulus[0], fmin(modulus[1], modulus[2]));
    const double middle = modulus[0] + modulus[1] + modulus[2] - most - least;
    double metric[6], shortest[2] = {INFINITY, INFINITY};
    ost_field_metric(problem->field, tet, metric);
    for (int e = 0; e < 6; e++) {
        const double step = step_along(problem->mesh, node[ost_tet_edge[e][0]], node[ost_tet_edge[e][1]], metric);
        shortest[1] = fmin(shortest[1], fmax(step, shortest[0]));
        shortest[0] = fmin(shortest[0], step);
    }
    return shortest[2.0 * middle > most] * sqrt(most / least);
}

/* About so many tets are looked at, the same on any number of ranks; of hexes' six tets each in its turn. */
enum { SAMPLED = 10000 };

OstStatus ost_stiff_directions_cross(const OstProblem *problem, int *cross)
{
    const OstGlobal stride = 1 + 6 * (problem->mesh->global_tets / (6 * SAMPLED));
    double sum[2] = {0.0};
    *cross = 0;
    if (!problem->field->region_axes) /* isotropic */
        return OST_SUCCESS;
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        if (problem->mesh->tet_label[tet] % stride == 0) {
            sum[0] += misalignment(problem, tet);
            sum[1] += 1.0;
        }
    OST_TRY(ost_sum(problem->ctx, 2, sum));
    *cross = sum[0] > 1.25 * sum[1];
    return OST_SUCCESS;
}

/* By Euler's formula vertices - edges + faces - tets is a small number, half of the surface's faces are its vertices,
 * and tets have four faces, those inside two tets. */
OstStatus ost_has_few_layers(const OstMesh *mesh, OstLocal edges, int *few)
{
    double all_edges = (double)edges;
    OST_TRY(ost_sum(mesh->ctx, 1, &all_edges));
    const double vertices = (double)mesh->global_nodes;
    *few = all_edges - vertices - (double)mesh->global_tets > 0.45 * vertices;
    return OST_SUCCESS;
}
