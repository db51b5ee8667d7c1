#!/usr/bin/env python3
"""Writes tests/data/noise_masses.json: masses of intervals under known distributions, to 40 digits. Needs mpmath."""
import json
import pathlib
from mpmath import mp, mpf, erfc, exp, sqrt, betainc, nstr

mp.dps = 60


def tail(kind, p, z):
    """P(X >= mean + z) of a symmetric distribution, z >= 0."""
    if kind == "gaussian":
        variance = mpf(p["variance"]) if "variance" in p else mpf(p["deviation"]) ** 2
        return erfc(z / sqrt(2 * variance)) / 2
    if kind == "laplace":
        return exp(-z / mpf(p["scale"])) / 2
    if kind == "logistic":
        return 1 / (1 + exp(z / mpf(p["scale"])))
    t, nu = z / mpf(p["scale"]), mpf(p["degrees"])
    return betainc(nu / 2, mpf(1) / 2, 0, nu / (nu + t * t), regularized=True) / 2


def below(spec, x):
    """P(X < x)."""
    (kind, p), = spec.items()
    if kind in ("gaussian", "laplace", "logistic", "student_t"):
        z = x - mpf(p.get("mean", "0"))
        return 1 - tail(kind, p, z) if z >= 0 else tail(kind, p, -z)
    if kind == "uniform":
        a, b = mpf(p["lower"]), mpf(p["upper"])
        return min(max((x - a) / (b - a), mpf(0)), mpf(1))
    if kind == "triangular":
        a, c, b = mpf(p["lower"]), mpf(p["mode"]), mpf(p["upper"])
        if x <= a or x >= b:
            return mpf(0) if x <= a else mpf(1)
        return (x - a) ** 2 / ((b - a) * (c - a)) if x <= c else 1 - (b - x) ** 2 / ((b - a) * (b - c))
    if kind == "atoms":
        weights = [mpf(w) for w in p["weights"]]
        return sum((w for v, w in zip(p["values"], weights) if mpf(v) < x), mpf(0)) / sum(weights)
    if kind == "table":
        points = list(zip(map(mpf, p["x"]), map(mpf, p["cdf"])))
        if x <= points[0][0] or x >= points[-1][0]:
            return mpf(0) if x <= points[0][0] else mpf(1)
        (a, f), (b, g) = next(pair for pair in zip(points, points[1:]) if pair[0][0] <= x < pair[1][0])
        return f + (g - f) * (x - a) / (b - a)
    if kind == "mixture":
        weights = [mpf(w) for w in p["weights"]]
        return sum(w * below(part, x) for w, part in zip(weights, p["of"])) / sum(weights)
    a, b = mpf(p["lower"]), mpf(p["upper"])
    low, high = below(p["of"], a), below(p["of"], b)
    return (min(max(below(p["of"], x), low), high) - low) / (high - low)


GAUSSIAN = {"gaussian": {"deviation": "0.3"}}
CASES = [
    (GAUSSIAN, "0.1"), ({"gaussian": {"mean": "-1.5", "variance": "0.75"}}, "0.25"), ({"gaussian": {"deviation": "1e-3"}}, "1e-4"),
    ({"laplace": {"scale": "0.2"}}, "0.125"), ({"laplace": {"mean": "0.3", "scale": "2"}}, "0.7"),
    ({"logistic": {"scale": "0.5"}}, "0.3"), ({"logistic": {"mean": "-2", "scale": "0.01"}}, "0.05"),
    *(({"student_t": {"scale": "0.4", "degrees": nu}}, "0.3") for nu in (1, 2, 3, 4, 5, 10, 37, 200)),
    ({"uniform": {"lower": "-0.7", "upper": "0.4"}}, "0.3"), ({"triangular": {"lower": "-1", "mode": "0.25", "upper": "2"}}, "0.2"),
    ({"triangular": {"lower": "0", "mode": "0", "upper": "1"}}, "0.1"),
    ({"atoms": {"values": ["-0.2", "0", "0.1", "0.3"], "weights": ["1", "2", "3", "1"]}}, "0.125"),
    ({"table": {"x": ["-1", "-0.5", "0", "2"], "cdf": ["0", "0.25", "0.75", "1"]}}, "0.2"),
    ({"mixture": {"of": [GAUSSIAN, {"uniform": {"lower": "1", "upper": "2"}}], "weights": ["2", "1"]}}, "0.15"),
    ({"truncated": {"of": GAUSSIAN, "lower": "-0.5", "upper": "0.25"}}, "0.125"),
    ({"truncated": {"of": {"student_t": {"scale": "1", "degrees": 3}}, "lower": "0.5", "upper": "9"}}, "0.6"),
]


def numbers(spec):
    """The same with JSON numbers for decimals."""
    if isinstance(spec, dict):
        return {key: numbers(value) for key, value in spec.items()}
    if isinstance(spec, list):
        return [numbers(value) for value in spec]
    return float(spec) if isinstance(spec, str) else spec


def main():
    cases = []
    for spec, pitch in CASES:
        edges = sorted({*range(-12, 14), -40, 40, -100, 100})
        masses = [[a, b, nstr(below_difference(spec, mpf(pitch), a, b), 40)] for a, b in zip(edges, edges[1:])]
        cases.append({"distribution": numbers(spec), "pitch": float(pitch), "masses": masses})
    path = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data" / "noise_masses.json"
    path.write_text(json.dumps(cases, indent=None, separators=(",", ":")).replace("},{\"distribution", "},\n{\"distribution") + "\n")


def below_difference(spec, pitch, a, b):
    with mp.workdps(400):
        return below(spec, b * pitch) - below(spec, a * pitch)


if __name__ == "__main__":
    main()
