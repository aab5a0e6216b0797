/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

#define CUBE "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
#define STEEL "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3}]\n"
#define MATERIAL(text) CUBE "materials:\n  - {region: all, " text "}\n"
#define AXES(text) MATERIAL("youngs_modulus: [1, 2, 3], poissons_ratio: 0.3, axes: {" text "}")
#define ON(text) CUBE STEEL "constraints:\n  - {on: {" text "}, slide: [0, 0, 1]}\n"
#define LOAD(text) CUBE STEEL "loads:\n  - {" text "}\n"

static void a_missing_file_is_named(void **state)
{
    OstCase *c = NULL;
    assert_failure(ost_case_read(ctx, "/nowhere/no.yaml", &c), OST_FILE_FAILED,
                   "/nowhere/no.yaml: cannot be opened: No such file or directory");
    assert_failure(ost_case_read(ctx, "/", &c), OST_FILE_FAILED, "/: cannot be read: Is a directory");
    assert_null(c);
}

static void control_characters_are_no_part_of_names(void **state)
{
    assert_refused(CUBE "materials: [{region: \"a\\x01\", youngs_modulus: 2, poissons_ratio: 0.3}]\n",
                   "2:22: found the control character \\x01 in a text; leave it out");
    assert_refused(CUBE STEEL "watch: {\"a\\e\": strain_energy}\n", "3:9: found the control character \\x1b ...");
}

static void an_unknown_key_comes_with_the_nearest(void **state)
{
    assert_refused(
        CUBE "materials:\n  - region: all\n    youngs_modulos: 1\n",
        "4:5: unknown key 'youngs_modulos' in materials[0]; did you mean 'youngs_modulus'? Known keys: region, "
        "youngs_modulus, poissons_ratio, shear_modulus, density, axes, fibre, eigenstrain, strengths");
    assert_refused(
        "mehs: 1\n",
        "1:1: unknown key 'mehs' in the case; did you mean 'mesh'? Known keys: title, mesh, "
        "element, materials, constraints, springs, loads, watch, accuracy, solver, output, path, large_rotation, "
        "formulation, buckling, verify, sweep, cases");
    assert_refused(CUBE STEEL "accuracy: {relative_eror: 0.01}\n",
                   "3:12: unknown key 'relative_eror' in accuracy; did you mean 'relative_error'? Known keys: "
                   "relative_residual, algebraic_fraction, out_of_reach, relative_error, of");
    assert_refused(MATERIAL("<<: 2"), "3:19: '<<' merges mappings in YAML 1.1 alone; write their keys out");
    assert_refused(LOAD("on: {all: true}, force: [1, 0, 0]"),
                   "4:23: unknown key 'force' in loads[0]; did you mean 'total_force'? ...");
    assert_refused(MATERIAL("E: 2, nu: 0.3"),
                   "3:19: unknown key 'E' in materials[0]; did you mean 'youngs_modulus'? ...");
    assert_refused(CUBE STEEL "supports: []\n",
                   "3:1: unknown key 'supports' in the case; did you mean 'constraints'? ...");
    assert_refused(MATERIAL("youngs_modulus: 2, poissons_ratio: 0,3"),
                   "3:56: unknown key '3' in materials[0]; decimals follow a point, and no comma: 0.3");
    assert_refused("mesh: plank.msh\n", "1:7: mesh: found 'plank.msh', expected a mapping with the keys tube, block, "
                                        "sector, octant, file, refine, merge; of a file: {file: NAME}");
    assert_refused("mesh: {tube: {axis: y, bananas: 1}}\n",
                   "1:24: unknown key 'bananas' in mesh.tube. Known keys: axis, length, radii, divisions, origin");
    assert_refused(LOAD("on: {all: true}, tractoin: [1, 0, 0]"),
                   "4:23: unknown key 'tractoin' in loads[0]; did you mean 'traction'? Known keys: total_force, "
                   "point_force, traction, pressure, gravity, body_force, centrifugal, moment, distributing, on, "
                   "share, at, region, "
                   "follows, time");
}

#define SPRING(text) CUBE STEEL "springs:\n  - {" text "}\n"

