"""As same_edits.c. usage: python3 same_edits.py PORT LIST FIRST STEP GO"""

import os
import sys

import scree

AT_REST, WAIT_S = 4, 0.05


def read_edit(line, timber):
    what, shape, *rest = line.split()
    at = tuple(map(float, rest[:3]))
    solid = scree.box(at, tuple(map(float, rest[3:6]))) if shape == "box" else scree.sphere(at, float(rest[3]))
    if what == "carve":
        return scree.carve(solid, seeds=int(rest[4]), random_seed=int(rest[5]), impact_m=at)
    return scree.fill(solid) if what == "fill" else scree.paint(solid, timber)


port, path, first, step = int(sys.argv[1]), sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
with scree.Client(port=port) as client:
    client.wait_until_loaded()
    timber = client.materials.index("timber")
    with open(path, encoding="utf-8") as lines:
        edits = [line for line in lines if not line.startswith("#")]
    for line in edits[first::step]:
        reply = client.carry_out(read_edit(line, timber))
        if reply["text"]:
            sys.exit(reply["text"])
    print("done", flush=True)
    while not os.path.exists(sys.argv[5]):
        client.poll(WAIT_S)
    quiet, last = 0, 0
    while quiet < AT_REST:
        for event in client.poll(WAIT_S):
            if event["kind"] != "status":
                continue
            now = client.status()
            same = now["pieces"] == 0 and now["server_hash"] == now["field_hash"] == last
            quiet, last = quiet + 1 if same else 0, now["server_hash"]
    print(f"{last:016x}")
