/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

/* The system with its supports: given displacements, slides, the way back to displacements, what multigrid is told. */

static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const double oblique[3] = {1.0, 2.0, -1.0};

/* u = linear x */
static const double linear[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};

static void displacement_at(const double *x, double u[3])
{
    ost_apply3(linear, x, u);
}

static void hold_surface_to_linear_field(const OstMesh *mesh, OstSupports *supports)
{
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node;
        double u[3];
        displacement_at(x, u);
        for (int i = 0; i < 3 && is_on_surface(x); i++)
            assert_success(ost_supports_constrain(supports, node, unit[i], u[i]));
    }
    assert_success(ost_supports_complete(supports));
}

static void check_patch(AxesOfBody axes)
{
    OstMesh *mesh = make_body(ctx);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, axes);
    OstSupports *supports = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    hold_surface_to_linear_field(mesh, supports);
    OstSystem *system = make_system(mesh, supports, field);
    assert_int_equal(system->matrix->global_rows, (NX - 1) * (NY - 1) * (NZ - 1));
    double *force = numbers(3 * (size_t)mesh->node_count);
    double *rhs = numbers(3 * (size_t)system->matrix->rows);
    double *v = numbers(3 * (size_t)system->matrix->rows);
    double *u = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_system_right_hand_side(system, field, 0.0, force, rhs));
    solve(ctx, system->matrix, rhs, v);
    assert_success(ost_system_displacement(system, 1.0, v, u));
    for (OstLocal node = 0; node < mesh->node_count; node++) { /* ghosts too */
        double expected[3];
        displacement_at(mesh->coordinates + 3 * node, expected);
        for (int i = 0; i < 3; i++)
            assert_close(u[3 * node + i], expected[i], 1e-10);
    }
    assert_success(ost_internal_force(mesh, field, 0.0, u, force, NULL));
    const double size = largest(ctx, 3 * mesh->owned_nodes, force);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3 && !is_on_surface(mesh->coordinates + 3 * node); i++)
            assert_close(force[3 * node + i] / size, 0.0, 1e-12);
    free(force);
    free(rhs);
    free(v);
    free(u);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static void a_linear_field_passes_the_patch_test(void **state)
{
    check_patch(AXES_FIXED);
    check_patch(AXES_SAME_BY_TET);
}

/* A body with every kind of support: fixed, given, slides on an oblique plane with a displacement along its normal. */
typedef struct Held {
    OstMesh *mesh;
    OstMaterialField *field;
    OstSupports *supports;
    OstSystem *system;
} Held;

