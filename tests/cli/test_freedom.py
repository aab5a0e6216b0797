"""What nothing holds is refused in words, before the solve; a floating body under balanced loads is solved when asked."""
import os

from program import check, fewer, new_folder, read_points, run, solve, write

TETS = [(0, 1, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 1, 7, 5), (0, 4, 7, 6), (0, 2, 7, 3)]


def veg(cells):
    """A .veg mesh of unit cells (x, y, z, copy): cells of one copy share the vertices they touch in."""
    number, points, tets = {}, [], []
    for x, y, z, copy in cells:
        corners = []
        for k in range(8):
            at = (x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1))
            if (copy, at) not in number:
                number[copy, at] = len(points) + 1
                points.append(at)
            corners.append(number[copy, at])
        tets += [[corners[v] for v in tet] for tet in TETS]
    lines = ["*VERTICES", f"{len(points)} 3 0 0"]
    lines += [f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(points)]
    lines += ["*ELEMENTS", "TET", f"{len(tets)} 4 0"]
    lines += [f"{i + 1} " + " ".join(map(str, tet)) for i, tet in enumerate(tets)]
    return "\n".join(lines) + "\n"


def case(constraints, loads="", mesh="file: m.veg"):
    return f"""mesh: {{{mesh}}}
materials:
  - {{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}}
constraints: {constraints}
loads:
{loads or "  - {on: {nearest: [0, 0, 1]}, point_force: [0, 0, -1]}"}
output: {{file: result.vtkhdf}}
accuracy: {{relative_residual: 1e-11}}
"""


HELD = "[{on: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, displacement: [0, 0, 0]}]"
FLOOR = "[{on: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, slide: [0, 0, 1]}]"
ONE, SIDE, EDGE, CORNER = (0, 0, 0, 0), (1, 0, 0, 1), (1, 1, 0, 0), (1, 1, 1, 0)
PULL = """  - {on: {boundary: xmin}, traction: [-1, 0, 0]}
  - {on: {boundary: xmax}, traction: [1, 0, 0]}"""
BEAM = "block: {size: [2, 1, 1], divisions: [8, 4, 4], origin: [-1, 3, 5]}"

REFUSED = [
    ("a block on a plane", case(FLOOR), [ONE],
     "  the body, 6 tets around (0.5, 0.5, 0.5): can move in any direction normal to (0, 0, 1), and turn about any line "
     "along (0, 0, 1)\n"),
    ("a loose block", case(HELD), [ONE, (4, 0, 0, 0)],
     "  component 2, 6 tets around (4.5, 0.5, 0.5): can move in any direction, and turn about any axis\n"),
    ("a block on an edge", case(HELD), [ONE, EDGE],
     "  component 2, 6 tets around (1.5, 1.5, 0.5), joined to component 1 along one line only: can turn about the line through "
     "(1, 1, 0.5) along (0, 0, 1)\n"),
    ("a block on a vertex", case(HELD), [ONE, CORNER],
     "  component 2, 6 tets around (1.5, 1.5, 1.5), joined to component 1 at one point only: can turn about any line through "
     "(1, 1, 1)\n"),
    ("coincident vertices", case(HELD), [ONE, SIDE],
     "or join the components: 4 vertices coincide with others, and mesh: {merge: 0.01} joins them"),
    ("a merge of whole edges", case(HELD, mesh="file: m.veg, merge: 1"), [ONE, SIDE], "an edge of length 1"),
    ("loads that do not balance", case("free_body"), [ONE],
     "these leave a force (0, 0, -1) of loads of size 1, and a moment (0.5, -0.5, 0) of size 0.866025 about "
     "(0.5, 0.5, 0.5)"),
    ("loads that leave a moment",
     case("free_body", "  - {on: {nearest: [0, 0, 0]}, point_force: [0, 1, 0]}\n"
                       "  - {on: {nearest: [1, 0, 0]}, point_force: [0, -1, 0]}"), [ONE],
     "these leave a force (0, 0, 0) of loads of size 2, and a moment (0, 0, -1)"),
    ("a balance but for rounding", case("free_body", "".join(
        f"  - {{on: {{nearest: {at}}}, point_force: [0, 0, {f}]}}\n"
        for at, f in (([0, 0, 0], 0.1), ([1, 0, 0], 0.2), ([0, 1, 0], -0.3)))), [ONE],
     "leave a force (0, 0, 0) of loads of size 0.6, and a moment (-0.3, -0.2, 0)"),
    ("moduli beyond the range of numbers", case(HELD).replace("modulus: 1000", "modulus: 2e180"), [ONE],
     "youngs_modulus: found '2e180', expected a number of at most 1e75 in size"),
    ("moduli below the range of numbers", case(HELD).replace("modulus: 1000", "modulus: 2e-150"), [ONE],
     "youngs_modulus: found '2e-150', expected a number of at least 1e-75"),
    ("loads beyond the range of numbers", case(HELD, "  - {on: {nearest: [1, 1, 1]}, point_force: [0, 0, -1e75]}\n" * 2), [ONE],
     "the loads, with the forces that prescribed displacements take, are of size 2e+75"),
    ("a free body in two parts", case("free_body"), [ONE, EDGE], "free_body takes one connected body"),
    ("a merge of a shape", case(HELD, mesh=BEAM + ", merge: 1e-6"), [], "merge joins coincident vertices of a mesh file"),
    ("a merge of nothing", case(HELD, mesh="file: m.veg, merge: 0"), [ONE], "merge"),
    ("an unknown word", case("free_boddy"), [ONE], "expected a list of constraints"),
]


