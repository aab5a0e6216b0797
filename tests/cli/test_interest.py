# SPDX-License-Identifier: BSD-3-Clause
"""`accuracy: {of}`: the error of a watched quantity by its adjoint problem, against meshes of a quarter of the edge length."""
from program import check, new_folder, run, solve

CASE = """title: a clamped beam
mesh: {{refine: {refine}, block: {{size: [10, 1, 1], divisions: [10, 2, 2]}}}}
materials:
  - {{region: all, youngs_modulus: [1000, 100, 50], poissons_ratio: {nu}, shear_modulus: {{G12: 60, G23: 20, G13: 50}}}}
constraints: {supports}
loads: {loads}
large_rotation: {large}
element: {{order: {order}}}
watch:
  middle: {{displacement: {{nearest: [5, 1, 1]}}, component: x}}
  tip: {{displacement: {{nearest: [10, 0.5, 0.5]}}}}
  pull: {{reaction: {{boundary: xmin}}, component: z}}
  energy_of_strain: strain_energy
accuracy: {accuracy}
"""
HELD = "{on: {boundary: xmin}, displacement: [0, 0, 0]}"
PULLED = {"nu": 0.3, "supports": f"[{HELD}]", "loads": "[{on: {boundary: xmax}, total_force: [0, 0, 0.1]}]"}
MOVED = {"nu": 0.3, "supports": f"[{HELD}, {{on: {{boundary: xmax}}, displacement: [0.1, 0, 0.2]}}]", "loads": "[]"}
folder = new_folder()


