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
import netCDF4
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


def parts(kind):
    """Points, triangles of the clamp, tets of the left and of the right cube."""
    mesh = meshio.read(source(kind))
    tets = np.vstack([block.data for block in mesh.cells if block.type.startswith("tetra")])
    clamp = np.vstack([block.data for block in mesh.cells if block.type.startswith("triangle")])
    left = mesh.points[tets[:, :4]].mean(axis=1)[:, 0] < 1
    return mesh.points, clamp[(mesh.points[clamp, 0] == 0).all(axis=1)], tets[left], tets[~left]


def exodus_by_meshio():
    for kind, types in (("linear", ("triangle", "tetra")), ("quadratic", ("triangle6", "tetra10"))):
        points, clamp, left, right = parts(kind)
        sense = np.where(np.arange(len(points)) % 2, 1.0, -1.0)[:, None]
        mesh = meshio.Mesh(points, [(types[0], clamp), (types[1], left), (types[1], right)],
                           point_data={"density": 1.0 + points[:, 0], "direction": sense * np.tile([0.6, 0.8, 0.0], (len(points), 1))},
                           point_sets={"pins": np.flatnonzero(points[:, 0] == 2)})
        meshio.write(os.path.join(HERE, f"meshio-{kind}.e"), mesh)


def exodus(name, kind, flavour, elem_type, steps=2, **packing):
    """As Cubit and Sandia's programs write it: blocks, side sets, node sets with names or none, maps of numbers, variables.
    Nodes are numbered 10, 20, ..., elements from 1001; only the last time step has the values that count."""
    points, _, left, right = parts(kind)
    tets = np.vstack([left, right])
    integer = "i8" if flavour == "NETCDF3_64BIT_DATA" else "i4"
    sides = [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)]
    at = {x: [(t + 1, s + 1) for t, tet in enumerate(tets) for s, side in enumerate(sides) if (points[tet[list(side)], 0] == x).all()]
          for x in (0, 2)}
    end = np.flatnonzero(points[:, 0] == 2) + 1
    centre = points[tets[:, :4]].mean(axis=1)[:, 0]
    elements = {"modulus": 1000.0 + 1000.0 * centre, "fibre_x": np.cos(centre), "fibre_y": np.sin(centre), "fibre_z": 0 * centre}
    sense = np.where(np.arange(len(points)) % 2, 1.0, -1.0)
    nodes = {"density": 1.0 + points[:, 0], "directionX": 0.6 * sense, "directionY": 0.8 * sense, "directionZ": 0.0 * sense}
    with netCDF4.Dataset(os.path.join(HERE, name), "w", format=flavour) as out:
        out.set_auto_mask(False)

        def array(word, dimensions, values, form):
            for dimension, size in zip(dimensions, np.shape(values)):
                if dimension not in out.dimensions:
                    out.createDimension(dimension, size)
            variable = out.createVariable(word, form, dimensions, **packing)
            variable[:] = values
            return variable

        def texts(word, dimension, values):
            array(word, (dimension, "len_name"), netCDF4.stringtochar(np.array(values, "S33")), "S1")

        out.setncatts({"api_version": np.float32(8.03), "version": np.float32(8.03), "floating_point_word_size": np.int32(8),
                       "file_size": np.int32(1), "maximum_name_length": np.int32(32), "title": "two cubes"})
        out.createDimension("time_step", None)
        out.createDimension("len_string", 33)
        out.createDimension("len_line", 81)
        out.createDimension("four", 4)
        out.createDimension("num_dim", 3)
        out.createDimension("num_elem", len(tets))
        out.createDimension("num_elem_var", len(elements))
        out.createDimension("num_nod_var", len(nodes))
        for axis, word in enumerate(("coordx", "coordy", "coordz")):
            array(word, ("num_nodes",), points[:, axis], "f8")
        array("node_num_map", ("num_nodes",), 10 * np.arange(1, len(points) + 1), integer)
        array("elem_num_map", ("num_elem",), np.arange(1001, 1001 + len(tets)), integer)
        array("eb_status", ("num_el_blk",), [1, 1, 0], "i4")
        array("eb_prop1", ("num_el_blk",), [10, 20, 30], integer).setncattr("name", "ID")
        texts("eb_names", "num_el_blk", ["left", "", "nothing"])  # the third is empty
        for b, block in enumerate((left, right), 1):
            array(f"connect{b}", (f"num_el_in_blk{b}", f"num_nod_per_el{b}"), block + 1, integer).elem_type = elem_type
        array("ss_status", ("num_side_sets",), [1, 1], "i4")
        array("ss_prop1", ("num_side_sets",), [3, 5], integer).setncattr("name", "ID")
        texts("ss_names", "num_side_sets", ["clamp", ""])
        for s, x in ((1, 0), (2, 2)):
            array(f"elem_ss{s}", (f"num_side_ss{s}",), [e for e, _ in at[x]], integer)
            array(f"side_ss{s}", (f"num_side_ss{s}",), [side for _, side in at[x]], integer)
        array("ns_status", ("num_node_sets",), [1, 1], "i4")
        array("ns_prop1", ("num_node_sets",), [8, 9], integer).setncattr("name", "ID")
        texts("ns_names", "num_node_sets", ["pins", ""])
        array("node_ns1", ("num_nod_ns1",), end, integer)
        array("node_ns2", ("num_nod_ns2",), end[:1], integer)
        texts("name_elem_var", "num_elem_var", list(elements))
        texts("name_nod_var", "num_nod_var", list(nodes))
        array("time_whole", ("time_step",), np.arange(steps) * 1.0, "f8")
        for v, values in enumerate(elements.values(), 1):
            for b, block in ((1, values[:len(left)]), (2, values[len(left):])):
                variable = out.createVariable(f"vals_elem_var{v}eb{b}", "f8", ("time_step", f"num_el_in_blk{b}"), **packing)
                for step in range(steps):
                    variable[step] = block if step == steps - 1 else -1.0
        for v, values in enumerate(nodes.values(), 1):
            variable = out.createVariable(f"vals_nod_var{v}", "f8", ("time_step", "num_nodes"), **packing)
            for step in range(steps):
                variable[step] = values if step == steps - 1 else -1.0


