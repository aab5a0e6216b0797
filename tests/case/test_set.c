/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

/* Changes "KEY=VALUE" to a case, and its load cases. */

static const char bar[] =
    "mesh: {block: {size: [4, 1, 1], divisions: [2, 2, 2]}}\n"
    "materials:\n"
    "  - {region: wood, youngs_modulus: [10, 2, 3], poissons_ratio: {nu12: 0.3, nu23: 0.2, nu31: 0.1},\n"
    "     shear_modulus: {G12: 1, G23: 1, G31: 1}}\n"
    "  - &soft {region: rubber, youngs_modulus: 1, poissons_ratio: 0.3}\n"
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
    "loads:\n"
    "  - {on: {boundary: xmax}, total_force: [1, 2, 3]}\n"
    "  - {on: {boundary: ymax}, pressure: 5}\n";

static OstCase *c;

static OstStatus read_with(int count, const char *const *settings)
{
    return ost_case_make(ctx, "bar.yaml",
                         &(OstCaseText){.bytes = bar, .size = strlen(bar), .settings = count, .setting = settings}, &c);
}

static void set(const char *setting)
{
    ost_case_destroy(&c);
    assert_success(read_with(1, &setting));
}

static void numbers_are_set_by_their_path(void **state)
{
    set("loads.1.pressure=7e2");
    assert_close(c->loads[1].pressure, 700.0, 0.0);
    set("loads.0.total_force=[4, 5, 6]");
    assert_close(c->loads[0].vector[2], 6.0, 0.0);
    set("loads.0.total_force.1=-2");
    assert_close(c->loads[0].vector[1], -2.0, 0.0);
    assert_close(c->loads[0].vector[2], 3.0, 0.0);
    set("mesh.block.divisions.0=9");
    assert_int_equal(c->block.divisions[0], 9);
    assert_int_equal(c->block.divisions[1], 2);
    set("constraints.0.displacement.x=free");
    assert_false(c->constraints[0].constrained[0]);
    assert_true(c->constraints[0].constrained[1]);
    ost_case_destroy(&c);
}

static void short_names_of_numbers_are_understood(void **state)
{
    set("materials.wood.E1=12");
    assert_close(c->materials[0].material.constants.youngs_modulus[0], 12.0, 0.0);
    assert_close(c->materials[0].material.constants.youngs_modulus[1], 2.0, 0.0);
    set("materials.wood.nu12=0.35");
    assert_close(c->materials[0].material.constants.poissons_ratio[0], 0.35, 1e-15);
    set("materials.wood.G23=0.5");
    assert_close(c->materials[0].material.constants.shear_modulus[1], 0.5, 0.0);
    set("materials.rubber.E=4");
    assert_close(c->materials[1].material.constants.youngs_modulus[0], 4.0, 0.0);
    set("loads.1.value=8");
    assert_close(c->loads[1].pressure, 8.0, 0.0);
    set("loads.0.value.z=9");
    assert_close(c->loads[0].vector[2], 9.0, 0.0);
    ost_case_destroy(&c);
}

/* E3 is the modulus of the axis. */
static void moduli_along_and_across_an_axis_are_understood(void **state)
{
    static const char text[] = "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
                               "materials: [{region: all, youngs_modulus: {plane: 2, axis: 5}, poissons_ratio: 0.3, "
                               "fibre: [0, 0, 1]}]\n";
    static const char *const settings[] = {"materials.all.E3=7", "materials.all.E1=3"};
    ost_case_destroy(&c);
    assert_success(ost_case_make(
        ctx, "bar.yaml", &(OstCaseText){.bytes = text, .size = strlen(text), .settings = 2, .setting = settings}, &c));
    assert_close(c->materials[0].material.constants.youngs_modulus[2], 7.0, 0.0);
    assert_close(c->materials[0].material.constants.youngs_modulus[0], 3.0, 0.0);
    assert_close(c->materials[0].material.constants.youngs_modulus[1], 3.0, 0.0);
    ost_case_destroy(&c);
}

