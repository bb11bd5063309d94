"""Clean frames as they arrive; here they come from a file, in a program from a capture system.

    python live_frames.py TAKE
"""

import sys

import numpy as np

import kinemend

take = kinemend.read(sys.argv[1])
live = kinemend.LiveFilter(take, "one-euro")
print(f"delay: {live.latency_frames} frames, {1000 * live.latency_frames / take.fps:.0f} ms")

cleaned = []
for rotations, positions in zip(take.rotations, take.positions):
    if (frame := live.push(rotations, positions)) is not None:
        cleaned.append(frame.rotations)
cleaned.extend(frame.rotations for frame in live.flush())

steps = [np.abs(np.diff(frames, n=2, axis=0)).mean() for frames in (take.rotations, np.array(cleaned))]
print(f"{len(cleaned)} frames, jitter {steps[1] / steps[0]:.0%} of what came in")
