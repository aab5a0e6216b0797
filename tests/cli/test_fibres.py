"""One direction is enough for a transversely isotropic body: `fibre`, axes of which one is stated, gradients between
boundaries that touch; and moduli, fibres and axes from fields of the mesh file."""
import json
import math
import os

from program import SANITIZED, SOURCE, check, fewer, new_folder, run, write

folder = new_folder()
STORED = os.path.join(SOURCE, "tests", "formats", "exchange")
BLOCK = "block: {size: [2, 1, 1], divisions: [4, 2, 2]}"
HELD = """constraints: [{on: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, displacement: [0, 0, 0]}]
loads: [{on: {plane: {point: [2, 0, 0], normal: [1, 0, 0]}}, total_force: [1, 2, 3]}]
"""
MUSCLE = "youngs_modulus: {plane: 500, axis: 5000}, poissons_ratio: {plane: 0.3, plane_axis: 0.03}, shear_modulus: {axis: 200}"
ABOUT_E1 = "youngs_modulus: [5000, 500, 500], poissons_ratio: 0.3"


def text(material, mesh=BLOCK, order=1, held=HELD):
    materials = material if isinstance(material, list) else ["region: all, " + material]
    return (f"mesh: {{{mesh}}}\nelement: {{order: {order}}}\nmaterials:\n" + "".join(f"  - {{{m}}}\n" for m in materials) + held +
            "large_rotation: off\naccuracy: {relative_residual: 1e-11}\noutput: {fields: [displacement]}\n"
            "watch: {end: {displacement: {nearest: [2, 1, 1]}}, energy: strain_energy}\n")


def call(case, command="solve", ranks=1):
    write(folder, "case.yaml", case)
    arguments = ["--json", "-", "-q"] if command == "solve" else ["--json"]
    return run(command, "case.yaml", *arguments, ranks=ranks, folder=folder)


def answer(case, ranks=1):
    done = call(case, ranks=ranks)
    check(done.exit_code == 0, f"{done.errors}\n{case}")
    watched = json.loads(done.output)["watched"]
    return watched["end"]["value"], watched["energy"]["value"]


def same(found, expected, what, tolerance=1e-8):
    check(all(abs(a - b) <= tolerance * abs(b) for a, b in zip(found, expected)), f"{what}: {found}, expected {expected}")


def refused(case, words):
    done = call(case)
    check(done.exit_code == 2 and words in done.errors, f"expected '{words}', found {done.errors}")


# --- one direction ---

along_x = answer(text(MUSCLE + ", axes: {fixed: [[0, 1, 0], [0, 0, 1], [1, 0, 0]]}"))
same(answer(text(MUSCLE + ", fibre: [2, 0, 0]")), along_x, "a fibre along x")
same(answer(text(MUSCLE + ", fibre: {curve: {points: [[-1, 0, 0], [9, 0, 0]]}}")), along_x, "a fibre along a straight curve")
same(answer(text(MUSCLE + ", fibre: {gradient: {from: xmin, to: xmax}}")), along_x, "a fibre from end to end", 1e-6)
for ranks in fewer([2, 4]):
    same(answer(text(MUSCLE + ", fibre: {gradient: {from: xmin, to: xmax}}"), ranks), along_x, f"on {ranks} ranks", 1e-6)
same(answer(text(MUSCLE + ", axes: {fixed: {e3: [1, 0, 0]}}")), along_x, "axes of which e3 is stated")
about_x = answer(text(ABOUT_E1))
same(answer(text(ABOUT_E1 + ", axes: {fixed: {e1: [3, 0, 0]}}")), about_x, "axes of which e1 is stated")
same(answer(text(ABOUT_E1 + ", axes: {gradient: {e1: {from: xmin, to: xmax}}}")), about_x, "a gradient of e1 alone", 1e-6)

