/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

#include "algebra/solver.h"
#include "orthostat/refine.h"

/* Assembly, loads and supports on quadratic tets, straight and curved. */

static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* The irregular body with middles added; `bend` moves inner ones off their edges. */
static OstMesh *make_quadratic_body(OstContext *of, double bend)
{
    OstMesh *linear = make_body(of);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_raise(linear, NULL, &mesh));
    ost_mesh_destroy(&linear);
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double *x = mesh->coordinates + 3 * node;
        if (!is_on_surface(x))
            for (int i = 0; i < 3; i++)
                x[i] += bend * random_of(mesh->node_label[node], 20 + i);
    }
    return mesh;
}

static void quadratic_at(const double *x, double u[3])
{
    u[0] = 0.1 * x[0] * x[0] + 0.2 * x[1] * x[2] - 0.1 * x[1];
    u[1] = 0.3 * x[0] * x[2] - 0.2 * x[1] * x[1] + 0.05 * x[0];
    u[2] = 0.1 * x[2] * x[2] - 0.3 * x[0] * x[1] + 0.2 * x[0] * x[0];
}

static void linear_at(const double *x, double u[3])
{
    static const double slope[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};
    ost_apply3(slope, x, u);
}

/* Force per volume that holds the quadratic field: minus the divergence of C strain, C in world axes. */
static void body_force_of_quadratic(const double c[36], double force[3])
{
    /* d strain / d x, y, z */
    static const double slope[3][6] = {{0.2, 0, 0, 0, 0.3 - 0.3, 0.4}, {0, -0.4, 0, 0, 0, -0.3}, {0, 0, 0.2, 0, 0, 0}};
    static const int of[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    double with_mixed[3][6];
    memcpy(with_mixed, slope, sizeof slope);
    with_mixed[2][3] = 0.2 + 0.3; /* u_x,yz + u_y,xz */
    with_mixed[1][5] = 0.2 - 0.3; /* u_x,zy + u_z,xy: both of u_x,z + u_z,x */
    with_mixed[0][4] = 0.3 - 0.3; /* u_y,zx + u_z,yx */
    for (int i = 0; i < 3; i++) {
        force[i] = 0.0;
        for (int j = 0; j < 3; j++)
            for (int q = 0; q < 6; q++)
                force[i] -= c[6 * of[i][j] + q] * with_mixed[j][q];
    }
}

typedef struct Pose {
    OstMesh *mesh;
    OstMaterialField *field;
    OstSupports *supports;
    OstSystem *system;
    double *force, *u;
} Pose;

static void solve_directly(const OstBlockMatrix *matrix, const double *rhs, double *v)
{
    const OstSolverGeometry nothing = {.coordinates = NULL};
    OstSolverOptions options = ost_solver_default_options();
    OstSolver *solver = NULL;
    OstSolveReport report;
    options.method = OST_METHOD_DIRECT;
    options.relative_residual = 1e-12;
    assert_success(ost_solver_create(ctx, matrix, &nothing, &options, &solver));
    assert_success(ost_solver_solve(solver, rhs, v, &report));
    ost_solver_destroy(&solver);
}

/* Solves with the surface held to the field given, under the loads in pose->force. */
static void solve_pose(Pose *pose, void (*at)(const double *, double *))
{
    OstMesh *mesh = pose->mesh;
    assert_success(ost_supports_create(mesh, &pose->supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        double u[3];
        at(mesh->coordinates + 3 * node, u);
        for (int i = 0; i < 3 && is_on_surface(mesh->coordinates + 3 * node); i++)
            assert_success(ost_supports_constrain(pose->supports, node, unit[i], u[i]));
    }
    assert_success(ost_supports_complete(pose->supports));
    pose->system = make_system(mesh, pose->supports, pose->field);
    double *rhs = numbers(3 * (size_t)pose->system->matrix->rows);
    double *v = numbers(3 * (size_t)pose->system->matrix->rows);
    pose->u = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_system_right_hand_side(pose->system, pose->field, 0.0, pose->force, rhs));
    solve_directly(pose->system->matrix, rhs, v);
    assert_success(ost_system_displacement(pose->system, 1.0, v, pose->u));
    free(rhs);
    free(v);
}

static void destroy(Pose *pose)
{
    free(pose->force);
    free(pose->u);
    ost_system_destroy(&pose->system);
    ost_supports_destroy(&pose->supports);
    ost_field_destroy(&pose->field);
    ost_mesh_destroy(&pose->mesh);
}

static void assert_field(const Pose *pose, void (*at)(const double *, double *))
{
    for (OstLocal node = 0; node < pose->mesh->node_count; node++) {
        double expected[3];
        at(pose->mesh->coordinates + 3 * node, expected);
        for (int i = 0; i < 3; i++)
            assert_close(pose->u[3 * node + i], expected[i], 1e-10);
    }
}

static OstMaterial nearly_incompressible(OstContext *of)
{
    const double modulus[3] = {1000.0, 10.0, 50.0};
    const OstOrthotropic constants = ost_orthotropic_family(modulus, 0.499, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    assert_success(ost_material_create(of, "rubber", &constants, 3.0, &material));
    return material;
}

/* Rotated orthotropic axes; straight and curved tets; C whole, and split. */
static void a_linear_field_passes_the_patch_test(void **state)
{
    for (int kind = 0; kind < 4; kind++) {
        Pose pose = {.mesh = make_quadratic_body(ctx, kind % 2 == 0 ? 0.0 : 0.03)};
        const OstMaterial material = kind < 2 ? make_material(ctx, 1) : nearly_incompressible(ctx);
        pose.field = make_field(pose.mesh, &material, kind == 0 ? AXES_SAME_BY_TET : AXES_FIXED);
        if (kind >= 2) {
            int regions = 0;
            assert_success(ost_field_mean_dilatation(pose.field, OST_NEARLY_INCOMPRESSIBLE, &regions));
            assert_int_equal(regions, 1);
        }
        pose.force = numbers(3 * (size_t)pose.mesh->node_count);
        solve_pose(&pose, linear_at);
        assert_field(&pose, linear_at);
        destroy(&pose);
    }
}

static void a_quadratic_field_is_exact_on_straight_tets(void **state)
{
    Pose pose = {.mesh = make_quadratic_body(ctx, 0.0)};
    const OstMaterial material = make_material(ctx, 1);
    double axes[9], c[36], density[3];
    pose.field = make_field(pose.mesh, &material, AXES_FIXED);
    pose.force = numbers(3 * (size_t)pose.mesh->node_count);
    axes_of(7, axes);
    ost_material_rotate_stiffness(material.stiffness, axes, c);
    body_force_of_quadratic(c, density);
    assert_success(ost_load_body_force(pose.mesh, -1, density, pose.force));
    solve_pose(&pose, quadratic_at);
    assert_field(&pose, quadratic_at);
    destroy(&pose);
}

static void rigid_motions_meet_no_force(void **state)
{
    for (int kind = 0; kind < 2; kind++) {
        OstMesh *mesh = make_quadratic_body(ctx, 0.03);
        const OstMaterial material = kind == 0 ? make_material(ctx, 1) : nearly_incompressible(ctx);
        OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
        OstSupports *none = NULL;
        int regions = 0;
        assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
        assert_int_equal(regions, kind);
        assert_success(ost_supports_create(mesh, &none));
        OstSystem *system = make_system(mesh, none, field);
        double *u = numbers(3 * (size_t)mesh->node_count);
        double *force = numbers(3 * (size_t)mesh->owned_nodes);
        const double stiffest =
            largest(ctx, 9 * system->matrix->row_start[system->matrix->rows], system->matrix->value);
        for (int mode = 0; mode < 6; mode++) {
            for (OstLocal i = 0; i < 3 * mesh->node_count; i++) {
                const double *x = mesh->coordinates + i / 3 * 3;
                const int first = mode % 3, next = (mode + 1) % 3;
                u[i] = mode < 3 ? i % 3 == mode : i % 3 == next ? x[first] : i % 3 == first ? -x[next] : 0.0;
            }
            assert_success(ost_internal_force(mesh, field, 0.0, u, force, NULL));
            assert_close(largest(ctx, 3 * mesh->owned_nodes, force) / stiffest, 0.0, 1e-12);
            assert_success(ost_block_matrix_apply(system->matrix, u, force));
            assert_close(largest(ctx, 3 * mesh->owned_nodes, force) / stiffest, 0.0, 1e-12);
        }
        free(u);
        free(force);
        ost_system_destroy(&system);
        ost_supports_destroy(&none);
        ost_field_destroy(&field);
        ost_mesh_destroy(&mesh);
    }
}

/* x·Ky = y·Kx over ranks, Ku is the force summed tet by tet, and the energy is positive; also far from the origin. */
static void check_matrix(double bend, double away, int split)
{
    OstMesh *mesh = make_quadratic_body(ctx, bend);
    const OstMaterial material = split ? nearly_incompressible(ctx) : make_material(ctx, 1);
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        mesh->coordinates[i] += away;
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    OstSupports *none = NULL;
    int regions = 0;
    assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
    assert_success(ost_supports_create(mesh, &none));
    OstSystem *system = make_system(mesh, none, field);
    const OstLocal owned = 3 * mesh->owned_nodes;
    double *x = numbers(3 * (size_t)mesh->node_count);
    double *y = numbers(3 * (size_t)mesh->node_count);
    double *kx = numbers((size_t)owned);
    double *ky = numbers((size_t)owned);
    double *force = numbers((size_t)owned);
    double *magnitude = numbers((size_t)owned);
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++) {
        x[i] = random_of(mesh->node_label[i / 3], i % 3);
        y[i] = random_of(mesh->node_label[i / 3], 3 + i % 3);
    }
    assert_success(ost_block_matrix_apply(system->matrix, x, kx));
    assert_success(ost_block_matrix_apply(system->matrix, y, ky));
    const double xkx = dot(ctx, owned, x, kx);
    assert_true(xkx > 0.0);
    assert_close(dot(ctx, owned, x, ky) / xkx, dot(ctx, owned, y, kx) / xkx, 1e-13);
    assert_success(ost_internal_force(mesh, field, 0.0, x, force, magnitude));
    const double size = largest(ctx, owned, force);
    for (OstLocal i = 0; i < owned; i++) {
        assert_close(kx[i] / size, force[i] / size, 1e-12);
        assert_true(fabs(force[i]) <= magnitude[i]);
    }
    free(x);
    free(y);
    free(kx);
    free(ky);
    free(force);
    free(magnitude);
    ost_system_destroy(&system);
    ost_supports_destroy(&none);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static void the_matrix_is_symmetric_and_gives_the_forces_of_the_tets(void **state)
{
    check_matrix(0.03, 0.0, 0);
    check_matrix(0.03, 0.0, 1);
    check_matrix(0.0, 1048576.0, 0);
}

static const OstTubeShape ring = {.axis = 2, .length = 0.5, .radii = {1.0, 2.0}, .around = 8, .radial = 2, .axial = 1};

static OstMesh *make_ring(OstContext *of, int refinement)
{
    OstTubeShape shape = ring;
    OstMeshChunk *chunk = NULL;
    OstMesh *linear = NULL, *mesh = NULL;
    shape.around *= refinement;
    shape.radial *= refinement;
    const OstShapeSurface surface = ost_shape_surface_tube(&shape);
    assert_success(ost_chunk_create_tube(of, &shape, &chunk));
    assert_success(ost_mesh_distribute(of, &chunk, &linear));
    assert_success(ost_mesh_raise(linear, &surface, &mesh));
    ost_mesh_destroy(&linear);
    return mesh;
}

static double surface_area(const OstMesh *mesh)
{
    OstSurface *surface = NULL;
    double area = 0.0;
    assert_success(ost_surface_create(mesh, NULL, &surface));
    assert_int_equal(surface->nodes_per_face, 6);
    assert_success(ost_faces_area(mesh, surface->count, surface->nodes, 6, &area));
    ost_surface_destroy(&surface);
    return area;
}

/* The weight of a body of density 3 under unit acceleration is three times its volume. */
static double volume_of(OstMesh *mesh)
{
    const OstMaterial material = make_material(ctx, 0);
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    double *force = numbers(3 * (size_t)mesh->node_count);
    double weight = 0.0;
    assert_success(ost_load_gravity(mesh, field, -1, unit[1], force));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        weight += force[3 * node + 1];
    free(force);
    ost_field_destroy(&field);
    return sum_over_ranks(ctx, weight) / 3.0;
}

static void area_and_volume_of_a_curved_ring_converge_with_order_four(void **state)
{
    const double pi = 3.14159265358979323846;
    double area_error[2], volume_error[2];
    for (int r = 0; r < 2; r++) {
        OstMesh *mesh = make_ring(ctx, r + 1);
        area_error[r] = fabs(surface_area(mesh) / (2.0 * pi * 3.0 + 2.0 * pi * 3.0 * 0.5) - 1.0);
        volume_error[r] = fabs(volume_of(mesh) / (1.5 * pi) - 1.0);
        ost_mesh_destroy(&mesh);
    }
    assert_true(area_error[1] < 1e-4 && area_error[1] < area_error[0] / 14.0);
    assert_true(volume_error[1] < 1e-4 && volume_error[1] < volume_error[0] / 14.0);
}

static void pressure_on_a_closed_curved_surface_is_in_balance(void **state)
{
    OstMesh *mesh = make_ring(ctx, 1);
    OstSurface *surface = NULL;
    double sum[6];
    double *force = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_surface_create(mesh, NULL, &surface));
    assert_success(ost_load_pressure(mesh, surface->count, surface->nodes, 6, 7.0, force));
    assert_true(largest(ctx, 3 * mesh->owned_nodes, force) > 0.1);
    resultant(mesh, force, sum);
    for (int i = 0; i < 6; i++)
        assert_close(sum[i], 0.0, 1e-12);
    ost_surface_destroy(&surface);
    free(force);
    ost_mesh_destroy(&mesh);
}

static void a_traction_has_the_force_and_moment_of_its_face(void **state)
{
    OstMesh *mesh = make_quadratic_body(ctx, 0.0);
    const OstBoundary *boundary = &mesh->boundaries[ost_mesh_find_boundary(mesh, "xmax")];
    const double traction[3] = {3.0, -1.0, 0.5};
    const double area = 1.5 * 1.2;
    OstLocal *faces = calloc(6 * (size_t)boundary->count + 1, sizeof *faces);
    double *force = numbers(3 * (size_t)mesh->node_count);
    double sum[6], moment[3];
    assert_int_equal(boundary->nodes_per_item, 6);
    for (OstLocal i = 0; i < 6 * boundary->count; i++)
        faces[i] = (OstLocal)boundary->nodes[i];
    assert_success(ost_load_traction(mesh, boundary->count, faces, 6, traction, force));
    resultant(mesh, force, sum);
    ost_cross3((const double[3]){2.0, 0.75, 0.6}, traction, moment); /* the face's middle */
    for (int i = 0; i < 3; i++) {
        assert_close(sum[i], traction[i] * area, 1e-12);
        assert_close(sum[3 + i], moment[i] * area, 1e-12);
    }
    assert_failure(ost_load_traction(mesh, boundary->count, faces, 3, traction, force), OST_INVALID_INPUT,
                   "faces of 3 nodes");
    free(faces);
    free(force);
    ost_mesh_destroy(&mesh);
}

static OstMaterialField *field_of_ring(const OstMesh *mesh, int at_points)
{
    const OstOrthotropic constants = {
        .youngs_modulus = {10.0, 100.0, 10.0}, .poissons_ratio = {0.03, 0.3, 0.3}, .shear_modulus = {3.0, 5.0, 4.0}};
    const OstAxesSpec formula = {
        .kind = OST_AXES_CYLINDRICAL, .axis = {0, 0, 1}, .order = {OST_RADIAL, OST_TANGENTIAL, OST_AXIAL}};
    const OstAxesSpec by_tet = {.kind = OST_AXES_CELLS};
    OstMaterial material;
    OstMaterialField *field = NULL;
    double *centroids = numbers(3 * (size_t)mesh->tet_count);
    double *given = numbers(9 * (size_t)mesh->tet_count);
    assert_success(ost_material_create(mesh->ctx, "wood", &constants, 0.0, &material));
    assert_success(ost_mesh_tet_centroids(mesh, centroids));
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++)
        assert_success(ost_axes_at(mesh->ctx, &formula, centroids + 3 * tet, given + 9 * tet));
    assert_success(ost_field_create(mesh->ctx, NULL, 1, &material, at_points ? &formula : &by_tet, mesh->tet_count,
                                    mesh->tet_region, mesh->tet_label, centroids, given, &field));
    free(centroids);
    free(given);
    return field;
}

