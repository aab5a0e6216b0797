# SPDX-License-Identifier: BSD-3-Clause
"""Errors of watched quantities where rotations are large, along a path, where nodes follow others and by the mixed form, against finer
meshes; and why there is none, in words."""
import os

from bricks import brick_mesh
from program import check, fewer, new_folder, solve

folder = new_folder()
MESH = """mesh: {block: {size: [10, 1, 1], divisions: [DIVISIONS]}}
element: {order: ORDER}
accuracy: {relative_residual: 1e-9}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
"""
HELD = "{on: {boundary: xmin}, displacement: [0, 0, 0]}"
REACTIONS = """  pull: {reaction: {boundary: xmin}, component: x}
  shear: {reaction: {boundary: xmax}, component: z}
  moment: {reaction: {boundary: xmin}, about: [0, 0.5, 0.5], component: y}
"""
# One end moved far; one that slides, so that the arms of its moment grow; a dead load that bends.
MOVED = MESH + f"""large_rotation: on
constraints: [{HELD}, {{on: {{boundary: xmax}}, displacement: [-0.2, 0, 2]}}]
watch:
{REACTIONS}  whole: {{reaction: {{boundary: xmin}}}}
  inside: {{stress: {{at: [2.1, 0.65, 0.83]}}, component: xx}}
"""
SLID = MESH + f"""large_rotation: on
constraints: [{HELD}, {{on: {{boundary: xmax}}, displacement: [free, free, 0]}}]
loads: [{{body_force: [0, 0, 2]}}]
watch:
  far: {{reaction: {{boundary: xmax}}, about: [10, 0.5, 0.5], component: y}}
  moment: {{reaction: {{boundary: xmin}}, about: [0, 0.5, 0.5], component: y}}
  along: {{reaction: {{boundary: xmin}}, component: x}}
"""
BENT = MESH + f"""large_rotation: on
constraints: [{HELD}]
loads: [{{on: {{boundary: xmax}}, total_force: [0, 0, 1]}}]
watch:
  tip: {{displacement: {{nearest: [10, 0.5, 0.5]}}, component: z}}
  b: {{stress: {{at: [6.1, 0.45, 0.83]}}, component: xx}}
  c: {{stress: {{at: [6.1, 0.45, 0.23]}}, component: xx}}
  d: {{stress: {{at: [2.1, 0.65, 0.23]}}, component: von_mises}}
"""
RIGID = MESH + f"""large_rotation: off
constraints: [{HELD}, {{on: {{boundary: xmax}}, rigid: {{at: [10, 0.5, 0.5], displacement: [0.1, free, 0.2], rotation: [0, 0.05, free]}}}}]
watch:
{REACTIONS}"""
MIXED = MESH.replace("0.3}]", "0.5}]") + f"""large_rotation: off
constraints: [{HELD}, {{on: {{boundary: xmax}}, displacement: [-0.02, 0, 0.2]}}]
watch:
{REACTIONS}  mean: {{stress: {{region: all}}, component: xx}}
  pressure: {{stress: {{region: all}}, component: pressure}}
  a: {{stress: {{at: [5.1, 0.35, 0.13]}}, component: xx}}
  b: {{stress: {{at: [7.6, 0.45, 0.13]}}, component: pressure}}
  c: {{stress: {{at: [8.2, 0.45, 0.83]}}, component: von_mises}}
  middle: {{displacement: {{nearest: [5, 0, 1]}}, component: x}}
"""
CELL = """mesh: {block: {size: [1, 1, 1], divisions: [DIVISIONS]}}
element: {order: ORDER}
materials:
  - {region: all, youngs_modulus: [1000, 50, 50], poissons_ratio: 0.3, axes: {cylindrical: {origin: [-1, 0.4, 0], axis: [0, 0, 1],
     order: [tangential, radial, axial]}}}
large_rotation: off
constraints: [{periodic: [[xmin, xmax], [ymin, ymax], [zmin, zmax]], strain: {xx: 0.01, xy: 0.01}}, {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}]
watch:
  across: {reaction: {boundary: ymax}, component: y}
  sheared: {reaction: {boundary: ymax}, component: x}
"""


