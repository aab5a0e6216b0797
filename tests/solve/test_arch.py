# SPDX-License-Identifier: BSD-3-Clause
"""A shallow arch snaps through at the load of the formula: Y. C. Fung and A. Kaplan, Buckling of low arches or curved beams
of small curvature, NACA TN 2840 (1952). A pinned half-sine arch under a half-sine load; its rise is 2 e times the radius of
gyration of the section. e = 1.8 passes a limit point, symmetrically; e = 3 buckles to one side before."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SANITIZED, check, new_folder, solve  # noqa: E402

LENGTH, YOUNG, PIECES = 100.0, 1e6, 40
GYRATION = math.sqrt(1 / 12)  # of a square of side 1
SIX_TETS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (1, 0, 2), (2, 1, 0))  # the axes along which corners follow


def limit_load(e):
    """The largest load per length."""
    reduced = e + math.sqrt(4 / 27 * (e * e - 1) ** 3) if e * e < 5.5 else e + 3 * math.sqrt(e * e - 4)
    return reduced * 2 * math.pi**4 * YOUNG / 12 * GYRATION / LENGTH**4


def nodes_of(rise):
    """By place along the arch, across it (2) and through it (3)."""
    nodes = []
    for i in range(PIECES + 1):
        x = LENGTH * i / PIECES
        slope = rise * math.pi / LENGTH * math.cos(math.pi * x / LENGTH)
        cosine = 1 / math.hypot(1, slope)
        middle = rise * math.sin(math.pi * x / LENGTH)
        nodes += [(x - d * slope * cosine, y, middle + d * cosine) for y in (-0.5, 0.5) for d in (-0.5, 0.0, 0.5)]
    return nodes


def number(i, j, k):
    return 6 * i + 3 * j + k + 1


def tets_of_cell(i, k):
    for turn, axes in enumerate(SIX_TETS):
        corner = [i, 0, k]
        tet = [number(*corner)]
        for axis in axes:
            corner[axis] += 1
            tet.append(number(*corner))
        if turn >= 3:
            tet[2], tet[3] = tet[3], tet[2]
        yield tet


def write_mesh(path, rise):
    nodes = nodes_of(rise)
    tops = [[[number(i, 0, 2), number(i + 1, 0, 2), number(i + 1, 1, 2)], [number(i, 0, 2), number(i + 1, 1, 2), number(i, 1, 2)]]
            for i in range(PIECES)]
    elements = [f"4 2 1 1 {' '.join(map(str, tet))}" for i in range(PIECES) for k in (0, 1) for tet in tets_of_cell(i, k)]
    elements += [f"2 2 {i + 2} {i + 2} {' '.join(map(str, face))}" for i, faces in enumerate(tops) for face in faces]
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{PIECES + 1}\n3 1 \"arch\"\n")
        stream.writelines(f'2 {i + 2} "top {i}"\n' for i in range(PIECES))
        stream.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        stream.writelines(f"{n + 1} {x!r} {y!r} {z!r}\n" for n, (x, y, z) in enumerate(nodes))
        stream.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        stream.writelines(f"{n + 1} {element}\n" for n, element in enumerate(elements))
        stream.write("$EndElements\n")


def crown(folder, e, share):
    """How far the crown comes down, over the rise, and what is said of the way there."""
    rise = 2 * e * GYRATION
    write_mesh(os.path.join(folder, "arch.msh"), rise)
    loads = "".join(f"  - {{on: {{boundary: top {i}}}, traction: [0, 0, "
                    f"{-share * limit_load(e) * math.sin(math.pi * (i + 0.5) / PIECES)!r}]}}\n" for i in range(PIECES))
    pins = [number(i, j, 1) for i in (0, PIECES) for j in (0, 1)]
    done, report, _ = solve(f"""title: arch
mesh: {{file: arch.msh}}
element: {{order: 2}}
materials: [{{region: arch, youngs_modulus: {YOUNG}, poissons_ratio: 0}}]
constraints:
  - {{on: {{vertices: {pins}}}, displacement: [0, 0, 0]}}
  - {{on: {{box: {{min: [-9, -0.6, -9], max: [109, -0.4, 9]}}}}, displacement: [free, 0, free]}}
loads:
{loads}large_rotation: on
output: {{fields: [displacement]}}
watch: {{crown: {{displacement: {{nearest: [50, 0.5, {rise + 0.5}]}}, component: z}}}}
""", folder=folder)
    check(done.exit_code == 0, done.errors)
    return -report["watched"]["crown"]["value"] / rise, done.output + done.errors


folder = new_folder()
for e in (3.0,) if SANITIZED else (1.8, 3.0):
    below, said = crown(folder, e, 0.98)
    check(below < 0.5 and "jumps" not in said, f"e = {e}, below its limit load: comes down by {below} of its rise\n{said}")
    above, said = crown(folder, e, 1.02)
    check(above > 1.5 and "jumps to another state" in said, f"e = {e}, above it: comes down by {above} of its rise\n{said}")
