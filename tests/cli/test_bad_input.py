"""Every mistake gets a message one can act on, exit status 2 on all ranks, and leaves existing output alone."""
import os
from concurrent.futures import ThreadPoolExecutor

from program import SANITIZED, check, new_folder, run, write

GOOD = """mesh:
  block: {size: [2, 1, 1], divisions: [4, 2, 2]}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [0, 0, -1]}
output: {file: result.vtkhdf}
"""

VEG = """*VERTICES
COUNT 3 0 0
0 0 0 0
1 1 0 0
2 0 1 0
3 0 0 1
EXTRA
*ELEMENTS
TET
1 4 0
0 CORNERS
"""

TWICE = """*VERTICES
4 3 0 0
0 0 0 0
1 1 0 0
2 0 1 0
3 0 0 1
*ELEMENTS
TET
2 4 0
0 0 1 2 3
1 SECOND
"""

MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 3 "rim"
2 2 "lid"
3 1 "body"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
3
1 1 2 3 1 1 3
2 2 2 2 1 1 3 2
3 4 2 1 1 1 2 3 4
$EndElements
"""


def veg(nodes="4", extra="", tet="0 1 2 3"):
    return VEG.replace("COUNT", nodes).replace("EXTRA\n", extra).replace("CORNERS", tet)


# One tet of ten nodes in Gmsh's order; the middle of the edge from vertex 2 to vertex 3 goes where MIDDLE says.
TET10_MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
10
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0.5 0 0
6 MIDDLE
7 0 0.5 0
8 0 0 0.5
9 0 0.5 0.5
10 0.5 0 0.5
$EndNodes
$Elements
COUNT
1 11 2 1 1 1 2 3 4 5 6 7 8 9 10
MORE$EndElements
"""


def tet10_msh(middle="0.5 0.5 0", more=""):
    return TET10_MSH.replace("MIDDLE", middle).replace("MORE", more).replace("COUNT", str(1 + more.count("\n")))


def with_mesh(name):
    text = GOOD.replace("block: {size: [2, 1, 1], divisions: [4, 2, 2]}", f"file: {name}")
    return text.replace("boundary: xmin", "plane: {point: [0, 0, 0], normal: [1, 0, 0]}").replace(
        "boundary: xmax", "nearest: [1, 0, 0]")


