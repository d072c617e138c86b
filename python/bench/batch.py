"""What a batch costs beside plain C++, for the same worlds: each gets one carve a second, within 32 m.

usage: batch.py PLAIN_WORLDS [--worlds 64] [--seconds 10] [--repeat 3] [--json FILE]
PLAIN_WORLDS is the program of python/bench/plain_worlds.cpp. Both run in turns, each first as often, and must end
with the same hashes. The processor time of both is that of all their threads: other load on the machine changes it
less.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time

import scree

# Both with the same thresholds of malloc: Python's own work raises those of its process, which alone saves a quarter.
if "GLIBC_TUNABLES" not in os.environ:
    os.environ["GLIBC_TUNABLES"] = "glibc.malloc.trim_threshold=268435456:glibc.malloc.mmap_threshold=33554432"
    os.execv(sys.executable, [sys.executable, *sys.argv])

options = argparse.ArgumentParser()
options.add_argument("plain_worlds")
options.add_argument("--worlds", type=int, default=64)
options.add_argument("--seconds", type=int, default=10)
options.add_argument("--repeat", type=int, default=3)
options.add_argument("--json")
given = options.parse_args()


def blow(world, second):
    place = ((world * 7 + second * 5) % 25 - 12, 0, (world * 11 + second * 3) % 25 - 12)
    return scree.carve(scree.sphere(place, 1.5), seeds=8, random_seed=second * 64 + world)


def batch(ticks):
    worlds = scree.Batch(given.worlds, lambda seed: scree.World("flat", seed=1))
    start, used = time.perf_counter(), time.process_time()
    for tick in range(0, 60 * given.seconds, ticks):
        commands = [blow(i, tick // 60) for i in range(given.worlds)] if tick % 60 == 0 else None
        steps = worlds.advance(commands, ticks)
    return time.perf_counter() - start, time.process_time() - used, sum(step.state_hash for step in steps) % 2**64


def plain(ticks):
    said = subprocess.run([given.plain_worlds, str(given.worlds), str(given.seconds), str(ticks)], check=True,
                          capture_output=True, text=True).stdout.split()
    return float(said[0]), float(said[1]), int(said[2])


results = {}
for ticks in (1, 6):
    ratios, processor_ratios, rates = [], [], []
    for turn in range(2 * given.repeat):
        first, second = (plain, batch) if turn % 2 == 0 else (batch, plain)
        results_of = {first: first(ticks), second: second(ticks)}
        (plain_s, plain_used_s, plain_hash), (batch_s, batch_used_s, batch_hash) = results_of[plain], results_of[batch]
        if plain_hash != batch_hash:
            raise SystemExit("the batch has other hashes than the same worlds in C++")
        ratios.append(batch_s / plain_s)
        processor_ratios.append(batch_used_s / plain_used_s)
        rates.append(given.worlds * 60 * given.seconds / batch_s)
    results[f"cost_over_plain_{ticks}_ticks_a_call"] = ratios
    results[f"processor_cost_over_plain_{ticks}_ticks_a_call"] = processor_ratios
    results[f"world_ticks_per_s_{ticks}_ticks_a_call"] = rates
for name, values in results.items():
    print(f"{name:48} {statistics.median(values):10.4g}   ({min(values):.4g} to {max(values):.4g})")
if given.json:
    with open(given.json, "w", encoding="utf-8") as file:
        json.dump(results, file, indent=2)
