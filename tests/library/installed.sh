#!/usr/bin/env bash
# Installs the library for clients into a folder, builds each example and each program of docs/clients.md from there alone,
# as projects of their own, and runs them against the server. usage: installed.sh SOURCE BUILD CMAKE
set -euo pipefail
readonly source=$1 build=$2 cmake=$3
folder=$(mktemp -d)
started=()
trap 'kill "${started[@]}" 2>/dev/null || true; wait 2>/dev/null || true; rm -rf "$folder"' EXIT
readonly prefix=$folder/usr
fail() { echo "$*" >&2; exit 1; }

for component in client dev; do "$cmake" --install "$build" --prefix "$prefix" --component "$component" >"$folder/install.log"; done
lib=$(dirname "$(find "$prefix" -name libscree_client.so)")
! grep -rlE "$source|$build" "$prefix" --include='*.cmake' --include='*.pc' --include='*.h' | grep . || fail 'an installed file names the build folder'
export LD_LIBRARY_PATH=$lib LIBSCREE_INCLUDE=$prefix/include PKG_CONFIG_PATH=$lib/pkgconfig

# project NAME: configures and builds $folder/NAME.
project() {
  "$cmake" --log-level=WARNING -G Ninja -S "$folder/$1" -B "$folder/$1/built" -DCMAKE_PREFIX_PATH="$prefix" >"$folder/$1.log" 2>&1 &&
    "$cmake" --build "$folder/$1/built" >>"$folder/$1.log" 2>&1 || { cat "$folder/$1.log" >&2; fail "$1 does not build"; }
}
cp -r "$source/examples/c" "$source/examples/cpp" "$source/examples/csharp" "$source/examples/luajit" "$folder/"
project c
project cpp
[[ $(wc -l <"$folder/cpp/terrain.cpp") -le 140 && $(wc -l <"$folder/luajit/carve.lua") -le 30 ]] || fail 'an example has grown'
# By pkg-config, in C99 and in C++.
# shellcheck disable=SC2046
cc -std=c99 -Wall -Wextra -Werror -o "$folder/by_pkg_config" "$folder/c/carve.c" $(pkg-config --cflags --libs scree-client)
echo '#include <scree/client.h>' >"$folder/header.cpp"
c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only "-I$prefix/include" "$folder/header.cpp"
cc -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -x c "-I$prefix/include" "$folder/header.cpp"

# The header's pages, in which every example is found.
if command -v doxygen >/dev/null; then
  (cd "$source" && sed "s|build/doxygen|$folder/doxygen|" client/library/Doxyfile | doxygen -) || fail 'the pages of the header cannot be made'
  for group in results client events requests world questions meshes; do
    grep -q 'class="fragment"' "$folder/doxygen/html/group__$group.html" || fail "the group $group of the header shows no example"
  done
fi

# serve OPTIONS…: a server, whose port is in $port.
serve() {
  "$build/bin/scree-server" --port 0 "$@" >"$folder/server.out" 2>"$folder/server.log" &
  started+=($!)
  port=
  for ((i = 0; i < 300; ++i)); do
    port=$(jq -r 'select(.listening) | .listening' "$folder/server.out" 2>/dev/null || true)
    [[ -z $port ]] || return 0
    kill -0 "${started[-1]}" 2>/dev/null || break
    sleep 0.1
  done
  cat "$folder/server.log" >&2
  fail 'the server does not start'
}
# said NAME PATTERN COMMAND…: the command ends well within two minutes, and a line of what it says is like that.
said() {
  timeout 120 "${@:3}" >"$folder/$1.said" 2>&1 || { cat "$folder/$1.said" "$folder/server.log" >&2; fail "$1 failed"; }
  grep -qE "$2" "$folder/$1.said" || { cat "$folder/$1.said" >&2; fail "$1 should say $2"; }
}
serve --terrain flat
said c '^[0-9]+ pieces at tick [0-9]+$' "$folder/c/built/carve" 127.0.0.1 "$port"
hashes=$(sed -nE "s/^hash ([0-9a-f]+), the server's ([0-9a-f]+)$/\1 \2/p" "$folder/c.said")
[[ ${hashes% *} == "${hashes#* }" && -n $hashes ]] || fail "the example in C has another hash than the server: $hashes"
said groups ' stones lie there, hash ' "$folder/c/built/groups" "$port"
said by_pkg_config ' pieces at tick ' "$folder/by_pkg_config" 127.0.0.1 "$port"
if command -v luajit >/dev/null; then (cd "$folder/luajit" && said luajit ' pieces$' luajit carve.lua 127.0.0.1 "$port"); fi
if command -v mcs >/dev/null; then
  (cd "$folder/csharp" && ./build.sh && said csharp ' pieces$' mono carve.exe 127.0.0.1 "$port")
fi
if command -v xvfb-run >/dev/null; then
  timeout 120 xvfb-run -a -s '-screen 0 960x540x24' "$folder/cpp/built/terrain" 127.0.0.1 "$port" >"$folder/cpp.said" 2>&1 &
  viewer=$!
  started+=("$viewer")
  for ((i = 0; i < 1000; ++i)); do
    ! grep -q 'all is drawn' "$folder/cpp.said" || break
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.1
  done
  grep -q 'all is drawn' "$folder/cpp.said" || { cat "$folder/cpp.said" >&2; fail 'the example in C++ draws nothing'; }
fi

# The programs of the page, in order; the last one needs persons that walk.
block() { awk -v "fence=\`\`\`$1" -v "wanted=$2" '$0 == fence { shown = ++count == wanted; next } /^```$/ { shown = 0 } shown' "$source/docs/clients.md"; }
page() {
  mkdir "$folder/page$1"
  block c "$1" >"$folder/page$1/main.c"
  block cmake 1 >"$folder/page$1/CMakeLists.txt"
  project "page$1"
  (cd "$folder/page$1" && said "page$1" "$2" ./built/first "$port")
}
page 1 '^[0-9]+ pieces$'
page 2 '^[0-9]+ bodies, [0-9]+ chunks$'
page 3 '^[1-9][0-9]+ vertices in ground.obj$'
page 4 'the hashes agree$'
serve --terrain flat --persons walk
page 5 '^walked [1-9]'
echo 'the examples and the programs of the page build from what is installed, and run'
