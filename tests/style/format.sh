#!/usr/bin/env bash
# Fails when clang-format would lay out a source file differently, and says where.
# usage: tests/style/format.sh [--fix]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
readonly folders=(shared proto crypto transport auth ground content tools server client python tests bench examples)

mode=(--dry-run -Werror)
if [[ ${1:-} == --fix ]]; then mode=(-i); fi

# What git knows or would add; without git, whatever lies in the folders.
mapfile -t files < <(git ls-files --cached --others --exclude-standard -- "${folders[@]}" 2>/dev/null || find "${folders[@]}" -type f)
sources=()
for file in "${files[@]}"; do
  if [[ $file == *.@(h|cpp) && -e $file ]]; then sources+=("$file"); fi
done
if ((${#sources[@]} == 0)); then
  echo "format.sh: found no source file in $PWD" >&2
  exit 1
fi
clang-format "${mode[@]}" "${sources[@]}"
echo "${#sources[@]} files are laid out as .clang-format says"
