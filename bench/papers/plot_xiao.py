#!/usr/bin/env python3
"""Draws xiao_*.csv: error against noise, one picture an action, and against M, K and lambda. Usage: plot_xiao.py FOLDER (CSV files, pictures)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])


def table(name):
    with open(folder / name, newline="") as file:
        return list(csv.DictReader(file))


motions = [motion for motion in ("run", "dance", "basketball") if (folder / f"xiao_{motion}.csv").exists()]
figure, axes = plt.subplots(1, len(motions), figsize=(6 * len(motions), 5), squeeze=False)
for axis, motion in zip(axes[0], motions):
    rows = table(f"xiao_{motion}.csv")
    for method in dict.fromkeys(row["method"] for row in rows):
        own = [row for row in rows if row["method"] == method]
        axis.errorbar([row["noise"] for row in own], [float(row["mean_cm"]) for row in own],
                      yerr=[float(row["deviation_cm"]) for row in own], marker="o", capsize=2, label=method,
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

if (folder / "xiao_sizes.csv").exists():
    rows = table("xiao_sizes.csv")
    figure, axes = plt.subplots(1, 3, figsize=(12, 4))
    for axis, what in zip(axes, ("M", "K", "lambda")):
        own = [row for row in rows if row["what"] == what]
        axis.plot([row["value"] for row in own], [float(row["mean_cm"]) for row in own], marker="o")
        axis.set(xlabel=what, ylabel="RMSE, cm per marker")
        axis.grid(alpha=0.3)
    figure.suptitle("Xiao et al. 2015, figure 10")
    figure.tight_layout()
    figure.savefig(folder / "xiao_sizes.png", dpi=120)
    print("wrote", folder / "xiao_sizes.png")
