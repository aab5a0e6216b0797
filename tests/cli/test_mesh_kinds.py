"""Mesh files as other programs write them, made here: curved tets, quadratic solids in any order, VTKHDF and packed .vtu files,
names in quotes, what is generated or included."""
import json
import os

import h5py
import numpy as np
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from program import SOURCE, check, fewer, new_folder, run, write

folder = new_folder()


def inspect(*arguments, ranks=1):
    done = run("mesh", *arguments, "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, f"mesh {arguments}: {done.errors}")
    return json.loads(done.output)


# A tet whose edge on x bulges by 0.1: its volume is 1/6 + 4 0.1 / 24, the area at z = 0 is 1/2 + 4 0.1 / 6, integrals of its shape functions.
CURVED = """*NODE
1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1
5, .5, -.1, 0\n6, .5, .5, 0\n7, 0, .5, 0\n8, 0, 0, .5\n9, .5, 0, .5\n10, 0, .5, .5
*ELEMENT, TYPE=C3D10
1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10
*SURFACE, NAME=BELOW
1, S1
"""
curved = inspect(write(folder, "curved.inp", CURVED))
check(abs(curved["volume"] - 1 / 6 - 0.1 / 6) < 1e-12 and abs(curved["boundaries"][0]["area"] - 0.5 - 0.2 / 3) < 1e-12,
      f"{curved}")

# What makes nodes of others, or moves them, is told; the rest of what Abaqus and Nastran have is read.
FOUR = "*NODE\n1, 0, 0, 0\n2, 1.D0, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n"
ONE = "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n"
for text, words in (("*SYSTEM\n1, 0, 0\n" + FOUR + ONE, "*SYSTEM"), (FOUR + "*NGEN\n1, 4, 1\n" + ONE, "*NGEN"),
                    (FOUR + ONE + "*ELEMENT, TYPE=AC3D4\n2, 1, 2, 3, 4\n", "1 solid elements"),
                    ("*PART, NAME=A\n" + FOUR + ONE + "*END PART\n*PART, NAME=B\n" + FOUR, "ends within a part"),
                    ("*PART, NAME=A\n" + FOUR + ONE + "*END PART\n*PART, NAME=B\n" + FOUR + "*END PART\n", "no instance of them"),
                    ("*PART, NAME=A\n" + FOUR + ONE + "*END PART\n*INSTANCE, NAME=I, PART=B\n*END INSTANCE\n", "the part 'B', which is not before"), ("", "is empty")):
    done = run("mesh", write(folder, "told.inp", text), folder=folder)
    check(done.exit_code == 2 and words in done.errors, f"{words}: {done.errors}")
# CAE gives the nodes and the solids of a face one name: the nodes become its faces all the same, but for a name that has shells. Data
# lines may lie in files of their own.
write(folder, "nodes.txt", "3, 0, 1, 0\n4, 0, 0, 1\n")
write(folder, "tets.txt", "1, 1, 2, 3, 4\n")
SHELL = "*ELEMENT, TYPE=S3, ELSET=SHELL\n2, 1, 2, 3\n*NSET, NSET=shell\n1, 2, 3, 1\n*NSET, NSET=tip\n4, 4\n"
held = inspect(write(folder, "mark.inp", "\ufeff*NODE\n1, 0, 0, 0\n2, 1.D0, 0, 0\n*NODE, INPUT=nodes.txt\n"
                     "*ELEMENT, TYPE=C3D4, ELSET=E, INPUT=tets.txt\n*NSET, NSET=E, ELSET=e\n" + SHELL))
check(held["tets"] == 1 and {(b["name"], b["of"], b["count"]) for b in held["boundaries"]} ==
      {("E", "faces", 4), ("SHELL", "faces", 1), ("shell", "faces", 1), ("tip", "points", 1)}, f"{held}")
write(folder, "nodes.bdf", "GRID,1,,0.,0.,0. $ the first\nGRID,2,,1.,0.,0.\nGRID*,3,,0.,1.\n*,0.\n   $ more\nGRID    4               0.      0.      1.      $ up\n")
held = inspect(write(folder, "included.bdf", "BEGIN BULK\nCORD2R,1,,10.,,,10.,,1.\n,11.\nGRDSET,,1\nINCLUDE 'nodes\n.bdf' $ over two lines\nCTETRA,1,7,1,2,3,4\nENDDATA\n"))
check(held["low"] == [10, 0, 0] and held["high"] == [11, 1, 1], f"{held}")
PYRAMID = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,0.,0.,3.\nCPYRA,1,7,1,2,3,4,5\n"
check(abs(inspect(write(folder, "pyramid.fem", PYRAMID))["volume"] - 1) < 1e-12, "OptiStruct's pyramid")
done = run("mesh", write(folder, "odd.bdf", PYRAMID + "CHEX8,2,7,1,2,3,4,5,5\n,5,5\n"), folder=folder)
check(done.exit_code == 2 and "1 solid elements" in done.errors and "CHEX8" in done.errors, done.errors)

# I-deas: permanent groups; nodes in another coordinate system than the global one are refused.
UNV = f"""    -1
  2420
         1
Part
         1         0         8
CS1
{"    1.0D+00    0.0D+00    0.0D+00"}
{"    0.0D+00    1.0D+00    0.0D+00"}
{"    0.0D+00    0.0D+00    1.0D+00"}
{"    0.0D+00    0.0D+00    0.0D+00"}
    -1
    -1
  2411
{"".join(f"{n:10d}         1         1        11{chr(10)}{x}{chr(10)}" for n, x in enumerate(("0. 0. 0.", "1. 0. 0.", "0. 1. 0.", "0. 0. 1."), 1))}    -1
    -1
  2412
         1       111         1         1         7         4
         1         2         3         4
    -1
    -1
  2417
         1         0         0         0         0         0         0         1
wood
         8         1
    -1
"""
check([r["name"] for r in inspect(write(folder, "groups.unv", UNV))["regions"]] == ["wood"], "2417")
write(folder, "quote.unv", UNV.replace("wood", 'wood "x"'))
for name in "quote.msh", "quote.inp":
    done = run("mesh", "quote.unv", name, folder=folder)
    check(done.exit_code == 2 and "double quote" in done.errors and not os.path.exists(os.path.join(folder, name)), done.errors)
OLD = "    -1\n    18\n         1         0         0         8         1\nCS1\n 0. 0. 0. 1. 0. 0.\n 0. 0. 1.\n    -1\n"
for text in (UNV.replace("         0         8\nCS1", "         1         8\nCS1"), UNV.replace("    0.0D+00\n    -1", "    5.0D+00\n    -1"),
             OLD + UNV):
    done = run("mesh", write(folder, "turned.unv", text), folder=folder)
    check(text != UNV and done.exit_code == 2 and "coordinate system 1" in done.errors, done.errors)

# Parts and their instances, moved and turned: sets have the instance's name before theirs, numbers of the second begin at 1000000000;
# the assembly's own node (a reference point) has a number that the first instance has too. An independent instance has its own mesh.
PARTS = f"""*PART, NAME=Arm
{FOUR}{ONE}*NSET, NSET=TIP
4
*ELSET, ELSET=BONE
1
*SURFACE, NAME=FOOT
BONE, S1
*SOLID SECTION, ELSET=BONE, MATERIAL=M
*END PART
*PART, NAME=Empty
*END PART
*ASSEMBLY, NAME=Assembly
*INSTANCE, NAME=Arm-1, PART=Arm
*END INSTANCE
*INSTANCE, NAME=Arm-2, PART=Arm
 10., 0., 0.
 10., 0., 0., 10., 0., 1., 90.
*END INSTANCE
*INSTANCE, NAME=Own-1, PART=Empty
0., 0., 7.
{FOUR}{ONE}*END INSTANCE
*NODE
1, 5., 5., 5.
*NSET, NSET=RP
1
*NSET, NSET=second, INSTANCE=Arm-2
1, 2
*NSET, NSET=all-tips
Arm-1.TIP, Arm-2.TIP
*ELSET, ELSET=_s, INTERNAL, INSTANCE=Arm-2
1
*SURFACE, NAME=side
_s, S1
*END ASSEMBLY
"""
held = inspect(write(folder, "parts.inp", PARTS), "parts.vtu")
check([(r["name"], r["tets"]) for r in held["regions"]][:2] == [("Arm-1.BONE", 1), ("Arm-2.BONE", 1)] and held["tets"] == 3 and
      abs(held["volume"] - 0.5) < 1e-12, f"{held}")
groups = {b["name"]: (b["of"], b["count"]) for b in held["boundaries"]}
check(groups == {"Arm-1.TIP": ("points", 1), "Arm-2.TIP": ("points", 1), "Arm-1.FOOT": ("faces", 1), "Arm-2.FOOT": ("faces", 1),
                 "RP": ("points", 0), "second": ("points", 2), "all-tips": ("points", 2), "side": ("faces", 1)}, f"{groups}")
check(held["low"] == [0, 0, 0] and np.allclose(held["high"], [10, 1, 8]), f"{held}")  # the second one, turned, lies at x from 9 to 10
write(folder, "parts.yaml", """mesh: {file: parts.inp}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0}]
constraints: [{on: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, displacement: [0, 0, 0]},
              {on: {plane: {point: [0, 0, 7], normal: [0, 0, 1]}}, displacement: [0, 0, 0]}]
loads: [{on: {vertices: [1000000004]}, point_force: [0, 0, 0.001]}]
watch: {tip: {displacement: {nearest: [10, 0, 1]}, component: z}, first: {displacement: {nearest: [0, 0, 1]}, component: z}}
""")
done = run("solve", "parts.yaml", "-q", "--json", "-", "--output", "out.vtkhdf", folder=folder)
check(done.exit_code == 0, done.errors)
watched = json.loads(done.output)["watched"]
check(abs(watched["tip"]["value"] - 0.006) < 1e-6 and watched["first"]["value"] == 0, f"{watched}")  # F = E V u / h^2

# MEDIT's quadratic solids, whose nodes may be in any order behind the vertices. The bodies are sheared by x + y z / 5, which keeps volumes.
CORNERS = {"HexahedraQ2": ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)),
           "PrismsP2": ((0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (0, 2, 2)),
           "PyramidsP2": ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2)), "QuadrilateralsQ2": ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0))}
