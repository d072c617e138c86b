"""What tests of the module share. Where the module is and what it is compared with comes from the environment."""

import json
import os
import pathlib
import subprocess

import pytest

import scree


@pytest.fixture
def source():
    """The source tree."""
    return pathlib.Path(os.environ["SCREE_SOURCE_DIR"])


@pytest.fixture
def flat():
    """A flat world with a tower on it."""
    world = scree.World("flat")
    step = world.step(scree.fill(scree.box((0, 4, 0), (1, 4, 1))))
    assert not step.refused
    return world


@pytest.fixture
def port():
    """The port of a server of flat ground, which ends with the test."""
    program = os.environ["SCREE_SERVER_PROGRAM"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("SCREE_")}
    with subprocess.Popen([program, "--port", "0", "--terrain", "flat"], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, env=environment) as server:
        try:
            yield json.loads(server.stdout.readline())["listening"]
        finally:
            server.terminate()


def blow(x=0.0, seeds=16):
    """A blow into the tower's foot, or beside it."""
    return scree.carve(scree.crater((x, 1, 0), 2.0), seeds=seeds)
