/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

static OstCase *c;

static void read_material(const char *text)
{
    char whole[2048];
    snprintf(whole, sizeof whole, "%smaterials:\n  - {region: all, %s}\n", cube, text);
    assert_success(read_text(whole, &c));
    assert_int_equal(c->material_count, 1);
}

static void assert_constants(const double expected[9])
{
    const OstOrthotropic *k = &c->materials[0].material.constants;
    for (int i = 0; i < 3; i++) {
        assert_close(k->youngs_modulus[i], expected[i], 1e-15 * fabs(expected[i]));
        assert_close(k->poissons_ratio[i], expected[3 + i], 1e-15 + 1e-15 * fabs(expected[3 + i]));
        assert_close(k->shear_modulus[i], expected[6 + i], 1e-15 * fabs(expected[6 + i]));
    }
    ost_case_destroy(&c);
}

static void the_smallest_case_has_the_defaults(void **state)
{
    char whole[512];
    snprintf(whole, sizeof whole, "%s%s", cube, steel);
    assert_success(read_text(whole, &c));
    const OstSolverOptions defaults = ost_solver_default_options();
    assert_string_equal(c->title, "untitled");
    assert_int_equal(c->mesh_kind, OST_MESH_BLOCK);
    assert_int_equal(c->order, 0);
    assert_int_equal(c->straighten, 0);
    assert_int_equal(c->refinement, 0);
    assert_int_equal(c->constraint_count + c->load_count, 0);
    assert_null(c->output_file);
    assert_int_equal(c->output_fields, OST_FIELDS_BY_DEFAULT);
    assert_int_equal(c->solver.method, OST_METHOD_AUTO);
    assert_close(c->solver.relative_residual, defaults.relative_residual, 0.0);
    assert_int_equal(c->materials[0].axes.kind, OST_AXES_NONE);
    assert_int_equal(c->materials[0].line, 2);
    ost_case_destroy(&c);
}

static void shapes_are_read(void **state)
{
    char whole[1024];
    snprintf(whole, sizeof whole,
             "title: a tube\nmesh:\n  tube: {axis: y, length: 1.0e+1, radii: [.9, 1.5], origin: [1, -2, +3],\n"
             "         divisions: {around: 60, radial: 6, axial: 50}}\n%s",
             steel);
    assert_success(read_text(whole, &c));
    assert_string_equal(c->title, "a tube");
    assert_int_equal(c->mesh_kind, OST_MESH_TUBE);
    assert_int_equal(c->tube.axis, 1);
    assert_close(c->tube.length, 10.0, 0.0);
    assert_close(c->tube.radii[0], 0.9, 0.0);
    assert_close(c->tube.radii[1], 1.5, 0.0);
    assert_close(c->tube.origin[1], -2.0, 0.0);
    assert_close(c->tube.origin[2], 3.0, 0.0);
    assert_int_equal(c->tube.around, 60);
    assert_int_equal(c->tube.radial, 6);
    assert_int_equal(c->tube.axial, 50);
    ost_case_destroy(&c);
    snprintf(whole, sizeof whole, "mesh: {block: {size: [1, 2, 3e0], divisions: [4, 5, 6], origin: [0, 0, -1]}}\n%s",
             steel);
    assert_success(read_text(whole, &c));
    assert_close(c->block.size[2], 3.0, 0.0);
    assert_int_equal(c->block.divisions[0], 4);
    assert_int_equal(c->block.divisions[2], 6);
    assert_close(c->block.origin[2], -1.0, 0.0);
    ost_case_destroy(&c);
}

static void files_are_named_from_the_case_files_folder(void **state)
{
    char whole[1024], path[256], expected[512];
    case_path(path);
    *strrchr(path, '/') = 0;
    snprintf(whole, sizeof whole, "mesh: {file: meshes/femur.msh}\n%soutput: {file: out/femur.vtkhdf}\n", steel);
    assert_success(read_text(whole, &c));
    snprintf(expected, sizeof expected, "%s/meshes/femur.msh", path);
    assert_int_equal(c->mesh_kind, OST_MESH_FILE);
    assert_string_equal(c->mesh_file, expected);
    assert_string_equal(c->output_file, "out/femur.vtkhdf");
    ost_case_destroy(&c);
    assert_success(read_text("mesh: {file: /far/turtle.veg}\n", &c)); /* a .veg file brings materials */
    assert_string_equal(c->mesh_file, "/far/turtle.veg");
    assert_int_equal(c->material_count, 0);
    ost_case_destroy(&c);
}

