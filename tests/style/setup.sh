#!/usr/bin/env bash
# `./scree setup` takes --files, --python, --package, --tests, --web and --bench in any combination, and asks for the packages of
# each with it alone; tests and bench bring those of files, and tests those of python and package.
# A copy of the script beside a list of its own meets a dpkg-query that has everything installed: nothing is installed here.
# usage: setup.sh SCREE
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$1" "$folder/scree"
printf '%s\n' '# a comment' 'plain  # for all' 'other-bench  # shared: not what bench: means' 'of-tests  # tests: one' \
  'of-web  # web: one' 'of-web-too  # web: two' 'of-bench  # bench: one' 'of-bench-two  # bench: two' \
  'of-bench-three  # bench: three' 'of-bench-four  # bench: four' 'of-files  # files: one' 'of-python  # python: one' \
  'of-package  # package: one' >"$folder/packages.txt"
mkdir "$folder/bin"
# shellcheck disable=SC2016  # the stub's own
printf '%s\n' '#!/usr/bin/env bash' 'for name in "$@"; do echo "installed $name, ,"; done' >"$folder/bin/dpkg-query"
chmod +x "$folder/bin/dpkg-query"

# expect PACKAGES OPTIONS…
expect() {
  local wanted=$1 said
  shift
  said=$(PATH="$folder/bin:$PATH" "$folder/scree" setup "$@" 2>&1)
  [[ $said == "scree: all $wanted packages are installed" ]] && return
  printf 'setup %s: wanted %s packages, it says: %s\n' "$*" "$wanted" "$said" >&2
  exit 1
}

expect 2
expect 3 --files
expect 3 --python
expect 3 --package
expect 4 --files --python
expect 6 --tests
expect 6 --files --tests
expect 6 --python --package --tests
expect 4 --web
expect 7 --bench
expect 8 --web --tests
expect 10 --bench --tests
expect 9 --web --bench
expect 12 --bench --web --tests
expect 12 --tests --web --files --bench
status=0
PATH="$folder/bin:$PATH" "$folder/scree" setup --tests --all >/dev/null 2>&1 || status=$?
((status == 2)) || { printf 'an option that does not exist ends with %s, not with 2\n' "$status" >&2; exit 1; }
