#!/usr/bin/env python3
"""Writes tests/data/binomial.csv: Clopper-Pearson bounds to 20 digits.

Usage: scripts/binomial-reference.py > tests/data/binomial.csv   (needs mpmath)

Columns: n, k, level, lower, upper. lower is the p with P(Bin(n, p) >= k) = level, upper the p with
P(Bin(n, p) <= k) = level; both p and 1 - p have 20 correct digits. Levels are the doubles as written.
"""

import random

import mpmath as mp

mp.mp.dps = 60


BITS = 400  # of the fixed-point numbers in which series are summed


def tail(k, n, z):
    """ln P(Bin(n, p) >= k) at p = 1 / (1 + exp(-z)), and its derivative by z."""
    p, q = 1 / (1 + mp.exp(-z)), 1 / (1 + mp.exp(z))
    mass = (mp.loggamma(n + 1) - mp.loggamma(k + 1) - mp.loggamma(n - k + 1)
            + k * mp.log(p) + (n - k) * mp.log(q))
    odds = int(mp.ldexp(mp.exp(z), BITS))
    term = total = 1 << BITS
    for i in range(k, n):
        term = (term * odds * (n - i)) // (i + 1) >> BITS
        total += term
        # Past the mode terms fall faster and faster.
        if term << 160 < total:
            break
    series = mp.ldexp(mp.mpf(total), -BITS)
    return mass + mp.log(series), k * q / series


def solve(k, n, level):
    """(p, 1 - p) with P(Bin(n, p) >= k) = level: Newton's method on log-odds, checked by a sign change."""
    if k == 0:
        return mp.mpf(0), mp.mpf(1)
    target = mp.log(level)
    share = k - mp.mpf("0.5")
    z = mp.log(share / (n - share))
    for _ in range(100):
        value, slope = tail(k, n, z)
        step = (value - target) / slope
        z -= step
        if abs(step) < mp.mpf(10) ** -30:
            break
    width = mp.mpf(10) ** -26
    assert tail(k, n, z - width)[0] < target < tail(k, n, z + width)[0], (k, n, level)
    return 1 / (1 + mp.exp(-z)), 1 / (1 + mp.exp(z))


def digits(p, q):
    if p == 0 or q == 0:
        return "0" if p == 0 else "1"
    leading = max(0, int(mp.ceil(-mp.log10(q))))
    return mp.nstr(p, 20 + leading, min_fixed=-mp.inf, max_fixed=mp.inf)


def cases():
    for n in range(1, 13):
        for k in range(n + 1):
            for level in (0.4, 0.01, 1e-15):
                yield n, k, level
    for n in (100, 1600, 12800, 10**7):
        for k in (0, 1, n // 2, n - 1, n):
            for level in (0.4, 1e-3, 1e-8, 1e-15):
                yield n, k, level
    rng = random.Random(1)
    for _ in range(150):
        n = int(10 ** rng.uniform(1, 7))
        k = rng.choice([rng.randint(0, n), int(n ** rng.random()), n - int(n ** rng.random())])
        yield n, k, float(f"{10 ** rng.uniform(-15, -0.4):.3e}")


print("n,k,level,lower,upper")
for n, k, level in cases():
    p, q = solve(k, n, mp.mpf(level))
    failures, successes = solve(n - k, n, mp.mpf(level))
    print(n, k, repr(level), digits(p, q), digits(successes, failures), sep=",", flush=True)
