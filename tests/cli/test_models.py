"""Of a whole model of another program the mesh is read; what else moves the body is told, with the lines for the case file
that do the same."""
import os
import re

from program import SOURCE, check, new_folder, read_json, run, write

folder = new_folder()

BAR = """*Part, name=Bar
*Node
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*Element, type=C3D8R, elset=wood
1, 1, 2, 3, 4, 5, 6, 7, 8
*Nset, nset=foot
1, 2, 3, 4
*Surface, name=low
wood, S1
*Surface, name=high
wood, S2
*Orientation, name=Grain
1., 0., 0., 0., 2., 0.
3, 30.
*Solid Section, elset=wood, orientation=Grain, material=Oak
,
*End Part
"""
DECK = BAR + """*Assembly, name=Assembly
*Instance, name=Bar-1, part=Bar
*End Instance
*Instance, name=Bar-2, part=Bar
0., 0., 1.
*End Instance
*Node
1, 0.5, 0.5, 3.
*Nset, nset=Handle
1
*Nset, nset="Top nodes", instance=Bar-2
5, 6, 7, 8
*Surface, type=NODE, name="Top_CNS_", internal
"Top nodes", 1.
*Tie, name=Glue, adjust=yes, position tolerance=0.01
Bar-2.low, Bar-1.high
*Coupling, constraint name=Cap, ref node=Handle, surface="Top_CNS_"
*Kinematic
*End Assembly
*Material, name=Oak
*Boundary
Bar-1.foot, ENCASTRE
*Contact Pair, interaction=Rough
Bar-2.low, Bar-1.high
*Step
*Static
*End Step
"""


def warnings(name, text):
    done = run("mesh", write(folder, name, text), folder=folder)
    check(done.exit_code == 0, done.errors)
    return done.errors


def told(said):
    return re.findall(r"^  (\w+): - (.*)$", said, re.M)


said = warnings("deck.inp", DECK)
check("*ORIENTATION (1), *TIE (1), *COUPLING (1), *CONTACT PAIR (1)" in said and "there is no contact" in said, said)
lines = told(said)
check([section for section, _ in lines] == ["materials", "materials", "constraints", "constraints"], said)
check(lines[0][1] == "{region: Bar-1.wood, axes: {fixed: {e1: [0.866025404, 0.5, 0], e2: [-0.5, 0.866025404, 0]}}, ...}", said)
check(lines[2][1] == "{on: {boundary: Bar-2.low}, tied_to: {boundary: Bar-1.high}, tolerance: 0.01}", said)
check(lines[3][1] == "{on: {boundary: Top_CNS_}, rigid: [0.5, 0.5, 3]}", said)

# With these lines the two bars are one, of length 2, that a force on the point lengthens.
case = f"""mesh: {{file: deck.inp}}
materials: [{lines[0][1].replace("...", "youngs_modulus: [1e3, 1e3, 1e3], poissons_ratio: 0").replace("Bar-1.wood", "all")}]
constraints:
  - {{on: {{boundary: Bar-1.foot}}, displacement: [0, 0, 0]}}
  - {lines[2][1]}
  - {lines[3][1]}
loads: [{{on: {{boundary: Top_CNS_}}, total_force: [0, 0, 10], at: [0.5, 0.5, 3]}}]
large_rotation: off
watch: {{top: {{displacement: {{nearest: [1, 1, 2]}}, component: z}}}}
"""
done = run("solve", write(folder, "deck.yaml", case), "-q", "--json", "deck.json", folder=folder)
check(done.exit_code == 0, done.errors)
top = read_json(folder, "deck.json")["watched"]["top"]["value"]
check(abs(top - 0.02) < 1e-7, top)
plain = run("check", write(folder, "plain.yaml", re.sub(r"  - .*tied_to.*\n", "", case)), folder=folder)
check(plain.exit_code == 2 and "tied_to: {boundary: Bar-1.high}" in plain.errors, plain.errors)

# About the other axes, about a cylinder; a distribution, and an instance that is turned, are left to words.
for turn, expected in (("1, 90.", "e1: [1, 0, 0], e2: [0, 0, 1]"), ("2, 90.", "e1: [0, 0, -1], e2: [0, 1, 0]")):
    said = re.sub(r"-?\d\.\d+e-17", "0", warnings("turn.inp", DECK.replace("3, 30.", turn)))
    check(expected in said, said)
