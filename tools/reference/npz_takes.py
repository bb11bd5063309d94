"""Writes small takes by NumPy itself: tests/fixtures/npz/{good,bad}/*.npz. Run from the repository's root:
python3 tools/reference/npz_takes.py
"""

import io
import os
import zipfile

import numpy as np

FIXTURES = "tests/fixtures/npz"
FRAMES, JOINTS = 5, 3


def joints():
    """Three joints in five frames: turns about fixed axes, the root moves along x."""
    axes = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1]])
    half = 0.1 * np.arange(FRAMES)[:, None] * np.array([1.0, -2, 3]) / 2
    rotations = np.concatenate([np.cos(half)[..., None], np.sin(half)[..., None] * axes], axis=2)
    positions = np.zeros((FRAMES, 1, 3))
    positions[:, 0, 0] = np.arange(FRAMES) / 8
    return {"fps": np.float64(60), "format": "kinemend-1", "names": np.array(["Hips", "Knee", "Füße"]),
            "parents": np.array([-1, 0, 1], np.int32), "offsets": np.array([[0, 1.0, 0], [0, -0.5, 0], [0, -0.5, 0]]),
            "rotations": rotations, "positions": positions, "metres_per_unit": np.float64(1)}


def markers():
    positions = np.arange(FRAMES * 2 * 3, dtype=float).reshape(FRAMES, 2, 3) * 10
    observed = np.ones((FRAMES, 2), np.uint8)
    observed[2, 1] = 0
    return {"fps": np.float64(100), "format": "kinemend-1", "names": np.array(["LASI", "RASI"]), "positions": positions,
            "observed": observed, "unit": "mm"}


def bytes_of(arrays, compressed=False):
    file = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(file, **arrays)
    return file.getvalue()


def main():
    def write(folder, name, data):
        os.makedirs(f"{FIXTURES}/{folder}", exist_ok=True)
        with open(f"{FIXTURES}/{folder}/{name}.npz", "wb") as file:
            file.write(data)

    def changed(arrays, **others):
        return {name: array for name, array in {**arrays, **others}.items() if array is not None}

    take, points = joints(), markers()
    write("good", "joints", bytes_of(take))
    write("good", "compressed", bytes_of(take, compressed=True))
    write("good", "markers", bytes_of(points))
    write("good", "float32", bytes_of({name: array.astype(np.float32) if name in ("rotations", "positions", "offsets") else array
                                       for name, array in take.items()}))
    write("good", "float16", bytes_of(changed(points, positions=points["positions"].astype(np.float16))))
    write("good", "fortran", bytes_of(changed(take, rotations=np.asfortranarray(take["rotations"]),
                                              offsets=np.asfortranarray(take["offsets"]))))
    write("good", "big_endian", bytes_of(changed(take, rotations=take["rotations"].astype(">f8"), parents=take["parents"].astype(">i8"),
                                                 names=take["names"].astype(">U4"))))
    observed = np.ones((FRAMES, JOINTS), bool)
    observed[1, 2] = False
    write("good", "gaps", bytes_of(changed(take, observed=observed)))
    write("good", "other_arrays", bytes_of(changed(take, contacts=np.eye(5, 2), heading=np.arange(5.0),
                                                   table=np.zeros(2, [("a", "f4"), ("b", "i4")])), compressed=True))
    write("good", "translated", bytes_of(changed(take, translated_joints=np.array([2], np.int32),
                                                 positions=np.repeat(take["positions"], 2, axis=1))))
    turn = np.array([[1.0, 0, 0, 0], [0.6, 0.8, 0, 0], [0, 0, 0, 1]])
    write("good", "rest", bytes_of(changed(take, rest_rotations=turn, end_parents=np.array([2]), end_offsets=np.array([[0, 0, 0.2]]),
                                           end_names=np.array(["toe"]))))
    write("good", "no_frames", bytes_of(changed(take, rotations=take["rotations"][:0], positions=take["positions"][:0])))
    broken = take["rotations"].copy()
    broken[1, 1] = np.nan
    broken[3, 0] = np.inf
    write("good", "not_finite", bytes_of(changed(take, rotations=broken)))
    zero = take["rotations"].copy()
    zero[2, 1] = 0
    zero[3] *= 1.5
    write("good", "odd_lengths", bytes_of(changed(take, rotations=zero, fps=None)))
    lost = points["positions"].copy()
    lost[4, 0] = np.nan
    write("good", "markers_not_finite", bytes_of(changed(points, positions=lost, observed=None, first_frame=np.int64(12))))
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.comment = b"a comment"
        for name, array in points.items():
            data = io.BytesIO()
            np.lib.format.write_array(data, np.asanyarray(array), version=(2, 0))
            archive.writestr(name + ".npy", data.getvalue(), zipfile.ZIP_STORED)
        archive.writestr("readme.txt", "no array")
    write("good", "version_2", file.getvalue())

    write("bad", "nothing", bytes_of({"other": np.zeros(3)}))
    write("bad", "no_names", bytes_of(changed(take, names=None)))
    write("bad", "layout", bytes_of(changed(take, format="kinemend-9")))
    write("bad", "child_first", bytes_of(changed(take, parents=np.array([-1, 2, 0]))))
    write("bad", "shape", bytes_of(changed(take, rotations=take["rotations"][:, :2])))
    write("bad", "objects", bytes_of(changed(take, names=np.array(["Hips", "Knee", "Foot"], object))))
    write("bad", "cut", bytes_of(take)[:-30])


if __name__ == "__main__":
    main()