EDGES = {"HexahedraQ2": "01 12 23 30 45 56 67 74 04 15 26 37 0123 4567 0145 1256 2367 3704 01234567",
         "PrismsP2": "01 12 20 34 45 53 03 14 25 0143 1254 2035", "PyramidsP2": "01 12 23 30 04 14 24 34 0123", "QuadrilateralsQ2": "01 12 23 30 0123"}


def medit(shapes, seed):
    nodes, lines = {}, []
    for word in shapes:
        at = [np.array(corner) / 2 for corner in CORNERS[word]]
        middles = [np.mean([at[int(c)] for c in ends], axis=0) for ends in EDGES[word].split()]
        np.random.default_rng(seed).shuffle(middles)
        numbers = [nodes.setdefault(tuple(x), len(nodes) + 1) for x in at + middles]
        lines += [f"{word}\n1", " ".join(map(str, numbers)) + " 3"]
    vertices = [f"{x + y * z / 5} {y} {z} 0" for x, y, z in nodes]
    return "\n".join(["MeshVersionFormatted 2", "Dimension 3", f"Vertices {len(vertices)}", *vertices, *lines, "End", ""])


for seed, (shapes, volume) in enumerate(((("HexahedraQ2", "QuadrilateralsQ2"), 1), (("PrismsP2",), 1 / 2), (("PyramidsP2", "QuadrilateralsQ2"), 1 / 3))):
    held = inspect(write(folder, "middles.mesh", medit(shapes, seed)))
    check(held["order"] == 2 and abs(held["volume"] - volume) < 1e-12 and held["regions"][0]["name"] == "volume-3", f"{shapes}: {held}")
    check([(b["count"], round(b["area"], 12)) for b in held["boundaries"]] == ([(2, 1)] if len(shapes) > 1 else []), f"{held['boundaries']}")

