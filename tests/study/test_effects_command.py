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
check(0 < frame["change"]["pose"] < 1e-5 and not frame["needed"], f"one frame: {frame}")
for name in ("one material for several", "without mean dilatation", "without point forces"):
    check(variants[name] == {"state": "off", "effect": variants[name]["effect"], "variant": name}, f"{variants[name]}")

other = study(3)[1]
for name, variant in variants.items():
    check(variant["state"] == other[name]["state"], f"{name} on 3 ranks: {other[name]}")
    if variant["state"] == "solved" and variant is not frame:
        close(other[name]["change"]["pose"], variant["change"]["pose"], 1e-6, f"{name}: pose on 3 ranks")

spoken = run("effects", "bar.yaml", "--picture", "bar.png", folder=folder)
check(spoken.exit_code == 0, spoken.errors)
lines = {line.split(":")[0]: line for line in spoken.output.splitlines()}
check("orthotropy" in lines["Needed, as leaving it out changes the answer by more"], spoken.output)
check("body force" in lines["Could be left out, as it changes the answer by less"], spoken.output)
check("mean dilatation" in lines["The case does not have"], spoken.output)
with open(os.path.join(folder, "bar.png"), "rb") as stream:
    check(stream.read(4) == b"\x89PNG", "a picture was drawn")
