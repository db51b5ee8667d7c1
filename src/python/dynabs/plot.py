"""Pictures of solutions, if matplotlib is there."""

import numpy as np


def bounds(solution, problem, across=0, up=1, at=None, ax=None):
    """The lower bounds on the probability of success over two dimensions of the state.

    across, up: the dimensions; at: (n,), the state through which the slice goes (the middle of the partition if None).
    Returns the axes of matplotlib.
    """
    import matplotlib.pyplot as plt

    ax = plt.subplots()[1] if ax is None else ax
    name = "value (nothing is promised)" if solution.confidence is None else "guaranteed probability"
    at = (problem.lower + problem.upper) / 2 if at is None else np.asarray(at, dtype=float)
    cells = np.array(problem.cells)
    places = np.floor((at - problem.lower) / (problem.upper - problem.lower) * cells).astype(int)
    slices = list(np.clip(places, 0, cells - 1))
    if len(cells) > 1:
        slices[across] = slices[up] = slice(None)
        values = solution.lower[tuple(slices)]
        values = values.T if across < up else values
        extent = [problem.lower[across], problem.upper[across], problem.lower[up], problem.upper[up]]
        image = ax.imshow(values, origin="lower", extent=extent, vmin=0, vmax=1, aspect="auto")
        ax.figure.colorbar(image, ax=ax, label=name)
        ax.set(xlabel=f"x{across + 1}", ylabel=f"x{up + 1}")
    else:
        ax.stairs(solution.lower, np.linspace(problem.lower[0], problem.upper[0], cells[0] + 1))
        ax.set(xlabel="x1", ylabel=name, ylim=(0, 1.05))
    return ax


def trajectories(solution, runs=10, seed=0, start=None, across=0, up=1, ax=None):
    """Runs of the closed loop over two dimensions of the state, or over time if up is None or there is one dimension only.

    Returns the axes of matplotlib.
    """
    import matplotlib.pyplot as plt

    ax = plt.subplots()[1] if ax is None else ax
    if solution.controller.states == 1:
        up = None
    for run in range(runs):
        states = solution.trajectory(run, seed, start)["states"]
        x = np.arange(len(states)) if up is None else states[:, across]
        ax.plot(x, states[:, across if up is None else up], marker=".", linewidth=0.8)
    return ax
