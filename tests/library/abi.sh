#!/usr/bin/env bash
# Compares the C interface of scree/client.h with that of the last release (abi/), by libabigail: additions may be, breaks
# may not. The header is the interface: a library of empty functions is compiled from it, with debug information. Then
# a break that is made on purpose must be found, and the built library must have every function.
# usage: abi.sh HEADER LIBRARY [--write]: with --write the header becomes the release to compare with
set -euo pipefail
readonly header=$1 library=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
here=$(dirname "${BASH_SOURCE[0]}")
command -v abidiff >/dev/null || { echo 'abidiff is missing: ./scree setup --tests installs it' >&2; exit 77; }

# empty NAME: compiles NAME.so of the header in $folder/NAME/scree.
empty() {
  {
    printf '#include <scree/client.h>\n#include <stdlib.h>\n'
    cpp -P -I "$folder/$1" <<<'#include <scree/client.h>' | tr '\n' ' ' | tr ';' '\n' |
      grep -oE '(scree_result|void|const char ?\*|uint32_t) ?scree_[a-z_]+\([^{}]*\) *$' | sed 's/$/ { abort(); }/'
  } >"$folder/$1.c"
  cc -std=c99 -g -shared -fPIC -I "$folder/$1" -Wl,-soname,libscree_client.so.0 -o "$folder/$1.so" "$folder/$1.c"
}
mkdir -p "$folder/now/scree"
cp "$header" "$folder/now/scree/client.h"
empty now
readonly release=$here/abi/client.abi
if [[ ${3:-} == --write ]]; then
  mkdir -p "$here/abi"
  abidw --no-show-locs --no-corpus-path --no-comp-dir-path "$folder/now.so" --out-file "$release"
fi
functions=$(nm -D --defined-only "$folder/now.so" | grep -o 'scree_[a-z_]*')
exported=$(nm -D --defined-only "$library" | grep -oE ' T scree_[a-z_]+' | cut -c4-)
if ! diff <(sort <<<"$functions") <(sort <<<"$exported"); then
  echo "$library should have the header's functions and no others" >&2
  exit 1
fi

# What abidiff says of members at the end of a struct, and nothing else: each struct says its size, so they may be added.
readonly addition="^ *$|changes summary|with some indirect sub-type change|\[C\] 'function|has sub-type changes:|in (pointed to|unqualified underlying) type|underlying type 'struct .*changed:|type size changed from [0-9]+ to [0-9]+ |data member insertions?:|^ +'.* at offset [0-9]+ "
# broken LEFT RIGHT: whether abidiff finds a change that is no addition.
broken() {
  local status=0
  abidiff --no-added-syms "$1" "$2" >"$folder/said" 2>&1 || status=$?
  ((status & 3)) && { cat "$folder/said" >&2; exit 1; } # an error of its own
  ((status & 8)) || grep -qvE "$addition" "$folder/said"
}
if broken "$release" "$folder/now.so"; then
  cat "$folder/said" >&2
  echo 'the C interface is not that of the last release any more (docs/compatibility.md)' >&2
  exit 1
fi

# changed NAME SED: the header with that change, compiled.
changed() {
  mkdir -p "$folder/$1/scree"
  sed "$2" "$header" >"$folder/$1/scree/client.h"
  ! cmp -s "$header" "$folder/$1/scree/client.h" || { echo "nothing of the header was changed by $2" >&2; exit 1; }
  empty "$1"
}
changed member 's/  uint32_t port; .*/  uint16_t port;/'
changed argument 's/const float place_m\[3\], float most_m/const float place_m[3], double most_m/'
changed order 's/  uint64_t tick, session; *$/  uint64_t earlier, tick, session;/'
changed removed 's/^SCREE_API uint32_t scree_protocol(void);//'
for break in member argument order removed; do
  broken "$release" "$folder/$break.so" || { echo "abidiff did not find a break that was made on purpose: $break" >&2; exit 1; }
done
changed grown 's/  float spawn_look.*/&\n  uint64_t later;/; s/^SCREE_API uint32_t scree_protocol(void);/&\nSCREE_API scree_result scree_later(int32_t what);/'
if broken "$release" "$folder/grown.so"; then
  cat "$folder/said" >&2
  echo 'a member at the end of a struct and a new function should be no break' >&2
  exit 1
fi
echo "$(wc -l <<<"$functions") functions, as in the last release; four breaks are found, and an addition is none"
