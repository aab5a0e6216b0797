"""The hard grid at size, on one rank and two: without a factorisation, and as well as is stated."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import check, new_folder, run  # noqa: E402

GRID = os.path.join(os.environ["ORTHOSTAT_TEST_BIN"], "hard_grid")
SIZE = 6000
SPREAD = 6


def grid(folder, ranks, *asked):
    path = os.path.join(folder, f"size-{ranks}.json")
    finished = run("--size", str(SIZE), "--json", path, *asked, ranks=ranks, timeout=580, program=GRID)
    with open(path) as stream:
        document = json.load(stream)
    check(document["ranks"] == ranks and document["size"] == SIZE, "another run than was asked for")
    check((finished.exit_code == 0) == document["passed"], f"exit {finished.exit_code}, passed {document['passed']}")
    return {point["point"]: point for point in document["points"]}


def check_point(name, point):
    check(point["outcome"] in ("solved", "solved to rounding"), f"{name}: {point['outcome']}: {point['reason']}")
    check(0.5 * SIZE < point["unknowns"] < 2 * SIZE, f"{name}: {point['unknowns']} unknowns")
    check(point["method"] != "direct", f"{name}: was factored")
    check(point["iterations"] <= 500, f"{name}: {point['iterations']} iterations")
    check(point["tet_residual_in_64_bits"] <= 3 * max(point["tet_residual"], 1e-8), f"{name}: {point['tet_residual']}")
    check((point["displacement_error"] is None) == (point["outcome"] == "solved"), f"{name}: factored, or not, without need")
    check(3 * point["stated_error"] >= (point["displacement_error"] or 0), f"{name}: off by {point['displacement_error']}")


def main():
    folder = new_folder()
    one, two = grid(folder, 1, "tube"), grid(folder, 2, "--quick", "tube")
    for point in list(one.items()) + list(two.items()):
        check_point(*point)
    check(len(one) == 2 * SPREAD and len(two) == 1, f"{len(one)} and {len(two)} points")
    check({point["shape"] for point in one.values()} == {"tube"}, "other shapes")
    check(len({point["row"] for point in one.values()}) == 5, "Poisson's ratios are missing")
    for name in two:
        check(two[name]["iterations"] <= 2 * one[name]["iterations"] + 20, f"{name}: {two[name]['iterations']} iterations on two ranks")
    every = run("--size", "1e9", program=GRID)
    check(every.exit_code == 2 and "1e8" in every.errors, "a size beyond all memory")


main()
