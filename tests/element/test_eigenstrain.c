/* SPDX-License-Identifier: BSD-3-Clause */
#include "element_support.h"

/* Linear kernels with an eigenstrain e0: stress = C (strain - e0), by tets of 4 nodes, of 10 with straight and curved
 * edges, and with C split. */

enum { WIDTH = 30, KINDS = 4 };
static const struct {
    int nodes;
    double bend;
    int by_mean;
} kinds[KINDS] = {{4, 0.0, 0}, {10, 0.0, 0}, {10, 0.05, 0}, {10, 0.05, 1}};

static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

typedef struct Case {
    const OstElement *element;
    int width;
    double c[36];
    OstSimd x[WIDTH], u[WIDTH];
    OstElasticity elasticity;
} Case;

static void make_case(int kind, Case *test)
{
    unsigned seed = 3u;
    test->element = ost_element_of(kinds[kind].nodes);
    test->width = 3 * kinds[kind].nodes;
    turned_ply(test->c);
    uniform_elasticity(test->c, &test->elasticity);
    test->elasticity.by_mean = kinds[kind].by_mean;
    for (int p = 0; p < 6; p++)
        test->elasticity.m[0][p] = 300.0 - 40.0 * p + (OstSimd){0};
    swell_elasticity(&test->elasticity);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double x[WIDTH];
        random_tet((unsigned)slot + 1u, x);
        for (int n = 12; n < WIDTH; n++)
            x[n] = 0.5 * (x[3 * ends[n / 3 - 4][0] + n % 3] + x[3 * ends[n / 3 - 4][1] + n % 3]) +
                   kinds[kind].bend * random_number(&seed);
        for (int n = 0; n < test->width; n++) {
            test->x[n][slot] = x[n];
            test->u[n][slot] = random_number(&seed);
        }
    }
}

static void energy_of(const Case *test, OstSimd *energy)
{
    OstMeans means;
    test->element->means(test->x, &test->elasticity, test->u, &means);
    *energy = means.energy * means.volume;
}

/* The energy is of second degree, so that central differences leave rounding alone. */
static void the_force_is_the_derivative_of_the_energy(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[WIDTH];
        make_case(kind, &test);
        test.element->force(test.x, &test.elasticity, test.u, force);
        for (int n = 0; n < test.width; n++) {
            const OstSimd kept = test.u[n];
            OstSimd ahead, behind;
            test.u[n] = kept + 0.5;
            energy_of(&test, &ahead);
            test.u[n] = kept - 0.5;
            energy_of(&test, &behind);
            test.u[n] = kept;
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                assert_close((ahead[slot] - behind[slot]) / test.c[0], force[n][slot] / test.c[0], 1e-11);
        }
    }
}

/* Twice the energy is the work of the forces less that of the stress on e0. */
static void energy_is_work(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[WIDTH];
        OstMeans means;
        make_case(kind, &test);
        test.element->force(test.x, &test.elasticity, test.u, force);
        test.element->means(test.x, &test.elasticity, test.u, &means);
        OstSimd work = -means.eigen * means.volume;
        for (int n = 0; n < test.width; n++)
            work += force[n] * test.u[n];
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            assert_close(work[slot] / (2.0 * means.energy[slot] * means.volume[slot]), 1.0, 1e-12);
    }
}

static void free_swelling_has_no_stress(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[WIDTH], magnitude[WIDTH];
        OstMeans means;
        make_case(kind, &test);
        swell_freely(test.element->nodes, test.x, &test.elasticity, test.u);
        test.element->force(test.x, &test.elasticity, test.u, force);
        test.element->magnitude(test.x, &test.elasticity, test.u, magnitude);
        test.element->means(test.x, &test.elasticity, test.u, &means);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            for (int n = 0; n < test.width; n++)
                assert_true(fabs(force[n][slot]) < 1e-13 * magnitude[n][slot]);
            for (int p = 0; p < 6; p++) {
                assert_close(means.strain[p][slot], test.elasticity.e0[0][p][slot], 1e-13);
                assert_close(means.stress[p][slot] / test.c[0], 0.0, 1e-13);
            }
        }
    }
}

/* Without displacement, too, rounding errors have a scale. */
static void the_magnitude_counts_the_eigenstrain(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[WIDTH], magnitude[WIDTH];
        make_case(kind, &test);
        memset(test.u, 0, sizeof test.u);
        test.element->force(test.x, &test.elasticity, test.u, force);
        test.element->magnitude(test.x, &test.elasticity, test.u, magnitude);
        for (int n = 0; n < test.width; n++)
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                assert_true(fabs(force[n][slot]) <= (1.0 + 1e-12) * magnitude[n][slot]);
    }
}

