"""A body whose only support turns far: one without loads turns with it in an iteration a load step, and one under a force is as strained as
where the force turns back instead."""
import json
import math
import os

from program import check, fewer, new_folder, run, write

STRIP = """mesh: {block: {size: [10, 1, 1], divisions: [4, 1, 1]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, rigid: {at: [0, 0.5, 0.5], displacement: [0, 0, 0], rotation: [0, %r, 0]}}]
large_rotation: on
watch:
  energy: strain_energy
  x: {displacement: {nearest: [10, 0, 0]}, component: x}
  z: {displacement: {nearest: [10, 0, 0]}, component: z}
output: {file: strip.vtkhdf}
"""
FORCE = "loads: [{on: {boundary: xmax}, total_force: [%r, 0, %r]}]\n"


def solve(text, ranks=1):
    folder = new_folder()
    write(folder, "strip.yaml", text)
    finished = run("solve", "strip.yaml", "-q", "--json", "strip.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    with open(os.path.join(folder, "strip.json")) as stream:
        report = json.load(stream)
    return {name: value["value"] for name, value in report["watched"].items()}, report["large_rotation"]


for ranks in fewer((1, 3)):
    for angle in 3, 4 * math.pi:
        values, search = solve(STRIP % angle, ranks)
        check(values["energy"] < 1e-12 and abs(values["x"] - (10 * (math.cos(angle) - 1) - 0.5 * math.sin(angle))) < 1e-6, f"{angle}: {values}")
        check(search["newton_iterations"] <= 6 and search["load_steps"] <= 5, f"{angle}, {ranks} ranks: {search}")

turned, search = solve(STRIP % 3.0 + FORCE % (0.0, 0.5), fewer((1, 3))[-1])
check(search["newton_iterations"] <= 12, f"{search}")
back, _ = solve(STRIP % 0.0 + FORCE % (-0.5 * math.sin(3.0), 0.5 * math.cos(3.0)))
check(abs(turned["energy"] / back["energy"] - 1) < 1e-7, f"{turned}, {back}")
place = [10 + back["x"], -0.5 + back["z"]]
for name, value in ("x", math.cos(3.0) * place[0] + math.sin(3.0) * place[1] - 10), ("z", math.cos(3.0) * place[1] - math.sin(3.0) * place[0] + 0.5):
    check(abs(turned[name] - value) < 1e-5, f"{name}: {turned[name]}, expected {value}")
