#!/usr/bin/env python3
"""Draws lou_*.csv. Usage: plot_lou.py FOLDER (where the CSV files are and the pictures go)."""
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


def save(figure, name):
    figure.tight_layout()
    figure.savefig(folder / name, dpi=120)
    print("wrote", folder / name)


def curves(axes, rows, key, x, y):
    groups = {}
    for row in rows:
        groups.setdefault(row[key], []).append(row)
    for name, points in groups.items():
        solid = points[0].get("of_the_paper", "1") == "1"
        axes.plot([float(p[x]) for p in points], [float(p[y]) for p in points], marker=".", label=name,
                  linestyle="-" if solid else "--", linewidth=1.6 if solid else 1)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7)


figure, axes = plt.subplots(figsize=(6, 4))
curves(axes, table("lou_bases.csv"), "walks", "bases", "rms_deg")
axes.set(xlabel="filter bases", ylabel="degrees per joint angle", title="Lou & Chai 2010, figure 3")
save(figure, "lou_bases.png")

figure, panels = plt.subplots(1, 2, figsize=(11, 5))
for panel, name, label in zip(panels, ["lou_noise.csv", "lou_outliers.csv"],
                              ["noise, degrees", "outliers, % of samples"]):
    curves(panel, table(name), "method", "level", "rms_deg")
    panel.set(xlabel=label, ylabel="degrees per joint angle")
figure.suptitle("Lou & Chai 2010, figure 7 (solid: the paper's four)")
save(figure, "lou_comparison.png")

rows = [row for row in table("lou_windows.csv") if row["window_frames"].isdigit()]
figure, panels = plt.subplots(1, 2, figsize=(9, 4))
for panel, column, title in zip(panels, ["denoising_rms_deg", "filling_rms_deg"],
                                ["a walk, sigma = 3", "a limb missing in a jump"]):
    for prefix, label in (("", "example"), ("papers_", "example, solver=paper")):
        panel.plot([int(r["window_frames"]) for r in rows], [float(r[prefix + column]) for r in rows], marker=".", label=label)
    panel.legend(fontsize=6)
    panel.set(xlabel="window, frames at 30 Hz", ylabel="degrees per joint angle", title=title, ylim=(0, None))
    panel.grid(alpha=0.3)
figure.suptitle("Lou & Chai 2010, figure 9")
save(figure, "lou_windows.png")

shown = {}
for row in table("lou_curves.csv"):
    panel = shown.setdefault((row["figure"], row["joint"]), {})
    panel.setdefault(row["version"], []).append(float(row["angle_deg"]))
figure, panels = plt.subplots(len(shown), 1, figsize=(9, 3.5 * len(shown)))
for axes, ((number, joint), versions) in zip(panels, shown.items()):
    for name, values in versions.items():
        quiet = name.startswith("training") or name == "noisy"
        axes.plot(values, label=name, linewidth=0.6 if quiet else 1.4)
    axes.set(title=f"figure {number}, {joint}" + (" (and figure 1)" if number == "4" else ""), xlabel="frame", ylabel="degrees")
    axes.legend(fontsize=6)
    axes.grid(alpha=0.3)
figure.suptitle("Lou & Chai 2010, figures 1, 4 and 8")
save(figure, "lou_curves.png")
