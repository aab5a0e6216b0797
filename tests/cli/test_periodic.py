# SPDX-License-Identifier: BSD-3-Clause
"""A periodic cell is as accurate as asked: all pairs of faces are cut where the error is, and still match."""
import os

from bricks import brick_mesh
from program import check, fewer, new_folder, solve

CELL = """
mesh: {file: cell.msh}
materials:
  - {region: soft, youngs_modulus: 100, poissons_ratio: 0.2}
  - {region: stiff, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {periodic: [[_xmin, _xmax], [_ymin, _ymax], [_zmin, _zmax]], strain: {STRAIN}}
  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}
watch: {along: {reaction: {boundary: _xmax}, component: x}, across: {reaction: {boundary: _zmax}, component: z}, energy: strain_energy}
accuracy: {ACCURACY}
"""
folder = new_folder()


def found(strain, accuracy, ranks=1):
    done, report, _ = solve(CELL.replace("STRAIN", strain).replace("ACCURACY", accuracy), ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    return report, {name: of["value"] for name, of in report["watched"].items()}


# A stiff cube in a soft cell: by periodicity it is the same in the centre and at a corner, beside three pairs of faces.
# Exact: extrapolated from quadratic tets, the whole mesh refined to 332,000 unknowns, or where the error is.
ENERGY, ALONG = 0.0073839, 1.193
for stiff, ranks in fewer((((1, 1, 1), 1), ((1, 1, 1), 3), ((0, 0, 0), 2))):
    brick_mesh(os.path.join(folder, "cell.msh"),
               [("", (0, 0, 0), (1, 1, 1), (3, 3, 3), lambda cell, stiff=stiff: "stiff" if cell == stiff else "soft")])
    report, values = found("xx: 0.01, yz: 0.004", "relative_error: 0.07", ranks)
    error, stated = max(values["energy"] / ENERGY - 1, 0) ** 0.5, report["answer_error"]["relative"]
    check(0.7 * error < stated < 1.5 * error and error < 0.07, f"{stiff}, {ranks} ranks: stated {stated}, true {error}")
    check(abs(values["along"] / ALONG - 1) < 0.07 ** 2 + 0.001, f"the stress is {values['along']}")
    check(report["adaption"]["levels"][-1]["tets"] > 162, "it is refined")

# Of a watched stress.
report, values = found("xx: 0.01, yz: 0.004", "relative_error: 0.01, of: along")
check(abs(values["along"] / ALONG - 1) < 0.01 and report["adaption"]["levels"][-1]["tets"] > 162, f"{values}")

# Layers in series have no error on any mesh.
brick_mesh(os.path.join(folder, "cell.msh"), [("", (0, 0, 0), (1, 1, 1), (2, 3, 4), ("soft", "stiff"))])
report, values = found("zz: 0.01", "relative_error: 0.07")
exact = 0.01 * 2 / (1 / (100 * 0.8 / (1.2 * 0.6)) + 1 / (1000 * 0.7 / (1.3 * 0.4)))
check(abs(values["across"] / exact - 1) < 1e-8 and len(report["adaption"]["levels"]) == 1, f"{values}, expected {exact}")
