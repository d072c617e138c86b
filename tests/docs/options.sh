#!/usr/bin/env bash
# The commands that pages name in a line, or show but cannot run in a test, have only options that their program's --help
# knows; and so have the options and variables that pages name by themselves, and the names of the C interface.
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

# names_in TEXT: the options and variables in it, each between spaces.
names_in() { printf ' %s ' "$(grep -oE -- '--[a-z][a-z-]*|SCREE_[A-Z_]+' <<<"$1" | sort -u | tr '\n' ' ')"; }

# print_help COMMAND [SUBCOMMAND…]: what --help prints for it. Benches and studies are not built for the tests: their sources
# name the options.
print_help() {
  if ! program_of "$@"; then
    "$source/scree" "$1" --help
  elif [[ $program == scree-bench || $program == scree-pictures ]]; then
    cat "$source"/bench/programs/*.cpp
  elif [[ $program == scree-studies ]]; then
    cat "$source"/studies/programs/*.cpp
  elif [[ $consumed == 1 && $# -ge 2 ]]; then
    "$bin/$program" "${@:2}" --help 2>/dev/null || true # no subcommand, but an argument
  else
    # The address and the token are options of scree-admin itself.
    [[ ${subcommand[0]:-} != rules ]] || "$bin/$program" --help
    "$bin/$program" "${subcommand[@]}" --help
  fi
}

# help_of COMMAND [SUBCOMMAND]: sets help to the names in it, from a cache.
declare -A helps
help_of() {
  local key="$*" own=''
  if [[ -z ${helps[$key]:-} ]]; then
    if (($# == 2)); then
      help_of "$1"
      own=$help
    fi
    helps[$key]=$own$(names_in "$(print_help "$@")")
  fi
  help=${helps[$key]}
}

# check WORDS…: a command without ./scree.
check() {
  local word
  [[ $1 != --help ]] || return 0
  [[ " $commands " == *" $1 "* ]] || { fault "there is no command ./scree $1" && return; }
  if [[ ${2:-} =~ ^[a-z][a-z-]*$ ]]; then help_of "$1" "$2"; else help_of "$1"; fi
  for word in "${@:2}"; do
    [[ $word == --?* && $word != --gtest_* ]] || continue
    checked=$((checked + 1))
    [[ $help == *" ${word%%=*} "* ]] || fault "./scree $1 ${2:-} has no option ${word%%=*}"
  done
}

on_fault() { :; } # run.sh tells
on_file() { :; }
on_command() {
  [[ $1 == 'not run: '* ]] || return 0
  local -a words
  read -ra words <<<"${2//$'\n'/ }"
  [[ ${words[0]} != ./scree ]] || check "${words[@]:1}"
}

# known NAME: whether a program or the build has it.
known() {
  checked=$((checked + 1))
  [[ $all == *" $1 "* ]] || fault "nothing has the option or variable $1"
}

commands=$("$source/scree" --help | sed -n 's/^  \([a-z]*\) .*/\1/p' | tr '\n' ' ')
# The last one has the fields of the journal.
all=$(names_in "$(cat "$source/CMakeLists.txt" "$source/.ci/run" "$source/client/library/include/scree/client.h" "$source/server/log/journal.cpp")")
for name in server viewer bot replay world scene import export place admin token bench 'bench studies' 'replay render' 'replay control' \
  'replay info' 'replay verify' 'replay diff' 'replay cut' 'replay events' 'replay export' 'world new' 'world info' 'admin ban' \
  'admin kick' 'admin set' 'admin health' 'admin slow' 'admin top' 'admin history' 'admin undo' 'admin restore' 'admin console' 'admin list-bodies' 'admin ask' 'admin region add' 'rules check' 'rules test' 'rules types' 'token new' 'token show' setup build test fuzz demo web; do
  # shellcheck disable=SC2086  # two words
  help_of $name
  all+=$help
done
readonly commands all
for page in "$@"; do
  read_page "$source/$page"
  # shellcheck disable=SC2016  # backticks of the page
  text=$(sed '/^```/,/^```$/d' "$source/$page")
  while IFS= read -r span; do
    read -ra words <<<"$span"
    check "${words[@]:1}"
  done < <(grep -oP '(?<=`)\./scree [^`]+(?=`)' <<<"$text" || true)
  while IFS= read -r name; do known "$name"; done < <(grep -oP '(?<=`)(--[a-z][a-z-]*|SCREE_[A-Z_]+(?=[`=]))' <<<"$text" | sort -u || true)
done
# The variables of the container are options of the server.
page=docker/compose.yaml
while IFS= read -r name; do known "$name"; done < <(sed -n 's/^ *\(SCREE_[A-Z_]*\):.*/\1/p' "$source/$page")
((checked > 0)) || fault 'no option was found'
((faults == 0)) || exit 1
printf '%s options are known\n' "$checked"
