#!/usr/bin/env bash
# Stands for ./scree in run.sh: runs the programs of a build tree without building them, and draws small pictures.
# usage: scree_shim.sh SOURCE_FOLDER PROGRAM_FOLDER COMMAND ARGUMENTS…
set -euo pipefail
readonly source=$1 bin=$2
shift 2
# shellcheck source=page.sh
source "$(dirname "$(readlink -f "$0")")/page.sh"

# small ARGUMENTS…: sets small_arguments, with a small size, a usual range of view and a film's usual rate in place of those
# given.
small() {
  small_arguments=()
  while (($#)); do
    case "$program $1" in
      *' --size' | *' --view-radius' | 'scree-render --fps') shift ;;
      *) small_arguments+=("$1") ;;
    esac
    shift
  done
  small_arguments+=(--size 96x54)
}

if [[ $1 == demo ]]; then
  program=demo
  small "${@:2}"
  SCREE_PROGRAMS=$bin exec "$source/tools/scripts/demo.sh" --offscreen --out "$PWD/out/demo" --carves 2 "${small_arguments[@]}"
fi
program_of "$@" || { printf 'a test runs no ./scree %s\n' "$1" >&2; exit 2; }
shift "$consumed"
case $program in
  scree-viewer)
    small "$@"
    # Without a window, a picture shows that the viewer comes in.
    [[ " $* " == *' --offscreen '* ]] || small_arguments+=(--offscreen --screenshot "$PWD/window.png")
    set -- "${small_arguments[@]}"
    ;;
  scree-render)
    small "$@"
    set -- --quality low --fps 3 "${small_arguments[@]}"
    ;;
esac
exec "$bin/$program" "${subcommand[@]}" "$@"
