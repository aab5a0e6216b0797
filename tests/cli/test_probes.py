"""Probes on points and along lines, and watched stresses, against VTK's own probe, the file of fields and formulas, on any number of ranks."""
import csv
import json
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from program import check, fewer, new_folder, run, write

PARTS = """
large_rotation: off
accuracy: {relative_residual: 1e-12}
watch:
  knot: {stress: {at: [1.1, 0.3, 0.4]}, component: 11}
  mean: {stress: {region: sector}, component: zx, take: mean}
  most: {stress: {region: all}, component: largest_principal, take: largest}
  least: {stress: {region: all}, component: "33", take: least}
output:
  file: out.vtu
  fields: [displacement, stress, material_stress, principal_stress, region]
  probes:
    arc: {points: [[1.06066, 0.3, 1.06066], [0, 0.5, 1.99], [1.3, 0.11, 0.2], [0.5, 0.5, 0.5], [1.42, 0.5, 1.42]]}
    through: {from: [1.02, 0.3, 0.1], to: [1.6, 0.9, 0.9], count: 30}
"""
SECTOR = """
mesh: {sector: {axis: y, length: 1, radii: [1, 2], angle: 90, divisions: {around: 4, radial: 2, axial: 2}}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [4e6, 1e6, 2e6], poissons_ratio: 0.3,
             axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [tangential, axial, radial]}}}]
constraints: [{on: {boundary: start}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: finish}, traction: [0, 500, 2000]}]
""" + PARTS
folder = new_folder()


def solve(text, ranks=1, name="case.yaml", expected=0):
    write(folder, name, text)
    finished = run("solve", name, "--json", "summary.json", ranks=ranks, folder=folder)
    check(finished.exit_code == expected, f"{ranks} ranks: {finished.errors}")
    if expected:
        return finished, None
    with open(os.path.join(folder, "summary.json")) as stream:
        return finished, json.load(stream)["watched"]


def rows(name):
    with open(os.path.join(folder, name), newline="") as stream:
        return [{key: float(value) if value else None for key, value in row.items()} for row in csv.DictReader(stream)]


def near(found, expected, what, tolerance=1e-8, size=None):
    found, expected = np.asarray(found), np.asarray(expected)
    size = size or np.abs(expected).max()
    off = np.abs(found - expected).max() / size
    check(off <= tolerance, f"{what}: {off:.1e} off: {found}, expected {expected}")


def grid():
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(folder, "out.vtu"))
    reader.Update()
    return reader.GetOutput()


def probed_by_vtk(table):
    """Displacements at the points of a table, and which of them VTK finds inside."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array([[row[k] for k in "xyz"] for row in table]), deep=True))
    asked = vtkPolyData()
    asked.SetPoints(points)
    probe = vtkProbeFilter()
    probe.SetInputData(asked)
    probe.SetSourceData(grid())
    probe.Update()
    data = probe.GetOutput().GetPointData()
    return vtk_to_numpy(data.GetArray("displacement")), vtk_to_numpy(data.GetArray("vtkValidPointMask")).astype(bool)


first = None
for ranks in fewer((1, 2, 4)):
    finished, watched = solve(SECTOR, ranks)
    arc, through = rows("out_arc.csv"), rows("out_through.csv")
    check("1 of 5 points of 'arc' are outside" in finished.errors and "point 4 at (0.5, 0.5, 0.5)" in finished.errors, finished.errors)
    check("out_through.csv" in finished.output, "the summary does not name the tables")
    first = first or (arc, through, watched)
    for mine, single in zip((arc, through), first):
        check([row["tet"] for row in mine] == [row["tet"] for row in single], f"{ranks} ranks: other tets")
        for key in mine[0]:
            inside = [i for i, row in enumerate(single) if row["tet"]]
            size = max(abs(row["stress_von_mises"]) for row in single if row["tet"]) if key.startswith("stress") else None
            near([mine[i][key] for i in inside], [single[i][key] for i in inside], f"{ranks} ranks: {key}", 1e-7, size)
    for name, value in watched.items():
        size = first[2]["most"]["value"] if name == "mean" else None  # the mean is 0, see below
        near(value["value"], first[2][name]["value"], f"{ranks} ranks: {name}", 1e-7, size)
        check(value["place"] == first[2][name]["place"] or np.allclose(value["place"], first[2][name]["place"]), f"{name}: {value}")

# Displacements by VTK's own interpolation; it finds places in curved tets to 1e-5 (tests/probe has ours to 1e-12). The points of arc are
# on the surface, where VTK may find none.
expected, valid = probed_by_vtk(through)
check(valid.all(), "VTK finds points outside")
near([[row[f"displacement_{k}"] for k in "xyz"] for row in through], expected, "displacements along the line", 1e-4)
check(arc[3]["tet"] is None and arc[3]["stress_xx"] is None, f"a point outside: {arc[3]}")
check(all(arc[i]["tet"] for i in (0, 1, 2, 4)), "points inside are taken for outside")
near(through[-1]["distance"], np.sqrt(0.58**2 + 0.6**2 + 0.8**2), "distance")

# Least, largest and mean are those of the file.
cells = grid().GetCellData()
stress, own, principal = (vtk_to_numpy(cells.GetArray(name)) for name in ("stress", "material_stress", "principal_stress"))
near(watched["most"]["value"], principal[:, 0].max(), "the largest principal stress")
near(watched["least"]["value"], own[:, 2].min(), "the least stress along e3")
nodes = vtk_to_numpy(grid().GetPoints().GetData())[vtk_to_numpy(grid().GetCells().GetConnectivityArray()).reshape(-1, 10)[:, :4]]
near(watched["most"]["place"], nodes[principal[:, 0].argmax()].mean(0), "where it is")
# By statics the mean of zx is 0: no force along x acts, and the face that is held lies in z = 0.
near(watched["mean"]["value"], 0, "the mean", size=watched["most"]["value"])
check(watched["knot"]["place"] is None and watched["mean"]["place"] is None, "means and points have no place of their own")

# One stress everywhere: what is sampled is known, along the axes too.
c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
BLOCK = """
mesh: {block: {size: [2, 1, 1], divisions: [2, 1, 1]}}
materials: [{region: all, youngs_modulus: [4e6, 1e6, 2e6], poissons_ratio: 0.3, axes: {euler: {degrees: [30, 0, 0]}}}]
constraints:
  - {on: {boundary: xmin}, displacement: [0, free, free]}
  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}
  - {on: {nearest: [0, 1, 0]}, displacement: [free, free, 0]}
