/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_data.h"
#include "support.h"

#include "algebra/solver.h"
#include "assembly/loads.h"
#include "assembly/system.h"
#include "core/memory.h"
#include "orthostat/orthostat.h"
#include "recovery/recovery.h"

/* A thick cylinder under internal pressure 1 in plane strain (Lamé): a = 3, b = 9, E = 1000. A quarter of it, one layer
 * of hexes high; 20 through the wall. */
static const double inner = 3.0, outer = 9.0;
static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

typedef struct Pose {
    OstMesh *mesh;
    OstMaterialField *field;
    OstSupports *supports;
    OstSystem *system;
    OstResult result;
} Pose;

static OstMesh *make_sector(int order)
{
    const OstSectorShape shape = {
        .axis = 2, .length = 0.3, .radii = {3.0, 9.0}, .angle = 90.0, .around = 8, .radial = 20, .axial = 1};
    const OstShapeSurface surface = {.kind = OST_SURFACE_TUBE, .axis = {0.0, 0.0, 1.0}};
    OstMeshChunk *chunk = NULL;
    OstMesh *linear = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_sector(ctx, &shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &linear));
    if (order == 1)
        return linear;
    assert_success(ost_mesh_raise(linear, &surface, &mesh));
    ost_mesh_destroy(&linear);
    return mesh;
}

static void hold_planes_of_symmetry(Pose *pose)
{
    assert_success(ost_supports_create(pose->mesh, &pose->supports));
    for (OstLocal node = 0; node < pose->mesh->owned_nodes; node++) {
        const double *x = pose->mesh->coordinates + 3 * node;
        for (int i = 0; i < 3; i++)
            if (fabs(x[i]) < 1e-9 || (i == 2 && x[2] > 0.3 - 1e-9))
                assert_success(ost_supports_constrain(pose->supports, node, unit[i], 0.0));
    }
    assert_success(ost_supports_complete(pose->supports));
}

static void press(const Pose *pose, double *force)
{
    const OstBoundary *boundary = &pose->mesh->boundaries[ost_mesh_find_boundary(pose->mesh, "inner")];
    const OstLocal count = boundary->count * boundary->nodes_per_item;
    OstLocal *faces = calloc((size_t)count, sizeof *faces);
    for (OstLocal i = 0; i < count; i++)
        faces[i] = (OstLocal)boundary->nodes[i];
    assert_success(ost_load_pressure(pose->mesh, boundary->count, faces, boundary->nodes_per_item, 1.0, force));
    free(faces);
}

static void solve_directly(Pose *pose)
{
    const OstSolverGeometry nothing = {.coordinates = NULL};
    OstSolverOptions options = ost_solver_default_options();
    OstSolver *solver = NULL;
    OstSolveReport report;
    double *rhs = calloc(3 * (size_t)pose->system->matrix->rows, sizeof *rhs);
    double *v = calloc(3 * (size_t)pose->system->matrix->rows, sizeof *v);
    double *force = calloc(3 * (size_t)pose->mesh->node_count, sizeof *force);
    press(pose, force);
    assert_success(ost_system_right_hand_side(pose->system, pose->field, 0.0, force, rhs));
    options.method = OST_METHOD_DIRECT;
    assert_success(ost_solver_create(ctx, pose->system->matrix, &nothing, &options, &solver));
    assert_success(ost_solver_solve(solver, rhs, v, &report));
    assert_success(ost_system_displacement(pose->system, 1.0, v, pose->result.displacement));
    ost_solver_destroy(&solver);
    free(rhs);
    free(v);
    free(force);
}

static Pose make_pose(int order, double nu, int by_mean)
{
    const OstOrthotropic constants = ost_orthotropic_isotropic(1000.0, nu);
    Pose pose = {.mesh = make_sector(order)};
    OstMesh *mesh = pose.mesh;
    OstMaterial material;
    int regions = 0;
    assert_success(ost_material_create(ctx, "rubber", &constants, 0.0, &material));
    assert_success(ost_field_create(ctx, NULL, 1, &material, NULL, mesh->tet_count, mesh->tet_region, mesh->tet_label,
                                    NULL, NULL, &pose.field));
    if (by_mean)
        assert_success(ost_field_mean_dilatation(pose.field, OST_NEARLY_INCOMPRESSIBLE, &regions));
    assert_int_equal(regions, by_mean);
    hold_planes_of_symmetry(&pose);
    assert_success(ost_system_create(mesh, pose.supports, &pose.system));
    assert_success(ost_system_fill(pose.system, pose.field));
    pose.result = (OstResult){.ctx = ctx, .mesh = mesh, .field = pose.field};
    pose.result.displacement = calloc(3 * (size_t)mesh->node_count, sizeof(double));
    solve_directly(&pose);
    assert_success(ost_result_recover(&pose.result, 1U << OST_FIELD_NODE_STRESS));
    return pose;
}

