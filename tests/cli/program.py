"""Runs the program as a user would, for the tests of this folder."""
import atexit
import json
import os
import shutil
import subprocess
import sys
import tempfile

PROGRAM = os.environ["ORTHOSTAT_PROGRAM"]
MPIEXEC = os.environ.get("ORTHOSTAT_MPIEXEC", "mpirun")
SOURCE = os.environ["ORTHOSTAT_SOURCE"]
SANITIZED = "ORTHOSTAT_SANITIZED" in os.environ


class Finished:
    def __init__(self, process):
        self.exit_code = process.returncode
        self.output = process.stdout
        self.errors = process.stderr


def new_folder():
    """A folder that goes when the test ends, however it ends."""
    folder = tempfile.mkdtemp(prefix="orthostat-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def fewer(choices):
    """All of them; for sanitizers, which look at memory and not at numbers, the last one."""
    return choices[-1:] if SANITIZED else choices


def write(folder, name, content):
    """Writes a file, and returns its name."""
    with open(os.path.join(folder, name), "wb" if isinstance(content, bytes) else "w") as stream:
        stream.write(content)
    return name


def read_json(folder, name):
    with open(os.path.join(folder, name)) as stream:
        return json.load(stream)


def run(*arguments, ranks=1, folder=None, timeout=240, program=PROGRAM):
    """On two ranks at most with sanitizers: more than the cores would wait for each other."""
    command = [program, *map(str, arguments)]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(min(ranks, 2) if SANITIZED else ranks), *command]
    for _ in range(3):
        process = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True, timeout=timeout)
        if "session_dir.c" not in process.stderr: # else the mpirun before was still removing its folder: nothing began
            break
    return Finished(process)


def solve(case_text, ranks=1, folder=None, name="case.yaml", extra=()):
    """Writes a case, solves it, and returns (finished, json or None, path of the result)."""
    folder = folder or new_folder()
    write(folder, name, case_text)
    summary = os.path.join(folder, "summary.json")
    result = os.path.join(folder, f"result-{ranks}.vtkhdf")
    finished = run("solve", name, "--output", result, "--json", summary, *extra, ranks=ranks, folder=folder)
    report = None
    if finished.exit_code == 0:
        report = read_json(folder, "summary.json")
    return finished, report, result


def read_points(path, array="displacement", step=None):
    """{label: vector} of a point array, with VTK's own reader; of a step, from 0, as scripts/render takes it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    if step is not None:
        sys.path.insert(0, os.path.join(SOURCE, "scripts"))
        from rendering import steps
        steps.take(reader.GetOutput(), path, step)
    data = reader.GetOutput().GetPointData()
    labels = vtk_to_numpy(data.GetArray("vertex"))
    values = vtk_to_numpy(data.GetArray(array))
    return dict(zip(labels.tolist(), values))


def check(condition, message):
    if not condition:
        raise SystemExit("FAILED: " + message)