def watched(scene, accuracy, refine=0, order=1, large="off", ranks=1):
    text = CASE.format(accuracy=accuracy, refine=refine, order=order, large=large, **scene)
    text = text.replace("refine: 0, ", "").replace("loads: []\n", "")
    done, report, _ = solve(text, ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    return report, done


two, finest = {}, {}
for scene, names in (PULLED, ("middle", "tip")), (MOVED, ("middle", "pull")):
    fine = watched(scene, "{relative_residual: 1e-9}", 2, 2)[0]["watched"]
    for order, refine in (1, 1), (2, 0):
        for name in names:
            report, done = watched(scene, f"{{of: {name}}}", refine, order, ranks=1 if order == 1 else 2)
            found = two[name] = report["watched"][name]
            finest[name] = fine[name]["value"]
            missing = finest[name] - found["value"]
            ratio = found["error"] / missing
            check(0.6 < ratio < 1.5, f"{name}, order {order}: {found['error']} estimated, {missing} missing")
            check(abs(fine[name]["value"] - found["corrected"]) < 0.4 * abs(missing), f"{name}: corrected {found}")
            check("with its error added" in done.output, done.output)

# A given load's whole reaction, -0.1, is right on every mesh, of the mixed form too: no mesh is refined for it.
for nu, order in (0.3, 1), (0.5, 2):
    report, done = watched({**PULLED, "nu": nu}, "{relative_error: 0.01, of: pull}", order=order)
    pull = report["watched"]["pull"]
    check(abs(pull["corrected"] + 0.1) < 1e-9 and pull["error"] == 0, f"a reaction without error: {pull}")
    check(len(report["adaption"]["levels"]) == 1 and report["adaption"]["met"] and "statics" in done.output, f"{report['adaption']}")

# The force of a moved coupling has an error of its own: none is known but the strain energy's, which falls with it.
coupled = {"nu": 0.3, "supports": f"[{HELD}]",
           "loads": "[{on: {boundary: xmax}, distributing: {at: [11, 0.5, 0.5], displacement: [free, free, 0.2]}}]"}
fine = watched(coupled, "{relative_residual: 1e-9}", 1, 2)[0]["watched"]["energy_of_strain"]["value"]
found = watched(coupled, "{of: energy}", order=2)[0]["watched"]
check(found["tip"]["error"] is None and "moved coupling" in found["tip"]["error_not_known"], f"{found['tip']}")
energy = found["energy_of_strain"]
check(0.6 < energy["error"] / (fine - energy["value"]) < 1.5 and energy["error"] < 0, f"{energy}, exact {fine}")

# The same on several ranks.
one = watched(MOVED, "{of: pull}", order=2)[0]["watched"]["pull"]["error"]
check(abs(two["pull"]["error"] / one - 1) < 0.1, f"1 rank: {one}, 2 ranks: {two['pull']}")

# Large rotations: the beam's own adjoint about the bent shape.
bent = {**PULLED, "loads": "[{on: {boundary: xmax}, total_force: [0, 0, 1]}]"}
fine = watched(bent, "{relative_residual: 1e-9}", 1, 2, "on")[0]["watched"]["tip"]["value"]
found = watched(bent, "{of: tip}", 0, 2, "on")[0]["watched"]["tip"]
check(0.5 < found["error"] / (fine - found["value"]) < 1.6, f"large rotation: {found}, exact {fine}")

# The mixed form: the adjoint problem has a pressure too. Half the edge length is off by a quarter as much, with its error added by less.
for scene, name, large in (PULLED, "tip", "off"), (MOVED, "pull", "off"), (bent, "tip", "on"):
    incompressible = {**scene, "nu": 0.5}
    fine = watched(incompressible, f"{{of: {name}}}", 1, 2, large)[0]["watched"][name]["corrected"]
    found = watched(incompressible, f"{{of: {name}}}", 0, 2, large, ranks=2)[0]["watched"][name]
    check(0.6 < found["error"] / (fine - found["value"]) < 1.5, f"nu 1/2, {name}, large rotation {large}: {found}, exact {fine}")

# Asked for: the quantity is as accurate as that.
report, done = watched(PULLED, "{relative_error: 0.001, of: tip}", order=2, ranks=2)
adaption = report["adaption"]
check(adaption["met"] and adaption["of"] == "tip" and "of tip" in done.output, f"met: {adaption}")
check(abs(report["watched"]["tip"]["value"] / finest["tip"] - 1) < 0.001, f"{report['watched']['tip']}, exact {finest}")
check(len(adaption["levels"]) > 1, f"the first mesh is too coarse: {adaption}")

# Reactions that are watched, by default: the solve stops early, and both errors of the adjoint problem count as a product.
REACTIONS = """title: a beam whose end is moved
mesh: {block: {size: [10, 1, 1], divisions: [20, 4, 4]}}
materials: [{region: all, youngs_modulus: MODULI, poissons_ratio: RATIO}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, displacement: [0.1, 0, 0.2]}]
large_rotation: off
solver: {method: metric}
watch:
  pull: {reaction: {boundary: xmin}, component: x}
  shear: {reaction: {boundary: xmax}, component: z}
  moment: {reaction: {boundary: xmin}, about: [0, 0.5, 0.5], component: y}
"""
TIGHT = ("--set", "accuracy.relative_residual=1e-10", "--set", "output.fields=[displacement]")


def beam(moduli, ratio, order, *extra, ranks=1, text=REACTIONS):
    text = text.replace("MODULI", moduli).replace("RATIO", ratio)
    done, report, _ = solve(text, ranks=ranks, folder=folder, extra=("--set", f"element.order={order}", *extra))
    check(done.exit_code == 0, done.errors)
    return report


def values(report):
    return {name: found["value"] for name, found in report["watched"].items()}


for moduli, ratio, least, most in ("1000", "0.3", 0.7, 1.5), ("[50000, 50, 50]", "0.3", 0.7, 1.5):
    # Edges of supports: the error falls by the same factor on each mesh, so three tell where it ends.
    coarse = values(beam(moduli, ratio, 2, "--set", "mesh.block.divisions=[10, 2, 2]", *TIGHT))
    middle = values(beam(moduli, ratio, 2, *TIGHT))
    fine = values(beam(moduli, ratio, 2, "--set", "mesh.refine=1", *TIGHT))
    for name, value in fine.items():
        left = (value - middle[name]) / (middle[name] - coarse[name])
        check(0 < left < 0.6, f"{moduli}, {name}: {coarse[name]}, {middle[name]}, {value}")
        fine[name] += (value - middle[name]) * left / (1 - left)
    for order in 1, 2:
        exact = middle if order == 2 else values(beam(moduli, ratio, order, *TIGHT))
        by_ranks = []
        for ranks in (1, 2) if order == 2 else (1,):
            report = beam(moduli, ratio, order, ranks=ranks)
            by_ranks.append(values(report))
            check(report["solver"]["stopped"] and report["solver"]["iterations"] <= 8, f"{moduli}: {report['solver']}")
            for name, found in report["watched"].items():
                check(abs(found["value"] / exact[name] - 1) < 2e-5, f"{moduli}, {name}: {found}, solved to the end {exact[name]}")
                effect = found["error"] / (fine[name] - exact[name])
                check(least < effect < most, f"{moduli}, {name}, order {order}: {found}, missing {fine[name] - exact[name]}")
        for name, value in by_ranks[0].items():
            check(all(abs(other[name] / value - 1) < 2e-5 for other in by_ranks), f"{moduli}, {name}: {by_ranks}")

# A bar whose end is moved, and statics: formulas. Rigid-body motions of the moved end leave a beam's 12 E I w / L^3.
bar = REACTIONS.replace("xmin}, displacement: [0, 0, 0]", "xmin}, displacement: [0, free, free]").replace("[0.1, 0, 0.2]}", "[0.1, free, free]}")
bar = bar.replace("constraints: [", "constraints: [{on: {vertices: [1]}, displacement: [0, 0, 0]}, "
                  "{on: {boundary: ymin}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}, ")
report = beam("1000", "0.3", 1, text=bar)
check(abs(report["watched"]["pull"]["value"] + 10) < 1e-6 and abs(report["watched"]["pull"]["error"]) < 1e-6, f"{report['watched']}")
report = beam("1000", "0", 2)
shear = 12 * 1000 / 12 / 100 / (5 / 6 * 500)  # of Timoshenko's beam, beside its bending
check(abs(report["watched"]["shear"]["value"] / (12 * 1000 / 12 * 0.2 / 1000 / (1 + shear)) - 1) < 0.01, f"{report['watched']}")

# A moment that statics gives is not exact on a mesh too stiff to tell that large rotations are called for: -75.81 with them.
done, report, _ = solve("""mesh: {block: {size: [10, 1, 1], divisions: [10, 1, 1]}}
materials: [{region: all, youngs_modulus: 1e4, poissons_ratio: 0.3}]
accuracy: {relative_error: 0.05, of: M}
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, -8]}]
watch: {M: {reaction: {boundary: xmin}, about: [0, 0.5, 0.5], component: y}}
""", folder=folder)
check(done.exit_code == 0, done.errors)
moment, levels = report["watched"]["M"]["value"], report["adaption"]["levels"]
check(abs(moment / -75.81 - 1) < 0.01 and report["large_rotation"]["newton"], f"{moment}: {report['large_rotation']}")
check(len(levels) == 2 and levels[0]["relative_error"] > 0.5 and levels[1]["relative_error"] < 0.04, f"{levels}")

# Load cases on the same supports have one adjoint problem for each reaction; answers are as those of a case alone.
LIGHT, HEAVY = "loads: [{body_force: [0, 0, -1]}]", "loads: [{body_force: [1, 0, -5]}]"
both = beam("1000", "0.3", 2, text=REACTIONS + f"cases:\n- {{name: light, {LIGHT}}}\n- {{name: heavy, {HEAVY}}}\n")["cases"]
for one, load in zip(both, (LIGHT, HEAVY), strict=True):
    alone = beam("1000", "0.3", 2, text=REACTIONS + load + "\n")["watched"]
    for name, found in one["watched"].items():
        check(one["solver"]["stopped"] and abs(found["value"] / alone[name]["value"] - 1) < 1e-4 and
              abs(found["error"] - alone[name]["error"]) < 0.1 * abs(alone[name]["error"]), f"{one['load_case']}, {name}: {found}, alone {alone[name]}")

# A reaction that is zero by symmetry, and not by statics, is compared with a hundredth of its nodes' forces: relative to itself
# it was 100 % off on any mesh.
done, report, _ = solve("""mesh: {block: {size: [4, 1, 1], divisions: [8, 2, 2]}}
materials: [{region: all, youngs_modulus: 1e5, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}, {on: {boundary: xmax}, displacement: [0.01, 0, 0]}]
large_rotation: off
watch: {side: {reaction: {boundary: xmin}, component: z}}
accuracy: {relative_error: 0.05, of: side}
""", folder=folder)
check(done.exit_code == 0 and report["unknowns"] < 5000 and abs(report["watched"]["side"]["value"]) < 0.1, f"{report['watched']}")

# Nor that of a reaction where a pressure follows a free rim.
text = CASE.format(accuracy="{relative_error: 0.1, of: pull}", refine=1, order=1, large="on", **PULLED)
done, _, _ = solve(text.replace("xmax}, total_force: [0, 0, 0.1]", "zmax}, pressure: 0.01, follows: true"), folder=folder)
check(done.exit_code == 1 and "cannot be estimated" in done.errors and "not known: a pressure that follows a free rim makes its" in done.output, done.errors)

for wrong, said, scene in (("{of: nobody}", "not watched", PULLED), ("{of: [tip]}", "expected a text", PULLED),
                           ("{of: pull}", "the error of 'pull' is not known", coupled)):
    with open(f"{folder}/wrong.yaml", "w", encoding="utf-8") as stream:
        stream.write(CASE.format(accuracy=wrong, refine=1, order=1, large="off", **scene))
    done = run("solve", "wrong.yaml", folder=folder)
    check(done.exit_code == 2 and said in done.errors, f"{wrong}: {done.errors}")
