#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the meshes of this folder again, from those of ../msh: two cubes, [0, 2] × [0, 1]², the left one and the right
one a region each, the face at x = 0 a boundary. Needs Debian's python3-gmsh 4.8, python3-meshio 5.0, python3-netcdf4 and
tetgen 1.5."""
import os
import subprocess
import tempfile

import gmsh
import meshio
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCES = {"linear": "gmsh2-binary", "quadratic": "gmsh41-quadratic-binary"}
FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]  # Abaqus's S1 to S4


def source(kind):
    return os.path.join(HERE, "..", "msh", SOURCES[kind] + ".msh")


def by_gmsh():
    for kind in SOURCES:
        gmsh.initialize([])
        gmsh.option.setNumber("General.Verbosity", 1)
        gmsh.open(source(kind))
        for ending in ("mesh", "inp", "unv", "bdf", "vtk"):
            gmsh.write(os.path.join(HERE, f"gmsh-{kind}.{ending}"))
        gmsh.finalize()


def by_meshio():
    for kind in SOURCES:
        mesh = meshio.read(source(kind))
        groups = mesh.cell_data["gmsh:physical"]
        mesh.point_data, mesh.cell_sets = {}, {}
        mesh.cell_data = {"gmsh:physical": groups}
        # a number that tells where each tet is, and a direction that turns about z, without a sense
        centre = [mesh.points[block.data].mean(axis=1) for block in mesh.cells]
        mesh.cell_data["modulus"] = [1000.0 + 1000.0 * c[:, 0] for c in centre]
        mesh.cell_data["fibre"] = [np.column_stack([np.cos(c[:, 0]), np.sin(c[:, 0]), 0 * c[:, 0]]) for c in centre]
        mesh.point_data["density"] = 1.0 + mesh.points[:, 0]
        sense = np.where(np.arange(len(mesh.points)) % 2, 1.0, -1.0)[:, None]
        mesh.point_data["direction"] = sense * np.tile([0.6, 0.8, 0.0], (len(mesh.points), 1))
        for name, how in (("ascii.vtk", {"binary": False}), ("binary.vtk", {}), ("zlib.vtu", {}), ("ascii.vtu", {"binary": False}),
                          ("plain.vtu", {"compression": None})):
            meshio.write(os.path.join(HERE, f"meshio-{kind}-{name}"), mesh, **how)
        meshio.write(os.path.join(HERE, f"meshio-{kind}-old.vtk"), mesh, file_format="vtk42")
        if kind == "linear":
            mesh.cell_data = {"medit:ref": groups}
            meshio.write(os.path.join(HERE, "meshio-linear.meshb"), mesh)
            for name, how in (("sets.vtu", {}), ("sets.vtk", {})):
                mesh.cell_data, mesh.point_data = {"material-number": groups}, {}
                mesh.cell_sets = {name: [np.flatnonzero(g == number) for g in groups]
                                  for name, number in (("left", 11), ("right-hand", 12), ("clamp", 7))}
                mesh.point_sets = {"pins": np.flatnonzero(mesh.points[:, 0] == 2)}
                meshio.write(os.path.join(HERE, "meshio-" + name), mesh, **how)


def appended_by_vtk():
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
    for name, raw, packed in (("raw", 0, 0), ("base64-zlib", 1, 1)):
        reader, writer = vtkXMLUnstructuredGridReader(), vtkXMLUnstructuredGridWriter()
        reader.SetFileName(os.path.join(HERE, "meshio-linear-ascii.vtu"))
        writer.SetInputConnection(reader.GetOutputPort())
        writer.SetFileName(os.path.join(HERE, f"vtk-appended-{name}.vtu"))
        writer.SetDataModeToAppended()
        writer.SetEncodeAppendedData(raw)
        if not packed:
            writer.SetCompressorTypeToNone()
        writer.Write()


def by_tetgen():
    corners = [(x, y, z) for z in (0, 1) for x in (0, 1, 2) for y in (0, 1)]
    number = {corner: n for n, corner in enumerate(corners, 1)}
    faces = [([(x, 0, 0), (x, 1, 0), (x, 1, 1), (x, 0, 1)], mark) for x, mark in ((0, 7), (1, 9), (2, 8))]
    for x in (0, 1):
        faces += [([(x, y, 0), (x + 1, y, 0), (x + 1, y, 1), (x, y, 1)], 3) for y in (0, 1)]
        faces += [([(x, 0, z), (x + 1, 0, z), (x + 1, 1, z), (x, 1, z)], 3) for z in (0, 1)]
    for name, options in (("tetgen-linear", "-pqAa0.1Q"), ("tetgen-quadratic", "-pqAo2Q")):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, name + ".poly")
            with open(path, "w") as out:
                print(len(corners), 3, 0, 0, file=out)
                for corner in corners:
                    print(number[corner], *corner, file=out)
                print(len(faces), 1, file=out)
                for face, mark in faces:
                    print(1, 0, mark, file=out)
                    print(4, *(number[corner] for corner in face), file=out)
                print("0\n2\n1 0.5 0.5 0.5 11\n2 1.5 0.5 0.5 12", file=out)
            subprocess.run(["tetgen", options, path], check=True, stdout=subprocess.DEVNULL)
            for ending in ("node", "ele", "face"):
                with open(os.path.join(folder, f"{name}.1.{ending}")) as made, \
                        open(os.path.join(HERE, f"{name}.{ending}"), "w") as kept:
                    kept.writelines(line for line in made if not line.startswith("# Generated"))


def as_from_cae(kind):
    """As Abaqus/CAE writes a model with one part: an assembly, internal sets, sections and surfaces by faces of tets."""
    mesh = meshio.read(source(kind))
    tets = np.vstack([block.data for block in mesh.cells if block.type.startswith("tetra")])
    left = mesh.points[tets[:, :4]].mean(axis=1)[:, 0] < 1
    tets = np.vstack([tets[left], tets[~left]])
    half = int(left.sum())
    clamp = [(t + 1, side + 1) for t, tet in enumerate(tets) for side, face in enumerate(FACES)
             if (mesh.points[tet[list(face)], 0] == 0).all()]
    at_end = np.flatnonzero(mesh.points[:, 0] == 2) + 1
    with open(os.path.join(HERE, f"cae-{kind}.inp"), "w") as out:
        print("*Heading\n** two cubes\n*Preprint, echo=NO\n**\n** PARTS\n**\n*Part, name=BODY\n*Node", file=out)
        for n, point in enumerate(mesh.points, 1):
            print(f"{n:7d}, {point[0] - 5:12.8g}, {point[1]:12.8g}, {point[2]:12.8g}", file=out)
        print(f"*Element, type=C3D{tets.shape[1]}", file=out)
        for t, tet in enumerate(tets, 1):
            numbers = [f"{v + 1}" for v in tet]
            print(f"{t:4d}, " + ", ".join(numbers[:8]) + ("," if len(numbers) > 8 else ""), file=out)
            if len(numbers) > 8:
                print("      " + ", ".join(numbers[8:]), file=out)
        print(f"*Nset, nset=Everything, generate\n 1, {len(mesh.points)}, 1", file=out)
        print(f"*Elset, elset=Left, generate\n 1, {half}, 1\n*Elset, elset=Right, generate\n {half + 1}, {len(tets)}, 1", file=out)
        print("*Elset, elset=All\n Left, Right", file=out)
        for side in sorted({side for _, side in clamp}):
            print(f"*Elset, elset=_Clamp_S{side}, internal\n " + ", ".join(str(t) for t, s in clamp if s == side), file=out)
        print("*Surface, type=ELEMENT, name=Clamp", file=out)
        for side in sorted({side for _, side in clamp}):
            print(f"_Clamp_S{side}, S{side}", file=out)
        print("** Section: wood\n*Solid Section, elset=Left, material=Wood\n,\n*Solid Section, elset=Right, material=Wood\n,", file=out)
        print("*End Part\n**\n** ASSEMBLY\n**\n*Assembly, name=Assembly\n*Instance, name=BODY-1, part=BODY\n 5., 0., 0.\n*End Instance", file=out)
        print("*Nset, nset=End, instance=BODY-1\n " + ",\n ".join(map(str, at_end)), file=out)
        print("*End Assembly\n*Material, name=Wood\n*Elastic\n 1000., 0.3\n*Step\n*Static\n1., 1.\n*Boundary\nEnd, 1, 1, 0.1\n*End Step", file=out)


TYPES = {"quad": 3, "tetra": 4, "hexahedron": 5, "wedge": 6, "pyramid": 7}  # Gmsh's numbers


def cells(with_pyramids):
    """The two cubes of other solids: on the left a hexahedron, on the right pyramids, of which the lowest is two tets, then
    two wedges; without pyramids a second hexahedron in their place."""
    places = [(x, y, z) for x in (0, 1, 1.5, 2) for y in (0, 1) for z in (0, 1)] + [(1.25, 0.5, 0.5)] * with_pyramids
    order = np.random.default_rng(8).permutation(len(places))  # diagonals go by the numbers of nodes
    number = {places[p]: n for n, p in enumerate(order)}
    at = lambda *names: [number[n] for n in names]
    corners = lambda a, b: [(a, 0, 0), (b, 0, 0), (b, 1, 0), (a, 1, 0), (a, 0, 1), (b, 0, 1), (b, 1, 1), (a, 1, 1)]
    middle, right, centre = corners(1, 1.5), corners(1.5, 2), (1.25, 0.5, 0.5)
    found = [("hexahedron", 11, at(*corners(0, 1)))]
    if with_pyramids:
        for face in ((4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)):
            found.append(("pyramid", 12, at(*(middle[v] for v in face), centre)))
        found += [("tetra", 12, at(middle[a], middle[b], middle[c], centre)) for a, b, c in ((0, 1, 2), (0, 2, 3))]
    else:
        found.append(("hexahedron", 12, at(*middle)))
    for a, b, c in ((0, 1, 2), (0, 2, 3)):
        found.append(("wedge", 12, at(*(right[v] for v in (a, b, c, a + 4, b + 4, c + 4)))))
    found.append(("quad", 7, at((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0))))
    return np.array([places[p] for p in order], dtype=float), sorted(found, key=lambda cell: (cell[1], list(TYPES).index(cell[0])))


def other_solids():
    for with_pyramids, incomplete, name, endings in (
            (True, None, "linear", ("bdf", "vtk", "msh")), (False, None, "bricks-linear", ("inp", "unv")),
            (True, 1, "serendipity", ("msh",)), (False, 1, "bricks-serendipity", ("inp", "bdf", "unv", "vtk")),
            (True, 0, "full", ("msh",)), (False, 0, "bricks-full", ("vtk",))):  # what Gmsh can write of them
        points, found = cells(with_pyramids)
        gmsh.initialize([])
        gmsh.option.setNumber("General.Verbosity", 1)
        for dimension, tag in ((2, 7), (3, 11), (3, 12)):
            gmsh.model.addDiscreteEntity(dimension, tag)
            gmsh.model.addPhysicalGroup(dimension, [tag], tag)
            gmsh.model.setPhysicalName(dimension, tag, {7: "clamp", 11: "left", 12: "right"}[tag])
        gmsh.model.mesh.addNodes(3, 11, list(range(1, len(points) + 1)), points.ravel())
        for n, (shape, tag, nodes) in enumerate(found, 1):
            gmsh.model.mesh.addElementsByType(tag, TYPES[shape], [n], [v + 1 for v in nodes])
        if incomplete is not None:
            gmsh.option.setNumber("Mesh.SecondOrderIncomplete", incomplete)
            gmsh.model.mesh.setOrder(2)
        for ending in endings:
            gmsh.write(os.path.join(HERE, f"solids-{name}.{ending}"))
        gmsh.finalize()
    points, found = cells(True)
    blocks = [(shape, np.array([nodes])) for shape, _, nodes in found]
    groups = [np.array([tag]) for _, tag, _ in found]
    modulus = [np.array([1000.0 + 1000.0 * points[nodes].mean(axis=0)[0]]) for _, _, nodes in found]
    meshio.write(os.path.join(HERE, "solids-meshio.vtu"), meshio.Mesh(
        points, blocks, cell_data={"gmsh:physical": groups, "modulus": modulus}, point_data={"density": 1.0 + points[:, 0]}))
    meshio.write(os.path.join(HERE, "solids-meshio.mesh"), meshio.Mesh(points, blocks, cell_data={"medit:ref": groups}))


EDGES = {"quad": "01 12 23 30", "tetra": "01 12 02 03 13 23", "pyramid": "01 12 23 30 04 14 24 34",
         "wedge": "01 12 20 34 45 53 03 14 25", "hexahedron": "01 12 23 30 45 56 67 74 04 15 26 37"}  # of VTK


def solids_by_vtk():
    from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
    types = {"quad": 23, "tetra": 24, "hexahedron": 25, "wedge": 26, "pyramid": 27}
    points, found = cells(True)
    grid, places, region, middles = vtkUnstructuredGrid(), vtkPoints(), vtkIntArray(), {}
    region.SetName("region")
    for point in points:
        places.InsertNextPoint(*point)
    for shape, tag, nodes in found:
        nodes, edges = list(map(int, nodes)), EDGES[shape].split()
        for a, b in edges:
            ends = frozenset((nodes[int(a)], nodes[int(b)]))
            if ends not in middles:
                middles[ends] = places.InsertNextPoint(*points[list(ends)].mean(axis=0))
            nodes.append(middles[ends])
        grid.InsertNextCell(types[shape], len(nodes), nodes)
        region.InsertNextValue(tag)
    grid.SetPoints(places)
    grid.GetCellData().AddArray(region)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(os.path.join(HERE, "solids-vtk.vtu"))
    writer.SetDataModeToBinary()
    writer.Write()


if __name__ == "__main__":
    by_gmsh()
    by_meshio()
    appended_by_vtk()
    by_tetgen()
    for order in SOURCES:
        as_from_cae(order)
    other_solids()
    solids_by_vtk()