THREE = "youngs_modulus: [5000, 500, 900], poissons_ratio: 0.3"
turned = answer(text(THREE + ", axes: {euler: {degrees: [0, 0, 30], sequence: XYZ}}"))
same(answer(text(THREE + ", axes: {rotation: {axis: [0, 0, 5], degrees: 30}}")), turned, "a rotation about z")
same(answer(text(THREE + ", axes: {fixed: {e1: [0.8660254037844386, 0.5, 0], e3: [0, 0, 2]}}")), turned, "e1 and e3")
same(answer(text(THREE + ", axes: {fixed: {e2: [-0.5, 0.8660254037844386, 0], e3: [0, 0, 2]}}")), turned, "e2 and e3")

refused(text(THREE + ", axes: {fixed: {e1: [1, 0, 0]}}"), "e1 alone does not place a material that differs across it")
refused(text(ABOUT_E1 + ", axes: {fixed: {e2: [1, 0, 0]}}"), "e2 alone does not place")
refused(text(THREE + ", axes: {fixed: {e1: [1, 0, 0], e2: [1, 1, 0]}}"), "not orthogonal")
refused(text(THREE + ", fibre: [1, 0, 0]"), "a fibre belongs to youngs_modulus: {plane: E, axis: E}")
refused(text(MUSCLE + ", fibre: [0, 0, 0]"), "not all zero")
refused(text(MUSCLE + ", fibre: [1, 0, 0], axes: {rotation: {axis: [0, 0, 1], degrees: 3}}"), "not both")
refused(text(THREE + ", axes: {fixed: {e1: [1, 0, 0], e2: [0, 1, 0], e3: [0, 0, 1]}}"), "e3 follows from e1 and e2")
said = json.loads(call(text(MUSCLE), "explain").output)
check("lies along z" in said["warnings"][0], f"{said['warnings']}")
said = json.loads(call(text(MUSCLE + ", fibre: [1, 0, 0]"), "explain").output)["materials"][0]
check("5000 along e3 (the axis)" in said["moduli"] and "e3 = (1, 0, 0)" in said["axes"], f"{said}")

# --- what is asked for along axes that lie anywhere ---

ASKED = """watch: {own: {stress: {region: all}, component: 33}, across: {stress: {region: all}, component: 11},
  shear: {stress: {at: [1, 0.5, 0.5]}, component: 31}, mises: {stress: {region: all}, component: von_mises}}
output: {fields: [displacement, e1, e3]}
"""


def warned(material, asked=ASKED, commands=("check",), mesh=BLOCK):
    case = f"mesh: {{{mesh}}}\nmaterials:\n  - {{region: all, {material}}}\n{HELD}large_rotation: off\n{asked}"
    said = [json.loads(call(case, command).output)["warnings"] for command in commands]
    check(all(one == said[0] for one in said), f"{commands}: {said}")
    return said[0]


