"""A distributing coupling whose point is moved: forces and moments by the formulas of bars, the same on several ranks, in load cases and
beside other loads; what is refused."""
import json
import os

from program import check, fewer, new_folder, run

BAR = """mesh: {block: {size: [10, 1, 1], divisions: [10, 2, 2]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
watch:
  pull: {reaction: {boundary: xmax}, component: x}
  force: {reaction: {boundary: xmax}, component: z}
  held: {reaction: {boundary: xmin}, component: z}
  torque: {reaction: {boundary: xmax}, about: [10, 0.5, 0.5], component: x}
  moment: {reaction: {boundary: xmax}, about: [10, 0.5, 0.5], component: y}
output: {file: bar.vtkhdf}
"""
CASES = """cases:
  - name: pulled
    loads: [{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], displacement: [0.02, free, free]}}]
  - name: bent
    loads: [{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], displacement: [free, free, 0.1]}}]
  - name: turned
    loads: [{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], rotation: [free, -0.05, free]}}]
  - name: guided
    loads:
      - {on: {boundary: xmax}, total_force: [0, 0, 0.01]}
      - {on: {boundary: xmax}, distributing: {at: [12, 0.5, 0.5], displacement: [free, free, 0], rotation: [free, 0, free]}}
"""
BENDING = 1000 / 12.0
SHEAR = 3 * BENDING / (5 / 6 * 500 * 100)  # of Timoshenko's beam, beside its bending
EXPECTED = {"pulled": {"pull": 2.0, "force": 0.0},
            "bent": {"force": 3 * BENDING * 0.1 / 1000 / (1 + SHEAR), "held": -3 * BENDING * 0.1 / 1000 / (1 + SHEAR), "moment": 0.0},
            "turned": {"moment": -BENDING * 0.05 / 10, "force": 0.0},
            "guided": {"force": -0.01, "held": 0.0, "moment": 0.0}}  # the coupling takes the whole load


def write(text):
    folder = new_folder()
    with open(os.path.join(folder, "bar.yaml"), "w") as stream:
        stream.write(text)
    return folder


