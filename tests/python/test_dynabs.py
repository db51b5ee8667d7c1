"""The package, built and installed: problems, solutions, controllers, errors, threads, Ctrl-C."""

import json
import os
import pathlib
import runpy
import signal
import threading
import time

import numpy as np
import pytest

import dynabs

ROOT = pathlib.Path(__file__).parents[2]
ROOM = ROOT / "models" / "room_temperature.json"


@pytest.fixture(autouse=True)
def interrupts_are_heard():
    """Whoever starts the tests in the background may have told them to ignore interrupts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def solved(model=ROOM, **changes):
    document = json.loads(pathlib.Path(model).read_text())
    document.update(changes)
    problem = dynabs.Problem(document, directory=pathlib.Path(model).parent)
    return problem, problem.compile().solve()


def test_a_model_file_and_its_dict_are_one_problem():
    problem, solution = solved()
    other = dynabs.Problem.read(ROOM).compile().solve()
    assert (problem.name, problem.actions, problem.horizon) == ("room_temperature", "targets", 6)
    assert solution.lower.shape == tuple(problem.cells) and np.array_equal(solution.lower, other.lower)
    assert solution.bound == other.bound and solution.bound > 0.99
    assert (solution.lower <= solution.upper).all()
    assert solution.lower_at(problem.initial_state) == solution.bound
    assert solution.lower_at([[2.0], [1e9]]).tolist() == [solution.bound, 0]
    assert "confidence 0.99" in solution.promise


def test_arrays_are_lists():
    document = json.loads((ROOT / "models" / "double_integrator.json").read_text())
    samples = np.loadtxt(ROOT / "models" / document["noise"]["samples"]["file"], delimiter=",")
    of_file = dynabs.Problem(document, directory=ROOT / "models").compile().solve()
    document["noise"]["samples"] = {"values": samples, "of": document["noise"]["samples"]["of"]}
    document["dynamics"]["A"] = np.array(document["dynamics"]["A"], dtype=np.int32)
    document["partition"]["cells"] = tuple(np.array(document["partition"]["cells"]))
    document["partition"]["lower"] = np.array(document["partition"]["lower"], dtype=float)
    of_arrays = dynabs.Problem(document).compile().solve()
    assert np.array_equal(of_file.lower, of_arrays.lower) and np.array_equal(of_file.upper, of_arrays.upper)


def test_controllers_take_one_state_or_many():
    problem, solution = solved(ROOT / "models" / "double_integrator.json")
    controller = solution.controller
    assert (controller.states, controller.inputs, controller.group_steps, controller.start) == (2, 1, 2, None)
    x = np.random.default_rng(1).uniform(problem.lower * 1.1, problem.upper * 1.1, (1000, 2))
    x[0] = np.nan, 0
    k = np.arange(1000) % (controller.horizon + 2)
    status, u = controller(x, k)
    assert u.shape == (1000, 2, 1) and status[0] == dynabs.Status.OUTSIDE
    assert set(status) >= {dynabs.Status.ACT, dynabs.Status.OUTSIDE, dynabs.Status.OVER}
    assert np.isnan(u[status != 0]).all() and (abs(u[status == 0]) <= 60).all()
    for i in range(0, 1000, 37):
        one, of_one = controller(x[i], int(k[i]))
        assert one == status[i] and np.array_equal(of_one, u[i], equal_nan=True)
    assert np.array_equal(controller(x.tolist(), 0)[0], controller(np.asfortranarray(x), 0)[0])
    for wrong, name in [(([1, 2, 3],), "x"), ((x, [1, 2]), "k"), (([0, 0], 0, 0), "memory")]:
        with pytest.raises(dynabs.Error) as error:
            controller(*wrong)
        assert error.value.path == name and error.value.expected
    with pytest.raises(TypeError):
        controller([0, 0], 0.5)


def test_a_million_states_are_quick():
    controller = solved(ROOT / "models" / "double_integrator.json")[1].controller
    status, u = controller(np.random.default_rng(1).uniform(-40, 40, (1_000_000, 2)))
    assert len(status) == 1_000_000 and (status == 0).any()


def test_tasks_with_a_memory_hand_it_on():
    document = json.loads((ROOT / "examples" / "tasks" / "sequence.json").read_text())
    problem = dynabs.Problem(document)
    solution = problem.compile().solve()
    controller = solution.controller
    assert problem.actions == "inputs" and controller.start is not None
    middle = (problem.lower + problem.upper) / 2
    first = controller(middle)
    assert len(first) == 3 and first[2] != controller.start
    assert controller(middle, 0, controller.start)[2] == first[2]
    status, u, memory = controller(np.tile(middle, (5, 1)), 1, np.full(5, first[2]))
    assert memory.shape == status.shape == (5,) and u.shape[0] == 5
    with pytest.raises(dynabs.Error):
        controller(middle, 0, 1000)


def test_the_closed_loop_keeps_its_promise():
    problem, solution = solved()
    said = solution.simulate(runs=2000, seed=3)
    assert said == solution.simulate(runs=2000, seed=3)
    assert said["runs"] == 2000 and said["promised"] == solution.bound
    assert not said["contradicted"] and said["violations"] == 0
    assert sum(said["ended"].values()) == 2000
    run = solution.trajectory(seed=3)
    steps, p = run["inputs"].shape
    assert run["states"].shape == (steps + 1, 1) and p == 1
    assert run["states"][0] == problem.initial_state
    for wrong in [{"start": [1e9]}, {"start": [np.nan]}, {"start": [1, 2]}, {"runs": 0}, {"confidence": 1.0}]:
        with pytest.raises(dynabs.Error):
            solution.simulate(**wrong)


def test_mistakes_say_where_what_and_what_not():
    document = json.loads(ROOM.read_text())
    document["partition"]["cells"] = [-1]
    with pytest.raises(ValueError) as error:
        dynabs.Problem(document)
    assert isinstance(error.value, dynabs.Error) and error.value.path.startswith("/partition/cells")
    assert error.value.found and error.value.expected and error.value.expected in str(error.value)
    with pytest.raises(dynabs.Error) as error:
        dynabs.Problem({"dynamics": {"A": [[np.nan]]}})
    with pytest.raises(dynabs.Error) as error:
        dynabs.Problem.read("nowhere.json")
    assert "nowhere.json" in str(error.value)
    with pytest.raises(TypeError):
        dynabs.Problem({"name": object()})


def test_other_threads_go_on():
    counted, done = 0, threading.Event()

    def work():
        for _ in range(5):
            solved()
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 5


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_ctrl_c_ends_long_work():
    problem, solution = solved()
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        solution.simulate(runs=10**9)
    assert time.monotonic() - begin < 60
    # And it goes on afterwards.
    assert solution.simulate(runs=10)["runs"] == 10


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_ctrl_c_ends_a_long_run():
    room = {
        "name": "room", "dynamics": {"A": [[0.9]], "B": [[1]]}, "actions": "inputs",
        "noise": {"components": [{"uniform": {"lower": -0.1, "upper": 0.1}}]},
        "input": {"lower": [-1], "upper": [1], "points": [3]},
        "partition": {"lower": [-2], "upper": [2], "cells": [20]},
        "task": {"type": "stay", "horizon": "infinite"}, "initial_state": [0],
    }
    solution = dynabs.Problem(room).compile().solve()
    assert solution.bound > 0.999 and solution.confidence == 1
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        solution.trajectory(most_steps=10**12)
    assert solution.trajectory(most_steps=10)["inputs"].shape == (10, 1)


@pytest.mark.parametrize("model", [ROOM, ROOT / "examples" / "tasks" / "sequence.json"])
def test_runs_are_saved_and_opened(model, tmp_path):
    problem, solution = solved(model)
    solution.save(tmp_path / "run")
    again = dynabs.open(tmp_path / "run")
    assert np.array_equal(again.lower, solution.lower) and np.array_equal(again.upper, solution.upper)
    assert again.promise == solution.promise and again.bound == solution.bound
    x = np.random.default_rng(1).uniform(problem.lower, problem.upper, (1000, len(problem.cells)))
    for one, other in zip(again.controller(x), solution.controller(x)):
        assert np.array_equal(one, other, equal_nan=True)
    with pytest.raises(dynabs.Error):
        solution.save(tmp_path / "run")
    solution.save(tmp_path / "run", force=True)
    # What was opened and is saved is what it was.
    again.save(tmp_path / "copy")
    files = sorted(path.name for path in (tmp_path / "run").iterdir())
    assert "solution.bin" in files and files == sorted(path.name for path in (tmp_path / "copy").iterdir())
    for name in files:
        assert (tmp_path / "run" / name).read_bytes() == (tmp_path / "copy" / name).read_bytes(), name
    (tmp_path / "run" / "solution.bin").write_bytes(b"")
    for wrong in ["run", "nowhere"]:
        with pytest.raises(dynabs.Error):
            dynabs.open(tmp_path / wrong)


def test_nothing_is_guaranteed_in_reference_mode():
    pytest.importorskip("matplotlib").use("Agg")
    from dynabs import plot

    problem, solution = solved(probabilities={"mode": "reference"})
    assert solution.confidence is None and solved()[1].confidence == 0.99
    said = solution.simulate(runs=100)
    assert said["promised"] is None and said["contradicted"] is None
    assert "guaranteed" not in plot.bounds(solution, problem).get_ylabel()
    # A run with one coordinate is drawn over time.
    line = plot.trajectories(solution, runs=1).lines[0]
    assert line.get_xdata().tolist() == list(range(len(line.get_ydata())))


@pytest.mark.parametrize("example", ["tutorial.py", "sweep.py"])
def test_examples_run(example, capsys):
    runpy.run_path(str(ROOT / "examples" / "python" / example), run_name="__main__")
    assert capsys.readouterr().out


def test_everything_has_words_and_types():
    stubs = (pathlib.Path(dynabs.__file__).parent / "_dynabs.pyi").read_text()
    assert (pathlib.Path(dynabs.__file__).parent / "py.typed").exists()
    from dynabs import _dynabs

    for name in ["Problem", "Abstraction", "Solution", "Controller", "Model", "Result", "Error", "verify", "open"]:
        one = getattr(_dynabs, name)
        assert one.__doc__ and f" {name}" in stubs
        for member in vars(one) if isinstance(one, type) else []:
            if not member.startswith("_"):
                assert getattr(one, member).__doc__, f"{name}.{member}"
                assert f"def {member}(" in stubs, f"{name}.{member}"