static void springs_say_what_is_wrong(void **state)
{
    assert_refused(SPRING("on: {all: true}"), "4:5: ...");
    assert_refused(SPRING("spring: 2"), "4:5: key 'on' is missing in springs[0]");
    assert_refused(SPRING("on: {all: true}, spring: -2"),
                   "4:31: springs[0].spring: found '-2', expected a stiffness, ...");
    assert_refused(SPRING("on: {all: true}, foundation: {normal: 0}"),
                   "4:35: the stiffness is 0, so this spring holds nothing; leave it out");
    assert_refused(SPRING("on: {all: true}, foundation: {normal: 1}, direction: [1, 0, 0]"),
                   "4:59: 'direction' and {normal, tangential} exclude each other; give one number "
                   "with it");
    assert_refused(SPRING("on: {all: true}, spring: {normal: 1}"), "4:31: ...");
}

static void eigenstrains_say_what_is_wrong(void **state)
{
    assert_refused(
        MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, eigenstrain: [1, 2]"),
        "3:72: materials[0].eigenstrain: found a list of 2, expected a strain: one number, three along e1, e2, "
        "e3, or six with the shears 12, 23, 31");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, eigenstrain: {per_unit: 1}"),
                   "3:72: 'per_unit' is a strain for each unit of a change; give the 'change' too");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, eigenstrain: {value: 1, change: 2}"),
                   "3:91: 'change' belongs to 'per_unit', not to 'value'");
    assert_refused(CUBE
                   "materials:\n"
                   "  - {region: all, youngs_modulus: 1, poissons_ratio: 0.3, eigenstrain: {value: 1, time: [[0, "
                   "1]]}}\n"
                   "  - {region: block, youngs_modulus: 1, poissons_ratio: 0.3, eigenstrain: 2}\npath: {steps: 2}\n",
                   "4:74: this eigenstrain follows another time table than that of region 'all' in line 3; give all "
                   "eigenstrains the same, or none");
}

static void only_a_pressure_follows(void **state)
{
    assert_refused(LOAD("on: {all: true}, traction: [1, 0, 0], follows: true"),
                   "4:53: 'follows' belongs to pressure, not to 'traction'");
    assert_refused(LOAD("on: {all: true}, pressure: 1, follows: maybe"),
                   "4:45: unknown answer 'maybe'. Known: false, true");
}

static void missing_doubled_and_empty_keys_are_refused(void **state)
{
    assert_refused(STEEL, "1:1: key 'mesh' is missing in the case");
    assert_refused(CUBE "materials: [{region: all, youngs_modulus: 1}]\n",
                   "2:13: key 'poissons_ratio' is missing in materials[0]");
    assert_refused(CUBE CUBE, "2:1: key 'mesh' occurs twice in the case, the first time in line 1; keep one");
    assert_refused(CUBE "materials:\n",
                   "2:1: key 'materials' in the case has no value; give it one, or leave the key out");
    assert_refused(CUBE, "1:1: the case has no materials, and its mesh has none; add materials (region, "
                         "youngs_modulus, poissons_ratio)");
}

