#!/usr/bin/env bash
# `./scree test FOLDER [FILTER]` builds one program and runs it with the filter, and fails when a test fails or none ran.
# A copy of the script meets a build that builds nothing and a test program that says how it was called.
# usage: test_folder.sh SCREE TEST_COUNTS.SH
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder"/{bin,tools/scripts,tests/{field,golden}}
cp "$1" "$folder/scree"
cp "$2" "$folder/tools/scripts/"
printf 'plain  # for all\n' >"$folder/packages.txt"
echo '{}' >"$folder/CMakePresets.json"
touch "$folder/tests/field/a_test.cpp" "$folder/tests/golden/kernels.txt"
# shellcheck disable=SC2016  # the stubs' own
{
  printf '%s\n' '#!/usr/bin/env bash' 'for name in "$@"; do echo "installed $name, ,"; done' >"$folder/bin/dpkg-query"
  printf '%s\n' '#!/usr/bin/env bash' 'echo "builds $*" >&2' >"$folder/bin/ninja"
}
for preset in dev release; do
  mkdir -p "$folder/build/$preset/bin"
  touch "$folder/build/$preset/build.ninja"
  cat >"$folder/build/$preset/bin/field_tests" <<'TEXT'
#!/usr/bin/env bash
echo "runs $(basename "$(dirname "$(dirname "$0")")") $*"
for argument in "$@"; do
  [[ $argument != --gtest_output=xml:* ]] || file=${argument#--gtest_output=xml:}
done
tests=3 failures=0
[[ ${GTEST_SHARD_INDEX:-0} == 0 ]] || tests=0
case $* in
  *--gtest_filter=\*nothing\**) tests=0 ;;
  *--gtest_filter=\*bad\**) failures=1 ;;
  *--gtest_filter=\*crash\**) exit 134 ;;
  *--gtest_list_tests*) exit 0 ;;
esac
echo "<testsuites tests=\"$tests\" failures=\"$failures\" disabled=\"0\" errors=\"0\">" >"$file"
exit "$failures"
TEXT
done
chmod +x "$folder"/bin/* "$folder"/build/*/bin/*

# expect STATUS TEXT ARGUMENTS…: ./scree test ends so, and says the text.
expect() {
  local wanted=$1 text=$2 said status=0
  shift 2
  said=$(PATH="$folder/bin:$PATH" "$folder/scree" test "$@" 2>&1) || status=$?
  [[ $status == "$wanted" && $said == *"$text"* ]] && return
  printf 'test %s: ended with %s, not with %s, or did not say "%s". It said:\n%s\n' "$*" "$status" "$wanted" "$text" "$said" >&2
  exit 1
}

expect 0 "builds -C $folder/build/dev" field
expect 0 'field_tests' field
expect 0 'runs dev --gtest_filter=* --gtest_output' field
expect 0 'all green: 3 tests passed, 0 skipped (dev,' field
expect 0 'runs dev --gtest_filter=*crater* --gtest_output' field crater
expect 0 'runs dev --gtest_filter=crater.*:-*long* --gtest_output' field 'crater.*:-*long*'
expect 0 '.xml --gtest_repeat=3 --gtest_shuffle' field crater --gtest_repeat=3 --gtest_shuffle
expect 0 'runs release --gtest_filter=*crater*' --preset release field crater
expect 0 'all green: 3 tests passed, 0 skipped (release,' field --preset=release
expect 0 'runs dev' field --gtest_list_tests
expect 1 'no test ran' field nothing
expect 1 'tests failed: 1; 2 passed' field bad
expect 1 'ended with 134' field crash
expect 1 'tests failed: 1' field crash
expect 1 'There are: field' golden
expect 1 'There are: field' no_such_folder
expect 1 'there is no preset' --preset no_such field
