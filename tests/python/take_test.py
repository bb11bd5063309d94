"""Arrays of a take are its own memory; takes are made of arrays, and what makes no sense is refused."""

import copy
import tracemalloc

import numpy as np
import pytest

import kinemend
from conftest import FIXTURES, TAKES


def arm(frames=10, **changes):
    rotations = np.zeros((frames, 2, 4))
    rotations[..., 0] = 1
    values = {"names": ["Root", "Arm"], "parents": [-1, 0], "offsets": np.ones((2, 3)), "rotations": rotations, "fps": 60.0}
    return kinemend.Take.of_joints(**{**values, **changes})


def address(array):
    return array.__array_interface__["data"][0]


def test_arrays_lie_where_the_take_has_them(noisy):
    addresses = noisy._addresses()
    for name in ("rotations", "positions", "observed", "offsets"):
        array = getattr(noisy, name)
        assert address(array) == addresses[name], name
        assert not array.flags.owndata and array.flags.writeable, name
        assert np.shares_memory(array, getattr(noisy, name)), name


def test_looking_at_arrays_and_cleaning_copies_none_of_them(noisy):
    long = noisy.copy()
    cleaner = kinemend.cleaners.gaussian()
    kinemend.clean(long, cleaner)
    tracemalloc.start()
    views = [long.rotations, long.positions, long.observed, long.offsets, long.rest_rotations]
    result = kinemend.clean(long, cleaner)
    views.append(result.take.rotations)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    # tracemalloc includes NumPy's allocations.
    assert most < 20_000 < long.rotations.nbytes
    assert address(views[-1]) == result.take._addresses()["rotations"]


def test_what_is_written_into_an_array_is_in_the_take(noisy):
    noisy.rotations[5, 3] = [0, 1, 0, 0]
    noisy.positions[7, 0] = [1, 2, 3]
    noisy.observed[9, 4] = False
    again = noisy.copy()
    assert again.rotations[5, 3].tolist() == [0, 1, 0, 0]
    assert again.positions[7, 0].tolist() == [1, 2, 3]
    assert not again.observed[9, 4] and again.observed[8, 4]
    assert kinemend.clean(noisy, "auto").report.figures.gaps is not None


def test_an_array_outlives_its_take():
    rotations = kinemend.read(TAKES / "walk.bvh").rotations
    assert np.allclose(np.linalg.norm(rotations, axis=-1), 1)


def test_shapes_are_fixed_and_the_tree_cannot_be_written(noisy):
    with pytest.raises(ValueError):
        noisy.rotations.resize((1, 1, 4))
    with pytest.raises(ValueError):
        noisy.parents[0] = 5
    with pytest.raises(AttributeError):
        noisy.rotations = np.zeros((1, 1, 4))


def test_a_copy_has_memory_of_its_own(noisy):
    for other in (noisy.copy(), copy.copy(noisy), copy.deepcopy(noisy)):
        other.rotations[0, 0] = [0, 0, 0, 1]
        assert noisy.rotations[0, 0].tolist() != [0, 0, 0, 1]


def test_frames_are_cut_as_a_list_is(noisy):
    assert len(noisy[10:20]) == 10 and len(noisy[-5:]) == 5 and len(noisy[500:]) == 0
    assert np.array_equal(noisy[10:20].rotations, noisy.rotations[10:20])
    with pytest.raises(ValueError):
        noisy[::2]


def test_a_take_of_joints_is_made_of_arrays():
    positions = np.arange(60.0).reshape(10, 2, 3)
    take = arm(positions=positions, translated_joints=[1], metres_per_unit=0.01, end_sites=[(1, (0, 5, 0), "Tip")])
    assert take.kind == "joints" and take.names == ["Root", "Arm"] and take.parents.tolist() == [-1, 0]
    assert np.array_equal(take.positions, positions) and take.translated_joints.tolist() == [1]
    assert take.observed.all() and take.end_sites == [(1, (0, 5, 0), "Tip")] and take.rotation_orders == ["ZXY", "ZXY"]
    back = kinemend.read(kinemend.to_bytes(take, "bvh"), name="arm.bvh")
    assert np.allclose(back.positions, positions) and back.fps == 60


def test_positions_of_a_joint_that_stays_are_its_offset():
    assert arm().positions.shape == (10, 1, 3) and (arm().positions == 1).all()


