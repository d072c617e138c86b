#!/usr/bin/env bash
# image.sh [TAG]: builds the image of docker/Dockerfile with buildah, and asks each of its programs for its version. Its
# base comes from debootstrap, so no registry is asked: only Debian's archive. Needs root, buildah and debootstrap, and some
# 10 GB in build/image, which go at the end. It takes about 20 minutes of two cores. TAG: scree:ci unless said otherwise.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

readonly tag=${1:-scree:ci} base=docker.io/library/debian:bookworm-slim folder=$PWD/build/image
readonly mirror=${SCREE_IMAGE_MIRROR:-http://deb.debian.org/debian}
for program in buildah debootstrap; do
  command -v "$program" >/dev/null || { echo "image: $program is missing: apt-get install buildah debootstrap" >&2; exit 2; }
done
((EUID == 0)) || { echo "image: debootstrap needs root" >&2; exit 2; }

# A storage of its own, and no new namespaces: so it works within a container, too.
in_store() {
  local command=$1
  shift
  buildah --root "$folder/root" --runroot "$folder/run" --storage-driver vfs "$command" "$@"
}
clear_up() {
  in_store rm --all >/dev/null 2>&1 || true
  rm -rf "$folder"
}
trap clear_up EXIT
clear_up
mkdir -p "$folder"

echo "image: the base"
debootstrap --variant=minbase bookworm "$folder/base" "$mirror" >"$folder/base.log" || { tail -n 20 "$folder/base.log" >&2; exit 1; }
rm -rf "$folder"/base/var/cache/apt/archives/*.deb
# The archive's other parts, as this machine has them: fixes of security, and sources for the page.
cp /etc/apt/sources.list "$folder/base/etc/apt/" 2>/dev/null || true
cp /etc/apt/sources.list.d/* "$folder/base/etc/apt/sources.list.d/" 2>/dev/null || true
cp /etc/apt/apt.conf.d/*proxy* "$folder/base/etc/apt/apt.conf.d/" 2>/dev/null || true
container=$(in_store from scratch)
in_store add --quiet "$container" "$folder/base" / >/dev/null
in_store config --cmd bash "$container"
in_store commit --quiet "$container" "$base" >/dev/null
in_store rm "$container" >/dev/null
rm -rf "$folder/base"

echo "image: $tag"
in_store bud --isolation chroot --pull-never --layers=false --format docker -f docker/Dockerfile -t "$tag" .

version=$(sed -nE 's/^project\(.*VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
container=$(in_store from --pull-never "$tag")
for program in server admin world replay token; do
  said=$(in_store run --isolation chroot "$container" -- "scree-$program" --version)
  [[ $said == "$version" ]] || { echo "image: scree-$program says '$said', not $version" >&2; exit 1; }
done
in_store inspect "$tag" | grep -q '"scree-admin"' || { echo "image: it has no health check" >&2; exit 1; }
echo "image: $tag has its five programs of version $version, and the health check"
