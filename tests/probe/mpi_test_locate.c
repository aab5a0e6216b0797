/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "element/element.h"
#include "element/shape_functions.h"
#include "orthostat/refine.h"
#include "probe/locate.h"

enum { COUNT = 200 };

/* The irregular body; quadratic ones with inner middles off their edges. */
static OstMesh *make_mesh(int order)
{
    OstMesh *linear = make_body(ctx), *mesh = NULL;
    if (order == 1)
        return linear;
    assert_success(ost_mesh_raise(linear, NULL, &mesh));
    ost_mesh_destroy(&linear);
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double *x = mesh->coordinates + 3 * node;
        for (int i = 0; i < 3 && !is_on_surface(x); i++)
            x[i] += 0.03 * random_of(mesh->node_label[node], 20 + i);
    }
    return mesh;
}

static void points_lie_where_their_coordinates_say(void **state)
{
    for (int order = 1; order <= 2; order++) {
        OstMesh *mesh = make_mesh(order);
        double low[3], high[3], points[3 * COUNT];
        OstLocated located[COUNT];
        assert_success(ost_mesh_bounds(mesh, low, high));
        for (int p = 0; p < COUNT; p++)
            for (int i = 0; i < 3; i++)
                points[3 * p + i] = low[i] + (0.5 + 0.49 * random_of(p + 1, 30 + i)) * (high[i] - low[i]);
        assert_success(ost_locate(mesh, COUNT, points, located));
        for (int p = 0; p < COUNT; p++) {
            int holders = located[p].tet >= 0;
            assert_true(located[p].label > 0);
            if (located[p].tet >= 0) {
                double x[3 * OST_MAX_TET_NODES], values[OST_MAX_TET_NODES], place[3];
                ost_gather3(mesh->nodes_per_tet, ost_mesh_nodes_of(mesh, located[p].tet), mesh->coordinates, x);
                ost_shape_values(mesh->nodes_per_tet, located[p].at, values);
                ost_shape_place(mesh->nodes_per_tet, values, x, place);
                for (int i = 0; i < 3; i++)
                    assert_close(place[i], points[3 * p + i], 1e-12);
                for (int k = 0; k < 4; k++)
                    assert_true(located[p].at[k] >= -1e-9);
                assert_true(mesh->tet_label[located[p].tet] == located[p].label);
            }
            MPI_Allreduce(MPI_IN_PLACE, &holders, 1, MPI_INT, MPI_SUM, ost_comm(ctx));
            assert_int_equal(holders, 1);
        }
        ost_mesh_destroy(&mesh);
    }
}

/* A vertex is in many tets: it goes to the lowest. What is far outside is in none; what a face misses by little is in.
 */
static void shared_points_and_points_outside(void **state)
{
    OstMesh *mesh = make_mesh(1);
    double low[3], high[3];
    assert_success(ost_mesh_bounds(mesh, low, high));
    const double middle[3] = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
    double points[9] = {high[0] + 0.5 * (high[0] - low[0]), middle[1], middle[2], high[0] + 1e-6, middle[1], middle[2]};
    OstLocated located[3];
    OstGlobal lowest = INT64_MAX;
    int owner = mesh->owned_nodes > 0 ? ost_rank(ctx) : ost_size(ctx);
    MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MIN, ost_comm(ctx));
    memcpy(points + 6, mesh->coordinates, 3 * sizeof *points);
    MPI_Bcast(points + 6, 3, MPI_DOUBLE, owner, ost_comm(ctx));
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        for (int a = 0; a < 4; a++)
            if (memcmp(mesh->coordinates + 3 * mesh->tet_nodes[4 * tet + a], points + 6, 3 * sizeof *points) == 0 &&
                mesh->tet_label[tet] < lowest)
                lowest = mesh->tet_label[tet];
    MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_INT64_T, MPI_MIN, ost_comm(ctx));
    assert_success(ost_locate(mesh, 3, points, located));
    assert_true(located[0].label == 0 && located[0].tet < 0);
    assert_true(located[1].label > 0);
    assert_true(located[2].label == lowest);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(points_lie_where_their_coordinates_say),
    cmocka_unit_test(shared_points_and_points_outside),
};

OST_TEST_MAIN(tests)
