"""No picture of the docs is stale: each is the one on record, made of files as they are, and shows what the program says now.
(The whole of verify, which takes two minutes, is compared in tests/verification/test_all.py.)"""
import json
import os
import re
import shutil
import subprocess

from drawn import check_drawn, pictures, record
from pages import PAGES, SOURCE, check, new_folder, read, run

folder = new_folder()


def report_of(name):
    with open(os.path.join(folder, name), encoding="utf-8") as stream:
        return json.load(stream)


# Every picture is on record and shown somewhere; it and the files it depends on are unchanged since it was drawn.
files = {name for name in os.listdir(pictures.PICTURES) if name != "record.json"}
text = "".join(read(page) for page in PAGES)
check(files == record.keys(), f"on one side alone: {sorted(files ^ record.keys())}")
for name, entry in record.items():
    check(f"pictures/{name})" in text, f"docs/pictures/{name} is shown nowhere")
    check(pictures.hash_of(os.path.join(pictures.PICTURES, name)) == entry["picture"],
          f"docs/pictures/{name} is not the picture on record; scripts/pictures draws and records it")
    for path, old in entry["depends"].items():
        check(pictures.hash_of(os.path.join(SOURCE, path)) == old,
              f"docs/pictures/{name} is older than {path}; scripts/pictures draws it again")
check(sum(os.path.getsize(os.path.join(pictures.PICTURES, name)) for name in files) < 3e6, "3 MB of pictures are enough")

# The tables that were written with them.
for name, (page, table, make) in pictures.TABLES.items():
    check(pictures.split_page(page, table)[1] == make(record[name]["numbers"]),
          f"the table of docs/{page} is not that of docs/pictures/{name}; scripts/pictures {table} writes both")

# The map.
drawn = os.path.join(folder, "map.svg")
subprocess.run([os.path.join(SOURCE, "scripts", "draw-map"), os.path.join(SOURCE, "docs", "architecture.md"), drawn],
               check=True)
check(read(drawn) == read("docs", "pictures", "map.svg"), "docs/pictures/map.svg is stale; scripts/pictures map draws it")
rooms = {name + "/" for name in os.listdir(os.path.join(SOURCE, "src"))}
on_map = set(re.findall(r"^\| \d \| `(\w+/)`", read("docs", "architecture.md"), re.M))
check(rooms <= on_map, f"docs/architecture.md has no row for {sorted(rooms - on_map)}")
for owner, row in re.findall(r"^\| \d \| `(\w+)/` (.*)$", read("docs", "architecture.md"), re.M):
    inner = {entry.name for entry in os.scandir(os.path.join(SOURCE, "src", owner)) if entry.is_dir()}
    told = set(re.findall(r"`(\w+)/`", row))
    check(inner == told, f"docs/architecture.md, row of {owner}/: on one side alone {sorted(inner ^ told)}")

# The tubes, and the plank where gmsh is at hand (its meshes differ a little from version to version).
for tube in pictures.TUBES:
    finished = run("solve", os.path.join(SOURCE, "cases", "tube", tube + ".yaml"), "-q", "--json", "tube.json", folder=folder)
    check(finished.exit_code == 0, finished.errors)
    check_drawn(f"tube-{tube}.png", pictures.numbers_of_solve(report_of("tube.json")), 1e-3, "tubes")  # what the stop leaves
for name in ("plank.geo", "plank.yaml"):
    shutil.copy(os.path.join(SOURCE, "cases", "plank", name), folder)
subprocess.run(["gmsh", "-3", "plank.geo", "-o", "plank.msh"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
finished = run("solve", "plank.yaml", "-q", "--json", "plank.json", folder=folder)
check(finished.exit_code == 0 and not finished.errors, finished.errors)
check_drawn("plank.png", pictures.numbers_of_solve(report_of("plank.json")), 0.02, "plank")

# What the effects of a tube change.
check(run("effects", os.path.join(SOURCE, pictures.EFFECTS), "-q", "--json", "effects.json", folder=folder).exit_code == 0,
      "orthostat effects failed")
check_drawn("effects-tube.png", pictures.numbers_of_effects(report_of("effects.json")), 1e-3, "effects")

# What the classical formulation costs: nothing where the material is isotropic.
old = pictures.numbers_of_formulations(pictures.split_page("verification.md", "formulations")[1])
for ranks in (1, 2):
    finished = run(program=os.path.join(os.environ["ORTHOSTAT_TEST_BIN"], "formulations"), ranks=ranks)
    check(finished.exit_code == 0, finished.errors)
    found = pictures.numbers_of_formulations(finished.output)
    differences = pictures.differences(old, found, 0.01)
    check(not differences, "docs/verification.md is stale (scripts/pictures formulations):\n" + "\n".join(differences))
    check([row[0] for row in found] == [1, 10, 100, 1000], f"other ratios: {found}")
    for ratio, moment, classical_moment, loop, classical_loop, difference in found:
        check(max(moment, loop) < 1e-12, f"E1/E2 {ratio}: consistent forces have a moment {moment}, or no potential: {loop}")
        classical = (classical_moment, classical_loop, difference)
        check(max(classical) < 1e-10 if ratio == 1 else min(classical) > 0.01, f"E1/E2 {ratio}: classical forces show {classical}")

# A path.
finished = run("solve", os.path.join(SOURCE, "cases", "bent-bar", "pull.yaml"), "-q", "--json", "pull.json", "--output", "pull.vtkhdf",
               folder=folder)
check(finished.exit_code == 0, finished.errors)
check_drawn("history.png", pictures.numbers_of_path(report_of("pull.json")), 1e-5, "history")

# Where nine constants are stable.
check(run("material", "--stability-region", "region.csv", folder=folder).exit_code == 0, "the stability region failed")
check_drawn("stability-region.png", pictures.numbers_of_region(os.path.join(folder, "region.csv")), 1e-4, "stability")

# Of the costs what takes no time: both orders on the mesh as given.
for name, case in pictures.COSTS.items():
    if name == "tube":
        continue
    finished = run("cost", os.path.join(SOURCE, case), "-q", "--refinements", "0", "--accuracies", "-", "--json", "cost.json",
                   folder=folder)
    check(finished.exit_code == 0, finished.errors)
    found = pictures.numbers_of_cost(report_of("cost.json"))
    old = record[f"cost-{name}.png"]["numbers"]
    check(len(found) == 6 and found.keys() <= old.keys(), f"the runs of cost-{name} are others: {sorted(found)}")
    differences = pictures.differences({run_name: old[run_name] for run_name in found}, found, 0.01)
    check(not differences, f"docs/pictures/cost-{name}.png is stale (scripts/pictures cost):\n" + "\n".join(differences))

# Verify's verdicts as they were drawn: every case, and every one passed.
verified = record["verify.png"]["numbers"]
names = {name[:-5] for name in os.listdir(os.path.join(SOURCE, "cases", "verify")) if name.endswith(".yaml")}
check(verified.keys() == names, f"docs/pictures/verify.png: on one side alone {sorted(verified.keys() ^ names)}")
check(all(case["passed"] for case in verified.values()), "docs/pictures/verify.png shows cases that failed")
