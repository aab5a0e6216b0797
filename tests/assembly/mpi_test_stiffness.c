/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

/* What the stiffness matrix must be, whatever the mesh, the material and the number of ranks. */

typedef struct Body {
    OstMesh *mesh;
    OstSupports *supports;
    OstMaterialField *field;
    OstSystem *system;
} Body;

/* Nothing is held: every node has a row. */
static Body make_free_body(int orthotropic, AxesOfBody axes)
{
    Body body = {.mesh = make_body(ctx)};
    const OstMaterial material = make_material(ctx, orthotropic);
    body.field = make_field(body.mesh, &material, axes);
    assert_success(ost_supports_create(body.mesh, &body.supports));
    body.system = make_system(body.mesh, body.supports, body.field);
    return body;
}

static void destroy(Body *body)
{
    ost_system_destroy(&body->system);
    ost_supports_destroy(&body->supports);
    ost_field_destroy(&body->field);
    ost_mesh_destroy(&body->mesh);
}

static void rigid_motion(const OstMesh *mesh, int mode, double *u)
{
    const int first = mode % 3;
    const int next = (mode + 1) % 3;
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        const double *x = mesh->coordinates + 3 * node;
        u[3 * node] = u[3 * node + 1] = u[3 * node + 2] = 0.0;
        if (mode < 3) {
            u[3 * node + mode] = 1.0;
        } else {
            u[3 * node + next] = x[first];
            u[3 * node + first] = -x[next];
        }
    }
}

static void rigid_motions_meet_no_force(void **state)
{
    Body body = make_free_body(1, AXES_RANDOM_BY_TET);
    const OstMesh *mesh = body.mesh;
    double *u = numbers(3 * (size_t)mesh->node_count);
    double *force = numbers(3 * (size_t)mesh->owned_nodes);
    const double stiffest =
        largest(ctx, 9 * body.system->matrix->row_start[body.system->matrix->rows], body.system->matrix->value);
    for (int mode = 0; mode < 6; mode++) {
        rigid_motion(mesh, mode, u);
        assert_success(ost_internal_force(mesh, body.field, 0.0, u, force, NULL));
        assert_close(largest(ctx, 3 * mesh->owned_nodes, force) / stiffest, 0.0, 1e-12);
        assert_success(ost_block_matrix_apply(body.system->matrix, u, force));
        assert_close(largest(ctx, 3 * mesh->owned_nodes, force) / stiffest, 0.0, 1e-12);
    }
    free(u);
    free(force);
    destroy(&body);
}

static void the_matrix_gives_the_forces_summed_tet_by_tet(void **state)
{
    Body body = make_free_body(1, AXES_RANDOM_BY_TET);
    const OstMesh *mesh = body.mesh;
    const size_t owned = 3 * (size_t)mesh->owned_nodes;
    double *u = numbers(3 * (size_t)mesh->node_count);
    double *by_tets = numbers(owned);
    double *by_matrix = numbers(owned);
    double *magnitude = numbers(owned);
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        u[i] = random_of(mesh->node_label[i / 3], i % 3);
    assert_success(ost_internal_force(mesh, body.field, 0.0, u, by_tets, NULL));
    assert_success(ost_block_matrix_apply(body.system->matrix, u, by_matrix));
    const double size = largest(ctx, (OstLocal)owned, by_tets);
    assert_true(size > 1.0);
    assert_success(ost_internal_force(mesh, body.field, 0.0, u, by_tets, magnitude));
    for (size_t i = 0; i < owned; i++)
        assert_true(fabs(by_tets[i]) <= magnitude[i] && magnitude[i] < 1e3 * size);
    for (size_t i = 0; i < owned; i++)
        assert_close(by_matrix[i] / size, by_tets[i] / size, 1e-13);
    free(u);
    free(by_tets);
    free(by_matrix);
    free(magnitude);
    destroy(&body);
}

