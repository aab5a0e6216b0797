/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "guard/rigid_motion.h"
#include "orthostat/refine.h"

/* Rigid motion is free of force for every kind of tet; what is not so is found and named. */

enum { LINEAR, STRAIGHT, CURVED, CURVED_BY_MEAN, KINDS };

/* Rounding leaves a few 1e-16, times the slenderness of the body's tets (below 10), in sums of some 30 terms. */
static const double rounding = 1e-13;

typedef struct Body {
    OstMesh *mesh;
    OstMaterialField *field;
    OstSupports *supports;
    OstSystem *system;
    double *coordinates;
    double *modes;
} Body;

static OstMesh *make_mesh(int kind)
{
    OstMesh *linear = make_body(ctx);
    OstMesh *mesh = NULL;
    if (kind == LINEAR)
        return linear;
    assert_success(ost_mesh_raise(linear, NULL, &mesh));
    ost_mesh_destroy(&linear);
    for (OstLocal node = 0; node < mesh->node_count && kind != STRAIGHT; node++)
        for (int i = 0; i < 3 && !is_on_surface(mesh->coordinates + 3 * node); i++)
            mesh->coordinates[3 * node + i] += 0.03 * random_of(mesh->node_label[node], 20 + i);
    return mesh;
}

static OstMaterial material_of(int kind)
{
    const double modulus[3] = {1000.0, 1.0, 50.0};
    const OstOrthotropic rubber = ost_orthotropic_family(modulus, 0.499, OST_SHEAR_GEOMETRIC);
    OstMaterial material;
    if (kind != CURVED_BY_MEAN)
        return make_material(ctx, 1);
    assert_success(ost_material_create(ctx, "rubber", &rubber, 3.0, &material));
    return material;
}

static void hold_one_end(const OstMesh *mesh, OstSupports *supports)
{
    static const double oblique[3] = {1.0, 2.0, -1.0};
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *x = mesh->coordinates + 3 * node;
        for (int i = 0; i < 3 && x[0] < 1e-12 && x[1] < 0.7; i++)
            assert_success(ost_supports_constrain(supports, node, unit[i], 0.0));
        if (x[0] < 1e-12 && x[1] >= 0.7)
            assert_success(ost_supports_constrain(supports, node, oblique, 0.0));
    }
    assert_success(ost_supports_complete(supports));
}

static Body make(int kind, int held)
{
    Body body = {.mesh = make_mesh(kind)};
    const OstMaterial material = material_of(kind);
    int regions = 0;
    body.field = make_field(body.mesh, &material, AXES_RANDOM_BY_TET);
    if (kind == CURVED_BY_MEAN) {
        assert_success(ost_field_mean_dilatation(body.field, OST_NEARLY_INCOMPRESSIBLE, &regions));
        assert_int_equal(regions, 1);
    }
    assert_success(ost_supports_create(body.mesh, &body.supports));
    if (held)
        hold_one_end(body.mesh, body.supports);
    body.system = make_system(body.mesh, body.supports, body.field);
    body.coordinates = numbers(3 * (size_t)body.system->matrix->rows);
    body.modes = numbers(18 * (size_t)body.system->matrix->rows);
    assert_success(ost_system_geometry(body.system, body.field, body.coordinates, NULL, body.modes));
    return body;
}

static void destroy(Body *body)
{
    free(body->coordinates);
    free(body->modes);
    ost_system_destroy(&body->system);
    ost_supports_destroy(&body->supports);
    ost_field_destroy(&body->field);
    ost_mesh_destroy(&body->mesh);
}

static void every_kind_of_tet_is_free_in_rigid_motion(void **state)
{
    for (int kind = 0; kind < KINDS; kind++)
        for (int held = 0; held < 2; held++) {
            Body body = make(kind, held);
            double of_tets = -1.0, of_rows = -1.0;
            assert_success(ost_rigid_motion_of_tets(body.mesh, body.field, &of_tets));
            assert_success(ost_rigid_motion_of_rows(body.system, body.modes, &of_rows));
            assert_true(of_tets > 0.0 && of_tets < rounding);
            assert_true(of_rows > 0.0 && of_rows < rounding);
            destroy(&body);
        }
}