MISTAKES = [
    ("no case", None, {}, ["nowhere.yaml"]),
    ("unknown key", GOOD.replace("youngs_modulus", "youngs_modulos"), {}, ["case.yaml:4:", "youngs_modulos", "youngs_modulus"]),
    ("wrong type", GOOD.replace("1000,", "stiff,"), {}, ["case.yaml:4:", "stiff"]),
    ("not a number", GOOD.replace("1000,", ".nan,"), {}, ["case.yaml:4:"]),
    ("infinite force", GOOD.replace("-1]", "-.inf]"), {}, ["case.yaml:8:"]),
    ("not yaml", GOOD + "  - {", {}, ["case.yaml:"]),
    ("missing mesh file", with_mesh("lost.veg"), {}, ["case.yaml:2:9: lost.veg: cannot be read"]),
    ("unknown boundary", GOOD.replace("xmax", "tip"), {}, ["case.yaml:8:21: there is no boundary 'tip'", "xmin", "xmax"]),
    ("unknown region", GOOD.replace("region: all", "region: bone"), {}, ["case.yaml:4:14: the mesh has no region 'bone'", "block"]),
    ("a load on an unknown region", GOOD.replace("output", "  - {body_force: [0, 0, 1], region: bone}\noutput"), {},
     ["case.yaml:9:37: the mesh has no region 'bone'"]),
    ("a region that is nearly one", GOOD.replace("region: all", "region: blok"), {},
     ["case.yaml:4:14: the mesh has no region 'blok'; did you mean 'block'? It has: block. 'all' stands for every one"]),
    ("a load on a region that is nearly one", GOOD.replace("output", "  - {body_force: [0, 0, 1], region: bloc}\noutput"), {},
     ["case.yaml:9:37: the mesh has no region 'bloc'; did you mean 'block'?"]),
    ("axes of a kind that is nearly one", GOOD.replace("0.3}", "0.3, axes: {cylinder: {}}}"), {},
     ["case.yaml:4:", "unknown key 'cylinder' in materials[0].axes; did you mean 'cylindrical'?"]),
    ("axes that a shape has not", GOOD.replace("1000,", "[10, 20, 30],").replace("0.3}", "0.3, axes: {cells: mesh}}"), {},
     ["case.yaml:4:76: region 'block' takes its axes from the mesh, but built-in shapes have no axes"]),
    ("axes that the mesh file has not", with_mesh("m.veg").replace("1000,", "[10, 20, 30],").replace(
        "0.3}", "0.3, axes: {cells: mesh}}"), {"m.veg": veg()},
     ["case.yaml:4:", "but the mesh file has no cell field 'axes' of nine components"]),
    ("nothing free", GOOD.replace("boundary: xmin", "all: true"), {},
     ["case.yaml:6:16: every vertex is constrained in all directions"]),
    ("missing axes", GOOD.replace("1000,", "[10, 20, 30],").replace("0.3}", "0.3, axes: {cells: lost.txt}}"), {},
     ["case.yaml:4:76: lost.txt: cannot be read"]),
    ("a constraint that holds nothing", GOOD.replace("[0, 0, 0]", "[free, free, free]"), {}, ["case.yaml:6:", "constrains nothing"]),
    ("nothing constrained", GOOD.replace("constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n", ""), {}, ["case.yaml:1: nothing is constrained"]),
    ("a tag", GOOD.replace("1000,", "!GPa 11,"), {}, ["case.yaml:4:35: ", "'!GPa'"]),
    ("a tag of a list", GOOD.replace("[0, 0, -1]", "!mm [0, 0, -1]"), {}, ["case.yaml:8:41: ", "'!mm'"]),
    ("a rigid face that is constrained", GOOD.replace("loads:", "  - {on: {boundary: xmin}, rigid: [0, 0, 0]}\nloads:"), {},
     ["case.yaml:7: vertex 1 at (0, 0, 0) follows others here", "is constrained besides"]),
    ("an unknown boundary for axes that nothing needs", GOOD.replace("0.3}", "0.3, axes: {gradient: {e1: {from: xmin, to: up}}}}"),
     {}, ["case.yaml:4:68: there is no boundary 'up'"]),
    ("a curve along up", GOOD.replace("1000,", "[1, 2, 3],").replace("0.3}", "0.3, axes: {curve: {points: [[0, 0, 0], [1, 0, 0]], up: [1, 0, 0]}}}"),
     {}, ["case.yaml:4:", "parallel to up"]),
    ("a table without points", GOOD.replace("vtkhdf}", "vtkhdf, probes: {a: {points: []}}}"), {}, ["case.yaml:9:", "expected points"]),
    ("indefinite material", GOOD.replace("1000, poissons_ratio: 0.3", "1000, poissons_ratio: 0.6"), {}, ["case.yaml:4:", "0.5"]),
    ("truncated mesh", with_mesh("m.veg"), {"m.veg": veg()[:60]}, ["m.veg"]),
    ("inverted tet", with_mesh("m.veg"), {"m.veg": veg(tet="0 2 1 3")}, ["m.veg: tet 0 is inverted", "-0.166", "mend the mesh: 1 of its tets is inverted: 'orthostat mesh FILE NEW --orient' turns such"]),
    ("flat tet", with_mesh("m.veg"), {"m.veg": veg().replace("3 0 0 1", "3 1 1 0")}, ["tet 0 is flat", "mend the mesh: 1 of its tets is flat: mesh the body anew there"]),
    ("unused vertex", with_mesh("m.veg"), {"m.veg": veg(nodes="5", extra="4 2 2 2\n")}, ["4"]),
    ("coordinate not finite", with_mesh("m.veg"), {"m.veg": veg().replace("3 0 0 1", "3 0 0 nan")}, ["m.veg"]),
    ("cubic elements", with_mesh("m.veg"), {"m.veg": veg().replace("TET\n", "CUBIC\n")}, ["CUBIC"]),
    ("folded quadratic tet", with_mesh("m.msh"), {"m.msh": tet10_msh("2.5 0 0")}, ["tet 1", "folds over"]),
    ("two orders in one mesh", with_mesh("m.msh"), {"m.msh": tet10_msh(more="2 4 2 1 1 1 2 3 4\n")}, ["m.msh:", "one order"]),
    ("unknown ending", with_mesh("m.stl"), {"m.stl": "solid"}, ["case.yaml:2:", "tetgen -pq"]),
    ("an ending nobody knows", with_mesh("m.qqq"), {"m.qqq": "solid"}, [".msh", ".veg", ".inp", ".vtu"]),
    ("a mesh without tets", with_mesh("m.msh"), {"m.msh": MSH.replace("3 4 2 1 1 1 2 3 4", "3 2 2 1 1 1 2 4")},
     ["case.yaml:2:9: m.msh: holds no tets among its 3 elements; mesh the volume (gmsh -3 MODEL.geo -o NEW.msh)"]),
    ("a curve among faces", with_mesh("m.msh").replace("nearest: [1, 0, 0]", "boundary: [lid, rim]"), {"m.msh": MSH},
     ["case.yaml:8:21: ", "'rim' is one of curves"]),
    ("parallel potentials", GOOD.replace("1000,", "[1000, 10, 10],").replace(
        "0.3}", "0.3, axes: {gradient: {e1: {from: xmin, to: xmax}, e2: {from: xmax, to: xmin}}}}"), {},
     ["gradient axes of region 'block', tet ", "lie across each other"]),
    ("a residual no solver takes", GOOD + "accuracy: {relative_residual: 0.6}\n", {}, ["case.yaml:10:31:", "to 0.5"]),
    ("one tet twice", with_mesh("m.veg"), {"m.veg": TWICE.replace("SECOND", "1 2 0 3")}, ["tets 0 and 1", "doubled or overlapping"]),
    ("a tet with a vertex twice", with_mesh("m.veg"), {"m.veg": veg(tet="0 1 2 2")}, ["tet 0", "same node twice"]),
    ("infinite coordinate", with_mesh("m.veg"), {"m.veg": veg().replace("3 0 0 1", "3 0 0 inf")}, ["m.veg:6:", "finite"]),
    ("a volume beyond numbers", GOOD.replace("[2, 1, 1]", "[2e74, 1e74, 1e74]").replace("1000,", "1e60,"), {}, ["stiffest", "1e+75", "units"]),
    ("a coordinate beyond squares", with_mesh("m.veg"), {"m.veg": veg().replace("3 0 0 1", "3 0 0 1e308")},
     ["vertex 3 has coordinate 1e+308 in (0, 0, 1e+308); coordinates up to 1e+75"]),
    ("left-handed axes", GOOD.replace("1000,", "[10, 20, 30],").replace(
        "0.3}", "0.3, axes: {fixed: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]}}"), {}, ["case.yaml:4:", "left-handed"]),
    ("axes that are no numbers", GOOD.replace("1000,", "[10, 20, 30],").replace("0.3}", "0.3, axes: {cells: a.txt}}"),
     {"a.txt": "nan 0 0 0 1 0 0 0 1\n" * 96}, ["case.yaml:4:76: a.txt:1:", "nan"]),
    ("no stiffness", GOOD.replace("1000,", "0,"), {}, ["case.yaml:4:", "above 0"]),
    ("stiffness beyond squares", GOOD.replace("1000,", "1e308,"), {}, ["case.yaml:4:", "youngs_modulus: found '1e308'", "at most 1e75 in size", "units"]),
    ("softness beyond squares", GOOD.replace("1000,", "1e-308,"), {}, ["case.yaml:4:", "youngs_modulus: found '1e-308'", "at least 1e-75", "units"]),
    ("a load whose square vanishes", GOOD.replace("-1]", "-1e-300]"), {}, ["loads", "units"]),
    ("a load whose square overflows", GOOD.replace("-1]", "-1e300]"), {}, ["total_force[2]: found '-1e300'", "at most 1e75 in size"]),
    ("quadratic elements", GOOD + "element: {order: 3}\n", {}, ["order"]),
]


