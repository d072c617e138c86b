#!/usr/bin/env bash
# What the client costs in JavaScript beside C: each makes the same storm in a world of its own, one after the other. Prints
# microseconds of a tick, of the mesh of a chunk and of 1,000 poses, and their ratios. Run it on a quiet machine, after
# ./scree build, ./scree web and ./scree test. usage: bench/clients/speed.sh [ROUNDS]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly rounds=${1:-3} bin=$root/build/release/bin lib=$root/build/release/lib
folder=$(mktemp -d)
server=
trap '[[ -z $server ]] || kill "$server" 2>/dev/null || true; rm -rf "$folder"' EXIT
cc -O2 -std=gnu11 -Wall -Wextra -Werror -I "$root/client/library/include" -o "$folder/speed" "$root/bench/clients/speed.c" -L "$lib" -lscree_client
mkdir -p "$folder/node_modules/scree-client"
tar -xzf "$root"/build/web/npm/scree-client-*.tgz -C "$folder/node_modules/scree-client" --strip-components=1
ln -s "$root/build/package/node_modules/ws" "$folder/node_modules/ws"
cp "$root/bench/clients/speed.js" "$folder/speed.mjs"
mkdir "$folder/web"
echo '<!doctype html>' >"$folder/web/index.html"

# measured NAME COMMAND…: prints what the command says of a fresh world.
measured() {
  "$bin/scree-server" --port 0 --terrain flat --recombine off --work-percent 65 --web "$folder/web" >"$folder/out" 2>"$folder/log" &
  server=$!
  local port=
  for ((i = 0; i < 100; ++i)); do
    port=$(jq -r 'select(.listening) | .listening' "$folder/out" 2>/dev/null || true)
    [[ -z $port ]] || break
    sleep 0.1
  done
  [[ -n $port ]] || { cat "$folder/log" >&2; exit 1; }
  (cd "$folder" && "${@:2}" "$port") | tee -a "$folder/$1"
  kill "$server"
  wait "$server" 2>/dev/null || true
  server=
}
for ((round = 0; round < rounds; ++round)); do
  measured c env LD_LIBRARY_PATH="$lib" ./speed
  measured js node speed.mjs
done
# Medians of the rounds, and JavaScript over C.
median() { awk -v column="$2" '{ print $column }' "$folder/$1" | sort -n | awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }'; }
for column in 1 2 3; do
  name=$(cut -d' ' -f"$column" <<<'tick_us chunk_mesh_us thousand_poses_us')
  c=$(median c "$column") js=$(median js "$column")
  awk -v name="$name" -v c="$c" -v js="$js" 'BEGIN { printf "%-20s C %8.1f  JavaScript %8.1f  ratio %.2f\n", name, c, js, js / c }'
done
