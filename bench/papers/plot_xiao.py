#!/usr/bin/env python3
"""Draws xiao_noise.csv: error against noise, one picture an action. Usage: plot_xiao.py FOLDER (CSV files, pictures)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])
with open(folder / "xiao_noise.csv", newline="") as file:
    rows = list(csv.DictReader(file))

motions = list(dict.fromkeys(row["motion"] for row in rows))
figure, axes = plt.subplots(1, len(motions), figsize=(6 * len(motions), 5), squeeze=False)
for axis, motion in zip(axes[0], motions):
    methods = dict.fromkeys(row["method"] for row in rows if row["motion"] == motion)
    for method in methods:
        own = [row for row in rows if row["motion"] == motion and row["method"] == method]
        axis.errorbar([row["noise"] for row in own], [100 * float(row["mean_m"]) for row in own],
                      yerr=[100 * float(row["deviation_m"]) for row in own], marker="o", capsize=2, label=method,
                      linestyle="--" if method == "(noisy)" else "-")
    axis.set_yscale("log")
    axis.set_title(motion)
    axis.set_ylabel("RMSE, cm per marker")
    axis.grid(alpha=0.3)
axes[0][0].legend(fontsize=8)
figure.suptitle("Xiao et al. 2015, figures 6 and 7 and table 1")
figure.tight_layout()
figure.savefig(folder / "xiao_noise.png", dpi=120)
print("wrote", folder / "xiao_noise.png")
