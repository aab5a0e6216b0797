"""Where solve writes: named before any work, refused where something would be lost; and what check says of it."""
import json
import os
import resource
import shutil
import signal
import subprocess

from program import PROGRAM, SANITIZED, check, new_folder, run, write

CASE = """mesh:
  block: {size: [2, 1, 1], divisions: [2, 1, 1]}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [0, 0, -1]}
"""


def read(folder, name):
    with open(os.path.join(folder, name), "rb") as stream:
        return stream.read()


def refused(folder, words, *arguments):
    """Refused in these words, once, with no file changed or left: on one rank, and with sanitizers on two."""
    before = {name: read(folder, name) for name in os.listdir(folder) if os.path.isfile(os.path.join(folder, name))}
    finished = run("solve", *arguments, ranks=2 if SANITIZED else 1, folder=folder)
    where = f"solve {' '.join(arguments)[:200]}: exit {finished.exit_code}\n{finished.errors}"
    check(finished.exit_code == 2, where)
    check(finished.errors.count("orthostat: error:") == 1, where)
    for word in words:
        check(word in finished.errors, f"no '{word}': {where}")
    for name, content in before.items():
        check(read(folder, name) == content, f"{name} was changed: {where}")
    check(not [name for name in os.listdir(folder) if name.startswith(".orthostat-")], f"a part was left: {where}")


def refuses_what_would_be_lost(folder):
    write(folder, "case.yaml", CASE)
    refused(folder, ["'case.yaml'", ".vtkhdf"], "case.yaml", "-o", "case.yaml")
    refused(folder, ["'fields.vtk'", ".vtkhdf"], "case.yaml", "-o", "fields.vtk")
    refused(folder, ["over the case itself"], "case.yaml", "--json", "case.yaml")
    refused(folder, ["over the case itself"], "case.yaml", "--json", "./folder/../case.yaml")
    os.symlink("case.yaml", os.path.join(folder, "to_case.json"))
    refused(folder, ["over the case itself"], "case.yaml", "--json", "to_case.json")
    shutil.copy(os.path.join(folder, "case.yaml"), os.path.join(folder, "case.vtkhdf"))
    refused(folder, ["over the case itself"], "case.vtkhdf")
    refused(folder, ["cannot both"], "case.yaml", "-o", "same.vtkhdf", "--json", "folder/../same.vtkhdf")
    refused(folder, ["'folder'", "not a regular file"], "case.yaml", "--json", "folder")
    refused(folder, ["'folder.vtkhdf'", "not a regular file"], "case.yaml", "-o", "folder.vtkhdf")
    refused(folder, ["'/dev/null'", "not a regular file"], "case.yaml", "--json", "/dev/null")
    refused(folder, ["names no file"], "case.yaml", "--json", "")


def refuses_folders_that_are_not_there(folder):
    refused(folder, ["folder 'nowhere'", "No such file"], "case.yaml", "-o", "nowhere/result.vtkhdf")
    refused(folder, ["folder 'nowhere'", "No such file"], "case.yaml", "--json", "nowhere//x.json")
    refused(folder, ["'case.yaml' is not a folder"], "case.yaml", "--json", "case.yaml/x.json")
    write(folder, "lost.yaml", CASE + "output: {file: nowhere/x.vtkhdf}\n")
    refused(folder, ["folder 'nowhere'"], "lost.yaml")
    if os.getuid() != 0:
        os.mkdir(os.path.join(folder, "shut"), 0o500)
        refused(folder, ["folder 'shut' is closed to writing"], "case.yaml", "--json", "shut/x.json")


