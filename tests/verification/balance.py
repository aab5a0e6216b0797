"""What holds of every case that `orthostat verify` reports on."""
import os

from program import SOURCE, check

COARSE = 30000  # unknowns: more than any mesh of --quick has; on finer ones rounding shows


def check_cases(cases):
    files = [name for name in os.listdir(os.path.join(SOURCE, "cases", "verify")) if name.endswith(".yaml")]
    check(len(cases) == len(files), f"{len(cases)} cases were run")
    for case in cases:
        check(case["passed"] and case["quantities"] and case["runs"], f"{case['name']} is not whole")
        for one in case["runs"]:
            if one["unknowns"] <= COARSE:
                worst = max(one["force_imbalance"], one["moment_imbalance"])
                check(worst <= 1e-10, f"{case['name']} is out of balance")
                check(one["energy_imbalance"] <= 1e-9, f"{case['name']}: energy is not work")