static void wrong_types_say_what_was_found(void **state)
{
    assert_refused("- 1\n", "1:1: the case: found a list of 1, expected a mapping with the keys title, mesh, ...");
    assert_refused(
        "mesh: cube\n",
        "1:7: mesh: found 'cube', expected a mapping with the keys tube, block, sector, octant, file, refine, merge");
    assert_refused("mesh: {block: {size: 1, divisions: [2, 2, 2]}}\n",
                   "1:22: mesh.block.size: found '1', expected a list of 3 numbers");
    assert_refused("mesh: {block: {size: [1, 1], divisions: [2, 2, 2]}}\n",
                   "1:22: mesh.block.size: found a list of 2, expected a list of 3 numbers");
    assert_refused("mesh: {block: {size: [1, 1, 1], divisions: [2, 2.5, 2]}}\n",
                   "1:48: mesh.block.divisions[1]: found '2.5', expected a whole number from 1 to 1000000");
    assert_refused(CUBE "materials: {region: all}\n",
                   "2:12: materials: found a mapping, expected a list of materials (- region: all ...)");
    assert_refused(MATERIAL("youngs_modulus: '1e6', poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found the quoted text '1e6', expected a number without quotes");
}

static void numbers_are_whole_and_finite(void **state)
{
    assert_refused(
        MATERIAL("youngs_modulus: 1e6Pa, poissons_ratio: 0.3"),
        "3:35: materials[0].youngs_modulus: found '1e6Pa', expected a number with nothing after it (write no "
        "units; use consistent ones)");
    assert_refused(MATERIAL("youngs_modulus: .nan, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '.nan', expected a finite number");
    assert_refused(MATERIAL("youngs_modulus: -Infinity, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '-Infinity', expected a finite number");
    assert_refused(MATERIAL("youngs_modulus: 1e400, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '1e400', expected a finite number (below 1.8e308)");
    assert_refused(MATERIAL("youngs_modulus: 1e308, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '1e308', expected a number of at most 1e75 in size "
                   "(squares of larger ones leave double precision; choose other units)");
    assert_refused(MATERIAL("youngs_modulus: 1e-308, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '1e-308', expected a number of at least 1e-75 (squares of "
                   "smaller ones ...");
    assert_refused(CUBE STEEL "constraints:\n  - {on: {all: true}, displacement: [1e200, 0, 0]}\n",
                   "4:38: constraints[0].displacement[0]: found '1e200', expected a number of at most 1e75 in size "
                   "(squares of larger ones leave double precision; choose other units)");
    assert_refused("mesh: {block: {size: [1e308, 1, 1], divisions: [1, 1, 1]}}\n" STEEL,
                   "1:23: mesh.block.size[0]: found '1e308', expected a number of at most 1e75 in size (squares of "
                   "larger ones leave double precision; choose other units)");
    assert_refused(MATERIAL("youngs_modulus: 0x10, poissons_ratio: 0.3"),
                   "3:35: materials[0].youngs_modulus: found '0x10', expected a number");
    assert_refused(MATERIAL("youngs_modulus: [1, stiff, 1], poissons_ratio: 0.3"),
                   "3:39: materials[0].youngs_modulus[1]: found 'stiff', expected a number");
    assert_refused(MATERIAL("youngs_modulus: [1, 2, -3], poissons_ratio: 0.3"),
                   "3:42: materials[0].youngs_modulus[2]: found '-3', expected a number above 0");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, density: -1"),
                   "3:68: materials[0].density: found '-1', expected a density, 0 or above");
}

static void exactly_one_form_is_expected(void **state)
{
    assert_refused("mesh: {}\n" STEEL,
                   "1:7: mesh has none of tube, block, sector, octant, file; exactly one of them is expected");
    assert_refused(
        LOAD("on: {all: true}, traction: [1, 0, 0], pressure: 1"),
        "4:5: loads[0] has both 'traction' and 'pressure'; exactly one of total_force, point_force, traction, "
        "pressure, gravity, body_force, centrifugal, moment, distributing is expected");
    assert_refused(
        ON("all: true, boundary: xmin"),
        "4:10: constraints[0].on has both 'boundary' and 'all'; exactly one of boundary, plane, box, sphere, "
        "cylinder, vertices, nearest, all is expected");
    assert_refused(AXES("fixed: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], cells: mesh"),
                   "3:73: materials[0].axes has both 'fixed' and 'cells'; ...");
}

static void unstable_materials_are_refused_where_they_stand(void **state)
{
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.51"), "3:54: ...");
    assert_refused(MATERIAL("youngs_modulus: [1, 1, 10], poissons_ratio: {nu12: 0.3, nu23: 0.3, nu31: 0.3}, "
                            "shear_modulus: {G12: 1, G23: 1, G31: 1}"),
                   "3:63: ...");
    assert_refused(MATERIAL("youngs_modulus: [1, 1, 1], poissons_ratio: {nu12: 0.3, nu31: 0.3}, "
                            "shear_modulus: {G12: 1, G23: 1, G31: 1}"),
                   "3:62: region 'all': neither nu23 nor nu32 is given...");
}

static void constants_that_do_not_go_together_are_refused(void **state)
{
    assert_refused(MATERIAL("youngs_modulus: [1, 1, 1], poissons_ratio: [0.1, 0.2, 0.3]"),
                   "3:62: programs differ in the order of the ratios; give them by name...");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: {plane: 0.3}"),
                   "3:54: poissons_ratio {plane, plane_axis} needs youngs_modulus {plane, axis}, where the axis is e3");
    assert_refused(MATERIAL("youngs_modulus: [1, 1, 1], poissons_ratio: {nu12: 0.1, nu23: 0.1, nu31: 0.1}"),
                   "3:62: nu12, nu23 and nu31 need shear_modulus {G12, G23, G31}; ...");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, shear_modulus: {G12: 1, G21: 1}"),
                   "3:88: 'G12' and 'G21' are the same modulus; state one of them");
    assert_refused(MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, shear_modulus: {G12: 1, G23: 1}"),
                   "3:74: expected either G12, G23 and G31 (or G13), or axis alone");
    assert_refused(
        MATERIAL("youngs_modulus: 1, poissons_ratio: 0.3, shear_modulus: geometrical"),
        "3:74: unknown shear rule 'geometrical'; did you mean 'geometric'? Known: geometric, arithmetic, min, "
        "max");
    assert_refused(MATERIAL("youngs_modulus: {plane: 1, axis: 2}, poissons_ratio: {nu12: 0.1}"),
                   "3:72: with youngs_modulus {plane, axis} (the axis is e3), poissons_ratio is a number or {plane, "
                   "plane_axis}; ...");
}

static void bad_axes_are_refused_where_they_stand(void **state)
{
    assert_refused(AXES("fixed: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]"),
                   "3:81: axes of region 'all': the axes are left-handed; ...");
    assert_refused(AXES("quaternion: [0, 0, 0, 0]"), "3:86: quaternion (0, 0, 0, 0); ...");
    assert_refused(AXES("euler: {degrees: [1, 2, 3], sequence: zzx}"), "3:112: Euler sequence 'zzx'; ...");
    assert_refused(AXES("cylindrical: {origin: [0, 0, 0], axis: [0, 0, 0], order: [axial, radial, tangential]}"),
                   "3:113: found the vector 0 0 0, expected a direction: three numbers not all zero");
    assert_refused(AXES("cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [axial, radial, radial]}"),
                   "3:147: direction 'radial' occurs twice; e1, e2 and e3 need a different one each");
    assert_refused(AXES("curve: {points: [[0, 0, 0]]}"), "3:90: found 1 points, expected two at least");
    assert_refused(AXES("curve: {points: [[0, 0, 0], [0, 0, 0]]}"),
                   "3:102: this point repeats the one before it; neighbouring points of a curve must differ");
    assert_refused(AXES("gradient: {e1: {from: a, to: a}, e2: {from: b, to: c}}"),
                   "3:103: 'a' is both from and to; a gradient needs two boundaries");
}

static void bad_selections_are_refused(void **state)
{
    assert_refused(ON("all: false"), "4:16: constraints[0].on.all: found 'false', expected true");
    assert_refused(ON("plane: {point: [0, 0, 0], normal: [0, 0, 1], tolerance: -1}"),
                   "4:67: constraints[0].on.plane.tolerance: found '-1', expected a distance, 0 or above");
    assert_refused(ON("box: {min: [0, 2, 0], max: [1, 1, 1]}"),
                   "4:22: min is above max along y (2 > 1); exchange them");
    assert_refused(ON("vertices: [1, 2, 1]"), "4:21: vertex 1 occurs twice in the list");
    assert_refused(ON("vertices: held.txt"), "4:21: constraints[0].on.vertices: found 'held.txt', expected a list of "
                                             "vertex labels, or the name of a .bou file");
    assert_refused(ON("cylinder: {origin: [0, 0, 0], axis: [0, 0, 1], radius: 1, radii: [0, 1]}"),
                   "4:21: constraints[0].on.cylinder has both 'radius' and 'radii'; ...");
}

static void bad_conditions_are_refused(void **state)
{
    assert_refused(CUBE STEEL "constraints:\n  - {on: {all: true}, displacement: [free, free, free]}\n",
                   "4:37: every component is free, so this constraint constrains nothing; leave it out");
    assert_refused(CUBE STEEL "constraints:\n  - {on: {all: true}, displacement: [fre, 0, 0]}\n",
                   "4:38: constraints[0].displacement[0]: found 'fre', expected a number");
    assert_refused(CUBE STEEL "constraints:\n  - {on: {all: true}, displacement: [null, 0, 0]}\n",
                   "4:38: constraints[0].displacement[0]: found 'null', expected a number or the word free");
    assert_refused(LOAD("traction: [1, 0, 0]"), "4:5: 'traction' needs 'on': where it acts");
    assert_refused(LOAD("on: {all: true}, gravity: [0, 0, 1]"),
                   "4:10: 'gravity' acts in the volume and has no 'on'; 'region: NAME' restricts it");
    assert_refused(LOAD("on: {all: true}, pressure: 1, share: faces"),
                   "4:43: 'share' belongs to total_force, moment and distributing, not to 'pressure'");
    assert_refused(LOAD("on: {all: true}, pressure: 1, region: a"),
                   "4:44: 'region' belongs to gravity, body_force and centrifugal; 'pressure' acts where 'on' says");
    assert_refused(LOAD("gravity: [0, 0, -9.81]"),
                   "4: gravity acts on mass, but no material has a density above 0; state one, or state ...");
    assert_refused(CUBE "materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3, density: 0}]\n"
                        "loads:\n  - {gravity: [0, 0, -9.81]}\n",
                   "4: gravity acts on mass, but no material has a density above 0; state one, or state ...");
}

static void what_no_version_does_is_refused_in_words(void **state)
{
    assert_refused(CUBE STEEL "effects: {large_rotation: auto}\n",
                   "3:1: unknown key 'effects' in the case. Known keys: ...");
    assert_refused(
        CUBE STEEL "output: {fields: [displacement, temperature]}\n",
        "3:33: unknown field 'temperature'. Known: displacement, reaction, load, stress, node_stress, strain_tensor, "
        "strain_energy_density, "
        "axes, region, rank, error, tsai_wu_load_factor, ...");
    assert_refused(CUBE STEEL "output: {fields: [strain]}\n",
                   "3:19: unknown field 'strain'; did you mean 'strain_tensor'? Known: ...");
}

static void bad_settings_are_refused(void **state)
{
    assert_refused(CUBE STEEL "accuracy: {relative_residual: 0.51}\n",
                   "3:31: accuracy.relative_residual: found '0.51', expected a number from 1e-15 to 0.5");
    assert_refused(CUBE STEEL "accuracy: {relative_error: 1}\n",
                   "3:28: accuracy.relative_error: found '1', expected a number above 0 and below 1");
    assert_refused(CUBE STEEL "large_rotation: yes\n", "3:17: unknown answer 'yes'. Known: auto, on, off");
    assert_refused(CUBE STEEL "buckling: maybe\n", "3:11: unknown answer 'maybe'. Known: off, on");
    assert_refused(CUBE STEEL "buckling: {modes: 4}\n",
                   "3:19: buckling.modes: found '4', expected a whole number from 1 "
                   "to 3");
    assert_refused(CUBE STEEL "buckling: on\npath: {steps: 2}\n",
                   "3:11: the body buckles under the load of one linear answer, and a path has many; leave out "
                   "'buckling' or 'path'");
    assert_refused(CUBE STEEL "constraints: free_body\nbuckling: on\n", "4:11: a free body that is pressed turns ...");
    assert_refused(CUBE STEEL "formulation: corotational\n",
                   "3:14: unknown formulation 'corotational'. Known: consistent, classical");
    assert_refused(CUBE STEEL "large_rotation: false\nformulation: classical\n", "4:14: formulation says how ...");
    assert_refused(CUBE STEEL "large_rotation: off\nformulation: classical\n",
                   "4:14: formulation says how large rotations are computed, and large_rotation is off; leave out one "
                   "of them");
    assert_refused(CUBE STEEL "constraints: free_body\nsprings: [{on: {nearest: [0, 0, 0]}, spring: 1}]\n",
                   "4:10: nothing holds a free body, and springs would; leave out these, or free_body");
    assert_refused(CUBE STEEL "constraints: free_body\nlarge_rotation: on\n",
                   "4:17: a free body is solved linearly: nothing says how far it turns as a whole; constrain six of "
                   "its components, or leave large_rotation out");
    assert_refused(CUBE STEEL "accuracy: {out_of_reach: acept}\n",
                   "3:26: unknown answer 'acept'; did you mean 'accept'? Known: refuse, accept");
    assert_refused(CUBE STEEL "solver: {method: twolevel}\n",
                   "3:18: unknown method 'twolevel'; did you mean 'two_level'? Known: auto, plain, metric, strong, "
                   "two_level, direct");
    assert_refused(CUBE STEEL "solver: {patience: 0}\n",
                   "3:20: solver.patience: found '0', expected a whole number from 1 to 1000000");
    assert_refused(CUBE STEEL "solver: {most_levels: 13}\n",
                   "3:23: solver.most_levels: found '13', expected a whole number from 1 to 12");
    assert_refused(CUBE STEEL "solver: {factor_memory: -1}\n",
                   "3:25: solver.factor_memory: found '-1', expected a number of MiB from 0 to 1e12");
    assert_refused(CUBE STEEL "solver: {factor_memory: 1e300}\n",
                   "3:25: solver.factor_memory: found '1e300', expected a number of at most 1e75 in size (squares of "
                   "larger ones leave double precision; choose other units)");
    assert_refused(CUBE STEEL "solver: {aggregate_nodes: 1}\n",
                   "3:27: solver.aggregate_nodes: found '1', expected a number of nodes above 1, at most 1e6");
    assert_refused(CUBE STEEL "solver: {coarse_aggregate_nodes: 2e6}\n",
                   "3:34: solver.coarse_aggregate_nodes: found '2e6', expected a number of nodes above 1, at most 1e6");
    assert_refused(CUBE STEEL "solver: {smoother_block_nodes: 1000000}\n",
                   "3:32: solver.smoother_block_nodes: found '1000000', expected a number of nodes from 1 to 1000");
    assert_refused(CUBE STEEL "solver: {smoother_block_nodes: 0.5}\n",
                   "3:32: solver.smoother_block_nodes: found '0.5', expected a number of nodes from 1 to 1000");
    assert_refused(CUBE STEEL "solver: {smoother_ratio: 1e7}\n",
                   "3:26: solver.smoother_ratio: found '1e7', expected a number above 1, at most 1e6");
    assert_refused(CUBE STEEL "solver: {smoother_degree: 21}\n",
                   "3:27: solver.smoother_degree: found '21', expected a whole number from 1 to 20");
    assert_refused(CUBE STEEL "solver: {coarsest_unknowns: 0}\n",
                   "3:29: solver.coarsest_unknowns: found '0', expected a whole number from 1 to 1000000");
    assert_refused(CUBE STEEL "accuracy: {relative_residual: 9e-16}\n",
                   "3:31: accuracy.relative_residual: found '9e-16', expected a number from 1e-15 to 0.5");
    assert_refused(
        CUBE STEEL "solver: {method: metrics}\n",
        "3:18: unknown method 'metrics'; did you mean 'metric'? Known: auto, plain, metric, strong, two_level, direct");
    assert_refused(CUBE STEEL "solver: {max_iterations: 0}\n",
                   "3:26: solver.max_iterations: found '0', expected a whole number from 1 to 1000000");
    assert_refused(CUBE STEEL "output: {file: a.vtk}\n",
                   "3:16: output.file: found 'a.vtk', expected a name that ends with .vtkhdf, .hdf, "
                   ".vtu or .pvtu");
    assert_refused("mesh: {file: a.stl}\n" STEEL, "1:14: ...");
    assert_refused("mesh: {tube: {axis: y, length: 1, radii: [2, 1], divisions: {around: 3, radial: 1, axial: 1}}}\n",
                   "1:42: found radii 2 and 1, expected the inner one first and smaller");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_missing_file_is_named),
    cmocka_unit_test(control_characters_are_no_part_of_names),
    cmocka_unit_test(an_unknown_key_comes_with_the_nearest),
    cmocka_unit_test(springs_say_what_is_wrong),
    cmocka_unit_test(eigenstrains_say_what_is_wrong),
    cmocka_unit_test(only_a_pressure_follows),
    cmocka_unit_test(missing_doubled_and_empty_keys_are_refused),
    cmocka_unit_test(wrong_types_say_what_was_found),
    cmocka_unit_test(numbers_are_whole_and_finite),
    cmocka_unit_test(exactly_one_form_is_expected),
    cmocka_unit_test(unstable_materials_are_refused_where_they_stand),
    cmocka_unit_test(constants_that_do_not_go_together_are_refused),
    cmocka_unit_test(bad_axes_are_refused_where_they_stand),
    cmocka_unit_test(bad_selections_are_refused),
    cmocka_unit_test(bad_conditions_are_refused),
    cmocka_unit_test(what_no_version_does_is_refused_in_words),
    cmocka_unit_test(bad_settings_are_refused),
};

OST_TEST_MAIN(tests)
