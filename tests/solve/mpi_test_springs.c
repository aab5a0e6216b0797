/* SPDX-License-Identifier: BSD-3-Clause */
#include "../case/case_text.h"
#include "core/error.h"
#include "guard/guard.h"
#include "problem/scene_data.h"

/* Elastic foundations and springs, against formulas. */

static OstStatus solve(const char *text, OstCase **c, OstScene **scene, OstResult **result)
{
    *scene = NULL;
    *result = NULL;
    assert_success(read_text(text, c));
    OST_TRY(ost_scene_create(*c, scene));
    return ost_scene_solve(*scene, result);
}

static void destroy(OstCase *c, OstScene *scene, OstResult *result)
{
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* The displacement of the vertex at a place, on every rank. */
static double displacement_at(const OstResult *result, double x, double y, double z, int component)
{
    const OstMesh *mesh = result->mesh;
    double found[2] = {0.0};
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *at = mesh->coordinates + 3 * node;
        if (fabs(at[0] - x) + fabs(at[1] - y) + fabs(at[2] - z) < 1e-9) {
            found[0] += result->displacement[3 * node + component];
            found[1] += 1.0;
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    assert_close(found[1], 1.0, 0.0);
    return found[0];
}

/* A column on a foundation: it sinks by F / (k A), and shortens by F z / (E A) without changing its section. */
static void a_column_sinks_into_its_foundation(void **state)
{
    static const char *const foundations[] = {"foundation: 4", "foundation: {normal: 4, tangential: 1}",
                                              "foundation: 4, direction: [0, 0, 2]"};
    for (int order = 1; order <= 2; order++)
        for (int f = 0; f < 3; f++) {
            char text[1024];
            OstCase *c;
            OstScene *scene;
            OstResult *result;
            snprintf(
                text, sizeof text,
                "large_rotation: off\nmesh: {block: {size: [1, 2, 3], divisions: [2, 3, 3]}}\nelement: {order: %d}\n"
                "materials: [{region: all, youngs_modulus: 60, poissons_ratio: 0}]\n"
                "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}]\n"
                "springs: [{on: {boundary: zmin}, %s}]\n"
                "loads: [{on: {boundary: zmax}, total_force: [0, 0, -8]}]\naccuracy: {relative_residual: 1e-12}\n",
                order, foundations[f]);
            assert_success(solve(text, &c, &scene, &result));
            assert_close(displacement_at(result, 1, 2, 0, 2), -1.0, 1e-10);
            assert_close(displacement_at(result, 1, 2, 3, 2), -1.2, 1e-10);
            assert_close(ost_result_checks(result)->reaction[2], 8.0, 1e-9);
            assert_close(ost_result_checks(result)->strain_energy, 0.5 * 8.0 * 0.2, 1e-9);
            destroy(c, scene, result);
        }
}

/* Springs one after the other: two at one vertex, the body, which moves as a whole. */
static void springs_at_a_vertex_add_up(void **state)
{
    OstCase *c;
    OstScene *scene;
    OstResult *result;
    assert_success(
        solve("large_rotation: off\nmesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
              "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3}]\n"
              "constraints: [{on: {boundary: ymin}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}]\n"
              "springs: [{on: {nearest: [0, 0, 0]}, spring: 2, direction: [1, 0, 0]},\n"
              "          {on: {vertices: [1]}, spring: 3}]\n"
              "loads: [{on: {boundary: xmax}, total_force: [10, 0, 0]}]\naccuracy: {relative_residual: 1e-12}\n",
              &c, &scene, &result));
    assert_close(displacement_at(result, 0, 0, 0, 0), 2.0, 1e-9);
    destroy(c, scene, result);
}

/* A beam on an elastic foundation with a force P in its middle, by its half (M. Hetényi, Beams on Elastic Foundation,
 * 1946, §17, free ends): w = P a (cosh aL + cos aL + 2) / (2 k (sinh aL + sin aL)) in the middle, with a^4 = k / (4 E
 * I). Shear adds about 2 a² E I / (5/6 G A), 0.4 %, of that (S. Timoshenko's beam). */
static void a_beam_on_a_foundation_bends_as_hetenyi_says(void **state)
{
    const double a = 0.1, length = 40.0, e = 1000.0, force = 2.0, k = 4.0 * pow(a, 4) * e / 12.0;
    const double w =
        force * a / (2.0 * k) * (cosh(a * length) + cos(a * length) + 2.0) / (sinh(a * length) + sin(a * length));
    char text[1024];
    OstCase *c;
    OstScene *scene;
    OstResult *result;
    snprintf(text, sizeof text,
             "large_rotation: off\nmesh: {block: {size: [20, 1, 1], divisions: [20, 1, 1]}}\nelement: {order: 2}\n"
             "materials: [{region: all, youngs_modulus: %g, poissons_ratio: 0}]\n"
             "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}]\n"
             "springs: [{on: {boundary: zmin}, foundation: %.17g, direction: [0, 0, 1]}]\n"
             "loads: [{on: {boundary: xmin}, total_force: [0, 0, %.17g]}]\n",
             e, k, -0.5 * force);
    assert_success(solve(text, &c, &scene, &result));
    assert_close(-displacement_at(result, 0, 0, 0, 2) / w, 1.004, 0.003);
    destroy(c, scene, result);
}

/* What springs do not hold is refused: a spring holds the directions that it has. */
static void springs_hold_the_directions_they_have(void **state)
{
    static const char body[] = "large_rotation: off\nmesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
                               "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3}]\n"
                               "loads: [{on: {boundary: xmax}, total_force: [1, 0, 0]}]\n";
    static const struct {
        const char *springs;
        int holds;
        const char *says;
    } cases[] = {
        {"springs: [{on: {boundary: zmin}, foundation: 5}]\n", 1, ""},
        {"springs: [{on: {boundary: zmin}, foundation: {normal: 5}}]\n", 0, "move"},
        {"springs: [{on: {boundary: zmin}, foundation: {tangential: 5}}]\n", 0, "turn"},
        {"springs: [{on: {boundary: xmin}, spring: 5}]\n", 1, ""},
        {"springs: [{on: {nearest: [0, 0, 0]}, spring: 5}]\n", 0, "turn"},
        {"springs: [{on: {boundary: xmin}, spring: 5, direction: [1, 0, 0]}]\nconstraints: [{on: {boundary: ymin}, "
         "slide: "
         "[0, 1, 0]}]\n",
         0, "move along"},
        {"springs: [{on: {boundary: xmin}, spring: 5, direction: [1, 0, 0]}]\nconstraints: [{on: {boundary: ymin}, "
         "slide: "
         "[0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}]\n",
         1, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        OstCase *c;
        OstScene *scene;
        OstResult *result;
        snprintf(text, sizeof text, "%s%s", body, cases[i].springs);
        const OstStatus status = solve(text, &c, &scene, &result);
        if ((status == OST_SUCCESS) != cases[i].holds ||
            (!cases[i].holds && !strstr(ost_error_text(ctx), cases[i].says)))
            fail_msg("%s: %s", cases[i].springs, status == OST_SUCCESS ? "solved" : ost_error_text(ctx));
        destroy(c, scene, result);
    }
}

/* A round body turns in a bed of springs along its normals, and slides where it is a cylinder: its mesh has facets, the
 * body has none. Edges count. */
static void a_round_body_turns_in_its_bed(void **state)
{
    static const char eight[] =
        "tube: {axis: y, length: 2, radii: [0.5, 1], divisions: {around: 8, radial: 1, axial: 3}}";
    static const char six[] =
        "tube: {axis: y, length: 2, radii: [0.5, 1], divisions: {around: 6, radial: 1, axial: 3}}";
    static const char ball[] = "octant: {radii: [1, 2], divisions: {around: 4, radial: 1}}";
    static const char block[] = "block: {size: [1, 1, 1], divisions: [1, 1, 1]}";
    static const char slides[] =
        "about the line through (0, 1, 0) along (0, 1, 0)\n(a foundation with a normal stiffness alone";
    static const struct {
        const char *mesh, *on, *foundation, *says;
    } cases[] = {
        {eight, "boundary: outer", "{normal: 5}", slides},
        {eight, "boundary: [outer, ends]", "{normal: 5}", "  the body, 144 tets around (0, 1, 0): can turn"},
        {eight, "boundary: outer", "{normal: 5, tangential: 0.01}", NULL},
        {six, "boundary: [outer, ends]", "{normal: 5}", NULL},
        {ball, "boundary: outer", "{normal: 5}", "can turn about any line through"},
        {ball, "all: true", "{normal: 5}", NULL},
        {block, "all: true", "{normal: 5}", NULL},
    };
    for (int order = 1; order <= 2; order++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            char text[1024];
            OstCase *c;
            OstScene *scene;
            OstResult *result;
            if (order == 2 && cases[i].mesh == six) /* its curved sides are round */
                continue;
            snprintf(text, sizeof text,
                     "large_rotation: off\nmesh: {%s}\nelement: {order: %d}\n"
                     "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3}]\n"
                     "loads: [{on: {nearest: [1, 0, 0]}, total_force: [1, 0, 0]}]\n"
                     "springs: [{on: {%s}, foundation: %s}]\n",
                     cases[i].mesh, order, cases[i].on, cases[i].foundation);
            const OstStatus status = solve(text, &c, &scene, &result);
            if ((status == OST_SUCCESS) != !cases[i].says ||
                (cases[i].says && !strstr(ost_error_text(ctx), cases[i].says)))
                fail_msg("order %d, %s: %s", order, text, status == OST_SUCCESS ? "solved" : ost_error_text(ctx));
            destroy(c, scene, result);
        }
}

/* Springs alone carry the body: what is wrong with their forces is the error of the reactions. */
static void forces_of_springs_have_the_error_of_reactions(void **state)
{
    OstCase *c;
    OstScene *scene;
    OstProblem *problem;
    OstErrors errors;
    assert_success(read_text("large_rotation: off\nmesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
                             "materials: [{region: all, youngs_modulus: 1e3, poissons_ratio: 0.3}]\n"
                             "springs: [{on: {boundary: zmin}, foundation: 5}]\n"
                             "loads: [{on: {boundary: zmax}, total_force: [0, 0, -1]}]\n",
                             &c));
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_problem(scene, &problem));
    double *u = calloc(3 * (size_t)scene->mesh->node_count, sizeof *u);
    double *error = calloc(3 * (size_t)scene->mesh->node_count, sizeof *error);
    for (OstLocal n = 0; n < scene->mesh->node_count; n++) {
        u[3 * n + 2] = -0.2;
        error[3 * n + 2] = 3e-3;
    }
    double *internal = calloc(3 * (size_t)scene->mesh->owned_nodes, sizeof *internal);
    double stress;
    assert_success(ost_problem_force_and_stress(problem, 1.0, u, internal, &stress));
    assert_success(ost_guard_errors(problem, problem, u, internal, stress, error, &errors));
    free(internal);
    assert_close(errors.reaction, 3e-3 / 0.2, 1e-12);
    free(u);
    free(error);
    ost_problem_destroy(&problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* Multigrid, whose coarse space of linear tets is held by springs alone. */
static void multigrid_solves_a_body_on_springs(void **state)
{
    double tip[2];
    for (int method = 0; method < 2; method++) {
        char text[1024];
        OstCase *c;
        OstScene *scene;
        OstResult *result;
        snprintf(text, sizeof text,
                 "large_rotation: off\nmesh: {block: {size: [4, 1, 1], divisions: [8, 2, 2]}}\nelement: {order: 2}\n"
                 "materials: [{region: all, youngs_modulus: [1e3, 1e2, 1e2], poissons_ratio: 0.3}]\n"
                 "springs: [{on: {boundary: xmin}, foundation: 0.1}]\nsolver: {method: %s}\n"
                 "loads: [{on: {boundary: xmax}, total_force: [0, 0, 1e-3]}]\naccuracy: {relative_residual: 1e-9}\n",
                 method ? "metric" : "direct");
        assert_success(solve(text, &c, &scene, &result));
        tip[method] = displacement_at(result, 4, 0, 0, 2);
        assert_true(ost_result_solve_report(result)->iterations < 40);
        destroy(c, scene, result);
    }
    assert_close(tip[1] / tip[0], 1.0, 1e-6);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_column_sinks_into_its_foundation),
    cmocka_unit_test(springs_at_a_vertex_add_up),
    cmocka_unit_test(a_beam_on_a_foundation_bends_as_hetenyi_says),
    cmocka_unit_test(springs_hold_the_directions_they_have),
    cmocka_unit_test(a_round_body_turns_in_its_bed),
    cmocka_unit_test(forces_of_springs_have_the_error_of_reactions),
    cmocka_unit_test(multigrid_solves_a_body_on_springs),
};

OST_TEST_MAIN(tests)
