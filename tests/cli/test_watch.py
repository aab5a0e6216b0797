"""What a case watches: printed by solve, in its JSON, the same on two ranks; selections that are not there refused."""
import os
import tempfile

from bricks import brick_mesh
from program import SOURCE, check, new_folder, run, solve, write

os.environ["ORTHOSTAT_CASES"] = os.path.join(SOURCE, "cases")

# Pulled by 2 over a section of 1 at E = 1000: 0.002 of its length of 4; half the work is 0.5 * 2 * 0.008.
CASE = """title: a bar under tension
mesh: {block: {size: [4, 1, 1], divisions: [8, 2, 2]}}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints:
  - {on: {boundary: xmin}, slide: [1, 0, 0]}
  - {on: {boundary: ymin}, slide: [0, 1, 0]}
  - {on: {boundary: zmin}, slide: [0, 0, 1]}
loads: [{on: {boundary: xmax}, total_force: [2, 0, 0]}]
accuracy: {relative_residual: 1e-10}
watch:
  tip: {displacement: {nearest: [4, 1, 0]}, component: x, expected: 0.01}
  held: {reaction: {boundary: xmin}, component: x}
  work: {strain_energy: all, expected: 0.008}
"""
TRUTH = {"tip": 0.008, "held": -2.0, "work": 0.008}
EXPECTED = {"tip": 0.01, "held": None, "work": 0.008}


def near(found, truth):
    return abs(found - truth) <= 1e-8 * abs(truth)


def is_printed_and_in_json(ranks):
    finished, report, _ = solve(CASE, ranks=ranks)
    check(finished.exit_code == 0, finished.errors)
    check(list(report["watched"]) == list(TRUTH), f"watched: {report['watched']}")
    printed = {line.split()[0]: line.split() for line in finished.output.splitlines() if line.split()}
    for name, truth in TRUTH.items():
        watched = report["watched"][name]
        check(near(watched["value"], truth), f"{name} on {ranks} ranks: {watched}")
        check(watched["expected"] == EXPECTED[name], f"{name}: {watched}")
        check(near(float(printed[name][1].rstrip(",")), truth), f"{name}: printed {printed[name]}")
    check(printed["tip"][-3:] == ["20", "%", "off"], f"the tip is 20 % off: {printed['tip']}")
    check("expected" not in printed["held"], f"nothing was expected of the reaction: {printed['held']}")


def errors_are_stated():
    """A clamped beam is too stiff: the exact tip goes further, its energy is larger; statics alone gives the
    reaction."""
    bent = CASE[:CASE.index("constraints:")] + """constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, 1]}]
large_rotation: off
watch:
  tip: {displacement: {nearest: [4, 0, 0]}, component: z}
  held: {reaction: {boundary: xmin}, component: z}
  length: {reaction: {boundary: xmin}}
  aside: {reaction: {boundary: xmin}, component: y}
  work: strain_energy
"""
    finished, report, _ = solve(bent)
    check(finished.exit_code == 0, finished.errors)
    watched = report["watched"]
    printed = {line.split()[0]: line for line in finished.output.splitlines() if line.split()}
    for name in ("tip", "work"):
        error, value = watched[name]["error"], watched[name]["value"]
        check(0.1 * value < error < value, f"{name}: {watched[name]}")
        check(f"+- {error:.2g} ({100 * error / value:.2g} %)" in printed[name], f"{name}: {printed[name]}")
    check(watched["held"]["error"] == 0 and "statics" in printed["held"], f"held: {watched['held']}, {printed['held']}")
    check(abs(watched["aside"]["value"]) < 1e-12 and printed["aside"].startswith("aside                  0, which statics"), f"{printed['aside']}")
    check(abs(watched["held"]["value"] + 1) < 1e-12, f"held: {watched['held']}")
    check(abs(watched["length"]["value"] - 1) < 1e-12 and "statics" in printed["length"], f"length: {watched['length']}")
    _, report, _ = solve(bent + "output: {fields: [stress]}\n")
    check(all(entry["error"] is None for entry in report["watched"].values()), f"not asked for: {report['watched']}")


