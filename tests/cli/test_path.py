"""A path as a user meets it: a file a step that VTK reads, the list of them, the history and its picture, the table and JSON; and a run
that is killed at any moment and resumed leaves the same bytes as one that was not."""
import csv
import os
import random
import shutil
import signal
import subprocess
import time

from program import MPIEXEC, PROGRAM, SANITIZED, SOURCE, check, fewer, new_folder, read_json, read_points, run, write

CASE = """title: a bar that is pulled and let go
mesh: {block: {size: [4, 1, 1], divisions: [12, 4, 4]}}
materials: [{region: all, youngs_modulus: [1000, 2000, 4000], poissons_ratio: 0.3}]
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
  - {on: {nearest: [4, 0, 0]}, displacement: [free, free, 0.01], time: [[0, 0], [1, 1]]}
loads: [{on: {boundary: xmax}, total_force: [2, 0, 0], time: [[0, 0], [0.5, 1], [1, 0]]}]
path: {times: [0.25, 0.5, 0.75, 1]}
large_rotation: on
solver: {method: metric}
watch:
  end: {displacement: {nearest: [4, 1, 1]}, component: x}
  held: {reaction: {boundary: xmin}, component: x}
output: {file: bar.vtkhdf}
"""
if SANITIZED:
    CASE = CASE.replace("[12, 4, 4]", "[6, 2, 2]")
NAMES = [f"bar_{k:04d}.vtkhdf" for k in range(1, 5)] + ["bar.hdf.series", "bar_history.csv"]


def folder_with_case(text=CASE):
    folder = new_folder()
    write(folder, "bar.yaml", text)
    return folder


def contents(folder):
    found = {}
    for name in NAMES:
        with open(os.path.join(folder, name), "rb") as stream:
            found[name] = stream.read()
    return found


# --- an uninterrupted run ---
whole = folder_with_case()
finished = run("solve", "bar.yaml", "--json", "bar.json", folder=whole)
check(finished.exit_code == 0, finished.errors)
check("path of 4 steps" in finished.output and "bar.hdf.series" in finished.output, finished.output)
check(not os.path.exists(os.path.join(whole, "bar.vtkhdf")), "a file of one answer was written beside those of the steps")
report = read_json(whole, "bar.json")
series = read_json(whole, "bar.hdf.series")
check(series["file-series-version"] == "1.0", series)
check([entry["time"] for entry in series["files"]] == [0.25, 0.5, 0.75, 1], series)
with open(os.path.join(whole, "bar_history.csv")) as stream:
    rows = list(csv.DictReader(stream))
check(len(rows) == len(report["steps"]) == 4, rows)
label = 7 * 9 if SANITIZED else 13 * 25  # of the vertex (4, 1, 1)
for entry, row, step, factor in zip(series["files"], rows, report["steps"], (0.5, 1, 0.5, 0)):
    u = read_points(os.path.join(whole, entry["name"]))
    check(float(row["t"]) == step["t"] == entry["time"], (row, step))
    check(float(row["load_factor_1"]) == entry["time"] and float(row["load_factor_2"]) == factor, row)
    check(float(row["end"]) == step["watched"]["end"] == u[label][0], (row, step, u[label]))
    check(abs(float(row["held"]) + 2 * factor) < 1e-6, row)
    check(float(row["strain_energy"]) == step["strain_energy"] > 0, row)
check(report["steps"][3]["watched"]["held"] == report["watched"]["held"]["value"], report["watched"])
truth = contents(whole)

quiet = run("solve", "bar.yaml", "-q", folder=whole)
check(quiet.exit_code == 0 and quiet.output == quiet.errors == "", quiet.output + quiet.errors)
check(contents(whole) == truth, "a second run left other bytes")
again = run("solve", "bar.yaml", "--resume", folder=whole)
check(again.exit_code == 0 and "3 of 4 steps are done" in again.errors, again.errors)
check(contents(whole) == truth, "the last step taken again left other bytes")

# --- killed at any moment, on one rank and on two ---
generator = random.Random(7)


