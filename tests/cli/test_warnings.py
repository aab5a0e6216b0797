"""Every warning that goes to standard error stands in the JSON report too."""
import json

from program import SANITIZED, check, new_folder, run, write

# A block in which a vertex is used by no tet, nearly incompressible, with a vertex watched where there is none.
MESH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 9 9 9
$EndNodes
$Elements
1
1 4 2 1 1 1 2 3 4
$EndElements
"""
CASE = """mesh: {file: tet.msh}
materials:
  - {region: all, youngs_modulus: 1, poissons_ratio: 0.4995}
constraints:
  - {on: {vertices: [1, 2, 3]}, displacement: [0, 0, 0]}
loads:
  - {on: {vertices: [4]}, point_force: [0, 0, 1e-9]}
watch: {top: {displacement: {nearest: [0, 0.3, 0.9]}, component: z}}
output: {file: result.vtkhdf, fields: [displacement]}
"""
KINDS = ["tet.msh: 1 vertex is used by no tet", "linear tets lock", "'top' is taken at (0, 0, 1)"]


def compare(words, folder, kinds, json_words, exit_code=0):
    ended = run(*words, *json_words, folder=folder)
    check(ended.exit_code == exit_code, f"{words}: {ended.errors}")
    start = "orthostat: warning: "
    printed = [line[len(start):] for line in ended.errors.splitlines() if line.startswith(start)]
    reported = json.loads(ended.output)["warnings"]
    check(printed == reported, f"{words}: standard error warns of {printed}, the report of {reported}")
    for kind in kinds:
        check(any(kind in text for text in reported), f"{words}: no warning '{kind}' in {reported}")
    quiet = json.loads(run(*words, "-q", *json_words, folder=folder).output)["warnings"]
    check(quiet == reported, f"{words}: with -q the report has {quiet} in place of {reported}")


def main():
    folder = new_folder()
    for name, text in [("tet.msh", MESH), ("case.yaml", CASE)]:
        write(folder, name, text)
    compare(["solve", "case.yaml"], folder, KINDS, ["--json", "-"])
    compare(["check", "case.yaml"], folder, KINDS, ["--json"])
    compare(["explain", "case.yaml"], folder, KINDS[:1], ["--json"])
    compare(["cost", "case.yaml", "--refinements", "0", "--orders", "1", "--tolerances", "1e-8", "--accuracies", "-"], folder, KINDS[:2], ["--json", "-"])
    plane_faces(folder)
    arbitrary_points(folder)
    if not SANITIZED:  # words of `check`
        zero_loads(folder)
        overridden_materials(folder)
        odd_units(folder)
        radians(folder)
        absent_fields(folder)
        nothing_to_refine(folder)


# A load of zero does nothing; where a sweep, a load case or --set says zero, it is meant.
ZERO = """mesh: {block: {size: [1, 1, 1], divisions: [1, 1, 1]}}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3}]
constraints: [{on: {boundary: zmin}, displacement: [0, 0, 0]}]
loads:
  - {on: {boundary: xmax}, total_force: [1, 0, 0]}
  - {on: {boundary: zmax}, pressure: VALUE}
