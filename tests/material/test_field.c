/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "material/axes_formula.h"
#include "material/directions.h"
#include "material/field_data.h"
#include "material/random.h"
#include "material/turn.h"

enum { TETS = 6 };

static const int32_t one_region[TETS] = {0};
static const int32_t two_regions[TETS] = {0, 1, 0, 1, 1, 0};
static const OstGlobal labels[TETS] = {101, 102, 103, 104, 105, 106};
static const double centroids[3 * TETS] = {1, 0, 0, 0, 1, 0, -1, 0, 2, 0, -1, 3, 1, 1, 4, 2, 1, 5};
static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static OstMaterial isotropic(void)
{
    const OstOrthotropic constants = ost_orthotropic_isotropic(5.0, 0.3);
    OstMaterial material;
    assert_success(ost_material_create(ctx, "rubber", &constants, 1.5, &material));
    return material;
}

static OstMaterial orthotropic(void)
{
    const double e[3] = {1, 10, 100};
    const OstOrthotropic constants = ost_orthotropic_family(e, 0.3, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    assert_success(ost_material_create(ctx, "wood", &constants, 0.7, &material));
    return material;
}

static const OstAxesSpec cylindrical = {
    .kind = OST_AXES_CYLINDRICAL, .axis = {0, 0, 1}, .order = {OST_RADIAL, OST_TANGENTIAL, OST_AXIAL}};
static const OstAxesSpec fixed = {.kind = OST_AXES_FIXED, .fixed = {0, 1, 0, 0, 0, 1, 1, 0, 0}};

typedef struct Booked {
    size_t orthotropy, varying;
    long orthotropy_entries, varying_entries;
} Booked;

static Booked booked(void)
{
    const OstLedgerEntry a = ost_ledger_entry(ctx, OST_EFFECT_ORTHOTROPY);
    const OstLedgerEntry b = ost_ledger_entry(ctx, OST_EFFECT_VARYING_AXES);
    return (Booked){a.bytes, b.bytes, a.entries, b.entries};
}

/* What a formula takes, beyond its curve. */
static const size_t formula_bytes = sizeof(OstAxesFormula *) + sizeof(OstAxesFormula);

static void assert_tet_is(const OstMaterialField *field, OstLocal tet, const OstMaterial *material,
                          const double axes[9])
{
    double expected[36], stiffness[36], found[9];
    ost_material_rotate_stiffness(material->stiffness, axes, expected);
    ost_field_stiffness(field, tet, stiffness);
    for (int i = 0; i < 36; i++)
        assert_close(stiffness[i], expected[i], 1e-14 * material->stiffness[14]);
    ost_field_axes(field, tet, found);
    assert_axes(found, axes, 1e-15);
    assert_close(ost_field_density(field, tet), material->density, 0.0);
}

static void an_isotropic_body_carries_no_axes(void **state)
{
    const OstMaterial materials[2] = {isotropic(), isotropic()};
    const OstAxesSpec specs[2] = {cylindrical, fixed};
    const Booked before = booked();
    OstMaterialField *field = NULL;
    assert_success(
        ost_field_create(ctx, NULL, 2, materials, specs, TETS, two_regions, labels, centroids, NULL, &field));
    const Booked after = booked();
    assert_int_equal(after.orthotropy, 0);
    assert_int_equal(after.varying, 0);
    assert_int_equal(after.orthotropy_entries, before.orthotropy_entries);
    assert_int_equal(after.varying_entries, before.varying_entries);
    assert_null(field->tet_turn);
    assert_null(field->region_axes);
    for (OstLocal t = 0; t < TETS; t++)
        assert_tet_is(field, t, &materials[0], world);
    ost_field_destroy(&field);
    assert_null(field);
}

static void fixed_axes_cost_nothing_per_tet(void **state)
{
    const OstMaterial material = orthotropic();
    const Booked before = booked();
    const size_t bytes_before = ost_ledger_bytes(ctx);
    OstMaterialField *field = NULL;
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, &fixed, TETS, one_region, labels, centroids, NULL, &field));
    const Booked after = booked();
    assert_int_equal(after.orthotropy, 9 * sizeof(double));
    assert_int_equal(after.varying, 0);
    assert_int_equal(after.orthotropy_entries, before.orthotropy_entries + 1);
    assert_int_equal(after.varying_entries, before.varying_entries);
    assert_null(field->tet_turn);
    for (OstLocal t = 0; t < TETS; t++)
        assert_tet_is(field, t, &material, fixed.fixed);
    const size_t held = ost_ledger_bytes(ctx) - bytes_before;
    assert_int_equal(held, sizeof(OstMaterialField) + sizeof(OstMaterial) + (36 + 9) * sizeof(double) + 1);
    ost_field_destroy(&field);
    assert_int_equal(ost_ledger_bytes(ctx), bytes_before);
}

