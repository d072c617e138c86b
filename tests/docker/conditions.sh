#!/usr/bin/env bash
# conditions.sh BIN PAGE COMPOSE DOCKERFILE: runs the programs in BIN as docker/compose.yaml runs its image, without
# Docker: a root that is read-only, no capabilities, no new privileges, the image's user, a volume, and the variables of
# both files. Then inside.sh plays a server's life there. Exits with 77, which ctest counts as skipped, where the system
# allows no such sandbox.
set -euo pipefail
bin=$1 page=$2 compose=$3 dockerfile=$4
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
fail() {
  echo "conditions: $*" >&2
  exit 1
}

if ! bwrap --ro-bind / / --unshare-user --unshare-net true 2>/dev/null; then
  echo "conditions: bwrap makes no sandbox here (bubblewrap, user namespaces)" >&2
  exit 77
fi

# What the files promise, or this would not be about them. The image's programs are those of the component server.
grep -q '^RUN ./scree package server web$' "$dockerfile" || fail "$dockerfile makes no packages of server and web"
programs=$(sed -nE 's/^scree_install_programs\(server (.*)\)$/\1/p' "$here/../../cmake/ScreeInstall.cmake")
[[ $programs == *scree-server* && $programs == *scree-admin* ]] || fail "the component server has only: $programs"
for line in 'read_only: true' 'cap_drop: \[ALL\]' 'no-new-privileges:true' 'worlds:/worlds' 'mem_limit: '; do
  grep -Eq "^ +.*$line" "$compose" || fail "$compose does not say $line"
done
grep -Eq '^ +tmpfs:' "$compose" && fail "$compose has a tmpfs, which this does not run with"
user=$(sed -nE 's/.*useradd .*--uid ([0-9]+).*/\1/p' "$dockerfile")
[[ -n $user ]] || fail "$dockerfile makes no user with a number"

# The variables: the image's, and over them compose's with their defaults.
declare -A variables
while IFS='=' read -r name value; do variables[$name]=$value; done < <(sed -nE 's/^ENV ([A-Z_]+=.*)$/\1/p' "$dockerfile")
while IFS='=' read -r name value; do variables[$name]=$value; done < <(
  sed -nE 's/^ +(SCREE_[A-Z_]+): \$\{[A-Z_]+:-([^}]*)\}$/\1=\2/p' "$compose")
((${#variables[@]} >= 8)) || fail "only ${#variables[@]} variables were found in $dockerfile and $compose"
setenv=()
for name in "${!variables[@]}"; do setenv+=(--setenv "$name" "${variables[$name]}"); done

work=$(mktemp --directory)
group=
trap 'rm -rf "$work"; [[ -z $group ]] || rmdir "$group" || true' EXIT
mkdir -p "$work"/{local/bin,local/share/scree/web,tools,worlds}
for program in $programs; do cp "$bin/$program" "$work/local/bin/"; done
cp "$bin/scree-bot" "$here/inside.sh" "$work/tools"
if [[ -e $page/index.html ]]; then
  cp -r "$page/." "$work/local/share/scree/web"
else
  echo '<!doctype html><title>Scree</title>' >"$work/local/share/scree/web/index.html"
fi
read -ra health < <(sed -nE 's/^ +CMD \[(.*)\]$/\1/p' "$dockerfile" | tr -d '",')
((${#health[@]})) || fail "$dockerfile has no health check"

# The memory limit, where control groups of either version are this process' to make.
megabytes=$(($(sed -nE 's/^ +mem_limit: ([0-9]+)g$/\1/p' "$compose") * 1024))
limit="no memory limit: control groups are not writable here"
groups=/sys/fs/cgroup file=memory.max
[[ -e $groups/cgroup.controllers ]] || groups=/sys/fs/cgroup/memory file=memory.limit_in_bytes
if [[ -e $groups/cgroup.procs ]] && mkdir "$groups/scree-conditions-$$" 2>/dev/null; then
  group=$groups/scree-conditions-$$
  if echo $((megabytes * 1048576)) >"$group/$file" 2>/dev/null; then limit="memory limit $megabytes MB"; fi
fi
echo "conditions: user $user, ${#variables[@]} variables, $limit"

enter() {
  [[ -z $group ]] || echo "$BASHPID" >"$group/cgroup.procs" 2>/dev/null || true
  exec bwrap --unshare-user --uid "$user" --gid "$user" --unshare-pid --unshare-net --unshare-ipc --die-with-parent \
    --new-session --cap-drop ALL --clearenv --setenv PATH /usr/local/bin:/usr/bin:/bin "${setenv[@]}" \
    --ro-bind /usr /usr --symlink usr/bin /bin --symlink usr/lib /lib --symlink usr/lib64 /lib64 --symlink usr/sbin /sbin \
    --ro-bind /etc /etc --proc /proc --dev /dev \
    --ro-bind "$work/local" /usr/local --ro-bind "$work/tools" /tools --bind "$work/worlds" /worlds \
    --remount-ro / --chdir /worlds \
    bash /tools/inside.sh "$user" "${health[@]}"
}
(enter)
[[ $(stat -c %a "$work/worlds/admin.token") == 600 ]] || fail "others can read the admin token"