static void what_is_not_there_is_added(void **state)
{
    set("title=a bar, and so on");
    assert_string_equal(c->title, "a bar, and so on");
    set("element.order=2");
    assert_int_equal(c->order, 2);
    set("materials.wood.density=450");
    assert_close(c->materials[0].material.density, 450.0, 0.0);
    set("watch.end.displacement={nearest: [4, 0, 0]}");
    assert_int_equal(c->watch_count, 1);
    assert_close(c->watches[0].on.point[0], 4.0, 0.0);
    set("constraints.1={on: {boundary: xmax}, slide: [0, 0, 1]}");
    assert_int_equal(c->constraint_count, 2);
    assert_close(c->constraints[0].displacement[0], 0.0, 0.0);
    assert_int_equal(c->constraints[1].kind, OST_CONSTRAIN_SLIDE);
    set("output.file=a \"b\".vtkhdf");
    assert_string_equal(c->output_file, "a \"b\".vtkhdf");
    ost_case_destroy(&c);
}

static void several_changes_are_made_in_their_order(void **state)
{
    const char *const settings[] = {"loads.1.pressure=7", "accuracy.relative_residual=1e-10",
                                    "title=one",          "accuracy.out_of_reach=accept",
                                    "title=two",          "materials.0.E1=8",
                                    "loads.1.value=9"};
    assert_success(read_with(7, settings));
    assert_close(c->loads[1].pressure, 9.0, 0.0);
    assert_close(c->solver.relative_residual, 1e-10, 0.0);
    assert_true(c->solver.accept_attainable);
    assert_string_equal(c->title, "two");
    assert_close(c->materials[0].material.constants.youngs_modulus[0], 8.0, 0.0);
    assert_int_equal(c->loads[1].line, 9); /* messages name the place in the file */
    const uint64_t hash = c->text_hash;
    ost_case_destroy(&c);
    assert_success(read_with(6, settings));
    assert_true(c->text_hash != hash); /* a checkpoint of the one is none of the other */
    ost_case_destroy(&c);
}

static void refuse(const char *setting, OstStatus status, const char *words)
{
    assert_failure(read_with(1, &setting), status, words);
    assert_null(c);
}

static void wrong_settings_are_refused_in_words(void **state)
{
    refuse("pressure", OST_INVALID_USAGE,
           "bar.yaml: cannot set pressure: expected KEY=VALUE, as in loads.0.pressure=2e5");
    refuse("title=", OST_INVALID_USAGE, "expected KEY=VALUE");
    refuse("=3", OST_INVALID_USAGE, "expected KEY=VALUE");
    refuse("loads..pressure=3", OST_INVALID_USAGE, "expected keys with a dot between them");
    refuse("loads.=3", OST_INVALID_USAGE, "expected keys with a dot between them");
    refuse(
        "materials.wod.E1=3", OST_INVALID_USAGE,
        "materials has no entry 'wod'; did you mean 'wood'?; it has 2, numbered from 0, of these names: wood, rubber");
    refuse("loads.2.pressure=3", OST_INVALID_USAGE,
           "loads has no entry '2'; it has 2, numbered from 0; number 2 can be added, as a whole");
    refuse("loads.3={gravity: [0, 0, 1]}", OST_INVALID_USAGE, "loads has no entry '3'; it has 2, numbered from 0");
    refuse("loads.0.total_force.3=1", OST_INVALID_INPUT, "found a list of 4, expected a list of 3 numbers");
    refuse("title=my bar: a", OST_INVALID_USAGE,
           "cannot set title=my bar: a: the value is not YAML beside other keys; put a text in quotes");
    refuse("loads.1.pressure.x=3", OST_INVALID_USAGE,
           "loads[1].pressure is the one value '5', which has no part 'x'; set the whole of it");
    refuse("loads.1.presure=3", OST_INVALID_INPUT,
           "bar.yaml:9:5: unknown key 'presure' in loads[1]; did you mean 'pressure'?");
    refuse("materals.wood.E1=3", OST_INVALID_INPUT, "unknown key 'materals' in the case; did you mean 'materials'?");
    refuse("loads.1.pressure=much", OST_INVALID_INPUT,
           "bar.yaml:9:38: loads[1].pressure: found 'much', expected a number (set by loads.1.pressure=much)");
    refuse("loads.1.pressure={", OST_INVALID_INPUT, "loads.1.pressure={:2:1: not YAML");
}

