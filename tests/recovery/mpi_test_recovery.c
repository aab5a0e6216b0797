/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "element/element.h"
#include "orthostat/refine.h"
#include "recovery/recovery.h"

enum {
    EVERYTHING = 1U << OST_FIELD_STRAIN | 1U << OST_FIELD_STRESS | 1U << OST_FIELD_ENERGY | 1U << OST_FIELD_NODE_STRESS
};

/* The irregular body; quadratic, with inner middles off their edges by up to `bend`, or linear. */
static OstMesh *make_mesh(int order, double bend)
{
    OstMesh *linear = make_body(ctx);
    OstMesh *mesh = NULL;
    if (order == 1)
        return linear;
    assert_success(ost_mesh_raise(linear, NULL, &mesh));
    ost_mesh_destroy(&linear);
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double *x = mesh->coordinates + 3 * node;
        if (!is_on_surface(x))
            for (int i = 0; i < 3; i++)
                x[i] += bend * random_of(mesh->node_label[node], 20 + i);
    }
    return mesh;
}

static void displace(OstResult *result, void (*at)(const double *, double *))
{
    const OstMesh *mesh = result->mesh;
    result->displacement = numbers(3 * (size_t)mesh->node_count);
    for (OstLocal node = 0; node < mesh->node_count; node++)
        at(mesh->coordinates + 3 * node, result->displacement + 3 * node);
}

static void release(OstResult *result)
{
    free(result->displacement);
    OST_FREE(result->strain, result->stress, result->strain_energy_density, result->node_stress);
}

static const double slope[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};

static void linear_at(const double *x, double u[3])
{
    ost_apply3(slope, x, u);
}

static void quadratic_at(const double *x, double u[3])
{
    u[0] = 0.1 * x[0] * x[0] + 0.2 * x[1] * x[2];
    u[1] = 0.3 * x[0] * x[2] - 0.2 * x[1] * x[1];
    u[2] = 0.1 * x[2] * x[2] - 0.3 * x[0] * x[1];
}

static void strain_of_quadratic(const double *x, double strain[6])
{
    strain[0] = 0.2 * x[0];
    strain[1] = -0.4 * x[1];
    strain[2] = 0.2 * x[2];
    strain[3] = 0.2 * x[2] + 0.3 * x[2];
    strain[4] = 0.3 * x[0] - 0.3 * x[0];
    strain[5] = 0.2 * x[1] - 0.3 * x[1];
}

static void stress_of(const double c[36], const double strain[6], double stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = 0.0;
        for (int q = 0; q < 6; q++)
            stress[p] += c[6 * p + q] * strain[q];
    }
}

