# SPDX-License-Identifier: Apache-2.0
"""F-curves as NumPy arrays. Works on anything with the members of Blender's F-curves."""

import numpy as np


class BoneCurves:
    """The curves of one property of a bone, by component; None where a component has no curve.

    times, values: of each curve's keys. `still`: the values of components without curves.
    """

    def __init__(self, path, still):
        self.path = path
        self.still = np.asarray(still, float)
        self.curves = [None] * len(still)
        self.times = [np.empty(0)] * len(still)
        self.values = [np.empty(0)] * len(still)

    def add(self, curve):
        if not 0 <= curve.array_index < len(self.curves):
            return
        keys = np.empty(2 * len(curve.keyframe_points), np.float32)
        curve.keyframe_points.foreach_get("co", keys)
        self.curves[curve.array_index] = curve
        self.times[curve.array_index] = keys[0::2].astype(float)
        self.values[curve.array_index] = keys[1::2].astype(float)

    def key_times(self):
        return np.unique(np.concatenate(self.times))

    def key_range(self):
        """Where all curves have keys at both sides; a curve of one key is a constant. None where no curve has two."""
        spans = [(times[0], times[-1]) for times in self.times if times.size > 1]
        return (max(s[0] for s in spans), min(s[1] for s in spans)) if spans else None

    def varies(self, least=1e-7):
        return any(np.ptp(values) > least for values in self.values if values.size > 1)

    def at(self, times):
        """The values (N, components): those of keys, and in between what Blender's own curve says."""
        result = np.empty((len(times), len(self.still)))
        for c, curve in enumerate(self.curves):
            if curve is None or not self.times[c].size:
                result[:, c] = self.still[c]
                continue
            place = np.searchsorted(self.times[c], times - 1e-3).clip(max=self.times[c].size - 1)
            is_key = np.abs(self.times[c][place] - times) < 1e-3
            result[:, c] = np.where(is_key, self.values[c][place], 0)
            for n in np.flatnonzero(~is_key):
                result[n, c] = curve.evaluate(float(times[n]))
        return result


def write_keys(curve, times, values):
    """Sets the values of a curve at these times. Keys are moved with their handles; a missing key is added."""
    count = len(curve.keyframe_points)
    keys = np.empty(2 * count, np.float32)
    curve.keyframe_points.foreach_get("co", keys)
    keys = keys.reshape(count, 2)
    at = np.searchsorted(keys[:, 0], np.asarray(times) - 1e-3)
    is_key = np.zeros(len(times), bool)
    if count:
        is_key = np.abs(keys[at.clip(max=count - 1), 0] - times) < 1e-3
    moved = np.zeros(count, np.float32)
    moved[at[is_key]] = np.asarray(values, np.float32)[is_key] - keys[at[is_key], 1]
    keys[at[is_key], 1] = np.asarray(values, np.float32)[is_key]
    new = np.stack([np.asarray(times)[~is_key], np.asarray(values)[~is_key]], axis=1).astype(np.float32)
    handles = {side: _numbers(curve, side, 2).reshape(count, 2) for side in ("handle_left", "handle_right")}
    if len(new):
        curve.keyframe_points.add(len(new))
        _copy_kind_of_first(curve, count, len(new))
    curve.keyframe_points.foreach_set("co", np.concatenate([keys, new]).ravel())
    for side, points in handles.items():
        points[:, 1] += moved
        curve.keyframe_points.foreach_set(side, np.concatenate([points, new]).ravel())
    curve.update()


def _numbers(curve, name, width, kind=np.float32):
    found = np.empty(width * len(curve.keyframe_points), kind)
    curve.keyframe_points.foreach_get(name, found)
    return found


# New keys interpolate like the curve's first one.
def _copy_kind_of_first(curve, count, added):
    if count == 0:
        return
    for name in ("interpolation", "handle_left_type", "handle_right_type"):
        kinds = _numbers(curve, name, 1, np.int32)
        kinds[count:count + added] = kinds[0]
        curve.keyframe_points.foreach_set(name, kinds)
