#!/usr/bin/env bash
# The same 200 edits by clients in C, C#, Lua, Python, Node and a browser, against one server: each carries out its share, all
# follow all, and all have the server's hash in the end. Python, Node and the browser are left out where they are not built.
# usage: same_edits.sh LIBRARY INCLUDE EXAMPLES SERVER [PYTHON MODULE [NODE_MODULES NPM]]
set -euo pipefail
readonly library=$1 include=$2 examples=$3 server=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
started=()
trap 'kill "${started[@]}" 2>/dev/null || true; wait 2>/dev/null || true; rm -rf "$folder"' EXIT
export LD_LIBRARY_PATH=$library LIBSCREE_INCLUDE=$include LUA_PATH="$examples/luajit/?.lua;;"

cc -std=c11 -Wall -Wextra -Werror -I "$include" -o "$folder/in_c" "$here/same_edits.c" -L "$library" -lscree_client
clients=("$folder/in_c")
if command -v luajit >/dev/null; then clients+=("luajit $here/same_edits.lua"); fi
if command -v mcs >/dev/null; then
  mcs -out:"$folder/edits.exe" "$here/SameEdits.cs" "$examples/csharp/Scree.cs"
  clients+=("mono $folder/edits.exe")
fi
if [[ -n ${6:-} && -e $6/scree.pyi ]]; then
  export PYTHONPATH=$6 PYTHONDONTWRITEBYTECODE=1
  clients+=("$5 $here/same_edits.py")
fi
page=(--web off)
if [[ -n ${8:-} ]] && packed=$(compgen -G "$8/scree-client-*.tgz") && [[ -d $7/node_modules ]]; then
  mkdir -p "$folder/web/scree-client"
  page=(--web "$folder/web")
  tar -xzf "$packed" -C "$folder/web/scree-client" --strip-components=1
  cp "$here"/../package/{edits.html,edits.js,carried_out.js} "$folder/web"
  cp "$folder/web/edits.html" "$folder/web/index.html"
  clients+=("$here/../package/run.sh $7 $8 same_edits.js" "$here/../package/run.sh $7 $8 browser_edits.js")
fi
printf 'by %s\n' "${clients[@]##*/}"

"$server" --port 0 --terrain flat --anonymous builder --reach 0 "${page[@]}" >"$folder/server.out" 2>"$folder/server.log" &
started+=($!)
port=
for ((i = 0; i < 300; ++i)); do
  port=$(jq -r 'select(.listening) | .listening' "$folder/server.out" 2>/dev/null || true)
  [[ -z $port ]] && kill -0 "${started[-1]}" 2>/dev/null || break
  sleep 0.1
done
[[ -n $port ]] || { cat "$folder/server.log" >&2; exit 1; }

pids=()
for i in "${!clients[@]}"; do
  ${clients[i]} "$port" "$here/edits.txt" "$i" "${#clients[@]}" "$folder/go" >"$folder/hash$i" 2>"$folder/said$i" &
  pids+=($!)
  started+=($!)
done
# Who is done early must not take the pause of a slow one for the end.
while (($(cat "$folder"/hash* | grep -c '^done$') < ${#clients[@]})); do
  for i in "${!clients[@]}"; do
    kill -0 "${pids[i]}" 2>/dev/null || { echo "${clients[i]} ended: $(cat "$folder/said$i")" >&2; exit 1; }
  done
  sleep 0.1
done
touch "$folder/go"
for i in "${!clients[@]}"; do
  wait "${pids[i]}" || { echo "${clients[i]} failed: $(cat "$folder/said$i")" >&2; exit 1; }
done
hashes=$(tail -qn 1 "$folder"/hash*)
echo "$hashes"
[[ $(wc -l <<<"$hashes") == "${#clients[@]}" && $(sort -u <<<"$hashes" | wc -l) == 1 && $hashes != 0000000000000000* ]] ||
  { echo 'all clients should have the same hash' >&2; exit 1; }