def refuses_what_is_too_long(folder):
    refused(folder, ["letters, more than"], "case.yaml", "-o", "x" * 250 + ".vtkhdf")
    refused(folder, ["letters, more than"], "case.yaml", "--json", "./" * 2050 + "x.json")
    long = "c" * 249 + ".yaml"  # with another ending it would not fit
    write(folder, long, CASE)
    refused(folder, ["letters, more than"], long)
    os.remove(os.path.join(folder, long))
    # Open MPI alone would overrun a buffer where the path of the file of fields has some 230 letters and above.
    for ranks, fields in (1, "./" * 92 + "x.vtkhdf"), (2, "./" * 2025 + "y" * 200 + "/../x.vtkhdf"):
        os.makedirs(os.path.join(folder, "y" * 200), exist_ok=True)
        fields = fields[-4000:]
        finished = run("solve", "-q", "case.yaml", "-o", fields, "--json", "./" * 2025 + "x.json", ranks=ranks,
                       folder=folder)
        check(finished.exit_code == 0 and os.path.exists(os.path.join(folder, "x.vtkhdf")),
              f"a long path: {finished.errors}")
        check(not [name for name in os.listdir(folder) if name.startswith(".orthostat-")], "a part was left")
        os.remove(os.path.join(folder, "x.vtkhdf"))


def a_link_keeps_pointing(folder):
    """What it points to is replaced; and two links to one file are one output."""
    os.makedirs(os.path.join(folder, "elsewhere"))
    for ranks in 1, 2:
        for name in "linked.vtkhdf", "linked.json":
            if not os.path.lexists(os.path.join(folder, name)):
                os.symlink("elsewhere/" + name, os.path.join(folder, name))
        finished = run("solve", "-q", "case.yaml", "-o", "linked.vtkhdf", "--json", "linked.json", ranks=ranks,
                       folder=folder)
        check(finished.exit_code == 0, f"through links: {finished.errors}")
        check(sorted(os.listdir(os.path.join(folder, "elsewhere"))) == ["linked.json", "linked.vtkhdf"],
              f"through links: {os.listdir(os.path.join(folder, 'elsewhere'))}")
        check(os.path.islink(os.path.join(folder, "linked.vtkhdf")), "the link was replaced")
    os.symlink("new.vtkhdf", os.path.join(folder, "one.vtkhdf"))
    refused(folder, ["cannot both"], "case.yaml", "-o", "one.vtkhdf", "--json", "new.vtkhdf")
    os.symlink("nowhere/x", os.path.join(folder, "lost.json"))
    refused(folder, ["folder 'nowhere'", "No such file"], "case.yaml", "--json", "lost.json")


def refuses_the_mesh_it_reads(folder):
    finished = run("solve", "-q", "case.yaml", "-o", "mesh.vtkhdf", folder=folder)
    check(finished.exit_code == 0, f"a mesh to read: {finished.errors}")
    write(folder, "again.yaml", CASE.replace("block: {size: [2, 1, 1], divisions: [2, 1, 1]}", "file: mesh.vtkhdf"))
    finished = run("solve", "-q", "again.yaml", "--json", "again.json", ranks=2, folder=folder)
    check(finished.exit_code == 0, f"the mesh is read: {finished.errors}")
    refused(folder, ["over the mesh that the case reads"], "again.yaml", "-o", "mesh.vtkhdf")
    refused(folder, ["over the mesh that the case reads"], "again.yaml", "--json", "folder/../mesh.vtkhdf")
    write(folder, "held.bou", "1,2,3,4")
    write(folder, "listed.yaml", CASE.replace("boundary: xmin", "vertices: held.bou"))
    refused(folder, ["over a list of vertices that the case reads"], "listed.yaml", "--json", "held.bou")
    write(folder, "watched.yaml", CASE + "watch: {pull: {reaction: {vertices: held.bou}, component: x}}\n")
    refused(folder, ["over a list of vertices that the case reads"], "watched.yaml", "--json", "held.bou")


VEG = """*VERTICES
4 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
*INCLUDE parts/elements.txt
"""


