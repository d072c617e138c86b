#!/usr/bin/env bash
# run.sh FOLDER PROGRAM ARGUMENTS…: runs a program of this folder with the modules that `./scree test` installed in FOLDER.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$1 program=$2
shift 2
if ! cmp -s "$here/package-lock.json" "$folder/node_modules/.installed"; then
  echo "The modules of the foreign client are not installed in $folder. ./scree test installs them from npm's registry" >&2
  echo "(another one: npm_config_registry=URL ./scree test); could it not be reached?" >&2
  exit 1
fi
# Node looks for modules beside and above a program, so the programs lie beside them.
copy=$(mktemp --directory --tmpdir="$folder")
trap 'rm -rf "$copy"' EXIT
cp "$here"/*.js "$here/package.json" "$copy"
cd "$copy"
node "$program" "$@"
