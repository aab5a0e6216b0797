#!/usr/bin/env bash
# One small solve under valgrind: no invalid access, and nothing of ours definitely lost.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/case.yaml" <<'CASE'
mesh:
  tube: {axis: y, length: 2, radii: [0.9, 1.5], divisions: {around: 12, radial: 2, axial: 6}}
materials:
  - region: all
    youngs_modulus: [1e6, 1e8, 1e6]
    poissons_ratio: 0.3
    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}
constraints:
  - {on: {boundary: bottom}, displacement: [0, 0, 0]}
loads:
  - {on: {boundary: top}, total_force: [1, 2, 3]}
solver: {method: metric, coarsest_unknowns: 100}
CASE
valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=none \
    --log-file="$folder/log" \
    "$ORTHOSTAT_PROGRAM" solve -q "$folder/case.yaml" --output "$folder/result.vtkhdf" || {
    cat "$folder/log"
    exit 1
}
# Leaks with a frame of ours on the stack.
if grep -E 'by .*: ost_|at .*: ost_' "$folder/log"; then
    cat "$folder/log"
    exit 1
fi
[ -s "$folder/result.vtkhdf" ]
