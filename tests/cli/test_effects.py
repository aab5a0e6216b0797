"""What `explain` says of a case is what its solve does: the same effects, on or off for the same reasons, none of them both ways; and the
ledger has calls for those that are on alone. `explain` looks at the mesh where only that can tell what a load acts on."""
import json
import os

from program import SOURCE, check, new_folder, run, write

VEG = """*VERTICES
5 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 1 1 1
*ELEMENTS
TET
2 4 0
1 1 2 3 4
2 2 3 4 5
*SET SOFT
1
*SET HARD
2
*MATERIAL RUBBER
ENU, 1, 1e4, 0.49
*MATERIAL FIBRE
ORTHOTROPIC_N3G3, 1, 1e6, 2e6, 3e6, 0.3, 0.3, 0.3, 1e6, 1e6, 1e6
*REGION
SOFT, RUBBER
*REGION
HARD, FIBRE
"""

BLOCK = "mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 2]}}\n"
STEEL = "materials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0.3}]\n"
HELD = "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
FIXED = "constraints: [{on: {vertices: [1, 2, 3]}, displacement: [0, 0, 0]}]\n"


def force(selection):
    return f"loads: [{{on: {selection}, total_force: [1, 0, 0]}}]\n"


# A case, and effects that are on in it.
CASES = {
    "a box of faces": (BLOCK + STEEL + HELD + force("{box: {min: [2, 0, 0], max: [2, 1, 1]}}"), ["surface load"]),
    "a box of one vertex": (BLOCK + STEEL + HELD + force("{box: {min: [2, 1, 1], max: [2, 1, 1]}}"), ["point force"]),
    "faces that only refinement makes": (BLOCK.replace("mesh: {", "mesh: {refine: 1, ") + STEEL + HELD +
                                         force("{box: {min: [2, 0, 0], max: [2, 0.25, 0.25]}}"), ["surface load"]),
    "those vertices as they are": (BLOCK + STEEL + HELD + force("{box: {min: [2, 0, 0], max: [2, 0.25, 0.25]}}"),
                                   ["point force"]),
    "materials of a file": ("mesh: {file: two.veg}\n" + FIXED + force("{vertices: [5]}"),
                            ["several materials", "orthotropy", "point force"]),
    "one of them replaced": ("mesh: {file: two.veg}\nmaterials: [{region: HARD, youngs_modulus: 1, poissons_ratio: 0.3}]\n" +
                             FIXED + force("{box: {min: [1, 0, 0], max: [1, 1, 1]}}"), ["several materials", "point force"]),
    "near incompressibility": ("element: {order: 2}\nmesh: {file: two.veg}\n" + FIXED + force("{vertices: [5]}"),
                               ["mixed form"]),
    "a moved coupling": (BLOCK + STEEL + HELD + "large_rotation: off\nloads: [{on: {boundary: xmax}, distributing: "
                         "{at: [2, 0.5, 0.5], rotation: [0, 0.1, 0]}}, {on: {boundary: zmax}, pressure: 1}]\n",
                         ["moved coupling", "surface load"]),
    "multigrid": ("element: {order: 2}\n" + BLOCK + STEEL + HELD + force("{boundary: xmax}") + "solver: {method: metric}\n",
                  ["linear space", "surface load"]),
}


def compare(name, on, folder, ranks=1):
    explained = run("explain", name, "--json", folder=folder, ranks=ranks)
    check(explained.exit_code == 0, f"{name}: {explained.errors}")
    solved = run("solve", name, "--json", "-", folder=folder, ranks=ranks)
    check(solved.exit_code == 0, f"{name}: {solved.errors}")
    said, done = json.loads(explained.output), json.loads(solved.output)
    accounts = {a["name"]: a for a in done["ledger"]["accounts"]}
    for foreseen, effect in zip(said["effects"], done["effects"], strict=True):
        check((foreseen["effect"], foreseen["on"], foreseen["reason"]) == (effect["effect"], effect["on"], effect["reason"]),
              f"{name}: {foreseen} was explained, {effect} was done")
        account = accounts[effect["effect"]]
        check(account["effect"] and (account["entries"] > 0) == effect["on"], f"{name}: {effect}, but {account}")
        check(effect["on"] or account["bytes"] == account["seconds"] == 0, f"{name}: {effect}, but {account}")
        check(" if " not in effect["reason"], f"{name}: on or off? {effect}")
    are_on = [e["effect"] for e in done["effects"] if e["on"]]
    for effect in on:
        check(effect in are_on, f"{name}: {effect} should be on, and {are_on} are")
    loads = [e for e in ("point force", "surface load", "body force") if e in are_on]
    check(not on or len(loads) == 1, f"{name}: one load, and {loads} are on")


folder = new_folder()
write(folder, "two.veg", VEG)
for title, (text, on) in CASES.items():
    write(folder, f"{title}.yaml", text)
    compare(f"{title}.yaml", on, folder)
for name in ("block/gravity", "block/pressure", "block/sliding", "beam/cantilever", "tube/gradient"):
    compare(os.path.join(SOURCE, "cases", name + ".yaml"), [], folder)

# What the partition keeps on one rank: `explain` on as many ranks looks at the mesh for it.
WHOLE = {
    "flat": (BLOCK.replace("[4, 2, 2]", "[4, 2, 20]") + STEEL, "close nodes"),
    "stiff": ("mesh: {file: two.veg, refine: 1}\nmaterials: [{region: SOFT, youngs_modulus: 1, poissons_ratio: 0.3}]\n",
              "whole inclusions"),
    "neither": (BLOCK + STEEL, None),
}
for title, (text, effect) in WHOLE.items():
    held = HELD + force("{boundary: xmax}") if "block" in text else FIXED + force("{vertices: [5]}")
    write(folder, f"{title}.yaml", text + held)
    compare(f"{title}.yaml", [effect] if effect else [], folder, ranks=2)
    compare(f"{title}.yaml", [], folder)