# Multigrid takes many cycles for what bends a thin plate: an estimate by few of them was a tenth of the error.
PLATE = """mesh: {block: {size: [20, 20, 0.5], divisions: [DIVISIONS]}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: zmax}, pressure: 1}]
watch:
  corner: {displacement: {nearest: [20, 0, 0]}, component: z}
solver: {method: metric}
accuracy: {relative_residual: 1e-7}
large_rotation: off
"""


# Solved by multigrid to the stop: half of a bar's twist, and of a bed's bending, was missed by steps that were short.
WOUND = """mesh: {block: {size: [4, 1, 1], divisions: [DIVISIONS]}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: [1e9, 1e10, 1e9], poissons_ratio: 0.3,
    axes: {cylindrical: {origin: [0, -0.5, -0.5], axis: [1, 0, 0], order: [radial, tangential, axial]}}}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, moment: [1e4, 0, 0]}]
watch: {tip: {displacement: {nearest: [4, 1, 1]}, component: z}}
solver: {method: metric}
"""
BED = WOUND.split("materials")[0] + """materials: [{region: all, youngs_modulus: 1e10, poissons_ratio: 0.3}]
springs: [{on: {boundary: zmin}, foundation: {normal: 1e10, tangential: 1e8}}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, -1e5]}]
watch: {tip: {displacement: {nearest: [4, 0.5, 1]}, component: z}}
solver: {method: metric}
"""
STIFF_BED = BED.replace("foundation: {normal: 1e10, tangential: 1e8}", "foundation: 1e12").replace("total_force: [0, 0, -1e5]", "traction: [0, 0, -1e4]")
# A little twist beside much widening: what the stop leaves is in the twist.
WIDENED = """mesh: {tube: {axis: z, length: 2, radii: [0.8, 1], divisions: {around: 24, radial: 2, axial: 8}}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1e9, 1e10, 1e9], poissons_ratio: 0.3,
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]
constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: inner}, pressure: 1e5}, {on: {boundary: top}, moment: [0, 0, 1e4]}]
watch: {twist: {displacement: {nearest: [0, 1, 2]}, component: x}}
solver: {method: metric}
"""


