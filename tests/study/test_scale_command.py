# SPDX-License-Identifier: BSD-3-Clause
"""`orthostat scale` as a user calls it: what ranks send is counted right, and where sizes and ranks cannot be had it
says so. Seconds are not looked at."""
import csv
import io
import json
import os
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["ORTHOSTAT_PROGRAM"]
SOURCE = os.environ["ORTHOSTAT_SOURCE"]

# A bar of one cell across: two ranks meet in one section of four vertices, and each has the other's next four as ghosts.
BAR = """title: a bar
mesh: {block: {size: [60, 1, 1], divisions: [60, 1, 1]}}
materials: [{region: all, youngs_modulus: 1000, poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [0, 0, -1]}]
large_rotation: off
solver: {method: metric, coarsest_unknowns: 50}
"""
CUBE = BAR.replace("size: [60, 1, 1]", "size: [1, 1, 1]").replace("[60, 1, 1]", "[6, 6, 6]")
NODE = 24  # bytes of a node's three unknowns


def run(*arguments, folder):
    return subprocess.run([PROGRAM, "scale", *arguments], cwd=folder, capture_output=True, text=True, timeout=200,
                          stdin=subprocess.DEVNULL)


class Scale(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orthostat-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.write("bar.yaml", BAR)
        self.write("cube.yaml", CUBE)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as stream:
            stream.write(text)

    def scale(self, *arguments):
        finished = run(*arguments, folder=self.folder)
        self.assertEqual(finished.returncode, 0, finished)
        return finished.stdout

    def refuse(self, text, *arguments):
        finished = run(*arguments, folder=self.folder)
        self.assertEqual(finished.returncode, 2, finished)
        self.assertIn(text, finished.stderr)

    def test_what_ranks_send_is_counted(self):
        one, two = json.loads(self.scale("bar.yaml", "--ranks", "1,2", "--strong-only", "--json", "-"))["runs"]
        self.assertEqual((one["ranks"], two["ranks"]), (1, 2))
        self.assertEqual(one["unknowns"], two["unknowns"])
        self.assertLessEqual(two["iterations"], 1.2 * one["iterations"] + 1)
        for part in (one["iteration"], *one["level"]):
            self.assertEqual((part["messages"]["most"], part["bytes"]["most"]), (0, 0), "one rank sends nothing")
        outside, fine = two["iteration"], two["level"][0]
        # Each exchange is one message to the one neighbour, with the four vertices of the last section.
        self.assertAlmostEqual(outside["messages"]["most"], outside["exchanges"])
        self.assertAlmostEqual(outside["bytes"]["most"], 4 * NODE * outside["exchanges"])
        self.assertGreaterEqual(outside["exchanges"], 1, "an iteration has one product with the stiffness")
        # Smoothing of degree 3 from zero has two products, the residual one, smoothing after it three. The level below
        # is on rank 0: the other one sends it the restriction, and gets the prolongation, six unknowns an aggregate.
        self.assertEqual((fine["visits"], fine["exchanges"], fine["ranks"]), (1, 8, 2))
        self.assertEqual((fine["messages"]["mean"], fine["messages"]["most"]), (7, 7))
        aggregates = (fine["bytes"]["mean"] - 6 * 4 * NODE) / (2 * NODE)
        self.assertTrue(3 <= aggregates <= 5 and aggregates == int(aggregates), fine)
        self.assertEqual([level["visits"] for level in two["level"]],
                         [1, *[2 ** number for number in range(1, two["levels"] - 1)], 2 ** (two["levels"] - 2)])
        last = two["level"][-1]
        self.assertEqual(last["ranks"], 1, "one rank has all of the last level")
        self.assertAlmostEqual(last["multiplied"]["most"], last["visits"] * last["unknowns"] ** 2)
        self.assertAlmostEqual(last["multiplied"]["mean"], last["multiplied"]["most"] / 2)
        # AztecOO's two sums, ours of r·r with p·Ap, and of r·z; others are once in a solve.
        self.assertTrue(4 <= outside["sums"] < 10, outside)
        total = sum(level["multiplied"]["mean"] for level in one["level"])
        self.assertEqual([level["ranks"] for level in two["level"][:-1]], [2] * (two["levels"] - 1))
        self.assertAlmostEqual(sum(2 * level["multiplied"]["mean"] for level in two["level"]) / total, 1, delta=0.1)

    def test_everything_is_in_the_files(self):
        table = self.scale("cube.yaml", "--ranks", "2,1", "--sizes", "1000,8000", "--json", "s.json", "--csv", "s.csv",
                           "--picture", "s.png", "--network", "latency=1e-5,ranks=8")
        with open(self.path("s.json")) as stream:
            study = json.load(stream)
        with open(self.path("s.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        with open(self.path("s.png"), "rb") as stream:
            self.assertEqual(stream.read(8), b"\x89PNG\r\n\x1a\n")
        # Two sizes on each, and the first one doubled on two ranks.
        self.assertEqual([one["ranks"] for one in study["runs"]], [1, 1, 2, 2, 2])
        self.assertEqual([one["target"] for one in study["runs"]], [1000, 8000, 1000, 2000, 8000])
        for one, row in zip(study["runs"], rows):
            self.assertEqual(one["state"], "done", one)
            self.assertTrue(0.7 < one["unknowns"] / one["target"] < 1.4, one)
            self.assertEqual(int(row["unknowns"]), one["unknowns"])
            self.assertEqual(float(row["bytes"]), one["bytes"])
            self.assertGreater(one["memory"]["most"], 0)
            self.assertLessEqual(one["nodes"]["mean"], one["nodes"]["most"])
            self.assertEqual(one["seconds"] is None, one["crowded"])
        self.assertEqual(study["network"]["latency"], 1e-5)
        for key in ("strong", "weak"):
            entries = study[key]["iterations"]
            self.assertEqual([entry["ranks"] for entry in entries], [1e3, 3e3, 1e4, 3e4, 1e5])
            for entry in entries:
                self.assertAlmostEqual(sum(entry["parts"].values()), entry["seconds"], delta=1e-12)
            self.assertIn(study[key]["stops_first"], table)
        self.assertIn("strong scaling", table)
        self.assertIn("weak scaling", table)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith(".orthostat-")])

    def test_more_ranks_than_cores_have_no_seconds(self):
        ranks = 1 + len(os.sched_getaffinity(0))
        rows = list(csv.DictReader(io.StringIO(self.scale("cube.yaml", "--ranks", f"1,{ranks}", "--strong-only", "--csv",
                                                          "-"))))
        self.assertEqual([row["crowded"] for row in rows], ["0", "1"])
        self.assertEqual([row["seconds"] == "" for row in rows], [False, True])
        self.assertTrue(all(row["messages_most"] for row in rows))

    def test_what_does_not_fit_is_left_out_and_said(self):
        set_to = json.loads(self.scale("cube.yaml", "--ranks", "1", "--set", "mesh.block.divisions=[4, 4, 4]", "--json", "-"))
        self.assertEqual(set_to["runs"][0]["unknowns"], 3 * 4 * 5 * 5)
        table = self.scale("cube.yaml", "--ranks", "1", "--sizes", "1000,2e9")
        self.assertIn("not run: about ", table)
        labelled = CUBE.replace("{boundary: xmax}", "{vertices: [3]}")
        self.write("labelled.yaml", labelled)
        self.assertIn("only refined by eights", self.scale("labelled.yaml", "--ranks", "1", "--sizes", "1029,3000"))

    def test_mistakes_are_refused(self):
        self.refuse("--ranks takes", "cube.yaml", "--ranks", "1,x")
        self.refuse("--ranks takes", "cube.yaml", "--ranks", "0")
        self.refuse("--sizes takes", "cube.yaml", "--ranks", "1", "--sizes", "1000;2000")
        self.refuse("100 to", "cube.yaml", "--ranks", "1", "--sizes", "10")
        self.refuse("infiniband, ethernet, laptop", "cube.yaml", "--ranks", "1", "--network", "carrier-pigeon")
        self.refuse("name a file", "-", "--ranks", "1")
        self.refuse("over the case itself", "cube.yaml", "--ranks", "1", "--json", "cube.yaml")
        script = os.path.join(SOURCE, "scripts", "plot-scale")
        finished = subprocess.run([script, self.path("bar.yaml"), self.path("p.png")], capture_output=True, text=True)
        self.assertEqual(finished.returncode, 2)
        self.assertIn("not a scaling study", finished.stderr)


if __name__ == "__main__":
    unittest.main()