static Held make_held(OstContext *of, int hold_all_of_bottom, double along_normal)
{
    Held held = {.mesh = make_body(of)};
    const OstMesh *mesh = held.mesh;
    const OstMaterial material = make_material(of, 1);
    held.field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    assert_success(ost_supports_create(mesh, &held.supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node;
        if (x[0] < 1e-12)
            for (int i = 0; i < (hold_all_of_bottom ? 3 : 2); i++)
                assert_success(ost_supports_constrain(held.supports, node, unit[i], 0.0));
        else if (x[0] > size_of_body[0] - 1e-12)
            assert_success(ost_supports_constrain(held.supports, node, oblique, along_normal));
    }
    assert_success(ost_supports_complete(held.supports));
    held.system = make_system(mesh, held.supports, held.field);
    return held;
}

static void destroy(Held *held)
{
    ost_system_destroy(&held->system);
    ost_supports_destroy(&held->supports);
    ost_field_destroy(&held->field);
    ost_mesh_destroy(&held->mesh);
}

/* A v = P K (P v) + s (I - P) v with K the unsupported body's, and s the mean stiffness of the free directions. */
static void partly_held_nodes_keep_what_is_free(void **state)
{
    Held held = make_held(ctx, 0, 0.0);
    const OstMesh *mesh = held.mesh;
    const OstLocal n = mesh->owned_nodes;
    OstSupports *none = NULL;
    assert_success(ost_supports_create(mesh, &none));
    OstSystem *free_system = make_system(mesh, none, held.field);
    assert_int_equal(held.system->matrix->global_rows, mesh->global_nodes); /* nothing is fully held */
    double *v = numbers(3 * (size_t)mesh->node_count);
    double *pv = numbers(3 * (size_t)mesh->node_count);
    double *kpv = numbers(3 * (size_t)n);
    double *av = numbers(3 * (size_t)n);
    for (OstLocal i = 0; i < 3 * n; i++)
        v[i] = random_of(mesh->node_label[i / 3], i % 3);
    for (OstLocal node = 0; node < n; node++) {
        double p[9], g[3];
        ost_supports_get(held.supports, node, p, g);
        ost_apply3(p, v + 3 * node, pv + 3 * node);
    }
    assert_success(ost_block_matrix_apply(held.system->matrix, v, av));
    assert_success(ost_block_matrix_apply(free_system->matrix, pv, kpv));
    const double size = largest(ctx, 3 * n, kpv);
    for (OstLocal node = 0; node < n; node++) {
        const double *diagonal = free_system->matrix->value + 9 * free_system->matrix->diagonal[node];
        double p[9], g[3], expected[3], pk[9], pkp[9];
        const int directions = ost_supports_get(held.supports, node, p, g);
        ost_apply3(p, kpv + 3 * node, expected);
        ost_multiply3(p, diagonal, pk);
        ost_multiply3(pk, p, pkp);
        const double s = (pkp[0] + pkp[4] + pkp[8]) / (3 - directions);
        assert_true(s > 0.0);
        for (int i = 0; i < 3; i++)
            assert_close(av[3 * node + i] / size, (expected[i] + s * (v[3 * node + i] - pv[3 * node + i])) / size,
                         1e-13);
    }
    free(v);
    free(pv);
    free(kpv);
    free(av);
    ost_system_destroy(&free_system);
    ost_supports_destroy(&none);
    destroy(&held);
}

static void the_right_hand_side_is_minus_k_g(void **state)
{
    const long before = ost_ledger_entry(ctx, OST_EFFECT_PRESCRIBED_DISPLACEMENT).entries;
    Held held = make_held(ctx, 1, 0.25);
    const OstMesh *mesh = held.mesh;
    OstSupports *none = NULL;
    assert_success(ost_supports_create(mesh, &none));
    OstSystem *free_system = make_system(mesh, none, held.field);
    double *force = numbers(3 * (size_t)mesh->node_count);
    double *g = numbers(3 * (size_t)mesh->node_count);
    double *kg = numbers(3 * (size_t)mesh->owned_nodes);
    double *rhs = numbers(3 * (size_t)held.system->matrix->rows);
    for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
        force[i] = random_of(mesh->node_label[i / 3], 20 + i % 3);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        double p[9];
        ost_supports_get(held.supports, node, p, g + 3 * node);
    }
    assert_success(ost_block_matrix_apply(free_system->matrix, g, kg));
    assert_success(ost_system_right_hand_side(held.system, held.field, 0.0, force, rhs));
    const double size = largest(ctx, 3 * mesh->owned_nodes, kg);
    assert_true(size > 1.0);
    for (OstLocal row = 0; row < held.system->matrix->rows; row++) {
        const OstLocal node = held.system->node_of_row[row];
        double p[9], given[3], expected[3];
        const double whole[3] = {force[3 * node] - kg[3 * node], force[3 * node + 1] - kg[3 * node + 1],
                                 force[3 * node + 2] - kg[3 * node + 2]};
        ost_supports_get(held.supports, node, p, given);
        ost_apply3(p, whole, expected);
        for (int i = 0; i < 3; i++)
            assert_close(rhs[3 * row + i] / size, expected[i] / size, 1e-13);
    }
    const int moved = ost_ledger_entry(ctx, OST_EFFECT_PRESCRIBED_DISPLACEMENT).entries > before;
    assert_true(sum_over_ranks(ctx, moved) > 0.0);
    free(force);
    free(g);
    free(kg);
    free(rhs);
    ost_system_destroy(&free_system);
    ost_supports_destroy(&none);
    destroy(&held);
}

