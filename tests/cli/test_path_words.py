"""What is said about paths: how far they went, what was written, what happened in steps before the last; and of springs in `check`."""
import csv
import json
import os

from program import check, fewer, new_folder, run, write

BLOCK = "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
STEEL = "materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]\n"
HELD = "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
PULL = "loads: [{on: {boundary: xmax}, total_force: [1, 0, 0]}]\n"


def call(text, *arguments, ranks=1):
    folder = new_folder()
    write(folder, "case.yaml", text)
    return run(*arguments, ranks=ranks, folder=folder), folder


# A path that ends before t = 1 is whole.
finished, _ = call(BLOCK + STEEL + HELD + PULL + "large_rotation: on\npath: {times: [0.25, 0.5]}\n", "solve", "case.yaml")
check(finished.exit_code == 0 and "newton " in finished.output, finished.output + finished.errors)
check("of the load is reached" not in finished.output and "followed up to" not in finished.output, finished.output)
check("case_0001.vtkhdf to " in finished.output, finished.output)

# One step is no range; and a path that stops at its first one has written no step.
finished, _ = call(BLOCK + STEEL + HELD + PULL + "path: {times: [1]}\n", "solve", "case.yaml")
check("written to       case_0001.vtkhdf, listed in case.hdf.series" in finished.output, finished.output)
long = BLOCK.replace("[2, 2, 2]", "[12, 6, 6]")
kept, folder = call(long + STEEL + HELD + PULL + "path: {times: [0.5, 1]}\nsolver: {method: plain, max_iterations: 2}\n", "solve",
                    "case.yaml", "--keep")
check(kept.exit_code == 1, kept.errors)
check("path of 2 steps, of which 0 are done\n" in kept.output, kept.output)
check("case_0001.vtkhdf, marked as unfinished" in kept.output and "case_0000" not in kept.output, kept.output)
check(os.path.exists(os.path.join(folder, "case_0001.vtkhdf")), "the unfinished step was not written")

# Two displacements of one vertex that follow different tables: each is prescribed alone.
tables = """constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
  - {on: {boundary: xmax}, displacement: [0.1, free, free], time: [[0, 0], [1, 1]]}
  - {on: {nearest: [1, 1, 1]}, displacement: [0.1, free, free], time: [[0, 0], [0.5, 1]]}
path: {steps: 2}
"""
refused, _ = call(BLOCK + STEEL + tables, "solve", "case.yaml")
check(refused.exit_code == 2 and "where two meet, give both the same table" in refused.errors, refused.errors)

# Turned inside out half-way, by a jump, and back again: only that step's own warnings tell.
pushed = """constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
  - {on: {boundary: xmax}, displacement: [-1.1, 0, 0], time: [[0, 0], [0.5, 1], [1, 0.1]]}
large_rotation: on
path: {times: [0.1, 0.5, 1]}
"""
for ranks in fewer((3, 1)):
    warned, _ = call(BLOCK + STEEL + pushed, "solve", "case.yaml", ranks=ranks)
    check(warned.exit_code == 0, warned.errors)
    for words in ("inside out", "the body jumps to another state"):
        lines = [line for line in warned.errors.splitlines() if words in line]
        check(len(lines) == 1 and "warning: step 2, at t = 0.5: " in lines[0], warned.errors)
    check("inside out" not in warned.output, warned.output)

# A path of an eigenstrain alone has its factor in the history, by a table or without.
for time, factors in (("", [0.5, 1.0]), (", time: [[0, 0], [0.5, 1], [1, 0.25]]", [1.0, 0.25])):
    swollen, folder = call(BLOCK + f"""materials:
  - {{region: all, youngs_modulus: 1000, poissons_ratio: 0.3, eigenstrain: {{value: [0.1, 0.2, 0.3]{time}}}}}
""" + HELD + "path: {steps: 2}\n", "solve", "case.yaml")
    check(swollen.exit_code == 0, swollen.errors)
    with open(os.path.join(folder, "case_history.csv")) as stream:
        rows = list(csv.DictReader(stream))
    check([float(row["load_factor"]) for row in rows] == factors, rows)

# A spring is named beside constraints and loads.
springs = "springs: [{on: {boundary: xmin}, foundation: 5}, {on: {nearest: [0, 0, 0]}, spring: 1}]\n"
checked, _ = call(BLOCK + STEEL + PULL + springs, "check", "case.yaml")
check("0 constraints on 0 vertices, 2 springs, 1 load\n" in checked.output, checked.output + checked.errors)
checked, _ = call(BLOCK + STEEL + PULL + springs, "check", "case.yaml", "--json")
check(json.loads(checked.output)["springs"] == 2, checked.output)