def refusals():
    for name, text, cells, wanted in REFUSED:
        messages = set()
        for command in fewer(("check", "solve")):
            for ranks in (1,) if command == "check" else (2,):
                folder = new_folder()
                for file, content in (("m.veg", veg(cells)), ("case.yaml", text), ("result.vtkhdf", "precious")):
                    write(folder, file, content)
                finished = run(command, "case.yaml", ranks=ranks, folder=folder)
                where = f"{name}: {command} on {ranks} rank(s)"
                check(finished.exit_code == 2, f"{where}: exit status {finished.exit_code}\n{finished.errors}")
                check(wanted in finished.errors, f"{where}: no '{wanted}' in: {finished.errors}")
                check(finished.errors.count("orthostat: error:") == 1, f"{where}: one message wanted: {finished.errors}")
                message = finished.errors[finished.errors.index("orthostat: error:"):].split("\n---")[0].strip()
                check(message.count("\n") < 20, f"{where}: a long message: {message}")
                messages.add(message)
                with open(os.path.join(folder, "result.vtkhdf")) as stream:
                    check(stream.read() == "precious", f"{where}: the existing output was touched")
        check(len(messages) == 1, f"{name}: the message depends on the ranks: {messages}")


def merged():
    """Two blocks that share no vertex make one beam once merged, the same as a beam made whole."""
    pull = "  - {on: {nearest: [2, 0, 0]}, point_force: [0, 0, -1]}"
    energies = {}
    for name, mesh, cells in (("whole", "file: m.veg", [ONE, (1, 0, 0, 0)]),
                              ("merged", "file: m.veg, merge: 0.01", [ONE, SIDE])):
        for ranks in fewer((1, 4)):
            folder = new_folder()
            write(folder, "m.veg", veg(cells))
            finished, report, _ = solve(case(HELD, pull, mesh), ranks=ranks, folder=folder)
            check(finished.exit_code == 0, f"{name} on {ranks} ranks: {finished.errors}")
            joined = "joined 4 vertices" in finished.errors
            check(joined == (name == "merged"), f"{name} on {ranks} ranks: {finished.errors}")
            energies[name, ranks] = report["checks"]["strain_energy"]
    whole = energies["whole", fewer((1, 4))[0]]
    for key, energy in energies.items():
        check(abs(energy - whole) <= 1e-9 * whole, f"{key}: energy {energy}, whole {whole}")


def held_apart():
    """Parts that are all held are solved, with a word on vertices that coincide."""
    folder = new_folder()
    write(folder, "m.veg", veg([ONE, SIDE]))
    for ranks in fewer((1, 3)):
        finished, _, _ = solve(case("[{on: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, displacement: [0, 0, 0]}]"),
                               ranks=ranks, folder=folder)
        check(finished.exit_code == 0, finished.errors)
        check("the mesh falls into 2 components, and 4 vertices coincide with others; mesh: {merge: 0.01} joins them"
              in finished.errors, finished.errors)


def free_body():
    """A bar pulled at both ends: energy t²V/(2E), the displacement opposite at opposite points, whoever holds it."""
    exact = 0.5 * 1.0 ** 2 / 1000.0 * 2.0
    slides = ("[{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}, "
              "{on: {boundary: zmin}, slide: [0, 0, 1]}]")
    finished, held, _ = solve(case(slides, PULL, BEAM))
    check(finished.exit_code == 0, finished.errors)
    check(abs(held["checks"]["strain_energy"] - exact) <= 1e-9 * exact, f"held: {held['checks']['strain_energy']}")
    for method, several in ("direct", (1, 2)), ("metric", (1, 4)):
        for ranks in fewer(several):
            text = case("free_body", PULL, BEAM) + f"solver: {{method: {method}, coarsest_unknowns: 100}}\n"
            finished, report, path = solve(text, ranks=ranks)
            where = f"free body, {method} on {ranks} ranks"
            check(finished.exit_code == 0, f"{where}: {finished.errors}")
            energy = report["checks"]["strain_energy"]
            check(abs(energy - exact) <= 1e-9 * exact, f"{where}: energy {energy}, not {exact}")
            points = read_points(path)
            for label, u in points.items():
                a, b, c = (label - 1) // 25, (label - 1) // 5 % 5, (label - 1) % 5
                x = (-1 + a / 4, b / 4 - 0.5, c / 4 - 0.5)
                wanted = (1e-3 * x[0], -0.3e-3 * x[1], -0.3e-3 * x[2])
                worst = max(abs(u[i] - wanted[i]) for i in range(3))
                check(worst <= 1e-9 * 1e-3, f"{where}: vertex {label} moves {u}, not {wanted}")
            opposite = max(abs(points[label] + points[9 * 25 + 1 - label]).max() for label in points)
            check(opposite <= 1e-12, f"{where}: not symmetric by {opposite}")


refusals()
merged()
held_apart()
free_body()