def what_has_no_error_is_told_in_words():
    """Under uniform stress linear tets are exact; no support acts on the pulled end."""
    text = CASE + """  loose: {reaction: {boundary: xmax}, component: x}
  turned: {reaction: {boundary: xmax}, about: [0, 0, 0], component: y}
  still: {displacement: {nearest: [0, 0, 0]}, component: x}
"""
    finished, report, _ = solve(text, ranks=2)
    printed = {line.split()[0]: line for line in finished.output.splitlines() if line.split()}
    for name in ("tip", "work", "still"):
        check("exact but for rounding" in printed[name] and "+-" not in printed[name], f"{name}: {printed[name]}")
    for name in ("loose", "turned"):
        check(report["watched"][name]["value"] == 0 and report["watched"][name]["error"] == 0, f"{name}: {report['watched']}")
        check("0, as no support acts there along it" in printed[name], f"{name}: {printed[name]}")
    rough = text.replace("1e-10", "1e-2").replace("[8, 2, 2]", "[16, 4, 4]") + "solver: {method: metric}\n"
    tip = next(line for line in solve(rough)[0].output.splitlines() if line.startswith("tip"))
    check("+-" in tip and "exact" not in tip, f"equations that are not solved: {tip}")


def reactions_balance_the_loads():
    """Statics alone gives these; summed over its nodes, what a solve that stops early leaves of one is a percent off."""
    heavy = """mesh: {block: {size: [8, 1, 1], divisions: [16, 2, 2]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1e7, 4e5, 4e5], poissons_ratio: 0.3, density: 2}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{gravity: [0, 0, -10]}]
solver: {method: metric}
"""
    weight = "{weight: {reaction: {boundary: xmin}, component: z}}"
    _, report, _ = solve(heavy + f"watch: {weight}\n")
    check(abs(report["watched"]["weight"]["value"] - 160) < 1e-5, f"weight: {report['watched']}")
    _, report, _ = solve(heavy + f"cases: [{{name: a}}, {{name: b, watch: {weight}}}, {{name: c}}]\n")
    stopped = [entry["solver"]["stopped"] for entry in report["cases"]]
    check(stopped == [True, True, True], f"which load cases stop early: {stopped}")
    check(abs(report["cases"][1]["watched"]["weight"]["value"] - 160) < 1e-5, f"weight: {report['cases'][1]['watched']}")
    _, report, _ = solve(heavy.replace("constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]",
                                       "springs: [{on: {boundary: xmin}, foundation: 1e7}]") + f"watch: {weight}\n")
    check(report["solver"]["stopped"], "the body on springs does not stop early")
    check(abs(report["watched"]["weight"]["value"] - 160) < 1e-5, f"weight on springs: {report['watched']}")
    edge = heavy + "watch: {edge: {reaction: {box: {min: [-0.1, -0.1, 0.9], max: [0.1, 1.1, 1.1]}}, component: x}}\n"
    early, late = solve(edge)[1], solve(edge + "accuracy: {algebraic_fraction: 0}\n")[1]
    early, late = early["watched"]["edge"]["value"], late["watched"]["edge"]["value"]
    check(abs(early - late) < 2e-5 * abs(late), f"an edge's reaction: {early}, to the residual {late}")


def springs_bear_nothing_where_nodes_are_held():
    """A foundation ends at a clamp: what acts on the edge is the clamp's alone. By finer meshes the foundation bears -0.1141."""
    for order, error in ((1, 0.052), (2, 0.0012)):
        _, report, _ = solve(f"""mesh: {{block: {{size: [2, 1, 1], divisions: [6, 2, 2]}}}}
element: {{order: {order}}}
materials: [{{region: all, youngs_modulus: [1e4, 3e3, 2e3], poissons_ratio: 0.3}}]
large_rotation: off
constraints: [{{on: {{boundary: xmin}}, displacement: [0, 0, 0]}}]
springs: [{{on: {{boundary: zmin}}, foundation: {{normal: 3e3, tangential: 1e2}}}}]
loads: [{{on: {{boundary: xmax}}, traction: [1, 2, 3]}}]
watch: {{below: {{reaction: {{boundary: zmin}}, component: x}}, behind: {{reaction: {{boundary: xmin}}, component: x}}}}
""")
        below, behind = report["watched"]["below"], report["watched"]["behind"]
        check(abs(below["value"] + behind["value"] + 1) < 1e-5, f"order {order}: below and behind are not the load: {report['watched']}")
        check(abs(below["value"] + 0.1141) < error, f"order {order}: the foundation bears {below}")
        check(0.5 < below["error"] / (-0.1141 - below["value"]) < 2.5, f"order {order}: the error stated is {below}")


