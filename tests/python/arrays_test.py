"""Takes go to NumPy archives and come back, and to pandas where it is there."""

import numpy as np
import pytest

import kinemend
from conftest import FIXTURES


def test_joints_come_back(noisy, tmp_path):
    noisy.observed[3:9, 4] = False
    kinemend.to_npz(noisy, tmp_path / "walk.npz")
    back = kinemend.from_npz(tmp_path / "walk.npz")
    assert back.names == noisy.names and back.fps == noisy.fps and back.parents.tolist() == noisy.parents.tolist()
    for name in ("rotations", "positions", "offsets", "observed"):
        assert np.array_equal(getattr(back, name), getattr(noisy, name)), name
    assert np.array_equal(kinemend.clean(back, "gaussian").take.rotations, kinemend.clean(noisy, "gaussian").take.rotations)


def test_rest_rotations_become_part_of_the_rotations(tmp_path):
    take = kinemend.read(FIXTURES / "glb/good/posed.glb")
    kinemend.to_npz(take, tmp_path / "posed.npz")
    back = kinemend.from_npz(tmp_path / "posed.npz")
    assert np.allclose(back.rest_rotations, [1, 0, 0, 0])
    assert np.allclose(kinemend.global_matrices(back), kinemend.global_matrices(take))


def test_translated_joints_come_back(tmp_path):
    rotations = np.tile([1.0, 0, 0, 0], (5, 2, 1))
    take = kinemend.Take.of_joints(["Root", "Arm"], [-1, 0], np.ones((2, 3)), rotations, np.random.default_rng(1).random((5, 2, 3)),
                                   fps=60, translated_joints=[1])
    kinemend.to_npz(take, tmp_path / "a.npz", compress=False)
    back = kinemend.from_npz(tmp_path / "a.npz")
    assert back.translated_joints.tolist() == take.translated_joints.tolist()
    assert np.array_equal(back.positions, take.positions)


def test_markers_come_back(tmp_path):
    take = kinemend.read(FIXTURES / "trc/good/gaps.trc")
    kinemend.to_npz(take, tmp_path / "m.npz")
    back = kinemend.from_npz(tmp_path / "m.npz")
    assert back.kind == "markers" and back.unit == take.unit and back.names == take.names
    assert np.array_equal(back.positions, take.positions) and np.array_equal(back.observed, take.observed)
    assert not take.observed.all()


def test_an_archive_holds_what_the_page_of_the_format_says(noisy, tmp_path):
    kinemend.to_npz(noisy, tmp_path / "w.npz", local_matrices=True, global_matrices=True, contacts=True)
    with np.load(tmp_path / "w.npz", allow_pickle=False) as archive:
        found = {name: (archive[name].shape, archive[name].dtype.kind) for name in archive.files}
        assert str(archive["format"]) == "kinemend-1" and archive["observed"].dtype == np.uint8
    frames, joints, parts = len(noisy), len(noisy.names), found["contacts"][0][1]
    assert found == {
        "format": ((), "U"), "fps": ((), "f"), "names": ((joints,), "U"), "parents": ((joints,), "i"), "offsets": ((joints, 3), "f"),
        "rotations": ((frames, joints, 4), "f"), "positions": ((frames, 1, 3), "f"), "translated_joints": ((0,), "i"),
        "observed": ((frames, joints), "u"), "metres_per_unit": ((), "f"), "local_matrices": ((frames, joints, 4, 4), "f"),
        "global_matrices": ((frames, joints, 4, 4), "f"), "contacts": ((frames, parts), "u"), "contact_names": ((parts,), "U")}


def test_archives_that_hold_no_take_are_refused(noisy, tmp_path):
    path = tmp_path / "a.npz"
    kinemend.to_npz(noisy, path)
    with np.load(path) as archive:
        whole = dict(archive)
    damaged = [{key: value for key, value in whole.items() if key != left_out} for left_out in ("format", "rotations", "parents", "fps")]
    damaged += [{**whole, "format": np.str_("other")}, {**whole, "rotations": whole["rotations"][:5]}, {**whole, "fps": np.zeros(3)},
                {**whole, "parents": whole["parents"].astype(float) + 0.5}, {**whole, "rotations": whole["rotations"] * 2},
                {**whole, "names": np.array([{}], dtype=object)}]
    for arrays in damaged:
        np.savez(path, **arrays)
        with pytest.raises(kinemend.Error) as raised:
            kinemend.from_npz(path)
        assert raised.value.kind == "unreadable_input" and raised.value.file == str(path)
    for content in (b"", b"PK\x03\x04", b"no archive", path.read_bytes()[:200]):
        path.write_bytes(content)
        with pytest.raises(kinemend.Error):
            kinemend.from_npz(path)
    with pytest.raises(kinemend.Error):
        kinemend.from_npz(tmp_path / "nowhere.npz")


def test_markers_have_no_matrices():
    with pytest.raises(kinemend.Error, match="markers"):
        kinemend.global_matrices(kinemend.read(FIXTURES / "trc/good/gaps.trc"))


def test_pandas_has_a_row_a_frame(noisy):
    pytest.importorskip("pandas")
    noisy.observed[5, 2] = False
    table = kinemend.to_pandas(noisy)
    assert table.shape == (len(noisy), 4 * len(noisy.names) + 3)
    assert table.index[1] == 1 / noisy.fps
    name = noisy.names[2]
    assert table[name].isna()["w"].sum() == 1 and table[noisy.names[3]]["w"].iloc[7] == noisy.rotations[7, 3, 0]
    markers = kinemend.to_pandas(kinemend.read(FIXTURES / "trc/good/gaps.trc"))
    assert markers.isna().any(axis=None)
    tracks = kinemend.to_pandas(kinemend.clean(noisy, "gaussian").report.tracks)
    assert list(tracks["name"]) == noisy.names
