"""`Client` against the server's program on loopback."""

import os
import threading

import numpy as np
import pytest

import scree


@pytest.fixture
def client(port):
    with scree.Client(port=port, radius_m=64) as joined:
        joined.wait_until_loaded()
        yield joined


def wait_for_rest(client):
    """Until the copy has no piece, and the server's hash."""
    for _ in range(1200):
        client.poll(0.1)
        now = client.status()
        if now["pieces"] == 0 and now["server_hash"] and now["field_hash"] == now["server_hash"]:
            return now
    raise AssertionError(client.status())


def test_a_carve_is_answered_and_the_copy_is_the_servers(client):
    eye = client.status()["eye_m"]
    hit = client.cast_ray((eye[0], eye[1] + 50, eye[2]), (0, -1, 0))
    assert hit.kind == "terrain"
    assert client.materials[hit.material] in ("rock", "soil")
    assert client.status()["role"] == "builder" and client.carried == {}
    above = client.distances([(eye[0], hit.place_m[1] + 0.5, eye[2]), (eye[0], hit.place_m[1] - 0.5, eye[2])])
    np.testing.assert_allclose(above, [0.5, -0.5], atol=0.05)
    reply = client.carry_out(scree.carve(scree.sphere(hit.place_m, 1.5), seeds=12, random_seed=4))
    assert reply["text"] == "" and reply["number"] > 0
    now = wait_for_rest(client)
    assert now["mismatches"] == 0
    voxel = np.floor(np.asarray(hit.place_m) / now["voxel_m"]).astype(int)
    codes = client.codes(voxel - 8, voxel + 8)
    assert codes.shape == (16, 16, 16) and codes.dtype == np.int8
    assert (codes < 0).any() and (codes > 0).any()


def test_pieces_and_events_are_told(client):
    hit = client.cast_ray((8, 50, 8), (0, -1, 0))
    number = client.ask(scree.carve(scree.sphere(hit.place_m, 2), seeds=20))
    kinds, most = set(), 0
    for _ in range(200):
        for event in client.poll(0.05):
            kinds.add(event["kind"])
            if event["kind"] == "reply":
                assert event["request"] == number
            if event["kind"] == "terrain":
                assert event["bricks"].shape[1] == 3
        bodies = client.bodies()
        most = max(most, len(bodies))
        assert (np.abs(bodies["position_m"]) < 100).all()
        if {"reply", "terrain", "piece_added"} <= kinds:
            break
    assert most > 0


def test_a_refusal_has_words_and_wrong_arguments_raise(client):
    reply = client.carry_out(scree.carve(scree.sphere((0, 0, 0), 100)))
    assert reply["name"] == "carve_invalid" and "8 m" in reply["text"]
    with pytest.raises(ValueError):
        client.ask(scree.setting("gravity", "1"))
    with pytest.raises(ValueError):
        client.cast_ray((0, 0, 0), (0, 0, 0))
    with pytest.raises(ValueError):
        client.poll(-1)
    with pytest.raises(ValueError):
        client.say("")
    with pytest.raises(ValueError):
        scree.Client(port=0)
    with pytest.raises(ValueError):
        scree.Client(name="n" * 100)


def test_a_chunk_is_a_mesh(client):
    mesh = next(found for y in (-1, 0) if (found := client.mesh_chunk((0, y, 0))) is not None)
    assert mesh["triangles"].max() < len(mesh["positions"]) == len(mesh["materials"])
    np.testing.assert_allclose(np.linalg.norm(mesh["normals"], axis=1), 1, atol=0.02)
    assert client.mesh_chunk((0, 5, 0)) is None


def test_no_server_is_an_error_and_a_closed_client_says_so():
    with scree.Client(port=1) as client:
        with pytest.raises(scree.Error):
            client.wait_until_loaded(20)
        with pytest.raises(scree.Error):
            client.ask(scree.fill(scree.sphere((0, 0, 0), 1)))
    with pytest.raises(scree.Error, match="closed"):
        client.poll()


def test_what_a_server_could_not_read_is_refused_here_and_the_connection_lives(client):
    with pytest.raises(ValueError, match="negative"):
        client.ask(scree.add_prop((6, 10, 6), mass_kg=-1))
    assert client.carry_out(scree.fill(scree.sphere((9, 1, 9), 1)))["text"] == ""
    with pytest.raises(ValueError):
        client.mesh_chunk((0.5, 0, 0))


def test_a_child_of_fork_has_no_client_and_ends(client):
    child = os.fork()
    if child == 0:
        try:
            client.poll()
        except scree.Error:
            client.close()
            os._exit(3)
        os._exit(4)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
    assert client.status()["connected"]


def test_a_second_thread_gets_an_error(client):
    errors = []

    def poll():
        try:
            for _ in range(200):
                client.poll(0.005)
        except scree.Error as error:
            errors.append(str(error))

    threads = [threading.Thread(target=poll) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors and all("another thread" in error for error in errors)
