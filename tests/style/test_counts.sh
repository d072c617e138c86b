#!/usr/bin/env bash
# tools/scripts/test_counts.sh counts the tests of programs by their results, and other entries of ctest by their lines.
# usage: test_counts.sh TEST_COUNTS.SH
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/log" <<'TEXT'
Test project /build
      Start 1: field
 1/10 Test  #1: field ............................   Passed    0.52 sec
 2/10 Test  #2: world_1 ..........................***Failed    3.10 sec
[ RUN      ] Sample.prints
 3/10 Test #3: says_so
 3/10 Test  #3: crashed ..........................***Exception: SegFault  0.10 sec
 4/10 Test  #4: leaks ............................***Failed    0.10 sec
 5/10 Test  #5: all_skipped ......................   Passed    0.10 sec
 6/10 Test  #6: clang_format .....................   Passed    0.10 sec
 7/10 Test  #7: page_units .......................***Skipped   0.10 sec
 8/10 Test  #8: off ..............................***Not Run (Disabled)   0.00 sec
 9/10 Test  #9: foreign_client ...................***Timeout 300.00 sec
TEXT
# results NAME TESTS FAILURES DISABLED SKIPPED: googletest's own file.
results() {
  printf '<?xml version="1.0" encoding="UTF-8"?>\n<testsuites tests="%s" failures="%s" disabled="%s" errors="0" time="1.">\n' \
    "$2" "$3" "$4" >"$folder/$1.xml"
  printf '  <testsuite name="Some" tests="9" failures="7" disabled="0" skipped="9" errors="0">\n' >>"$folder/$1.xml"
  for ((i = 0; i < $5; ++i)); do
    printf '    <testcase name="a" status="run" result="skipped" time="0." classname="Some">\n' >>"$folder/$1.xml"
  done
}
results field 55 0 0 0
results world_1 40 2 1 3
results leaks 7 0 0 0
results all_skipped 2 0 0 2

# 55, 40 − 2 − 1 − 3, 7 and clang_format; 2, the crash, the leak and the timeout; 1 + 3, 2, page_units and off.
wanted='97 5 8'
said=$("$1" "$folder/log" "$folder")
[[ $said == "$wanted" ]] || { printf 'counted %s, not %s\n' "$said" "$wanted" >&2; exit 1; }
: >"$folder/empty"
[[ $("$1" "$folder/empty" "$folder") == '0 0 0' ]] || { echo 'an empty log has tests' >&2; exit 1; }
