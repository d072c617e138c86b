#!/usr/bin/env bash
# The demo: a server on the canyon, a viewer, and a bot that carves. `./scree demo` builds the programs first.
# With a display a window opens, to play in until it is closed; a second server replays the first one's recording, so that J
# rewinds there. Without one the viewer draws offscreen and
# leaves before.png, blast.png and settled.png, and browser.png where Chromium can draw the page. Either way a summary of the session follows.
set -euo pipefail

root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
# A test of the documentation runs the demo with the programs of its own build tree.
readonly root bin=${SCREE_PROGRAMS:-$root/build/release/bin}
# Seconds. A software renderer on two busy cores is slow; nothing here should come near these.
readonly start_s_max=60 session_s_max=600
# Where the bot carves, metres: between the cliff and the arch, all of it before the spawn. A scene has places of its own.
area_m=10 stage_m=(9 4) world=(--terrain canyon --spawn 30,9,19,63,-7)
# When the second picture is due, and the last. First by pieces in flight: about two carves' worth, which three carves a
# second reach. In a scene rock may be thin.
middle='pieces>=100' last=settled

# In a game (games/NAME): what the first bot does besides, and the options of each further one.
first_bot=() bots=()

out="$root/out/demo" scene='' game='' carves=20 seed=7 rate=3 offscreen=auto size=1280x720
server_pid='' past_pid='' viewer_pid='' bot_pid='' more_bots=()

usage() {
  cat <<'TEXT'
usage: ./scree demo [--scene NAME | --game NAME] [--out DIR] [--carves N] [--seed N] [--rate N] [--size WxH] [--offscreen]

  --scene NAME   show this scene instead of the canyon; ./scree scene list lists them
  --game NAME    let bots play a game with rules of its own: demolition, floor, plots or quarry
  --out DIR      folder for pictures, reports and logs (default: out/demo)
  --carves N     number of carves of the bot (default: 20)
  --seed N       seed of the bot's random choices (default: 7)
  --rate N       carves a second (default: 3)
  --size WxH     size of the window or the pictures (default: 1280x720)
  --offscreen    draw pictures, even if there is a display
TEXT
}

say() { printf 'demo: %s\n' "$*"; }
# die MESSAGE [LOG]
die() {
  printf 'demo: error: %s\n' "$1" >&2
  if [[ -s ${2:-} ]]; then
    printf 'the end of %s:\n' "$2" >&2
    tail -n 15 "$2" >&2
  fi
  exit 1
}

parse() {
  while (($#)); do
    case $1 in
      --scene | --game | --out | --carves | --seed | --rate | --size)
        (($# > 1)) || die "$1 needs a value"
        printf -v "${1#--}" '%s' "$2"
        shift
        ;;
      --offscreen) offscreen=yes ;;
      --help | -h)
        usage
        exit 0
        ;;
      *) die "there is no option '$1'; ./scree demo --help lists them" ;;
    esac
    shift
  done
  [[ -z $scene || -z $game ]] || die "--scene and --game exclude each other"
  [[ $carves =~ ^[1-9][0-9]{0,5}$ ]] || die "--carves: write a number from 1 to 999999"
  # Of few carves, or slow ones, not so many pieces are ever in flight.
  if ((carves < 3)) || [[ $rate =~ ^[01](\.|$) ]]; then middle='pieces>=30'; fi
}

# Ends what is still running, and only that.
cleanup() {
  local pid
  for pid in $viewer_pid $bot_pid "${more_bots[@]}" $past_pid $server_pid; do
    kill -TERM "$pid" 2>/dev/null || true
  done
  wait
}

# wait_until SECONDS PID WHAT LOG COMMAND…: polls the command; the process PID must stay alive meanwhile.
wait_until() {
  local deadline=$((SECONDS + $1)) pid=$2 what=$3 log=$4
  shift 4
  until "$@"; do
    kill -0 "$pid" 2>/dev/null || { "$@" && return; } || die "$what: the program ended early" "$log"
    ((SECONDS < deadline)) || die "$what: nothing after the deadline" "$log"
    sleep 0.1
  done
}

# wait_for_exit SECONDS PID WHAT LOG: waits for a program of ours to end well.
wait_for_exit() {
  local deadline=$((SECONDS + $1))
  while kill -0 "$2" 2>/dev/null; do
    ((SECONDS < deadline)) || die "$3 did not finish in $1 s" "$4"
    sleep 0.1
  done
  wait "$2" || die "$3 failed" "$4"
}