static void one_modulus_is_isotropic(void **state)
{
    read_material("youngs_modulus: 2.6e6, poissons_ratio: 0.3, density: 1000");
    assert_close(c->materials[0].material.density, 1000.0, 0.0);
    assert_constants((double[9]){2.6e6, 2.6e6, 2.6e6, 0.3, 0.3, 0.3, 1e6, 1e6, 1e6});
}

static void three_moduli_and_one_ratio_are_the_stable_family(void **state)
{
    /* eq. 18: nu12 = nu sqrt(E1/E2) ...; eq. 22: G_ij = mean(E_i, E_j) / (2 (1 + nu)) */
    read_material("youngs_modulus: [1, 4, 16], poissons_ratio: 0.25");
    assert_constants((double[9]){1, 4, 16, 0.125, 0.125, 1.0, 2 / 2.5, 8 / 2.5, 4 / 2.5});
    read_material("youngs_modulus: [1, 4, 16], poissons_ratio: 0.25, shear_modulus: arithmetic");
    assert_constants((double[9]){1, 4, 16, 0.125, 0.125, 1.0, 2.5 / 2.5, 10 / 2.5, 8.5 / 2.5});
    read_material("youngs_modulus: [1, 4, 16], poissons_ratio: 0.25, shear_modulus: min");
    assert_constants((double[9]){1, 4, 16, 0.125, 0.125, 1.0, 1 / 2.5, 4 / 2.5, 1 / 2.5});
    read_material("youngs_modulus: [1, 4, 16], poissons_ratio: 0.25, shear_modulus: max");
    assert_constants((double[9]){1, 4, 16, 0.125, 0.125, 1.0, 4 / 2.5, 16 / 2.5, 16 / 2.5});
    read_material("youngs_modulus: [1, 4, 16], poissons_ratio: 0.25, shear_modulus: {G12: 5, G23: 6, G31: 7}");
    assert_constants((double[9]){1, 4, 16, 0.125, 0.125, 1.0, 5, 6, 7});
}

static void nine_constants_go_by_name(void **state)
{
    /* nu21 = nu12 E2/E1, nu31 = nu13 E3/E1 */
    read_material("youngs_modulus: [8, 4, 2], poissons_ratio: {nu13: 0.4, nu21: 0.1, nu23: 0.3}, "
                  "shear_modulus: {G13: 3, G12: 1, G32: 2}");
    assert_constants((double[9]){8, 4, 2, 0.2, 0.3, 0.1, 1, 2, 3});
}

static void plane_and_axis_are_transversely_isotropic(void **state)
{
    /* section 3.1: nu31 = nu_pz Ez/Ep, G12 = Ep / 2(1 + nu_p); eq. 20: nu_pz = nu_p sqrt(Ep/Ez) */
    read_material("youngs_modulus: {plane: 2, axis: 8}, poissons_ratio: {plane: 0.25, plane_axis: 0.1}, "
                  "shear_modulus: {axis: 3}");
    assert_constants((double[9]){2, 2, 8, 0.25, 0.1, 0.4, 0.8, 3, 3});
    read_material("youngs_modulus: {plane: 2, axis: 8}, poissons_ratio: 0.25");
    assert_constants((double[9]){2, 2, 8, 0.25, 0.125, 0.5, 0.8, 1.6, 1.6});
    read_material("youngs_modulus: {plane: 2, axis: 8}, poissons_ratio: {plane: 0.25}, shear_modulus: max");
    assert_constants((double[9]){2, 2, 8, 0.25, 0.125, 0.5, 0.8, 3.2, 3.2});
}

