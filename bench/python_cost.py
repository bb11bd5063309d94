#!/usr/bin/python3
"""Measures what a call from Python costs over the call of C++ that it makes.

  PYTHONPATH=build/release/python bench/python_cost.py [TAKE]

`kinemend.clean` says how long the call of C++ took (`report.figures.seconds`), without the copy of the take that `clean_take(const
Take&)` makes first. The rest of the wall clock, less the time of such a copy, is the cost. The least of many repetitions is printed,
in milliseconds. A frame of a live filter has no such clock: its whole time is printed.
"""
import pathlib
import sys
import time

import numpy as np

import kinemend

TAKE = pathlib.Path(__file__).resolve().parent.parent / "examples" / "takes" / "noisy_walk.bvh"
REPETITIONS = 50


def time_of_a_copy(take):
    times = []
    for _ in range(REPETITIONS):
        begin = time.perf_counter()
        take.copy()
        times.append(time.perf_counter() - begin)
    return min(times)


def cost_of_cleaning(take, method):
    cleaner = kinemend.Cleaner(method)
    copy = time_of_a_copy(take)
    costs = []
    for _ in range(REPETITIONS):
        begin = time.perf_counter()
        result = kinemend.clean(take, cleaner)
        spent = time.perf_counter() - begin
        costs.append(spent - result.report.figures.seconds)
        # Freeing it here keeps that cost out of the next call.
        del result
    return 1000 * (min(costs) - copy)


def time_of_a_frame(take):
    live = kinemend.LiveFilter(take, "one-euro")
    times = []
    for rotations, positions in zip(take.rotations, take.positions):
        begin = time.perf_counter()
        live.push(rotations, positions)
        times.append(time.perf_counter() - begin)
    return 1000 * min(times)


def main(words):
    take = kinemend.read(words[0] if words else TAKE)
    tenfold = kinemend.Take.of_joints(take.names, take.parents, take.offsets, np.tile(take.rotations, (10, 1, 1)), fps=take.fps)
    for one in (take[:2], take, tenfold):
        print(f"clean, {len(one)} frames of {len(one.names)} joints: {cost_of_cleaning(one, 'gaussian'):.3f} ms over C++")
    begin = time.perf_counter()
    for _ in range(1000):
        take.rotations
    print(f"a view: {time.perf_counter() - begin:.4f} ms")
    print(f"a live frame, whole: {time_of_a_frame(take):.4f} ms")


if __name__ == "__main__":
    main(sys.argv[1:])
