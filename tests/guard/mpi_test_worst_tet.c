/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/flat_tet.h"

#include "core/error.h"
#include "guard/guard.h"

static void a_flat_tet_is_named_by_number_place_and_quality(void **state)
{
    OstMesh *mesh = make_flattened(ctx, 1.0, 1e-8);
    char words[OST_WORST_TET_SIZE];
    OstGlobal label = 0;
    double quality = 0.0;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const double found = ost_tet_quality(mesh->coordinates, ost_mesh_nodes_of(mesh, tet));
        if (found < 1e-6) {
            label = mesh->tet_label[tet];
            quality = found;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, &label, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &quality, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_success(ost_guard_worst_tet(mesh, words));
    char expected[64];
    snprintf(expected, sizeof expected, "the worst tet, %lld around (", (long long)label);
    assert_non_null(strstr(words, expected));
    snprintf(expected, sizeof expected, "has a quality of %.2g (", quality);
    assert_non_null(strstr(words, expected));
    ost_mesh_destroy(&mesh);
}

static void good_tets_are_not_blamed(void **state)
{
    OstMesh *mesh = make_body(ctx);
    char words[OST_WORST_TET_SIZE];
    assert_success(ost_guard_worst_tet(mesh, words));
    assert_string_equal(words, "");
    ost_mesh_destroy(&mesh);
}

/* The refusal of a solver that did not converge names the tet. */
static void a_refusal_names_it(void **state)
{
    OstMesh *mesh = make_flattened(ctx, 1.0, 1e-8);
    const OstProblem problem = {.ctx = ctx, .mesh = mesh};
    const OstStatus failed = OST_RAISE(ctx, OST_NOT_CONVERGED, "the solver gave up");
    assert_failure(ost_guard_explain(&problem, failed), OST_NOT_CONVERGED, "the solver gave up; the worst tet, ");
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_flat_tet_is_named_by_number_place_and_quality),
    cmocka_unit_test(good_tets_are_not_blamed),
    cmocka_unit_test(a_refusal_names_it),
};

OST_TEST_MAIN(tests)