static void an_eigenstrain_has_five_forms(void **state)
{
    static const struct {
        const char *text;
        double strain[6];
        int isotropic;
    } forms[] = {{"0.5", {0.5, 0.5, 0.5}, 1},
                 {"[1, 2, 3]", {1, 2, 3}, 0},
                 {"[1, 1, 1, 0, 0, 4]", {1, 1, 1, 0, 0, 4}, 0},
                 {"{value: [1, 2, 3]}", {1, 2, 3}, 0},
                 {"{per_unit: [1, 2, 3], change: -2}", {-2, -4, -6}, 0}};
    for (int f = 0; f < 5; f++) {
        char text[256];
        snprintf(text, sizeof text, "youngs_modulus: 2, poissons_ratio: 0.3, eigenstrain: %s", forms[f].text);
        read_material(text);
        for (int p = 0; p < 6; p++)
            assert_close(c->materials[0].eigenstrain[p], forms[f].strain[p], 0.0);
        assert_int_equal(c->materials[0].material.isotropic, forms[f].isotropic);
        ost_case_destroy(&c);
    }
}

static void springs_are_read(void **state)
{
    char whole[1024];
    snprintf(
        whole, sizeof whole,
        "%s%ssprings:\n  - {on: {boundary: xmin}, foundation: 4}\n  - {on: {boundary: xmin}, foundation: {normal: 5}}\n"
        "  - {on: {vertices: [3]}, spring: 6}\n  - {on: {vertices: [3]}, spring: 7, direction: [0, 0, 2]}\n",
        cube, steel);
    static const double along[] = {4, 5, 6, 7}, across[] = {4, 0, 6, 0};
    assert_success(read_text(whole, &c));
    assert_int_equal(c->spring_count, 4);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(c->springs[i].kind, i < 2 ? OST_SPRING_FOUNDATION : OST_SPRING_POINT);
        assert_close(c->springs[i].along, along[i], 0.0);
        assert_close(c->springs[i].across, across[i], 0.0);
        assert_close(c->springs[i].direction[2], i == 3 ? 1.0 : 0.0, 0.0);
    }
    ost_case_destroy(&c);
}

static const OstAxesSpec *read_axes(const char *text)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "youngs_modulus: [1, 2, 3], poissons_ratio: 0.3, axes: {%s}", text);
    read_material(whole);
    return &c->materials[0].axes;
}

static void axes_of_one_frame_are_read(void **state)
{
    const double turned[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1}; /* by 90 degrees about z */
    static const char *const forms[] = {"fixed: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]",
                                        "fixed: [[0, 2, 0], [-3, 0, 0], [0, 0, 1]]", "euler: {degrees: [90, 0, 0]}",
                                        "euler: {degrees: [0, 0, 90], sequence: XYZ}",
                                        "quaternion: [0.70710678118654752, 0, 0, 0.70710678118654752]"};
    static const OstAxesKind kinds[] = {OST_AXES_FIXED, OST_AXES_FIXED, OST_AXES_EULER, OST_AXES_EULER,
                                        OST_AXES_QUATERNION};
    for (int f = 0; f < 5; f++) {
        const OstAxesSpec *axes = read_axes(forms[f]);
        assert_int_equal(axes->kind, kinds[f]);
        for (int i = 0; i < 9; i++)
            assert_close(axes->fixed[i], turned[i], 1e-15);
        ost_case_destroy(&c);
    }
}

static void axes_along_a_line_are_read(void **state)
{
    const OstAxesSpec *axes =
        read_axes("cylindrical: {origin: [1, 2, 3], axis: [0, 2, 0], order: [tangential, axial, radial]}");
    assert_int_equal(axes->kind, OST_AXES_CYLINDRICAL);
    assert_close(axes->origin[2], 3.0, 0.0);
    assert_close(axes->axis[1], 1.0, 0.0);
    assert_int_equal(axes->order[0], OST_TANGENTIAL);
    assert_int_equal(axes->order[1], OST_AXIAL);
    assert_int_equal(axes->order[2], OST_RADIAL);
    ost_case_destroy(&c);
    axes = read_axes("curve: {points: [[0, 0, 0], [1, 0, 0], [2, 1, 0]], up: [0, 0, 3]}");
    assert_int_equal(axes->kind, OST_AXES_CURVE);
    assert_int_equal(axes->point_count, 3);
    assert_close(axes->points[7], 1.0, 0.0);
    assert_close(axes->up[2], 1.0, 0.0);
    assert_int_equal(axes->order[2], OST_TANGENTIAL);
    ost_case_destroy(&c);
}

