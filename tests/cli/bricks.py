# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of bricks, for tests."""
import itertools


def brick_mesh(path, bricks, move=lambda place: place):
    """Bricks (name, origin, size, divisions, regions of the layers along z, or a function of the cell) in one Gmsh file, each
    with the boundaries name_xmin ...; `move`: where nodes go to in the end."""
    nodes, tets, faces, groups = [], [], [], {}
    for name, origin, size, (nx, ny, nz), regions in bricks:
        first = len(nodes)
        nodes += [[origin[k] + size[k] * place[k] / (nx, ny, nz)[k] for k in range(3)]
                  for place in itertools.product(range(nx + 1), range(ny + 1), range(nz + 1))]
        sides = {}
        for cell in itertools.product(range(nx), range(ny), range(nz)):
            material = regions(cell) if callable(regions) else regions[cell[2] * len(regions) // nz]
            region = groups.setdefault((3, material), len(groups) + 1)
            for order in itertools.permutations(range(3)):
                corner, tet = list(cell), []
                for k in (None, *order):
                    if k is not None:
                        corner[k] += 1
                    tet.append(first + (corner[0] * (ny + 1) + corner[1]) * (nz + 1) + corner[2] + 1)
                if sum(order[i] > order[j] for i in range(3) for j in range(i, 3)) % 2:
                    tet[2], tet[3] = tet[3], tet[2]
                tets.append((region, tet))
                for face in itertools.combinations(sorted(tet), 3):
                    sides[face] = sides.get(face, 0) + 1
        for face in (f for f, count in sides.items() if count == 1):
            for k, end in itertools.product(range(3), (0, 1)):
                if all(abs(nodes[v - 1][k] - origin[k] - end * size[k]) < 1e-9 for v in face):
                    faces.append((groups.setdefault((2, f"{name}_{'xyz'[k]}{('min', 'max')[end]}"), len(groups) + 1), face))
    items = [(2, *f) for f in faces] + [(4, *t) for t in tets]
    with open(path, "w") as stream:
        stream.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(groups)}\n")
        stream.writelines(f'{dimension} {number} "{name}"\n' for (dimension, name), number in groups.items())
        stream.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        stream.writelines(f"{n + 1} {x!r} {y!r} {z!r}\n" for n, (x, y, z) in enumerate(map(move, nodes)))
        stream.write(f"$EndNodes\n$Elements\n{len(items)}\n")
        stream.writelines(f"{n + 1} {kind} 2 {group} {group} {' '.join(map(str, item))}\n"
                          for n, (kind, group, item) in enumerate(items))
        stream.write("$EndElements\n")
