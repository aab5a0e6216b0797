"""scripts/orthostat: words in any order, standard input left to its caller, and a full standard output."""
import os
import shutil
import signal
import subprocess

from program import SOURCE, check, new_folder

# Programs that say how they were called; like the real one, mpirun reads what stands in standard input.
MPIRUN = "#!/bin/sh\necho mpirun \"$@\"\ncat\n"
PROGRAM = "#!/bin/sh\necho alone \"$@\"\n"


def write_program(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as stream:
        stream.write(text)
    os.chmod(path, 0o755)
    return path


def make_script(folder):
    """The script, beside an environment in which nothing needs to be built."""
    script = os.path.join(folder, "scripts", "orthostat")
    write_program(os.path.join(folder, "scripts", "environment"),
                  f"cores=3 build={folder}/bin PATH={folder}/path:$PATH\nbuild_program() {{ :; }}\n")
    write_program(os.path.join(folder, "path", "mpirun"), MPIRUN)
    for name in ("orthostat", "batch-ranks"):
        shutil.copy(os.path.join(SOURCE, "scripts", name), os.path.join(folder, "scripts", name))
    return script, write_program(os.path.join(folder, "bin", "orthostat"), PROGRAM)


def call(script, words, given="", output=subprocess.PIPE, job=None):
    return subprocess.run(["bash", script, *words.split()], text=True, input=given, stdout=output,
                          stderr=subprocess.PIPE, timeout=60, env={**os.environ, **(job or {})})


def takes_words_in_any_order(script, program):
    for words, expected in [
            ("-q -n 2 solve a.yaml -v", f"mpirun -n 2 {program} -q solve a.yaml -v"),
            ("-n 2 -v -q check a.yaml", f"mpirun -n 2 {program} -v -q check a.yaml"),
            ("solve -n", f"mpirun -n 3 {program} solve -n"),
            ("-v material x", "alone -v material x"),
            ("-q --help", "alone -q --help"),
            ("-n 2", "alone")]:
        said = call(script, words).stdout.strip()
        check(said == expected, f"scripts/orthostat {words}: {said}")
    refused = call(script, "-n 49 check a.yaml")
    check(refused.returncode == 2 and "-n 49 is far more ranks than the 3 cores" in refused.stderr and
          refused.stdout == "", f"49 ranks on 3 cores: {refused}")


def takes_its_ranks_from_the_batch_system(folder, script, program):
    nodes = os.path.join(folder, "nodes")
    with open(nodes, "w") as stream:
        stream.write("one\n" * 40 + "two\n" * 40)
    slurm = {"SLURM_JOB_ID": "7"}
    for job, ranks in [
            ({**slurm, "SLURM_NTASKS": "128", "SLURM_JOB_CPUS_PER_NODE": "64(x2)"}, 128),
            ({**slurm, "SLURM_JOB_NUM_NODES": "4", "SLURM_NTASKS_PER_NODE": "32"}, 128),
            ({**slurm, "SLURM_JOB_CPUS_PER_NODE": "32(x3),16"}, 112),
            ({**slurm, "SLURM_JOB_CPUS_PER_NODE": "32(x3),16", "SLURM_CPUS_PER_TASK": "2"}, 56),
            ({"PBS_NP": "96"}, 96), ({"PBS_NODEFILE": nodes}, 80), ({"LSB_DJOB_NUMPROC": "24"}, 24),
            ({"JOB_ID": "7", "NSLOTS": "12"}, 12), ({"FLUX_JOB_ID": "f1", "FLUX_JOB_SIZE": "48"}, 48), ({}, 3)]:
        said = call(script, "solve a.yaml", job=job).stdout.strip()
        check(said == f"mpirun -n {ranks} {program} solve a.yaml", f"{job}: {said}")
    said = call(script, "-n 256 solve a", job={**slurm, "SLURM_NTASKS": "256"}).stdout.strip()
    check(said == f"mpirun -n 256 {program} solve a", f"-n 256 in a job: {said}")
    said = call(script, "scale a --ranks 1,2").stdout.strip()
    check(said == "alone scale a --ranks 1,2", f"scale starts its ranks itself: {said}")
    said = call(script, "scale a", job={**slurm, "SLURM_NTASKS": "8"}).stdout.strip()
    check(said == f"mpirun -n 8 {program} scale a", f"scale in a job: {said}")


def the_slurm_job_runs_the_case(folder):
    job = os.path.join(SOURCE, "examples", "cluster", "orthostat.sbatch")
    place = {"PATH": f"{folder}/path:{os.environ['PATH']}", "SLURM_JOB_ID": "7", "SCRATCH": folder, "HOME": folder}
    said = subprocess.run(["bash", job, "cases/a.yaml", "--quiet"], text=True, stdout=subprocess.PIPE, input="",
                          env={**os.environ, **place}, timeout=60)
    results = os.path.join(folder, "orthostat-7")
    check(said.returncode == 0 and said.stdout.strip() ==
          f"mpirun --map-by core --bind-to core orthostat solve cases/a.yaml --output {results}/a.vtkhdf --json "
          f"{results}/a.json --quiet" and os.path.isdir(results), f"the job: {said}")
    said = subprocess.run(["bash", job], text=True, capture_output=True, env={**os.environ, **place}, timeout=60)
    check(said.returncode != 0 and "Usage: sbatch" in said.stderr, f"a job without a case: {said}")


def leaves_standard_input_alone(script):
    """A loop over a list goes through all of it; a case from standard input arrives."""
    loop = f"printf 'a\\nb\\nc\\n' | while read name; do bash {script} solve $name --json -; done"
    said = subprocess.run(["bash", "-c", loop], text=True, stdout=subprocess.PIPE, timeout=60).stdout
    check(all(f"solve {name} --json -" in said for name in "abc"), f"a loop over a, b and c: {said}")
    for words, reads in [("solve -", True), ("solve -q - --json -", True), ("check --json -", True),
                         ("solve /dev/stdin", True), ("solve a --json -", False), ("cost a -c -", False)]:
        said = call(script, words, given="the case").stdout
        check(("the case" in said) == reads, f"{words}: {said}")


def a_full_disk_is_no_success(script):
    """mpirun takes no notice of it."""
    with open("/dev/full", "w") as full:
        for words in "solve a", "solve --help", "check a --json":
            ended = call(script, words, output=full)
            check(ended.returncode == 2 and "standard output could not be written" in ended.stderr,
                  f"{words} > /dev/full: exit {ended.returncode}, {ended.stderr}")
    with open(os.path.join(os.path.dirname(script), "said"), "w+") as stream:
        ended = call(script, "solve a", output=stream)
        stream.seek(0)
        check(ended.returncode == 0 and not ended.stderr and stream.read().endswith("solve a\n"), f"to a file: {ended}")


def passes_on_the_exit_status(folder, script):
    write_program(os.path.join(folder, "path", "mpirun"), "#!/bin/sh\nexit 7\n")
    with open(os.devnull, "w") as nowhere:
        for output in subprocess.PIPE, nowhere:
            check(call(script, "solve a", output=output).returncode == 7, "the program's exit status")


# Like the real one, mpirun ends its ranks before they can speak, if it is asked to.
SLOW = """#!/bin/sh
sh -c 'trap "echo the rank stops >&2; exit 130" TERM; echo up; for _ in $(seq 1200); do sleep 0.05; done' &
trap 'kill -9 $!; echo mpirun stops >&2; exit 1' INT TERM
wait $!
"""


def lets_ranks_say_that_they_were_interrupted(folder, script):
    """Ctrl-C reaches all processes of the terminal's group."""
    write_program(os.path.join(folder, "path", "mpirun"), SLOW)
    for number in signal.SIGINT, signal.SIGTERM:
        running = subprocess.Popen(["bash", script, "solve", "a"], text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, start_new_session=True,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        check(running.stdout.readline() == "up\n", "the rank does not start")
        os.killpg(running.pid, number)
        _, errors = running.communicate(timeout=60)
        check(running.returncode == 130 and errors == "the rank stops\n", f"{number}: exit {running.returncode}, {errors}")


def main():
    folder = new_folder()
    script, program = make_script(folder)
    takes_words_in_any_order(script, program)
    takes_its_ranks_from_the_batch_system(folder, script, program)
    the_slurm_job_runs_the_case(folder)
    leaves_standard_input_alone(script)
    a_full_disk_is_no_success(script)
    passes_on_the_exit_status(folder, script)
    lets_ranks_say_that_they_were_interrupted(folder, script)


main()
