#!/usr/bin/env bash
# Makes all packages of a build twice: the bytes are the same. lintian finds no fault, the service is as closed as it says,
# and completions complete. Leaves the packages in MADE, those of a higher version in MADE/higher.
# usage: made.sh SOURCE BUILD MADE
set -euo pipefail
readonly source=$1 build=$2 made=$3
fail() { echo "packages: $*" >&2; exit 1; }
rm -rf "$made"
mkdir -p "$made/again" "$made/server"

components=(server tools viewer client dev cpp python)
if [[ -e $source/build/web/dist/index.html ]]; then
  components+=(web)
else
  echo 'packages: the page is not built (./scree web), and so its package is not looked at'
fi
# The same commit, another moment. xz would take most of the test's time: one package shows that it changes nothing.
for folder in "$made" "$made/again"; do
  "$source/packaging/package.sh" "$build" "$folder" --compression gzip "${components[@]}"
  "$source/packaging/package.sh" "$build" "$folder/xz" client
done
while read -r package; do
  cmp "$made/$package" "$made/again/$package" || fail "a second build of $package has other bytes"
done < <(cd "$made" && ls -- *.deb xz/*.deb)
rm -r "$made/again"
version=$(dpkg-deb -f "$made"/scree-server_*.deb Version)
"$source/packaging/package.sh" "$build" "$made/higher" --version "$version.1" --compression gzip server >/dev/null
dpkg --compare-versions "$version" lt "$version.1" || fail "$version.1 is not higher than $version"

# Also the warnings: none is left to be explained.
lintian --fail-on error,warning --allow-root "$made"/*.deb || fail 'lintian finds faults'

# The service. Units that it needs are systemd's own.
dpkg-deb -x "$made"/scree-server_*.deb "$made/server"
unit=$made/server/usr/lib/systemd/system/scree@.service
sed "s|/usr/bin/scree-server|$made/server&|" "$unit" >"$made/scree@world.service"
said=$(systemd-analyze verify --man=no "$made/scree@world.service" 2>&1) || fail "the unit is not in order: $said"
[[ -z $said ]] || fail "systemd says of the unit: $said"
said=$(systemd-analyze security --offline=true --threshold=20 "$unit" 2>&1) || fail "the unit is too open: $said"
tail -n 1 <<<"$said"

# Each program has its page and its completions, and these know what the program knows.
while read -r program; do
  for part in "man/man1/$program.1.gz" "bash-completion/completions/$program" "zsh/vendor-completions/_$program"; do
    [[ -s $(find "$build/packaging" -path "*/share/$part") ]] || fail "$program has no $part"
  done
  bash -n "$(find "$build/packaging" -path "*/completions/$program")"
  grep -qE '^\.B |^\\fB' <(gzip -dc "$(find "$build/packaging" -name "$program.1.gz")") || fail "the page of $program says nothing"
done < <(sed -nE 's/^scree_install_programs\([a-z]+ (.*)\)/\1/p' "$source/cmake/ScreeInstall.cmake" | tr ' ' '\n')
# completed WORDS…: what bash offers for the last word.
completed() {
  (
    # shellcheck disable=SC1090
    source "$(find "$build/packaging" -path "*/completions/$1")"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    "_${1//-/_}"
    echo "${COMPREPLY[*]}"
  )
}
[[ $(completed scree-token n) == new ]] || fail "bash completes scree-token n by $(completed scree-token n)"
[[ $(completed scree-token new --rol) == --role ]] || fail 'bash does not complete scree-token new --rol'
[[ $(completed scree-token new --role car) == carver ]] || fail 'bash does not complete scree-token new --role car'
[[ $(completed scree-server --world-n) == --world-name ]] || fail 'bash does not complete scree-server --world-n'
echo "packages: version $version, made twice with the same bytes"
