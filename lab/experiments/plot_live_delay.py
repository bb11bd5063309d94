#!/usr/bin/env python3
"""Draws page_live_delay.csv: error against delay, a curve for each method.

Usage: plot_live_delay.py FOLDER [PICTURE]    the picture is FOLDER/live_delay.svg unless named
"""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# A fixed salt, so that the same figures always give the same file.
matplotlib.rcParams["svg.hashsalt"] = "kinemend"
folder = pathlib.Path(sys.argv[1])
picture = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else folder / "live_delay.svg"
curves = {}
with open(folder / "page_live_delay.csv", newline="") as file:
    for row in csv.DictReader(file):
        curves.setdefault(row["method"], []).append(row)

figure, panels = plt.subplots(1, 2, figsize=(11, 4.5), sharey=True)
for panel, column, title in zip(panels, ("white", "spikes"), ("white noise", "white noise with spikes")):
    for method, rows in curves.items():
        points = sorted((float(row["delay_ms"]), float(row[column])) for row in rows)
        style = "-" if len({delay for delay, _ in points}) > 1 else "none"
        panel.plot(*zip(*points), linestyle=style, marker="o", label=method)
    panel.set_title(title)
    panel.set_xlabel("delay, ms at 120 Hz")
    panel.set_ylim(0, 2)
    panel.grid(alpha=0.3)
panels[0].set_ylabel("error left, share of that of the input")
panels[1].legend(fontsize=8)
figure.tight_layout()
figure.savefig(picture, metadata={"Date": None})
print("wrote", picture)
