"""Under a limit of address space (ulimit -v) the program works or says what is short; OpenBLAS would wait for ever."""
import resource
import subprocess

from program import PROGRAM, check, new_folder, write

CASE = """mesh:
  block: {size: [2, 1, 1], divisions: [16, 16, 16]}
materials:
  - {region: all, youngs_modulus: 1000, poissons_ratio: 0.3}
constraints:
  - {on: {boundary: xmin}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: xmax}, total_force: [10, 0, 0]}
solver: {method: direct}
"""
MIB = 1 << 20


def solve_within(mebibytes, folder):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (mebibytes * MIB, mebibytes * MIB))
    return subprocess.run([PROGRAM, "solve", "case.yaml", "-q"], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit, timeout=60)


def main():
    folder = new_folder()
    write(folder, "case.yaml", CASE)
    for mebibytes in 250, 400, 500:
        ended = solve_within(mebibytes, folder)
        check(ended.returncode == 1 and "512 MiB of address space" in ended.stderr
              and f"ulimit -v is {1024 * mebibytes} KiB" in ended.stderr, f"{mebibytes} MiB: {ended}")
    for mebibytes in 650, 700, 1500:
        ended = solve_within(mebibytes, folder)
        check(ended.returncode == 0 or (ended.returncode == 1 and "memory" in ended.stderr), f"{mebibytes} MiB: {ended}")
    check(ended.returncode == 0, f"1500 MiB is enough: {ended}")


main()