static void axes_from_elsewhere_are_read(void **state)
{
    const OstAxesSpec *axes = read_axes("cells: mesh");
    assert_int_equal(axes->kind, OST_AXES_CELLS);
    assert_null(axes->cells_file);
    ost_case_destroy(&c);
    axes = read_axes("cells: axes.txt");
    assert_string_equal(strrchr(axes->cells_file, '/'), "/axes.txt");
    ost_case_destroy(&c);
    axes = read_axes("gradient: {e1: {from: xmin, to: xmax}, e2: {from: ymin, to: ymax}}");
    assert_int_equal(axes->kind, OST_AXES_GRADIENT);
    assert_string_equal(axes->from[0], "xmin");
    assert_string_equal(axes->to[1], "ymax");
    ost_case_destroy(&c);
}

static const OstSelection *read_selection(const char *text)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s%sconstraints:\n  - {on: {%s}, slide: [0, 0, 5]}\n", cube, steel, text);
    assert_success(read_text(whole, &c));
    assert_int_equal(c->constraints[0].kind, OST_CONSTRAIN_SLIDE);
    assert_close(c->constraints[0].normal[2], 1.0, 0.0);
    assert_int_equal(c->constraints[0].on.place.line, 4);
    return &c->constraints[0].on;
}

static void selections_by_name_and_number_are_read(void **state)
{
    const OstSelection *on = read_selection("boundary: xmin");
    assert_int_equal(on->kind, OST_SELECT_BOUNDARY);
    assert_string_equal(on->boundaries.name[0], "xmin");
    ost_case_destroy(&c);
    on = read_selection("boundary: [xmin, xmax]");
    assert_int_equal(on->boundaries.count, 2);
    assert_string_equal(on->boundaries.name[1], "xmax");
    ost_case_destroy(&c);
    on = read_selection("vertices: [5, 1, 27]");
    assert_int_equal(on->kind, OST_SELECT_VERTICES);
    assert_int_equal(on->range_count, 3);
    assert_int_equal(on->ranges[0].first, 1);
    assert_int_equal(on->ranges[2].last, 27);
    ost_case_destroy(&c);
    on = read_selection("nearest: [1, 2, 3]");
    assert_int_equal(on->kind, OST_SELECT_NEAREST);
    assert_close(on->point[1], 2.0, 0.0);
    ost_case_destroy(&c);
    on = read_selection("all: true");
    assert_int_equal(on->kind, OST_SELECT_ALL);
    ost_case_destroy(&c);
}

static void selections_in_space_are_read(void **state)
{
    const OstSelection *on = read_selection("plane: {point: [0, 0, 1], normal: [0, 3, 4], tolerance: 0.5}");
    assert_int_equal(on->kind, OST_SELECT_PLANE);
    assert_close(on->direction[1], 0.6, 1e-15);
    assert_close(on->tolerance, 0.5, 0.0);
    ost_case_destroy(&c);
    on = read_selection("box: {min: [0, 0, 0], max: [1, 1, 2]}");
    assert_int_equal(on->kind, OST_SELECT_BOX);
    assert_close(on->direction[2], 2.0, 0.0);
    assert_true(on->tolerance < 0.0);
    ost_case_destroy(&c);
    on = read_selection("sphere: {center: [1, 0, 0], radius: 2}");
    assert_int_equal(on->kind, OST_SELECT_SPHERE);
    assert_close(on->radii[1], 2.0, 0.0);
    ost_case_destroy(&c);
    on = read_selection("cylinder: {origin: [1, 0, 0], axis: [0, 0, 2], radii: [0.5, 2]}");
    assert_int_equal(on->kind, OST_SELECT_CYLINDER);
    assert_close(on->radii[0], 0.5, 0.0);
    assert_close(on->direction[2], 1.0, 0.0);
    ost_case_destroy(&c);
    on = read_selection("cylinder: {origin: [1, 0, 0], axis: [0, 0, 2], radius: 2}");
    assert_close(on->radii[0], 0.0, 0.0);
    assert_close(on->radii[1], 2.0, 0.0);
    ost_case_destroy(&c);
}

