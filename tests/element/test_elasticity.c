/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/memory.h"
#include "element/element.h"
#include "element_support.h"
#include "material/directions.h"
#include "material/field_data.h"
#include "support.h"

enum { REGIONS = 3, TETS = REGIONS * OST_SIMD_WIDTH, MOST = 8 };

/* The tets of a batch, and what a field of them wants; more than are needed where registers are narrow. */
static const OstLocal first_tets[MOST] = {0, 1, 2, 3, 4, 5, 6, 7};
static const OstGlobal label[MOST] = {1, 2, 3, 4, 5, 6, 7, 8};
static const int32_t region_0[MOST] = {0};

static void tets_from(OstLocal first, OstLocal tets[OST_SIMD_WIDTH])
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        tets[slot] = first + slot;
}

/* A batch of isotropic tets, one orthotropic with fixed axes, one orthotropic with axes that vary; `mixed` deals the
 * regions out in turn instead. */
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
    OstGlobal labels[TETS];
    OstMaterialField *field = NULL;
    assert_success(ost_material_create(ctx, "soft", &soft, 0.0, &material[0]));
    assert_success(ost_material_create(ctx, "wood", &wood, 0.0, &material[1]));
    assert_success(ost_material_create(ctx, "tube", &tube, 0.0, &material[2]));
    assert_success(ost_axes_from_euler(ctx, "zxz", degrees, axes[1].fixed));
    for (int t = 0; t < TETS; t++) {
        region[t] = mixed ? t % REGIONS : t / OST_SIMD_WIDTH;
        labels[t] = t + 1;
        centroids[3 * t] = cos(t);
        centroids[3 * t + 1] = t;
        centroids[3 * t + 2] = sin(t);
    }
    assert_success(ost_field_create(ctx, NULL, REGIONS, material, axes, TETS, region, labels, centroids, NULL, &field));
    return field;
}

static void assert_gathered(const OstMaterialField *field)
{
    OstElasticity elasticity;
    ost_elasticity_clear(&elasticity);
    for (OstLocal first = 0; first + OST_SIMD_WIDTH <= TETS; first += OST_SIMD_WIDTH) {
        OstLocal tets[OST_SIMD_WIDTH];
        tets_from(first, tets);
        ost_elasticity_gather(&elasticity, field, tets, 0, NULL, NULL);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double c[36];
            double size = 0.0;
            ost_field_stiffness(field, tets[slot], c);
            for (int i = 0; i < 36; i++)
                size = fmax(size, fabs(c[i]));
            for (int p = 0, n = 0; p < 6; p++)
                for (int q = p; q < 6; q++)
                    assert_close(elasticity.c[0][n++][slot] / size, c[6 * p + q] / size, 1e-15);
        }
    }
}

static void lanes_hold_each_tets_elasticity(void **state)
{
    int32_t region[TETS];
    OstMaterialField *field = make_field(0, region);
    assert_gathered(field);
    ost_field_destroy(&field);
}

static void lanes_of_several_regions_hold_theirs(void **state)
{
    int32_t region[TETS];
    OstMaterialField *field = make_field(1, region);
    assert_gathered(field);
    ost_field_destroy(&field);
}

static void a_uniform_region_is_gathered_once(void **state)
{
    int32_t region[TETS];
    OstLocal same[OST_SIMD_WIDTH], vary[OST_SIMD_WIDTH];
    OstMaterialField *field = make_field(0, region);
    OstElasticity elasticity;
    tets_from(0, same);
    tets_from(2 * OST_SIMD_WIDTH, vary);
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, same, 0, NULL, NULL);
    assert_int_equal(elasticity.region, 0);
    elasticity.c[0][0][0] = -1.0; /* would be overwritten */
    ost_elasticity_gather(&elasticity, field, same, 0, NULL, NULL);
    assert_close(elasticity.c[0][0][0], -1.0, 0.0);
    ost_elasticity_gather(&elasticity, field, vary, 0, NULL, NULL);
    assert_int_equal(elasticity.region, -1);
    ost_elasticity_gather(&elasticity, field, same, 0, NULL, NULL);
    assert_true(elasticity.c[0][0][0] > 0.0);
    ost_field_destroy(&field);
}