loads: [{on: {boundary: xmax}, traction: [1000, 0, 0]}]
""" + PARTS.replace("region: sector", "region: block").replace("[0.5, 0.5, 0.5]", "[9, 9, 9]")
_, watched = solve(BLOCK, name="block.yaml")
near(watched["knot"]["value"], 1000 * c * c, "along e1 at a point")
near(watched["most"]["value"], 1000, "the largest principal stress")
near(watched["mean"]["value"], 0, "no shear", size=1000)
line = np.array([[row[f"displacement_{k}"] for k in "xyz"] for row in rows("out_through.csv")])
share = np.linspace(0, 1, len(line))[:, None]
near(line, (1 - share) * line[0] + share * line[-1], "displacements of a uniform strain", 1e-9)
row = rows("out_through.csv")[3]
near([row[f"stress_{m}"] for m in ("xx", "11", "22", "12", "von_mises", "pressure", "largest_principal")],
     [1000, 1000 * c * c, 1000 * s * s, -1000 * c * s, 1000, -1000 / 3, 1000], "the stress at a point")

# A path has a table of each step, and its history the watched stresses.
solve(BLOCK + "path: {steps: 2}\n", name="path.yaml")
near(rows("out_0001_through.csv")[3]["stress_xx"], 500, "the first step")
near([row["knot"] for row in rows("out_history.csv")], [500 * c * c, 1000 * c * c], "the history")

# Axes are those of the point, which turn within a tet: Lame's thick cylinder under pressure, of three tets through its wall.
solve("""mesh: {sector: {axis: z, length: 1, radii: [1, 2], angle: 90, divisions: {around: 6, radial: 3, axial: 2}}}
element: {order: 2}
large_rotation: off
materials: [{region: all, youngs_modulus: [100, 100, 100.0001], poissons_ratio: 0.3, axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}]
constraints: [{on: {boundary: start}, slide: [1, 0, 0]}, {on: {boundary: finish}, slide: [0, 1, 0]}, {on: {boundary: bottom}, slide: [0, 0, 1]}, {on: {boundary: top}, slide: [0, 0, 1]}]
loads: [{on: {boundary: inner}, pressure: 1}]
output: {file: lame.vtu, probes: {r: {from: [0.7072, 0.7072, 0.5], to: [1.414, 1.414, 0.5], count: 5}}}
watch: {hoop: {stress: {at: [1.0606, 1.0606, 0.5]}, component: 22}, shear: {stress: {at: [1.0606, 1.0606, 0.5]}, component: 12}}
""", name="lame.yaml")
for row in rows("lame_r.csv"):
    r = (row["x"] ** 2 + row["y"] ** 2) ** 0.5
    near([row["stress_22"], row["stress_12"]], [(1 + 4 / r ** 2) / 3, 0], f"the hoop at r = {r}", tolerance=0.025)
with open(os.path.join(folder, "summary.json")) as stream:
    watched = json.load(stream)["watched"]
near([watched["hoop"]["value"], watched["shear"]["value"]], [(1 + 4 / 2.25) / 3, 0], "the hoop that is watched", tolerance=0.01)

# What is asked for wrongly.
for before, after, message in (
        ("at: [1.1, 0.3, 0.4]", "at: [9, 9, 9]", "'knot' is at (9, 9, 9), which is outside the body"),
        ("region: block", "region: bloc", "'bloc'"),
        ("component: 11", "component: x", "unknown component 'x'"),
        (", component: 11", "", "component: von_mises"),
        ("component: 11", "component: 11, take: mean", "at a point there is one stress"),
        ("count: 30", "count: 1", "count"),
        (", count: 30", "", "expected either points"),
        ("through:", '"a/b":', "part of a file's name"),
        ("accuracy: {relative_residual: 1e-12}", "accuracy: {relative_error: 0.01, of: knot}", "is a stress")):
    check(before in BLOCK, before)
    finished, _ = solve(BLOCK.replace(before, after), name="wrong.yaml", expected=2)
    check(message in finished.errors and "wrong.yaml:" in finished.errors, finished.errors)
os.mkdir(os.path.join(folder, "out_arc2.csv"))
finished, _ = solve(BLOCK.replace("arc:", "arc2:"), name="taken.yaml", expected=2)
check("'out_arc2.csv' is there already" in finished.errors, finished.errors)