/* The near-null space is the six rigid modes about the middle of the rows, as far as supports leave them. */
static void multigrid_is_given_the_rigid_modes(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Body body = make(kind, 1);
        const OstLocal rows = body.system->matrix->rows;
        double middle[3];
        for (int i = 0; i < 3; i++) {
            double sum = 0.0;
            for (OstLocal row = 0; row < rows; row++)
                sum += body.coordinates[3 * row + i];
            middle[i] = sum_over_ranks(ctx, sum) / (double)body.system->matrix->global_rows;
        }
        for (OstLocal row = 0; row < rows; row++)
            for (int m = 0; m < 6; m++) {
                const double axis[3] = {m % 3 == 0, m % 3 == 1, m % 3 == 2};
                double arm[3], whole[3], projector[9], given[3], expected[3];
                for (int i = 0; i < 3; i++)
                    arm[i] = body.coordinates[3 * row + i] - middle[i];
                ost_cross3(axis, arm, whole);
                ost_supports_get(body.supports, body.system->node_of_row[row], projector, given);
                ost_apply3(projector, m < 3 ? axis : whole, expected);
                for (int i = 0; i < 3; i++)
                    assert_close(body.modes[3 * ((OstLocal)m * rows + row) + i], expected[i], 1e-13);
            }
        destroy(&body);
    }
}

/* A wrong sign in one turn, as one gets by taking the product the other way round. */
static void a_wrong_mode_is_named(void **state)
{
    static const char *const word[6] = {"a move along x",          "a move along y",
                                        "a move along z",          "a turn about the x axis",
                                        "a turn about the y axis", "a turn about the z axis"};
    for (int kind = LINEAR; kind < KINDS; kind += CURVED)
        for (int m = 0; m < 6; m++) {
            Body body = make(kind, 0);
            const size_t length = 3 * (size_t)body.system->matrix->rows;
            double worst;
            for (size_t i = 0; i < length; i += 3)
                body.modes[(size_t)m * length + i + (size_t)(m + 1) % 3] += 0.001 * body.coordinates[i + (size_t)m % 3];
            assert_failure(ost_rigid_motion_of_rows(body.system, body.modes, &worst), OST_CHECK_FAILED, word[m]);
            destroy(&body);
        }
}

/* One number of one block off by 1e-4 of it: a slip in the sum over tets. */
static void a_wrong_matrix_is_named(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Body body = make(kind, 0);
        const OstBlockMatrix *matrix = body.system->matrix;
        char vertex[64] = "resists";
        double worst;
        if (ost_rank(ctx) == ost_size(ctx) - 1) {
            const OstLocal row = matrix->rows / 2;
            matrix->value[9 * matrix->diagonal[row]] *= 1.0 + 1e-4;
            snprintf(vertex, sizeof vertex,
                     "at vertex %lld:", (long long)body.mesh->node_label[body.system->node_of_row[row]]);
        }
        assert_failure(ost_rigid_motion_of_rows(body.system, body.modes, &worst), OST_CHECK_FAILED, vertex);
        destroy(&body);
    }
}

static void a_tet_without_a_number_is_named(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Body body = make(kind, 0);
        char tet[64] = "resists";
        double worst;
        if (ost_rank(ctx) == 0) {
            const OstLocal *nodes = body.mesh->tet_nodes;
            body.mesh->coordinates[3 * (size_t)nodes[0]] = NAN;
            snprintf(tet, sizeof tet, "tet %lld resists", (long long)body.mesh->tet_label[0]);
        }
        assert_failure(ost_rigid_motion_of_tets(body.mesh, body.field, &worst), OST_CHECK_FAILED, tet);
        destroy(&body);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_kind_of_tet_is_free_in_rigid_motion),
    cmocka_unit_test(multigrid_is_given_the_rigid_modes),
    cmocka_unit_test(a_wrong_mode_is_named),
    cmocka_unit_test(a_wrong_matrix_is_named),
    cmocka_unit_test(a_tet_without_a_number_is_named),
};

OST_TEST_MAIN(tests)
