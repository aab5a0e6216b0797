"""Fields that users plot, against formulas, and files that VTK's and meshio's readers open: each vertex once on any number of ranks."""
import json
import math
import os
import sys

import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

from program import check, fewer, new_folder, run, write

E, NU = (11e9, 0.9e9, 0.5e9), 0.3
TENSION, COMPRESSION, SHEAR = (80e6, 3e6, 3e6), (45e6, 6e6, 6e6), (8e6, 3e6, 8e6)
ANGLE, PULL = 30.0, 1e6
FIELDS = ("displacement stress strain_tensor axes region rank material_stress material_strain_tensor von_mises pressure principal_stress "
          "principal_direction_1 principal_direction_2 principal_direction_3 principal_strain e1 e2 e3 tsai_wu_load_factor "
          "hill_load_factor maximum_stress_load_factor").split()
CASE = f"""
mesh: {{block: {{size: [4, 1, 1], divisions: [6, 2, 2]}}}}
materials:
  - region: all
    youngs_modulus: {list(E)}
    poissons_ratio: {NU}
    axes: {{euler: {{degrees: [{ANGLE}, 0, 0]}}}}
    strengths: {{tension: {list(TENSION)}, compression: {list(COMPRESSION)}, shear: {{S12: 8e6, S32: 3e6, S13: 8e6}}}}
constraints:
  - {{on: {{boundary: xmin}}, displacement: [0, free, free]}}
  - {{on: {{nearest: [0, 0, 0]}}, displacement: [0, 0, 0]}}
  - {{on: {{nearest: [0, 1, 0]}}, displacement: [free, free, 0]}}
loads: [{{on: {{boundary: xmax}}, traction: [{PULL}, 0, 0]}}]
large_rotation: off
"""
OUTPUT = f"output: {{fields: [{', '.join(FIELDS)}]}}\n"
folder = new_folder()


def solve(case, output, ranks=1, *more):
    finished = run("solve", case, "-o", output, "--json", "summary.json", *more, ranks=ranks, folder=folder)
    check(finished.exit_code == 0, f"{output} on {ranks} ranks: {finished.errors}")
    with open(os.path.join(folder, "summary.json")) as stream:
        return finished, json.load(stream)


def read(name):
    reader = vtkXMLPUnstructuredGridReader() if name.endswith(".pvtu") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(folder, name))
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    """{name: values by label}"""
    found = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    order = np.argsort(found["tet" if "tet" in found else "vertex"])
    return {name: values[order] for name, values in found.items()}


def near(found, expected, what, tolerance=1e-8):
    found = np.asarray(found)
    size = max(np.abs(expected).max(), 1e-300) if np.ndim(expected) else abs(expected)
    check(np.abs(found - expected).max() <= tolerance * size, f"{what}: {found.reshape(-1)[:6]}, expected {expected}")


# Uniform tension at 30 degrees to the fibre: the stress along the axes, and what follows from it, is known.
write(folder, "tension.yaml", CASE + OUTPUT)
finished, report = solve("tension.yaml", "one.vtu")
c, s = math.cos(math.radians(ANGLE)), math.sin(math.radians(ANGLE))
own = np.array([PULL * c * c, PULL * s * s, 0, -PULL * c * s, 0, 0])
points, cells = arrays(read("one.vtu").GetPointData()), arrays(read("one.vtu").GetCellData())
check(set(FIELDS) | {"tet", "vertex"} == set(points) | set(cells), f"fields: {sorted(points)} {sorted(cells)}")
near(cells["stress"], np.array([PULL, 0, 0, 0, 0, 0]), "stress")
near(cells["material_stress"], own, "material_stress")
near(cells["von_mises"], PULL, "von_mises")
near(cells["pressure"], -PULL / 3, "pressure")
near(cells["principal_stress"], np.array([PULL, 0, 0]), "principal_stress")
near(cells["principal_direction_1"], np.array([1, 0, 0]), "principal_direction_1")
for k in range(3):
    near(cells[f"e{k + 1}"], cells["axes"][:, 3 * k:3 * k + 3], f"e{k + 1}", 0)
near(cells["e1"], np.array([c, s, 0]), "e1", 1e-15)
nu12 = NU * math.sqrt(E[0] / E[1])
g12 = math.sqrt(E[0] * E[1]) / (2 * (1 + NU))
near(cells["material_strain_tensor"][:, :2], np.array([own[0] / E[0] - nu12 / E[0] * own[1], own[1] / E[1] - nu12 / E[0] * own[0]]),
     "material_strain_tensor 11 22")
