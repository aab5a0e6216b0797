#!/usr/bin/env bash
# What cmake --install leaves is all that another project needs: the examples are built on it through CMake and through
# pkg-config, and run.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sanitizers=""
grep -q '^ORTHOSTAT_SANITIZE:BOOL=ON' "$ORTHOSTAT_BUILD/CMakeCache.txt" && sanitizers="-fsanitize=address,undefined"
warnings="-std=c11 -Wall -Wextra -Wshadow -Wconversion -Werror"

cmake --install "$ORTHOSTAT_BUILD" --prefix "$folder/usr" >/dev/null
cmake -S "$ORTHOSTAT_SOURCE/examples" -B "$folder/by-cmake" -DCMAKE_PREFIX_PATH="$folder/usr" \
    -DCMAKE_C_FLAGS="$warnings $sanitizers" >/dev/null
cmake --build "$folder/by-cmake" >/dev/null

PKG_CONFIG_PATH=$(dirname "$(find "$folder/usr" -name orthostat.pc)")
export PKG_CONFIG_PATH
cp -r "$ORTHOSTAT_SOURCE/examples" "$folder/by-pkg-config"
make -C "$folder/by-pkg-config" CC="cc $sanitizers" >/dev/null

fail() {
    echo "$1" >&2
    exit 1
}

# The answers are the same however the program was linked, and on however many ranks; times and iterations are not.
cd "$folder"
for ranks in 1 2; do
    for build in by-cmake by-pkg-config; do
        "$ORTHOSTAT_MPIEXEC" -n $ranks $build/solve_case "$ORTHOSTAT_SOURCE/cases/block/sliding.yaml" sliding.vtkhdf
        "$ORTHOSTAT_MPIEXEC" -n $ranks $build/own_mesh
        "$ORTHOSTAT_MPIEXEC" -n $ranks $build/ten_loads | sed 's/,.*//'
    done >"answers-$ranks"
done
"$ORTHOSTAT_MPIEXEC" -n 2 by-pkg-config/formulations >formulations
diff answers-1 answers-2 || fail "the answers differ between 1 and 2 ranks"
half=$(($(wc -l <answers-1) / 2))
diff <(head -n $half answers-1) <(tail -n $half answers-1) || fail "the answers differ between CMake and pkg-config"
cat answers-1
grep -q 'moves by 0.00106536 at most, at (2, 1, 1)' answers-1 || fail "solve_case: another answer"
grep -q 'straight grain: 0.0105.*1\.6. times as far' answers-1 || fail "own_mesh: another answer"
[ "$(grep -c 'degrees: moves by' answers-1)" = 20 ] || fail "ten_loads: not ten answers"
[ "$(grep -c '^| 10* |' formulations)" = 4 ] || fail "formulations: not four rows"
[ -s sliding.vtkhdf ] && [ -s own_mesh.vtkhdf ] || fail "the examples wrote no files"

# C++ may use the headers, and every function that they declare is there to be linked.
# shellcheck disable=SC2046
echo '#include <orthostat/orthostat.h>' |
    c++ -x c++ -std=c++11 -Wall -Wextra -pedantic -Werror -DOMPI_SKIP_MPICXX $(pkg-config --cflags orthostat) -fsyntax-only -
# shellcheck disable=SC2046
cc -E -P $(pkg-config --cflags orthostat) "$folder/usr/include/orthostat/orthostat.h" |
    grep -oE '\bost_[a-z0-9_]+ *\(' | tr -d ' (' | sort -u >declared
library=$(find "$folder/usr" -name 'liborthostat.so' -o -name 'liborthostat.a')
case $library in
*.so)
    nm -D --defined-only "$library" | awk '{ print $3 }' | sort -u >offered
    diff declared offered || fail "the library offers other functions than its headers declare"
    ;;
*)
    nm --defined-only "$library" 2>/dev/null | awk 'NF == 3 { print $3 }' | sort -u >offered
    [ -z "$(comm -23 declared offered)" ] || fail "declared, but not in the library: $(comm -23 declared offered)"
    ;;
esac

# Python finds the package and, from there, the library of the same prefix.
case $library in
*.so)
    PYTHONPATH=$folder/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - <<END
import orthostat
result = orthostat.solve("$folder/usr/share/orthostat/cases/block/sliding.yaml")
assert abs(result.largest_displacement / 0.00106536 - 1) < 1e-5, result
assert "$folder/usr/" in open("/proc/self/maps").read(), "another library was loaded"
END
    ;;
esac

"$folder/usr/bin/orthostat" --version | grep -q '^orthostat '