SLICE = """mesh: {block: {size: [4, 2, 0.5], divisions: [4, 2, 1]}}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3}]
large_rotation: off
constraints:
  - {on: {boundary: xmin}, slide: [1, 0, 0]}
  - {on: {boundary: ymin}, slide: [0, 1, 0]}
  - {on: {boundary: [zmin, zmax]}, displacement: [free, free, 0]}
loads: [{on: {boundary: xmax}, traction: [0.1, 0, 0]}]
accuracy: {relative_residual: 1e-12, out_of_reach: accept}
watch:
  below: {reaction: {boundary: zmin}, component: z}
  both: {reaction: {boundary: [zmin, zmax]}, component: x}
  end: {reaction: {boundary: xmin}, component: x}
"""

# Under a pressure of 1 all around, each of its planes bears its own: -area x normal.
LEANING = """mesh: {file: leaning.msh}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3}]
large_rotation: off
constraints:
  - {on: {boundary: a_xmin}, slide: [-1, 0.5, 0.25]}
  - {on: {boundary: a_ymin}, slide: [0, -1, 0.5]}
  - {on: {boundary: a_zmin}, slide: [0, 0, 1]}
loads: [{on: {boundary: [a_xmax, a_ymax, a_zmax]}, pressure: 1}]
accuracy: {relative_residual: 1e-12, out_of_reach: accept}
watch:
""" + "".join(f"  {side}{axis}: {{reaction: {{boundary: a_{side}min}}, component: {axis}}}\n" for side in "xyz" for axis in "xyz")

# A stiff block moves along x by 1, on beds of 5 and of 20.
ON_BEDS = """mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: 1e9, poissons_ratio: 0.3}]
large_rotation: off
constraints: [{on: {box: {min: [0, 0, 0], max: [1, 1, 1]}}, displacement: [free, 0, 0]}]
springs: [{on: {boundary: xmin}, foundation: {normal: 5, tangential: 1}}, {on: {boundary: zmin}, foundation: {normal: 1, tangential: 20}}]
loads: [{on: {boundary: xmax}, total_force: [25, 0, 0]}]
watch: {behind: {reaction: {boundary: xmin}, component: x}, below: {reaction: {boundary: zmin}, component: x}}
"""

# A foot on four springs: of 8 beside its middle they bear 1, 3, 1 and 3. And that foot on a bed, of which half is watched.
FOOT = """mesh: {block: {size: [2, 2, 1], divisions: [2, 2, 1]}}
large_rotation: off
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints: [{on: {boundary: zmin}, rigid: {at: [1, 1, 0], displacement: [0, 0, free], rotation: [free, free, 0]}}]
springs: [{on: {vertices: [1, 5, 13, 17]}, spring: 50, direction: [0, 0, 1]}]
loads: [{on: {boundary: zmax}, total_force: [0, 0, -8], at: [1.5, 1, 1]}]
watch:
  left: {reaction: {nearest: [0, 0, 0]}, component: z}
  right: {reaction: {nearest: [2, 2, 0]}, component: z}
  tilt: {reaction: {box: {min: [-1, -1, -0.1], max: [3, 1.5, 0.1]}}, component: y, about: [1, 1, 0]}
  whole: {reaction: {boundary: zmin}, component: z}
"""