/* Kept as quaternions, whichever of its four numbers is the largest; half turns have none but one. */
static void axes_survive_being_kept(void **state)
{
    static const double axis[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {-1, 2, 0.1}, {0, -3, 2}};
    for (size_t a = 0; a < sizeof axis / sizeof axis[0]; a++)
        for (int step = 0; step <= 12; step++) {
            const double size = sqrt(axis[a][0] * axis[a][0] + axis[a][1] * axis[a][1] + axis[a][2] * axis[a][2]);
            const double angle = 3.14159265358979323846 * step / 6.0, c = cos(angle), s = sin(angle);
            const double n[3] = {axis[a][0] / size, axis[a][1] / size, axis[a][2] / size};
            const double cross[9] = {0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0};
            double axes[9], turn[4], again[9];
            for (int i = 0; i < 9; i++) /* Rodrigues */
                axes[i] = (i % 4 == 0 ? c : 0.0) + (1.0 - c) * n[i / 3] * n[i % 3] + s * cross[i];
            ost_turn_of_axes(axes, turn);
            OST_AXES_OF_TURN(turn, again);
            assert_axes(again, axes, 1e-15);
        }
}

static void varying_axes_are_kept_by_tet(void **state)
{
    const OstMaterial material = orthotropic();
    OstMaterialField *field = NULL;
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, &cylindrical, TETS, one_region, labels, centroids, NULL, &field));
    assert_int_equal(booked().orthotropy, 9 * sizeof(double));
    assert_int_equal(booked().varying, 4 * TETS * sizeof(double) + formula_bytes);
    for (OstLocal t = 0; t < TETS; t++) {
        double axes[9];
        assert_success(ost_axes_at(ctx, &cylindrical, centroids + 3 * t, axes));
        assert_tet_is(field, t, &material, axes);
    }
    ost_field_destroy(&field);
    assert_int_equal(booked().varying, 0);
    assert_int_equal(booked().orthotropy, 0);
}

static void each_region_keeps_its_own_ways(void **state)
{
    const OstMaterial materials[4] = {orthotropic(), isotropic(), orthotropic(), orthotropic()};
    const OstAxesSpec specs[4] = {cylindrical, cylindrical, fixed, {.kind = OST_AXES_NONE}};
    const int32_t regions[TETS] = {0, 1, 2, 3, 0, 2};
    OstMaterialField *field = NULL;
    assert_success(ost_field_create(ctx, NULL, 4, materials, specs, TETS, regions, labels, centroids, NULL, &field));
    for (OstLocal t = 0; t < TETS; t++) {
        double axes[9];
        if (regions[t] == 0)
            assert_success(ost_axes_at(ctx, &cylindrical, centroids + 3 * t, axes));
        else
            memcpy(axes, regions[t] == 2 ? fixed.fixed : world, sizeof axes);
        assert_tet_is(field, t, &materials[regions[t]], axes);
    }
    ost_field_destroy(&field);
}

static void a_curve_is_followed(void **state)
{
    double points[9] = {0, 0, -1, 0, 0, 3, 1, 0, 9};
    double same[9] = {0, 0, -1, 0, 0, 3, 1, 0, 9};
    const OstAxesSpec spec = {
        .kind = OST_AXES_CURVE, .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}, .point_count = 3, .points = points};
    OstAxesSpec unchanged = spec;
    unchanged.points = same;
    const OstMaterial material = orthotropic();
    OstMaterialField *field = NULL;
    assert_success(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, NULL, &field));
    const size_t curve_bytes = 3 * 9 * sizeof(double); /* points, tangents, normals */
    assert_int_equal(booked().varying, 4 * TETS * sizeof(double) + formula_bytes + curve_bytes);
    memset(points, 0, sizeof points); /* the field has its own */
    for (OstLocal t = 0; t < TETS; t++) {
        double axes[9];
        assert_success(ost_axes_at(ctx, &unchanged, centroids + 3 * t, axes));
        assert_tet_is(field, t, &material, axes);
    }
    ost_field_destroy(&field);
}

