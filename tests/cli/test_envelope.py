# SPDX-License-Identifier: BSD-3-Clause
"""The envelope of load cases: the extremes of all at each node and in each tet, and whose they are, against the fields of each."""
import os

import h5py
import numpy as np

from program import check, fewer, new_folder, read_json, run, write

CASE = """title: a bar
mesh: {block: {size: [4, 1, 1], divisions: [12, 3, 3]}}
materials: [{region: all, youngs_modulus: [1000, 2000, 4000], poissons_ratio: 0.3, strengths: {tension: 5, compression: 9}}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
large_rotation: off
output: {file: bar.vtkhdf, envelope: true, fields: [displacement, von_mises, principal_stress, tsai_wu_load_factor,
  hill_load_factor, maximum_stress_load_factor]}
cases:
  - {name: pull, loads: [{on: {boundary: xmax}, total_force: [2, 0, 0]}]}
  - {name: bend, loads: [{on: {boundary: xmax}, total_force: [0, 0, 0.1]}]}
  - {name: press, loads: [{on: {boundary: zmax}, pressure: 0.06}]}
  - {name: push, loads: [{on: {boundary: xmax}, total_force: [-2.5, 0, 0]}]}
"""
NAMES = ["pull", "bend", "press", "push"]
FIELDS = {"largest_displacement": ("displacement", np.max), "largest_von_mises": ("von_mises", np.max),
          "largest_principal": ("principal_stress", np.max)}
FIELDS.update({f"least_{name}_load_factor": (f"{name}_load_factor", np.min) for name in ("tsai_wu", "hill", "maximum_stress")})


