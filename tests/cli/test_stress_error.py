# SPDX-License-Identifier: BSD-3-Clause
"""The estimated error of watched stresses at points, of least and largest ones, and of load factors to failure, against formulas of thick tubes (Lame, and
Lekhnitskii for one that is 10 times stiffer around)."""
import math
import os

from bricks import brick_mesh
from program import check, fewer, new_folder, solve

TUBE = """mesh:
  sector: {{axis: z, length: 0.5, radii: [1, 2], angle: 90, divisions: {{around: 8, radial: 6, axial: 2}}}}
element: {{order: {order}}}
materials:
  - region: all
    {moduli}
    strengths: {{tension: 4, compression: 90, shear: 90}}
    axes: {{cylindrical: {{origin: [0, 0, 0], axis: [0, 0, 1], order: [radial, tangential, axial]}}}}
constraints:
  - {{on: {{boundary: [bottom, top]}}, slide: [0, 0, 1]}}
  - {{on: {{boundary: start}}, slide: [1, 0, 0]}}
  - {{on: {{boundary: finish}}, slide: [0, 1, 0]}}
loads: [{{on: {{boundary: inner}}, pressure: 1}}]
large_rotation: off
watch:
  hoop: {{stress: {{region: all}}, component: {around}, take: largest}}
  breaks: {{load_factor: {{region: all}}, criterion: maximum_stress}}
"""
LAME = ("youngs_modulus: 1000\n    poissons_ratio: 0.3", 1.0, "largest_principal")
ORTHOTROPIC = ("youngs_modulus: [10, 100, 10]\n    poissons_ratio: {nu12: 0.03, nu23: 0.3, nu13: 0.3}\n    "
               "shear_modulus: {G12: 5, G23: 5, G31: 5}", 3.030287741, "22")
PLACES = [(1.15 + 0.09 * k, 0.2 + (0.37 * k) % 1.2, 0.06 + (0.17 * k) % 0.4) for k in range(8)]  # r, angle, z
folder = new_folder()


def stresses(r, k):
    """Radial and hoop, under a pressure of 1 within, of a tube of radii 1 and 2."""
    scale = 0.5 ** (k + 1) / (1 - 0.25 ** k)
    grows, falls = (r / 2) ** (k - 1), (2 / r) ** (k + 1)
    return scale * (grows - falls), scale * k * (grows + falls)


for moduli, k, around in LAME, ORTHOTROPIC:
    for order in 1, 2:
        text = TUBE.format(order=order, moduli=moduli, around=around)
        for n, (r, angle, z) in enumerate(PLACES):
            text += f"  p{n}: {{stress: {{at: [{r * math.cos(angle)}, {r * math.sin(angle)}, {z}]}}, component: yy}}\n"
        first = None
        for ranks in fewer((1, 2, 4)) if order == 2 else (1,):
            done, report, _ = solve(text, ranks=ranks, folder=folder)
            check(done.exit_code == 0, done.errors)
            watched = report["watched"]
            true = left = stated = 0.0
            for n, (r, angle, _) in enumerate(PLACES):
                radial, hoop = stresses(r, k)
                missing = radial * math.sin(angle) ** 2 + hoop * math.cos(angle) ** 2 - watched[f"p{n}"]["value"]
                true += abs(missing)
                stated += abs(watched[f"p{n}"]["error"])
                left += abs(missing - watched[f"p{n}"]["error"])
            name = f"k {k}, order {order}, {ranks} ranks"
            check(0.7 < stated / true < 1.4 and left < 0.45 * true, f"{name}: {true} missing, {stated} stated, {left} left")
            missing = stresses(1, k)[1] - watched["hoop"]["value"]
            check(0.5 < watched["hoop"]["error"] / missing < 1.5, f"{name}: {watched['hoop']}, missing {missing}")
            missing = 4 / stresses(1, k)[1] - watched["breaks"]["value"]
            check(0.5 < watched["breaks"]["error"] / missing < 1.5, f"{name}: {watched['breaks']}, missing {missing}")
            errors = [watched[key]["error"] for key in watched]
            first = first or errors
            check(all(abs(a - b) < 0.1 * abs(a) + 0.02 * abs(first[0]) for a, b in zip(first, errors, strict=True)),
                  f"{name}: {errors}, on one rank {first}")

