# %% [markdown]
# # From arrays to a simulated controller
#
# A cart with a position and a speed is to come to rest near the origin. Its noise is known by measurements only. Every cell
# below (`# %%`) runs as it stands: `python examples/python/tutorial.py`, or as a notebook in an editor that knows percent scripts.

# %%
import numpy as np

import dynabs

noise = np.random.default_rng(1).uniform(-0.2, 0.2, (4000, 2))
problem = dynabs.Problem({
    "name": "cart",
    "dynamics": {"A": np.array([[1, 1], [0, 1]]), "B": np.array([[0.5], [1]]), "group_steps": 2},
    "noise": {"samples": {"values": noise, "of": "step"}},
    "input": {"lower": [-4], "upper": [4]},
    "partition": {"lower": [-10.5, -10.5], "upper": [10.5, 10.5], "cells": [21, 21]},
    "task": {"goal": [{"lower": [-1.5, -1.5], "upper": [1.5, 1.5]}], "horizon": 16},
    "initial_state": [-6, 0],
})
solution = problem.compile().solve()
controller = solution.controller
print(solution.bound)                               # guaranteed from (-6, 0)
status, u = controller([-6, 0])
print(status, u)                                    # the inputs of the next two steps
print(solution.simulate(runs=10_000)["satisfied"])  # how often 10,000 runs did it

# %% [markdown]
# `solution.lower` is the guaranteed probability of every cell, in the shape of the partition; `lower_at` is that of states.

# %%
assert solution.lower.shape == (21, 21)
assert solution.lower_at([-6, 0]) == solution.bound
print(solution.promise)

# %% [markdown]
# The controller takes arrays: a million states at once.

# %%
x = np.random.default_rng(2).uniform(-10, 10, (1_000_000, 2))
status, u = controller(x)
print({dynabs.Status(s).name: int(n) for s, n in zip(*np.unique(status, return_counts=True))}, u.shape)

# %% [markdown]
# A mistake says where it is, what was found and what is expected.

# %%
try:
    dynabs.Problem({"dynamics": {"A": [[1, 1], [0, 1]], "B": [[0.5], [1], [2]]}})
except dynabs.Error as error:
    print(error.path, "|", error.found, "|", error.expected)

# %% [markdown]
# The model is an interval MDP. Anyone's can be made of arrays, asked properties in PRISM's syntax, and proved.

# %%
model = dynabs.imdp.Model([0, 1, 1], [0, 2], [0, 1], [0.4, 0.3], [0.7, 0.6], labels={"goal": [1]})
result = model.solve('Pmaxmin=? [ F<=3 "goal" ]')
print(result.lower, result.upper)

# %%
from importlib.util import find_spec

if find_spec("matplotlib"):
    import matplotlib

    matplotlib.use("Agg")
    from dynabs import plot

    ax = plot.bounds(solution, problem)
    plot.trajectories(solution, runs=5, ax=ax)
