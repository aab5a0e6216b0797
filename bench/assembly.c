/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/orthostat.h"
#include "problem/scene_data.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Times of the pattern and of the stiffness of the paper's tube (Li and Barbič 2014, Fig. 6), isotropic and stiff
 * along, across and around, and of what large rotations take of the bent tube; least of several. Arguments: repetitions
 * (15), refinement (1: 129,600 tets), kind of tets (1: linear, 2: quadratic, 3: quadratic with curved edges). */

typedef struct Bench {
    OstContext *ctx;
    OstMesh *mesh;
    OstSupports *supports;
    int repetitions;
} Bench;

/* Time of the processor for this thread: other programs' turns on a busy machine do not count. */
static double processor_seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Exchanges the linear mesh for a quadratic one. */
static OstStatus raise_order(Bench *bench, const OstTubeShape *shape, int curved)
{
    const OstShapeSurface surface = ost_shape_surface_tube(shape);
    OstMesh *quadratic = NULL;
    OST_TRY(ost_mesh_raise(bench->mesh, curved ? &surface : NULL, &quadratic));
    ost_mesh_destroy(&bench->mesh);
    bench->mesh = quadratic;
    return OST_SUCCESS;
}

static OstStatus make_tube(Bench *bench, OstLocal refinement, int kind)
{
    const OstTubeShape shape = {.axis = 1,
                                .length = 10.0,
                                .radii = {0.9, 1.5},
                                .around = 60 * refinement,
                                .radial = 6 * refinement,
                                .axial = 60 * refinement};
    OstMeshChunk *chunk = NULL;
    OST_TRY(ost_chunk_create_tube(bench->ctx, &shape, &chunk));
    OST_TRY(ost_mesh_distribute(bench->ctx, &chunk, &bench->mesh));
    return kind == 1 ? OST_SUCCESS : raise_order(bench, &shape, kind == 3);
}

static OstStatus hold_ends(Bench *bench)
{
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    OST_TRY(ost_supports_create(bench->mesh, &bench->supports));
    for (OstLocal node = 0; node < bench->mesh->owned_nodes; node++) {
        const double y = bench->mesh->coordinates[3 * (size_t)node + 1];
        for (int i = 0; i < 3 && (y == 0.0 || y == 10.0); i++)
            OST_TRY(ost_supports_constrain(bench->supports, node, unit[i], 0.0));
    }
    return ost_supports_complete(bench->supports);
}

static OstStatus make_field(const Bench *bench, const double youngs_modulus[3], OstMaterialField **field)
{
    const OstMesh *mesh = bench->mesh;
    const OstAxesSpec axes = {
        .kind = OST_AXES_CYLINDRICAL, .axis = {0.0, 1.0, 0.0}, .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}};
    const OstOrthotropic constants = ost_orthotropic_family(youngs_modulus, 0.3, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    double *centroids = NULL;
    OST_TRY(ost_material_create(bench->ctx, "tube", &constants, 0.0, &material));
    OST_TRY(OST_NEW(bench->ctx, &centroids, 3 * (size_t)mesh->tet_count));
    OstStatus status = ost_mesh_tet_centroids(mesh, centroids);
    if (status == OST_SUCCESS)
        status = ost_field_create(bench->ctx, NULL, 1, &material, &axes, mesh->tet_count, mesh->tet_region,
                                  mesh->tet_label, centroids, NULL, field);
    OST_FREE(centroids);
    return status;
}

static OstStatus time_pattern(const Bench *bench)
{
    double least = HUGE_VAL;
    for (int r = 0; r < bench->repetitions; r++) {
        OstSystem *system = NULL;
        const double start = processor_seconds();
        OST_TRY(ost_system_create(bench->mesh, bench->supports, &system));
        least = fmin(least, processor_seconds() - start);
        if (r == 0)
            printf("tets %d, vertices %d, free %d, blocks %d\n", (int)bench->mesh->tet_count,
                   (int)bench->mesh->owned_nodes, (int)system->matrix->rows,
                   (int)system->matrix->row_start[system->matrix->rows]);
        ost_system_destroy(&system);
    }
    printf("%-24s %8.2f ms\n", "pattern", 1e3 * least);
    return OST_SUCCESS;
}

enum { MATERIALS = 4 };

/* The materials take turns, so that a busy moment of the machine is nobody's alone. */
static OstStatus time_fill(const Bench *bench, OstSystem *system, OstMaterialField *const field[MATERIALS])
{
    static const char *const name[MATERIALS] = {"isotropic", "stiff along", "stiff radially", "stiff around"};
    double least[MATERIALS] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    for (int r = 0; r < bench->repetitions; r++)
        for (int m = 0; m < MATERIALS; m++) {
            const double start = processor_seconds();
            OST_TRY(ost_system_fill(system, field[m]));
            least[m] = fmin(least[m], processor_seconds() - start);
        }
    for (int m = 0; m < MATERIALS; m++)
        printf("fill, %-18s %8.2f ms   %.3f of isotropic\n", name[m], 1e3 * least[m], least[m] / least[0]);
    return OST_SUCCESS;
}

