"""Load cases as a user meets them: a file for each, a list and a table, the same answers as one run for each; errors of one case
and refusals; --set, --case and a case from standard input."""
import csv
import json
import os
import subprocess

from program import MPIEXEC, PROGRAM, check, fewer, new_folder, read_points, run

CASE = """title: a beam
mesh: {block: {size: [6, 1, 1], divisions: [12, 2, 2]}}
materials: [{region: all, youngs_modulus: [1000, 80, 50], poissons_ratio: 0.3, density: 1}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
accuracy: {relative_residual: 1e-11}
watch: {end: {displacement: {nearest: [6, 1, 1]}, component: z}}
cases:
  - name: weight
    loads: [{gravity: [0, 0, -0.01]}]
  - name: push
    loads: [{on: {boundary: xmax}, total_force: [0, 0.01, 0]}]
    watch: {held: {reaction: {boundary: xmin}, component: y}}
  - name: far
    loads: [{on: {boundary: xmax}, total_force: [0, 0, 5]}]
  - name: propped
    constraints: [{on: {boundary: xmax}, displacement: [free, free, -0.02]}]
output: {file: beam.vtkhdf}
"""
NAMES = ("weight", "push", "far", "propped")


def folder_with(text, name="beam.yaml"):
    folder = new_folder()
    with open(os.path.join(folder, name), "w") as stream:
        stream.write(text)
    return folder


def load(folder, name):
    with open(os.path.join(folder, name)) as stream:
        return json.load(stream)


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(abs(a), abs(b))


