/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "algebra/multigrid/vertices.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/coarse_space.h"
#include "problem/row_geometry.h"

/* A body of quadratic tets, its linear tets, and the vertices that turn between them. */
typedef struct Made {
    OstMesh *mesh;
    OstMaterialField *field;
    OstSupports *supports;
    OstSystem *system;
    OstLinearSpace *linear;
    OstRowGeometry rows;
    OstScaling *scaling, *linear_scaling;
    OstVertexSpace vertices;
} Made;

static Made make(void)
{
    static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const OstMaterial material = make_material(ctx, 1);
    Made made = {.mesh = make_body_of(2)};
    made.field = make_field(made.mesh, &material, AXES_RANDOM_BY_TET);
    assert_success(ost_supports_create(made.mesh, &made.supports));
    for (OstLocal node = 0; node < made.mesh->owned_nodes;
         node++) /* one corner is held, so that the body may be solved */
        for (int i = 0; i < 3 && ost_norm3(made.mesh->coordinates + 3 * node) < 1e-9; i++)
            assert_success(ost_supports_constrain(made.supports, node, unit[i], 0.0));
    assert_success(ost_supports_complete(made.supports));
    assert_success(ost_system_create(made.mesh, made.supports, &made.system));
    assert_success(ost_system_fill(made.system, made.field));
    assert_success(ost_linear_space_create(made.system, made.field, 1, &made.linear));
    assert_non_null(made.linear);
    assert_success(ost_row_geometry_create(made.system, made.field, 1, &made.rows));
    assert_success(ost_scaling_create(made.system->matrix, &made.scaling));
    assert_success(ost_scaling_create(made.linear->space.matrix, &made.linear_scaling));
    assert_success(ost_vertex_space_create(&made.linear->space, &made.rows.geometry, made.scaling, made.linear_scaling,
                                           &made.vertices));
    return made;
}

static void destroy(Made *made)
{
    ost_vertex_space_clear(&made->vertices);
    ost_scaling_destroy(&made->scaling);
    ost_scaling_destroy(&made->linear_scaling);
    ost_row_geometry_release(&made->rows);
    ost_linear_space_destroy(&made->linear);
    ost_system_destroy(&made->system);
    ost_supports_destroy(&made->supports);
    ost_field_destroy(&made->field);
    ost_mesh_destroy(&made->mesh);
}

/* Is none of the row's parents held? */
static int is_free(const Made *made, size_t row)
{
    double sum = 0.0;
    for (size_t k = 4 * row; k < 4 * row + 4; k++)
        sum += made->linear->space.parents[k] >= 0 ? made->linear->space.weights[k] : 0.0;
    return fabs(sum - 1.0) < 1e-12;
}

/* x = P c in unscaled unknowns of the quadratic rows; c holds its owned part. */
static void interpolate(const Made *made, const double *c, double *x)
{
    const OstProlongator *p = made->vertices.prolongator;
    double *coarse = numbers(OST_MODES * (size_t)p->columns + OST_PADDING);
    memcpy(coarse, c, OST_MODES * (size_t)made->linear_scaling->rows * sizeof *c);
    memset(x, 0, 3 * (size_t)p->rows * sizeof *x);
    ost_prolongator_add(p, coarse, x);
    ost_scaling_from_scaled(made->scaling, x, x);
    free(coarse);
}

static void rigid_motions_pass_as_they_are(void **state)
{
    (void)state;
    Made made = make();
    const size_t fine = 3 * (size_t)made.scaling->rows, coarse = OST_MODES * (size_t)made.linear_scaling->rows;
    double *x = numbers(fine), worst = 0.0;
    for (size_t mode = 0; mode < OST_MODES; mode++) {
        const double *modes = made.linear->rows.modes + mode * coarse / 2, *exact = made.rows.modes + mode * fine;
        double apart[3] = {0.0}; /* both turn about points of their own */
        interpolate(&made, made.vertices.modes + mode * coarse, x);
        for (size_t row = 0; row < fine / 3; row++)
            for (size_t k = 0; k < 4; k++) {
                const OstLocal parent = made.linear->space.parents[4 * row + k];
                const int is_vertex =
                    made.vertices.prolongator->row_start[row + 1] == made.vertices.prolongator->row_start[row] + 1;
                for (size_t i = 0; i < 3 && is_vertex && parent >= 0 && parent < made.linear_scaling->rows; i++)
                    apart[i] = modes[3 * (size_t)parent + i] - exact[3 * row + i];
            }
        for (size_t i = 0; i < fine; i++)
            if (is_free(&made, i / 3))
                worst = fmax(worst, fabs(x[i] - exact[i] - apart[i % 3]));
    }
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    assert_true(worst < 1e-5);
    free(x);
    destroy(&made);
}

/* Pure bending, u = (-x z, 0, x² / 2), whose rotation is (0, -x, 0): the deflection of linear interpolation is off by
 * dx² / 8 between two vertices, and with their rotations not at all; along x half of its error is left. */
static void edges_bend_where_their_ends_turn(void **state)
{
    (void)state;
    Made made = make();
    const double *places = made.linear->rows.coordinates;
    const size_t vertices = (size_t)made.linear_scaling->rows, fine = 3 * (size_t)made.scaling->rows;
    double *c = numbers(OST_MODES * vertices), *x = numbers(fine), *u = numbers(3 * vertices);
    double sum[4] = {0.0}; /* squares of what is off, along x and z, without rotations and with them */
    for (size_t turns = 0; turns < 2; turns++) {
        for (size_t v = 0; v < vertices; v++) {
            u[3 * v] = -places[3 * v] * places[3 * v + 2];
            u[3 * v + 1] = 0.0;
            u[3 * v + 2] = 0.5 * places[3 * v] * places[3 * v];
        }
        ost_scaling_to_scaled_mode(made.linear_scaling, u, u);
        for (size_t v = 0; v < vertices; v++) {
            const double *turn = made.vertices.modes + 4 * OST_MODES * vertices + OST_MODES * v + 3; /* about y */
            for (size_t i = 0; i < 3; i++) {
                c[OST_MODES * v + i] = u[3 * v + i];
                c[OST_MODES * v + 3 + i] = turns ? -places[3 * v] * turn[i] : 0.0;
            }
        }
        interpolate(&made, c, x);
        for (size_t row = 0; row < fine / 3; row++) {
            if (!is_free(&made, row))
                continue;
            const double *place = made.rows.coordinates + 3 * row;
            sum[2 * turns] += pow(x[3 * row] + place[0] * place[2], 2.0);
            sum[2 * turns + 1] += pow(x[3 * row + 2] - 0.5 * place[0] * place[0], 2.0);
        }
    }
    assert_success(ost_sum(ctx, 4, sum));
    assert_true(sum[0] > 0.0 && sum[1] > 0.0);
    assert_close(sqrt(sum[2] / sum[0]), 0.5, 1e-4);
    assert_true(sqrt(sum[3] / sum[1]) < 1e-4);
    free(c);
    free(x);
    free(u);
    destroy(&made);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rigid_motions_pass_as_they_are),
    cmocka_unit_test(edges_bend_where_their_ends_turn),
};

OST_TEST_MAIN(tests)