said = warnings("ring.inp", DECK.replace("name=Grain\n", "name=Grain, system=CYLINDRICAL\n").replace("3, 30.", "3, 0."))
check("cylindrical: {origin: [1, 0, 0], axis: [-1, 2, 0], order: [radial, tangential, axial]}" in said, said)
for deck in (DECK.replace("3, 30.", "3, Dist-1"), DECK.replace("0., 0., 1.\n*End I", "0., 0., 1.\n0,0,0,0,0,1,90.\n*End I")):
    said = warnings("words.inp", deck)
    check("axes: {" not in said and "*ORIENTATION (1)" in said and "material axes are those of the case" in said, said)

# A surface of nodes: a set, or a node, and its area. A mesh alone is told nothing of.
said = warnings("mesh.inp", DECK.split("*Tie")[0].replace("*Orientation", "**").replace(", orientation=Grain", "") +
                "*Surface, type=NODE, name=one\nBar-1.3, 0.25\n*End Assembly\n")
check("not read" not in said, said)

BULK = """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,9,,0.5,0.5,2.
GRID,10,,0.5,0.5,-1.
CHEXA,1,7,1,2,3,4,5,6
+,7,8
RBE2,17,9,123456,5,THRU,8,1.2-5
RBE3,18,,10,123456,1.,123,1,2
,3,2.,123,4,UM,9,1
CELAS2,77,100.,9,1
ENDDATA
"""
said = warnings("model.bdf", BULK)
check("RBE2 (1), RBE3 (1), CELAS2 (1)" in said and "springs" in said, said)
check(told(said) == [("constraints", "{on: {boundary: rbe2-17}, rigid: [0.5, 0.5, 2]}"),
                     ("loads", "{on: {boundary: rbe3-18}, total_force: [fx, fy, fz], at: [0.5, 0.5, -1]}")], said)
run("mesh", "model.bdf", "--json", "model.json", folder=folder)
check([(b["name"], b["count"]) for b in read_json(folder, "model.json")["boundaries"]] == [("rbe2-17", 2), ("rbe3-18", 2)],
      "the nodes of rigid elements")


# A point of the body moves with its rigid element; what couples some directions alone has no line that does the same.
said = warnings("some.bdf", BULK.replace("RBE2,17,9,123456,5,THRU,8,1.2-5", "RBE2,17,5,12,6,THRU,8"))
check(("constraints", "{on: {boundary: rbe2-17}, rigid: [0, 0, 1]} # holds more: the model couples 12 alone") in told(said), said)
run("mesh", "some.bdf", "--json", "some.json", folder=folder)
top = read_json(folder, "some.json")["boundaries"][0]
check((top["name"], round(top["area"], 6)) == ("rbe2-17", 1), top)
said = warnings("some.inp", DECK.replace("*Kinematic\n", "*Kinematic\n1, 2\n6, 6\n"))
check(told(said)[3][1].endswith("rigid: [0.5, 0.5, 3]} # holds more: the model couples 126 alone"), said)
for words in ("*Kinematic coupling, ref node=Handle\n\"Top_CNS_\", 1, 6\n", "*Rigid body, nset=\"Top nodes\", ref node=Handle\n"):
    said = warnings("other.inp", DECK.replace("*Coupling, constraint name=Cap, ref node=Handle, surface=\"Top_CNS_\"\n*Kinematic\n", words))
    check(told(said)[3][1].endswith("rigid: [0.5, 0.5, 3]}") and "boundary: ..." not in said, said)
check("holds more" not in warnings("all.inp", DECK.replace("*Kinematic\n", "*Kinematic\n1, 3\n")), "all directions")

# A surface of shells has both of their sides where none is named, one of solids those of their faces that no other has.
FREE = """*NODE
1,0,0,0
2,1,0,0
3,0,1,0
4,0,0,1
5,1,1,1
*ELEMENT, TYPE=C3D4, ELSET=A
1,1,2,3,4
*ELEMENT, TYPE=C3D4, ELSET=B
2,2,5,3,4
*ELEMENT, TYPE=S3, ELSET=SKIN
3,1,3,2
*SURFACE, TYPE=ELEMENT, NAME=FREE
A,
*SURFACE, TYPE=ELEMENT, NAME=SHELLS
SKIN
*ELSET, ELSET=BOTH
2, 3
*SURFACE, NAME=MIXED
BOTH
*SURFACE, NAME=SOME
A, S4
1
*SURFACE, NAME=OTHER
B,
*ELSET, ELSET=FRONT
1, 3
*SURFACE, NAME=ONCE
FRONT
*SURFACE, NAME=ALL, COMBINE=UNION
FREE, OTHER
*TIE, NAME=t
FREE, SHELLS
"""
said = warnings("free.inp", FREE)
check("SURFACE" not in said and told(said) == [
    ("constraints", "{on: {boundary: FREE}, tied_to: {boundary: SHELLS}}")], said)