static void destroy(Pose *pose)
{
    free(pose->result.displacement);
    OST_FREE(pose->result.node_stress);
    ost_system_destroy(&pose->system);
    ost_supports_destroy(&pose->supports);
    ost_field_destroy(&pose->field);
    ost_mesh_destroy(&pose->mesh);
}

/* u(a) = (1 + nu) a / (E (b² - a²)) ((1 - 2 nu) a² + b²); root of the mean square over the inner nodes,
 * relative. */
static double displacement_error(const Pose *pose, double nu)
{
    const double exact = (1.0 + nu) * inner / (1000.0 * (outer * outer - inner * inner)) *
                         ((1.0 - 2.0 * nu) * inner * inner + outer * outer);
    double sum = 0.0;
    int count = 0;
    for (OstLocal node = 0; node < pose->mesh->owned_nodes; node++) {
        const double *x = pose->mesh->coordinates + 3 * node;
        const double *u = pose->result.displacement + 3 * node;
        const double radius = hypot(x[0], x[1]);
        if (fabs(radius - inner) > 1e-6)
            continue;
        sum += pow((x[0] * u[0] + x[1] * u[1]) / radius / exact - 1.0, 2.0);
        count++;
    }
    return sqrt(sum / count);
}

/* Radial and hoop stress A (1 -+ b²/r²), A = a² / (b² - a²): root of the mean square over nodes, of the pressure. */
static double stress_error(const Pose *pose)
{
    double sum = 0.0;
    for (OstLocal node = 0; node < pose->mesh->owned_nodes; node++) {
        const double *x = pose->mesh->coordinates + 3 * node;
        const double *s = pose->result.node_stress + 6 * node;
        const double r = hypot(x[0], x[1]), c = x[0] / r, d = x[1] / r;
        const double radial = s[0] * c * c + s[1] * d * d + 2.0 * s[3] * c * d - (1.0 - 81.0 / (r * r)) / 8.0;
        const double hoop = s[0] * d * d + s[1] * c * c - 2.0 * s[3] * c * d - (1.0 + 81.0 / (r * r)) / 8.0;
        sum += radial * radial + hoop * hoop;
    }
    return sqrt(sum / (2.0 * pose->mesh->owned_nodes));
}

static void quadratic_tets_with_the_mean_are_right_at_any_poissons_ratio(void **state)
{
    static const double nu[3] = {0.49, 0.499, 0.4999};
    static const double exact[3] = {5.039925e-3, 5.06024925e-3, 5.062274992e-3}; /* u(a), from the formula */
    for (int n = 0; n < 3; n++) {
        Pose pose = make_pose(2, nu[n], 1);
        assert_close(displacement_error(&pose, nu[n]), 0.0, 5e-4);
        assert_close(stress_error(&pose), 0.0, 0.02);
        assert_close((1.0 + nu[n]) * 3.0 / 72000.0 * ((1.0 - 2.0 * nu[n]) * 9.0 + 81.0) / exact[n], 1.0, 1e-9);
        destroy(&pose);
    }
}

/* What the remedy is for: without it displacements are passable on this mesh, stresses are not. */
static void the_mean_is_what_makes_stresses_right(void **state)
{
    Pose whole = make_pose(2, 0.4999, 0);
    Pose split = make_pose(2, 0.4999, 1);
    assert_true(stress_error(&whole) > 1.0);
    assert_true(stress_error(&split) < 0.01 * stress_error(&whole));
    assert_true(displacement_error(&split, 0.4999) < 0.5 * displacement_error(&whole, 0.4999));
    destroy(&whole);
    destroy(&split);
}

static void linear_tets_lock_and_the_mean_is_nothing_to_them(void **state)
{
    Pose whole = make_pose(1, 0.4999, 0);
    Pose split = make_pose(1, 0.4999, 1);
    assert_true(displacement_error(&whole, 0.4999) > 0.1);
    assert_memory_equal(split.result.displacement, whole.result.displacement,
                        3 * (size_t)whole.mesh->node_count * sizeof(double));
    destroy(&whole);
    destroy(&split);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(quadratic_tets_with_the_mean_are_right_at_any_poissons_ratio),
    cmocka_unit_test(the_mean_is_what_makes_stresses_right),
    cmocka_unit_test(linear_tets_lock_and_the_mean_is_nothing_to_them),
};

OST_TEST_MAIN(tests)