# A VTKHDF file of another program, in two pieces: a hexahedron and its face, and a wedge beside it, with points of their own.
with h5py.File(os.path.join(folder, "other.vtkhdf"), "w") as file:
    group = file.create_group("VTKHDF")
    group.attrs["Version"] = [2, 0]
    group.attrs.create("Type", np.bytes_("UnstructuredGrid"))
    group["Points"] = np.array([*CORNERS["HexahedraQ2"], (2, 0, 0), (4, 0, 0), (2, 2, 0), (2, 0, 2), (4, 0, 2), (2, 2, 2)]) / 2
    group["NumberOfPoints"], group["NumberOfCells"], group["NumberOfConnectivityIds"] = [8, 6], [2, 1], [12, 6]
    group["Types"] = np.array([12, 9, 13], dtype=np.uint8)
    group["Offsets"], group["Connectivity"] = [0, 8, 12, 0, 6], [*range(8), 0, 4, 7, 3, *range(6)]
    group["CellData/region"], group["CellData/modulus"] = [4, 6, 5], [1000, 0, 2000]
held = inspect("other.vtkhdf")
check({r["name"]: round(r["volume"], 12) for r in held["regions"]} == {"volume-4": 1, "volume-5": 0.5} and
      [(b["name"], b["count"], b["area"]) for b in held["boundaries"]] == [("surface-6", 2, 1)] and
      len(held["components"]) == 1 and held["misfit_faces"] == held["cracked_faces"] == 0, f"{held}")
