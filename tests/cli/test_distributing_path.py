"""A distributing coupling that is moved along a path: the moment and energy of the circle's arc at each pose, the answer without a path at
the end, the same on several ranks and after a restart; a motion with a time table beside another load, by linear theory and with large
rotations."""
import csv
import json
import math
import os

from program import check, fewer, new_folder, run, write

STRIP = """mesh: {block: {size: [10, 1, 1], divisions: [6, 1, 1]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
watch:
  held: {reaction: {boundary: xmin}, about: [0, 0.5, 0.5], component: y}
  moment: {reaction: {boundary: xmax}, about: [10, 0.5, 0.5], component: y}
  force: {reaction: {boundary: xmax}, component: z}
  energy: strain_energy
  end: {displacement: {nearest: [10, 0, 0]}, component: x}
output: {file: strip.vtkhdf}
"""
COUPLING = "{on: {boundary: xmax}, distributing: {at: [10, 0.5, 0.5], %s}%s}"
STIFFNESS = 1000 / 12 / 10  # E I / L


def solve(text, ranks=1):
    """The watched values of each step, or of the one answer; and the folder."""
    folder = new_folder()
    write(folder, "strip.yaml", STRIP + text)
    finished = run("solve", "strip.yaml", "-q", "--json", "strip.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    with open(os.path.join(folder, "strip.json")) as stream:
        report = json.load(stream)
    steps = [step["watched"] for step in report.get("steps", [])]
    return steps or [{name: value["value"] for name, value in report["watched"].items()}], folder


def differ(a, b, digits):
    return {name: (a[name], b[name]) for name in a if abs(a[name] - b[name]) > digits * max(abs(a[name]), 1.0)}


# --- poses: a half circle, and its moment, force and energy at each of them ---
HALF = f"large_rotation: on\nloads: [{COUPLING % (f'rotation: [0, {-math.pi!r}, 0]', '')}]\n"
POSES = HALF + "path: {times: [0.25, 0.6, 1]}\n"
steps, folder = solve(POSES)
for t, step in zip((0.25, 0.6, 1), steps):
    moment = STIFFNESS * math.pi * t
    check(abs(step["moment"] / -moment - 1) <= 0.01 and abs(step["held"] / moment - 1) <= 0.01, f"{t}: {step}")
    check(abs(step["energy"] / (moment * math.pi * t / 2) - 1) <= 0.01 and abs(step["force"]) <= 1e-6 * moment, f"{t}: {step}")
alone, _ = solve(HALF)
check(not differ(steps[-1], alone[0], 1e-7), f"at the end of the path, and without: {differ(steps[-1], alone[0], 1e-7)}")
for ranks in fewer((3,)):
    other, _ = solve(POSES, ranks)
    check(not any(differ(a, b, 1e-7) for a, b in zip(steps, other)), f"on {ranks} ranks: {other}, on one: {steps}")


def history(folder):
    with open(os.path.join(folder, "strip_history.csv")) as stream:
        return stream.read()


truth = history(folder)  # a path that is done takes its last step again, from the checkpoint of the one before
again = run("solve", "strip.yaml", "--resume", folder=folder)
check(again.exit_code == 0 and "2 of 3 steps are done" in again.errors, again.errors)
check(history(folder) == truth, f"resumed: {history(folder)}, expected {truth}")
check(len(list(csv.DictReader(truth.splitlines()))) == 3, truth)

# --- a rotation given in part, there and back, beside a force; with large rotations and by linear theory ---
FORCE = "{on: {boundary: xmax}, total_force: [0, 0.02, 0]}"
for theory, angle in fewer((("off", -0.05), ("on", -1.5))):
    def case(given, table, path):
        return f"large_rotation: {theory}\nloads: [{FORCE}, {COUPLING % (f'rotation: [free, {given!r}, free]', table)}]\n{path}"
    there, folder = solve(case(angle, ", time: [[0, 0], [0.5, 1], [1, 0]]", "path: {times: [0.5, 1]}\n"), fewer((1, 2))[-1])
    half = case(angle, "", "").replace("0.02", "0.01")
    for step, single in (there[0], half), (there[1], case(0, "", "")):
        expected, _ = solve(single)
        check(not differ(step, expected[0], 1e-6), f"large_rotation {theory}: {differ(step, expected[0], 1e-6)}")

# --- where factors of the stiffness do not fit, GMRES finds the same, and the program says that it does not know whether that is stable ---
folder = new_folder()
write(folder, "strip.yaml", STRIP + HALF + "solver: {factor_memory: 0}\n")
finished = run("solve", "strip.yaml", "-q", "--json", "-", folder=folder)
check(finished.exit_code == 0, finished.errors)
report = json.loads(finished.output)
check(report["large_rotation"]["stability_unknown"] and abs(report["watched"]["moment"]["value"] / steps[-1]["moment"] - 1) < 1e-7, report["watched"])

# --- the estimated error of a strip whose end a coupling turns falls as the mesh is refined: the estimate knows the coupling's forces ---
relative = []
for cells in fewer((6, 12)):
    folder = new_folder()
    write(folder, "strip.yaml", STRIP.replace("[6, 1, 1]", f"[{cells}, 1, 1]") + HALF)
    finished = run("solve", "strip.yaml", "-q", "--json", "-", folder=folder)
    check(finished.exit_code == 0, finished.errors)
    relative.append(json.loads(finished.output)["answer_error"]["relative"])
check(relative[-1] <= 0.4 * relative[0] or len(relative) == 1, f"estimated errors with 6 and 12 cells: {relative}")
