"""Cleans live motion frame by frame, with a fixed delay."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import Take
from ._files import _GivenTake, taken
from ._tables import Cleaner, _GivenOption


@dataclass(frozen=True, repr=False)
class LiveFrame:
    """One cleaned frame.

    Attributes
    ----------
    rotations : array of shape (J, 4)
        Unit quaternions w, x, y, z, relative to the rest rotation; (0, 4) for markers.
    positions : array of shape (P, 3)
        As `Take.positions` of one frame.
    observed : array of bool of shape (J,) or (P,)
        As it came in.
    """

    rotations: npt.NDArray[np.float64]
    positions: npt.NDArray[np.float64]
    observed: npt.NDArray[np.bool_]

    def __repr__(self) -> str:
        shapes = f"rotations {self.rotations.shape}, positions {self.positions.shape}"
        return f"<kinemend.LiveFrame: {shapes}, {self.observed.sum()} of {self.observed.size} observed>"


class LiveFilter:
    """Cleans one stream: frame t goes in, frame t - `latency_frames` comes out.

    The result equals that of cleaning the whole take. Threads may use several filters at once.

    Parameters
    ----------
    like : Take or path
        A take with the skeleton or markers and the frame rate of the stream. Its frames are ignored.
    method : str or Cleaner, default "median"
        A method that runs live: `methods()` says which do.
    body_height : float, default 0
        Of markers: the height of the person in the unit of the take; 0: a usual one.
    source : {"optical", "suit", "video", "depth", "keyframed", "unknown"}
        What records the frames, for the method `learned`, as in `clean`. Unknown: what the file of
        `like` says.
    options : mapping, optional
        Options of the method.
    **more
        The same as keywords.

    Raises
    ------
    Error
        The method needs the whole take, or does not work at this frame rate.

    Examples
    --------
    >>> take = kinemend.read("walk.bvh")
    >>> live = kinemend.LiveFilter(take, "one-euro", min_cutoff_hz=2)
    >>> live.latency_frames
    0
    >>> frame = live.push(take.rotations[0], take.positions[0])
    >>> frame.rotations.shape
    (31, 4)
    """

    def __init__(
        self,
        like: _GivenTake,
        method: str | Cleaner = "median",
        *,
        body_height: float = 0.0,
        source: Literal["optical", "suit", "video", "depth", "keyframed", "unknown"] = "unknown",
        options: Mapping[str, _GivenOption] | None = None,
        **more: _GivenOption,
    ) -> None:
        self.cleaner = method if isinstance(method, Cleaner) else Cleaner(method, options, **more)
        self._stream = _core.CoreStream(self.cleaner._core, taken(like), body_height, source)

    def __repr__(self) -> str:
        return f"<kinemend.LiveFilter {self.latency_frames} frames behind: {self.cleaner!r}>"

    @property
    def latency_frames(self) -> int:
        """Frames that go in before the first one comes out; constant."""
        return self._stream.latency_frames

    def push(
        self,
        rotations: npt.ArrayLike | None,
        positions: npt.ArrayLike,
        observed: npt.ArrayLike | None = None,
    ) -> LiveFrame | None:
        """Take a frame; return the next cleaned one, or None while the filter waits for more.

        Parameters
        ----------
        rotations : array of shape (J, 4)
            Unit quaternions; None for markers.
        positions : array of shape (P, 3)
            Of the joints that have some, or of the markers.
        observed : array of bool of shape (J,) or (P,), optional
            True where a joint or marker was measured. Default: all were.

        Raises
        ------
        ValueError
            An array has another shape. Values never cause an error.
        """
        frame = self._stream.push(rotations, positions, observed)
        return None if frame is None else LiveFrame(*frame)

    def flush(self) -> Iterator[LiveFrame]:
        """The remaining frames, after the last one went in."""
        while (frame := self._stream.flush()) is not None:
            yield LiveFrame(*frame)

    def reset(self) -> None:
        """Back to the state before the first frame."""
        self._stream.reset()
