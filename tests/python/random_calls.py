"""Calls with numbers at random, good and bad: whatever comes, it is an exception or a refusal, and the mass balances.

usage: random_calls.py SEED STEPS. A crash ends the process, which the test sees.
"""

import random
import sys

import numpy as np

import scree

chance = random.Random(int(sys.argv[1]))
ODD = [0, 1, -1, 1e-9, 1e3, -4096, 4095.9, 8192, 1e6, 1e12, -1e12, 1e30, float("nan"), float("inf"), 511, 2**31, 2**63]
WHOLE = [0, 1, 5, 20, -1, 2**31, 2**32 - 1, 2**32, 4096, 4097, 254, 255]
PATTERNS = ["uniform", "radial", "clustered", "authored", "even", "grain_x", "slabs_y", "shards", "natural", "zigzag"]
SETTINGS = ["recombine", "cutter", "pieces-max", "islands", "support", "collider", "simplifier", "group-merges", "none"]
VALUES = ["off", "stamp", "true", "false", "slice", "mesh", "rays", "nan", "1e9", "5", "slices", "sphere", "merge"]


def number():
    return chance.choice(ODD) if chance.random() < 0.2 else chance.uniform(-12, 12)


def whole():
    return chance.choice(WHOLE) if chance.random() < 0.4 else chance.randrange(40)


def vector():
    if chance.random() < 0.03:
        return chance.choice([None, "x", 3, (1, 2)])
    return [number() for _ in range(3)]


def voxel():
    odd = chance.random() < 0.2
    return [chance.choice([16383, -16384, 10**6, 2**40, 0]) if odd else chance.randrange(-40, 40) for _ in range(3)]


def places():
    some = np.random.default_rng(whole() % 9).normal(size=(whole() % 9, 3))
    return chance.choice([some, some, np.zeros((3, 2)), np.full((2, 3), number())])


def turn():
    return chance.choice([None, [number() for _ in range(4)]])


def shape():
    make = getattr(scree, chance.choice(["sphere", "box", "capsule", "crater"]))
    radius = number() if chance.random() < 0.2 else chance.uniform(0.1, 3)
    return make(vector(), radius) if make in (scree.sphere, scree.crater) else make(vector(), vector(), radius)


COMMANDS = [
    lambda: scree.carve(shape(), whole(), chance.choice(PATTERNS), whole(), vector(), number(),
                        chance.choice([None, places()]), chance.choice([0, whole()])),
    lambda: scree.fill(shape(), chance.choice([None, 0, 1, whole()])),
    lambda: scree.paint(shape(), whole()),
    lambda: scree.blast(vector(), chance.choice([1e5, 1e6, number()]), whole()),
    lambda: scree.dig(shape(), chance.choice([0, whole()]), chance.choice(["", "red", "x" * 300, "\0"])),
    lambda: scree.place(shape(), whole(), chance.random() < 0.5),
    lambda: scree.cut_out(shape()),
    lambda: scree.add_prop(vector(), chance.choice(["box", "sphere", "hull", "cone"]), vector(),
                           chance.choice([None, places()]), turn(), vector(), vector(),
                           chance.choice(["dynamic", "kinematic", "fixed"]), number(), whole(), whole()),
    lambda: scree.move_prop(whole(), vector(), turn(), vector(), vector()),
    lambda: scree.push(whole(), vector(), vector()),
    lambda: scree.break_piece(whole(), vector(), whole(), whole()),
    lambda: scree.release(whole()),
    lambda: scree.remove_prop(whole()),
    lambda: scree.setting(chance.choice(SETTINGS), chance.choice(VALUES)),
]
QUESTIONS = [
    lambda world: world.codes(voxel(), voxel()),
    lambda world: world.distances(voxel(), voxel()),
    lambda world: world.materials_in(voxel(), voxel()),
    lambda world: world.heights(voxel(), voxel(), whole()),
    lambda world: world.cast_ray(vector(), vector(), number()),
    lambda world: world.cast_rays(places(), places(), number()),
    lambda world: world.nearest_surface(vector(), number()),
    lambda world: world.overlap_sphere(vector(), number()),
    lambda world: world.overlap_box(vector(), vector()),
    lambda world: world.distance(places()),
    lambda world: world.bodies(),
    lambda world: world.snapshot(),
]


def attempt(call):
    """The call's result; None: it was refused as it should be."""
    try:
        return call()
    except (ValueError, TypeError, scree.Error):
        return None


world = scree.World("noise", seed=2)
accepted = 0
for round_number in range(int(sys.argv[2])):
    commands = [command for command in (attempt(chance.choice(COMMANDS)) for _ in range(4)) if command is not None]
    step = world.step(commands)
    accepted += sum(reply.accepted for reply in step.replies)
    assert step.ledger["error"] == 0
    question = chance.choice(QUESTIONS)
    attempt(lambda: question(world))
    if round_number % 100 == 49:
        world = world.fork()
    if round_number % 100 == 99:
        world = scree.World(chance.choice(["flat", "noise", "canyon"]), voxel_m=chance.choice([0.25, 0.5, 1.0]))
print(accepted, "requests were carried out")
