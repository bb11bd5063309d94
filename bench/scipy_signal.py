"""The jobs of signal_bench.cpp as SciPy and NumPy do them, one thread: 96 channels, 10,000 frames at 120 Hz.

Run with Debian's interpreter: /usr/bin/python3 bench/scipy_signal.py [--quick] [--out FILE]
FILE gets the same as JSON, in the form of Google Benchmark.
"""

import json
import sys
import time

import numpy as np
import scipy.interpolate
import scipy.ndimage
import scipy.signal

FRAMES, CHANNELS = 10000, 96
ROUNDS = 2 if "--quick" in sys.argv else 9

random = np.random.default_rng(1)
phase = 0.03 * np.arange(FRAMES)[:, None] + 0.7 * np.arange(CHANNELS)
take = np.sin(phase) + 0.02 * random.standard_normal((FRAMES, CHANNELS))
missing = random.random((FRAMES, CHANNELS)) < 0.05
sos = scipy.signal.butter(4, 6, fs=120, output="sos")


def reflected(x, radius):
    return np.pad(x, ((radius, radius), (0, 0)), mode="reflect", reflect_type="odd")


def fir(x, kernel):
    radius = len(kernel) // 2
    return scipy.ndimage.correlate1d(reflected(x, radius), kernel, axis=0)[radius:-radius]


def gaussian(x):
    kernel = np.exp(-0.5 * (np.arange(-12, 13) / 3.0) ** 2)
    return fir(x, kernel / kernel.sum())


def weighted_mean(x, passes):
    for _ in range(passes):
        x = fir(x, np.array([2, 3, 2, 3, 2]) / 12)
    return x


def fill_cubic(x):
    result = x.copy()
    for c in range(CHANNELS):
        kept = np.flatnonzero(~missing[:, c])
        gaps = np.flatnonzero(missing[:, c])
        spline = scipy.interpolate.CubicSpline(kept, x[kept, c], bc_type="natural")
        result[gaps, c] = spline(gaps)
    return result


JOBS = [
    ("butterworth_zero_phase_order_4", lambda x: scipy.signal.sosfiltfilt(sos, x, axis=0)),
    ("gaussian_sigma_3", gaussian),
    ("weighted_mean_passes/1", lambda x: weighted_mean(x, 1)),
    ("weighted_mean_passes/4", lambda x: weighted_mean(x, 4)),
    ("median_half_window_5", lambda x: scipy.ndimage.median_filter(x, size=(11, 1))),
    ("fill_cubic_5_percent", fill_cubic),
]

measured = []
print(f"{'Job':<34}{'CPU':>12}{'frames/s':>14}")
for name, job in JOBS:
    best = np.inf
    for _ in range(ROUNDS):
        start = time.process_time()
        job(take)
        best = min(best, time.process_time() - start)
    print(f"{name:<34}{1e3 * best:>9.3g} ms{FRAMES / best / 1e6:>12.4g}M/s")
    measured.append({"name": name, "cpu_time": 1e3 * best, "time_unit": "ms", "frames/s": FRAMES / best})
if "--out" in sys.argv:
    with open(sys.argv[sys.argv.index("--out") + 1], "w") as file:
        json.dump({"benchmarks": measured}, file)