def refused(mistake, ranks):
    name, text, files, wanted = mistake
    folder = new_folder()
    for file, content in files.items():
        write(folder, file, content)
    if text is not None:
        write(folder, "case.yaml", text)
    write(folder, "result.vtkhdf", "precious")
    finished = run("solve", "case.yaml" if text is not None else "nowhere.yaml", ranks=ranks, folder=folder)
    where = f"{name} on {ranks} rank(s)"
    check(finished.exit_code == 2, f"{where}: exit status {finished.exit_code}\n{finished.errors}")
    for word in wanted:
        check(word in finished.errors, f"{where}: no '{word}' in: {finished.errors}")
    check(finished.errors.count("orthostat: error:") == 1, f"{where}: one message wanted: {finished.errors}")
    with open(os.path.join(folder, "result.vtkhdf")) as stream:
        check(stream.read() == "precious", f"{where}: the existing output was touched")
    left = sorted(set(os.listdir(folder)) - set(files) - {"case.yaml", "result.vtkhdf"})
    check(not left, f"{where}: left behind {left}")


def main():
    with ThreadPoolExecutor(2) as pool:  # most of each run is Open MPI's start
        runs = [pool.submit(refused, mistake, ranks) for i, mistake in enumerate(MISTAKES)
                for ranks in ((1 + i % 2,) if SANITIZED else (1, 2))]
        for done in runs:
            done.result()


main()
