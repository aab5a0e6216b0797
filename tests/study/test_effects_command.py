# SPDX-License-Identifier: BSD-3-Clause
"""`orthostat effects`: what leaving an effect out changes, against the formulas of a bar that is pulled and hangs."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import check, new_folder, run  # noqa: E402

# A bar of length L = 4 and section 1 by 1 without lateral contraction (nu = 0). Pulled by F, its end moves by F L / E; with
# the weight w per length its support carries F + w L, and its end moves w L² / (2 E) further, half a percent, which tets of
# one cell spread unevenly over the section. Axes about a line 1e6 away are uniform to 1e-6, so one frame will do.
FORCE, WEIGHT, LENGTH, STIFF, SOFT = 2.0, 0.005, 4.0, 1000.0, 1.0
CASE = f"""title: a bar
mesh: {{block: {{size: [1, 1, {LENGTH}], divisions: [1, 1, 4]}}}}
materials:
  - {{region: all, youngs_modulus: [{SOFT}, {SOFT}, {STIFF}], poissons_ratio: 0, density: {WEIGHT},
     axes: {{cylindrical: {{origin: [-1e6, 0, 0], axis: [0, 0, 1], order: [tangential, radial, axial]}}}}}}
constraints:
  - {{on: {{boundary: zmin}}, displacement: [free, free, 0]}}
  - {{on: {{nearest: [0, 0, 0]}}, displacement: [0, 0, free]}}
  - {{on: {{nearest: [1, 0, 0]}}, displacement: [free, 0, free]}}
loads:
  - {{on: {{boundary: zmax}}, total_force: [0, 0, {FORCE}]}}
  - {{gravity: [0, 0, 1]}}
watch:
  end: {{displacement: {{nearest: [0, 0, {LENGTH}]}}, component: z}}
  support: {{reaction: {{boundary: zmin}}, component: z}}
accuracy: {{relative_error: 0.02}}
"""
folder = new_folder()
with open(os.path.join(folder, "bar.yaml"), "w", encoding="utf-8") as stream:
    stream.write(CASE)


def close(value, expected, tolerance, what):
    check(abs(value - expected) <= tolerance * abs(expected), f"{what}: {value}, expected {expected}")


def study(ranks):
    done = run("effects", "bar.yaml", "-q", "--json", "-", ranks=ranks, folder=folder)
    check(done.exit_code == 0, done.errors)
    report = json.loads(done.output)
    return report, {variant["variant"]: variant for variant in report["variants"]}


report, variants = study(1)
unevenly = 2e-3
mean = (STIFF * SOFT * SOFT) ** (1 / 3)
close(report["base"]["watch"]["support"], -FORCE - WEIGHT * LENGTH, 1e-7, "support of the whole bar")
isotropic = variants["isotropic mean for orthotropy"]
close(isotropic["change"]["watch"]["end"], STIFF / mean - 1, unevenly, "end of the isotropic bar")
close(isotropic["change"]["energy"], STIFF / mean - 1, unevenly, "energy of the isotropic bar")
check(isotropic["needed"], "orthotropy is needed")
weightless = variants["without gravity and body forces"]
close(weightless["change"]["watch"]["support"], WEIGHT * LENGTH / (FORCE + WEIGHT * LENGTH), 1e-6, "support without weight")
close(weightless["watch"]["end"], FORCE * LENGTH / STIFF, 1e-6, "end of the weightless bar")
check(not weightless["needed"], "1 % of weight is not needed for 2 %")
close(variants["without surface loads"]["watch"]["support"], -WEIGHT * LENGTH, 1e-6, "support of the bar that hangs")
frame = variants["one frame for varying axes"]
check(frame["state"] == "solved" and frame["change"]["pose"] < 1e-5 and not frame["needed"], f"one frame: {frame}")
large = variants["large rotation for linear theory"]
check(large["large_rotation"] and large["change"]["pose"] < 0.02 and not large["needed"], f"a stiff bar: {large}")
for name in ("linear theory for large rotation", "one material for several", "without mean dilatation", "without point forces"):
    check(variants[name] == {"state": "off", "effect": variants[name]["effect"], "variant": name}, f"{variants[name]}")

other = study(3)[1]
for name, variant in variants.items():
    check(variant["state"] == other[name]["state"], f"{name} on 3 ranks: {other[name]}")
    if variant["state"] == "solved" and variant is not frame:
        close(other[name]["change"]["pose"], variant["change"]["pose"], 1e-6, f"{name}: pose on 3 ranks")

# Pushed sideways it bends far: large rotation is called for.
with open(os.path.join(folder, "bent.yaml"), "w", encoding="utf-8") as stream:
    stream.write(CASE.replace(f"total_force: [0, 0, {FORCE}]", "total_force: [2, 0, 0]"))
bent = json.loads(run("effects", "bent.yaml", "-q", "--json", "-", folder=folder).output)
check(bent["base"]["large_rotation"], f"a bar bent far: {bent['base']}")
linear = next(variant for variant in bent["variants"] if variant["variant"] == "linear theory for large rotation")
check(linear["state"] == "solved" and not linear["large_rotation"] and linear["needed"] and
      linear["change"]["pose"] > 0.02, f"a bar bent far, by linear theory: {linear}")

# A block that swells freely has no energy but rounding: changes of that are no changes.
with open(os.path.join(folder, "swollen.yaml"), "w", encoding="utf-8") as stream:
    stream.write("""mesh: {block: {size: [1, 1, 1], divisions: [3, 3, 3]}}