/* Energy of a smooth displacement (its values at the nodes) in a ring with cylindrical axes. */
static double ring_energy(OstContext *of, int refinement, int at_points)
{
    OstMesh *mesh = make_ring(of, refinement);
    OstMaterialField *field = field_of_ring(mesh, at_points);
    double *u = numbers(3 * (size_t)mesh->node_count);
    double *force = numbers(3 * (size_t)mesh->owned_nodes);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        quadratic_at(mesh->coordinates + 3 * node, u + 3 * node);
    assert_success(ost_internal_force(mesh, field, 0.0, u, force, NULL));
    const double energy = 0.5 * dot(of, 3 * mesh->owned_nodes, u, force);
    free(u);
    free(force);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
    return energy;
}

/* Order 2 with the axes of the centroids, order 4 with those of the points. */
static void axes_are_those_of_the_quadrature_points(void **state)
{
    const double reference = ring_energy(ctx, 6, 1);
    double error[2][2];
    for (int at_points = 0; at_points < 2; at_points++)
        for (int r = 0; r < 2; r++)
            error[at_points][r] = fabs(ring_energy(ctx, r + 1, at_points) / reference - 1.0);
    assert_true(error[0][1] > error[0][0] / 6.0);
    assert_true(error[1][1] < error[1][0] / 14.0);
    assert_true(error[1][1] < error[0][1] / 100.0);
}

