/* SPDX-License-Identifier: BSD-3-Clause */
/* A program that has a mesh of its own: a wooden bar, 10 long, 1 wide and 1 high, held at x = 0 and pulled at x = 10
 * by forces on its nodes. Its grain is not straight: it waves in the x-y plane, so every tet has material axes of its
 * own. Wavy wood is softer: the program says by how much.
 *
 *     mpirun -n 2 ./own_mesh
 */
#include <orthostat/orthostat.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define TRY(call)        \
    do {                 \
        status = (call); \
        if (status)      \
            goto done;   \
    } while (0)

/* The mesh as this program holds it: CELLS × WIDE × WIDE cubes of six tets. */
enum { CELLS = 20, WIDE = 2, NODES = (CELLS + 1) * (WIDE + 1) * (WIDE + 1), TETS = 6 * CELLS * WIDE * WIDE };
static const double length = 10.0;
static const double force = 0.01;
static const double pi = 3.14159265358979323846;

static OstGlobal node_number(int i, int j, int k)
{
    return (OstGlobal)((i * (WIDE + 1) + j) * (WIDE + 1) + k);
}

/* Each tet walks from a cube's corner to the opposite one, along the three directions in one of six orders. An odd
 * order would turn the tet inside out: two of its nodes change places. */
static void fill_mesh(double *coordinates, OstGlobal *tet_nodes)
{
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int i = 0; i <= CELLS; i++)
        for (int j = 0; j <= WIDE; j++)
            for (int k = 0; k <= WIDE; k++) {
                double *x = coordinates + 3 * node_number(i, j, k);
                x[0] = length * i / CELLS;
                x[1] = (double)j / WIDE;
                x[2] = (double)k / WIDE;
            }
    for (int cube = 0; cube < CELLS * WIDE * WIDE; cube++)
        for (int t = 0; t < 6; t++) {
            int at[3] = {cube / (WIDE * WIDE), cube / WIDE % WIDE, cube % WIDE};
            OstGlobal *nodes = tet_nodes + 4 * (6 * cube + t);
            nodes[0] = node_number(at[0], at[1], at[2]);
            for (int step = 0; step < 3; step++) {
                at[order[t][step]]++;
                nodes[t >= 3 && step < 2 ? 2 - step : step + 1] = node_number(at[0], at[1], at[2]);
            }
        }
}

/* Rows e1, e2, e3: e1 along the grain, which rises and falls by `slope`; e3 along z. */
static void fill_axes(const double *coordinates, const OstGlobal *tet_nodes, double slope, double *axes)
{
    for (int t = 0; t < TETS; t++) {
        double x = 0.0;
        for (int v = 0; v < 4; v++)
            x += 0.25 * coordinates[3 * tet_nodes[4 * t + v]];
        const double angle = slope * cos(2.0 * pi * x / 5.0);
        const double rows[9] = {cos(angle), sin(angle), 0.0, -sin(angle), cos(angle), 0.0, 0.0, 0.0, 1.0};
        for (int i = 0; i < 9; i++)
            axes[9 * t + i] = rows[i];
    }
}

/* The library copies the arrays, partitions the mesh, and gives each rank its piece. Rank 0 brings all of it here; it
 * could also be spread over the ranks already. */
static OstStatus make_mesh(OstContext *ctx, double slope, OstMesh **mesh)
{
    static double coordinates[3 * NODES], tet_axes[9 * TETS];
    static OstGlobal tet_nodes[4 * TETS];
    OstMeshChunk *chunk = NULL;
    fill_mesh(coordinates, tet_nodes);
    fill_axes(coordinates, tet_nodes, slope, tet_axes);
    const OstMeshArrays arrays = {.nodes_per_tet = 4,
                                  .node_count = NODES,
                                  .coordinates = coordinates,
                                  .tet_count = TETS,
                                  .tet_nodes = tet_nodes,
                                  .tet_axes = tet_axes};
    OstStatus status = ost_chunk_create_from_arrays(ctx, ost_rank(ctx) == 0 ? &arrays : NULL, &chunk);
    if (status == OST_SUCCESS)
        status = ost_mesh_distribute(ctx, &chunk, mesh); /* consumes the chunk */
    return status;
}

