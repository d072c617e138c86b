"""Arrays of a world: what they hold, and that each is filled once."""

import numpy as np
import pytest

import scree
from conftest import blow


@pytest.mark.parametrize("call, dtype", [("codes", np.int8), ("distances", np.float32), ("occupancy", np.bool_),
                                         ("materials_in", np.uint8)])
def test_arrays_of_boxes_own_one_buffer(flat, call, dtype):
    array = getattr(flat, call)((-8, -8, -8), (8, 40, 12))
    assert array.shape == (16, 48, 20) and array.dtype == dtype and array.flags.c_contiguous
    assert not array.flags.owndata
    assert type(array.base).__name__ == "PyCapsule"
    view = array[2:4]
    assert view.base is array


def test_arrays_outlive_their_world(flat):
    codes = flat.codes((-4, -4, -4), (4, 4, 4))
    expected = codes.copy()
    del flat
    assert (codes == expected).all()


def test_codes_distances_and_occupancy_agree(flat):
    lo, hi = (-12, -12, -12), (12, 44, 12)
    codes = flat.codes(lo, hi).astype(np.float32)
    distances = flat.distances(lo, hi)
    assert np.allclose(distances, codes * 3 / 127 * flat.voxel_m, atol=1e-6)
    assert (flat.occupancy(lo, hi) == (codes < 0)).all()
    assert codes[12, 12 + 8, 12] < 0 < codes[0, 12 + 8, 0]  # the tower, and beside it
    mass = np.clip(127 - 6 * codes, 0, 254)[:, 16:, :].sum()  # from 7/8 m up
    assert mass == pytest.approx(7.125 * 2 * 2 / flat.voxel_m**3 * 254, rel=0.05)


def test_materials_are_numbers_of_the_palette(flat):
    flat.step(scree.paint(scree.sphere((0, 4, 0), 0.8), flat.materials.index("ice")))
    assert (flat.materials_in((0, 16, 0), (1, 17, 1)) == flat.materials.index("ice")).all()


def test_heights_see_the_tower_and_the_plain(flat):
    heights = flat.heights((-16, -20, -16), (17, 60, 17), step=16)
    assert heights.shape == (3, 3)
    assert heights[1, 1] == pytest.approx(8.0, abs=0.02)
    assert heights[0, 0] == pytest.approx(0.0, abs=0.02)
    assert np.isnan(flat.heights((0, 50, 0), (1, 60, 1))).all()


def test_distances_at_places_are_those_of_voxels(flat):
    voxels = np.array([[0, 20, 0], [3, 31, 2], [40, 1, 40]])
    expected = [flat.distances(v, v + 1)[0, 0, 0] for v in voxels]
    assert np.allclose(flat.distance(voxels * flat.voxel_m), expected, atol=1e-5)


def test_bodies_are_rows(flat):
    flat.step(blow(), ticks=3)
    pieces = flat.pieces()
    assert pieces.dtype == scree.body_type and not pieces.flags.owndata
    assert (np.diff(pieces["id"].astype(np.int64)) > 0).all()
    assert pieces["is_piece"].all() and pieces["awake"].any() and not pieces["kept"].any()
    assert np.allclose(np.linalg.norm(pieces["rotation"], axis=1), 1, atol=1e-4)
    assert pieces["mass_units"].sum() == flat.ledger()["pieces"]
    assert (np.abs(pieces["velocity_m_s"]).sum(axis=1) > 0).any()


def test_rays_find_the_tower(flat):
    hit = flat.cast_ray((-10, 4, 0), (2, 0, 0), 50)
    assert hit.kind == "terrain" and not hit.inside
    assert hit.distance_m == pytest.approx(9, abs=0.02) and hit.normal[0] == pytest.approx(-1, abs=0.01)
    assert flat.cast_ray((-10, 20, 0), (1, 0, 0)) is None
    assert flat.cast_ray((-10, 4, 0), (1, 0, 0), terrain=False) is None
    far = flat.cast_rays([(-10, 4, 0), (-10, 20, 0)], [(1, 0, 0), (1, 0, 0)], 50)
    assert far[0] == pytest.approx(hit.distance_m) and np.isinf(far[1])
    near = flat.nearest_surface((-2, 4, 0))
    assert near.distance_m == pytest.approx(1, abs=0.02)
    assert flat.nearest_surface((-30, 30, 0)) is None


def test_overlaps_name_bodies(flat):
    assert flat.overlap_sphere((0, 4, 0), 0.5) == (True, [])
    crate = flat.step(scree.add_prop((0, 20, 0))).replies[0].body
    assert flat.overlap_sphere((0, 20, 0), 0.5) == (False, [crate])
    assert flat.overlap_box((-1, 19, -1), (1, 21, 1)) == (False, [crate])
    assert flat.overlap_box((-1, 19, -1), (1, 21, 1), bodies=False) == (False, [])
