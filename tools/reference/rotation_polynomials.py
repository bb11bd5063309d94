#!/usr/bin/env python3
"""Coefficients of the polynomials in src/cleaner/rotation_lanes-inl.hpp, and how far they are off.

With u = sin^2(angle / 4) of a rotation (0 to 1/2 for angles from 0 to pi) both are analytic in u:
  angle^2 = u f(u),               f(u) = 16 asin(sqrt(u))^2 / u
  Log(q)  = g(u) (x, y, z),       g(u) = angle / sin(angle / 2) = 2 asin(sqrt(u)) / sqrt(u (1 - u))
They are interpolated at Chebyshev nodes of [0, 1/2] and written as powers of u.
Needs python3-mpmath. Usage: rotation_polynomials.py
"""
import mpmath as mp

mp.mp.dps = 60


def f(u):
    return mp.mpf(16) if u == 0 else 16 * mp.asin(mp.sqrt(u)) ** 2 / u


def g(u):
    return mp.mpf(2) if u == 0 else 2 * mp.asin(mp.sqrt(u)) / mp.sqrt(u * (1 - u))


def interpolate(function, degree):
    nodes = [(1 + mp.cos(mp.pi * (2 * i + 1) / (2 * (degree + 1)))) / 4 for i in range(degree + 1)]
    matrix = mp.matrix(degree + 1, degree + 1)
    for row, u in enumerate(nodes):
        for column in range(degree + 1):
            matrix[row, column] = u**column
    return mp.lu_solve(matrix, mp.matrix([function(u) for u in nodes]))


def horner(coefficients, u):
    value = mp.mpf(0)
    for c in reversed(coefficients):
        value = value * u + c
    return value


for name, function, degree in (("squared angle", f, 14), ("logarithm", g, 17)):
    coefficients = [mp.mpf(float(c)) for c in interpolate(function, degree)]
    worst = max(abs(horner(coefficients, mp.mpf(i) / 2000) / function(mp.mpf(i) / 2000) - 1) for i in range(1001))
    print(f"// {name}, degree {degree}: relative error below {mp.nstr(worst, 2)}")
    print(",\n".join(repr(float(c)) for c in coefficients))
