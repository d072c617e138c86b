#!/usr/bin/env bash
# gdb's printers (tools/debug/scree_gdb.py) show the values of printed_values.cpp in words.
# usage: printers.sh SCREE_GDB.PY PROGRAM; exits with 77, which ctest counts as skipped, where there is no gdb.
set -euo pipefail
readonly printers=$1 program=$2

if ! command -v gdb >/dev/null; then
  echo "gdb is not installed: ./scree setup --tests installs it" >&2
  exit 77
fi

said=$(gdb -nx -batch -iex 'set debuginfod enabled off' -ex 'set width 0' -x "$printers" \
  -ex 'break scree::stop_here' -ex run \
  -ex 'print values.brick' -ex 'print values.window' -ex 'print values.carve' -ex 'print values.island' \
  -ex 'print values.field' -ex 'print values.layer' \
  -ex 'scree-slice values.brick y 2' -ex 'scree-slice values.window x 11' "$program" 2>&1)

status=0
# expect LINE: gdb must have printed it, with anything before and after.
expect() {
  [[ $said == *"$1"* ]] && return
  printf 'gdb did not print: %s\n' "$1" >&2
  status=1
}
# refuse LINE
refuse() {
  [[ $said != *"$1"* ]] && return
  printf 'gdb printed: %s\n' "$1" >&2
  status=1
}
expect 'brick: 1 of 512 voxels in rock, codes -5 to 127'
expect 'window (10, 20, 30) to (13, 24, 35), 3 x 4 x 5 voxels: 1 of 60 voxels in rock, codes -7 to 127'
expect 'operation carve = {shape = {kind = scree::ShapeKind::sphere, a = (1, 2, 3), b = (0, 0, 0), radius_m = 4.5}'
expect 'seeds = 17'
expect 'operation island = {box = box (0, 0, 0) to (8, 8, 8), 8 x 8 x 8 voxels, start = (1, 2, -3), piece = 9}'
expect 'MapField: 2 edited bricks in 2 chunks, hash '
expect 'MapField: 1 edited bricks in 1 chunks, hash '
expect ', a layer over the field at 0x'
expect $'\n   .   .   .  -5   .   .   .   .\n'
expect $'\n   .   .   .  -7   .\n'
refuse 'Python Exception'
refuse 'Error'
((status == 0)) || printf '%s\n' "$said" >&2
exit "$status"
