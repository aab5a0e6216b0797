"""A sample of the hard grid, on one rank and two: the sound is solved, flaws are named, the ranks are of one mind."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import check, new_folder, run  # noqa: E402

GRID = os.path.join(os.environ["ORTHOSTAT_TEST_BIN"], "hard_grid")
SHAPES = {"tube", "beam", "plate", "slivers", "layers", "soft", "stiff", "checker"}
SOLVED = {"solved", "solved to rounding"}


def grid(folder, ranks, *which):
    path = os.path.join(folder, f"hard-{ranks}.json")
    finished = run("--quick", "--json", path, *which, ranks=ranks, timeout=580, program=GRID)
    with open(path) as stream:
        document = json.load(stream)
    check(document["ranks"] == ranks, f"{document['ranks']} ranks ran, not {ranks}")
    check((finished.exit_code == 0) == document["passed"], f"exit {finished.exit_code}, passed {document['passed']}")
    return {point["point"]: point for point in document["points"]}


def check_sound(point):
    name = point["point"]
    check(point["outcome"] in SOLVED, f"{name}: {point['outcome']}: {point['reason']}")
    check(point["unknowns"] > 3000, f"{name}: only {point['unknowns']} unknowns, which any case has factored")
    check(point["rounding_limited"] == (point["outcome"] == "solved to rounding"), f"{name}: {point['outcome']}")
    check(point["rounding_limited"] or point["relative_residual"] <= 1e-8, f"{name}: {point['relative_residual']}")
    check(10 ** -point["digits"] <= 10 * point["stated_error"], f"{name}: {point['digits']} digits")


def check_ranks(name, one, two):
    """The same verdict; and the same body, as near as factorisations of differently rounded sums come to it."""
    if one["outcome"] != two["outcome"]:  # at the very limit of double precision one may just reach 1e-8
        check({one["outcome"], two["outcome"]} == SOLVED and max(one["floor"], two["floor"]) > 1e-10,
              f"{name}: {one['outcome']} on one rank, {two['outcome']} on two")
    if one["flawed"]:
        return
    apart = abs(one["size"] - two["size"]) / one["size"]
    least = max(one["plain_factors_error"], two["plain_factors_error"], 1e-15)
    check(apart <= 100 * least, f"{name}: displacements are {apart:.1e} apart")


def mixed_forms_state_their_errors(folder):
    """Bodies of nu = 1/2 against both equations as the tets have them: all of these are solved."""
    path = os.path.join(folder, "mixed.json")
    finished = run("--mixed", "--quick", "--json", path, "tube", "layers", "checker", timeout=580, program=GRID)
    with open(path) as stream:
        points = json.load(stream)["points"]
    check(finished.exit_code == 0 and len(points) > 5, f"--mixed: {len(points)} points: {finished.output}{finished.errors}")
    for point in points:
        check(point["outcome"] in SOLVED, f"{point['point']}: {point['outcome']}: {point['reason']}")
        true = max(point["stress_error"], point["reaction_error"])
        check(true <= 3 * point["stated_forces"] < 1e-3, f"{point['point']}: {true}, stated {point['stated_forces']}")
    check(run("--mixed", "--size", "5000", "tube", program=GRID).exit_code == 2, "--mixed has no sizes")


# A bar on an elastic foundation, and one that its supports hold without a force.
BAR = """mesh: {{block: {{size: [1, 0.3, 0.3], divisions: [6, 2, 2]}}}}
materials: [{{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}}]
{held}
loads: [{{on: {{boundary: {load}}}, {force}}}]
large_rotation: off
output: {{file: bar.vtkhdf}}
"""


def case_files_are_judged(folder):
    slides = "".join(f"  - {{on: {{boundary: {side}}}, slide: {normal}}}\n"
                     for side, normal in (("xmin", [1, 0, 0]), ("ymin", [0, 1, 0]), ("zmin", [0, 0, 1])))
    for held, load, force in (("springs: [{on: {boundary: xmin}, foundation: 1e5}]", "xmax", "total_force: [1, 2, 3]"),
                              ("constraints:\n" + slides, "xmax", "total_force: [0, 0, 0.1]"),
                              ("constraints:\n" + slides, "[xmax, xmin]", "pressure: 1")):
        path = os.path.join(folder, "bar.yaml")
        with open(path, "w") as stream:
            stream.write(BAR.format(held=held, load=load, force=force))
        judged = run(path, program=GRID)
        check(judged.exit_code == 0 and "errors           displacement" in judged.output and "nan" not in judged.output,
              f"{held}: {judged.output}{judged.errors}")


def main():
    folder = new_folder()
    case_files_are_judged(folder)
    two = grid(folder, 2, "--sample", "16", "slivers", "stiff")
    one = grid(folder, 1, "--sample", "20")
    sound = [name for name, point in one.items() if not point["flawed"]]
    check({one[name]["shape"] for name in sound} == SHAPES, "a shape is missing")
    check({one[name]["row"] for name in sound} == set(range(7)), "a Poisson's ratio is missing")
    check({one[name]["order"] for name in sound} == {1, 2}, "an order is missing")
    check({point["shape"] for point in two.values()} == {"slivers", "stiff"}, "shapes were not picked")
    for name, point in list(one.items()) + list(two.items()):
        if point["flawed"]:
            check(point["outcome"] == "refused rightly", f"{name}: {point['outcome']}: {point['reason']}")
        else:
            check_sound(point)
    common = one.keys() & two.keys()
    check(len(common) > 12, f"{len(common)} bodies on one rank and on two")
    for name in common:
        check_ranks(name, one[name], two[name])

    mixed_forms_state_their_errors(folder)
    unknown = run("cube", program=GRID)
    check(unknown.exit_code == 2 and "slivers" in unknown.errors, "a shape that does not exist")
    check(run("--json", os.path.join(folder, "no", "such.json"), "tube", program=GRID).exit_code == 2,
          "a report that cannot be written is found before the grid runs")
    check(run("--json", "-", "--json", "-", "tube", program=GRID).exit_code == 2, "two reports to standard output")

    script = os.path.join(os.environ["ORTHOSTAT_SOURCE"], "scripts", "hard-grid")
    check(run("--help", program=script).exit_code == 0, "scripts/hard-grid --help")
    check("number of ranks" in run("-n", "0", program=script).errors, "no ranks")
    check(run("--json", program=script).exit_code == 2, "an option without its value")
    moved = run("verify", "--hard")
    check(moved.exit_code == 2 and "scripts/hard-grid" in moved.errors, "verify --hard says where the grid has gone")


main()
