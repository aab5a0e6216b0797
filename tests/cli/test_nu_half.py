# SPDX-License-Identifier: BSD-3-Clause
"""nu = 1/2 where the mixed form is off: the refusal says why and names ways out, and each of them works."""
import os

from program import check, new_folder, read_json, run

BODY = """mesh: {block: {size: [2, 1, 1], divisions: [2, 1, 1]}}
materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.5}]
"""
HELD = "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
PULLED = "loads: [{on: {boundary: xmax}, traction: [0.01, 0, 0]}]\n"
RIGID = HELD.replace("]}]", "]}, {on: {boundary: xmax}, rigid: [2, 0, 0]}]")
MOVED = "loads: [{on: {boundary: xmax}, distributing: {at: [2, 0.5, 0.5], displacement: [0.01, free, free]}}]\n"
CLASSICAL = "large_rotation: on\nformulation: classical\n"

# A case, and the ways out that the refusal names: lines to put in place of those of the same key.
CASES = {
    "linear tets": (BODY + HELD + PULLED, ["element: {order: 2}"]),
    "left out": (BODY + HELD + PULLED + "element: {order: 2, mixed: off}\n", ["element: {mixed: auto}"]),
    "both": (BODY + HELD + PULLED + "element: {order: 1, mixed: off}\n", ["element: {order: 2, mixed: auto}"]),
    "classical": (BODY + HELD + PULLED + "element: {order: 2}\n" + CLASSICAL, ["formulation: consistent"]),
    "a rigid face": (BODY + RIGID + PULLED + "element: {order: 2, mixed: off}\n", ["element: {mixed: auto}"]),
    "a moved coupling": (BODY + HELD + MOVED, ["element: {order: 2}"]),
}
EVERY = "nu = 0.4999"
folder = new_folder()


def solve(text):
    with open(os.path.join(folder, "case.yaml"), "w", encoding="utf-8") as stream:
        stream.write(text)
    return run("solve", "case.yaml", "-q", folder=folder)


def follow(text, way):
    if way == EVERY:
        return text.replace("poissons_ratio: 0.5", "poissons_ratio: 0.4999")
    key = way.split(":")[0]
    lines = [line for line in text.splitlines() if not line.startswith(key + ":")]
    if way == "element: {mixed: auto}":  # beside the order that is there
        way = "element: {order: 2, mixed: auto}"
    return "\n".join([*lines, way, ""])


for name, (text, ways) in CASES.items():
    refused = solve(text)
    named = " or ".join([*(way + "," for way in ways), EVERY])
    check(refused.exit_code == 2 and refused.errors.rstrip().endswith(f"Set {named}"), f"{name}: {refused.errors}")
    for way in [*ways, EVERY]:
        done = solve(follow(text, way))
        check(done.exit_code == 0, f"{name}, {way}: {done.errors}")

# One ratio of 1/2 keeps the volume of equal moduli alone, and says so; others keep that of a material with an axis.
FREE = ("constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}]\n"
        "element: {order: 2}\nwatch: {" + ", ".join(f"{c}: {{displacement: {{nearest: [2, 1, 1]}}, component: {c}}}" for c in "xyz") + "}\n")
for constants, change, warned in (
        ("youngs_modulus: 60, poissons_ratio: 0.5", 0, False),
        ("youngs_modulus: [60, 20, 20], poissons_ratio: 0.5", 1 - 3 ** 0.5, True),
        ("youngs_modulus: {plane: 20, axis: 60}, poissons_ratio: {plane: 0.8332, plane_axis: 0.16664}, shear_modulus: {axis: 10}, "
         "fibre: [1, 0, 0]", 0, False)):
    with open(os.path.join(folder, "case.yaml"), "w", encoding="utf-8") as stream:
        stream.write(BODY.replace("youngs_modulus: 1, poissons_ratio: 0.5", constants) + FREE + PULLED)
    done = run("solve", "case.yaml", "--json", "volume.json", folder=folder)
    check(done.exit_code == 0 and ("changes by -0.73 times" in done.errors) == warned, f"{constants}: {done.errors}")
    x, y, z = (read_json(folder, "volume.json")["watched"][c]["value"] for c in "xyz")
    check(abs((x / 2 + y + z) / (x / 2) - change) < 1e-3, f"{constants}: {x} {y} {z}")
