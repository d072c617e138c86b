#!/usr/bin/env bash
# run.sh WEB_BUILD PROGRAM ARGUMENTS…: runs a program of this folder under Node with what ./scree web built, or is skipped
# (77) where that was not done.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
built=$1 program=$2
shift 2
if [[ ! -e $built/bin/scree.wasm ]]; then
  echo "$built has no web client: ./scree setup --web, ./scree web" >&2
  exit 77
fi
# Node 20 has a fetch of its own, which emscripten 3.1.6 takes for a browser's.
exec node --no-experimental-fetch "$here/$program" "$built/bin" "$@"
