# SPDX-License-Identifier: BSD-3-Clause
"""`accuracy: {relative_error}`: `orthostat solve` refines until the answer is as accurate as that, and says what it takes
where it may not."""
import json
import os

from program import SANITIZED, check, new_folder, run

CASE = """title: a clamped beam
mesh: {{block: {{size: [3, 1, 1], divisions: [3, 1, 1]}}}}
materials: [{{region: all, youngs_modulus: [1e6, 1e5, 1e5], poissons_ratio: 0.3}}]
constraints: [{{on: {{boundary: xmin}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{boundary: xmax}}, traction: [0, 0, 100]}}]
large_rotation: off
watch: {{tip: {{displacement: {{nearest: [3, 0, 0]}}, component: z}}}}
{accuracy}
"""
folder = new_folder()


def solve(accuracy, *options, ranks=1):
    with open(os.path.join(folder, "beam.yaml"), "w", encoding="utf-8") as stream:
        stream.write(CASE.format(accuracy=accuracy))
    done = run("solve", "beam.yaml", "--json", "beam.json", *options, ranks=ranks, folder=folder)
    path = os.path.join(folder, "beam.json")
    if not os.path.exists(path):
        return done, None
    with open(path, encoding="utf-8") as stream:
        return done, json.load(stream)


done, as_given = solve("")
check(done.exit_code == 0, done.errors)
check("adaption" not in as_given and as_given["tets"] == 18, "without the key the mesh stays as it is")

done, report = solve("accuracy: {relative_error: 0.1}")
check(done.exit_code == 0, done.errors)
adaption = report["adaption"]
levels = adaption["levels"]
check(adaption["met"] and adaption["end"] == "met" and adaption["asked"] == 0.1, f"met: {adaption}")
check(levels[0]["order"] == 1 and levels[-1]["order"] == 2, "from linear tets to quadratic ones")


def is_enough(level):
    return level["relative_error"] <= (0.075 if level["missed"] is None else 0.09)


check(is_enough(levels[-1]) and not is_enough(levels[-2]), f"no level too many: {levels}")
check(levels[1]["missed"] is None and levels[-1]["missed"] >= 1, "the estimate is measured from two levels of quadratic tets on")
check(levels[-1]["tets"] == report["tets"] and levels[-1]["unknowns"] == report["unknowns"], "the result is the last level")
check("10 % asked for" in done.output and str(levels[-1]["unknowns"]) in done.output, done.output)
check(os.path.getsize(os.path.join(folder, "beam.vtkhdf")) > 0, "a file of the last mesh")

_, parallel = solve("accuracy: {relative_error: 0.1}", ranks=3)
check([level["tets"] for level in parallel["adaption"]["levels"]] == [level["tets"] for level in levels],
      "the same meshes on 3 ranks")
check(abs(parallel["watched"]["tip"]["value"] / report["watched"]["tip"]["value"] - 1) < 1e-3, "the same tip on 3 ranks")

done, report = solve("accuracy: {relative_error: 0.001}", "--max-memory", "0.005")
adaption = report["adaption"]
check(done.exit_code == 1 and "--max-memory" in done.errors and "not met" in done.errors, f"what is missing: {done.errors}")
check(not adaption["met"] and adaption["end"] == "out of memory", f"the end: {adaption}")
check(adaption["needed_unknowns"] > report["unknowns"] and adaption["needed_bytes"] > 0.005 * 2**30, "what it would take")
check(report["accepted"], "the answer is one, though not as accurate")

done, _ = solve("accuracy: {relative_error: 0.1}", "--max-time", "soon")
check(done.exit_code == 2 and "found 'soon'" in done.errors, done.errors)

if SANITIZED:  # what follows is about numbers alone
    raise SystemExit(0)

# Where only supports move the body the answer has more energy than the exact one, by that of its error.
BAR = """title: a bar whose end is moved
mesh: {{block: {{size: [6, 1, 1], divisions: {divisions}}}}}
element: {{order: {order}}}
materials: [{{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}}]
constraints:
  - {{on: {{boundary: xmin}}, displacement: [0, 0, 0]}}
  - {{on: {{boundary: xmax}}, displacement: [0, 0.01, 0]}}
large_rotation: off
"""


