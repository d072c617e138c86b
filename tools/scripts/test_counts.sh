#!/usr/bin/env bash
# Counts tests after ctest: test_counts.sh LOG RESULTS prints "PASSED FAILED SKIPPED".
#
# LOG is what ctest printed, whole or cut off. An entry of ctest that runs a test program leaves RESULTS/NAME.xml, by
# which its tests are counted; every other entry counts as one test, and so does a program that crashed.
set -euo pipefail
readonly log=$1 results=$2

# sum_of ATTRIBUTE FILE: of the whole program, from googletest's XML.
attribute_of() {
  local value
  value=$(grep -m1 '<testsuites ' "$2" | grep -oE " $1=\"[0-9]+\"" | tr -dc '0-9')
  printf '%s\n' "${value:-0}"
}

passed=0 failed=0 skipped=0
while read -r name outcome; do
  file=$results/$name.xml
  if [[ -s $file ]]; then
    total=$(attribute_of tests "$file")
    bad=$(attribute_of failures "$file")
    # googletest counts skipped tests by suite alone.
    left_out=$(($(attribute_of disabled "$file") + $(grep -cE '<testcase .* result="skipped"' "$file" || true)))
    passed=$((passed + total - bad - left_out)) failed=$((failed + bad)) skipped=$((skipped + left_out))
    # As when a sanitizer ended the program after its tests.
    [[ $outcome != failed || $bad != 0 ]] || failed=$((failed + 1))
  else
    printf -v "$outcome" %s $((${!outcome} + 1))
  fi
done < <(awk '
  !/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { next }
  { sub(/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: /, "") }
  / Passed /                                   { print $1, "passed"; next }
  /\*\*\*(Skipped|Not Run \(Disabled\))/       { print $1, "skipped"; next }
  /\*\*\*/                                     { print $1, "failed" }' "$log")
printf '%s %s %s\n' "$passed" "$failed" "$skipped"