def each_support_bears_its_own():
    """By balance. Sides between two others that are held, planes that lean, springs beside springs and on a rigid face."""
    folder = new_folder()
    brick_mesh(os.path.join(folder, "leaning.msh"), [("a", (0, 0, 0), (1, 1, 1), (2, 2, 2), "a")],
               lambda x: [x[0] + 0.5 * x[1] + 0.5 * x[2], x[1] + 0.5 * x[2], x[2]])
    planes = {"x": (1, -0.5, -0.25), "y": (0, 1, -0.5), "z": (0, 0, 1)}
    leaning = {side + axis: part for side, of in planes.items() for axis, part in zip("xyz", of)}
    foot = {"left": 1, "right": 3, "tilt": -2, "whole": 8}
    for name, text, ranks, expected in (
            ("a slice", SLICE, 1, {"below": -0.24, "both": 0, "end": -0.1}), ("planes that lean", LEANING, 2, leaning),
            ("beds", ON_BEDS.replace("ORDER", "1"), 1, {"behind": -5, "below": -20}),
            ("beds of quadratic tets", ON_BEDS.replace("ORDER", "2"), 1, {"behind": -5, "below": -20}),
            ("a foot", FOOT, 1, foot), ("a foot, quadratic", FOOT + "element: {order: 2}\n", 2, foot)):
        finished, report, _ = solve(text, folder=folder, ranks=ranks)
        check(finished.exit_code == 0, finished.errors)
        for key, value in expected.items():
            of = report["watched"][key]
            check(abs(of["value"] - value) < 1e-6 and abs(of["error"]) < 1e-6, f"{name}: {key} is {of}, not {value}")
    held = FOOT.replace("free", "0")  # a part of a foot that is held bears the same, with springs that cannot move or without
    parts = [solve(text)[1]["watched"]["tilt"] for text in (held, held.replace(FOOT[FOOT.index("springs"):FOOT.index("loads")], ""))]
    check(abs(parts[0]["value"]) > 0.1 and abs(parts[0]["value"] - parts[1]["value"]) < 1e-9, f"a part of a held foot: {parts}")


def an_energy_is_not_stated_below_zero():
    """Linear tets across stiff fibres, moved: far more energy than there is, and an estimate of its error that is larger still."""
    _, report, _ = solve("""mesh: {block: {size: [4, 1, 0.4], divisions: [4, 2, 1]}}
materials: [{region: all, youngs_modulus: [1, 1e3, 1], poissons_ratio: 0.2, axes: {rotation: {axis: [0, 0, 1], degrees: 30}}}]
large_rotation: off
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, displacement: [free, 0.05, free]}]
watch: {energy: strain_energy}
""")
    energy = report["watched"]["energy"]
    check(report["answer_error"]["energy_norm"] ** 2 > 2 * energy["value"] and energy["error"] is None and
          "too coarse" in energy["error_not_known"], f"{energy}")


def pressure_follows_no_surface_by_linear_theory():
    """A pull of 2 by a pressure that follows: a strain of 10 % would change the area, and the reaction, by 6 %."""
    pulled = (CASE.replace("total_force: [2, 0, 0]", "pressure: -2, follows: true")
              .replace("youngs_modulus: 1000", "youngs_modulus: 20").replace("slide: [1, 0, 0]", "displacement: [0, 0, 0]"))
    _, report, _ = solve(pulled + "large_rotation: off\n")
    check(near(report["watched"]["held"]["value"], -2), f"the reaction is not that of linear theory: {report['watched']}")
    check(near(report["watched"]["held"]["value"], report["checks"]["reaction"][0]), f"two reactions: {report}")


def no_error_without_a_definite_stiffness():
    _, report, _ = solve("""mesh: {tube: {axis: x, length: 3, radii: [0.7, 1], divisions: {around: 8, radial: 1, axial: 4}}}
large_rotation: on
materials: [{region: all, youngs_modulus: [100, 30, 60], poissons_ratio: 0.3}]
constraints: [{on: {boundary: bottom}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: inner}, pressure: 6, follows: true}]
watch: {energy: strain_energy}
""")
    check(report["answer_error"] is None and "not positive definite" in report["watched"]["energy"]["error_not_known"] and
          any("set element: {order: 2}" in one for one in report["warnings"] if "not known" in one), f"{report}")


def reactions_of_a_nearly_incompressible_body_balance_its_loads():
    """In a mixed form, part of the forces is the pressures'; a moment at the deformed body has other arms."""
    muscle = """mesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1000, 300, 200], poissons_ratio: 0.49, density: 1}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [3, 0, -1]}, {gravity: [0, 0, -1]}]
watch:
  along: {reaction: {boundary: xmin}, component: x}
  down: {reaction: {boundary: xmin}, component: z}
  moment: {reaction: {boundary: xmin}, component: y, about: [0, 0.5, 0.5]}
"""
    for rotation, loads in ("off", {"along": -3, "down": 5, "moment": -12}), ("on", {"along": -3, "down": 5}):
        finished, report, _ = solve(f"{muscle}large_rotation: {rotation}\n")
        check(finished.exit_code == 0, finished.errors)
        for name, value in loads.items():
            check(abs(report["watched"][name]["value"] - value) < 1e-6, f"{rotation}, {name}: {report['watched'][name]}, not {value}")


