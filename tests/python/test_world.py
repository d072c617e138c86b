"""Worlds: made, stepped, saved, forked; and what they refuse."""

import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import scree
from conftest import blow


def test_a_carve_breaks_the_tower_and_conserves_mass(flat):
    step = flat.step(blow())
    assert [reply.accepted for reply in step.replies] == [True]
    assert step.replies[0].pieces > 4
    assert step.replies[0].number == step.numbers[0]
    assert step.ledger["error"] == 0
    assert step.ledger["pieces"] > 0
    assert "carve" in step.events["kind"]
    assert len(flat.pieces()) > 4
    assert flat.ledger() == step.ledger
    assert flat.measure_terrain() == flat.ledger()["terrain"]


def test_the_same_commands_give_the_hashes_of_the_program_in_c_plus_plus():
    lines = subprocess.run([os.environ["SCREE_GOLDEN"]], capture_output=True, text=True, check=True).stdout.split("\n")
    expected = [tuple(int(number, 16) for number in line.split()) for line in lines if line]
    world = scree.World("canyon", seed=7)
    found = []
    for tick in range(len(expected)):
        carve = scree.carve(scree.sphere((6.0 + tick, 20.0, 0.0), 2.5), seeds=12, random_seed=tick)
        step = world.step(carve if tick < 8 else None)
        found.append((step.field_hash, step.state_hash))
    assert found == expected
    assert len(found) > 60


def test_steps_of_many_ticks_are_those_of_single_ticks(flat):
    other = flat.fork()
    flat.step(blow(), ticks=30)
    other.step(blow())
    for _ in range(29):
        other.step()
    assert flat.tick == other.tick
    assert flat.state_hash == other.state_hash


def test_a_snapshot_is_restored_with_its_hashes(flat):
    flat.step(blow(), ticks=10)
    saved = flat.snapshot()
    again = scree.World.restore(saved)
    assert again.state_hash == flat.state_hash
    assert again.field_hash == flat.field_hash
    assert again.snapshot() == saved
    assert scree.World.restore(saved).step(ticks=20).state_hash == again.step(ticks=20).state_hash


def test_a_fork_goes_on_with_equal_hashes(flat):
    flat.step(blow(), ticks=20)
    fork = flat.fork()
    assert fork.state_hash == flat.state_hash
    for tick in range(60):
        commands = [blow(x=tick / 20)] if tick % 20 == 0 else []
        assert fork.step(commands).state_hash == flat.step(commands).state_hash
    flat.step(blow(3.0))
    fork.step()
    assert fork.state_hash != flat.state_hash


def test_threads_change_no_hash(flat):
    fork = flat.fork(threads=2)
    assert flat.step(blow(), ticks=30).state_hash == fork.step(blow(), ticks=30).state_hash


def test_rubble_comes_to_rest_and_is_terrain_again(flat):
    flat.step(blow())
    while len(flat.pieces()) and flat.tick < 3600:
        flat.step(ticks=10)
    assert len(flat.pieces()) == 0
    assert flat.ledger()["pieces"] == 0


def test_every_command_is_carried_out(flat):
    step = flat.step(scree.add_prop((0, 12, 6), half_m=(0.5, 0.5, 0.5), mass_kg=800, tag=9))
    crate = step.replies[0].body
    assert crate is not None
    row = flat.bodies(pieces=False)[0]
    assert row["id"] == crate and row["tag"] == 9 and row["mass_kg"] == 800 and not row["is_piece"]
    step = flat.step([scree.push(crate, (800, 0, 0), (0, 12, 6)), scree.move_prop(crate, spin_rad_s=(0, 1, 0)),
                      scree.paint(scree.sphere((0, -1, 9), 1.0), flat.materials.index("soil")),
                      scree.dig(scree.sphere((9, -1, 0), 1.0)), scree.cut_out(scree.box((0, 6, 0), (0.5, 0.5, 0.5))),
                      scree.blast((-9, 0, 0), 1e6), scree.remove_prop(crate), scree.setting("recombine", "off")])
    assert not step.refused, step.refused
    assert step.replies[3].mass_units > 0
    kept = step.replies[4].body
    assert kept is not None
    assert flat.stores["the world's store"]["rock"] > 0
    at = flat.pieces()[flat.pieces()["id"] == kept]["position_m"][0]
    step = flat.step([scree.place(scree.sphere((12, 1, 0), 0.5)), scree.break_piece(kept, at, seeds=4),
                      scree.release(kept)])
    assert [reply.accepted for reply in step.replies][:2] == [True, True], step.replies
    assert flat.ledger()["error"] == 0
    assert flat.settings["recombine"] == "off"


