#!/usr/bin/env bash
# Unpacks Debian's sources of the libraries that the web build compiles itself (cmake/ScreeWeb.cmake) into DIR/NAME, unless
# they are there. They come from the repositories from which this system has its packages, by apt and checked by its
# signatures; lists and sources of apt's own are left alone.
#   web_sources.sh DIR
set -euo pipefail

readonly into=$1 packages="protobuf libzstd"
readonly work=$into/apt

die() {
  printf 'scree: error: %s\n' "$*" >&2
  exit 1
}

missing=()
for name in $packages; do
  [[ -e $into/$name/.unpacked ]] || missing+=("$name")
done
((${#missing[@]})) || exit 0

mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
# shellcheck disable=SC2016  # the format's $(…) are apt's
apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  awk '$3 == "main" { print "deb-src " $1, $2, $3 }' | sort -u >"$work/sources.list"
[[ -s $work/sources.list ]] || die "apt knows no repository; is this Debian, and has apt-get update been run?"

of_these_lists() {
  "$1" -q -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache" -o Acquire::Retries=3 \
    -o APT::Sandbox::User="$(id -un)" "${@:2}"
}
apt_get() {
  of_these_lists apt-get "$@" >&2
}

# fetch NAME: its newest source that a mirror has. A mirror may list a security update whose source it lacks.
fetch() {
  local name=$1 version
  for version in $(of_these_lists apt-cache showsrc --only-source "$name" | awk '/^Version:/ { print $2 }' | sort -Vru); do
    apt_get source --download-only "$name=$version" && return
    rm -f "$work/${name}"_*
    printf 'scree: the source of %s %s cannot be had: an older one is tried\n' "$name" "$version" >&2
  done
  die "apt-get could not fetch the source of $name"
}
apt_get update || die "apt-get update failed for the sources of ${missing[*]}"
cd "$work"
for name in "${missing[@]}"; do
  fetch "$name"
  rm -rf "${into:?}/$name"
  found=("$work/${name}"_*.dsc)
  # What apt has fetched is checked: the .dsc's own signature is a maintainer's, whom this machine need not know.
  dpkg-source --no-check --no-copy -x "${found[-1]}" "$into/$name" >&2
  touch "$into/$name/.unpacked"
done
rm -rf "$work"
