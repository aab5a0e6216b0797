# SPDX-License-Identifier: BSD-3-Clause
"""Which files are drawn: results, lists of them, steps of them, and cases, which are solved first."""
import json
import os
import subprocess
from xml.etree import ElementTree

from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

from . import steps
from .common import Refusal

SCRIPTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.environ.get("ORTHOSTAT_PROGRAM", os.path.join(SCRIPTS, "orthostat"))
RESULTS = (".vtkhdf", ".hdf", ".vtu", ".pvtu")
LISTS = (".pvd", ".series")


def ending(path):
    return os.path.splitext(path)[1].lower()


def solve(case, folder):
    """The result of a case, on all cores; of a path its last step, of load cases the last."""
    if not os.path.isfile(case):
        raise Refusal(f"{case}: there is no such file")
    result = os.path.join(folder, os.path.splitext(os.path.basename(case))[0] + ".vtkhdf")
    done = subprocess.run([PROGRAM, "solve", case, "--output", result], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    files = sorted(os.path.join(folder, name) for name in os.listdir(folder) if name.endswith(".vtkhdf"))
    if done.returncode != 0 or not files:
        raise Refusal(f"{case} could not be solved:\n{done.stdout.strip()}")
    return (each_step(result) if result in files else files)[-1]


def listed(path):
    """The files of a list for ParaView."""
    try:
        if ending(path) == ".pvd":
            names = [one.get("file") for one in ElementTree.parse(path).iter("DataSet")]
        else:
            with open(path, encoding="utf-8") as stream:
                names = [one["name"] for one in json.load(stream)["files"]]
    except (OSError, ValueError, KeyError, TypeError, ElementTree.ParseError) as failure:
        raise Refusal(f"{path}: cannot be read as a list of results: {failure}")
    return [os.path.join(os.path.dirname(path), name) for name in names]


def each_step(path):
    """The files of a list; the steps of a file, as FILE:STEP; the file itself where it has none, or names one."""
    if ending(path) in LISTS:
        return listed(path)
    names = None if steps.split(path)[1] or not path.lower().endswith(steps.ENDINGS) else steps.names(path)
    return [f"{path}:{name}" for name in names] if names else [path]


def read_step(path):
    """The grid of FILE:STEP."""
    name, step = steps.split(path)
    if step is None:
        return read_grid(path)
    grid = read_grid(name)
    names = steps.names(name)
    if not names or step not in names:
        raise Refusal(f"{name}: has no step '{step}'; it has {', '.join(names) if names else 'none'}")
    steps.take(grid, name, names.index(step))
    return grid


def read_grid(path):
    if not os.path.isfile(path):
        raise Refusal(f"{path}: there is no such file")
    vtkObject.GlobalWarningDisplayOff()
    reader = {".vtu": vtkXMLUnstructuredGridReader, ".pvtu": vtkXMLPUnstructuredGridReader}.get(ending(path), vtkHDFReader)()
    reader.SetFileName(path)
    if not reader.CanReadFile(path):
        kind = "VTKHDF" if isinstance(reader, vtkHDFReader) else "VTK"
        raise Refusal(f"{path}: not a {kind} file; expected a result of 'orthostat solve'")
    reader.Update()
    if reader.GetOutput().GetNumberOfCells() == 0:
        raise Refusal(f"{path}: holds no cells, or is damaged")
    return reader.GetOutput()