# make_scene: the scene's world, which has a spawn, and where its strikes lie.
make_scene() {
  local file="$out/scene.world"
  "$bin/scree-scene" make "$scene" "$file" >"$out/scene.json" || die "there is no world of the scene '$scene'"
  world=(--world "$file") middle='pieces>=20' area_m=3
  mapfile -t stage_m < <(jq -r '.centre[]' "$out/scene.json")
}

# set_game: its world, where it is looked at from, and what bots do in it: the first one's carves are the demo's.
set_game() {
  world=(--terrain flat --game "$game") middle='pieces>=20'
  case $game in
    demolition)
      world+=(--spawn 0,22,34,0,-25) stage_m=(24 0) area_m=3 first_bot=(--radius 1.4 --name anna --message team red)
      bots=("--name ben --message team blue --centre -24 0 --area 3 --carves $carves --rate $rate --radius 1.4 --seed $((seed + 1))")
      ;;
    floor)
      world+=(--persons walk --spawn 0,9,15,0,-35) carves=0 middle='pieces>=5' first_bot=(--walk 24 --walk-in 0 0 5.5 --name anna)
      bots=("--name ben --carves 0 --walk 24 --walk-in 0 0 5.5 --seed $((seed + 1))" "--name carl --carves 0 --walk 24 --walk-in 0 0 5.5 --seed $((seed + 2))")
      ;;
    quarry)
      world+=(--spawn 0,16,34,0,-25) carves=0 rate=0.25 middle='after=18' last='after=30' stage_m=(0 22) area_m=3
      local moves='--digs 3 --places 3 --place-centre 0 0 --radius 1.6'
      # shellcheck disable=SC2206  # options are words
      first_bot=($moves --name anna)
      bots=("--name ben --centre -18 -10" "--name carl --centre 18 -10" "--name dora --centre 0 -24")
      bots=("${bots[@]/%/ $moves --carves 0 --area $area_m --rate $rate}")
      ;;
    plots)
      world+=(--spawn 0,16,28,0,-25) stage_m=(0 0) area_m=5 first_bot=(--name anna --say /claim)
      bots=("--name ben --say /claim --centre -16 -16 --area 5 --carves $carves --rate $rate --seed $((seed + 1))")
      ;;
    *) die "there is no game '$game': choose demolition, floor, plots or quarry" ;;
  esac
}

# start_server [OPTIONS…]
start_server() {
  "$bin/scree-server" --host 127.0.0.1 --port 0 "${world[@]}" --report "$out/server.json" "$@" \
    >"$out/server.out" 2>"$out/server.log" &
  server_pid=$!
  wait_until "$start_s_max" "$server_pid" "the server should listen" "$out/server.log" \
    grep -qs '"listening"' "$out/server.out"
  port=$(jq -r 'select(.listening) | .listening' "$out/server.out")
  say "the server listens on port $port"
  page=$(jq -r 'select(.page) | .page' "$out/server.out")
}

# start_past: another server, which replays what the first one records, a second behind.
start_past() {
  "$bin/scree-server" --host 127.0.0.1 --port 0 --replay "$out/session.scree" >"$out/past.out" 2>"$out/past.log" &
  past_pid=$!
  wait_until "$start_s_max" "$past_pid" "the replay should listen" "$out/past.log" grep -qs '"listening"' "$out/past.out"
  past=$(jq -r 'select(.listening) | .listening' "$out/past.out")
}

# start_bot SECONDS: carves, stays until all has settled, then compares its hash with the server's.
start_bot() {
  "$bin/scree-bot" --host 127.0.0.1 --port "$port" --centre "${stage_m[@]}" --area "$area_m" \
    --carves "$carves" --seed "$seed" --rate "$rate" --linger --check-hash --timeout "$1" "${first_bot[@]}" \
    --report "$out/bot.json" >"$out/bot.log" 2>&1 &
  bot_pid=$!
  local options
  for options in "${bots[@]}"; do
    sleep 1 # the first one comes first, to the plot in the middle
    # shellcheck disable=SC2086  # options are words
    "$bin/scree-bot" --host 127.0.0.1 --port "$port" $options --timeout "$1" >>"$out/bots.log" 2>&1 &
    more_bots+=($!)
  done
  if [[ -n $game ]]; then say "$((1 + ${#bots[@]})) bots play $game"; else say "a bot carves $carves times"; fi
}

play_in_window() {
  start_past
  [[ -z $page ]] || say "in a browser: $page#past=$past"
  say "close the window to end the demo"
  "$bin/scree-viewer" --host 127.0.0.1 --port "$port" --past "$past" --size "$size" \
    >"$out/viewer.log" 2>&1 &
  viewer_pid=$!
  start_bot 86400 # the player may go on for as long as they like
  wait "$viewer_pid" || die "the viewer failed (--offscreen needs no display)" "$out/viewer.log"
  viewer_pid=''
  wait_for_exit "$session_s_max" "$bot_pid" "the bot" "$out/bot.log"
}

