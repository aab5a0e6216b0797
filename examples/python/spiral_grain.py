#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Spiral grain: the fibres of many trees wind around the trunk. What does a post of such wood do under load?

To be read from top to bottom; editors that know `# %%` run it cell by cell, as a notebook. On several ranks, and with the
picture:

    mpirun -n 2 spiral_grain.py
    spiral_grain.py --picture spiral_grain.png
"""
import argparse

import numpy as np

import orthostat

# %% The mesh: a post, 1 × 1 and 10 high, of cubes of six tets each, made by numpy alone.
SIDE, HEIGHT, WIDE, HIGH = 1.0, 10.0, 3, 20


def make_post():
    """(points, tets, faces of the foot, faces of the top)"""
    number = np.arange((WIDE + 1) ** 2 * (HIGH + 1)).reshape(WIDE + 1, WIDE + 1, HIGH + 1)
    steps = np.linspace(-SIDE / 2, SIDE / 2, WIDE + 1), np.linspace(-SIDE / 2, SIDE / 2, WIDE + 1), np.linspace(0, HEIGHT, HIGH + 1)
    points = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3)

    def corner(i, j, k):
        return number[i:WIDE + i, j:WIDE + j, k:HIGH + k].ravel()

    # A tet walks from a cube's corner to the opposite one, along x, y, z in one of six orders; odd ones are turned over.
    tets = []
    for order, odd in ((0, 1, 2), 0), ((1, 2, 0), 0), ((2, 0, 1), 0), ((0, 2, 1), 1), ((2, 1, 0), 1), ((1, 0, 2), 1):
        at = [(0, 0, 0)]
        for direction in order:
            at.append(tuple(at[-1][d] + (d == direction) for d in range(3)))
        nodes = np.stack([corner(*place) for place in at], axis=1)
        tets.append(nodes[:, [0, 2, 1, 3]] if odd else nodes)

    def layer(k):
        square = number[:, :, k]
        a, b, c, d = (square[i:WIDE + i, j:WIDE + j].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
        return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])

    return points, np.concatenate(tets), layer(0), layer(HIGH)


points, tets, foot, top = make_post()


# %% The grain: e1 climbs around the axis by an angle, e2 points away from it. One frame for each tet.
def spiral_axes(degrees):
    middle = points[tets].mean(axis=1)
    radius = np.hypot(middle[:, 0], middle[:, 1])[:, None]
    away = np.column_stack([middle[:, 0], middle[:, 1], 0 * radius]) / radius
    up = np.array([0.0, 0.0, 1.0])
    around = np.cross(up, away)
    e1 = np.cos(np.radians(degrees)) * up + np.sin(np.radians(degrees)) * around
    return np.stack([e1, away, np.cross(e1, away)], axis=1)


# %% The physics: spruce, in GPa and cm; the foot stands still, and the top carries a weight.
case = {
    "title": "a post with spiral grain",
    "mesh": "from_program",
    "element": {"order": 2},
    "materials": [{"region": "all", "youngs_modulus": [10, 0.8, 0.5],
                   "poissons_ratio": {"nu12": 0.4, "nu23": 0.3, "nu31": 0.02},
                   "shear_modulus": {"G12": 0.6, "G23": 0.04, "G31": 0.6}, "axes": {"cells": "mesh"}}],
    "constraints": [{"on": {"boundary": "foot"}, "displacement": [0, 0, 0]}],
    "loads": [{"on": {"boundary": "top"}, "total_force": [0, 0, -0.001]}],
}


def scene_of(degrees, **changes):
    arrays = orthostat.MeshArrays(points, tets, boundaries={"foot": foot, "top": top}, axes=spiral_axes(degrees))
    return orthostat.Case({**case, **changes}).scene(arrays)


def twist(scene, u):
    """By how many degrees the top turns about the axis: the mean of its nodes, on every rank."""
    x, u = scene.mesh.gather_nodes(scene.mesh.points), scene.mesh.gather_nodes(u)
    at = x[:, 2] == HEIGHT
    x, u = x[at], u[at]
    return np.degrees((x[:, 0] * u[:, 1] - x[:, 1] * u[:, 0]).sum() / (x[:, :2] ** 2).sum())


# %% One post: the weight shortens it and turns its top. The answer comes with an estimate of its error.
scene = scene_of(20)
result = scene.solve()
rank0 = scene.context.rank == 0
if rank0:
    print(f"grain at 20 degrees: sinks by {result.largest_displacement:.5g}, error about {100 * result.error.relative:.1f} % in energy")

# %% Many loads on one post: matrix and hierarchy are made once. A push at the top, from twelve sides.
analysis = scene.analysis()
mesh = scene.mesh
at_top = mesh.points[:mesh.owned_nodes, 2] == HEIGHT
nodes_at_top = mesh.gather_nodes(at_top).sum()
pushes = []
for degrees in range(0, 360, 30):
    force = np.zeros((mesh.owned_nodes, 3))
    force[at_top] = 0.001 / nodes_at_top * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0])
    answer = analysis.solve(force, fields=())
    pushes.append((degrees, answer.largest_displacement, answer.iterations))
if rank0:
    softest = max(pushes, key=lambda push: push[1])
    print(f"{len(pushes)} pushes on one hierarchy: moves by {min(p[1] for p in pushes):.5g} to {softest[1]:.5g}, "
          f"{sum(p[2] for p in pushes)} iterations in all")

# %% The sweep: how far does the top turn, by the angle of the grain?
angles = np.arange(0, 91, 10)
twists = []
for degrees in angles:
    swept = scene_of(degrees)
    twists.append(twist(swept, swept.solve().displacement))
if rank0:
    print("twist by angle:", ", ".join(f"{degrees}: {turn:.3g}" for degrees, turn in zip(angles, twists)))

# %% A pose: pushed aside as well, with large rotations.
push = [{"on": {"boundary": "top"}, "total_force": [0.001, 0, -0.001]}]
posed = scene_of(20, loads=push, large_rotation="on")
pose = posed.solve()
if rank0:
    print(f"large rotations: moves by {pose.largest_displacement:.5g}, {pose.newton.iterations} Newton iterations")


# %% The picture, drawn by rank 0 from what all ranks bring together.
def draw(path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    whole, whole_tets = mesh.whole()
    u = mesh.gather_nodes(result.displacement)
    shown = abs(twist(scene, result.displacement))
    if not rank0:
        return
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 5), width_ratios=(1, 1.2), layout="constrained")
    for shift, enlarged, title in (0, 0, "at rest"), (3, 20, "pressed"):
        draw_post(left, whole, whole_tets, enlarged * u, shift)
        left.text(shift, -1, title, ha="center")
    left.set(xlim=(-0.9, 3.9), ylim=(-1.5, HEIGHT + 0.8), aspect="equal", title="grain at 20° (motion 20 × enlarged)")
    left.set_axis_off()
    right.plot(angles, np.abs(twists), "o-", color="saddlebrown")
    right.plot(20, shown, "o", color="black", markersize=9)
    right.annotate("the post on the left", (20, shown), (10, -6), textcoords="offset points")
    right.set(xlabel="angle between grain and post, degrees", ylabel="the top turns by, degrees", ylim=(0, None))
    right.spines[["top", "right"]].set_visible(False)
    figure.suptitle("Pressed, a post with spiral grain turns", fontsize=14)
    figure.savefig(path, dpi=110)


def draw_post(axes, whole, tets, u, shift):
    """The faces that look at us, shaded, and the grain on them."""
    from matplotlib.collections import LineCollection, PolyCollection
    turn, tilt = np.radians(30), np.radians(12)
    view = np.array([[np.cos(turn), np.sin(turn), 0], [0, 0, 1.0], [np.sin(turn), -np.cos(turn), 0]])  # right, up, to us
    view = np.array([[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]) @ view
    seen = (whole + u) @ view.T + [shift, 0, 0]
    skin = skin_of(tets)
    normal = np.cross(seen[skin[:, 1]] - seen[skin[:, 0]], seen[skin[:, 2]] - seen[skin[:, 0]])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    skin, normal = skin[normal[:, 2] > 0], normal[normal[:, 2] > 0]
    colours = (0.55 + 0.45 * np.clip(normal @ [-0.45, 0.45, 0.77], 0, 1))[:, None] * [0.96, 0.83, 0.64]
    axes.add_collection(PolyCollection(seen[skin][:, :, :2], facecolors=colours, edgecolors=colours, linewidths=0.4))
    axes.add_collection(LineCollection(grain_lines(whole, u) @ view.T[:, :2] + [shift, 0], colors="saddlebrown", linewidths=1.0))


def skin_of(tets):
    """The faces (vertices alone) that belong to one tet only, seen from outside."""
    faces = np.concatenate([tets[:, list(face)] for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def grain_lines(whole, u):
    """(lines, points of a line, 3): at 20 degrees on the two sides that look at us, moved with the nodes around."""
    climb, s = SIDE / np.tan(np.radians(20)), np.linspace(0, 1, 40)
    lines = []
    for start in np.arange(-climb, HEIGHT, climb / 3):
        z = start + s * climb
        for side in (np.column_stack([s - 0.5, 0 * s - 0.5, z]), np.column_stack([0 * s + 0.5, s - 0.5, z])):
            line = side * [SIDE, SIDE, 1]
            weight = 1 / (((line[:, None] - whole) ** 2).sum(axis=2) ** 2 + 1e-6)
            line += weight @ u / weight.sum(axis=1)[:, None]
            line[(z < 0) | (z > HEIGHT)] = np.nan
            lines.append(line)
    return np.array(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="What a post with spiral grain does under load.")
    parser.add_argument("--picture", metavar="FILE", help="draw it (wants matplotlib)")
    arguments = parser.parse_args()
    if arguments.picture:
        draw(arguments.picture)