def test_refusals_have_words_and_a_name(flat):
    step = flat.step(scree.carve(scree.sphere((0, 0, 0), 100.0)))
    assert step.refused[0].reason == "carve_invalid"
    assert "100" in step.refused[0].refusal and not step.refused[0].accepted


def test_settings_are_arguments():
    world = scree.World("flat", recombine="stamp", islands=False, pieces_max=50)
    found = [world.settings[name] for name in ("recombine", "islands", "pieces-max")]
    assert found == ["stamp", "false", "50"]


@pytest.mark.parametrize("make", [
    lambda: scree.World("hills"),
    lambda: scree.World("flat", voxel_m=0.0),
    lambda: scree.World("flat", voxel_m=float("nan")),
    lambda: scree.World("flat", seed=-1),
    lambda: scree.World("flat", tick_rate_hz=0),
    lambda: scree.World("flat", threads=65),
    lambda: scree.World("flat", recombine="glue"),
    lambda: scree.World("flat", no_such_setting=1),
    lambda: scree.sphere((0, 0), 1.0),
    lambda: scree.sphere((0, 0, float("inf")), 1.0),
    lambda: scree.sphere((0, 0, 0), float("nan")),
    lambda: scree.sphere((0, 0, 0), -1.0),
    lambda: scree.carve(scree.sphere((0, 0, 0), 1.0), pattern="zigzag"),
    lambda: scree.carve(scree.sphere((0, 0, 0), 1.0), seeds=-1),
    lambda: scree.add_prop((0, 0, 0), turn=(0, 0, 0, 0)),
    lambda: scree.paint(scree.sphere((0, 0, 0), 1.0), 255),
    lambda: scree.World().step(ticks=0),
    lambda: scree.World().codes((0, 0, 0), (0, 1, 1)),
    lambda: scree.World().codes((0, 0, 0), (2000, 2000, 2000)),
    lambda: scree.World().codes((0, 0, 0), (10**9, 1, 1)),
    lambda: scree.World().heights((0, 0, 0), (1, 1, 1), step=0),
    lambda: scree.World().cast_ray((0, 0, 0), (0, 0, 0)),
    lambda: scree.World().cast_ray((0, 0, 0), (0, 1, 0), 1e9),
    lambda: scree.World().distance(np.zeros((3, 2))),
    lambda: scree.World().distance([[1e9, 0, 0]]),
    lambda: scree.World().overlap_sphere((0, 0, 0), 1e6),
    lambda: scree.World().nearest_surface((1e11, 0, 0)),
])
def test_wrong_values_are_value_errors(make):
    with pytest.raises(ValueError):
        make()


@pytest.mark.parametrize("make", [
    lambda: scree.World(terrain=3),
    lambda: scree.World().step("carve"),
    lambda: scree.World().step([1]),
    lambda: scree.sphere("here", 1.0),
    lambda: scree.carve((0, 0, 0)),
    lambda: scree.World().codes(0, 1),
    lambda: scree.World().codes((0.5, 0, 0), (1, 1, 1)),
    lambda: scree.World.restore("text"),
])
def test_wrong_types_are_type_errors(make):
    with pytest.raises(TypeError):
        make()