materials: [{region: all, youngs_modulus: [1e3, 2e3, 3e3], poissons_ratio: 0.3, eigenstrain: [0.01, 0.02, 0.03]}]
constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]},
              {on: {boundary: zmin}, slide: [0, 0, 1]}]
watch: {energy: strain_energy}
large_rotation: off
""")
swollen = run("effects", "swollen.yaml", "-q", "--json", "-", folder=folder)
check(swollen.exit_code == 0, swollen.errors)
swollen = {variant["variant"]: variant for variant in json.loads(swollen.output)["variants"]}
for name in ("isotropic mean for orthotropy", "without eigenstrain"):
    change = swollen[name]["change"]
    check(change["energy"] < 1e-6 and change["watch"]["energy"] < 1e-6, f"{name} of a block that swells freely: {change}")

# Two tets, one of which swells: of one material, both do, and nothing is in the way.
with open(os.path.join(folder, "two.veg"), "w", encoding="utf-8") as stream:
    stream.write("*VERTICES\n5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n*ELEMENTS\nTET\n2 4 0\n1 1 2 3 4\n"
                 "2 2 3 4 5\n*SET SMALL\n1\n*SET LARGE\n2\n*MATERIAL STEEL\nENU, 1, 1e3, 0.3\n*REGION\nSMALL, STEEL\n"
                 "*REGION\nLARGE, STEEL\n")
with open(os.path.join(folder, "two.yaml"), "w", encoding="utf-8") as stream:
    stream.write("""mesh: {file: two.veg}
materials:
  - {region: SMALL, youngs_modulus: 2e3, poissons_ratio: 0.3}
  - {region: LARGE, youngs_modulus: 1e3, poissons_ratio: 0.3, eigenstrain: 0.01}
constraints: [{on: {vertices: [1]}, displacement: [0, 0, 0]}, {on: {vertices: [2]}, displacement: [free, 0, 0]},
              {on: {vertices: [3]}, displacement: [free, free, 0]}]
large_rotation: off
""")
two = run("effects", "two.yaml", "-q", "--json", "-", folder=folder)
check(two.exit_code == 0, two.errors)
two = {variant["variant"]: variant for variant in json.loads(two.output)["variants"]}["one material for several"]
close(two["change"]["energy"], 1.0, 1e-6, "energy of two tets that swell alike")

# What cannot be left out, or put in, is said to be not measured; a moved coupling is no moment.
LINKED = """mesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}CONSTRAINT]
loads: [{on: {boundary: zmax}, pressure: 0.001}LOAD]
large_rotation: off
"""
TURN = "{at: [4, 0.5, 0.5], rotation: [0, 1, free]}"
for constraint, load, effect, reason in (
        (f", {{on: {{boundary: xmax}}, rigid: {TURN}}}", "", "rigid face", "its motion and its loads would go with it"),
        ("", f", {{on: {{boundary: xmax}}, distributing: {TURN}}}", "moved coupling", None)):
    with open(os.path.join(folder, "linked.yaml"), "w", encoding="utf-8") as stream:
        stream.write(LINKED.replace("CONSTRAINT", constraint).replace("LOAD", load))
    linked = run("effects", "linked.yaml", "--json", "linked.json", folder=folder)
    check(linked.exit_code == 0, linked.errors)
    with open(os.path.join(folder, "linked.json"), encoding="utf-8") as stream:
        found = {variant["variant"]: variant for variant in json.load(stream)["variants"]}
    large = found["large rotation for linear theory"]
    check(large["change"]["pose"] > 0.1, f"{effect}: {linked.output}")
    check(found["without moments"]["state"] == "off", f"{effect}: {found['without moments']}")
    of_effect = next(variant for variant in found.values() if variant["effect"] == effect)
    if reason:
        check(of_effect["state"] == "not measured" and of_effect["reason"] == reason, f"{of_effect}")
    else:
        check(of_effect["needed"] and of_effect["change"]["pose"] > 0.9, f"{of_effect}")

spoken = run("effects", "bar.yaml", "--picture", "bar.png", folder=folder)
check(spoken.exit_code == 0, spoken.errors)
lines = {line.split(":")[0]: line for line in spoken.output.splitlines()}
check("orthotropy" in lines["Needed, as leaving it out changes the answer by more"], spoken.output)
check("body force" in lines["Could be left out, as it changes the answer by less"], spoken.output)
check("mean dilatation" in lines["The case does not have"], spoken.output)
with open(os.path.join(folder, "bar.png"), "rb") as stream:
    check(stream.read(4) == b"\x89PNG", "a picture was drawn")