def bend(divisions, order):
    with open(os.path.join(folder, "bar.yaml"), "w", encoding="utf-8") as stream:
        stream.write(BAR.format(divisions=divisions, order=order))
    check(run("solve", "bar.yaml", "--json", "bar.json", folder=folder).exit_code == 0, "solved")
    with open(os.path.join(folder, "bar.json"), encoding="utf-8") as stream:
        found = json.load(stream)
    return found["checks"]["strain_energy"], found["answer_error"]["relative"]


energy, off = bend([18, 3, 3], 2)
exact = energy * (1 - off**2)
for divisions in ([9, 2, 2], [18, 3, 3]):
    energy, off = bend(divisions, 1)
    true = (energy / exact - 1) ** 0.5
    check(0.9 < off / true < 1.1, f"{divisions}: {off} estimated, {true} true")

# A beam that bends by 90 degrees: on the last mesh alone Newton's method takes 2 load steps and 8 iterations.
with open(os.path.join(folder, "bent.yaml"), "w", encoding="utf-8") as stream:
    stream.write("""mesh: {block: {size: [8, 1, 1], divisions: [8, 1, 1]}}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, traction: [0, 0, 4000]}]
large_rotation: on
accuracy: {relative_error: 0.05}
""")
done = run("solve", "bent.yaml", "--json", "bent.json", folder=folder)
check(done.exit_code == 0, done.errors)
with open(os.path.join(folder, "bent.json"), encoding="utf-8") as stream:
    turned = json.load(stream)["large_rotation"]
check(turned["newton"] and turned["load_steps"] == 1 and turned["newton_iterations"] <= 4, f"from the coarser pose: {turned}")

# Loads alone act, so the energy that is missing is half the squared error. The exact ones are those of meshes refined for
# 0.5 % (2,222,079 unknowns), 2 % (390,093) and 1.2 % (1,774,755), with what these miss.
CLAMPED = """title: a block clamped below, whose edges are singular
mesh: {block: {size: [2.74, 2.46, 1.46], divisions: [2, 1, 3]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0}]
constraints: [{on: {boundary: zmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, traction: [-0.79, -0.71, -0.85]}]
large_rotation: off
"""
CROSSED = """title: linear tets that stiff directions cross
mesh: {block: {size: [9.42, 1, 1.3], divisions: [4, 2, 1]}}
materials:
  - {region: all, youngs_modulus: [1e6, 1e8, 1e6], poissons_ratio: 0.3,
     axes: {rotation: {axis: [0.58, -0.81, 1], degrees: 12}}}
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: zmax}, traction: [-0.13, 0.52, -1]}]
large_rotation: off
"""
PLATE = """title: a plate of one layer of tets that bends
mesh: {block: {size: [11.3, 11.53, 1], divisions: [6, 3, 1]}}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]
constraints: [{on: {boundary: ymin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: zmax}, traction: [-0.06, -0.7, -0.13]}]
large_rotation: off
"""
for case, exact, refinements, least in (
    (CLAMPED, 5.155362315e-6 * (1 + 0.0036**2), (0, 1), 0.9),  # 0.75 and 0.82 without what higher orders would find
    (CROSSED, 0.01429880978 * (1 + 0.015**2), (2,), 0.7),  # 0.58 by three steps of the search for the error
    (PLATE, 0.003673797389 * (1 + 0.0085**2), (0, 1), 0.8),  # 0.48 and 0.63 by three
):
    with open(os.path.join(folder, "block.yaml"), "w", encoding="utf-8") as stream:
        stream.write(case)
    for refinement in refinements:
        done = run("solve", "block.yaml", "--json", "block.json", "--set", f"mesh.refine={refinement}", folder=folder)
        check(done.exit_code == 0, done.errors)
        with open(os.path.join(folder, "block.json"), encoding="utf-8") as stream:
            found = json.load(stream)
        true = (1 - found["checks"]["strain_energy"] / exact) ** 0.5
        quotient = found["answer_error"]["relative"] / true
        check(least < quotient < 1.1, f"refined {refinement} times: {quotient} of {true}")
