#!/usr/bin/env bash
# Plays the sessions of a build, keeps what it prints, and compares that with what another build printed. What is
# compared with another build is played once; a build of which that is asked alone plays each session twice.
# usage: sessions.sh PROGRAM OUTPUT [OUTPUT_OF_ANOTHER_BUILD]
set -euo pipefail
readonly program=$1 output=$2 reference=${3:-}

if [[ -z $reference ]]; then
  "$program" >"$output"
  exit
fi
"$program" once >"$output"
if ! diff --unified=0 "$reference" "$output"; then
  echo "the simulations of two builds part, as above: $program prints other hashes than $reference holds" >&2
  exit 1
fi
echo "$(wc -l <"$output") lines of hashes agree"
