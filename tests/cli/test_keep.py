"""A result that is no answer is not written; with --keep it is, and says everywhere that it is none."""
import os
import subprocess

from matplotlib.image import imread

from program import SOURCE, check, fewer, new_folder, read_json, run, write

CASE = """title: a block that is given too few iterations
mesh:
  block: {size: [4, 1, 1], divisions: [24, 6, 6]}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [0, 0, -1]}
solver: {method: plain, max_iterations: MOST}
"""


def field_data(path):
    from vtkmodules.vtkIOHDF import vtkHDFReader
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput().GetFieldData()
    return {data.GetArrayName(a): data.GetArray(a).GetTuple(0) for a in range(data.GetNumberOfArrays())}


def draw(result):
    """Is the picture marked, and is that said? The same of one rank's file as of several's."""
    picture = result + ".png"
    done = subprocess.run([os.path.join(SOURCE, "scripts", "render"), result, picture, "--size", "600x400"],
                          capture_output=True, text=True, timeout=120)
    check(done.returncode == 0, done.stderr)
    top = imread(picture)[:50, :, :3]
    red = (top[:, :, 0] > 0.6) & (top[:, :, 1] < 0.3) & (top[:, :, 2] < 0.3)
    return bool(red.any()), "marked as unfinished, no answer" in done.stdout


def write_case(folder, most):
    write(folder, "case.yaml", CASE.replace("MOST", str(most)))


def without_keep(folder, ranks):
    write_case(folder, 2)
    write(folder, "case.vtkhdf", "precious")
    finished = run("solve", "case.yaml", "--json", "summary.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 1, f"exit status {finished.exit_code}: {finished.errors}")
    check("2 iterations" in finished.errors and "--keep" in finished.errors, finished.errors)
    check(finished.errors.count("orthostat: error:") == 1, f"one message wanted: {finished.errors}")
    with open(os.path.join(folder, "case.vtkhdf")) as stream:
        check(stream.read() == "precious", "the existing output was touched")
    check(not os.path.exists(os.path.join(folder, "summary.json")), "a summary was written")


def with_keep(folder, ranks):
    finished = run("solve", "case.yaml", "--keep", "--json", "summary.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 1, f"exit status {finished.exit_code}: {finished.errors}")
    check("NO ANSWER" in finished.output and "marked as unfinished" in finished.output, finished.output)
    report = read_json(folder, "summary.json")
    check(report["accepted"] is False and report["status"] == "unfinished", f"{report['status']}")
    check("2 iterations" in report["reasons"][0], f"{report['reasons']}")
    check(report["checks"]["relative_residual"] > 1e-8, "the residual is that of an answer")
    result = os.path.join(folder, "case.vtkhdf")
    check(field_data(result) == {"refused": (1.0,), "unfinished": (1.0,)}, f"the file is not marked: {field_data(result)}")
    with open(result, "rb") as stream:
        check(b"unfinished" in stream.read(), "the file does not say what it is")
    check(ranks > 1 or draw(result) == (True, True), "the picture does not say what it shows")


def an_answer(folder, ranks):
    write_case(folder, 500)
    finished = run("solve", "case.yaml", "--keep", "--json", "summary.json", ranks=ranks, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    report = read_json(folder, "summary.json")
    check(report["accepted"] is True and report["reasons"] == [], "an answer is called none")
    result = os.path.join(folder, "case.vtkhdf")
    check(field_data(result) == {}, "an answer is marked")
    check(ranks > 1 or draw(result) == (False, False), "the picture of an answer is marked")


def main():
    for ranks in fewer((1, 2)):
        folder = new_folder()
        without_keep(folder, ranks)
        with_keep(folder, ranks)
        an_answer(folder, ranks)


main()