/* Three points in each tet. */
static void some_places(OstSimd places[9])
{
    for (int n = 0; n < 9; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            places[n][slot] = cos(1.0 + n + 9 * slot);
}

static void assert_at_points(const OstMaterialField *field, const OstLocal tets[OST_SIMD_WIDTH])
{
    OstElasticity elasticity;
    OstSimd places[9];
    some_places(places);
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, tets, 3, ost_tet_degree2.point, places);
    assert_int_equal(elasticity.points, 3);
    for (int point = 0; point < 3; point++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const int32_t region = field->tet_region[tets[slot]];
            const double place[3] = {places[3 * point][slot], places[3 * point + 1][slot], places[3 * point + 2][slot]};
            const double *mode = elasticity.by_mean ? ost_field_stiff_mode(field, region) : NULL;
            double axes[9], turned[36], size = 0.0;
            ost_field_axes_at(field, tets[slot], ost_tet_degree2.point[point].at, place, axes);
            ost_material_rotate_stiffness(field->material[region].stiffness, axes, turned);
            for (int p = 0; p < 36; p++)
                size = fmax(size, fabs(turned[p]));
            for (int p = 0, n = 0; p < 6; p++)
                for (int q = p; q < 6; q++, n++) {
                    double c = elasticity.c[point][n][slot];
                    if (elasticity.by_mean)
                        c += elasticity.m[point][p][slot] * elasticity.m[point][q][slot];
                    assert_close(c / size, turned[6 * p + q] / size, 1e-14);
                }
            for (int p = 0; p < 6 && elasticity.by_mean; p++) {
                double m = 0.0; /* the mode's stress in world axes */
                for (int a = 0; a < 3 && mode; a++)
                    m += mode[a] * axes[3 * a + p % 3] * axes[3 * a + (p < 3 ? p : (p + 1) % 3)];
                assert_close(elasticity.m[point][p][slot] / sqrt(size), m / sqrt(size), 1e-14);
            }
        }
}

static void a_formula_is_evaluated_at_the_points_of_each_tet(void **state)
{
    int32_t region[TETS];
    OstLocal vary[OST_SIMD_WIDTH], mixed_tets[OST_SIMD_WIDTH], same[OST_SIMD_WIDTH];
    tets_from(2 * OST_SIMD_WIDTH, vary);
    tets_from(2, mixed_tets);
    tets_from(OST_SIMD_WIDTH, same);
    for (int mixed = 0; mixed < 2; mixed++) {
        int regions = 0;
        OstElasticity elasticity;
        OstSimd places[9];
        OstMaterialField *field = make_field(mixed, region);
        assert_at_points(field, mixed ? mixed_tets : vary);
        assert_success(ost_field_mean_dilatation(field, 0.2, &regions));
        assert_true(regions >= 2);
        assert_at_points(field, mixed ? mixed_tets : vary);
        some_places(places);
        ost_elasticity_clear(&elasticity);
        ost_elasticity_gather(&elasticity, field, same, 3, NULL, places);
        assert_int_equal(elasticity.points, mixed ? 3 : 1); /* fixed axes */
        ost_elasticity_clear(&elasticity);
        ost_elasticity_gather(&elasticity, field, vary, 0, NULL, NULL); /* a linear tet: at the centroid, and whole */
        assert_int_equal(elasticity.points, 1);
        assert_int_equal(elasticity.by_mean, 0);
        ost_field_destroy(&field);
    }
}

/* Has e3 and e1 of the last region follow directions in place of the formula. */
static void set_directions(OstMaterialField *field)
{
    const int axis[2] = {2, 0};
    signed char *along = NULL;
    float *directions = NULL;
    assert_success(OST_NEW(ctx, &along, 2 * REGIONS));
    assert_success(OST_NEW(ctx, &directions, TETS * OST_DIRECTIONS));
    along[2 * REGIONS - 2] = 2;
    for (OstLocal t = 0; t < TETS; t++) {
        double axes[9], first[12], second[12];
        ost_field_axes(field, t, axes);
        for (int k = 0; k < 12; k++) {
            first[k] = 3.0 * axes[6 + k % 3] + cos(t + k);
            second[k] = axes[k % 3] + 0.3 * cos(2.0 * t - k);
        }
        ost_directions_set_linear(axes, axis, first, second, directions + OST_DIRECTIONS * t);
    }
    ost_field_take_directions(field, &along, &directions);
}

