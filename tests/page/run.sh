#!/usr/bin/env bash
# run.sh FOLDER PROGRAM ARGUMENTS…: runs a program of this folder with the modules that `./scree test` installed in FOLDER,
# and with the page's own beside it in page/ and admin/. Exits with 77, which ctest counts as skipped, where these or the built page are not there.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$1 program=$2
shift 2
if ! cmp -s "$here/package-lock.json" "$folder/node_modules/.installed"; then
  echo "The modules of the page's tests are not installed in $folder: ./scree setup --web, then ./scree test, installs them." >&2
  exit 77
fi
if [[ $program =~ ^(session|proxy|first|keyboard|signs|sound)_test\.js$ && ! -e ${SCREE_DIST:-}/index.html ]]; then
  echo "There is no page in ${SCREE_DIST:-SCREE_DIST}: ./scree web builds it." >&2
  exit 77
fi
if [[ $program == admin_test.js && ! -e ${SCREE_DIST:-}/admin.html ]]; then
  echo "There is no administrators' page in ${SCREE_DIST:-SCREE_DIST}: ./scree web builds it, with modules from npm." >&2
  exit 77
fi
# Node looks for modules beside and above a program, so the programs lie beside them.
copy=$(mktemp --directory --tmpdir="$folder")
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/page" "$copy/admin"
cp "$here"/*.js "$here/package.json" "$copy"
cp "$here"/../../client/web/page/* "$copy/page"
cp "$here"/../../client/web/admin/*.js "$copy/admin"
cd "$copy"
# This reporter tells what failed at the end, where a reader of a long log looks first.
node --test-reporter=spec "$program" "$@"
