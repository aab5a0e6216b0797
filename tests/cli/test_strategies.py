"""The solver's strategies as a user sees them: the plan, the next strategy in summary and JSON, refusals; on one rank and on two."""
import json

from program import check, fewer, new_folder, read_json, read_points, run, solve, write

CASE = """
title: a tube, stiff around
mesh:
  tube: {axis: y, length: 4, radii: [0.9, 1.5], divisions: {around: 24, radial: 3, axial: 16}}
materials:
  - region: all
    youngs_modulus: [1e6, 1e6, MODULUS]
    poissons_ratio: 0.3
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: bottom}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: top}, total_force: [10, 0, 0]}
accuracy: {relative_residual: TOLERANCE}
solver: {SOLVER}
"""

# One step of smoothing on single nodes over a narrow interval: far too slow, and given, so that no strategy may mend it.
CRIPPLED = "aggregate_nodes: 300, smoother_block_nodes: 1, smoother_degree: 1, smoother_ratio: 1.5, patience: 1"


def case(solver, modulus="1e9", tolerance="1e-9"):
    return CASE.replace("SOLVER", solver).replace("MODULUS", modulus).replace("TOLERANCE", tolerance)


def close(a, b, what):
    size = max(max(abs(value)) for value in b.values())
    worst = max(max(abs(a[label] - b[label])) for label in b)
    check(a.keys() == b.keys() and worst <= 1e-5 * size, f"{what}: differs by {worst / size:.1e}")


def every_rung_gives_the_same_pose():
    expected = None
    for method in ("direct", "plain", "metric", "strong", "two_level", "auto"):
        for ranks in fewer((1, 2)):
            finished, report, path = solve(case(f"method: {method}"), ranks=ranks)
            check(finished.exit_code == 0, f"{method}, {ranks} ranks: {finished.errors}")
            used = "metric" if method == "auto" else method
            check(report["solver"]["method"] == used, f"{method} used {report['solver']['method']}")
            check([step["strategy"] for step in report["solver"]["strategies"]] == [used], f"{method} went on to another")
            check(report["solver"]["relative_residual"] <= 1e-9, f"{method}: {report['solver']['relative_residual']}")
            points = read_points(path)
            expected = expected or points
            close(points, expected, f"{method} on {ranks} ranks")


def a_next_strategy_is_told():
    for ranks in fewer((1, 2)):
        finished, report, _ = solve(case(CRIPPLED), ranks=ranks)
        check(finished.exit_code == 0, f"{ranks} ranks: {finished.errors}")
        steps = report["solver"]["strategies"]
        check([step["strategy"] for step in steps] == ["metric", "direct"], f"cheap factors come next: {steps}")
        check("too slow" in steps[0]["outcome"] and steps[0]["iterations"] == 40, f"first step: {steps[0]}")
        check(steps[-1]["relative_residual"] <= 1e-9, f"last step: {steps[-1]}")
        check(sum(step["iterations"] for step in steps) == report["solver"]["iterations"], "iterations do not add up")
        check("strategies       metric, 40 iterations" in finished.output, finished.output)


def without_memory_all_that_was_tried_is_told():
    for ranks in fewer((1, 2)):
        finished, _, _ = solve(case(CRIPPLED + ", factor_memory: 1, max_iterations: 125"), ranks=ranks)
        check(finished.exit_code == 1, f"exit {finished.exit_code}")
        for words in ("after 125 iterations, the most allowed", "Tried: metric (40 iterations)",
                      "solver.factor_memory allows 1 MiB; raise it or leave it out"):
            check(words in finished.errors, f"'{words}' is not in: {finished.errors}")
        check(finished.errors.count("error:") == 1, f"told more than once: {finished.errors}")


SMALL = """
mesh: {block: {size: [1, 1, 1], divisions: [6, 6, 6]}}
element: {order: ORDER}
materials: [{region: all, youngs_modulus: 2e11, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, 1]}]
solver: {factor_memory: MEMORY}
accuracy: {relative_residual: 1e-8}
"""