static void directions_are_followed_at_the_points_of_each_tet(void **state)
{
    int32_t region[TETS];
    OstLocal tets[OST_SIMD_WIDTH];
    for (int mixed = 0; mixed < 2; mixed++) {
        OstMaterialField *field = make_field(mixed, region);
        double axes[2][9];
        set_directions(field);
        tets_from(mixed ? 2 : 2 * OST_SIMD_WIDTH, tets);
        assert_at_points(field, tets);
        for (int p = 0; p < 2; p++)
            ost_field_axes_at(field, TETS - 1, ost_tet_degree2.point[p].at, (const double[3]){0.0}, axes[p]);
        assert_true(fabs(axes[0][8] - axes[1][8]) > 1e-3);
        ost_field_destroy(&field);
    }
}

/* C in its two parts keeps the digits of the soft one: next to nu = 1/2, on axes of any direction, an isotropic body
 * resists a change of shape by 2 G, and a pull beside that by the limit's bulk modulus. */
static void a_split_elasticity_keeps_its_digits_next_to_incompressible(void **state)
{
    const OstOrthotropic constants = ost_orthotropic_isotropic(2.0, 0.5 - 1e-10);
    const double shear = 2.0 / (2.0 * 1.5),
                 bulk = 2.0 / (3.0 * 0.1); /* G = E / (2 (1 + nu)), E / (3 (1 - 2 nu_limit)) */
    const OstSimd places[3] = {{0}};
    OstMaterial material;
    OstMaterialField *field = NULL;
    OstElasticity elasticity;
    int regions = 0;
    assert_success(ost_material_create(ctx, "gel", &constants, 0.0, &material));
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, NULL, OST_SIMD_WIDTH, region_0, label, NULL, NULL, &field));
    assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
    ost_elasticity_clear(&elasticity);
    ost_elasticity_gather(&elasticity, field, first_tets, 1, NULL, places);
    assert_int_equal(elasticity.by_mean, 1);
    const double expected = bulk + 4.0 / 3.0 * shear, beside = bulk - 2.0 / 3.0 * shear;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        assert_close(elasticity.c[0][0][slot], expected, 1e-9 * expected); /* nu is 1e-10 from 1/2 */
        assert_close(elasticity.c[0][1][slot], beside, 1e-9 * expected);
        assert_close(elasticity.c[0][OST_ELASTICITY_COUNT - 1][slot], shear, 1e-9 * shear);
        assert_close((elasticity.c[0][0][slot] - elasticity.c[0][1][slot]) /
                         (2.0 * material.constants.shear_modulus[0]),
                     1.0, 1e-14);
    }
    ost_field_destroy(&field);
}

/* Tets with random axes, each its own (CELLS) or one for all (FIXED), of one material of the family. */
static OstMaterialField *family_field(const double youngs_modulus[3], double nu, OstShearRule rule, OstAxesKind kind)
{
    const double centroids[3 * OST_SIMD_WIDTH] = {0};
    const OstOrthotropic constants = ost_orthotropic_family(youngs_modulus, nu, rule);
    OstAxesSpec spec = {.kind = kind};
    double axes[9 * OST_SIMD_WIDTH];
    OstMaterial material;
    OstMaterialField *field = NULL;
    for (unsigned slot = 0; slot < OST_SIMD_WIDTH; slot++)
        random_axes(slot + 1u, axes + 9 * slot);
    random_axes(9u, spec.fixed);
    assert_success(ost_material_create(ctx, "family", &constants, 0.0, &material));
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, &spec, OST_SIMD_WIDTH, region_0, label, centroids, axes, &field));
    return field;
}

static const double moduli[][3] = {{1, 1e12, 1e6}, {1e12, 1, 1}, {3e-4, 2e2, 5e8}, {1e6, 1e9, 1e6}, {2, 3, 5}};
enum { MODULI = sizeof moduli / sizeof *moduli };