# --- all cases, and each of them alone ---
for ranks in fewer((1, 2, 4)):
    folder = folder_with(CASE)
    finished = run("solve", "beam.yaml", "--json", "beam.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 0 and "4 load cases" in finished.output, finished.output + finished.errors)
    report = load(folder, "beam.json")
    series = load(folder, "beam.hdf.series")
    check([entry["name"] for entry in series["files"]] == [f"beam_{name}.vtkhdf" for name in NAMES], series)
    check([entry["time"] for entry in series["files"]] == [1, 2, 3, 4], series)
    with open(os.path.join(folder, "beam_cases.csv")) as stream:
        rows = list(csv.DictReader(stream))
    check([row["case"] for row in rows] == list(NAMES) == [one["load_case"] for one in report["cases"]], rows)
    check(report["accepted"] and "ledger" in report and "ledger" not in report["cases"][0], list(report))
    check(not os.path.exists(os.path.join(folder, "beam.vtkhdf")), "a file of one answer stands beside those of the cases")
    for name, row, one in zip(NAMES, rows, report["cases"]):
        alone = run("solve", "beam.yaml", "--case", name, "--json", "one.json", "-o", "one.vtkhdf", "-q", folder=folder)
        check(alone.exit_code == 0, alone.errors)
        single = load(folder, "one.json")
        check(one["title"] == single["title"] == "a beam: " + name and one["output"] == f"beam_{name}.vtkhdf", one["title"])
        check(set(one) == set(single) - {"ledger"} | {"load_case"}, set(one) ^ set(single))
        for key in one["watched"]:
            check(close(one["watched"][key]["value"], single["watched"][key]["value"], 1e-6), (name, key))
            check(float(row[key]) == one["watched"][key]["value"], row)
        check(one["large_rotation"]["newton"] == single["large_rotation"]["newton"] == (name == "far"), name)
        check(close(one["answer_error"]["relative"], single["answer_error"]["relative"], 0.03), name)
        check(row["held"] == "" if name != "push" else close(float(row["held"]), -0.01, 1e-6), row)
        together = read_points(os.path.join(folder, f"beam_{name}.vtkhdf"))
        apart = read_points(os.path.join(folder, "one.vtkhdf"))
        check(max(abs(together[v] - apart[v]).max() for v in apart) <= 1e-6 * single["largest_displacement"], name)

# --- what is wrong with one case ---
stretched = CASE.replace("title: a beam", "title: a beam\nsolver: {method: metric, coarsest_unknowns: 60, max_iterations: 3}")
folder = folder_with(stretched.replace("total_force: [0, 0.01, 0]", "total_force: [0, 0, 0]"))
finished = run("solve", "beam.yaml", "--json", "beam.json", "-q", folder=folder)
check(finished.exit_code == 1 and "3 of 4 load cases have no answer, and nothing of them was written:" in finished.errors
      and "\n  weight: " in finished.errors, finished.errors)
report = load(folder, "beam.json")
check([one["accepted"] for one in report["cases"]] == [False, True, False, False] and not report["accepted"], report)
check(sorted(os.listdir(folder)) == ["beam.hdf.series", "beam.json", "beam.yaml", "beam_cases.csv", "beam_push.vtkhdf"],
      os.listdir(folder))
finished = run("solve", "beam.yaml", "--keep", folder=folder)
check(finished.exit_code == 1 and "4 files" in finished.output and "NO ANSWER" in finished.output, finished.output)
check(os.path.exists(os.path.join(folder, "beam_weight.vtkhdf")), "--keep kept nothing")

# --- check, and what is refused ---
folder = folder_with(CASE)
sound = run("check", "beam.yaml", folder=folder)
check(sound.exit_code == 0 and "4 load cases beside beam.vtkhdf" in sound.output, sound.output + sound.errors)
check("load cases           4" in run("explain", "beam.yaml", folder=folder).output, "explain says nothing of load cases")
for arguments, words in ((("effects", "beam.yaml"), "there are 4 load cases, and this command takes one: name it, as in --case weight"),
                         (("cost", "beam.yaml"), "name it, as in --case weight"),
                         (("solve", "beam.yaml", "--case", "pull"), "did you mean 'push'?"),
                         (("check", "beam.yaml", "--set", "cases.push.constraints=[{on: {boundary: nowhere}, slide: [1, 0, 0]}]"),
                          "nowhere"),
                         (("check", "beam.yaml", "--set", "cases.push.name=weight"), "the load case 'weight' is there already"),
                         (("check", "beam.yaml", "--set", "path.steps=3"), "leave out 'cases' or 'path'"),
                         (("solve", "beam.yaml", "--resume"), "--resume goes on with a path"),
                         (("verify", "beam.yaml", "--case", "push"), "State the load of 'push' in a case of its own"),
                         (("check", "beam.yaml", "--set", "loads"), "expected KEY=VALUE")):
    refused = run(*arguments, folder=folder)
    check(refused.exit_code == 2 and words in refused.errors, f"{arguments}: {refused.errors}")

# --- files of another form ---
other = run("solve", "beam.yaml", "-q", "-o", "xml.pvtu", folder=folder)
check(other.exit_code == 0, other.errors)
with open(os.path.join(folder, "xml.pvd")) as stream:
    listed = stream.read()
for number, name in enumerate(NAMES, 1):
    check(f'timestep="{number}" file="xml_{name}.pvtu"' in listed and os.path.exists(os.path.join(folder, f"xml_{name}.pvtu")),
          listed)
check(os.path.exists(os.path.join(folder, "xml_cases.csv")), os.listdir(folder))

# --- settings, and standard input ---
changed = run("solve", "beam.yaml", "--set", "cases.weight.loads.0.value.z=-0.02", "--set", "large_rotation=off",
              "--case", "weight", "--json", "-", folder=folder)
single = json.loads(changed.output)
plain = json.loads(run("solve", "beam.yaml", "--set", "large_rotation=off", "--case", "weight", "--json", "-",
                       folder=folder).output)
check(close(single["watched"]["end"]["value"], 2 * plain["watched"]["end"]["value"], 1e-8), (single, plain))
os.mkdir(os.path.join(folder, "elsewhere"))
for command in ([PROGRAM], [MPIEXEC, "--quiet", "-n", "2", PROGRAM]):
    piped = subprocess.run([*command, "solve", "-", "--case", "push", "-q", "--set", "output.file=piped.vtkhdf"],
                           cwd=os.path.join(folder, "elsewhere"), input=CASE, capture_output=True, text=True, timeout=240)
    check(piped.returncode == 0, piped.stderr)
    check(os.listdir(os.path.join(folder, "elsewhere")) == ["piped.vtkhdf"], os.listdir(os.path.join(folder, "elsewhere")))
wrong = subprocess.run([PROGRAM, "check", "-", "--set", "mesh={file: bar.msh}"], cwd=folder, input=CASE, capture_output=True,
                       text=True, timeout=240)
check(wrong.returncode == 2 and "stdin:2:7: bar.msh: cannot be read" in wrong.stderr, wrong.stderr)

# --- an early stop: the answer's error stands first, and a residual that says nothing of it is told to those who ask ---
early = CASE.replace("accuracy: {relative_residual: 1e-11}\n", "").replace("[12, 2, 2]", "[60, 10, 10]")
folder = folder_with(early)
short = run("solve", "beam.yaml", "--case", "weight", folder=folder).output
whole = run("solve", "beam.yaml", "--case", "weight", "-v", folder=folder).output
check("  stopped " in short and "residual" not in short, short)
check(0 < short.find("  accuracy ") < short.find("  solver "), short)
check("of the loads (true, recomputed)" in whole and "hardly move anything" in whole and "tet by tet" in whole, whole)
