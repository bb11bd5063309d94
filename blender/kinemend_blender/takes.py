# SPDX-License-Identifier: Apache-2.0
"""Takes as npz files (docs/formats/npz.md), in memory. Knows nothing of Blender."""

import io

import numpy as np

LAYOUT = "kinemend-1"


def to_npz(take):
    """The bytes of a take, a dictionary of arrays by the names of the layout."""
    file = io.BytesIO()
    np.savez(file, format=LAYOUT, **take)
    return file.getvalue()


def from_npz(data):
    """The arrays of a take."""
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def frame_grid(times, tolerance=0.01):
    """The frames on which keys lie: first, step and count, from the times of all keys (frames, any order).

    The step is that of most neighbouring keys where nearly all keys lie on its grid, as for a take of 120 Hz in a scene of
    24 frames/s (0.2); else 1. `tolerance` is in frames.
    """
    times = np.unique(np.round(np.asarray(times, float), 3))
    if times.size < 2:
        return (float(times[0]) if times.size else 0.0), 1.0, int(times.size)
    usual = float(np.median(np.diff(times)))
    step = 1.0
    for candidate in dict.fromkeys((usual, (times[-1] - times[0]) / max(round((times[-1] - times[0]) / usual), 1))):
        off = np.abs((times - times[0]) / candidate - np.round((times - times[0]) / candidate)) * candidate
        if candidate > 0.001 and np.mean(off < tolerance) > 0.99:
            step = candidate
    return float(times[0]), step, int(round((times[-1] - times[0]) / step)) + 1


def usual_rate(frames_per_second):
    """The whole number next to a rate that a rounded frame time gave: 120 for 1 / 0.008333. 23.976 stays."""
    whole = round(frames_per_second)
    return float(whole) if abs(frames_per_second - whole) < 1e-4 * frames_per_second else float(frames_per_second)


def places_on_grid(times, first, step, count, tolerance=0.01):
    """The index in the grid of each time; -1 for a time that lies between frames or outside."""
    index = (np.asarray(times, float) - first) / step
    nearest = np.round(index)
    off = (np.abs(index - nearest) * step > tolerance) | (nearest < 0) | (nearest >= count)
    return np.where(off, -1, nearest).astype(int)