/* Three numbers of each owned node, by label, on every rank; labels of middles leave gaps. */
static double *by_sparse_label(const OstMesh *mesh, const double *values, OstGlobal *highest)
{
    *highest = 0;
    for (OstLocal node = 0; node < mesh->node_count; node++)
        *highest = mesh->node_label[node] > *highest ? mesh->node_label[node] : *highest;
    MPI_Allreduce(MPI_IN_PLACE, highest, 1, MPI_INT64_T, MPI_MAX, ost_comm(mesh->ctx));
    double *all = numbers(3 * (size_t)*highest);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        memcpy(all + 3 * (mesh->node_label[node] - 1), values + 3 * node, 3 * sizeof *all);
    MPI_Allreduce(MPI_IN_PLACE, all, 3 * (int)*highest, MPI_DOUBLE, MPI_SUM, ost_comm(mesh->ctx));
    return all;
}

/* Forces by any number of ranks are those of one; curved, axes at points, C split. */
static void ranks_agree_with_one_rank(void **state)
{
    double *product[2];
    OstGlobal highest = 0;
    OstContext *alone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    for (int one = 0; one < 2; one++) {
        OstContext *of = one ? alone : ctx;
        OstMesh *mesh = make_ring(of, 1);
        OstMaterialField *field = field_of_ring(mesh, 1);
        OstSupports *none = NULL;
        int regions = 0;
        assert_success(ost_field_mean_dilatation(field, 0.1, &regions));
        assert_int_equal(regions, 1);
        assert_success(ost_supports_create(mesh, &none));
        OstSystem *system = make_system(mesh, none, field);
        double *u = numbers(3 * (size_t)mesh->node_count);
        double *force = numbers(3 * (size_t)mesh->owned_nodes);
        for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
            u[i] = random_of(mesh->node_label[i / 3], i % 3);
        assert_success(ost_block_matrix_apply(system->matrix, u, force));
        product[one] = by_sparse_label(mesh, force, &highest);
        free(u);
        free(force);
        ost_system_destroy(&system);
        ost_supports_destroy(&none);
        ost_field_destroy(&field);
        ost_mesh_destroy(&mesh);
    }
    const OstLocal count = (OstLocal)(3 * highest);
    const double size = largest(ctx, count, product[1]);
    for (OstLocal i = 0; i < count; i++)
        assert_close(product[0][i] / size, product[1][i] / size, 1e-12);
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
    free(product[0]);
    free(product[1]);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_linear_field_passes_the_patch_test),
    cmocka_unit_test(a_quadratic_field_is_exact_on_straight_tets),
    cmocka_unit_test(rigid_motions_meet_no_force),
    cmocka_unit_test(the_matrix_is_symmetric_and_gives_the_forces_of_the_tets),
    cmocka_unit_test(area_and_volume_of_a_curved_ring_converge_with_order_four),
    cmocka_unit_test(pressure_on_a_closed_curved_surface_is_in_balance),
    cmocka_unit_test(a_traction_has_the_force_and_moment_of_its_face),
    cmocka_unit_test(axes_are_those_of_the_quadrature_points),
    cmocka_unit_test(ranks_agree_with_one_rank),
};

OST_TEST_MAIN(tests)
