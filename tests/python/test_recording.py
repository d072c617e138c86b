"""Recordings: of tests/data, whole and damaged."""

import numpy as np
import pytest

import scree


@pytest.fixture
def path(source):
    return source / "tests/data/format_4/hills.scree"


def test_a_recording_tells_its_ticks(path):
    recording = scree.Recording(path)
    assert recording.first_tick == 1 and recording.last_tick >= 119
    assert len(recording) == len(recording.ticks) == recording.last_tick
    assert recording.header["voxel_m"] == 0.25 and recording.header["ground"]
    assert "rock" in recording.header["materials"]
    assert recording.bytes == path.stat().st_size


def test_the_ledger_balances_and_is_that_of_the_frames(path):
    recording = scree.Recording(path)
    ledger = recording.ledger()
    assert ledger.dtype == scree.ledger_type and not ledger.flags.owndata
    assert (ledger["error"] == 0).all() and (ledger["tick"] == recording.ticks).all()
    frames = list(recording)
    assert [frame.tick for frame in frames] == recording.ticks.tolist()
    for row, frame in zip(ledger, frames):
        assert row["terrain"] == frame.ledger["terrain"] and row["dust"] == frame.ledger["dust"]
    assert any(frame.operations.get("carves") for frame in frames)
    moved = next(frame.moved for frame in frames if len(frame.moved))
    assert np.isfinite(moved["position_m"]).all()


def test_events_are_rows(path):
    recording = scree.Recording(path)
    events = recording.events()
    assert events.dtype == scree.event_type
    assert "carve" in events["kind"]
    carve = events[events["kind"] == "carve"][0]
    assert carve["pieces"] > 0 and np.isfinite(carve["place_m"]).all()
    part = recording.events(first=int(carve["tick"]), last=int(carve["tick"]))
    assert (part["tick"] == carve["tick"]).all()


def test_ticks_beyond_are_value_errors(path):
    recording = scree.Recording(path)
    for tick in (0, recording.last_tick + 1, -1):
        with pytest.raises(ValueError):
            recording.frame(tick)
    with pytest.raises(ValueError):
        recording.ledger(first=0)


def test_damaged_files_are_errors_in_words(path, tmp_path):
    whole = path.read_bytes()
    copy = tmp_path / "damaged.scree"
    with pytest.raises(scree.Error, match="missing.scree"):
        scree.Recording(tmp_path / "missing.scree")
    for damaged in (b"", b"text", whole[:5000], whole[: len(whole) // 2]):
        copy.write_bytes(damaged)
        with pytest.raises(scree.Error, match="damaged.scree"):
            scree.Recording(copy)
    with pytest.raises(TypeError):
        scree.Recording(3)
