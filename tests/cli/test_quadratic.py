"""Quadratic tets: p-multigrid, the direct solver and any number of ranks give one pose, and it is softer than that of linear tets."""
import json

from program import SANITIZED, check, new_folder, read_points, run as run_program, solve, write

CASE = """
title: a short tube of quadratic tets
mesh:
  tube: {axis: y, length: 4, radii: [0.9, 1.5], divisions: {around: 24, radial: 2, axial: 10}}
element: {order: ORDER}
materials:
  - region: all
    youngs_modulus: [1e6, 1e6, 1e7]
    poissons_ratio: 0.3
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: bottom}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: top}, total_force: [10, 0, 0]}
  - {on: {boundary: inner}, pressure: 5}
accuracy: {relative_residual: 1e-11}
solver: {method: METHOD, coarsest_unknowns: 200}
"""


def run(order, method, ranks):
    finished, report, path = solve(CASE.replace("ORDER", str(order)).replace("METHOD", method), ranks=ranks)
    check(finished.exit_code == 0, f"order {order}, {method}, {ranks} ranks: {finished.errors}")
    return report, read_points(path)


FORESEEN = """
mesh: {SHAPE, refine: 1}
element: {order: 2}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {on: {all: true}, displacement: [0, free, free]}
  - {on: {nearest: [0, 9, 1]}, displacement: [0, 0, 0]}
  - {on: {nearest: [0, 1, 9]}, displacement: [0, 0, 0]}
"""


def foreseen_sizes_are_the_real_ones():
    for shape in ("sector: {axis: z, length: 1, radii: [1, 2], angle: 90, divisions: {around: 3, radial: 2, axial: 1}}",
                  "octant: {radii: [1, 2], divisions: {around: 2, radial: 1}}",
                  "tube: {axis: x, length: 1, radii: [1, 2], divisions: {around: 6, radial: 1, axial: 2}}"):
        folder = new_folder()
        write(folder, "case.yaml", FORESEEN.replace("SHAPE", shape))
        foreseen = run_program("explain", "case.yaml", "--json", folder=folder)
        real = run_program("check", "case.yaml", "--json", folder=folder)
        check(foreseen.exit_code == 0, f"explain: {foreseen.errors}")
        foreseen, real = json.loads(foreseen.output), json.loads(real.output)
        for what in ("vertices", "tets"):
            check(foreseen[what] == real[what], f"{shape}: {foreseen[what]} {what} foreseen, {real[what]} made")


TURNED = """
mesh: {block: {size: [1, 1, 0.5], divisions: [8, 8, 4]}}
element: {order: 2}
materials:
  - {region: all, youngs_modulus: [1e9, 1e6, 1e6], poissons_ratio: 0.3, axes: {euler: {degrees: [25, 15, 0]}}}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [10, 0, 5]}
accuracy: {relative_residual: 1e-8}
solver: {method: METHOD}
"""


def vertices_turn_where_stiff_axes_cross_the_mesh():
    """Over linear tets this body takes 79 iterations. Factors give the same answer, and are no quicker."""
    found = []
    for method, ranks in (("metric", 1), ("metric", 4), ("auto", 1), ("direct", 1)):
        finished, report, path = solve(TURNED.replace("METHOD", method), ranks=ranks)
        check(finished.exit_code == 0, f"turned, {method}, {ranks} ranks: {finished.errors}")
        solver = report["solver"]
        if method == "auto":
            check(solver["method"] == "metric", f"{solver['plan']}")
        if method != "direct":
            print(f"turned axes, {ranks} ranks: {solver['iterations']} iterations")
            check(solver["iterations"] <= 45, f"turned, {ranks} ranks: {solver['iterations']} iterations")
            check(solver["level_unknowns"][1] != 3 * 8 * 9 * 5, "the linear tets should not be the next level")
        found.append(report["checks"]["strain_energy"])
    check(max(found) - min(found) < 1e-6 * found[0], f"energies differ: {found}")


def main():
    vertices_turn_where_stiff_axes_cross_the_mesh()
    foreseen_sizes_are_the_real_ones()
    linear, _ = run(1, "metric", 1)
    reference = None
    runs = [("metric", 1), ("metric", 2), ("metric", 4), ("direct", 1), ("direct", 2), ("plain", 2)]
    for method, ranks in runs[1::2] if SANITIZED else runs:
        report, points = run(2, method, ranks)
        check(len(points) == 48 * 5 * 21, f"{len(points)} nodes: one on every edge is expected")
        energy = report["checks"]["strain_energy"]
        check(energy > linear["checks"]["strain_energy"], "quadratic tets give more under the same load than linear ones")
        if method == "metric":
            unknowns = report["solver"]["level_unknowns"]
            check(unknowns[0] == report["unknowns"], "the quadratic tets are the finest level")
            check(unknowns[1] == 3 * 24 * 3 * 10, f"the linear tets come next, not {unknowns[1]} unknowns")
            check(report["solver"]["iterations"] <= 40, f"{report['solver']['iterations']} iterations to 1e-11")
        if reference is None:
            reference = points
            largest = max(abs(v).max() for v in points.values())
            continue
        check(points.keys() == reference.keys(), f"{method} on {ranks} ranks: other labels")
        worst = max(abs(points[k] - reference[k]).max() for k in points)
        check(worst <= 1e-9 * largest, f"{method} on {ranks} ranks differs by {worst / largest:.2e}")


main()