def kill_and_resume(ranks, seconds):
    """Kills run after run at a random moment, each after one more step than the last, until one ends."""
    folder = folder_with_case()
    command = [PROGRAM, "solve", "bar.yaml", "-q", "--resume"]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    for killed in range(20):
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        while killed > 0 and process.poll() is None and not os.path.exists(os.path.join(folder, NAMES[min(killed, 4) - 1])):
            time.sleep(0.002)
        try:
            process.wait(timeout=0.2 * seconds * generator.random())
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            time.sleep(0.05)
            continue
        check(process.returncode == 0, f"a resumed run on {ranks} ranks ended with {process.returncode}")
        return folder, killed
    done = run("solve", "bar.yaml", "-q", "--resume", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    return folder, 20


for ranks in fewer((1, 2)):
    start = time.monotonic()
    expected = truth
    if ranks > 1:
        other = folder_with_case()
        done = run("solve", "bar.yaml", "-q", ranks=ranks, folder=other)
        check(done.exit_code == 0, done.errors)
        expected = contents(other)
    else:
        run("solve", "bar.yaml", "-q", folder=whole)
    folder, killed = kill_and_resume(ranks, time.monotonic() - start)
    check(killed > 0, "no run was killed")
    found = contents(folder)
    for name in NAMES:
        check(found[name] == expected[name], f"{name} has other bytes after {killed} kills on {ranks} ranks")

# --- by linear theory, with a pressure as an unknown or without ---
LINEAR = CASE.replace("large_rotation: on", "large_rotation: off").replace("[12, 4, 4]", "[6, 2, 2]")
for text in (LINEAR, LINEAR.replace("ratio: 0.3", "ratio: 0.5") + "element: {order: 2}\n", LINEAR + "accuracy: {relative_residual: 1e-9}\n"):
    for ranks in fewer((1, 2)):
        folder = folder_with_case(text)
        done = run("solve", "bar.yaml", "-q", ranks=ranks, folder=folder)
        check(done.exit_code == 0, done.errors)
        expected = contents(folder)
        done = run("solve", "bar.yaml", "--resume", ranks=ranks, folder=folder)
        check(done.exit_code == 0 and "3 of 4 steps are done" in done.errors, done.errors)
        check(contents(folder) == expected, f"a linear path that was resumed on {ranks} ranks left other bytes")
        check("is not there" not in done.errors, done.errors)
    done = run("solve", "bar.yaml", "--resume", "-o", "bar.vtu", folder=folder)
    check(done.exit_code == 0 and "step 1 of the path is done, but its file bar_0001.vtu is not there" in done.errors, done.errors)

# --- what is refused ---
for text, ranks, words in ((CASE.replace("large_rotation: on", "large_rotation: on\nformulation: classical"), 2,
                            "it was made with formulation: consistent, and this run has formulation: classical"),
                           (CASE + "# changed\n", 1, "the case file has changed since")):
    write(whole, "bar.yaml", text)
    refused = run("solve", "bar.yaml", "--resume", ranks=ranks, folder=whole)
    check(refused.exit_code == 2 and words in refused.errors, refused.errors)
check(contents(whole) == truth, "a refused run left other bytes")
still = folder_with_case(CASE.replace("path: {times: [0.25, 0.5, 0.75, 1]}\n", "").replace(", time: [[0, 0], [1, 1]]", "")
                         .replace(", time: [[0, 0], [0.5, 1], [1, 0]]", ""))
refused = run("solve", "bar.yaml", "--resume", folder=still)
check(refused.exit_code == 2 and "--resume goes on with a path, and the case has none" in refused.errors, refused.errors)
shutil.copy(os.path.join(whole, "bar_0001.vtkhdf"), os.path.join(still, "bar_0002.vtkhdf"))
write(still, "bar.yaml", CASE.replace(CASE.splitlines()[1], "mesh: {file: bar_0002.vtkhdf}"))
refused = run("solve", "bar.yaml", folder=still)
check(refused.exit_code == 2 and "would be written over the mesh that the case reads" in refused.errors, refused.errors)

# --- the picture ---
for extra in ((), ("--x", "end", "--y", "held")):
    drawn = subprocess.run([os.path.join(SOURCE, "scripts", "plot-history"), "bar_history.csv", "bar.png", *extra], cwd=whole,
                           capture_output=True, text=True)
    check(drawn.returncode == 0, drawn.stderr)
    with open(os.path.join(whole, "bar.png"), "rb") as stream:
        check(stream.read(8) == b"\x89PNG\r\n\x1a\n", "no picture")
drawn = subprocess.run([os.path.join(SOURCE, "scripts", "plot-history"), "bar_history.csv", "bar.png", "--x", "tip"], cwd=whole,
                       capture_output=True, text=True)
check(drawn.returncode != 0 and "'tip'" in drawn.stderr and "end, held" in drawn.stderr, drawn.stderr)
