"""Load cases of every kind in one list are solved as each is alone (--case NAME), in whichever order they stand: which effects are on,
how many rotations are large and how the pressure is found follows from a load case by itself, never from the first."""
import re

from program import SANITIZED, check, new_folder, read_json, run, write

BODY = """mesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}
element: {order: 2}
MATERIAL
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
watch:
  z: {displacement: {nearest: [4, 0, 0]}, component: z}
  y: {displacement: {nearest: [4, 1, 0]}, component: y}
  energy: strain_energy
  stress: {stress: {at: [2, 0.5, 0.5]}, component: xx}
  held: {reaction: {boundary: xmin}, component: z}
  moment: {reaction: {boundary: xmax}, about: [5, 0, 0], component: y}
"""
CASES = {
    "force": "loads: [{on: {boundary: xmax}, total_force: [0, 0, -1]}]",
    "moved": "loads: [{on: {boundary: xmax}, distributing: {at: [5, 0, 0], displacement: [free, free, -0.002]}}]",
    "moved-far": "loads: [{on: {boundary: xmax}, distributing: {at: [5, 0, 0], displacement: [free, free, -2]}}]",
    "large": "loads: [{on: {boundary: xmax}, total_force: [0, 0, -5000]}]",
    "pressed": "loads: [{on: {boundary: zmax}, pressure: 1500, follows: true}]",
    "moment": "loads: [{on: {boundary: xmax}, moment: [0, 8000, 0]}]",
    "spun": "loads: [{centrifugal: {angular_velocity: 20, axis: [0, 0, 1]}}]",
    "weight": "loads: [{gravity: [0, 0, -9.81]}]",
    "point": "loads: [{on: {box: {min: [3.9, -1, 0.9], max: [4.1, 0.1, 1.1]}}, point_force: [0, 1, 0]}]",
    "drawn": "constraints: [{on: {boundary: xmax}, displacement: [0.01, free, free]}]",
    "sprung": "loads: [{on: {boundary: xmax}, total_force: [0, 0, -1]}]\n    springs: [{on: {boundary: zmin}, foundation: 1e4}]",
    "rigid": "loads: [{on: {boundary: xmax}, total_force: [0, 0, -5000]}]\n    constraints: [{on: {boundary: xmax}, rigid: {at: [4, 0.5, 0.5]}}]",
}
STEEL = "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3, density: 1}]"
OF_THE_FORM = ("force", "moved", "moved-far", "large", "pressed", "rigid")
BODIES = {
    "steel": (STEEL, tuple(CASES)),
    "rubber": (STEEL.replace("0.3", "0.499"), OF_THE_FORM),  # the mixed form
    "classical": (STEEL.replace("0.3", "0.47") + "\nformulation: classical", OF_THE_FORM),  # large rotations leave the mixed form
}


def solve(folder, *arguments):
    finished = run("solve", "case.yaml", "-q", "-o", "out.vtkhdf", "--json", "out.json", *arguments, folder=folder)
    check(finished.exit_code == 0, finished.errors)
    report = read_json(folder, "out.json")
    return report["cases"] if "cases" in report else [report]


def answer(one):
    values = {name: quantity["value"] for name, quantity in one["watched"].items()}
    return values, one["large_rotation"] and one["large_rotation"]["load_steps"]


def compare(body, names, text, alone):
    folder = new_folder()
    write(folder, "case.yaml", text + "cases:\n" + "".join(f"  - name: {name}\n    {CASES[name]}\n" for name in names))
    listed = solve(folder)
    check([one["load_case"] for one in listed] == list(names), [one["load_case"] for one in listed])
    for name, one in zip(names, listed):
        if name not in alone:
            alone[name] = answer(solve(folder, "--case", name)[0])
        (values, *how), (expected, *expected_how) = answer(one), alone[name]
        check(how == expected_how, f"{body}, {name} in {names}: {how}, alone {expected_how}")
        largest = max(map(abs, expected.values()))
        for key, value in expected.items():
            check(abs(values[key] - value) <= 1e-6 * abs(value) + 1e-9 * largest,
                  f"{body}, {name}, {key}: {values[key]} in the list {names}, {value} alone")


for body, (material, names) in list(BODIES.items())[:2 if SANITIZED else None]:
    text, alone = BODY.replace("MATERIAL", material), {}
    for order in names, names[1:2] + names[:0:-1] + names[:1]:
        compare(body, tuple(dict.fromkeys(order)), text, alone)

# `explain` says what `solve` does
folder = new_folder()
write(folder, "case.yaml", BODY.replace("MATERIAL", BODIES["rubber"][0]) + "cases:\n"
      + "".join(f"  - name: {name}\n    {text}\n" for name, text in CASES.items()))
for arguments, large in ((), "on +auto: [^;]*$"), (("--case", "moved"), "on +auto: [^;]*$"):
    finished = run("explain", "case.yaml", *arguments, folder=folder)
    check(re.search(f"large rotation +{large}", finished.output, re.M), finished.output)
    check(re.search("mixed form +on +[^;]*$", finished.output, re.M), finished.output)
