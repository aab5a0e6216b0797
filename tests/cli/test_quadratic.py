"""Quadratic tets: p-multigrid, the direct solver and any number of ranks give one pose, and it is softer than that of linear tets."""
from program import check, read_points, solve

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
solver: {recipe: RECIPE, coarsest_unknowns: 200}
"""


def run(order, recipe, ranks):
    finished, report, path = solve(CASE.replace("ORDER", str(order)).replace("RECIPE", recipe), ranks=ranks)
    check(finished.exit_code == 0, f"order {order}, {recipe}, {ranks} ranks: {finished.errors}")
    return report, read_points(path)


def main():
    linear, _ = run(1, "metric", 1)
    reference = None
    for recipe, ranks in (("metric", 1), ("metric", 2), ("metric", 4), ("direct", 1), ("direct", 2), ("plain", 2)):
        report, points = run(2, recipe, ranks)
        check(len(points) == 48 * 5 * 21, f"{len(points)} nodes: one on every edge is expected")
        energy = report["checks"]["strain_energy"]
        check(energy > linear["checks"]["strain_energy"], "quadratic tets give more under the same load than linear ones")
        if recipe == "metric":
            unknowns = report["solver"]["level_unknowns"]
            check(unknowns[0] == report["unknowns"], "the quadratic tets are the finest level")
            check(unknowns[1] == 3 * 24 * 3 * 10, f"the linear tets come next, not {unknowns[1]} unknowns")
            check(report["solver"]["iterations"] <= 40, f"{report['solver']['iterations']} iterations to 1e-11")
        if reference is None:
            reference = points
            largest = max(abs(v).max() for v in points.values())
            continue
        check(points.keys() == reference.keys(), f"{recipe} on {ranks} ranks: other labels")
        worst = max(abs(points[k] - reference[k]).max() for k in points)
        check(worst <= 1e-9 * largest, f"{recipe} on {ranks} ranks differs by {worst / largest:.2e}")


main()
