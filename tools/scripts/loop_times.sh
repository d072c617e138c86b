#!/usr/bin/env bash
# Measures how long an edit takes to its tests' result: adds a line to a source, runs `./scree test FOLDER [FILTER]`, and
# prints the seconds that passed and those of the processor. The sources are put back at the end.
# usage: tools/scripts/loop_times.sh [FILE:FOLDER[:FILTER]…]; default: five files of five rooms
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

edits=("$@")
if ((${#edits[@]} == 0)); then
  edits=(shared/field/edit.cpp:field server/world/world.cpp:world server/net/net_host.cpp:net
    client/mirror/mirror.cpp:client client/render/renderer.cpp:render:Looks)
fi

saved=$(mktemp -d)
trap 'put_back; rm -rf "$saved"' EXIT
edited=''
put_back() {
  [[ -z $edited ]] || cp "$saved/source" "$edited"
  edited=''
}

for edit in "${edits[@]}"; do
  IFS=: read -r file folder filter <<<"$edit"
  test=(./scree test "$folder" ${filter:+"$filter"})
  "${test[@]}" >"$saved/log" 2>&1 || { cat "$saved/log" >&2; exit 1; } # all else is built
  cp "$file" "$saved/source"
  edited=$file
  # ccache has not seen this line.
  printf '// Edited at %s.\n' "$(date +%s%N)" >>"$file"
  TIMEFORMAT="%R s, %U + %S s of the processor"
  took=$({ time "${test[@]}" >"$saved/log" 2>&1; } 2>&1) || { cat "$saved/log" >&2; exit 1; }
  printf '%-32s %-8s %s (%s)\n' "$file" "$folder" "$took" "$(sed -n 's/^scree: built in /built in /p' "$saved/log")"
  put_back
done
