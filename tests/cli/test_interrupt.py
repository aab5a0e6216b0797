"""Long work shows itself on a terminal, and can be interrupted: it says so, ends with 130, and leaves no half of a file."""
import os
import pty
import signal
import subprocess
import time
import types

from program import MPIEXEC, PROGRAM, check, new_folder, write

CASE = """mesh: {block: {size: [4, 1, 1], divisions: [120, 30, 30]}}
materials: [{region: all, youngs_modulus: [1000, 2000, 4000], poissons_ratio: 0.3}]
constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]
loads: [{on: {boundary: xmax}, total_force: [2, 0, 0]}]
output: {file: bar.vtkhdf}
"""
os.environ.pop("OMPI_MCA_odls_base_sigkill_timeout", None)  # of the tests: mpirun would kill ranks before they can speak
folder = new_folder()
write(folder, "bar.yaml", CASE)


def ranks_of(process):
    """The processes of the program that mpirun has started."""
    found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True).stdout.split()
    return [int(pid) for pid in found]


def listens(pid):
    """Does the process handle SIGTERM yet?"""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as stream:
            caught = next(line for line in stream if line.startswith("SigCgt:"))
    except (OSError, StopIteration):
        return False
    return int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1 == 1


def wait_for(process, ranks):
    """Until all ranks are at work; a busy machine takes its time."""
    for _ in range(600):
        pids = ranks_of(process) if ranks > 1 else [process.pid]
        if len(pids) == ranks and all(map(listens, pids)):
            return
        time.sleep(0.05)
    check(False, "the ranks do not start")


def interrupt(command, number, of_rank):
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True)
    wait_for(process, int(command[command.index("-n") + 1]) if "-n" in command else 1)
    time.sleep(0.5)
    check(process.poll() is None, "the run ended before it could be interrupted")
    os.kill(ranks_of(process)[0] if of_rank else process.pid, number)
    output, errors = process.communicate(timeout=60)
    check("orthostat: interrupted, nothing written" in errors and not output, errors + output)
    check(os.listdir(folder) == ["bar.yaml"], os.listdir(folder))
    return process.returncode


for number in signal.SIGINT, signal.SIGTERM:
    code = interrupt([PROGRAM, "solve", "bar.yaml"], number, False)
    check(code == 130, f"signal {number}: exit {code}")
for ranks in 2, 4:
    interrupt([MPIEXEC, "-n", str(ranks), PROGRAM, "solve", "bar.yaml"], signal.SIGINT, False)
code = interrupt([MPIEXEC, "-n", "2", PROGRAM, "solve", "bar.yaml"], signal.SIGTERM, True)
check(code == 130, f"a rank ended with 130, mpirun with {code}")

def interrupt_on_terminal(command, ranks):
    """Ctrl-C typed on a terminal."""
    pid, ours = pty.fork()
    if pid == 0:
        os.chdir(folder)
        os.execvp(command[0], command)
    wait_for(types.SimpleNamespace(pid=pid), ranks)
    time.sleep(0.5)
    os.write(ours, b"\x03")
    seen = b""
    try:
        while more := os.read(ours, 4096):
            seen += more
    except OSError:
        pass
    check(b"orthostat: interrupted, nothing written" in seen, seen.decode())
    check(os.listdir(folder) == ["bar.yaml"], os.listdir(folder))
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


code = interrupt_on_terminal([PROGRAM, "solve", "bar.yaml"], 1)
check(code == 130, f"Ctrl-C: exit {code}")
code = interrupt_on_terminal([MPIEXEC, "-n", "2", PROGRAM, "solve", "bar.yaml"], 2)
check(code != 0, f"Ctrl-C under mpirun: exit {code}")  # 1 of Open MPI 4, whatever the ranks end with

# --- a file that is half written goes, one that is complete stays ---
write(folder, "many.yaml", CASE.replace("[120, 30, 30]", "[60, 16, 16]") + "path: {steps: 200}\nlarge_rotation: off\n")
process = subprocess.Popen([PROGRAM, "solve", "many.yaml", "-q"], cwd=folder, stderr=subprocess.PIPE, text=True)
first = os.path.join(folder, "bar_0002.vtkhdf")
for _ in range(2400):
    if os.path.exists(first):
        break
    time.sleep(0.05)
process.send_signal(signal.SIGINT)
errors = process.communicate(timeout=60)[1]
check(process.returncode == 130 and "the files that were complete stay" in errors, f"exit {process.returncode}: {errors}")
check(os.path.exists(first) and not [name for name in os.listdir(folder) if name.startswith(".orthostat")], os.listdir(folder))

# --- a sweep leaves the runs that ended ---
process = subprocess.Popen([PROGRAM, "sweep", "bar.yaml", "-q", "--over", "mesh.block.divisions=[4,1,1],[120,30,30]", "--csv", "bar.csv"],
                           cwd=folder, stderr=subprocess.PIPE, text=True)
rows = os.path.join(folder, "bar.csv")
for _ in range(2400):
    if os.path.exists(rows):
        break
    time.sleep(0.05)
process.send_signal(signal.SIGINT)
errors = process.communicate(timeout=60)[1]
check(process.returncode == 130 and "the files that were complete stay" in errors, f"exit {process.returncode}: {errors}")
with open(rows, encoding="utf-8") as stream:
    check([line.split('"')[1] for line in stream] == ["mesh.block.divisions", "[4,1,1]"], "the run that ended")

# --- the line on a terminal ---
def on_terminal(*words):
    ours, theirs = pty.openpty()
    process = subprocess.Popen([PROGRAM, "solve", "bar.yaml", "-o", "seen.vtkhdf", *words], cwd=folder, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    seen = b""
    while True:
        try:
            more = os.read(ours, 4096)
        except OSError:
            break
        if not more:
            break
        seen += more
    check(process.wait() == 0, seen)
    return seen.decode()


seen = on_terminal()
for words in ("% of the whole", "solve ", "multigrid setup"):  # others may be over before the line is drawn again
    check(words in seen, f"the terminal shows nothing of '{words}': {seen[-2000:]}")
check(seen.count("\n") <= 2 and seen.rstrip("\n").endswith("\x1b[K"), "the line is not erased at the end: " + repr(seen[-200:]))
write(folder, "bar.yaml", CASE.replace("[120, 30, 30]", "[60, 16, 16]"))
check(on_terminal("-q") == "", "-q shows something")