def linear_theory_may_be_off_by_all_of_a_small_component():
    """The elastica with P L^2 = 0.3 E I: the end comes 0.059 nearer, of which linear theory knows nothing."""
    strip = """mesh: {block: {size: [10, 1, 0.2], divisions: [30, 1, 2]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, -2]}]
watch:
  nearer: {displacement: {nearest: [10, 0, 0.1]}, component: x}
  lower: {displacement: {nearest: [10, 0, 0.1]}, component: z}
  free: {reaction: {boundary: zmax}, component: x}
"""
    finished, report, _ = solve(strip)
    check("'free' is" not in finished.errors and report["watched"]["free"]["value"] == 0, finished.errors)
    check("'nearer' is" in finished.errors and "large_rotation: on" in finished.errors, finished.errors)
    check("'lower' is" not in finished.errors and any("'nearer' is" in w for w in report["warnings"]), report["warnings"])
    finished, report, _ = solve(strip + "large_rotation: on\n")
    check(not finished.errors, finished.errors)
    watched = report["watched"]
    check(abs(watched["nearer"]["value"] / -0.05899 - 1) < 0.01 and abs(watched["lower"]["value"] / -0.9899 - 1) < 0.003,
          f"the elastica: {watched}")


def means_are_by_the_true_volume_of_curved_tets():
    """Of a quarter tube under inner pressure p, u = (x, 0, 0) as virtual displacement gives the mean of the stress xx,
    exactly and on any mesh: p times the hole's area over the body's."""
    _, report, _ = solve("""mesh: {sector: {axis: z, length: 1, radii: [1, 2], angle: 90, divisions: {around: 1, radial: 1, axial: 1}}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints:
  - {on: {boundary: start}, slide: [1, 0, 0]}
  - {on: {boundary: finish}, slide: [0, 1, 0]}
  - {on: {boundary: bottom}, slide: [0, 0, 1]}
loads: [{on: {boundary: inner}, pressure: 3}]
accuracy: {relative_residual: 1e-12, out_of_reach: accept}
watch: {mean: {stress: {region: all}, component: xx}}
""")
    check(near(report["watched"]["mean"]["value"], 1.0), f"the mean stress is not 1: {report['watched']}")


def means_are_along_the_axes_as_they_vary_in_tets():
    """Of a turning disc of few tets: by an adjoint problem, by e alone, and where rotations are large. Along each tet's
    own axes all three were 0.32 % off, and 0.01 to 0.07 % was stated."""
    disc = """mesh: {sector: {axis: z, length: 0.4, radii: [0.5, 2], angle: 90, divisions: {around: 4, radial: 4, axial: 1}}}
element: {order: 2}
materials:
  - region: all
    youngs_modulus: %s
    poissons_ratio: 0.3
    density: 1
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}
constraints:
  - {on: {boundary: start}, slide: [1, 0, 0]}
  - {on: {boundary: finish}, slide: [0, 1, 0]}
  - {on: {boundary: bottom}, slide: [0, 0, 1]}
loads: [{centrifugal: {axis: [0, 0, 1], angular_velocity: 2}}]
large_rotation: %s
watch: {mean: {stress: {region: all}, component: "22"}}
"""
    for moduli, rotation in ("[1e5, 1e3, 1e4]", "off"), ("[1e4, 1e3, 2e3]", "off"), ("[1e7, 1e6, 2e6]", "on"):
        coarse, fine = (solve(disc % (moduli, rotation), extra=("--set", f"mesh.refine={k}"))[1]["watched"]["mean"] for k in (0, 1))
        true = fine["value"] + fine["error"] - coarse["value"]
        check(abs(true) < 3e-4 * fine["value"] and 0.25 < coarse["error"] / true < 2.5, f"{moduli}: {true} missing, of {coarse}")


MOVED = """mesh: {block: {size: [8, 1, 1], divisions: [8, 1, 1]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1e3, 1e3, 1e6], poissons_ratio: 0.3, density: 1, axes: {rotation: {axis: [0, 1, 0], degrees: 30}}}]
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
  - {on: {boundary: xmax}, displacement: [0, 0, 0.5]}
large_rotation: off
accuracy: {algebraic_fraction: 0}
watch: {energy: strain_energy}
"""


