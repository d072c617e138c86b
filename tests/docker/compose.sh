#!/usr/bin/env bash
# compose.sh DOCKER: the files of compose are whole. Each that lies over compose.yaml parses, names only services, networks
# and volumes that are there, and mounts files that exist; and nginx takes its configuration. By `docker compose config`
# where that is installed, too. Exits with 77, which ctest counts as skipped, where Python has no yaml.
set -euo pipefail
cd "$1"
if ! /usr/bin/python3 -c 'import yaml' 2>/dev/null; then
  echo 'compose: Python has no module yaml (python3-yaml)'
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

/usr/bin/python3 - <<'PYTHON'
import glob
import json
import os
import sys

import yaml


class Loader(yaml.SafeLoader):
    """Knows compose's own tag."""


Loader.add_constructor("!override", lambda loader, node: loader.construct_sequence(node))
faults = []
over = sorted(glob.glob("compose.*.yaml"))
base = yaml.load(open("compose.yaml"), Loader)
for name in over:
    file = yaml.load(open(name), Loader)
    networks, volumes = file.get("networks", {}), {**base["volumes"], **file.get("volumes", {})}
    for service, parts in file["services"].items():
        if service not in base["services"] and not {"image", "build"} & parts.keys():
            faults.append(f"{name}: {service} has no image, and builds none")
        faults += [f"{name}: no network {net}" for net in parts.get("networks", []) if net not in networks]
        for mount in parts.get("volumes", []):
            source = mount.rsplit(":", 2 if mount.endswith(":ro") else 1)[0]
            if source.startswith("./") and not os.path.exists(source):
                faults.append(f"{name}: {source} does not exist")
            if source[0] not in "./$" and source not in volumes:
                faults.append(f"{name}: no volume {source}")
for name in filter(os.path.isfile, glob.glob("monitoring/**", recursive=True)):
    with open(name) as file:
        json.load(file) if name.endswith(".json") else yaml.safe_load(file)
print(f"{len(over)} files over compose.yaml")
sys.exit("\n".join(faults) if faults or len(over) < 3 else 0)
PYTHON

openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=localhost -keyout "$work/privkey.pem" -out "$work/fullchain.pem" 2>/dev/null
{
  printf 'pid %s/pid; error_log stderr; events {}\nhttp { access_log off;\n' "$work"
  sed "s|/etc/certificates|$work|; s|//server:|//127.0.0.1:|" nginx.conf
  echo '}'
} >"$work/nginx.conf"
nginx -t -q -e stderr -c "$work/nginx.conf"

if docker compose version >/dev/null 2>&1; then
  for file in compose.*.yaml; do
    PLAY_NAME=play.example.org CERTIFICATES=$work SIMULATOR_PASSWORD=a EDGE_1_PASSWORD=b EDGE_2_PASSWORD=c docker compose -f compose.yaml -f "$file" config -q
  done
fi
