#!/usr/bin/env bash
# What cmake --install leaves can be used by another project, through CMake and through pkg-config.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
consumer=$ORTHOSTAT_SOURCE/tests/cli/consumer
sanitizers=()
grep -q '^ORTHOSTAT_SANITIZE:BOOL=ON' "$ORTHOSTAT_BUILD/CMakeCache.txt" && sanitizers=(-fsanitize=address,undefined)

cmake --install "$ORTHOSTAT_BUILD" --prefix "$folder/usr" >/dev/null
cmake -S "$consumer" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/usr" -DCMAKE_C_FLAGS="${sanitizers[*]-}" >/dev/null
cmake --build "$folder/build" >/dev/null
by_cmake=$("$folder/build/consumer" "$ORTHOSTAT_SOURCE/cases/block/sliding.yaml")

PKG_CONFIG_PATH=$(dirname "$(find "$folder/usr" -name orthostat.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046
cc "$consumer/main.c" -o "$folder/consumer" "${sanitizers[@]}" $(pkg-config --cflags --libs orthostat)
by_pkg_config=$("$folder/consumer" "$ORTHOSTAT_SOURCE/cases/block/sliding.yaml")

"$folder/usr/bin/orthostat" --version | grep -q '^orthostat '
echo "largest displacement: $by_cmake by CMake, $by_pkg_config by pkg-config"
[ -n "$by_cmake" ] && [ "$by_cmake" = "$by_pkg_config" ]
