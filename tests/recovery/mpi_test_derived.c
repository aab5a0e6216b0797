/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "recovery/derived.h"
#include "recovery/recovery.h"

static const double slope[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};

enum { MOST = 9 };

static unsigned everything(void)
{
    return (1U << OST_FIELD_COUNT) - 1U - (1U << OST_FIELD_ERROR) - (1U << OST_FIELD_MIXED_PRESSURE);
}

/* u = gradient x */
static void displace(OstResult *result, const double gradient[9])
{
    const OstMesh *mesh = result->mesh;
    result->displacement = numbers(3 * (size_t)mesh->node_count);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        ost_apply3(gradient, mesh->coordinates + 3 * node, result->displacement + 3 * node);
}

static void release(OstResult *result)
{
    free(result->displacement);
    OST_FREE(result->strain, result->stress, result->strain_energy_density, result->node_stress, result->rotation);
}

static double *derive(const OstResult *result, OstOutputFieldBit field)
{
    double *values = numbers(MOST * (size_t)result->mesh->owned_tets);
    assert_true(ost_output_field(field).is_derived);
    assert_true(ost_result_can_derive(result, field));
    assert_success(ost_result_derive(result, field, values));
    return values;
}

static const OstStrength strengths = {.known = 1,
                                      .tension = {4.0, 3.0, 2.0},
                                      .compression = {2.5, 3.5, 5.0},
                                      .shear = {1.5, 2.0, 2.5},
                                      .interaction = {-0.5, -0.5, -0.5}};

/* One strain along axes that differ from tet to tet: C in material axes makes of it the stress along them. */
static void stress_and_strain_follow_the_axes(void **state)
{
    OstMesh *mesh = make_body(ctx);
    OstMaterial material = make_material(ctx, 1);
    material.strength = strengths;
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
    displace(&result, slope);
    assert_success(ost_result_recover(&result, everything()));
    double *strain = derive(&result, OST_FIELD_MATERIAL_STRAIN), *stress = derive(&result, OST_FIELD_MATERIAL_STRESS);
    double *e2 = derive(&result, OST_FIELD_E2), *tsai_wu = derive(&result, OST_FIELD_TSAI_WU);
    const double size = largest(ctx, 6 * mesh->owned_tets, stress);
    double least = OST_MOST_LOAD_FACTOR;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        double axes[9], along[9], doubled[6], expected[6];
        axes_of(mesh->tet_label[tet], axes);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                double row[3];
                ost_apply3_transposed(slope, axes + 3 * a, row);
                along[3 * a + b] = ost_dot3(row, axes + 3 * b);
            }
        for (int p = 0; p < 6; p++) {
            const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
            const double tensor = 0.5 * (along[3 * i + j] + along[3 * j + i]);
            assert_close(strain[6 * tet + p], tensor, 1e-13);
            doubled[p] = (p < 3 ? 1.0 : 2.0) * tensor;
        }
        ost_apply6(material.stiffness, doubled, expected);
        for (int p = 0; p < 6; p++)
            assert_close(stress[6 * tet + p] / size, expected[p] / size, 1e-12);
        for (int i = 0; i < 3; i++)
            assert_close(e2[3 * tet + i], axes[3 + i], 1e-14);
        const double factor = ost_load_factor(&strengths, OST_TSAI_WU, expected);
        assert_close(tsai_wu[tet] / factor, 1.0, 1e-10);
        least = fmin(least, factor);
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, ost_comm(ctx));
    assert_true(result.failure.known && least < 1.0);
    assert_close(result.failure.least[OST_TSAI_WU].factor / least, 1.0, 1e-10);
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        if (mesh->tet_label[tet] == result.failure.least[OST_TSAI_WU].tet)
            assert_close(tsai_wu[tet] / least, 1.0, 1e-9);
    free(strain);
    free(stress);
    free(e2);
    free(tsai_wu);
    release(&result);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* What is made of the stress in world axes, against its definition. */
