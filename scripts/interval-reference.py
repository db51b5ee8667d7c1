#!/usr/bin/env python3
"""Writes tests/data/intervals.csv: the exact ranges of functions over intervals, to the double.

Usage: scripts/interval-reference.py > tests/data/intervals.csv   (needs mpmath)

Columns: function, lower, upper, least, greatest. The first two are the ends of the argument, the last two the largest
double at most the least value and the smallest double at least the greatest one; doubles are written as the
hexadecimal digits of their 64 bits.
"""
import math
import random
import struct

import mpmath as mp

mp.mp.prec = 1400  # arguments up to 2^1000 times π need as many bits
random.seed(2024)


def bits(x):
    return struct.pack(">d", x).hex()


def down(value):
    """The largest double at most an mpmath number."""
    near = float(value)
    if math.isinf(near):
        return 1.7976931348623157e308 if near > 0 else near
    return near if mp.mpf(near) <= value else math.nextafter(near, -math.inf)


def up(value):
    return -down(-value)


def oscillating(function, shift):
    """The range of sin or cos: extremes are at (k + shift)·π, a maximum for even k."""
    def ends(a, b):
        first, last = mp.ceil(a / mp.pi - shift), mp.floor(b / mp.pi - shift)
        inside = {int(k) % 2 for k in (first, first + 1) if k <= last}
        values = [function(a), function(b)]
        return (mp.mpf(-1) if 1 in inside else min(values)), (mp.mpf(1) if 0 in inside else max(values))
    return ends


def monotone(function):
    return lambda a, b: (lambda x, y: (min(x, y), max(x, y)))(function(a), function(b))


def even(function):
    def ends(a, b):
        far = function(max(abs(a), abs(b)))
        return (function(mp.mpf(0)) if a <= 0 <= b else function(min(abs(a), abs(b)))), far
    return ends


def spread(low, high):
    return random.uniform(low, high)


def scaled(low, high):
    """A number of random size and sign."""
    return random.choice([-1, 1]) * 2.0 ** random.uniform(low, high)


HALF = mp.mpf(1) / 2
FUNCTIONS = {
    "sin": (oscillating(mp.sin, HALF), lambda: random.choice([spread(-10, 10), scaled(-60, 28)])),
    "cos": (oscillating(mp.cos, mp.mpf(0)), lambda: random.choice([spread(-10, 10), scaled(-60, 28)])),
    "tan": (monotone(mp.tan), lambda: spread(-1.57, 1.57)),
    "atan": (monotone(mp.atan), lambda: scaled(-30, 60)),
    "asin": (monotone(mp.asin), lambda: spread(-1, 1)),
    "acos": (monotone(mp.acos), lambda: spread(-1, 1)),
    "sinh": (monotone(mp.sinh), lambda: scaled(-30, 9)),
    "cosh": (even(mp.cosh), lambda: scaled(-30, 9)),
    "tanh": (monotone(mp.tanh), lambda: scaled(-30, 5)),
    "exp": (monotone(mp.exp), lambda: spread(-800, 700)),
    "ln": (monotone(mp.log), lambda: 2.0 ** spread(-1000, 1000)),
    "sqrt": (monotone(mp.sqrt), lambda: 2.0 ** spread(-1060, 1000)),
}
# Doubles nearest to multiples of π/2, where the extremes lie just inside or just outside.
NEAR = [float(k * mp.pi / 2) for k in (*range(-8, 9), 101, 10001, 1000003)]


def arguments(name, draw):
    for _ in range(60):
        x = draw()
        yield x, x
    for _ in range(60):
        yield tuple(sorted((draw(), draw())))
    for _ in range(60):
        x = draw()
        y = x + abs(x) * 2.0 ** random.uniform(-50, -3)
        if name not in ("asin", "acos", "tan") or abs(y) <= 1:
            yield x, y
    if name in ("sin", "cos"):
        for x in NEAR:
            before, after = math.nextafter(x, -math.inf), math.nextafter(x, math.inf)
            yield from ((x, x), (before, x), (x, after), (before, after), (x - 1, before), (after, x + 1))


print("function,lower,upper,least,greatest")
for name, (ends, draw) in FUNCTIONS.items():
    for a, b in arguments(name, draw):
        least, greatest = ends(mp.mpf(a), mp.mpf(b))
        print(f"{name},{bits(a)},{bits(b)},{bits(down(least))},{bits(up(greatest))}")
for _ in range(200):
    a, b = sorted((2.0 ** spread(-3, 3), 2.0 ** spread(-3, 3)))
    c, d = sorted((spread(-20, 20), spread(-20, 20)))
    values = [mp.power(x, y) for x in (mp.mpf(a), mp.mpf(b)) for y in (mp.mpf(c), mp.mpf(d))]
    print(f"power,{bits(a)} {bits(c)},{bits(b)} {bits(d)},{bits(down(min(values)))},{bits(up(max(values)))}")
