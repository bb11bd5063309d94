"""Takes as the arrays and files that motion learning uses."""

from __future__ import annotations

import importlib
import os
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._commands import contacts
from ._core import Take
from ._errors import Error, error_of
from ._files import _GivenTake, taken

_Path = str | os.PathLike[str]
_Doubles = npt.NDArray[np.float64]

NPZ_FORMAT = "kinemend-1"
# Errors that NumPy and zipfile raise for invalid archives and unsuitable arrays.
_BROKEN = (
    EOFError,
    KeyError,
    ValueError,
    TypeError,
    AttributeError,
    NotImplementedError,
    zipfile.BadZipFile,
    zlib.error,
)


def _product(a: _Doubles, b: _Doubles) -> _Doubles:
    """Of quaternions w, x, y, z: turns by b first."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def _matrices(rotations: _Doubles, positions: _Doubles) -> _Doubles:
    """(..., 4, 4) of unit quaternions (..., 4) and positions (..., 3)."""
    w, x, y, z = np.moveaxis(rotations, -1, 0)
    result = np.zeros((*rotations.shape[:-1], 4, 4))
    result[..., 0, 0] = 1 - 2 * (y * y + z * z)
    result[..., 0, 1] = 2 * (x * y - w * z)
    result[..., 0, 2] = 2 * (x * z + w * y)
    result[..., 1, 0] = 2 * (x * y + w * z)
    result[..., 1, 1] = 1 - 2 * (x * x + z * z)
    result[..., 1, 2] = 2 * (y * z - w * x)
    result[..., 2, 0] = 2 * (x * z - w * y)
    result[..., 2, 1] = 2 * (y * z + w * x)
    result[..., 2, 2] = 1 - 2 * (x * x + y * y)
    result[..., :3, 3] = positions
    result[..., 3, 3] = 1
    return result


def _need_joints(take: Take) -> None:
    if take.kind != "joints":
        raise Error("this take holds markers; only joints have rotations")


def local_rotations(take: Take) -> _Doubles:
    """The whole rotation of each joint in its parent, (F, J, 4): the rest rotation, then that of the frame.

    `take.rotations` leaves the rest rotation out. In BVH files both are the same.
    """
    _need_joints(take)
    return _product(take.rest_rotations[np.newaxis], take.rotations)


def local_positions(take: Take) -> _Doubles:
    """The position of each joint in its parent, (F, J, 3); of joint 0 in the world."""
    _need_joints(take)
    positions = np.repeat(take.offsets[np.newaxis], len(take), axis=0)
    positions[:, 0] = take.positions[:, 0]
    positions[:, take.translated_joints] = take.positions[:, 1:]
    return positions


def local_matrices(take: Take) -> _Doubles:
    """Transforms (F, J, 4, 4) of each joint in its parent, which act on columns: p' = M p."""
    return _matrices(local_rotations(take), local_positions(take))


def global_matrices(take: Take) -> _Doubles:
    """Transforms (F, J, 4, 4) of each joint in the world, which act on columns: p' = M p.

    Examples
    --------
    >>> kinemend.global_matrices(kinemend.read("walk.bvh")).shape
    (960, 31, 4, 4)
    """
    _need_joints(take)
    return _matrices(*take.forward_kinematics())


def contact_masks(
    take: _GivenTake, *, feet_names: Mapping[str, str] | None = None
) -> tuple[list[str], npt.NDArray[np.bool_]]:
    """When heels and toes stand, as arrays.

    Returns
    -------
    names : list of str
        C parts of feet: "left heel".
    masks : array of bool of shape (F, C)
        True where the part stands.

    Examples
    --------
    >>> names, masks = kinemend.contact_masks(kinemend.read("walk.bvh"))
    >>> names
    ['left heel', 'left toe', 'right heel', 'right toe']
    """
    take = taken(take)
    feet = contacts(take, feet_names=feet_names).feet
    found = [] if feet is None or feet.contacts is None else feet.contacts
    names = sorted({f"{contact.side} {contact.part}" for contact in found})
    masks = np.zeros((len(take), len(names)), dtype=np.bool_)
    for contact in found:
        first, last = (frame - take.first_frame for frame in (contact.first_frame, contact.last_frame))
        masks[first : last + 1, names.index(f"{contact.side} {contact.part}")] = True
    return names, masks


def _joint_arrays(take: Take) -> dict[str, Any]:
    return {
        "parents": take.parents,
        "offsets": take.offsets,
        "rotations": local_rotations(take),
        "translated_joints": take.translated_joints,
        "metres_per_unit": np.float64(take.metres_per_unit),
    }


