#!/usr/bin/env bash
# run.sh and options.sh catch what they are for: pages that are wrong, one mistake each, must fail, and a right one passes.
# usage: rules.sh SOURCE_FOLDER PROGRAM_FOLDER
set -euo pipefail
readonly source=$1 bin=$2
here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# expect SCRIPT STATUS TEXT: a page of this text makes the script end so.
expect() {
  local status=0
  printf '%b' "$3" >"$folder/page.md"
  if [[ $1 == run.sh ]]; then
    "$here/run.sh" page.md "$folder" "$bin" >"$folder/said" 2>&1 || status=1
  else
    "$here/options.sh" "$source" "$bin" "$(realpath --relative-to "$source" "$folder/page.md")" >"$folder/said" 2>&1 || status=1
  fi
  ((status == $2)) && return
  printf '%s ends with %s on this page, not with %s:\n%b\n' "$1" "$status" "$2" "$3" >&2
  cat "$folder/said" >&2
  exit 1
}

expect run.sh 0 '# A\n\n<!-- run -->\n\n    ./scree token key k\n    test -s k.pub\n\n<!-- run: exits with 2 -->\n\n    ./scree bot --no-such\n'
expect run.sh 0 '<!-- file: a.txt -->\n\n```text\nb\n```\n\n<!-- run -->\n\n    test "$(cat a.txt)" = b\n    test 1 = \\\n        1\n'
expect run.sh 0 '<!-- not run: why -->\n\n    false\n'
expect run.sh 1 '<!-- run -->\n\n    false\n'
expect run.sh 1 '<!-- run: exits with 2 -->\n\n    true\n'
expect run.sh 1 'No mark:\n\n    true\n'
expect run.sh 1 '<!-- not run: -->\n\n    true\n'
expect run.sh 1 '<!-- run: sometimes -->\n\n    true\n'
expect run.sh 1 '<!-- run -->\n\nNo command.\n'
expect run.sh 1 '```\nno language\n```\n'
expect run.sh 1 '```sh\ntrue\n```\n'
expect run.sh 1 '<!-- run -->\n\n    ./scree server --no-such\n'
expect options.sh 0 '`./scree bot --carves 2`, `--carves`, `SCREE_PORT`\n'
expect options.sh 1 '`./scree bot --no-such 2`\n'
expect options.sh 1 '`./scree no-such`\n'
expect options.sh 1 '`--no-such`\n'
expect options.sh 1 '`SCREE_NO_SUCH`\n'
expect options.sh 1 '<!-- not run: why -->\n\n    ./scree test --no-such\n'
