"""Batches: their worlds are those stepped singly; and the environment of an excavation."""

import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import scree


def commands_of(world, tick):
    """Commands that differ from world to world."""
    if tick % 10:
        return []
    return [scree.carve(scree.sphere((world - 2.0, 0, tick / 10), 1.5), seeds=6 + world, random_seed=tick)]


def test_a_batch_has_the_hashes_of_worlds_stepped_singly():
    batch = scree.Batch(5, lambda seed: scree.World("noise", seed=seed), threads=2)
    single = [scree.World("noise", seed=seed) for seed in range(1, 6)]
    for tick in range(40):
        commands = [commands_of(i, tick) for i in range(5)]
        steps = batch.advance(commands)
        for i, step in enumerate(steps):
            alone = single[i].step(commands[i])
            assert (step.tick, step.field_hash, step.state_hash) == (alone.tick, alone.field_hash, alone.state_hash)
            assert [r.refusal for r in step.replies] == [r.refusal for r in alone.replies]
    assert [w.state_hash for w in batch.worlds] == [w.state_hash for w in single]


def test_actions_are_digs_that_move_mass():
    batch = scree.Batch(3, steps=4)
    heights, infos = batch.reset(seed=5)
    assert heights.shape == (3, 16, 16) and heights.dtype == np.float32 and infos == {}
    assert np.allclose(heights, 0, atol=0.02)
    actions = np.array([[0.5, 0.5, 1.0], [0.5, 0.5, 2.0], [0.5, 0.5, 0.0]], np.float32)
    after, rewards, terminated, truncated, infos = batch.step(actions)
    assert 0 < rewards[0] < rewards[1] and rewards[2] == 0
    assert after[0, 8, 8] < -0.5 and after[1, 8, 8] < after[0, 8, 8] and after[2, 8, 8] == heights[2, 8, 8]
    assert not terminated.any() and not truncated.any() and not infos["refused"].any()
    for world, reward in zip(batch.worlds, rewards):
        stored = sum(world.stores.get("the world's store", {}).values())
        assert reward == pytest.approx(stored / 254 * world.voxel_m**3)
        assert world.ledger()["error"] == 0


def test_an_episode_is_cut_off_and_the_next_begins_in_the_next_step():
    batch = scree.Batch(2, steps=2)
    batch.reset(seed=1)
    actions = np.full((2, 3), 1.0, np.float32)
    assert not batch.step(actions)[3].any()
    assert batch.step(actions)[3].all()
    heights, rewards, _, truncated, _ = batch.step(actions)
    assert np.allclose(heights, 0, atol=0.02) and (rewards == 0).all() and not truncated.any()
    assert batch.step(actions)[1].all()


def test_the_same_seeds_give_the_same_episode():
    def play(threads):
        batch = scree.Batch(4, lambda seed: scree.World("canyon", seed=seed), threads=threads)
        batch.reset(seed=[3, 1, 4, 1])
        return [batch.step(np.tile([1.0, -1.0, 1.5], (4, 1)))[4]["state_hash"].tolist() for _ in range(3)]

    found = play(1)
    assert found == play(2)
    assert found[0][1] == found[0][3] != found[0][0]


def test_spaces_bound_actions_and_observations():
    batch = scree.Batch(2, cells=8)
    assert batch.num_envs == len(batch) == 2
    assert batch.single_action_space.shape == (3,) and batch.action_space.shape == (2, 3)
    assert batch.single_observation_space.shape == (8, 8) and batch.observation_space.shape == (2, 8, 8)
    assert batch.single_action_space.low.tolist() == [-8, -8, 0]
    batch.close()


@pytest.mark.parametrize("wrong", [np.zeros((2, 2)), np.zeros(3), np.full((2, 3), np.nan)])
def test_wrong_actions_are_value_errors(wrong):
    batch = scree.Batch(2)
    batch.reset(seed=1)
    with pytest.raises(ValueError):
        batch.step(wrong)


def test_wrong_batches_are_errors():
    for wrong in [{"n": 0}, {"n": 1, "cells": 0}, {"n": 1, "half_m": float("nan")}, {"n": 1, "threads": -1}]:
        with pytest.raises(ValueError):
            scree.Batch(**wrong)
    with pytest.raises(TypeError):
        scree.Batch(1, make=3)
    with pytest.raises(TypeError):
        scree.Batch(1, make=lambda seed: None)
    with pytest.raises(ValueError):
        scree.Batch(2).advance([[]])


def test_a_world_twice_in_a_batch_is_an_error():
    world = scree.World("flat")
    with pytest.raises(scree.Error):
        scree.Batch(2, lambda seed: world).advance()
    world.step()


def test_a_world_of_a_batch_at_work_is_in_use():
    batch = scree.Batch(4)
    world = batch.worlds[0]
    thread = threading.Thread(target=lambda: batch.advance(ticks=20000))
    thread.start()
    met = False
    while thread.is_alive() and not met:
        for call in (world.step, batch.advance):
            try:
                call()
            except scree.Error as error:
                met = "in use" in str(error)
    thread.join()
    assert met
    batch.advance()


STAND_IN = {
    "__init__.py": "from . import spaces, vector\n",
    "spaces.py": "class Box:\n    def __init__(self, low, high, dtype):\n"
                 "        self.low, self.high, self.shape = low, high, low.shape\n",
    "vector.py": "import enum\n\n\nclass AutoresetMode(enum.Enum):\n    NEXT_STEP = 'NextStep'\n\n\n"
                 "class VectorEnv:\n    metadata = {}\n\n"
                 "    def reset(self, *, seed=None, options=None):\n        raise NotImplementedError\n\n"
                 "    @property\n    def unwrapped(self):\n        return self\n",
}


def test_a_batch_is_a_vector_environment_where_gymnasium_is_installed(tmp_path):
    """By a stand-in with Gymnasium's names, which is not in Debian."""
    (tmp_path / "gymnasium").mkdir()
    for name, text in STAND_IN.items():
        (tmp_path / "gymnasium" / name).write_text(text)
    program = (
        "import gymnasium, numpy, scree\n"
        "batch = scree.Batch(2, steps=3)\n"
        "assert isinstance(batch, gymnasium.vector.VectorEnv) and batch.unwrapped is batch\n"
        "assert isinstance(batch.action_space, gymnasium.spaces.Box) and batch.action_space.shape == (2, 3)\n"
        "assert batch.metadata['autoreset_mode'] is gymnasium.vector.AutoresetMode.NEXT_STEP\n"
        "batch.reset(seed=1)\n"
        "assert batch.step(numpy.ones((2, 3)))[1].all()\n"
    )
    path = os.pathsep.join([str(tmp_path), os.environ["PYTHONPATH"]])
    subprocess.run([sys.executable, "-c", program], check=True, env=dict(os.environ, PYTHONPATH=path))
