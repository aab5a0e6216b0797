/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ASSEMBLY_FLAT_TET_H
#define ORTHOSTAT_TESTS_ASSEMBLY_FLAT_TET_H

#include "body.h"

/* Label of the inner vertex nearest to a point of the body, the same on all ranks. */
static inline OstGlobal inner_vertex_near(const OstMesh *mesh, const double point[3])
{
    double nearest = HUGE_VAL, own = HUGE_VAL;
    OstGlobal label = INT64_MAX;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node;
        const double away = hypot(hypot(x[0] - point[0], x[1] - point[1]), x[2] - point[2]);
        if (is_on_surface(x) || away >= own)
            continue;
        own = away;
        label = mesh->node_label[node];
    }
    MPI_Allreduce(&own, &nearest, 1, MPI_DOUBLE, MPI_MIN, ost_comm(mesh->ctx));
    label = own > nearest ? INT64_MAX : label;
    MPI_Allreduce(MPI_IN_PLACE, &label, 1, MPI_INT64_T, MPI_MIN, ost_comm(mesh->ctx));
    return label;
}

/* The body's tets with an inner vertex, that nearest to x = `at` on the middle line, moved until the first of its tets
 * keeps this share of its volume. The same on any number of ranks. */
static inline OstMesh *make_flattened(OstContext *of, double at, double left)
{
    static const double direction[3] = {0.3, -0.7, 0.45}; /* towards no symmetry of the block */
    OstMesh *mesh = make_body(of);
    const double middle[3] = {at, 0.5 * size_of_body[1], 0.5 * size_of_body[2]};
    const OstGlobal moved = inner_vertex_near(mesh, middle);
    double far = HUGE_VAL;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        const double before = ost_tet_volume(mesh->coordinates, nodes);
        for (int a = 0; a < 4; a++) {
            double *x = mesh->coordinates + 3 * nodes[a];
            if (mesh->node_label[nodes[a]] != moved)
                continue;
            const double kept[3] = {x[0], x[1], x[2]};
            for (int i = 0; i < 3; i++)
                x[i] += direction[i];
            const double lost = before - ost_tet_volume(mesh->coordinates, nodes);
            memcpy(x, kept, sizeof kept);
            if (lost > 0.0)
                far = fmin(far, before / lost);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &far, 1, MPI_DOUBLE, MPI_MIN, ost_comm(of));
    for (OstLocal node = 0; node < mesh->node_count; node++)
        for (int i = 0; i < 3 && mesh->node_label[node] == moved; i++)
            mesh->coordinates[3 * node + i] += (1.0 - left) * far * direction[i];
    return mesh;
}

#endif
