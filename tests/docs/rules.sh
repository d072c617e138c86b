#!/usr/bin/env bash
# run.sh and options.sh catch what they are for: pages that are wrong, one mistake each, must fail, and a right one passes.
# usage: rules.sh SOURCE_FOLDER PROGRAM_FOLDER
set -euo pipefail
readonly source=$1 bin=$2
here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# expect STATUS TEXT: a page of this text makes run.sh end so.
expect() {
  local status=0
  printf '%b' "$2" >"$folder/page.md"
  "$here/run.sh" page.md "$folder" "$bin" >"$folder/said" 2>&1 || status=1
  ((status == $1)) && return
  printf 'run.sh ends with %s on this page, not with %s:\n%b\n' "$status" "$1" "$2" >&2
  cat "$folder/said" >&2
  exit 1
}

expect 0 '# A\n\n<!-- run -->\n\n    ./scree token key k\n    test -s k.pub\n\n<!-- run: exits with 2 -->\n\n    ./scree bot --no-such\n'
expect 0 '<!-- file: a.txt -->\n\n```text\nb\n```\n\n<!-- run -->\n\n    test "$(cat a.txt)" = b\n    test 1 = \\\n        1\n'
expect 0 '<!-- not run: why -->\n\n    false\n'
expect 1 '<!-- run -->\n\n    false\n'
expect 1 '<!-- run: exits with 2 -->\n\n    true\n'
expect 1 'No mark:\n\n    true\n'
expect 1 '<!-- not run: -->\n\n    true\n'
expect 1 '<!-- run: sometimes -->\n\n    true\n'
expect 1 '<!-- run -->\n\nNo command.\n'
expect 1 '```\nno language\n```\n'
expect 1 '```sh\ntrue\n```\n'
expect 1 '<!-- run -->\n\n    ./scree server --no-such\n'

# Each line is a page that options.sh must tell, but for the first; one run, because it asks every program for its help.
pages=()
while IFS= read -r line; do
  printf '%b' "$line" >"$folder/${#pages[@]}.md"
  pages+=("$(realpath --relative-to "$source" "$folder/${#pages[@]}.md")")
done <<'TEXT'
`./scree bot --carves 2`, `--carves`, `SCREE_PORT`\n
`./scree bot --no-such 2`\n
`./scree no-such`\n
`--no-such`\n
`SCREE_NO_SUCH`\n
<!-- not run: why -->\n\n    ./scree test --no-such\n
TEXT
if "$here/options.sh" "$source" "$bin" "${pages[@]}" >"$folder/said" 2>&1; then
  echo 'options.sh takes options that do not exist' >&2
  exit 1
fi
for i in "${!pages[@]}"; do
  told=$(grep -c "^${pages[i]}: " "$folder/said" || true)
  ((told == (i > 0 ? 1 : 0))) && continue
  printf 'options.sh has %s complaints of page %s:\n' "$told" "$i" >&2
  cat "$folder/said" >&2
  exit 1
done