static void invariants_are_those_of_the_stress(void **state)
{
    OstMesh *mesh = make_body(ctx);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
    displace(&result, slope);
    assert_success(ost_result_recover(&result, 1U << OST_FIELD_PRINCIPAL_STRESS | 1U << OST_FIELD_PRINCIPAL_STRAIN));
    assert_false(result.failure.known);
    assert_false(ost_result_can_derive(&result, OST_FIELD_HILL));
    double *value = derive(&result, OST_FIELD_PRINCIPAL_STRESS), *strain = derive(&result, OST_FIELD_PRINCIPAL_STRAIN);
    double *mises = derive(&result, OST_FIELD_VON_MISES), *pressure = derive(&result, OST_FIELD_PRESSURE);
    double *line[3];
    for (int k = 0; k < 3; k++)
        line[k] = derive(&result, (OstOutputFieldBit)(OST_FIELD_PRINCIPAL_DIRECTION_1 + k));
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        const double *s = result.stress + 6 * tet, *v = value + 3 * tet;
        const double size = fmax(fabs(v[0]), fabs(v[2]));
        assert_true(v[0] >= v[1] && v[1] >= v[2]);
        for (int k = 0; k < 3; k++) {
            const double *n = line[k] + 3 * tet;
            const double sn[3] = {s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
                                  s[5] * n[0] + s[4] * n[1] + s[2] * n[2]};
            assert_close(ost_norm3(n), 1.0, 1e-13);
            for (int i = 0; i < 3; i++)
                assert_close((sn[i] - v[k] * n[i]) / size, 0.0, 1e-13);
        }
        const double spread = pow(v[0] - v[1], 2) + pow(v[1] - v[2], 2) + pow(v[2] - v[0], 2);
        assert_close(mises[tet] / size, sqrt(0.5 * spread) / size, 1e-13);
        assert_close(pressure[tet] / size, -(v[0] + v[1] + v[2]) / (3.0 * size), 1e-13);
        assert_close(strain[3 * tet] + strain[3 * tet + 1] + strain[3 * tet + 2], 0.1 - 0.2 + 0.3, 1e-13);
    }
    for (int k = 0; k < 3; k++)
        free(line[k]);
    free(value);
    free(strain);
    free(mises);
    free(pressure);
    release(&result);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* A stretched body that is then turned has the same stress along its material axes, which turn with it. */
static void a_turned_body_has_the_same_stress_along_its_axes(void **state)
{
    const double stretch[9] = {1.1, 0.02, -0.03, 0.02, 0.8, 0.04, -0.03, 0.04, 1.3}, angle = 1.2;
    const double turn[9] = {cos(angle), -sin(angle), 0.0, sin(angle), cos(angle), 0.0, 0.0, 0.0, 1.0};
    OstMesh *mesh = make_body(ctx);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    double *stress[2], *strain[2];
    for (int turned = 0; turned < 2; turned++) {
        OstResult result = {.ctx = ctx, .mesh = mesh, .field = field, .formulation = OST_FORMULATION_CONSISTENT};
        double gradient[9];
        ost_multiply3(turn, stretch, gradient);
        if (!turned)
            memcpy(gradient, stretch, sizeof gradient);
        for (int i = 0; i < 3; i++)
            gradient[4 * i] -= 1.0;
        displace(&result, gradient);
        assert_success(ost_result_recover(&result, everything()));
        assert_non_null(result.rotation);
        stress[turned] = derive(&result, OST_FIELD_MATERIAL_STRESS);
        strain[turned] = derive(&result, OST_FIELD_MATERIAL_STRAIN);
        release(&result);
    }
    const double size = largest(ctx, 6 * mesh->owned_tets, stress[0]);
    for (OstLocal i = 0; i < 6 * mesh->owned_tets; i++) {
        assert_close(stress[1][i] / size, stress[0][i] / size, 1e-12);
        assert_close(strain[1][i], strain[0][i], 1e-13);
    }
    for (int turned = 0; turned < 2; turned++) {
        free(stress[turned]);
        free(strain[turned]);
    }
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(stress_and_strain_follow_the_axes),
    cmocka_unit_test(invariants_are_those_of_the_stress),
    cmocka_unit_test(a_turned_body_has_the_same_stress_along_its_axes),
};

OST_TEST_MAIN(tests)
