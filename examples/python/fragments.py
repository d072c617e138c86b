"""Sizes of the fragments of blows, beside a Weibull law: its shape and scale, fitted by least squares.

The share of fragments of at most a size s is 1 - exp(-(s / scale) ** shape), so that log(-log(1 - share)) is a line
over log(s). The size of a fragment is the side of a cube of its volume.
"""

import argparse

import numpy as np

import scree

options = argparse.ArgumentParser()
options.add_argument("--blows", type=int, default=12)
options.add_argument("--pattern", default="radial")
given = options.parse_args()

sizes = []
for blow in range(given.blows):
    world = scree.World("flat", recombine="off", impacts=False)
    world.step(scree.fill(scree.box((0, 4, 0), (3, 4, 3))))
    step = world.step(scree.carve(scree.sphere((0, 5, 0), 2.5), seeds=64, pattern=given.pattern, random_seed=blow))
    world.step(ticks=60)  # large blows are cut in several ticks
    volumes = world.pieces()["mass_units"] / 254 * world.voxel_m**3
    sizes.extend(np.cbrt(volumes))
sizes = np.sort(sizes)
share = (np.arange(len(sizes)) + 0.5) / len(sizes)
shape, offset = np.polyfit(np.log(sizes), np.log(-np.log(1 - share)), 1)
scale = np.exp(-offset / shape)
error = np.abs(1 - np.exp(-((sizes / scale) ** shape)) - share).max()
print(f"{len(sizes)} fragments of {given.blows} blows: shape {shape:.2f}, scale {scale:.2f} m")
print(f"farthest from the law: {error:.3f}")
