/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/elasticity.h"
#include "orthostat/field.h"
#include "support.h"

enum { TETS = 12, REGIONS = 3 };

/* Tets 0-3 isotropic, 4-7 orthotropic with fixed axes, 8-11 orthotropic with axes that vary; `mixed` deals the regions
 * out in turn instead. */
static OstMaterialField *make_field(int mixed, int32_t region[TETS])
{
    const OstOrthotropic soft = ost_orthotropic_isotropic(2.0, 0.3);
    const OstOrthotropic wood = {
        .youngs_modulus = {11e3, 0.9e3, 0.5e3}, .poissons_ratio = {0.37, 0.44, 0.02}, .shear_modulus = {700, 40, 500}};
    const double stiff[3] = {1e6, 1e9, 1e6};
    const OstOrthotropic tube = ost_orthotropic_family(stiff, 0.3, OST_SHEAR_GEOMETRIC);
    OstMaterial material[REGIONS];
    OstAxesSpec axes[REGIONS] = {
        {.kind = OST_AXES_NONE},
        {.kind = OST_AXES_FIXED},
        {.kind = OST_AXES_CYLINDRICAL, .axis = {0, 1, 0}, .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}}};
    const double degrees[3] = {20, 40, -70};
    double centroids[3 * TETS];
    OstGlobal label[TETS];
    OstMaterialField *field = NULL;
    assert_success(ost_material_create(ctx, "soft", &soft, 0.0, &material[0]));
    assert_success(ost_material_create(ctx, "wood", &wood, 0.0, &material[1]));
    assert_success(ost_material_create(ctx, "tube", &tube, 0.0, &material[2]));
    assert_success(ost_axes_from_euler(ctx, "zxz", degrees, axes[1].fixed));
    for (int t = 0; t < TETS; t++) {
        region[t] = mixed ? t % REGIONS : t / 4;
        label[t] = t + 1;
        centroids[3 * t] = cos(t);
        centroids[3 * t + 1] = t;
        centroids[3 * t + 2] = sin(t);
    }
    assert_success(ost_field_create(ctx, REGIONS, material, axes, TETS, region, label, centroids, NULL, &field));
    return field;
}

static void assert_gathered(const OstMaterialField *field)
{
    OstElasticity elasticity;
    ost_elasticity_clear(&elasticity);
    for (OstLocal first = 0; first + OST_LANES <= TETS; first += OST_LANES) {
        OstLocal tets[OST_LANES];
        for (int lane = 0; lane < OST_LANES; lane++)
            tets[lane] = first + lane;
        ost_elasticity_gather(&elasticity, field, tets);
        for (int lane = 0; lane < OST_LANES; lane++) {
            double c[36];
            double size = 0.0;
            ost_field_stiffness(field, tets[lane], c);
            for (int i = 0; i < 36; i++)
                size = fmax(size, fabs(c[i]));
            for (int p = 0, n = 0; p < 6; p++)
                for (int q = p; q < 6; q++)
                    assert_close(elasticity.c[n++][lane] / size, c[6 * p + q] / size, 1e-15);
        }
    }
}

static void lanes_hold_each_tets_elasticity(void **state)
{
    (void)state;
    int32_t region[TETS];
    OstMaterialField *field = make_field(0, region);
    assert_gathered(field);
    ost_field_destroy(&field);
}

static void lanes_of_several_regions_hold_theirs(void **state)
{
    (void)state;
    int32_t region[TETS];
    OstMaterialField *field = make_field(1, region);
    assert_gathered(field);
    ost_field_destroy(&field);
}

static void a_uniform_region_is_gathered_once(void **state)
{
    (void)state;
    int32_t region[TETS];
    const OstLocal same[OST_LANES] = {0, 1, 2, 3};
    const OstLocal vary[OST_LANES] = {8, 9, 10, 11};
    OstMaterialField *field = make_field(0, region);
    OstElasticity elasticity;
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, same);
    assert_int_equal(elasticity.region, 0);
    elasticity.c[0][0] = -1.0; /* would be overwritten */
    ost_elasticity_gather(&elasticity, field, same);
    assert_close(elasticity.c[0][0], -1.0, 0.0);
    ost_elasticity_gather(&elasticity, field, vary);
    assert_int_equal(elasticity.region, -1);
    ost_elasticity_gather(&elasticity, field, same);
    assert_true(elasticity.c[0][0] > 0.0);
    ost_field_destroy(&field);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(lanes_hold_each_tets_elasticity),
    cmocka_unit_test(lanes_of_several_regions_hold_theirs),
    cmocka_unit_test(a_uniform_region_is_gathered_once),
};

OST_TEST_MAIN(tests)
