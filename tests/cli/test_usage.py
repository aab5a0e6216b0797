"""The command line: help, versions, mistakes, quiet runs, JSON, and the default place of the output."""
import json
import os
import tempfile

from program import check, run

CASE = """title: a bar pulled along
mesh:
  block: {size: [2, 1, 1], divisions: [4, 2, 2]}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0}
constraints:
  - {on: {boundary: xmin}, slide: [1, 0, 0]}
  - {on: {vertices: [1]}, displacement: [0, 0, 0]}
  - {on: {nearest: [0, 1, 0]}, displacement: [0, free, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [10, 0, 0]}
"""


def what_does_not_fit_is_said(folder):
    """A body of 2e9 tets is foreseen without being made; the bar fits."""
    with open(os.path.join(folder, "huge.yaml"), "w") as stream:
        stream.write(CASE.replace("[4, 2, 2]", "[700, 700, 700]"))
    for case, fits in (("bar.yaml", True), ("huge.yaml", False)):
        foreseen = run("explain", case, folder=folder)
        check(foreseen.exit_code == 0, foreseen.errors)
        check(("does not fit" in foreseen.output) != fits, f"{case}: {foreseen.output}")
        size = json.loads(run("explain", case, "--json", folder=folder).output)["bytes"]
        check((size["in_all"] <= size["free"]) == fits, f"{case}: {size}")


def main():
    folder = tempfile.mkdtemp(prefix="orthostat-")
    with open(os.path.join(folder, "bar.yaml"), "w") as stream:
        stream.write(CASE)
    what_does_not_fit_is_said(folder)

    helped = run("--help")
    check(helped.exit_code == 0 and "solve" in helped.output and not helped.errors, "orthostat --help")
    helped_text = helped.output
    helped = run("solve", "--help", ranks=2)
    check(helped.exit_code == 0 and helped.output.count("Usage:") == 1, f"solve --help: {helped.output}{helped.errors}")
    check(run("--version").output.startswith("orthostat "), "--version")
    check(run().exit_code == 2, "no command")
    for words, stream in (((), "errors"), (("--help",), "output"), (("sovle",), "errors")):
        said = run(*words, ranks=2)
        check(getattr(said, stream).count("Usage:") == 1, f"{words} on 2 ranks, not said once: {said.output}{said.errors}")
    check(run("--version", ranks=2).output.count("orthostat") == 1, "--version on 2 ranks")
    wrong = run("sovle", "bar.yaml", folder=folder)
    check(wrong.exit_code == 2 and "sovle" in wrong.errors, "an unknown command")
    wrong = run("solve", "bar.yaml", "--ouput", "x", ranks=2, folder=folder)
    check(wrong.exit_code == 2 and wrong.errors.count("ouput") == 1, f"an unknown option: {wrong.errors}")
    check(run("solve").exit_code == 2, "no case")
    check(run("solve", "bar.yaml", "bar.yaml", folder=folder).exit_code == 2, "two cases")

    quiet = run("solve", "-q", "bar.yaml", folder=folder)
    check(quiet.exit_code == 0 and not quiet.output and not quiet.errors, f"-q: {quiet.output}{quiet.errors}")
    check(os.path.exists(os.path.join(folder, "bar.vtkhdf")), "no output key: the case's name with .vtkhdf")

    quiet = run("-q", "solve", "bar.yaml", folder=folder, ranks=2)
    check(quiet.exit_code == 0 and not quiet.output and not quiet.errors, f"-q first: {quiet.output}{quiet.errors}")
    spoken = run("-q", "--verbose", "solve", "bar.yaml", folder=folder)
    check(spoken.exit_code == 0 and "vertices" in spoken.output, f"the last word counts: {spoken.output}{spoken.errors}")
    check(run("-v").exit_code == 2, "-v and no command")
    check(run("-q", "--help").output == helped_text, "-q --help")

    spoken = run("solve", "bar.yaml", "--json", "-", folder=folder)
    report = json.loads(spoken.output)
    # u = F L / (E A) = 10 * 2 / 1000, energy = F u / 2
    check(abs(report["largest_displacement"] - 0.02) < 1e-9, f"|u| = {report['largest_displacement']}, F L / E A = 0.02")
    check(abs(report["checks"]["strain_energy"] - 0.1) < 1e-9, "energy")
    check(abs(report["checks"]["reaction"][0] + 10) < 1e-6, "reaction")
    accounts = {a["name"]: a for a in report["ledger"]["accounts"]}
    for name in ("orthotropy", "varying axes", "gradient axes", "body force", "given displacement"):
        check(accounts[name]["entries"] == 0 and accounts[name]["bytes"] == 0, f"{name} is off but was called")
    for name in ("sliding support", "surface load"):
        check(accounts[name]["entries"] > 0, f"{name} is on but was not called")
    on = {e["effect"]: e["on"] for e in report["effects"]}
    check(on["surface load"] and on["sliding support"] and not on["orthotropy"], f"plan: {on}")

    lost = run("solve", "bar.yaml", "--output", "nowhere/result.vtkhdf", folder=folder)
    check(lost.exit_code == 2 and "nowhere" in lost.errors, f"an output folder that is not there: {lost.errors}")
    full = run("solve", "bar.yaml", "--json", "/dev/full/x", folder=folder)
    check(full.exit_code == 2, "an impossible JSON path")


main()