static void given_axes_are_taken_and_bad_ones_refused_by_tet(void **state)
{
    const OstMaterial material = orthotropic();
    const OstAxesSpec spec = {.kind = OST_AXES_CELLS};
    double given[9 * TETS];
    OstMaterialField *field = NULL;
    for (OstLocal t = 0; t < TETS; t++)
        random_axes(given + 9 * t);
    assert_success(
        ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, given, &field));
    for (OstLocal t = 0; t < TETS; t++)
        assert_tet_is(field, t, &material, given + 9 * t);
    ost_field_destroy(&field);
    for (int i = 0; i < 3; i++)
        given[9 * 3 + 6 + i] *= -1.0;
    assert_failure(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, given, &field),
                   OST_INVALID_INPUT, "tet 104 (material 'wood'): given axes: the axes are left-handed");
    assert_null(field);
    for (int i = 0; i < 3; i++)
        given[9 * 1 + i] *= 1.5;
    assert_failure(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, given, &field),
                   OST_INVALID_INPUT, "tet 102 (material 'wood'): given axes: e1 has length 1.5");
    assert_failure(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, NULL, &field),
                   OST_INVALID_INPUT, "tet by tet, but the mesh brings none");
}

static void bad_axes_regions_and_points_are_refused(void **state)
{
    const OstMaterial material = orthotropic(), plain = isotropic();
    OstAxesSpec spec = {.kind = OST_AXES_FIXED, .fixed = {1, 0, 0, 0, 1, 0, 0, 0, -1}};
    OstMaterialField *field = NULL;
    assert_failure(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, NULL, &field),
                   OST_INVALID_INPUT, "axes of material 'wood': the axes are left-handed");
    assert_failure(ost_field_create(ctx, NULL, 1, &plain, &spec, TETS, one_region, labels, centroids, NULL, &field),
                   OST_INVALID_INPUT, "axes of material 'rubber': the axes are left-handed");
    assert_failure(ost_field_create(ctx, NULL, 1, &material, NULL, TETS, two_regions, labels, centroids, NULL, &field),
                   OST_INVALID_INPUT, "tet 102 is of region 1");
    spec = cylindrical;
    spec.origin[0] = 1.0; /* the first centroid is on the axis */
    assert_failure(ost_field_create(ctx, NULL, 1, &material, &spec, TETS, one_region, labels, centroids, NULL, &field),
                   OST_INVALID_INPUT, "tet 101 (material 'wood'): the point (1, 0, 0) lies on the cylinder's axis");
    assert_null(field);
}

static void a_rank_without_tets_has_a_field_too(void **state)
{
    const OstMaterial material = orthotropic();
    const OstAxesSpec spec = {.kind = OST_AXES_CELLS};
    OstMaterialField *field = NULL;
    assert_success(ost_field_create(ctx, NULL, 1, &material, &spec, 0, NULL, NULL, NULL, NULL, &field));
    assert_int_equal(booked().varying, 0);
    ost_field_destroy(&field);
}

static void a_formula_gives_axes_at_any_point(void **state)
{
    const OstMaterial materials[2] = {orthotropic(), orthotropic()};
    const OstAxesSpec specs[2] = {cylindrical, fixed};
    const double point[3] = {0.3, -0.4, 2.0};
    const double on_axis[3] = {0.0, 0.0, 1.0};
    double axes[9], expected[9];
    OstMaterialField *field = NULL;
    assert_success(
        ost_field_create(ctx, NULL, 2, materials, specs, TETS, two_regions, labels, centroids, NULL, &field));
    assert_true(ost_field_has_formula(field, 0));
    assert_false(ost_field_has_formula(field, 1));
    assert_success(ost_axes_at(ctx, &cylindrical, point, expected));
    ost_field_axes_at(field, 0, NULL, point, axes);
    assert_axes(axes, expected, 1e-15);
    ost_field_axes_at(field, 1, NULL, point, axes);
    assert_axes(axes, fixed.fixed, 1e-15);
    ost_field_axes_at(field, 0, NULL, on_axis, axes); /* not defined there: the tet's own */
    assert_success(ost_axes_at(ctx, &cylindrical, centroids, expected));
    assert_axes(axes, expected, 1e-15);
    ost_field_destroy(&field);
}

