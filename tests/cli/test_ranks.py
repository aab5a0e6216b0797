"""The pose does not depend on the number of ranks beyond rounding."""
import os

from program import check, read_points, solve

CASE = """
title: a short tube, stiff in the radial direction
mesh:
  tube: {axis: y, length: 4, radii: [0.9, 1.5], divisions: {around: 24, radial: 3, axial: 16}}
materials:
  - region: all
    youngs_modulus: [1e6, 1e9, 1e6]
    poissons_ratio: 0.3
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: bottom}, displacement: [0, 0, 0]}
  - {on: {boundary: top}, slide: [0, 1, 0]}
loads:
  - {on: {nearest: [1.5, 2, 0]}, point_force: [1000, 0, 0]}
  - {on: {boundary: inner}, pressure: 50}
accuracy: {relative_residual: 2e-11}
solver: {method: METHOD, coarsest_unknowns: 200}
"""


SMALL = """
mesh: {block: {size: [1, 1, 1], divisions: [1, 1, 1]}}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [1, 0, 0]}]
"""


def more_ranks_than_vertices_are_refused():
    finished, _, path = solve(SMALL, ranks=9)
    check(finished.exit_code == 2 and finished.errors.count("9 ranks are more than the 8 vertices of the mesh; use 8 at"
          " most") == 1 and not os.path.exists(path), f"9 ranks for 8 vertices: {finished.exit_code} {finished.errors}")


def main():
    more_ranks_than_vertices_are_refused()
    for method in ("metric", "plain", "direct"):
        reference = None
        for ranks in (1, 2, 3, 4):
            finished, report, path = solve(CASE.replace("METHOD", method), ranks=ranks)
            check(finished.exit_code == 0, f"{method} on {ranks} ranks: {finished.errors}")
            check(report["ranks"] == ranks, f"the run reports {report['ranks']} ranks, not {ranks}")
            check(report["solver"]["method"] == method, f"method {report['solver']['method']}, asked for {method}")
            points = read_points(path)
            check(len(points) == 24 * 4 * 17, f"{len(points)} vertices in the file")
            if reference is None:
                reference = points
                largest = max(abs(v).max() for v in points.values())
                check(largest > 0.0, "nothing moved")
                continue
            check(points.keys() == reference.keys(), "the labels differ between numbers of ranks")
            worst = max(abs(points[k] - reference[k]).max() for k in points)
            check(worst <= 1e-9 * largest, f"{method}: {ranks} ranks differ from 1 by {worst / largest:.2e}")


main()
