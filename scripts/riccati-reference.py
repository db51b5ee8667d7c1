#!/usr/bin/env python3
"""Writes tests/data/riccati.json: random systems with the LQR gain that scipy computes for them.

Usage: scripts/riccati-reference.py > tests/data/riccati.json   (needs numpy and scipy)
"""

import json

import numpy as np
from scipy.linalg import solve_discrete_are

rng = np.random.default_rng(1)
cases = []
while len(cases) < 200:
    n = int(rng.integers(1, 7))
    p = int(rng.integers(1, n + 2))
    # Spectral radii from well inside to well outside the unit circle.
    a = rng.normal(size=(n, n)) * rng.choice([0.2, 0.6, 1.0, 2.0])
    b = rng.normal(size=(n, p))
    root_q, root_r = rng.normal(size=(n, n)), rng.normal(size=(p, p))
    q = root_q @ root_q.T + 0.1 * np.eye(n)
    r = (root_r @ root_r.T + 0.1 * np.eye(p)) * rng.choice([0.01, 1.0, 20.0])
    cost = solve_discrete_are(a, b, q, r)
    gain = np.linalg.solve(r + b.T @ cost @ b, b.T @ cost @ a)
    residual = a.T @ cost @ (a - b @ gain) + q - cost
    if np.linalg.norm(residual) > 1e-11 * np.linalg.norm(cost):
        continue  # not a reference
    cases.append({name: m.tolist() for name, m in dict(A=a, B=b, Q=q, R=r, K=gain, P=cost).items()})
print(json.dumps(cases))
