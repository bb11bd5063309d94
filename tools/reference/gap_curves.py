"""Writes tests/fixtures/fill/curves.csv: the numbers of SciPy that the curves through a gap must reproduce.

Run from the repository's root: python3 tools/reference/gap_curves.py
One record a line: name, then its values.
"""

import numpy as np
import scipy.interpolate

records = []


def record(name, values):
    records.append(name + "," + ",".join(repr(float(v)) for v in np.ravel(values)))


random = np.random.default_rng(5)
t = np.arange(160)
clean = 1.5 * np.sin(0.09 * t) + 0.02 * t + 0.3 * np.cos(0.31 * t)
noisy = np.round(clean + 0.05 * random.standard_normal(len(t)), 6)
missing = np.zeros(len(t), bool)
missing[70:95] = True
missing[[66, 99, 120]] = True
missing[130:133] = True
kept = np.flatnonzero(~missing)
gap = np.arange(70, 95)
record("input", noisy)
record("missing", missing)
record("cubic", scipy.interpolate.CubicSpline(kept, noisy[kept], bc_type="natural")(gap))
natural = ([(3, 0.0), (4, 0.0)], [(3, 0.0), (4, 0.0)])
record("quintic", scipy.interpolate.make_interp_spline(kept, noisy[kept], k=5, bc_type=natural)(gap))
pchip = scipy.interpolate.PchipInterpolator(kept, noisy[kept])
record("pchip", pchip(gap))
record("pchip_all", pchip(t))
# Ends: the curve through the first (last) two samples and the next one.
record("pchip_ends", scipy.interpolate.PchipInterpolator([0, 9, 10], [1.0, 4.0, 4.5])(np.arange(1, 9)))
record("pchip_ends_turning", scipy.interpolate.PchipInterpolator([0, 9, 10], [1.0, 4.0, 1.0])(np.arange(1, 9)))

for smoothing in [0.5, 30.0, 5000.0]:
    spline = scipy.interpolate.make_smoothing_spline(kept.astype(float), noisy[kept], lam=smoothing)
    record(f"smoothing_cubic/{smoothing}", np.concatenate([spline(kept), spline(gap)]))


def smoothing_quintic(x, y, smoothing):
    """Quintic B-splines with a knot at every sample, penalised by the integral of f'''^2, dense; and the trace of H."""
    knots = np.concatenate([[x[0]] * 5, x, [x[-1]] * 5]).astype(float)
    basis = scipy.interpolate.BSpline(knots, np.eye(len(knots) - 6), 5)
    third = basis.derivative(3)
    nodes, weights = np.polynomial.legendre.leggauss(3)
    penalty = 0
    for a, b in zip(x[:-1], x[1:]):
        for node, weight in zip(nodes, weights):
            row = third((a + b) / 2 + node * (b - a) / 2)
            penalty = penalty + weight * (b - a) / 2 * np.outer(row, row)
    design = basis(x)
    inverse = np.linalg.solve(design.T @ design + smoothing * penalty, design.T)
    return scipy.interpolate.BSpline(knots, inverse @ y, 5), np.trace(design @ inverse)


x, y = kept.astype(float), noisy[kept]
for smoothing in [0.5, 30.0, 5000.0]:
    spline, trace = smoothing_quintic(x, y, smoothing)
    score = np.mean((y - spline(x)) ** 2) / (1 - trace / len(x)) ** 2
    record(f"smoothing_quintic/{smoothing}", np.concatenate([spline(x), spline(gap)]))
    record(f"cross_validation/{smoothing}", [score])

with open("tests/fixtures/fill/curves.csv", "w") as file:
    file.write("\n".join(records) + "\n")
