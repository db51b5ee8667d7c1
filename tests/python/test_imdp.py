"""Interval MDPs of arrays, sparse matrices and files."""

import numpy as np
import pytest

import dynabs
from dynabs import imdp

ARRAYS = ([0, 1, 1], [0, 2], [0, 1], [0.4, 0.3], [0.7, 0.6])


def model(**changes):
    return imdp.Model(*ARRAYS, **{"labels": {"goal": [1]}, **changes})


def test_properties_have_bounds_in_every_state():
    small = model()
    assert (small.states, small.choices, small.transitions, small.labels, small.initial) == (2, 1, 2, {"goal": [1]}, [0])
    result = small.solve('Pmaxmin=? [ F<=3 "goal" ]')
    value = 1 - 0.7**3
    assert result.lower[0] <= value <= result.upper[0] and result.upper[0] - result.lower[0] < 1e-9
    assert result.value == (result.lower[0], result.upper[0]) and result.lower[1] == 1 and result.holds is None
    assert small.solve('(Pmaxmin=? [ F<=3 "goal" ])>=0.5').holds is True
    assert small.solve('(Pmaxmin=? [ F<=3 "goal" ]) > 0.9').holds is False
    with pytest.raises(dynabs.Error) as error:
        small.solve("Pmaxmin=? [ F")
    assert error.value.path.startswith("property")


def test_there_and_back(tmp_path):
    small = model()
    again = imdp.Model(*small.arrays(), labels=small.labels)
    for ending in ["dynabs", "drn", "umb", "tra"]:
        again.write(tmp_path / f"m.{ending}")
        read = imdp.Model.read(tmp_path / f"m.{ending}")
        for before, after in zip(small.arrays(), read.arrays()):
            # A state without a choice may be written as one that stays.
            assert np.array_equal(before, after[: len(before)])
        assert read.labels["goal"] == [1] and small.warnings == []
    (tmp_path / "m.lab").unlink()
    assert any("m.lab" in warning for warning in imdp.Model.read(tmp_path / "m.tra").warnings)
    with pytest.raises(dynabs.Error, match="ends in"):
        small.write(tmp_path / "m.txt7")


def test_sparse_matrices():
    scipy = pytest.importorskip("scipy.sparse")
    upper = scipy.csr_array([[0.7, 0.6, 0], [0, 1, 0], [0, 0.5, 1]])
    lower = scipy.csr_array([[0.4, 0, 0], [0, 1, 0], [0, 0, 0.5]])
    sparse = imdp.from_scipy(lower, upper, labels={"goal": [1]})
    back = imdp.to_scipy(sparse)
    assert abs(back[0] - lower).max() == 0 and abs(back[1] - upper).max() == 0
    assert back[2].tolist() == [0, 1, 2, 3]
    assert sparse.solve('Pmaxmin=? [ X "goal" ]').lower[0] == pytest.approx(0.3)
    # Entries that are there twice are one, their sum.
    twice = scipy.coo_array(([0.3, 0.1, 1, 0.5], ([0, 0, 1, 2], [0, 0, 1, 2])), (3, 3))
    assert np.allclose(imdp.from_scipy(twice, upper).arrays()[3], sparse.arrays()[3])
    with pytest.raises(dynabs.Error, match="lower"):
        imdp.from_scipy(scipy.csr_array([[0.4, 0, 0.1], [0, 1, 0], [0, 0, 0.5]]), upper)


def test_certificates_prove(tmp_path):
    for i, text in enumerate(['Pmaxmin=? [ F<=3 "goal" ]', 'Pmaxmin=? [ F "goal" ]', '(Pmaxmin=? [ F<=3 "goal" ]) > 0.5']):
        path = tmp_path / f"{i}.cert"
        result = model().solve(text, certificate=path)
        proved = imdp.verify(path, model())
        assert proved["states"] == 2 and "goal" in proved["property"]
        if "> 0.5" not in text:
            assert result.lower[0] <= proved["upper"] and proved["lower"] <= result.upper[0]
    other = imdp.Model([0, 1, 1], [0, 2], [0, 1], [0.4, 0.3], [0.7, 0.5], labels={"goal": [1]})
    with pytest.raises(dynabs.Error):
        imdp.verify(path, other)
    path.write_text(path.read_text().replace("states 2", "states 3"))
    with pytest.raises(dynabs.Error):
        imdp.verify(path, model())


def test_compiled_models():
    room = dynabs.Problem({
        "name": "room", "dynamics": {"A": [[0.9]], "B": [[1]]},
        "noise": {"gaussian": {"mean": [0], "covariance": [[0.01]]}, "count": 500},
        "input": {"lower": [-1], "upper": [1]}, "partition": {"lower": [-3], "upper": [3], "cells": [12]},
        "task": {"goal": [{"lower": [-0.5], "upper": [0.5]}], "horizon": 3}, "initial_state": [2],
    })
    abstraction = room.compile()
    result = abstraction.model.solve(abstraction.property)
    assert result.value[0] == abstraction.solve().bound


@pytest.mark.parametrize(("change", "path"), [
    ((0, [0, 1, 2]), "state_offsets"), ((0, [1, 1]), "state_offsets"), ((1, [0, 3]), "successors, lower, upper"),
    ((1, [2, 0]), "choice_offsets"), ((2, [0, 0.5]), "successors"), ((2, [0, 7]), "row 0"), ((2, [1, 0]), "row 0"),
    ((3, [0.8, 0.3]), "row 0"), ((3, [np.nan, 0.3]), "row 0"), ((4, [0.2, 0.2]), "row 0"), ((3, [[0.4, 0.3]]), "lower"),
])
def test_what_is_no_model_is_refused(change, path):
    arrays = list(ARRAYS)
    arrays[change[0]] = change[1]
    with pytest.raises(dynabs.Error) as error:
        imdp.Model(*arrays)
    assert error.value.path == path and error.value.found and error.value.expected
    for wrong in [{"labels": {"goal": [2]}}, {"initial": [5]}, {"initial": []}]:
        with pytest.raises(dynabs.Error):
            model(**wrong)
