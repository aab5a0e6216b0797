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


def some_coarse_meshes_pass():
    finished = run("verify", "--quick", "axial-pull", "cylinder-nu-5", "given-displacement", ranks=2)
    check(finished.exit_code == 0, f"verify --quick: {finished.output[-4000:]}{finished.errors}")
    check("3 of 3 cases pass" in finished.output, finished.output)


def mistakes_fail(folder):
    """A sign, a factor, a wrong material, a wrong shear modulus, an axis that points elsewhere."""
    fails_when(folder, "cylinder-nu-3", "inner}, pressure: 1}", "inner}, pressure: -1}")
    fails_when(folder, "axial-pull", "total_force: [2,", "total_force: [2.0000001,")
    fails_when(folder, "hanging-bar", "gravity: [0, 0, -9.81]", "gravity: [0, 0, -9.80]")
    fails_when(folder, "tube-lekhnitskii", "order: [radial, tangential, axial]", "order: [tangential, radial, axial]")
    fails_when(folder, "torsion-1-5", "scale: 2e4", "scale: 1e4")
    fails_when(folder, "hanging-bar", "expected: end_displacement", "expected: 4.2")
    fails_when(folder, "given-displacement", "[0.02, free, free]", "[0.0200001, free, free]")


def settings_change_case_and_formula():
    finished = run("verify", "--quick", "axial-pull", "--set", "materials.0.E1=2000", "--json", "-")
    check(finished.exit_code == 0, finished.errors)
    elongation = json.loads(finished.output)["cases"][0]["quantities"][0]["steps"][0]["levels"][0]
    check(abs(elongation["expected"] - 0.01) < 1e-12 and abs(elongation["obtained"] - 0.01) < 1e-10, elongation)
    finished = run("verify", "--quick", "axial-pull", "--set", "verify.quantities.elongation.expected=0.011")
    check(finished.exit_code == 1 and "FAIL" in finished.output, finished.output)


def main():
    folder = new_folder()
    if SANITIZED:  # the release build's test_all.py runs all; mistakes are about numbers
        some_coarse_meshes_pass()
    else:
        mistakes_fail(folder)

    settings_change_case_and_formula()
    # What is not a case of this kind is refused.
    check(run("verify", "--quick", "no-such-case").exit_code == 2, "a case that is not there")
    check(run("verify", os.path.join(CASES, "tube", "radial.yaml")).exit_code == 2, "a case without a verify section")
    finished = run("solve", os.path.join(CASES, "verify", "strip.yaml"), folder=folder)
    check(finished.exit_code == 2 and "orthostat verify" in finished.errors, f"solve of 'exact': {finished.errors}")


main()
