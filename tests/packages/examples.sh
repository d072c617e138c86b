#!/usr/bin/env bash
# examples.sh install|run: the examples build and run from what is installed, against an installed server.
set -euo pipefail
# shellcheck source=served.sh
source /tests/served.sh
if [[ $1 == install ]]; then
  apt-get -q -y install g++ cmake ninja-build pkg-config luajit mono-mcs libepoxy-dev libglfw3-dev libglm-dev >/tmp/apt.log 2>&1 ||
    { tail -n 30 /tmp/apt.log >&2; exit 1; }
  install_packages scree-server libscree-client0 libscree-client-dev python3-scree
  exit
fi
# said PATTERN COMMAND…: the command ends well, and a line of what it says is like that.
said() {
  timeout 100 "${@:2}" >/tmp/said 2>&1 || { cat /tmp/said >&2; fail "${*:2} failed"; }
  grep -qE "$1" /tmp/said || { cat /tmp/said >&2; fail "${*:2} should say $1"; }
}
sed 's/"viewer"/"builder"/; s/"canyon"/"flat"/' /usr/share/doc/scree-server/examples/world.toml >/etc/scree/hill.toml
serve
cp -r /examples /tmp/examples
cd /tmp/examples
for language in c cpp; do
  cmake --log-level=WARNING -G Ninja -S $language -B $language/built >/tmp/said 2>&1 && cmake --build $language/built >>/tmp/said 2>&1 ||
    { cat /tmp/said >&2; fail "the examples in $language do not build"; }
done
said '^[0-9]+ pieces at tick [0-9]+$' c/built/carve 127.0.0.1 4177
said ' stones lie there, hash ' c/built/groups 4177
# shellcheck disable=SC2046  # options, a word each
cc -std=c99 -Wall -Wextra -Werror -o by_pkg_config c/carve.c $(pkg-config --cflags --libs scree-client)
said ' pieces at tick ' ./by_pkg_config 127.0.0.1 4177
(cd luajit && said ' pieces$' luajit carve.lua 127.0.0.1 4177)
(cd csharp && LIBSCREE_INCLUDE=/usr/include ./build.sh && said ' pieces$' mono carve.exe 127.0.0.1 4177)
said 'fragments' python3 python/fragments.py --blows 1
# A client in Python, as the page shows it.
awk '/^```python$/ { text = ""; inside = 1; next } /^```$/ { if (inside && text ~ /scree.Client/) printf "%s", text; inside = 0 }
  inside { text = text $0 "\n" }' /docs/python.md >client.py
said "the same hash as the server's: True" python3 client.py
stop
echo 'packages: the examples in C, C++, C#, Lua and Python build and run from what is installed'