def what_lies_anywhere_is_told():
    arbitrary = warned(MUSCLE + ", fibre: [1, 0, 0]", commands=("check", "explain", "solve"))
    check(len(arbitrary) == 1 and "e3 alone, and e1 and e2 lie anywhere" in arbitrary[0] and
          "arbitrary numbers: across (11), shear (31), the field e1; state" in arbitrary[0] and
          "axes: {fixed: {e1: ..., e3: ...}}, or ask for 33," in arbitrary[0], f"{arbitrary}")
    said = warned(ABOUT_E1 + ", axes: {fixed: {e1: [1, 0, 0]}}")
    check("e1 alone, and e2 and e3" in said[0] and "numbers: own (33), shear (31), the field e3;" in said[0], f"{said}")
    said = warned(MUSCLE + ", fibre: {curve: {points: [[-1, 0, 0], [9, 0, 0]]}}", "output: {probes: {p: {points: [[1, 0.5, 0.5]]}}}")
    check(len(said) == 1 and "numbers: the probes' stresses" in said[0] and "up: ..., order:" in said[0], f"{said}")
    said = warned(MUSCLE + ", fibre: [1, 0, 0]", "cases: [{name: a, watch: {mine: {stress: {region: all}, component: 22}}}, {name: b}]")
    check(len(said) == 1 and "numbers: mine (22);" in said[0], f"{said}")
    for settled in ("axes: {fixed: {e1: [0, 1, 0], e3: [1, 0, 0]}}",
                    "fibre: {cylindrical: {origin: [0, 9, 9], axis: [1, 0, 0], along: axial}}"):
        check(not warned(f"{MUSCLE}, {settled}"), f"{settled}: {warned(f'{MUSCLE}, {settled}')}")
    check(not warned(MUSCLE + ", fibre: [1, 0, 0]", ""), "nothing is asked for along the axes")

    keeps = "youngs_modulus: {plane: 20, axis: 60}, poissons_ratio: {plane: 0.8332, plane_axis: 0.16664}, shear_modulus: {axis: 10}, fibre: [1, 0, 0]"
    for eigenstrain, changes in ("[0, 0, -0.2]", True), ("[0.1, 0.1, -0.2]", False), ("0.05", False):
        said = warned(f"{keeps}, eigenstrain: {eigenstrain}", "element: {order: 2}\n")
        check(any("its eigenstrain changes the volume: unless something prevents it, by about -20 %" in one for one in said) == changes, f"{said}")

    strong = MUSCLE + ", fibre: [1, 0, 0], strengths: {tension: {plane: 3, axis: 80}, shear: {plane: %s, axis: 8}}"
    said = warned(strong % 2, "")
    check(len(said) == 1 and "tsai_wu_load_factor, hill_load_factor, maximum_stress_load_factor;" in said[0] and
          "S12 (plane) = 1.7321" in said[0], f"{said}")
    said = warned(strong % 1.73, "")
    check(len(said) == 1 and "strengths: hill_load_factor, maximum_stress_load_factor;" in said[0], f"{said}")
    check(not warned(strong % 1.73, "output: {fields: [tsai_wu_load_factor]}"), "Tsai and Wu's alone")
    refused(text(strong[:-1] % 2 +
                 ", interaction: {f12: -0.5, f23: -0.5, f31: -0.4}}"), "e3 alone does not place a material that differs")


if not SANITIZED:
    what_lies_anywhere_is_told()

# --- boundaries that touch ---

# Between two planes through z the potential is the angle about z, and so the fibre is tangential.
OCTANT = "octant: {radii: [3, 9], divisions: {around: 3, radial: 3}}"
HANGING = """constraints: [{on: {boundary: zmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: outer}, total_force: [1, 2, 3]}]
"""
tangential = answer(text(MUSCLE + ", fibre: {cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], along: tangential}}", OCTANT,
                         held=HANGING))
for ranks in fewer([1, 3]):
    same(answer(text(MUSCLE + ", fibre: {gradient: {from: ymin, to: xmin}}", OCTANT, held=HANGING), ranks), tangential,
         "planes that touch", 0.02)

# Quadratic tets have quadratic potentials: linear ones were 1.4 % off here.
STIFFER = MUSCLE.replace("5000", "50000")
tangential, found = (answer(text(f"{STIFFER}, fibre: {fibre}", OCTANT, 2, HANGING)) for fibre in (
    "{cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], along: tangential}}", "{gradient: {from: ymin, to: xmin}}"))
same(found, tangential, "quadratic tets", 0.002)
RING = "sector: {axis: z, length: 0.5, radii: [1, 1.5], angle: 90, divisions: {around: 4, radial: 2, axial: 1}}"
CLAMPED = """constraints: [{on: {boundary: start}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: finish}, total_force: [0.1, 0.1, 0.2]}]
"""
# Within these the fibres follow the potential: uniform in each, the energy was 43 % off.
tangential, found = (answer(text(f"{MUSCLE.replace('5000', '500000').replace('0.03', '0.0003')}, fibre: {fibre}", RING, 2, CLAMPED)) for fibre in (
    "{cylindrical: {origin: [0, 0, 0], axis: [0, 0, 1], along: tangential}}", "{gradient: {from: start, to: finish}}"))
same(found, tangential, "a ring of quadratic tets", 0.01)
said = json.loads(call(text(f"{STIFFER}, fibre: {{gradient: {{from: ymin, to: xmin}}}}", OCTANT, held=HANGING)).output)["warnings"]
check(any("coarse for the axes of region 'shell' ('gradient'), which turn by" in words for words in said), f"far turns: {said}")


