# SPDX-License-Identifier: BSD-3-Clause
"""`orthostat material` as a user calls it, and the picture of the stability region."""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

# A program alone need not start Open MPI's daemon, which takes most of its time.
ALONE = {**os.environ, "OMPI_MCA_ess_singleton_isolated": "1"}
PROGRAM = os.environ["ORTHOSTAT_PROGRAM"]
SOURCE = os.environ["ORTHOSTAT_SOURCE"]
MPIEXEC = os.environ["ORTHOSTAT_MPIEXEC"]
LAMINA = "--youngs 140,10,10 --nu12 0.3 --nu23 0.3 --nu13 0.3 --G12 5 --G23 3.8 --G31 5".split()


def run(*arguments, ranks=1):
    command = [PROGRAM, "material", *arguments]
    if ranks > 1:
        command = [MPIEXEC, "-n", str(ranks), *command]
    environment = ALONE if ranks == 1 else None
    return subprocess.run(command, capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL, env=environment)


def report(*arguments):
    finished = run(*arguments, "--json")
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout)


class Material(unittest.TestCase):
    def refuse(self, arguments, *texts):
        finished = run(*arguments)
        self.assertEqual(finished.returncode, 2, finished)
        self.assertEqual(finished.stdout, "")
        for text in texts:
            self.assertIn(text, finished.stderr)

    def test_isotropic_stiffness_is_lames(self):
        found = report("--youngs", "1e6", "--poissons", "0.3")
        self.assertEqual(found["kind"], "isotropic")
        lame, mu = 1e6 * 0.3 / (1.3 * 0.4), 1e6 / 2.6
        self.assertAlmostEqual(found["stiffness"][0][0], lame + 2 * mu, delta=1e-8)
        self.assertAlmostEqual(found["stiffness"][0][1], lame, delta=1e-8)
        self.assertAlmostEqual(found["stiffness"][3][3], mu, delta=1e-8)
        self.assertAlmostEqual(found["stiffness_eigenvalues"][5], 3 * lame + 2 * mu, delta=1e-7)
        self.assertEqual(found["stable_range"]["family_nu"], [-1, 0.5])

    def test_family_and_its_shear_rules(self):
        means = {"arithmetic": 50.5, "max": 100}
        for rule, mean in means.items():
            found = report("--youngs", "1,100,7", "--nu", "-0.2", "--shear", rule)
            self.assertAlmostEqual(found["shear_modulus"]["G12"], mean / 1.6, delta=1e-12)
            self.assertAlmostEqual(found["poissons_ratio"]["nu12"], -0.02, delta=1e-15)
            self.assertAlmostEqual(found["poissons_ratio"]["nu21"], -2.0, delta=1e-13)

    def test_off_axis_moduli_of_a_lamina(self):
        half = repr(0.5**0.5)
        turned = report(*LAMINA, "--axes", f"{half},{half},0 -{half},{half},0 0,0,1")
        self.assertAlmostEqual(turned["world"]["youngs_modulus"]["Ex"], 13.207547, delta=5e-7)
        self.assertIn("21.292776", run(*LAMINA, "--angle", "30").stdout)

    def test_either_ratio_of_a_pair(self):
        swapped = [word.replace("nu13", "nu31") for word in LAMINA]
        swapped[swapped.index("--nu31") + 1] = repr(0.3 * 10 / 140)
        for a, b in zip(report(*LAMINA)["stiffness"], report(*swapped)["stiffness"]):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, delta=1e-12)

    def test_transversely_isotropic(self):
        found = report(*"--plane-youngs 1 --axis-youngs 100 --plane-nu 0.3 --axis-shear 2.5".split())
        self.assertEqual(found["kind"], "transversely isotropic")
        self.assertEqual(found["youngs_modulus"], {"E1": 1, "E2": 1, "E3": 100})
        self.assertAlmostEqual(found["poissons_ratio"]["nu23"], 0.03, delta=1e-15)  # eq. 20
        self.assertEqual(found["shear_modulus"]["G23"], 2.5)
        self.assertEqual(found["moduli"], "E = 100 along e3 (the axis), 1 along e1 and e2")

    def test_indefinite_constants_are_refused_with_the_way_out(self):
        arguments = "--youngs 1,1,4 --nu12 .45 --nu23 .45 --nu31 .45 --G12 1 --G23 1 --G31 1".split()
        self.refuse(arguments, "-0.245375 must be positive", "Stable up to 0.9025", "nu = 0.45 means")

    def test_bad_usage_is_refused(self):
        cases = [
            ([], "--youngs is missing"),
            (["--youngs", "1,2", "--nu", "0.3"], "one number or three"),
            (["--youngs", "1,x,3", "--nu", "0.3"], "--youngs '1,x,3'"),
            (["--youngs", "-5", "--nu", "0.3"], "E1 = -5"),
            (["--youngs", "5", "--nu", "0.3", "--nu", "0.4"], "given twice"),
            (["--youngs", "5", "--nu", "0.3", "--plane-nu", "0.2"], "--youngs does not go with"),
            (["--youngs", "1,2,3", "--nu", "0.3", "--shear", "mean"], "geometric, arithmetic, min or max"),
            (LAMINA + ["--nu21", "0.3"], "contradict each other"),
            (LAMINA + ["--axes", "1,0,0,0,1,0,0,0,-1"], "left-handed"),
            (LAMINA + ["--axes", "1,0,0"], "nine"),
            (LAMINA + ["--axes", "1,0,0,0,1,0,0,0,1", "--angle", "3"], "give one of them"),
            (["140", "10"], "stands alone"),
        ]
        with ThreadPoolExecutor(4) as pool:
            list(pool.map(lambda case: self.refuse(*case), cases))

    def test_several_ranks_speak_once(self):
        finished = run("--youngs", "1e6", "--nu", "0.3", "--json", ranks=2)
        self.assertEqual(json.loads(finished.stdout)["kind"], "isotropic")
        finished = run("--youngs", "1e6", "--nu", "0.7", ranks=2)
        self.assertEqual(finished.returncode, 2)
        self.assertEqual(finished.stderr.count("orthostat: error"), 1)


