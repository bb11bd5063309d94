#!/usr/bin/env python3
"""Euler orders by SciPy and chordal means by NumPy's symmetric eigenproblem.

Writes tests/fixtures/rotation/euler_orders.csv: order, three angles (radians), w, x, y, z of R = R0 R1 R2; and
tests/fixtures/rotation/chordal_means.csv: one line a rotation: set, weight, w, x, y, z; then the mean as set, -1, w, x, y, z.
"""
import itertools
import pathlib

import numpy as np
from scipy.spatial.transform import Rotation

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "tests/fixtures/rotation"


def text(values):
    return ",".join(repr(float(v)) for v in values)


def euler_orders(rng):
    lines = ["# order,a0,a1,a2,w,x,y,z"]
    for axes in itertools.product("XYZ", repeat=3):
        if axes[0] == axes[1] or axes[1] == axes[2]:
            continue
        order = "".join(axes)
        for angles in rng.uniform(-np.pi, np.pi, (5, 3)):
            x, y, z, w = Rotation.from_euler(order, angles).as_quat()
            lines.append(f"{order},{text(angles)},{text((w, x, y, z))}")
    return lines


def chordal_means(rng):
    lines = ["# set,weight (-1: the mean),w,x,y,z"]
    for number, (count, spread) in enumerate([(1, 0.0), (2, 0.5), (5, 0.1), (10, 0.8), (20, 3.0)]):
        centre = Rotation.random(random_state=rng)
        rotations = centre * Rotation.from_rotvec(rng.normal(0, spread, (count, 3)))
        quaternions = np.roll(rotations.as_quat(), 1, axis=1) * rng.choice([-1, 1], (count, 1))
        weights = rng.uniform(0.1, 2, count)
        moment = np.einsum("i,ij,ik->jk", weights, quaternions, quaternions)
        mean = np.linalg.eigh(moment)[1][:, -1]
        lines += [f"{number},{text((w,))},{text(q)}" for w, q in zip(weights, quaternions)]
        lines.append(f"{number},-1,{text(mean)}")
    return lines


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    rng = np.random.RandomState(20)
    (FOLDER / "euler_orders.csv").write_text("\n".join(euler_orders(rng)) + "\n")
    (FOLDER / "chordal_means.csv").write_text("\n".join(chordal_means(rng)) + "\n")


main()
