/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "core/memory.h"
#include "orthostat/refine.h"
#include "problem/coarse_space.h"

/* A quarter of a tube, whose quadratic tets have curved edges on both surfaces; held at one end. */
typedef struct Body {
    OstMesh *mesh;
    OstSupports *supports;
    OstSystem *system;
} Body;

static void hold_and_number(Body *body)
{
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    assert_success(ost_supports_create(body->mesh, &body->supports));
    for (OstLocal node = 0; node < body->mesh->owned_nodes; node++)
        for (int i = 0; i < 3 && body->mesh->coordinates[3 * node + 2] < 1e-9; i++)
            assert_success(ost_supports_constrain(body->supports, node, unit[i], 0.0));
    assert_success(ost_supports_complete(body->supports));
    assert_success(ost_system_create(body->mesh, body->supports, &body->system));
}

static void destroy(Body *body)
{
    ost_system_destroy(&body->system);
    ost_supports_destroy(&body->supports);
    ost_mesh_destroy(&body->mesh);
}

static void make_bodies(Body *linear, Body *quadratic)
{
    const OstSectorShape shape = {
        .axis = 2, .length = 1.0, .radii = {1.0, 2.0}, .angle = 90.0, .around = 4, .radial = 3, .axial = 3};
    const OstShapeSurface surface = {.kind = OST_SURFACE_TUBE, .axis = {0.0, 0.0, 1.0}};
    OstMeshChunk *chunk = NULL;
    OstMesh *straight = NULL;
    assert_success(ost_chunk_create_sector(ctx, &shape, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &straight));
    assert_success(ost_mesh_raise(straight, &surface, &quadratic->mesh));
    ost_mesh_destroy(&straight);
    assert_success(ost_mesh_linear(quadratic->mesh, &linear->mesh, NULL));
    hold_and_number(linear);
    hold_and_number(quadratic);
}

/* The weighted sum of the parents' places is the node's own, so every field of uniform slope passes as it is. */
static void curved_edges_keep_rotations_and_uniform_strains(void **state)
{
    Body linear = {0}, quadratic = {0};
    OstLocal *parents = NULL;
    double *weights = NULL;
    int checked[2] = {0};
    make_bodies(&linear, &quadratic);
    assert_success(ost_coarse_parents(quadratic.system, linear.system, &parents, &weights));
    for (OstLocal row = 0; row < quadratic.system->matrix->rows; row++) {
        const double *x = quadratic.mesh->coordinates + 3 * quadratic.system->node_of_row[row];
        double sum = 0.0, place[3] = {0.0};
        int bent = 0, held = 0;
        for (OstLocal k = 4 * row; k < 4 * row + 4; k++) {
            bent += weights[k] != 0.0 && weights[k] != 0.5;
            held += parents[k] < 0 && weights[k] != 0.0;
            if (parents[k] < 0)
                continue;
            sum += weights[k];
            for (int i = 0; i < 3; i++)
                place[i] += weights[k] * linear.mesh->coordinates[3 * linear.system->node_of_row[parents[k]] + i];
        }
        if (held)
            continue;
        checked[bent > 0]++;
        assert_close(sum, 1.0, 1e-12);
        for (int i = 0; i < 3; i++)
            assert_close(place[i], x[i], 1e-12);
    }
    MPI_Allreduce(MPI_IN_PLACE, checked, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    assert_true(checked[0] > 100);
    assert_true(checked[1] > 20);
    OST_FREE(parents, weights);
    destroy(&linear);
    destroy(&quadratic);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(curved_edges_keep_rotations_and_uniform_strains),
};

OST_TEST_MAIN(tests)