folder = write(BAR + CASES)
answers = []
for ranks in fewer((1, 2, 4)):
    finished = run("solve", "bar.yaml", "-q", "--json", "bar.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    with open(os.path.join(folder, "bar.json")) as stream:
        report = json.load(stream)
    answers.append({one["load_case"]: {key: value["value"] for key, value in one["watched"].items()} for one in report["cases"]})
    for name, expected in EXPECTED.items():
        for key, value in expected.items():
            found = answers[-1][name][key]
            check(abs(found - value) <= 0.003 * abs(value) + 1e-7, f"{name}, {key} on {ranks} ranks: {found}, expected {value}")
            check(abs(found - answers[0][name][key]) <= 1e-7, f"{name}, {key}: {found} on {ranks} ranks")

# one case alone, and the mean of the answer: the end of a bar of nu = 0 that is pulled stays flat
alone = run("solve", "bar.yaml", "--case", "pulled", "-q", "--json", "-", "--set",
            "watch.end={displacement: {nearest: [10, 0, 1]}, component: x}", folder=folder)
check(alone.exit_code == 0, alone.errors)
check(abs(json.loads(alone.output)["watched"]["end"]["value"] - 0.02) <= 1e-8, alone.output)
check(json.loads(alone.output)["answer_error"]["displacement"] is None and json.loads(alone.output)["answer_error"]["relative"] < 1e-9, alone.output)

# by multigrid: on the linear tets with the same vertices, as without a coupling
for load in fewer(("total_force: [0, 0, 0.02]", "distributing: {at: [10, 0.5, 0.5], displacement: [free, free, 0.1]}")):
    text = BAR.replace("[10, 2, 2]", "[20, 4, 4]") + f"loads: [{{on: {{boundary: xmax}}, {load}}}]\nsolver: {{method: metric}}\n"
    by_ranks = []
    for ranks in fewer((1, 2, 4)):
        finished = run("solve", "bar.yaml", "-q", "--json", "-", ranks=ranks, folder=write(text))
        check(finished.exit_code == 0, finished.errors)
        report = json.loads(finished.output)
        on = [effect["effect"] for effect in report["effects"] if effect["on"]]
        check("linear space" in on and ("moved coupling" in on) == ("distributing" in load), f"{load}: {on}")
        check(report["solver"]["iterations"] <= 14, f"{load} on {ranks} ranks: {report['solver']['iterations']} iterations")
        by_ranks.append(report["watched"]["held"]["value"])
    check(max(by_ranks) - min(by_ranks) <= 1e-7, f"{load}: {by_ranks}")

# nu = 1/2, beside a pressure and an end that is given: the force that is found does as much as a load
BESIDE = "{on: {boundary: zmax}, pressure: 0.1}]\n"
text = BAR.replace("ratio: 0}", "ratio: 0.5}").replace("[10, 2, 2]", "[5, 1, 1]").replace("[0, 0, 0]}]", "[0.001, 0, 0]}]") \
    + "large_rotation: off\nsolver: {method: metric}\naccuracy: {relative_residual: 1e-11}\n"
text = text.replace("output:", "  middle: {displacement: {nearest: [6, 1, 1]}, component: z}\n  energy: strain_energy\noutput:")


def values_of(load):
    finished = run("solve", "bar.yaml", "-q", "--json", "-", folder=write(text + f"loads: [{load}, {BESIDE}"))
    check(finished.exit_code == 0, finished.errors)
    return {key: value["value"] for key, value in json.loads(finished.output)["watched"].items()}


moved = values_of("{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], displacement: [free, free, 0.1]}}")
loaded = values_of(f"{{on: {{boundary: xmax}}, total_force: [0, 0, {moved['force']!r}], at: [10, 0.5, 0.5]}}")
for key in "middle", "energy":
    check(abs(moved[key] - loaded[key]) <= 1e-7 * abs(loaded[key]), f"{key} of a moved end: {moved[key]}, of a loaded one {loaded[key]}")

# With large rotations: the moment of a circle's arc; force and moment are the energy's derivatives by the motion of their point.
BENT = {"less": ("rotation: [0, -1.99, free]", 1.99), "more": ("rotation: [0, -2.01, free]", 2.01),
        "low": ("displacement: [free, free, 2.98]", 0.0), "high": ("displacement: [free, free, 3.02]", 0.0)}
PAIRS = fewer((("low", "high", 0.04, "force"), ("less", "more", 0.02, "moment")))
BENT = {name: BENT[name] for pair in PAIRS for name in pair[:2]}
text = BAR.replace("[10, 2, 2]", "[6, 1, 1]").replace("output:", "  energy: strain_energy\noutput:") + "large_rotation: on\ncases:\n" + "".join(
    f"  - {{name: {name}, loads: [{{on: {{boundary: xmax}}, distributing: {{at: [11, 0.5, 0.5], {motion}}}}}]}}\n" for name, (motion, _) in BENT.items())
finished = run("solve", "bar.yaml", "-q", "--json", "-", ranks=2, folder=write(text))
check(finished.exit_code == 0, finished.errors)
found = {one["load_case"]: one for one in json.loads(finished.output)["cases"]}
values = {name: {key: value["value"] for key, value in one["watched"].items()} for name, one in found.items()}
moments = {name: -one["moment"] for name, one in values.items()}
for name, (_, angle) in BENT.items():
    check(abs(moments[name] / (BENDING * angle / 10) - 1) <= 0.01 if angle else True, f"{name}: {values[name]}")
    search = found[name]["large_rotation"]
    check(search["newton_iterations"] <= 20 and not search["stability_unknown"], f"{search}")
    check(search["linear_iterations"] <= 14 * search["newton_iterations"], f"{search}: 9 sums and a residual take 10 solves by factors")
does = {"moment": moments, "force": {name: one["force"] for name, one in values.items()}}
for a, b, step, kind in PAIRS:
    rate, mean = (values[b]["energy"] - values[a]["energy"]) / step, (does[kind][a] + does[kind][b]) / 2
    check(abs(rate / mean - 1) <= 1e-4, f"{a} and {b}: by the energy {rate}, by its {kind} {mean}")

MOVED = "loads: [{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], displacement: [0.02, free, free]}}]\n"
for text, words in ((MOVED.replace("displacement: [0.02, free, free]", "displacement: [free, free, free]"), "no component"),
                    (MOVED.replace("xmax", "xmin"), "given already"),
                    (MOVED.replace("}}]", "}}, {on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], displacement: [0.03, free, free]}}]"),
                     "given already")):
    refused = run("solve", "bar.yaml", "-q", folder=write(BAR + text))
    check(refused.exit_code == 2 and words in refused.errors, f"{words}: {refused.exit_code}, {refused.errors}")
LINE = MOVED.replace("boundary: xmax", "box: {min: [10, 0, 0], max: [10, 0, 1]}")
for text, words in (LINE.replace("at: [10, 0.5,", "at: [10, 0,"), ""), (LINE.replace("at: [10, 0.5, 0.5]", "at: [10, 0, 5]"), "lies on one line"):
    line = run("solve", "bar.yaml", "-q", folder=write(BAR.replace("[10, 2, 2]", "[2, 1, 1]") + text + "large_rotation: on\n"))
    check(line.exit_code == (2 if words else 0) and words in line.errors, f"{words}: {line.exit_code}, {line.errors}")
buckled = run("solve", "bar.yaml", "-q", folder=write(BAR.replace("[10, 2, 2]", "[6, 1, 1]") + MOVED.replace("0.02", "-0.5") + "large_rotation: on\n"))
check(buckled.exit_code == 1 and "make the face 'rigid'" in buckled.errors, f"{buckled.exit_code}, {buckled.errors}")
