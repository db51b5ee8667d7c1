"""A sweep over horizons and limits of the input, on all processors.

Compiling and solving leave the interpreter free, so threads will do; with Ray it is `ray.remote(bound)`, with Dask
`client.map(bound, settings)`: a setting and a number are all that travels. The noise here is known, so what is promised holds for every
setting; with samples each of m settings needs its share of the confidence (docs/guarantee.md).
"""

import itertools
from concurrent.futures import ThreadPoolExecutor

import dynabs

ROOM = {
    "name": "room",
    "dynamics": {"A": [[0.9]], "B": [[1]]},
    "noise": {"components": [{"gaussian": {"deviation": 0.1}}]},
    "partition": {"lower": [-3], "upper": [3], "cells": [120]},
    "task": {"goal": [{"lower": [-0.5], "upper": [0.5]}]},
    "initial_state": [2],
}


def bound(setting):
    """The guaranteed probability with a horizon and a limit of the input."""
    horizon, limit = setting
    problem = dynabs.Problem({
        **ROOM,
        "input": {"lower": [-limit], "upper": [limit], "points": [9]},
        "task": {**ROOM["task"], "horizon": horizon},
    })
    return problem.compile().solve().bound


if __name__ == "__main__":
    settings = list(itertools.product([2, 4, 8], [0.1, 0.2, 0.4]))
    with ThreadPoolExecutor() as executor:
        for (horizon, limit), value in zip(settings, executor.map(bound, settings)):
            print(f"horizon {horizon}  |u| <= {limit}  bound {value:.6f}")
