#!/usr/bin/env python3
"""Draws dean_psnr.csv. Usage: plot_dean.py FOLDER (where the CSV files are and the pictures go)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])
with open(folder / "dean_psnr.csv", newline="") as file:
    header, *rows = csv.reader(file)

figure, axes = plt.subplots(figsize=(9, 5))
for name, *values in rows:
    style = "--" if name == "(noisy)" else "-"
    axes.plot(header[1:], [float(v) for v in values], style, marker="o", label=name)
axes.set_ylabel("PSNR, dB (peak pi / 2)")
axes.set_title("Dean 2016, table I")
axes.grid(alpha=0.3)
axes.legend(fontsize=8)
figure.tight_layout()
figure.savefig(folder / "dean_psnr.png", dpi=120)
print("wrote", folder / "dean_psnr.png")


def curves(name):
    """Values by noise, version and channel."""
    result = {}
    with open(folder / name, newline="") as file:
        for row in csv.DictReader(file):
            key = row["noise"], row["version"], row.get("channel", "")
            result.setdefault(key, []).append(float(row["value"]))
    return result


def save(figure, name):
    figure.tight_layout()
    figure.savefig(folder / name, dpi=120)
    print("wrote", folder / name)


channels = curves("dean_channels.csv")
versions = ["truth", "noisy", "NLPM (best bandwidth)"]
noises = list(dict.fromkeys(noise for noise, _, _ in channels))
figure, panels = plt.subplots(len(noises), 3, figsize=(12, 3 * len(noises)), sharex=True, sharey=True)
for row, noise in zip(panels, noises):
    for panel, version in zip(row, versions):
        for (of, what, _), values in channels.items():
            if (of, what) == (noise, version):
                panel.plot(values, linewidth=0.5)
        panel.set_title(f"{version}, {noise}", fontsize=9)
figure.suptitle("Dean 2016, figures 3 and 4: all channels")
save(figure, "dean_channels.png")

single = curves("dean_channel.csv")
noises = list(dict.fromkeys(noise for noise, _, _ in single))
figure, panels = plt.subplots(len(noises), 2, figsize=(14, 3.5 * len(noises)), sharex=True, squeeze=False)
for (noise, version, _), values in single.items():
    left, right = panels[noises.index(noise)]
    if version in versions:
        left.plot(values, label=version, linewidth=1)
    if version != "noisy":
        right.plot(values, label=version, linewidth=2 if version == "truth" else 0.8)
for noise, (left, right) in zip(noises, panels):
    left.set_title(f"Dean 2016, figure 5: one channel of a knee, {noise}", fontsize=9)
    right.set_title(f"figure 6: every method of table I, {noise}", fontsize=9)
    # Noise would hide the remaining errors of the methods.
    truth = single[noise, "truth", ""]
    margin = 0.5 * (max(truth) - min(truth))
    right.set_ylim(min(truth) - margin, max(truth) + margin)
    for panel in (left, right):
        panel.grid(alpha=0.3)
panels[0][0].legend(fontsize=7)
panels[0][1].legend(fontsize=6)
save(figure, "dean_channel.png")
