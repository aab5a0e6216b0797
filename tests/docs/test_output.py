"""Every field, summary line and JSON key that solve writes stands in docs/output.md."""
import json
import os
import re

from pages import check, code_of, has_word, new_folder, read, run

CASE = """
title: everything at once
mesh: {block: {size: [1, 1, 1], divisions: [3, 3, 3]}}
materials: [{region: all, youngs_modulus: [1e6, 2e6, 3e6], poissons_ratio: 0.3, axes: {euler: {degrees: [10, 20, 30]}},
   strengths: {tension: 1e5, shear: 5e4}}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, traction: [1e6, 0, 0]}]
watch: {end: {displacement: {nearest: [1, 0, 0]}, component: x}}
"""


WORDS = re.findall(r'X\(OST_FIELD_\w+, "(\w+)"\)', read("include", "orthostat", "output_field.h"))


def keys_of(value, free=("watched",)):
    """All keys, but not those that the case itself names."""
    if isinstance(value, list):
        return {key for item in value for key in keys_of(item)}
    if not isinstance(value, dict):
        return set()
    return {key for name, item in value.items()
            for key in {name} | (keys_of(list(item.values())) if name in free else keys_of(item))}


code = code_of(read("docs", "output.md"))
folder = new_folder()
with open(os.path.join(folder, "case.yaml"), "w") as stream:
    stream.write(CASE + "buckling: {modes: 3}\n")
with open(os.path.join(folder, "linear.yaml"), "w") as stream:
    stream.write(CASE.replace("0.3", "0.5") + "element: {order: 2}\nlarge_rotation: off\noutput: {fields: ["
                 + ", ".join(WORDS) + "]}\n")  # incompressible: with the pressure of a mixed form
labels = []
for case in "case.yaml", "linear.yaml":
    finished = run("solve", case, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    labels += re.findall(r"^  (\S.*?)  +\S", finished.output.split("\nledger")[0], re.M)
check({"residual", "newton", "WARNING"} <= set(labels), f"the summary has changed its form: {labels}")
missing = sorted(label for label in set(labels) if label not in code)
check(not missing, f"docs/output.md says nothing of the summary's lines {missing}")

run("solve", "case.yaml", "-q", "--json", "summary.json", folder=folder)
with open(os.path.join(folder, "summary.json")) as stream:
    keys = keys_of(json.load(stream))
check({"solver", "iterations", "largest_rotation", "peak_bytes"} <= keys, f"keys: {sorted(keys)}")
missing = sorted(key for key in keys if not has_word(code, key))
check(not missing, f"docs/output.md says nothing of the JSON keys {missing}")
for command in ("check", "explain"):
    report = json.loads(run(command, "case.yaml", "--json", folder=folder).output)
    missing = sorted(key for key in keys_of(report) if not has_word(code, key))
    check(not missing, f"docs/output.md says nothing of {command}'s JSON keys {missing}")

with open(os.path.join(folder, "path.yaml"), "w") as stream:
    stream.write(CASE + "path: {steps: 2}\nlarge_rotation: off\n")
finished = run("solve", "path.yaml", "--json", "path.json", folder=folder)
check(finished.exit_code == 0, finished.errors)
with open(os.path.join(folder, "path.json")) as stream:
    keys = keys_of(json.load(stream)["steps"])
with open(os.path.join(folder, "path_history.csv")) as stream:
    keys |= {name.strip('"') for name in stream.readline().split(",")[:-1]}
check({"newton_iterations", "load_factor"} <= keys, f"keys: {sorted(keys)}")
missing = sorted(key for key in keys if not has_word(code, key))
check(not missing, f"docs/output.md says nothing of {missing}, which solve writes of a path")

from vtkmodules.vtkIOHDF import vtkHDFReader  # noqa: E402

rows = {name: (on, components) for name, on, components in
        re.findall(r"^\| `(\w+)` \| (points|cells) \| (\d)", read("docs", "output.md"), re.M)}
written = set()
for name in "case", "linear":
    reader = vtkHDFReader()
    reader.SetFileName(os.path.join(folder, name + ".vtkhdf"))
    reader.Update()
    for on, data in (("points", reader.GetOutput().GetPointData()), ("cells", reader.GetOutput().GetCellData())):
        for i in range(data.GetNumberOfArrays()):
            found = (on, str(data.GetArray(i).GetNumberOfComponents()))
            written.add(data.GetArrayName(i))
            check(rows.get(data.GetArrayName(i)) == found,
                  f"docs/output.md does not have {data.GetArrayName(i)} on {found[0]} with {found[1]} components")
check(set(rows) == written, f"docs/output.md has fields that are not in the files: {sorted(set(rows) - written)}")

# Of small rotations, the field of strains is the tensor that VTK itself makes of the displacement, so that principal strains are right.
from vtkmodules.vtkFiltersGeneral import vtkCellDerivatives  # noqa: E402

grid = reader.GetOutput()
grid.GetPointData().SetActiveVectors("displacement")
derivatives = vtkCellDerivatives()
derivatives.SetInputData(grid)
derivatives.SetVectorModeToPassVectors()
derivatives.SetTensorModeToComputeStrain()
derivatives.Update()
expected = derivatives.GetOutput().GetCellData().GetTensors()
written = grid.GetCellData().GetArray("strain_tensor")
largest = max(abs(x) for tet in range(grid.GetNumberOfCells()) for x in expected.GetTuple(tet))
for tet in range(grid.GetNumberOfCells()):
    whole = expected.GetTuple(tet)
    for value, place in zip(written.GetTuple(tet), (0, 4, 8, 1, 5, 2)):
        check(abs(value - whole[place]) < 1e-9 * largest, f"strain of tet {tet}: {written.GetTuple(tet)}, VTK: {whole}")