# The mean stress along a plate under its weight, which balance alone gives: what is wrong is what an early stop leaves of
# the equations, far more than the mesh makes wrong.
PLATE = """mesh: {{block: {{size: [1, 1, 0.114], divisions: [9, 9, 1]}}, refine: {refine}}}
element: {{order: 2}}
materials: [{{region: all, youngs_modulus: 1e6, poissons_ratio: 0, density: 1000}}]
constraints: [{{on: {{boundary: xmin}}, displacement: [0, 0, 0]}}]
loads: [{{gravity: [0.1, -0.2, -0.5]}}]
large_rotation: off
watch:
  along: {{stress: {{region: all}}, component: xx}}
  across: {{stress: {{region: all}}, component: xy}}
"""
for refine in 0, 1:
    done, report, _ = solve(PLATE.format(refine=refine), ranks=1, folder=folder)
    check(done.exit_code == 0 and report["solver"]["stopped"], f"{done.errors}{report['solver']}")
    for name, exact in (("along", 50), ("across", -100)):
        missing, stated = exact - report["watched"][name]["value"], report["watched"][name]["error"]
        check(abs(missing) < 1 and abs(missing) < 1.5 * abs(stated) and abs(missing - stated) < 0.8 * abs(stated),
              f"refine {refine}, {name}: {missing} missing, {stated} stated")

# Steel between rubber, pulled along and across so that it turns: the middle of the bar has next to none of the energy, by
# which Newton's method stops, and the same mean stress as the rest of it. It was 2.8 and 7.7 times too large, "+- 0.02 %".
brick_mesh(os.path.join(folder, "bar.msh"), [("bar", (0, 0, 0), (1, 1, 3), (2, 2, 6), ["rubber", "steel", "rubber 2"])])
for contrast in 1e5, 1e6:
    done, report, _ = solve(f"""mesh: {{file: bar.msh}}
element: {{order: 2}}
materials:
  - {{region: all, youngs_modulus: 1, poissons_ratio: 0.3}}
  - {{region: steel, youngs_modulus: {contrast:g}, poissons_ratio: 0.3}}
constraints: [{{on: {{boundary: bar_zmin}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{boundary: bar_zmax}}, traction: [1e-3, 0, 1e-3]}}]
large_rotation: on
solver: {{method: metric}}
watch:
  steel: {{stress: {{region: steel}}, component: zz}}
  rubber: {{stress: {{region: rubber 2}}, component: zz}}
""", ranks=1, folder=folder)
    check(done.exit_code == 0 and report["large_rotation"]["newton_iterations"], f"{done.errors}{report}")
    steel, rubber = report["watched"]["steel"]["value"], report["watched"]["rubber"]["value"]
    check(abs(steel / rubber - 1) < 0.01, f"contrast {contrast:g}: {report['watched']}")
    check(report["checks"]["force_error"] < 0.01, report["checks"])

# Extremes along material axes that have turned with the tets: their errors do not depend on how the body is divided.
TURNED = """mesh: {block: {size: [4, 1, 1], divisions: [6, 2, 2]}}
element: {order: 2}
materials:
  - region: all
    youngs_modulus: [1000, 100, 50]
    poissons_ratio: 0.3
    strengths: {tension: 30}
    axes: {rotation: {axis: [1, 1, 0], degrees: 30}}
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: zmax}, pressure: 1}]
large_rotation: on
watch:
  along: {stress: {region: all}, component: 11, take: largest}
  breaks: {load_factor: {region: all}}
"""
first = None
for ranks in 1, 3:
    done, report, _ = solve(TURNED, ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    errors = [watched["error"] for watched in report["watched"].values()]
    first = first or errors
    check(all(abs(a - b) < 0.02 * abs(a) for a, b in zip(first, errors, strict=True)),
          f"{ranks} ranks: {errors}, on one rank {first}")

# With mean dilatation the stiff mode of the error counts by its mean over each tet: by the mean of its values at the nodes, a mean
# stress that statics gives was stated ten times its size off, and a stress at a point seven times too far.
SOFT = """mesh: {block: {size: [4, 1, 1], divisions: [6, 2, 2]}}
element: {order: 2, mixed: off}
materials: [{region: all, youngs_modulus: 1200, poissons_ratio: 0.499}]
large_rotation: off
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, traction: [1, 0, 1]}]
watch: {mean: {stress: {region: all}, component: xx}, at: {stress: {at: [2, 0.4, 0.8]}, component: xx}}
"""
found, finer = (solve(SOFT, folder=folder, extra=("--set", f"mesh.refine={refine}"))[1]["watched"] for refine in (0, 1))
check(abs(found["mean"]["error"]) < 1e-6, f"a mean that statics gives: {found}")
check(0.5 < found["at"]["error"] / (finer["at"]["value"] + finer["at"]["error"] - found["at"]["value"]) < 2, f"at a point: {found}, {finer}")