near(cells["material_strain_tensor"][:, 3], own[3] / (2 * g12), "material_strain_tensor 12, half the engineering shear")
middle = 0.5 * (cells["strain_tensor"][:, 0] + cells["strain_tensor"][:, 1])
near(cells["principal_strain"].sum(1), cells["strain_tensor"][:, :3].sum(1)[0], "the sum of principal strains")
check((cells["principal_strain"][:, 0] >= middle).all(), "the largest principal strain is not the largest")

# Tsai and Wu's f: the root of a f^2 + b f = 1.
f1, f2, f11, f22 = 1 / 80e6 - 1 / 45e6, 1 / 3e6 - 1 / 6e6, 1 / (80e6 * 45e6), 1 / (3e6 * 6e6)
a = f11 * own[0]**2 + f22 * own[1]**2 - math.sqrt(f11 * f22) * own[0] * own[1] + (own[3] / 8e6)**2
b = f1 * own[0] + f2 * own[1]
tsai_wu = (-b + math.sqrt(b * b + 4 * a)) / (2 * a)
x, y = 1 / 45e6**2, 1 / 3e6**2  # Hill: of each axis the smaller strength
hill = 1 / math.sqrt(x * own[0]**2 + y * own[1]**2 - x * own[0] * own[1] + (own[3] / 8e6)**2)
least = {"tsai_wu": tsai_wu, "hill": hill, "maximum_stress": 3e6 / own[1]}
for criterion, factor in least.items():
    near(cells[criterion + "_load_factor"], factor, criterion)
    near(report["strength"][criterion]["load_factor"], factor, f"{criterion} in the summary")
    check(report["strength"][criterion]["tet"] == 1 and report["strength"][criterion]["region"] == "block",
          f"where it fails: {report['strength'][criterion]}")
check(f"Tsai-Wu: fails at {tsai_wu:.5g} times the load, in tet 1" in finished.output, finished.output)

# Grown by that factor the load is the last that holds.
write(folder, "grown.yaml", (CASE + OUTPUT).replace(f"traction: [{PULL}", f"traction: [{PULL * tsai_wu}"))
near(solve("grown.yaml", "grown.vtu")[1]["strength"]["tsai_wu"]["load_factor"], 1.0, "at the load that fails")

# Any number of ranks: the same values, each vertex once, and no surface between ranks.
bent = CASE.replace(f"traction: [{PULL}, 0, 0]", "point_force: [1e3, 2e3, 5e2]").replace("boundary: xmax", "nearest: [4, 1, 1]")
write(folder, "bent.yaml", bent + "element: {order: 2}\naccuracy: {relative_residual: 1e-12}\n" + OUTPUT)
single = None
for ranks in fewer((1, 2, 4)):
    for ending in "vtu", "pvtu":
        name = f"bent-{ranks}.{ending}"
        _, report = solve("bent.yaml", name, ranks)
        grid = read(name)
        check(grid.GetNumberOfPoints() == report["vertices"], f"{name}: {grid.GetNumberOfPoints()} points")
        surface = vtkDataSetSurfaceFilter()
        surface.SetInputData(grid)
        surface.SetNonlinearSubdivisionLevel(0)
        surface.Update()
        check(surface.GetOutput().GetNumberOfCells() == 2 * 2 * (6 * 2 + 6 * 2 + 2 * 2), f"{name}: faces between ranks")
        found = {**arrays(grid.GetPointData()), **arrays(grid.GetCellData())}
        single = single or (found, report)
        for field in set(FIELDS) - {"rank"}:
            near(found[field], single[0][field], f"{name}: {field}", 1e-7)
        near(report["strength"]["tsai_wu"]["load_factor"], single[1]["strength"]["tsai_wu"]["load_factor"], name)
        check(report["strength"]["tsai_wu"]["tet"] == single[1]["strength"]["tsai_wu"]["tet"], f"{name}: {report['strength']}")

# The file says what a field is; meshio reads it too.
data = read("bent-4.vtu").GetCellData()
stress = data.GetArray("stress")
check([stress.GetComponentName(k) for k in range(6)] == ["xx", "yy", "zz", "xy", "yz", "zx"], "names of components")
check(stress.GetInformation().Get(vtkDataArray.UNITS_LABEL()) == "force per area", "the unit of stress")
with open(os.path.join(folder, "bent-4.vtu"), "rb") as stream:
    head = stream.read(8000).decode(errors="replace")
