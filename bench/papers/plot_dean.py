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
