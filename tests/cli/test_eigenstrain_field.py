"""Eigenstrains tet by tet, from a field of the mesh file: $ElementData of .msh, text and bytes, and CellData of .vtkhdf; and
eigenstrains and moduli at vertices, $NodeData."""
import json
import math
import struct

from program import check, fewer, new_folder, run, write

CORNERS = [(0, 1, 3, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 1, 7, 5), (0, 4, 7, 6), (0, 2, 7, 3)]
LENGTH = 3
STRAIN = {"lower": (0.01, 0.0, 0.02), "upper": (0.03, -0.01, 0.0)}


def bar():
    """Points and tets (tag, region, corners) of a bar of 3 by 1 by 2 unit cubes; the upper half is a region of its own."""
    number = {}
    tets = []
    for x in range(LENGTH):
        for z in range(2):
            corner = [number.setdefault((x + (k & 1), k >> 1 & 1, z + (k >> 2 & 1)), len(number) + 1) for k in range(8)]
            tets += [(100 + len(tets) + i, "upper" if z else "lower", [corner[v] for v in tet]) for i, tet in enumerate(CORNERS)]
    return list(number), tets


POINTS, TETS = bar()


def msh(fields, binary=False, at_vertices={}):
    """A file of version 2.2 with these fields: {name: (components, {tag: numbers})}, {name: numbers of vertices}."""
    def record(form, *numbers):
        return struct.pack("=" + form, *numbers) if binary else (" ".join(map(repr, numbers)) + "\n").encode()
    out = b"$MeshFormat\n2.2 %d 8\n" % binary + (struct.pack("=i", 1) + b"\n" if binary else b"") + b"$EndMeshFormat\n"
    out += b'$PhysicalNames\n2\n3 1 "lower"\n3 2 "upper"\n$EndPhysicalNames\n'
    out += b"$Nodes\n%d\n" % len(POINTS)
    for i, point in enumerate(POINTS):
        out += record("iddd", i + 1, *map(float, point))
    out += (b"\n" if binary else b"") + b"$EndNodes\n$Elements\n%d\n" % len(TETS)
    out += struct.pack("=iii", 4, len(TETS), 2) if binary else b""
    for tag, region, corners in TETS:
        group = 1 if region == "lower" else 2
        out += record("iiiiiii", tag, group, group, *corners) if binary else record("", tag, 4, 2, group, group, *corners)
    out += (b"\n" if binary else b"") + b"$EndElements\n"
    for name, (components, values) in fields.items():
        out += b'$ElementData\n1\n"%s"\n1\n0.0\n3\n0\n%d\n%d\n' % (name.encode(), components, len(values))
        for tag, numbers in values.items():
            out += record("i" + components * "d", tag, *numbers)
        out += (b"\n" if binary else b"") + b"$EndElementData\n"
    for name, values in at_vertices.items():
        out += b'$NodeData\n1\n"%s"\n1\n0.0\n3\n0\n1\n%d\n' % (name.encode(), len(values))
        for number, value in enumerate(values):
            out += record("id", number + 1, value)
        out += b"$EndNodeData\n"
    return out


HELD = """constraints: [{on: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, slide: [1, 0, 0]},
              {on: {plane: {point: [0, 0, 0], normal: [0, 1, 0]}}, slide: [0, 1, 0]},
              {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}]
large_rotation: off
accuracy: {relative_residual: 1e-12}
watch: {end: {displacement: {nearest: [3, 1, 2]}}, energy: strain_energy}
"""


def case(eigenstrain, mesh="file: bar.msh", order=1, more=""):
    """One eigenstrain of all, or one for each half."""
    halves = eigenstrain if isinstance(eigenstrain, dict) else {"all": eigenstrain}
    axes = "axes: {fixed: [[0, 0, 1], [1, 0, 0], [0, 1, 0]]}"
    return (f"mesh: {{{mesh}}}\nelement: {{order: {order}}}\nmaterials:\n" +
            "".join(f"  - {{region: {region}, youngs_modulus: [1e3, 2e3, 5e2], poissons_ratio: 0.3, {axes}, eigenstrain: {value}}}\n"
                    for region, value in halves.items()) + HELD + more)


folder = new_folder()


