"""A sweep as a user meets it: the table on the screen, as CSV, JSON and picture; the same numbers as single runs; refusals."""
import csv
import io
import json
import os
import subprocess

from program import PROGRAM, check, fewer, new_folder, read_json, run, write

CASE = """title: a bar
mesh: {block: {size: [4, 1, 1], divisions: [6, 2, 2]}}
materials: [{region: wood, youngs_modulus: [1000, 2000, 4000], poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [2, 0, 0]}]
watch: {end: {displacement: {nearest: [4, 1, 1]}, component: x}}
sweep:
  loads.0.value.x: {from: 1, to: 3, count: 3}
  materials.all.E1: [500, 1000]
""".replace("region: wood", "region: all")

folder = new_folder()
write(folder, "bar.yaml", CASE)


def end_of(*settings):
    report = json.loads(run("solve", "bar.yaml", "--json", "-", "-o", "one.vtkhdf",
                            *(word for setting in settings for word in ("--set", setting)), folder=folder).output)
    return report["watched"]["end"]["value"]


for ranks in fewer((1, 2)):
    swept = run("sweep", "bar.yaml", "--csv", "bar.csv", "--json", "bar.json", ranks=ranks, folder=folder)
    check(swept.exit_code == 0 and "6 runs" in swept.output and "end" in swept.output, swept.output + swept.errors)
    with open(os.path.join(folder, "bar.csv")) as stream:
        rows = list(csv.DictReader(stream))
    report = read_json(folder, "bar.json")
    check([(row["loads.0.value.x"], row["materials.all.E1"]) for row in rows]
          == [(x, e) for x in ("1", "2", "3") for e in ("500", "1000")], rows)
    check(report["keys"] == ["loads.0.value.x", "materials.all.E1"] and report["watched"] == ["end"], report)
    for row, one in zip(rows, report["runs"]):
        check(float(row["end"]) == one["watched"]["end"] and one["answered"] and row["answered"] == "1", (row, one))
        check(one["values"] == {key: float(row[key]) for key in report["keys"]}, one)
    alone = end_of("loads.0.total_force.0=3", "materials.0.youngs_modulus.0=500")
    check(abs(rows[4]["end"] and float(rows[4]["end"]) - alone) < 1e-6 * abs(alone), (rows[4], alone))

# --over goes before the case's own; settings hold for all; the case may come from standard input
piped = subprocess.run([PROGRAM, "sweep", "-", "--over", "element.order=1,2", "--set", "loads.0.value.x=4", "--csv", "-"],
                       cwd=folder, input=CASE, capture_output=True, text=True, timeout=240)
rows = list(csv.DictReader(io.StringIO(piped.stdout)))
check(piped.returncode == 0 and [row["element.order"] for row in rows] == ["1", "2"], piped.stderr)
check(int(rows[1]["unknowns"]) > 5 * int(rows[0]["unknowns"]), rows)
alone = end_of("element.order=2", "loads.0.value.x=4")
check(abs(float(rows[1]["end"]) - alone) < 1e-5 * abs(alone), (rows, alone))

# a value may be a list or a mapping: commas within are its own
vectors = run("sweep", "bar.yaml", "--over", "loads.0.value=[1,0,0],[0,1,0]", "--json", "bar.json", folder=folder)
runs = read_json(folder, "bar.json")["runs"]
check([one["values"]["loads.0.value"] for one in runs] == ["[1,0,0]", "[0,1,0]"], vectors.errors)
for one, vector in zip(runs, ("[1,0,0]", "[0,1,0]")):
    alone = end_of("loads.0.value=" + vector)
    check(abs(one["watched"]["end"] - alone) < 1e-5 * abs(alone), (one, alone))

drawn = run("sweep", "bar.yaml", "-q", "--picture", "bar.png", folder=folder)
check(drawn.exit_code == 0, drawn.errors)
with open(os.path.join(folder, "bar.png"), "rb") as stream:
    check(stream.read(8) == b"\x89PNG\r\n\x1a\n", "no picture")

# Of two long keys the heads of columns say which is which; what all runs warn of is said once.
long = run("sweep", "bar.yaml", "--over", "materials.all.youngs_modulus.1=2000", "--over", "materials.all.youngs_modulus.2=4000,5000",
           "--set", "watch.end.displacement.nearest=[4, 1, 0.75]", folder=folder)
check("materials.all.youngs_modulus.1  materials.all.youngs_modulus.2 " in long.output, long.output)
check(long.exit_code == 0 and long.errors.count("'end' is taken at") == 1, long.errors)

# --- what fails, and what is refused ---
failed = run("sweep", "bar.yaml", "--over", "materials.0.poissons_ratio=0.3,0.6", "--json", "bar.json", folder=folder)
check(failed.exit_code == 1 and "1 of 2 runs have no answer" in failed.errors and "no answer" in failed.output, failed.errors)
with open(os.path.join(folder, "bar.json")) as stream:
    runs = json.load(stream)["runs"]
check([one["answered"] for one in runs] == [True, False] and "0.6" in runs[1]["failure"], runs)
for key, bad, good in (("materials.0.E1", "-1", "500"), ("constraints.0.on.boundary", "nowhere", "xmin")):  # found on reading, or in the mesh
    failed = run("sweep", "bar.yaml", "--over", f"{key}={bad},{good}", "--json", "bar.json", folder=folder)
    report = read_json(folder, "bar.json")
    check(failed.exit_code == 1 and "1 of 2 runs have no answer" in failed.errors, failed.errors)
    check([one["answered"] for one in report["runs"]] == [False, True] and report["runs"][1]["watched"]["end"] > 0, report)