static void displacements_may_be_free(void **state)
{
    char whole[512];
    snprintf(whole, sizeof whole, "%s%sconstraints:\n  - on: {all: true}\n    displacement: [free, 0, -1.5]\n", cube,
             steel);
    assert_success(read_text(whole, &c));
    const OstConstraint *constraint = &c->constraints[0];
    assert_int_equal(constraint->kind, OST_CONSTRAIN_DISPLACEMENT);
    assert_int_equal(constraint->constrained[0], 0);
    assert_int_equal(constraint->constrained[1] && constraint->constrained[2], 1);
    assert_close(constraint->displacement[2], -1.5, 0.0);
    ost_case_destroy(&c);
}

static void every_load_is_read(void **state)
{
    char whole[2048];
    snprintf(whole, sizeof whole,
             "%smaterials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3, density: 7}]\nloads:\n"
             "  - {on: {boundary: xmax}, total_force: [1, 2, 3]}\n"
             "  - {on: {boundary: xmax}, total_force: [1, 2, 3], share: vertices}\n"
             "  - {on: {vertices: [1]}, total_force: [1, 2, 3]}\n"
             "  - {on: {nearest: [0, 0, 0]}, point_force: [4, 5, 6]}\n"
             "  - {on: {boundary: xmax}, traction: [7, 8, 9]}\n"
             "  - {on: {boundary: xmax}, pressure: -10}\n"
             "  - {gravity: [0, 0, -9.81]}\n"
             "  - {body_force: [1, 0, 0], region: block}\n",
             cube);
    assert_success(read_text(whole, &c));
    static const OstLoadKind kinds[] = {OST_LOAD_TOTAL_FORCE, OST_LOAD_TOTAL_FORCE, OST_LOAD_TOTAL_FORCE,
                                        OST_LOAD_POINT_FORCE, OST_LOAD_TRACTION,    OST_LOAD_PRESSURE,
                                        OST_LOAD_GRAVITY,     OST_LOAD_BODY_FORCE};
    assert_int_equal(c->load_count, 8);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(c->loads[i].kind, kinds[i]);
        assert_int_equal(c->loads[i].line, 4 + i);
    }
    assert_int_equal(c->loads[0].share, OST_SHARE_AUTO);
    assert_int_equal(c->loads[1].share, OST_SHARE_VERTICES);
    assert_int_equal(c->loads[2].share, OST_SHARE_VERTICES);
    assert_close(c->loads[4].vector[2], 9.0, 0.0);
    assert_close(c->loads[5].pressure, -10.0, 0.0);
    assert_null(c->loads[6].region);
    assert_string_equal(c->loads[7].region, "block");
    ost_case_destroy(&c);
}

/* A case that asks for no residual takes what double precision holds; one that asks gets it, or a refusal. */
static void what_is_out_of_reach_is_refused_to_those_who_ask(void **state)
{
    static const char *const accuracy[] = {"", "accuracy: {relative_residual: 1e-8}\n",
                                           "accuracy: {out_of_reach: refuse}\n"};
    for (int a = 0; a < 3; a++) {
        char whole[2048];
        snprintf(whole, sizeof whole, "%s%s%s", cube, steel, accuracy[a]);
        assert_success(read_text(whole, &c));
        assert_int_equal(c->solver.accept_attainable, a == 0);
        ost_case_destroy(&c);
    }
}

