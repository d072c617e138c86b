#!/usr/bin/env bash
# Reads each source of the libraries, programs and tests by itself, without its neighbours and without precompiled
# headers, and prints those that miss an include. Nothing is compiled, so this takes a fraction of a build.
# usage: tools/scripts/each_source.sh [PATTERN]: only sources whose path matches the extended regular expression
# Exit status: 0 when all can be read, 1 when not.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

folder=build/dev
cmake --log-level=WARNING --preset dev >&2
# Sources include headers that the build makes; ninja would first build what their folders link.
protoc -I proto --cpp_out="$folder/proto" proto/*.proto
protoc -I proto -I server/formats --cpp_out="$folder/server/formats" server/formats/*.proto

# The compiler's own command, with -fsyntax-only in place of the object. Clang reads headers faster; it knows no --param.
compiler=$(command -v clang++ || command -v c++)
read_source() {
  local folder=$1 file=$2 command=$3 output
  [[ -e $file ]] || return 0 # the build makes it
  command=$(sed -E 's/ -o [^ ]+ -c / /; s/ --param=[^ ]+//g; s/^(.* )?[^ ]*c\+\+ //' <<<"$command")
  # shellcheck disable=SC2086 # a list of words, with quoted ones
  output=$(cd "$folder" && eval "$compiler -fsyntax-only -w $command" 2>&1) && return
  printf '%s\n%s\n' "$file cannot be read by itself:" "$(grep -E 'error' <<<"$output" | head -n 3)"
  return 1
}
export -f read_source
export compiler

jq -r --arg pattern "${1:-.}" '.[] | select(.file | test("\\.cpp$") and test($pattern)) | .directory, .file, .command' \
  "$folder/compile_commands.json" | tr '\n' '\0' |
  xargs -0 -n 3 -P "$(nproc)" bash -c 'read_source "$@"' read_source