static OstMaterial nearly_incompressible(void)
{
    const double modulus[3] = {1000.0, 10.0, 50.0};
    const OstOrthotropic constants = ost_orthotropic_family(modulus, 0.49, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    assert_success(ost_material_create(ctx, "rubber", &constants, 3.0, &material));
    return material;
}

/* Linear, straight quadratic, curved, curved with C split; ghosts too. */
static void a_uniform_strain_has_one_stress_everywhere(void **state)
{
    const double strain[6] = {slope[0],           slope[4], slope[8], slope[1] + slope[3], slope[5] + slope[7],
                              slope[6] + slope[2]};
    for (int kind = 0; kind < 4; kind++) {
        OstMesh *mesh = make_mesh(kind == 0 ? 1 : 2, kind < 2 ? 0.0 : 0.03);
        const OstMaterial material = kind < 3 ? make_material(ctx, 1) : nearly_incompressible();
        OstMaterialField *field = make_field(mesh, &material, AXES_SAME_BY_TET);
        OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
        double axes[9], c[36], stress[6], energy = 0.0;
        int regions = 0;
        assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
        assert_int_equal(regions, kind == 3);
        axes_of(7, axes);
        ost_material_rotate_stiffness(material.stiffness, axes, c);
        stress_of(c, strain, stress);
        const double size = largest(ctx, 6, stress);
        for (int p = 0; p < 6; p++)
            energy += 0.5 * stress[p] * strain[p];
        displace(&result, linear_at);
        assert_success(ost_result_recover(&result, EVERYTHING));
        for (OstLocal i = 0; i < 6 * mesh->owned_tets; i++) {
            assert_close(result.strain[i], strain[i % 6], 1e-13);
            assert_close(result.stress[i] / size, stress[i % 6] / size, 1e-12);
            assert_close(result.strain_energy_density[i / 6] / energy, 1.0, 1e-12);
        }
        for (OstLocal i = 0; i < 6 * mesh->node_count; i++)
            assert_close(result.node_stress[i] / size, stress[i % 6] / size, 1e-12);
        release(&result);
        ost_field_destroy(&field);
        ost_mesh_destroy(&mesh);
    }
}

static void nodes_of_quadratic_tets_have_the_stress_of_a_quadratic_field(void **state)
{
    OstMesh *mesh = make_mesh(2, 0.0);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
    double c[36];
    ost_field_stiffness(field, 0, c);
    displace(&result, quadratic_at);
    assert_success(ost_result_recover(&result, 1U << OST_FIELD_NODE_STRESS));
    assert_null(result.stress);
    assert_null(result.strain);
    assert_null(result.strain_energy_density);
    const double size = largest(ctx, 6 * mesh->node_count, result.node_stress);
    assert_true(size > 1.0);
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double strain[6], stress[6];
        strain_of_quadratic(mesh->coordinates + 3 * node, strain);
        stress_of(c, strain, stress);
        for (int p = 0; p < 6; p++)
            assert_close(result.node_stress[6 * node + p] / size, stress[p] / size, 1e-12);
    }
    release(&result);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* Of curved tets with C split by axes that differ from tet to tet: the tets' energies are ½ u·Ku. */
static void the_energies_of_the_tets_add_up(void **state)
{
    OstMesh *mesh = make_mesh(2, 0.03);
    const OstMaterial material = nearly_incompressible();
    OstMaterialField *field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    const OstElement *element = ost_element_of(10);
    OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
    double energy = 0.0;
    int regions = 0;
    assert_success(ost_field_mean_dilatation(field, OST_NEARLY_INCOMPRESSIBLE, &regions));
    displace(&result, quadratic_at);
    assert_success(ost_result_recover(&result, EVERYTHING));
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        double x[30];
        for (int n = 0; n < 30; n++)
            x[n] = mesh->coordinates[3 * mesh->tet_nodes[10 * tet + n / 3] + n % 3];
        energy += result.strain_energy_density[tet] * element->volume(x);
    }
    double *force = numbers(3 * (size_t)mesh->owned_nodes);
    assert_success(ost_internal_force(mesh, field, 0.0, result.displacement, force, NULL));
    const double work = 0.5 * dot(ctx, 3 * mesh->owned_nodes, result.displacement, force);
    assert_close(sum_over_ranks(ctx, energy) / work, 1.0, 1e-12);
    free(force);
    release(&result);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

/* Two materials side by side under one strain: where they meet, nodes show the first. */
static void nodes_between_regions_belong_to_the_first(void **state)
{
    for (int order = 1; order <= 2; order++) {
        OstMesh *mesh = make_mesh(order, 0.0);
        const OstMaterial materials[2] = {make_material(ctx, 0), make_material(ctx, 1)};
        const OstAxesSpec axes[2] = {{.kind = OST_AXES_NONE}, {.kind = OST_AXES_NONE}};
        OstMaterialField *field = NULL;
        double *centroids = numbers(3 * (size_t)mesh->tet_count);
        unsigned char *touched = calloc((size_t)mesh->node_count + 1, 1);
        const double strain[6] = {slope[0],           slope[4], slope[8], slope[1] + slope[3], slope[5] + slope[7],
                                  slope[6] + slope[2]};
        double stress[2][6];
        assert_success(ost_mesh_tet_centroids(mesh, centroids));
        for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
            mesh->tet_region[tet] = centroids[3 * tet] < 1.0 ? 0 : 1;
            for (int a = 0; a < mesh->nodes_per_tet; a++)
                touched[mesh->tet_nodes[mesh->nodes_per_tet * tet + a]] |= mesh->tet_region[tet] == 0;
        }
        assert_success(ost_field_create(ctx, NULL, 2, materials, axes, mesh->tet_count, mesh->tet_region,
                                        mesh->tet_label, centroids, NULL, &field));
        OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
        displace(&result, linear_at);
        assert_success(ost_result_recover(&result, 1U << OST_FIELD_NODE_STRESS));
        for (int r = 0; r < 2; r++)
            stress_of(materials[r].stiffness, strain, stress[r]);
        for (OstLocal node = 0; node < mesh->owned_nodes; node++)
            for (int p = 0; p < 6; p++)
                assert_close(result.node_stress[6 * node + p], stress[!touched[node]][p], 1e-11);
        free(centroids);
        free(touched);
        release(&result);
        ost_field_destroy(&field);
        ost_mesh_destroy(&mesh);
    }
}

static void what_is_not_asked_for_is_not_made(void **state)
{
    OstMesh *mesh = make_mesh(1, 0.0);
    const OstMaterial material = make_material(ctx, 1);
    OstMaterialField *field = make_field(mesh, &material, AXES_FIXED);
    OstResult result = {.ctx = ctx, .mesh = mesh, .field = field};
    const long entries = ost_ledger_entry(ctx, OST_EFFECT_RECOVERY).entries;
    displace(&result, linear_at);
    assert_success(ost_result_recover(&result, 1U << OST_FIELD_DISPLACEMENT | 1U << OST_FIELD_REGION));
    assert_int_equal(ost_ledger_entry(ctx, OST_EFFECT_RECOVERY).entries, entries);
    assert_null(result.node_stress);
    assert_success(ost_result_recover(&result, 1U << OST_FIELD_STRESS));
    assert_non_null(result.stress);
    assert_null(result.node_stress);
    assert_null(result.strain);
    release(&result);
    ost_field_destroy(&field);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_uniform_strain_has_one_stress_everywhere),
    cmocka_unit_test(nodes_of_quadratic_tets_have_the_stress_of_a_quadratic_field),
    cmocka_unit_test(the_energies_of_the_tets_add_up),
    cmocka_unit_test(nodes_between_regions_belong_to_the_first),
    cmocka_unit_test(what_is_not_asked_for_is_not_made),
};

OST_TEST_MAIN(tests)