def read(path, name):
    """Rows by their labels, each once; of a file of steps those of all, one after another."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        group, label = ("PointData", "vertex") if name in root["PointData"] else ("CellData", "tet")
        rows, labels = root[f"{group}/{name}"][:], root[f"{group}/{label}"][:]
        rows = rows.reshape(-1, len(labels), *rows.shape[1:])
        return rows[:, np.unique(labels, return_index=True)[1]]


for ranks in fewer((1, 2)):
    folder = new_folder()
    write(folder, "bar.yaml", CASE)
    solved = run("solve", "bar.yaml", "--json", "bar.json", ranks=ranks, folder=folder)
    check(solved.exit_code == 0 and "envelope of 4 load cases, written to bar_envelope.vtkhdf" in solved.output, solved.output + solved.errors)
    report = read_json(folder, "bar.json")["envelope"]
    check(report["file"] == "bar_envelope.vtkhdf" and report["load_cases"] == 4 and list(report["fields"]) == list(FIELDS), report)
    for name, (of, extreme) in FIELDS.items():
        each = read(os.path.join(folder, "bar.vtkhdf"), of)
        each = np.linalg.norm(each, axis=2) if of == "displacement" else each[:, :, 0] if each.ndim == 3 else each
        found = read(os.path.join(folder, "bar_envelope.vtkhdf"), name)[0]
        by = read(os.path.join(folder, "bar_envelope.vtkhdf"), name + "_case")[0]
        check(np.allclose(found, extreme(each, axis=0), rtol=1e-12, atol=0), f"{name} on {ranks} ranks")
        fails = (found < 1e9) if "factor" in name else np.full(found.shape, True)
        check((by[fails] > 0).all() and (by[~fails] == 0).all(), f"{name}: {by}")
        check(np.allclose(np.choose(by[fails] - 1, each[:, fails]), found[fails], rtol=1e-12, atol=0), f"{name}: who governs")
        told = report["fields"][name]
        check(told["value"] == extreme(found) and NAMES[by[np.argwhere(found == told["value"])[0, 0]] - 1] == told["load_case"], f"{name}: {told}")
        for k, case in enumerate(NAMES):
            check(abs(told["governs"][case] - np.mean(by[fails] == k + 1)) < 1e-12, f"{name}: {case}, {told}")
    check(len({told["load_case"] for told in report["fields"].values()}) > 1, f"one case governs all: {report}")
with h5py.File(os.path.join(folder, "bar_envelope.vtkhdf"), "r") as file:
    array = file["VTKHDF/CellData/largest_von_mises"]
    check({"Unit", "Description"} <= set(array.attrs), dict(array.attrs))

# --- fields that are not written, another ending, and what has no strengths ---
write(folder, "plain.yaml", CASE.replace(", strengths: {tension: 5, compression: 9}", "").split(", fields:")[0] + ", fields: [displacement]}\n"
      + CASE[CASE.index("cases:"):])
run("solve", "plain.yaml", "-q", "-o", "plain.vtu", "--json", "plain.json", folder=folder)
told = read_json(folder, "plain.json")["envelope"]
check(list(told["fields"]) == list(FIELDS)[:3] and os.path.exists(os.path.join(folder, "plain_envelope.vtu")), told)
check(abs(told["fields"]["largest_principal"]["value"] / report["fields"]["largest_principal"]["value"] - 1) < 1e-6, told)

# --- a case without an answer is left out; so are all ---
write(folder, "far.yaml", CASE.replace("title: a bar", "solver: {method: metric, coarsest_unknowns: 60, max_iterations: 1}")
      .replace("total_force: [2, 0, 0]", "total_force: [0, 0, 0]"))
failed = run("solve", "far.yaml", "--json", "far.json", folder=folder)
check(failed.exit_code == 1 and "envelope of 1 load case, " in failed.output, failed.output)
check("nothing fails" in failed.output, failed.output)
write(folder, "none.yaml", CASE.replace("title: a bar", "solver: {method: metric, coarsest_unknowns: 60, max_iterations: 1}")
      .replace("bar.vtkhdf", "none.vtkhdf"))
failed = run("solve", "none.yaml", "--json", "none.json", folder=folder)
check(failed.exit_code == 1 and "envelope of" not in failed.output, failed.output)
check(not os.path.exists(os.path.join(folder, "none_envelope.vtkhdf")), os.listdir(folder))

# --- mirrored loads differ by rounding alone: the first governs ---
write(folder, "mirror.yaml", CASE.replace("[-2.5, 0, 0]", "[-2, 0, 0]").replace("bar.vtkhdf", "mirror.vtkhdf"))
for ranks in fewer((1, 2)):
    run("solve", "mirror.yaml", "--json", "mirror.json", ranks=ranks, folder=folder)
    governs = read_json(folder, "mirror.json")["envelope"]["fields"]["largest_von_mises"]["governs"]
    check(governs["pull"] > 0 and governs["push"] == 0, governs)

# --- one of them alone has none, and makes none ---
run("solve", "mirror.yaml", "--case", "bend", "-o", "alone.vtkhdf", folder=folder)
check(not os.path.exists(os.path.join(folder, "alone_envelope.vtkhdf")), os.listdir(folder))
write(folder, "accurate.yaml", CASE.replace("title: a bar", "accuracy: {relative_error: 0.5}"))
accurate = run("solve", "accurate.yaml", "--case", "bend", "-o", "alone.vtkhdf", folder=folder)
check(accurate.exit_code == 0 and "no envelope is written: it is of all load cases, and --case takes 'bend'" in accurate.errors + accurate.output,
      accurate)
check(not os.path.exists(os.path.join(folder, "alone_envelope.vtkhdf")), os.listdir(folder))

for change, words in ((("cases:", "caseless:"), "unknown key 'caseless'"),
                      ((CASE[CASE.index("cases:"):], ""), "an envelope is of load cases, and there are none"),
                      (("envelope: true", "envelope: yes"), "unknown answer 'yes'"),
                      (("title: a bar", "accuracy: {relative_error: 0.1}"), "an envelope needs one mesh for all load cases"),
                      (("name: push", "name: Envelope"), "has the name of the load case 'Envelope', in line 12")):
    write(folder, "wrong.yaml", CASE.replace(*change))
    refused = run("check", "wrong.yaml", folder=folder)
    check(refused.exit_code == 2 and words in refused.errors, f"{change}: {refused.errors}")