def cubes(count, mark):
    """A cube of count³ hexes as a .mesh file; `mark` gives three corners of a face on its surface their reference."""
    def number(a, b, c):
        return (a * (count + 1) + b) * (count + 1) + c + 1
    points = [(a, b, c) for a in range(count + 1) for b in range(count + 1) for c in range(count + 1)]
    tets = []
    for a, b, c in ((a, b, c) for a in range(count) for b in range(count) for c in range(count)):
        corner = [(a + (k & 1), b + (k >> 1 & 1), c + (k >> 2 & 1)) for k in range(8)]
        tets += [[corner[v] for v in tet] for tet in ((0, 1, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 1, 7, 5), (0, 4, 7, 6), (0, 2, 7, 3))]
    faces = {}
    for tet in tets:
        for out in range(4):
            face = tuple(sorted(tet[v] for v in range(4) if v != out))
            faces[face] = faces.get(face, 0) + 1
    marked = [(face, mark(face)) for face, times in faces.items() if times == 1]
    marked = [(face, reference) for face, reference in marked if reference]
    with open(os.path.join(folder, "cube.mesh"), "w") as out:
        out.write(f"MeshVersionFormatted 2\nDimension 3\nVertices {len(points)}\n")
        out.writelines(f"{x / count} {y / count} {z / count} 0\n" for x, y, z in points)
        out.write(f"Tetrahedra {len(tets)}\n")
        out.writelines(" ".join(str(number(*v)) for v in tet) + " 1\n" for tet in tets)
        out.write(f"Triangles {len(marked)}\n")
        out.writelines(" ".join(str(number(*v)) for v in face) + f" {reference}\n" for face, reference in marked)
        out.write("End\n")


CUBE_HELD = """constraints: [{on: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: surface-2}, total_force: [1, 2, 3]}]
"""


def top_halves(face):
    """Two patches of the flat top that meet in its middle."""
    return 0 if any(z < 4 for _, _, z in face) else 1 if sum(x for x, _, _ in face) < 6 else 2


def around_an_edge(face):
    """One boundary over two sides, so that some tets have all four vertices on it; the other opposite."""
    if all(x == 0 for x, _, _ in face) or all(y == 4 for _, y, _ in face):
        return 1
    return 2 if all(x == 4 for x, _, _ in face) else 0


for mark in (top_halves, around_an_edge):
    cubes(4, mark)
    one = answer(text(MUSCLE + ", fibre: {gradient: {from: surface-1, to: surface-2}}", "file: cube.mesh", held=CUBE_HELD))
    for ranks in fewer([3]):
        same(answer(text(MUSCLE + ", fibre: {gradient: {from: surface-1, to: surface-2}}", "file: cube.mesh", held=CUBE_HELD),
                    ranks), one, f"{mark.__name__} on {ranks} ranks", 1e-6)

# --- fields of the mesh file ---

TWO_CUBES = "file: " + os.path.join(STORED, "meshio-linear-zlib.vtu")
REGIONS = ("region: volume-11, youngs_modulus: 1100, poissons_ratio: 0.3", "region: volume-12, youngs_modulus: 1200, poissons_ratio: 0.3")
for order, ranks in fewer([(1, 1), (1, 4), (2, 2)]):
    expected = answer(text(list(REGIONS), TWO_CUBES, order))
    same(answer(text('youngs_modulus: {field: "gmsh:physical", factor: 100}, poissons_ratio: 0.3', TWO_CUBES, order), ranks),
         expected, f"a modulus by tet, order {order}, {ranks} ranks")
ORTHOTROPIC = "poissons_ratio: 0.3, axes: {rotation: {axis: [1, 2, 3], degrees: 40}}"
expected = answer(text([f"region: volume-11, youngs_modulus: [1100, 550, 220], {ORTHOTROPIC}",
                        f"region: volume-12, youngs_modulus: [1200, 600, 240], {ORTHOTROPIC}"], TWO_CUBES, 2))
same(answer(text(f'youngs_modulus: {{field: "gmsh:physical", factor: 100, ratios: [1, 0.5, 0.2]}}, {ORTHOTROPIC}', TWO_CUBES, 2)),
     expected, "an orthotropic one")