/* Spruce: 20 times as stiff along the grain as across. Every tet takes the axes that came with the mesh. */
static OstStatus make_field(OstContext *ctx, const OstMesh *mesh, OstMaterialField **field)
{
    const OstOrthotropic spruce = {
        .youngs_modulus = {10.0, 0.8, 0.5}, .poissons_ratio = {0.4, 0.3, 0.02}, .shear_modulus = {0.6, 0.04, 0.6}};
    const OstAxesSpec axes = {.kind = OST_AXES_CELLS};
    OstMaterial material;
    OstStatus status = ost_material_create(ctx, "spruce", &spruce, 0.0, &material);
    if (status == OST_SUCCESS)
        status = ost_field_create_on(mesh, &material, &axes, ost_mesh_tet_axes(mesh), field);
    return status;
}

/* Supports and loads are given node by node, each rank for the nodes that it owns. Nodes at x = 0 do not move; those at
 * x = length share the force, by the area around them. */
static OstStatus make_problem(const OstMesh *mesh, const OstMaterialField *field, OstProblem **problem)
{
    const OstLocal owned = ost_mesh_owned_nodes(mesh);
    const double *coordinates = ost_mesh_coordinates(mesh);
    OstNodeConstraint *constraints = malloc(3 * (size_t)owned * sizeof *constraints + 1);
    double *forces = calloc(3 * (size_t)owned + 1, sizeof *forces);
    OstLocal count = 0;
    for (OstLocal n = 0; n < owned; n++) {
        const double *x = coordinates + 3 * n;
        for (int d = 0; d < 3 && x[0] == 0.0; d++) {
            constraints[count] = (OstNodeConstraint){.node = n, .displacement = 0.0};
            constraints[count++].direction[d] = 1.0;
        }
        if (x[0] == length)
            forces[3 * n] = force * (x[1] == 0.5 ? 2.0 : 1.0) * (x[2] == 0.5 ? 2.0 : 1.0) / 16.0;
    }
    const OstProblemParts parts = {
        .mesh = mesh, .field = field, .constraints = constraints, .constraint_count = count, .force = forces};
    const OstStatus status = ost_problem_create(&parts, problem); /* copies constraints and forces */
    free(constraints);
    free(forces);
    return status;
}

/* How far the bar with this slope of the grain is stretched. */
static OstStatus stretch(OstContext *ctx, double slope, double *largest)
{
    const OstSolverOptions options = ost_solver_default_options();
    OstStatus status = OST_SUCCESS;
    OstMesh *mesh = NULL;
    OstMaterialField *field = NULL;
    OstProblem *problem = NULL;
    OstResult *result = NULL;
    TRY(make_mesh(ctx, slope, &mesh));
    TRY(make_field(ctx, mesh, &field));
    TRY(make_problem(mesh, field, &problem));
    TRY(ost_problem_solve(problem, &options, 1U << OST_FIELD_STRESS, &result));
    *largest = ost_result_largest_displacement(result, NULL);
    TRY(ost_result_write(result, 1U << OST_FIELD_DISPLACEMENT | 1U << OST_FIELD_STRESS | 1U << OST_FIELD_AXES,
                         "own_mesh.vtkhdf"));
done:
    ost_result_destroy(&result);
    ost_problem_destroy(&problem);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    double straight = 0.0, wavy = 0.0;
    MPI_Init(&argc, &argv);
    OstStatus status = ost_context_create(MPI_COMM_WORLD, &ctx);
    if (status == OST_SUCCESS)
        status = stretch(ctx, 0.0, &straight);
    if (status == OST_SUCCESS)
        status = stretch(ctx, 0.3, &wavy);
    if (ctx && ost_rank(ctx) == 0) {
        if (status)
            fprintf(stderr, "%s\n", ost_error_text(ctx));
        else
            printf("straight grain: %.5g, wavy grain: %.5g, %.2f times as far\n", straight, wavy, wavy / straight);
    }
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