static void settings_are_read(void **state)
{
    char whole[2048];
    snprintf(whole, sizeof whole,
             "%s%selement: {order: 1, straighten: true}\naccuracy: {relative_residual: 1e-10, "
             "out_of_reach: accept, relative_error: 0.001}\n"
             "solver: {method: plain, max_iterations: 77, aggregate_nodes: 41, coarse_aggregate_nodes: 9,\n"
             "         smoother_block_nodes: 6, smoother_degree: 4, smoother_ratio: 30, coarsest_unknowns: 500,\n"
             "         patience: 88, most_levels: 3, load_steps: 5, factor_memory: 2}\n"
             "output: {file: a.vtkhdf, fields: [displacement, rank]}\n",
             cube, steel);
    assert_success(read_text(whole, &c));
    assert_int_equal(c->solver.method, OST_METHOD_PLAIN);
    assert_int_equal(c->straighten, 1);
    assert_close(c->solver.relative_residual, 1e-10, 0.0);
    assert_close(c->relative_error, 0.001, 0.0);
    assert_int_equal(c->solver.max_iterations, 77);
    assert_close(c->solver.aggregate_nodes, 41, 0.0);
    assert_close(c->solver.coarse_aggregate_nodes, 9, 0.0);
    assert_close(c->solver.smoother_block_nodes, 6, 0.0);
    assert_int_equal(c->solver.smoother_degree, 4);
    assert_close(c->solver.smoother_ratio, 30, 0.0);
    assert_int_equal(c->solver.coarsest_unknowns, 500);
    assert_int_equal(c->solver.accept_attainable, 1);
    assert_int_equal(c->solver.patience, 88);
    assert_int_equal(c->solver.most_levels, 3);
    assert_int_equal(c->solver.load_steps, 5);
    assert_close(c->solver.factor_memory, 2097152.0, 0.0);
    assert_int_equal(c->solver.given, OST_GIVEN_AGGREGATE | OST_GIVEN_COARSE_AGGREGATE | OST_GIVEN_BLOCK |
                                          OST_GIVEN_DEGREE | OST_GIVEN_RATIO | OST_GIVEN_COARSEST);
    assert_string_equal(c->output_file, "a.vtkhdf");
    assert_int_equal(c->output_fields, 1U << OST_FIELD_DISPLACEMENT | 1U << OST_FIELD_RANK);
    ost_case_destroy(&c);
    snprintf(whole, sizeof whole, "%s%ssolver: {factor_memory: 0}\n", cube, steel);
    assert_success(read_text(whole, &c));
    assert_true(c->solver.factor_memory > 0.0 && c->solver.factor_memory < 1.0); /* 0: all that is free */
    ost_case_destroy(&c);
}

static void aliases_stand_for_their_anchors(void **state)
{
    char whole[1024];
    snprintf(whole, sizeof whole,
             "%smaterials:\n  - {region: a, youngs_modulus: &e [1, 2, 3], poissons_ratio: &n 0.3}\n"
             "  - {region: b, youngs_modulus: *e, poissons_ratio: *n}\n",
             cube);
    assert_success(read_text(whole, &c));
    assert_int_equal(c->material_count, 2);
    assert_close(c->materials[1].material.constants.youngs_modulus[2], 3.0, 0.0);
    assert_int_equal(c->materials[1].line, 4);
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_smallest_case_has_the_defaults),
    cmocka_unit_test(shapes_are_read),
    cmocka_unit_test(files_are_named_from_the_case_files_folder),
    cmocka_unit_test(one_modulus_is_isotropic),
    cmocka_unit_test(three_moduli_and_one_ratio_are_the_stable_family),
    cmocka_unit_test(nine_constants_go_by_name),
    cmocka_unit_test(plane_and_axis_are_transversely_isotropic),
    cmocka_unit_test(an_eigenstrain_has_five_forms),
    cmocka_unit_test(springs_are_read),
    cmocka_unit_test(axes_of_one_frame_are_read),
    cmocka_unit_test(axes_along_a_line_are_read),
    cmocka_unit_test(axes_from_elsewhere_are_read),
    cmocka_unit_test(selections_by_name_and_number_are_read),
    cmocka_unit_test(selections_in_space_are_read),
    cmocka_unit_test(displacements_may_be_free),
    cmocka_unit_test(every_load_is_read),
    cmocka_unit_test(what_is_out_of_reach_is_refused_to_those_who_ask),
    cmocka_unit_test(settings_are_read),
    cmocka_unit_test(aliases_stand_for_their_anchors),
};

OST_TEST_MAIN(tests)