def to_npz(
    take: Take,
    path: _Path,
    *,
    local_matrices: bool = False,
    global_matrices: bool = False,
    contacts: bool = False,
    compress: bool = True,
) -> None:
    """Write a take as a NumPy archive, which every tool that reads `.npz` can read.

    docs/formats/npz.md describes the arrays. The archive holds the motion, not the file that it
    came from.

    Parameters
    ----------
    take : Take
        Joints or markers.
    path : path
        "walk.npz". A file that exists is overwritten.
    local_matrices, global_matrices : bool, default False
        Of joints: also transforms (F, J, 4, 4).
    contacts : bool, default False
        Of joints: also when feet stand, `contacts` (F, C) and `contact_names` (C,).
    compress : bool, default True
        Compress the arrays.
    """
    arrays: dict[str, Any] = {
        "format": np.str_(NPZ_FORMAT),
        "fps": np.float64(take.fps),
        "names": np.array(take.names, dtype=np.str_),
        "positions": take.positions,
        "observed": take.observed.astype(np.uint8),
    }
    if take.kind == "joints":
        arrays.update(_joint_arrays(take))
    else:
        arrays["unit"] = np.str_(take.unit)
    # The parameters have the same names as the functions.
    module = globals()
    for wanted, name in ((local_matrices, "local_matrices"), (global_matrices, "global_matrices")):
        if wanted:
            arrays[name] = module[name](take)
    if contacts:
        names, masks = contact_masks(take)
        arrays["contact_names"] = np.array(names, dtype=np.str_)
        arrays["contacts"] = masks.astype(np.uint8)
    save = np.savez_compressed if compress else np.savez
    with open(path, "wb") as file:
        save(file, **arrays)


def from_npz(path: _Path) -> Take:
    """Read a take from such an archive, also one that another tool made.

    Raises
    ------
    Error
        The file is no such archive, or an array is missing or has another shape.
    """
    name = os.fspath(path)
    try:
        with np.load(path, allow_pickle=False) as archive:
            return _take_of({key: archive[key] for key in archive.files}, name)
    except Error as error:
        raise Error(f"{name}: {error}", "unreadable_input") from None
    except OSError as error:
        words = os.strerror(error.errno) if error.errno else str(error)
        raise error_of(f"{name}: {words}", "unreadable_input") from None
    except _BROKEN as error:
        words = str(error).strip("'\"")
        problem = f"the array {words} is missing" if isinstance(error, KeyError) else words
        raise Error(f"{name}: {problem}", "unreadable_input") from None


def _take_of(arrays: Mapping[str, npt.NDArray[Any]], name: str) -> Take:
    if str(arrays["format"]) != NPZ_FORMAT:
        raise Error(f"expected format {NPZ_FORMAT}, found {arrays['format']}")
    names = [str(name) for name in arrays["names"]]
    fps = float(arrays["fps"])
    observed = arrays.get("observed")
    marks = None if observed is None else observed.astype(np.bool_)
    if "rotations" in arrays:
        take = Take.of_joints(
            names,
            arrays["parents"],
            arrays["offsets"],
            arrays["rotations"],
            arrays["positions"],
            fps=fps,
            observed=marks,
            translated_joints=arrays.get("translated_joints", np.zeros(0, dtype=np.int32)),
            metres_per_unit=float(arrays.get("metres_per_unit", np.float64(0))),
        )
    else:
        unit = str(arrays.get("unit", np.str_("")))
        take = Take.of_markers(names, arrays["positions"], fps=fps, observed=marks, unit=unit)
    take.name = name
    return take


def _channels(take: Take) -> tuple[list[tuple[str, str]], _Doubles]:
    frames = len(take)
    columns = [(name, axis) for name in take.names for axis in ("w", "x", "y", "z")]
    owners = [take.names[0], *(take.names[joint] for joint in take.translated_joints)]
    columns += [(name, f"position {axis}") for name in owners for axis in ("x", "y", "z")]
    values = np.hstack([take.rotations.reshape(frames, -1), take.positions.reshape(frames, -1)])
    return columns, values


def to_pandas(source: Take | Sequence[Any]) -> Any:
    """A take, or a list of a report such as `report.tracks`, as a pandas DataFrame (a copy).

    A row of a take is a frame, by its time in seconds. Its columns have two levels: joint or marker,
    and w, x, y, z of rotations or the axis of a position. Missing samples are NaN.

    Examples
    --------
    >>> frame = kinemend.to_pandas(kinemend.read("walk.bvh"))
    >>> frame["LeftArm"]["w"].shape
    (960,)
    """
    pandas = importlib.import_module("pandas")
    if not isinstance(source, Take):
        return pandas.DataFrame([asdict(row) if is_dataclass(row) else row for row in source])
    times = pandas.Index(np.arange(len(source)) / source.fps, name="time_s")
    if source.kind == "joints":
        columns, values = _channels(source)
        missing = np.hstack(
            [np.repeat(~source.observed, 4, axis=1), np.repeat(~source.observed_positions, 3, axis=1)]
        )
    else:
        columns = [(name, axis) for name in source.names for axis in ("x", "y", "z")]
        values = source.positions.reshape(len(source), -1)
        missing = np.repeat(~source.observed, 3, axis=1)
    labels = pandas.MultiIndex.from_tuples(columns)
    return pandas.DataFrame(np.where(missing, np.nan, values), index=times, columns=labels)
