/* SPDX-License-Identifier: BSD-3-Clause */
#include "body.h"

/* What nodes are held to: directions one by one, their agreement, and the ghosts' copies. */

static OstSupports *begin(OstMesh **mesh)
{
    OstSupports *supports = NULL;
    *mesh = make_body(ctx);
    assert_success(ost_supports_create(*mesh, &supports));
    return supports;
}

static void end(OstSupports *supports, OstMesh *mesh)
{
    ost_supports_destroy(&supports);
    ost_mesh_destroy(&mesh);
}

static void a_free_node_is_left_alone(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    double p[9], g[3];
    assert_int_equal(ost_supports_get(supports, 0, p, g), 0);
    for (int i = 0; i < 9; i++)
        assert_close(p[i], i % 4 == 0 ? 1.0 : 0.0, 0.0);
    for (int i = 0; i < 3; i++)
        assert_close(g[i], 0.0, 0.0);
    end(supports, mesh);
}

static void a_slide_on_an_oblique_plane_takes_its_normal(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double normal[3] = {2.0, -1.0, 2.0}; /* of length 3: P = I - n n' / 9 */
    double p[9], g[3];
    assert_success(ost_supports_constrain(supports, 0, normal, 0.6));
    assert_int_equal(ost_supports_get(supports, 0, p, g), 1);
    for (int i = 0; i < 9; i++)
        assert_close(p[i], (i % 4 == 0 ? 1.0 : 0.0) - normal[i / 3] * normal[i % 3] / 9.0, 1e-15);
    for (int i = 0; i < 3; i++)
        assert_close(g[i], 0.2 * normal[i], 1e-15);
    end(supports, mesh);
}

/* Three skew directions determine the displacement: u·d_k = given_k for each. */
static void skew_directions_together_hold_a_node(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double u[3] = {0.3, -0.2, 0.5};
    const double direction[4][3] = {{1, 1, 0}, {0, 1, 1}, {1, 0, 3}, {-2, 5, 1}};
    double p[9], g[3];
    for (int k = 0; k < 4; k++) /* the fourth repeats what the three say */
        assert_success(
            ost_supports_constrain(supports, 0, direction[k], ost_dot3(direction[k], u) / ost_norm3(direction[k])));
    assert_int_equal(ost_supports_get(supports, 0, p, g), 3);
    for (int i = 0; i < 9; i++)
        assert_close(p[i], 0.0, 0.0);
    for (int i = 0; i < 3; i++)
        assert_close(g[i], u[i], 1e-15);
    end(supports, mesh);
}

static void holding_the_same_twice_is_holding_it_once(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double x[3] = {1, 0, 0};
    const double back[3] = {-5, 0, 0};
    double p[9], g[3];
    assert_success(ost_supports_constrain(supports, 0, x, 0.1));
    assert_success(ost_supports_constrain(supports, 0, x, 0.1));
    assert_success(ost_supports_constrain(supports, 0, back, -0.1));
    assert_int_equal(ost_supports_get(supports, 0, p, g), 1);
    assert_close(g[0], 0.1, 0.0);
    end(supports, mesh);
}

/* Two normals of one plane, from rounded coordinates, hold it once: the tangent between them stays free. */
static void nearly_parallel_slides_are_one(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double off[4] = {0.0, 1e-9, -3e-8, 5e-7};
    double p[9], g[3];
    for (int k = 0; k < 4; k++) {
        const double normal[3] = {1.0, off[k], off[3 - k]};
        assert_success(ost_supports_constrain(supports, 0, normal, 0.0));
        assert_int_equal(ost_supports_get(supports, 0, p, g), 1);
    }
    const double other[3] = {1.0, 1e-4, 0.0};
    assert_success(ost_supports_constrain(supports, 0, other, 0.0));
    assert_int_equal(ost_supports_get(supports, 0, p, g), 2);
    end(supports, mesh);
}

static void contradictions_are_refused_in_words(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double x[3] = {1, 0, 0};
    const double z[3] = {0, 0, 1};
    const double between[3] = {1, 0, 1};
    char text[80];
    assert_success(ost_supports_constrain(supports, 0, z, 0.0));
    snprintf(text, sizeof text, "vertex %lld is constrained to 0 along (0, 0, 1) and to 0.1 by another constraint",
             (long long)mesh->node_label[0]);
    assert_failure(ost_supports_constrain(supports, 0, z, 0.1), OST_INVALID_INPUT, text);
    assert_success(ost_supports_constrain(supports, 0, x, 0.0));
    assert_failure(ost_supports_constrain(supports, 0, between, 0.2), OST_INVALID_INPUT, "by another constraint");
    end(supports, mesh);
}

static void useless_directions_are_refused(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    const double zero[3] = {0, 0, 0};
    const double endless[3] = {INFINITY, 0, 0};
    const double x[3] = {1, 0, 0};
    assert_failure(ost_supports_constrain(supports, 0, zero, 0.0), OST_INVALID_INPUT, "not zero");
    assert_failure(ost_supports_constrain(supports, 0, endless, 0.0), OST_INVALID_INPUT, "finite");
    assert_failure(ost_supports_constrain(supports, 0, x, NAN), OST_INVALID_INPUT, "finite");
    end(supports, mesh);
}

static void nothing_held_anywhere_is_refused(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    assert_failure(ost_supports_complete(supports), OST_INVALID_INPUT, "nothing is constrained");
    end(supports, mesh);
}

/* Every node with an odd label slides on a plane of its own; every rank must know it of its ghosts as well. */
static void ghosts_are_held_as_their_owners_say(void **state)
{
    OstMesh *mesh;
    OstSupports *supports = begin(&mesh);
    for (OstLocal node = mesh->owned_nodes - 1; node >= 0; node--) { /* in no helpful order */
        const double label = (double)mesh->node_label[node];
        const double normal[3] = {1.0, label, -2.0};
        if (mesh->node_label[node] % 2 == 1)
            assert_success(ost_supports_constrain(supports, node, normal, label));
    }
    assert_success(ost_supports_complete(supports));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        const double label = (double)mesh->node_label[node];
        const double normal[3] = {1.0, label, -2.0};
        double p[9], g[3], along[3];
        const int held = ost_supports_get(supports, node, p, g);
        assert_int_equal(held, (int)(mesh->node_label[node] % 2));
        if (held == 0)
            continue;
        ost_apply3(p, normal, along);
        assert_close(ost_norm3(along), 0.0, 1e-12);
        assert_close(ost_dot3(g, normal) / ost_norm3(normal) / label, 1.0, 1e-14);
    }
    end(supports, mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_free_node_is_left_alone),
    cmocka_unit_test(a_slide_on_an_oblique_plane_takes_its_normal),
    cmocka_unit_test(skew_directions_together_hold_a_node),
    cmocka_unit_test(holding_the_same_twice_is_holding_it_once),
    cmocka_unit_test(nearly_parallel_slides_are_one),
    cmocka_unit_test(contradictions_are_refused_in_words),
    cmocka_unit_test(useless_directions_are_refused),
    cmocka_unit_test(nothing_held_anywhere_is_refused),
    cmocka_unit_test(ghosts_are_held_as_their_owners_say),
};

OST_TEST_MAIN(tests)
