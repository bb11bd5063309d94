"""Clean motion that is held in arrays: a tracker's rotations of a two-joint arm.

    python take_from_arrays.py [OUT.bvh]
"""

import sys

import numpy as np

import kinemend

FRAMES, FPS = 240, 120.0
times = np.arange(FRAMES) / FPS
angles = np.radians(40) * np.sin(2 * np.pi * 0.8 * times)

rotations = np.zeros((FRAMES, 2, 4))
rotations[..., 0] = 1
rotations[:, 1, 0] = np.cos(angles / 2)
rotations[:, 1, 3] = np.sin(angles / 2)

clean = kinemend.Take.of_joints(
    names=["Shoulder", "Elbow"],
    parents=[-1, 0],
    offsets=[[0, 140, 0], [30, 0, 0]],
    rotations=rotations,
    fps=FPS,
    metres_per_unit=0.01,
    end_sites=[(1, (25, 0, 0), "")],
)
noisy, _ = kinemend.corrupt(clean, "gaussian", std_deg=1.0, seed=7)
result = kinemend.clean(noisy, "auto")

before = kinemend.compare(clean, noisy).figures.geodesic_rms_deg
after = kinemend.compare(clean, result.take).figures.geodesic_rms_deg
print(f"error {before:.2f} deg before, {after:.2f} deg after")
print("first frame of the elbow:", result.take.rotations[0, 1])
if len(sys.argv) > 1:
    kinemend.write(result.take, sys.argv[1], overwrite=True)
