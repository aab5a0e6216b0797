"""Bars of hexahedra as Abaqus has them bend and stretch as their formulas say; a file of axes has a line for each element."""
import json

from program import SANITIZED, check, fewer, new_folder, run, write

folder = new_folder()
FACES = {"S6": 0, "S4": 1}  # at x = 0, at the end


def bar(name, length, along, across, quadratic, by_nodes=False):
    """A bar of square section, of side 1, with its ends by faces of its elements, or as sets of nodes."""
    number, lines = {}, ["*ELEMENT, TYPE=" + ("C3D20R" if quadratic else "C3D8I")]

    def node(a, b, c):  # in halves of elements
        return number.setdefault((a, b, c), len(number) + 1)

    corners = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
    middles = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
               (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1))
    ends, element = {"S6": [], "S4": []}, 0
    for i in range(along):
        for j in range(across):
            for k in range(across):
                element += 1
                nodes = [node(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in corners + (middles if quadratic else ())]
                lines.append(f"{element}, " + ", ".join(map(str, nodes[:12])) + ("," if quadratic else ""))
                if quadratic:
                    lines.append(", ".join(map(str, nodes[12:])))
                for face, at in FACES.items():
                    if i == at * (along - 1):
                        ends[face].append(element)
    places = [f"{n}, {a * length / along / 2}, {b / across / 2}, {c / across / 2}" for (a, b, c), n in number.items()]
    for end, name_of in ((0, "ROOT"), (2 * along, "TIP")) if by_nodes else ():
        lines += [f"*NSET, NSET={name_of}"] + [str(n) for (a, _, _), n in number.items() if a == end]
    for face, name_of in () if by_nodes else (("S6", "ROOT"), ("S4", "TIP")):
        lines += [f"*SURFACE, NAME={name_of}"] + [f"{e}, {face}" for e in ends[face]]
    write(folder, name, "\n".join(["*NODE", *places, *lines, ""]))


CASE = """mesh: {{file: {mesh}}}
{element}
materials: [{{region: all, youngs_modulus: {modulus}, poissons_ratio: 0{axes}}}]
constraints: [{{on: {{boundary: ROOT}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{boundary: TIP}}, total_force: {force}}}]
large_rotation: off
accuracy: {{relative_residual: 1e-9}}
watch: {{tip: {{displacement: {{nearest: [{length}, 0.5, 0.5]}}, component: {component}}}}}
"""


def run_bar(mesh, force, component="x", element="", length=10, ranks=1, modulus="1000", axes=""):
    write(folder, "case.yaml", CASE.format(**locals()))
    return run("solve", "case.yaml", "--json", "-", "--output", "out.vtkhdf", folder=folder, ranks=ranks)


def tip(mesh, force, **how):
    done = run_bar(mesh, force, **how)
    check(done.exit_code == 0, f"{mesh}: {done.errors}")
    return json.loads(done.output)["watched"]["tip"]["value"]


# Stretched by 2: FL/EA = 0.02, whatever the element.
bar("linear.inp", 10, 20, 2, False)
bar("quadratic.inp", 10, 10, 2, True)
for mesh, ranks in fewer((("linear.inp", 1), ("linear.inp", 2), ("quadratic.inp", 1))):
    found = tip(mesh, "[2, 0, 0]", ranks=ranks)
    check(abs(found - 0.02) < 1e-8, f"{mesh} on {ranks} ranks is stretched by {found}, expected 0.02")

# Sets of nodes that are whole ends stay whole where quadratic tets, refinement or the split of C3D20 add nodes.
bar("nodes.inp", 2, 2, 2, False, by_nodes=True)
bar("nodes-quadratic.inp", 2, 2, 2, True, by_nodes=True)
for mesh, element in (("nodes.inp", "element: {order: 2}"), ("nodes.inp, refine: 1", "element: {order: 2}"), ("nodes-quadratic.inp", "")):
    found = tip(mesh, "[5, 0, 0]", element=element, length=2)
    check(abs(found - 0.01) < 1e-8, f"{mesh} {element}: stretched by {found}, expected 0.01")

# Bent: FL³/3EI + 6FL/5GA (Timoshenko). Linear tets are too stiff, and quadratic ones made of them are not.
bent = 0.01 * (10**3 / (3 * 1000 / 12) + 1.2 * 10 / 500)
for mesh, element, low, high in () if SANITIZED else (
        ("quadratic.inp", "", 0.998, 1.001), ("linear.inp", "element: {order: 2}", 0.998, 1.001), ("linear.inp", "", 0.5, 0.6)):
    found = tip(mesh, "[0, 0, 0.01]", component="z", element=element) / bent
    check(low < found < high, f"{mesh} {element}: bent by {found} times what the formula has")

# What was split is said once, and 'orthostat mesh' says it too.
done = run("mesh", "linear.inp", folder=folder)
check(done.errors.count("linear.inp: split 80 hexahedra into ") == 1 and "volume 10," in done.output, done.errors + done.output)

# Axes in a file have a line for each element: along x the first has E1, the second E2.
bar("two.inp", 2, 2, 1, False)
write(folder, "axes.txt", "1 0 0 0 1 0 0 0 1\n0 1 0 -1 0 0 0 0 1\n")
how = {"modulus": "[1000, 2000, 500]", "axes": ", axes: {cells: axes.txt}", "length": 2}
for ranks in fewer((1, 2)):
    found = tip("two.inp", "[1, 0, 0]", ranks=ranks, **how)
    check(abs(found - 1 / 1000 - 1 / 2000) < 1e-9, f"two elements with axes of their own are stretched by {found}")
write(folder, "axes.txt", "1 0 0 0 1 0 0 0 1\n")
done = run_bar("two.inp", "[1, 0, 0]", **how)
check(done.exit_code == 2 and "expected 2" in done.errors, done.errors)

# Two hexahedra with vertices of their own at their common face, numbered backwards in the second: merged they fit. Where one has
# become four, vertices hang on the face of the other, and checks say so.
def two_parts(name, across):
    nodes, lines = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)], ["*ELEMENT, TYPE=C3D8", "1, 1, 5, 7, 3, 2, 6, 8, 4"]
    steps = range(across + 1)
    last = 8 + 2 * len(steps)**2
    nodes += [(1 + a, b / across, c / across) for a in (1, 0) for b in reversed(steps) for c in reversed(steps)]
    for b in range(across):
        for c in range(across):
            corners = [(a, b + j, c + k) for k in (0, 1) for a, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
            lines.append(", ".join(map(str, [2 + b * across + c] + [last - (a * len(steps) + j) * len(steps) - k for a, j, k in corners])))
    return write(folder, name, "\n".join(["*NODE"] + [f"{n + 1}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(nodes)] + lines + [""]))


counts = json.loads(run("mesh", two_parts("pair.inp", 1), "--merge", "1e-6", "--json", "-", folder=folder).output)
check(counts["surface_faces"] == 20 and counts["misfit_faces"] == counts["cracked_faces"] == 0, f"{counts}")
two_parts("hanging.inp", 2)
write(folder, "hanging.yaml", """mesh: {file: hanging.inp, merge: 1e-6}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.3}]
constraints: [{on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}]
""")
for ranks in fewer((1, 2)):
    done = run("check", "hanging.yaml", ranks=ranks, folder=folder)
    check("10 faces of tets lie on faces of others without fitting them, from (1, 0, 0) to (1, 1, 1)" in done.errors, done.errors)
