#!/usr/bin/env bash
# The Debian package is made, and what lies in it is all that others need: the program solves from another folder, examples
# are built on it through CMake and through pkg-config, Python finds its package, man its pages, bash its completion.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
sanitizers=""
grep -q '^ORTHOSTAT_SANITIZE:BOOL=ON' "$ORTHOSTAT_BUILD/CMakeCache.txt" && sanitizers="-fsanitize=address,undefined"
warnings="-std=c11 -Wall -Wextra -Wshadow -Wconversion -Werror"

fail() {
    echo "$1" >&2
    exit 1
}

# --- the package; everything is built already, and Ninja is not asked to look ---

make_package() {
    cpack --config "$ORTHOSTAT_BUILD/CPackConfig.cmake" -B "$folder/cpack" -D CPACK_CMAKE_GENERATOR=Ninja \
        -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >"$folder/cpack.log" 2>&1 ||
        fail "$(cat "$folder/cpack.log")"
    version=$(sed -nE 's/^project\(orthostat VERSION ([0-9.]+).*/\1/p' "$ORTHOSTAT_SOURCE/CMakeLists.txt")
    package=$folder/cpack/orthostat_${version}_$(dpkg --print-architecture).deb
    [ "$(dpkg-deb --field "$package" Version)" = "$version" ] || fail "the package is not of version $version"
    dpkg-deb --field "$package" Depends | tr ',' '\n' | sed 's/ *(.*//; s/^ *//' >"$folder/depends"
    for needed in openmpi-bin libc6 libopenmpi libhdf5-openmpi libmumps libmetis5 libtrilinos-ml libyaml; do
        grep -q "^$needed" "$folder/depends" || fail "the package does not depend on $needed: $(tr '\n' ' ' <"$folder/depends")"
    done
    while read -r needed; do # libopenblas0 stands for any of libopenblas0-serial, -pthread and -openmp
        dpkg-query -W "$needed*" >/dev/null || fail "the package depends on $needed, by which it was not built"
    done <"$folder/depends"
    dpkg-deb -x "$package" "$folder"
}
if [ -z "$sanitizers" ]; then
    make_package
else # others build on the static library; what else is packaged is the same
    cmake --install "$ORTHOSTAT_BUILD" --prefix "$folder/usr" >/dev/null
fi

# --- other projects ---

PKG_CONFIG_PATH=$(dirname "$(find "$folder/usr" -name orthostat.pc)")
export PKG_CONFIG_PATH
cp -r "$ORTHOSTAT_SOURCE/examples" "$folder/by-pkg-config"
make -C "$folder/by-pkg-config" CC="cc $sanitizers" >/dev/null
cmake -S "$ORTHOSTAT_SOURCE/examples" -B "$folder/by-cmake" -DCMAKE_PREFIX_PATH="$folder/usr" \
    -DCMAKE_C_FLAGS="$warnings $sanitizers" >/dev/null
cmake --build "$folder/by-cmake" >/dev/null

# The answers are the same however the program was linked, and on however many ranks; times and iterations are not.
cd "$folder"
answers() { # RANKS FOLDER
    "$ORTHOSTAT_MPIEXEC" -n "$1" "$2/solve_case" "$ORTHOSTAT_SOURCE/cases/block/sliding.yaml" sliding.vtkhdf
    "$ORTHOSTAT_MPIEXEC" -n "$1" "$2/own_mesh"
    [ -n "$sanitizers" ] || "$ORTHOSTAT_MPIEXEC" -n "$1" "$2/ten_loads" | sed 's/,.*//'
}
answers 1 by-pkg-config >answers-pkg-config
answers 2 by-cmake >answers-cmake
diff answers-pkg-config answers-cmake || fail "the answers differ between pkg-config on 1 rank and CMake on 2"
cat answers-cmake
grep -q 'moves by 0.00106536 at most, at (2, 1, 1)' answers-cmake || fail "solve_case: another answer"
grep -q 'straight grain: 0.0105.*1\.6. times as far' answers-cmake || fail "own_mesh: another answer"
if [ -z "$sanitizers" ]; then # these take long with them, and call little that the others do not
    [ "$(grep -c 'degrees: moves by' answers-cmake)" = 10 ] || fail "ten_loads: not ten answers"
    "$ORTHOSTAT_MPIEXEC" -n 2 by-pkg-config/formulations >formulations
    [ "$(grep -c '^| 10* |' formulations)" = 4 ] || fail "formulations: not four rows"
