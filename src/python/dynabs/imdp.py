"""Interval MDPs: models from arrays, SciPy's matrices and files, properties, certificates.

    model = dynabs.imdp.Model([0, 1, 1], [0, 2], [0, 1], [0.4, 0.3], [0.7, 0.6], labels={"goal": [1]})
    result = model.solve('Pmaxmin=? [ F<=3 "goal" ]', certificate="goal.cert")
    result.lower, result.upper                      # bounds in every state
    dynabs.imdp.verify("goal.cert", model)          # again, in exact arithmetic
"""

import numpy as np

from ._dynabs import Error, Model, Result, verify

__all__ = ["Model", "Result", "from_scipy", "to_scipy", "verify"]


def from_scipy(lower, upper, state_offsets=None, labels=None, initial=(0,)):
    """A model of two sparse matrices, a row for each choice and a column for each state.

    lower, upper: (choices, states), any format of SciPy; an entry of upper is a transition, and one that lower lacks is 0 there.
    state_offsets: (states + 1,), where the choices of each state begin and end; one choice for each state if it is None.
    """
    upper = upper.tocsr().copy()
    upper.sum_duplicates()
    lower = lower.tocsr().copy()
    lower.sum_duplicates()
    if lower.shape != upper.shape:
        raise Error(f"lower: found the shape {lower.shape}; expected that of upper, {upper.shape}")
    rows = np.repeat(np.arange(upper.shape[0]), np.diff(upper.indptr))
    bounds = np.asarray(lower[rows, upper.indices]).ravel() if len(rows) else np.zeros(0)
    if np.count_nonzero(bounds) != lower.count_nonzero():
        raise Error("lower: found entries where upper has none; expected lower <= upper")
    if state_offsets is None:
        state_offsets = np.arange(upper.shape[0] + 1)
    return Model(state_offsets, upper.indptr, upper.indices, bounds, upper.data, labels or {}, list(initial))


def to_scipy(model):
    """lower, upper, state_offsets of a model: two matrices in SciPy's CSR format, (choices, states), and (states + 1,)."""
    import scipy.sparse

    state_offsets, choice_offsets, successors, lower, upper = model.arrays()
    shape = (len(choice_offsets) - 1, model.states)
    matrices = [scipy.sparse.csr_array((bounds, successors, choice_offsets), shape) for bounds in (lower, upper)]
    return (*matrices, state_offsets)
