"""Answers compared with closed-form solutions, on all the meshes that the README tells of."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SOURCE, check, run  # noqa: E402

os.environ["ORTHOSTAT_CASES"] = os.path.join(SOURCE, "cases")
finished = run("verify", ranks=2)
check(finished.exit_code == 0, f"verify: {finished.output[-4000:]}{finished.errors}")
check("FAIL" not in finished.output, finished.output)