fi
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

# --- users ---

[ -z "$sanitizers" ] || exit 0

"$folder/usr/bin/orthostat" --version | grep -qx "orthostat $version" || fail "the program is not of version $version"
"$folder/usr/bin/orthostat" solve usr/share/orthostat/cases/block/sliding.yaml --quiet --output users.vtkhdf
[ -s users.vtkhdf ] || fail "the program wrote nothing"

# Python finds the package and, from there, the library of the same prefix.
case $library in
*.so)
    PYTHONPATH=$folder/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - <<END
import orthostat
result = orthostat.solve("usr/share/orthostat/cases/block/sliding.yaml")
assert abs(result.largest_displacement / 0.00106536 - 1) < 1e-5, result
assert "$folder/usr/" in open("/proc/self/maps").read(), "another library was loaded"
END
    ;;
esac

# Each command has a page with its options, and each option has a word for bash.
mapfile -t commands < <("$folder/usr/bin/orthostat" --help | sed -nE 's/^  ([a-z]+) .*/\1/p')
for command in "${commands[@]}"; do
    zcat "usr/share/man/man1/orthostat-$command.1.gz" | sed 's/\\-/-/g; s/\\fR//g' >"page-$command"
    grep -q "^orthostat-$command \\\\* *- [a-z]" "page-$command" || fail "$command: its page has no name"
done
grep -q -e '--max-memory=' page-solve && grep -q 'Exit\|EXIT' page-solve || fail "solve: its page lacks options"
zcat usr/share/man/man1/orthostat.1.gz | grep -q 'orthostat\\-cost\|orthostat-cost' || fail "orthostat(1) does not name the others"
for page in orthostat orthostat-solve; do
    zcat "usr/share/man/man1/$page.1.gz" | grep -q '130 interrupted' || fail "$page(1) does not tell of status 130"
done

# shellcheck disable=SC1091
. "$PWD/usr/share/bash-completion/completions/orthostat"
completed() { # WORD...: what may stand for the last of them
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    _orthostat
    printf '%s ' "${COMPREPLY[@]}"
}
expect() { # ANSWER WORD...
    local found
    found=$(completed "${@:2}")
    [ "$found" = "$1" ] || fail "completion of '${*:2}': '$found' where '$1' is right"
}
mkdir -p completion/deeper
cd completion
touch beam.yaml beam.yml beam.vtkhdf
expect "solve " orthostat so
expect "--version --verbose " orthostat --ver
expect "--json= " orthostat solve --js
expect "--json " orthostat -q check --js
expect "beam.yaml beam.yml " orthostat solve b
expect "beam.yaml beam.yml deeper " orthostat explain ""
expect "beam.vtkhdf " orthostat solve --output beam.v
expect "beam.vtkhdf " orthostat solve --output = beam.v
expect "beam.vtkhdf deeper " orthostat solve -o ""
expect "beam.vtkhdf deeper " orthostat solve --json =
expect " " orthostat solve --case b
printf 'cases:\n  - name: wind\n    loads: []\n  - {name: snow}\nwatch: {name: none}\n' >beam.yaml
expect "wind snow " orthostat solve beam.yaml --case ""
expect "snow " orthostat solve beam.yaml --case = s
expect "torsion-1-1 torsion-1-5 " orthostat verify torsion-1
expect "check " scripts/orthostat -n 4 ch
