"""Meshes of other programs give the answer of the .msh file that they were made from; `orthostat mesh` inspects, converts,
refines, merges and orients."""
import json
import os
import re
import subprocess
import sys

import meshio
import numpy as np

from program import SOURCE, check, fewer, new_folder, run, write

STORED = os.path.join(SOURCE, "tests", "formats", "exchange")
folder = new_folder()

# --- the same answer ---

CASE = """mesh: {{file: {mesh}}}
materials: [{{region: all, youngs_modulus: [1e3, 2e3, 5e2], poissons_ratio: 0.3}}]
constraints: [{{on: {{boundary: {clamp}}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{plane: {{point: [2, 0, 0], normal: [1, 0, 0]}}}}, total_force: [1, 2, 3]}}]
large_rotation: off
accuracy: {{relative_residual: 1e-11}}
watch: {{end: {{displacement: {{nearest: [2, 1, 1]}}}}, energy: strain_energy}}
"""


def answer(mesh, clamp, ranks=1):
    path = os.path.join(folder, "case.yaml")
    with open(path, "w") as stream:
        stream.write(CASE.format(mesh=mesh, clamp=clamp))
    done = run("solve", path, "-q", "--json", "-", "--output", os.path.join(folder, "out.vtkhdf"), ranks=ranks)
    check(done.exit_code == 0, f"{mesh}: {done.errors}")
    report = json.loads(done.output)
    watched, reading = report["watched"], [a for a in report["ledger"]["accounts"] if a["name"] == "mesh"][0]
    check(reading["entries"] == 1 and reading["seconds"] > 0 and reading["bytes"] >= 24 * report["vertices"],
          f"{mesh}: what is read is not booked to the mesh: {reading}")
    return [watched["end"]["value"], watched["energy"]["value"]]


for order, source in (("linear", "gmsh2-binary"), ("quadratic", "gmsh41-quadratic-binary")):
    expected = answer(os.path.join(SOURCE, "tests", "formats", "msh", source + ".msh"), "clamp")
    names = {"linear": [("cae-linear.inp", "Clamp"), ("meshio-linear-zlib.vtu", "surface-7")],
             "quadratic": [("cae-quadratic.inp", "Clamp"), ("gmsh-quadratic.mesh", "surface-1"),
                           ("gmsh-quadratic.unv", "clamp"), ("gmsh-quadratic.bdf", "surface-1")]}[order]
    for name, clamp in fewer(names):
        for ranks in (1, 3) if name.startswith("cae-linear") else (1,):
            found = answer(os.path.join(STORED, name), clamp, ranks)
            # Nastran's small fields and Abaqus's file have eight digits
            check(all(abs(a - b) < 1e-7 * abs(b) for a, b in zip(found, expected)), f"{name}: {found}, expected {expected}")

# --- as programs write them ---


def stored(name):
    return os.path.join(STORED, name)


NODES = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
CARDS = NODES + "CTETRA,1,7,1,2,3,4\nCTRIA3,2,5,1,2,3\n"
DECK = f"SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\n{CARDS}ENDDATA\n"
WORDS = open(os.path.join(STORED, "gmsh-linear.mesh")).read()
MSH = open(os.path.join(SOURCE, "tests", "formats", "msh", "gmsh2-binary.msh"), "rb").read()
with open(os.path.join(folder, "binary.msh22"), "wb") as stream:
    stream.write(MSH)
