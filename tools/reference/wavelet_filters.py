#!/usr/bin/env python3
"""Writes src/signal/wavelet_table.hpp: the filters of Daubechies wavelets and symlets, correct to the last bit.

  python3 tools/reference/wavelet_filters.py > src/signal/wavelet_table.hpp

With y = sin^2(w / 2) a filter has |H|^2 = 2 cos^{2N}(w / 2) P(y), P(y) = sum_{k<N} binomial(N - 1 + k, k) y^k
(Daubechies 1988). Each root y of P gives two roots z of y = (2 - z - 1/z) / 4, and a filter takes one of them:
Daubechies wavelets the one within the unit circle, symlets the choice that is nearest to linear phase.
Needs python3-mpmath.
"""
import itertools
import math

import mpmath as mp

mp.mp.dps = 60
MOST_MOMENTS = 10


def root_groups(moments):
    """The roots within the unit circle: a real one alone, a complex one as one of its conjugate pair."""
    if moments == 1:
        return []
    polynomial = [mp.binomial(moments - 1 + k, k) for k in reversed(range(moments))]
    groups = []
    for y in mp.polyroots(polynomial, maxsteps=500, extraprec=400):
        if mp.im(y) < -mp.mpf(10) ** -40:
            continue
        centre = 1 - 2 * y
        offset = mp.sqrt(centre * centre - 1)
        root = min(centre - offset, centre + offset, key=abs)
        groups.append(mp.mpc(mp.re(root), 0) if abs(mp.im(y)) < mp.mpf(10) ** -40 else mp.mpc(root))
    return groups


def filter_of(moments, groups):
    """h(z) = (1 + 1/z)^N prod (1 - root/z), scaled to sum sqrt(2)."""
    h = [mp.mpf(1)]
    factors = [[1, 1]] * moments
    factors += [[1, -g.real] if g.imag == 0 else [1, -2 * g.real, g.real**2 + g.imag**2] for g in groups]
    for factor in factors:
        product = [mp.mpf(0)] * (len(h) + len(factor) - 1)
        for i, value in enumerate(h):
            for j, f in enumerate(factor):
                product[i + j] += value * f
        h = product
    scale = mp.sqrt(2) / mp.fsum(h)
    return [value * scale for value in h]


def phase_nonlinearity(groups):
    """Deviation of the phase from a straight line between 0 and pi; (1 + 1/z)^N, whose phase is linear, is left out."""
    steps = 256
    roots = [complex(g) for g in groups] + [complex(g).conjugate() for g in groups if g.imag != 0]
    phase = []
    for i in range(steps + 1):
        delay = complex(math.cos(math.pi * i / steps), -math.sin(math.pi * i / steps))
        value = math.prod((1 - root * delay for root in roots), start=complex(1))
        angle = math.atan2(value.imag, value.real)
        turns = round((phase[-1] - angle) / (2 * math.pi)) if phase else 0
        phase.append(angle + 2 * math.pi * turns)
    return sum((p - phase[0] - (phase[-1] - phase[0]) * i / steps) ** 2 for i, p in enumerate(phase))


def symlet(moments):
    """The choice of roots nearest to linear phase; of it and its mirror image the one that comes earlier."""
    groups = root_groups(moments)
    choices = []
    for taken in itertools.product([False, True], repeat=len(groups) - 1):
        choices.append([1 / mp.conj(g) if other else g for g, other in zip(groups, taken + (False,))])
    h = filter_of(moments, min(choices, key=phase_nonlinearity))
    return h[::-1] if mp.fsum(k * value**2 for k, value in enumerate(h)) > mp.mpf(len(h) - 1) / 2 else h


def rows(family, first, filters):
    print(f"// With {first} to {MOST_MOMENTS} vanishing moments, one after the other; two coefficients a moment.")
    print(f"inline constexpr double {family}_filters[] = {{")
    print(",\n".join(f"    {float(value)!r}" for h in filters for value in h) + "};")


def main():
    print("// The filters of Daubechies wavelets and symlets, correct to the last bit. They are stored because\n"
          "// functions of complex numbers differ by system. Made by tools/reference/wavelet_filters.py.")
    print("// clang-format off\n#pragma once\n\nnamespace kinemend::signal {\n")
    print(f"inline constexpr int most_moments = {MOST_MOMENTS};\n")
    rows("daubechies", 1, [filter_of(n, root_groups(n)) for n in range(1, MOST_MOMENTS + 1)])
    print()
    rows("symlet", 2, [symlet(n) for n in range(2, MOST_MOMENTS + 1)])
    print("\n}  // namespace kinemend::signal")


if __name__ == "__main__":
    main()
