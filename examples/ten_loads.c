/* SPDX-License-Identifier: BSD-3-Clause */
/* One body, ten loads. A cantilever of wood is bent by a force at its end that points another way each time: first down
 * the strong side, last across it. The stiffness and the solver's multigrid hierarchy are made for the first load and
 * serve the other nine, which take a fraction of its time.
 *
 *     mpirun -n 2 ./ten_loads
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

enum { LOADS = 10 };
static const double pi = 3.14159265358979323846;

/* A case may stand in the program as well as in a file; `cantilever` is what messages call it. The load here is the
 * first one; the program puts others in its place. */
static const char cantilever[] = "title: cantilever\n"
                                 "mesh: {block: {size: [8, 1, 2], divisions: [32, 4, 8]}}\n"
                                 "materials:\n"
                                 "  - region: all\n"
                                 "    youngs_modulus: [10, 0.8, 0.5]\n"
                                 "    poissons_ratio: {nu12: 0.4, nu23: 0.3, nu31: 0.02}\n"
                                 "    shear_modulus: {G12: 0.6, G23: 0.04, G31: 0.6}\n"
                                 "constraints:\n"
                                 "  - {on: {boundary: [xmin]}, displacement: [0, 0, 0]}\n"
                                 "loads:\n"
                                 "  - {on: {boundary: [xmax]}, total_force: [0, 0, -0.001], share: vertices}\n";

/* How many nodes of the body lie at the free end, x = 8. */
static OstGlobal count_end_nodes(OstContext *ctx, const OstMesh *mesh)
{
    OstGlobal count = 0;
    for (OstLocal n = 0; n < ost_mesh_owned_nodes(mesh); n++)
        count += ost_mesh_coordinates(mesh)[3 * n] == 8.0;
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    return count;
}

/* A force of 0.001 in all at the free end, turned by `angle` from -z towards y; each rank for the nodes it owns. */
static void fill_load(const OstMesh *mesh, OstGlobal end_nodes, double angle, double *force)
{
    const double share = 0.001 / (double)end_nodes;
    for (OstLocal n = 0; n < ost_mesh_owned_nodes(mesh); n++) {
        const int at_end = ost_mesh_coordinates(mesh)[3 * n] == 8.0;
        force[3 * n] = 0.0;
        force[3 * n + 1] = at_end ? share * sin(angle) : 0.0;
        force[3 * n + 2] = at_end ? -share * cos(angle) : 0.0;
    }
}

static OstStatus solve_all(OstContext *ctx)
{
    OstStatus status = OST_SUCCESS;
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstProblem *problem = NULL;
    OstAnalysis *analysis = NULL;
    double *force = NULL;

    TRY(ost_case_parse(ctx, "cantilever", cantilever, &c));
    TRY(ost_scene_create(c, &scene));
    TRY(ost_scene_problem(scene, &problem));
    TRY(ost_analysis_create(problem, ost_case_solver_options(c), &analysis));

    const OstMesh *mesh = ost_scene_mesh(scene);
    const OstGlobal end_nodes = count_end_nodes(ctx, mesh);
    force = malloc(3 * sizeof *force * ((size_t)ost_mesh_owned_nodes(mesh) + 1));
    for (int load = 0; load < LOADS; load++) {
        OstResult *result = NULL;
        const double degrees = 90.0 * load / (LOADS - 1);
        const double start = ost_seconds();
        fill_load(mesh, end_nodes, degrees * pi / 180.0, force);
        ost_problem_set_load(problem, force);
        status = ost_analysis_solve(analysis, 0, &result); /* 0: no strains or stresses */
        if (status == OST_SUCCESS && ost_rank(ctx) == 0)
            printf("%3.0f degrees: moves by %.5g, %d iterations, %.3f s\n", degrees,
                   ost_result_largest_displacement(result, NULL), ost_result_solve_report(result)->iterations,
                   ost_seconds() - start);
        ost_result_destroy(&result);
        TRY(status);
    }
done:
    free(force);
    ost_analysis_destroy(&analysis);
    ost_problem_destroy(&problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    OstStatus status = ost_context_create(MPI_COMM_WORLD, &ctx);
    if (status == OST_SUCCESS) {
        status = solve_all(ctx);
        if (status && ost_rank(ctx) == 0)
            fprintf(stderr, "%s\n", ost_error_text(ctx));
    }
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