for name, text, tets, regions in (
        ("deck.bdf", DECK, 1, ["volume-7"]), ("cards.bdf", CARDS, 1, ["volume-7"]),
        ("tabs.bdf", CARDS.replace(",", "\t"), 1, ["volume-7"]),
        ("meshio.bdf", CARDS.replace("1,7,", "1,,").replace("2,5,", "2,,"), 1, ["volume"]),
        ("hypermesh.fem", f'$HMNAME PROP       7"soft wood" 4\n$HMSET 3 1 "held" 18\n$HMSETTYPE 3 "formula"\nSET,3,GRID,LIST\n+,1,THRU,3\n'
                          f"SET     4       GRID\n+       2       3\nSET,5,ELEM,LIST\n+,1\n{CARDS}", 1, ["soft wood"]),
        ("ansa.nas", f"$ANSA_NAME_COMMENT;7;PSOLID;wood;;NO;NO;\n{CARDS}", 1, ["wood"]),
        ("ansa-old.nas", f"$ANSA_NAME;7;PSOLID;~\n$wood\n$bark\n{CARDS}", 1, ["wood"]),
        ("femap.bdf", f"$ Femap with NX Nastran Property 7 : soft wood\n{CARDS}", 1, ["soft wood"]),
        ("femap-old.bdf", f"$ FEMAP Property 7 : Untitled\n{CARDS}", 1, ["volume-7"]),
        ("patran.bdf", "$ Elements and Element Properties for region : wood \nPARAM,POST,0\nPSOLID,7,1\nPSOLID,8,1\n" + CARDS, 1, ["wood"]),
        ("simcenter.bdf", f"$*  Property: wood\nPSOLID,7,1\n{CARDS}", 1, ["wood"]),
        ("words.meshb", WORDS, 48, ["volume-1", "volume-2"]), ("binary.msh22", None, 48, ["left", "right"])):
    done = run("mesh", write(folder, name, text) if text else name, "--json", "-", folder=folder)
    check(done.exit_code == 0, f"{name}: {done.errors}")
    held = json.loads(done.output)
    check((held["tets"], [r["name"] for r in held["regions"]]) == (tets, regions), f"{name}: {held}")
    boundaries = {b["name"] for b in held["boundaries"]}
    check("hypermesh" not in name or boundaries == {"surface-5", "held", "set-4"}, f"{name}: {boundaries}")
    check(name != "meshio.bdf" or boundaries == {"surface-0"}, f"{name}: {boundaries}")

# meshio calls quadratic solids CTETRA_ and the like.
CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
for kind, corners, edges in (
        ("tetra10", CUBE[[0, 1, 3, 4]], ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))),
        ("hexahedron20", CUBE, ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)))):
    points = np.vstack([corners, [(corners[a] + corners[b]) / 2 for a, b in edges]])
    meshio.write(os.path.join(folder, "quadratic.bdf"), meshio.Mesh(points, [(kind, [list(range(len(points)))])]))
    done = run("mesh", "quadratic.bdf", "--json", "-", folder=folder)
    check(done.exit_code == 0 and abs(json.loads(done.output)["volume"] - (1 if kind[0] == "h" else 1 / 6)) < 1e-7, f"{kind}: {done.errors}")

# Nodes in coordinate systems, each of another: at (10, 0, 0), and one along each axis from there.
SYSTEMS = """CORD2C,2,1,,,,,,1.
,1.
GRID,1,2,0.,0.,0.
GRID,2,2,1.,90.,0.
GRID,3,1,1.,0.,0.
GRID,4,3,11.,90.,0.
CORD2R,1,,10.,,,11.,,
,10.,1.
CORD2S,3,,,,,,,1.
,1.
CTETRA,1,7,1,2,3,4
"""
done = run("mesh", write(folder, "systems.bdf", SYSTEMS), "--json", "-", folder=folder)
held = json.loads(done.output)
check(np.allclose([*held["low"], *held["high"], held["volume"]], [10, 0, 0, 11, 1, 1, 1 / 6], atol=1e-12), f"{held}")

