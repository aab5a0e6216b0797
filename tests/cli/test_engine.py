"""Who does the work of the default solve: the calls of AztecOO's AZ_iterate and ML's ML_Cycle_MG are counted from outside
(count_trilinos.c, preloaded) and held against what the program says of itself."""
import json
import os

from program import SOURCE, check, new_folder, run, solve, write

COUNTER = os.environ["ORTHOSTAT_COUNTER"]

# Fields without the error, whose estimate has cycles of its own; linear, as the look for buckling has them too.
TUBE = open(os.path.join(SOURCE, "cases", "tube", "radial.yaml")).read().replace("output: {", "large_rotation: off\noutput: {fields: [displacement], ")
BENT = """
title: a cantilever of quadratic tets
mesh: {block: {size: [4, 1, 1], divisions: [16, 4, 4]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, 1]}]
output: {fields: [displacement]}
large_rotation: off
"""


def counted(case, ranks):
    """The report of a solve, and (AZ_iterate, ML_Cycle_MG) on each rank."""
    counts = os.path.join(new_folder(), "counts")
    os.environ.update(LD_PRELOAD=COUNTER, ORTHOSTAT_COUNTS=counts)
    finished, report, _ = solve(case, ranks=ranks, extra=["-v"])
    del os.environ["LD_PRELOAD"]
    check(finished.exit_code == 0, finished.errors)
    with open(counts) as lines:
        found = [tuple(map(int, line.split())) for line in lines]
    return finished, report["solver"], [pair for pair in found if pair != (0, 0)]


def aztecoo_iterates_and_ml_cycles():
    for case, name in ((TUBE, "tube"), (BENT, "quadratic tets")):
        for ranks in (1, 2):
            finished, solver, found = counted(case, ranks)
            where = f"{name}, {ranks} ranks: "
            check(solver["method"] == "metric", where + solver["method"])
            check(len(found) == ranks, where + f"counts of {len(found)} processes")
            # one solve; one cycle for each iteration, one to judge whether it may end, and one to find the error
            check(set(found) == {(1, solver["iterations"] + 2)}, where + f"{found} for {solver['iterations']} iterations")
            engine = f"AztecOO CG, ML cycle of {len(solver['level_unknowns'])} levels"
            check(solver["engine"] == engine, where + solver["engine"])
            check(engine in finished.output, where + finished.output)
            check(engine in finished.errors, where + finished.errors)


def explain_names_the_engine():
    folder = new_folder()
    write(folder, "case.yaml", TUBE)
    explained = run("explain", "case.yaml", folder=folder).output
    check("engine               AztecOO CG, ML cycle" in explained, explained)
    plan = json.loads(run("explain", "--json", "case.yaml", folder=folder).output)
    check(plan["solver"]["engine"] == "AztecOO CG, ML cycle", plan)


def factors_are_mumps():
    finished, solver, found = counted(TUBE + "\nsolver: {method: direct}\n", 1)
    check(found == [], f"{found}")
    check(solver["engine"] == "MUMPS factors, refined by CG", solver["engine"])


aztecoo_iterates_and_ml_cycles()
explain_names_the_engine()
factors_are_mumps()