static void a_value_that_aliases_stand_for_stays(void **state)
{
    static const char text[] = "mesh: {block: {size: &size [4, 1, 1], divisions: [2, 2, 2], origin: *size}}\n"
                               "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3}]\n";
    const char *setting = "mesh.block.size=[1, 1, 1]";
    OstCaseText given = {.bytes = text, .size = strlen(text), .settings = 1, .setting = &setting};
    assert_failure(ost_case_make(ctx, "bar.yaml", &given, &c), OST_INVALID_USAGE,
                   "an alias (*name) elsewhere in the file stands for what is there");
    setting = "mesh.block.origin=[1, 2, 3]"; /* the alias itself may be replaced */
    assert_success(ost_case_make(ctx, "bar.yaml", &given, &c));
    assert_close(c->block.size[0], 4.0, 0.0);
    assert_close(c->block.origin[2], 3.0, 0.0);
    ost_case_destroy(&c);
}

/* --- load cases --- */

static const char with_cases[] = "mesh: {block: {size: [4, 1, 1], divisions: [2, 2, 2]}}\n"
                                 "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3, density: 1}]\n"
                                 "title: bridge\n"
                                 "cases:\n"
                                 "  - {name: empty}\n"
                                 "  - name: wind\n"
                                 "    loads: [{on: {boundary: ymax}, pressure: 5}]\n"
                                 "    watch: {side: {displacement: {nearest: [4, 1, 1]}}}\n"
                                 "  - name: sunk\n"
                                 "    constraints: [{on: {boundary: xmin}, displacement: [0, 0, -1]}]\n"
                                 "    springs: [{on: {boundary: xmax}, foundation: 3}]\n"
                                 "loads: [{gravity: [0, 0, -1]}]\n"
                                 "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                                 "watch: {end: {displacement: {nearest: [4, 0, 0]}}}\n";

static void a_load_case_is_a_case_with_its_own_beside_that_of_all(void **state)
{
    assert_success(ost_case_parse(ctx, "bridge.yaml", with_cases, &c));
    assert_int_equal(ost_case_load_case_count(c), 3);
    const OstCase *empty = ost_case_load_case(c, 0), *wind = ost_case_load_case(c, 1), *sunk = ost_case_load_case(c, 2);
    assert_string_equal(ost_case_load_case_name(c, 1), "wind");
    assert_string_equal(wind->title, "bridge: wind");
    assert_int_equal(empty->load_count, 1);
    assert_int_equal(wind->load_count, 2);
    assert_close(wind->loads[1].pressure, 5.0, 0.0);
    assert_int_equal(empty->watch_count, 1);
    assert_int_equal(wind->watch_count, 2);
    assert_int_equal(sunk->constraint_count, 1); /* in place of that of all */
    assert_close(sunk->constraints[0].displacement[2], -1.0, 0.0);
    assert_close(wind->constraints[0].displacement[2], 0.0, 0.0);
    assert_int_equal(sunk->spring_count, 1);
    assert_int_equal(wind->spring_count, 0);
    ost_case_destroy(&c);
}

