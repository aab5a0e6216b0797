"""The command line: help, versions, mistakes, quiet runs, JSON, and the default place of the output."""
import json
import os
import subprocess

from program import PROGRAM, check, new_folder, run, write

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


def a_full_standard_output_is_no_success(folder):
    for words in (["check", "bar.yaml", "--json"], ["check", "bar.yaml"], ["explain", "bar.yaml"], ["--version"],
                  ["material", "--youngs", "1", "--nu", "0.3", "--json"], ["solve", "bar.yaml", "--json", "-"]):
        with open("/dev/full", "w") as full:
            process = subprocess.run([PROGRAM, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=full,
                                     stderr=subprocess.PIPE, text=True, timeout=240)
        check(process.returncode == 2 and "standard output could not be written: No space left" in process.stderr,
              f"{words} > /dev/full: exit {process.returncode}, {process.stderr}")


def numbers_out_of_range_are_refused(folder):
    """Also where they would not be used: nobody learns of them otherwise."""
    wrong = {"solve": ("--max-time=-3", "--max-time=0", "--max-time=nan", "--max-memory=0", "--max-memory=-1"),
             "cost": ("--max-time=-3", "--orders=0", "--refinements=-1", "--tolerances=0", "--accuracies=-1", "--load-steps=0"),
             "scale": ("--max-time=0", "--ranks=0", "--ranks=-2", "--sizes=-5", "--network=latency=-1")}
    for command, options in wrong.items():
        for option in options:
            refused = run(command, "bar.yaml", option, folder=folder)
            name, value = option.split("=")[0], option.split("=")[-1]
            said = " ".join(refused.errors.split())
            check(refused.exit_code == 2 and not refused.output and value in said, f"{command} {option}: {said}")
            check(name in said or f"not {value}" in said, f"{command} {option}: {said}")


def one_process_needs_nobody(folder):
    """Open MPI names the interfaces it finds, where it looks for any; a user's own choice of transports stands. No folder of Open
    MPI's is made, which processes that run at the same time would share."""
    for chosen, looks in (None, False), ("self,tcp", True):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
        environment |= {"OMPI_MCA_btl_base_verbose": "20"} | ({"OMPI_MCA_btl": chosen} if chosen else {})
        environment["OMPI_MCA_orte_tmpdir_base"] = os.path.join(folder, "session")
        process = subprocess.run([PROGRAM, "solve", "-q", "bar.yaml"], cwd=folder, stdin=subprocess.DEVNULL, env=environment,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=240)
        check(process.returncode == 0 and ("btl: tcp: " in process.stderr) == looks, f"{chosen}: {process.stderr}")
        check(not os.path.exists(os.path.join(folder, "session")), f"{chosen}: Open MPI has made its folder")


def the_program_starts_once(folder):
    """Its libraries take a third of a small run to load. The linker says so each time, by LD_DEBUG of the GNU C library."""
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    process = subprocess.run([PROGRAM, "--version"], cwd=folder, env=environment | {"LD_DEBUG": "statistics"},
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=240)
    starts = process.stderr.count("startup time in dynamic loader")
    check(process.returncode == 0 and starts == 1, f"--version: exit {process.returncode}, {starts} starts")


def a_case_comes_from_standard_input(folder):
    process = subprocess.run([PROGRAM, "check", "-", "--json"], cwd=folder, input=CASE, stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True, timeout=240)
    check(process.returncode == 0 and json.loads(process.stdout)["loads"] == 1, f"check -: {process}")


def impossible_sizes_are_told_by_their_limit(folder):
    """2^31 - 1 unknowns are 715,827,882 nodes, which no ranks help beyond; the nonzeros of a rank they do help."""
    for divisions, refine in (([100000, 100000, 100000], 0), ([1000000, 1000000, 1000000], 8), ([894, 894, 894], 0)):
        write(folder, "huge.yaml", CASE.replace("[4, 2, 2]}", f"{divisions}}}\n  refine: {refine}"))
        for command in "explain", "check", "solve":
            refused = run(command, "huge.yaml", folder=folder)
            check(refused.exit_code == 2 and "2^31 - 1 over all ranks, which is 715827882 nodes: use a coarser mesh"
                  in refused.errors and not refused.output, f"{command} {divisions}: {refused.output}{refused.errors}")
    write(folder, "large.yaml", CASE.replace("[4, 2, 2]", "[890, 890, 890]"))
    told = run("explain", "large.yaml", folder=folder)
    # Kuhn's six tets a cell: 15 blocks a vertex, each of 9 nonzeros
    least = 891 ** 3 * 15 * 9 / (2 ** 31 - 1)
    check(told.exit_code == 0 and "at least: a rank can hold 2^31 - 1 nonzeros" in told.output, f"{told.output}{told.errors}")
    ranks = json.loads(run("explain", "large.yaml", "--json", folder=folder).output)["ranks_at_least"]
    check(abs(ranks - least) <= 1 + 0.01 * least, f"at least {ranks} ranks, {least} by hand")
    check("ranks  " not in run("explain", "bar.yaml", folder=folder).output, "one rank will do, and nothing is said")


def explain_says_where_each_modulus_goes(folder):
    """Axes with the fibre along e1, but a material whose axis is e3: nothing else would show it."""
    write(folder, "fibre.yaml", CASE.replace("youngs_modulus: 1000", "axes: {fixed: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]}, "
                              "youngs_modulus: {plane: 1, axis: 88}"))
    words = "E = 88 along e3 (the axis), 1 along e1 and e2"
    axes = "e1 = (0, 1, 0), e2 = (-1, 0, 0), e3 = (0, 0, 1)"
    told = run("explain", "fibre.yaml", folder=folder)
    check(words in told.output and axes in told.output, f"explain: {told.output}{told.errors}")
    told = json.loads(run("explain", "fibre.yaml", "--json", folder=folder).output)
    check(told["materials"] == [{"region": "all", "moduli": words, "axes": axes}], f"explain --json: {told}")


def what_does_not_fit_is_said(folder):
    """A body of 2e9 tets is foreseen without being made; the bar fits."""
    write(folder, "huge.yaml", CASE.replace("[4, 2, 2]", "[700, 700, 700]"))
    for case, fits in (("bar.yaml", True), ("huge.yaml", False)):
        foreseen = run("explain", case, folder=folder)
        check(foreseen.exit_code == 0, foreseen.errors)
        check(("does not fit" in foreseen.output) != fits, f"{case}: {foreseen.output}")
        size = json.loads(run("explain", case, "--json", folder=folder).output)["bytes"]
        check((size["in_all"] <= size["free"]) == fits, f"{case}: {size}")
    refused = run("solve", "huge.yaml", folder=folder)
    check(refused.exit_code == 2 and "GiB are free; use a coarser mesh" in refused.errors, refused.errors)


def main():
    folder = new_folder()
    write(folder, "bar.yaml", CASE)
    what_does_not_fit_is_said(folder)
    explain_says_where_each_modulus_goes(folder)

    helped = run("--help")
    check(helped.exit_code == 0 and "solve" in helped.output and not helped.errors, "orthostat --help")
    helped_text = helped.output
    helped = run("solve", "--help", ranks=2)
    check(helped.exit_code == 0 and helped.output.count("Usage:") == 1, f"solve --help: {helped.output}{helped.errors}")
    check(run("--version").output.startswith("orthostat "), "--version")
    check(run().exit_code == 2, "no command")
    for words, stream, exit_code, told in (((), "errors", 2, "Usage:"), (("--help",), "output", 0, "Usage:"),
                                           (("sovle",), "errors", 2, "did you mean 'solve'?")):
        said = run(*words, ranks=2)
        check(said.exit_code == exit_code, f"{words} on 2 ranks: exit {said.exit_code}")
        check(getattr(said, stream).count(told) == 1, f"{words} on 2 ranks, not said once: {said.output}{said.errors}")
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
    for told in ("mesh: 45 vertices", "solver: direct first: ", "solver: direct: set up (", "iterations in "):
        check(told in spoken.errors, f"-v does not tell '{told}': {spoken.errors}")
    check(not run("solve", "bar.yaml", folder=folder).errors, "without -v it is not told")
    steel = ("material", "--youngs", "1", "--nu", "0.3")
    for words in (("explain", "bar.yaml"), ("check", "bar.yaml"), steel):
        quiet = run(*words, "-q", folder=folder)
        check(quiet.exit_code == 0 and not quiet.output and not quiet.errors, f"{words} -q: {quiet.output}{quiet.errors}")
        json.loads(run(*words, "-q", "--json", folder=folder).output)
    quiet = run("material", "-q", "--youngs", "1", "--nu", "0.6")
    check(quiet.exit_code == 2 and not quiet.output and "orthostat: error: " in quiet.errors, f"{quiet.errors}")
    check(run("-v").exit_code == 2, "-v and no command")
    check(run("-q", "--help").output == helped_text, "-q --help")

    spoken = run("solve", "bar.yaml", "--json", "-", folder=folder)
    report = json.loads(spoken.output)
    # u = F L / (E A) = 10 * 2 / 1000, energy = F u / 2
    check(abs(report["largest_displacement"] - 0.02) < 1e-9, f"|u| = {report['largest_displacement']}, F L / E A = 0.02")
    check(abs(report["checks"]["strain_energy"] - 0.1) < 1e-9, "energy")
    check(abs(report["checks"]["reaction"][0] + 10) < 1e-6, "reaction")
    check(report["solver"]["method"] == "direct" and report["solver"]["attainable_residual"] is None,
          f"nobody asked what double precision can hold: {report['solver']}")
    accounts = {a["name"]: a for a in report["ledger"]["accounts"]}
    for name in ("orthotropy", "varying axes", "gradient axes", "body force", "prescribed displacement"):
        check(accounts[name]["entries"] == 0 and accounts[name]["bytes"] == 0, f"{name} is off but was called")
    for name in ("sliding support", "surface load"):
        check(accounts[name]["entries"] > 0, f"{name} is on but was not called")
    on = {e["effect"]: e["on"] for e in report["effects"]}
    check(on["surface load"] and on["sliding support"] and not on["orthotropy"], f"plan: {on}")

    lost = run("solve", "bar.yaml", "--output", "nowhere/result.vtkhdf", folder=folder)
    check(lost.exit_code == 2 and "nowhere" in lost.errors, f"an output folder that is not there: {lost.errors}")
    full = run("solve", "bar.yaml", "--json", "/dev/full/x", folder=folder)
    check(full.exit_code == 2, "an impossible JSON path")
    a_full_standard_output_is_no_success(folder)
    impossible_sizes_are_told_by_their_limit(folder)
    a_case_comes_from_standard_input(folder)
    one_process_needs_nobody(folder)
    the_program_starts_once(folder)
    numbers_out_of_range_are_refused(folder)


main()
