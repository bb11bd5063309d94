#!/usr/bin/env python3
"""Numbers of xoshiro256++ seeded through splitmix64, from their published definitions (Blackman & Vigna), in plain integers.

Writes tests/fixtures/base/xoshiro256pp.csv: seed, position in the sequence, value.
"""
import pathlib

MASK = (1 << 64) - 1


def splitmix64(state):
    while True:
        state = (state + 0x9E3779B97F4A7C15) & MASK
        z = state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        yield z ^ (z >> 31)


def rotate_left(x, k):
    return ((x << k) | (x >> (64 - k))) & MASK


def xoshiro256pp(seed):
    words = splitmix64(seed)
    s = [next(words) for _ in range(4)]
    while True:
        yield (rotate_left((s[0] + s[3]) & MASK, 23) + s[0]) & MASK
        t = (s[1] << 17) & MASK
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotate_left(s[3], 45)


def main():
    target = pathlib.Path(__file__).resolve().parents[2] / "tests/fixtures/base/xoshiro256pp.csv"
    target.parent.mkdir(parents=True, exist_ok=True)
    lines = ["# seed,position,value"]
    for seed in (0, 1, 42, MASK):
        for position, value in zip(range(1001), xoshiro256pp(seed)):
            if position < 6 or position == 1000:
                lines.append(f"{seed},{position},{value}")
    target.write_text("\n".join(lines) + "\n")


main()