def a_load_that_does_no_work_changes_no_error():
    without, tiny, large = (solve(MOVED + f"loads: [{{gravity: [0, 0, {g}]}}]\n" * (g != 0))[1] for g in (0, -1e-9, -1))
    for key in "relative", "energy_norm":
        a, b = without["answer_error"][key], tiny["answer_error"][key]
        check(abs(a - b) < 1e-5 * a, f"{key}: {a} without a load, {b} with next to none")
    a, b, c = (one["watched"]["energy"] for one in (without, tiny, large))
    check(b["error"] < 0 and abs(a["error"] - b["error"]) < 1e-5 * abs(a["error"]), f"energies: {a}, {b}")
    check(c["error"] is None and "both loads and" in c["error_not_known"], f"{c}")


def an_error_leaves_some_of_the_energy():
    """Of linear tets that bend: by a moved coupling; by a moved end, of which the estimate leaves nothing."""
    linear = MOVED.replace("order: 2", "order: 1")
    moved = solve(linear.replace("  - {on: {boundary: xmax}, displacement: [0, 0, 0.5]}",
                                 "loads: [{on: {boundary: xmax}, distributing: {at: [9, 0.5, 0.5], displacement: [free, free, 0.05]}}]"))[1]
    energy = moved["watched"]["energy"]
    check(-1 < energy["error"] / energy["value"] < -0.8, f"{energy}")
    held = solve(linear)[1]
    energy = held["watched"]["energy"]
    check(held["answer_error"]["relative"] <= 1, f"{held['answer_error']}")
    check(energy["error"] is None and "too coarse" in energy["error_not_known"] or energy["value"] + energy["error"] > 0, f"{energy}")


def load_cases_have_the_errors_of_single_runs():
    text = CASE.replace("watch:", "element: {order: 2}\nwatch:\n  stress: {stress: {at: [1.3, 0.4, 0.6]}, component: xx}") + """cases:
  - {name: first}
  - {name: second, loads: [{on: {boundary: zmax}, total_force: [1, 2, 3]}]}
  - {name: third, loads: [{on: {boundary: xmax}, total_force: [0, 3, 1]}]}
"""
    text = text.replace("slide: [1, 0, 0]", "displacement: [0, 0, 0]")
    of_all = {one["load_case"]: one for one in solve(text)[1]["cases"]}
    for name in "second", "third":
        single, together = solve(text, extra=("--case", name))[1], of_all[name]
        for key, watched in together["watched"].items():
            alone = single["watched"][key]["error"]
            check(abs(watched["error"] - alone) <= 1e-6 * abs(alone), f"{name}, {key}: {watched['error']}, alone {alone}")


def load_factors_are_those_of_the_summary():
    """The bar, pulled by 2 over a section of 1, of a material that tears at 5; half of it of one without strengths."""
    strong = CASE[:CASE.index("watch:")].replace("0.3}]", "0.3, strengths: {tension: 5, compression: 8}}]") + """watch:
  tsai_wu: {load_factor: {region: all}, criterion: tsai_wu}
  hill: {load_factor: {region: all}, criterion: hill}
  maximum_stress: {load_factor: {region: all}, criterion: maximum_stress}
  breaks: {load_factor: {region: all}}
"""
    for ranks in (1, 2):
        finished, report, _ = solve(strong.replace("[2, 0, 0]", "[0, 0.2, 0]"), ranks=ranks)
        check(finished.exit_code == 0, finished.errors)
        watched = report["watched"]
        for criterion, least in report["strength"].items():
            check(near(watched[criterion]["value"], least["load_factor"]), f"{criterion}: {watched[criterion]}, {least}")
            check(watched[criterion]["place"] == least["place"], f"{criterion}: {watched[criterion]}, {least}")
        check(near(watched["breaks"]["value"], min(watched[name]["value"] for name in report["strength"])), f"{watched}")
        check(watched["breaks"]["error"] < 0, f"a finer mesh has larger stresses: {watched['breaks']}")
    finished, report, _ = solve(strong + "large_rotation: off\noutput: {fields: [displacement]}\n")
    check(all(near(one["value"], 2.5) for one in report["watched"].values()), f"5 over 2: {report['watched']}")
    finished, report, _ = solve(strong.replace("[2, 0, 0]", "[0, 0, 0]"))
    check("inf, as nothing fails there" in finished.output and report["watched"]["breaks"]["value"] is None, finished.output)
    refused("no strengths", CASE + "  breaks: {load_factor: {region: all}}\n",
            ["case.yaml:14", "'breaks' is a load factor to failure of the body, of which no material has 'strengths'"])
    refused("no region", strong + "  one: {load_factor: {region: wod}}\n", ["no region 'wod'"])
    refused("a criterion", strong + "  one: {load_factor: {region: all}, criterion: tsai}\n", ["tsai_wu"])
    refused("a component", strong + "  one: {load_factor: {region: all}, component: x}\n", ["it may have a 'criterion'"])
    refused("a criterion of a stress", strong + "  one: {stress: {region: all}, component: xx, criterion: hill}\n", ["'criterion' belongs to a load factor"])
    refused("an accuracy", strong.replace("relative_residual: 1e-10", "relative_error: 0.01, of: breaks"), ["'breaks' is a load factor, for whose error"])