for arguments, words in ((("--over", "loads.0.valu=1,2"), "unknown key 'valu'"),
                         (("--over", "materials.wod.E1=1,2"), "materials has no entry 'wod'"),
                         (("--over", "loads.0.value.x"), "--over takes KEY=a,b,c or KEY=from:to:count"),
                         (("--over", "loads.0.value.x=1,,2"), "--over takes KEY=a,b,c"),
                         (("--over", "loads.0.value.x=1:2"), "KEY=from:to:count"),
                         (("--over", "loads.0.value.x=1:2:9999", "--over", "loads.0.value.y=1:2:9999"), "at most 10000"),
                         (("--over", "loads.0.value=[1,0,0],[0,1,0"), "loads.0.value=[1,0,0],[0,1,0]; found"),
                         (("--over", "loads.0.value.x=1,2", "--over", "loads.0.total_force.0=3,4"),
                          "by two keys, loads.0.value.x=1 and loads.0.total_force.0=3"),
                         (("--over", "loads.0.value.x=1,2", "--over", "loads.0.value=[1,0,0],[0,1,0]"), "by two keys"),
                         (("--over", "element.order=1,2", "--over", "element={order: 1}"), "by two keys"),
                         (("--picture", "-"), "a picture cannot go to standard output"),
                         (("--picture", "bar.bmp"), "ends with .png, .svg or .pdf; found 'bar.bmp'"),
                         (("--picture", "bar"), "ends with .png, .svg or .pdf; found 'bar'"),
                         (("--csv", "bar.yaml"), "would be written over the case itself")):
    refused = run("sweep", "bar.yaml", *arguments, folder=folder)
    check(refused.exit_code == 2 and words in refused.errors, f"{arguments}: {refused.errors}")
write(folder, "plain.yaml", CASE.split("sweep:")[0] + "cases: [{name: one}]\n")
check("over what?" in run("sweep", "plain.yaml", folder=folder).errors, "a sweep over nothing")

# --- load cases: all of them for each value, in company as solve does, with quantities of their own ---
CASES = CASE.split("sweep:")[0] + """cases:
  - {name: pull}
  - {name: bend, loads: [{on: {boundary: xmax}, total_force: [0, 0, 0.1]}], watch: {rise: {displacement: {nearest: [4, 1, 1]}, component: z}}}
  - {name: twice, combine: {bend: 2}}
  - {name: moved, constraints: [{on: {boundary: xmin}, displacement: [0.01, 0, 0]}]}
"""
NAMES = ["pull", "bend", "twice", "moved"]
write(folder, "cases.yaml", CASES)
for ranks in fewer((1, 2)):
    swept = run("sweep", "cases.yaml", "--over", "materials.all.E1=500,1000", "--csv", "cases.csv", "--json", "cases.json",
                "--picture", "cases.png", ranks=ranks, folder=folder)
    check(swept.exit_code == 0 and "8 runs" in swept.output and "load case" in swept.output, swept.output + swept.errors)
    with open(os.path.join(folder, "cases.csv")) as stream:
        rows = list(csv.DictReader(stream))
    report = read_json(folder, "cases.json")
    check([(row["materials.all.E1"], row["load_case"]) for row in rows] == [(e, name) for e in ("500", "1000") for name in NAMES], rows)
    check(report["load_cases"] == NAMES and report["watched"] == ["end", "rise"], report)
    run("solve", "cases.yaml", "--set", "materials.all.E1=500", "--json", "solved.json", ranks=ranks, folder=folder)
    for one, solved in zip(report["runs"], read_json(folder, "solved.json")["cases"]):
        check(one["load_case"] == solved["load_case"] and one["iterations"] == solved["solver"]["iterations"], f"{one}, {solved}")
        for name, watched in one["watched"].items():
            alone = solved["watched"].get(name, {"value": None})["value"]
            check(watched == alone or abs(watched - alone) < 1e-9 * abs(alone), f"{one}, {solved['watched']}")
    check(rows[0]["rise"] == "" and float(rows[1]["rise"]) > 0, rows)

one = run("sweep", "cases.yaml", "--case", "bend", "--over", "loads.0.value.x=1,2", "--json", "bar.json", folder=folder)
report = read_json(folder, "bar.json")
check(one.exit_code == 0 and len(report["runs"]) == 2 and report["load_cases"] == [], one.errors)
failed = run("sweep", "cases.yaml", "--over", "materials.0.poissons_ratio=0.3,0.6", "--json", "bar.json", folder=folder)
runs = read_json(folder, "bar.json")["runs"]
check(failed.exit_code == 1 and [one["answered"] for one in runs] == 4 * [True] + 4 * [False], failed.errors)
check("run 5 of 8, load case pull has no answer" in failed.errors and "4 of 8 runs have no answer" in failed.errors, failed.errors)
for key, warned in (("cases.bend.loads.0.value.z", True), ("cases.1.loads.0.value.z", True), ("cases.pull.loads", False)):
    values = "[],[{on: {boundary: xmax}, total_force: [0, 1, 0]}]" if key.endswith("loads") else "1,2"
    one = run("sweep", "cases.yaml", "--case", "pull", "--over", f"{key}={values}", folder=folder)
    check(one.exit_code == 0 and (f"{key} is of the load case 'bend', and the sweep takes 'pull' alone" in one.errors) == warned, one.errors)
renamed = run("sweep", "cases.yaml", "--over", "cases.0.name=pull,push", folder=folder)
check("cannot change which load cases there are" in renamed.errors, renamed.errors)
