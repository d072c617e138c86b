"""Bodies beside MuJoCo: boxes that fall into a heap, a world for each core; simulated seconds in a second.

usage: mujoco.py [--boxes 16] [--seconds 10] [--repeat 3] [--json FILE]
MuJoCo runs by its own `testspeed` (Debian: mujoco-testspeed of libmujoco-samples) in steps of 1/240 s; Scree by a
batch, in ticks of 1/60 s, whose solver takes steps of its own. Scree's boxes lie on terrain that can break, and sleep
once they lie still; MuJoCo's lie on a plane, and never sleep. The seconds of all worlds are added.
"""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import tempfile
import time

import scree

options = argparse.ArgumentParser()
options.add_argument("--boxes", type=int, default=16)
options.add_argument("--seconds", type=int, default=10)
options.add_argument("--repeat", type=int, default=3)
options.add_argument("--json")
given = options.parse_args()
testspeed = shutil.which("mujoco-testspeed") or shutil.which("testspeed")
if testspeed is None:
    raise SystemExit("MuJoCo's testspeed is not installed (Debian: libmujoco-samples)")
threads = os.cpu_count()
places = [(0.3 * (i % 2), 1.0 + 1.2 * i, 0.2 * (i % 3)) for i in range(given.boxes)]


def peer():
    bodies = "".join(f'<body pos="{x} {z} {y}"><freejoint/><geom type="box" size=".5 .5 .5" mass="2600"/></body>'
                     for x, y, z in places)
    model = ('<mujoco><option timestep="0.0041666667"/><size nconmax="2000" njmax="8000"/><worldbody>'
             f'<geom type="plane" size="50 50 1"/>{bodies}</worldbody></mujoco>')
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(model)
        file.flush()
        said = subprocess.run([testspeed, file.name, str(240 * given.seconds), str(threads)], check=True,
                              capture_output=True, text=True).stdout
    return float(re.search(r"Total realtime factor\s*:\s*([0-9.]+)", said)[1])


def own():
    batch = scree.Batch(threads, lambda seed: scree.World("flat", seed=seed))
    boxes = [scree.add_prop(place, half_m=(0.5, 0.5, 0.5), mass_kg=2600) for place in places]
    start = time.perf_counter()
    steps = batch.advance([boxes] * threads)
    for _ in range(given.seconds):
        batch.advance(ticks=60)
    took = time.perf_counter() - start
    if any(step.refused for step in steps):
        raise SystemExit("a box was refused")
    return threads * given.seconds / took


results = {"mujoco_s_per_s": [], "scree_s_per_s": []}
for _ in range(given.repeat):
    results["mujoco_s_per_s"].append(peer())
    results["scree_s_per_s"].append(own())
for name, values in results.items():
    print(f"{name:20} {statistics.median(values):10.4g}   ({min(values):.4g} to {max(values):.4g})")
if given.json:
    with open(given.json, "w", encoding="utf-8") as file:
        json.dump(results, file, indent=2)