def test_requests_beyond_all_limits_are_refused_and_never_crash(flat):
    far = 1e12
    odd = [scree.carve(scree.sphere((far, 0, 0), 1.0)), scree.fill(scree.box((0, far, 0), (1, 1, 1))),
           scree.fill(scree.sphere((0, 2, 9), 1.0), 254), scree.paint(scree.sphere((0, 0, 0), 1.0), 254),
           scree.blast((0, 0, 0), -1.0), scree.blast((0, 0, 0), far), scree.blast((far, far, far), 1e6),
           scree.push(7777, (1, 0, 0), (0, 0, 0)), scree.break_piece(7777, (0, 0, 0)), scree.release(7777),
           scree.add_prop((far, 0, 0)), scree.add_prop((0, 0, 0), half_m=(0, 0, 0)),
           scree.add_prop((0, 0, 0), part="hull", corners_m=np.zeros((3, 3))), scree.remove_prop(7777),
           scree.dig(scree.sphere((0, 1e6, 0), 1.0)), scree.place(scree.sphere((0, 30, 0), 1.0)),
           scree.carve(scree.sphere((0, 0, 0), 1.0), pattern="authored"),
           scree.carve(scree.sphere((0, 0, 0), 1.0), seeds=2**32 - 1), scree.setting("x" * 1000, "y" * 1000),
           scree.carve(scree.capsule((-far, 0, 0), (far, 0, 0), 1.0)), scree.cut_out(scree.sphere((0, 500, 0), 1.0))]
    step = flat.step(odd)
    assert len(step.refused) == len(odd), [r for r in step.replies if r.accepted]
    assert flat.step(ticks=3).ledger["error"] == 0


@pytest.mark.parametrize("seed", [1, 2])
def test_calls_at_random_never_end_the_process(source, seed):
    said = subprocess.run([sys.executable, source / "tests/python/random_calls.py", str(seed), "200"],
                          capture_output=True, text=True, check=False)
    assert said.returncode == 0, said.stderr
    assert int(said.stdout.split()[0]) > 20


def test_a_long_step_can_be_interrupted():
    program = ("import scree, signal\nsignal.setitimer(signal.ITIMER_REAL, 0.3)\n"
               "signal.signal(signal.SIGALRM, signal.default_int_handler)\n"
               "world = scree.World('flat')\n"
               "try:\n    world.step(ticks=1000000)\n"
               "except KeyboardInterrupt:\n    print('stopped', world.step().tick > 1)\n")
    said = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=100)
    assert said.stdout == "stopped True\n"


def test_damaged_snapshots_are_refused(flat):
    flat.step(blow(), ticks=5)
    saved = flat.snapshot()
    with pytest.raises(scree.Error):
        scree.World.restore(b"")
    with pytest.raises(scree.Error):
        scree.World.restore(saved[:-7])
    for at in range(0, len(saved), max(1, len(saved) // 40)):
        damaged = bytearray(saved)
        damaged[at] ^= 0x55
        try:
            scree.World.restore(bytes(damaged)).step()
        except scree.Error:
            pass


def test_two_threads_on_one_world_are_an_error(flat):
    raised, started = [], threading.Event()

    def work():
        started.set()
        try:
            flat.step(ticks=20000)
        except scree.Error as error:
            raised.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    started.wait()
    met = False
    while thread.is_alive() and not met:
        try:
            flat.step()
        except scree.Error as error:
            met = "in use" in str(error)
    thread.join()
    assert met or raised
    flat.step()  # nobody uses it any more


def resident_mb():
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) / 1024


def test_a_thousand_worlds_leave_memory_flat():
    def make(count):
        for seed in range(count):
            scree.World("flat", seed=seed).step(scree.carve(scree.sphere((0, 0, 0), 1.0), seeds=3))

    make(200)
    before = resident_mb()
    make(1000)
    assert resident_mb() - before < 8