def answer(text, ranks=1):
    write(folder, "case.yaml", text)
    done = run("solve", "case.yaml", "-q", "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    watched = json.loads(done.output)["watched"]
    return watched["end"]["value"], watched["energy"]["value"]


def same(found, expected, what, tolerance=1e-9):
    check(all(abs(a - b) <= tolerance * abs(b) for a, b in zip(found, expected)), f"{what}: {found}, expected {expected}")


def shuffled(values):
    """As a file may have them: in another order, with an element that is no tet."""
    return {7: values[TETS[0][0]], **dict(reversed(values.items()))}


along = {tag: STRAIN[region] for tag, region, _ in TETS}
tensor = {tag: (e[0], 0.002, 0.0, 0.004, e[1], 0.0, 0.0, 0.006, e[2]) for tag, e in along.items()}
moisture = {tag: (2.0 if region == "upper" else 0.5,) for tag, region, _ in TETS}
FIELDS = {"other": (1, moisture), "swelling": (3, shuffled(along)), "tensor": (9, tensor), "moisture": (1, moisture)}
STATED = {region: list(e) for region, e in STRAIN.items()}
SHEARED = {region: [*e, 0.006, 0.006, 0.0] for region, e in STRAIN.items()}  # engineering: 12 is .002 + .004
GROWN = {region: [0.01 * m, 0.0, -0.02 * m] for region, m in (("lower", 0.5), ("upper", 2.0))}

for field, stated in (("{field: swelling}", STATED), ("{field: tensor}", SHEARED),
                      ("{per_unit: [0.01, 0, -0.02], change: {field: moisture}}", GROWN)):
    write(folder, "bar.msh", msh(FIELDS))
    expected = answer(case(stated))
    check(expected[1] > 0, "the halves are in each other's way")
    same(answer(case(field), fewer((1, 3))[-1]), expected, field)
    write(folder, "bar.msh", msh(FIELDS, binary=True))
    same(answer(case(field)), expected, f"{field}, binary")
fine = "file: bar.msh, refine: 1"
expected = answer(case(STATED, fine, 2))
for ranks in fewer((1, 4)):
    same(answer(case("{field: swelling}", fine, 2), ranks), expected, f"refined, of order 2, on {ranks} ranks")

# From a result: the energy density of a bar that is pulled is F²/(2 E A²), and swells the same bar freely by as much.
write(folder, "pulled.yaml", "mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 2]}}\n"
      "materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0}]\nlarge_rotation: off\n"
      "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]},\n"
      "              {on: {boundary: zmin}, slide: [0, 0, 1]}]\nloads: [{on: {boundary: xmax}, total_force: [1, 0, 0]}]\n")
done = run("solve", "pulled.yaml", folder=folder)
check(done.exit_code == 0, done.errors)
for ranks in fewer((1, 3)):
    write(folder, "grown.yaml", "mesh: {file: pulled.vtkhdf}\n"
          "materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0, eigenstrain: {field: strain_energy_density}}]\n"
          "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]},\n"
          "              {on: {boundary: zmin}, slide: [0, 0, 1]}]\n"
          "large_rotation: off\nwatch: {end: {displacement: {nearest: [2, 1, 1]}, component: x}}\n")
    done = run("solve", "grown.yaml", "-q", "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    grown = json.loads(done.output)["watched"]["end"]["value"]
    check(math.isclose(grown, 2 / 20, rel_tol=1e-7), f"grown by {grown} on {ranks} ranks")

# A free bar whose temperature is linear has no stress; of linear tets, whose strain is uniform, less on a finer mesh. A bar
# with E = 1 + x, or (1 + x)^2 as a power, grows by F ln 4, or F (1 - 1/4).
write(folder, "bar.msh", msh({}, at_vertices={"T": [20 + 10 * x for x, _, _ in POINTS], "E": [1 + x for x, _, _ in POINTS],
                                              "odd": [x - 1.5 for x, _, _ in POINTS]}))
FREE = """constraints: [{on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}, {on: {nearest: [0, 0, 2]}, displacement: [0, 0, free]},
              {on: {nearest: [0, 1, 0]}, displacement: [0, free, free]}]
watch: {mises: {stress: {region: all}, component: von_mises, take: largest}}
"""
PULLED = """constraints: [{on: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}, displacement: [0, 0, 0]}]
loads: [{on: {plane: {point: [3, 0, 0], normal: [1, 0, 0]}}, traction: [0.01, 0, 0]}]
watch: {end: {displacement: {nearest: [3, 1, 1]}, component: x}}
"""


def watched(material, rest, order=2, mesh="file: bar.msh", ranks=1, large="off"):
    write(folder, "case.yaml", f"mesh: {{{mesh}}}\nelement: {{order: {order}}}\nmaterials: [{{region: all, {material}}}]\n"
          f"large_rotation: {large}\naccuracy: {{relative_residual: 1e-11}}\n{rest}")
    done = run("solve", "case.yaml", "-q", "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    return next(iter(json.loads(done.output)["watched"].values()))


HEATED = "youngs_modulus: 1e3, poissons_ratio: %s, eigenstrain: {per_unit: %s, change: {field: T}}"
FINER = "file: bar.msh, refine: 1"
for nu, mesh, ranks in fewer(((0.3, "file: bar.msh", 3), (0.3, FINER, 1), (0.5, "file: bar.msh", 1))):
    found = watched(HEATED % (nu, 1e-3), FREE, 2, mesh, ranks)["value"]
    check(found < 1e-7 * 1e3 * 1e-3 * 30, f"a free bar, nu = {nu}, {mesh}, {ranks} ranks: {found}")
found = watched(HEATED % (0.3, 1e-5), FREE, large="on")["value"]  # with E alpha T = 0.3 what is left is of second order
check(found < 1e-3 * 1e3 * 1e-5 * 30, f"a free bar, large rotations: {found}")
coarse, fine = (watched(HEATED % (0.3, 1e-3), FREE, 1, mesh)["value"] for mesh in ("file: bar.msh", FINER))
check(0.2 * coarse < fine < 0.7 * coarse, f"linear tets: {coarse}, finer {fine}")
for modulus, order, mesh, exact in fewer((("{field: E, power: 2}", 2, FINER, 0.0075), ("{field: E}", 2, "file: bar.msh", 0.01 * math.log(4)),
                                          ("{field: E}", 1, FINER, 0.01 * math.log(4)))):
    end = watched(f"youngs_modulus: {modulus}, poissons_ratio: 0", PULLED, order, mesh)
    off = exact - end["value"]
    check(abs(off) < 0.03 * exact and 0.7 < end["error"] / off < 1.3, f"{modulus}, order {order}, {mesh}: {end}, exact {exact}")

# What is refused, where it stands.
write(folder, "case.yaml", "mesh: {file: bar.msh}\nmaterials: [{region: all, youngs_modulus: {field: odd, power: 2}, poissons_ratio: 0}]\n" + PULLED)
refused = run("check", "case.yaml", folder=folder)
check(refused.exit_code == 2 and "none makes a Young's modulus in between" in refused.errors, refused.errors)
write(folder, "bar.msh", msh({"few": (3, dict(list(along.items())[:5])), "two": (2, {tag: (1, 2) for tag in along}),
                              "some": (1, {tag: (5,) for tag in list(along)[:5]}), **FIELDS}))
write(folder, "case.yaml", "mesh: {file: bar.msh}\nmaterials: [{region: all, youngs_modulus: {field: some}, poissons_ratio: 0}]\n" + PULLED)
refused = run("check", "case.yaml", folder=folder)
check(refused.exit_code == 2 and "nan is no number" in refused.errors, refused.errors)
for eigenstrain, mesh, words in (
        ("{field: swelling_}", "file: bar.msh", "there is no field 'swelling_' on the elements, or on the nodes; there is 'few', 'two', "),
        ("{field: few}", "file: bar.msh", "the field 'few' has no number for tet 105 of region 'lower'"),
        ("{field: two}", "file: bar.msh", "the field 'two' has 2 numbers a tet, expected 1, 3, 6 or 9"),
        ("{per_unit: 1, change: {field: swelling}}", "file: bar.msh", "the field 'swelling' has 3 numbers a tet; a change is one"),
        ("{field: swelling}", "block: {size: [3, 1, 2], divisions: [3, 1, 2]}", "this mesh comes from none"),
        ("{field: nothing}", "file: pulled.vtkhdf", "there is no field 'nothing' on the elements, or on the nodes; there is ")):
    write(folder, "case.yaml", case(eigenstrain, mesh))
    for ranks in fewer((1, 3)) if "few" in eigenstrain or "nothing" in eigenstrain else (1,):
        refused = run("check", "case.yaml", ranks=ranks, folder=folder)
        check(refused.exit_code == 2 and words in refused.errors and "case.yaml:4:" in refused.errors, f"{eigenstrain}: {refused.errors}")
write(folder, "bar.msh", msh({"swelling": (3, along)}).replace(b"\n101 4 ", b"\n100 4 "))
write(folder, "case.yaml", case("{field: swelling}"))
refused = run("check", "case.yaml", folder=folder)
check(refused.exit_code == 2 and "give each element its own tag" in refused.errors, refused.errors)