def test_other_memory_layouts_and_types_are_converted():
    rotations = np.asfortranarray(arm().rotations.astype(np.float32))
    offsets = np.ones((4, 3), dtype=np.int64)[::2]
    take = arm(rotations=rotations, offsets=offsets)
    assert take.rotations.dtype == np.float64 and take.rotations.flags.c_contiguous


@pytest.mark.parametrize("changes", [
    {"offsets": np.ones((3, 3))}, {"parents": [-1]}, {"rotations": np.zeros((10, 2, 3))},
    {"positions": np.zeros((9, 1, 3))}, {"observed": np.ones((10, 3), bool)}, {"rest_rotations": np.ones((1, 4))},
    {"translated_joints": [1]}])
def test_wrong_shapes_are_refused(changes):
    with pytest.raises(ValueError, match=next(iter(changes)).replace("translated_joints", "positions")):
        arm(**changes)


@pytest.mark.parametrize("changes", [
    {"rotations": np.zeros((10, 2, 4))}, {"rotations": np.full((10, 2, 4), np.nan)}, {"parents": [0, 0]}, {"parents": [-1, 1]},
    {"parents": [-1, 7]}, {"fps": 0.0}, {"fps": float("nan")}, {"offsets": np.full((2, 3), np.inf)},
    {"positions": np.full((10, 1, 3), np.nan)}, {"rotation_order": "ABC"}, {"end_sites": [(9, (0, 0, 0), "")]},
    {"positions": np.zeros((10, 2, 3)), "translated_joints": [7]}])
def test_takes_that_break_the_rules_are_refused(changes):
    with pytest.raises(kinemend.Error) as raised:
        arm(**changes)
    assert raised.value.kind == "usage" and raised.value.file is None


def test_a_list_of_names_is_no_text():
    with pytest.raises(TypeError, match="list of names"):
        arm(names="ab")


def test_missing_markers_are_those_without_a_position():
    positions = np.ones((4, 2, 3))
    positions[1, 0, 2] = np.nan
    take = kinemend.Take.of_markers(["LASI", "RASI"], positions, fps=100, unit="mm")
    assert take.kind == "markers" and take.unit == "mm" and take.rotations.shape == (0, 0, 4)
    assert take.observed.tolist() == [[True, True], [False, True], [True, True], [True, True]]
    assert take.positions[1, 0].tolist() == [0, 0, 0]
    assert np.shares_memory(take.observed, take.observed_positions)


def test_values_that_break_a_take_later_are_refused_when_it_is_cleaned(noisy):
    noisy.rotations[3, 3] = 0
    with pytest.raises(kinemend.Error, match="frame"):
        kinemend.clean(noisy, "gaussian")
    with pytest.raises(kinemend.Error):
        noisy.validate()


def test_names_that_are_no_utf8_come_back(tmp_path):
    text = (FIXTURES / "bvh/good/one_frame.bvh").read_bytes()
    first = kinemend.read(text, name="a.bvh").names[0]
    take = kinemend.read(text.replace(first.encode(), b"H\xfcfte"), name="a.bvh")
    assert take.names[0].encode("utf-8", "surrogateescape") == b"H\xfcfte"
    assert b"H\xfcfte" in kinemend.to_bytes(take)


def test_forward_kinematics_agrees_with_matrices(noisy):
    rotations, positions = noisy.forward_kinematics()
    locals_, globals_ = kinemend.local_matrices(noisy), kinemend.global_matrices(noisy)
    for joint, parent in enumerate(noisy.parents):
        expected = locals_[:, joint] if parent < 0 else globals_[:, parent] @ locals_[:, joint]
        assert np.allclose(globals_[:, joint], expected, atol=1e-9)
    assert np.allclose(globals_[..., :3, 3], positions)
    assert np.allclose(np.linalg.norm(rotations, axis=-1), 1)


def test_rest_rotations_are_part_of_local_rotations():
    take = kinemend.read(FIXTURES / "glb/good/posed.glb")
    assert not np.allclose(take.rest_rotations, [1, 0, 0, 0])
    locals_ = kinemend.local_matrices(take)
    globals_ = kinemend.global_matrices(take)
    for joint, parent in enumerate(take.parents):
        expected = locals_[:, joint] if parent < 0 else globals_[:, parent] @ locals_[:, joint]
        assert np.allclose(globals_[:, joint], expected, atol=1e-9)
