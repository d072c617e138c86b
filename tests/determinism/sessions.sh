#!/usr/bin/env bash
# Plays the sessions of a build, keeps what it prints, and compares that with what another build printed.
# usage: sessions.sh PROGRAM OUTPUT [OUTPUT_OF_ANOTHER_BUILD]
set -euo pipefail
readonly program=$1 output=$2 reference=${3:-}

"$program" >"$output"
[[ -n $reference ]] || exit 0
if ! diff --unified=0 "$reference" "$output"; then
  echo "the simulations of two builds part, as above: $program prints other hashes than $reference holds" >&2
  exit 1
fi
echo "$(wc -l <"$output") lines of hashes agree"