draw_pictures() {
  say "no display: drawing before.png, blast.png and settled.png offscreen"
  "$bin/scree-viewer" --host 127.0.0.1 --port "$port" --offscreen --size "$size" \
    --timeout "$session_s_max" \
    --screenshot "$out/before.png@joined" --screenshot "$out/blast.png@$middle" \
    --screenshot "$out/settled.png@$last" >"$out/viewer.log" 2>&1 &
  viewer_pid=$!
  wait_until "$session_s_max" "$viewer_pid" "the first picture" "$out/viewer.log" test -s "$out/before.png"
  start_bot "$session_s_max"
  wait_for_exit "$session_s_max" "$bot_pid" "the bot" "$out/bot.log"
  wait_for_exit "$session_s_max" "$viewer_pid" "the viewer" "$out/viewer.log"
  viewer_pid=''
  local picture
  for picture in before blast settled; do
    [[ -s $out/$picture.png ]] || die "there is no $picture.png" "$out/viewer.log"
  done
}

# The page as a browser shows it, where ./scree web has built it and ./scree test has installed the modules that drive Chromium.
draw_page() {
  [[ -z ${SCREE_PROGRAMS:-} ]] || return 0 # tests of the page draw it
  [[ -e $root/build/web/dist/index.html && -e $root/build/page/node_modules/.installed ]] && command -v chromium >/dev/null || return 0
  say "drawing browser.png in Chromium"
  "$root/tests/page/run.sh" "$root/build/page" draw.js "$page#quality=low" "$out/browser.png" "$size" >"$out/browser.log" 2>&1 ||
    say "Chromium drew nothing: $out/browser.log says why"
}

stop_server() {
  if [[ -n $past_pid ]]; then
    kill -TERM "$past_pid"
    wait_for_exit "$start_s_max" "$past_pid" "the replay" "$out/past.log"
    past_pid=''
  fi
  kill -TERM "$server_pid"
  wait_for_exit "$start_s_max" "$server_pid" "the server" "$out/server.log"
  server_pid=''
}

# The session in numbers: the server's, but for what crossed the wire and the hashes, which a client must say.
summary() {
  printf '\n'
  # shellcheck disable=SC2016  # the $… are jq's
  jq -rn --slurpfile server "$out/server.json" --slurpfile bot "$out/bot.json" '
    def rounded($digits): . * pow(10; $digits) | round / pow(10; $digits) | tostring;
    $server[0] as $s | $bot[0] as $b | $s.stages_ms.tick as $tick | [
      ["carves", "\($b.carves.accepted)\(($s.carves - $b.carves.accepted) as $dents | if $dents > 0 then ", dents: \($dents)" else "" end)"],
      ["pieces made", "\($s.pieces_made)"],
      ["pieces merged", "\($s.pieces_merged)"],
      ["pieces still alive", "\($s.pieces_alive)"],
      ["ledger error", "\($s.ledger.error) of \($s.ledger.moved) units moved"],
      ["bytes per carve", "\($b.bytes_per_carve.mean | rounded(0)) (transforms aside)"],
      ["median tick", "\($tick.median | rounded(2)) ms"],
      ["worst tick", "\($tick.worst | rounded(2)) ms"],
      ["hashes equal", "\(if $b.hash.equal then "yes" else "NO" end), \($b.checks) checks, \($b.mismatches) mismatches"]
    ] | .[] | @tsv' | while IFS=$'\t' read -r name value; do printf '  %-20s %s\n' "$name" "$value"; done
  printf '\n'
  if [[ -e $out/settled.png ]]; then say "pictures: $out/before.png blast.png settled.png$([[ ! -e $out/browser.png ]] || echo ' browser.png')"; fi
  say "reports: $out/server.json bot.json"
}

main() {
  parse "$@"
  mkdir -p "$out"
  out=$(cd "$out" && pwd)
  rm -f "$out"/scene.{world,world-wal,world-shm,json} "$out"/session.scree{,-wal,-shm} "$out"/{server,bot,past}.{json,out,log} "$out"/{viewer,browser,bots}.log "$out"/{before,blast,settled,browser}.png
  trap cleanup EXIT
  [[ -z $scene ]] || make_scene
  [[ -z $game ]] || set_game
  if [[ $offscreen == auto && -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
    start_server --record "$out/session.scree"
    play_in_window
  else
    start_server
    [[ -z $page ]] || say "in a browser: $page"
    draw_pictures
    draw_page
  fi
  bot_pid=''
  stop_server
  summary
}

main "$@"