/* C of the family, which comes from its stretch tensor, against eq. 9. */
static void the_familys_elasticity_is_the_rotated_one(void **state)
{
    static const double nu[4] = {-0.6, 0.0, 0.3, 0.49};
    for (int n = 0; n < 4 * MODULI; n++) {
        OstMaterialField *field = family_field(moduli[n / 4], nu[n % 4], OST_SHEAR_GEOMETRIC, OST_AXES_CELLS);
        OstElasticity elasticity;
        ost_elasticity_clear(&elasticity);
        ost_elasticity_gather(&elasticity, field, first_tets, 0, NULL, NULL);
        assert_true(elasticity.stretched);
        assert_false(elasticity.by_stretch);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double c[36], size = 0.0;
            ost_field_stiffness(field, slot, c);
            for (int i = 0; i < 36; i++)
                size = fmax(size, fabs(c[i]));
            for (int p = 0, i = 0; p < 6; p++)
                for (int q = p; q < 6; q++)
                    assert_close(elasticity.c[0][i++][slot] / size, c[6 * p + q] / size, 1e-14);
        }
        ost_field_destroy(&field);
    }
}

/* Stiffness of the tets, by the stretch tensor if that suffices. */
static void stiffness_of_field(const OstMaterialField *field, int stretch_suffices, OstSimd blocks[90])
{
    OstElasticity elasticity;
    OstSimd x[12];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double of_tet[12];
        random_tet((unsigned)slot + 1u, of_tet);
        for (int i = 0; i < 12; i++)
            x[i][slot] = of_tet[i];
    }
    ost_elasticity_clear(&elasticity);
    elasticity.stretch_suffices = stretch_suffices;
    ost_elasticity_gather(&elasticity, field, first_tets, 0, NULL, NULL);
    assert_int_equal(elasticity.by_stretch, stretch_suffices);
    ost_element_of(4)->stiffness(x, &elasticity, blocks);
}

static void stiffness_by_the_metric_is_that_by_the_elasticity(void **state)
{
    for (int n = 0; n < 2 * MODULI; n++) {
        OstMaterialField *field =
            family_field(moduli[n / 2], 0.3, OST_SHEAR_GEOMETRIC, n % 2 ? OST_AXES_CELLS : OST_AXES_FIXED);
        OstSimd tensor[90], plain[90];
        stiffness_of_field(field, 1, tensor);
        stiffness_of_field(field, 0, plain);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double size = 0.0;
            for (int i = 0; i < 90; i++)
                size = fmax(size, fabs(plain[i][slot]));
            for (int i = 0; i < 90; i++)
                assert_close(tensor[i][slot] / size, plain[i][slot] / size, 1e-14);
        }
        ost_field_destroy(&field);
    }
}

static void other_shear_has_no_metric(void **state)
{
    OstMaterialField *field = family_field(moduli[MODULI - 1], 0.3, OST_SHEAR_ARITHMETIC, OST_AXES_CELLS);
    OstElasticity elasticity;
    ost_elasticity_clear(&elasticity);
    elasticity.stretch_suffices = 1;
    ost_elasticity_gather(&elasticity, field, first_tets, 0, NULL, NULL);
    assert_false(elasticity.stretched);
    assert_false(elasticity.by_stretch);
    ost_field_destroy(&field);
}

/* A about a line askew, made from the corners of tets, against A from the axes at their centroids. */
static void the_metric_about_a_line_is_that_of_its_axes(void **state)
{
    const OstAxesSpec spec = {.kind = OST_AXES_CYLINDRICAL,
                              .origin = {0.3, -0.2, 0.5},
                              .axis = {1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0},
                              .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}};
    const OstOrthotropic constants = ost_orthotropic_family(moduli[3], 0.3, OST_SHEAR_GEOMETRIC);
    double centroids[3 * OST_SIMD_WIDTH] = {0.0}, axes[9];
    OstMaterial material;
    OstMaterialField *field = NULL;
    OstElasticity about_line, of_axes;
    OstSimd x[12], tensor[6];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double of_tet[12];
        random_tet((unsigned)slot + 1u, of_tet);
        for (int i = 0; i < 12; i++) {
            x[i][slot] = of_tet[i];
            centroids[3 * slot + i % 3] += of_tet[i] / 4.0;
        }
    }
    assert_success(ost_material_create(ctx, "family", &constants, 0.0, &material));
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, &spec, OST_SIMD_WIDTH, region_0, label, centroids, NULL, &field));
    ost_elasticity_clear(&about_line);
    about_line.stretch_suffices = 1;
    ost_elasticity_gather(&about_line, field, first_tets, 0, NULL, NULL);
    assert_true(about_line.by_stretch && about_line.about_line);
    ost_stretch_about_line(&about_line, x, tensor);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        ost_field_axes(field, first_tets[slot], axes);
        for (int p = 0; p < 6; p++) {
            const int i = p % 3, j = p < 3 ? i : (p + 1) % 3;
            double expected = 0.0;
            for (int a = 0; a < 3; a++)
                expected += about_line.stretch[a] * axes[3 * a + i] * axes[3 * a + j];
            assert_close(tensor[p][slot] / about_line.stretch[1], expected / about_line.stretch[1], 1e-14);
        }
    }
    ost_elasticity_clear(&of_axes); /* C is asked for: the line does not suffice */
    ost_elasticity_gather(&of_axes, field, first_tets, 0, NULL, NULL);
    assert_false(of_axes.by_stretch || of_axes.about_line);
    ost_field_destroy(&field);
}

