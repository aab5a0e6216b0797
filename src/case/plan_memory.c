/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_plan.h"
#include "case/plan.h"

#include <math.h>

/* Bytes of each structure; the fields are those of mesh.h, block_matrix.h, system.h and result.h. */
static const double mesh_node_bytes = 24.0 + 8.0 + 8.0;      /* coordinates, number, label */
static const double mesh_tet_bytes = 8.0 + 8.0 + 4.0;        /* label, index, region; its nodes come on top */
static const double block_bytes = 72.0 + 4.0;                /* nine doubles and a column */
static const double row_bytes = 8.0 + 4.0 + 4.0 + 4.0 + 4.0; /* label, start, diagonal, both maps of nodes and rows */
static const double pair_bytes = 4.0;                        /* place of the block of a pair of a tet's nodes */
static const double vectors = 10.0;                          /* of three doubles a node, in the solver and around it */

/* Multigrid's memory over the matrix', measured on the tube of the paper: level 0 in single precision, the smoother's
 * factors, and the coarse levels. Under quadratic tets the levels are of the linear tets, which are counted apart
 * (OST_EFFECT_LINEAR_SPACE). */
static const double multigrid_copies = 1.9;
static const double quadratic_copies = 1.0;
static const double plain_copies = 3.0; /* scalar copy for ML and Gauss-Seidel, and the hierarchy */

/* All nodes and tets that ranks hold, over those they own: each holds a layer of ghost nodes around its part of the
 * partition. A part of n nodes has about 6 n^(2/3) nodes on its faces; about half of its faces border on another part.
 */
static double halo_factor(double nodes, int ranks)
{
    if (ranks <= 1 || nodes <= 0.0)
        return 1.0;
    return 1.0 + fmin(3.0 * cbrt((double)ranks / nodes), (double)ranks - 1.0);
}

/* Number of blocks of K: one for each node, and two for each pair of nodes that share a tet. By Euler's formula a mesh
 * of V vertices, T tets and B surface faces has about E = V + T + B/2 edges; B is about 12 V^(2/3) for a compact body.
 * With quadratic tets an edge's node is paired with the vertices of the tets around it: the edge's two ends and 6 T / E
 * more; and with the nodes of other edges: 12 T / E share a face with it, 6 T / E lie opposite in a tet. */
static double matrix_blocks(double nodes, double tets, int quadratic)
{
    const double vertices = quadratic ? fmax(nodes - 7.0 / 6.0 * tets, 0.0) : nodes;
    const double edges = quadratic ? nodes - vertices : vertices + tets + 6.0 * pow(vertices, 2.0 / 3.0);
    return vertices + 2.0 * edges + (quadratic ? 5.0 * edges + 30.0 * tets : 0.0);
}

static double solver_bytes(const OstPlan *plan, int quadratic, double matrix_bytes)
{
    const double vector_bytes = vectors * 24.0 * (double)plan->nodes;
    switch (plan->solver.first) {
    case OST_METHOD_DIRECT:
        return vector_bytes + ost_solver_factor_bytes(plan->unknowns);
    case OST_METHOD_PLAIN:
        return vector_bytes + plain_copies * matrix_bytes;
    default:
        return vector_bytes + (quadratic ? quadratic_copies : multigrid_copies) * matrix_bytes;
    }
}

int ost_plan_writes(const OstCase *c, OstOutputFieldBit field)
{
    return (c->output_fields >> field & 1U) != 0;
}

static double output_bytes(const OstCase *c, const OstPlan *plan)
{
    const double node = 24.0 + 24.0 * ost_plan_writes(c, OST_FIELD_DISPLACEMENT) +
                        24.0 * ost_plan_writes(c, OST_FIELD_REACTION) + 24.0 * ost_plan_writes(c, OST_FIELD_LOAD) +
                        48.0 * ost_plan_writes(c, OST_FIELD_NODE_STRESS);
    const double tet = 32.0 + 8.0 + 1.0 + 48.0 * ost_plan_writes(c, OST_FIELD_STRESS) +
                       48.0 * ost_plan_writes(c, OST_FIELD_STRAIN) + 8.0 * ost_plan_writes(c, OST_FIELD_ENERGY) +
                       8.0 * ost_plan_writes(c, OST_FIELD_ERROR) + 72.0 * ost_plan_writes(c, OST_FIELD_AXES) +
                       4.0 * ost_plan_writes(c, OST_FIELD_REGION) + 4.0 * ost_plan_writes(c, OST_FIELD_RANK);
    return node * (double)plan->nodes + tet * (double)plan->tets;
}

/* Fewest ranks by the limits of assembly/limits.c: nonzeros of K, and nodes of tets, on one rank. Assumes equal parts.
 */
static int least_ranks(double blocks, double tet_nodes)
{
    return (int)fmin(fmax(ceil(fmax(9.0 * blocks, tet_nodes) / INT32_MAX), 1.0), INT32_MAX);
}

void ost_plan_memory(const OstCase *c, int quadratic, int ranks, OstPlan *plan)
{
    const double nodes = (double)plan->nodes;
    const double tets = (double)plan->tets;
    const double nodes_per_tet = quadratic ? 10.0 : 4.0;
    const double pairs = nodes_per_tet * (nodes_per_tet + 1.0) / 2.0;
    const double halo = halo_factor(nodes, ranks);
    const double blocks = matrix_blocks(nodes, tets, quadratic);
    plan->least_ranks = least_ranks(blocks, nodes_per_tet * tets);
    plan->bytes_mesh = halo * (nodes * mesh_node_bytes + tets * (4.0 * nodes_per_tet + mesh_tet_bytes));
    plan->bytes_matrix = blocks * block_bytes + nodes * row_bytes + halo * tets * pairs * pair_bytes;
    plan->bytes_solver = solver_bytes(plan, quadratic, blocks * block_bytes);
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        plan->bytes_effects += ost_effect_state(&plan->effects, (OstEffect)e)->bytes;
    plan->bytes_output = output_bytes(c, plan) * (c->path_steps > 0 ? c->path_steps : 1);
}