# A surface that no tet has: the message speaks of it, and not of where the body lies.
STRAY = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "foot"
3 2 "body"
$EndPhysicalNames
$Nodes
7
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 9
6 1 0 9
7 0 1 9
$EndNodes
$Elements
2
1 2 2 1 1 5 6 7
2 4 2 2 2 1 2 3 4
$EndElements
"""
write(folder, "stray.yaml", CASE.format(mesh=write(folder, "stray.msh", STRAY), clamp="foot"))
done = run("check", "stray.yaml", folder=folder)
check(done.exit_code == 2 and "stray.yaml:3:" in done.errors and "boundary 'foot'" in done.errors and
      "on no tet" in done.errors, done.errors)

# An array of equal numbers, as of the one region of a large body, is packed to a thousandth by zlib.
done = run("mesh", stored("gmsh-linear.mesh"), "large.vtu", "--refine", "3", "-q", folder=folder)
large = meshio.read(os.path.join(folder, "large.vtu"))
tets = [cells for cells in large.cells if cells.type == "tetra"]
meshio.write(os.path.join(folder, "equal.vtu"),
             meshio.Mesh(large.points, tets, cell_data={"region": [np.full(len(tets[0].data), 7, dtype=np.int64)]}))
done = run("mesh", "equal.vtu", folder=folder)
check(done.exit_code == 0 and "volume-7" in done.output and "24576" in done.output, done.errors)

# meshio's sets of points are references of vertices, -1 where there is none.
meshio.write(os.path.join(folder, "sets.meshb"),
             meshio.Mesh(large.points, tets, point_sets={"few": np.arange(9)}, cell_data={"region": [np.full(len(tets[0].data), 7)]}))
done = run("mesh", "sets.meshb", folder=folder)
check(done.exit_code == 0 and "volume-7" in done.output and "24576" in done.output, done.errors)

# Bulk data that were cut off at a line's end.
done = run("mesh", write(folder, "short.bdf", DECK.replace("ENDDATA\n", "")), folder=folder)
check(done.exit_code == 0 and "no ENDDATA: is the file complete?" in done.errors, done.errors)
check(not run("mesh", "deck.bdf", folder=folder).errors, "a whole deck is warned of")

# Abaqus: a coordinate that is left out is 0.
blanks = write(folder, "blanks.inp", "*NODE\n1\n2, 1., ,\n3,,1.\n4, , ,1.\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n")
held = json.loads(run("mesh", blanks, "--json", "-", folder=folder).output)
check([*held["low"], *held["high"], round(6 * held["volume"], 12)] == [0, 0, 0, 1, 1, 1, 1], f"{held}")

# VTK's attributes beside the data, as its writer has them, in text and in bytes; names with blanks.
def vtk(numbers):
    """A grid of two tets; `numbers`: its arrays of big-endian types, as the file has them."""
    return b"".join(part.encode() if isinstance(part, str) else numbers(*part) + b"\n" for part in (
        "# vtk DataFile Version 4.2\ntwo\n" + ("BINARY" if numbers is as_bytes else "ASCII") + "\nDATASET UNSTRUCTURED_GRID\n"
        "POINTS 5 double\n", (">f8", [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]),
        "CELLS 2 10\n", (">i4", [4, 0, 1, 2, 3, 4, 1, 2, 3, 4]), "CELL_TYPES 2\n", (">i4", [10, 10]),
        "CELL_DATA 2\nSCALARS material int\nLOOKUP_TABLE rainbow\n", (">i4", [0, 3]),
        "LOOKUP_TABLE rainbow 2\n", ("u1", [1, 0, 0, 1, 0, 1, 0, 1]), "TENSORS6 t double\n", (">f8", range(12)),
        "GLOBAL_IDS GlobalElementId vtkIdType\n", (">i4", [0, 1]), "PEDIGREE_IDS of vtkIdType\n", (">i4", [4, 5]),
        "FIELD FieldData 1\nYoung%20E%25 1 2 double\n", (">f8", [10, 20]),
        "POINT_DATA 5\nCOLOR_SCALARS rgb 3\n", ("u1", [0] * 15), "NORMALS n double\n", (">f8", [0] * 15),
        "TEXTURE_COORDINATES tc 2 double\n", (">f8", [0] * 10), "EDGE_FLAGS e int\n", (">i4", [0] * 5)))


def as_bytes(kind, values):
    return np.array(values, kind).tobytes()


def as_text(_, values):
    return " ".join(map(str, values)).encode()


moved = set()
for name, numbers in ("bytes", as_bytes), ("text", as_text):
    write(folder, name + ".vtk", vtk(numbers))
    write(folder, "attributes.yaml", f"""mesh: {{file: {name}.vtk}}
