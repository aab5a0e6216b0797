"""Answers against closed forms: one case on all the meshes that docs/verification.md tells of, the others on
the coarser ones. The picture and the table of the docs show them."""
import json
import os
import sys

tests = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path += [os.path.join(tests, "cli"), os.path.join(tests, "docs")]
from balance import check_cases  # noqa: E402
from drawn import pictures, record  # noqa: E402
from program import SOURCE, check, new_folder, run  # noqa: E402

WHOLE = ["cylinder-nu-4999"]
os.environ["ORTHOSTAT_CASES"] = os.path.join(SOURCE, "cases")
folder = new_folder()


def verify(*arguments):
    report = os.path.join(folder, "verify.json")
    finished = run("verify", "--json", report, *arguments, timeout=1180)
    check(finished.exit_code == 0, f"verify: {finished.output[-4000:]}{finished.errors}")
    check("FAIL" not in finished.output, finished.output)
    with open(report, encoding="utf-8") as stream:
        return json.load(stream)


def of_meshes(reading, count):
    """What is drawn of the first meshes; the rate and the formula's value are of the finest."""
    return {"errors": reading["errors"][:count], "locks": reading["locks"], "passed": reading["passed"]}


coarse = verify("--quick")
check_cases(coarse["cases"])
drawn = record["verify.png"]["numbers"]
found = pictures.numbers_of_verify(coarse)
check(found.keys() == drawn.keys(), f"the picture has other cases: {sorted(found.keys() ^ drawn.keys())}")
stale = []
for name, case in found.items():
    for reading, numbers in case["readings"].items():
        count = len(numbers["errors"])
        stale += pictures.differences(of_meshes(drawn[name]["readings"][reading], count), of_meshes(numbers, count), 0.05,
                                      f"{name}/{reading}")
whole = pictures.numbers_of_verify(verify(*WHOLE))
stale += pictures.differences({name: drawn[name] for name in WHOLE}, whole, 0.05)
check(not stale, "docs/pictures/verify.png is stale (scripts/pictures verify draws it again):\n" + "\n".join(stale[:20]))
