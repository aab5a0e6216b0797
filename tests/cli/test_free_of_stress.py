# SPDX-License-Identifier: BSD-3-Clause
"""Bodies whose answer has no energy: one that swells freely, and an incompressible one that bears its load by its pressure alone.
What the equations leave is not taken for an error of the mesh, nor compared with itself. So of one whose springs are where it is
loaded: loads and springs balance, and what strains it is rounding."""
from program import check, new_folder, solve

folder = new_folder()
FREE = """mesh: {block: {size: [4, 1, 1], divisions: [12, 5, 5]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 210e9, poissons_ratio: NU, eigenstrain: {per_unit: 1.2e-5, change: 100}}]
constraints:
  - {on: {boundary: xmin}, slide: [1, 0, 0]}
  - {on: {nearest: [0, 0, 0]}, displacement: [0, 0, 0]}
  - {on: {nearest: [0, 1, 0]}, displacement: [0, free, 0]}
watch: {s: {stress: {region: all}, component: von_mises, take: largest}}
solver: {method: metric}
"""
HELD_STRESS = 210e9 * 1.2e-3
PISTON = """mesh: {block: {size: [2, 1, 1], divisions: [6, 3, 3]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.5}]
constraints:
  - {on: {boundary: [xmin, xmax]}, slide: [1, 0, 0]}
  - {on: {boundary: [ymin, ymax]}, slide: [0, 1, 0]}
  - {on: {boundary: zmin}, slide: [0, 0, 1]}
loads: [{on: {boundary: zmax}, pressure: 7}]
watch: {top: {displacement: {nearest: [1, 0, 1]}, component: z}, p: {stress: {region: all}, component: pressure}}
accuracy: {relative_error: 0.01}
"""

for nu in 0.3, 0.5:
    for change in (), ("--set", "accuracy.relative_error=0.05"):
        done, report, _ = solve(FREE.replace("NU", str(nu)), folder=folder, extra=change)
        check(done.exit_code == 0, f"nu = {nu} {change}: {done.output} {done.errors}")
        check(report["answer_error"]["relative"] < 1e-2, f"nu = {nu} {change}: {report['answer_error']}")
        check(not any("coarse" in warning for warning in report["warnings"]), str(report["warnings"]))
        check(report["watched"]["s"]["value"] < 1e-5 * HELD_STRESS, f"nu = {nu} {change}: {report['watched']['s']}")
        check(report["tets"] == 12 * 5 * 5 * 6, f"no finer mesh: {report['tets']}")

done, report, _ = solve(PISTON, folder=folder)
check(done.exit_code == 0, done.output + done.errors)
error = report["answer_error"]
check(error["relative"] < 1e-6 and error["displacement"] < 1e-6, f"the pressure is exact: {error}")
check(not report["warnings"], str(report["warnings"]))
check(abs(report["watched"]["p"]["value"] - 7) < 1e-9, str(report["watched"]))

BED = """mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}
materials: [{region: all, youngs_modulus: 100, poissons_ratio: 0.3}]
large_rotation: off
springs: [{on: {boundary: zmin}, foundation: 2}]
loads: [{on: {boundary: zmin}, traction: [0, 0, -0.01]}]
watch: {w: {displacement: {nearest: [0, 0, 0]}, component: z}}
"""
HINGE = """mesh: {block: {size: [4, 1, 1], origin: [0, -0.5, -0.5], divisions: [4, 2, 2]}}
large_rotation: on
materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, rigid: {at: [0, 0, 0], displacement: [0, 0, 0], rotation: [0, 0, free]}}]
springs: [{on: {nearest: [4, 0, 0]}, spring: 1, direction: [0, 1, 0]}]
loads: [{on: {nearest: [4, 0, 0]}, point_force: [0, 0.8, 0]}]
watch: {w: {displacement: {nearest: [4, 0, 0]}, component: y}}
"""
for text, w in (BED, -0.005), (HINGE, 0.8):
    done, report, _ = solve(text, folder=folder)
    check(done.exit_code == 0, done.output + done.errors)
    check(abs(report["watched"]["w"]["value"] - w) < 1e-6 * abs(w) and report["checks"]["force_imbalance"] < 1e-9, f"{report}")
