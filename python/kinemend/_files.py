"""Reads and writes takes of every format."""

from __future__ import annotations

import os
from collections.abc import Callable

from . import _core
from ._core import Take
from .reports import Diagnostic

_Path = str | os.PathLike[str]
# Functions that need a take also accept the path of its file.
_GivenTake = Take | str | os.PathLike[str]


def taken(take: _GivenTake) -> Take:
    """The take, read first where a path was given."""
    return take if isinstance(take, Take) else read(take)


def read(
    source: _Path | bytes,
    *,
    name: str = "",
    format: str = "",
    strict: bool = False,
    skeleton: _Path = "",
    fps: float = 0.0,
    animation: str = "",
    progress: Callable[[str, float], object] | None = None,
) -> Take:
    """Read a take from a file, or from the bytes of one.

    Parameters
    ----------
    source : path or bytes
        The content decides the format.
    name : str, optional
        Of bytes, for messages: "walk.bvh".
    format : str, optional
        "bvh", if the content does not show it.
    strict : bool, default False
        Repairs of odd but usable input are errors. Without it `diagnostics` lists them.
    skeleton : path, optional
        The ASF file of an AMC file.
    fps : float, default 0
        Frame rate of a file that does not state it (0.1 to 100,000); 0: the usual one.
    animation : str, optional
        Which take of a file that holds several. Default: the active one.
    progress : callable, optional
        Called as `progress("reading", done)` with `done` from 0 to 1, of large files.

    Returns
    -------
    Take

    Raises
    ------
    Error
        The file cannot be read; `line` or `byte` says where. A missing file is also a
        `FileNotFoundError`, and one that may not be read a `PermissionError`.

    Examples
    --------
    >>> kinemend.read("walk.bvh")
    <kinemend.Take walk.bvh: 960 frames of 31 joints at 120 Hz>
    """
    if isinstance(source, bytes):
        return _core.read_bytes(source, name, format, strict, skeleton, fps, animation, progress)
    return _core.read_path(source, format, strict, skeleton, fps, animation, progress)


def write(take: Take, path: _Path, *, format: str = "", overwrite: bool = False) -> None:
    """Write a take, in the layout and with the digits of the file that it came from.

    Parameters
    ----------
    take : Take
        The take.
    path : path
        Its ending is the format; without one the take keeps its own. The file is complete or not
        there at all. A skeleton or buffer that the format keeps beside it is written, too.
    format : str, optional
        "bvh", in place of the ending.
    overwrite : bool, default False
        Overwrite a file that exists.

    Raises
    ------
    Error
        The file exists (also a `FileExistsError`), cannot be written, or its format cannot hold the
        take.
    """
    _core.write_path(take, path, format, overwrite)


def to_bytes(take: Take, format: str = "") -> bytes:
    """The bytes of the file that `write` would write.

    Examples
    --------
    >>> take = kinemend.read("walk.bvh")
    >>> kinemend.to_bytes(take) == open("walk.bvh", "rb").read()
    True
    """
    return _core.to_bytes(take, format)


def diagnostics(take: Take) -> list[Diagnostic]:
    """What the reader of the take repaired, in order of first occurrence.

    Examples
    --------
    >>> kinemend.diagnostics(kinemend.read("walk.bvh"))
    []
    """
    return _diagnostics(take._diagnostics, take.format)


def losses(take: Take, format: str) -> list[Diagnostic]:
    """What is lost when the take is written in `format`; empty where nothing is.
    """
    return _diagnostics(_core.losses(take, format), format)


def _diagnostics(entries: list[tuple[str, str, int, int]], format: str) -> list[Diagnostic]:
    place = "first_byte" if format == "c3d" else "first_line"
    return [
        Diagnostic.from_dict({"name": name, "message": message, place: first, "count": count})
        for name, message, first, count in entries
    ]