static void rows_are_ascending_and_the_matrix_is_its_own_mirror_image(void **state)
{
    Body body = make_free_body(1, AXES_RANDOM_BY_TET);
    const OstBlockMatrix *matrix = body.system->matrix;
    OstGlobal rows = matrix->rows;
    MPI_Allreduce(MPI_IN_PLACE, &rows, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(rows, (NX + 1) * (NY + 1) * (NZ + 1));
    assert_int_equal(matrix->global_rows, rows);
    for (OstLocal row = 0; row < matrix->rows; row++) {
        assert_int_equal(matrix->column[matrix->diagonal[row]], row);
        for (OstLocal block = matrix->row_start[row]; block < matrix->row_start[row + 1]; block++) {
            const OstLocal column = matrix->column[block];
            if (block > matrix->row_start[row])
                assert_true(matrix->column[block - 1] < column);
            assert_true(column < matrix->columns);
            if (column >= matrix->rows)
                continue;
            OstLocal mirror = matrix->row_start[column];
            while (matrix->column[mirror] != row)
                mirror++;
            assert_true(mirror < matrix->row_start[column + 1]);
            for (int i = 0; i < 9 && column != row; i++)
                assert_close(matrix->value[9 * block + i], matrix->value[9 * mirror + i % 3 * 3 + i / 3], 0.0);
        }
    }
    destroy(&body);
}

/* Across ranks too: x·Ky = y·Kx. */
static void the_whole_matrix_is_symmetric(void **state)
{
    Body body = make_free_body(1, AXES_RANDOM_BY_TET);
    const OstMesh *mesh = body.mesh;
    const OstLocal owned = 3 * mesh->owned_nodes;
    double *x = numbers(3 * (size_t)mesh->node_count);
    double *y = numbers(3 * (size_t)mesh->node_count);
    double *product = numbers((size_t)owned);
    for (OstLocal i = 0; i < owned; i++) {
        x[i] = random_of(mesh->node_label[i / 3], i % 3);
        y[i] = random_of(mesh->node_label[i / 3], 3 + i % 3);
    }
    assert_success(ost_block_matrix_apply(body.system->matrix, y, product));
    const double xky = dot(ctx, owned, x, product);
    assert_success(ost_block_matrix_apply(body.system->matrix, x, product));
    const double xkx = dot(ctx, owned, x, product);
    assert_close(dot(ctx, owned, y, product) / xkx, xky / xkx, 1e-13);
    assert_true(xkx > 0.0);
    free(x);
    free(y);
    free(product);
    destroy(&body);
}

/* ½ u·Ku of a uniform strain is ½ strain·C·strain times the box's volume. */
static void the_energy_of_a_uniform_strain_is_exact(void **state)
{
    static const double a[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};
    const double strain[6] = {a[0], a[4], a[8], a[1] + a[3], a[5] + a[7], a[6] + a[2]};
    for (int axes = AXES_FIXED; axes <= AXES_SAME_BY_TET; axes++) {
        Body body = make_free_body(1, (AxesOfBody)axes);
        const OstMesh *mesh = body.mesh;
        double turned[36];
        double of_seven[9];
        double expected = 0.0;
        double *u = numbers(3 * (size_t)mesh->node_count);
        double *force = numbers(3 * (size_t)mesh->owned_nodes);
        axes_of(7, of_seven);
        ost_material_rotate_stiffness(body.field->material[0].stiffness, of_seven, turned);
        for (int p = 0; p < 36; p++)
            expected += 0.5 * strain[p / 6] * turned[p] * strain[p % 6];
        expected *= size_of_body[0] * size_of_body[1] * size_of_body[2];
        for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
            u[i] = ost_dot3(a + 3 * (i % 3), mesh->coordinates + i / 3 * 3);
        assert_success(ost_block_matrix_apply(body.system->matrix, u, force));
        assert_close(0.5 * dot(ctx, 3 * mesh->owned_nodes, u, force) / expected, 1.0, 1e-12);
        free(u);
        free(force);
        destroy(&body);
    }
}

static void isotropic_constants_do_not_feel_their_axes(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const OstMaterial isotropic = make_material(ctx, 0);
    OstMaterial turned = isotropic;
    turned.isotropic = 0; /* so that axes are carried and every tet's C is turned */
    OstSupports *supports = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    OstMaterialField *plain = make_field(mesh, &isotropic, AXES_FIXED);
    OstMaterialField *random = make_field(mesh, &turned, AXES_RANDOM_BY_TET);
    assert_null(plain->tet_turn);
    assert_non_null(random->tet_turn);
    OstSystem *a = make_system(mesh, supports, plain);
    OstSystem *b = make_system(mesh, supports, random);
    const OstLocal count = 9 * a->matrix->row_start[a->matrix->rows];
    const double size = largest(ctx, count, a->matrix->value);
    for (OstLocal i = 0; i < count; i++)
        assert_close(b->matrix->value[i] / size, a->matrix->value[i] / size, 1e-14);
    ost_system_destroy(&a);
    ost_system_destroy(&b);
    ost_field_destroy(&plain);
    ost_field_destroy(&random);
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

static void filling_again_gives_the_same(void **state)
{
    Body body = make_free_body(1, AXES_RANDOM_BY_TET);
    OstBlockMatrix *matrix = body.system->matrix;
    const size_t count = 9 * (size_t)matrix->row_start[matrix->rows];
    double *first = numbers(count);
    memcpy(first, matrix->value, count * sizeof *first);
    assert_success(ost_system_fill(body.system, body.field));
    assert_memory_equal(first, matrix->value, count * sizeof *first);
    ost_system_release_scatter(body.system);
    assert_failure(ost_system_fill(body.system, body.field), OST_INVALID_USAGE, "scatter map");
    free(first);
    destroy(&body);
}

/* The product by any number of ranks is that of one. */
static void ranks_agree_with_one_rank(void **state)
{
    double *product[2];
    OstContext *alone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    for (int one = 0; one < 2; one++) {
        OstContext *of = one ? alone : ctx;
        OstMesh *mesh = make_body(of);
        const OstMaterial material = make_material(of, 1);
        OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
        OstSupports *supports = NULL;
        assert_success(ost_supports_create(mesh, &supports));
        OstSystem *system = make_system(mesh, supports, field);
        double *u = numbers(3 * (size_t)mesh->node_count);
        double *force = numbers(3 * (size_t)mesh->owned_nodes);
        for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++)
            u[i] = random_of(mesh->node_label[i / 3], i % 3);
        assert_success(ost_block_matrix_apply(system->matrix, u, force));
        product[one] = by_label(mesh, force);
        free(u);
        free(force);
        ost_system_destroy(&system);
        ost_supports_destroy(&supports);
        ost_field_destroy(&field);
        ost_mesh_destroy(&mesh);
    }
    const OstLocal count = 3 * (NX + 1) * (NY + 1) * (NZ + 1);
    const double size = largest(ctx, count, product[1]);
    for (OstLocal i = 0; i < count; i++)
        assert_close(product[0][i] / size, product[1][i] / size, 1e-12);
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
    free(product[0]);
    free(product[1]);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rigid_motions_meet_no_force),
    cmocka_unit_test(the_matrix_gives_the_forces_summed_tet_by_tet),
    cmocka_unit_test(rows_are_ascending_and_the_matrix_is_its_own_mirror_image),
    cmocka_unit_test(the_whole_matrix_is_symmetric),
    cmocka_unit_test(the_energy_of_a_uniform_strain_is_exact),
    cmocka_unit_test(isotropic_constants_do_not_feel_their_axes),
    cmocka_unit_test(filling_again_gives_the_same),
    cmocka_unit_test(ranks_agree_with_one_rank),
};

OST_TEST_MAIN(tests)
