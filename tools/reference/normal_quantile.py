#!/usr/bin/env python3
"""Quantiles of the standard normal distribution by SciPy.

Writes tests/fixtures/base/normal_quantile.csv: p, quantile.
"""
import pathlib

import numpy as np
from scipy.special import ndtri


def main():
    target = pathlib.Path(__file__).resolve().parents[2] / "tests/fixtures/base/normal_quantile.csv"
    target.parent.mkdir(parents=True, exist_ok=True)
    tails = [10.0**-e for e in (300, 200, 100, 50, 20, 16, 12, 9, 6, 5, 4, 3)]
    middle = list(np.linspace(0.01, 0.99, 99))
    edges = [0.075, np.nextafter(0.075, 0), np.nextafter(0.075, 1), 0.925, np.nextafter(0.925, 1), np.exp(-25.0)]
    upper = [1 - 10.0**-e for e in (3, 6, 9, 12, 15)]
    lines = ["# p,quantile"]
    lines += [f"{float(p)!r},{float(ndtri(p))!r}" for p in sorted(tails + middle + edges + upper)]
    target.write_text("\n".join(lines) + "\n")


main()
