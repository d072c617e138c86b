#!/usr/bin/env bash
# run.sh FOLDER BUILT PROGRAM ARGUMENTS…: runs a test of this folder with the modules that `./scree test` installed in FOLDER,
# and with the package that `./scree web` made in BUILT, unpacked as npm does. The examples lie beside it. Exits with 77,
# which ctest counts as skipped, where these are not there.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(readlink -f "$1") built=$2 program=$3
shift 3
if ! cmp -s "$here/package-lock.json" "$folder/node_modules/.installed"; then
  echo "The modules of the package's tests are not installed in $folder: ./scree setup --web, then ./scree test, installs them." >&2
  exit 77
fi
packed=$(compgen -G "$built/scree-client-*.tgz") || {
  echo "There is no package in $built: ./scree web builds it." >&2
  exit 77
}
# Node looks for modules beside and above a program.
copy=$(mktemp --directory --tmpdir="$folder")
trap 'rm -rf "$copy"' EXIT
mkdir -p "$copy/node_modules/scree-client"
tar -xzf "$packed" -C "$copy/node_modules/scree-client" --strip-components=1
cp "$here"/*.{js,json,ts} "$here"/../page/{server,browser}.js "$copy"
cp -r "$here/../../examples" "$copy/examples"
cp "$here/../../docs/javascript.md" "$copy"
mkdir "$copy/web"
printf "<!doctype html>\n" >"$copy/web/index.html" # the server speaks HTTP where it has a page
export SCREE_DIST=$copy/web
cd "$copy"
node --expose-gc --test-reporter=spec "$program" "$@"