static void effects_that_are_off_are_not_entered(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    OstSupports *supports = NULL;
    const long given = ost_ledger_entry(ctx, OST_EFFECT_PRESCRIBED_DISPLACEMENT).entries;
    const long sliding = ost_ledger_entry(ctx, OST_EFFECT_SLIDING).entries;
    assert_success(ost_supports_create(mesh, &supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        if (mesh->coordinates[3 * node] < 1e-12)
            for (int i = 0; i < 2; i++) /* free along z, held along coordinates: no slide */
                assert_success(ost_supports_constrain(supports, node, unit[i], 0.0));
    assert_success(ost_supports_complete(supports));
    OstSystem *system = make_system(mesh, supports, field);
    double *force = numbers(3 * (size_t)mesh->node_count);
    double *rhs = numbers(3 * (size_t)system->matrix->rows);
    assert_success(ost_system_right_hand_side(system, field, 0.0, force, rhs));
    assert_int_equal(ost_ledger_entry(ctx, OST_EFFECT_PRESCRIBED_DISPLACEMENT).entries, given);
    assert_int_equal(ost_ledger_entry(ctx, OST_EFFECT_SLIDING).entries, sliding);
    free(force);
    free(rhs);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* u = P v + g: what is held is where it was given, whatever v is. */
static void displacements_obey_the_supports(void **state)
{
    Held held = make_held(ctx, 1, 0.25);
    const OstMesh *mesh = held.mesh;
    const OstBlockMatrix *matrix = held.system->matrix;
    double *v = numbers(3 * (size_t)matrix->rows);
    double *u = numbers(3 * (size_t)mesh->node_count);
    for (OstLocal i = 0; i < 3 * matrix->rows; i++)
        v[i] = random_of(mesh->node_label[held.system->node_of_row[i / 3]], i % 3);
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        u[i] = NAN;
    assert_success(ost_system_displacement(held.system, 1.0, v, u));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        const double *x = mesh->coordinates + 3 * node;
        const double free_part[3] = {random_of(mesh->node_label[node], 0), random_of(mesh->node_label[node], 1),
                                     random_of(mesh->node_label[node], 2)};
        for (int i = 0; i < 3; i++) {
            if (x[0] < 1e-12)
                assert_close(u[3 * node + i], 0.0, 0.0);
            else if (x[0] < size_of_body[0] - 1e-12)
                assert_close(u[3 * node + i], free_part[i], 0.0);
        }
        if (x[0] > size_of_body[0] - 1e-12)
            assert_close(ost_dot3(u + 3 * node, oblique) / ost_norm3(oblique), 0.25, 1e-14);
    }
    free(v);
    free(u);
    destroy(&held);
}

/* Matrix and right-hand side by label, on this many ranks and on one. */
static void ranks_agree_with_one_rank(void **state)
{
    double *product[2];
    double *side[2];
    OstContext *alone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    for (int one = 0; one < 2; one++) {
        Held held = make_held(one ? alone : ctx, 1, 0.25);
        const OstMesh *mesh = held.mesh;
        const OstBlockMatrix *matrix = held.system->matrix;
        double *nodal[2] = {numbers(3 * (size_t)mesh->node_count), numbers(3 * (size_t)mesh->node_count)};
        double *force = numbers(3 * (size_t)mesh->node_count);
        double *v = numbers(3 * (size_t)matrix->columns);
        double *av = numbers(3 * (size_t)matrix->rows);
        double *rhs = numbers(3 * (size_t)matrix->rows);
        for (OstLocal i = 0; i < 3 * matrix->rows; i++)
            v[i] = random_of(mesh->node_label[held.system->node_of_row[i / 3]], i % 3);
        assert_success(ost_block_matrix_apply(matrix, v, av));
        assert_success(ost_system_right_hand_side(held.system, held.field, 0.0, force, rhs));
        for (OstLocal i = 0; i < 3 * matrix->rows; i++) {
            nodal[0][3 * held.system->node_of_row[i / 3] + i % 3] = av[i];
            nodal[1][3 * held.system->node_of_row[i / 3] + i % 3] = rhs[i];
        }
        product[one] = by_label(mesh, nodal[0]);
        side[one] = by_label(mesh, nodal[1]);
        free(nodal[0]);
        free(nodal[1]);
        free(force);
        free(v);
        free(av);
        free(rhs);
        destroy(&held);
    }
    const OstLocal count = 3 * (NX + 1) * (NY + 1) * (NZ + 1);
    const double size = largest(ctx, count, product[1]);
    const double side_size = largest(ctx, count, side[1]);
    for (OstLocal i = 0; i < count; i++) {
        assert_close(product[0][i] / size, product[1][i] / size, 1e-12);
        assert_close(side[0][i] / side_size, side[1][i] / side_size, 1e-12);
    }
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
    for (int one = 0; one < 2; one++) {
        free(product[one]);
        free(side[one]);
    }
}

/* Without supports, K times each mode is nothing, over all ranks: so the modes turn about one common point. */
static void multigrid_is_told_the_rigid_motions(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    OstSupports *none = NULL;
    assert_success(ost_supports_create(mesh, &none));
    OstSystem *system = make_system(mesh, none, field);
    const OstBlockMatrix *matrix = system->matrix;
    const size_t length = 3 * (size_t)matrix->rows;
    double *coordinates = numbers(length);
    double *metric = numbers(2 * length);
    double *modes = numbers(6 * length);
    double *x = numbers(3 * (size_t)matrix->columns);
    double *force = numbers(length);
    assert_success(ost_system_geometry(system, field, coordinates, metric, modes));
    const double stiffest = largest(ctx, 9 * matrix->row_start[matrix->rows], matrix->value);
    for (int m = 0; m < 6; m++) {
        memcpy(x, modes + (size_t)m * length, length * sizeof *x);
        assert_true(largest(ctx, (OstLocal)length, x) > 0.4);
        assert_success(ost_block_matrix_apply(matrix, x, force));
        assert_close(largest(ctx, (OstLocal)length, force) / stiffest, 0.0, 1e-13);
    }
    for (OstLocal row = 0; row < matrix->rows; row++) {
        /* trace: the same for every tet; here sqrt(10/1000) + sqrt(10/10) + sqrt(10/50) */
        assert_close(metric[6 * row] + metric[6 * row + 1] + metric[6 * row + 2], 0.1 + 1.0 + sqrt(0.2), 1e-14);
        for (int i = 0; i < 3; i++)
            assert_close(coordinates[3 * row + i], mesh->coordinates[3 * system->node_of_row[row] + i], 0.0);
    }
    free(coordinates);
    free(metric);
    free(modes);
    free(x);
    free(force);
    ost_system_destroy(&system);
    ost_supports_destroy(&none);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* One orientation in all tets: the mean is that of one tet, R' diag(sqrt(E_min / E_k)) R. */
static void the_metric_of_one_orientation_is_its_own_mean(void **state)
{
    static const double weight[3] = {0.1, 1.0, 0.44721359549995793928}; /* E = 1000, 10, 50 */
    OstMesh *mesh = make_body(ctx);
    const OstMaterial materials[2] = {make_material(ctx, 0), make_material(ctx, 1)};
    OstSupports *none = NULL;
    double axes[9];
    axes_of(7, axes);
    assert_success(ost_supports_create(mesh, &none));
    for (int orthotropic = 0; orthotropic < 2; orthotropic++) {
        OstMaterialField *field = make_field(mesh, &materials[orthotropic], AXES_FIXED);
        OstSystem *system = make_system(mesh, none, field);
        double *coordinates = numbers(3 * (size_t)system->matrix->rows);
        double *metric = numbers(6 * (size_t)system->matrix->rows);
        double *modes = numbers(18 * (size_t)system->matrix->rows);
        assert_success(ost_system_geometry(system, field, coordinates, metric, modes));
        for (OstLocal row = 0; row < system->matrix->rows; row++)
            for (int p = 0; p < 6; p++) {
                const int i = p % 3;
                const int j = p < 3 ? i : (i + 1) % 3;
                double expected = 0.0;
                for (int k = 0; k < 3; k++)
                    expected += (orthotropic ? weight[k] : 1.0) * axes[3 * k + i] * axes[3 * k + j];
                assert_close(metric[6 * row + p], expected, 1e-14);
            }
        free(coordinates);
        free(metric);
        free(modes);
        ost_system_destroy(&system);
        ost_field_destroy(&field);
    }
    ost_supports_destroy(&none);
    ost_mesh_destroy(&mesh);
}

static void modes_stay_clear_of_held_directions(void **state)
{
    Held held = make_held(ctx, 1, 0.0);
    const OstBlockMatrix *matrix = held.system->matrix;
    const size_t length = 3 * (size_t)matrix->rows;
    double *coordinates = numbers(length);
    double *modes = numbers(6 * length);
    assert_success(ost_system_geometry(held.system, held.field, coordinates, NULL, modes));
    for (OstLocal row = 0; row < matrix->rows; row++)
        for (size_t m = 0; m < 6 && coordinates[3 * row] > size_of_body[0] - 1e-12; m++)
            assert_close(ost_dot3(modes + m * length + 3 * (size_t)row, oblique), 0.0, 1e-14);
    free(coordinates);
    free(modes);
    destroy(&held);
}

static void tets_of_other_orders_are_refused(void **state)
{
    OstMesh *mesh = make_body(ctx);
    OstSupports *none = NULL;
    OstSystem *system = NULL;
    assert_success(ost_supports_create(mesh, &none));
    mesh->nodes_per_tet = 20;
    assert_failure(ost_system_create(mesh, none, &system), OST_INVALID_INPUT, "tets of 20 nodes; 4 or 10 are expected");
    assert_null(system);
    mesh->nodes_per_tet = 4;
    ost_supports_destroy(&none);
    ost_mesh_destroy(&mesh);
}

static void a_body_without_a_free_vertex_is_refused(void **state)
{
    OstMesh *mesh = make_body(ctx);
    OstSupports *supports = NULL;
    OstSystem *system = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3; i++)
            assert_success(ost_supports_constrain(supports, node, unit[i], 0.0));
    assert_success(ost_supports_complete(supports));
    assert_failure(ost_system_create(mesh, supports, &system), OST_INVALID_INPUT, "nothing to solve for");
    assert_null(system);
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_linear_field_passes_the_patch_test),
    cmocka_unit_test(partly_held_nodes_keep_what_is_free),
    cmocka_unit_test(the_right_hand_side_is_minus_k_g),
    cmocka_unit_test(effects_that_are_off_are_not_entered),
    cmocka_unit_test(displacements_obey_the_supports),
    cmocka_unit_test(ranks_agree_with_one_rank),
    cmocka_unit_test(multigrid_is_told_the_rigid_motions),
    cmocka_unit_test(the_metric_of_one_orientation_is_its_own_mean),
    cmocka_unit_test(modes_stay_clear_of_held_directions),
    cmocka_unit_test(tets_of_other_orders_are_refused),
    cmocka_unit_test(a_body_without_a_free_vertex_is_refused),
};

OST_TEST_MAIN(tests)