/* C - m m' resists the mode's strain as a material with the limit's Poisson's ratio does. */
static void assert_splits(const OstMaterial *material, const double m[3], double nu, double limit)
{
    const double *modulus = material->constants.youngs_modulus;
    const double w = 1.0 / sqrt(3.0);
    for (int p = 0; p < 3; p++) {
        double rest = 0.0, whole = 0.0;
        for (int q = 0; q < 3; q++) {
            const double strain = w / sqrt(modulus[q]);
            whole += material->stiffness[6 * p + q] * strain;
            rest += (material->stiffness[6 * p + q] - m[p] * m[q]) * strain;
        }
        assert_close(whole * (1.0 - 2.0 * nu) / (w * sqrt(modulus[p])), 1.0, 1e-11);
        assert_close(rest * (1.0 - 2.0 * limit) / (w * sqrt(modulus[p])), 1.0, 1e-9);
    }
}

static void the_stiff_mode_of_nearly_incompressible_regions_is_found(void **state)
{
    const double e[3] = {1, 10, 100};
    const double nu[3] = {0.3, 0.4999, 0.47};
    OstMaterial materials[3];
    OstMaterialField *field = NULL;
    int regions = 0;
    for (int r = 0; r < 3; r++) {
        const OstOrthotropic constants =
            r == 2 ? ost_orthotropic_isotropic(5.0, nu[r]) : ost_orthotropic_family(e, nu[r], OST_SHEAR_GEOMETRIC);
        assert_success(ost_material_create(ctx, "rubber", &constants, 0.0, &materials[r]));
    }
    const size_t before = ost_ledger_bytes(ctx);
    assert_success(ost_field_create(ctx, NULL, 3, materials, NULL, TETS, one_region, labels, centroids, NULL, &field));
    const size_t plain = ost_ledger_bytes(ctx);
    assert_success(ost_field_mean_dilatation(field, 0.49995, &regions));
    assert_int_equal(regions, 0);
    assert_int_equal(ost_ledger_bytes(ctx), plain);
    assert_success(ost_field_mean_dilatation(field, 0.45, &regions));
    assert_int_equal(regions, 2);
    assert_null(ost_field_stiff_mode(field, 0));
    assert_splits(&materials[1], ost_field_stiff_mode(field, 1), nu[1], 0.45);
    assert_splits(&materials[2], ost_field_stiff_mode(field, 2), nu[2], 0.45);
    /* isotropic: the bulk modulus E / (3 (1 - 2 nu)), less that of the limit */
    for (int a = 0; a < 3; a++)
        assert_close(pow(ost_field_stiff_mode(field, 2)[a], 2.0), 5.0 / 3.0 * (1.0 / 0.06 - 1.0 / 0.1), 1e-12);
    assert_success(ost_field_mean_dilatation(field, 0.5, &regions)); /* none again */
    assert_int_equal(regions, 0);
    assert_null(ost_field_stiff_mode(field, 1));
    ost_field_destroy(&field);
    assert_int_equal(ost_ledger_bytes(ctx), before);
}

/* Near nu = 1/2 the mode is 1e10 times as stiff as the rest, which keeps all its digits: along sqrt(E) times what is at
 * right angles to the mode, C of the family is E^(1/2) w / (1 + nu), and along the mode it is that of the limit. */
