#!/usr/bin/env bash
# life.sh install|run: the life of the packages. They are installed, serve a world as docs/host.md says, are upgraded, and go;
# the world outlives all of that.
set -euo pipefail
# shellcheck source=served.sh
source /tests/served.sh
if [[ $1 == install ]]; then
  names=(scree-server scree-tools scree-viewer)
  ! compgen -G '/packages/scree-web_*.deb' >/dev/null || names+=(scree-web)
  install_packages "${names[@]}"
  exit
fi
version() { dpkg-query -W -f '${Version}' scree-server; }
terrain() { scree-admin --json status | sed -n 's/.*"terrain": \(-\{0,1\}[0-9]*\).*/\1/p' | paste -sd' '; }

# Every program starts, by the libraries that its package depends on.
for program in /usr/bin/scree-*; do
  said=$("$program" --version) || fail "$program does not start: $(ldd "$program" | grep 'not found')"
  [[ $(version) == "$said"* ]] || fail "$program is $said, and its package $(version)"
done

cp /usr/share/doc/scree-server/examples/world.toml /etc/scree/hill.toml
serve
[[ $(stat -c '%U %a' /var/lib/scree/hill/hill.world) == 'scree 600' ]] || fail 'the world is not its user'\''s alone'
token=/var/lib/scree/hill/admin.token
carve() { scree-bot --carves 3 --rate 5 --seed 7 --linger --check-hash --timeout 60 --quiet --report - "$@" >/tmp/bot.json 2>/tmp/bot.log; }
status=0
carve || status=$?
((status == 3)) || fail "a visitor may carve by the example of options: the bot ended with $status"
carve --token-file "$token" || fail "three carves failed: $(cat /tmp/bot.log)"
scree-admin --token-file "$token" ban 203.0.113.9 --reason 'too loud' >/dev/null
if [[ -e /usr/share/scree/web/index.html ]]; then
  exec 3<>/dev/tcp/127.0.0.1/4177
  printf 'GET / HTTP/1.0\r\nHost: localhost\r\n\r\n' >&3
  grep -qai '<title>' <&3 || fail 'the server serves no page'
fi
[[ $(stat -c '%U %a' /run/scree/hill.sock) == 'scree 600' ]] || fail 'the socket of administrators is not its user'\''s alone'
scree-admin --socket /run/scree/hill.sock bans | grep -q 203.0.113.9 || fail 'root is no administrator by the socket'
before=$(terrain)
stop
[[ ! -e /run/scree/hill.sock ]] || fail 'the socket outlives its server'
scree-world check /var/lib/scree/hill/hill.world >/dev/null || fail 'the world is damaged'
scree-replay verify /var/lib/scree/hill/hill.scree >/dev/null || fail 'the recording does not verify'

# A higher version goes on with the world. Nothing of it comes from the network, which is not there.
was=$(version)
dpkg -i /packages/higher/scree-server_*.deb >/tmp/dpkg.log 2>&1 || fail "the upgrade failed: $(cat /tmp/dpkg.log)"
[[ $(version) == "$was.1" ]] || fail "the upgrade left the version $(version)"
serve
[[ -n $before && $(terrain) == "$before" ]] || fail "the terrain was $before, and is $(terrain) after the upgrade"
scree-admin --token-file "$token" bans | grep -q 203.0.113.9 || fail 'the ban is lost'
stop

# What is purged leaves what its host made, and the user that owns it.
mapfile -t names < <(dpkg-query -W -f '${Package}\n' 'scree-*')
dpkg --purge "${names[@]}" >/tmp/dpkg.log 2>&1 || fail "the packages cannot be purged: $(cat /tmp/dpkg.log)"
grep -q '/var/lib/scree is not empty, and stays' /tmp/dpkg.log || fail 'nobody says that the world stays'
left=$(find / -xdev \( -path /tests -o -path /packages -o -path /examples -o -path /docs -o -path /proc -o -path /dev -o -path /tmp -o -path /var/cache/apt \) -prune \
  -o -iname '*scree*' ! -iname '*screen*' -print | sort | tr '\n' ' ')
[[ $left == '/etc/scree /var/lib/scree /var/lib/scree/hill/hill.scree ' ]] || fail "this is left: $left"
[[ $(ls /etc/scree) == hill.toml && -s /var/lib/scree/hill/hill.world ]] || fail 'the world or its options are gone'
rm -r /var/lib/scree /etc/scree
echo "packages: $was served, was upgraded and went; the terrain $before outlived it"