write(folder, "other.yaml", """mesh: {file: other.vtkhdf}
materials: [{region: all, youngs_modulus: {field: modulus}, poissons_ratio: 0}]
constraints: [{on: {boundary: surface-6}, displacement: [0, 0, 0]}, {on: {plane: {point: [1, 0, 0], normal: [1, 0, 0]}}, displacement: [0.1, free, free]}]
large_rotation: off
watch: {pull: {reaction: {boundary: surface-6}, component: x}}
""")
for ranks in fewer([1, 2]):
    done = run("solve", "other.yaml", "-q", "--json", "-", "--output", "out.vtkhdf", ranks=ranks, folder=folder)
    check(done.exit_code == 0 and abs(json.loads(done.output)["watched"]["pull"]["value"] + 100) < 1e-5, done.errors + done.output)



# Pieces share points by their numbers, else by their places; where these are two in one piece, as on the sides of a crack, they are
# refused with the way out. Tets are read by all ranks, other cells by one; a .vtu has pieces too.
def in_pieces(name, kind, points, cells, numbers=None):
    at, names = [len(p) for p in points], {"numbers": "GlobalNodeId"}
    if name.endswith(".vtu"):
        def array(word, values, of="Int64", more=""):
            return f'<DataArray type="{of}" Name="{word}" {more} format="ascii">{" ".join(map(str, np.ravel(values)))}</DataArray>'
        pieces = [f'<Piece NumberOfPoints="{len(p)}" NumberOfCells="{len(c)}"><Points>' + array("p", p, "Float64", 'NumberOfComponents="3"') +
                  "</Points><Cells>" + array("connectivity", c) + array("offsets", [len(c[0]) * (i + 1) for i in range(len(c))]) +
                  array("types", [kind] * len(c)) + "</Cells>" +
                  (f'<PointData>{array(names["numbers"], numbers[i])}</PointData>' if numbers else "") + "</Piece>" for i, (p, c) in enumerate(zip(points, cells))]
        return write(folder, name, '<VTKFile type="UnstructuredGrid" version="1.0" header_type="UInt64"><UnstructuredGrid>' +
                     "".join(pieces) + "</UnstructuredGrid></VTKFile>")
    with h5py.File(os.path.join(folder, name), "w") as file:
        group = file.create_group("VTKHDF")
        group.attrs["Version"] = [2, 0]
        group.attrs.create("Type", np.bytes_("UnstructuredGrid"))
        group["Points"], group["NumberOfPoints"] = np.concatenate(points).astype(float), at
        group["NumberOfCells"], group["NumberOfConnectivityIds"] = [len(c) for c in cells], [np.size(c) for c in cells]
        group["Types"] = np.full(sum(map(len, cells)), kind, dtype=np.uint8)
        group["Offsets"] = np.concatenate([np.arange(len(c) + 1) * len(c[0]) for c in cells])
        group["Connectivity"] = np.concatenate([np.ravel(c) for c in cells])
        if numbers:
            group["PointData/" + names["numbers"]] = np.concatenate(numbers)
    return name


# What VTK marks as hidden, or as another piece's, is no part of the body.
ghosts = in_pieces("ghosts.vtkhdf", 10, [np.eye(4)[:, :3], np.eye(4)[:, :3] * 2], [[range(4)], [range(4)]])
with h5py.File(os.path.join(folder, ghosts), "a") as file:
    file["VTKHDF/CellData/vtkGhostType"] = np.array([0, 32], dtype=np.uint8)
text = open(os.path.join(folder, in_pieces("hidden.vtu", 10, [np.eye(4)[:, :3]] * 2, [[range(4)]] * 2))).read().split("</Piece>")
mark = '<CellData><DataArray type="UInt8" Name="vtkGhostType" format="ascii">{}</DataArray></CellData></Piece>'
write(folder, "hidden.vtu", text[0] + mark.format(0) + text[1] + mark.format(1) + text[2])
for name in ghosts, "hidden.vtu":
    done = run("mesh", name, "--json", "-", folder=folder)
    held = json.loads(done.output)
    check(held["tets"] == 1 and abs(held["volume"] - 1 / 6) < 1e-12 and "vtkGhostType" in done.errors, f"{name}: {held} {done.errors}")

