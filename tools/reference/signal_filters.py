"""Writes tests/fixtures/signal/filters.csv: the numbers of NumPy and SciPy that the filters must reproduce.

Run from the repository's root: python3 tools/reference/signal_filters.py
One record a line: name, then its values. A record called input/... is what the others of that name were made from.
"""

import numpy as np
import scipy.interpolate
import scipy.ndimage
import scipy.signal

RATE_HZ = 120.0
records = []


def record(name, values):
    records.append(name + "," + ",".join(repr(float(v)) for v in np.ravel(values)))


def take(frames, seed):
    random = np.random.default_rng(seed)
    t = np.arange(frames)
    x = 1.5 * np.sin(0.11 * t + seed) + 0.02 * t + 0.1 * random.standard_normal(frames)
    return np.round(x, 6)


long_take = take(150, 1)
record("input/long", long_take)

for order, cutoff_hz in [(1, 6), (2, 6), (3, 10), (4, 6), (5, 20), (7, 12), (8, 30), (12, 15)]:
    sos = scipy.signal.butter(order, cutoff_hz, fs=RATE_HZ, output="sos")
    record(f"sosfiltfilt/{order}/{cutoff_hz}", scipy.signal.sosfiltfilt(sos, long_take))

sos = scipy.signal.butter(4, 6, fs=RATE_HZ, output="sos")
for frames in [2, 3, 9, 16]:
    short = take(frames, frames)
    record(f"input/{frames}", short)
    pad = min(15, frames - 1)
    record(f"sosfiltfilt_short/{frames}", scipy.signal.sosfiltfilt(sos, short, padlen=pad))

for sigma in [0.4, 1.5, 3.0, 50.0]:
    radius = int(4 * sigma + 0.5)
    kernel = np.exp(-0.5 * (np.arange(-radius, radius + 1) / sigma) ** 2)
    kernel /= kernel.sum()
    padded = np.pad(long_take, radius, mode="reflect", reflect_type="odd")
    smooth = scipy.ndimage.correlate1d(padded, kernel, mode="constant")
    record(f"gaussian/{sigma}", smooth[radius : radius + len(long_take)])

for half_window in [1, 2, 5]:
    record(f"medfilt/{half_window}", scipy.signal.medfilt(long_take, 2 * half_window + 1))

missing = np.zeros(len(long_take), bool)
missing[[20, 40, 41, 42, 43, 60, 62, 64]] = True
missing[90:120] = True
kept = np.flatnonzero(~missing)
record("missing", missing)
spline = scipy.interpolate.CubicSpline(kept, long_take[kept], bc_type="natural")
record("fill_cubic", spline(np.arange(len(long_take))))
record("fill_linear", np.interp(np.arange(len(long_take)), kept, long_take[kept]))

for moments in range(1, 11):
    record(f"daub/{moments}", scipy.signal.daub(moments))

with open("tests/fixtures/signal/filters.csv", "w", encoding="ascii") as out:
    out.write("\n".join(records) + "\n")
