#!/usr/bin/env bash
# The commands that pages name in a line, or show but cannot run in a test, have only options that their program's --help
# knows; and so have the options that pages name by themselves.
# usage: options.sh SOURCE_FOLDER PROGRAM_FOLDER PAGE…
set -euo pipefail
readonly source=$1 bin=$2
shift 2
# shellcheck source=page.sh
source "$(dirname "$(readlink -f "$0")")/page.sh"

faults=0 page='' checked=0
fault() {
  printf '%s: %s\n' "$page" "$*" >&2
  faults=$((faults + 1))
}

# help_of COMMAND [SUBCOMMAND]: what --help prints of both, from a cache.
declare -A helps
help_of() {
  local key="$1 ${2:-}" own
  if [[ -z ${helps[$key]:-} ]]; then
    if program_of "$@"; then
      [[ -x $bin/$program ]] || { helps[$key]=unbuilt && return; } # scree-studies: ./scree bench builds it
      helps[$key]=$("$bin/$program" "${subcommand[@]}" --help)
      # Where the second word is a subcommand, it has options of its own.
      own=${2:-}
      if [[ $own =~ ^[a-z]+$ && $consumed == 1 ]]; then helps[$key]+=$("$bin/$program" "$own" --help 2>/dev/null || true); fi
    else
      helps[$key]=$("$source/scree" "$1" --help)
    fi
  fi
}

# check WORDS…: a command without ./scree.
check() {
  local command=$1 word
  [[ " setup build web test fuzz demo $(sed -n 's/^  \([a-z]*\) .*/\1/p' <<<"$scree_help" | tr '\n' ' ') " == *" $command "* ]] ||
    { fault "there is no command ./scree $command" && return; }
  help_of "$command" "${2:-}"
  [[ ${helps[$command ${2:-}]} != unbuilt ]] || return 0
  for word in "${@:2}"; do
    [[ $word == --?* ]] || continue
    checked=$((checked + 1))
    word=${word%%=*}
    grep -qE -- "(^|[^a-z-])${word}([^a-z-]|$)" <<<"${helps[$command ${2:-}]}" || fault "./scree $command ${2:-} has no option $word"
  done
}

on_fault() { :; } # run.sh tells
on_file() { :; }
on_command() {
  [[ $1 == 'not run: '* && $2 == *./scree\ * ]] || return 0
  local -a words
  read -ra words <<<"${2//$'\n'/ }"
  [[ ${words[0]} == ./scree ]] || return 0
  check "${words[@]:1}"
}

# Every option of every program, to look those up that stand alone.
all_help() {
  local name
  for name in server viewer bot replay world scene import export admin token bench pictures 'replay render' 'replay control'; do
    # shellcheck disable=SC2086  # two words
    program_of $name && "$bin/$program" "${subcommand[@]}" --help
  done
  for name in 'replay info' 'replay verify' 'replay diff' 'replay cut' 'replay events' 'replay export' 'world new' 'world info' \
    'admin ban' 'admin kick' 'admin set' 'token new' 'token show' 'bench run' 'bench all' 'bench compare'; do
    "$bin/scree-${name% *}" "${name#* }" --help
  done
  for name in setup build test fuzz demo web; do "$source/scree" "$name" --help; done
}

scree_help=$("$source/scree" --help)
all=$(all_help)
readonly scree_help all
for page in "$@"; do
  read_page "$source/$page"
  text=$(sed '/^```/,/^```$/d' "$source/$page")
  while IFS= read -r span; do
    [[ -n $span ]] || continue
    read -ra words <<<"$span"
    check "${words[@]:1}"
  done < <(grep -oP '(?<=`)\./scree [^`]+(?=`)' <<<"$text" || true)
  while IFS= read -r option; do
    [[ -n $option ]] || continue
    checked=$((checked + 1))
    grep -qE -- "(^|[^a-z-])${option}([^a-z-]|$)" <<<"$all" || fault "no program has the option $option"
  done < <(grep -oP '(?<=`)--[a-z][a-z-]*' <<<"$text" | sort -u || true)
done
((checked > 0)) || fault 'no option was found'
((faults == 0)) || exit 1
printf '%s options are known\n' "$checked"
