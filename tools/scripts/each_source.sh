#!/usr/bin/env bash
# Reads each source of the libraries, programs and tests by itself, without its neighbours and without precompiled
# headers, and prints those that miss an include. Nothing is compiled, so this takes a fraction of a build.
# usage: tools/scripts/each_source.sh [--newest N] [PATTERN]
#   --newest N  only the N sources that were committed last, or include what was: a source takes some 2.5 s of processor
#               time
#   PATTERN     only sources whose path matches the extended regular expression
# Exit status: 0 when all can be read, 1 when not.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

folder=build/dev
newest=
if [[ ${1:-} == --newest ]]; then
  newest=${2:?each_source: --newest wants a number}
  shift 2
fi
readonly folder newest pattern=${1:-.}
cmake --log-level=WARNING --preset dev >&2
# Sources include headers that the build makes; ninja would first build what their folders link.
protoc -I proto --cpp_out="$folder/proto" proto/*.proto
protoc -I proto -I server/formats --cpp_out="$folder/server/formats" server/formats/*.proto

# The compiler's own command, with -fsyntax-only in place of the object. Clang reads headers faster; it does not know all of
# GCC's options.
compiler=$(command -v clang++ || command -v c++)
read_source() {
  local folder=$1 file=$2 command=$3 output
  [[ -e $file ]] || return 0 # the build makes it
  command=$(sed -E 's/ -o [^ ]+ -c / /; s/ (--param=[^ ]+|-femit-class-debug-always)//g; s/^(.* )?[^ ]*c\+\+ //' <<<"$command")
  # shellcheck disable=SC2086 # a list of words, with quoted ones
  output=$(cd "$folder" && eval "$compiler -fsyntax-only -w $command" 2>&1) && return
  printf '%s\n%s\n' "$file cannot be read by itself:" "$(grep -E 'error' <<<"$output" | head -n 3)"
  return 1
}
export -f read_source
export compiler

# wanted: the sources' paths, those committed last first. A header that changed may have taken an include away from the
# sources that name it, so they follow it.
wanted() {
  git log --format= --name-only --diff-filter=d -- '*.cpp' '*.h' | awk '!seen[$0]++' | while read -r file; do
    [[ -e $file ]] || continue
    if [[ $file == *.h ]]; then git grep -l "#include \"$file\"" -- '*.cpp' || true; else printf '%s\n' "$file"; fi
  done | awk -v folder="$PWD" '!seen[$0]++ { print folder "/" $0 }' | grep -E -- "$pattern" | head -n "${newest:--0}"
}

jq -r --slurpfile wanted <(wanted | jq -R .) \
  '($wanted | INDEX(.)) as $set | .[] | select($set[.file]) | .directory, .file, .command' \
  "$folder/compile_commands.json" | tr '\n' '\0' |
  xargs -0 -n 3 -P "$(nproc)" bash -c 'read_source "$@"' read_source || exit 1