def watched(case, order, divisions, ranks=1, text=""):
    done, report, _ = solve(case.replace("ORDER", str(order)).replace("DIVISIONS", divisions) + text, ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    return report["watched"], done


def ratios_hold(name, case, fine, coarse, skip=(), several=(1,)):
    exact, _ = watched(case, 2, fine)
    for order, divisions in coarse:
        first = None
        for ranks in several if order == 2 else (1,):
            found, _ = watched(case, order, divisions, ranks)
            first = first or found
            for key, value in found.items():
                missing = exact[key]["value"] - value["value"]
                check(key in skip or 0.5 < value["error"] / missing < 2, f"{name}, {key}, order {order}: {value}, missing {missing}")
                check(abs(value["error"] - first[key]["error"]) <= 0.1 * abs(first[key]["error"]) + 1e-12,
                      f"{name}, {key}: {value} on {ranks} ranks, {first[key]} on one")
    return exact


BEAMS = (1, "20, 4, 4"), (2, "10, 2, 2")
ratios_hold("a moved end", MOVED, "20, 4, 4", BEAMS, several=(1, 2))
ratios_hold("an end that slides", SLID, "20, 4, 4", BEAMS, skip=("along",))
ratios_hold("bent", BENT, "20, 4, 4", BEAMS)
# By a hierarchy as by factors: one that was made before the body turned found a third.
TURNED = BENT.split("  b:")[0].replace("accuracy: {relative_residual: 1e-9}\n", "").replace("[10,", "[4,").replace("[0, 0, 1]", "[0, 0, 4]")
tips = [watched(TURNED, 2, "8, 4, 4", text=f"solver: {{method: {by}}}\n")[0]["tip"]["error"] for by in ("metric", "direct")]
check(0.8 < tips[0] / tips[1] < 1.25, f"the error of a tip by a hierarchy and by factors: {tips}")
ratios_hold("a rigid face", RIGID, "20, 4, 4", BEAMS, several=(1, 2))
ratios_hold("a thin plate", PLATE, "20, 20, 2", ((2, "10, 10, 1"),))
# In flat tets the functions that are added are found slowly: 0.41 of a strip's error was stated, `of` its tip 0.44.
STRIP = PLATE.replace("[20, 20, 0.5]", "[20, 4, 0.25]").replace("1e-7", "1e-6")
ratios_hold("a strip", STRIP, "40, 8, 1", ((2, "10, 2, 1"),))
ratios_hold("its tip", STRIP.replace("residual: 1e-6", "residual: 1e-6, of: corner"), "40, 8, 1", ((2, "10, 2, 1"),))
# 0.4 of this corner's error was stated while steps on the elements' own unknowns did not start along the displacement.
PULLED = PLATE.replace("zmax}, pressure: 1", "xmax}, total_force: [0, 0, 1]").replace("1e-7", "1e-6")
ratios_hold("a plate that is pulled at its edge", PULLED, "20, 20, 2", ((2, "10, 10, 1"),), several=(1, 2))
ratios_hold("a twisted bar", WOUND, "16, 8, 8", ((2, "8, 4, 4"),), several=(1, 2))
ratios_hold("a bar on a bed", BED, "16, 8, 8", ((2, "8, 4, 4"),), several=(2,))
# The truth is 13 %; what a stiff bed takes at vertices, which nothing keeps near it, made 82 % of that.
for ranks in fewer((1, 2)):
    done, report, _ = solve(STIFF_BED.replace("ORDER", "2").replace("DIVISIONS", "8, 4, 4"), ranks=ranks, folder=folder)
    check(0.1 < report["answer_error"]["relative"] < 0.25, f"a stiff bed on {ranks} ranks: {report['answer_error']}")
stopped, solved = (watched(WIDENED + text, 2, "")[0]["twist"] for text in ("", "accuracy: {relative_residual: 1e-9}\n"))
check(abs(solved["value"] - stopped["value"]) > 0.01 * abs(solved["value"]), f"the stop left nothing: {stopped}, {solved}")
check(abs(sum(stopped[part] - solved[part] for part in ("value", "error"))) < 0.2 * abs(stopped["value"] - solved["value"]),
      f"what the stop left of a twist is not in its error: {stopped}, {solved}")
# Where nothing is watched, few steps have a part of the largest displacement's error.
for size, whole in ("20, 20, 0.5", False), ("20, 20, 20", True):
    case = PLATE.split("watch:")[0].replace("20, 20, 0.5", size) + "solver: {method: metric}\nlarge_rotation: off\n"
    done, report, _ = solve(case.replace("ORDER", "2").replace("DIVISIONS", "10, 10, 1" if not whole else "5, 5, 5"), folder=folder)
    check(report["answer_error"]["displacement_is_least"] == (not whole), f"{size}: {report['answer_error']}")
    check((" at least " in done.output) == (not whole), done.output)
ratios_hold("a cell", CELL, "8, 8, 8", ((1, "6, 6, 6"), (2, "3, 3, 3")), several=(1, 2))
for material in "0.5", "0.499":
    ratios_hold(f"nu {material}", MIXED.replace("0.5}", material + "}"), "20, 3, 3", ((2, "10, 2, 2"),), several=(1, 2) if material == "0.5" else (1,))
# Statics: the mean axial stress of a bar that is loaded at its ends alone is the pull over its section. So are their errors.
found, _ = watched(MIXED, 2, "10, 2, 2")
for part in "value", "error":
    check(abs(found["mean"][part] / -found["pull"][part] - 1) < 1e-4, f"{part} of mean stress and pull: {found}")
ratios_hold("a moved end, nu 0.5", MOVED.replace("0.3}]", "0.5}]"), "20, 4, 4", ((2, "10, 2, 2"),))

# Statics gives a reaction with the answer's pressure.
for nu in fewer(("0.5", "0.499")):
    found, done = watched(MESH.replace("0.3}]", nu + "}]") + f"""large_rotation: off
constraints: [{HELD}]
loads: [{{on: {{boundary: xmax}}, total_force: [1, 0, 1]}}]
watch:
{REACTIONS}""", 2, "6, 1, 1")
    check(found["pull"]["error"] == 0 and abs(found["pull"]["value"] + 1) < 1e-6, f"statics, nu {nu}: {found['pull']}")

# With large rotations it gives a moment too, where no load acts that has an arm: a body that swells, held at one end.
found, done = watched(MESH.replace("0.3}]", "0.3, eigenstrain: [0.1, 0, 0.05], axes: {rotation: {axis: [1, 2, 3], degrees: 40}}}]") + f"""large_rotation: on
constraints: [{HELD}]
watch:
{REACTIONS}""".replace("xmax", "xmin"), 1, "6, 1, 1")
for name, of in found.items():
    check(of["error"] == 0 and abs(of["value"]) < 1e-6, f"a body that swells, {name}: {of}")

# Half of a clamped beam, cut along its plane of symmetry, which the clamped end meets at an edge: nothing else acts along y, so both
# bear the same. The truth is by 2.3 million unknowns, which state an error of 0.002; in full at both, the edge's nodes made it 0.9.
HALF = """mesh: {block: {size: [3, 0.5, 1], divisions: [DIVISIONS]}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: 1e5, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}]
loads: [{on: {boundary: xmax}, total_force: [10, 0, -1]}]
large_rotation: off
watch:
  cut: {reaction: {boundary: ymin}, component: y}
  end: {reaction: {boundary: xmin}, component: y}
  along: {reaction: {boundary: xmin}, component: x}
  inner: {reaction: {boundary: ymin}, about: [0, 0, 0], component: x}
  outer: {reaction: {boundary: xmin}, about: [0, 0, 0], component: x}
  beside: {reaction: {boundary: ymin}, component: x}
"""
for ranks in fewer((1, 2)):
    for order, asked in (1, ""), (2, ""), (2, "accuracy: {relative_error: 0.1, of: end}\n"):
        found, done = watched(HALF, order, "6, 1, 2", ranks, asked)
        end = found["end"]
        check(abs(found["cut"]["value"] + end["value"]) < 1e-3 * end["value"], f"cut and end, order {order}: {found}")
        moment = found["inner"]["value"] + found["outer"]["value"]  # that of the load is -0.25
        check(abs(moment - 0.25) < 1e-3, f"moments: {found}")
        check(1 < abs(end["error"] / (1.35 - end["value"])) < (4 if order == 1 else 2.5), f"a common edge, order {order}: {end}")
        check(found["along"]["error"] == 0, f"another direction: {found['along']}")
        check(found["beside"]["value"] == found["beside"]["error"] == 0, f"what the other alone holds: {found['beside']}")
        check(not asked or (end["error"] < 0.1 * end["value"] and "its error added" not in done.output), done.output)

# What others alone hold along a direction, and a spring where a constraint holds, is not counted: three planes of symmetry, each of
# which had an eighth of the pull of the first; and a bed beside a clamped face, whose sum with it was 1.007 of the weight.
PLANES = """mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0.3, density: 1}]
constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}]
loads: [{on: {boundary: xmax}, traction: [1, 0, 0]}]
large_rotation: off
watch:
""" + "".join(f"  {side}: {{reaction: {{boundary: {side}}}, component: x}}\n" for side in ("xmin", "ymin", "zmin"))
BEDDED = PLANES.split("constraints:")[0] + """constraints: [{on: {boundary: ymin}, displacement: [0, 0, 0]}]
springs: [{on: {boundary: xmax}, foundation: 20}]
loads: [{gravity: [0, 0, -1]}]
large_rotation: off
watch:
""" + "".join(f"  {side}: {{reaction: {{boundary: {side}}}, component: z}}\n" for side in ("ymin", "xmax"))
for ranks in fewer((1, 2)):
    found, _ = watched(PLANES, 2, "", ranks)
    check(abs(found["xmin"]["value"] + 1) < 1e-9 and found["ymin"]["value"] == found["zmin"]["value"] == 0, f"planes of symmetry: {found}")
    found, _ = watched(BEDDED, 2, "", ranks)
    check(abs(found["ymin"]["value"] + found["xmax"]["value"] - 1) < 1e-6, f"a clamped face beside a bed: {found}")
    rigid, _ = watched(BEDDED.replace("displacement: [0, 0, 0]", "rigid: {at: [0, 0, 0], displacement: [0, 0, 0], rotation: [0, 0, 0]}"),
                       2, "", ranks)
    check(all(abs(rigid[key]["value"] - value["value"]) < 1e-6 for key, value in found.items()), f"held as a rigid face: {rigid}, {found}")

# Means in a layer up to 1000 times stiffer, which has little of the energy: by few steps they were other ones on two ranks.
brick_mesh(os.path.join(folder, "layers.msh"), [("b", (0, 0, 0), (1, 1, 1), (3, 3, 3), ("soft", "stiff", "soft"))])
LAYERS = """mesh: {file: layers.msh, refine: FINER}
element: {order: 2}
materials: [{region: soft, youngs_modulus: 1e4, poissons_ratio: 0.3},
    {region: stiff, youngs_modulus: [1e7, 1e5, 1e5], poissons_ratio: 0.3, axes: {fixed: {e1: [1, 1, 0], e3: [0, 0, 1]}}}]
constraints: [{on: {boundary: b_xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: b_xmax}, traction: [1, 0, 2]}, {on: {boundary: b_zmax}, pressure: 1}]
large_rotation: off
watch:
""" + "".join(f"  {name}: {{stress: {{region: stiff}}, component: {name}}}\n" for name in ("xx", "zx", "pressure"))
finer, first = watched(LAYERS.replace("FINER", "1"), 2, "")[0], {}
for ranks in fewer((1, 2)):
    found, _ = watched(LAYERS.replace("FINER", "0"), 2, "", ranks)
    for name, value in found.items():
        missing = finer[name]["value"] + finer[name]["error"] - value["value"]
        check(name == "pressure" or 0.7 < value["error"] / missing < 1.4, f"a stiff layer's {name}, {ranks} ranks: {value}, {missing}")
        first[name] = first.get(name, value["error"])
        check(abs(value["error"] / first[name] - 1) < 0.05, f"a stiff layer's {name}: {value} on {ranks} ranks, {first} on one")

# Statics gives a force, whatever the rotations.
found, done = watched(SLID, 1, "10, 2, 2")
check(found["along"]["error"] == 0 and "statics" in done.output, f"along: {found['along']}")

# The end of a path has the errors of that load alone, linear or not.
for case in MOVED, MOVED.replace("large_rotation: on", "large_rotation: off"):
    alone, _ = watched(case, 2, "10, 2, 2")
    last, _ = watched(case, 2, "10, 2, 2", text="path: {steps: 2}\n")
    for key, value in alone.items():
        check(abs(last[key]["error"] - value["error"]) < 0.05 * abs(value["error"]), f"path, {key}: {last[key]}, alone {value}")

# Moved by its supports alone a body has 2 U = R·d, so that the error of R·d is |e|², and that of U half of it; by products with the
# adjoint's error it was 0.6 of that. The mean stress along the bar is R over the section.
SHEARED = """mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 2]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1e5, 1e3, 1e3], poissons_ratio: 0.3, shear_modulus: geometric,
     axes: {rotation: {axis: [0.3, -0.8, 1], degrees: 25}}}]
large_rotation: off
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, displacement: [0.02, 0, 0.1]}]
watch:
  x: {reaction: {boundary: xmax}, component: x}
  z: {reaction: {boundary: xmax}, component: z}
  mean: {stress: {region: all}, component: xx}
"""
for ranks, text in (1, ""), (2, ""), (1, "accuracy: {relative_error: 0.3}\n"), (1, "accuracy: {of: z}\n"):
    done, report, _ = solve(SHEARED + text, ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    x, z, mean = (report["watched"][key]["error"] for key in ("x", "z", "mean"))
    square = report["answer_error"]["energy_norm"] ** 2
    check(abs(-(0.02 * x + 0.1 * z) / square - 1) < 0.15, f"{text} on {ranks} ranks: the error of R·d beside |e|² = {square}: {x}, {z}")
    check(abs(mean / x - 1) < 0.15, f"{text} on {ranks} ranks: the errors of mean stress and pull: {mean}, {x}")

# On curved tets too: both ends bear the same force, and the work of either is twice the strain energy. By straight tets' stiffness what
# was stated of the ends was 1.1 and 2.4 times that in an isotropic ring, and 0 and 2.2 times in the other, with either sign.
RING = """mesh: {sector: {axis: z, length: 0.6, radii: [2, 3], angle: 90, divisions: {around: AROUND, radial: 2, axial: 1}}}
element: {order: 2}
materials: [{region: all, youngs_modulus: MODULI, poissons_ratio: 0.3,
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]
large_rotation: off
constraints: [{on: {boundary: finish}, displacement: [0, 0, 0]}, {on: {boundary: start}, displacement: [0, 0.01, 0]}]
watch:
  still: {reaction: {boundary: finish}, component: y}
  moved: {reaction: {boundary: start}, component: y}
  energy: strain_energy
"""
for moduli in "1", "[1, 10, 3]":
    found, _ = watched(RING.replace("MODULI", moduli).replace("AROUND", "6"), 2, "")
    still, moved, energy = (found[key]["error"] / found[key]["value"] for key in ("still", "moved", "energy"))
    check(abs(still / moved - 1) < 1e-3, f"both ends of a ring of {moduli}: {found}")
    check(abs(moved / energy - 1) < 0.15, f"a ring of {moduli}, its force and its energy: {found}")

# What an early stop leaves of a mixed form's mean stress is found by the adjoint problem, and added: of both equations.
STRETCHED = """mesh: {block: {size: [4, 1, 1], divisions: [8, 3, 3]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.5}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [1, 0, 1]}]
large_rotation: off
watch: {across: {stress: {region: all}, component: yy}, pressure: {stress: {region: all}, component: pressure}}
solver: {method: metric}
"""
solved, _ = watched(STRETCHED, 2, "", text="accuracy: {relative_residual: 1e-10, algebraic_fraction: 0}\n")
stopped, _ = watched(STRETCHED, 2, "")
for key, value in solved.items():
    check(abs(stopped[key]["value"] - value["value"]) <= 3e-4 * abs(value["value"]), f"{key}: {stopped[key]}, solved {value}")

# What is not known is said, with the reason.
SILENT = {
    "energy": (BENT + "  work: strain_energy\n", "work", "large rotations"),
    "mean": (BENT + "  mean: {stress: {region: all}, component: von_mises, take: mean}\n", "mean", "not linear"),
    "coupling": (MESH + f"""constraints: [{HELD}]
loads: [{{on: {{boundary: xmax}}, distributing: {{at: [10, 0.5, 0.5], displacement: [0.01, free, free]}}}}]
watch: {{pull: {{reaction: {{boundary: xmin}}, component: x}}}}
""", "pull", "moved coupling"),
}
for name, (case, key, words) in SILENT.items():
    found, done = watched(case, 2, "6, 1, 1")
    line = next(line for line in done.output.splitlines() if line.startswith(key))
    check(found[key]["error"] is None and words in found[key]["error_not_known"], f"{name}: {found[key]}")
    check(f"error not known: {found[key]['error_not_known']}" in line, f"{name}: {line}")
found, done = watched(BENT, 2, "6, 1, 1", text="output: {fields: [stress]}\n")
check(all(value["error"] is None and value["error_not_known"] is None for value in found.values()), f"not asked for: {found}")
check("not known" not in done.output, done.output)