def refuses_what_the_mesh_includes(folder):
    """Also two files deep."""
    os.mkdir(os.path.join(folder, "parts"))
    write(folder, "tet.veg", VEG)
    write(folder, "parts/elements.txt", "*ELEMENTS\nTET\n1 4 0\n1 1 2 3 4\n*INCLUDE deep.txt\n")
    write(folder, "parts/deep.txt", "# nothing more\n")
    write(folder, "tet.yaml", """mesh: {file: tet.veg}
constraints:
  - {on: {vertices: [1, 2, 3]}, displacement: [0, 0, 0]}
loads:
  - {on: {vertices: [4]}, point_force: [0, 0, -1]}
""")
    before = read(folder, "parts/elements.txt")
    refused(folder, ["over a file that the mesh includes"], "tet.yaml", "--json", "parts/elements.txt")
    refused(folder, ["over a file that the mesh includes"], "tet.yaml", "--json", "parts/deep.txt")
    for report in "--csv", "--json", "--picture":
        finished = run("cost", "tet.yaml", report, "parts/elements.txt", folder=folder)
        check(finished.exit_code == 2 and "over a file that the mesh includes" in finished.errors, f"{finished.errors}")
    check(read(folder, "parts/elements.txt") == before, "the included file was changed")
    finished = run("solve", "-q", "tet.yaml", "--json", "parts/other.txt", folder=folder)
    check(finished.exit_code == 0, f"beside an included file: {finished.errors}")