CUBE = np.array(CORNERS["HexahedraQ2"]) / 2
TET = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
for kind, first, second, shared in ((12, CUBE, CUBE + (1, 0, 0), 4), (10, TET, np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)], dtype=float), 3)):
    n = len(first)
    both = sorted(set(map(tuple, first)) | set(map(tuple, second)))
    numbers = [[both.index(tuple(x)) for x in piece] for piece in (first, second)]
    twice = np.concatenate([second, second])  # a body on itself: only numbers tell which one the first piece shares
    apart = numbers[1] + [100 + i for i in range(n)]
    for ending in (".vtkhdf", ".vtu"):
        for numbered in (None, numbers):
            held = inspect(in_pieces("pieces" + ending, kind, [first, second], [[range(n)], [range(n)]], numbered))
            check(held["nodes"] == 2 * n - shared and len(held["components"]) == 1, f"{kind} {ending} {numbered}: {held}")
        if ending == ".vtu": # a list of files has a piece in each
            for part, points in (("first.vtu", first), ("second.vtu", second)):
                in_pieces(part, kind, [points], [[range(n)]])
            listed = '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="first.vtu"/><Piece Source="second.vtu"/></PUnstructuredGrid></VTKFile>'
            held = inspect(write(folder, "parts.pvtu", listed))
            check(held["nodes"] == 2 * n - shared and len(held["components"]) == 1, f"{kind} .pvtu: {held}")
            solved = run("solve", "parts.pvtu", folder=folder)
            check("parts.pvtu: a mesh; expected a case, a YAML file that names it, mesh: {file: parts.pvtu}" in solved.errors, solved.errors)
            lost = run("mesh", write(folder, "lost.pvtu", listed.replace("second", "lost")), folder=folder)
            check(lost.exit_code == 2 and "lost.pvtu:1: names a file that is to be read here: " in lost.errors, lost.errors)
        name = in_pieces("pieces" + ending, kind, [first, twice], [[range(n)], [range(n), range(n, 2 * n)]])
        refused = run("mesh", name, folder=folder)
        check(refused.exit_code == 2 and "GlobalNodeId" in refused.errors, f"{kind} {ending}: {refused.errors}")
        held = inspect(in_pieces("pieces" + ending, kind, [first, twice], [[range(n)], [range(n), range(n, 2 * n)]], [numbers[0], apart]))
        check(held["nodes"] == 3 * n - shared and len(held["components"]) == 2, f"{kind} {ending}: {held}")

# Names in quotes have blanks and commas, and keep their small letters; other names are the same in capitals. Blanks in keywords do
# not count, and sets may come with their instance.
QUOTED = """*Heading
 a model
** comment
*Preprint, echo=NO
*Part, name="part one"
*Node
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 1., 1., 1.
*Element, type=C3D4
1, 1, 2, 3, 4
2, 2, 3, 4, 5
*Nset, nset="Set A, left", internal
1, 2, 3
*Elset, elset="part one"
1,
*Elset, elset=Rest
 2
*Solid Section, elset="part one", material="Material 1"
,
*Solid  Section, ELSET=REST, material=m
,
*End Part
*Assembly, name=Assembly
*Instance, name="part one-1", part="part one"
          0.,          0.,          2.
*End Instance
*Nset, nset=tip, instance="part one-1"
 5,
*Nset, nset=both
 TIP, "part one-1"."Set A, left"
*Elset, elset=_Surf-1_S1, internal, instance="part one-1"
 1
*Surface, type=ELEMENT, name="my surf"
_surf-1_S1, s1
*End Assembly
*Material, name="Material 1"
*Elastic
1., .3
"""
first = inspect(write(folder, "quoted.inp", QUOTED), "again.inp")
for named in (first, inspect("again.inp")):
    check({r["name"]: r["tets"] for r in named["regions"]} == {"part one": 1, "Rest": 1}, f"{named['regions']}")
    check({(b["name"], b["of"], b["count"]) for b in named["boundaries"]} ==
          {("Set A, left", "faces", 1), ("both", "faces", 2), ("my surf", "faces", 1), ("tip", "points", 1)},
          f"{named['boundaries']}")

# VTK's packers: LZ4 is read, LZMA refused where it packs anything.
source, writer = vtkXMLUnstructuredGridReader(), vtkXMLUnstructuredGridWriter()
source.SetFileName(os.path.join(SOURCE, "tests", "formats", "exchange", "meshio-linear-zlib.vtu"))
writer.SetInputConnection(source.GetOutputPort())
for packer, mode, taken in (("LZ4", "Appended", True), ("LZ4", "Binary", True), ("LZMA", "Ascii", True), ("LZMA", "Binary", False)):
    getattr(writer, "SetCompressorTypeTo" + packer)()
    getattr(writer, "SetDataModeTo" + mode)()
    writer.SetFileName(os.path.join(folder, "packed.vtu"))
    writer.Write()
    done = run("mesh", "packed.vtu", folder=folder)
    check(done.exit_code == (0 if taken else 2) and ("48 linear tets" in done.output if taken else "zlib nor LZ4" in done.errors),
          f"{packer} {mode}: {done.output} {done.errors}")
