"""Does terrain become slower with every carve? The paper of 2016 plots it (figures 24 and 25): a list of carves did, a
grid did not. Times of carves and of the ticks after them, into OUT.csv, and OUT.png where matplotlib is installed."""

import argparse
import importlib.util
import time

import numpy as np

import scree

options = argparse.ArgumentParser()
options.add_argument("--carves", type=int, default=400)
options.add_argument("--out", default="degradation")
given = options.parse_args()

world = scree.World("noise", seed=3)
random = np.random.default_rng(1)
rows = []
for carve in range(given.carves):
    x, z = random.uniform(-12, 12, 2)
    ground = world.cast_ray((x, 60, z), (0, -1, 0), 150)
    blow = scree.carve(scree.sphere(ground.place_m, 1.5), seeds=8, random_seed=carve)
    start = time.perf_counter()
    world.step(blow)
    carved = time.perf_counter()
    world.step(ticks=30)
    ticked = time.perf_counter()
    rows.append((carve + 1, 1e3 * (carved - start), 1e3 * (ticked - carved) / 30, len(world.pieces())))
rows = np.array(rows)
np.savetxt(given.out + ".csv", rows, "%.4f", ",", header="carves,carve_ms,tick_ms,pieces", comments="")
for part, name in ((rows[: len(rows) // 4], "first"), (rows[-(len(rows) // 4):], "last")):
    carve_ms, tick_ms = np.median(part[:, 1:3], axis=0)
    print(f"{name} quarter of {given.carves} carves: {carve_ms:.2f} ms a carve, {tick_ms:.2f} ms a tick")
if importlib.util.find_spec("matplotlib"):
    from matplotlib import pyplot
    pyplot.plot(rows[:, 0], rows[:, 1:3], label=["carve, ms", "tick, ms"])
    pyplot.legend(title="over the number of carves")
    pyplot.savefig(given.out + ".png")
