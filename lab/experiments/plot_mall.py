#!/usr/bin/env python3
"""Draws mall_*.csv. Usage: plot_mall.py FOLDER (where the CSV files are and the pictures go)."""
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

folder = pathlib.Path(sys.argv[1])


def table(name):
    path = folder / name
    if not path.is_file():
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def save(figure, name):
    figure.tight_layout()
    figure.savefig(folder / name, dpi=120)
    print("wrote", folder / name)


def grouped(rows, *keys):
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def panels_of(count, columns, width, height):
    rows = max(1, -(-count // columns))
    figure, axes = plt.subplots(rows, columns, figsize=(width * columns, height * rows), squeeze=False)
    flat = [panel for row in axes for panel in row]
    for panel in flat[count:]:
        panel.axis("off")
    return figure, flat


def errors_over_time():
    takes = grouped(table("mall_curves.csv"), "take", "action")
    if not takes:
        return
    figure, panels = panels_of(len(takes), 2, 6, 2.6)
    for panel, ((take, action), rows) in zip(panels, takes.items()):
        for (method,), points in grouped(rows, "method").items():
            panel.plot([float(p["time_s"]) for p in points], [float(p["rms_deg"]) for p in points], label=method,
                       linewidth=1.8 if method == "ebf" else 1)
        panel.set(title=f"{take}, {action}", xlabel="s", ylabel="degrees", ylim=(0, None))
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=6)
    figure.suptitle("Mall et al. 2017, figure 4")
    save(figure, "mall_curves.png")


def free_shapes():
    takes = grouped(table("mall_kernels.csv"), "take", "action")
    if not takes:
        return
    figure, panels = panels_of(len(takes), 3, 4, 3)
    for panel, ((take, action), rows) in zip(panels, takes.items()):
        for points in grouped(rows, "time_s").values():
            panel.plot([float(p["offset_ms"]) for p in points], [float(p["weight"]) for p in points], linewidth=0.7)
        panel.set(title=f"{take}, {action}", xlabel="ms", ylabel="weight")
        panel.grid(alpha=0.3)
    figure.suptitle("Mall et al. 2017, figure 3")
    save(figure, "mall_kernels.png")


def gap_curves():
    takes = grouped(table("mall_gap_curves.csv"), "take", "joint")
    if not takes:
        return
    figure, panels = panels_of(len(takes), 1, 9, 3)
    for panel, ((take, joint), rows) in zip(panels, takes.items()):
        for (version,), points in grouped(rows, "version").items():
            panel.plot([float(p["time_s"]) for p in points], [float(p["angle_deg"]) for p in points], label=version,
                       linewidth=2 if version == "truth" else 1.2)
        missing = [float(row["time_s"]) for row in rows if row["is_missing"] == "1"]
        panel.axvspan(min(missing), max(missing), alpha=0.1)
        panel.set(title=f"{take}, {joint}", xlabel="s", ylabel="degrees about x")
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    figure.suptitle("Mall et al. 2017, figure 10")
    save(figure, "mall_gap_curves.png")


def amplitudes():
    rows = [row for row in table("mall_ebf.csv") if row["group"] == "plain"]
    if not rows:
        return
    shown = ["gaussian 58 ms", "best constant gaussian", "ebf", "bf", "nn", "ebf-spatial", "wiener"]
    figure, panels = plt.subplots(1, 2, figsize=(11, 4))
    for panel, kind in zip(panels, ["angular", "spatial"]):
        noises = list(dict.fromkeys(row["noise"] for row in rows if row["noise"].startswith(kind)))
        for method in shown:
            found = {row["noise"]: float(row["rms_deg"]) for row in rows if row["method"] == method}
            panel.plot([noise for noise in noises if noise in found], [found[noise] for noise in noises if noise in found],
                       marker=".", label=method)
        panel.set(title=f"{kind} noise", ylabel="degrees", ylim=(0, None))
        panel.tick_params(axis="x", labelsize=7, rotation=20)
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    figure.suptitle("Mall et al. 2017, figure 6")
    save(figure, "mall_ebf.png")


errors_over_time()
free_shapes()
gap_curves()
amplitudes()