"""
NEVER_ZERO = "cases: [{name: calm, loads: [{on: {boundary: xmin}, traction: [0, 0, 0]}]}, {name: wind}]\n"


def zero_loads(folder):
    words = "zero.yaml:6: this load is zero, and does nothing"
    for text, more, warned in ((ZERO, (), True), (ZERO.replace("VALUE", "5"), (), False),
                               (ZERO, ("--set", "loads.1.pressure=0"), False),
                               (ZERO + "sweep: {loads.1.pressure: [1, 2]}\n", (), False),
                               (ZERO + NEVER_ZERO, (), True),
                               (ZERO.replace("VALUE", "5") + NEVER_ZERO, (), False)):
        write(folder, "zero.yaml", text.replace("VALUE", "0"))
        ended = run("check", "zero.yaml", *more, folder=folder)
        check(ended.exit_code == 0 and (words in ended.errors) == warned and ("is zero" in ended.errors) == warned,
              f"{text} {more}: {ended.errors}")
    swept = run("sweep", "zero.yaml", "--case", "wind", "--over", "loads.1.pressure=0,1", folder=folder)
    check(swept.exit_code == 0 and "is zero" not in swept.errors, swept.errors)


# A later material stands in the place of an earlier one: the other order is likely meant.
def overridden_materials(folder):
    one = "{region: %s, youngs_modulus: 1, poissons_ratio: 0.3}"
    for regions, warned in ((("block", "all"), True), (("all", "block"), False), (("block", "block"), True)):
        write(folder, "two.yaml", ZERO.replace("VALUE", "5").replace(one % "all", ", ".join(one % region for region in regions)))
        ended = run("check", "two.yaml", folder=folder)
        check(ended.exit_code == 0 and ("two.yaml:2: the material of region 'block' is nowhere" in ended.errors) == warned,
              f"{regions}: {ended.errors}")


# Of a cube of 1 m³ and 3 Pa, of which GPa are meant, 2 Pa are a large load and 200 Pa an odd one.
def odd_units(folder):
    for pressure, warned in ((2, False), (200, True)):
        text = ZERO.replace("youngs_modulus: 1,", "youngs_modulus: 3,").replace("VALUE", str(pressure))
        write(folder, "units.yaml", text)
        ended = run("solve", "units.yaml", "--output", "units.vtkhdf", folder=folder)
        check(("the units of one set" in ended.errors) == warned, f"{pressure}: {ended.errors}")
        ended = run("solve", "units.yaml", "-q", "--output", "units.vtkhdf", folder=folder)  # the failure itself asks
        check(("the units of one set" in ended.errors) == warned == (ended.exit_code == 1), f"{pressure}: {ended.errors}")


def radians(folder):
    turned = ZERO.replace("VALUE", "5").replace("youngs_modulus: 1,", "youngs_modulus: [1, 2, 3], axes: {rotation: {axis: "
                                                "[0, 1, 0], degrees: ANGLE}},")
    for angle, meant in (("0.2618", "15"), ("-1.5708", "-90"), ("15", None), ("0.5", None), ("0", None), ("1", None)):
        write(folder, "turned.yaml", turned.replace("ANGLE", angle))
        ended = run("check", "turned.yaml", folder=folder)
        check(ended.exit_code == 0 and (f"{meant} degrees are {angle} in radians" in ended.errors) == (meant is not None) and
              ("radians" in ended.errors) == (meant is not None), f"{angle}: {ended.errors}")


# A column pressed on its end is solved exactly, but its cross-section has twelve corners.
COLUMN = """mesh: {tube: {axis: z, length: 2, radii: [0.5, 1], divisions: {around: 12, radial: 1, axial: 2}}}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0}]
element: {order: ORDER}
constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: top}, pressure: 1}]
output: {file: column.vtkhdf}
"""


def plane_faces(folder):
    for order, warned in ((1, "cut off about 6.2 % of the volume and add 1.6 % in hollows"), (2, None)):
        write(folder, "column.yaml", COLUMN.replace("ORDER", str(order)))
        warnings = json.loads(run("solve", "column.yaml", "-q", "--json", "-", folder=folder).output)["warnings"]
        check([text for text in warnings if "meant to be curved" in text] == [text for text in warnings if warned and
              warned in text] and (warned is None or len(warnings) == 1), f"order {order}: {warnings}")
        looked = run("mesh", "column.vtkhdf", folder=folder).output
        check(("cut off 6.2 % of the volume, and add 1.6 % in hollows" in looked) == (order == 1), looked)


# A field that is asked for by name and has no values is left out of the file, with a word.
def absent_fields(folder):
    asked = "output: {file: a.vtu, fields: [displacement, e1, tsai_wu_load_factor, mixed_pressure]}\n"
    need = {"'e1'": "needs a material that is not isotropic", "'tsai_wu_load_factor'": "needs a material with 'strengths'",
            "'mixed_pressure'": "needs the mixed form"}
    has = ZERO.replace("VALUE", "5").replace("0.3}", "0.3, strengths: {tension: 1, shear: 1}, axes: {fixed: {e1: [1, 0, 0], e3: [0, 0, 1]}}}")
    for command in "check", "explain", "solve":
        for text, absent in ((ZERO.replace("VALUE", "5"), set(need)), (has, {"'mixed_pressure'"})):
            write(folder, "absent.yaml", text + asked)
            ended = run(command, "absent.yaml", folder=folder)
            for field, needs in need.items():
                check((f"absent.yaml:7: the field {field} is left out of the output: it {needs}" in ended.errors) ==
                      (field in absent), f"{command} {field}: {ended.errors}")
    write(folder, "absent.yaml", ZERO.replace("VALUE", "5"))
    check("left out" not in run("check", "absent.yaml", folder=folder).errors, "nothing was asked for by name")


# Of two regions one states e3 alone: at a point of that one a stress along e1 is arbitrary.
TWO = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
3 1 "above"
3 2 "below"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -1
$EndNodes
$Elements
2
1 4 2 1 1 1 2 3 4
2 4 2 2 2 1 3 2 5
$EndElements
"""
FIBRE = """mesh: {file: two.msh}
materials:
  - {region: above, youngs_modulus: {plane: 1, axis: 3}, poissons_ratio: {plane: 0.3}, fibre: [0, 0, 1]}
  - {region: below, youngs_modulus: [3, 2, 1], poissons_ratio: 0.3, axes: {fixed: {e1: [1, 0, 0], e3: [0, 0, 1]}}}
constraints: [{on: {vertices: [1, 2, 3]}, displacement: [0, 0, 0]}]
watch: {s: {stress: {at: [0.2, 0.2, HEIGHT]}, component: COMPONENT}}
output: {file: two.vtu, fields: [displacement]}
"""