/* What was in its place before is not taken for it. */
static void a_load_case_after_one_that_replaces_has_its_own(void **state)
{
    assert_success(
        ost_case_parse(ctx, "bridge.yaml",
                       "mesh: {block: {size: [4, 1, 1], divisions: [2, 2, 2]}}\n"
                       "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3}]\n"
                       "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                       "cases:\n"
                       "  - {name: sunk, constraints: [{on: {boundary: xmin}, displacement: [0, 0, -1]}]}\n"
                       "  - name: pulled\n"
                       "    constraints: [{on: {plane: {point: [4, 0, 0], normal: [1, 0, 0]}}, displacement: "
                       "[1, 0, 0]}]\n",
                       &c));
    const OstCase *pulled = ost_case_load_case(c, 1);
    assert_int_equal(pulled->constraint_count, 2);
    assert_int_equal(pulled->constraints[1].on.kind, OST_SELECT_PLANE);
    assert_close(pulled->constraints[1].displacement[0], 1.0, 0.0);
    ost_case_destroy(&c);
}

static void a_load_case_is_picked_and_set_by_its_name(void **state)
{
    const char *setting = "cases.wind.loads.0.value=6";
    const OstCaseText text = {.bytes = with_cases, .size = strlen(with_cases), .settings = 1, .setting = &setting};
    assert_success(ost_case_make(ctx, "bridge.yaml", &text, &c));
    assert_failure(ost_case_pick(&c, "wnd"), OST_INVALID_USAGE,
                   "bridge.yaml: there is no load case 'wnd'; did you mean 'wind'? There are: empty, wind, sunk");
    assert_success(ost_case_pick(&c, "wind"));
    assert_int_equal(c->load_case_count, 0);
    assert_close(c->loads[1].pressure, 6.0, 0.0);
    assert_failure(ost_case_pick(&c, "wind"), OST_INVALID_USAGE, "there are no load cases (cases: ...)");
    ost_case_destroy(&c);
}

static void refuse_cases(const char *cases, const char *words)
{
    char text[1024];
    snprintf(text, sizeof text, "%s%s%s", cube, steel, cases);
    assert_refused(text, words);
}

static void wrong_load_cases_are_refused(void **state)
{
    refuse_cases("cases: {wind: 3}\n", "3:8: cases: found a mapping, expected a list of load cases...");
    refuse_cases("cases: []\n", "3:8: found 0 load cases, expected 1 to 1000");
    refuse_cases("cases: [{loads: []}]\n", "3:9: key 'name' is missing in cases[0]");
    refuse_cases("cases: [{name: a b}]\n", "3:16: the name 'a b' is part of a file's name: letters...");
    refuse_cases("cases: [{name: a}, {name: A}]\n", "3:27: the load case 'A' is there already, in line 3;...");
    refuse_cases("cases: [{name: a, mesh: 3}]\n",
                 "3:19: unknown key 'mesh' in cases[0]. Known keys: name, loads, combine, constraints, springs, watch");
    refuse_cases("cases: [{name: a}]\npath: {steps: 2}\n",
                 "3:8: load cases stand beside each other, and the steps of a path follow one another;...");
    refuse_cases("cases: [{name: a, loads: [{gravity: [0, 0, 1]}]}]\n", "3: gravity acts on mass...");
    refuse_cases("constraints: free_body\ncases: [{name: a, constraints: [{on: {all: true}, slide: [1, 0, 0]}]}]\n",
                 "4:32: a free body has no constraints...");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(numbers_are_set_by_their_path),
    cmocka_unit_test(short_names_of_numbers_are_understood),
    cmocka_unit_test(moduli_along_and_across_an_axis_are_understood),
    cmocka_unit_test(what_is_not_there_is_added),
    cmocka_unit_test(several_changes_are_made_in_their_order),
    cmocka_unit_test(wrong_settings_are_refused_in_words),
    cmocka_unit_test(a_value_that_aliases_stand_for_stays),
    cmocka_unit_test(a_load_case_is_a_case_with_its_own_beside_that_of_all),
    cmocka_unit_test(a_load_case_after_one_that_replaces_has_its_own),
    cmocka_unit_test(a_load_case_is_picked_and_set_by_its_name),
    cmocka_unit_test(wrong_load_cases_are_refused),
};

OST_TEST_MAIN(tests)