/* The tube bent to a circle, its free end displaced by about its radius, and stretched. */
static void bend(const OstMesh *mesh, double stretch, double *u)
{
    const double curvature = 0.03;
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        const double *x = mesh->coordinates + 3 * (size_t)node;
        const double angle = curvature * x[1];
        const double radius = 1.0 / curvature - x[0];
        u[3 * (size_t)node] = 1.0 / curvature - stretch * radius * cos(angle) - x[0];
        u[3 * (size_t)node + 1] = stretch * radius * sin(angle) - x[1];
        u[3 * (size_t)node + 2] = 0.0;
    }
}

enum { LINEAR_FORCE, LINEAR_FILL, ENERGY, FORCE, STIFFNESS, DEFINITE, WORKS };

static OstStatus do_work(const Bench *bench, OstSystem *system, const OstMaterialField *field, int work,
                         const double *u, double *force)
{
    const OstTangent tangent = {.formulation = OST_FORMULATION_CONSISTENT, .u = u, .definite = work == DEFINITE};
    if (work == LINEAR_FORCE)
        return ost_internal_force(bench->mesh, field, 1.0, u, force, NULL);
    if (work == FORCE)
        return ost_internal_force_of(bench->mesh, field, tangent.formulation, 1.0, u, force, NULL);
    if (work >= STIFFNESS)
        return ost_system_fill_tangent(system, field, &tangent);
    if (work == LINEAR_FILL)
        return ost_system_fill(system, field);
    return ost_large_rotation_energy_of(bench->mesh, field, tangent.formulation, 1.0, u) >= 0.0
               ? OST_SUCCESS
               : OST_RAISE(bench->ctx, OST_CHECK_FAILED, "the energy of the bent tube is negative");
}

static OstStatus time_large_rotation(const Bench *bench, OstSystem *system, const OstMaterialField *field,
                                     const char *material, double stretch)
{
    static const char *const name[WORKS] = {"linear force", "linear fill", "energy",
                                            "force",        "stiffness",   "definite stiffness"};
    double least[WORKS] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double *u = NULL;
    double *force = NULL;
    OST_TRY(OST_NEW(bench->ctx, &u, 3 * (size_t)bench->mesh->node_count));
    OstStatus status = OST_NEW(bench->ctx, &force, 3 * (size_t)bench->mesh->owned_nodes);
    bend(bench->mesh, stretch, u);
    for (int r = 0; r < bench->repetitions; r++)
        for (int work = 0; work < WORKS && status == OST_SUCCESS; work++) {
            const double start = processor_seconds();
            status = do_work(bench, system, field, work, u, force);
            least[work] = fmin(least[work], processor_seconds() - start);
        }
    printf("bent, stretched %.2f, %s\n", stretch, material);
    for (int work = 0; work < WORKS; work++)
        printf("  %-22s %8.2f ms   %.2f linear fills\n", name[work], 1e3 * least[work],
               least[work] / least[LINEAR_FILL]);
    OST_FREE(u, force);
    return status;
}

static OstStatus run(Bench *bench, OstLocal refinement, int kind)
{
    static const double modulus[MATERIALS][3] = {{1e6, 1e6, 1e6}, {1e9, 1e6, 1e6}, {1e6, 1e9, 1e6}, {1e6, 1e6, 1e9}};
    OstMaterialField *field[MATERIALS] = {NULL};
    OstSystem *system = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(make_tube(bench, refinement, kind));
    OST_TRY_DONE(hold_ends(bench));
    for (int m = 0; m < MATERIALS; m++)
        OST_TRY_DONE(make_field(bench, modulus[m], &field[m]));
    OST_TRY_DONE(time_pattern(bench));
    OST_TRY_DONE(ost_system_create(bench->mesh, bench->supports, &system));
    OST_TRY_DONE(time_fill(bench, system, field));
    for (int m = 0; m < 2; m++) {
        OST_TRY_DONE(time_large_rotation(bench, system, field[m], m ? "stiff along" : "isotropic", 1.0));
        OST_TRY_DONE(time_large_rotation(bench, system, field[m], m ? "stiff along" : "isotropic", 1.1));
    }
done:
    ost_system_destroy(&system);
    for (int m = 0; m < MATERIALS; m++)
        ost_field_destroy(&field[m]);
    ost_supports_destroy(&bench->supports);
    ost_mesh_destroy(&bench->mesh);
    return status;
}

int main(int argc, char **argv)
{
    Bench bench = {.repetitions = argc > 1 ? atoi(argv[1]) : 15};
    ost_keep_freed_memory();
    MPI_Init(&argc, &argv);
    if (ost_context_create(MPI_COMM_WORLD, &bench.ctx) != OST_SUCCESS)
        return 1;
    const OstStatus status = run(&bench, argc > 2 ? atoi(argv[2]) : 1, argc > 3 ? atoi(argv[3]) : 1);
    if (status != OST_SUCCESS)
        fprintf(stderr, "%s\n", ost_error_text(bench.ctx));
    ost_context_destroy(&bench.ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
