# SPDX-License-Identifier: BSD-3-Clause
"""An accuracy is asked for where finer meshes would hold another problem: refused, told, or held to the first mesh."""
import json
import os

from program import check, new_folder, run

BEAM = """mesh: {block: {size: [4, 1, 1], divisions: [6, 2, 2]}}
materials: [{region: all, youngs_modulus: 1e10, poissons_ratio: %s}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}%s]
loads: [{on: %s, %s}]
watch:
  tip: {displacement: {nearest: [4, 0.5, 0.5]}, component: z}
  inside: {displacement: {nearest: [2.2, 0.3, 0.7]}, component: z}
  across: {displacement: {nearest: [4, 0.5, 0.5]}, component: y}
large_rotation: off
%s
"""
END = "{boundary: xmax}"
SHEAR = "total_force: [0, 0, -1e5]"
folder = new_folder()


def start(command, on=END, load=SHEAR, nu=0.3, more="", support="", options=()):
    with open(os.path.join(folder, "beam.yaml"), "w", encoding="utf-8") as stream:
        stream.write(BEAM % (nu, support, on, load, more))
    return run(command, "beam.yaml", *options, folder=folder)


def solve(accuracy, **changes):
    done = start("solve", options=("--json", "beam.json"), more="accuracy: {relative_error: %s}" % accuracy, **changes)
    check(done.exit_code == 0, done.errors)
    with open(os.path.join(folder, "beam.json"), encoding="utf-8") as stream:
        return done, json.load(stream)


# What acts on each vertex is another load on a finer mesh.
for changes, words in (({"load": "point_force: [0, 0, -1e4]"}, ("beam.yaml:4: a point_force", "total_force")),
                       ({"more": "springs: [{on: {boundary: xmax}, spring: 1e6}]\n"}, ("a spring", "foundation"))):
    more = changes.pop("more", "")
    done = start("solve", more=more, **changes)
    check(done.exit_code == 0 and "acts on each node" not in done.errors, "on the mesh as it is, it is what it says")
    done = start("check", more=more + "element: {order: 2}", **changes)
    check("acts on each node that is selected, 25 here" in done.errors and all(word in done.errors for word in words), done.errors)
    for command in ("check", "solve"):
        done = start(command, more=more + "accuracy: {relative_error: 0.1}", **changes)
        check(done.exit_code == 2 and all(word in done.errors for word in words), done.errors)
    done = start("cost", more=more, **changes, options=("--refine", "1"))
    check(done.exit_code == 2 and all(word in done.errors for word in words), done.errors)

# One vertex stays one, but the energy of a force on it grows without limit.
done = start("solve", on="{nearest: [4, 1, 1]}", load="point_force: [0, 0, -1e5]", more="accuracy: {relative_error: 0.1}")
check(done.exit_code == 1 and "8 times the unknowns the error is" in done.errors and "total_force" in done.errors, done.errors)

# The border of a box in the middle of faces: it holds more of them on each finer mesh.
done, _ = solve("0.005, of: tip", on="{box: {min: [1.5, -1, 0.9], max: [2.5, 2, 1.1]}}")
check("beam.yaml:4: the faces that this load selects cover an area of 0 on the first mesh and 0." in done.errors and
      done.errors.count("cover an area") == 1, done.errors)
done, _ = solve("0.01, of: tip", on="{box: {min: [1.3, -1, 0.9], max: [2.7, 2, 1.1]}}")  # two edges of the first mesh
check("cover" not in done.errors, done.errors)

# A watched place is held to the vertex of the first mesh, and said to be.
done, coarse = solve("0.02, of: inside")
check("'inside' is taken at (2, 0.5, 0.5)" in done.errors and done.errors.count("is taken at") == 1, done.errors)
_, fine = solve("0.005, of: inside")
values = [report["watched"]["inside"]["value"] for report in (coarse, fine)]
check(abs(values[0] / values[1] - 1) < 0.02, f"the same place on each mesh: {values}")

# Zero by symmetry: no mesh is fine enough for 1 % of it; it is compared with a hundredth of the largest displacement.
_, report = solve("0.05, of: across")
check(abs(report["watched"]["across"]["value"]) < 1e-3 * abs(report["watched"]["tip"]["value"]), report["watched"])

# Linear tets cannot keep their volume: the program begins with quadratic ones.
done, report = solve(0.1, nu=0.5)
check(report["adaption"]["levels"][0]["order"] == 2 and "lock" not in done.errors, done.errors)
check(report["adaption"]["answer_level"] == len(report["adaption"]["levels"]), "the last level is the answer")