def by_netcdf():
    exodus("exodus-linear-classic.exo", "linear", "NETCDF3_CLASSIC", "TETRA")
    exodus("exodus-linear-offset.gen", "linear", "NETCDF3_64BIT_OFFSET", "TET4", steps=1)
    exodus("exodus-linear-netcdf4.g", "linear", "NETCDF4_CLASSIC", "tetra4", zlib=True)
    exodus("exodus-quadratic-64bit.ex2", "quadratic", "NETCDF3_64BIT_DATA", "tetra10")
    exodus_in_parts()


def exodus_in_parts():
    """The file of 4 ranks, as MOOSE or nem_spread write it: numbers in the whole are maps, lists name places in the part. The
    last rank has nothing."""
    with netCDF4.Dataset(os.path.join(HERE, "exodus-linear-classic.exo")) as whole:
        whole.set_auto_mask(False)
        points = np.stack([whole[f"coord{axis}"][:] for axis in "xyz"], axis=1)
        tets = np.vstack([whole["connect1"][:], whole["connect2"][:]]) - 1
        left, centre = len(whole["connect1"][:]), points[tets].mean(axis=1)
        rank_of = np.where(centre[:, 0] < 1, 0, np.where(centre[:, 1] < 0.5, 1, 2))
        for rank in range(4):
            mine = np.flatnonzero(rank_of == rank)
            used = np.unique(tets[mine])
            node = {n: place for place, n in enumerate(used, 1)}
            element = {e: place for place, e in enumerate(mine, 1)}
            blocks = [mine[mine < left], mine[mine >= left], mine[:0]]
            with netCDF4.Dataset(os.path.join(HERE, f"parts.e.4.{rank}"), "w", format="NETCDF3_CLASSIC") as out:
                out.setncatts({word: whole.getncattr(word) for word in whole.ncattrs()})
                for word, dimension in whole.dimensions.items():
                    if not word.startswith(("num_el_in", "num_nod_ns", "num_side_ss")) and word not in ("num_nodes", "num_elem"):
                        out.createDimension(word, None if dimension.isunlimited() else len(dimension))

                def put(word, values, like=None):
                    """An array whose first dimension, or that after the time step, is the part's."""
                    form = whole[like or word]
                    for name, size in zip(form.dimensions[::-1], np.shape(values)[::-1]):
                        if name not in out.dimensions:
                            out.createDimension(name, size)
                    variable = out.createVariable(word, form.dtype, form.dimensions)
                    variable.setncatts({a: form.getncattr(a) for a in form.ncattrs()})
                    variable[:] = values

                for word in whole.variables:
                    values, stem = whole[word][:], word.rstrip("0123456789")
                    if word.startswith(("coord", "node_num_map")):
                        values = values[used]
                    elif word == "elem_num_map":
                        values = values[mine]
                    elif stem == "connect":
                        block = blocks[int(word[7:]) - 1]
                        values = np.array([[node[n] for n in tets[e]] for e in block])
                    elif stem == "node_ns":
                        values = np.array([node[n - 1] for n in values if n - 1 in node])
                    elif stem in ("elem_ss", "side_ss"):
                        kept = [i for i, e in enumerate(whole["elem_ss" + word[7:]][:]) if e - 1 in element]
                        values = np.array([element[values[i] - 1] if stem == "elem_ss" else values[i] for i in kept])
                    elif word.startswith("vals_elem"):
                        block = blocks[int(word[-1]) - 1]
                        values = values[:, block - (0 if word[-1] == "1" else left)]
                    elif word.startswith("vals_nod"):
                        values = values[:, used]
                    if np.size(values):
                        put(word, values)


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
    os.chdir(HERE)
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
            gmsh.write(f"solids-{name}.{ending}")  # it writes the path into the file
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