nearly = [region.replace("0.3", "0.49") for region in REGIONS]
same(answer(text('youngs_modulus: {field: "gmsh:physical", factor: 100}, poissons_ratio: 0.49', TWO_CUBES, 2)),
     answer(text(nearly, TWO_CUBES, 2)), "a nearly incompressible one", 1e-7)
CYLINDER = "poissons_ratio: 0.3, axes: {cylindrical: {origin: [0, 9, 9], axis: [1, 0, 0], order: [axial, radial, tangential]}}"
same(answer(text(f'youngs_modulus: {{field: "gmsh:physical", factor: 100, ratios: [1, 0.5, 0.2]}}, {CYLINDER}', TWO_CUBES)),
     answer(text([f"region: volume-11, youngs_modulus: [1100, 550, 220], {CYLINDER}",
                  f"region: volume-12, youngs_modulus: [1200, 600, 240], {CYLINDER}"], TWO_CUBES)), "axes about a line")
by_tet = answer(text("youngs_modulus: {field: modulus}, poissons_ratio: 0.3", TWO_CUBES))
same(answer(text("youngs_modulus: {field: density, factor: 1000}, poissons_ratio: 0.3", TWO_CUBES)), by_tet, "a density by vertex")
same(answer(text("youngs_modulus: {field: modulus, power: 2, factor: 1e-3, least: 1e9}, poissons_ratio: 0.3", TWO_CUBES)),
     answer(text("youngs_modulus: 1e9, poissons_ratio: 0.3", TWO_CUBES)), "the least")
same(answer(text(MUSCLE + ", fibre: {field: direction}", TWO_CUBES)), answer(text(MUSCLE + ", fibre: [0.6, 0.8, 0]", TWO_CUBES)),
     "directions by vertex, of either sense")
same(answer(text(ABOUT_E1 + ", axes: {field: {e1: direction}}", TWO_CUBES)),
     answer(text(ABOUT_E1 + ", axes: {fixed: {e1: [0.6, 0.8, 0]}}", TWO_CUBES)), "axes of which e1 is a field")
turning = answer(text(MUSCLE + ", fibre: {field: fibre}", TWO_CUBES))
for ranks in fewer([3]):
    same(answer(text(MUSCLE + ", fibre: {field: fibre}", TWO_CUBES), ranks), turning, f"a field of fibres on {ranks} ranks")

# At the vertices of a cube, directions about the line x = -1, y = 0, each of either sense and some length: they vary within quadratic tets,
# also those of a finer mesh. (Uniform in each tet, they were 10 % off.)