/* C at points, from cylindrical axes of any order, is that of tets with these centroids; on the cylinder's axis, where
 * there are none, it is the tet's own. */
static void elasticity_at_points_has_the_axes_there(void **state)
{
    static const double centroids[3 * MOST] = {1.0, 0.2, -0.4, -3.0, 5.0,  0.1, 0.2,  -0.7, 9.0,  1e-3, 2e-3, -1e4,
                                               0.7, 0.1, 0.3,  2.0,  -6.0, 1.5, -0.2, 0.4,  -8.0, 0.9,  -3.1, 0.8};
    const OstOrthotropic wood = {
        .youngs_modulus = {11e3, 0.9e3, 0.5e3}, .poissons_ratio = {0.37, 0.44, 0.02}, .shear_modulus = {700, 40, 500}};
    OstMaterial material;
    assert_success(ost_material_create(ctx, "wood", &wood, 0.0, &material));
    for (int order = 0; order < 6; order++) {
        const int first = order % 3, second = (first + 1 + order / 3) % 3;
        const OstAxesSpec spec = {.kind = OST_AXES_CYLINDRICAL,
                                  .origin = {0.3, -0.2, 0.5},
                                  .axis = {1.0, 2.0, 2.0},
                                  .order = {(OstCylindricalDirection)first, (OstCylindricalDirection)second,
                                            (OstCylindricalDirection)(3 - first - second)}};
        OstMaterialField *field = NULL;
        OstElasticity elasticity;
        OstSimd places[6];
        assert_success(
            ost_field_create(ctx, NULL, 1, &material, &spec, OST_SIMD_WIDTH, region_0, label, centroids, NULL, &field));
        for (int i = 0; i < 6; i++)
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                places[i][slot] =
                    i > 2 && slot == 0 ? spec.origin[i % 3] + spec.axis[i % 3] : centroids[3 * slot + i % 3];
        ost_elasticity_clear(&elasticity);
        ost_elasticity_gather(&elasticity, field, first_tets, 2, NULL, places);
        assert_int_equal(elasticity.points, 2);
        for (int k = 0; k < 2 * OST_SIMD_WIDTH; k++) {
            double c[36];
            ost_field_stiffness(field, first_tets[k / 2], c);
            for (int p = 0, n = 0; p < 6; p++)
                for (int q = p; q < 6; q++)
                    assert_close(elasticity.c[k % 2][n++][k / 2], c[6 * p + q], 1e-11 * c[0]);
        }
        ost_field_destroy(&field);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(elasticity_at_points_has_the_axes_there),
    cmocka_unit_test(the_metric_about_a_line_is_that_of_its_axes),
    cmocka_unit_test(the_familys_elasticity_is_the_rotated_one),
    cmocka_unit_test(stiffness_by_the_metric_is_that_by_the_elasticity),
    cmocka_unit_test(other_shear_has_no_metric),
    cmocka_unit_test(lanes_hold_each_tets_elasticity),
    cmocka_unit_test(lanes_of_several_regions_hold_theirs),
    cmocka_unit_test(a_uniform_region_is_gathered_once),
    cmocka_unit_test(a_formula_is_evaluated_at_the_points_of_each_tet),
    cmocka_unit_test(directions_are_followed_at_the_points_of_each_tet),
    cmocka_unit_test(a_split_elasticity_keeps_its_digits_next_to_incompressible),
};

OST_TEST_MAIN(tests)
