/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

#include "assembly/laplacian.h"

/* Potential k runs from 1 to 3 between the two faces of the box across axis k; no flow through the other faces. So it
 * is linear, on any mesh. */
static OstSupports *hold_potentials(const OstMesh *mesh)
{
    OstSupports *supports = NULL;
    assert_success(ost_supports_create(mesh, &supports));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int k = 0; k < 3; k++) {
            double direction[3] = {0.0, 0.0, 0.0};
            const double x = mesh->coordinates[3 * node + k];
            direction[k] = 1.0;
            if (x < 1e-12)
                assert_success(ost_supports_constrain(supports, node, direction, 1.0));
            else if (x > size_of_body[k] - 1e-12)
                assert_success(ost_supports_constrain(supports, node, direction, 3.0));
        }
    assert_success(ost_supports_complete(supports));
    return supports;
}

static void potentials_between_parallel_faces_are_linear(void **state)
{
    OstMesh *mesh = make_body(ctx);
    OstSupports *supports = hold_potentials(mesh);
    OstSystem *system = NULL;
    assert_success(ost_system_create(mesh, supports, &system));
    double *rhs = numbers(3 * (size_t)system->matrix->rows);
    double *v = numbers(3 * (size_t)system->matrix->rows);
    double *u = numbers(3 * (size_t)mesh->node_count);
    assert_success(ost_system_fill_laplacian(system, rhs));
    solve(ctx, system->matrix, rhs, v);
    assert_success(ost_system_displacement(system, 1.0, v, u));
    for (OstLocal i = 0; i < 3 * mesh->node_count; i++)
        assert_close(u[i], 1.0 + 2.0 * mesh->coordinates[i] / size_of_body[i % 3], 1e-12);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        double gradients[9];
        ost_tet_component_gradients(mesh, tet, u, gradients);
        for (int i = 0; i < 9; i++)
            assert_close(gradients[i], i % 4 == 0 ? 2.0 / size_of_body[i / 3] : 0.0, 1e-11);
    }
    ost_system_release_scatter(system);
    assert_failure(ost_system_fill_laplacian(system, rhs), OST_INVALID_USAGE, "scatter map");
    free(rhs);
    free(v);
    free(u);
    ost_system_destroy(&system);
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(potentials_between_parallel_faces_are_linear),
};

OST_TEST_MAIN(tests)