def a_full_disk_costs_no_result(folder):
    """A limit on the size of files stands for the disk; the signal that comes with it is ignored, as a disk sends none."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 17, 1 << 17))
    write(folder, "room.yaml", CASE)
    write(folder, "room.vtkhdf", "an earlier result")
    process = subprocess.run([PROGRAM, "solve", "room.yaml"], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit, restore_signals=False,
                             env={**os.environ, "OMPI_MCA_ess_singleton_isolated": "1"}, timeout=240)
    check(process.returncode == 2 and "MiB of disk space, which cannot be reserved: File too large" in process.stderr,
          f"a full disk: exit {process.returncode}\n{process.stderr}")
    check(read(folder, "room.vtkhdf") == b"an earlier result", "a full disk: the earlier result is gone")
    check(not [name for name in os.listdir(folder) if name.startswith(".orthostat-")], "a full disk: a part was left")


def check_says_where_it_goes(folder):
    finished = run("check", "case.yaml", folder=folder)
    check(finished.exit_code == 0 and not finished.errors, f"check: {finished.errors}")
    check("12 vertices, 12 tets, 1 region, 1 constraint on 4 vertices, 1 load\n" in finished.output
          and "to case.vtkhdf\n" in finished.output, f"check: {finished.output}")
    for command in "check", "explain":
        printed = run(command, "case.yaml", "--json", folder=folder).output
        finished = run(command, "case.yaml", "--json=found.json", folder=folder)
        check(finished.exit_code == 0 and not finished.output, f"{command}: {finished.output} {finished.errors}")
        with open(os.path.join(folder, "found.json")) as written:
            check(json.load(written).keys() == json.loads(printed).keys(), f"{command} --json=FILE: {printed}")
        finished = run(command, "--json", "found.json", "case.yaml", folder=folder)
        check(finished.exit_code == 2 and "say --json=found.json" in finished.errors, f"{command}: {finished.errors}")
        finished = run(command, "case.yaml", "--json=case.yaml", folder=folder)
        check(finished.exit_code == 2 and "case.yaml" in finished.errors, f"{command}: {finished.errors}")
        check(read(folder, "case.yaml") == CASE.encode(), f"{command}: the case was written over")
    finished = run("check", "lost.yaml", "--json", ranks=2, folder=folder)
    check(finished.exit_code == 0, f"check --json: {finished.errors}")
    found = json.loads(finished.output)
    check(found["vertices"] == 12 and found["tets"] == 12 and found["regions"] == ["block"], f"check --json: {found}")
    check(sorted(found["boundaries"]) == ["xmax", "xmin", "ymax", "ymin", "zmax", "zmin"], f"check --json: {found}")
    check(found["output"] == "nowhere/x.vtkhdf" and len(found["warnings"]) == 1 and "'nowhere'" in found["warnings"][0],
          f"check --json: {found}")


def a_body_at_rest_is_pointed_out(folder):
    write(folder, "rest.yaml", CASE[:CASE.index("loads:")] + "cases: [{name: full, " + CASE[CASE.index("loads:"):].replace(
        "\n  - ", " [").rstrip() + "]}, {name: none}]\n")
    with open(os.path.join(folder, "log"), "w+", encoding="utf-8") as log:
        subprocess.run([PROGRAM, "solve", "rest.yaml"], cwd=folder, stdout=log, stderr=log, timeout=240, check=True)
        log.seek(0)
        text = log.read()
    check(text.index("untitled: full") < text.index("\northostat: warning: rest.yaml: nothing acts on the body in load case 'none'")
          < text.index("untitled: none"), f"the log: {text}")
    write(folder, "rest.yaml", CASE[:CASE.index("loads:")])
    finished = run("solve", "rest.yaml", folder=folder)
    check(finished.exit_code == 0 and finished.errors.count("nothing acts on the body") == 1, f"{finished.errors}")
    for cases, words in (("", "nothing acts on the body:"), (", cases=[{name: one}]", "nothing acts on the body in load case 'one'")):
        asked = run("solve", "rest.yaml", "--set", "accuracy.relative_error=0.1", *(["--set", cases[2:]] if cases else []), folder=folder)
        check(asked.exit_code == 0 and asked.errors.count(words) == 1, f"an accuracy asked for: {asked.errors}")
    found = json.loads(run("check", "-q", "rest.yaml", "--json", folder=folder).output)
    check(len(found["warnings"]) == 1 and "nothing acts on the body" in found["warnings"][0], f"{found}")
    write(folder, "moved.yaml", CASE[:CASE.index("loads:")] +
          "  - {on: {boundary: xmax}, displacement: [0.1, free, free]}\n")
    finished = run("solve", "moved.yaml", folder=folder)
    check(finished.exit_code == 0 and not finished.errors, f"a displacement acts: {finished.errors}")


def a_place_between_vertices_is_pointed_out(folder):
    """What is watched there is the nearest vertex: solve and check say which."""
    write(folder, "watch.yaml", CASE + "watch: {tip: {displacement: {nearest: [2, 0.5, 0.5]}, component: z}}\n")
    for command in "solve", "check":
        finished = run(command, "watch.yaml", ranks=2, folder=folder)
        check(finished.exit_code == 0 and finished.errors.count("'tip' is taken at (2, ") == 1,
              f"{command}: {finished.errors}")
    write(folder, "watch.yaml", CASE + "watch: {tip: {displacement: {nearest: [2, 1, 1]}, component: z}}\n")
    check(not run("solve", "watch.yaml", folder=folder).errors, "a vertex is watched where it lies")
    write(folder, "slip.yaml", CASE.replace("boundary: xmax", "nearest: [20, 0, 0]"))
    for command in "solve", "check":
        finished = run(command, "slip.yaml", ranks=2, folder=folder)
        check(finished.exit_code == 0 and finished.errors.count("slip.yaml:8:20: the vertex nearest to (20, 0, 0)") == 1,
              f"{command}: {finished.errors}")


def main():
    folder = new_folder()
    os.mkdir(os.path.join(folder, "folder"))
    os.mkdir(os.path.join(folder, "folder.vtkhdf"))
    refuses_what_would_be_lost(folder)
    refuses_folders_that_are_not_there(folder)
    refuses_what_is_too_long(folder)
    a_link_keeps_pointing(folder)
    refuses_the_mesh_it_reads(folder)
    refuses_what_the_mesh_includes(folder)
    a_full_disk_costs_no_result(folder)
    check_says_where_it_goes(folder)
    a_body_at_rest_is_pointed_out(folder)
    a_place_between_vertices_is_pointed_out(folder)


main()
