# SPDX-License-Identifier: BSD-3-Clause
"""Stiff inclusions that a field of moduli makes, tet by tet, stay whole on one rank, as those of a region do."""
import os

import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from program import check, new_folder, run

CELLS = 12
CASE = """mesh: MESH
materials: [{region: all, youngs_modulus: MODULUS, poissons_ratio: 0.3}]
constraints: [{on: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, displacement: [0, 0, 0]}]
loads: [{body_force: [0, 0, 1]}]
large_rotation: off
output: {file: out.vtu, fields: [rank]}
"""
folder = new_folder()


def solve(mesh, modulus, ranks=1):
    with open(os.path.join(folder, "case.yaml"), "w", encoding="utf-8") as stream:
        stream.write(CASE.replace("MESH", mesh).replace("MODULUS", modulus))
    done = run("solve", "case.yaml", "-q", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(folder, "out.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return points, vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4), grid.GetCellData().GetArray("rank")


points, tets, _ = solve(f"{{block: {{size: [1, 1, 1], divisions: [{CELLS}, {CELLS}, {CELLS}]}}}}", "1")


def cubes(points, tets):
    """Of each tet the number of the cube of 2 x 2 x 2 cells that it is in, one in each 4 x 4 x 4 cells, or -1."""
    cell = np.floor(points[tets].mean(axis=1) * CELLS).astype(int)
    inside = np.all((cell % 4 >= 1) & (cell % 4 < 3), axis=1)
    return np.where(inside, cell // 4 @ [1, 10, 100], -1)


split = {}
for ratio in 1e3, 1e6:  # up to 10,000 the body hangs together, and is cut as METIS likes
    moduli = np.where(cubes(points, tets) >= 0, ratio, 1.0)
    meshio.Mesh(points, [("tetra", tets)], cell_data={"E": [moduli]}).write(os.path.join(folder, "field.vtu"))
    *found, rank = solve("{file: field.vtu}", "{field: E}", ranks=4)
    ranks = vtk_to_numpy(rank).ravel()
    number = cubes(*found)
    split[ratio] = sum(len(set(ranks[number == n])) > 1 for n in set(number) - {-1})
check(len(set(cubes(points, tets))) == 28, "27 inclusions")
check(split[1e6] == 0 and split[1e3] > 0, f"inclusions on several ranks: {split}")