check("field von_mises: von Mises stress" in head and "region 0: block" in head, "the fields are not described at the head")
if sys.version_info < (3, 13):  # whose base64 no longer takes what meshio 5.3 makes of bytes that stand as they are
    mesh = meshio.read(os.path.join(folder, "bent-4.vtu"))
    check(mesh.cells[0].type == "tetra10" and len(mesh.points) == single[1]["vertices"], f"meshio: {mesh}")
    near(np.sort(mesh.cell_data["von_mises"][0].reshape(-1)), np.sort(single[0]["von_mises"]), "von_mises by meshio", 1e-7)

# Without `fields` the load factors are there where a material has strengths, and nothing else that others follow from.
write(folder, "default.yaml", CASE)
solve("default.yaml", "default.vtu")
found = set(arrays(read("default.vtu").GetCellData()))
check("hill_load_factor" in found and not found & {"von_mises", "e1", "principal_stress"}, f"by default: {sorted(found)}")
write(folder, "plain.yaml", CASE.replace("    strengths:", "    # strengths:"))
report = solve("plain.yaml", "plain.vtu")[1]
found = set(arrays(read("plain.vtu").GetCellData()))
check("hill_load_factor" not in found and report["strength"] is None, f"without strengths: {sorted(found)}")
strength = next(account for account in report["ledger"]["accounts"] if account["name"] == "strength")
check(strength["entries"] == 0 and strength["bytes"] == 0, f"strength is off and costs {strength}")

# Steps as a series; a failed run leaves the earlier result; a refused one is marked.
write(folder, "path.yaml", CASE + "path: {steps: 2}\n" + OUTPUT)
solve("path.yaml", "steps.pvtu", fewer((2,))[-1])
with open(os.path.join(folder, "steps.pvd")) as stream:
    listed = stream.read()
check('timestep="0.5" file="steps_0001.pvtu"' in listed and 'timestep="1" file="steps_0002.pvtu"' in listed, listed)
near(arrays(read("steps_0001.pvtu").GetCellData())["von_mises"], PULL / 2, "von Mises of step 1")
with open(os.path.join(folder, "one.vtu"), "rb") as stream:
    before = stream.read()
write(folder, "unsolved.yaml", bent + "element: {order: 2}\n" + OUTPUT + "solver: {method: plain, max_iterations: 2, coarsest_unknowns: 50}\n")
finished = run("solve", "unsolved.yaml", "-o", "one.vtu", folder=folder)
with open(os.path.join(folder, "one.vtu"), "rb") as stream:
    check(finished.exit_code == 1 and stream.read() == before, "a run that failed touched the earlier result")
finished = run("solve", "unsolved.yaml", "-o", "kept.vtu", "--keep", folder=folder)
flags = read("kept.vtu").GetFieldData()
check(finished.exit_code == 1 and flags.GetArray("refused").GetValue(0) == 1 and flags.GetArray("unfinished").GetValue(0) == 1,
      "a result that is no answer is not marked")
os.mkdir(os.path.join(folder, "taken.vtu"))
finished = run("solve", "tension.yaml", "-o", "taken.pvtu", folder=folder)
check(finished.exit_code == 2 and "'taken.vtu' is there already" in finished.errors, finished.errors)
finished = run("solve", "tension.yaml", "-o", "x.vtk", folder=folder)
check(finished.exit_code == 2 and ".vtkhdf, .hdf, .vtu or .pvtu" in finished.errors, finished.errors)
check(not [name for name in os.listdir(folder) if name.startswith(".orthostat")], "temporary files are left")

# Strengths that cannot be.
for text, message in (("tension: [80e6, 3e6, 3e6]", "'shear' is missing"), ("compression: 3e6", "tension"),
                      ("tension: -1", "above 0"), ("tension: 1, shear: {S12: 1, S21: 1}", "same strength"),
                      ("tension: 1, shear: {S12: 1}", "S12, S23 and S31"),
                      ("tension: 1, interaction: -0.9", "without end")):
    write(folder, "wrong.yaml", CASE.replace(CASE[CASE.index("strengths: {"):CASE.index("}}\nconstraints") + 2], f"strengths: {{{text}}}"))
    finished = run("check", "wrong.yaml", folder=folder)
    check(finished.exit_code == 2 and message in finished.errors and "wrong.yaml:8:" in finished.errors, finished.errors)
write(folder, "open.yaml", CASE.replace("tension: [80000000.0, 3000000.0, 3000000.0]", "tension: [8e7, 3e6, 4.5e6]"))
check("Hill's criterion lets some stresses grow" in run("check", "open.yaml", folder=folder).errors, "an open criterion")
