#!/usr/bin/env bash
# Embeds Scree in projects outside the tree, in the ways that docs/embedding.md names: the simulation from a build tree,
# built and run; the same as a subdirectory, configured without the libraries that the simulation does not need; and a
# server with its host's own rules from a build tree, built and run.
# usage: embedding.sh SOURCE_FOLDER BUILD_FOLDER CMAKE COMPILER
set -euo pipefail
readonly source=$1 build=$2 cmake=$3 compiler=$4

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$source/tests/embedding/host/CMakeLists.txt" "$folder"
cp -r "$source/tests/embedding/host_hooks" "$folder"
# programs_of PAGE NAME: writes each program that the page shows, to NAME_1.cpp and so on.
programs_of() {
  awk -v "out=$folder/$2" '/^```cpp$/ { file = out "_" ++count ".cpp"; next } /^```$/ { file = "" } file { print >file }' "$source/$1"
  [[ -s $folder/$2_1.cpp ]] || { echo "$1 shows no program" >&2; exit 1; }
}
programs_of README.md readme
programs_of docs/embedding.md page
# What -Wall -Wextra -Werror, which are ours, would not let pass.
for program in "$folder"/*.cpp "$folder/host_hooks/main.cpp"; do echo 'static int unused(int never) { return 0; }' >>"$program"; done

# configure SOURCE BUILD OPTIONS...
configure() {
  "$cmake" --log-level=WARNING -G Ninja -S "$1" -B "$2" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${@:3}" >"$2.log" 2>&1 || { cat "$2.log" >&2; exit 1; }
}

configure "$folder" "$folder/built" -DSCREE_BUILD="$build"
"$cmake" --build "$folder/built"
for program in "$folder"/*.cpp; do "$folder/built/$(basename "$program" .cpp)" | tee -a "$folder/said"; done
grep -q '^mass error 0$' "$folder/said" || { echo "the README's program should print: mass error 0" >&2; exit 1; }

missing=()
for package in CLI11 GTest OpenSSL PkgConfig Protobuf SQLite3 fmt glfw3 nlohmann_json spdlog zstd; do
  missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
configure "$folder" "$folder/subdirectory" -DSCREE_SOURCE="$source" "${missing[@]}"
# The flags that reach the host are enough for its source, and none of them is about warnings.
command=$(jq -r '.[] | select(.file | endswith("/readme_1.cpp")) | .command' "$folder/subdirectory/compile_commands.json")
[[ $command != *-W* ]] || { echo "our warnings reach the host: $command" >&2; exit 1; }
(cd "$folder/subdirectory" && mkdir -p CMakeFiles/readme_1.dir && bash -c "$command -fsyntax-only")

configure "$folder/host_hooks" "$folder/hooks" -DSCREE_BUILD="$build"
"$cmake" --build "$folder/hooks"
"$folder/hooks/host_hooks" | tee "$folder/answers"
for answer in "carve 1: refused (game:protected): the tower's ground is protected" "carve 2: 32 pieces"; do
  grep -qxF "$answer" "$folder/answers" || { echo "the host with hooks should print: $answer" >&2; exit 1; }
done
echo "the simulation is embedded in both ways, and a server with its host's rules"
