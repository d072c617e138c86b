#!/usr/bin/env bash
# The fuzzers of tests/fuzz. `./scree fuzz` builds a target before it calls this with its name, and what to do.
# What is found lies in build/fuzz: found/NAME has the inputs with new coverage, failed/NAME those on which the
# target fails, log/NAME.log libFuzzer's output.
set -euo pipefail

root=$(dirname "$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")")
readonly root targets="$root/tests/fuzz/targets" corpora="$root/tests/fuzz/corpus" built="$root/build/fuzz"
# Seconds for one input, and megabytes: above, the input is a finding. An input takes milliseconds, as a rule.
readonly input_s_max=60 memory_mb_max=4096
# Found inputs that go into the tree for one target, beside the seeds and the findings, and their bytes in all.
readonly kept_inputs_max=64 kept_bytes_max=65536

say() { printf 'fuzz: %s\n' "$*"; }
die() {
  printf 'fuzz: error: %s\n' "$*" >&2
  exit 1
}

usage() {
  cat <<'TEXT'
usage: ./scree fuzz --list                 lists the targets
       ./scree fuzz NAME [--minutes N] [--seed S]
                                           fuzzes a target for N minutes (default: 5), on one core. It starts from the
                                           corpus in the tree and the earlier findings, and ends at the first input
                                           that fails. The same seed and corpus give the same inputs
       ./scree fuzz NAME FILE…             runs these inputs
       ./scree fuzz NAME --merge           adds the findings with the most new coverage to the corpus in the tree
       ./scree fuzz --seeds                writes the first inputs of all corpora again

Findings are kept in build/fuzz (found, failed, log). docs/fuzzing.md says how to add a target.
TEXT
}

# The name and the first sentence of each target's comment.
list() {
  local file name
  for file in "$targets"/*.cpp; do
    name=$(basename "$file" .cpp)
    printf '%-16s %s\n' "$name" "$(sed -n '/^\/\//!q; s/^\/\/ \?//p' "$file" | tr '\n' ' ' | sed 's/\([:.]\) .*/\1/; s/[:.]$//')"
  done
}

# number NAME LOG: a number of libFuzzer's final statistics.
number() { sed -n "s/^stat::$1: *//p" "$2" | tail -n 1; }

# report NAME LOG STARTED SECONDS: in a line; and inputs that failed since the file STARTED, with what to do next.
report() {
  local name=$1 log=$2 started=$3 seconds=$4 executions coverage found failed
  executions=$(number number_of_executed_units "$log")
  coverage=$(grep -ao 'cov: [0-9]* ft: [0-9]*' "$log" | tail -n 1 || true)
  found=$(find "$built/found/$name" -type f | wc -l)
  say "$name: ${executions:-no} executions in $seconds s of processor time; coverage ${coverage:-unknown};" \
    "$found inputs found so far"
  mapfile -t failed < <(find "$built/failed/$name" -type f -newer "$started" ! -name 'slow-unit-*')
  ((${#failed[@]})) || return 0
  grep -aE -m 3 'CHECK failed|ERROR: (Address|Leak|lib)|runtime error' "$log" || true
  for file in "${failed[@]}"; do
    say "it fails on $file ($(stat -c %s "$file") bytes); to run it again:"
    printf '  ./scree fuzz %s %s\n' "$name" "${file#"$root"/}"
    xxd -l 256 "$file" 2>/dev/null || true
  done
  say "fix the cause, and keep the input: cp … tests/fuzz/corpus/$name/finding-…"
  return 1
}

# options: what every run has.
set_options() {
  # To count what is rare among features (-entropic) takes longer than most inputs of a server.
  options=("-timeout=$input_s_max" "-rss_limit_mb=$memory_mb_max" -max_len=4096 -entropic=0)
  # Memory that is kept from use again, megabytes: more means fresh pages all the time.
  export ASAN_OPTIONS=${ASAN_OPTIONS:-quarantine_size_mb=16}
  export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
  [[ -d /dev/shm && -w /dev/shm ]] && export TMPDIR=/dev/shm # targets that read files write them first
}

fuzz() {
  local name=$1 minutes=$2 log="$built/log/$1.log" started seconds TIMEFORMAT='%U %S'
  mkdir -p "$built/found/$name" "$built/failed/$name" "$built/log"
  started=$(mktemp)
  local dictionary="$root/tests/fuzz/dictionaries/$name.dict"
  [[ -e $dictionary ]] && options+=(-dict="$dictionary")
  options+=(-print_final_stats=1 -artifact_prefix="$built/failed/$name/"
    -max_total_time="$(awk -v m="$minutes" 'BEGIN { printf "%d", m * 60 }')")
  { time { "$built/bin/fuzz_$name" "${options[@]}" "$built/found/$name" "$corpora/$name" 2>&1 | tee "$log" |
    grep -a --line-buffered -E 'INITED|pulse|ERROR|CHECK' >&3 || true; }; } 3>&1 2>"$started.seconds"
  seconds=$(awk '{ print $1 + $2 }' "$started.seconds")
  local status=0
  report "$name" "$log" "$started" "$seconds" || status=1
  rm -f "$started" "$started.seconds"
  return $status
}

# Seeds and findings stay; of the rest of the corpus, and of what was found, those that add most coverage, which
# libFuzzer writes first.
merge() {
  local name=$1 corpus="$corpora/$1" fresh="$built/merged/$1" inputs=0 kept=0 file bytes
  rm -rf "$fresh"
  mkdir -p "$fresh" "$built/found/$name"
  find "$corpus" -type f \( -name 'seed-*' -o -name 'finding-*' \) -exec cp {} "$fresh" \;
  "$built/bin/fuzz_$name" "${options[@]}" -set_cover_merge=1 "$fresh" "$corpus" "$built/found/$name" 2>&1 |
    grep 'MERGE-OUTER.*added' || true
  find "$corpus" -type f ! -name 'seed-*' ! -name 'finding-*' -delete
  while read -r _ bytes file; do
    inputs=$((inputs + 1)) kept=$((kept + bytes))
    ((inputs <= kept_inputs_max && kept <= kept_bytes_max)) || break
    cp "$fresh/$file" "$corpus"
  done < <(find "$fresh" -type f ! -name 'seed-*' ! -name 'finding-*' -printf '%T@ %s %f\n' | sort -n)
  say "$corpus: $(find "$corpus" -type f | wc -l) inputs, $(cat "$corpus"/* | wc -c) bytes"
}

main() {
  local name=${1:-}
  case $name in
    --list) list && return ;;
    --seeds) "$built/bin/fuzz_seeds" "$corpora" && return ;;
    --help | -h) usage && return ;;
    '')
      usage >&2
      exit 2
      ;;
  esac
  shift
  local options=()
  set_options
  case ${1:-} in
    --merge) merge "$name" ;;
    --minutes | --seed | '')
      local minutes=5
      while (($# > 0)); do
        case $1 in
          --minutes) [[ ${2:-} =~ ^[0-9]+(\.[0-9]+)?$ ]] && minutes=$2 || die "--minutes needs a number" ;;
          --seed) [[ ${2:-} =~ ^[1-9][0-9]{0,8}$ ]] && options+=("-seed=$2") || die "--seed needs a number from 1 on" ;;
          *) die "there is no option '$1'; ./scree fuzz --help lists them" ;;
        esac
        shift 2
      done
      fuzz "$name" "$minutes"
      ;;
    -*) die "there is no option '$1'; ./scree fuzz --help lists them" ;;
    *) "$built/bin/fuzz_$name" "${options[@]}" "$@" ;;
  esac
}

main "$@"
