"""The turtle of Li and Barbic's paper, under a force on every vertex, against Vega FEM's direct solver."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SOURCE, check, fewer, new_folder, run  # noqa: E402

TURTLE = os.path.join(SOURCE, "..", "shared", "data", "turtle")

# Strain energy of the pose, computed with Vega FEM's own stiffness and direct solver from the same files.
ENERGY = {"heterogeneous": 9.5076783330e-3, "homogeneous": 9.5012809098e-3}

CASE = """mesh: {{file: {folder}/turtle-volumetric-{kind}.ortho.veg}}
constraints:
  - {{on: {{vertices: {folder}/turtle-volumetric.bou}}, displacement: [0, 0, 0]}}
loads:
  - {{on: {{all: true}}, point_force: [0, -1, 0]}}
solver: {{method: {method}}}
accuracy: {{relative_residual: 1e-11}}
"""


def is_close(value, reference):
    return abs(value - reference) <= 1e-9 * reference


def main():
    if not os.path.isdir(TURTLE):
        print(f"skipped: the turtle's files are not at hand ({TURTLE})")
        return
    folder = new_folder()
    case = os.path.join(folder, "turtle.yaml")
    summary = os.path.join(folder, "turtle.json")
    for kind, energy in fewer(list(ENERGY.items())):
        for method in ("metric", "direct"):
            with open(case, "w") as stream:
                stream.write(CASE.format(folder=os.path.realpath(TURTLE), kind=kind, method=method))
            for ranks in fewer((1, 2)):
                finished = run("solve", "-q", case, "--json", summary, ranks=ranks, folder=folder)
                where = f"{kind} turtle, {method} on {ranks} rank(s)"
                check(finished.exit_code == 0, f"{where}: {finished.errors}")
                with open(summary) as stream:
                    report = json.load(stream)
                check(report["vertices"] == 347 and report["tets"] == 1185, f"{where}: another mesh")
                check(report["unknowns"] == 3 * (347 - 23), f"{where}: {report['unknowns']} unknowns, 23 vertices held")
                check(report["solver"]["method"] == method, f"{where}: solved by {report['solver']['method']}")
                checks = report["checks"]
                check(is_close(checks["strain_energy"], energy), f"{where}: energy {checks['strain_energy']:.12g}")
                check(is_close(checks["work"], energy), f"{where}: half of f u is {checks['work']:.12g}")


main()