def turning_cube(count):
    places = [(a, b, c) for a in range(count + 1) for b in range(count + 1) for c in range(count + 1)]
    number = {place: n + 1 for n, place in enumerate(places)}
    points = [tuple(x / count for x in place) for place in places]
    tets = [[number[a + (k & 1), b + (k >> 1 & 1), c + (k >> 2 & 1)] for k in tet] for a in range(count) for b in range(count)
            for c in range(count) for tet in ((0, 1, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 1, 7, 5), (0, 4, 7, 6), (0, 2, 7, 3))]
    radial = [[(x + 1) / math.hypot(x + 1, y), y / math.hypot(x + 1, y), 0] for x, y, _ in points]
    tangential = [[-r[1], r[0], 0] for r in radial]
    fields = {"radial": [[x * (-1) ** n for x in r] for n, r in enumerate(radial)],
              "tangential": [[(1 + n % 5) * x * (-1) ** (n // 3) for x in t] for n, t in enumerate(tangential)],
              "frame": [r + t + [0, 0, 1] for r, t in zip(radial, tangential)]}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", len(points), *(f"{n + 1} {x} {y} {z}" for n, (x, y, z) in enumerate(points)),
             "$EndNodes", "$Elements", len(tets), *(f"{n + 1} 4 0 " + " ".join(map(str, tet)) for n, tet in enumerate(tets)), "$EndElements"]
    for name, rows in fields.items():
        lines += ["$NodeData", 1, f'"{name}"', 1, 0, 3, 0, len(rows[0]), len(rows),
                  *(f"{n + 1} " + " ".join(map(repr, map(float, row))) for n, row in enumerate(rows)), "$EndNodeData"]
    write(folder, "turning.msh", "\n".join(map(str, lines)) + "\n")


turning_cube(2)
STIFF_AROUND = "youngs_modulus: [10, 1000, 10], poissons_ratio: 0.3, axes: "
ABOUT_LINE = STIFF_AROUND + "{cylindrical: {origin: [-1, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}"
TURNED_HELD = HELD.replace("[2, 0, 0]", "[1, 0, 0]")
for mesh in fewer(["file: turning.msh", "file: turning.msh, refine: 1"]):
    expected = answer(text(ABOUT_LINE, mesh, 2, TURNED_HELD))
    for axes, ranks in fewer([("{field: {e1: radial, e2: tangential}}", 1), ("{field: frame}", 3)]):
        same(answer(text(STIFF_AROUND + axes, mesh, 2, TURNED_HELD), ranks), expected, f"{axes} at vertices, {mesh}", 0.01)
adapted = text(ABOUT_LINE, "file: turning.msh", 2, TURNED_HELD).replace("relative_residual: 1e-11", "relative_error: 0.1")
if not SANITIZED:  # numbers alone
    expected = answer(adapted)
    same(answer(adapted.replace(ABOUT_LINE, STIFF_AROUND + "{field: {e1: radial, e2: tangential}}"), 2), expected, "where an accuracy is asked for", 0.01)
    same(answer(text(STIFF_AROUND + "{field: frame}", "file: turning.msh", 1, TURNED_HELD)),
         answer(text(ABOUT_LINE, "file: turning.msh", 1, TURNED_HELD)), "of linear tets their mean", 0.02)

# A result of its own as the mesh: its displacements, on points, as fibres; in a .vtkhdf file ranks' pieces share points.
write(folder, "bent.yaml", text("youngs_modulus: 1000, poissons_ratio: 0.3", TWO_CUBES, 2))
for name, ranks in (("bent.vtu", 1), ("bent-1.vtkhdf", 1), ("bent-3.vtkhdf", 3)):
    done = run("solve", "bent.yaml", "-q", "-o", name, ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
along = answer(text(MUSCLE + ", fibre: {field: displacement}", "file: bent.vtu", 2))
for name, ranks in (("bent-1.vtkhdf", 1), ("bent-3.vtkhdf", 1), ("bent-1.vtkhdf", 4), ("bent-3.vtkhdf", 2)):
    same(answer(text(MUSCLE + ", fibre: {field: displacement}", "file: " + name, 2), ranks), along,
         f"displacements of {name} as fibres on {ranks} ranks")
lacking = [json.loads(call(text(MUSCLE + ", fibre: {field: displacement}", "file: " + name, 2), ranks=ranks).output)["warnings"]
           for name, ranks in fewer([("bent.vtu", 1), ("bent-3.vtkhdf", 2)])]
told = [warning.split(": ", 1)[1] for warnings in lacking for warning in warnings if "zero at vertices of" in warning]
check(len(told) == len(lacking) and len(set(told)) == 1, f"held vertices have no direction: {told}")
refused(text(MUSCLE + ", fibre: {field: nowhere}", "file: bent-3.vtkhdf"), "there is no field 'nowhere' on the elements, or on the nodes; there is 'region', 'tet', 'displacement', 'vertex'")
refused(text(MUSCLE + ", fibre: {field: modulus}", TWO_CUBES), "it has 1 numbers a tet, expected 3")
refused(text("youngs_modulus: {field: fibre}, poissons_ratio: 0.3", TWO_CUBES), "it has 3 numbers a tet, expected 1")
refused(text("youngs_modulus: {field: modulos}, poissons_ratio: 0.3", TWO_CUBES), "there is no field 'modulos' on the elements, or on the nodes; there is ")
refused(text("youngs_modulus: {field: modulus, factor: 1, power: -400}, poissons_ratio: 0.3", TWO_CUBES), "expected one above 0")
refused(text("youngs_modulus: {field: modulus}, poissons_ratio: 0.3"), "this mesh comes from none")
