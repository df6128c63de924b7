#!/usr/bin/env python3
"""Make the coefficients in gslam/geometry/detail/{stumpff,arctangent,exponential}.h, and their error bounds.

Each function f is entire, or analytic far beyond its interval, and is replaced by f(0) + x r(x): the constant is exact,
so nothing changes at small x. r is the polynomial (for the arctangent the quotient of two) that meets (f(x) - f(0)) / x
at Chebyshev points, in exact fractions; this is within a small factor of the best there is. Coefficients are then
rounded, and the largest relative error of what the header computes in exact arithmetic is measured on a grid.

Usage: polynomials.py [double|float]   prints C++ arrays, highest power first; only Python's standard library is needed.
"""
import math
import struct
import sys
from fractions import Fraction

BITS = 400  # of intermediate numbers


def short(value):
    """A fraction with BITS bits behind the point: exact enough, and small."""
    return Fraction(round(value * 2**BITS), 2**BITS)


def stumpff(n):
    """c_n(x) = sum of (-x)^k / (2k + n)!"""
    return lambda x: series(lambda k: Fraction((-1) ** k, math.factorial(2 * k + n)), x, 60)


def exponential(n):
    """e_n(x) = sum of x^k / (k + n)!"""
    return lambda x: series(lambda k: Fraction(1, math.factorial(k + n)), x, 60)


def arctangent(x):
    """atan(sqrt(x)) / sqrt(x), by Euler's series, whose terms shrink by x / (1 + x)."""
    ratio, term, total = x / (1 + x), 1 / (1 + x), Fraction(0)
    for n in range(350):
        total += term
        term = short(term * ratio * Fraction(2 * n + 2, 2 * n + 3))
    return total


def series(coefficient, x, terms):
    total = Fraction(0)
    for k in reversed(range(terms)):
        total = short(total * x + coefficient(k))
    return total


def chebyshev_points(low, high, count):
    middle, half = Fraction(low + high) / 2, Fraction(high - low) / 2
    return [middle + half * Fraction(math.cos(math.pi * (2 * i + 1) / (2 * count))) for i in range(count)]


def solve(rows, right):
    """Gauss' elimination in fractions."""
    n = len(rows)
    table = [[*row, value] for row, value in zip(rows, right)]
    for column in range(n):
        pivot = max(range(column, n), key=lambda r, c=column: abs(table[r][c]))
        table[column], table[pivot] = table[pivot], table[column]
        for r in range(column + 1, n):
            factor = short(table[r][column] / table[column][column])
            table[r] = [short(a - factor * b) for a, b in zip(table[r], table[column])]
    solution = [Fraction(0)] * n
    for r in reversed(range(n)):
        rest = sum(table[r][c] * solution[c] for c in range(r + 1, n))
        solution[r] = short((table[r][n] - rest) / table[r][r])
    return solution


def quotient(f, low, high, above, below):
    """Coefficients, lowest power first, of p (degree `above`) and q (degree `below`, q(0) = 1), p / q = (f - f(0)) / x."""
    points = chebyshev_points(low, high, above + below + 1)
    constant = f(Fraction(0))
    values = [short((f(x) - constant) / x) for x in points]
    rows = [[x**k for k in range(above + 1)] + [-y * x**k for k in range(1, below + 1)] for x, y in zip(points, values)]
    solution = solve(rows, values)
    return solution[: above + 1], [Fraction(1), *solution[above + 1 :]]


def rounded(value, kind):
    return Fraction(float(value) if kind == "double" else struct.unpack("f", struct.pack("f", float(value)))[0])


def evaluate(coefficients, x):
    total = Fraction(0)
    for c in reversed(coefficients):
        total = total * x + c
    return total


def text(value, kind):
    return repr(float(value)) if kind == "double" else f"{float(value):.9g}"


def print_array(name, coefficients, kind):
    print(f"{name}:")
    for c in reversed(coefficients):
        print(f"    T({text(c, kind)}),")


def make(name, f, low, high, degrees, kind):
    """`degrees`: of r, and of its denominator."""
    p, q = quotient(f, low, high, *degrees)
    p, q = [rounded(c, kind) for c in p], [rounded(c, kind) for c in q]
    constant = rounded(f(Fraction(0)), kind)
    worst = 0.0
    for i in range(400):
        x = low + Fraction(high - low) * i / 399
        error = constant + x * evaluate(p, x) / evaluate(q, x) - f(x)
        worst = max(worst, abs(float(error / f(Fraction(0)))))
    print(f"\n// {name} on [{low}, {high}]: error / f(0) < {worst:.1e}")
    if degrees[1]:
        print_array("p", p, kind)
        print_array("q", q, kind)
    else:
        print_array("coefficients", [constant, *p], kind)


def main():
    kind = sys.argv[1] if len(sys.argv) > 1 else "double"
    is_double = kind == "double"
    quarter = Fraction(5, 2)
    make("half angle, c0(h)", stumpff(0), 0, quarter, (7 if is_double else 4, 0), kind)
    make("half angle, c1(h)", stumpff(1), 0, quarter, (7 if is_double else 4, 0), kind)
    for n in (3, 4, 5):
        make(f"c{n}(x)", stumpff(n), 0, 10, (8 if is_double else 4, 0), kind)
    make("atan(sqrt(x)) / sqrt(x)", arctangent, 0, 1, (6, 6) if is_double else (2, 2), kind)
    make("e3(x)", exponential(3), -1, 1, (11 if is_double else 5, 0), kind)


if __name__ == "__main__":
    main()
