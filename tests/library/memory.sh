#!/usr/bin/env bash
# Memory and threads of clients in C: 1,000 connects and disconnects, and the example under valgrind, which finds nothing.
# usage: memory.sh LIBRARY INCLUDE EXAMPLES SERVER [CONNECTS]
set -euo pipefail
readonly library=$1 include=$2 examples=$3 server=$4 connects=${5:-1000}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
started=()
trap 'kill "${started[@]}" 2>/dev/null || true; wait 2>/dev/null || true; rm -rf "$folder"' EXIT
export LD_LIBRARY_PATH=$library

cc -std=gnu11 -Wall -Wextra -Werror -g -I "$include" -o "$folder/connects" "$here/connects.c" -L "$library" -lscree_client
cc -std=c99 -Wall -Wextra -Werror -g -I "$include" -o "$folder/groups" "$examples/c/groups.c" -L "$library" -lscree_client
# A server takes so many handshakes of one address only where it is told to.
"$server" --port 0 --terrain flat >"$folder/server.out" 2>"$folder/server.log" &
started+=($!)
port=
for ((i = 0; i < 300; ++i)); do
  port=$(jq -r 'select(.listening) | .listening' "$folder/server.out" 2>/dev/null || true)
  [[ -z $port ]] && kill -0 "${started[-1]}" 2>/dev/null || break
  sleep 0.1
done
[[ -n $port ]] || { cat "$folder/server.log" >&2; exit 1; }
"$folder/connects" "$port" "$connects" || { tail -3 "$folder/server.log" >&2; echo 'a thread or memory is left' >&2; exit 1; }
if command -v valgrind >/dev/null; then
  timeout 250 valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite,indirect "$folder/groups" "$port" ||
    { echo 'valgrind has found something' >&2; exit 1; }
fi