/* e0 at a point by the axes there: cylindrical ones, in tets of one region and of two. */
static void it_follows_the_axes(void **state)
{
    OstMaterial materials[2];
    const OstAxesSpec axes[2] = {
        {.kind = OST_AXES_CYLINDRICAL, .axis = {0, 0, 1}, .order = {OST_RADIAL, OST_TANGENTIAL, OST_AXIAL}},
        {.kind = OST_AXES_NONE}};
    const double of_regions[12] = {0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0};
    const double of_tets[24] = {0.0, 0.0, 0.5};
    const int32_t region[4] = {0, 0, 0, 1};
    const OstGlobal label[4] = {1, 2, 3, 4};
    const double centroids[12] = {1, 1, 0, 2, 0, 1, 0, 3, 0, 1, 1, 1};
    OstMaterialField *field = NULL;
    OstElasticity elasticity;
    OstLocal tets[OST_SIMD_WIDTH];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        tets[slot] = slot % 4;
    orthotropic_material(&materials[0]);
    orthotropic_material(&materials[1]);
    assert_success(ost_field_create(ctx, NULL, 2, materials, axes, 4, region, label, centroids, NULL, &field));
    assert_success(ost_field_set_eigenstrain(field, of_regions, 4, of_tets));
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, tets, 0, NULL, NULL);
    assert_int_equal(elasticity.eigenstrained, 0); /* none of it acts unless asked for */
    elasticity.eigen_share = 0.5;
    ost_elasticity_gather(&elasticity, field, tets, 0, NULL, NULL);
    assert_int_equal(elasticity.eigenstrained, 1);
    const double expected[4][6] = {{0.075, 0.075, 0.25, 0.15}, {0.15}, {0.0, 0.15}, {0.0, 0.1}};
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int p = 0; p < 6; p++)
            assert_close(elasticity.e0[0][p][slot], expected[tets[slot]][p], 1e-15);
    assert_success(ost_field_set_eigenstrain(field, NULL, 0, NULL));
    ost_elasticity_gather(&elasticity, field, tets, 0, NULL, NULL);
    assert_int_equal(elasticity.eigenstrained, 0);
    ost_field_destroy(&field);
}

/* Strains and factors at the vertices are linear between them: at each point of quadratic tets, in linear ones their
 * mean; and C is spread to all points only if something differs between them. */
static void it_varies_within_tets(void **state)
{
    const OstQuadrature *rule = &ost_tet_degree3;
    const int32_t region[2] = {0, 0};
    const OstGlobal label[2] = {1, 2};
    const OstLocal tets[OST_SIMD_WIDTH] = {0, 1};
    const double centroids[6] = {0};
    double strains[48], factors[8];
    OstMaterial material;
    OstMaterialField *field = NULL;
    OstElasticity elasticity, plain;
    OstSimd places[3 * OST_MAX_POINTS] = {{0}};
    for (int n = 0; n < 48; n++)
        strains[n] = 0.01 * (n % 7) - 0.02 * (n % 5);
    for (int n = 0; n < 8; n++)
        factors[n] = 1.0 + 0.5 * n;
    orthotropic_material(&material);
    assert_success(ost_field_create(ctx, NULL, 1, &material, NULL, 2, region, label, centroids, NULL, &field));
    ost_elasticity_clear(&plain);
    ost_elasticity_gather(&plain, field, tets, rule->count, rule->point, places);
    assert_success(ost_field_set_vertex_eigenstrain(field, NULL, 2, strains));
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, tets, rule->count, rule->point, places);
    assert_int_equal(elasticity.points, 1); /* none of it acts */
    elasticity.eigen_share = 0.5;
    for (int scaled = 0; scaled < 2; scaled++) {
        if (scaled)
            assert_success(ost_field_set_vertex_scale(field, 2, factors));
        ost_elasticity_gather(&elasticity, field, tets, rule->count, rule->point, places);
        assert_int_equal(elasticity.points, rule->count);
        for (int q = 0; q < rule->count; q++)
            for (int slot = 0; slot < 2; slot++) {
                double factor = 0.0, strain[6] = {0.0};
                for (int v = 0; v < 4; v++) {
                    factor += rule->point[q].at[v] * factors[4 * slot + v];
                    for (int p = 0; p < 6; p++)
                        strain[p] += 0.5 * rule->point[q].at[v] * strains[24 * slot + 6 * v + p];
                }
                for (int p = 0; p < 6; p++)
                    assert_close(elasticity.e0[q][p][slot], strain[p], 1e-15);
                for (int n = 0; n < OST_ELASTICITY_COUNT; n++)
                    assert_close(elasticity.c[q][n][slot], (scaled ? factor : 1.0) * plain.c[0][n][slot],
                                 1e-14 * fabs(plain.c[0][0][0]));
            }
    }
    ost_elasticity_gather(&elasticity, field, tets, 0, NULL, NULL);
    assert_int_equal(elasticity.points, 1);
    for (int p = 0; p < 6; p++)
        assert_close(elasticity.e0[0][p][1],
                     0.125 * (strains[24 + p] + strains[30 + p] + strains[36 + p] + strains[42 + p]), 1e-15);
    assert_close(elasticity.c[0][0][1], 3.75 * plain.c[0][0][1], 1e-14 * plain.c[0][0][1]);
    ost_field_destroy(&field);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_force_is_the_derivative_of_the_energy),
    cmocka_unit_test(energy_is_work),
    cmocka_unit_test(free_swelling_has_no_stress),
    cmocka_unit_test(the_magnitude_counts_the_eigenstrain),
    cmocka_unit_test(it_follows_the_axes),
    cmocka_unit_test(it_varies_within_tets),
};

OST_TEST_MAIN(tests)