materials: [{{region: all, youngs_modulus: {{field: Young E%}}, poissons_ratio: 0.3}}]
constraints: [{{on: {{vertices: [1, 2, 3]}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{vertices: [5]}}, point_force: [0, 0, -0.001]}}]
watch: {{energy: strain_energy}}
""")
    done = run("solve", "attributes.yaml", "--json", "-", "--output", "attributes.vtu", folder=folder)
    check(done.exit_code == 0, done.errors)
    report = json.loads(done.output)
    moved.add(report["watched"]["energy"]["value"])
    held = json.loads(run("mesh", name + ".vtk", "--json", "-", folder=folder).output)
    check([r["name"] for r in held["regions"]] == ["volume-0", "volume-3"], f"{held}")
check(len(moved) == 1, f"{moved}")
done = run("mesh", write(folder, "much.vtk", vtk(as_bytes).replace(b"rgb 3", b"rgb 9999999")), folder=folder)
check(done.exit_code == 2 and "colours stated, which do not fit" in done.errors, done.errors)

# A text that was cut off is told so; a case is no mesh.
text = open(stored("gmsh-linear.unv")).read()
cut = text[:text.index("\n", len(text) // 3) - 2]
done = run("mesh", write(folder, "cut.unv", cut), folder=folder)
check(done.exit_code == 2 and "cut.unv:" in done.errors and "is it complete?" in done.errors, done.errors)
done = run("mesh", "a body.su2", folder=folder)
check("meshio.read('a body.su2').write('a body.vtu')" in done.errors, done.errors)
done = run("mesh", "case.yaml", folder=folder)
check(done.exit_code == 2 and "orthostat check case.yaml" in done.errors, done.errors)

# --- inspect ---


def inspect(*arguments, ranks=1):
    done = run("mesh", *arguments, "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, f"mesh {arguments}: {done.errors}")
    return json.loads(done.output)


for ranks in fewer([1, 2, 4]):
    counts = inspect(stored("cae-quadratic.inp"), ranks=ranks)
    check((counts["tets"], counts["nodes"], counts["order"], counts["surface_faces"]) == (48, 113, 2, 40), f"{counts}")
    check([r["name"] for r in counts["regions"]] == ["Left", "Right"], f"{counts['regions']}")
    check(all(r["tets"] == 24 and abs(r["volume"] - 1) < 1e-9 for r in counts["regions"]), f"{counts['regions']}")
    check([(b["name"], b["of"], b["count"]) for b in counts["boundaries"]] ==
          [("Clamp", "faces", 4), ("End", "faces", 4), ("Everything", "points", 113)], f"{counts['boundaries']}")
    check(abs(counts["boundaries"][0]["area"] - 1) < 1e-9, "the clamp's area")
    check(sum(counts["quality"]["histogram"]) == 48 and 0 < counts["quality"]["least"] < counts["quality"]["mean"] < 1,
          f"{counts['quality']}")
    check(len(counts["components"]) == 1 and counts["coincident_vertices"] == 0, "one component")
said = run("mesh", stored("cae-linear.inp"), folder=folder).output
check("48 linear tets" in said and "Clamp" in said and "least" in said, said)

# --- convert, there and back ---

for ranks in fewer([1, 3]):
    for ending in ("msh", "inp", "vtu", "vtkhdf", "hdf"):
        new = f"new-{ranks}.{ending}"
        inspect(stored("cae-quadratic.inp"), new, ranks=ranks)
        again = inspect(new)
        for key in ("tets", "nodes", "order", "surface_faces"):
            check(again[key] == counts[key], f"{new}: {key} {again[key]}")
        for region, as_before in zip(again["regions"], counts["regions"]):
            check((region["name"], region["tets"]) == (as_before["name"], as_before["tets"]) and
                  abs(region["volume"] - 1) < 1e-9, f"{new}: {again['regions']}")
        check({b["name"]: b["count"] for b in again["boundaries"]} == {b["name"]: b["count"] for b in counts["boundaries"]},
              f"{new}: {again['boundaries']}")
for ending in ("msh", "inp", "vtu"):
    if len(fewer([1, 3])) == 2:
        texts = [open(os.path.join(folder, f"new-{ranks}.{ending}")).read() for ranks in (1, 3)]
        check(texts[0] == texts[1], f"{ending}: what is written depends on the number of ranks")
for order, points, kinds in (("linear", 23, {"tetra": 48, "triangle": 4}), ("quadratic", 113, {"tetra10": 48, "triangle6": 4})):
    inspect(stored(f"gmsh-{order}.mesh"), f"{order}.vtu")
    other = meshio.read(os.path.join(folder, f"{order}.vtu"))
    count = {}
    for block in other.cells:
        count[block.type] = count.get(block.type, 0) + len(block.data)
    check(len(other.points) == points and count == kinds, f"meshio finds {len(other.points)} points and {count}")
    check(sorted(set(np.concatenate(other.cell_data["region"]))) == [1, 2, 3], "numbers of regions and boundaries")
    kept = inspect(f"{order}.vtu")
    check([r["name"] for r in kept["regions"]] == ["volume-1", "volume-2"] and kept["boundaries"][0]["name"] == "surface-1",
          f"{kept['regions']} {kept['boundaries']}")

# the material axes of a result go along
AXES = "axes: {curve: {points: [[0, 0, 0], [1, 0, 0.1], [2, 0, 0.4]], up: [0, 0, 1]}}}]"
CURVED = f"""mesh: {{block: {{size: [2, 1, 1], divisions: [2, 1, 1]}}}}
materials: [{{region: all, youngs_modulus: [1, 2, 3], poissons_ratio: 0.3, {AXES}
constraints: [{{on: {{boundary: xmin}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{plane: {{point: [2, 0, 0], normal: [1, 0, 0]}}}}, total_force: [0.001, 0, 0]}}]
watch: {{energy: strain_energy}}
"""
write(folder, "curved.yaml", CURVED)
energy = json.loads(run("solve", "curved.yaml", "-q", "--json", "-", "--output", "curved.vtkhdf", folder=folder).output)["watched"]["energy"]["value"]
for ending in ("msh", "vtu", "inp"):
    made = run("mesh", "curved.vtkhdf", "curved." + ending, folder=folder)
    check(made.exit_code == 0 and ("material axes" in made.errors) == (ending == "inp"), made.errors)
    if ending != "inp":
        write(folder, "again.yaml", CURVED.replace(AXES, "axes: {field: axes}}]").replace(
            "{block: {size: [2, 1, 1], divisions: [2, 1, 1]}}", "{file: curved." + ending + "}"))
        again = run("solve", "again.yaml", "-q", "--json", "-", "--output", "again.vtkhdf", ranks=fewer([2])[0], folder=folder)
        check(abs(json.loads(again.output)["watched"]["energy"]["value"] - energy) < 1e-6 * energy, f"{ending}: {again.errors}")
bad = run("mesh", stored("cae-linear.inp"), "new.stl", folder=folder)
check(bad.exit_code == 2 and ".msh" in bad.errors and ".vtu" in bad.errors, bad.errors)

# --- Abaqus's names ---

# In quotes to the letter, blanks at the ends among it; others in any capitals. Sets of other names stay apart.
NAMES = ['"top side"', "tip", '"X"', '"x"', '"x "', "Y", "y"]
INP = "*NODE\n" + "".join(f"{4 * k + 1 + i}, {2 * k + (i == 1)}, {int(i == 2)}, {int(i == 3)}\n" for k in range(7) for i in range(4))
INP += "".join(f"*ELEMENT, TYPE=C3D4, ELSET={name}\n{1 + k}, {4 * k + 1}, {4 * k + 2}, {4 * k + 3}, {4 * k + 4}\n"
               for k, name in enumerate(NAMES))
write(folder, "names.inp", INP)
EXPECTED = {"top side": 1, "tip": 1, "X": 1, "x": 1, "x ": 1, "Y": 2}
for name in ("names.inp", "names.msh", "again.inp", "again.vtu", "last.inp"):
    held = inspect(name)
    check({r["name"]: r["tets"] for r in held["regions"]} == EXPECTED, f"{name}: {held['regions']}")
    if name != "last.inp":
        inspect(name, {"names.inp": "names.msh", "names.msh": "again.inp", "again.inp": "again.vtu"}.get(name, "last.inp"))
done = run("mesh", write(folder, "long.inp", INP.replace("tip", "t" * 127)), folder=folder)
check(done.exit_code == 2 and "long.inp:32:" in done.errors and "longer than 126 letters" in done.errors, done.errors)

# --- meshio's sets, and whole numbers that look like them ---

cubes = meshio.read(stored("meshio-linear-ascii.vtu"))
TETS = [block for block in cubes.cells if block.type == "tetra"][0].data
FIRST = np.arange(len(TETS)) < 24


def by_meshio(names=(), data=None):
    """Regions of a file in which meshio has written these sets, or these numbers of cells, and what is said of them."""
    made = meshio.Mesh(cubes.points, [("tetra", TETS)], cell_data={key: [value] for key, value in (data or {}).items()})
    if names:
        made.cell_sets = {name: [np.where(FIRST == (k == 0))[0]] for k, name in enumerate(names)}
    made.write(os.path.join(folder, "sets.vtu"))
    said = run("mesh", "sets.vtu", "-v", folder=folder)
    return [region["name"] for region in inspect("sets.vtu")["regions"]], said.output + said.errors


NUMBERS = FIRST.astype(int)
for name in ("netgen:index", "su2:tag", "part_id", "mat_id", "MeshDomain"):
    found, _ = by_meshio(data={name: NUMBERS + 1})
    check(found == ["volume-1", "volume-2"], f"{name}: {found}")

# The command for Netgen's meshes keeps their regions, boundaries and names, which meshio's .vtu has no room for.
write(folder, "two.vol", """mesh3d
dimension
3
surfaceelements
2
1 1 1 0 3 1 2 3
2 2 2 0 3 3 4 5
volumeelements
2
1 4 1 2 3 4
2 4 2 3 4 5
points
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
materials
2
1 wood
2 knot
bcnames
2
1 wall
2 top
endmesh
""")
said = run("mesh", "two.vol", folder=folder)
command = re.search('python3 -c "([^"]*)"', said.errors)
check(said.exit_code == 2 and command, said.errors)
made = subprocess.run([sys.executable, "-c", command.group(1)], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
check(made.returncode == 0, made.stdout)
counts = inspect("two.msh")
check([r["name"] for r in counts["regions"]] == ["wood", "knot"] and
      {b["name"] for b in counts["boundaries"]} == {"wall", "top"}, str(counts))
for names, data, regions, words in (
        (["a", "b"], None, {"a", "b"}, "the numbers 'a-b' of cells are taken for 2 of meshio's sets"),
        (["a-1", "b-2"], None, {"a-1", "b-2"}, "'a-1_b-2' of cells are taken for 2"),
        (["a-1", "b"], None, {"a", "1_b"}, "after each '-', or each '_'"),
        ([], {"cell_id": NUMBERS}, {"volume"}, None),
        ([], {"a_b#c": NUMBERS}, {"volume"}, None),
        (["a", "b"], {"material": NUMBERS}, {"volume-0", "volume-1"}, "regions are the numbers 'material' of cells")):
    found, said = by_meshio(names, data)
    check(set(found) == regions and (words in said if words else "are taken for" not in said), f"{names} {data}: {found}\n{said}")

# --- refine, raise, merge, orient ---

fine = inspect(stored("tetgen-linear.ele"), "fine.msh", "--refine", "1")
check(fine["tets"] == 8 * 136 and abs(fine["volume"] - 2) < 1e-9, f"{fine['tets']} tets")
check(inspect(stored("tetgen-linear.ele"), "--element-order", "2")["order"] == 2, "raised")
check(inspect(stored("cae-quadratic.inp"), "--element-order", "1")["nodes"] == 23, "linear")

# A curved tet that folds over is sound as a straight one, but not where it is refined first.
TEN_NODES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0, 0), (2.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5), (0, 0.5, 0.5), (0.5, 0, 0.5)]
write(folder, "folded.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n" + "".join(
    "%d %g %g %g\n" % (n, *x) for n, x in enumerate(TEN_NODES, 1)) + "$EndNodes\n$Elements\n1\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n")
check(inspect("folded.msh", "straight.vtu", "--element-order", "1")["nodes"] == 4, "straight")
done = run("mesh", "folded.msh", "--element-order", "1", "--refine", "1", folder=folder)
check(done.exit_code == 2 and "folds over" in done.errors, done.errors)
write(folder, "folded.yaml", """mesh: {file: folded.msh}
element: {order: 1}
materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0.3}]
constraints: [{on: {vertices: [1, 2, 3]}, displacement: [0, 0, 0]}]
loads: [{on: {vertices: [4]}, point_force: [0, 0, -0.001]}]
""")
for order, wanted in ((1, 0), (2, 2)):
    done = run("check", "folded.yaml", "--set", f"element.order={order}", folder=folder)
    check(done.exit_code == wanted and ("folds over" in done.errors) == (order == 2), done.errors)

# TetGen counts from 1, or with -z from 0: `vertices` and messages have the file's numbers, what is written counts from 1.
CORNERS, TETS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)], [(0, 1, 2, 3), (1, 2, 3, 4)]
found = {}
for first in (0, 1):
    write(folder, f"from{first}.node", "5 3 0 0\n" + "".join("%d %g %g %g\n" % (n + first, *p) for n, p in enumerate(CORNERS)))
    write(folder, f"from{first}.ele",
          "2 4 0\n" + "".join("%d %d %d %d %d\n" % (t + first, *(n + first for n in tet)) for t, tet in enumerate(TETS)))
    for order in (1, 2):
        write(folder, "counted.yaml", f"""mesh: {{file: from{first}.node, refine: {order - 1}}}
element: {{order: {order}}}
materials: [{{region: all, youngs_modulus: 10, poissons_ratio: 0.3}}]
constraints: [{{on: {{plane: {{point: [0, 0, 0], normal: [0, 0, 1]}}}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{vertices: [{4 + first}]}}, point_force: [0, 0, -0.001]}}]
watch: {{tip: {{displacement: {{nearest: [1, 1, 1]}}}}}}
""")
        done = run("solve", "counted.yaml", "--json", "-", "--output", "counted.vtu", folder=folder)
        check(done.exit_code == 0 and ("numbered from 0" in done.errors) == (first == 0), done.errors)
        if order == 1:
            write(folder, "clash.yaml", open(os.path.join(folder, "counted.yaml")).read().replace(
                "constraints: [", f"constraints: [{{on: {{vertices: [{first}]}}, displacement: [1, 0, 0]}}, "))
            clash = run("check", "clash.yaml", folder=folder)
            check(clash.exit_code == 2 and f"vertex {first} is constrained to 1" in clash.errors, clash.errors)
            inspected = inspect(f"from{first}.node")
            check(inspected["components"][0]["first_tet"] == first, f"{inspected}")
        found[first, order] = json.loads(done.output)["watched"]["tip"]["value"]
    for ending in ("msh", "inp", "vtu"):
        inspect(f"from{first}.node", f"from{first}.{ending}", "--refine", "1", "--element-order", "2")
check(found[0, 1] == found[1, 1] and found[0, 2] == found[1, 2], f"{found}")
for ending in ("msh", "inp", "vtu"):
    check(open(os.path.join(folder, f"from0.{ending}")).read() == open(os.path.join(folder, f"from1.{ending}")).read(), ending)

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
write(folder, "two.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 8\n" + "".join("%g %g %g 0\n" % p for p in POINTS) +
             "Tetrahedra 2\n1 2 3 4 1\n6 7 8 5 2\nEnd\n")
apart = inspect("two.mesh")
check(len(apart["components"]) == 2 and apart["coincident_vertices"] == 3, f"{apart}")
joined = inspect("two.mesh", "--merge", "1e-6")
check(len(joined["components"]) == 1 and joined["nodes"] == 5, f"{joined}")
write(folder, "turned.mesh", open(os.path.join(folder, "two.mesh")).read().replace("6 7 8 5 2", "6 8 7 5 2"))
check(run("mesh", "turned.mesh", folder=folder).exit_code == 2, "an inverted tet is refused")
check(inspect("turned.mesh", "--orient", "--merge", "1e-6")["tets"] == 2, "and turned where that is asked for")
for times in "9", "-1", str(2**32 + 1):
    check(run("mesh", "turned.mesh", "--refine", times, folder=folder).exit_code == 2, f"{times} refinements are refused")
for output in (["fine.msh"], ["--json", "./fine.msh"]):  # what is read is not written over
    refused = run("mesh", "fine.msh", *output, folder=folder)
    check(refused.exit_code == 2 and "would be written over the mesh that is read" in refused.errors, refused.errors)
    check(inspect("fine.msh")["tets"] == fine["tets"], "fine.msh is still there")