def faces(name, text):
    """The number and area of the faces of each boundary."""
    warnings(name, text)
    run("mesh", name, "--json", "free.json", folder=folder)
    return {b["name"]: (b["count"], round(b["area"], 6)) for b in read_json(folder, "free.json")["boundaries"]}


TOP = 3 ** 0.5 / 2
check(faces("free.inp", FREE) == {"FREE": (3, 1.5), "SHELLS": (1, 0.5), "MIXED": (4, round(3 * TOP + 0.5, 6)),
                                  "OTHER": (3, round(3 * TOP, 6)), "SOME": (3, 1.5), "BOTH": (1, 0.5),
                                  "ALL": (6, round(3 * TOP + 1.5, 6)), "ONCE": (3, 1.5), "FRONT": (1, 0.5), "SKIN": (1, 0.5)},
      f"{faces('free.inp', FREE)}")

# Shells and sets with nodes of their own at the places of the solid's; not where two parts meet, as it is unknown whose they are.
SKIN = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n11,0,0,0\n12,1,0,0\n13,0,1,-0.\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n" \
       "*ELEMENT,TYPE=S3,ELSET=SKIN\n3,11,12,13\n*NSET,NSET=SUP\n11,12\n"
for text, expected in ((SKIN, {"SKIN": 1, "SUP": 2}), (SKIN.replace("*ELEMENT,TYPE=S3", "*NODE\n21,0,0,0\n22,1,0,0\n23,0,0,-1\n24,0,1,0\n"
                       "*ELEMENT,TYPE=C3D4,ELSET=F\n2,21,22,23,24\n*ELEMENT,TYPE=S3"), {"SKIN": 0, "SUP": 0})):
    said = warnings("skin.inp", text)
    run("mesh", "skin.inp", "--json", "skin.json", folder=folder)
    check({b["name"]: b["count"] for b in read_json(folder, "skin.json")["boundaries"]} == expected and "3 vertices are used by no tet" in said, said)

# Of what is split into tets, of quadratic tets, and of instances that are moved and turned: outside alone.
CUBES = BAR.replace("*Orientation", "**").replace(", orientation=Grain", "").replace("*End Part", """*Node
9, 0, 0, 2
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*Element, type=C3D8, elset=steel
2, 5, 6, 7, 8, 9, 10, 11, 12
*Surface, name=bare
wood,
*End Part""")
check(faces("cubes.inp", CUBES)["bare"] == (10, 5), f"{faces('cubes.inp', CUBES)}")
said = faces("placed.inp", CUBES + """*Assembly, name=Both
*Instance, name=A, part=Bar
*End Instance
*Instance, name=B, part=Bar
5., 0., 0.
5., 0., 0., 5., 0., 1., 30.
*End Instance
*Surface, name=outer
A.steel,
B.wood
*Surface, name=least, trim=YES
B.steel
*End Assembly
""")
check((said["A.bare"], said["B.bare"], said["outer"], said["least"]) == ((10, 5), (10, 5), (20, 10), (10, 5)), f"{said}")
check("TRIM=YES is not read" in warnings("placed.inp", open(f"{folder}/placed.inp").read()), "a surface that is trimmed")

quadratic = open(os.path.join(SOURCE, "tests", "formats", "exchange", "gmsh-quadratic.inp")).read()
said = faces("quadratic.inp", quadratic + "*SURFACE, NAME=skin\nVolume1,\n")
check(said["skin"] == (20, 5), f"{said}")

# What is not made of others is told, with the way out.
said = warnings("less.inp", FREE.replace("COMBINE=UNION", "COMBINE=DIFFERENCE"))
check("COMBINE=DIFFERENCE is not read" in said and "write its faces" in said, said)
done = run("mesh", write(folder, "none.inp", FREE.replace("FREE, OTHER", "FREE, MIXD")), folder=folder)
check(done.exit_code == 2 and "no surface 'MIXD'" in done.errors, done.errors)
said = warnings("edge.inp", FREE.replace("A, S4", "A, E1"))
check("1 line of *SURFACE names no face" in said, said)
