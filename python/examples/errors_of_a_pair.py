"""Compare a take with a reference: the error figures, and the joints that are worst.

    python errors_of_a_pair.py REFERENCE OTHER
"""

import sys

import kinemend

reference, other = kinemend.read(sys.argv[1]), kinemend.read(sys.argv[2])
report = kinemend.compare(reference, other)

figures = report.figures
print(f"{report.figures.frames_compared} frames")
print(f"rms of joint angles  {figures.rms_deg:.2f} deg")
print(f"rotation, rms        {figures.geodesic_rms_deg:.2f} deg")
if figures.mpjpe_cm is not None:
    print(f"joint positions      {figures.mpjpe_cm:.2f} cm")
for track in sorted(report.tracks, key=lambda t: t.geodesic_rms_deg or 0, reverse=True)[:5]:
    print(f"  {track.name:16} {track.geodesic_rms_deg:.2f} deg")
