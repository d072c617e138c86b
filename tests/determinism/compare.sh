#!/usr/bin/env bash
# Compares what a build of kernels_golden prints with the golden hashes.
# usage: compare.sh PROGRAM GOLDEN_FILE
# A kernel that is meant to compute something else now changes its hashes. Then look at the difference, raise
# protocol_version (old recordings and clients no longer agree), and write the new hashes with
#   build/release/bin/scree-kernels-golden > tests/golden/kernels.txt
set -euo pipefail
readonly program=$1 golden=$2

# 126: the system runs no such programs, as a kernel without support of 32 bits; CTest counts 77 as skipped.
"$program" >/dev/null 2>&1 || [[ $? != 126 ]] || {
  echo "this system cannot run $program: its hashes are not compared"
  exit 77
}
if ! "$program" | diff --unified=0 --label "$golden" --label "$program" "$golden" -; then
  echo "the kernels of $program differ from the golden hashes above; $0 says what to do" >&2
  exit 1
fi
echo "$(wc -l <"$golden") hashes agree"
