#!/usr/bin/env bash
# Embeds Scree in projects outside the tree, as README.md and docs/embedding.md show it, with their own CMakeLists.txt:
# the simulation as a subdirectory, configured without the libraries that it does not need; the same from a build tree,
# and as installed, built and run; and a server with its host's own rules from a build tree, built and run with a bot.
# usage: embedding.sh SOURCE_FOLDER BUILD_FOLDER CMAKE COMPILER
set -euo pipefail
readonly source=$1 build=$2 cmake=$3 compiler=$4

folder=$(mktemp -d)
host=''
trap '[[ -z $host ]] || kill "$host" 2>/dev/null; rm -rf "$folder"' EXIT
# block PAGE LANGUAGE N: prints the page's N-th block of that language.
block() {
  awk -v "fence=\`\`\`$2" -v "wanted=$3" '$0 == fence { shown = ++count == wanted; next } /^```$/ { shown = 0 } shown' "$source/$1"
}
# project NAME CMAKE_PAGE CMAKE_N CPP_PAGE CPP_N: a host's project of a page's blocks, beside a clone, in which
# -Wall -Wextra -Werror, which are ours, would not let a line pass.
project() {
  mkdir "$folder/$1"
  ln -s "$source" "$folder/$1/scree"
  block "$2" cmake "$3" >"$folder/$1/CMakeLists.txt"
  block "$4" cpp "$5" >"$folder/$1/main.cpp"
  [[ -s $folder/$1/CMakeLists.txt && -s $folder/$1/main.cpp ]] || { echo "$2 and $4 should show a host's project" >&2; exit 1; }
  sed -i "s|scree/build/release|$build NO_DEFAULT_PATH|" "$folder/$1/CMakeLists.txt"
  echo 'static int unused(int never) { return 0; }' >>"$folder/$1/main.cpp"
}
# configure NAME OPTIONS...
configure() {
  "$cmake" --log-level=WARNING -G Ninja -S "$folder/$1" -B "$folder/$1/built" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${@:2}" >"$folder/$1.log" 2>&1 || { cat "$folder/$1.log" >&2; exit 1; }
}

project subdirectory README.md 1 README.md 1
cat >>"$folder/subdirectory/CMakeLists.txt" <<'TEXT'
if(TARGET scree_viewer_lib OR TARGET scree_net OR TARGET scree_mirror OR TARGET base_tests)
  message(FATAL_ERROR "parts of Scree are configured that nobody asked for")
endif()
TEXT
missing=()
for package in CLI11 GTest OpenSSL PkgConfig Protobuf SQLite3 fmt glfw3 nlohmann_json spdlog zstd; do
  missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
configure subdirectory "${missing[@]}"
# The flags that reach the host are enough for its source, and none of them is about warnings.
command=$(jq -r '.[] | select(.file | endswith("/subdirectory/main.cpp")) | .command' "$folder/subdirectory/built/compile_commands.json")
[[ $command != *-W* ]] || { echo "our warnings reach the host: $command" >&2; exit 1; }
(cd "$folder/subdirectory/built" && mkdir -p CMakeFiles/host.dir && bash -c "$command -fsyntax-only")

project readme docs/embedding.md 1 README.md 1
project tower docs/embedding.md 1 docs/embedding.md 1
for name in readme tower; do
  configure "$name"
  "$cmake" --build "$folder/$name/built"
  "$folder/$name/built/host" | tee "$folder/$name.said"
done
for line in '20 pieces' 'terrain -8158, dust 8158' 'mass error 0'; do
  grep -qxF "$line" "$folder/readme.said" || { echo "the README's program should print, as the README says: $line" >&2; exit 1; }
done

# The same from an installed tree, which names neither the sources nor the build.
for component in dev cpp; do "$cmake" --install "$build" --prefix "$folder/usr" --component "$component" >"$folder/install.log"; done
! grep -rlE "$source|$build" "$folder/usr" --include='*.cmake' | grep . || { echo 'an installed file names the build folder' >&2; exit 1; }
project installed docs/embedding.md 1 README.md 1
sed -i "s| PATHS $build NO_DEFAULT_PATH||" "$folder/installed/CMakeLists.txt"
configure installed -DCMAKE_PREFIX_PATH="$folder/usr"
"$cmake" --build "$folder/installed/built"
"$folder/installed/built/host" | diff - "$folder/readme.said" || { echo 'the installed libraries should compute the same' >&2; exit 1; }

project rules docs/embedding.md 2 docs/embedding.md 2
configure rules
"$cmake" --build "$folder/rules/built"
mkfifo "$folder/input"
"$folder/rules/built/host" <"$folder/input" >"$folder/rules.said" &
host=$!
exec 3>"$folder/input" # held open: the host serves until its input ends
for ((i = 0; i < 100; ++i)); do
  [[ ! -s $folder/rules.said ]] || break
  sleep 0.1
done
port=$(sed -n 's/^port //p' "$folder/rules.said")
# carve X: a bot carves once at X, 0; prints its report.
carve() { "$build/bin/scree-bot" --port "$port" --centre "$1" 0 --area 0 --carves 1 --timeout 30 --quiet --report -; }
near=$(carve 0 || true) far=$(carve 30)
[[ $(jq -r '.carves.accepted, .carves.refusals["game:protected"]' <<<"$near" | paste -sd' ') == '0 1' ]] ||
  { echo "the host should refuse a carve at its tower: $near" >&2; exit 1; }
[[ $(jq -r '.carves.accepted' <<<"$far") == 1 ]] || { echo "the host should let a carve pass: $far" >&2; exit 1; }
exec 3>&-
wait "$host" || { echo 'the host should end well when its input ends' >&2; exit 1; }
host=''
echo "the simulation is embedded in both ways, and a server with its host's rules"
