#!/usr/bin/env bash
# inside.sh USER HEALTH…: a server's life in the sandbox of conditions.sh. It starts as the image does, serves the page, is
# carved, stops, starts again, and has its terrain. HEALTH is the image's health check.
set -euo pipefail
user=$1
shift
health=("$@")
server=
trap '[[ -z $server ]] || kill -KILL "$server" 2>/dev/null || true' EXIT
fail() {
  echo "inside: $*" >&2
  [[ ! -e server.log ]] || cat server.log >&2
  exit 1
}

# The sandbox is the one that was meant.
[[ $(id -u) == "$user" ]] || fail "the user is $(id -u)"
[[ $(sed -n 's/^CapEff:\t//p' /proc/self/status) == 0000000000000000 ]] || fail "there are capabilities"
[[ $(sed -n 's/^NoNewPrivs:\t//p' /proc/self/status) == 1 ]] || fail "there may be new privileges"
for place in / /tmp /usr /etc /var/tmp; do
  ! (: >"$place/probe") 2>/dev/null || fail "$place can be written"
done

start() {
  scree-server >listening.json 2>server.log &
  server=$!
  for _ in {1..600}; do
    if "${health[@]}" >health.txt 2>&1; then return; fi
    kill -0 "$server" 2>/dev/null || fail "the server ended at once"
    sleep 0.1
  done
  fail "the server did not become healthy: $(cat health.txt)"
}
stop() {
  kill -TERM "$server"
  wait "$server" || fail "the server ended with $?"
  server=
}
tell() { scree-admin --json "$@"; }
carve() { /tools/scree-bot --host 127.0.0.1 --carves 5 --rate 5 --seed 7 --linger --check-hash --timeout 120 --quiet --report - "$@"; }

start
# Who keeps the token elsewhere has a healthy server as well.
SCREE_ADMIN_TOKEN_FILE=/worlds/none "${health[@]}" >/dev/null || fail "health needs the token's file"
# The log may come later than the health.
for ((i = 0; i < 100; ++i)); do
  grep -q 'an admin token was made' server.log && break
  sleep 0.1
done
grep -q 'an admin token was made' server.log || fail "the first start says nothing of its token"
token=$(head -n 1 "$SCREE_ADMIN_TOKEN_FILE")
((${#token} >= 16)) || fail "the token has ${#token} characters"
# In whole: a grep that has found it closes the pipe, which curl may take for a fault.
curl -sf "http://127.0.0.1:$SCREE_PORT/" >page.html || fail "there is no page"
grep -qi '<title>' page.html || fail "what is served is no page"
curl -sf "http://127.0.0.1:$SCREE_PORT/readyz" >/dev/null || fail "the server is not ready"

status=0
carve >visitor.json 2>visitor.err || status=$?
((status == 3)) || fail "a visitor without a token may carve here: the bot ended with $status"
carve --token "$token" >bot.json 2>bot.err || fail "five carves with the token failed: $(cat bot.err)"
scree-admin ban 203.0.113.9 --reason 'too loud' || fail "a ban failed"
before=$(tell status | sed -n 's/.*"terrain": \(-\{0,1\}[0-9]*\).*/\1/p')
stop
[[ -s $SCREE_WORLD ]] || fail "there is no world in the volume"

start
! grep -q 'an admin token was made' server.log || fail "the second start makes another token"
[[ $(head -n 1 "$SCREE_ADMIN_TOKEN_FILE") == "$token" ]] || fail "the token changed"
after=$(tell status | sed -n 's/.*"terrain": \(-\{0,1\}[0-9]*\).*/\1/p')
[[ -n $before && $before == "$after" ]] || fail "the terrain was $before, and is $after"
scree-admin bans | grep -q 203.0.113.9 || fail "the ban is lost"
stop
echo "inside: five carves and a ban outlived the restart; terrain $after"
