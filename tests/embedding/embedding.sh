#!/usr/bin/env bash
# Embeds the simulation in a project outside the tree, in both ways that docs/embedding.md names: from a build tree, built
# and run; and as a subdirectory, configured without the libraries that the simulation does not need.
# usage: embedding.sh SOURCE_FOLDER BUILD_FOLDER CMAKE COMPILER
set -euo pipefail
readonly source=$1 build=$2 cmake=$3 compiler=$4

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$source/tests/embedding/host/CMakeLists.txt" "$folder"
# programs_of PAGE NAME: writes each program that the page shows, to NAME_1.cpp and so on.
programs_of() {
  awk -v "out=$folder/$2" '/^```cpp$/ { file = out "_" ++count ".cpp"; next } /^```$/ { file = "" } file { print >file }' "$source/$1"
  [[ -s $folder/$2_1.cpp ]] || { echo "$1 shows no program" >&2; exit 1; }
}
programs_of README.md readme
programs_of docs/embedding.md page
# What -Wall -Wextra -Werror, which are ours, would not let pass.
for program in "$folder"/*.cpp; do echo 'static int unused(int never) { return 0; }' >>"$program"; done

configure() {
  "$cmake" --log-level=WARNING -G Ninja -S "$folder" -B "$1" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${@:2}" >"$1.log" 2>&1 || { cat "$1.log" >&2; exit 1; }
}

configure "$folder/built" -DSCREE_BUILD="$build"
"$cmake" --build "$folder/built"
for program in "$folder"/*.cpp; do "$folder/built/$(basename "$program" .cpp)" | tee -a "$folder/said"; done
grep -q '^mass error 0$' "$folder/said" || { echo "the README's program should print: mass error 0" >&2; exit 1; }

missing=()
for package in CLI11 GTest OpenSSL PkgConfig Protobuf SQLite3 fmt glfw3 nlohmann_json spdlog zstd; do
  missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
configure "$folder/subdirectory" -DSCREE_SOURCE="$source" "${missing[@]}"
# The flags that reach the host are enough for its source, and none of them is about warnings.
command=$(jq -r '.[] | select(.file | endswith("/readme_1.cpp")) | .command' "$folder/subdirectory/compile_commands.json")
[[ $command != *-W* ]] || { echo "our warnings reach the host: $command" >&2; exit 1; }
(cd "$folder/subdirectory" && mkdir -p CMakeFiles/readme_1.dir && bash -c "$command -fsyntax-only")
echo "the simulation is embedded in both ways"