class StabilityRegion(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.file = os.path.join(self.folder.name, "region.csv")

    def tearDown(self):
        self.folder.cleanup()

    def test_curves_lie_on_equation_16_and_are_drawn(self):
        finished = run("--stability-region", self.file, "--nu", "0.2,0.45")
        self.assertEqual(finished.returncode, 0, finished.stderr)
        with open(self.file, newline="") as stream:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
        self.assertEqual({row["nu"] for row in rows}, {0.2, 0.45})
        for row in rows:
            nu, x, y = row["nu"], row["E1_over_E2"], row["E3_over_E2"]
            self.assertAlmostEqual(1 - nu**2 * (1 / x + y + x / y) - 2 * nu**3, 0, delta=1e-10)
        # the paper's region for 0.45 does not reach E3 = 4 E2 at E1 = E2
        self.assertLess(max(row["E3_over_E2"] for row in rows if row["nu"] == 0.45), 4)
        picture = os.path.join(self.folder.name, "region.png")
        script = os.path.join(SOURCE, "scripts", "stability-region")
        subprocess.run([sys.executable, script, self.file, picture], check=True, timeout=100)
        with open(picture, "rb") as stream:
            self.assertEqual(stream.read(8), b"\x89PNG\r\n\x1a\n")

    def test_failures_leave_an_existing_file_alone(self):
        with open(self.file, "w") as stream:
            stream.write("precious")
        finished = run("--stability-region", self.file, "--nu", "0.2,0.6")
        self.assertEqual(finished.returncode, 2)
        self.assertIn("nu = 0.6 has no stability boundary", finished.stderr)
        with open(self.file) as stream:
            self.assertEqual(stream.read(), "precious")
        self.assertEqual(os.listdir(self.folder.name), ["region.csv"])
        lost = run("--stability-region", os.path.join(self.folder.name, "none", "x.csv"))
        self.assertEqual(lost.returncode, 2)
        self.assertIn("cannot write", lost.stderr)


if __name__ == "__main__":
    unittest.main()
