"""The error of reactions and stresses: a body that its supports move along may deform by less than its displacement is rounded."""
import os

from program import check, new_folder, read_points, solve

CASE = """
mesh: {block: {size: SIZE, divisions: DIVISIONS}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: 2e11, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, MOVED]}MORE]
loads: [LOAD]
solver: {method: METHOD}
output: {fields: [displacement, node_stress]}
"""

PULL = "{on: {boundary: xmax}, total_force: [0, 0, 1]}"


def case(moved, method="direct", order=1, size="[1, 0.1, 0.1]", divisions="[20, 2, 2]", load=PULL, more=""):
    text = CASE.replace("MOVED", moved).replace("METHOD", method).replace("ORDER", str(order)).replace("SIZE", size)
    return text.replace("DIVISIONS", divisions).replace("LOAD", load).replace("MORE", more)


def stress(path):
    return read_points(path, "node_stress")


def relative_difference(values, others):
    square = sum(((values[k] - others[k]) ** 2).sum() for k in others)
    return (square / sum((others[k] ** 2).sum() for k in others)) ** 0.5


def what_is_stated_is_the_error_of_the_stress():
    cube = {"size": "[1, 1, 1]", "divisions": "[6, 12, 12]"}
    bodies = [({}, "direct", "1e2"), ({}, "metric", "1e2"), ({"order": 2}, "direct", "1"), (cube, "metric", "1e-5"),
              (cube, "direct", "1")]
    for body, method, moved in bodies:
        _, _, path = solve(case("0", method, **body))
        expected = stress(path)
        for ranks in (1, 2):
            where = f"{body}, {method}, moved by {moved}, {ranks} ranks"
            finished, report, path = solve(case(moved, method, **body), ranks=ranks)
            check(finished.exit_code == 0, f"{where}: {finished.errors}")
            stated = report["checks"]["force_error"]
            error = relative_difference(stress(path), expected)
            check(0.2 * stated < error < 5 * stated, f"{where}: stress off by {error:.1e}, {stated:.1e} was stated")
            check(f"{stated:.1e} in reactions and stresses" in finished.output, finished.output)


def loads_are_written_node_by_node():
    heavy = case("0", size="[2, 1, 1]", divisions="[4, 2, 2]", load="{gravity: [0, 3, 0]}, " + PULL)
    heavy = heavy.replace("ratio: 0.3", "ratio: 0.3, density: 2").replace("[displacement, node_stress]", "[load]")
    for ranks in (1, 2):
        finished, _, path = solve(heavy, ranks=ranks)
        check(finished.exit_code == 0, finished.errors)
        load = read_points(path, "load")
        total = sum(load.values())
        check(len(load) == 45 and max(abs(total - [0, 12, 1])) < 1e-12, f"{ranks} ranks: the loads add up to {total}")


def stresses_without_a_digit_are_refused():
    # the cube's reactions balance to 0.06 all the same, as many that are wrong hide each other
    cube = {"size": "[1, 1, 1]", "divisions": "[6, 12, 12]"}
    for body, method, moved in (({}, "direct", "1e5"), ({}, "metric", "1e5"), (cube, "metric", "1"), (cube, "plain", "1")):
        for ranks in (1, 2):
            where = f"{body}, {method}, moved by {moved}, {ranks} ranks"
            finished, _, path = solve(case(moved, method, **body), ranks=ranks)
            check(finished.exit_code == 1, f"{where}: exit {finished.exit_code}: {finished.output}")
            for words in ("reactions and stresses hold less than one digit", f"moves as a whole by about (0, 0, {float(moved):.3g})",
                          "subtract the common part from the prescribed displacements", "nothing was written"):
                check(words in finished.errors, f"{where}: '{words}' is not in: {finished.errors}")
            check(not os.path.exists(path), f"{where}: written all the same")
    folder = new_folder()
    finished, _, path = solve(case("1e5"), folder=folder, extra=("--keep",))
    check(finished.exit_code == 1 and os.path.exists(path), f"--keep: exit {finished.exit_code}")
    check("NO ANSWER        reactions and stresses" in finished.output, finished.output)


def what_has_no_forces_passes():
    taken_along = ", {on: {boundary: xmax}, displacement: [0, 0, 1e5]}"
    for method in ("direct", "metric", "plain"):
        for what, text in (("nothing acts", case("0", method, load="")), ("moved", case("1e5", method, load="")),
                           ("moved at both ends", case("1e5", method, load="", more=taken_along)),
                           ("loaded where it is held", case("1e5", method, load="{on: {nearest: [0, 0, 0]}, point_force: [0, 0, 1e3]}"))):
            finished, _, _ = solve(text)
            check(finished.exit_code == 0, f"{what}, {method}: {finished.errors}")


def a_force_straight_into_a_moved_support_passes():
    load = "{on: {nearest: [1, 0, 0]}, point_force: [0, 0, 1e12]}"
    more = ", {on: {boundary: xmax}, displacement: [0, 0, 1e-3]}"
    for method in ("direct", "metric"):
        finished, report, _ = solve(case("0", method, load=load, more=more))
        check(finished.exit_code == 0, f"{method}: {finished.errors}")
        check(report["checks"]["force_error"] < 1e-6, f"{method}: {report['checks']}")


what_is_stated_is_the_error_of_the_stress()
stresses_without_a_digit_are_refused()
what_has_no_forces_passes()
a_force_straight_into_a_moved_support_passes()
loads_are_written_node_by_node()
