"""A sample of the hard grid, on one rank and on two: nothing false, every flaw named, and the ranks of one mind."""
import json
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import check, run  # noqa: E402

SHAPES = {"tube", "beam", "plate", "slivers", "layers", "soft", "stiff", "checker"}
SOLVED = {"solved", "solved to rounding"}


def grid(folder, ranks):
    path = os.path.join(folder, f"hard-{ranks}.json")
    finished = run("verify", "--hard", "--quick", "--json", path, ranks=ranks)
    with open(path) as stream:
        document = json.load(stream)
    check(document["ranks"] == ranks, f"{document['ranks']} ranks ran, not {ranks}")
    check((finished.exit_code == 0) == document["passed"], f"exit {finished.exit_code}, passed {document['passed']}")
    check(document["passed"], f"on {ranks} ranks:\n{finished.output[-6000:]}{finished.errors}")
    return {point["point"]: point for point in document["points"]}


def check_sound(point):
    name = point["point"]
    check(point["outcome"] in SOLVED | {"refused rightly"}, f"{name}: {point['outcome']}: {point['reason']}")
    if point["outcome"] not in SOLVED:
        return
    check(point["unknowns"] > 3000, f"{name}: only {point['unknowns']} unknowns, which any case has factored")
    check(point["relative_residual"] <= point["asked"], f"{name}: residual {point['relative_residual']}")
    check((point["asked"] == 1e-8) == (point["outcome"] == "solved"), f"{name}: asked {point['asked']}")
    # ||u - u*|| <= ||K^-1|| ||f - K u||; the norm is estimated, from below.
    check(point["digits"] is not None and 10 ** -point["digits"] <= 4 * point["amplification"] *
          (point["asked"] + point["floor"]), f"{name}: {point['digits']} digits")


def main():
    folder = tempfile.mkdtemp(prefix="orthostat-")
    one, two = grid(folder, 1), grid(folder, 2)
    check(one.keys() == two.keys(), "the ranks ran different points")
    sound = [name for name, point in one.items() if not point["flawed"]]
    check({one[name]["shape"] for name in sound} == SHAPES, "a shape is missing")
    check({one[name]["row"] for name in sound} == set(range(7)), "a Poisson's ratio is missing")
    check({one[name]["order"] for name in sound} == {1, 2}, "an order is missing")
    for name, point in one.items():
        other = two[name]
        if point["flawed"]:
            check(point["outcome"] == other["outcome"] == "refused rightly", f"{name}: {point['reason']}")
            continue
        check_sound(point)
        check_sound(other)
        check(point["outcome"] == other["outcome"],
              f"{name}: {point['outcome']} on one rank, {other['outcome']} on two")
        # Two factorisations of what two assemblies rounded differently: as near as conditioning lets them.
        apart = abs(point["size"] - other["size"]) / point["size"]
        check(apart <= 100 * max(point["plain_factors_error"], other["plain_factors_error"], 1e-15),
              f"{name}: displacements are {apart:.1e} apart")

    check(run("verify", "--hard", "cube").exit_code == 2, "a shape that is not there")
    check(run("verify", "--hard", "--json", os.path.join(folder, "no", "such.json"), "tube").exit_code == 2,
          "a report that cannot be written is found before the grid runs")


main()
