"""Answers against closed forms, on all the meshes that docs/verification.md tells of; its picture and table show them."""
import json
import os
import sys

tests = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path += [os.path.join(tests, "cli"), os.path.join(tests, "docs")]
from balance import check_cases  # noqa: E402
from drawn import check_drawn, pictures  # noqa: E402
from program import SOURCE, check, new_folder, run  # noqa: E402

os.environ["ORTHOSTAT_CASES"] = os.path.join(SOURCE, "cases")
report = os.path.join(new_folder(), "verify.json")
finished = run("verify", "--json", report, timeout=1180)
check(finished.exit_code == 0, f"verify: {finished.output[-4000:]}{finished.errors}")
check("FAIL" not in finished.output, finished.output)
with open(report, encoding="utf-8") as stream:
    document = json.load(stream)
check_cases(document["cases"])
check_drawn("verify.png", pictures.numbers_of_verify(document), 0.05, "verify")
