#!/usr/bin/env bash
# Runs a script of this folder in a bare Debian 12 that has nothing of ours but the packages. The roots come from debootstrap
# once and are kept in ROOTS, with what apt downloads; a run works on a layer over them that goes with it.
# usage: installed.sh SOURCE MADE ROOTS life.sh|examples.sh
# Exits with 77, which ctest counts as skipped, where there is no root, no mirror, or no way to mount.
set -euo pipefail
readonly source=$1 made=$2 roots=$3 script=$4
readonly here=$source/tests/packages
skip() { echo "packages: skipped: $*"; exit 77; }
((EUID == 0)) || skip 'only root can make a bare Debian (debootstrap)'
if [[ ${5:-} != inner ]]; then exec unshare --mount --propagation private "$0" "$source" "$made" "$roots" "$script" inner; fi
[[ $(. /etc/os-release && echo "$VERSION_CODENAME") == bookworm ]] || skip 'this is not Debian 12, whose packages these are'

# The archive that apt here uses.
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)
mirror=${mirror:-http://deb.debian.org/debian}
mirror=${mirror%/}
mkdir -p "$roots/archives/partial"

# enter ROOT COMMAND…: in that root, as its root. Without NETWORK=yes it has a network of its own, with loopback alone.
enter() {
  local root=$1 network=(--unshare-net)
  shift
  [[ ${NETWORK:-} != yes ]] || network=(--ro-bind /etc/resolv.conf /etc/resolv.conf)
  bwrap --bind "$root" / --dev /dev --proc /proc --bind "$roots/archives" /var/cache/apt/archives --ro-bind "$made" /packages \
    --ro-bind "$here" /tests --ro-bind "$source/examples" /examples --ro-bind "$source/docs" /docs --tmpfs /run "${network[@]}" --unshare-pid --unshare-ipc \
    --die-with-parent --cap-add ALL --clearenv --setenv PATH /usr/sbin:/usr/bin:/sbin:/bin --setenv DEBIAN_FRONTEND noninteractive \
    --setenv LC_ALL C.UTF-8 --chdir / "$@"
}
# make ROOT: the bare Debian, once.
make_base() {
  [[ ! -e $roots/base.made ]] || return 0
  curl -sfI --max-time 20 "$mirror/dists/bookworm/InRelease" >/dev/null || skip "the mirror does not answer: $mirror"
  echo "packages: a bare Debian from $mirror"
  rm -rf "$roots/base"
  debootstrap --variant=minbase --include=ca-certificates --cache-dir="$roots/archives" bookworm "$roots/base" "$mirror" \
    >"$roots/base.log" 2>&1 || { tail -n 5 "$roots/base.log" >&2; skip "debootstrap failed (see $roots/base.log)"; }
  echo 'force-unsafe-io' >"$roots/base/etc/dpkg/dpkg.cfg.d/tests"
  # apt leaves what it downloads to the next run.
  echo 'APT::Keep-Downloaded-Packages "true"; APT::Install-Recommends "false"; APT::Sandbox::User "root"; Acquire::Retries "3";' \
    >"$roots/base/etc/apt/apt.conf.d/tests"
  NETWORK=yes enter "$roots/base" apt-get -q update >>"$roots/base.log" 2>&1
  touch "$roots/base.made"
}
make_base

readonly layer=$roots/layer.${script%.sh}
umount "$layer/root" 2>/dev/null || true # of a run that was ended
rm -rf "$layer"
mkdir -p "$layer"/{upper,work,root}
mount -t overlay overlay -o "lowerdir=$roots/base,upperdir=$layer/upper,workdir=$layer/work" "$layer/root" ||
  skip 'no layer can be mounted over a folder (overlay)'
trap 'umount "$layer/root"; rm -rf "$layer"' EXIT
NETWORK=yes enter "$layer/root" bash "/tests/$script" install || { echo "packages: the installation failed" >&2; exit 1; }
enter "$layer/root" bash "/tests/$script" run
