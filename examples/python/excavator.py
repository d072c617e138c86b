"""An excavator learns by random search where to dig, so that it moves the most rock in a few actions.

Each world of a batch tries another plan: the best one so far, changed a little. The best of each round is kept.
"""

import argparse

import numpy as np

import scree

options = argparse.ArgumentParser()
options.add_argument("--worlds", type=int, default=32)
options.add_argument("--rounds", type=int, default=20)
options.add_argument("--actions", type=int, default=8)
given = options.parse_args()

random = np.random.default_rng(1)
batch = scree.Batch(given.worlds, lambda seed: scree.World("canyon", seed=1), steps=given.actions + 1)
space = batch.single_action_space
best, most = random.uniform(space.low, space.high, (given.actions, 3)), 0.0
for turn in range(given.rounds):
    noise = random.normal(0, 0.15, (given.worlds, *best.shape)) * (space.high - space.low)
    plans = np.clip(best + noise, space.low, space.high)
    plans[0] = best
    batch.reset(seed=1)
    moved = sum(batch.step(plans[:, i])[1] for i in range(given.actions))
    if moved.max() > most:
        best, most = plans[moved.argmax()], moved.max()
    print(f"round {turn + 1}: {moved.mean():.2f} m³ in the mean, {most:.2f} m³ at best")