def arbitrary_points(folder):
    write(folder, "two.msh", TWO)
    for command in "check", "solve":
        for height, component, warned in (0.2, 11, True), (-0.2, 11, False), (0.2, 33, False):
            write(folder, "fibre.yaml", FIBRE.replace("HEIGHT", str(height)).replace("COMPONENT", str(component)))
            ended = run(command, "fibre.yaml", folder=folder)
            check(ended.exit_code == 0 and ("arbitrary numbers: s (11);" in ended.errors) == warned ==
                  ("arbitrary" in ended.errors), f"{command} {height} {component}: {ended.errors}")
            check("on the border" not in ended.errors, f"{ended.errors}")
    write(folder, "fibre.yaml", FIBRE.replace("HEIGHT", "0").replace("COMPONENT", "33"))
    ended = run("check", "fibre.yaml", folder=folder)
    check("border of the regions 'above' and 'below', where stresses may jump: it is that in 'above'" in ended.errors, ended.errors)


# Limits of refinement, where nothing is refined.
def nothing_to_refine(folder):
    case, asks = ZERO.replace("VALUE", "1e-3"), "accuracy: {relative_error: 0.9}\n"
    for text, limit, path in ((case, True, False), (case + asks, False, False), (case + asks + "path: {steps: 1}\n", True, True)):
        write(folder, "fixed.yaml", text)
        ended = run("solve", "fixed.yaml", "--max-time", "60", "--output", "fixed.vtkhdf", folder=folder)
        check(ended.exit_code == 0 and ("--max-time limits how far meshes are refined" in ended.errors) == limit and
              ("fixed.yaml:8: a path is solved on the mesh as it is" in ended.errors) == path, f"{text}: {ended.errors}")
        check(("a path is solved" in run("check", "fixed.yaml", folder=folder).errors) == path, text)
    write(folder, "of.yaml", case + "accuracy: {relative_error: 0.1, of: tip}\n"
          "cases: [{name: a, watch: {tip: {displacement: {nearest: [0, 0, 1]}, component: x}}}, {name: b}]\n")
    ended = run("check", "of.yaml", folder=folder)
    check(ended.exit_code == 2 and "'tip' is not watched in all load cases: what 'cases' adds to one alone does not count, also where --case takes" in ended.errors, ended.errors)
    write(folder, "energy.yaml", case + "accuracy: {of: energy}\nwatch: {energy: strain_energy}\n")
    ended = run("check", "energy.yaml", folder=folder)
    check(ended.exit_code == 2 and "the quantity watched in line 8 has that name too" in ended.errors, ended.errors)


main()
