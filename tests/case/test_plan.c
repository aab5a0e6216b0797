/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

#include "case/plan.h"

#define CUBE "mesh: {block: {size: [1, 1, 1], divisions: [10, 10, 10]}}\n"
#define STEEL "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3, density: 1}]\n"

static OstCase *c;
static OstPlan plan;

static void plan_of_shape(void)
{
    OstPlanMesh mesh = {.quadratic = c->order == 2};
    ost_plan_shape_size(c, &mesh.nodes, &mesh.tets);
    ost_plan_make(c, &mesh, 1, &plan);
}

static void make_plan(const char *text)
{
    assert_success(read_text(text, &c));
    plan_of_shape();
    ost_case_destroy(&c);
}

static void assert_effect(OstEffect effect, int on, const char *reason)
{
    assert_int_equal(ost_effect_on(&plan.effects, effect), on);
    assert_string_equal(ost_effect_state(&plan.effects, effect)->reason, reason);
}

static void a_bare_isotropic_body_calls_for_nothing(void **state)
{
    make_plan(CUBE STEEL "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 0, "every material is isotropic");
    assert_effect(OST_EFFECT_VARYING_AXES, 0, "an isotropic body needs no axes");
    assert_effect(OST_EFFECT_GRADIENT_AXES, 0, "no axes are given by gradients");
    assert_effect(OST_EFFECT_REGIONS, 0, "one material for the whole body");
    assert_effect(OST_EFFECT_PRESCRIBED_DISPLACEMENT, 0, "every constraint is zero");
    assert_effect(OST_EFFECT_SLIDING, 0, "no constraint is a slide");
    assert_effect(OST_EFFECT_POINT_FORCE, 0, "there is no load");
    assert_effect(OST_EFFECT_SURFACE_LOAD, 0, "there is no load");
    assert_effect(OST_EFFECT_BODY_FORCE, 0, "there is no load");
    assert_effect(OST_EFFECT_LARGE_ROTATION, 1,
                  "auto: a linear solve, then Newton's method (consistent) where that is off by more than 2 %");
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        assert_int_equal(ost_effect_on(&plan.effects, (OstEffect)e),
                         e == OST_EFFECT_RECOVERY || e == OST_EFFECT_LARGE_ROTATION || e == OST_EFFECT_ERROR_ESTIMATE);
}

static void large_rotations_are_explained(void **state)
{
    make_plan(CUBE STEEL "large_rotation: off\n");
    assert_effect(OST_EFFECT_LARGE_ROTATION, 0,
                  "the case says so: linear theory, which takes rotations and strains as small");
    make_plan(CUBE STEEL "large_rotation: on\nformulation: classical\n");
    assert_effect(OST_EFFECT_LARGE_ROTATION, 1, "the case says so: Newton's method, classical formulation");
    make_plan(CUBE STEEL "accuracy: {relative_error: 0.1}\n");
    assert_effect(OST_EFFECT_LARGE_ROTATION, 1,
                  "auto: a linear solve, then Newton's method (consistent) where that is off by more than 10 %");
    make_plan(CUBE STEEL "constraints: free_body\n");
    assert_effect(OST_EFFECT_LARGE_ROTATION, 0, "a free body is solved linearly");
}

static void three_equal_moduli_with_axes_are_isotropic_still(void **state)
{
    make_plan(CUBE "materials: [{region: all, youngs_modulus: [2, 2, 2], poissons_ratio: 0.3, axes: {cylindrical: "
                   "{origin: [9, 9, 0], axis: [0, 0, 1], order: [axial, radial, tangential]}}}]\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 0, "every material is isotropic");
    assert_effect(OST_EFFECT_VARYING_AXES, 0, "an isotropic body needs no axes");
}

static void axes_of_an_isotropic_material_stay_if_something_is_asked_for_along_them(void **state)
{
    static const char *const asking[] = {"watch: {hoop: {stress: {at: [0.5, 0.5, 0.5]}, component: 33}}\n",
                                         "output: {fields: [material_stress]}\n", "output: {fields: [e1]}\n",
                                         "output: {probes: {line: {points: [[0.5, 0.5, 0.5]]}}}\n",
                                         "cases: [{name: a, watch: {hoop: {stress: {region: all}, component: 12}}}]\n"};
    for (size_t i = 0; i < sizeof asking / sizeof asking[0]; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 CUBE "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3, axes: {cylindrical: {origin: "
                      "[9, 9, 0], axis: [0, 0, 1], order: [axial, radial, tangential]}}}]\n%s",
                 asking[i]);
        make_plan(text);
        assert_effect(OST_EFFECT_ORTHOTROPY, 1, "stresses along the axes of region 'all' are asked for");
        assert_effect(OST_EFFECT_VARYING_AXES, 1, "axes follow a cylinder in region 'all'");
    }
    make_plan(CUBE STEEL "watch: {s: {stress: {at: [0.5, 0.5, 0.5]}, component: 11}}\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 0, "every material is isotropic");
}

static void orthotropy_and_its_axes_are_explained(void **state)
{
    make_plan(CUBE "materials: [{region: all, youngs_modulus: [1, 2, 3], poissons_ratio: 0.3}]\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 1, "3 different Young's moduli in region 'all'");
    assert_effect(OST_EFFECT_VARYING_AXES, 0, "the axes are uniform in each region");
    make_plan(CUBE "materials: [{region: all, youngs_modulus: [1, 2, 1], poissons_ratio: 0.3, axes: {cylindrical: "
                   "{origin: [9, 9, 0], axis: [0, 0, 1], order: [axial, radial, tangential]}}}]\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 1, "2 different Young's moduli in region 'all'");
    assert_effect(OST_EFFECT_VARYING_AXES, 1, "axes follow a cylinder in region 'all'");
    make_plan(CUBE "materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3, shear_modulus: {G12: 1, G23: 1, "
                   "G31: 1}, axes: {gradient: {e1: {from: xmin, to: xmax}, e2: {from: ymin, to: ymax}}}}]\n");
    assert_effect(OST_EFFECT_ORTHOTROPY, 1, "the shear moduli of region 'all' are not those of an isotropic material");
    assert_effect(OST_EFFECT_VARYING_AXES, 1, "axes follow the gradients of potentials in region 'all'");
    assert_effect(OST_EFFECT_GRADIENT_AXES, 1, "axes of region 'all' follow potentials between boundaries");
}

static void materials_that_are_replaced_do_not_count(void **state)
{
    char *names[2] = {"shell", "core"};
    const OstNames regions = {2, names};
    const OstPlanMesh mesh = {.nodes = 100, .tets = 300, .regions = &regions};
    assert_success(read_text("mesh: {file: a.msh}\n"
                             "materials:\n  - {region: all, youngs_modulus: 1, poissons_ratio: 0.3}\n"
                             "  - {region: core, youngs_modulus: [1, 2, 3], poissons_ratio: 0.3}\n",
                             &c));
    ost_plan_make(c, &mesh, 1, &plan);
    assert_effect(OST_EFFECT_REGIONS, 1, "2 materials");
    assert_effect(OST_EFFECT_ORTHOTROPY, 1, "3 different Young's moduli in region 'core'");
    ost_case_destroy(&c);
    make_plan(CUBE "materials:\n  - {region: core, youngs_modulus: [1, 2, 3], poissons_ratio: 0.3}\n"
                   "  - {region: all, youngs_modulus: 1, poissons_ratio: 0.3}\n");
    assert_effect(OST_EFFECT_REGIONS, 0, "one material for the whole body");
    assert_effect(OST_EFFECT_ORTHOTROPY, 0, "every material is isotropic");
}

static void materials_of_the_file_count_where_the_case_has_none(void **state)
{
    OstMaterial two[2];
    const OstOrthotropic soft = ost_orthotropic_isotropic(1.0, 0.3);
    const OstOrthotropic fibre = ost_orthotropic_family((double[3]){1, 1, 9}, 0.3, OST_SHEAR_GEOMETRIC);
    char *names[2] = {"belly", "tendon"};
    const OstNames regions = {2, names};
    assert_success(ost_material_create(ctx, "SOFT", &soft, 0.0, &two[0]));
    assert_success(ost_material_create(ctx, "FIBRE", &fibre, 0.0, &two[1]));
    const OstFileMaterials from_file = {2, two, NULL};
    const OstPlanMesh mesh = {.nodes = 100, .tets = 300, .regions = &regions, .materials = &from_file};
    assert_success(read_text("mesh: {file: a.veg}\n", &c));
    ost_plan_make(c, &mesh, 1, &plan);
    assert_effect(OST_EFFECT_ORTHOTROPY, 1, "2 different Young's moduli in region 'FIBRE'");
    assert_effect(OST_EFFECT_REGIONS, 1, "2 materials");
    ost_case_destroy(&c);
    assert_success(
        read_text("mesh: {file: a.veg}\nmaterials: [{region: tendon, youngs_modulus: 2, poissons_ratio: 0.3}]\n", &c));
    ost_plan_make(c, &mesh, 1, &plan);
    assert_effect(OST_EFFECT_ORTHOTROPY, 0, "every material is isotropic");
    assert_effect(OST_EFFECT_REGIONS, 1, "2 materials");
    ost_case_destroy(&c);
    assert_success(read_text("mesh: {file: a.veg}\n" STEEL, &c));
    ost_plan_make(c, &mesh, 1, &plan);
    assert_effect(OST_EFFECT_REGIONS, 0, "one material for the whole body");
    ost_case_destroy(&c);
}

static void supports_are_explained(void **state)
{
    make_plan(CUBE STEEL "constraints:\n  - {on: {boundary: xmin}, displacement: [0, free, 0.1]}\n"
                         "  - {on: {boundary: xmax}, slide: [1, 0, 0]}\n");
    assert_effect(OST_EFFECT_PRESCRIBED_DISPLACEMENT, 1, "1 of 2 constraints prescribe a displacement other than zero");
    assert_effect(OST_EFFECT_SLIDING, 1, "1 of 2 constraints let the body slide on a plane");
    make_plan(CUBE STEEL);
    assert_effect(OST_EFFECT_PRESCRIBED_DISPLACEMENT, 0, "there is no constraint");
}

static void loads_are_explained(void **state)
{
    make_plan(CUBE STEEL "loads:\n  - {on: {boundary: xmax}, total_force: [1, 0, 0]}\n");
    assert_effect(OST_EFFECT_SURFACE_LOAD, 1, "1 of 1 loads act on faces");
    assert_effect(OST_EFFECT_POINT_FORCE, 0, "no load acts on vertices");
    assert_effect(OST_EFFECT_BODY_FORCE, 0, "no load acts in the volume");
    make_plan(CUBE STEEL "loads:\n  - {on: {vertices: [1]}, total_force: [1, 0, 0]}\n  - {gravity: [0, 0, -1]}\n");
    assert_effect(OST_EFFECT_SURFACE_LOAD, 0, "no load acts on faces");
    assert_effect(OST_EFFECT_POINT_FORCE, 1, "1 of 2 loads act on vertices");
    assert_effect(OST_EFFECT_BODY_FORCE, 1, "1 of 2 loads act in the volume, gravity among them");
}

/* Without a share, a total force on a box acts on faces if there are any: the mesh has to be looked at. */
static void only_the_mesh_tells_faces_from_vertices(void **state)
{
    for (int few = 0; few < 2; few++) {
        char text[512];
        OstMeshChunk *chunk = NULL;
        OstMesh *mesh = NULL;
        OstEffect effect;
        snprintf(text, sizeof text,
                 CUBE STEEL "loads:\n  - {on: {box: {min: [0, 0, 1], max: %s}}, total_force: [1, 0, 0]}\n",
                 few ? "[0.05, 0.05, 1]" : "[1, 1, 1]");
        assert_success(read_text(text, &c));
        assert_true(ost_loads_need_mesh(c));
        assert_success(ost_chunk_create_block(ctx, &c->block, &chunk));
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        assert_success(ost_load_effects(c, mesh, &effect));
        assert_int_equal(effect, few ? OST_EFFECT_POINT_FORCE : OST_EFFECT_SURFACE_LOAD);
        ost_plan_make(c, &(OstPlanMesh){.nodes = 1331, .tets = 6000, .load = &effect}, 1, &plan);
        assert_effect(effect, 1, few ? "1 of 1 loads act on vertices" : "1 of 1 loads act on faces");
        ost_mesh_destroy(&mesh);
        ost_case_destroy(&c);
    }
}

static void the_method_follows_the_size_unless_the_case_says(void **state)
{
    make_plan("mesh: {block: {size: [1, 1, 1], divisions: [8, 8, 8]}}\n" STEEL);
    assert_int_equal(plan.unknowns, 3 * 9 * 9 * 9);
    assert_int_equal(plan.solver.first, OST_METHOD_DIRECT);
    make_plan(CUBE STEEL);
    assert_int_equal(plan.solver.first, OST_METHOD_METRIC);
    assert_close(plan.facts.anisotropy, 1.0, 0.0);
    assert_close(plan.facts.contrast, 1.0, 0.0);
    make_plan(CUBE STEEL "solver: {method: plain}\n");
    assert_int_equal(plan.solver.first, OST_METHOD_PLAIN);
    assert_string_equal(plan.solver.reason[0], "the case asks for it");
}

static void nearly_incompressible_begins_above_its_limit(void **state)
{
    const char *const moduli[2] = {"1", "[1, 1000, 1]"};
    for (int k = 0; k < 2; k++) {
        char text[512];
        for (int above = 0; above < 2; above++) {
            snprintf(text, sizeof text, CUBE "materials: [{region: all, youngs_modulus: %s, poissons_ratio: %s}]\n",
                     moduli[k], above ? "0.4500001" : "0.45");
            make_plan(text);
            assert_close(plan.solver.options.aggregate_nodes, above ? 15.0 : 40.0, 0.0);
        }
    }
}

/* The paper's tube: 25,620 vertices and 129,600 tets; an independent count of its edges gives 13.7 blocks a row. */
static void the_papers_tube_is_foreseen(void **state)
{
    make_plan("mesh: {tube: {axis: y, length: 10, radii: [0.9, 1.5], divisions: {around: 60, radial: 6, axial: 60}}}\n"
              "materials: [{region: all, youngs_modulus: [1, 2, 3], poissons_ratio: 0.3, axes: {cylindrical: "
              "{origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}}]\n");
    assert_int_equal(plan.nodes, 25620);
    assert_int_equal(plan.tets, 129600);
    assert_int_equal(plan.unknowns, 76860);
    const double faces = 2.0 * 2.0 * 60.0 * 60.0 + 2.0 * 2.0 * 60.0 * 6.0;
    assert_close(plan.counts.surface, faces, 0.0);
    assert_close(plan.counts.edges, 25620.0 + 129600.0 + 0.5 * faces, 0.0); /* Euler: a tube has chi = 0 */
    assert_close(plan.counts.blocks, 25620.0 + 2.0 * plan.counts.edges, 0.0);
    assert_close(plan.bytes_matrix, (76.0 + 28.0) * 25620.0 + (76.0 + 8.0) * plan.counts.edges, 1.0); /* one triangle */
    assert_true(plan.bytes_solver > plan.bytes_matrix);
    assert_true(plan.bytes_effects >= 32.0 * 129600.0); /* axes as quaternions */
    assert_close(plan.bytes_output, 25620.0 * 144.0 + 129600.0 * (41.0 + 48 + 48 + 8 + 8 + 72 + 4 + 4), 1.0);
}

/* A cube of 10 × 10 × 10 hexes of six tets: 21 nodes to each side. */
static void quadratic_tets_are_counted(void **state)
{
    const OstMeshCounts block = ost_mesh_counts(9261.0, 6000.0, 1, 1200.0);
    assert_close(block.vertices, 1331.0, 0.51);
    assert_close(block.edges, 7930.0, 1.51);
    assert_close(block.blocks, 9261.0 + 2.0 * (3.0 * 7930.0 + 15.0 * 6000.0 + 3.0 * 1200.0), 12.0);
}

static void a_file_is_refined_and_raised(void **state)
{
    OstGlobal nodes = 1331, tets = 6000;
    double surface = 1200.0;
    assert_success(read_text("mesh: {file: a.msh, refine: 1}\nelement: {order: 2}\n" STEEL, &c));
    ost_plan_file_size(c, 4, &nodes, &tets, &surface);
    assert_int_equal(tets, 48000);
    assert_close((double)nodes, 68921.0, 20.0); /* 41 to each side; Euler's 1 in two steps */
    assert_close(surface, 4800.0, 0.0);
    ost_case_destroy(&c);
}

static void more_ranks_hold_more_halo(void **state)
{
    OstPlan two;
    assert_success(read_text(CUBE STEEL, &c));
    const OstPlanMesh mesh = {.nodes = 1331, .tets = 6000};
    ost_plan_make(c, &mesh, 1, &plan);
    ost_plan_make(c, &mesh, 2, &two);
    assert_true(two.bytes_mesh > plan.bytes_mesh && two.bytes_mesh <= 2.0 * plan.bytes_mesh);
    ost_case_destroy(&c);
}

static void an_estimate_that_does_not_fit_is_left_out(void **state)
{
    const OstPlanMesh mesh = {.nodes = 1331, .tets = 6000};
    assert_success(read_text(CUBE STEEL, &c));
    ost_plan_make(c, &mesh, 1, &plan);
    const OstPlan with = plan;
    c->output_fields &= ~(1U << OST_FIELD_ERROR);
    ost_plan_make(c, &mesh, 1, &plan);
    const double without = plan.bytes_in_all;
    c->output_fields |= 1U << OST_FIELD_ERROR;
    assert_true(without < with.bytes_in_all);

    plan = with;
    ost_plan_fit(c, 1, with.bytes_in_all, &plan);
    assert_true(ost_effect_on(&plan.effects, OST_EFFECT_ERROR_ESTIMATE));
    ost_plan_fit(c, 1, without, &plan);
    assert_false(ost_effect_on(&plan.effects, OST_EFFECT_ERROR_ESTIMATE));
    assert_close(plan.bytes_in_all, without, 0.0);
    assert_non_null(strstr(ost_effect_state(&plan.effects, OST_EFFECT_ERROR_ESTIMATE)->reason, "GiB are free"));

    plan = with; /* nor would the run without it fit: it is not to blame */
    ost_plan_fit(c, 1, 0.9 * without, &plan);
    assert_true(ost_effect_on(&plan.effects, OST_EFFECT_ERROR_ESTIMATE));
    plan = with;
    c->asks_error = 1;
    ost_plan_fit(c, 1, without, &plan);
    assert_true(ost_effect_on(&plan.effects, OST_EFFECT_ERROR_ESTIMATE));
    ost_case_destroy(&c);
}

/* The scenes that come with Orthostat are all read, and the four tubes say what they are. */
static void the_scenes_of_the_house_are_read(void **state)
{
    static const char *const scenes[] = {"tube/isotropic",  "tube/longitudinal", "tube/radial",
                                         "tube/tangential", "tube/gradient",     "block/sliding",
                                         "block/pressure",  "block/gravity",     "bent-bar/curve"};
    const char *source = getenv("ORTHOSTAT_SOURCE");
    if (!source)
        skip();
    for (int s = 0; s < (int)(sizeof scenes / sizeof *scenes); s++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/cases/%s.yaml", source, scenes[s]);
        assert_success(ost_case_read(ctx, path, &c));
        plan_of_shape();
        assert_int_equal(ost_effect_on(&plan.effects, OST_EFFECT_ORTHOTROPY), s != 0);
        assert_true(s > 3 || plan.nodes == 25620);
        /* (k·60 + j)·7 + i + 1 for k = 30, i = 6, j in {58, 59, 0, 1, 2} */
        static const OstLabelRange pulled[] = {
            {12607, 12607}, {12614, 12614}, {12621, 12621}, {13013, 13013}, {13020, 13020}};
        if (s <= 3)
            assert_memory_equal(c->loads[0].on.ranges, pulled, sizeof pulled);
        ost_case_destroy(&c);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_bare_isotropic_body_calls_for_nothing),
    cmocka_unit_test(large_rotations_are_explained),
    cmocka_unit_test(three_equal_moduli_with_axes_are_isotropic_still),
    cmocka_unit_test(axes_of_an_isotropic_material_stay_if_something_is_asked_for_along_them),
    cmocka_unit_test(orthotropy_and_its_axes_are_explained),
    cmocka_unit_test(materials_that_are_replaced_do_not_count),
    cmocka_unit_test(materials_of_the_file_count_where_the_case_has_none),
    cmocka_unit_test(supports_are_explained),
    cmocka_unit_test(loads_are_explained),
    cmocka_unit_test(only_the_mesh_tells_faces_from_vertices),
    cmocka_unit_test(the_method_follows_the_size_unless_the_case_says),
    cmocka_unit_test(nearly_incompressible_begins_above_its_limit),
    cmocka_unit_test(the_papers_tube_is_foreseen),
    cmocka_unit_test(quadratic_tets_are_counted),
    cmocka_unit_test(a_file_is_refined_and_raised),
    cmocka_unit_test(more_ranks_hold_more_halo),
    cmocka_unit_test(an_estimate_that_does_not_fit_is_left_out),
    cmocka_unit_test(the_scenes_of_the_house_are_read),
};

OST_TEST_MAIN(tests)
