/* SPDX-License-Identifier: BSD-3-Clause */
#include "flat_tet.h"

/* The volume of a flat tet is rounding for the most part, and depends on the order of its vertices. Rows of different
 * ranks must have the same one, or K is not symmetric, and factors of its upper triangle are not positive definite. */

static void check_symmetry(double at)
{
    const OstMaterial material = make_material(ctx, 0);
    OstMesh *mesh = make_flattened(ctx, at, 1e-10);
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    OstSupports *supports = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3 && mesh->coordinates[3 * node] < 1e-12; i++) {
            double direction[3] = {0.0};
            direction[i] = 1.0;
            assert_success(ost_supports_constrain(supports, node, direction, 0.0));
        }
    assert_success(ost_supports_complete(supports));
    OstSystem *system = make_system(mesh, supports, field);
    const OstBlockMatrix *matrix = system->matrix;
    const OstLocal count = 3 * matrix->rows;
    double *x = numbers(3 * (size_t)matrix->columns), *y = numbers(3 * (size_t)matrix->columns);
    double *product = numbers((size_t)count);
    for (OstLocal i = 0; i < count; i++) {
        x[i] = random_of(matrix->label[i / 3], 20 + i % 3);
        y[i] = random_of(matrix->label[i / 3], 30 + i % 3);
    }
    assert_success(ost_block_matrix_apply(matrix, y, product));
    const double forth = dot(ctx, count, x, product), scale = sqrt(dot(ctx, count, product, product));
    assert_success(ost_block_matrix_apply(matrix, x, product));
    assert_close(dot(ctx, count, y, product), forth, 1e-13 * scale);
    free(x);
    free(y);
    free(product);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static void rows_of_all_ranks_fit_together(void **state)
{
    check_symmetry(0.5);
    check_symmetry(1.0);
    check_symmetry(1.5);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rows_of_all_ranks_fit_together),
};

OST_TEST_MAIN(tests)
