#!/usr/bin/env python3
"""Draws courty_*.csv. Usage: plot_courty.py FOLDER (where the CSV files are and the pictures go)."""
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


figure, axes = plt.subplots(figsize=(7, 4.5))
curves = {}
for row in table("courty_mse.csv"):
    curves.setdefault(row["sigma_g"], []).append((int(row["passes"]), float(row["mse_rad2"])))
for sigma, points in curves.items():
    axes.plot(*zip(*points), marker=".", label=f"sigma_g = {sigma}" + (" (Gaussian)" if float(sigma) > 5 else ""))
axes.set(xlabel="passes", ylabel="MSE, rad^2", yscale="log", title="Courty 2008, figure 3")
axes.grid(alpha=0.3)
axes.legend(fontsize=8)
save(figure, "courty_mse.png")

rows = table("courty_velocity.csv")
names = [n for n in rows[0] if n != "frame"]
figure, panels = plt.subplots(len(names), 1, figsize=(8, 8), sharex=True)
for panel, name in zip(panels, names):
    panel.plot([float(r[name]) for r in rows], linewidth=1)
    if name != "truth":
        panel.plot([float(r["truth"]) for r in rows], linewidth=0.8, color="grey")
    panel.set_title(name, fontsize=9)
    panel.set_ylabel("rad/s")
panels[-1].set_xlabel("frame")
figure.suptitle("Courty 2008, figure 2: velocity of one joint (grey: truth)")
save(figure, "courty_velocity.png")

paths = {}
for row in table("courty_path.csv"):
    paths.setdefault(row["version"], []).append([float(row[c]) for c in "xyz"])
figure = plt.figure(figsize=(9, 8))
limits = [(min(p[c] for p in paths["noisy"]), max(p[c] for p in paths["noisy"])) for c in range(3)]
for index, (name, points) in enumerate(paths.items(), 1):
    panel = figure.add_subplot(2, 2, index, projection="3d")
    x, y, z = zip(*points)
    panel.plot(x, z, y, linewidth=0.8)  # y is up
    panel.set(title=name, xlim=limits[0], ylim=limits[2], zlim=limits[1])
figure.suptitle("Courty 2008, figure 4: path of a hand")
save(figure, "courty_path.png")
