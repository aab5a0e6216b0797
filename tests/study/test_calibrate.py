# SPDX-License-Identifier: BSD-3-Clause
"""`orthostat cost --calibrate` as a user calls it: the table, the rates that are kept, and what `explain` makes of them.

Memory is exact, so it is held to what was foretold; seconds are those of the day, and only printed."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["ORTHOSTAT_PROGRAM"]
SOURCE = os.environ["ORTHOSTAT_SOURCE"]
TUBE = os.path.join(SOURCE, "cases/tube/isotropic.yaml")


class Calibrate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orthostat-")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.rates = os.path.join(self.folder, "orthostat", "rates.json")

    def run_program(self, *arguments, **changes):
        environment = {**os.environ, "XDG_CACHE_HOME": self.folder, **changes}
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=500, env=environment,
                              stdin=subprocess.DEVNULL)

    def explain(self, **changes):
        done = self.run_program("explain", TUBE, "--json", **changes)
        self.assertEqual(done.returncode, 0, done)
        return json.loads(done.stdout)

    def test_memory_of_thin_plates_of_quadratic_tets(self):
        """Multigrid takes aggregates of their nodes in place of the linear tets, or columns of them."""
        for thickness, cells in (0.004, 40), (0.002, 32):
            case = os.path.join(self.folder, "plate.yaml")
            with open(case, "w", encoding="ascii") as stream:
                stream.write(f"""mesh: {{block: {{size: [1, 1, {thickness}], divisions: [{cells}, {cells}, 1]}}}}
element: {{order: 2}}
materials: [{{region: all, youngs_modulus: 1e9, poissons_ratio: 0.3}}]
constraints: [{{on: {{boundary: [xmin, xmax, ymin, ymax]}}, displacement: [0, 0, 0]}}]
loads: [{{on: {{boundary: zmax}}, pressure: 1}}]
large_rotation: off
solver: {{method: metric}}
output: {{file: {self.folder}/plate.vtkhdf}}
""")
            told = json.loads(self.run_program("explain", case, "--json").stdout)["bytes"]["in_all"]
            done = self.run_program("solve", "-q", case, "--json", "-")
            self.assertEqual(done.returncode, 0, done)
            ratio = told / json.loads(done.stdout)["ledger"]["peak_bytes"]
            self.assertTrue(1 / 1.15 < ratio < 1.15, (thickness, ratio))

    def test_the_rates_are_measured_kept_and_used(self):
        self.assertIn("typical of", self.explain()["rates"])
        done = self.run_program("cost", "--calibrate", "--json", "-")
        self.assertEqual(done.returncode, 0, done)
        found = json.loads(done.stdout)
        self.assertEqual({(run["body"], run["order"]) for run in found["runs"] if not run["fitted"]},
                         {(body, order) for body in ("beam", "tube", "tube, stiff along") for order in (1, 2)})
        for run in found["runs"]:
            ratio = run["bytes"]["foretold"] / run["bytes"]["taken"]
            print(f'{run["body"]}, order {run["order"]}: memory {ratio:.3f}, '
                  f'seconds {run["seconds"]["foretold"] / run["seconds"]["taken"]:.2f}')
            self.assertTrue(1 / 1.15 < ratio < 1.15, run)
            parts = sum(stage["taken"] for stage in run["stages"].values())
            self.assertAlmostEqual(parts, run["seconds"]["taken"], delta=1e-9)
        # The runs that a rate is taken from are foretold by it: their mean is right whatever the day was like.
        for stage in ("mesh", "assembly", "setup", "solve"):
            for order in (1, 2):
                product = 1.0
                for run in found["runs"]:
                    if run["fitted"] and run["order"] == order and "small" not in run["body"]:
                        work = run["stages"][stage]
                        product *= work["foretold"] / work["taken"]
                        if stage == "solve":
                            product *= run["iterations"]["taken"] / run["iterations"]["foretold"]
                self.assertTrue(0.8 < product < 1.25, (stage, order, product))

        foretold = self.explain()
        self.assertIn("measured on this machine on 20", foretold["rates"])
        seconds = foretold["seconds"]
        parts = sum(value for name, value in seconds.items() if name not in ("in_all", "newton_iteration"))
        self.assertAlmostEqual(seconds["in_all"], parts, delta=1e-9)
        self.assertGreater(seconds["solve"], 0.0)

        with open(self.rates) as stream:
            kept = json.load(stream)
        kept["version"] = "0.0.0"
        self.keep(kept)
        self.assertIn("of version 0.0.0", self.explain()["rates"])
        kept["machine"] = "another"
        self.keep(kept)
        self.assertIn("of another machine (another", self.explain()["rates"])

    def keep(self, kept):
        with open(self.rates, "w") as stream:
            json.dump(kept, stream)

    def test_a_case_beside_it_is_refused(self):
        for arguments in (["--calibrate", TUBE], []):
            done = self.run_program("cost", *arguments)
            self.assertEqual(done.returncode, 2, done)

    def test_no_place_for_the_rates(self):
        nowhere = self.explain(HOME="", XDG_CACHE_HOME="")
        self.assertIn("typical of", nowhere["rates"])


if __name__ == "__main__":
    unittest.main()
