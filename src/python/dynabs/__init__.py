"""From a noisy control system to a controller with a proof.

    problem = dynabs.Problem({"dynamics": {"A": A, "B": B}, ...})       # or dynabs.Problem.read("model.json")
    solution = problem.compile().solve()
    solution.lower                                  # a lower bound on the probability of success from every cell
    status, u = solution.controller(x, k=0)         # one state, (n,), or an array of states, (m, n)
    solution.simulate(runs=100_000)
    solution.save("out/di")                         # for the command line; dynabs.open("out/di") is the solution again

The fields of a problem are those of the model file (docs/guide.md); wherever it has lists, arrays will do. Whatever takes
long leaves other threads running and ends with Ctrl-C. A mistake is a dynabs.Error with path, found and expected.

In shapes n is the number of states, p of inputs, d of steps that are grouped.
"""

import enum

from . import imdp
from ._dynabs import Abstraction, Controller, Error, Problem, Solution, __version__, open

__all__ = ["Abstraction", "Controller", "Error", "Problem", "Solution", "Status", "__version__", "imdp", "open"]


class Status(enum.IntEnum):
    """What a controller says of a state: ACT with inputs; any other ends the run."""

    ACT = 0
    REACHED = 1
    UNSAFE = 2
    OUTSIDE = 3
    NO_ACTION = 4
    OVER = 5
