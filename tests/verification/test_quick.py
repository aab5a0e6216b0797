"""Answers compared with closed-form solutions, on coarse meshes; and mistakes that verification is there to catch."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SANITIZED, SOURCE, check, new_folder, run  # noqa: E402

CASES = os.path.join(SOURCE, "cases")
os.environ["ORTHOSTAT_CASES"] = CASES


def read(name):
    with open(os.path.join(CASES, "verify", name + ".yaml")) as stream:
        return stream.read()


def fails_when(folder, name, old, new):
    """The case passes as it stands, and fails with `new` for `old`."""
    text = read(name)
    check(old in text, f"{name} has no '{old}'")
    path = os.path.join(folder, "changed.yaml")
    with open(path, "w") as stream:
        stream.write(text.replace(old, new))
    finished = run("verify", "--quick", path)
    check(finished.exit_code == 1, f"{name} with '{new}' for '{old}': exit {finished.exit_code}\n{finished.output}")
    check("FAIL" in finished.output, f"{name}: no quantity is said to fail\n{finished.output}")


def main():
    folder = new_folder()
    report = os.path.join(folder, "verify.json")
    finished = run("verify", "--quick", "--json", report, ranks=2)
    check(finished.exit_code == 0, f"verify --quick: {finished.output[-4000:]}{finished.errors}")
    with open(report) as stream:
        cases = json.load(stream)["cases"]
    check(len(cases) == len([f for f in os.listdir(os.path.join(CASES, "verify")) if f.endswith(".yaml")]),
          f"{len(cases)} cases were run")
    for case in cases:
        check(case["passed"] and case["quantities"] and case["runs"], f"{case['name']} is not whole")
        for one in case["runs"]:
            check(max(one["force_imbalance"], one["moment_imbalance"]) <= 1e-10, f"{case['name']} is out of balance")
            check(one["energy_imbalance"] <= 1e-9, f"{case['name']}: energy is not work")

    if SANITIZED:  # the rest is about numbers
        return
    # A sign, a factor, a wrong material, a wrong shear modulus, an axis that points elsewhere.
    fails_when(folder, "tube-lekhnitskii", "pressure: 1}\naccuracy", "pressure: -1}\naccuracy")
    fails_when(folder, "axial-pull", "total_force: [2,", "total_force: [2.0000001,")
    fails_when(folder, "hanging-bar", "gravity: [0, 0, -9.81]", "gravity: [0, 0, -9.80]")
    fails_when(folder, "tube-lekhnitskii", "order: [radial, tangential, axial]", "order: [tangential, radial, axial]")
    fails_when(folder, "torsion-1-5", "scale: 2e4", "scale: 1e4")
    fails_when(folder, "cantilever-shear-20", "expected: tip_deflection", "expected: 4.2")
    fails_when(folder, "given-displacement", "[0.02, free, free]", "[0.0200001, free, free]")

    # What is not a case of this kind is refused.
    check(run("verify", "--quick", "no-such-case").exit_code == 2, "a case that is not there")
    check(run("verify", os.path.join(CASES, "tube", "radial.yaml")).exit_code == 2, "a case without a verify section")
    finished = run("solve", os.path.join(CASES, "verify", "strip.yaml"), folder=folder)
    check(finished.exit_code == 2 and "orthostat verify" in finished.errors, f"solve of 'exact': {finished.errors}")


main()