def exodus_of_solids():
    """Blocks by shape, sides by the figures of the Exodus manual, which has upright edges before those of the top."""
    sides = {"hexahedron": "0154 1265 2376 0473 0321 4567", "wedge": "0143 1254 0352 021 345", "pyramid": "014 124 234 043 0321"}
    order = {"hexahedron": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15], "wedge": [*range(9), 12, 13, 14, 9, 10, 11]}
    points, found = cells(True)
    for name, quadratic in (("linear", False), ("serendipity", True)):
        places, middles, blocks = [list(point) for point in points], {}, {}
        for shape, _, nodes in found:
            nodes = list(map(int, nodes))
            for a, b in EDGES[shape].split() if quadratic else ():
                ends = frozenset((nodes[int(a)], nodes[int(b)]))
                if ends not in middles:
                    middles[ends] = len(places)
                    places.append(points[list(ends)].mean(axis=0))
                nodes.append(middles[ends])
            if shape != "quad":
                blocks.setdefault(shape, []).append([nodes[n] for n in order.get(shape, [])[:len(nodes)]] if quadratic and shape in order else nodes)
        places, elements = np.array(places), [(shape, nodes) for shape, block in blocks.items() for nodes in block]
        with netCDF4.Dataset(os.path.join(HERE, f"solids-{name}.exo"), "w", format="NETCDF3_CLASSIC") as out:
            out.setncatts({"api_version": np.float32(8.03), "version": np.float32(8.03), "floating_point_word_size": np.int32(8),
                           "file_size": np.int32(1), "title": "two cubes"})
            for word, size in (("num_dim", 3), ("num_nodes", len(places)), ("num_elem", len(elements)), ("num_el_blk", len(blocks)),
                               ("num_side_sets", 2), ("num_elem_var", 1), ("len_name", 33), ("time_step", None)):
                out.createDimension(word, size)
            for axis, word in enumerate(("coordx", "coordy", "coordz")):
                out.createVariable(word, "f8", ("num_nodes",))[:] = places[:, axis]
            out.createVariable("name_elem_var", "S1", ("num_elem_var", "len_name"))[:] = netCDF4.stringtochar(np.array(["modulus"], "S33"))
            out.createVariable("ss_names", "S1", ("num_side_sets", "len_name"))[:] = netCDF4.stringtochar(np.array(["clamp", "end"], "S33"))
            out.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = range(1, len(blocks) + 1)
            out["eb_prop1"].setncattr("name", "ID")
            for b, (shape, block) in enumerate(blocks.items(), 1):
                out.createDimension(f"num_el_in_blk{b}", len(block))
                out.createDimension(f"num_nod_per_el{b}", len(block[0]))
                connect = out.createVariable(f"connect{b}", "i4", (f"num_el_in_blk{b}", f"num_nod_per_el{b}"))
                connect.elem_type = {"hexahedron": "HEX", "tetra": "TETRA"}.get(shape, shape.upper()) + str(len(block[0]))
                connect[:] = np.array(block) + 1
                corners = {"hexahedron": 8, "wedge": 6, "pyramid": 5, "tetra": 4}[shape]
                values = out.createVariable(f"vals_elem_var1eb{b}", "f8", ("time_step", f"num_el_in_blk{b}"))
                values[0] = [1000.0 + 1000.0 * places[nodes[:corners], 0].mean() for nodes in block]
            for s, x in ((1, 0.0), (2, 2.0)):
                at = [(e, n) for e, (shape, nodes) in enumerate(elements, 1) for n, side in enumerate(sides.get(shape, "").split(), 1)
                      if all(places[nodes[int(v)], 0] == x for v in side)]
                out.createDimension(f"num_side_ss{s}", len(at))
                for word, column in ((f"elem_ss{s}", 0), (f"side_ss{s}", 1)):
                    out.createVariable(word, "i4", (f"num_side_ss{s}",))[:] = [pair[column] for pair in at]


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
    exodus_by_meshio()
    by_netcdf()
    appended_by_vtk()
    by_tetgen()
    for order in SOURCES:
        as_from_cae(order)
    other_solids()
    exodus_of_solids()
    solids_by_vtk()
