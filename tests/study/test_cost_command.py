# SPDX-License-Identifier: BSD-3-Clause
"""`orthostat cost` as a user calls it: the list, its files and its picture."""
import csv
import io
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["ORTHOSTAT_PROGRAM"]
MPIEXEC = os.environ["ORTHOSTAT_MPIEXEC"]
SOURCE = os.environ["ORTHOSTAT_SOURCE"]
CASE = """title: a cantilever
mesh: {block: {size: [4, 1, 1], divisions: [4, 1, 1]}}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, -1]}]
watch:
  tip: {displacement: {nearest: [4, 1, 0]}, component: z}
"""
LADDER = ["--tolerances", "1e-2,1e-8"]
SHORT = ["--tolerances", "1e-8", "--orders", "1", "--refinements", "0,1", "--accuracies", "-"]


def run(*arguments, ranks=1, folder=None):
    command = [PROGRAM, "cost", *arguments]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=100, stdin=subprocess.DEVNULL)


class Cost(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orthostat-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        with open(self.path("beam.yaml"), "w") as stream:
            stream.write(CASE)

    def path(self, name):
        return os.path.join(self.folder, name)

    def cost(self, *arguments, ranks=1):
        finished = run("beam.yaml", *arguments, ranks=ranks, folder=self.folder)
        self.assertEqual(finished.returncode, 0, finished)
        return finished

    def refuse(self, text, *arguments):
        finished = run(*arguments, folder=self.folder)
        self.assertEqual(finished.returncode, 2, finished)
        self.assertIn(text, finished.stderr)

    def test_a_moment_that_is_zero_is_known(self):
        """Up to rounding, which is no error to be given in percent of rounding."""
        with open(self.path("moved.yaml"), "w") as stream:
            stream.write(CASE.replace("total_force: [0, 0, -1]", "distributing: {at: [5, 0, 0], displacement: [free, free, -0.1]}")
                         + "  free: {reaction: {boundary: xmax}, about: [5, 0, 0], component: y}\n")
        process = run("moved.yaml", *SHORT, folder=self.folder)
        self.assertEqual(process.returncode, 0, process.stderr)
        found = re.search(r"free .*good to ([^ ]*) %; that is negligible beside ([^ ]*), to which", process.stdout)
        self.assertTrue(found, process.stdout)
        self.assertLess(float(found[1]), 1e-4)
        self.assertGreater(float(found[2]), 1e-3)

    def test_large_rotations_are_priced(self):
        with open(self.path("bent.yaml"), "w") as stream:
            stream.write(CASE.replace("-1]", "-10]"))
        options = ["--orders", "2", "--refinements", "0", "--tolerances", "1e-6", "--accuracies", "-"]
        finished = run("bent.yaml", *options, "--load-steps", "5", "--csv", "p.csv", "--json", "p.json", folder=self.folder)
        self.assertEqual(finished.returncode, 0, finished)
        self.assertIn("at least 5 load steps: ", finished.stdout)
        with open(self.path("p.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([row["formulation"] for row in rows], ["consistent", "linear", "classical", "consistent"])
        self.assertEqual([row["least_load_steps"] for row in rows], ["", "", "", "5"])
        self.assertGreaterEqual(int(rows[3]["load_steps"]), 5)
        self.assertLess(int(rows[0]["load_steps"]), 5)
        tips = [float(row["tip"]) for row in rows]
        self.assertGreater(abs(tips[1]), 1.1 * abs(tips[0]))  # linear theory bends too far
        self.assertAlmostEqual(tips[3] / tips[0], 1.0, delta=1e-5)  # the state at rest does not depend on the way
        with open(self.path("p.json")) as stream:
            runs = json.load(stream)["runs"]
        self.assertEqual([one["more"] for one in runs],
                         ["", "linear theory", "classical formulation", "at least 5 load steps"])
        self.refuse("--formulations takes linear, consistent and classical", "bent.yaml", "--formulations", "cubic")

    def test_everything_is_in_the_files(self):
        finished = self.cost(*LADDER, "--csv", "p.csv", "--json", "p.json", ranks=2)
        self.assertEqual(finished.stdout.count("cheapest for an error of"), 1)
        with open(self.path("p.json")) as stream:
            study = json.load(stream)
        with open(self.path("p.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(study["ranks"], 2)
        self.assertEqual(len(rows), 14)
        self.assertEqual(len(study["runs"]), 14)
        # Order 2 of one mesh against order 1 of its refinement, which has the same nodes.
        error = {(one["order"], one["refinement"]): one["answers"]["tip"]["error"] for one in study["runs"]
                 if not one["accuracy"]}
        for r in (0, 1):
            self.assertLess(error[2, r], 0.3 * error[1, r + 1])
        for row, one in zip(rows, study["runs"]):
            self.assertEqual(one["state"], "done", one)
            self.assertEqual(int(row["unknowns"]), one["unknowns"])
            self.assertEqual(float(row["seconds"]), one["seconds"])
            self.assertEqual(float(row["tip"]), one["answers"]["tip"]["value"])
            self.assertEqual(float(row["tip error"]), one["answers"]["tip"]["error"])
            self.assertEqual(float(row["setup_seconds"]), one["phase_seconds"]["setup"])
        for row, one in zip(rows, study["runs"]):
            if one["true_norm"] is not None:  # the estimate beside it, in the norm of the energy
                self.assertTrue(0.7 < one["estimate"] / one["true_norm"] < 1.5, one)
                self.assertEqual(float(row["estimate"]), one["estimate"])
        adaptive = study["runs"][-2:]
        self.assertEqual([one["accuracy"] for one in adaptive], [0.1, 0.03])
        for one in adaptive:
            self.assertLessEqual(one["estimate"], one["accuracy"])
            self.assertGreater(one["levels"], 1)
            self.assertTrue(one["repeats"] > 1 or one["seconds"] > 0.4, one)  # as short runs by hand are
            if one["by_hand"] is not None:
                self.assertLessEqual(study["runs"][one["by_hand"]]["true_norm"], one["accuracy"])
        for order, ahead in zip((1, 2), study["quantities"][1]["next"]):
            fine, coarse = error[order, 2 if order == 1 else 1], error[order, 1 if order == 1 else 0]
            self.assertEqual(ahead["order"], order)
            self.assertEqual(ahead["refinement"], 3)
            self.assertLess(ahead["error"], error[order, 2])
            if order == 1:
                self.assertAlmostEqual(ahead["error"], fine * fine / coarse, delta=1e-12)
        sizes = {(one["order"], one["refinement"]): one["tets"] for one in study["runs"]}
        self.assertEqual(sizes[1, 1], 8 * sizes[1, 0])
        self.assertEqual(sizes[2, 2], 64 * sizes[1, 0])
        self.assertEqual([entry["name"] for entry in study["quantities"]], ["energy", "tip"])
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".orthostat-")])

    def test_what_equations_leave_is_in_the_estimate(self):
        with open(self.path("moved.yaml"), "w") as stream:
            stream.write("""title: a bar whose end is moved, far stiffer across
mesh: {block: {size: [6, 1, 1], divisions: [12, 4, 4]}}
element: {order: 2}
materials: [{region: all, youngs_modulus: [1e6, 1e9, 1e9], poissons_ratio: 0.4}]
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
  - {on: {boundary: xmax}, displacement: [0.01, 0, 0]}
large_rotation: off
""")
        finished = run("moved.yaml", "--orders", "2", "--refinements", "0", "--tolerances", "0.03,1e-9",
                       "--accuracies", "-", "--json", "p.json", folder=self.folder)
        self.assertEqual(finished.returncode, 0, finished)
        with open(self.path("p.json")) as stream:
            early = next(one for one in json.load(stream)["runs"] if one["tolerance"] == 0.03)
        self.assertTrue(0.85 < early["estimate"] / early["true_norm"] < 1.15, early)  # without it: 0.79

    def test_ranks_do_not_change_the_answers(self):
        answers = []
        for ranks in (1, 2):
            found = json.loads(self.cost("--tolerances", "1e-11", "--refinements", "1", "--accuracies", "-", "--json", "-", ranks=ranks).stdout)
            answers.append([one["answers"]["tip"]["value"] for one in found["runs"]])
        for one, two in zip(*answers):
            self.assertAlmostEqual(one, two, delta=1e-9 * abs(one))

    def test_max_time_leaves_runs_out(self):
        table = self.cost(*LADDER, "--max-time", "1e-6", "--json", "p.json").stdout
        with open(self.path("p.json")) as stream:
            found = json.load(stream)
        states = [one["state"] for one in found["runs"]]
        self.assertEqual(states, ["done"] + 13 * ["not run"])
        self.assertTrue(found["runs"][1]["reason"].startswith("about "))
        self.assertEqual(table.count("not run (about "), 11)
        self.assertEqual(table.count("not run (no time is left)"), 2)

    def test_csv_goes_to_standard_output_alone(self):
        rows = list(csv.DictReader(io.StringIO(self.cost(*LADDER, "--orders", "1", "--refinements", "0", "--accuracies", "-", "--csv", "-").stdout)))
        self.assertEqual([row["order"] for row in rows], ["1", "1"])
        self.assertEqual(rows[0]["tip error"], "", "the finest answer knows nothing of itself")

    def test_the_picture_goes_by_way_of_tmpdir(self):
        """An installed program runs the script beside it: here one that tells what it is to draw."""
        for folder in ("bin", "share/orthostat", "somewhere"):
            os.makedirs(self.path(folder))
        program = shutil.copy(PROGRAM, self.path("bin"))
        with open(self.path("share/orthostat/plot-cost"), "w") as stream:
            stream.write('#!/bin/sh\ntest -s "$1" && echo "$1"\n')
        os.chmod(stream.name, 0o755)
        done = subprocess.run([program, "cost", "beam.yaml", *SHORT, "-q", "--picture", "p.png"], cwd=self.folder,
                              capture_output=True, text=True, timeout=100,
                              env={**os.environ, "TMPDIR": self.path("somewhere")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.startswith(self.path("somewhere/orthostat-study-")), done.stdout)
        self.assertFalse(os.path.exists(done.stdout.strip()))

    def test_picture_is_drawn(self):
        self.assertEqual(self.cost(*SHORT, "-q", "--picture", "p.png").stdout, "")
        with open(self.path("p.png"), "rb") as stream:
            self.assertEqual(stream.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertEqual(sorted(os.listdir(self.folder)), ["beam.yaml", "p.png"])

    def test_plot_cost_refuses_what_is_no_price_list(self):
        script = os.path.join(SOURCE, "scripts", "plot-cost")
        finished = subprocess.run([script, self.path("beam.yaml"), self.path("p.png")], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 2)
        self.assertIn("not a price list", finished.stderr)

    def test_mistakes_are_refused(self):
        self.refuse("--orders takes", "beam.yaml", "--orders", "1;2")
        self.refuse("--tolerances takes", "beam.yaml", "--tolerances", "1e-2,")
        self.refuse("order 1 or 2, not 3", "beam.yaml", "--orders", "3")
        self.refuse("0 to 8 times", "beam.yaml", "--refinements", "9")
        self.refuse("below 1", "beam.yaml", "--tolerances", "2")
        self.refuse("above 0", "beam.yaml", "--max-time", "no")
        self.refuse("which case", *LADDER)

    def test_errors_are_against_the_formula_where_there_is_one(self):
        expected = -0.25
        with open(self.path("beam.yaml"), "w") as stream:
            stream.write(CASE.replace("component: z", f"component: z, expected: {expected}, source: a book §7") +
                         "  work: {strain_energy: all, expected: 0.125}\n")
        finished = self.cost("--tolerances", "1e-8", "--refinements", "0,1", "--accuracies", "-", "--csv", "p.csv",
                             "--json", "p.json")
        self.assertIn("the formula's value -0.25, a book §7\n", finished.stdout)
        self.assertIn("the formula's value 0.125\n", finished.stdout)
        with open(self.path("p.json")) as stream:
            study = json.load(stream)
        with open(self.path("p.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        tip, work = study["quantities"]
        self.assertEqual((tip["reference"]["kind"], tip["reference"]["source"]), ("formula", "a book §7"))
        self.assertEqual((tip["reference"]["value"], tip["reference"]["uncertainty"]), (expected, 0))
        self.assertEqual((work["reference"]["value"], work["reference"]["source"]), (0.125, None))
        self.assertEqual(len(rows), 4)
        for row, one in zip(rows, study["runs"]):
            answer = one["answers"]["tip"]
            self.assertAlmostEqual(answer["error"], abs(answer["value"] - expected) / 0.25, delta=1e-14)
            self.assertEqual(row["tip reference kind"], "formula")
            self.assertEqual(float(row["tip reference"]), expected)
        script = os.path.join(SOURCE, "scripts", "plot-cost")
        finished = subprocess.run([script, "p.json", "p.svg", "tip"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(finished.returncode, 0, finished)
        with open(self.path("p.svg")) as stream:
            self.assertIn("against the formula's value -0.25, a book §7", stream.read())

    def test_nothing_is_written_over_what_is_needed(self):
        os.mkdir(self.path("folder"))
        for option in ("--csv", "--json", "--picture"):
            for place, words in (("beam.yaml", "over the case itself"), ("folder/../beam.yaml", "over the case itself"),
                                 ("folder", "not a regular file"), ("/dev/null", "not a regular file"),
                                 ("nowhere/p.png", "folder 'nowhere'"), ("", "names no file")):
                # The ladder would be refused if anything came to it.
                self.refuse(words, "beam.yaml", "--orders", "3", option, place)
        self.refuse("cannot both go to 'folder/../p'", "beam.yaml", "--orders", "3", "--csv", "p", "--json", "folder/../p")
        self.refuse("cannot both go to standard output", "beam.yaml", "--orders", "3", "--csv", "-", "--json", "-")
        self.refuse("a picture cannot go to standard output", "beam.yaml", "--orders", "3", "--picture", "-")
        self.assertEqual(sorted(os.listdir(self.folder)), ["beam.yaml", "folder"])
        with open(self.path("beam.yaml")) as stream:
            self.assertEqual(stream.read(), CASE)

    def test_verify_writes_over_nothing_that_is_needed(self):
        shutil.copy(os.path.join(SOURCE, "cases", "verify", "strip.yaml"), self.path("strip.yaml"))
        before = sorted(os.listdir(self.folder))
        for words, *arguments in (("over the case itself", "--json", "strip.yaml"),
                                  ("not a regular file", "--json", "."),
                                  ("folder 'nowhere'", "--json", "nowhere/v.json"),
                                  ("cannot make the folder 'nowhere/here'", "--picture", "nowhere/here"),
                                  ("'strip.yaml' is not a folder", "--picture", "strip.yaml")):
            command = [PROGRAM, "verify", "--quick", "./strip.yaml", *arguments]
            if words.startswith("cannot make"):
                command = [MPIEXEC, "-n", "2", *command]
            finished = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(finished.returncode, 2, finished)
            self.assertIn(words, finished.stderr)
            self.assertEqual(finished.stderr.count("error:"), 1, finished)
            self.assertEqual(finished.stdout, "", "nothing ran")
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        with open(self.path("strip.yaml")) as copy, open(os.path.join(SOURCE, "cases", "verify", "strip.yaml")) as case:
            self.assertEqual(copy.read(), case.read())

    def test_all_refused_is_a_failure_with_its_reason(self):
        with open(self.path("beam.yaml"), "a") as stream:
            stream.write("solver: {method: metric, max_iterations: 1}\n")
        finished = run("beam.yaml", "--orders", "1", "--refinements", "2", "--tolerances", "1e-12", "--accuracies", "-",
                       folder=self.folder)
        self.assertEqual(finished.returncode, 1, finished)
        self.assertIn("1 iteration", finished.stderr)


if __name__ == "__main__":
    unittest.main()