def nothing_watched_is_nothing_in_json():
    _, report, _ = solve(CASE[:CASE.index("watch:")])
    check(report["watched"] == {}, f"nothing is watched: {report['watched']}")


def refused(name, text, words):
    folder = tempfile.mkdtemp(prefix="orthostat-")
    write(folder, "case.yaml", text)
    for command in ("check", "solve"):
        finished = run(command, "case.yaml", folder=folder)
        check(finished.exit_code == 2, f"{name}: {command} exits {finished.exit_code}: {finished.output}")
        for word in words:
            check(word in finished.errors, f"{name}: {command} does not say '{word}': {finished.errors}")
        check(os.listdir(folder) == ["case.yaml"], f"{name}: {command} wrote {os.listdir(folder)}")


def verify_section(boundary):
    return CASE + f"""verify:
  formula: uniform_stress
  source: Hooke's law
  parameters: {{xx: 2, yy: 0, zz: 0, xy: 0, yz: 0, zx: 0}}
  ladder: [{{order: 1, refinements: [0], quick: 1}}]
  quantities:
    end: {{displacement: [1, 0, 0], on: {{boundary: {boundary}}}, expected: 0.008, error: [1e-8], rate: [exact]}}
"""


def main():
    for ranks in (1, 2):
        is_printed_and_in_json(ranks)
    errors_are_stated()
    what_has_no_error_is_told_in_words()
    reactions_balance_the_loads()
    each_support_bears_its_own()
    springs_bear_nothing_where_nodes_are_held()
    no_error_without_a_definite_stiffness()
    an_energy_is_not_stated_below_zero()
    pressure_follows_no_surface_by_linear_theory()
    reactions_of_a_nearly_incompressible_body_balance_its_loads()
    linear_theory_may_be_off_by_all_of_a_small_component()
    means_are_by_the_true_volume_of_curved_tets()
    means_are_along_the_axes_as_they_vary_in_tets()
    a_load_that_does_no_work_changes_no_error()
    an_error_leaves_some_of_the_energy()
    load_cases_have_the_errors_of_single_runs()
    load_factors_are_those_of_the_summary()
    nothing_watched_is_nothing_in_json()
    refused("a watched boundary", CASE.replace("{reaction: {boundary: xmin}", "{reaction: {boundary: xmim}"),
            ["case.yaml:", "no boundary 'xmim'", "did you mean 'xmin'?"])
    refused("a watch of nothing", CASE[:CASE.index("watch:")] + "watch: {}\n", ["case.yaml:10", "watch"])
    refused("a verified boundary", verify_section("xmxa"), ["case.yaml:", "no boundary 'xmxa'", "'xmax'"])

    finished = run("verify", "nosuch")
    there = [file[:-5] for file in os.listdir(os.path.join(os.environ["ORTHOSTAT_CASES"], "verify")) if file.endswith(".yaml")]
    check(finished.exit_code == 2, f"verify nosuch: exit {finished.exit_code}")
    check("'nosuch'" in finished.errors and all(name in finished.errors.replace(",", "").split() for name in there), f"verify nosuch: {finished.errors}")


main()
