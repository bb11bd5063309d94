#!/usr/bin/env python3
"""Draws system_spectra.csv. Usage: plot_system_noise.py FOLDER (where the CSV file is and the pictures go); nothing without real pairs."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])
source = folder / "system_spectra.csv"
if not source.is_file():
    sys.exit(0)
curves = {}
with open(source, newline="") as file:
    for row in csv.DictReader(file):
        curve = curves.setdefault(row["noise"], {}).setdefault(row["source"], ([], []))
        curve[0].append(float(row["frequency_hz"]))
        curve[1].append(float(row["density"]))

matplotlib.rcParams.update({"svg.hashsalt": "kinemend", "svg.fonttype": "none"})
figure, panels = plt.subplots(2, 4, figsize=(13, 6))
for panel, (noise, by_source) in zip(panels.flat, curves.items()):
    for name, (frequencies, densities) in by_source.items():
        panel.loglog(frequencies, densities, "-" if name == "real" else "--", linewidth=1.4, label=name)
    panel.set_title(noise, fontsize=9)
    panel.set_xlabel("Hz", fontsize=8)
    panel.set_ylabel("deg$^2$/Hz" if "angles" in noise else "mm$^2$/Hz", fontsize=8)
    panel.tick_params(labelsize=7)
    panel.grid(alpha=0.3)
    panel.legend(fontsize=7)
for panel in panels.flat[len(curves):]:
    panel.axis("off")
figure.tight_layout()
for kind in ("png", "svg"):
    path = folder / f"system_noise.{kind}"
    figure.savefig(path, dpi=120, metadata={"Date": None} if kind == "svg" else None)
    print("wrote", path)
