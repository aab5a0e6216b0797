"""The Python package out of the build tree: on one rank and on two, with mpi4py and without."""
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "docs"))
from drawn import check_drawn, pictures  # noqa: E402
from pages import blocks_of, check, read  # noqa: E402

BUILD, SOURCE, MPIEXEC = (os.environ[name] for name in ("ORTHOSTAT_BUILD", "ORTHOSTAT_SOURCE", "ORTHOSTAT_MPIEXEC"))
HERE = os.path.dirname(os.path.abspath(__file__))


def call(*command, folder):
    environment = {**os.environ, "PYTHONPATH": os.path.join(BUILD, "python"), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(command, env=environment, cwd=folder, text=True, timeout=120, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def run(*command, folder):
    process = call(*command, folder=folder)
    check(process.returncode == 0, f"{' '.join(command)}\n{process.stdout}\n{process.stderr}")
    return process.stdout


with tempfile.TemporaryDirectory(prefix="orthostat-") as scratch:
    for ranks, mpi in (1, "none"), (2, "mpi4py"):
        start = [MPIEXEC, "-n", str(ranks)] if ranks > 1 else []
        said = run(*start, sys.executable, os.path.join(HERE, "on_ranks.py"), mpi, scratch, folder=scratch)
        check(said == "done\n", f"on {ranks} ranks it said: {said}")

    # What the page shows runs as it stands, from top to bottom.
    page = os.path.join(scratch, "page.py")
    with open(page, "w", encoding="utf-8") as stream:
        stream.write("\n".join(blocks_of(read("docs", "python.md"), "python")))
    said = run(sys.executable, page, folder=scratch)
    check("did you mean 'loads'" in said and os.path.exists(os.path.join(scratch, "beam.vtkhdf")), said)

    # The example, and its picture.
    picture = os.path.join(scratch, "spiral.png")
    said = run(MPIEXEC, "-n", "2", sys.executable, os.path.join(SOURCE, pictures.SPIRAL), "--picture", picture,
               folder=scratch)
    check_drawn("spiral-grain.png", pictures.numbers_of_spiral(said), 0.01, "python")
    check(os.path.getsize(picture) > 10000, "no picture")

    # A rank that fails alone does not leave the others waiting.
    lonely = os.path.join(scratch, "lonely.py")
    with open(lonely, "w", encoding="utf-8") as stream:
        stream.write("import orthostat\ncontext = orthostat.Context()\n1 / context.rank\ncontext.gather([1])\n")
    failed = call(MPIEXEC, "-n", "2", sys.executable, lonely, folder=scratch)
    check(failed.returncode == 1 and "ZeroDivisionError" in failed.stderr, failed.stderr)