def a_small_body_that_may_not_be_factored_is_iterated_on():
    # below what the plan takes a factorisation for, and above that but below what the analysis foresees
    for memory, said in (("0.5", "would not fit into the 0.5 MiB allowed"), ("1.7", "would not fit into the 1.7 MiB allowed")):
        for ranks in fewer((1, 2)):
            finished, report, path = solve(SMALL.replace("MEMORY", memory).replace("ORDER", "1"), ranks=ranks)
            check(finished.exit_code == 0, f"{memory} MiB, {ranks} ranks: {finished.errors}")
            check(report["solver"]["method"] == "metric", f"{memory} MiB: {report['solver']['method']}")
            check(len(report["solver"]["level_unknowns"]) > 1, f"{memory} MiB: factored after all")
            check(said in report["solver"]["plan"][0], f"{memory} MiB: {report['solver']['plan']}")
            free, _, expected = solve(SMALL.replace("MEMORY", "1000").replace("ORDER", "1"))
            check("solver           direct" in free.output, free.output)
            close(read_points(path), read_points(expected), f"{memory} MiB")
    finished, report, _ = solve(SMALL.replace("MEMORY", "1.7").replace("ORDER", "2").replace("6, 6, 6", "3, 3, 3"))
    check(finished.exit_code == 0 and report["solver"]["method"] == "metric", finished.errors + finished.output)
    check(report["solver"]["level_unknowns"][1] == 144, f"not on the linear tets: {report['solver']['level_unknowns']}")


def all_that_was_tried_is_told_whole():
    """To its last word: on standard error, in the JSON and in the file."""
    folder = new_folder()
    hopeless = case(CRIPPLED + ", factor_memory: 1, max_iterations: 125")
    finished, _, path = solve(hopeless, folder=folder, extra=("--keep",))
    report = read_json(folder, "summary.json")
    steps = report["solver"]["strategies"]
    check(len(steps) == 5, f"five steps are wanted: {steps}")
    reason = report["reasons"][0]
    tried = "; ".join(f"{s['strategy']} ({s['iterations']} iterations): {s['outcome']}" for s in steps)
    check(reason.endswith("Tried: " + tried), f"not all of {tried}: {reason}")
    check(steps[3]["outcome"].endswith("raise it or leave it out"), f"an outcome is cut off: {steps[3]}")
    check(finished.errors.endswith(reason + "\n"), f"not whole: {finished.errors}")
    with open(path, "rb") as stream:
        check(reason.encode() in stream.read(), "the file's reason is not whole")


def what_rounding_allows_is_refused_or_taken():
    finished, _, _ = solve(case("method: auto", tolerance="1e-15"))
    check(finished.exit_code == 1 and "double precision allows about" in finished.errors, finished.errors)
    finished, report, _ = solve(case("method: auto", tolerance="1e-15, out_of_reach: accept"))
    check(finished.exit_code == 0, finished.errors)
    solver = report["solver"]
    check(solver["rounding_limited"], "not said to be limited by rounding")
    check(1e-15 < solver["relative_residual"] < 3 * solver["attainable_residual"], f"{solver}")
    check(len(solver["strategies"]) == 1, f"went on in vain: {solver['strategies']}")


def the_plan_is_explained():
    folder = new_folder()
    first = "metric"
    for modulus in ("1e9", "1e12"):
        write(folder, "case.yaml", case("method: auto", modulus=modulus))
        finished = run("explain", "case.yaml", "--json", folder=folder)
        check(finished.exit_code == 0, finished.errors)
        plan = json.loads(finished.output)["solver"]
        check(plan["method"] == first, f"{modulus}: {plan}")
        check(any("at one place" in reason for reason in plan["reasons"]), f"{modulus}: {plan}")
        check(any("method direct is" in reason for reason in plan["reasons"]), f"{modulus}: {plan}")
        check(f"{first} first: " in run("explain", "case.yaml", folder=folder).output, "the method is not printed")


every_rung_gives_the_same_pose()
a_next_strategy_is_told()
without_memory_all_that_was_tried_is_told()
a_small_body_that_may_not_be_factored_is_iterated_on()
all_that_was_tried_is_told_whole()
what_rounding_allows_is_refused_or_taken()
the_plan_is_explained()
