#!/usr/bin/env python3
"""Draws xiao_*.csv: error against noise, error of each frame, and error against M, K and lambda. Usage: plot_xiao.py FOLDER (CSV files, pictures)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])
MOTIONS = [motion for motion in ("run", "dance", "basketball") if (folder / f"xiao_{motion}.csv").exists()]
FIGURES = {6: ["40 dB", "30 dB", "20 dB", "10 dB"], 7: ["10 %", "15 %", "20 %", "25 %"]}


def table(name):
    with open(folder / name, newline="") as file:
        return list(csv.DictReader(file))


def names(rows, column):
    return list(dict.fromkeys(row[column] for row in rows))


def save(figure, title, name):
    figure.suptitle(title)
    figure.tight_layout()
    figure.savefig(folder / name, dpi=120)
    plt.close(figure)
    print("wrote", folder / name)


def draw_noise():
    figure, axes = plt.subplots(1, len(MOTIONS), figsize=(6 * len(MOTIONS), 5), squeeze=False)
    for axis, motion in zip(axes[0], MOTIONS):
        rows = table(f"xiao_{motion}.csv")
        for method in names(rows, "method"):
            own = [row for row in rows if row["method"] == method]
            axis.errorbar([row["noise"] for row in own], [float(row["own_mean_cm"]) for row in own],
                          yerr=[float(row["own_deviation_cm"]) for row in own], marker="o", capsize=2, label=method,
                          linestyle="--" if method == "(noisy)" else "-")
        axis.set(title=motion, ylabel="RMSE, cm per noisy marker", yscale="log")
        axis.grid(alpha=0.3)
    axes[0][0].legend(fontsize=8)
    save(figure, "Xiao et al. 2015, means of figures 6 and 7 and table 1", "xiao_noise.png")


def draw_curves(number):
    rows = table("xiao_curves.csv")
    noises, methods = FIGURES[number], [method for method in names(rows, "method") if method != "(noisy)"]
    figure, axes = plt.subplots(len(MOTIONS), len(noises), figsize=(5 * len(noises), 3 * len(MOTIONS)), squeeze=False)
    for line, motion in zip(axes, MOTIONS):
        for axis, noise in zip(line, noises):
            for method in methods:
                own = [row for row in rows if (row["motion"], row["noise"], row["method"]) == (motion, noise, method)]
                axis.plot([int(row["frame"]) for row in own], [float(row["rmse_cm"]) for row in own], linewidth=0.8, label=method)
            axis.set(title=f"{motion}, {noise}", yscale="log")
            axis.grid(alpha=0.3)
        line[0].set_ylabel("RMSE, cm")
    axes[0][0].legend(fontsize=7)
    save(figure, f"Xiao et al. 2015, figure {number}: error of each frame", f"xiao_figure{number}.png")


def draw_sizes():
    rows = table("xiao_sizes.csv")
    figure, axes = plt.subplots(1, 3, figsize=(12, 4))
    for axis, what in zip(axes, ("M", "K", "lambda")):
        for motion in names(rows, "motion"):
            own = [row for row in rows if (row["what"], row["motion"]) == (what, motion)]
            axis.plot([row["value"] for row in own], [float(row["mean_cm"]) for row in own], marker="o", label=motion)
        axis.set(xlabel=what, ylabel="RMSE, cm per marker")
        axis.grid(alpha=0.3)
    axes[0].legend()
    save(figure, "Xiao et al. 2015, figure 10", "xiao_sizes.png")


draw_noise()
if (folder / "xiao_curves.csv").exists():
    for number in FIGURES:
        draw_curves(number)
if (folder / "xiao_sizes.csv").exists():
    draw_sizes()
