"""scripts/orthostat: words in any order, standard input left to its caller, and a full standard output."""
import os
import shutil
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
    shutil.copy(os.path.join(SOURCE, "scripts", "orthostat"), script)
    return script, write_program(os.path.join(folder, "bin", "orthostat"), PROGRAM)


def call(script, words, given="", output=subprocess.PIPE):
    return subprocess.run(["bash", script, *words.split()], text=True, input=given, stdout=output,
                          stderr=subprocess.PIPE, timeout=60)


def takes_words_in_any_order(script, program):
    for words, expected in [
            ("-q -n 2 solve a.yaml -v", f"mpirun --quiet -n 2 {program} -q solve a.yaml -v"),
            ("-n 2 -v -q check a.yaml", f"mpirun --quiet -n 2 {program} -v -q check a.yaml"),
            ("solve -n", f"mpirun --quiet -n 3 {program} solve -n"),
            ("-v material x", "alone -v material x"),
            ("-q --help", "alone -q --help"),
            ("-n 2", "alone")]:
        said = call(script, words).stdout.strip()
        check(said == expected, f"scripts/orthostat {words}: {said}")
    refused = call(script, "-n 49 check a.yaml")
    check(refused.returncode == 2 and "-n 49 is far more ranks than the 3 cores" in refused.stderr and
          refused.stdout == "", f"49 ranks on 3 cores: {refused}")


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


def main():
    folder = new_folder()
    script, program = make_script(folder)
    takes_words_in_any_order(script, program)
    leaves_standard_input_alone(script)
    a_full_disk_is_no_success(script)
    passes_on_the_exit_status(folder, script)


main()
