"""Codes of windows, as sparse_bench.cpp makes them, by scikit-learn: 800 atoms, windows of 360 values.

Learning a dictionary of this size is left out: scikit-learn takes minutes for it.

Run with Debian's interpreter: /usr/bin/python3 bench/sklearn_sparse.py [--out FILE]
FILE gets the same as JSON, in the form of Google Benchmark.
"""

import json
import sys
import time

import numpy as np
from sklearn.decomposition import sparse_encode

ROWS, DIRECTIONS, ATOMS, NOISE = 360, 40, 800, 0.01

random = np.random.default_rng(1)
basis = np.cos(0.01 * np.outer(np.arange(1, DIRECTIONS + 1), np.arange(1, ROWS + 1))) / np.sqrt(0.5 * ROWS)


def windows(count, noise):
    weights = random.standard_normal((count, DIRECTIONS)) * 0.9 ** np.arange(DIRECTIONS)
    return weights @ basis + noise * random.standard_normal((count, ROWS))


measured = []


def timed(name, job):
    start, cpu_start = time.perf_counter(), time.process_time()
    result = job()
    print(f"{name:<44}{1e3 * (time.perf_counter() - start):12.1f} ms", flush=True)
    measured.append({"name": name, "cpu_time": 1e3 * (time.process_time() - cpu_start), "time_unit": "ms"})
    return result


training = windows(2000, 0)
atoms = training[random.choice(len(training), ATOMS, replace=False)]
atoms /= np.linalg.norm(atoms, axis=1, keepdims=True)
noisy = windows(2000, NOISE)
timed("batch_omp", lambda: sparse_encode(noisy, atoms, algorithm="omp", n_nonzero_coefs=10, n_jobs=1))
# scikit-learn's lasso halves the squared error.
penalty = 0.25 * NOISE * np.sqrt(2 * np.log(ATOMS))
for algorithm in ("lasso_cd", "lasso_lars"):
    timed(f"{algorithm}/256",
          lambda algorithm=algorithm: sparse_encode(noisy[:256], atoms, algorithm=algorithm, alpha=penalty, n_jobs=1))
if "--out" in sys.argv:
    with open(sys.argv[sys.argv.index("--out") + 1], "w") as file:
        json.dump({"benchmarks": measured}, file)
