"""Cook's membrane in plane strain: a slab between two smooth walls, of quadratic tets, against cook.py's triangles."""
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
import cook  # noqa: E402
from program import check, new_folder, run  # noqa: E402

YOUNG = 240.565
THICKNESS = 4.0

CASE = """mesh: {{file: {mesh}}}
element: {{order: 2}}
large_rotation: off
materials: [{{region: all, youngs_modulus: {young}, poissons_ratio: {nu}}}]
constraints:
  - {{on: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}}}, displacement: [0, 0, 0]}}
  - {{on: {{plane: {{point: [0, 0, 0], normal: [0, 0, 1]}}}}, slide: [0, 0, 1]}}
  - {{on: {{plane: {{point: [0, 0, {thickness}], normal: [0, 0, 1]}}}}, slide: [0, 0, 1]}}
loads: [{{on: {{plane: {{point: [48, 0, 0], normal: [1, 0, 0]}}}}, total_force: [0, {force}, 0]}}]
accuracy: {{relative_residual: 1e-9}}
solver: {{method: metric}}
"""


def write_slab(path, points, triangles):
    """Each triangle becomes a prism of three tets; sides are cut from the lower number to the higher one."""
    n = len(points)
    lines = ["*VERTICES", f"{2 * n} 3 0 0"]
    for layer in range(2):
        lines += [f"{layer * n + i + 1} {x:.17g} {y:.17g} {layer * THICKNESS:.17g}" for i, (x, y) in enumerate(points)]
    tets = []
    for t in triangles:
        a, b, c = sorted(t)
        turned = np.linalg.det([points[b] - points[a], points[c] - points[a]]) < 0
        for tet in ((a, b, c, c + n), (a, b, c + n, b + n), (a, b + n, c + n, a + n)):
            tet = (tet[0], tet[2], tet[1], tet[3]) if turned else tet
            tets.append(tuple(k + 1 for k in tet))
    lines += ["*ELEMENTS", "TET", f"{len(tets)} 4 0"]
    lines += [f"{i + 1} " + " ".join(map(str, tet)) for i, tet in enumerate(tets)]
    with open(path, "w", encoding="ascii") as stream:
        stream.write("\n".join(lines) + "\n")


def mean_displacement(folder, nu, divisions, share, ranks=1):
    mesh, case, summary = (os.path.join(folder, name) for name in ("cook.veg", "cook.yaml", "cook.json"))
    write_slab(mesh, *cook.mesh(divisions, share))
    with open(case, "w", encoding="ascii") as stream:
        stream.write(CASE.format(mesh=mesh, young=YOUNG, nu=nu, thickness=THICKNESS, force=cook.FORCE * THICKNESS))
    finished = run("solve", "-q", case, "--json", summary, ranks=ranks, folder=folder)
    check(finished.exit_code == 0, f"nu = {nu}, {divisions} divisions: {finished.errors}")
    with open(summary, encoding="utf-8") as stream:
        report = json.load(stream)
    return 2.0 * report["checks"]["strain_energy"] / (cook.FORCE * THICKNESS)


def main():
    folder = new_folder()
    for nu in (0.4999, 0.5):
        exact, order, _ = cook.reference(YOUNG, nu)
        check(order > 2.5, f"nu = {nu}: the reference converges with order {order:.2f}")
        # Uniform meshes: the corner's exponent, twice in the energy, sets the order; cut at a quarter: twice that.
        for share, times in ((0.5, 1.0), (0.25, 2.0)):
            of_theory = 2.0 * times * cook.exponent(nu)
            errors = [abs(mean_displacement(folder, nu, n, share, ranks) / exact - 1.0) for n, ranks in ((2, 1), (3, 2))]
            rate = np.log2(errors[0] / errors[1])
            print(f"nu = {nu}, cut at {share}: errors {errors[0]:.2e}, {errors[1]:.2e}, order {rate:.2f} of {of_theory:.2f}")
            check(0.9 * of_theory < rate < 1.2 * of_theory, f"nu = {nu}, cut at {share}: order {rate:.2f}, not {of_theory:.2f}")
        check(errors[1] < 5e-4, f"nu = {nu}: {errors[1]:.2e} off")


main()