static void the_rest_keeps_its_digits_next_to_incompressible(void **state)
{
    const double e[3] = {1, 10, 100}, nu = 0.5 - 1e-10;
    const double shape[3][3] = {{1, 1, 1}, {1, -1, 0}, {1, 1, -2}};
    const double expected[3] = {1.0 / (1.0 - 2.0 * 0.45), 1.0 / (1.0 + nu), 1.0 / (1.0 + nu)};
    const OstOrthotropic constants = ost_orthotropic_family(e, nu, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    OstMaterialField *field = NULL;
    int regions = 0;
    assert_success(ost_material_create(ctx, "gel", &constants, 0.0, &material));
    assert_success(ost_field_create(ctx, NULL, 1, &material, NULL, TETS, one_region, labels, centroids, NULL, &field));
    assert_null(ost_field_rest(field, 0));
    assert_success(ost_field_mean_dilatation(field, 0.45, &regions));
    assert_int_equal(regions, 1);
    const double *rest = ost_field_rest(field, 0);
    for (int k = 0; k < 3; k++)
        for (int p = 0; p < 3; p++) {
            double stress = 0.0;
            for (int q = 0; q < 3; q++)
                stress += rest[6 * p + q] * shape[k][q] / sqrt(e[q]);
            assert_close(stress / sqrt(e[p]), expected[k] * shape[k][p], 1e-13 * expected[k]);
        }
    for (int p = 3; p < 6; p++)
        assert_close(rest[7 * p], material.stiffness[7 * p], 0.0);
    ost_field_destroy(&field);
}

static void two_stiff_modes_are_left_alone(void **state)
{
    const OstOrthotropic constants = ost_orthotropic_isotropic(5.0, -0.97); /* 1 + nu twice */
    OstMaterial material;
    OstMaterialField *field = NULL;
    int regions = 1;
    assert_success(ost_material_create(ctx, "foam", &constants, 0.0, &material));
    assert_success(ost_field_create(ctx, NULL, 1, &material, NULL, TETS, one_region, labels, centroids, NULL, &field));
    assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
    assert_int_equal(regions, 0);
    ost_field_destroy(&field);
}

/* Radial vectors are linear: axes within the tet are the cylinder's. One that is far off has the tet keep its own. */
static void directions_at_vertices_give_axes_within_the_tet(void **state)
{
    const double x[12] = {1, 0, 0, 1.3, 0.5, 0, 0.9, 0.4, 0.2, 1, 0.3, 0.7}, at[4] = {0.1, 0.2, 0.3, 0.4};
    const OstAxesSpec spec = {
        .kind = OST_AXES_CYLINDRICAL, .axis = {0, 0, 1}, .order = {OST_TANGENTIAL, OST_RADIAL, OST_AXIAL}};
    const int along[2] = {1, 0};
    const signed char kept[2] = {1, 0};
    double place[3] = {0.0}, radial[12] = {0.0}, around[12] = {0.0}, own[9], expected[9], axes[9];
    float directions[OST_DIRECTIONS];
    for (int v = 0; v < 4; v++)
        for (int i = 0; i < 3; i++) {
            place[i] += at[v] * x[3 * v + i];
            radial[3 * v + i] = (v == 2 ? -1e-100 : 1e-100) * (i < 2 ? x[3 * v + i] : 0.0); /* whatever its sense */
            around[3 * v + i] = 1e100 * (i == 0 ? -x[3 * v + 1] : i == 1 ? x[3 * v] : 0.0);
        }
    assert_success(ost_axes_at(ctx, &spec, (const double[3]){1.05, 0.3, 0.2}, own));
    assert_success(ost_axes_at(ctx, &spec, place, expected));
    ost_directions_set_linear(own, along, radial, around, directions);
    assert_success(ost_directions_at(ctx, directions, kept, at, axes));
    assert_axes(axes, expected, 1e-6);
    ost_directions_set_linear(own, along, radial, NULL, directions); /* e1 across it, as the tet has it */
    assert_success(ost_directions_at(ctx, directions, kept, at, axes));
    assert_axes(axes, expected, 1e-6);
    memcpy(radial, around, 3 * sizeof *radial);
    ost_directions_set_linear(own, along, radial, around, directions);
    assert_success(ost_directions_at(ctx, directions, kept, at, axes));
    assert_axes(axes, own, 1e-6);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_isotropic_body_carries_no_axes),
    cmocka_unit_test(fixed_axes_cost_nothing_per_tet),
    cmocka_unit_test(axes_survive_being_kept),
    cmocka_unit_test(varying_axes_are_kept_by_tet),
    cmocka_unit_test(each_region_keeps_its_own_ways),
    cmocka_unit_test(a_curve_is_followed),
    cmocka_unit_test(given_axes_are_taken_and_bad_ones_refused_by_tet),
    cmocka_unit_test(bad_axes_regions_and_points_are_refused),
    cmocka_unit_test(a_formula_gives_axes_at_any_point),
    cmocka_unit_test(directions_at_vertices_give_axes_within_the_tet),
    cmocka_unit_test(the_stiff_mode_of_nearly_incompressible_regions_is_found),
    cmocka_unit_test(the_rest_keeps_its_digits_next_to_incompressible),
    cmocka_unit_test(two_stiff_modes_are_left_alone),
    cmocka_unit_test(a_rank_without_tets_has_a_field_too),
};

OST_TEST_MAIN(tests)
