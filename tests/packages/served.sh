# shellcheck shell=bash
# For life.sh and examples.sh: a server as the service runs it, where there is no systemd.
fail() { echo "packages: $*" >&2; [[ ! -e /tmp/server.log ]] || tail -n 5 /tmp/server.log >&2; exit 1; }

# install_packages NAME…: our packages by these names, with what they depend on.
install_packages() {
  local name files=()
  for name in "$@"; do files+=(/packages/"${name}"_*.deb); done
  apt-get -q -y install "${files[@]}" >/tmp/apt.log 2>&1 || { tail -n 30 /tmp/apt.log >&2; return 1; }
}

# of_unit KEY: its value in the service of the world hill.
of_unit() { sed -n "s/^$1=//p" /lib/systemd/system/scree@.service | sed 's/%i/hill/g; s|%S|/var/lib|g; s|%t|/run|g'; }

# serve: as the unit says, until scree-admin finds the server ready.
serve() {
  local user folder
  user=$(of_unit User) folder=$(of_unit WorkingDirectory)
  install -d -o "$user" -g "$(of_unit Group)" -m "$(of_unit StateDirectoryMode)" "$folder"
  install -d -o "$user" -g "$(of_unit Group)" "/run/$(of_unit RuntimeDirectory)"
  # shellcheck disable=SC2046  # the words of a command
  (cd "$folder" && umask "$(of_unit UMask)" &&
    exec env "$(of_unit Environment)" setpriv --reuid "$user" --regid "$user" --clear-groups --no-new-privs --bounding-set=-all $(of_unit ExecStart)) \
    >/tmp/listening.json 2>/tmp/server.log &
  server=$!
  for ((i = 0; i < 600; ++i)); do
    ! scree-admin health --ready >/dev/null 2>&1 || return 0
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
  done
  fail 'the server does not become ready'
}
stop() { kill -TERM "$server" && wait "$server" || fail "the server ended with $?"; }
