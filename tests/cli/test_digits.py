"""The error that a run states is not exceeded: two solvers that share no preconditioner agree to it, on 1 rank and on 2."""
from program import check, read_points, solve

CASE = """
mesh:
  tube: {axis: y, length: 4, radii: [0.9, 1.5], divisions: {around: 24, radial: 3, axial: 12}}
element: {order: ORDER}
materials:
  - region: all
    youngs_modulus: MODULI
    poissons_ratio: POISSON
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: ends}, displacement: [0, 0, 0]}
loads:
  - {on: {nearest: [1.5, 2, 0]}, point_force: [1000, 0, 0]}
accuracy: {relative_residual: 1e-8}
solver: {method: METHOD}
large_rotation: off
"""

HARD = [("1e6, 1e6, 1e6", "0.3", 1), ("1e6, 1e9, 1e6", "0.3", 2), ("1e6, 1e12, 1e6", "0.3", 1), ("1e12, 1e6, 1e6", "0.3", 1),
        ("1e6, 1e6, 1e12", "0.3", 1), ("1e6, 1e9, 1e6", "0.49", 1)]


def relative_difference(points, others):
    square = sum(((points[k] - others[k]) ** 2).sum() for k in points)
    return (square / sum((others[k] ** 2).sum() for k in points)) ** 0.5


GEL = """
mesh:
  block: {size: [1, 1, 1], divisions: [2, 2, 2]}
element: {order: 2}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: POISSON}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [0, 0, 1]}
accuracy: {relative_residual: 1e-8}
large_rotation: off
"""


def next_to_incompressible():
    """The displacement has a limit at nu = 1/2, and differs from it by half of what nu is off (1e-6 here)."""
    limit = None
    for off in (1e-6, 1e-8, 1e-9, 1e-12):
        finished, report, path = solve(GEL.replace("POISSON", repr(0.5 - off)))
        check(finished.exit_code == 0, f"nu 0.5 - {off}: {finished.errors}")
        points = read_points(path)
        limit = limit or points
        difference, stated = relative_difference(points, limit), report["checks"]["displacement_error"]
        check(difference <= 1e-6 + 3.0 * stated, f"nu 0.5 - {off}: off by {difference:.1e}, where {stated:.1e} was stated")
        check(stated < 1e-3, f"nu 0.5 - {off}: an error of {stated:.1e}")


PULLED = """
mesh:
  block: {size: [100, 1, 1], divisions: [100, 2, 2]}
materials:
  - {region: all, youngs_modulus: 1, poissons_ratio: 0.3}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [1, 0, 0]}
  - {on: {nearest: [100, 0.5, 0.5]}, point_force: [0, 0, 1e-4]}
solver: {method: METHOD}
large_rotation: off
MORE
"""


def bent_by_little():
    """A bar's pull has the energy and the residual, and a small force that bends it the displacement."""
    found = []
    text = PULLED.replace("MORE", "accuracy: {relative_residual: 1e-8}")
    for method, ranks in (("direct", 1), ("metric", 1), ("metric", 2), ("strong", 1)):
        finished, report, path = solve(text.replace("METHOD", method), ranks=ranks)
        check(finished.exit_code == 0, f"{method} on {ranks} ranks: {finished.errors}")
        found.append((method, report["checks"]["displacement_error"], read_points(path)))
    for method, error, points in found[1:]:
        difference = relative_difference(points, found[0][2])
        check(difference <= error + found[0][1], f"{method}: differs by {difference:.1e}, {error:.1e} was stated")
    for method in ("metric", "strong"):  # stopped where the mesh has the larger error
        finished, report, path = solve(PULLED.replace("METHOD", method).replace("MORE", ""))
        check(finished.exit_code == 0, f"{method}, stopped: {finished.errors}")
        difference, stated = relative_difference(read_points(path), found[0][2]), report["checks"]["displacement_error"]
        check(difference <= 3.0 * stated, f"{method}, stopped: differs by {difference:.1e}, {stated:.1e} was stated")
        check(difference <= report["answer_error"]["displacement"], f"{method}, stopped: differs by {difference:.1e}")


LOOSE = """
mesh:
  tube: {axis: y, length: 4, radii: [0.9, 1.5], divisions: {around: 16, radial: 2, axial: 8}}
element: {order: 2}
materials:
  - region: all
    youngs_modulus: [1e5, 1e8, 3e6]
    poissons_ratio: 0.4
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: bottom}, displacement: [0, 0, 0]}
  - {on: {boundary: top}, displacement: [0, 0.3, 0]}
output: {fields: [displacement]}
accuracy: {relative_residual: RESIDUAL}
solver: {method: metric}
large_rotation: off
"""


def a_large_residual_is_not_rounding():
    finished, _, path = solve(LOOSE.replace("RESIDUAL", "1e-9"))
    check(finished.exit_code == 0 and "the residual asked for leaves" not in finished.output, finished.errors + finished.output)
    right = read_points(path)
    for residual in ("1e-1", "1e-2"):
        finished, report, path = solve(LOOSE.replace("RESIDUAL", residual))
        check(finished.exit_code == 0, f"{residual}: {finished.errors}")
        check("WARNING          the residual asked for leaves" in finished.output, f"{residual}: {finished.output}")
        difference, stated = relative_difference(read_points(path), right), report["checks"]["displacement_error"]
        check(stated / 4 < difference < 3.0 * stated, f"{residual}: off by {difference:.1e}, {stated:.1e} stated")


def main():
    a_large_residual_is_not_rounding()
    next_to_incompressible()
    bent_by_little()
    for moduli, poisson, order in HARD:
        text = CASE.replace("MODULI", f"[{moduli}]").replace("POISSON", poisson).replace("ORDER", str(order))
        found = []
        for method, ranks in (("direct", 1), ("direct", 2), ("metric", 1), ("metric", 2)):
            where = f"{method} on {ranks} ranks, moduli {moduli}, nu {poisson}, order {order}"
            finished, report, path = solve(text.replace("METHOD", method), ranks=ranks)
            check(finished.exit_code == 0, f"{where}: {finished.errors}")
            checks = report["checks"]
            check(checks["rigid_motion"] < 1e-13, f"{where}: rigid motion meets a force of {checks['rigid_motion']:.1e}")
            check(checks["displacement_error"] <= 1e-3, f"{where}: an error of {checks['displacement_error']:.1e}")
            check(f"of about {checks['displacement_error']:.1e} in the displacement" in finished.output, f"{where}: {finished.output}")
            found.append((where, checks["displacement_error"], read_points(path)))
        for where, error, points in found[1:]:
            difference = relative_difference(points, found[0][2])
            allowed = error + found[0][1]
            check(difference <= allowed, f"{where}: differs by {difference:.1e}, where {allowed:.1e} was stated")


main()
