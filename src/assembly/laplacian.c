/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/laplacian.h"

#include "assembly/batch.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/shape_functions.h"

#include <string.h>

enum { MAX_PAIRS = OST_MAX_TET_NODES * (OST_MAX_TET_NODES + 1) / 2 };

/* One tet: its nodes in the scatter map's order, and its Laplacian. */
typedef struct TetLaplacian {
    OstLocal node[OST_MAX_TET_NODES];
    double pairs[MAX_PAIRS];
} TetLaplacian;

static void laplacian_of(const OstMesh *mesh, const OstElement *element, OstLocal tet, TetLaplacian *laplacian)
{
    const int n = element->nodes;
    double x[3 * OST_MAX_TET_NODES];
    ost_order_nodes(n, mesh->node_label, mesh->tet_nodes + (size_t)n * (size_t)tet, laplacian->node);
    ost_gather3(n, laplacian->node, mesh->coordinates, x);
    element->laplacian(x, laplacian->pairs);
}

static void add_to_matrix(const OstSystem *system, int pairs, OstLocal tet, const TetLaplacian *laplacian)
{
    const OstLocal *target = system->block_of_tet + (size_t)pairs * (size_t)tet;
    for (int p = 0; p < pairs; p++)
        for (int i = 0; i < 9 && target[p] >= 0; i += 4)
            system->matrix->value[9 * (size_t)target[p] + (size_t)i] += laplacian->pairs[p];
}

/* force -= L g: `prescribed` is g, 3 × node_count; force is 3 × rows. */
static void subtract_prescribed(const OstSystem *system, int n, const TetLaplacian *laplacian, const double *prescribed,
                                double *force)
{
    for (int a = 0; a < n; a++) {
        const OstLocal row = system->row_of_node[laplacian->node[a]];
        if (row < 0 || row >= system->matrix->rows)
            continue;
        for (int b = 0; b < n; b++) {
            const double weight = laplacian->pairs[a <= b ? ost_pair_index(n, a, b) : ost_pair_index(n, b, a)];
            for (size_t i = 0; i < 3; i++)
                force[3 * (size_t)row + i] -= weight * prescribed[3 * (size_t)laplacian->node[b] + i];
        }
    }
}

/* rhs = P rhs */
static void project(const OstSystem *system, double *rhs)
{
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        double *at = rhs + 3 * (size_t)row;
        const double whole[3] = {at[0], at[1], at[2]};
        double projector[9];
        ost_supports_get(system->supports, system->node_of_row[row], projector, NULL);
        ost_apply3(projector, whole, at);
    }
}

OstStatus ost_system_fill_laplacian(OstSystem *system, double *rhs)
{
    const OstMesh *mesh = system->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    double *prescribed = NULL;
    if (!system->block_of_tet)
        return OST_RAISE(system->ctx, OST_INVALID_USAGE,
                         "the matrix cannot be filled: its scatter map has been released");
    OST_TRY(OST_NEW(system->ctx, &prescribed, 3 * (size_t)mesh->node_count));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double projector[9];
        ost_supports_get(system->supports, node, projector, prescribed + 3 * (size_t)node);
    }
    ost_triangle_clear(system->matrix);
    memset(rhs, 0, 3 * (size_t)system->matrix->rows * sizeof *rhs);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        TetLaplacian laplacian;
        laplacian_of(mesh, element, tet, &laplacian);
        add_to_matrix(system, ost_pair_count(element->nodes), tet, &laplacian);
        subtract_prescribed(system, element->nodes, &laplacian, prescribed, rhs);
    }
    OST_FREE(prescribed);
    OST_TRY(ost_triangle_mirror(system->matrix));
    ost_system_apply_supports(system);
    project(system, rhs);
    return OST_SUCCESS;
}

void ost_tet_component_gradients(const OstMesh *mesh, OstLocal tet, const double *u, double gradients[9])
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    const OstLocal *nodes = mesh->tet_nodes + (size_t)element->nodes * (size_t)tet;
    double x[3 * OST_MAX_TET_NODES];
    double values[3 * OST_MAX_TET_NODES];
    ost_gather3(element->nodes, nodes, mesh->coordinates, x);
    ost_gather3(element->nodes, nodes, u, values);
    element->gradient(x, values, gradients);
}

void ost_tet_node_gradients(const OstMesh *mesh, OstLocal tet, const double *u, int component, double gradients[30])
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double x[30], of_node[30];
    ost_gather3(10, nodes, mesh->coordinates, x);
    memset(gradients, 0, 30 * sizeof *gradients);
    for (int n = 0; n < 10; n++) {
        ost_shape_gradients(10, ost_tet_nodes.point[n].at, x, of_node);
        for (int a = 0; a < 10; a++)
            for (int i = 0; i < 3; i++)
                gradients[3 * n + i] += u[3 * (size_t)nodes[a] + (size_t)component] * of_node[3 * a + i];
    }
}
