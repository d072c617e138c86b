#!/usr/bin/env bash
# Makes Debian's packages of components that are built: see ./scree package, which builds them first.
# usage: package.sh BUILD OUT [--version V] [--compression xz|gzip] COMPONENT…
# The same objects give the same bytes: all times are that of the last commit, or SOURCE_DATE_EPOCH.
set -euo pipefail
source=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/..
source=$(cd "$source" && pwd)
build=$(readlink -f "$1") out=$(readlink -m "$2")
shift 2
version='' compression=xz
while [[ ${1:-} == --* ]]; do
  case $1 in
    --version) version=$2 ;;
    --compression) compression=$2 ;;
    *) echo "package.sh: there is no option $1" >&2 && exit 2 ;;
  esac
  shift 2
done
components=("$@")
((${#components[@]})) || { echo 'package.sh: which components?' >&2 && exit 2; }

# A release has the project's version. What comes before it has the time of its commit behind a tilde, and so is older.
project=$(sed -nE 's/^project\(.*VERSION ([0-9.]+).*/\1/p' "$source/CMakeLists.txt")
in_git() { git -C "$source" "$@" 2>/dev/null; }
if commit=$(in_git log -1 --format=%ct); then
  export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$commit}
  [[ -n $version ]] || in_git describe --exact-match --tags --match "v$project" >/dev/null ||
    version=$project~$(date -u -d "@$commit" +%Y%m%d.%H%M%S)
fi
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(stat -c %Y "$source/CHANGELOG.md")}
version=${version:-$project}
readonly stage=$build/packaging
umask 022

package_of() { sed -nE "s/^scree_package\($1 ([^ ]+) .*/\1/p" "$source/cmake/ScreePackages.cmake"; }
programs_of() { sed -nE "s/^scree_install_programs\($1 (.*)\)/\1/p" "$source/cmake/ScreeInstall.cmake"; }

# documents COMPONENT: what each package has to say of itself.
documents() {
  local name doc
  name=$(package_of "$1")
  [[ -n $name ]] || { echo "package.sh: there is no component $1" >&2 && exit 2; }
  doc=$stage/$1/share/doc/$name
  install -d "$doc"
  install -m 644 "$source/packaging/copyright" "$doc/copyright"
  printf 'scree (%s) unstable; urgency=medium\n\n  * The changes are in changelog.gz.\n\n -- %s  %s\n' "$version" \
    "$(sed -nE 's/^set\(CPACK_PACKAGE_CONTACT "(.*)"\)/\1/p' "$source/cmake/ScreePackages.cmake")" \
    "$(date -u -R -d "@$SOURCE_DATE_EPOCH")" | gzip -9n >"$doc/changelog.Debian.gz"
  gzip -9n <"$source/CHANGELOG.md" >"$doc/changelog.gz"
}

# pages COMPONENT: manual pages and completions of its programs, which change with these alone.
pages() {
  local program made
  for program in $(programs_of "$1"); do
    [[ -x $build/bin/$program ]] || { echo "package.sh: $program is not built" >&2 && exit 1; }
    made=$stage/$1/share/man/man1/$program.1.gz
    if [[ ! $made -nt $build/bin/$program || ! $made -nt $source/packaging/program_words.py ]]; then
      "$source/packaging/program_words.py" "$build/bin/$program" "$stage/$1/share"
    fi
  done
}

for component in "${components[@]}"; do
  documents "$component"
  pages "$component"
  case $component in
    server)
      install -D -m 644 "$source/packaging/server/scree@.service" "$stage/server/lib/systemd/system/scree@.service"
      install -D -m 644 "$source/packaging/server/world.toml" "$stage/server/share/doc/scree-server/examples/world.toml"
      ;;
    cpp) install -D -m 644 "$source/packaging/cpp/libscree-dev.lintian-overrides" "$stage/cpp/share/lintian/overrides/libscree-dev" ;;
    web) [[ -e $source/build/web/dist/index.html ]] || { echo 'package.sh: the page is not built' >&2 && exit 1; } ;;
  esac
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$build" && cpack --config CPackConfig.cmake -B "$work" -D CPACK_PACKAGE_VERSION="$version" \
  -D CPACK_DEBIAN_COMPRESSION_TYPE="$compression" -D CPACK_COMPONENTS_ALL="$(IFS=';' && echo "${components[*]}")" \
  >"$work/cpack.log" 2>&1) || { cat "$work/cpack.log" >&2 && exit 1; }

# with_trigger PACKAGE: CPack has a shared library's package call ldconfig in scripts, where Debian's asks for its trigger.
with_trigger() {
  local folder=$work/control
  dpkg-deb --raw-extract "$1" "$folder"
  rm "$folder"/DEBIAN/post{inst,rm}
  install -m 644 "$source/packaging/client/triggers" "$folder/DEBIAN/triggers"
  dpkg-deb --root-owner-group -Z"$compression" --build "$folder" "$1" >"$work/cpack.log"
  rm -r "$folder"
}

install -d "$out"
for component in "${components[@]}"; do
  name=$(package_of "$component")
  rm -f "$out/${name}"_*.deb
  [[ $component != client ]] || with_trigger "$work/${name}"_*.deb
  mv "$work/${name}"_*.deb "$out/"
  (cd "$out" && du -k --apparent-size "${name}"_*.deb)
done
