#!/usr/bin/env bash
# Runs the commands of a page as a reader would, with the programs of a build tree, in a temporary folder; page.sh says
# how a page marks them. Servers run in the background on free ports of this machine, and pictures are small.
# usage: run.sh PAGE SOURCE_FOLDER PROGRAM_FOLDER
set -euo pipefail
readonly page=$1 source=$2 bin=$3
here=$(dirname "$(readlink -f "$0")")
readonly here
# shellcheck source=page.sh
source "$here/page.sh"

folder=$(mktemp -d)
server_pid='' waiting=() commands=0 faults=0
cleanup() {
  local pid
  for pid in $server_pid "${waiting[@]}"; do kill -TERM "$pid" 2>/dev/null || true; done
  wait
  rm -rf "$folder"
}
trap cleanup EXIT

mkdir "$folder/page" "$folder/home"
cd "$folder/page"
ln -s "$source/data" data
ln -s "$source/content" content
printf '#!/usr/bin/env bash\nexec "%s/scree_shim.sh" "%s" "%s" "$@"\n' "$here" "$source" "$bin" >scree
chmod +x scree
unset DISPLAY WAYLAND_DISPLAY "${!SCREE_@}" "${!XDG_@}" http_proxy all_proxy
export HOME=$folder/home SCREE_LOG=warn SCREE_QUALITY=low SCREE_SIZE=96x54
TIMEFORMAT='    %U + %S s of the processor'

die() {
  printf '%s: %s\n' "$page" "$*" >&2
  exit 1
}

on_fault() {
  printf '%s:%s: %s\n' "$page" "$1" "$2" >&2
  faults=$((faults + 1))
}

on_file() { mkdir -p "$(dirname "$1")" && printf '%s' "$2" >"$1"; }

stop_server() {
  [[ -n $server_pid ]] || return 0
  kill -TERM "$server_pid"
  wait "$server_pid" || die "the server ended with $?: $(tail -n 3 server.log)"
  server_pid='' SCREE_PORT=''
}

# start_server COMMAND: in the background, until it listens.
start_server() {
  stop_server
  rm -f server.out
  SCREE_PORT=0 bash -c "exec $1" >server.out 2>server.log </dev/null &
  server_pid=$!
  local deadline=$((SECONDS + 60))
  until SCREE_PORT=$(sed -n 's/.*"listening":\([0-9]*\).*/\1/p' server.out 2>/dev/null) && [[ -n $SCREE_PORT ]]; do
    kill -0 "$server_pid" 2>/dev/null || die "the server does not start: $1: $(tail -n 3 server.log)"
    ((SECONDS < deadline)) || die "the server does not listen: $1"
    sleep 0.05
  done
  export SCREE_PORT
}

# What a test changes in a command: it must stay on this machine, on its own server's port.
for_test() {
  local command=$1
  command=${command//--bind 0.0.0.0/--bind 127.0.0.1}
  command=${command//localhost:4177/localhost:${SCREE_PORT:-4177}}
  command=${command//--server localhost/--server localhost:${SCREE_PORT:-4177}}
  printf '%s' "$command"
}

# clients: how many the server has.
clients() {
  local said
  said=$("$bin/scree-admin" status --json)
  said=${said#*\"clients\": }
  printf '%s' "${said%%[!0-9]*}"
}

# Starts a command beside others, and waits until it has joined the server, so that it sees what the next one does.
run_beside() {
  local before deadline=$((SECONDS + 60))
  before=$(clients)
  [[ -n $before ]] || die 'the server does not say how many clients it has'
  timeout 100 bash -c "$1" >>output 2>&1 </dev/null &
  waiting+=($!)
  until (($(clients) > before)) || ! kill -0 $! 2>/dev/null; do
    ((SECONDS < deadline)) || die "it does not join the server: $1"
    sleep 0.1
  done
}

wait_for_all() {
  local pid
  for pid in "${waiting[@]}"; do wait "$pid" || die "a command of those together ended with $?: $(tail -n 5 output)"; done
  waiting=()
}

on_command() {
  local mark=$1 command status=0 wanted=0
  command=$(for_test "$2")
  [[ $mark == 'run: together' ]] || wait_for_all
  [[ $mark != 'not run: '* ]] || return 0
  commands=$((commands + 1))
  case $mark in
    'run: without server') stop_server ;;
    'run: exits with '*) wanted=${mark##* } ;;
  esac
  printf '%s\n' "$command"
  if [[ $command == './scree server'* && $command != './scree server config '* && $command != *' --version' && $command != *' --help' ]]; then
    start_server "$command"
  elif [[ $mark == 'run: together' ]]; then
    run_beside "$command"
  else
    time timeout 100 bash -c "$command" >output 2>&1 </dev/null || status=$?
    ((status == wanted)) || die "ended with $status, not with $wanted: $command: $(tail -n 5 output)"
  fi
}

read_page "$source/$page"
wait_for_all
stop_server
((faults == 0)) || exit 1
printf '%s: %s commands ran\n' "$page" "$commands"
